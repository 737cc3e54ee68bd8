"""Refusing numbers that are out of range, where they are known: not while JAX traces or transforms a tree."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import jax
import numpy as np
from jax.core import Tracer

RANGES = {
    "> 0": lambda v: v > 0,
    ">= 0": lambda v: v >= 0,
    "finite": lambda v: v == v,
    "between 0 and 1": lambda v: (v >= 0) & (v <= 1),
    "between 0 and 0.5": lambda v: (v >= 0) & (v <= 0.5),
}


def known(*values: Any) -> tuple[float, ...] | None:
    """The values as floats, or `None` where one of them is traced or missing, or stands in for a number."""
    numbers = (int, float, np.generic, np.ndarray, jax.Array)
    if any(isinstance(v, Tracer) or not isinstance(v, numbers) for v in values):
        return None
    return tuple(float(v) for v in values)


def require(part: str, **checks: tuple[Any, str]) -> None:
    """`checks` maps a field name to (value, range), the range one of `RANGES`; `None` and tracers pass.

    **Raises:** `ValueError` naming part, field, the value and what is allowed.
    """
    for name, (value, allowed) in checks.items():
        if isinstance(value, str | bytes | list | tuple | dict) or (np.ndim(value) and not isinstance(value, Tracer)):
            raise ValueError(f"{part}.{name} must be one number, got {value!r}")
        number = known(value)
        if number is not None and not (np.isfinite(number[0]) and RANGES[allowed](number[0])):
            raise ValueError(f"{part}.{name} must be {allowed}, got {number[0]:g}")


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
    """What a check raises, each problem by itself."""
    try:
        check(*args)
    except Refusals as several:
        yield from several.refusals
    except ValueError as error:
        yield error
