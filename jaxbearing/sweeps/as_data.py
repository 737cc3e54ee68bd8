"""Scenes and plans as data: a JSON text and arrays. Reading the data creates objects of this package and runs no code
from the file.

An object is written as the name of its class, such as `jaxbearing.bearings.ball.scene:BallBearing`, and its fields.
Only classes of this package can be named: those already imported, and those of the packages of scenes, whose modules
contain only definitions. Constructors are not called, nothing else is imported for a file, and arrays are read without
pickles.
"""

import dataclasses
import functools
import importlib
import json
import re
import sys
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import equinox as eqx
import numpy as np

_PACKAGE = __name__.partition(".")[0]
_OF_SCENES = ("bearings", "contacts", "ehl", "gaps", "lubricants", "machines", "materials", "shafts", "time_laws")
"""Packages and modules with the classes of scenes; they are imported when needed."""
_NAME = re.compile(r"\w+(?:\.\w+)*", re.ASCII)


class ForeignPartError(TypeError):
    """Error for an object of a class outside this package, such as a user's own law: it cannot be written as data."""


def encoded(part: object) -> tuple[str, dict[str, np.ndarray]]:
    """An object as a JSON text and named arrays, from which `decoded` restores it.

    **Raises:** `ForeignPartError`.
    """
    arrays: dict[str, np.ndarray] = {}
    return json.dumps(_encode(part, arrays)), arrays


def decoded(text: str, arrays: Mapping[str, np.ndarray]) -> Any:
    """The object that `encoded` wrote. **Raises:** `ValueError` for other data."""
    try:
        return _decode(json.loads(text), arrays)
    except (KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"not the data of a part: {type(error).__name__}: {error}") from None


def _encode(part: object, arrays: dict[str, np.ndarray]) -> object:
    if part is None or type(part) in (bool, int, float, str):
        return part
    if isinstance(part, np.ndarray | np.generic) or hasattr(part, "__jax_array__") or eqx.is_array(part):
        values = np.asarray(part)
        if values.dtype.kind not in "biuf":
            raise ForeignPartError(f"an array of {values.dtype}")
        name = f"array_{len(arrays)}"
        arrays[name] = values
        return {"array": name}
    each = lambda values: [_encode(value, arrays) for value in values]
    if type(part) in (list, tuple):
        return {type(part).__name__: each(part)}
    if type(part) is dict and all(type(key) is str for key in part):
        return {"dict": {key: _encode(value, arrays) for key, value in part.items()}}
    kind = type(part)
    name = f"{kind.__module__}:{kind.__qualname__}"
    if _kind(name) is not kind:
        raise ForeignPartError(f"a {kind.__module__}.{kind.__qualname__}")
    values = {field: _encode(getattr(part, field), arrays) for field in _fields(kind)}
    return {"class": name, "fields": values}


def _decode(data: object, arrays: Mapping[str, np.ndarray]) -> object:
    if not isinstance(data, dict):
        if isinstance(data, list):
            raise ValueError("not the data of a part: a list without its kind")
        return data
    if set(data) == {"array"}:
        return arrays[data["array"]]
    if set(data) == {"list"}:
        return [_decode(value, arrays) for value in data["list"]]
    if set(data) == {"tuple"}:
        return tuple(_decode(value, arrays) for value in data["tuple"])
    if set(data) == {"dict"}:
        return {key: _decode(value, arrays) for key, value in data["dict"].items()}
    if set(data) != {"class", "fields"}:
        raise ValueError(f"not the data of a part: {', '.join(sorted(data))[:80]}")
    kind, fields = _kind(data["class"]), data["fields"]
    if kind is None:
        raise ValueError(f"no class of this package: {data['class']!r}"[:160])
    if set(fields) != set(_fields(kind)):
        raise ValueError(f"{data['class']} of another version: its fields differ")
    values = {field: _decode(fields[field], arrays) for field in _fields(kind)}
    if issubclass(kind, tuple):
        return tuple.__new__(kind, values.values())
    made = object.__new__(kind)
    for field, value in values.items():
        object.__setattr__(made, field, value)
    return made


@functools.cache
def _fields(kind: type) -> tuple[str, ...]:
    if issubclass(kind, tuple):
        return getattr(kind, "_fields")  # noqa: B009  (of a named tuple, which has no class of its own)
    return tuple(field.name for field in dataclasses.fields(kind))


def _kind(name: str) -> type | None:
    """The class of this package with this name; `None` unless it is a named tuple, frozen dataclass or module of
    Equinox, whose fields are its whole content."""
    module, _, path = name.partition(":")
    if module.partition(".")[0] != _PACKAGE or not path:
        return None
    if (
        module not in sys.modules
        and _NAME.fullmatch(module)
        and module.partition(".")[2].partition(".")[0] in _OF_SCENES
    ):
        with suppress(ImportError):
            importlib.import_module(module)
    kind: Any = sys.modules.get(module)
    for part in path.split("."):
        kind = None if kind is None else vars(kind).get(part)
    if not isinstance(kind, type) or kind.__module__ != module:
        return None
    named_tuple = issubclass(kind, tuple) and hasattr(kind, "_fields")
    parameters = vars(kind).get("__dataclass_params__")
    fields_alone = parameters is not None and (issubclass(kind, eqx.Module) or parameters.frozen)
    return kind if named_tuple or fields_alone else None
