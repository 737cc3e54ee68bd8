"""Builds the scene of a tapered roller bearing from its valid table. Only Python and numpy numbers enter the
constructors: nothing runs on JAX."""

from functools import cache

from ...bearings.parts import ContactLaws, Drag, Materials
from ...bearings.rating import Rating
from ...bearings.tapered.geometry import TaperedCage, TaperedGeometry
from ...bearings.tapered.scene import TaperedOperation, TaperedRollerBearing
from ...contacts import (
    ChittendenCentral,
    Gupta,
    MeanPressureTraction,
    NijenbanningVennerMoes,
    NoThermalReduction,
    Supply,
)
from ...contacts.point_laws import PointLaws
from ...lubricants import Lubricant, NoPressureViscosity
from ..bearing.build import built, cage, laws_of, part, seats, shapes, solids
from ..bearing.profile import roller_profile
from ..bearing.simulation import warm_up
from ..laws import RIB_FILMS, ROLLER_FILMS, ROLLING, distributed_traction, thermal_factor, viscous_function
from ..mixed import mixed_friction, rib_mixed_friction
from ..oil.catalogue import lubricant
from .schema import TaperedContactTable, TaperedRollerTable


def tapered_roller_bearing(table: TaperedRollerTable) -> TaperedRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = cache(lambda: None if table.oil is None else lubricant(table.oil))
    return built(
        TaperedRollerBearing,
        geometry=lambda: TaperedGeometry(**table.geometry.model_dump()),
        materials=lambda: Materials(**solids(table, "rings", "rollers", "inner_ring")),
        operation=lambda: TaperedOperation(**table.operation.model_dump(exclude_none=True)),
        oil=oil,
        contact=lambda: None if table.contact is None else _laws(table.contact, oil()),
        rib=lambda: None if table.contact is None else _rib_laws(table.contact, oil()),
        cage=lambda: cage(TaperedCage, table.cage),
        drag=lambda: part(Drag, table.drag),
        profile=lambda: roller_profile(table.profile),
        rating=lambda: part(Rating, table.rating),
        **seats(table),
        **shapes(table),
        simulation=lambda: warm_up(table),
    )


def _laws(table: TaperedContactTable, oil: Lubricant | None) -> ContactLaws:
    """Laws of the raceways."""
    rolling = None if table.rolling_resistance is None else ROLLING[table.rolling_resistance]()
    traction = None if table.traction is None else MeanPressureTraction(viscous_function(table.traction, oil))
    return laws_of(
        ContactLaws,
        TaperedContactTable,
        table,
        film=ROLLER_FILMS[table.film](),
        thermal=thermal_factor(table.thermal),
        traction=traction,
        rolling=rolling,
        supply=part(Supply, table.supply, exclude_none=True),
        mixed=mixed_friction(table.mixed),
    )


def _rib_laws(table: TaperedContactTable, oil: Lubricant | None) -> PointLaws:
    """Laws of the contacts of roller ends and rib. If `flange_film` is not given, the film law is that of contacts that
    roll along their longer axis. It holds only for piezoviscous oils; other oils have the law of Nijenbanning."""
    isoviscous = oil is not None and isinstance(oil.pressure_viscosity, NoPressureViscosity)
    film = NijenbanningVennerMoes if isoviscous else ChittendenCentral
    traction = None
    if table.traction is not None:
        traction = distributed_traction(table.traction, table.traction_accuracy, oil, spin=True)
    return PointLaws(
        film=film() if table.flange_film is None else RIB_FILMS[table.flange_film](),
        thermal=NoThermalReduction() if table.thermal is None else Gupta(),
        traction=traction,
        mixed=rib_mixed_friction(table.mixed),
    )
