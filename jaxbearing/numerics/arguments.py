"""Checks of the arguments of public functions, where they are known: choices, angles, temperatures, counts."""

import difflib
from collections.abc import Iterable
from typing import Any

import jax
import numpy as np
from jax.core import Tracer

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
