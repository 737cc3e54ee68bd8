"""Refusing numbers that are out of range, where they are known: not while JAX traces or transforms a tree."""

import difflib
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


COLDEST = 150.0
"""K; every lubricant is a solid there: a lower number is in another unit. There is no such limit above: the laws say
how they go on."""


def _numbers(value: Any) -> np.ndarray | None:
    """The numbers of an argument; `None` where they are traced, or none of these."""
    if isinstance(value, Tracer) or not isinstance(value, int | float | np.generic | np.ndarray | jax.Array):
        return None
    return np.asarray(value)


def require_choice(name: str, value: Any, choices: Iterable[str]) -> None:
    """**Raises:** `ValueError` for what is none of the choices, with the nearest one."""
    known_ones = tuple(choices)
    if isinstance(value, str) and value in known_ones:
        return
    near = difflib.get_close_matches(value, known_ones, n=1) if isinstance(value, str) else []
    hint = f"; did you mean {near[0]!r}?" if near else ""
    raise ValueError(f"{name} must be one of {', '.join(map(repr, known_ones))}, got {value!r}{hint}")


def require_angle(name: str, value: Any) -> None:
    """**Raises:** `ValueError` for an angle, rad, that is not from 0 to below a right angle; degrees are not."""
    angles = _numbers(value)
    wrong = [] if angles is None else angles[~((angles >= 0.0) & (angles < 0.5 * np.pi))].ravel()
    if len(wrong):
        given = float(wrong[0])
        hint = f" ({given:g} degrees are {np.radians(given):.4g} rad)" if 0.0 < given < 90.0 else ""
        raise ValueError(f"{name} must be an angle in rad, from 0 to below pi/2, got {given:g}{hint}")


def require_temperature(value: Any, name: str = "temperature") -> None:
    """**Raises:** `ValueError` for a temperature below `COLDEST`, as one in degrees Celsius is. A NaN of a failed solve
    passes, and so do traced values, such as the trial values of a solver."""
    given = _numbers(value)
    wrong = [] if given is None else given[given < COLDEST].ravel()
    if len(wrong):
        first = float(wrong[0])
        hint = f" ({first:g} degC are {first + 273.15:g} K)" if first > -100.0 else ""
        raise ValueError(f"{name} must be in K, at least {COLDEST:g}, got {first:g}{hint}")


def require_count(name: str, value: Any, least: int = 1) -> None:
    """**Raises:** `ValueError` for what is not a whole number from `least` on."""
    number = _numbers(value)
    if isinstance(value, Tracer):
        return
    whole = number is not None and number.ndim == 0 and number.dtype.kind in "iu" and number >= least
    if not whole:
        raise ValueError(f"{name} must be a whole number >= {least}, got {value!r}")
