"""Shear modulus and characteristic shear stress of a lubricant under contact pressure."""

from typing import ClassVar

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import Checked, bounded, known
from ..numerics.structure import choice, constant

EXPONENT_CAP = 60.0
"""Exponents are clipped to +-60 (26 decades): beyond, the law is constant and its gradient 0."""

VISCOUS_FUNCTIONS = ("ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock")
"""Names of the flow laws with which shear modulus and stress may have been fitted."""


class ExponentialRheology(Checked):
    r"""Shear modulus and characteristic stress, exponential in pressure and in 1/temperature.

    $G = G_0\exp[\alpha_G p + \beta_G(1/T - 1/T_0)]$, $\tau = \tau_{00}\exp[\alpha_\tau p + \beta_\tau(1/T - 1/T_0)]$.

    Both come as natural logarithms, since only those are needed downstream. Whether the stress is an Eyring stress or
    a limiting stress is said by `viscous_function`, the flow law with which the data were fitted; with another one
    the same numbers give another traction.

    **Limits:** $G_0$, $\tau_{00}$ at p = 0, T = T_0.
    **Validity:** the source's fits are for 0.6 to 1.8 GPa and 273 to 378 K; $G_0$ is an extrapolation to p = 0.
    $\beta_\tau < 0$ for both oils of the source: the stress *rises* with temperature, a property of the fit.
    **Reference:** source eqs. (78)-(79), tables 8 and 12.
    """

    part: ClassVar[str] = "oil.rheology"

    reference_temperature: Scalar = bounded("> 0", unit="K")
    shear_modulus: Scalar = bounded("> 0", unit="Pa")
    shear_modulus_pressure: Scalar = bounded("finite", unit="1/Pa")
    shear_modulus_temperature: Scalar = bounded("finite", unit="K", difference=True)
    stress: Scalar = bounded("> 0", unit="Pa")
    stress_pressure: Scalar = bounded("finite", unit="1/Pa")
    stress_temperature: Scalar = bounded("finite", unit="K", difference=True)
    viscous_function: str | None = choice("rheology.viscous_function", VISCOUS_FUNCTIONS, None)
    exponent: float | None = constant("rheology.exponent", None, bound="> 0")

    def misfit(self, viscous_function: str, exponent: Values | None = None) -> tuple[str, ...]:
        """Notes for the user on a traction law with this viscous function: nothing, or that the data were fitted
        with another one (a limiting stress is no Eyring stress).

        **Arguments:** `viscous_function`, its name; `exponent`, that of "elsharkawy_hamrock".
        """
        if self.viscous_function is None:
            return ()
        if self.viscous_function != viscous_function:
            fitted = self.viscous_function
            return (f"contact.traction is {viscous_function}, the oil's rheology was fitted with {fitted}",)
        given = None if exponent is None else known(exponent)
        if given is None or self.exponent in (None, given[0]):
            return ()
        return (f"contact.traction has the exponent {given[0]:g}, the oil's rheology {self.exponent:g}",)

    def log_shear_modulus(self, pressure: Values, temperature: Values) -> Batch:
        """ln of the shear modulus in Pa. **Arguments:** `pressure`, Pa; `temperature`, K, > 0."""
        require_temperature(temperature)
        inverse = 1.0 / temperature - 1.0 / self.reference_temperature
        exponent = self.shear_modulus_pressure * pressure + self.shear_modulus_temperature * inverse
        return jnp.log(self.shear_modulus) + jnp.clip(exponent, -EXPONENT_CAP, EXPONENT_CAP)

    def log_stress(self, pressure: Values, temperature: Values) -> Batch:
        """ln of the characteristic stress in Pa. **Arguments:** `pressure`, Pa; `temperature`, K, > 0."""
        require_temperature(temperature)
        inverse = 1.0 / temperature - 1.0 / self.reference_temperature
        exponent = self.stress_pressure * pressure + self.stress_temperature * inverse
        return jnp.log(self.stress) + jnp.clip(exponent, -EXPONENT_CAP, EXPONENT_CAP)


ExponentialRheology.__init__.__doc__ = """**Arguments:**
- `reference_temperature`: T_0, K, > 0.
- `shear_modulus`: G_0, Pa, > 0.
- `shear_modulus_pressure`: alpha_G, 1/Pa.
- `shear_modulus_temperature`: beta_G, K.
- `stress`: tau_00, Pa, > 0.
- `stress_pressure`: alpha_tau, 1/Pa.
- `stress_temperature`: beta_tau, K.
- `viscous_function`: name in `VISCOUS_FUNCTIONS` of the flow law that the data were fitted with, or None: not known.
- `exponent`: that flow law's exponent n, > 0; for "elsharkawy_hamrock" only.
"""
