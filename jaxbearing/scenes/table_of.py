"""Makes tables of scene files from the classes that they build, so that a field is defined only once, in its class.

The class defines SI unit and bound of a field (`numerics.checks.bounded`), or its choices, count or switch
(`numerics.structure`), its default and its description. The table defines only the properties of files: names of laws
and materials, fields that exclude each other, and fields that may be left out.
"""

import dataclasses
import types
import typing
from collections.abc import Collection, Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, create_model

from . import units
from .table import Table


def table_of(
    *classes: type, leave_out: Collection[str] = (), optional: Collection[str] = (), base: type[Table] = Table
) -> Any:
    """A table with the fields of classes. A subclass adds the rules of files, and the fields that hold a part or a law.

    **Arguments:**
    - `classes`: classes with the fields; the first is the class that the table builds.
    - `leave_out`: fields that files do not have.
    - `optional`: fields that are `None` if a file leaves them out, although their class has no default or another one.
    - `base`: table with further fields and checks.

    **Returns:** a `type[Table]`, annotated as `Any` because type checkers cannot know its fields.
    """
    fields: dict[str, Any] = {}
    made_from: dict[str, tuple[type, str]] = {}
    for name, owner, field in _fields(classes):
        if name in leave_out or name in fields:
            continue
        kind = type_of(field)
        if kind is None:
            continue
        default = None if name in optional else field.default
        fields[name] = (kind | None if default is None else kind, ... if default is dataclasses.MISSING else default)
        made_from[name] = (owner, field.name)
    unknown = {*leave_out, *optional} - {name for name, _, _ in _fields(classes)}
    assert not unknown, unknown
    made: Any = create_model(f"{classes[0].__name__}Fields", __base__=base, __module__=__name__, **fields)
    made.builds, made.made_from = classes[0], types.MappingProxyType(made_from)
    return made


def type_of(field: Any) -> Any:
    """The type that reads a field of a class from a file; `None` for a field that does not hold numbers, a word or a
    truth value."""
    metadata: Mapping[str, Any] = field.metadata
    if "bound" in metadata:
        return Annotated[float, units.number_note(metadata["bound"], metadata["unit"], metadata["difference"])]
    if "each" in metadata:
        return Annotated[tuple[float, ...], units.several_note(metadata["each"], metadata["unit"])]
    if "choices" in metadata:
        words: Any = Literal[metadata["choices"]]
        return (
            Annotated[words, BeforeValidator(metadata["also"]), metadata["also_words"]] if "also" in metadata else words
        )
    if "count" in metadata:
        return Annotated[int, units.count_note(*metadata["count"])]
    if "switch" in metadata:
        return units.Switch
    if "constant" in metadata:
        among, bound = metadata["among"], metadata["constant"]
        return Annotated[float, units.number_note(bound) if among is None else units.among_note(among)]
    return None


def number_of(owner: type, name: str) -> Any:
    """The type that reads the field `name` of a class from a file."""
    return type_of(next(field for field in dataclasses.fields(owner) if field.name == name))


def fields_of_class(owner: type) -> Iterator[str]:
    """Names in files of the fields of a class that its table has."""
    yield from (name for name, _, field in _fields((owner,)) if type_of(field) is not None)


def _fields(classes: typing.Iterable[type]) -> Iterator[tuple[str, type, Any]]:
    """Name in files, class and field, of all fields."""
    for owner in classes:
        for field in dataclasses.fields(owner):
            yield field.metadata.get("name") or field.name, owner, field
