"""Fields that shape a program: plain Python numbers, truth values and words, static, never traced."""

import dataclasses
import math
from collections.abc import Callable, Iterable
from typing import Any

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from .arguments import require_choice
from .checks import RANGES

_WORDS = {int: "a whole number", float: "one finite number", bool: "True or False"}


def count(
    name: str,
    default: Any = dataclasses.MISSING,
    *,
    least: int | None = None,
    most: int | None = None,
    **kwargs: Any,
) -> Any:
    """Static field that holds a whole number, not below `least` and not above `most`; `name` as messages have it.
    `None` passes where it is the default."""

    def read(value: Any) -> int:
        number = static_count(name, value, least if most is None else None)
        if most is not None and not (least or 0) <= number <= most:
            raise ValueError(f"{name} must be from {least or 0} to {most}, got {number}")
        return number

    return _field(read, default, kwargs, {"count": (least, most)})


def constant(
    name: str,
    default: Any = dataclasses.MISSING,
    *,
    bound: str = "finite",
    among: Iterable[float] | None = None,
    **kwargs: Any,
) -> Any:
    """Static field that holds one finite number without a unit, within a bound of `checks.RANGES` or `among` some
    numbers; `name` as messages have it. `None` passes where it is the default."""
    numbers = None if among is None else tuple(among)

    def read(value: Any) -> float:
        number = static_number(name, value, float)
        if not RANGES[bound].holds(number):
            raise ValueError(f"{name} must be {bound}, got {number:g}")
        if numbers is not None and number not in numbers:
            raise ValueError(f"{name} must be one of {numbers}, got {number!r}")
        return number

    return _field(read, default, kwargs, {"constant": bound, "among": numbers})


def switch(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds `True` or `False`; `name` as messages have it. `None` passes where it is the default."""
    return _field(lambda value: static_number(name, value, bool), default, kwargs, {"switch": True})


def choice(name: str, choices: Iterable[str], default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds one of some words; `name` as messages have it. `None` passes where it is the default."""
    words = tuple(choices)

    def read(value: Any) -> str:
        value = _untraced(name, value)
        require_choice(name, value, words)
        return str(value)

    return _field(read, default, kwargs, {"choices": words})


def _field(read: Callable[[Any], Any], default: Any, kwargs: dict[str, Any], said: dict[str, Any]) -> Any:
    """**Arguments:** `said`: what scene files read of the field, see `scenes.table_of`."""
    if default is not dataclasses.MISSING:
        kwargs["default"] = default

    def converter(value: Any) -> Any:
        return None if value is None and default is None else read(value)

    metadata = {**said, **kwargs.pop("metadata", {})}
    return eqx.field(static=True, converter=converter, metadata=metadata, **kwargs)


def static_count(name: str, value: Any, least: int | None = None) -> int:
    """The value as a Python `int`. **Raises:** `ValueError` as `static_number`, and below `least`."""
    number = static_number(name, value, int)
    if least is not None and number < least:
        raise ValueError(f"{name} must be >= {least}, got {number}")
    return number


def static_number(name: str, value: Any, kind: type) -> Any:
    """The value as a Python `int`, `float` or `bool`, also of a numpy or JAX scalar.

    **Raises:** `ValueError` for a traced value, and for a value of another kind.
    """
    value = _untraced(name, value)
    is_bool = isinstance(value, bool)
    good = is_bool if kind is bool else not is_bool and isinstance(value, int if kind is int else int | float)
    if not good or not math.isfinite(value):
        raise ValueError(f"{name} must be {_WORDS[kind]}, got {value!r}")
    return kind(value)


def _untraced(name: str, value: Any) -> Any:
    """A numpy or JAX scalar as the Python value; any other as it is. **Raises:** `ValueError` for a traced value."""
    if isinstance(value, Tracer):
        raise ValueError(
            f"{name}: got a traced value, but it is structure: the program that JAX compiles depends on it. Give a "
            "plain Python value, outside of jit, vmap and grad; each value compiles a program of its own"
        )
    return plain(value)


def plain(value: Any) -> Any:
    """A numpy or JAX scalar as the Python value; any other as it is, a traced value too."""
    if isinstance(value, np.generic | np.ndarray | jax.Array) and not isinstance(value, Tracer) and value.ndim == 0:
        return np.asarray(value).item()
    return value
