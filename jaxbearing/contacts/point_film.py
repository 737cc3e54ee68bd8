"""Isothermal film thickness of a lubricated point contact."""

import abc
from typing import ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import log_add, smooth_abs
from .film import LOG_2, MoesNumbers
from .line import LOAD_FLOOR, log_entrainment_sum, log_material_number
from .point import PointContact

POINT_LOAD_FLOOR = 1e-6
"""Smallest load number M. The film of an unloaded contact is then finite (4e13 R U^(1/2)); the clearance limits it, not
the formula."""
RADIUS_RATIO_FLOOR = 1e-4
"""Smallest ratio Rx/Ry in the film formula; such a contact is practically a line contact."""


class AbstractPointFilm(Checked):
    """Film thickness of a point contact from load, speed and the oil at the inlet."""

    part: ClassVar[str] = "contact.film"
    piezoviscous_only: ClassVar[bool]
    """True if the law holds only for an oil whose viscosity rises with pressure: for others its film is about 0."""

    @abc.abstractmethod
    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        """Natural logarithm of the film thickness in m.

        **Arguments:**
        - `contact`: the two bodies; only reduced radii and modulus count.
        - `load`: N, >= 0.
        - `entrainment_speed`: mean surface speed (u1 + u2)/2 relative to the contact, m/s; only its modulus counts.
        - `viscosity`: at the inlet temperature and ambient pressure, Pa s, > 0.
        - `pressure_viscosity`: reciprocal isoviscous pressure at the inlet temperature, 1/Pa, >= 0.
        """

    def thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        """Film thickness, m. **Arguments:** those of `log_thickness`."""
        return jnp.exp(self.log_thickness(contact, load, entrainment_speed, viscosity, pressure_viscosity))


class NijenbanningVennerMoes(AbstractPointFilm):
    r"""Central film of an elliptical contact in all four regimes.

    $U = \mu(u_1+u_2)/(E'R_x)$, $M = \frac{Q}{E'R_x^2}U^{-3/4}$, $L = \alpha E'U^{1/4}$, $H = \frac{h}{R_x}U^{-1/2}$,
    $\lambda = R_x/R_y$, $C = 1 + 0.006\ln\lambda + 0.63\lambda^{4/7}$,
    $H^s = [H_{RI}^{3/2} + (H_{EI}^{-4} + H_{00}^{-4})^{-3/8}]^{2s/3} + [H_{RP}^{-8} + H_{EP}^{-8}]^{-s/8}$,
    $H_{RI} = 145(1 + 0.796\lambda^{14/15})^{-15/7}\lambda^{-1}M^{-2}$,
    $H_{RP} = 1.29(1 + 0.691\lambda)^{-2/3}L^{2/3}$, $H_{EI} = 3.18C^{-14/25}\lambda^{-1/15}M^{-2/15}$,
    $H_{EP} = 1.48C^{-7/20}\lambda^{-1/24}M^{-1/12}L^{3/4}$, $H_{00} = 1.80/\lambda$,
    $s = \frac32[1 + \exp(-1.2H_{EI}/H_{EP})]$.

    **Limits:** the film of each regime where this regime dominates; the isoviscous film at $\alpha$ = 0 (1e-25 1/Pa is
    added to $\alpha$).
    **Validity:** $\lambda\le1$, rolling along the minor axis of the ellipse. For $\lambda$ > 1, where the formula
    extrapolates, use `ChittendenCentral`. A $\lambda$ below 1e-4 counts as 1e-4. M is floored as
    $\sqrt{M^2 + 10^{-12}}$, and $u_1+u_2$ levels off at 1e-6 m/s. In the elastic-piezoviscous regime the film differs
    from that of Hamrock and Dowson by about 10 %.
    **Reference:** Nijenbanning, Venner and Moes (1994), Wear 176, 217; the constants are from memory, checked by their
    limits.
    """

    piezoviscous_only: ClassVar[bool] = False

    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        radius = contact.reduced_radius_rolling
        log_u, m, log_l = self._groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        log_m = jnp.log(smooth_abs(m, POINT_LOAD_FLOOR))
        ratio = jnp.maximum(radius / contact.reduced_radius_transverse, RADIUS_RATIO_FLOOR)
        log_ratio = jnp.log(ratio)
        log_c = jnp.log(1.0 + 0.006 * log_ratio + 0.63 * jnp.exp(4.0 / 7.0 * log_ratio))

        rigid_isoviscous = _log_rigid_isoviscous(log_ratio, log_m)
        rigid_piezoviscous = jnp.log(1.29) - 2.0 / 3.0 * jnp.log1p(0.691 * ratio) + 2.0 / 3.0 * log_l
        elastic_isoviscous = jnp.log(3.18) - 14.0 / 25.0 * log_c - log_ratio / 15.0 - 2.0 / 15.0 * log_m
        elastic_piezoviscous = jnp.log(1.48) - 0.35 * log_c - log_ratio / 24.0 - log_m / 12.0 + 0.75 * log_l
        light_load = jnp.log(1.80) - log_ratio

        s = 1.5 * (1.0 + jnp.exp(-1.2 * jnp.exp(elastic_isoviscous - elastic_piezoviscous)))
        deformed = -3.0 / 8.0 * log_add(-4.0 * elastic_isoviscous, -4.0 * light_load)
        isoviscous = 2.0 / 3.0 * log_add(1.5 * rigid_isoviscous, deformed)
        piezoviscous = -log_add(-8.0 * rigid_piezoviscous, -8.0 * elastic_piezoviscous) / 8.0
        log_h = log_add(s * isoviscous, s * piezoviscous) / s
        return log_h + 0.5 * log_u + jnp.log(radius)

    def numbers(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> MoesNumbers:
        """Dimensionless groups of the contact. **Arguments:** those of `log_thickness`."""
        log_u, m, log_l = self._groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        return MoesNumbers(m, jnp.exp(log_l), contact.reduced_radius_rolling * jnp.exp(0.5 * log_u))

    @staticmethod
    def _groups(
        contact: PointContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
    ) -> tuple[Array, Array, Array]:
        """Groups of Moes: ln U, M and ln L."""
        radius, modulus = contact.reduced_radius_rolling, contact.reduced_modulus
        stiffness = modulus * radius
        log_u = log_entrainment_sum(entrainment_speed) + jnp.log(viscosity) - jnp.log(stiffness)
        m = load / (stiffness * radius) * jnp.exp(-0.75 * log_u)
        return log_u, m, log_material_number(pressure_viscosity, modulus) + 0.25 * log_u


def _log_rigid_isoviscous(log_ratio: Array, log_m: Array) -> Array:
    """Logarithm of H_RI in `NijenbanningVennerMoes`, from the logarithms of Rx/Ry and M."""
    side_flow = jnp.log1p(0.796 * jnp.exp(14.0 / 15.0 * log_ratio))
    return jnp.log(145.0) - 15.0 / 7.0 * side_flow - log_ratio - 2.0 * log_m


class HamrockDowsonCentral(AbstractPointFilm):
    r"""Central film of an elastohydrodynamic point contact.

    $h_c/R_x = 2.69\,U^{0.67}G^{0.53}W^{-0.067}(1 - 0.61e^{-0.73k})$, $U = \mu u/(E'R_x)$ with u the *mean* speed,
    $G = \alpha E'$, $W = Q/(E'R_x^2)$, $k = 1.03(R_y/R_x)^{0.64}$.

    **Validity:** the elastic-piezoviscous regime only: at light load the film is far too thin (see `RigidBlend`).
    Fitted for k >= 1; for smaller k the formula extrapolates. The load levels off at 1e-9 N, the speed at 0.5e-6 m/s
    and alpha at 1e-25 1/Pa.
    **Reference:** Hamrock and Dowson (1977), ASME J. Lubr. Technol. 99, 264; source eqs. (59)-(60), whose factor
    1.691 belongs to the sum of the speeds.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_speed, log_material, log_load = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        shape = jnp.log1p(-0.61 * jnp.exp(-0.73 * _fitted_ellipticity(contact)))
        log_film = jnp.log(2.69) + 0.67 * log_speed + 0.53 * log_material - 0.067 * log_load + shape
        return log_film + jnp.log(contact.reduced_radius_rolling)


class HamrockDowsonMinimum(AbstractPointFilm):
    r"""Minimum film of an elastohydrodynamic point contact.

    $h_{min}/R_x = 3.63\,U^{0.68}G^{0.49}W^{-0.073}(1 - e^{-0.68k})$, groups and k as in `HamrockDowsonCentral`.

    **Validity:** as `HamrockDowsonCentral`.
    **Reference:** Hamrock and Dowson (1977), ASME J. Lubr. Technol. 99, 264; source eqs. (58) and (60), whose factor
    2.266 belongs to the sum of the speeds.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_speed, log_material, log_load = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        shape = jnp.log(-jnp.expm1(-0.68 * _fitted_ellipticity(contact)))
        log_film = jnp.log(3.63) + 0.68 * log_speed + 0.49 * log_material - 0.073 * log_load + shape
        return log_film + jnp.log(contact.reduced_radius_rolling)


class ChittendenCentral(AbstractPointFilm):
    r"""Central film of an elastohydrodynamic point contact that rolls along the minor or the major axis of its ellipse.

    $h_c/R_x = 4.31\,U^{0.68}G^{0.49}W^{-0.073}[1 - \exp(-1.23(R_y/R_x)^{2/3})]$, groups as in `HamrockDowsonCentral`.

    **Limits:** for a circular contact within 5 % of Hamrock and Dowson's film.
    **Validity:** the elastic-piezoviscous regime only, with the floors of `HamrockDowsonCentral`. Fitted for rolling
    along the minor axis and, down to about R_y/R_x = 0.1, along the major axis (R_y < R_x).
    **Reference:** Chittenden, Dowson, Dunn and Taylor (1985), Proc. R. Soc. A 397, 245; the constants are from memory,
    checked by this limit.
    """

    piezoviscous_only: ClassVar[bool] = True

    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        log_speed, log_material, log_load = _log_groups(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        log_ratio = jnp.log(contact.reduced_radius_transverse) - jnp.log(contact.reduced_radius_rolling)
        shape = jnp.log(-jnp.expm1(-1.23 * jnp.exp(2.0 / 3.0 * log_ratio)))
        log_film = jnp.log(4.31) + 0.68 * log_speed + 0.49 * log_material - 0.073 * log_load + shape
        return log_film + jnp.log(contact.reduced_radius_rolling)


class RigidBlend(AbstractPointFilm):
    r"""An elastohydrodynamic film joined to the rigid isoviscous one: $h^n = h_{film}^n + h_{RI}^n$.

    $h_{RI} = R_xU^{1/2}H_{RI}$, $H_{RI} = 145(1 + 0.796\lambda^{14/15})^{-15/7}\lambda^{-1}M^{-2}$, groups as in
    `NijenbanningVennerMoes`; n = 3 by default.

    **Limits:** at high load the given film, plus the fraction $r^n/n$ of it with $r = h_{RI}/h_{film}$; with Hamrock
    and Dowson's film of a circular contact and L = 10 this is 4e-10 at M = 100, 4e-7 at M = 30 and 3e-4 at M = 10. As
    Q -> 0 the film is $h_{RI}$. It grows as $Q^{-2}$ and fills any clearance, so that an unloaded ball carries a small
    positive load and has a definite position; the given film grows as $Q^{-0.067}$ only and does not fill a clearance.
    **Validity:** an interpolation; where both films are equal, the sum is 26 % above them (n = 3). The plateau of a
    rigid-piezoviscous contact between them is missing; `NijenbanningVennerMoes` has it. M is floored as there. Do not
    use the blend with that law, which contains $h_{RI}$ already.
    **Reference:** Nijenbanning, Venner and Moes (1994), Wear 176, 217, for $h_{RI}$; the blend is ours.
    """

    film: AbstractPointFilm
    exponent: Scalar = bounded("> 0", default=3.0)

    @property
    def piezoviscous_only(self) -> bool:  # pyright: ignore[reportIncompatibleVariableOverride]  (the wrapped film's)
        return self.film.piezoviscous_only

    def log_thickness(
        self,
        contact: PointContact,
        load: Values,
        entrainment_speed: Values,
        viscosity: Values,
        pressure_viscosity: Values,
    ) -> Float[Array, "..."]:
        elastic = self.film.log_thickness(contact, load, entrainment_speed, viscosity, pressure_viscosity)
        radius, stiffness = contact.reduced_radius_rolling, contact.reduced_modulus * contact.reduced_radius_rolling
        log_u = log_entrainment_sum(entrainment_speed) + jnp.log(viscosity) - jnp.log(stiffness)
        m = load / (stiffness * radius) * jnp.exp(-0.75 * log_u)
        log_ratio = jnp.log(radius) - jnp.log(contact.reduced_radius_transverse)
        rigid = _log_rigid_isoviscous(log_ratio, jnp.log(smooth_abs(m, POINT_LOAD_FLOOR)))
        rigid = rigid + 0.5 * log_u + jnp.log(radius)
        return log_add(self.exponent * elastic, self.exponent * rigid) / self.exponent


RigidBlend.__init__.__doc__ = """**Arguments:**
- `film`: the film at high load.
- `exponent`: n, > 0.
"""


def _fitted_ellipticity(contact: PointContact) -> Array:
    """Ellipticity k in the formulas of Hamrock and Dowson: their approximation, not the exact k of `PointContact`."""
    ratio = jnp.log(contact.reduced_radius_transverse) - jnp.log(contact.reduced_radius_rolling)
    return 1.03 * jnp.exp(0.64 * ratio)


def _log_groups(
    contact: PointContact, load: Values, entrainment_speed: Values, viscosity: Values, pressure_viscosity: Values
) -> tuple[Array, Array, Array]:
    """Logarithms of U with the mean speed, G and W, as in `HamrockDowsonCentral`."""
    stiffness = contact.reduced_modulus * contact.reduced_radius_rolling
    log_speed = log_entrainment_sum(entrainment_speed) - LOG_2 + jnp.log(viscosity) - jnp.log(stiffness)
    log_material = log_material_number(pressure_viscosity, contact.reduced_modulus)
    log_load = jnp.log(smooth_abs(load, LOAD_FLOOR)) - jnp.log(stiffness * contact.reduced_radius_rolling)
    return log_speed, log_material, log_load
