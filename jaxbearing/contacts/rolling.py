"""Rolling resistance of line contacts.

The film pressure, displaced towards the inlet, opposes the rolling of both surfaces.
"""

import abc
from typing import ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.safe import log_add, smooth_abs, smooth_sign, softplus
from .film import LOG_2
from .line import LOAD_FLOOR, PRESSURE_VISCOSITY_FLOOR, SPEED_FLOOR, LineContact
from .rolling_heating import AIHARA, FILM_TEMPERATURE

RIGID_CONSTANT = 6.506905
r"""$\int h\,dp$ of a rigid isoviscous film in units of $\mu u\sqrt{2R/h}$ (Martin 1916):
$12(\beta - I_2/\sin^2\beta)$ at the Reynolds exit, as `gaps.MARTIN_ROLLING`."""
INLET_CONSTANT = 6.532471
r"""$\int(h - h_c)\,dp$ over a piezoviscous inlet in units of $h_c/\alpha$, with the gap $h_c(1 + \xi^{3/2})$ before a
Hertz zone much longer than the inlet; 6.2 for an inlet of a tenth of the half-width."""
LIGHT_LOAD = 1.2
"""Moes' load number at which the rigid law and that of Ertel and Grubin have equal weights."""
LIGHT_LOAD_CONSTANT = RIGID_CONSTANT / 4.894968**0.5
r"""Factor C of the rigid isoviscous film, divided by $\sqrt M$: Martin's force at Martin's film."""
JOINT = 3.778
"""Exponent n of the blend of light and heavy load in `FullRangeRollingResistance`."""
LOAD_NUMBER_FLOOR = 1e-6
"""Smoothing of the load number M in the heavily loaded branch, which levels off below it."""


class RollingInlet(NamedTuple):
    """Inputs of a law of rolling resistance; a law may use only some of them.

    - `load`: N, >= 0.
    - `speed`: mean surface speed (u1 + u2)/2 relative to the contact, m/s, signed.
    - `viscosity`: of the oil in the inlet, at ambient pressure, Pa s.
    - `pressure_viscosity`: reciprocal isoviscous pressure in the inlet, 1/Pa, >= 0.
    - `film`: film thickness by the film law of the bearing, m, > 0; a law that uses it says whether it means the
      central or the minimum film.
    """

    load: Values
    speed: Values
    viscosity: Values
    pressure_viscosity: Values
    film: Values


class AbstractRollingResistance(eqx.Module):
    r"""The rolling force $P = \ell\int h\,(dp/dx)\,dx$ of a line contact, x along the entrainment.

    The pressure flow drags each surface with P/2 against the entrainment, and the pressure pushes body k (of radius
    R_k, R the reduced radius) with P R/R_k along the entrainment. Together they dissipate P u, u the mean speed.
    """

    name: ClassVar[str]
    """Name in scene files and on the screen."""
    piezoviscous_only: ClassVar[bool]
    """True if the law does not apply to an oil whose viscosity does not rise with pressure."""
    own_heating: ClassVar[str]
    """Default inlet heating of the law, one of `rolling_heating.HEATINGS`; a scene may name the other."""

    @abc.abstractmethod
    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        """P, N, with the sign of the entrainment speed. **Arguments:** `contact`, the two cylinders; `inlet`."""


class RigidRollingResistance(AbstractRollingResistance):
    r"""Rigid cylinders, isoviscous oil: $P = 6.506905\,\mu u\ell\sqrt{2R/h}$.

    **Limits:** linear in the speed at a given film.
    **Validity:** isoviscous oil, h the minimum film: then exact for rigid cylinders and within 4 % of own full
    solutions for elastic ones. A piezoviscous oil has a thicker film and, at that film, 30 to 55 % more resistance
    than this law gives. The law is no upper bound; $4.16\sqrt{\mu u\ell Q}$, its value at the film of rigid cylinders
    under the same load, is one.
    **Reference:** Martin (1916), Engineering 102, 119.
    """

    name: ClassVar[str] = "rigid_isoviscous"
    piezoviscous_only: ClassVar[bool] = False
    own_heating: ClassVar[str] = FILM_TEMPERATURE

    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        span = contact.length * jnp.sqrt(2.0 * contact.reduced_radius / inlet.film)
        return RIGID_CONSTANT * inlet.viscosity * inlet.speed * span


class ErtelGrubinRollingResistance(AbstractRollingResistance):
    r"""Piezoviscous inlet of an elastic contact: $P = 6.532471\,\ell h_c/\alpha$, with the sign of the speed.

    **Limits:** the sign is $u/\sqrt{u^2 + u_\epsilon^2}$, $u_\epsilon$ = 1e-6 m/s: smooth at rest.
    **Validity:** the elastic-piezoviscous regime only: 1, 11 and 25 % above own full solutions of a turbine bearing's
    contact at M = 24, 10 and 4 (L = 9.5), and unbounded as alpha -> 0 (1e-25 1/Pa is added to alpha). h is the
    *central* film.
    **Reference:** own derivation with the inlet of Ertel and Grubin (1949).
    """

    name: ClassVar[str] = "ertel_grubin_inlet"
    piezoviscous_only: ClassVar[bool] = True
    own_heating: ClassVar[str] = FILM_TEMPERATURE

    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        coefficient = inlet.pressure_viscosity + PRESSURE_VISCOSITY_FLOOR
        return INLET_CONSTANT * contact.length * inlet.film / coefficient * smooth_sign(inlet.speed, SPEED_FLOOR)


class JoinedRollingResistance(AbstractRollingResistance):
    r"""Rigid law at light load, Ertel and Grubin's at heavy load: $P = (P_R M_0^2 + P_{EG} M^2)/(M_0^2 + M^2)$.

    M is Moes' load number, $Q/(\ell E' R)\,[\mu(u_1 + u_2)/(E'R)]^{-1/2}$, $M_0 = 1.2$.

    **Limits:** the rigid law as Q -> 0, Ertel and Grubin's at M >> 1.
    **Validity:** a piezoviscous oil, h the *central* film. Within -2 and +21 % of full solutions of the isothermal
    contact at M = 1.2 to 24, L = 6.7 to 9.5.
    **Reference:** those of the two laws; the interpolation is our own.
    """

    name: ClassVar[str] = "ertel_grubin"
    piezoviscous_only: ClassVar[bool] = True
    own_heating: ClassVar[str] = FILM_TEMPERATURE

    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        rigid = RigidRollingResistance().force(contact, inlet)
        loaded = ErtelGrubinRollingResistance().force(contact, inlet)
        stiffness = contact.reduced_modulus * contact.reduced_radius
        speed_number = inlet.viscosity * smooth_abs(2.0 * inlet.speed, SPEED_FLOOR) / stiffness
        square = jnp.square(inlet.load / (contact.length * stiffness * LIGHT_LOAD)) / speed_number
        return (rigid + square * loaded) / (1.0 + square)


class FullRangeRollingResistance(AbstractRollingResistance):
    r"""Fit to full solutions from light to heavy load: $P = C\,\ell E'R\,U^{3/4}$, with the sign of the speed.

    $C = (C_R^{-n} + C_E^{-n})^{-1/n}$, n = 3.778, $C_R = 2.94103\sqrt M$ (Martin's rigid isoviscous film),
    $C_E = 4.1156\,M^{-0.02816}(L^2 + 4)^{-0.04105}$, $U = 2\mu u/(E'R)$, $W = Q/(\ell E'R)$, $M = W/\sqrt U$,
    $L = \alpha E'U^{1/4}$. The film thickness is not used.

    **Limits:** $4.16\sqrt{\mu u\ell Q}$ as Q -> 0. |Q| is smoothed to $\sqrt{Q^2 + Q_\epsilon^2}$, $Q_\epsilon$ = 1e-9
    N, |u| to $\sqrt{u^2 + u_\epsilon^2}$ and the sign of u to $u/\sqrt{u^2 + u_\epsilon^2}$, $u_\epsilon$ = 1e-6 m/s,
    and M in $C_E$ to $\sqrt{M^2 + 10^{-12}}$. For an isoviscous oil (L = 0) $C_E = 3.89\,M^{-0.028}$.
    **Validity:** flooded and isothermal. Within -3.0 and +3.3 % of the 48 compressible full solutions of Barus oils
    that it was fitted to (M = 0.5 to 200, L = 4 to 16, p0 < 3 GPa); 2 to 19 % below those of an incompressible oil; 3
    to 6 % below those of a Roelands oil; 10 % low at L < 1 and M >= 24; within 11 % of elastic isoviscous solutions.
    **Reference:** own fit to own full solutions; Martin (1916) at light load.
    """

    name: ClassVar[str] = "full_range"
    piezoviscous_only: ClassVar[bool] = False
    own_heating: ClassVar[str] = AIHARA

    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        groups = _groups(contact, inlet)
        log_rigid = jnp.log(LIGHT_LOAD_CONSTANT) + 0.5 * groups.log_load
        loaded = 0.5 * jnp.log(jnp.exp(2.0 * groups.log_load) + LOAD_NUMBER_FLOOR**2)
        log_elastic = jnp.log(4.1156) - 0.02816 * loaded - 0.5 * 0.0821 * jnp.log(groups.material_square + 4.0)
        log_constant = -log_add(-JOINT * log_rigid, -JOINT * log_elastic) / JOINT
        return _scaled(contact, groups, log_constant, inlet.speed)


class BibouletHoupertRollingResistance(AbstractRollingResistance):
    r"""Biboulet and Houpert's line contact: $P = C\,\ell E'R\,U^{3/4}$, with the sign of the speed.

    $C = \frac12(8/\pi)^{3/2}M^{3/2}T^*$, $T^* = 1.4M^{-1}/[1 + (\frac{1.4}{1.45}\sqrt M)^{10}]^{1/10}$; M and U as in
    `FullRangeRollingResistance`. Their force is that on one surface; P is twice as large.

    **Limits:** $C = 2.845\sqrt M$ at light load, 3 % below the rigid isoviscous film; $C = 2.946$ at heavy load. Load
    and speed are smoothed at 0 as in `FullRangeRollingResistance`.
    **Validity:** fitted for L = 4 to 16, M = 0.2 to 200, an incompressible oil. Within -16 and +5 % of own full
    solutions.
    **Reference:** Biboulet and Houpert (2010), Proc. IMechE J 224, part 1, eq. (42).
    """

    name: ClassVar[str] = "biboulet_houpert"
    piezoviscous_only: ClassVar[bool] = False
    own_heating: ClassVar[str] = AIHARA

    def force(self, contact: LineContact, inlet: RollingInlet) -> Float[Array, "..."]:
        groups = _groups(contact, inlet)
        root = 0.5 * groups.log_load
        knee = 0.1 * softplus(10.0 * (root + jnp.log(1.4 / 1.45)))
        log_constant = jnp.log(0.5 * 1.4) + 1.5 * jnp.log(8.0 / jnp.pi) + root - knee
        return _scaled(contact, groups, log_constant, inlet.speed)


class _Groups(NamedTuple):
    """Dimensionless groups ln U, ln M and L^2 of a line contact, U with the sum of both surface speeds."""

    log_speed: Array
    log_load: Array
    material_square: Array


def _groups(contact: LineContact, inlet: RollingInlet) -> _Groups:
    log_stiffness = jnp.log(contact.reduced_modulus) + jnp.log(contact.reduced_radius)
    log_speed = LOG_2 + jnp.log(inlet.viscosity) + jnp.log(smooth_abs(inlet.speed, SPEED_FLOOR)) - log_stiffness
    log_load = jnp.log(smooth_abs(inlet.load, LOAD_FLOOR)) - jnp.log(contact.length) - log_stiffness
    material = jnp.square(inlet.pressure_viscosity * contact.reduced_modulus) * jnp.exp(0.5 * log_speed)
    return _Groups(log_speed, log_load - 0.5 * log_speed, material)


def _scaled(contact: LineContact, groups: _Groups, log_constant: Array, speed: Values) -> Array:
    """Force C l E' R U^(3/4), N, with the sign of the speed."""
    size = contact.length * contact.reduced_modulus * contact.reduced_radius
    return size * jnp.exp(log_constant + 0.75 * groups.log_speed) * smooth_sign(speed, SPEED_FLOOR)
