"""Reads the oils of the catalogue and makes the `Lubricant` that an oil table describes."""

import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...lubricants import (
    ISOVISCOUS,
    AbstractPressureViscosity,
    AbstractRheology,
    AbstractViscosity,
    ConstantPressureViscosity,
    IntegratedPressureViscosity,
    LinearConductivity,
    LinearDensity,
    LinearHeatCapacity,
    Lubricant,
    NoPressureViscosity,
    WaltherPower,
    WaltherRoelands,
)
from ..data_files import oil_named, oil_names, oil_text
from ..drafts import read_table
from ..errors import SceneError, nearest, one_of
from .files import base_of
from .grades import grade_named
from .schema import DOCUMENTATION, LAWS, Law, OilTable, builds

ROOM_TEMPERATURE = 293.15
"""Reference temperature, K, of a linear law without a slope, on which it has no effect."""


def load_oil(name: str, base: str | None = None) -> Lubricant:
    """An oil of the catalogue by its name, or a standard oil by its grade.

    **Arguments:** `base`: base stock of a grade; "mineral" if not given.

    **Raises:** `SceneError` for an unknown name, grade or base stock.
    """
    if (isinstance(name, str) and grade_named(name) is not None) or base is not None:
        table = {"grade": name} if base is None else {"grade": name, "base": base}
        return lubricant(read_table(OilTable, with_catalogue(table), str(name)))
    known = oil_named(name)
    if known is None:
        near = nearest(name, oil_names()) if isinstance(name, str) else ""
        raise SceneError(str(name), "name", f"'{name}'", f"an oil of the catalogue: {one_of(oil_names())}", near)
    return lubricant(read_table(OilTable, with_catalogue({"name": known}), f"{known}.toml"))


def oil_data(name: str) -> dict[str, object]:
    """The tables of an oil's data file."""
    return tomllib.loads(oil_text(name))


def with_catalogue(oil: Mapping[str, Any]) -> dict[str, Any]:
    """An oil table merged with the data of its `name`, `grade` or `file`; entries of the table itself take precedence.

    A table of a law without `law`, or with the same law as the catalogue, changes single parameters; with another law
    it replaces the law of the catalogue. If the viscosity is changed, the pressure-viscosity coefficient of the
    catalogue is dropped and integrated from the new viscosity. The same rules hold for an oil file. The validation
    refuses an unknown name.

    **Raises:** `SceneError` for a file that cannot be read or is not an oil.
    """
    merged = base_of(oil)
    if merged is None:
        return dict(oil)
    if "viscosity" in oil and _changes(oil["viscosity"], merged["viscosity"]):
        merged.pop("pressure_viscosity", None)
    for key, own in oil.items():
        theirs = merged.get(key)
        if isinstance(own, Mapping) and isinstance(theirs, Mapping) and own.get("law", theirs["law"]) == theirs["law"]:
            # a note on the catalogue's values does not apply to values that replace them, even if these are equal
            replaced = any(key not in DOCUMENTATION for key in own)
            kept = {name: value for name, value in theirs.items() if name != "note" or not replaced}
            if own.get("viscous_function", kept.get("viscous_function")) != kept.get("viscous_function"):
                # the exponent belongs to the viscous function that is replaced
                kept.pop("exponent", None)
            merged[key] = {**kept, **own}
        else:
            merged[key] = own
    return merged


def _changes(own: object, theirs: Mapping[str, object]) -> bool:
    return not isinstance(own, Mapping) or any(theirs.get(key) != value for key, value in own.items())


def missing_sources(data: Mapping[str, object]) -> list[str]:
    """Dotted paths of the values of an oil file without a source (`all` is the source of all values of a law)."""
    missing = []
    for law, table in data.items():
        if isinstance(table, Mapping):
            sources = table.get("sources", {})
            named = set(table) - set(DOCUMENTATION)
            missing += [f"{law}.{key}" for key in sorted(named) if not sources.get("all", sources.get(key))]
    return missing


def lubricant(table: OilTable) -> Lubricant:
    """The lubricant that a valid oil table describes, with numpy scalars as parameters."""
    density = None if table.density is None else LinearDensity(**_linear(table.density))
    viscosity = _viscosity(table, density)
    laws = [getattr(table, name) for name in LAWS]
    notes = tuple(law.note for law in laws if isinstance(law, Law) and law.note)
    return Lubricant(
        viscosity=viscosity,
        pressure_viscosity=_pressure_viscosity(table, viscosity),
        rheology=None if table.rheology is None else _rheology(table.rheology),
        density=density,
        conductivity=None if table.conductivity is None else LinearConductivity(**_linear(table.conductivity)),
        heat_capacity=None if table.heat_capacity is None else LinearHeatCapacity(**_linear(table.heat_capacity)),
        notes=(*viscosity.notes, *notes),
    )


def _viscosity(table: OilTable, density: LinearDensity | None) -> AbstractViscosity:
    law: Any = table.viscosity
    more = {"density": density} if builds(law, WaltherRoelands, WaltherPower) else {}
    return law.builds(**more, **_parameters(law))


def _pressure_viscosity(table: OilTable, viscosity: AbstractViscosity) -> AbstractPressureViscosity:
    law: Any = table.pressure_viscosity
    if isinstance(law, float):
        return ConstantPressureViscosity(np.float64(law))
    if law is not None and not builds(law, IntegratedPressureViscosity):
        return law.builds(**_parameters(law))
    return NoPressureViscosity() if isinstance(viscosity, ISOVISCOUS) else IntegratedPressureViscosity(viscosity)


def _rheology(table: Any) -> AbstractRheology:
    # the exponent is static
    return table.builds(**{**_parameters(table), "exponent": table.exponent})


def _linear(law: float | Law) -> dict[str, object]:
    """Parameters of a linear law. A plain number means a constant."""
    if isinstance(law, Law):
        return _parameters(law)
    return {"value": np.float64(law), "slope": np.float64(0.0), "reference_temperature": np.float64(ROOM_TEMPERATURE)}


def _parameters(law: Law) -> dict[str, Any]:
    # numpy scalars are leaves of the scene; plain Python floats would be compiled in as constants
    parameters = law.model_dump(exclude=set(DOCUMENTATION), exclude_none=True)
    return {name: np.float64(value) if isinstance(value, float) else value for name, value in parameters.items()}
