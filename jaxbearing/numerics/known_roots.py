"""Roots that one program has found, for another that differentiates results there without searching again.

A search asks `at_known_root` where it would begin. In a block of `recorded_roots` its root is noted, in the order of
the searches; in a block of `known_roots` it takes the root that was noted and does not search.
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
    """For a block that is traced: gives the list of the roots that it finds, filled at its end."""
    noted: list[object] = []
    with _set(_Roots(noted, None, True)):
        yield noted


@contextmanager
def known_roots(roots: Iterable[object], stiffness: bool = True) -> Iterator[None]:
    """For a block that is traced: its searches take these roots, which `recorded_roots` noted in the same block.

    **Arguments:** `stiffness`: whether what is computed from a Jacobian, as the stiffness, is differentiated; its
    derivatives are NaN else, and a third of the time of tracing is saved.
    """
    with _set(_Roots([], deque(roots), stiffness)):
        yield


@contextmanager
def own_roots() -> Iterator[None]:
    """For a block whose searches are parts of another search: their roots are neither noted nor known."""
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
    """The root of a search.

    **Arguments:** `search`: finds it; `known`: the same with its derivatives, from the root that was noted and
    `stiffness` of `known_roots`.
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
