"""Laws that the [contact] table of a roller bearing names."""

from collections.abc import Callable

from ..bearings.parts import ContactLaws
from ..contacts import (
    AbstractLineFilm,
    AbstractRollingResistance,
    AbstractTraction,
    JoinedRollingResistance,
    MartinBlend,
    MeanPressureTraction,
    RigidRollingResistance,
)
from ..lubricants import Lubricant
from .laws import LINE_FILMS, distributed_traction, thermal_factor, viscous_function
from .roller_schema import ContactTable


def _with_martin(film: type[AbstractLineFilm]) -> Callable[[], AbstractLineFilm]:
    """An elastohydrodynamic formula alone has a finite film at no load, where an unloaded roller needs Martin's."""
    return lambda: MartinBlend(film())


FILMS: dict[str, Callable[[], AbstractLineFilm]] = {
    name: film if name == "moes" else _with_martin(film) for name, film in LINE_FILMS.items()
}
ROLLING: dict[str, type[AbstractRollingResistance]] = {
    "rigid_isoviscous": RigidRollingResistance,
    # under load; a roller outside the loaded zone has the rigid law's
    "ertel_grubin": JoinedRollingResistance,
}


def contact_laws(table: ContactTable, oil: Lubricant | None) -> ContactLaws:
    """The laws that a table names. Traction laws take the exponent with which the oil's data were fitted."""
    rolling = None if table.rolling_resistance is None else ROLLING[table.rolling_resistance]()
    return ContactLaws(
        film=FILMS[table.film](),
        thermal=thermal_factor(table.thermal),
        traction=_traction(table, oil),
        rolling=rolling,
        entrainment_offset=table.entrainment_offset,
    )


def _traction(table: ContactTable, oil: Lubricant | None) -> AbstractTraction | None:
    if table.traction is None:
        return None
    if table.traction_model == "mean_pressure":
        return MeanPressureTraction(viscous_function(table.traction, oil))
    return distributed_traction(table.traction, table.traction_accuracy, oil)
