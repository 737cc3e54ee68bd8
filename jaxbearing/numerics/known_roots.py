"""Roots that one program has found, reused by another that differentiates the results without a new search.

A search is called through `at_known_root`. In a block of `recorded_roots` its root is noted, in the order of the
searches; in a block of `known_roots` the noted root is used and there is no search.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple, TypeVar

import jax

Root = TypeVar("Root")


class _Roots(NamedTuple):
    noted: list[Any]
    known: deque[Any] | None
    stiffness: bool


_ROOTS: ContextVar[_Roots | None] = ContextVar("roots that are recorded or known", default=None)


@contextmanager
def recorded_roots() -> Iterator[list[object]]:
    """Context for a block that is traced: yields the list of the roots found in it, complete at its end."""
    noted: list[object] = []
    with _set(_Roots(noted, None, True)):
        yield noted


@contextmanager
def known_roots(roots: Iterable[object], stiffness: bool = True) -> Iterator[None]:
    """Context for a block that is traced: its searches take these roots, noted by `recorded_roots` for the same code.

    **Arguments:** `stiffness`: True if results computed from a Jacobian, such as the stiffness, are differentiated;
    if False their derivatives are NaN, and a third of the tracing time is saved.
    """
    with _set(_Roots([], deque(roots), stiffness)):
        yield


@contextmanager
def own_roots() -> Iterator[None]:
    """Context for searches that are parts of another search: their roots are neither noted nor taken as known."""
    with _set(None):
        yield


def recording() -> bool:
    """True in a block of `recorded_roots`."""
    roots = _ROOTS.get()
    return roots is not None and roots.known is None


@contextmanager
def _set(roots: _Roots | None) -> Iterator[None]:
    token = _ROOTS.set(roots)
    try:
        yield
    finally:
        _ROOTS.reset(token)


def at_known_root(search: Callable[[], Root], known: Callable[[Root, bool], Root]) -> Root:
    """The root of a search, or the known root in its place.

    **Arguments:** `search`: finds the root; `known`: gives the noted root its derivatives; its arguments are this root
    and `stiffness` of `known_roots`.
    """
    roots = _ROOTS.get()
    if roots is None:
        return search()
    if roots.known is not None:
        # a root depends on the numbers of its search, and on nothing else
        return known(jax.lax.stop_gradient(roots.known.popleft()), roots.stiffness)
    root = search()
    roots.noted.append(root)
    return root
