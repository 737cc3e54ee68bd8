"""Isothermal film thickness of a lubricated line contact."""

import abc
from typing import ClassVar, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import log_add, smooth_abs
from .line import LOAD_FLOOR, LineContact, log_entrainment_sum, log_material_number

MARTIN_CONSTANT = 4.894968
"""Martin's (1916) constant h Q/(mu u R l) of a rigid cylinder in an isoviscous oil with the Reynolds exit condition,
which puts the outlet at x = sqrt(2 R h) tan(25.4 deg). It belongs to the mean speed u; for the sum u1 + u2 of the
speeds it is half as large, 2.447."""
MOES_LOAD_FLOOR = 1e-6
"""Smallest load number M of Moes. The film of an unloaded contact is then finite (H = 3/M = 3e6); the clearance limits
it, not the formula."""
LOG_2 = 0.6931471805599453


class AbstractLineFilm(Checked):
    """Film thickness of a line contact from load, speed and the oil at the inlet."""

    part: ClassVar[str] = "contact.film"
    piezoviscous_only: ClassVar[bool]
    """True if the law holds only for an oil whose viscosity rises with pressure: for others its film is about 0."""

    @abc.abstractmethod
    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        """Natural logarithm of the film thickness in m.

        **Arguments:**
        - `contact`: the two cylinders.
        - `load`: N, >= 0.
        - `entrainment_speed`: mean surface speed (u1 + u2)/2 relative to the contact, m/s; only its modulus counts.
        - `viscosity`: at the inlet temperature and ambient pressure, Pa s, > 0.
        - `pressure_viscosity`: reciprocal isoviscous pressure at the inlet temperature, 1/Pa, >= 0.
        """

    def thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        """Film thickness, m. **Arguments:** those of `log_thickness`."""
        return jnp.exp(self.log_thickness(contact, load, entrainment_speed, viscosity, pressure_viscosity))


class MoesNumbers(NamedTuple):
    r"""Dimensionless groups of Moes.

    - `load`: load number M, of a line contact $M = \frac{Q}{\ell E'R}U^{-1/2}$, of a point contact
      $M = \frac{Q}{E'R_x^2}U^{-3/4}$.
    - `material`: material number $L = \alpha E'U^{1/4}$.
    - `film_unit`: unit $RU^{1/2}$ of the film thickness, m: the dimensionless film is $H = \frac hRU^{-1/2}$.

    $U = \mu(u_1+u_2)/(E'R)$. In a point contact R is $R_x$.
    """

    load: Float[Array, "..."]
    material: Float[Array, "..."]
    film_unit: Float[Array, "..."]


class Moes(AbstractLineFilm):
    r"""Central film of a line contact in all four regimes.

    $U = \mu(u_1+u_2)/(E'R)$, $M = \frac{Q}{\ell E'R} U^{-1/2}$, $L = \alpha E' U^{1/4}$, $H = \frac{h}{R} U^{-1/2}$,
    $H^s = (H_{RI}^{7/3} + H_{EI}^{7/3})^{3s/7} + (H_{RP}^{-7/2} + H_{EP}^{-7/2})^{-2s/7}$,
    $H_{RI} = 3/M$, $H_{EI} = 2.621 M^{-1/5}$, $H_{RP} = 1.287 L^{2/3}$, $H_{EP} = 1.311 M^{-1/8}L^{3/4}$,
    $s = [7 + 8\exp(-2 H_{EI}/H_{RI})]/5$.

    **Limits:** Martin's $3/M$ as M and L -> 0; at $\alpha$ = 0 the isoviscous film, within 1e-12, because 1e-25 1/Pa
    is added to $\alpha$; Ertel-Grubin's $H_{EP}$ and Blok's $H_{RP}$ at large L.
    **Validity:** smooth surfaces, fully flooded, isothermal, Newtonian inlet. About 5 % below the source's full
    numerical solution (table 18). M is floored as $\sqrt{M^2 + 10^{-12}}$: the film of an unloaded contact is finite,
    and the caller limits it by the clearance. $u_1+u_2$ levels off at 1e-6 m/s.
    **Reference:** Moes (1992), Wear 159, 57. The source names Cheng's line formula without printing it; this one
    stands in for it.
    """

    piezoviscous_only: ClassVar[bool] = False

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_u, m, log_l = self._groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        log_m = jnp.log(smooth_abs(m, MOES_LOAD_FLOOR))

        rigid_isoviscous = jnp.log(3.0) - log_m
        elastic_isoviscous = jnp.log(2.621) - 0.2 * log_m
        rigid_piezoviscous = jnp.log(1.287) + 2.0 / 3.0 * log_l
        elastic_piezoviscous = jnp.log(1.311) - 0.125 * log_m + 0.75 * log_l

        s = (7.0 + 8.0 * jnp.exp(-2.0 * jnp.exp(elastic_isoviscous - rigid_isoviscous))) / 5.0
        isoviscous = 3.0 / 7.0 * log_add(7.0 / 3.0 * rigid_isoviscous, 7.0 / 3.0 * elastic_isoviscous)
        piezoviscous = -2.0 / 7.0 * log_add(-3.5 * rigid_piezoviscous, -3.5 * elastic_piezoviscous)
        log_h = log_add(s * isoviscous, s * piezoviscous) / s
        return log_h + 0.5 * log_u + jnp.log(contact.reduced_radius)

    def numbers(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> MoesNumbers:
        """Dimensionless groups of the contact. **Arguments:** those of `log_thickness`."""
        log_u, m, log_l = self._groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return MoesNumbers(m, jnp.exp(log_l), contact.reduced_radius * jnp.exp(0.5 * log_u))

    @staticmethod
    def _groups(
        contact: LineContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
    ) -> tuple[Array, Array, Array]:
        """Groups of Moes: ln U, M and ln L."""
        stiffness = contact.reduced_modulus * contact.reduced_radius
        log_u = log_entrainment_sum(entrainment_speed) + jnp.log(viscosity) - jnp.log(stiffness)
        m = load / (contact.length * stiffness) * jnp.exp(-0.5 * log_u)
        return log_u, m, log_material_number(pressure_viscosity, contact.reduced_modulus) + 0.25 * log_u


def _log_groups(
    contact: LineContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
) -> tuple[Array, Array, Array]:
    r"""Logarithms of $U = \mu u/(E'R)$ with the mean speed u, $G = \alpha E'$ and $W = Q/(E'R\ell)$."""
    stiffness = contact.reduced_modulus * contact.reduced_radius
    log_speed = log_entrainment_sum(entrainment_speed) - LOG_2 + jnp.log(viscosity) - jnp.log(stiffness)
    log_material = log_material_number(pressure_viscosity, contact.reduced_modulus)
    log_load = jnp.log(smooth_abs(load, LOAD_FLOOR)) - jnp.log(contact.length * stiffness)
    return log_speed, log_material, log_load


def _power_law(
    contact: LineContact,
    log_groups: tuple[Array, Array, Array],
    factor: float,
    speed: float,
    material: float,
    load: float,
) -> Float[Array, "..."]:
    """Logarithm of R factor U^speed G^material W^load."""
    log_speed, log_material, log_load = log_groups
    log_radius = jnp.log(contact.reduced_radius)
    return jnp.log(factor) + log_radius + speed * log_speed + material * log_material + load * log_load


class DowsonHigginson(AbstractLineFilm):
    r"""Minimum film of an elastohydrodynamic line contact.

    $h_{min}/R = 2.65\,U^{0.70}G^{0.54}W^{-0.13}$, $U = \mu u/(E'R)$ with u the *mean* speed, $G = \alpha E'$,
    $W = Q/(E'R\ell)$.

    **Validity:** the elastic-piezoviscous regime only: at light load the film is far too thin (see `MartinBlend`). The
    load levels off at 1e-9 N, the speed at 0.5e-6 m/s and alpha at 1e-25 1/Pa. About 4 % below the source's full
    numerical solution (table 18).
    **Reference:** Dowson and Higginson, *Elastohydrodynamic Lubrication* (1966, revised 1977).
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_groups = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return _power_law(contact, log_groups, 2.65, 0.70, 0.54, -0.13)


class DowsonToyoda(AbstractLineFilm):
    r"""Central film of an elastohydrodynamic line contact.

    $h_c/R = 3.06\,U^{0.69}G^{0.56}W^{-0.10}$, groups as in `DowsonHigginson`.

    **Validity:** the elastic-piezoviscous regime only, with the floors of `DowsonHigginson`. In the source's two
    contacts 4 and 0.1 % below the full numerical solution (table 18).
    **Reference:** Dowson and Toyoda (1979), Proc. 5th Leeds-Lyon Symposium, 60.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_groups = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return _power_law(contact, log_groups, 3.06, 0.69, 0.56, -0.10)


class PanHamrockCentral(AbstractLineFilm):
    r"""Central film of an elastohydrodynamic line contact.

    $h_c/R = 2.922\,U^{0.692}G^{0.470}W^{-0.166}$, groups as in `DowsonHigginson`.

    **Validity:** the elastic-piezoviscous regime only, with the floors of `DowsonHigginson`. A quarter below the
    source's full numerical solution (table 18).
    **Reference:** Pan and Hamrock (1989), ASME J. Tribology 111, 246.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_groups = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return _power_law(contact, log_groups, 2.922, 0.692, 0.470, -0.166)


class PanHamrockMinimum(AbstractLineFilm):
    r"""Minimum film of an elastohydrodynamic line contact.

    $h_{min}/R = 1.714\,U^{0.694}G^{0.568}W^{-0.128}$, groups as in `DowsonHigginson`.

    **Validity:** the elastic-piezoviscous regime only, with the floors of `DowsonHigginson`. In the source's two
    contacts 11 and 9 % below the full numerical solution (table 18).
    **Reference:** Pan and Hamrock (1989), ASME J. Tribology 111, 246.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_groups = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return _power_law(contact, log_groups, 1.714, 0.694, 0.568, -0.128)


class Grubin(AbstractLineFilm):
    r"""Film at the inlet edge of the Hertz zone: the approximate solution of Ertel and Grubin.

    $h_c/R = 1.95\,(GU)^{8/11}W^{-1/11}$, groups as in `DowsonHigginson`.

    **Validity:** the elastic-piezoviscous regime only, with the floors of `DowsonHigginson`. In the source's two
    contacts 11 and 13 % below the full numerical solution (table 18).
    **Reference:** Grubin (1949), TsNIITMASh Book 30 (DSIR translation 337).
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_groups = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return _power_law(contact, log_groups, 1.95, 8.0 / 11.0, 8.0 / 11.0, -1.0 / 11.0)


class MartinBlend(AbstractLineFilm):
    r"""An elastohydrodynamic film joined to the rigid isoviscous one: $h^n = h_{film}^n + h_M^n$.

    $h_M = 4.894968\,\mu u R\ell/Q$ (Martin, u the mean speed), n = 3 by default.

    **Limits:** the given film at high load. Martin's film as Q -> 0: it grows without bound and fills any clearance, so
    that an unloaded roller carries a small positive load and has a definite position.
    **Validity:** an interpolation; where both films are equal, the sum is 26 % above them (n = 3). Do not use it with
    `Moes`, which contains Martin's film already.
    **Reference:** Martin (1916), Engineering 102, 119, for $h_M$; the blend is ours.
    """

    film: AbstractLineFilm
    exponent: Scalar = bounded("> 0", default=3.0)

    @property
    def piezoviscous_only(self) -> bool:  # pyright: ignore[reportIncompatibleVariableOverride]  (the wrapped film's)
        return self.film.piezoviscous_only

    def log_thickness(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        elastic = self.film.log_thickness(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        log_drag = jnp.log(viscosity) + log_entrainment_sum(entrainment_speed) - LOG_2
        log_size = jnp.log(contact.reduced_radius * contact.length)
        martin = jnp.log(MARTIN_CONSTANT) + log_drag + log_size - jnp.log(smooth_abs(load, LOAD_FLOOR))
        return log_add(self.exponent * elastic, self.exponent * martin) / self.exponent


MartinBlend.__init__.__doc__ = """**Arguments:**
- `film`: the film at high load.
- `exponent`: n, a number > 0.
"""
