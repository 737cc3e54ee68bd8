"""Shear modulus and characteristic shear stress of a lubricant under contact pressure."""

import abc
from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import Checked, bounded, known
from ..numerics.safe import smooth_abs
from ..numerics.structure import choice, constant

EXPONENT_CAP = 60.0
"""Largest exponent of `ExponentialRheology`, +-60 (26 decades); beyond, the law is constant and its gradient 0."""

PRESSURE_FLOOR = 1e7
"""Pressure p_f of `ProportionalRheology`, Pa, added in squares: it keeps modulus and stress above 0 in an unloaded
contact. It raises them by 0.5 % at 0.1 GPa, by 0.005 % at 1 GPa."""

VISCOUS_FUNCTIONS = ("ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock")
"""Names of the flow laws with which shear modulus and stress may have been fitted."""


class AbstractRheology(Checked):
    """Shear modulus and characteristic stress of a lubricant, as natural logarithms.

    The stress is an Eyring stress or a limiting stress, depending on `viscous_function`, the flow law with which the
    data were fitted. With another flow law the same numbers give another traction.
    """

    part: ClassVar[str] = "oil.rheology"

    viscous_function: eqx.AbstractVar[str | None]
    exponent: eqx.AbstractVar[float | None]

    @abc.abstractmethod
    def log_shear_modulus(self, pressure: Values, temperature: Values) -> Batch:
        """Natural logarithm of the shear modulus in Pa. **Arguments:** `pressure`, Pa; `temperature`, K, > 0."""

    @abc.abstractmethod
    def log_stress(self, pressure: Values, temperature: Values) -> Batch:
        """Natural logarithm of the stress in Pa. **Arguments:** `pressure`, Pa; `temperature`, K, > 0."""

    def misfit(self, viscous_function: str, exponent: Values | None = None) -> tuple[str, ...]:
        """Note for the user if a traction law has another flow law, or another exponent, than the fit of the data (a
        limiting stress is not an Eyring stress); else empty.

        **Arguments:** `viscous_function`: name of the flow law of the traction law; `exponent`: of
        "elsharkawy_hamrock".
        """
        if self.viscous_function is None:
            return ()
        if self.viscous_function != viscous_function:
            fitted = self.viscous_function
            return (f"contact.traction is {viscous_function}, the oil's rheology was fitted with {fitted}",)
        law_exponent = None if exponent is None else known(exponent)
        if law_exponent is None or self.exponent in (None, law_exponent[0]):
            return ()
        return (f"contact.traction has the exponent {law_exponent[0]:g}, the oil's rheology {self.exponent:g}",)


class ExponentialRheology(AbstractRheology):
    r"""Shear modulus and characteristic stress, exponential in pressure and in 1/temperature.

    $G = G_0\exp[\alpha_G p + \beta_G(1/T - 1/T_0)]$, $\tau = \tau_{00}\exp[\alpha_\tau p + \beta_\tau(1/T - 1/T_0)]$.

    **Limits:** $G_0$, $\tau_{00}$ at p = 0, T = T_0.
    **Validity:** the source's fits are for 0.6 to 1.8 GPa and 273 to 378 K; $G_0$ is an extrapolation to p = 0.
    $\beta_\tau < 0$ for both oils of the source: the stress *rises* with temperature, a property of the fit.
    **Reference:** source eqs. (78)-(79), tables 8 and 12.
    """

    reference_temperature: Scalar = bounded("> 0", unit="K")
    shear_modulus: Scalar = bounded("> 0", unit="Pa")
    shear_modulus_pressure: Scalar = bounded("finite", unit="1/Pa")
    shear_modulus_temperature: Scalar = bounded("finite", unit="K", difference=True)
    stress: Scalar = bounded("> 0", unit="Pa")
    stress_pressure: Scalar = bounded("finite", unit="1/Pa")
    stress_temperature: Scalar = bounded("finite", unit="K", difference=True)
    viscous_function: str | None = choice("rheology.viscous_function", VISCOUS_FUNCTIONS, None)
    exponent: float | None = constant("rheology.exponent", None, bound="> 0")

    def log_shear_modulus(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        inverse = 1.0 / temperature - 1.0 / self.reference_temperature
        exponent = self.shear_modulus_pressure * pressure + self.shear_modulus_temperature * inverse
        return jnp.log(self.shear_modulus) + jnp.clip(exponent, -EXPONENT_CAP, EXPONENT_CAP)

    def log_stress(self, pressure: Values, temperature: Values) -> Batch:
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


class ProportionalRheology(AbstractRheology):
    r"""Shear modulus and characteristic stress proportional to pressure, the same at every temperature.

    $G = g\sqrt{p^2 + p_f^2}$, $\tau = \Lambda\sqrt{p^2 + p_f^2}$ with $p_f$ = 10 MPa.

    With a limiting stress, $\Lambda$ is the largest traction coefficient that the oil can give.

    **Limits:** $gp$ and $\Lambda p$, within 0.5 % above 0.1 GPa.
    **Validity:** for oils without measured traction curves. The two fitted oils of the catalogue have a
    modulus that rises more steeply with pressure, and a stress that rises with temperature, by 35 and 46 % from 30 to
    70 C.
    """

    stress_ratio: Scalar = bounded("> 0", unit="1")
    shear_modulus_ratio: Scalar = bounded("> 0", unit="1")
    viscous_function: str | None = choice("rheology.viscous_function", VISCOUS_FUNCTIONS, None)
    exponent: float | None = constant("rheology.exponent", None, bound="> 0")

    def log_shear_modulus(self, pressure: Values, temperature: Values) -> Batch:
        return self._log_share(self.shear_modulus_ratio, pressure, temperature)

    def log_stress(self, pressure: Values, temperature: Values) -> Batch:
        return self._log_share(self.stress_ratio, pressure, temperature)

    def _log_share(self, share: Scalar, pressure: Values, temperature: Values) -> Batch:
        """Natural logarithm of `share` times the pressure in Pa, with `PRESSURE_FLOOR` added in squares."""
        require_temperature(temperature)
        shape = jnp.broadcast_shapes(jnp.shape(pressure), jnp.shape(temperature))
        return jnp.broadcast_to(jnp.log(share) + jnp.log(smooth_abs(pressure, PRESSURE_FLOOR)), shape)


ProportionalRheology.__init__.__doc__ = """**Arguments:**
- `stress_ratio`: Lambda, characteristic stress over pressure, a number > 0, about 0.03 to 0.1.
- `shear_modulus_ratio`: g, shear modulus over pressure, a number > 0.
- `viscous_function`: name in `VISCOUS_FUNCTIONS` of the flow law that the data were fitted with, or None: not known.
- `exponent`: that flow law's exponent n, > 0; for "elsharkawy_hamrock" only.
"""
