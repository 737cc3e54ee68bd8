"""Fields that determine the structure of a compiled program: static Python numbers, truth values and words.

They are never traced; another value compiles another program.
"""

import dataclasses
import inspect
import math
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from .arguments import did_you_mean, require_choice
from .ranges import RANGES

Kind = TypeVar("Kind", int, float, bool)
_WORDS = {int: "a whole number", float: "one finite number", bool: "True or False"}


class Hinting(eqx.Module):
    """Base of modules whose error for an unknown argument suggests the nearest one."""

    def __new__(cls, *_: object, **arguments: object):
        fields = getattr(cls, "__dataclass_fields__", {})
        for name in arguments.keys() - fields:
            # a constructor of its own may have other arguments
            known = inspect.signature(cls.__init__).parameters
            if name not in known and not any(parameter.kind is parameter.VAR_KEYWORD for parameter in known.values()):
                raise TypeError(f"{cls.__name__} has no argument {name!r}{did_you_mean(name, list(known)[1:])}")
        return super().__new__(cls)


def count(
    name: str,
    default: object = dataclasses.MISSING,
    *,
    least: int | None = None,
    most: int | None = None,
    **kwargs: Any,
) -> Any:
    """Static field that holds a whole number from `least` to `most`. Without `least` it is at least 0 if `most` is
    given; without both it may be negative. Messages call the field `name`. `None` passes if it is the default."""

    def read(value: object) -> int:
        number = static_count(name, value, least if most is None else None)
        if most is not None and not (least or 0) <= number <= most:
            raise ValueError(f"{name} must be from {least or 0} to {most}, got {number}")
        return number

    return _field(read, default, kwargs, {"count": (least, most)})


def constant(
    name: str,
    default: object = dataclasses.MISSING,
    *,
    bound: str = "finite",
    among: Iterable[float] | None = None,
    **kwargs: Any,
) -> Any:
    """Static field that holds one finite number without a unit, within `bound` (a key of `ranges.RANGES`). If `among`
    is given, it is also one of these numbers. Messages call the field `name`. `None` passes if it is the default."""
    numbers = None if among is None else tuple(among)

    def read(value: object) -> float:
        number = static_number(name, value, float)
        if not RANGES[bound].holds(number):
            raise ValueError(f"{name} must be {bound}, got {number:g}")
        if numbers is not None and number not in numbers:
            raise ValueError(f"{name} must be one of {numbers}, got {number!r}")
        return number

    return _field(read, default, kwargs, {"constant": bound, "among": numbers})


def switch(name: str, default: object = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Static field that holds `True` or `False`. Messages call it `name`. `None` passes if it is the default."""
    return _field(lambda value: static_number(name, value, bool), default, kwargs, {"switch": True})


def choice(
    name: str,
    choices: Iterable[str],
    default: object = dataclasses.MISSING,
    *,
    also: Callable[[Any], Any] | None = None,
    also_words: str = "",
    **kwargs: Any,
) -> Any:
    """Static field that holds one of the words `choices`. Messages call it `name`. `None` passes as the default.

    **Arguments:** `also`: function that returns the choice if a value is another name of it, else the value itself;
    `also_words`: these further names in words, for messages.
    """
    words = tuple(choices)

    def read(value: object) -> str:
        value = _untraced(name, value)
        value = value if also is None else also(value)
        require_choice(name, value, words)
        return str(value)

    return _field(
        read, default, kwargs, {"choices": words} | ({} if also is None else {"also": also, "also_words": also_words})
    )


def _field(read: Callable[[Any], Any], default: object, kwargs: dict[str, Any], facts: dict[str, Any]) -> Any:
    """A static field with a converter.

    **Arguments:**
    - `read`: converts a given value to the stored one, or raises `ValueError`.
    - `facts`: metadata, from which `scenes.table_of` makes the field's schema in scene files.
    """
    if default is not dataclasses.MISSING:
        kwargs["default"] = default

    def converter(value: object) -> Any:
        return None if value is None and default is None else read(value)

    metadata = {**facts, **kwargs.pop("metadata", {})}
    return eqx.field(static=True, converter=converter, metadata=metadata, **kwargs)


def static_count(name: str, value: object, least: int | None = None) -> int:
    """The value as a Python `int`. **Raises:** `ValueError` as `static_number` does, and for a value below `least`."""
    number = static_number(name, value, int)
    if least is not None and number < least:
        raise ValueError(f"{name} must be >= {least}, got {number}")
    return number


def static_number(name: str, value: Any, kind: type[Kind]) -> Kind:
    """The value, or that of a numpy or JAX scalar, as Python's `kind`: `int`, `float` or `bool`.

    **Raises:** `ValueError` for a traced value, a value of another kind and a number that is not finite.
    """
    value = _untraced(name, value)
    is_bool = isinstance(value, bool)
    good = is_bool if kind is bool else not is_bool and isinstance(value, int if kind is int else int | float)
    if not good or not math.isfinite(value):
        raise ValueError(f"{name} must be {_WORDS[kind]}, got {value!r}")
    return kind(value)


def _untraced(name: str, value: object) -> Any:
    """A numpy or JAX scalar as a Python value; other values unchanged. **Raises:** `ValueError` for a traced value."""
    if isinstance(value, Tracer):
        raise ValueError(
            f"{name}: got a traced value, but it is structure: the program that JAX compiles depends on it. Give a "
            "plain Python value, outside of jit, vmap and grad; each value compiles a program of its own"
        )
    return plain(value)


def plain(value: object) -> Any:
    """A numpy or JAX scalar as a Python value; other values, traced ones included, unchanged."""
    if isinstance(value, np.generic | np.ndarray | jax.Array) and not isinstance(value, Tracer) and value.ndim == 0:
        return np.asarray(value).item()
    return value
