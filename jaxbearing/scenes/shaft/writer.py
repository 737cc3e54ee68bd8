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
    tables["set"] = [_set(one) for one in scene.sets]
    tables["bearing"] = [_mounted(one) for one in scene.bearings]
    tables["force"] = [{"name": one.name, "kind": one.kind} | rows(FORCE_TABLES[one.kind], one) for one in scene.forces]
    tables["state"] = [_state(one, scene) for one in scene.states]
    tables["life"] = _life(scene)
    return {name: table for name, table in tables.items() if table is not None and table != []}


def plain_scene(scene: ShaftSystem) -> ShaftSystem:
    """The scene with loads and speeds of its bearings, which have no effect, set to the values that files give."""
    bearings = tuple(dataclasses.replace(one, scene=_standing(one.scene)) for one in scene.bearings)
    sets = tuple(dataclasses.replace(one, scene=_standing_set(one)) for one in scene.sets)
    return dataclasses.replace(scene, bearings=bearings, sets=sets)


def _standing_set(one: MatchedSet) -> AbstractBearing | tuple[AbstractBearing, ...]:
    found = tuple(_standing(bearing) for bearing in one.scenes)
    return found[0] if all(same(other, found[0]) for other in found) else found


def _standing(scene: object) -> Any:
    if not isinstance(scene, AbstractBearing):
        return scene
    operation = scene.operation
    kept = {name: getattr(operation, name) for name in OF_SHAFT}
    table = OPERATIONS[scene.kind].model_construct(**{name: np.float64(value) for name, value in kept.items()})
    return dataclasses.replace(scene, operation=type(operation)(**table.model_dump(exclude_none=True)), simulation=None)


def _shaft(part: Shaft) -> Rows:
    found = rows(ShaftPart, part)
    if same(part.material, STEEL):
        del found["material"]
    if part.sections:
        found["sections"] = [rows(SectionTable, one) for one in part.sections]
    return found


def _mounted(one: MountedBearing) -> Rows:
    own = {"name": one.name} | rows(MountTable, one) | given({"support": _support(one.support)})
    if isinstance(one.scene, LinearBearing):
        return own | {"kind": LINEAR, "stiffness": _matrix(one.scene.stiffness)}
    return own | _bearing(one.scene, f"bearing.{one.name}")


def _set(one: MatchedSet) -> Rows:
    found = {"name": one.name, "picture": one.picture} | rows(SetMountTable, one)
    found |= {"distance": _lengths(one.distance), "mismatch": None if one.mismatch is None else _lengths(one.mismatch)}
    found["preload"] = None if one.preload is None else rows(PreloadTable, one.preload)
    found["support"] = _support(one.support)
    scene = _standing_set(one)
    if not isinstance(scene, tuple):
        return given(found) | _bearing(scene, f"set.{one.name}")
    path = f"set.{one.name}.{MEMBERS}"
    each = [_bearing(bearing, f"{path}.{place + 1}") for place, bearing in enumerate(scene)]
    return given(found) | {MEMBERS: each}


def _bearing(scene: AbstractBearing, path: str) -> Rows:
    """The tables of a bearing without loads and speeds."""
    from ..reader import tables_of

    try:
        found = tables_of(_standing(scene))
    except SceneError as error:
        raise error.inside(path) from None
    operation = {name: value for name, value in found["operation"].items() if name in OF_SHAFT}
    idle = operation.get("outer_speed") is not None and float(np.asarray(scene.operation.outer_speed)) == 0.0
    operation = {name: value for name, value in operation.items() if not (idle and name == "outer_speed")}
    return {name: value for name, value in found.items() if name != "operation"} | (
        {"operation": operation} if operation else {}
    )


def _support(part: Support | None) -> Rows | None:
    if part is None:
        return None
    found = rows(SupportTable, part)
    found.pop("matrix", None)
    return found if part.matrix is None else found | {"matrix": _matrix(part.matrix)}


def _matrix(values: "npt.ArrayLike") -> list[list[float | str]]:
    """A stiffness matrix as texts with units, five rows for each bearing; a 0 has no unit."""
    return [
        [0 if one == 0.0 else number(one, MATRIX_UNITS[i % 5][j % 5]) for j, one in enumerate(row)]
        for i, row in enumerate(np.asarray(values, dtype=np.float64))
    ]


def _lengths(value: "npt.ArrayLike") -> float | str | list[float | str]:
    texts = [number(one, "m") for one in np.atleast_1d(np.asarray(value, dtype=np.float64))]
    return texts[0] if np.ndim(value) == 0 else texts


def _life(scene: ShaftSystem) -> Rows | None:
    if scene.life.weibull is None:
        return None
    unrated = [one.name for one in scene.places if getattr(one.scene, "rating", None) is None]
    if unrated:
        path = f"bearing.{unrated[0]}.rating"
        raise unwritable(path, "None", "a Rating, which life.weibull is about: [life] in a file rates all bearings")
    return {"weibull": written(scene.life, "weibull")}


def _state(one: ShaftState, scene: ShaftSystem) -> Rows:
    """The table of a state. **Raises:** `SceneError` for a change that a file cannot hold."""
    changes = {path: _change(path, value, scene) for path, value in one.changes.items()}
    return ({"name": one.name} if one.name else {}) | {"share": written(one, "share")} | changes


def _change(path: str, value: object, scene: ShaftSystem) -> float | str:
    above, _, last = path.rpartition(".")
    part = part_at(scene, above)
    fields = {field.name: field for field in dataclasses.fields(part)} if isinstance(part, eqx.Module) else {}
    said = fields[last].metadata if last in fields else {}
    if "bound" not in said:
        raise unwritable(f"state.{path}", "a change", "one of a number that files have at this path")
    return number(value, said["unit"], said["difference"])
