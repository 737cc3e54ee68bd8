"""Builds the parts of a scene from the tables that all bearings have."""

import dataclasses
import re
import typing
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any, TypeVar

import jax

from ...bearings.cage import AbstractCage
from ...bearings.ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from ...materials import Material
from ...mounting import Fits, PartTemperatures
from ...numerics.checks import STAND_IN
from ...numerics.refusals import collecting, refusals_of, refuse_all
from ...thermal.settings import Thermal
from ..drafts import Unreadable
from ..laws import TURBULENCE
from ..materials import material
from ..table import Table
from .schema import FitsTable

Cage = TypeVar("Cage", bound=AbstractCage)
Part = TypeVar("Part")


def built(kind: type[Part], **parts: Callable[[], Any]) -> Part:
    """The scene built from its parts, each made by its function. All parts are tried before an error is raised.

    **Raises:** `ValueError` with all errors of the classes; `Unreadable` if a part needs a field that is refused
    already.
    """
    error: ValueError | Unreadable = Unreadable(kind.__name__)
    try:
        made = {name: make() for name, make in parts.items()}
        if all(leaf is not STAND_IN for leaf in jax.tree.leaves(made)):
            return kind(**made)
    except (ValueError, Unreadable) as raised:
        error = raised
    refuse_all(_problems(kind, parts))
    raise error


def _problems(kind: type[Any], parts: Mapping[str, Callable[[], Any]]) -> list[ValueError]:
    """Errors from the checks of the parts and between them, as far as these can be decided."""
    made: dict[str, Any] = {}
    with collecting() as problems:
        for name, make in parts.items():
            before = len(problems)
            with suppress(Unreadable):
                problems += refusals_of(lambda name=name, make=make: made.update({name: make()}))
            if name not in made:
                made[name] = _blank(kind, name)
            _without_refused(made[name], name, problems[before:])
        problems += refusals_of(lambda: kind(**made))
    return problems


class _Blank:
    """Placeholder for a part that could not be made: `isinstance` takes it for its class; it has no attributes."""

    def __init__(self, owner: type):
        self._owner = owner

    @property
    def __class__(self) -> type:  # pyright: ignore[reportIncompatibleMethodOverride]
        return self._owner


def _blank(kind: type, name: str) -> object:
    """Placeholder for the part in a field of a scene."""
    hint = typing.get_type_hints(kind)[name]
    (owner, *_) = [candidate for candidate in (hint, *typing.get_args(hint)) if dataclasses.is_dataclass(candidate)]
    return _Blank(owner)  # pyright: ignore[reportArgumentType]


def _without_refused(part: object, name: str, problems: list[ValueError]) -> None:
    """Puts `STAND_IN` in place of the fields that the checks of a part refuse; `problems` name their paths."""
    for problem in problems:
        match = re.match(rf"{name}\.(\w+)\b(?!\.)", str(problem))
        if match and hasattr(part, match[1]):
            object.__setattr__(part, match[1], STAND_IN)


def part(kind: type[Part], table: Table | None, exclude_none: bool = False) -> Part | None:
    """The part whose attributes are the fields of the table; `None` without a table."""
    return None if table is None else kind(**table.model_dump(exclude_none=exclude_none))


def laws_of(kind: type[Part], model: type[Table], table: Table, **made: Any) -> Part:
    """The laws of the raceways.

    **Arguments:** `model`: class of the table; `made`: fields that are built from the table, such as a law from
    its name. The other fields of the class have the values of the table, or their defaults if the table lacks them.
    """
    names = {field.name for field in dataclasses.fields(kind)} & model.model_fields.keys()  # pyright: ignore[reportArgumentType]
    return kind(**made, **{name: getattr(table, name) for name in names - made.keys()})


def seats(table: Any) -> dict[str, Callable[[], Any]]:
    """The parts `fits`, `temperatures` and `thermal` of a bearing, as `built` takes them."""
    return {
        "fits": lambda: None if table.fits is None else _fits(table.fits),
        "temperatures": lambda: part(PartTemperatures, table.temperatures),
        "thermal": lambda: part(Thermal, table.thermal, exclude_none=True),
    }


def shapes(table: Any) -> dict[str, Callable[[], Any]]:
    """The parts that describe flexible rings and out-of-round raceways, as `built` takes them."""
    return {
        "outer_ring": lambda: part(FlexibleRing, table.outer_ring),
        "inner_ring": lambda: part(FlexibleInnerRing, table.inner_ring),
        "inner_roundness": lambda: part(InnerRoundness, table.inner_roundness),
        "outer_roundness": lambda: part(OuterRoundness, table.outer_roundness),
    }


def _fits(table: FitsTable) -> Fits:
    names = ("shaft_material", "housing_material")
    of = {name: getattr(table, name) for name in names}
    materials: dict[str, Any] = {name: material(field, thermal=True) for name, field in of.items() if field is not None}
    return Fits(**table.model_dump(exclude=set(names)), **materials)


def solids(table: Any, *names: str) -> dict[str, Material]:
    """The given materials of these fields, with thermal properties if the parts have temperatures."""
    try:
        thermal = table.temperatures is not None or table.thermal is not None
    except Unreadable:
        thermal = True
    fields = {name: getattr(table.materials, name) for name in names}
    return {name: material(field, thermal=thermal) for name, field in fields.items() if field is not None}


def cage(kind: type[Cage], table: Any) -> Cage | None:
    """The cage that a table describes; `None` without a table."""
    return None if table is None else kind(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
