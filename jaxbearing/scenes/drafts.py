"""Drafts: tables with errors, of which the valid fields can be used, so that one pass finds all errors of a file."""

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
    """Raised when code reads a field of a draft that is refused already."""


class Draft:
    """Replaces a table with errors: its valid fields read as those of the table.

    Reading a refused field raises `Unreadable`, so that checks that depend on it are skipped. So does reading an absent
    field if the file has an unknown name that may be meant for it. An inner table with errors is a draft itself if
    `nested` (for checks), otherwise `PartFields` (for building parts).
    """

    def __init__(self, model: type[Table], raw: Mapping[str, Any], refused: Collection[str] = (), nested: bool = False):
        self._model, self._raw, self._nested = model, raw, nested
        absent = [name for name in model.model_fields if name not in raw]
        near = [_meant_field(str(name), model, absent) for name in raw if name not in model.model_fields]
        self._refused = {*refused, *(absent if "" in near else near)}

    def __getattr__(self, name: str) -> Any:
        info = self._model.model_fields.get(name)
        if info is None:
            attribute = inspect.getattr_static(self._model, name)
            return attribute.__get__(self, self._model) if inspect.isfunction(attribute) else getattr(self._model, name)
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
        """Dotted path and wording of each problem that the checks of this table and of its inner tables find."""
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


def _meant_field(name: str, model: type[Table], absent: Collection[str]) -> str:
    """The field that an unknown name may be meant for: the inner table that has a field of this name, or the nearest
    absent field; "" if there is none."""
    tables = ((field, plain_table_at(model, field)) for field in model.model_fields)
    inside = next((field for field, table in tables if table is not None and name in table.model_fields), None)
    return nearest(name, absent) if inside is None else inside


@functools.cache
def _reader(model: type[Table], name: str) -> TypeAdapter[Any]:
    return TypeAdapter(type_at(model, [name]))


class PartFields:
    """Replaces a table with errors in the building of a part whose attributes are its fields. `STAND_IN` replaces a
    refused number, so that the checks of the class that do not need this number still run.
    """

    def __init__(self, model: type[Table], fields: Draft):
        self._model, self._fields = model, fields

    def __getattr__(self, name: str) -> Any:
        raise Unreadable(name)

    def model_dump(
        self, include: Collection[str] | None = None, exclude: Collection[str] = (), exclude_none: bool = False
    ) -> dict[str, Any]:
        """The fields as of a table. **Raises:** `Unreadable` if a field of another type than a number is refused."""
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
    """The table of a file, validated. **Raises:** `SceneError` with all its errors."""
    table, problems = draft(model, raw, file)
    if problems:
        raise SceneError.of_all(problems)
    return table


def draft(
    model: type[Any], raw: Mapping[str, object], file: str, refused: Collection[str] = ()
) -> tuple[Any, list[SceneError]]:
    """The table of a file, or a draft of it with all problems that its fields and checks find.

    **Arguments:** `refused`: names in the table that are refused and reported already.
    """
    problems: list[SceneError] = []
    try:
        table = model.model_validate(raw)
        if not refused:
            return table, []
    except ValidationError as error:
        errors = from_validation(error, model, file, raw).problems
        problems = [problem for problem in errors if problem.path.partition(".")[0] not in refused]
    reported = {(problem.path, problem.expected) for problem in problems}
    for path, words in Draft(model, raw, refused, nested=True).problems():
        if (path, words["expected"]) not in reported:
            reported.add((path, words["expected"]))
            problems.append(in_words(file, path, words))
    return Draft(model, raw, refused), problems
