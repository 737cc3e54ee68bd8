"""Assumed distributions of inputs for which there are no measurements."""

import math
from typing import TYPE_CHECKING, Any

from ..contacts.oil_supply import LEVELS
from ..distribution import Distribution
from ..lubricants import WaltherPower

if TYPE_CHECKING:
    from .._scene import AbstractScene

DRAG_FIELD = "drag.coefficient"
"""Dotted path of the drag coefficient."""
DRAG = {
    "ball": Distribution.lognormal(0.2, 0.9, high=0.66),
    "roller": Distribution.lognormal(0.3, 0.9, high=1.2),
}
r"""Rolling element -> assumed distribution of its drag coefficient in a row, with Parker's oil fraction.

A measured loss determines only the product of drag coefficient and oil fraction, so this is the distribution of
$\chi = XC_d/X_{Parker}$. An isolated ball has 0.42 to 0.5, an isolated roller 1.0 to 1.2. Neighbours, rings, cage and
a mixture that turns with the elements reduce it by a factor that has not been measured. The heat of a 35-mm ball
bearing at 28 000 to 72 000 rpm gives an upper bound of 0.66 if all of it were drag, and 0.2 to 0.6 after subtraction of
the rolling resistance. Median and spread are a judgement.
"""

COEFFICIENT_FIELD = "oil.viscosity.pressure_coefficient"
"""Dotted path of the factor in the pressure-viscosity law of a standard oil."""
SUPPLY_FIELD = "contact.supply.gap_over_central"
"""Dotted path of the supply input "gap at the inlet over central film"."""
LEVEL_FIELD = "contact.supply.level"
"""Dotted path of the supply level, a word that stands for such a gap."""
SUPPLY_DEVIATION = math.log(3.0)
"""Standard deviation of the logarithm of the gap for a supply level: a factor of 3 about the median, which `LEVELS`
gives as 100 (jet, under the race), 10 (bath) or 1 (grease, oil and air). It is a judgement."""


def drag_prior(scene: Any) -> Distribution | None:
    """Assumed distribution of the drag coefficient of a bearing; `None` if the scene has no drag, a coefficient of 0,
    or a coefficient by the law of an isolated ball."""
    drag = getattr(scene, "drag", None)
    coefficient = None if drag is None else drag.coefficient
    if coefficient is None or not scene.dissipates or float(coefficient) == 0.0:
        return None
    return DRAG[scene.element]


def isolated(scene: Any) -> bool:
    """True if the drag coefficient of a bearing follows from the law of an isolated ball."""
    drag = getattr(scene, "drag", None)
    return drag is not None and drag.coefficient is None and scene.dissipates


def supply_prior(scene: "AbstractScene") -> Distribution | None:
    """Assumed distribution of the gap at the inlet over the central film; `None` if the scene does not give its supply
    as a `level`."""
    supply = getattr(getattr(scene, "contact", None), "supply", None)
    level = None if supply is None else supply.level
    return None if level is None else Distribution.lognormal(LEVELS[level], SUPPLY_DEVIATION)


def meaning(scene: "AbstractScene", path: str) -> str:
    """Explains a number of a law and its effect at the inlet temperature of the oil; "" if its name is clear by itself.

    **Arguments:** `path`: dotted path of the number.
    """
    if path != COEFFICIENT_FIELD:
        return ""
    viscosity = getattr(getattr(scene, "oil", None), "viscosity", None)
    temperature = getattr(getattr(scene, "operation", None), "oil_temperature", None)
    if not isinstance(viscosity, WaltherPower) or temperature is None:
        return ""
    alpha, celsius = 1e9 * float(viscosity.coefficient(temperature)), float(temperature) - 273.15
    return f"s in alpha = s (nu/cSt)^t, and alpha is {alpha:.3g} 1/GPa at {celsius:.4g} degC"


def prior_in_words(prior: Distribution) -> str:
    """Description of an assumed distribution in words."""
    cut = "" if prior.high is None else f", at most {prior.high:g}"
    return f"assumed: lognormal, median {prior.median:g}, log deviation {prior.log_deviation:.3g}{cut}"
