"""Tables of scene files that all bearings have: operating point, profile, cage, laws of the raceways."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from ..bearings.cage import AbstractCage
from ..bearings.profile import RollerProfile
from ..contacts import PRESETS, AbstractViscousFunction, DistributedTraction, NoThermalReduction, Resolution
from ..contacts.profile import CrownedProfile, LogarithmicProfile
from ..lubricants import Lubricant
from ..materials import catalogue_material
from ..mounting import Fits
from .bearing_schema import DisplacementTable, FitsTable, TemperaturesTable
from .laws import LINE_THERMAL, ROLLER_FILMS, ROLLING, TRACTIONS, TURBULENCE, Laws, viscous_function
from .oil_writer import scene_oil
from .part_writer import Rows, all_rows, given, law_name, material, optional_rows, rows, same, shown, unwritable
from .profile_schema import ProfileTable
from .table import Table

_OF_OIL = ("oil_temperature", "oil_flow")
"""Fields of the operating point that only lubricated bearings need."""


def bearing_tables(scene: Any, tables: Mapping[str, type[Table]], *, geometry: Rows, **own: Rows | None) -> Rows:
    """The tables of a bearing in the order of the built-in files.

    **Arguments:**
    - `tables`: of `operation` and of the parts whose fields all follow from their class, by name.
    - `geometry`, `own`: the other tables; `None` for a part that is not modelled.
    """
    materials = {field.name: getattr(scene.materials, field.name) for field in dataclasses.fields(scene.materials)}
    plain = {name: optional_rows(tables[name], getattr(scene, name)) for name in tables if name != "operation"}
    parts = {
        "geometry": geometry,
        "materials": {name: material(one) for name, one in materials.items() if one is not None},
        "oil": scene_oil(scene.oil),
        **own,
        **plain,
        "fits": fits(scene.fits),
        "temperatures": optional_rows(TemperaturesTable, scene.temperatures),
        "operation": _operation(tables["operation"], scene),
    }
    order = ("geometry", "profile", "materials", "oil", "contact", "kinematics", "cage", "flange", "drag", "rating")
    order = (*order, "fits", "temperatures", "operation", "simulation")
    assert set(parts) <= set(order), parts
    return {"kind": scene.kind} | given({name: parts.get(name) for name in order})


def _operation(table: type[Table], scene: Any) -> Rows:
    operation = scene.operation
    found = rows(table, operation)
    if scene.oil is None and scene.contact is None:
        assumed = {field.name: field.default for field in dataclasses.fields(operation) if field.name in _OF_OIL}
        for name, default in assumed.items():
            if same(getattr(operation, name), default):
                del found[name]
    return found | given({"displacement": optional_rows(DisplacementTable, operation.displacement)})


def fits(part: Fits | None) -> Rows | None:
    """The table [fits]."""
    if part is None:
        return None
    solids = {"shaft_material": part.shaft_material, "housing_material": part.housing_material}
    usual = catalogue_material("steel", thermal=True)
    named = {name: None if same(one, usual) else material(one) for name, one in solids.items()}
    return rows(FitsTable, part) | given(named)


def cage(table: type[Table], part: AbstractCage | None) -> Rows | None:
    """The table [cage]."""
    if part is None:
        return None
    return rows(table, part) | {"turbulence": law_name(TURBULENCE, part.turbulence, "cage.turbulence")}


def profile(part: RollerProfile | None) -> Rows | None:
    """The table [profile]."""
    if part is None:
        return None
    words = {type(None): "straight", CrownedProfile: "crowned", LogarithmicProfile: "logarithmic"}
    shape = part.shape
    if type(shape) not in words:
        raise unwritable("profile.shape", shown(shape), "a straight, crowned or logarithmic profile")
    return {"shape": words[type(shape)]} | ({} if shape is None else all_rows(shape)) | rows(ProfileTable, part)


def raceway_laws(contact: Any) -> Rows:
    """The laws of a roller bearing's raceways by name, but for the traction."""
    rolling = contact.rolling
    return given(
        {
            "film": law_name(ROLLER_FILMS, contact.film, "contact.film"),
            "thermal": thermal_law(LINE_THERMAL, contact.thermal),
            "rolling_resistance": rolling and law_name(ROLLING, rolling, "contact.rolling"),
        }
    )


def thermal_law(laws: Laws[Any], law: Any) -> str | None:
    """The name of the thermal reduction of films; `None` for films without one."""
    return None if same(law, NoThermalReduction()) else law_name(laws, law, "contact.thermal")


def flow_law(
    viscous: AbstractViscousFunction | None, oil: Lubricant | None, path: str, laws: Laws[Any] = TRACTIONS
) -> str:
    """The name of a flow law with this oil."""
    return law_name(laws, viscous, path, lambda name: viscous_function(name, oil))


def march_accuracy(traction: DistributedTraction, path: str, spin: bool) -> float:
    """The accuracy for which files have this resolution of the traction."""
    known = {Resolution.for_accuracy(accuracy, spin): accuracy for accuracy in PRESETS}
    if traction.resolution not in known:
        expected = f"one of those that traction_accuracy has: {', '.join(map(shown, known))}"
        raise unwritable(f"{path}.resolution", shown(traction.resolution), expected)
    return known[traction.resolution]
