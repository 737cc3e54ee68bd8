"""Describes what a program is made from, in words that are the same in every process."""

import dataclasses
import enum
import functools
import operator
import sys
import types
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import equinox as eqx
import jax

Structure: TypeAlias = Any
"""A `PyTreeDef` of JAX, for which type checkers have no type."""
ROOT = Path(__file__).parents[2]
"""Folder of the packages."""
OWN = ("jaxbearing", "fitting")
_KNOWN = (*OWN, "equinox", "jax", "jaxlib", "numpy", "builtins")
"""Packages whose code is part of the key of a kept program, by their versions or their files."""


class NotKept(Exception):
    """A program depends on code that is not known here, such as a law of the user's own."""


def description(structure: Structure) -> str:
    """Describes the structure of a pytree, with all that is static in it.

    **Raises:** `NotKept` where a class or a function is from elsewhere, or has no name that another process knows.
    """
    return "".join(_structure(structure))


def _structure(structure: Structure) -> Iterator[str]:
    node = structure.node_data()
    if node is None:
        # a leaf, or nothing at all
        yield "*" if structure.num_leaves else "-"
        return
    kind, static = node
    yield f"{_named(kind)}({static_description(static)}"
    for child in structure.children():
        yield ","
        yield from _structure(child)
    yield ")"


def static_description(value: object) -> str:
    """Describes a value that is no array. **Raises:** as `description`."""
    if isinstance(value, enum.Enum):  # some are numbers besides
        return f"{_named(type(value))}.{value.name}"
    if value is None or isinstance(value, bool | int | float | complex | str | bytes):
        # repr of a float is exact; a subclass is told from its base
        return f"{type(value).__name__}:{value!r}" if type(value).__module__ == "builtins" else _described(value)
    if isinstance(value, type | types.FunctionType | types.BuiltinFunctionType):
        return _named(value)
    if isinstance(value, Mapping):
        entries = (f"{static_description(key)}:{static_description(entry)}" for key, entry in value.items())
        return f"{_named(type(value))}{{{','.join(entries)}}}"
    if isinstance(value, tuple | list | frozenset | set):
        parts = [static_description(entry) for entry in value]
        parts = sorted(parts) if isinstance(value, frozenset | set) else parts
        return f"{_named(type(value))}[{','.join(parts)}]"
    return _described(value)


def _described(value: object) -> str:
    if isinstance(value, eqx.Module):
        leaves, structure = jax.tree.flatten(value)
        return f"{description(structure)}<{','.join(static_description(leaf) for leaf in leaves)}>"
    if dataclasses.is_dataclass(value):
        fields = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return f"{_named(type(value))}({static_description(fields)})"
    if isinstance(value, str) and not getattr(value, "__dict__", None):
        # a text that its class puts in a group, as a warning
        return f"{_named(type(value))}:{str(value)!r}"
    # one of a kind: equinox' mark of a field that is not there
    if type(value).__module__.split(".")[0] == "equinox":
        return _named(type(value))
    raise NotKept(f"{value!r} of {type(value)}")


def _named(thing: object) -> str:
    module, name = getattr(thing, "__module__", None) or "", getattr(thing, "__qualname__", "")
    if module.split(".")[0] not in _KNOWN or "<" in name or not name:
        raise NotKept(f"{module}.{name}")
    if module.split(".")[0] in OWN and not _is_of_these_files(thing, module, name):
        raise NotKept(f"another {module}.{name}")
    return f"{module}.{name}"


def _is_of_these_files(thing: object, module: str, name: str) -> bool:
    """True if the name leads to this very thing in a file of this project: a user's `fitting.py` may hide the package,
    and a wrapper bears the name of what it wraps."""
    origin = sys.modules.get(module)
    if origin is None or not _below_root(getattr(origin, "__file__", None)):
        return False
    try:
        return operator.attrgetter(name)(origin) is thing
    except AttributeError:
        return False


@functools.cache
def _below_root(file: str | None) -> bool:
    return file is not None and any(Path(file).is_relative_to(ROOT / package) for package in OWN)
