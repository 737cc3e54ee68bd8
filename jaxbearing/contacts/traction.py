"""Traction of a lubricated line contact: the tangential force of the film on the surfaces."""

import abc

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import Lubricant
from ..numerics.safe import log_add
from ..numerics.structure import switch
from .film import LOG_2
from .line import LineContact, log_entrainment_sum
from .viscous import AbstractViscousFunction, ReeEyring, viscous_function_for, viscous_notes

INLET_COUETTE_CONSTANT = 2.01435
r"""Integral $\int dx/h$ from the inlet to the Reynolds exit in units of $\sqrt{2R/h}$: pi/2 plus the exit angle of the
rigid isoviscous film, 25.415 degrees (Martin 1916)."""


class AbstractTraction(eqx.Module):
    """Traction force of a line contact, odd and increasing in the sliding speed."""

    @abc.abstractmethod
    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        temperature: Values,
        lubricant: Lubricant,
        viscosity_inlet: Values,
    ) -> Float[Array, "..."]:
        """Force, N, of the sign of the sliding speed: it brakes the faster surface and drives the slower one.

        **Arguments:**
        - `contact`: the two cylinders.
        - `load`: N, >= 0.
        - `film`: film thickness, m, > 0.
        - `entrainment_speed`: (u1 + u2)/2, m/s, of either sign.
        - `sliding_speed`: u1 - u2, m/s.
        - `temperature`: of the oil in the contact, K.
        - `lubricant`: its laws of viscosity and rheology.
        - `viscosity_inlet`: at the inlet temperature and ambient pressure, Pa s.
        """

    def notes(self, lubricant: Lubricant) -> tuple[str, ...]:
        """Notes for the user about the use of this law with this oil, one sentence each."""
        return ()


class MeanPressureTraction(AbstractTraction):
    r"""Viscous flow at the mean pressure with a Maxwell correction for the transit time, plus inlet shear.

    $F = \tau_0\,F^{-1}\!\left(\frac{\mu_l\,\Delta u}{h\tau_0}\right) 2 b\ell
    + 2.01435\,\mu_{in}\,\Delta u\,\ell\sqrt{2R/h}$, $\;1/\mu_l = 1/\mu(\bar p, T) + u/(G b)$:
    the oil crosses the contact in about b/u, and a glassy oil, which relaxes more slowly, acts with G b/u in place of
    its viscosity. $F^{-1}$ is the inverse of the viscous function (asinh for Ree-Eyring), by default of the one that
    the oil's rheology was fitted with. Without `elastic` it is the viscous limit, $\mu_l = \mu$.

    **Limits:** for small $\Delta u$ linear with slope $2b\ell\mu_l/h$ plus the inlet term (Newton's law if G is large);
    for large $\Delta u$ the area $2b\ell$ times $\tau_0\ln(2x)$ (Ree-Eyring, x the argument of $F^{-1}$) or times the
    limiting stress (the others), plus the inlet term; at load 0 the inlet term alone.
    **Validity:** isothermal; the mean pressure for the whole contact; increasing in sliding, so without the thermal
    fall of traction at high sliding. Rheology fits hold for 0.6 to 1.8 GPa, and each only with the viscous function
    that it was made with.
    **Reference:** Johnson and Tevaarwerk (1977), Proc. R. Soc. A 356, 215 (Maxwell-Eyring model); Houpert (1985), ASME
    J. Tribology 107, 241 (one mean pressure per contact); rheology of the source, eqs. (78)-(79), viscous limit
    eqs. (82)-(83).
    """

    viscous: AbstractViscousFunction | None = None
    elastic: bool = switch("elastic", True)

    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        temperature: Values,
        lubricant: Lubricant,
        viscosity_inlet: Values,
    ) -> Float[Array, "..."]:
        if lubricant.rheology is None:
            raise ValueError(
                "The traction law needs the lubricant's rheology (shear modulus and stress): none is given."
            )
        half_width = contact.half_width(load)
        pressure = contact.mean_pressure(load)
        log_viscosity = lubricant.viscosity.log_viscosity(pressure, temperature)
        log_stress = lubricant.rheology.log_stress(pressure, temperature)

        if self.elastic:
            log_modulus = lubricant.rheology.log_shear_modulus(pressure, temperature)
            log_mean_speed = log_entrainment_sum(entrainment_speed) - LOG_2
            log_elastic = log_mean_speed - log_modulus - jnp.log(half_width)
            log_viscosity = -log_add(-log_viscosity, log_elastic)
        log_scale = log_viscosity - jnp.log(film) - log_stress
        viscous = viscous_function_for(self.viscous, lubricant)
        stress_ratio = viscous.stress_ratio_of_scaled(log_scale, sliding_speed)
        pressed = jnp.exp(log_stress) * stress_ratio * 2.0 * half_width * contact.length

        return pressed + inlet_shear(contact, film, sliding_speed, viscosity_inlet)

    def notes(self, lubricant: Lubricant) -> tuple[str, ...]:
        return viscous_notes(self.viscous, lubricant)


MeanPressureTraction.__init__.__doc__ = """**Arguments:**
- `viscous`: the viscous function; None: the one with which the oil's rheology was fitted (Ree and Eyring's where the
  oil does not say).
- `elastic`: whether the shear modulus limits the answer in transit.
"""


def MaxwellEyring(elastic: bool = True) -> MeanPressureTraction:
    """Mean-pressure traction with Ree and Eyring's viscous function, whatever the oil's rheology was fitted with."""
    return MeanPressureTraction(ReeEyring(), elastic)


def inlet_shear(contact: LineContact, film: Values, sliding_speed: Values, viscosity: Values) -> Float[Array, "..."]:
    r"""Shear force of the converging film at the inlet of a line contact, N: $2.01435\,\mu\,\Delta u\,\ell\sqrt{2R/h}$.

    **Arguments:** `film`, m, > 0; `sliding_speed`, m/s; `viscosity`, Pa s, at the inlet temperature.
    """
    span = contact.length * jnp.sqrt(2.0 * contact.reduced_radius / film)
    return INLET_COUETTE_CONSTANT * viscosity * sliding_speed * span
