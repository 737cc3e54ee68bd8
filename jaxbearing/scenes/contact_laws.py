"""Laws that the [contact] table of a roller bearing names."""

from ..bearings.parts import ContactLaws
from ..contacts import AbstractTraction, MeanPressureTraction, Supply
from ..lubricants import Lubricant
from .bearing.build import laws_of, part
from .cylindrical.schema import ContactTable
from .laws import ROLLER_FILMS, ROLLING, distributed_traction, thermal_factor, viscous_function
from .mixed import mixed_friction


def contact_laws(table: ContactTable, oil: Lubricant | None) -> ContactLaws:
    """The laws that a table names. Traction laws take the exponent with which the oil's data were fitted."""
    rolling = None if table.rolling_resistance is None else ROLLING[table.rolling_resistance]()
    return laws_of(
        ContactLaws,
        ContactTable,
        table,
        film=ROLLER_FILMS[table.film](),
        thermal=thermal_factor(table.thermal),
        traction=_traction(table, oil),
        rolling=rolling,
        supply=part(Supply, table.supply, exclude_none=True),
        mixed=mixed_friction(table.mixed),
    )


def _traction(table: ContactTable, oil: Lubricant | None) -> AbstractTraction | None:
    if table.traction is None:
        return None
    if table.traction_model == "mean_pressure":
        return MeanPressureTraction(viscous_function(table.traction, oil))
    return distributed_traction(table.traction, table.traction_accuracy, oil)
