"""Names of contact laws in scene files of any kind, and the laws that they stand for."""

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import BeforeValidator

from ..contacts import (
    PRESETS,
    AbstractLineFilm,
    AbstractPointFilm,
    AbstractThermalFactor,
    AbstractViscousFunction,
    DistributedTraction,
    DowsonHigginson,
    DowsonToyoda,
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
from ..contacts import viscous_function as viscous_function_named
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
"""Film laws of ball bearings, in which some balls may carry nothing."""
THERMAL: dict[str, type[AbstractThermalFactor]] = {"gupta": Gupta, "hsu_lee": HsuLee}
MAXWELL_EYRING = "maxwell_eyring"
"""Ree and Eyring's flow with the Maxwell element that every law here has."""

DISTRIBUTED_ACCURACY = 1e-3
"""Accuracy of the distributed traction if a scene gives none."""


def thermal_factor(name: str | None) -> AbstractThermalFactor:
    return NoThermalReduction() if name is None else THERMAL[name]()


def viscous_function(name: str, oil: Lubricant | None) -> AbstractViscousFunction:
    """The flow law of this name, with the exponent with which the oil's data were fitted."""
    name = ReeEyring.name if name == MAXWELL_EYRING else name
    return viscous_function_named(name, None if oil is None else oil.rheology)


def distributed_traction(
    name: str, accuracy: float | None, oil: Lubricant | None, spin: bool = False
) -> DistributedTraction:
    """The traction of a bearing's contact with the flow law of this name, to this or the assumed accuracy; `spin`:
    whether the bodies spin against each other."""
    resolution = Resolution.for_accuracy(DISTRIBUTED_ACCURACY if accuracy is None else accuracy, spin)
    return DistributedTraction(viscous_function(name, oil), resolution)


def _accuracy(value: Any) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or float(value) not in PRESETS:
        known = ", ".join(f"{key:g}" for key in PRESETS)
        raise units.refusal(f"one of {known}, without quotes", units.describe(value))
    return float(value)


TractionAccuracy = Annotated[float, BeforeValidator(_accuracy)]
"""Relative error of the forces for which there is a measured resolution."""
