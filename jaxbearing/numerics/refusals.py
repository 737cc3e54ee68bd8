"""Several refusals told at once."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any


class Refusals(ValueError):
    """Several things are wrong; the message has a line for each. `refusals`: the errors one by one."""

    def __init__(self, refusals: Iterable[ValueError]):
        self.refusals = tuple(refusals)
        super().__init__("\n".join(map(str, self.refusals)))


UNDECIDED = (AttributeError, TypeError)
"""Errors of a rule that needs a value which is refused already, where `collecting`."""
_COLLECTED: ContextVar[list[ValueError] | None] = ContextVar("refusals that are collected", default=None)


@contextmanager
def collecting() -> Iterator[list[ValueError]]:
    """Inside, `refuse_all` adds to this list instead of raising, and rules that cannot be decided are passed over: for
    objects that are made to find all that is wrong with them, and are not used."""
    found: list[ValueError] = []
    token = _COLLECTED.set(found)
    try:
        yield found
    finally:
        _COLLECTED.reset(token)


def is_collecting() -> bool:
    return _COLLECTED.get() is not None


def refuse_all(problems: Iterable[str | ValueError]) -> None:
    """**Raises:** `ValueError` with what is wrong, `Refusals` where that is several things."""
    collected = _COLLECTED.get()
    if collected is not None:
        try:
            for one in problems:
                collected.append(one if isinstance(one, ValueError) else ValueError(one))
        except UNDECIDED:
            pass
        return
    errors = {str(one): one if isinstance(one, ValueError) else ValueError(one) for one in problems}
    if len(errors) == 1:
        raise next(iter(errors.values()))
    if errors:
        raise Refusals(errors.values())


def refusals_of(check: Callable[..., Any], *args: Any) -> Iterator[ValueError]:
    """The problems that a check raises, one by one."""
    try:
        check(*args)
    except UNDECIDED:
        if not is_collecting():
            raise
    except Refusals as several:
        yield from several.refusals
    except ValueError as error:
        yield error
