"""Results of the life calculation, labelled like all results."""

import equinox as eqx
from jaxtyping import Array, Float

from .._scene import label

_Number = Float[Array, ""]


def _result(unit: str, description: str):
    return eqx.field(metadata=label(unit, description), kw_only=True)


def _optional(unit: str, description: str):
    return eqx.field(default=None, metadata=label(unit, description), kw_only=True)


class Life(eqx.Module):
    """Life of a solved bearing; what the scene does not model is `None`. Lives count millions of revolutions of the
    rings against each other. The order is that of the reports: the modified life is the one to design by."""

    Lnmr_hours: _Number | None = _optional("h", "modified reference rating life")
    Lnmr: _Number | None = _optional("1", "modified reference rating life a_1 a_ISO L10r, million revolutions")
    L10r_hours: _Number = _result("h", "basic reference rating life")
    L10r: _Number = _result("1", "basic reference rating life, million revolutions")
    L10h: _Number | None = _optional("h", "basic rating life of ISO 281 by catalogue formulas")
    L10: _Number | None = _optional("1", "basic rating life of ISO 281 by catalogue formulas, million revolutions")
    reliability_factor: _Number = _result("1", "a_1")
    modification_factor: _Number | None = _optional("1", "a_ISO")
    viscosity_ratio: _Number | None = _optional("1", "kappa, viscosity over that of an adequate film")
    film_ratio_inner: Float[Array, " element"] | None = _optional(
        "1", "lambda ratio (of the minimum film) on the inner raceway"
    )
    film_ratio_outer: Float[Array, " element"] | None = _optional(
        "1", "lambda ratio (of the minimum film) on the outer raceway"
    )
    dynamic_capacity: _Number = _result("N", "basic dynamic load rating C")
    static_capacity: _Number = _result(
        "N", "basic static load rating C0, at the pressures of ISO 76: 4.2 GPa of balls, 4.0 GPa of rollers"
    )
    equivalent_load: _Number = _result("N", "load P at which ISO 281 gives the reference life")
    damage_rate: _Number = _result("1", "1/L10r, per million revolutions: 0 without load, smooth")
