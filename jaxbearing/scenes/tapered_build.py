"""From a valid table of a tapered roller bearing to the scene of the library. Only Python and numpy numbers enter the
constructors: nothing runs on JAX."""

from ..bearings.parts import ContactLaws, Materials
from ..bearings.rating import Rating
from ..bearings.tapered_geometry import TaperedGeometry
from ..bearings.tapered_roller import TaperedOperation, TaperedRollerBearing
from .bearing_build import part
from .contact_laws import FILMS, ROLLING
from .laws import thermal_factor
from .materials import material
from .oils import lubricant
from .profile_schema import roller_profile
from .tapered_schema import TaperedContactTable, TaperedRollerTable


def tapered_roller_bearing(table: TaperedRollerTable) -> TaperedRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    return TaperedRollerBearing(
        geometry=TaperedGeometry(**table.geometry.model_dump()),
        materials=Materials(rings=material(table.materials.rings), rollers=material(table.materials.rollers)),
        operation=TaperedOperation(**table.operation.model_dump(exclude_none=True)),
        oil=None if table.oil is None else lubricant(table.oil),
        contact=None if table.contact is None else _laws(table.contact),
        profile=roller_profile(table.profile),
        rating=part(Rating, table.rating),
    )


def _laws(table: TaperedContactTable) -> ContactLaws:
    rolling = None if table.rolling_resistance is None else ROLLING[table.rolling_resistance]()
    return ContactLaws(film=FILMS[table.film](), thermal=thermal_factor(table.thermal), rolling=rolling)
