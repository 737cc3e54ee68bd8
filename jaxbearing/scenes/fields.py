"""Finds the valid names of a scene file and their types in the schemas, for messages and `--set`."""

import typing
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel

from .units import Dimension, QuantityValidator


@dataclass(frozen=True)
class Names:
    """Names that are known in a table.

    - `names`: valid names.
    - `not_yet`, `elsewhere`: names of later versions and of other tables -> what is expected instead, in words.
    - `instead`: field -> fields that it excludes.
    - `about`: field -> fields that have a meaning only with it.
    """

    names: tuple[str, ...] = ()
    not_yet: Mapping[str, str] = field(default_factory=dict)
    elsewhere: Mapping[str, str] = field(default_factory=dict)
    instead: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    about: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def is_tag(part: int | str) -> bool:
    """True for a tag "<...>", which marks an alternative of a field (such as a law) in locations of pydantic."""
    return isinstance(part, str) and part.startswith("<")


def path_of(location: Sequence[int | str]) -> str:
    """Dotted path of a location, without the tags of alternatives."""
    return ".".join(str(part) for part in location if not is_tag(part))


def names_at(model: type[BaseModel], location: Sequence[int | str]) -> Names:
    """Valid names of the table at a location of `model`."""
    models = tables_at(model, location)
    names = dict.fromkeys(name for candidate in models for name in candidate.model_fields)
    not_yet: dict[str, str] = {}
    elsewhere: dict[str, str] = {}
    instead: dict[str, tuple[str, ...]] = {}
    about: dict[str, tuple[str, ...]] = {}
    for candidate in models:
        not_yet.update(getattr(candidate, "not_yet", {}))
        elsewhere.update(getattr(candidate, "elsewhere", {}))
        instead.update(getattr(candidate, "instead", {}))
        about.update(getattr(candidate, "about", {}))
    return Names(tuple(names), not_yet, elsewhere, instead, about)


def tables_at(model: type[BaseModel], location: Sequence[int | str]) -> list[type[BaseModel]]:
    """The tables that a location accepts: several if there are alternatives, none if it only accepts values."""
    models = [model]
    for part in location:
        if is_tag(part):
            models = [candidate for candidate in models if getattr(candidate, "tag", None) == part]
        else:
            models = [inner for outer in models for inner in _models_of_field(outer, str(part))]
    return models


def is_known(model: type[BaseModel], path: Sequence[str]) -> bool:
    """True if the schema has a field at this path."""
    return path[-1] in names_at(model, path[:-1]).names


def is_optional(model: type[BaseModel], location: Sequence[int | str]) -> bool:
    """True if the field at a location may be left out of its table."""
    owners = tables_at(model, location[:-1])
    fields = [owner.model_fields[str(location[-1])] for owner in owners if str(location[-1]) in owner.model_fields]
    return bool(fields) and all(not info.is_required() and info.default is None for info in fields)


def type_at(model: type[BaseModel], location: Sequence[int | str]) -> Any:
    """The type of the field at a location with its validators; `None` if there is no such field."""
    for owner in tables_at(model, location[:-1]):
        info = owner.model_fields.get(str(location[-1]))
        if info is not None:
            return typing.Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
    return None


def parts_of(kind: object) -> list[object]:
    """A type without its alternative `None`, followed by its annotations."""
    if typing.get_origin(kind) is typing.Annotated:
        inner, *notes = typing.get_args(kind)
        return [*parts_of(inner), *notes]
    alternatives = [alternative for alternative in typing.get_args(kind) if alternative is not type(None)]
    if alternatives and type(None) in typing.get_args(kind) and len(alternatives) == 1:
        return parts_of(alternatives[0])
    return [kind]


def dimension_of(kind: object) -> Dimension | None:
    """Unit of a field's type; `None` for a number without a unit."""
    dimensions = [note.dimension for note in parts_of(kind) if isinstance(note, QuantityValidator)]
    return dimensions[0] if dimensions else None


def plain_table_at(model: type[BaseModel], name: str) -> Any:
    """The table of a field that accepts a single kind of table; `None` for any other field."""
    models = _models_of_field(model, name)
    return models[0] if len(models) == 1 and not getattr(models[0], "tag", "") else None


def required_names(model: type[BaseModel]) -> tuple[str, ...]:
    """Names of the fields that a table requires, including those that another field can replace."""
    required = tuple(name for name, info in model.model_fields.items() if info.is_required())
    return (*required, *getattr(model, "needs", ()))


def _models_of_field(model: type[BaseModel], name: str) -> list[type[BaseModel]]:
    info = model.model_fields.get(name)
    return [] if info is None else _models_in(info.annotation)


def _models_in(annotation: object) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for inner in typing.get_args(annotation) for model in _models_in(inner)]
