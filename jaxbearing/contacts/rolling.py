"""Rolling resistance: the film pressure, displaced towards the inlet, opposes the rolling of both surfaces."""

import abc
from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.safe import smooth_abs, smooth_sign
from .film import LOG_2
from .line import (
    PRESSURE_VISCOSITY_FLOOR,
    SPEED_FLOOR,
    LineContact,
    log_entrainment_sum,
    log_material_number,
)
from .point import PointContact

RIGID_CONSTANT = 6.506905
r"""$\int h\,dp$ of a rigid isoviscous film in units of $\mu u\sqrt{2R/h}$ (Martin 1916):
$12(\beta - I_2/\sin^2\beta)$ at the Reynolds exit."""
INLET_CONSTANT = 6.532471
r"""$\int(h - h_c)\,dp$ over a piezoviscous inlet in units of $h_c/\alpha$, with the gap $h_c(1 + \xi^{3/2})$ next to a
Hertz zone long against the inlet; 6.2 at an inlet a tenth as long as the half-width."""
MOMENT_LOAD_WIDTH = 1e-2
"""Smoothing of the load that shapes the moment arm of a point contact, N."""
LIGHT_LOAD = 1.2
"""Moes' load number at which the rigid law and Ertel and Grubin's count alike."""


class AbstractRollingResistance(eqx.Module):
    r"""The rolling force $P = \ell\int h\,(dp/dx)\,dx$ of a line contact, x along the entrainment.

    The pressure flow drags each surface with P/2 against the entrainment, and the pressure pushes body k (radius R_k,
    reduced radius R) with P R/R_k along it. Together they dissipate P u, u the mean speed.
    """

    piezoviscous_only: ClassVar[bool]
    """True if the law means nothing for an oil whose viscosity does not rise with pressure."""

    @abc.abstractmethod
    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        """P, N, of the sign of the entrainment speed.

        **Arguments:**
        - `contact`: the two cylinders.
        - `load`: N, >= 0.
        - `film`: film thickness, m, > 0 (`ContactLaws` passes that of its film law; each law says which it means).
        - `entrainment_speed`: mean surface speed (u1 + u2)/2 relative to the contact, m/s, signed.
        - `viscosity`: of the oil in the inlet, at ambient pressure, Pa s.
        - `pressure_viscosity`: reciprocal isoviscous pressure in the inlet, 1/Pa, >= 0.
        """


class RigidRollingResistance(AbstractRollingResistance):
    r"""Rigid cylinders, isoviscous oil: $P = 6.506905\,\mu u\ell\sqrt{2R/h}$.

    **Limits:** linear in the speed at a given film.
    **Validity:** isoviscous oil, h the minimum film: then exact for rigid cylinders and within 4 % of own full
    solutions for elastic ones. A piezoviscous oil makes a thicker film and, at that film, 30 to 55 % more resistance
    than this law. An upper bound is only $4.16\sqrt{\mu u\ell Q}$, this law at the film of rigid cylinders under the
    same load.
    **Reference:** Martin (1916), Engineering 102, 119.
    """

    piezoviscous_only: ClassVar[bool] = False

    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        span = contact.length * jnp.sqrt(2.0 * contact.reduced_radius / film)
        return RIGID_CONSTANT * viscosity * entrainment_speed * span


class ErtelGrubinRollingResistance(AbstractRollingResistance):
    r"""Piezoviscous inlet of an elastic contact: $P = 6.532471\,\ell h_c/\alpha$, with the sign of the speed.

    **Limits:** the sign is $u/\sqrt{u^2 + u_\epsilon^2}$, $u_\epsilon$ = 1e-6 m/s: smooth at rest.
    **Validity:** the elastic-piezoviscous regime only: 1, 11 and 25 % above own full solutions of a turbine bearing's
    contact at M = 24, 10 and 4 (L = 9.5), and unbounded as alpha -> 0, which is floored at 1e-25 1/Pa. h is the
    *central* film.
    **Reference:** own derivation with the inlet of Ertel and Grubin (1949).
    """

    piezoviscous_only: ClassVar[bool] = True

    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        coefficient = pressure_viscosity + PRESSURE_VISCOSITY_FLOOR
        return INLET_CONSTANT * contact.length * film / coefficient * smooth_sign(entrainment_speed, SPEED_FLOOR)


class JoinedRollingResistance(AbstractRollingResistance):
    r"""The rigid law at light load, Ertel and Grubin's under load: $P = (P_R M_0^2 + P_{EG} M^2)/(M_0^2 + M^2)$.

    M is Moes' load number, $Q/(\ell E' R)\,[\mu(u_1 + u_2)/(E'R)]^{-1/2}$, $M_0 = 1.2$.

    **Limits:** the rigid law as Q -> 0, Ertel and Grubin's at M >> 1.
    **Validity:** a piezoviscous oil, h the *central* film. Within -2 and +21 % of full solutions of the isothermal
    contact at M = 1.2 to 24, L = 6.7 to 9.5.
    **Reference:** the two laws; the interpolation is ours.
    """

    piezoviscous_only: ClassVar[bool] = True

    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        arguments = (contact, load, film, entrainment_speed, viscosity, pressure_viscosity)
        rigid, loaded = RigidRollingResistance().force(*arguments), ErtelGrubinRollingResistance().force(*arguments)
        stiffness = contact.reduced_modulus * contact.reduced_radius
        speed_number = viscosity * smooth_abs(2.0 * entrainment_speed, SPEED_FLOOR) / stiffness
        square = jnp.square(load / (contact.length * stiffness * LIGHT_LOAD)) / speed_number
        return (rigid + square * loaded) / (1.0 + square)


def point_rolling_moment(
    contact: PointContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
) -> Float[Array, "..."]:
    r"""Moment of a point contact that opposes the rolling of the two bodies, N m, of the sign of the entrainment speed.

    $M = Q\delta'$, $\delta' = 4.25\,a\,g_V^{0.022}g_E^{-0.35}(c/a)^{0.91}$, $g_V = GW^3/U^2$, $g_E = W^{8/3}/U^2$,
    $U = \mu u/(E'R_x)$ with u the *mean* speed, $G = \alpha E'$, $W = Q/(E'R_x^2)$: the pressure of the film acts
    $\delta'$ ahead of the centre. One moment per contact, the couple between the bodies: it takes the power of their
    relative roll rate.

    **Limits:** grows as $Q^{0.47}u^{0.656}$; 0 at load 0 and at rest, with finite slopes: the load inside
    $\delta'$ counts as $\sqrt{Q^2 + Q_\epsilon^2}$, $Q_\epsilon$ = 0.01 N (relative error 0.27 $(Q_\epsilon/Q)^2$),
    the speed levels off at 0.5e-6 m/s, alpha at 1e-25 1/Pa.
    **Validity:** elastohydrodynamic contacts; about 30 % (twice Houpert's rolling force times R_x within 3 % for a
    circle, 1.7 times it at c/a = 8).
    **Reference:** source eqs. (86)-(87); Houpert (1987), whose exponents it has.

    **Arguments:** `contact`, the two bodies; `load`, N, >= 0; `entrainment_speed`, (u1 + u2)/2, m/s, signed;
    `viscosity`, Pa s, and `pressure_viscosity`, 1/Pa, >= 0, of the oil in the inlet.
    """
    stiffness = contact.reduced_modulus * contact.reduced_radius_rolling
    pressing = smooth_abs(load, MOMENT_LOAD_WIDTH)
    log_speed = log_entrainment_sum(entrainment_speed) - LOG_2 + jnp.log(viscosity) - jnp.log(stiffness)
    log_material = log_material_number(pressure_viscosity, contact.reduced_modulus)
    log_load = jnp.log(pressing) - jnp.log(stiffness * contact.reduced_radius_rolling)
    log_viscous = log_material + 3.0 * log_load - 2.0 * log_speed
    log_elastic = 8.0 / 3.0 * log_load - 2.0 * log_speed
    ellipse = contact.ellipse(pressing)
    log_shape = 0.09 * jnp.log(ellipse.rolling) + 0.91 * jnp.log(ellipse.transverse)
    arm = 4.25 * jnp.exp(log_shape + 0.022 * log_viscous - 0.35 * log_elastic)
    return load * arm * smooth_sign(entrainment_speed, SPEED_FLOOR)
