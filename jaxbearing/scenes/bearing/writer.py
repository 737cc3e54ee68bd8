"""Tables of scene files that all bearings have: operating point, profile, cage, laws of the raceways."""

import dataclasses
from typing import Any

from ...bearings.bearing import AbstractBearing
from ...bearings.cage import AbstractCage
from ...bearings.profile import RollerProfile
from ...contacts import PRESETS, AbstractViscousFunction, DistributedTraction, NoThermalReduction, Resolution
from ...contacts.profile import CrownedProfile, LogarithmicProfile
from ...lubricants import Lubricant
from ..fields import plain_table_at
from ..laws import LINE_THERMAL, ROLLER_FILMS, ROLLING, TRACTIONS, TURBULENCE, Laws, viscous_function
from ..oil.writer import scene_oil
from ..part_writer import Rows, all_rows, given, law_name, rows, same, shown, unwritable
from ..table import Table

_ORDER = (
    *("geometry", "outer_ring", "inner_ring", "inner_roundness", "outer_roundness", "profile"),
    *("materials", "oil", "contact"),
    *("kinematics", "cage", "flange", "drag", "rating"),
    *("operation", "fits", "temperatures", "thermal", "simulation"),
)
"""Tables of the built-in files; a table of another part comes after them."""
_OF_OIL = ("oil_temperature", "oil_flow")
"""Fields of the operating point that only lubricated bearings need."""


def bearing_tables(scene: AbstractBearing, model: type[Table], **own: Rows | None) -> Rows:
    """The tables of a bearing in the order of the built-in files.

    **Arguments:**
    - `model`: of the whole file.
    - `own`: name of a table -> entries that `rows` does not find, such as names of laws; `None` for a part that is
      not modelled.
    """
    tables: Rows = {}
    for name in sorted(model.model_fields, key=lambda name: _ORDER.index(name) if name in _ORDER else len(_ORDER)):
        table, part = plain_table_at(model, name), getattr(scene, name, None)
        if table is None or part is None:
            continue
        # materials from files have thermal properties in [fits], and in [materials] if the parts have temperatures
        warm = scene.temperatures is not None or scene.thermal is not None
        thermal = name == "fits" or (name == "materials" and warm)
        tables[name] = scene_oil(part) if name == "oil" else _joined(own.get(name) or {}, rows(table, part, thermal))
    tables["operation"] = _operation(tables["operation"], scene)
    if "thermal" in tables:
        # inner tables without entries are left out
        tables["thermal"] = {name: value for name, value in tables["thermal"].items() if value != {}}
    return {"kind": scene.kind} | tables


def _joined(own: Rows, entries: Rows) -> Rows:
    """Both tables merged, and also the inner tables that both have."""
    inner = lambda name, value: own[name] | value if isinstance(value, dict) and name in own else value
    return own | {name: inner(name, value) for name, value in entries.items()}


def _operation(entries: Rows, scene: AbstractBearing) -> Rows:
    """The operating point. For a bearing without oil, fields of the oil with their default values are left out."""
    if scene.oil is not None or scene.contact is not None:
        return entries
    assumed = {field.name: field.default for field in dataclasses.fields(scene.operation) if field.name in _OF_OIL}
    idle = {name for name, default in assumed.items() if same(getattr(scene.operation, name), default)}
    return {name: value for name, value in entries.items() if name not in idle}


def cage(table: type[Table], part: AbstractCage | None) -> Rows | None:
    """The table [cage]."""
    if part is None:
        return None
    return rows(table, part) | {"turbulence": law_name(TURBULENCE, part.turbulence, "cage.turbulence")}


def profile(part: RollerProfile | None) -> Rows | None:
    """The shape of the rollers and its numbers, for the table [profile]."""
    if part is None:
        return None
    words = {type(None): "straight", CrownedProfile: "crowned", LogarithmicProfile: "logarithmic"}
    shape = part.shape
    if type(shape) not in words:
        raise unwritable("profile.shape", shown(shape), "a straight, crowned or logarithmic profile")
    return {"shape": words[type(shape)]} | ({} if shape is None else all_rows(shape))


def raceway_laws(contact: Any) -> Rows:
    """Names of the laws of a roller bearing's raceways, except traction."""
    rolling = contact.rolling
    return given(
        {
            "film": law_name(ROLLER_FILMS, contact.film, "contact.film"),
            "thermal": thermal_law(LINE_THERMAL, contact.thermal),
            "rolling_resistance": rolling and law_name(ROLLING, rolling, "contact.rolling"),
        }
    )


def thermal_law(laws: Laws[Any], law: object) -> str | None:
    """The name of the thermal reduction of films; `None` for films without one."""
    return None if same(law, NoThermalReduction()) else law_name(laws, law, "contact.thermal")


def flow_law(
    viscous: AbstractViscousFunction | None, oil: Lubricant | None, path: str, laws: Laws[Any] = TRACTIONS
) -> str:
    """The name of a flow law, whose exponent comes from the oil."""
    return law_name(laws, viscous, path, lambda name: viscous_function(name, oil))


def march_accuracy(traction: DistributedTraction, path: str, spin: bool) -> float:
    """The value of `traction_accuracy` that gives this resolution of the traction."""
    known = {Resolution.for_accuracy(accuracy, spin): accuracy for accuracy in PRESETS}
    if traction.resolution not in known:
        expected = f"one of those that traction_accuracy has: {', '.join(map(shown, known))}"
        raise unwritable(f"{path}.resolution", shown(traction.resolution), expected)
    return known[traction.resolution]
