"""What the names of contact laws in scene files stand for, whatever the kind of scene."""

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import BeforeValidator

from ..contacts import (
    PRESETS,
    AbstractLineFilm,
    AbstractPointFilm,
    AbstractThermalFactor,
    AbstractViscousFunction,
    BairWiner,
    DistributedTraction,
    DowsonHigginson,
    DowsonToyoda,
    ElsharkawyHamrock,
    GecimWiner,
    Grubin,
    Gupta,
    HamrockDowsonCentral,
    HsuLee,
    Moes,
    NijenbanningVennerMoes,
    NoThermalReduction,
    PanHamrockCentral,
    ReeEyring,
    Resolution,
    RigidBlend,
)
from ..lubricants import Lubricant
from . import units

LINE_FILMS: dict[str, type[AbstractLineFilm]] = {
    "moes": Moes,
    "dowson_higginson": DowsonHigginson,
    "dowson_toyoda": DowsonToyoda,
    "pan_hamrock": PanHamrockCentral,
    "grubin": Grubin,
}
POINT_FILMS: dict[str, type[AbstractPointFilm]] = {
    "nijenbanning": NijenbanningVennerMoes,
    "hamrock_dowson": HamrockDowsonCentral,
}
BALL_FILMS: dict[str, Callable[[], AbstractPointFilm]] = {
    "nijenbanning": NijenbanningVennerMoes,
    # an unloaded ball needs the rigid film of light loads
    "hamrock_dowson": lambda: RigidBlend(HamrockDowsonCentral()),
}
"""Of balls, some of which may carry nothing."""
THERMAL: dict[str, type[AbstractThermalFactor]] = {"gupta": Gupta, "hsu_lee": HsuLee}
VISCOUS: dict[str, type[AbstractViscousFunction]] = {
    "ree_eyring": ReeEyring,
    "bair_winer": BairWiner,
    "gecim_winer": GecimWiner,
    # the Maxwell-Eyring law is Ree and Eyring's flow with the Maxwell element that every law here has
    "maxwell_eyring": ReeEyring,
}
"""Besides Elsharkawy and Hamrock's, which has an exponent."""

DISTRIBUTED_ACCURACY = 1e-3
"""Of the distributed traction where a scene does not say."""


def thermal_factor(name: str | None) -> AbstractThermalFactor:
    return NoThermalReduction() if name is None else THERMAL[name]()


def viscous_function(name: str, oil: Lubricant | None) -> AbstractViscousFunction:
    """The flow law of this name, with the exponent with which the oil's data were fitted."""
    if name != "elsharkawy_hamrock":
        return VISCOUS[name]()
    fitted = None if oil is None or oil.rheology is None else oil.rheology.exponent
    return ElsharkawyHamrock() if fitted is None else ElsharkawyHamrock(fitted)


def distributed_traction(name: str, accuracy: float | None, oil: Lubricant | None) -> DistributedTraction:
    """The traction of a bearing's contact with the flow law of this name, to this or the assumed accuracy."""
    resolution = Resolution.for_accuracy(DISTRIBUTED_ACCURACY if accuracy is None else accuracy)
    return DistributedTraction(viscous_function(name, oil), resolution)


def _accuracy(value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or float(value) not in PRESETS:
        known = ", ".join(f"{key:g}" for key in PRESETS)
        raise units.refusal(f"one of {known}, without quotes", units.describe(value))
    return float(value)


TractionAccuracy = Annotated[float, BeforeValidator(_accuracy)]
"""Relative error of the forces for which there is a measured resolution."""
