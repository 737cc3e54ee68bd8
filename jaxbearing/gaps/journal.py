"""Short journal bearing with both surfaces turning and squeeze, for the land between cage and ring."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.compiling import compiled_by_hand
from ..numerics.roots import monotone_root
from ..numerics.safe import safe_norm, smooth_abs, softplus
from ..numerics.structure import count
from .turbulence import AbstractTurbulence, BlendedTurbulence

ECCENTRICITY_LIMIT = 0.995
"""Eccentricity ratio at which the film integrals saturate and the land contact sets in."""
ECCENTRICITY_WIDTH = 1e-3
"""Smoothing width of `ECCENTRICITY_LIMIT`; it shifts eps by at most 3.1e-10 below eps = 0.98."""
LAND_STIFFNESS = 1e8
"""Stiffness of the land contact beyond `ECCENTRICITY_LIMIT`, N/m."""
OFFSET_SHIFT = 1e-7
"""Shift of the journal along +x, over the radial clearance; it gives the line of centres a direction when journal and
bush are concentric. The force is exactly that of the shifted position (relative change 7e-7 at eps = 0.5, 1.3e-6 at
0.93)."""
DIRECTION_FLOOR = 1e-15
"""Floor of the shifted offset, over the radial clearance; it acts only at the offset -OFFSET_SHIFT c."""
SPEED_TINY = 1e-12
"""Shift of the tangential velocity over the radial clearance, rad/s, which gives the velocity a direction at rest."""
SPEED_WIDTH = 1e-6
"""Smoothing of |relative speed| in the Reynolds number, rad/s: relative error 5e-13 at 1 rad/s."""
MEAN_SPEED_WIDTH = 1e-12
"""Smoothing of |mean speed| in `static_equilibrium`, rad/s: at rest the film still carries about 1e-12 N."""


def saturated_eccentricity(eccentricity_ratio: Values) -> Batch:
    r"""Smooth min(eps, 0.995): $\epsilon_s = 0.995 - w\ln(1+e^{(0.995-\epsilon)/w})$, w = 1e-3.

    The difference $\epsilon - \epsilon_s$ is the smooth max(eps - 0.995, 0): it underflows to
    0 for eps < 0.25, is 3.1e-10 at 0.98 and $w\ln 2$ at 0.995.
    """
    require_numbers("finite", eccentricity_ratio=eccentricity_ratio)
    return eccentricity_ratio - eccentricity_overlap(eccentricity_ratio)


def eccentricity_overlap(eccentricity_ratio: Values) -> Batch:
    """Smooth max(eps - 0.995, 0), the complement of `saturated_eccentricity`."""
    return ECCENTRICITY_WIDTH * softplus((eccentricity_ratio - ECCENTRICITY_LIMIT) / ECCENTRICITY_WIDTH)


class StaticFilm(NamedTuple):
    """Steady equilibrium of one land under a dead load.

    - `eccentricity_ratio`: offset over radial clearance (may exceed 1 when the land contact carries).
    - `attitude_angle`: angle between load and line of centres, rad, in (0, pi/2], without sign.
    - `tangential_force`: F_t on the journal, N, with the sign of the mean speed.
    - `residual`: error of the load relative to the load, or, if that is larger, to the initial stiffness dW/d eps.
    """

    eccentricity_ratio: Batch
    attitude_angle: Batch
    tangential_force: Batch
    residual: Batch


class LineOfCentres(NamedTuple):
    """Eccentricity ratio and unit vector from the bush's centre to the journal's."""

    eccentricity_ratio: Batch
    direction: tuple[Batch, Batch]


class ShortJournal(Checked):
    r"""Film of a short (narrow) journal bearing, isoviscous and rigid, with cavitation: p = max(p, 0) (pi film).

    The journal is the inner body. Its offset is $e = x_{journal} - x_{bush}$, $\epsilon = |e|/c$;
    $e_r = e/|e|$, $e_t$ is $e_r$ turned +90 deg; speeds are absolute and counter-clockwise positive.
    Inner-guided cage: the cage is the bush; outer-guided: the cage is the journal. All methods
    are for ONE land: multiply forces and torques by `n_lands`.

    **Validity:** width/(2 radius) < 1/6; no misalignment; the friction torque is that of a fully wetted land
    (a decision: a half-dry land would have about half of it).
    **Reference:** Ocvirk (1953), NACA TN 2808 (pressure); Booker (1965), ASME J. Basic Eng. 87,
    537 (moving film); the source names the contact in Table 3 without a formula.

    **Arguments:**
    - `radius`: of the journal, R, m, > 0.
    - `width`: L of ONE land, m, > 0.
    - `clearance`: c, RADIAL: half of the diametral clearance, m, > 0.
    - `turbulence`: flow regime of the film.
    - `n_lands`: number of lands; structure.
    """

    radius: Scalar = bounded("> 0")
    width: Scalar = bounded("> 0")
    clearance: Scalar = bounded("> 0")
    turbulence: AbstractTurbulence = eqx.field(default_factory=BlendedTurbulence)
    n_lands: int = count("n_lands", 2, least=1)

    def film_factors(self, density: Values, viscosity: Values, relative_speed: Values) -> tuple[Batch, Batch]:
        r"""Flow factor k_z and friction factor C_f at $Re = \rho R|\Delta\omega|c/\mu$, $Re_c = 41.2\sqrt{R/c}$.

        **Arguments:** `density`, kg/m^3; `viscosity` at inlet temperature, Pa s; `relative_speed`,
        journal minus bush, rad/s, of either sign.
        """
        reynolds = self.reynolds_number(density, viscosity, relative_speed)
        critical = jnp.broadcast_to(41.2 * jnp.sqrt(self.radius / self.clearance), jnp.shape(reynolds))
        return self.turbulence.factors(reynolds, critical)

    def reynolds_number(self, density: Values, viscosity: Values, relative_speed: Values) -> Batch:
        r"""Reynolds number $Re = \rho R|\Delta\omega|c/\mu$; the film is laminar below about 41.2 sqrt(R/c).

        **Arguments:** as in `film_factors`.
        """
        return density * self.radius * smooth_abs(relative_speed, SPEED_WIDTH) * self.clearance / viscosity

    def film_constant(self, viscosity: Values, k_z: Values) -> Batch:
        r"""Film constant $K = (\mu k_z/12) R L^3/c^3$, N s/m."""
        return jnp.asarray(viscosity) * k_z / 12.0 * (self.radius * self.width**3 / self.clearance**3)

    def force_on_journal(
        self,
        offset_x: Values,
        offset_y: Values,
        rate_x: Values,
        rate_y: Values,
        journal_speed: Values,
        bush_speed: Values,
        viscosity: Values,
        k_z: Values,
    ) -> tuple[Batch, Batch]:
        r"""Force of film and land contact on the journal, (F_x, F_y), N, of one land.

        $v_r = \dot e\cdot e_r$, $v_t = \dot e\cdot e_t - \tfrac12(\omega_j+\omega_b)|e|$,
        $F_r = -K(Cv_r + Bv_t)$, $F_t = -K(Bv_r + Av_t)$ with A, B, C the integrals of sin^2, sin cos,
        cos^2 over (1 + eps cos)^3 on the half turn of positive pressure (see `_film_integrals`).
        The force on the bush is the opposite.

        **Limits:** eps -> 0: $F = -(\pi/2)Kv$ with v the velocity in the frame that turns with the mean speed; v = 0:
        no film force. Beyond eps = 0.995 (see `saturated_eccentricity`) the film integrals saturate and a contact of
        `LAND_STIFFNESS` pushes back along the line of centres. F is homogeneous of degree one in the velocity:
        continuous at rest, where its slope jumps.

        **Arguments:** `offset_*`, m; `rate_*`, m/s; `*_speed`, rad/s; `viscosity`, Pa s; `k_z` from
        `film_factors` (12 if laminar).
        """
        c = self.clearance
        eps, (r_x, r_y) = self.line_of_centres(offset_x, offset_y)
        length = eps * c
        mean_speed = 0.5 * (journal_speed + bush_speed)
        v_r = rate_x * r_x + rate_y * r_y
        v_t = rate_y * r_x - rate_x * r_y - mean_speed * length
        a, b, cc = _film_integrals(saturated_eccentricity(eps), v_r, v_t, SPEED_TINY * c)
        k = self.film_constant(viscosity, k_z)
        f_r = -k * (cc * v_r + b * v_t) - LAND_STIFFNESS * c * eccentricity_overlap(eps)
        f_t = -k * (b * v_r + a * v_t)
        return f_r * r_x - f_t * r_y, f_r * r_y + f_t * r_x

    def line_of_centres(self, offset_x: Values, offset_y: Values) -> LineOfCentres:
        """Eccentricity and direction at an offset of the journal, m, shifted by `OFFSET_SHIFT`."""
        # the shift keeps e_r a unit vector at e = 0; a floor of |e| alone would give e_r = 0 and F = 0
        shifted_x = offset_x + OFFSET_SHIFT * self.clearance
        length = safe_norm(safe_norm(shifted_x, offset_y), DIRECTION_FLOOR * self.clearance)
        return LineOfCentres(length / self.clearance, (shifted_x / length, offset_y / length))

    def static_offset(
        self, eccentricity_ratio: Values, attitude_angle: Values, force_x: Values, force_y: Values, mean_speed: Values
    ) -> tuple[Batch, Batch]:
        """Offset of the journal, m, in a `static_equilibrium` whose film force on the journal has a given direction.

        **Arguments:** `force_*`: a force of that direction, N, of any size; `mean_speed` of journal and bush, rad/s,
        of which only the sign counts.
        """
        turn = jnp.where(mean_speed >= 0, 1.0, -1.0) * (jnp.pi - attitude_angle)
        angle = jnp.arctan2(force_y, force_x) - turn
        length = eccentricity_ratio * self.clearance
        return length * jnp.cos(angle) - OFFSET_SHIFT * self.clearance, length * jnp.sin(angle)

    def torques(
        self,
        eccentricity_ratio: Values,
        tangential_force: Values,
        journal_speed: Values,
        bush_speed: Values,
        viscosity: Values,
        C_f: Values,
    ) -> tuple[Batch, Batch]:
        r"""Film torques (on the journal, on the bush), N m, counter-clockwise positive, one land.

        $T_c = 2\pi\mu C_fR^3L(\omega_j-\omega_b)/(c\sqrt{1-\epsilon^2})$,
        $T_j = -T_c - \epsilon cF_t/2$, $T_b = +T_c - \epsilon cF_t/2$, each about the body's own centre: the film force
        needs no further transfer between the centres (the extra term of the source's eq. (33) is included).

        **Arguments:** `tangential_force` F_t on the journal, N, signed (from `StaticFilm`, or the e_t component of
        `force_on_journal`); `C_f` from `film_factors` (1 if laminar); others as in `force_on_journal`.
        """
        eps_s = saturated_eccentricity(eccentricity_ratio)
        shear = 2.0 * jnp.pi * viscosity * C_f * (self.radius**3 * self.width / self.clearance)
        shear = shear * (journal_speed - bush_speed) / jnp.sqrt(1.0 - jnp.square(eps_s))
        couple = 0.5 * eccentricity_ratio * self.clearance * tangential_force
        return -shear - couple, shear - couple

    def dissipation(self, T_journal: Values, T_bush: Values, journal_speed: Values, bush_speed: Values) -> Batch:
        r"""Power $-T_j\omega_j - T_b\omega_b$, W, of shear and pumping in the eccentric film; >= 0 in steady state."""
        return -(jnp.asarray(T_journal) * journal_speed + jnp.asarray(T_bush) * bush_speed)

    @compiled_by_hand
    def static_equilibrium(
        self, load: Values, journal_speed: Values, bush_speed: Values, viscosity: Values, k_z: Values
    ) -> StaticFilm:
        r"""Equilibrium under a dead load, the inverse of `force_on_journal` with resting centres.

        $W = \tfrac12Kc\omega_s\,\epsilon(1-\epsilon^2)^{-2}\sqrt{16\epsilon^2+\pi^2(1-\epsilon^2)}$,
        $\tan\phi = \pi\sqrt{1-\epsilon^2}/(4\epsilon)$, with the same saturation and land contact as
        `force_on_journal` (and without its `OFFSET_SHIFT`).

        **Limits:** load 0: eps = 0, phi = pi/2, with finite derivatives; mean speed 0: the land contact carries the
        load (|mean speed| is smoothed by 1e-12 rad/s, so that eps is defined there). Derivatives in both modes, by the
        implicit function.

        **Arguments:** `load` on this land, N, >= 0; others as in `force_on_journal`.
        """
        mean_speed = 0.5 * (journal_speed + bush_speed)
        signed = self.film_constant(viscosity, k_z) * self.clearance * (0.5 * jnp.pi)
        reference = signed * smooth_abs(mean_speed, MEAN_SPEED_WIDTH)
        contact = LAND_STIFFNESS * self.clearance
        args = jnp.broadcast_arrays(load / reference, contact / reference)
        upper = 1.0 + load / contact + jnp.zeros_like(args[0])
        ratio = args[0] / (1.0 + args[0])
        guess = ECCENTRICITY_LIMIT * ratio + load / contact
        root = monotone_root(_static_balance, args, -0.5, upper, guess)
        eps = root.value
        radial, tangential = _static_stiffness(eps, args[1])
        return StaticFilm(
            eccentricity_ratio=eps,
            attitude_angle=jnp.arctan2(tangential, radial),
            tangential_force=signed * mean_speed * tangential * eps,
            residual=root.residual,
        )


def _film_integrals(eps: Values, v_r: Values, v_t: Values, tiny: Values) -> tuple[Batch, Batch, Batch]:
    r"""Integrals A, B, C of $\sin^2, \sin\cos, \cos^2$ over $(1+\epsilon\cos\theta)^3$ on $[\theta_1,\theta_1+\pi]$.

    The half turn of positive pressure begins at $\theta_1 = atan2(v_r, -v_t)$. Sommerfeld's substitution
    $g = atan2(\sqrt{1-\epsilon^2}\sin\theta, \cos\theta+\epsilon)$ makes the integrals elementary, without
    cancellation as eps -> 0 (A = C = pi/2, B = 0).
    """
    along = tiny - v_t
    speed = safe_norm(v_r, along)
    sin1, cos1 = v_r / speed, along / speed
    complement = 1.0 - jnp.square(eps)
    root = jnp.sqrt(complement)
    g1 = jnp.arctan2(root * sin1, cos1 + eps)
    g2 = jnp.arctan2(-root * sin1, eps - cos1)
    g2 = jnp.where(g2 <= g1, g2 + 2.0 * jnp.pi, g2)
    s1, c1, s2, c2 = jnp.sin(g1), jnp.cos(g1), jnp.sin(g2), jnp.cos(g2)
    half = 0.5 * (g2 - g1)
    double = 0.5 * (s2 * c2 - s1 * c1)  # [sin(2g)/4]
    a = (half - double) / (complement * root)
    b = (0.5 * (s2 * s2 - s1 * s1) + eps * (c2 - c1)) / (complement * complement)
    c = (half + double - 2.0 * eps * (s2 - s1) + 2.0 * jnp.square(eps) * half) / (complement * complement * root)
    return a, b, c


def _static_stiffness(eps: Values, contact: Values) -> tuple[Batch, Batch]:
    """Radial and tangential force over eps, in units of the reference (pi/2) K c |mean speed|."""
    eps_s = saturated_eccentricity(eps)
    complement = 1.0 - jnp.square(eps_s)
    # the overlap underflows to 0 below eps = 0.25, so the value at eps <= 0.1 is exact
    loaded = eps > 0.1
    secant = jnp.where(loaded, eccentricity_overlap(eps) / jnp.where(loaded, eps, 1.0), 0.0)
    return (4.0 / jnp.pi) * eps_s / jnp.square(complement) + contact * secant, complement**-1.5


def _static_balance(eps: Array, args: tuple[Array, Array] | list[Array]) -> Array:
    """Residual asinh(W(eps)) - asinh(load): linear for small loads, logarithmic for large ones."""
    load, contact = args
    radial, tangential = _static_stiffness(eps, contact)
    return jnp.arcsinh(eps * safe_norm(radial, tangential)) - jnp.arcsinh(load)
