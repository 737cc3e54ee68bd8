r"""The pressure-viscosity coefficient that film formulas ask for.

It is the reciprocal isoviscous pressure, $1/\alpha^* = \int_0^\infty \mu(0,T)/\mu(p,T)\,dp$, and not the tangent
at p = 0, which is larger: 26.1 instead of 20.3 1/GPa for Mobil Jet II at 0 C.
"""

import abc
from typing import ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import Checked, bounded
from ..numerics.compiling import compiled_by_hand
from ..numerics.quadrature import gauss_legendre
from ..numerics.safe import softplus_floor
from .simple_viscosity import ISOVISCOUS
from .viscosity import AbstractViscosity

SUBSTITUTION_SCALES = 4.0
"""Scale P of the substitution p = P t/(1 - t), in units of the `pressure_scale` of the viscosity law."""
NODES = 32
"""Number of Gauss-Legendre nodes: relative error <= 1e-8 for the four oils of the source on -20 to 150 C, < 1e-12 for
the laws of Barus and Roelands."""
FIT_MARGIN = 50.0
"""Smallest distance, K, of the temperature from the pole of the fitted form; colder temperatures are clamped."""
FIT_WIDTH = 1.0
"""Smoothing width of that clamp, K: 57 K above the clamp (243 K for Mobil Jet II) T is exact to round-off."""


class AbstractPressureViscosity(Checked):
    """Pressure-viscosity coefficient of a lubricant as a function of temperature."""

    part: ClassVar[str] = "oil.pressure_viscosity"

    @abc.abstractmethod
    def coefficient(self, temperature: Values) -> Batch:
        """Reciprocal isoviscous pressure, 1/Pa, > 0 (0 for an isoviscous fluid only).

        **Arguments:** `temperature`, K, > 0, at the contact inlet.
        """


class ConstantPressureViscosity(AbstractPressureViscosity):
    """The same coefficient at every temperature.

    **Validity:** a baseline; the coefficient of real oils halves between 0 and 100 C.
    """

    value: Scalar = bounded(">= 0", unit="1/Pa")

    def coefficient(self, temperature: Values) -> Batch:
        require_temperature(temperature)
        return jnp.full(jnp.shape(temperature), self.value, dtype=float)


ConstantPressureViscosity.__init__.__doc__ = """**Arguments:**
- `value`: 1/Pa, >= 0; a fluid without one has `NoPressureViscosity`.
"""


class FittedPressureViscosity(AbstractPressureViscosity):
    r"""Closed form in temperature.

    $\alpha^* = \alpha_\infty + A_{00}/T + A_{01}/T^2 + A_{10}/(T - T_c) + A_{11}/(T - T_c)^2$.

    **Validity:** $T > T_c + 50$ K. Below, T is clamped smoothly (width 1 K), so the coefficient levels off. The
    coefficients of the source for three oils follow the integral within 0.04, 0.03 and 0.23 % on -30 to 300 C;
    those of Mobil Jet II are our own fit (0.003 % on -20 to 200 C), since the source's own are illegible.
    **Reference:** source eq. (93) and table 11.
    """

    offset: Scalar = bounded("finite", unit="1/Pa")
    a00: Scalar = bounded("finite", unit="K/Pa")
    a01: Scalar = bounded("finite", unit="K^2/Pa")
    pole_temperature: Scalar = bounded("> 0", unit="K")
    a10: Scalar = bounded("finite", unit="K/Pa")
    a11: Scalar = bounded("finite", unit="K^2/Pa")

    def coefficient(self, temperature: Values) -> Batch:
        require_temperature(temperature)
        t = softplus_floor(temperature, self.pole_temperature + FIT_MARGIN, FIT_WIDTH)
        above_pole = t - self.pole_temperature
        regular = self.offset + (self.a00 + self.a01 / t) / t
        return jnp.asarray(regular + (self.a10 + self.a11 / above_pole) / above_pole)


FittedPressureViscosity.__init__.__doc__ = """**Arguments:**
- `offset`: alpha_inf, 1/Pa.
- `a00`: K/Pa.
- `a01`: K^2/Pa.
- `pole_temperature`: T_c, K; glass temperature minus C2 of the viscosity law.
- `a10`: K/Pa.
- `a11`: K^2/Pa.
"""


class NoPressureViscosity(AbstractPressureViscosity):
    """The coefficient 0 of an isoviscous fluid (water, kerosene)."""

    def coefficient(self, temperature: Values) -> Batch:
        require_temperature(temperature)
        return jnp.zeros(jnp.shape(temperature))


class IntegratedPressureViscosity(AbstractPressureViscosity):
    r"""Integral $1/\alpha^* = \int_0^{p_{lim}} \mu(0,T)/\mu(p,T)\,dp$, by 32 Gauss-Legendre nodes in $t = p/(P + p)$.

    The upper limit is `pressure_limit(T)` of the viscosity law, not infinity: beyond F = 0 the printed modified WLF
    law falls again and would add a spurious branch. P is four times `pressure_scale(T)` of the viscosity law. Automatic
    differentiation treats the limit and P as constants. For the modified WLF law the integrand at the limit is
    <= 2.5e-7 on -20 to 164 C.

    **Limits:** $\alpha$ for Barus' law.
    **Validity:** relative error <= 1e-8 for the modified WLF law on -20 to 150 C, < 1e-6 for the others; finite at
    every temperature, but meaningless if the viscosity at ambient pressure is already near the cap.
    **Reference:** source eq. (77); Blok's inverse isoviscous asymptotic pressure (1963).
    """

    viscosity: AbstractViscosity

    def __check_init__(self):
        super().__check_init__()
        if isinstance(self.viscosity, ISOVISCOUS):
            raise ValueError(
                "pressure_viscosity: a constant viscosity, the same at every pressure, has no coefficient to "
                "integrate; use NoPressureViscosity"
            )

    def coefficient(self, temperature: Values) -> Batch:
        require_temperature(temperature)
        nodes, weights = gauss_legendre(NODES)
        temperature = jnp.asarray(temperature, dtype=float)
        return _integrated(self.viscosity, temperature, jnp.asarray(nodes), jnp.asarray(weights))


@compiled_by_hand
def _integrated(
    viscosity: AbstractViscosity, temperature: Batch, nodes: Float[Array, " node"], weights: Float[Array, " node"]
) -> Batch:
    limit = viscosity.pressure_limit(temperature)
    scale = SUBSTITUTION_SCALES * viscosity.pressure_scale(temperature)
    trailing = (1,) * temperature.ndim + nodes.shape
    end, scale = (limit / (scale + limit))[..., None], scale[..., None]
    t = end * nodes.reshape(trailing)
    pressure = scale * t / (1.0 - t)
    jacobian = scale / jnp.square(1.0 - t)
    ambient = viscosity.log_viscosity(0.0, temperature)[..., None]
    ratio = jnp.exp(ambient - viscosity.log_viscosity(pressure, temperature[..., None]))
    integral = jnp.sum(end * weights.reshape(trailing) * ratio * jacobian, axis=-1)
    return 1.0 / integral


IntegratedPressureViscosity.__init__.__doc__ = """**Arguments:**
- `viscosity`: the law that is integrated; not one of `ISOVISCOUS`, whose coefficient is `NoPressureViscosity`.
"""
