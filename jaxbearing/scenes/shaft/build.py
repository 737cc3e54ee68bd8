"""Builds the scene of a shaft from its valid table. Only Python and numpy numbers enter the constructors: nothing runs
on JAX."""

import dataclasses
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from ...bearings.bearing import AbstractBearing
from ...bearings.rating import Rating
from ...numerics.refusals import Refusals, refuse_all
from ...shafts.forces import FORCES, AbstractForce
from ...shafts.heat import ShaftThermal
from ...shafts.mounting import LinearBearing, MatchedSet, MountedBearing, Preload, Support
from ...shafts.scene import ShaftState, ShaftSystem, SystemLife
from ...shafts.shaft import STEEL, Gravity, Section, Shaft
from ..ball.build import ball_bearing
from ..bearing.build import part
from ..cylindrical.build import cylindrical_roller_bearing
from ..errors import SceneError
from ..materials import material
from ..tapered.build import tapered_roller_bearing
from .files import LINEAR
from .members import MEMBERS
from .schema import ShaftTable
from .tables import SupportTable

_BUILD: dict[str, Callable[[Any], AbstractBearing]] = {
    "ball_bearing": ball_bearing,
    "cylindrical_roller_bearing": cylindrical_roller_bearing,
    "tapered_roller_bearing": tapered_roller_bearing,
}
_PATH = re.compile(r"[a-z_0-9]+(?:\.[a-z_0-9]+)*(?::| must)")


def shaft(table: ShaftTable, states: tuple[ShaftState, ...] = ()) -> ShaftSystem:
    """The scene that a table describes. **Arguments:** `states`: states of its duty cycle.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    housing = None if table.housing is None else np.asarray(table.housing.matrix)
    made: dict[str, Any] = {}
    problems: list[ValueError] = []
    rated = table.life is not None
    parts: dict[str, Callable[[], Any]] = {
        "shaft": lambda: _shaft(table),
        "bearings": lambda: _each(table, "bearing", lambda name, entry: _mounted(name, entry, rated)),
        "sets": lambda: _each(table, "set", lambda name, entry: _set(name, entry, rated)),
        "forces": lambda: _each(table, "force", _force),
        "thermal": lambda: part(ShaftThermal, table.thermal),
        "life": lambda: SystemLife() if table.life is None else SystemLife(weibull=table.life.weibull),
    }
    for name, make in parts.items():
        try:
            made[name] = make()
        except ValueError as error:
            problems.append(error)
    refuse_all(problems)
    return ShaftSystem(**made, housing=housing, states=states)


def _each(table: ShaftTable, word: str, make: Callable[[str, Any], Any]) -> tuple[Any, ...]:
    """The entries of a list, each made by its function. **Raises:** `ValueError` whose texts begin with the names of
    the entries."""
    made, problems = [], []
    for name, entry in table.entries(word).items():
        try:
            made.append(make(name, entry))
        except ValueError as error:
            problems += list(_within(error, word, name))
    refuse_all(problems)
    return tuple(made)


def _within(error: ValueError, word: str, name: str) -> list[ValueError]:
    """The errors of an entry, with its name before each path."""
    if isinstance(error, SceneError):
        return [problem.inside(f"{word}.{name}") for problem in error.problems]
    if isinstance(error, Refusals):
        return [new for refusal in error.refusals for new in _within(refusal, word, name)]
    text = str(error).removeprefix(f"{word}.")
    joint = "." if _PATH.match(text) else ": "
    return [ValueError(f"{word}.{name}{joint}{text}")]


def _shaft(table: ShaftTable) -> Shaft:
    shaft_table = table.shaft
    fields: dict[str, Any] = shaft_table.model_dump(exclude={"sections", "material", "gravity"})
    made = lambda field, default: default if field is None else material(field, thermal=table.thermal is not None)
    sections = [
        Section(**section.model_dump(exclude={"material"}), material=made(section.material, None))
        for section in table.entries("sections").values()
    ]
    return Shaft(
        **fields,
        sections=tuple(sections),
        material=made(shaft_table.material, STEEL),
        gravity=part(Gravity, shaft_table.gravity),
    )


def _mounted(name: str, table: Any, rated: bool) -> MountedBearing:
    if table.kind == LINEAR:
        scene: AbstractBearing | LinearBearing = LinearBearing(np.asarray(table.stiffness))
    else:
        scene = _bearing(table, rated)
    own = {field: getattr(table, field) for field in ("position", "thrust", "closure", "expansion")}
    return MountedBearing(name=name, scene=scene, support=_support(table.support), **own)


def _bearing(table: Any, rated: bool) -> AbstractBearing:
    scene = _BUILD[table.kind](table)
    return dataclasses.replace(scene, rating=Rating()) if rated and scene.rating is None else scene


def _bearings_of_set(table: Any, rated: bool) -> AbstractBearing | tuple[AbstractBearing, ...]:
    """The bearing of a set, or its bearings if they differ. **Raises:** `ValueError` with the errors of all of them."""
    if MEMBERS not in type(table).model_fields:
        return _bearing(table, rated)
    each = getattr(table, MEMBERS)
    made, problems = [], []
    for number in type(each).model_fields:
        try:
            made.append(_bearing(getattr(each, number), rated))
        except ValueError as error:
            problems += _within(error, MEMBERS, number)
    refuse_all(problems)
    return tuple(made)


def _set(name: str, table: Any, rated: bool) -> MatchedSet:
    distance = table.distance[0] if len(table.distance) == 1 else table.distance
    mismatch = table.mismatch
    if mismatch is not None and len(mismatch) == 1:
        mismatch = mismatch * len(table.picture)
    return MatchedSet(
        name=name,
        picture=table.picture,
        scene=_bearings_of_set(table, rated),
        position=table.position,
        distance=distance,
        preload=None if table.preload is None else Preload(**table.preload.model_dump()),
        mismatch=mismatch,
        expansion=table.expansion,
        support=_support(table.support),
    )


def _support(table: SupportTable | None) -> Support | None:
    if table is None:
        return None
    matrix = None if table.matrix is None else np.asarray(table.matrix)
    return Support(**table.model_dump(exclude={"matrix"}), matrix=matrix)


def _force(name: str, table: Any) -> AbstractForce:
    return FORCES[table.kind](name=name, **table.model_dump(exclude={"kind"}))
