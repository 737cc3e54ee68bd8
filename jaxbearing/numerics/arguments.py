"""Checks of arguments of public functions: choices, numbers, angles, temperatures, counts. Traced values pass."""

import difflib
from collections.abc import Iterable

import numpy as np

from .ranges import RANGES

COLDEST = 150.0
"""Lowest temperature that is accepted, K. Every lubricant is solid there, so a lower number is in another unit. There
is no upper limit, because each law of an oil says how it goes on above the range that it was fitted in."""


def _is_traced(value: object) -> bool:
    """True for a traced value of JAX."""
    if isinstance(value, int | float):
        return False
    # plain numbers do not wait for the import of JAX
    from jax.core import Tracer

    return isinstance(value, Tracer)


def _is_array(value: object) -> bool:
    """True for an array of NumPy or JAX, and for a scalar of NumPy; traced values are arrays too."""
    # plain numbers do not wait for the import of JAX
    from jax import Array

    return isinstance(value, np.generic | np.ndarray | Array)


def _numbers(value: object) -> np.ndarray | None:
    """The numbers of an argument; `None` if they are traced, or if it holds no numbers."""
    if isinstance(value, int | float) or (_is_array(value) and not _is_traced(value)):
        return np.asarray(value)
    return None


def _judged(name: str, value: object) -> np.ndarray:
    """The numbers of an argument; an empty array if they are traced.

    **Raises:** `ValueError` for anything but a number or an array of numbers.
    """
    numbers = _numbers(value)
    if numbers is None and (_is_traced(value) or hasattr(value, "dtype")):
        # an object with a dtype that is no array is a placeholder (`jax.ShapeDtypeStruct`)
        return np.empty(0)
    if numbers is None or numbers.dtype.kind not in "iuf":
        raise ValueError(f"{name} must be a number or an array of numbers, got {value!r}")
    return numbers


def require_numbers(bound: str, **values: object) -> None:
    """Checks that each value is a number, or an array of numbers, within a bound. NaN passes, because a failed solve
    returns it, and so do traced values.

    **Arguments:** `bound`: a key of `ranges.RANGES`, such as "> 0"; `values`: name of the argument = its value.

    **Raises:** `ValueError` that names the first argument that is wrong.
    """
    for name, value in values.items():
        numbers = _judged(name, value)
        wrong = numbers[~(RANGES[bound].holds(numbers) | np.isnan(numbers))].ravel()
        if len(wrong):
            raise ValueError(f"{name} must be {bound}, got {float(wrong[0]):g}")


def did_you_mean(name: str, valid: Iterable[str], before: str = "") -> str:
    """The nearest valid name as the end of a message; "" if none is near. **Arguments:** `before`: path in front."""
    near = difflib.get_close_matches(name, tuple(valid), n=1)
    return f"; did you mean {before + near[0]!r}?" if near else ""


def require_choice(name: str, value: object, choices: Iterable[str]) -> None:
    """Checks that a value is one of the choices.

    **Raises:** `ValueError` that lists the choices and suggests the nearest one.
    """
    known_ones = tuple(choices)
    if isinstance(value, str) and value in known_ones:
        return
    hint = did_you_mean(value, known_ones) if isinstance(value, str) else ""
    raise ValueError(f"{name} must be one of {', '.join(map(repr, known_ones))}, got {value!r}{hint}")


def require_angle(name: str, value: object) -> None:
    """Checks that angles are in rad, from 0 to below a right angle. NaN is refused.

    **Raises:** `ValueError`; for a number that may be in degrees it shows the angle in rad.
    """
    angles = _judged(name, value)
    wrong = angles[~((angles >= 0.0) & (angles < 0.5 * np.pi))].ravel()
    if len(wrong):
        first = float(wrong[0])
        hint = f" ({first:g} degrees are {np.radians(first):.4g} rad)" if 0.0 < first < 90.0 else ""
        raise ValueError(f"{name} must be an angle in rad, from 0 to below pi/2, got {first:g}{hint}")


def require_temperature(value: object, name: str = "temperature") -> None:
    """Checks that temperatures are at least `COLDEST`, which catches degrees Celsius below 150. NaN passes, because a
    failed solve returns it, and so do traced values, such as the trial values of a solver.

    **Raises:** `ValueError`; for a number that may be in degrees Celsius it shows the temperature in K.
    """
    temperatures = _judged(name, value)
    wrong = temperatures[temperatures < COLDEST].ravel()
    if len(wrong):
        first = float(wrong[0])
        hint = f" ({first:g} degC are {first + 273.15:g} K)" if first > -100.0 else ""
        raise ValueError(f"{name} must be in K, at least {COLDEST:g}, got {first:g}{hint}")


def require_count(name: str, value: object, least: int = 1) -> None:
    """Checks that a value is a whole number, at least `least`. A traced value passes.

    **Raises:** `ValueError`.
    """
    number = _numbers(value)
    if _is_traced(value):
        return
    whole = number is not None and number.ndim == 0 and number.dtype.kind in "iu" and number >= least
    if not whole:
        raise ValueError(f"{name} must be a whole number >= {least}, got {value!r}")
