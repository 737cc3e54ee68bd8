"""Rolling resistance of point contacts: one moment per contact, a couple between the two bodies."""

import abc
from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.safe import log_add, smooth_abs, smooth_sign, softplus
from .film import LOG_2
from .line import SPEED_FLOOR, log_entrainment_sum, log_material_number
from .point import PointContact
from .rolling import RollingInlet
from .rolling_heating import AIHARA, FILM_TEMPERATURE

MOMENT_LOAD_WIDTH = 1e-2
"""Smoothing of the load in the lever arm of the moment, N."""
WIDTH_JOINT = 40.0
"""Exponent of the smooth minimum of 1 and the ratio of ellipse width to race width."""


class AbstractPointRollingResistance(eqx.Module):
    """Moment M against the rolling of two bodies in a point contact; its power is M times the relative roll rate."""

    name: ClassVar[str]
    """Name in scene files and on the screen."""
    own_heating: ClassVar[str]
    """Default inlet heating of the law, one of `rolling_heating.HEATINGS`; a scene may name the other."""

    @abc.abstractmethod
    def moment(self, contact: PointContact, inlet: RollingInlet) -> Float[Array, "..."]:
        """M, N m, with the sign of the entrainment speed. **Arguments:** `contact`, the two bodies; `inlet`."""


class SourceRollingResistance(AbstractPointRollingResistance):
    r"""The source's law: $M = Q\delta'$, $\delta' = 4.25\,a\,g_V^{0.022}g_E^{-0.35}(c/a)^{0.91}$.

    $g_V = GW^3/U^2$, $g_E = W^{8/3}/U^2$, $U = \mu u/(E'R_x)$ with u the *mean* speed, $G = \alpha E'$,
    $W = Q/(E'R_x^2)$: the pressure of the film acts $\delta'$ ahead of the centre.

    **Limits:** grows as $Q^{0.47}u^{0.656}$; 0 at load 0 and at rest, with finite slopes: in $\delta'$ the load is
    smoothed to $\sqrt{Q^2 + Q_\epsilon^2}$, $Q_\epsilon$ = 0.01 N (relative error 0.27 $(Q_\epsilon/Q)^2$), the speed
    levels off at 0.5e-6 m/s and alpha at 1e-25 1/Pa.
    **Validity:** elastohydrodynamic contacts. At 5 to 40 m/s and c/a = 1 to 9 it is 0.64 to 1.22 times
    `BibouletHoupertPointRollingResistance` at p0 = 1.5 to 2.2 GPa, and 0.46 to 0.85 times it at 1 GPa.
    **Reference:** source eqs. (86)-(87); the exponents are those of Houpert (1987).
    """

    name: ClassVar[str] = "source_86"
    own_heating: ClassVar[str] = FILM_TEMPERATURE

    def moment(self, contact: PointContact, inlet: RollingInlet) -> Float[Array, "..."]:
        stiffness = contact.reduced_modulus * contact.reduced_radius_rolling
        pressing = smooth_abs(inlet.load, MOMENT_LOAD_WIDTH)
        log_speed = log_entrainment_sum(inlet.speed) - LOG_2 + jnp.log(inlet.viscosity) - jnp.log(stiffness)
        log_material = log_material_number(inlet.pressure_viscosity, contact.reduced_modulus)
        log_load = jnp.log(pressing) - jnp.log(stiffness * contact.reduced_radius_rolling)
        log_viscous = log_material + 3.0 * log_load - 2.0 * log_speed
        log_elastic = 8.0 / 3.0 * log_load - 2.0 * log_speed
        ellipse = contact.ellipse(pressing)
        log_shape = 0.09 * jnp.log(ellipse.rolling) + 0.91 * jnp.log(ellipse.transverse)
        arm = 4.25 * jnp.exp(log_shape + 0.022 * log_viscous - 0.35 * log_elastic)
        return inlet.load * arm * smooth_sign(inlet.speed, SPEED_FLOOR)


def point_rolling_moment(
    contact: PointContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
) -> Float[Array, "..."]:
    """Moment of `SourceRollingResistance`, N m; deprecated, the next release removes this function.

    **Arguments:** `contact`, the two bodies; `load`, N, >= 0; `entrainment_speed`, (u1 + u2)/2, m/s, signed;
    `viscosity`, Pa s, and `pressure_viscosity`, 1/Pa, >= 0, of the oil in the inlet.
    """
    # the law does not use the film
    inlet = RollingInlet(load, entrainment_speed, viscosity, pressure_viscosity, jnp.nan)
    return SourceRollingResistance().moment(contact, inlet)


class BibouletHoupertPointRollingResistance(AbstractPointRollingResistance):
    r"""Biboulet and Houpert's point contact: $M = R_xP$, $P = 2fCE'R_x^2$.

    $f = \frac{2c}{R_x}\frac{f_R + f_EM_p/6.6}{1 + M_p/6.6}U^{3/4}$, $f_R = 0.77\beta^{-1/3}\kappa^{0.12}U^{-1/12}$,
    $f_E = 1.8\beta^{-1/4}$, with $\kappa = a/c$, $U = 2\mu u/(E'R_x)$, $W = Q/(E'R_x^2)$,
    $M_p = \beta^{1/4}\kappa WU^{-3/4}$, $\beta = \frac4\pi E(1 - \kappa^2)/(1 + R_x/R_y)$ (E: complete elliptic
    integral). f is the force on one surface. A race of the width $L_r$ cuts off the film beside it, a factor
    $C = 1/[1 + (1/c_0 - 1)s^n]$, $n = (2 - \kappa)(0.0018M_p + 1.33)$, $c_0 = 0.85/(1 +
    4.72M_p^{-0.39}\kappa^{0.484M_p^{0.165}})$, s the smaller of 1 and $2c/L_r$; C = 1 without a race width.

    **Limits:** rigid and isoviscous as $M_p\to0$. $P = Q\,P(Q_e)/Q_e$, $Q_e = \sqrt{Q^2 + Q_\epsilon^2}$,
    $Q_\epsilon$ = 0.01 N: 0 without load, with a finite slope. |u| is smoothed to $\sqrt{u^2 + u_\epsilon^2}$,
    $u_\epsilon$ = 1e-6 m/s, and the sign of the moment to $u/\sqrt{u^2 + u_\epsilon^2}$. s is
    $x/(1 + x^{40})^{1/40}$, x = $2c/L_r$.
    **Validity:** flooded, isothermal, ellipses at most as long along rolling as across it ($\kappa\le1$). For longer
    ones there is no law: $\kappa$ = 1 and $\beta$ = 1 are used, with the actual c of the ellipse. The line law summed
    over strips of the ellipse gives 0.81 to 0.87 of this moment at p0 = 1.5 to 2.2 GPa: 26 % of the moment arises
    outside the ellipse, where there are no strips.
    **Reference:** Biboulet and Houpert (2010), Proc. IMechE J 224, part 2, eqs. (14), (31), (32), (35), (36).
    """

    race_width: Values | None = None
    name: ClassVar[str] = "biboulet_houpert"
    own_heating: ClassVar[str] = AIHARA

    def moment(self, contact: PointContact, inlet: RollingInlet) -> Float[Array, "..."]:
        radius, modulus = contact.reduced_radius_rolling, contact.reduced_modulus
        pressing = smooth_abs(inlet.load, MOMENT_LOAD_WIDTH)
        log_stiffness = jnp.log(modulus) + jnp.log(radius)
        speed = smooth_abs(inlet.speed, SPEED_FLOOR)
        log_speed = LOG_2 + jnp.log(inlet.viscosity) + jnp.log(speed) - log_stiffness
        log_load = jnp.log(pressing) - jnp.log(radius) - log_stiffness
        log_kappa, log_beta = _shape(contact)
        log_number = 0.25 * log_beta + log_kappa + log_load - 0.75 * log_speed
        rigid = 0.77 * jnp.exp(-log_beta / 3.0 + 0.12 * log_kappa - log_speed / 12.0)
        elastic = 1.8 * jnp.exp(-0.25 * log_beta)
        share = jnp.exp(-softplus(log_number - jnp.log(6.6)))  # 1/(1 + M_p/6.6)
        width = 2.0 * contact.ellipse(pressing).transverse
        force = width / radius * (rigid * share + elastic * (1.0 - share)) * jnp.exp(0.75 * log_speed)
        if self.race_width is not None:
            force = force * _race_share(log_kappa, log_number, width / self.race_width)
        moment = 2.0 * force * modulus * radius**3
        return inlet.load * moment / pressing * smooth_sign(inlet.speed, SPEED_FLOOR)


BibouletHoupertPointRollingResistance.__init__.__doc__ = """**Arguments:**
- `race_width`: L_r, width of the narrower body across rolling, m, > 0; `None`: wider than the pressure of the film.
"""


def _shape(contact: PointContact) -> tuple[Array, Array]:
    """Logarithms of kappa = a/c and of beta; both 0 for an ellipse that is longer along rolling than across it."""
    log_kappa = -jnp.log(contact.ellipticity())
    wide = log_kappa <= 0.0
    log_kappa = jnp.where(wide, log_kappa, 0.0)
    log_ratio = jnp.log(contact.reduced_radius_rolling) - jnp.log(contact.reduced_radius_transverse)
    log_beta = jnp.log(4.0 / jnp.pi) + contact.log_second_kind() - softplus(log_ratio)
    return log_kappa, jnp.where(wide, log_beta, 0.0)


def _race_share(log_kappa: Array, log_number: Array, ratio: Array) -> Array:
    """Factor C of a race of finite width; `ratio` is ellipse width over race width, 2c/L_r."""
    kappa, number = jnp.exp(log_kappa), jnp.exp(log_number)
    log_narrow = jnp.log(4.72) - 0.39 * log_number + 0.484 * jnp.exp(0.165 * log_number) * log_kappa
    log_excess = log_add(jnp.log(0.15), log_narrow) - jnp.log(0.85)  # of 1/c_0 over 1
    log_ratio = jnp.log(ratio) - softplus(WIDTH_JOINT * jnp.log(ratio)) / WIDTH_JOINT
    return jnp.exp(-softplus(log_excess + (2.0 - kappa) * (0.0018 * number + 1.33) * log_ratio))
