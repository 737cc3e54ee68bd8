"""Lists the fields of a kind of scene file from the schemas: unit, accepted values, default and description."""

import dataclasses
import types
import typing
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, TypeAdapter, ValidationError

from .fields import tables_at
from .inputs import described_argument
from .reader import schema_of_kind
from .table import Table
from .units import Dimension, QuantityValidator

_PLAIN = {"string_type": "text", "bool_type": "true or false", "float_type": "a number", "dict_type": "a table"}


@dataclasses.dataclass(frozen=True)
class Field:
    """One field of a table of a scene file.

    **Arguments:**
    - `unit`: SI unit, or "".
    - `expected`: accepted values, in words.
    - `tables`: schemas of the accepted tables.
    - `default`: "required", a value, or "optional" (without the field its subject is not modelled, or it is computed or
      assumed).
    """

    name: str
    unit: str
    expected: str
    tables: tuple[type[BaseModel], ...]
    default: str
    description: str


def fields(model: type[BaseModel], owner: type | None) -> Iterator[Field]:
    """The fields of a table; the descriptions come from `owner`, the class that the table builds."""
    for name, info in model.model_fields.items():
        if name in ("sources", "note", "ranges", "law"):
            continue
        annotation = typing.Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
        dimension = _dimension(annotation)
        unit = dimension.si if dimension else ""
        if info.is_required():
            default = "required"
        elif info.default is None:
            default = "optional"
        else:
            default = f"{str(info.default).lower() if isinstance(info.default, bool) else info.default} {unit}".strip()
        words = name.replace("_", " ")
        source, own = model.made_from.get(name, (owner, name)) if issubclass(model, Table) else (owner, name)
        description = _described(owner, name) or _described(source, own)
        # the table describes fields that no class has and fields that their class does not describe
        description = description if description and description != words else described_argument(model, name)
        expected, tables = _expected(model, name, annotation, unit)
        text = " ".join((description.removeprefix(f"{words}: ") or words).split())
        yield Field(name, unit, expected, tables, default, text)


def _described(owner: type | None, name: str) -> str:
    """Description of an argument by its class, without the name."""
    text = described_argument(owner, name) if owner is not None else ""
    return text.removeprefix(f"{name.replace('_', ' ')}: ")


def _dimension(annotation: object) -> Dimension | None:
    """The dimension of a type, or of one of its alternatives."""
    for part in typing.get_args(annotation):
        dimension = part.dimension if isinstance(part, QuantityValidator) else _dimension(part)
        if dimension is not None:
            return dimension
    return None


def _expected(model: type[BaseModel], name: str, annotation: Any, unit: str) -> tuple[str, tuple[type[BaseModel], ...]]:
    """Accepted values of a field, in the words of its error message, and the tables that it accepts."""
    tables = tuple(table for table in tables_at(model, (name,)) if not table.__name__.startswith("Unknown"))
    reader = TypeAdapter(annotation)
    # first a number below the range, then an object that no field accepts
    for probe in (f"-1 {unit}" if unit else -1, object()):
        try:
            reader.validate_python(probe)
        except ValidationError as error:
            texts = [
                detail.get("ctx", {}).get("expected") or _PLAIN.get(detail["type"], "") for detail in error.errors()
            ]
            words = dict.fromkeys(
                " ".join(text.split()) for text in texts if text and "a table with a 'law'" not in text
            )
            return " or ".join(words), tables
    raise ValueError(f"{model.__name__}.{name} takes anything")


def tables_of_kind(kind: str) -> Iterator[tuple[str, type[BaseModel], type | None]]:
    """Dotted path, schema and class of every table of a kind of scene, outer tables before inner ones. Alternatives
    at the same path are listed one after the other."""
    model, scene = schema_of_kind(kind)
    yield from _inside(model, scene, "")


def _inside(
    model: type[BaseModel], owner: type | None, above: str
) -> Iterator[tuple[str, type[BaseModel], type | None]]:
    for name in model.model_fields:
        for table in tables_at(model, (name,)):
            if table.__name__.startswith("Unknown"):
                continue
            built, path = class_of(owner, name, table), f"{above}{name}"
            yield path, table, built
            yield from _inside(table, built, f"{path}.")


def class_of(owner: type | None, name: str, table: type[BaseModel]) -> type | None:
    """The class of the objects in a field of `owner`; if it is not known, the class that the table builds."""
    hint = typing.get_type_hints(owner).get(name) if owner is not None else None
    classes = [kind for kind in _classes(hint) if dataclasses.is_dataclass(kind)]
    return classes[0] if classes else class_of_table(table)


def class_of_table(table: type[BaseModel]) -> type | None:
    """The class that a table builds."""
    return table.builds if issubclass(table, Table) else None


def _classes(hint: object) -> list[type]:
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return [kind for part in typing.get_args(hint) for kind in _classes(part)]
    return [hint] if isinstance(hint, type) else []
