"""Oils: the data files of the catalogue, and the `Lubricant` that an oil table describes."""

import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np
from pydantic import ValidationError

from ..lubricants import (
    AbstractPressureViscosity,
    ConstantPressureViscosity,
    ExponentialRheology,
    FittedPressureViscosity,
    IntegratedPressureViscosity,
    LinearConductivity,
    LinearDensity,
    Lubricant,
    ModifiedWLF,
)
from .data_files import oil_names, oil_text
from .errors import SceneError, from_validation, nearest, one_of
from .oil_schema import (
    ConstantPressureViscosityTable,
    FittedPressureViscosityTable,
    IntegratedPressureViscosityTable,
    Law,
    OilTable,
)

_DOCUMENTATION = {"law", "sources"}


def load_oil(name: str) -> Lubricant:
    """An oil of the catalogue.

    **Raises:** `SceneError` for a name that the catalogue does not have.
    """
    if name not in oil_names():
        near = nearest(name, oil_names())
        raise SceneError(name, "name", f"'{name}'", f"an oil of the catalogue: {one_of(oil_names())}", near)
    try:
        return lubricant(OilTable.model_validate(with_catalogue({"name": name})))
    except ValidationError as error:
        raise from_validation(error, OilTable, f"{name}.toml") from None


def oil_data(name: str) -> dict[str, Any]:
    """The tables of an oil's data file."""
    return tomllib.loads(oil_text(name))


def with_catalogue(oil: Mapping[str, Any]) -> dict[str, Any]:
    """An oil table together with what its `name` stands for; what the table itself says prevails.

    A law table without `law`, or with the law of the catalogue, changes single parameters; with another law it
    replaces the catalogue's. An unknown name is left for the validation to refuse.
    """
    name = oil.get("name")
    if not isinstance(name, str) or name not in oil_names():
        return dict(oil)
    merged = oil_data(name)
    for key, own in oil.items():
        theirs = merged.get(key)
        if isinstance(own, Mapping) and isinstance(theirs, Mapping) and own.get("law", theirs["law"]) == theirs["law"]:
            merged[key] = {**theirs, **own}
        else:
            merged[key] = own
    return merged


def missing_sources(data: Mapping[str, Any]) -> list[str]:
    """Dotted paths of the values of an oil file whose source is not given (`all` speaks for a whole law)."""
    missing = []
    for law, table in data.items():
        if isinstance(table, Mapping):
            sources = table.get("sources", {})
            named = set(table) - _DOCUMENTATION
            missing += [f"{law}.{key}" for key in sorted(named) if not sources.get("all", sources.get(key))]
    return missing


def lubricant(table: OilTable) -> Lubricant:
    """The laws of a valid oil table, its parameters numpy scalars."""
    assert table.viscosity is not None
    viscosity = ModifiedWLF(**_parameters(table.viscosity))
    return Lubricant(
        viscosity=viscosity,
        pressure_viscosity=_pressure_viscosity(table, viscosity),
        rheology=None if table.rheology is None else ExponentialRheology(**_parameters(table.rheology)),
        density=None if table.density is None else LinearDensity(**_parameters(table.density)),
        conductivity=None if table.conductivity is None else LinearConductivity(**_parameters(table.conductivity)),
    )


def _pressure_viscosity(table: OilTable, viscosity: ModifiedWLF) -> AbstractPressureViscosity:
    law = table.pressure_viscosity
    if isinstance(law, float):
        return ConstantPressureViscosity(np.float64(law))
    if isinstance(law, ConstantPressureViscosityTable):
        return ConstantPressureViscosity(**_parameters(law))
    if isinstance(law, FittedPressureViscosityTable):
        return FittedPressureViscosity(**_parameters(law))
    assert isinstance(law, IntegratedPressureViscosityTable)
    return IntegratedPressureViscosity(viscosity)


def _parameters(law: Law) -> dict[str, np.float64]:
    # numpy scalars are leaves of the scene; plain Python floats would be compiled in as constants
    return {name: np.float64(value) for name, value in law.model_dump(exclude=_DOCUMENTATION).items()}
