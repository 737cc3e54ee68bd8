"""Short journal bearing with both surfaces turning and squeeze: cage or ring land."""

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
"""Eccentricity ratio at which the film laws saturate and the land contact takes over."""
ECCENTRICITY_WIDTH = 1e-3
"""Width of that saturation; below eps = 0.98 it shifts eps by at most 3.1e-10."""
LAND_STIFFNESS = 1e8
"""Stiffness of the land contact beyond the limit, N/m."""
OFFSET_SHIFT = 1e-7
"""Shift of the journal along +x, as a ratio of the clearance, that keeps the direction of the
line of centres a unit vector when journal and bush are concentric; the force is that of the shifted
place, exactly (relative change 7e-7 at eps = 0.5, 1.3e-6 at 0.93)."""
DIRECTION_FLOOR = 1e-15
"""Floor of the offset as a ratio of the clearance (only at offset = -OFFSET_SHIFT c)."""
SPEED_TINY = 1e-12
"""Shift of the tangential velocity, in rad/s times the clearance, that gives a direction at rest."""
SPEED_WIDTH = 1e-6
"""Width of |relative speed| in the Reynolds number, rad/s: relative error 5e-13 at 1 rad/s."""
MEAN_SPEED_WIDTH = 1e-12
"""Width of |mean speed| in the static law, rad/s: a film of about 1e-12 N remains where none turns."""


def saturated_eccentricity(eccentricity_ratio: Values) -> Batch:
    r"""$\epsilon_s = 0.995 - w\ln(1+e^{(0.995-\epsilon)/w})$, w = 1e-3: min(eps, 0.995), smoothly.

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

    - `eccentricity_ratio`: offset / radial clearance (may exceed 1 when the land contact carries).
    - `attitude_angle`: angle between load line and line of centres, rad, in (0, pi/2], sense-free.
    - `tangential_force`: F_t on the journal, N, signed: that of the mean speed.
    - `residual`: relative error of the load (of load/initial stiffness for loads below it).
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
    r"""Short (narrow) journal film, isoviscous and rigid, cavitated: p = max(p, 0) (pi film).

    The journal is the inner body. Its offset is $e = x_{journal} - x_{bush}$, $\epsilon = |e|/c$;
    $e_r = e/|e|$, $e_t$ is $e_r$ turned +90 deg; speeds are absolute and counter-clockwise positive.
    Inner-guided cage: the cage is the bush; outer-guided: the cage is the journal. All methods
    are for ONE land: multiply forces and torques by `n_lands`.

    **Validity:** width/(2 radius) < 1/6; no misalignment; full wetting for the friction torque
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
        journal minus bush, rad/s, either sign.
        """
        reynolds = self.reynolds_number(density, viscosity, relative_speed)
        critical = jnp.broadcast_to(41.2 * jnp.sqrt(self.radius / self.clearance), jnp.shape(reynolds))
        return self.turbulence.factors(reynolds, critical)

    def reynolds_number(self, density: Values, viscosity: Values, relative_speed: Values) -> Batch:
        r"""$Re = \rho R|\Delta\omega|c/\mu$; laminar below about 41.2 sqrt(R/c). **Arguments:** those of
        `film_factors`."""
        return density * self.radius * smooth_abs(relative_speed, SPEED_WIDTH) * self.clearance / viscosity

    def film_constant(self, viscosity: Values, k_z: Values) -> Batch:
        r"""$K = (\mu k_z/12) R L^3/c^3$, N s/m."""
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
        r"""Film (and land contact) force on the journal, (F_x, F_y) in N, one land.

        $v_r = \dot e\cdot e_r$, $v_t = \dot e\cdot e_t - \tfrac12(\omega_j+\omega_b)|e|$,
        $F_r = -K(Cv_r + Bv_t)$, $F_t = -K(Bv_r + Av_t)$ with A, B, C the integrals of sin^2, sin cos,
        cos^2 over (1 + eps cos)^3 on the half turn of positive pressure (see `_film_integrals`).
        The force on the bush is the opposite.

        **Limits:** eps -> 0: $F = -(\pi/2)Kv$ with v the velocity in the mean-rotating frame; no
        velocity at all: no film force. Beyond eps = 0.995 (see `saturated_eccentricity`) the film
        integrals saturate and a contact of `LAND_STIFFNESS` pushes back along the line of centres.
        F is of degree one in the velocity: continuous at rest, where its slope jumps.

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
        """Eccentricity and direction at an offset of the journal, m; see `OFFSET_SHIFT`."""
        # the shift keeps e_r a unit vector at e = 0; flooring |e| alone would give e_r = 0, F = 0
        shifted_x = offset_x + OFFSET_SHIFT * self.clearance
        length = safe_norm(safe_norm(shifted_x, offset_y), DIRECTION_FLOOR * self.clearance)
        return LineOfCentres(length / self.clearance, (shifted_x / length, offset_y / length))

    def static_offset(
        self, eccentricity_ratio: Values, attitude_angle: Values, force_x: Values, force_y: Values, mean_speed: Values
    ) -> tuple[Batch, Batch]:
        """Offset of the journal, m, at a `static_equilibrium` in which the film pushes on the journal along a force.

        **Arguments:** `force_*`, N, of any size; `mean_speed` of journal and bush, rad/s, of which the sign counts.
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
        $T_j = -T_c - \epsilon cF_t/2$, $T_b = +T_c - \epsilon cF_t/2$: each about its own centre, so no
        further transfer of the film force between the centres is due (the extra term of the
        source's eq. (33) is contained here).

        **Arguments:** `tangential_force` F_t on the journal, N, signed (`StaticFilm`, or the e_t
        component of `force_on_journal`); others as above.
        """
        eps_s = saturated_eccentricity(eccentricity_ratio)
        shear = 2.0 * jnp.pi * viscosity * C_f * (self.radius**3 * self.width / self.clearance)
        shear = shear * (journal_speed - bush_speed) / jnp.sqrt(1.0 - jnp.square(eps_s))
        couple = 0.5 * eccentricity_ratio * self.clearance * tangential_force
        return -shear - couple, shear - couple

    def dissipation(self, T_journal: Values, T_bush: Values, journal_speed: Values, bush_speed: Values) -> Batch:
        r"""$-T_j\omega_j - T_b\omega_b$, W: shear heat plus the pumping of the offset film, >= 0 at steady state."""
        return -(jnp.asarray(T_journal) * journal_speed + jnp.asarray(T_bush) * bush_speed)

    @compiled_by_hand
    def static_equilibrium(
        self, load: Values, journal_speed: Values, bush_speed: Values, viscosity: Values, k_z: Values
    ) -> StaticFilm:
        r"""Eccentricity that carries a dead load: the inverse of `force_on_journal` at rest.

        $W = \tfrac12Kc\omega_s\,\epsilon(1-\epsilon^2)^{-2}\sqrt{16\epsilon^2+\pi^2(1-\epsilon^2)}$,
        $\tan\phi = \pi\sqrt{1-\epsilon^2}/(4\epsilon)$, with the same saturation and land contact as
        `force_on_journal` (and without its `OFFSET_SHIFT`).

        **Limits:** load 0: eps = 0, phi = pi/2, with finite derivatives; no mean speed: the land
        contact carries the load (|mean speed| is smoothed by 1e-12 rad/s, so eps is defined at 0).
        Implicit derivatives in both modes.

        **Arguments:** `load`, this land's share, N, >= 0; others as in `force_on_journal`.
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
    r"""A, B, C: $\int\sin^2, \sin\cos, \cos^2\;(1+\epsilon\cos\theta)^{-3}d\theta$ on $[\theta_1,\theta_1+\pi]$.

    $\theta_1 = atan2(v_r, -v_t)$ starts the half with positive pressure. Sommerfeld's substitution
    $g = atan2(\sqrt{1-\epsilon^2}\sin\theta, \cos\theta+\epsilon)$ makes the integrals elementary:
    no cancellation at eps -> 0 (A = C = pi/2, B = 0).
    """
    along = tiny - v_t
    speed = safe_norm(v_r, along)
    sin1, cos1 = v_r / speed, along / speed
    one = 1.0 - jnp.square(eps)
    root = jnp.sqrt(one)
    g1 = jnp.arctan2(root * sin1, cos1 + eps)
    g2 = jnp.arctan2(-root * sin1, eps - cos1)
    g2 = jnp.where(g2 <= g1, g2 + 2.0 * jnp.pi, g2)
    s1, c1, s2, c2 = jnp.sin(g1), jnp.cos(g1), jnp.sin(g2), jnp.cos(g2)
    half = 0.5 * (g2 - g1)
    double = 0.5 * (s2 * c2 - s1 * c1)  # [sin(2g)/4]
    a = (half - double) / (one * root)
    b = (0.5 * (s2 * s2 - s1 * s1) + eps * (c2 - c1)) / (one * one)
    c = (half + double - 2.0 * eps * (s2 - s1) + 2.0 * jnp.square(eps) * half) / (one * one * root)
    return a, b, c


def _static_stiffness(eps: Values, contact: Values) -> tuple[Batch, Batch]:
    """Radial and tangential force over eps, in units of the reference (pi/2) K c |mean speed|."""
    eps_s = saturated_eccentricity(eps)
    one = 1.0 - jnp.square(eps_s)
    # the overlap underflows to 0 below eps = 0.25, so the double where changes nothing
    loaded = eps > 0.1
    secant = jnp.where(loaded, eccentricity_overlap(eps) / jnp.where(loaded, eps, 1.0), 0.0)
    return (4.0 / jnp.pi) * eps_s / jnp.square(one) + contact * secant, one**-1.5


def _static_balance(eps: Array, args: tuple[Array, Array] | list[Array]) -> Array:
    """asinh(W(eps)) - asinh(load): linear for small loads, logarithmic for large ones."""
    load, contact = args
    radial, tangential = _static_stiffness(eps, contact)
    return jnp.arcsinh(eps * safe_norm(radial, tangential)) - jnp.arcsinh(load)
