"""Ball near one wall of its round cage pocket, or near another ball: rolling and squeeze together, and flattening."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.roots import monotone_root
from ..numerics.safe import safe_norm
from .ball_pocket import CUT_FILMS

LOG_LOAD_RANGE = (-80.0, 35.0)
"""Bracket of ln(load/N)."""
STEEPEST_SQUEEZE = 300.0
"""Limit of the squeeze number: beyond it the load of a separating wall is below 1e-5 of that without squeeze."""
LOAD_STEP = 1e-8
"""Last step of ln(load), whose square is left as its error."""


class BallWall(NamedTuple):
    """One wall: load, N, film, m, friction over the sliding speed, N s/m, residual of the gap equation relative to the
    film."""

    load: Batch
    film: Batch
    friction: Batch
    residual: Batch


class CompliantBallPocket(Checked):
    r"""Film between a ball and one wall of a cylindrical pocket that gives way: any rigid gap, also negative.

    For $h + x^2/2R_1 + y^2/2R_2$ Reynolds' equation with rolling and squeeze has the solution
    $p = (C + c_1x + c_2y)/h^2$, and with p = max(p, 0)

    $$W = \frac{\pi\sqrt{R_1R_2}}{h}\Bigl[C + \sqrt{C^2 + X^2}\Bigr],\quad
    C = -\frac{6\mu\dot h}{1/R_1 + 1/R_2},\quad
    X^2 = h\sum_i 2R_i\Bigl[\frac{6\mu u_i}{3 + 2R_i/R_j}\Bigr]^2.$$

    $R_1 = R_b$ along the pocket's axis, $R_2 = R_bR_p/(R_p - R_b)$ across it. The wall gives way by
    $(W/K_p)^{2/3}$: $h(W) - (W/K_p)^{2/3} = H$. In the squeeze term h is
    $h_s = (H + \sqrt{H^2 + 4h_{min}^2})/2$. The friction is $\mu uA$, $A = 2\pi\sqrt{R_1R_2}\ln\max(20, J_p/h)$.

    **Limits:** no squeeze: Kapitza's film; no entrainment: $12\pi\mu v\sqrt{R_1R_2}/[h(1/R_1 + 1/R_2)]$ for approach at
    v; a wall that separates never pulls; deep overlap: Hertz.
    **Validity:** isoviscous, half Sommerfeld. Films of some nanometres at 100 N have no meaning, and no effect: the
    flattening of some micrometres decides there.
    **Reference:** Kapitza (1955), Zh. Tekh. Fiz. 25, 747, for pure rolling; own derivation with squeeze.

    **Arguments:**
    - `ball_radius`: R_b, m, > 0.
    - `clearance`: J_p, DIAMETRAL: pocket diameter minus ball diameter, m, > 0.
    - `stiffness`: K_p of the Hertz contact of ball and pocket, N/m^(3/2), > 0.
    - `minimum_speed`: added to the speed along the pocket's axis in squares, m/s, > 0.
    - `minimum_film`: h_min of the squeeze term, m, > 0.
    """

    ball_radius: Scalar = bounded("> 0")
    clearance: Scalar = bounded("> 0")
    stiffness: Scalar = bounded("> 0")
    minimum_speed: Scalar = bounded("> 0", default=0.5)
    minimum_film: Scalar = bounded("> 0", default=0.3e-6)

    @property
    def conforming_radius(self) -> Array:
        """R_c, reduced radius across the pocket's axis, m."""
        return jnp.asarray(self.ball_radius * (2.0 * self.ball_radius + self.clearance) / self.clearance)

    def flattening_energy(self, load: Values) -> Batch:
        r"""Elastic energy of the flattening, J: $\int W\,d\delta = \tfrac25W^{5/3}/K_p^{2/3}$, W the `load`, N."""
        return 0.4 * jnp.cbrt(jnp.asarray(load)) ** 5 / jnp.cbrt(self.stiffness) ** 2

    def wall(self, gap: Values, gap_rate: Values, along: Values, across: Values, viscosity: Values) -> BallWall:
        """Load, film and friction at a rigid gap.

        **Arguments:** `gap`, H, m, any sign; `gap_rate`, dH/dt, m/s; `along`, `across`: speed of the ball's surface
        over the wall, along the pocket's axis and across it, m/s; `viscosity`, Pa s.
        """
        axial, transverse = jnp.asarray(self.ball_radius), self.conforming_radius
        speeds = (safe_norm(along, self.minimum_speed), across)
        motion = (gap_rate, *speeds, viscosity)
        load, film, residual = squeezed_film((axial, transverse), self.stiffness, self.minimum_film, gap, motion)
        area = 2.0 * jnp.pi * jnp.sqrt(axial * transverse) * jnp.log(jnp.maximum(CUT_FILMS, self.clearance / film))
        return BallWall(load, film, viscosity * area, residual)


class MeetingBalls(Checked):
    r"""Film between two like balls that meet, or contact between them: any rigid gap, also negative.

    The load is that of `CompliantBallPocket` with $R_1 = R_2 = R_b/2$. Balls that turn alike have surfaces that move
    against each other where they meet: they slide by twice that speed and carry no oil in, so that only squeeze and
    elastic contact keep them apart. The friction is $\mu uA$, $A = \pi R_b\cdot\tfrac12\ln(1 + (R_b/h)^2)$.

    **Limits:** in deep overlap Hertz; far apart the friction falls with the square of the gap.
    **Validity:** isoviscous, half Sommerfeld.
    **Reference:** as `CompliantBallPocket`; the friction is that of a parabolic gap, cut where it is as wide as R_b.

    **Arguments:**
    - `ball_radius`: R_b, m, > 0.
    - `stiffness`: of the Hertz contact of two balls, N/m^(3/2), > 0.
    - `minimum_speed`: added to the entraining speed in squares, m/s, > 0.
    - `minimum_film`: of the squeeze term, m, > 0.
    """

    ball_radius: Scalar = bounded("> 0")
    stiffness: Scalar = bounded("> 0")
    minimum_speed: Scalar = bounded("> 0", default=0.5)
    minimum_film: Scalar = bounded("> 0", default=0.3e-6)

    def flattening_energy(self, load: Values) -> Batch:
        """Elastic energy of one contact, J. **Arguments:** `load`, N."""
        return 0.4 * jnp.cbrt(jnp.asarray(load)) ** 5 / jnp.cbrt(self.stiffness) ** 2

    def contact(self, gap: Values, gap_rate: Values, entraining: Values, viscosity: Values) -> BallWall:
        """Load, film and friction at a rigid gap.

        **Arguments:** `gap`, m, any sign; `gap_rate`, m/s; `entraining`: sum of both surface speeds, m/s, >= 0;
        `viscosity`, Pa s.
        """
        ball = jnp.asarray(self.ball_radius)
        motion = (gap_rate, safe_norm(entraining, self.minimum_speed), jnp.zeros_like(entraining), viscosity)
        radii = (0.5 * ball, 0.5 * ball)
        load, film, residual = squeezed_film(radii, self.stiffness, self.minimum_film, gap, motion)
        area = 0.5 * jnp.pi * ball * jnp.log1p(jnp.square(ball / film))
        return BallWall(load, film, viscosity * area, residual)


def squeezed_film(
    radii: tuple[Array, Array], stiffness: Scalar, minimum_film: Scalar, gap: Values, motion: tuple[Values, ...]
) -> tuple[Array, Array, Array]:
    """Load, N, film, m, and residual of the gap equation relative to the film, by the law of `CompliantBallPocket`.

    **Arguments:** `radii` of the gap along two directions, m; `gap`, m; `motion`: its rate, m/s, both entraining
    speeds, m/s, and the viscosity, Pa s.
    """
    gap, (axial, transverse) = jnp.asarray(gap), radii
    gap_rate, along, across, viscosity = motion
    mean = jnp.sqrt(axial * transverse)
    entrained = lambda speed, own, other: jnp.sqrt(2.0 * own) * 6.0 * viscosity * speed / (3.0 + 2.0 * own / other)
    rolling = safe_norm(entrained(along, axial, transverse), entrained(across, transverse, axial))
    squeezed = _smooth_gap(gap, minimum_film)
    squeeze = -6.0 * viscosity * gap_rate / (1.0 / axial + 1.0 / transverse)
    number = jnp.clip(squeeze / (rolling * jnp.sqrt(squeezed)), -STEEPEST_SQUEEZE, STEEPEST_SQUEEZE)
    log_film = jnp.log(jnp.pi * mean * rolling) + jnp.arcsinh(number)
    log_stiffness = jnp.log(jnp.asarray(stiffness))
    args = tuple(jnp.broadcast_arrays(gap, log_film, log_stiffness))
    pressed = 1.5 * jnp.log(jnp.maximum(minimum_film, -gap)) + log_stiffness
    guess = jnp.where(gap < minimum_film, pressed, log_film - 0.5 * jnp.log(squeezed))
    root = monotone_root(_wall_balance, args, *LOG_LOAD_RANGE, guess + jnp.zeros_like(args[0]), tolerance=LOAD_STEP)
    film = jnp.exp(2.0 * (args[1] - root.value))
    return jnp.exp(root.value), film, root.residual / film


def _smooth_gap(gap: Array, minimum_film: Scalar) -> Array:
    """h_s: near the gap where that is wide, small and positive where the wall is pressed in, m."""
    root = jnp.sqrt(jnp.square(gap) + 4.0 * jnp.square(minimum_film))
    positive = gap >= 0
    # below contact the difference cancels: use the conjugate
    closed = 2.0 * jnp.square(minimum_film) / (root - jnp.where(positive, 0.0, gap))
    return jnp.where(positive, 0.5 * (gap + root), closed)


def _wall_balance(log_load: Array, args: tuple[Array, Array, Array]) -> Array:
    """H + flattening - film: increasing in ln W."""
    gap, log_film, log_stiffness = args
    return gap + jnp.exp((log_load - log_stiffness) * (2.0 / 3.0)) - jnp.exp(2.0 * (log_film - log_load))
