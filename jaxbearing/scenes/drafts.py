"""A table of a file as far as it is sound: so that one look at a file finds everything that is wrong with it."""

import functools
import inspect
import typing
from collections.abc import Collection, Iterator, Mapping
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from ..numerics.checks import STAND_IN
from .errors import SceneError, nearest
from .fields import plain_table_at, type_at
from .problems import from_validation, in_words
from .table import Table

AnyTable = TypeVar("AnyTable", bound=Table)


class Unreadable(Exception):
    """A field of a draft was asked for that is refused already."""


class Draft:
    """Stands for a table that is refused somewhere: gives the fields that are sound as the table would.

    A field that is refused raises `Unreadable`, so that what depends on it is left undecided. So does a field that the
    file does not have while it has an unknown name that may be meant for it. A table inside that is refused somewhere
    is a draft itself if `nested` (for checks), otherwise `PartFields` (for building parts).
    """

    def __init__(self, model: type[Table], raw: Mapping[str, Any], refused: Collection[str] = (), nested: bool = False):
        self._model, self._raw, self._nested = model, raw, nested
        absent = [name for name in model.model_fields if name not in raw]
        near = [_meant(str(name), model, absent) for name in raw if name not in model.model_fields]
        self._refused = {*refused, *(absent if "" in near else near)}

    def __getattr__(self, name: str) -> Any:
        info = self._model.model_fields.get(name)
        if info is None:
            found = inspect.getattr_static(self._model, name)
            return found.__get__(self, self._model) if inspect.isfunction(found) else getattr(self._model, name)
        if name in self._refused or (name not in self._raw and info.is_required()):
            raise Unreadable(name)
        if name not in self._raw:
            return info.get_default(call_default_factory=True)
        try:
            return _reader(self._model, name).validate_python(self._raw[name], strict=True)
        except ValidationError:
            inner = plain_table_at(self._model, name)
            if inner is None or not isinstance(self._raw[name], Mapping):
                raise Unreadable(name) from None
            inside = Draft(inner, self._raw[name], nested=True)
            if self._nested:
                return inside
            if any(inside.problems()):
                # the classes repeat some checks of the tables
                raise Unreadable(name) from None
            return PartFields(inner, inside)

    def problems(self, inside: str = "") -> Iterator[tuple[str, Mapping[str, str]]]:
        """Dotted path, and the words, of what the checks of this table and of those in it find."""
        for method in self._model.checks():
            try:
                for problem in method(self):
                    context = problem.context or {}
                    yield inside + context["field"], context
            except Unreadable:
                continue
        for name in self._model.model_fields:
            try:
                value = getattr(self, name)
            except Unreadable:
                continue
            if isinstance(value, Draft):
                yield from value.problems(f"{inside}{name}.")


def _meant(name: str, model: type[Table], absent: Collection[str]) -> str:
    """The field that an unknown name may be meant for: a table that has a field of this name, or the nearest absent
    name; "" where there is none."""
    tables = ((field, plain_table_at(model, field)) for field in model.model_fields)
    inside = next((field for field, table in tables if table is not None and name in table.model_fields), None)
    return nearest(name, absent) if inside is None else inside


@functools.cache
def _reader(model: type[Table], name: str) -> TypeAdapter[Any]:
    return TypeAdapter(type_at(model, [name]))


class PartFields:
    """Stands for a table that is refused somewhere, for a part whose attributes are its fields: `STAND_IN` is in the
    place of a number that is refused, so that the rules of the class that do not need it are checked all the same.
    """

    def __init__(self, model: type[Table], fields: Draft):
        self._model, self._fields = model, fields

    def __getattr__(self, name: str) -> Any:
        raise Unreadable(name)

    def model_dump(
        self, include: Collection[str] | None = None, exclude: Collection[str] = (), exclude_none: bool = False
    ) -> dict[str, Any]:
        """The fields as those of a table. **Raises:** `Unreadable` where something else than a number is refused."""
        fields: dict[str, Any] = {}
        for name, info in self._model.model_fields.items():
            if name in exclude or (include is not None and name not in include):
                continue
            try:
                fields[name] = getattr(self._fields, name)
            except Unreadable:
                if float not in (info.annotation, *typing.get_args(info.annotation)):
                    raise
                fields[name] = STAND_IN
        return {name: value for name, value in fields.items() if value is not None or not exclude_none}


def read_table(model: type[AnyTable], raw: Mapping[str, object], file: str) -> AnyTable:
    """The table of a file, validated. **Raises:** `SceneError` with all that is wrong with it."""
    table, problems = draft(model, raw, file)
    if problems:
        raise SceneError.of_all(problems)
    return table


def draft(
    model: type[Any], raw: Mapping[str, object], file: str, refused: Collection[str] = ()
) -> tuple[Any, list[SceneError]]:
    """The table of a file, or a draft of it with everything that its fields and checks refuse.

    **Arguments:** `refused`: names in the table that are refused already, and said to be.
    """
    problems: list[SceneError] = []
    try:
        table = model.model_validate(raw)
        if not refused:
            return table, []
    except ValidationError as error:
        found = from_validation(error, model, file, raw).problems
        problems = [one for one in found if one.path.partition(".")[0] not in refused]
    said = {(one.path, one.expected) for one in problems}
    for path, words in Draft(model, raw, refused, nested=True).problems():
        if (path, words["expected"]) not in said:
            said.add((path, words["expected"]))
            problems.append(in_words(file, path, words))
    return Draft(model, raw, refused), problems
