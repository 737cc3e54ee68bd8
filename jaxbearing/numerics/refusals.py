"""Several refusals told at once."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any


class Refusals(ValueError):
    """Several things are wrong; the message has a line for each. `refusals`: the errors one by one."""

    def __init__(self, refusals: Iterable[ValueError]):
        self.refusals = tuple(refusals)
        super().__init__("\n".join(map(str, self.refusals)))


def refuse_all(problems: Iterable[str | ValueError]) -> None:
    """**Raises:** `ValueError` with what is wrong, `Refusals` where that is several things."""
    errors = {str(one): one if isinstance(one, ValueError) else ValueError(one) for one in problems}
    if len(errors) == 1:
        raise next(iter(errors.values()))
    if errors:
        raise Refusals(errors.values())


def refusals_of(check: Callable[..., Any], *args: Any) -> Iterator[ValueError]:
    """The problems that a check raises, one by one."""
    try:
        check(*args)
    except Refusals as several:
        yield from several.refusals
    except ValueError as error:
        yield error
