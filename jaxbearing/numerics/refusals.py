"""Errors of an input reported together: a message names everything that is wrong, and not only the first."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar


class Refusals(ValueError):
    """Error of an input that is wrong in several ways: one line of the message for each of the errors `refusals`."""

    def __init__(self, refusals: Iterable[ValueError]):
        self.refusals = tuple(refusals)
        super().__init__("\n".join(map(str, self.refusals)))


UNDECIDED = (AttributeError, TypeError)
"""Errors of a rule that needs a value which has been refused already; they are passed over while `collecting`."""
_COLLECTED: ContextVar[list[ValueError] | None] = ContextVar("refusals that are collected", default=None)


@contextmanager
def collecting() -> Iterator[list[ValueError]]:
    """Context in which `refuse_all` adds errors to this list and does not raise them.

    Rules that cannot be decided are passed over. An object made inside only serves to find its errors and
    is not used."""
    errors: list[ValueError] = []
    token = _COLLECTED.set(errors)
    try:
        yield errors
    finally:
        _COLLECTED.reset(token)


def is_collecting() -> bool:
    """True inside of `collecting`."""
    return _COLLECTED.get() is not None


def refuse_all(problems: Iterable[str | ValueError]) -> None:
    """Raises the problems, or adds them to the list of `collecting`.

    **Raises:** `ValueError` for one problem, `Refusals` for several.
    """
    collected = _COLLECTED.get()
    if collected is not None:
        try:
            for problem in problems:
                collected.append(problem if isinstance(problem, ValueError) else ValueError(problem))
        except UNDECIDED:
            pass
        return
    errors = {str(problem): problem if isinstance(problem, ValueError) else ValueError(problem) for problem in problems}
    if len(errors) == 1:
        raise next(iter(errors.values()))
    if errors:
        raise Refusals(errors.values())


def refusals_of(check: Callable[..., object], *args: object) -> Iterator[ValueError]:
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
