"""Fields that shape a program: plain Python numbers, static, never traced."""

import dataclasses
import math
from typing import Any

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer


def count(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds a whole number; `name` as messages have it. `None` passes where it is the default."""
    return _field(name, int, default, kwargs)


def constant(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds one finite number; `name` as messages have it. `None` passes where it is the default."""
    return _field(name, float, default, kwargs)


def _field(name: str, kind: type, default: Any, kwargs: dict[str, Any]) -> Any:
    if default is not dataclasses.MISSING:
        kwargs["default"] = default

    def converter(value: Any) -> Any:
        return None if value is None and default is None else static_number(name, value, kind)

    return eqx.field(static=True, converter=converter, **kwargs)


def static_number(name: str, value: Any, kind: type) -> Any:
    """The value as a Python `int` or `float`, also of a numpy or JAX scalar.

    **Raises:** `ValueError` for a traced value, for another kind of number, and for what is no number.
    """
    if isinstance(value, Tracer):
        raise ValueError(
            f"{name}: got a traced value, but it is structure: the program that JAX compiles depends on it. Give a "
            "Python number, outside of jit, vmap and grad; each value compiles a program of its own"
        )
    if isinstance(value, np.generic | np.ndarray | jax.Array) and np.ndim(value) == 0:
        value = np.asarray(value).item()
    allowed = int if kind is int else int | float
    if isinstance(value, bool) or not isinstance(value, allowed) or not math.isfinite(value):
        what = "a whole number" if kind is int else "one finite number"
        raise ValueError(f"{name} must be {what}, got {value!r}")
    return kind(value)
