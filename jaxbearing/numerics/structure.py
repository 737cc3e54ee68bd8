"""Fields that shape a program: plain Python numbers and truth values, static, never traced."""

import dataclasses
import math
from typing import Any

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

_WORDS = {int: "a whole number", float: "one finite number", bool: "True or False"}


def count(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds a whole number; `name` as messages have it. `None` passes where it is the default."""
    return _field(name, int, default, kwargs)


def constant(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds one finite number; `name` as messages have it. `None` passes where it is the default."""
    return _field(name, float, default, kwargs)


def switch(name: str, default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds `True` or `False`; `name` as messages have it. `None` passes where it is the default."""
    return _field(name, bool, default, kwargs)


def _field(name: str, kind: type, default: Any, kwargs: dict[str, Any]) -> Any:
    if default is not dataclasses.MISSING:
        kwargs["default"] = default

    def converter(value: Any) -> Any:
        return None if value is None and default is None else static_number(name, value, kind)

    return eqx.field(static=True, converter=converter, **kwargs)


def static_number(name: str, value: Any, kind: type) -> Any:
    """The value as a Python `int`, `float` or `bool`, also of a numpy or JAX scalar.

    **Raises:** `ValueError` for a traced value, and for a value of another kind.
    """
    if isinstance(value, Tracer):
        raise ValueError(
            f"{name}: got a traced value, but it is structure: the program that JAX compiles depends on it. Give a "
            "plain Python value, outside of jit, vmap and grad; each value compiles a program of its own"
        )
    if isinstance(value, np.generic | np.ndarray | jax.Array) and np.ndim(value) == 0:
        value = np.asarray(value).item()
    is_bool = isinstance(value, bool)
    good = is_bool if kind is bool else not is_bool and isinstance(value, int if kind is int else int | float)
    if not good or not math.isfinite(value):
        raise ValueError(f"{name} must be {_WORDS[kind]}, got {value!r}")
    return kind(value)
