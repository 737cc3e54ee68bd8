"""The tables of a scene file from a shaft: the way back from `shaft.build`."""

import dataclasses
from typing import TYPE_CHECKING, Any

import equinox as eqx
import numpy as np

from ...bearings.bearing import AbstractBearing
from ...shafts.mounting import LinearBearing, MatchedSet, MountedBearing, Support
from ...shafts.paths import part_at
from ...shafts.scene import ShaftState, ShaftSystem
from ...shafts.shaft import STEEL, Shaft
from ..errors import SceneError
from ..part_writer import Rows, given, number, rows, same, unwritable, written
from .files import LINEAR, OF_SHAFT
from .members import MEMBERS
from .tables import (
    FORCE_TABLES,
    MATRIX_UNITS,
    OPERATIONS,
    MountTable,
    PreloadTable,
    SectionTable,
    SetMountTable,
    ShaftPart,
    ShaftThermalTable,
    SupportTable,
)

if TYPE_CHECKING:
    import numpy.typing as npt


def shaft_tables(scene: ShaftSystem) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    tables: Rows = {"kind": scene.kind, "shaft": _shaft(scene.shaft)}
    tables["housing"] = None if scene.housing is None else {"matrix": _matrix(scene.housing)}
    tables["thermal"] = None if scene.thermal is None else rows(ShaftThermalTable, scene.thermal)
    tables["set"] = [_set(matched) for matched in scene.sets]
    tables["bearing"] = [_mounted(bearing) for bearing in scene.bearings]
    tables["force"] = [
        {"name": force.name, "kind": force.kind} | rows(FORCE_TABLES[force.kind], force) for force in scene.forces
    ]
    tables["state"] = [_state(state, scene) for state in scene.states]
    tables["life"] = _life(scene)
    return {name: table for name, table in tables.items() if table is not None and table != []}


def plain_scene(scene: ShaftSystem) -> ShaftSystem:
    """The scene with loads and speeds of its bearings, which have no effect, set to the values that files give."""
    bearings = tuple(dataclasses.replace(bearing, scene=_standing(bearing.scene)) for bearing in scene.bearings)
    sets = tuple(dataclasses.replace(matched, scene=_standing_set(matched)) for matched in scene.sets)
    return dataclasses.replace(scene, bearings=bearings, sets=sets)


def _standing_set(matched: MatchedSet) -> AbstractBearing | tuple[AbstractBearing, ...]:
    bearings = tuple(_standing(bearing) for bearing in matched.scenes)
    return bearings[0] if all(same(other, bearings[0]) for other in bearings) else bearings


def _standing(scene: object) -> Any:
    if not isinstance(scene, AbstractBearing):
        return scene
    operation = scene.operation
    kept = {name: getattr(operation, name) for name in OF_SHAFT}
    table = OPERATIONS[scene.kind].model_construct(**{name: np.float64(value) for name, value in kept.items()})
    return dataclasses.replace(scene, operation=type(operation)(**table.model_dump(exclude_none=True)), simulation=None)


def _shaft(part: Shaft) -> Rows:
    entries = rows(ShaftPart, part)
    if same(part.material, STEEL):
        del entries["material"]
    if part.sections:
        entries["sections"] = [rows(SectionTable, section) for section in part.sections]
    return entries


def _mounted(mounted: MountedBearing) -> Rows:
    own = {"name": mounted.name} | rows(MountTable, mounted) | given({"support": _support(mounted.support)})
    if isinstance(mounted.scene, LinearBearing):
        return own | {"kind": LINEAR, "stiffness": _matrix(mounted.scene.stiffness)}
    return own | _bearing(mounted.scene, f"bearing.{mounted.name}")


def _set(matched: MatchedSet) -> Rows:
    entries = {"name": matched.name, "picture": matched.picture} | rows(SetMountTable, matched)
    entries |= {
        "distance": _lengths(matched.distance),
        "mismatch": None if matched.mismatch is None else _lengths(matched.mismatch),
    }
    entries["preload"] = None if matched.preload is None else rows(PreloadTable, matched.preload)
    entries["support"] = _support(matched.support)
    scene = _standing_set(matched)
    if not isinstance(scene, tuple):
        return given(entries) | _bearing(scene, f"set.{matched.name}")
    path = f"set.{matched.name}.{MEMBERS}"
    each = [_bearing(bearing, f"{path}.{place + 1}") for place, bearing in enumerate(scene)]
    return given(entries) | {MEMBERS: each}


def _bearing(scene: AbstractBearing, path: str) -> Rows:
    """The tables of a bearing without loads and speeds."""
    from ..reader import tables_of

    try:
        tables = tables_of(_standing(scene))
    except SceneError as error:
        raise error.inside(path) from None
    operation = {name: value for name, value in tables["operation"].items() if name in OF_SHAFT}
    idle = operation.get("outer_speed") is not None and float(np.asarray(scene.operation.outer_speed)) == 0.0
    operation = {name: value for name, value in operation.items() if not (idle and name == "outer_speed")}
    return {name: value for name, value in tables.items() if name != "operation"} | (
        {"operation": operation} if operation else {}
    )


def _support(part: Support | None) -> Rows | None:
    if part is None:
        return None
    entries = rows(SupportTable, part)
    entries.pop("matrix", None)
    return entries if part.matrix is None else entries | {"matrix": _matrix(part.matrix)}


def _matrix(values: "npt.ArrayLike") -> list[list[float | str]]:
    """A stiffness matrix as texts with units, five rows for each bearing; a 0 has no unit."""
    return [
        [0 if entry == 0.0 else number(entry, MATRIX_UNITS[i % 5][j % 5]) for j, entry in enumerate(row)]
        for i, row in enumerate(np.asarray(values, dtype=np.float64))
    ]


def _lengths(value: "npt.ArrayLike") -> float | str | list[float | str]:
    texts = [number(length, "m") for length in np.atleast_1d(np.asarray(value, dtype=np.float64))]
    return texts[0] if np.ndim(value) == 0 else texts


def _life(scene: ShaftSystem) -> Rows | None:
    if scene.life.weibull is None:
        return None
    unrated = [place.name for place in scene.places if getattr(place.scene, "rating", None) is None]
    if unrated:
        path = f"bearing.{unrated[0]}.rating"
        raise unwritable(path, "None", "a Rating, which life.weibull is about: [life] in a file rates all bearings")
    return {"weibull": written(scene.life, "weibull")}


def _state(state: ShaftState, scene: ShaftSystem) -> Rows:
    """The table of a state. **Raises:** `SceneError` for a change that a file cannot hold."""
    changes = {path: _change(path, value, scene) for path, value in state.changes.items()}
    return ({"name": state.name} if state.name else {}) | {"share": written(state, "share")} | changes


def _change(path: str, value: object, scene: ShaftSystem) -> float | str:
    above, _, last = path.rpartition(".")
    part = part_at(scene, above)
    fields = {field.name: field for field in dataclasses.fields(part)} if isinstance(part, eqx.Module) else {}
    metadata = fields[last].metadata if last in fields else {}
    if "bound" not in metadata:
        raise unwritable(f"state.{path}", "a change", "one of a number that files have at this path")
    return number(value, metadata["unit"], metadata["difference"])
