"""What the names of laws in a [contact] table stand for."""

from collections.abc import Callable

from ..bearings.parts import ContactLaws
from ..contacts import (
    AbstractLineFilm,
    AbstractRollingResistance,
    AbstractThermalFactor,
    BairWiner,
    DowsonHigginson,
    DowsonToyoda,
    ElsharkawyHamrock,
    GecimWiner,
    Grubin,
    Gupta,
    HsuLee,
    JoinedRollingResistance,
    MartinBlend,
    MeanPressureTraction,
    Moes,
    NoThermalReduction,
    PanHamrockCentral,
    ReeEyring,
    RigidRollingResistance,
)
from ..lubricants import Lubricant
from .schema import ContactTable

FILMS: dict[str, Callable[[], AbstractLineFilm]] = {
    "moes": Moes,
    "dowson_higginson": lambda: MartinBlend(DowsonHigginson()),
    "dowson_toyoda": lambda: MartinBlend(DowsonToyoda()),
    "pan_hamrock": lambda: MartinBlend(PanHamrockCentral()),
    "grubin": lambda: MartinBlend(Grubin()),
}
"""An elastohydrodynamic formula alone has a finite film at no load, where an unloaded roller needs Martin's."""
THERMAL: dict[str, type[AbstractThermalFactor]] = {"gupta": Gupta, "hsu_lee": HsuLee}
VISCOUS = {"ree_eyring": ReeEyring, "bair_winer": BairWiner, "gecim_winer": GecimWiner}
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
        thermal=NoThermalReduction() if table.thermal is None else THERMAL[table.thermal](),
        traction=None if table.traction is None else _traction(table.traction, oil),
        rolling=rolling,
        entrainment_offset=table.entrainment_offset,
    )


def _traction(name: str, oil: Lubricant | None) -> MeanPressureTraction:
    if name == "elsharkawy_hamrock":
        fitted = None if oil is None or oil.rheology is None else oil.rheology.exponent
        return MeanPressureTraction(ElsharkawyHamrock() if fitted is None else ElsharkawyHamrock(fitted))
    # the Maxwell-Eyring law is Ree and Eyring's flow with the Maxwell element that every law here has
    return MeanPressureTraction(VISCOUS["ree_eyring" if name == "maxwell_eyring" else name]())
