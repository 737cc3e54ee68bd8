"""Ball at one wall of its round pocket: a film with rolling and squeeze, between rigid or compliant bodies."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.compiling import compiled_by_hand
from ..numerics.roots import monotone_root
from ..numerics.safe import safe_norm
from .ball_pocket import CUT_FILMS

LOG_LOAD_RANGE = (-80.0, 35.0)
"""Bracket of ln(load/N)."""
LOAD_STEP = 1e-5
"""Largest last step in the search for ln(load), which leaves an error of about its cube."""


class BallPocketFace(NamedTuple):
    """Results of one wall: load (N), film (m), friction along and across the pocket's axis (N, with the signs of the
    surface speeds), residual of the gap equation relative to the film."""

    load: Batch
    film: Batch
    friction_along: Batch
    friction_across: Batch
    residual: Batch


class CompliantBallPocketFace(Checked):
    r"""Film between a ball and one compliant wall of its round pocket, for any rigid gap, also negative.

    For a gap $h + x^2/2R_1 + y^2/2R_2$ Reynolds' equation with entrainment and squeeze has the exact solution
    $p = (C + c_1x + c_2y)/(h + x^2/2R_1 + y^2/2R_2)^2$. With half Sommerfeld cavitation, $\max(p, 0)$, it carries

    $$W = \frac{\pi\sqrt{R_1R_2}}{h}\left[C + \sqrt{C^2 + X^2}\right],\quad C = \frac{-6\mu\dot h}{1/R_1 + 1/R_2},\quad
    X^2 = h\sum_i 2R_i\left[\frac{6\mu u_i}{3 + 2R_i/R_j}\right]^2,$$

    axis 1 along the pocket's axis with $R_1 = R_b$, axis 2 across it with $R_2 = R_c = R_bR_p/(R_p - R_b)$. The wall
    deflects by Hertz' $(W/K)^{2/3}$, and W follows from $h(W) - (W/K)^{2/3} = H$, the rigid gap. In the ratio of C to X
    the film is replaced by $h_s = (H + \sqrt{H^2 + 4h_{min}^2})/2$, so that $h = (A/W)^2$ with A independent of W:
    $A = \pi\sqrt{R_1R_2}X_0e^{\mathrm{asinh}\,s}$, $X_0 = X/\sqrt h$, $s = C/(X_0\sqrt{h_s})$.
    In the load, the speed along the axis is $\sqrt{u_1^2 + u_{min}^2}$.

    The friction is $\mu u_iA_h$, $A_h = 2\pi\sqrt{R_1R_2}\ln\max(20, J_p/h)$.

    **Limits:** no squeeze: `BallPocket`; no entrainment: $12\pi\mu v\sqrt{R_1R_2}/[h(1/R_1 + 1/R_2)]$, $v = -\dot h$;
    separation: the load falls as 1/speed and stays positive; deep overlap: Hertz.
    **Validity:** isoviscous. Film thicknesses of a few nanometres (at 100 N) have no physical meaning; the load is
    then that of the elastic flattening.
    **Reference:** Kapitza (1955), Zh. Tekh. Fiz. 25, 747, for rolling alone; the solution with squeeze is checked
    against Reynolds' equation and by quadrature (`tests/gaps/test_ball_pocket_face.py`).

    **Arguments:**
    - `clearance`: J_p, DIAMETRAL: pocket diameter minus ball diameter, m, > 0.
    - `ball_radius`: R_b, m, > 0.
    - `stiffness`: K of Hertz' law between ball and wall (radii R_b and R_c), N/m^1.5, > 0.
    - `minimum_speed`: u_min, floor of the speed along the axis, m/s, > 0.
    - `minimum_film`: h_min, floor of the film in the ratio of squeeze to entrainment, m, > 0.
    """

    clearance: Scalar = bounded("> 0")
    ball_radius: Scalar = bounded("> 0")
    stiffness: Scalar = bounded("> 0")
    minimum_speed: Scalar = bounded("> 0", default=0.5)
    minimum_film: Scalar = bounded("> 0", default=0.3e-6)

    @property
    def conforming_radius(self) -> Scalar:
        """Reduced radius R_c across the pocket's axis, m."""
        return self.ball_radius * (2.0 * self.ball_radius + self.clearance) / self.clearance

    def elastic_energy(self, load: Values) -> Batch:
        r"""Elastic energy of the wall, J: $\int W\,d\delta = \tfrac25W^{5/3}/K^{2/3}$, W the `load`, N."""
        return 0.4 * jnp.asarray(load) ** (5.0 / 3.0) / self.stiffness ** (2.0 / 3.0)

    def rigid_load(
        self, film: Values, film_rate: Values, speed_along: Values, speed_across: Values, viscosity: Values
    ) -> Batch:
        """Load W of a rigid wall, N; `minimum_speed` does not count here.

        **Arguments:** `film`, h, m, > 0; `film_rate`, dh/dt, m/s; `speed_along`, `speed_across`, of the ball's surface
        at the wall, m/s; `viscosity`, Pa s.
        """
        rolling = jnp.sqrt(film) * self._entrainment(speed_along, speed_across, viscosity)
        squeeze = self._squeeze(film_rate, viscosity)
        # on separation the sum cancels: use the conjugate
        length = safe_norm(squeeze, rolling)
        apart = squeeze < 0
        both = jnp.square(rolling) / (length - jnp.where(apart, squeeze, 0.0))
        mean_radius = jnp.sqrt(self.ball_radius * self.conforming_radius)
        return jnp.pi * mean_radius / film * jnp.where(apart, both, squeeze + length)

    def _squeeze(self, film_rate: Values, viscosity: Values) -> Batch:
        """Squeeze term C, N."""
        radii = 1.0 / self.ball_radius + 1.0 / self.conforming_radius
        return -6.0 * viscosity * jnp.asarray(film_rate) / radii

    def _entrainment(self, speed_along: Values, speed_across: Values, viscosity: Values) -> Batch:
        """Entrainment term X over the root of the film, N/m^0.5."""
        radius, across = self.ball_radius, self.conforming_radius
        first = speed_along * jnp.sqrt(radius) / (3.0 + 2.0 * radius / across)
        second = speed_across * jnp.sqrt(across) / (3.0 + 2.0 * across / radius)
        return 6.0 * jnp.sqrt(2.0) * viscosity * safe_norm(first, second)

    @compiled_by_hand
    def face(
        self, gap: Values, gap_rate: Values, speed_along: Values, speed_across: Values, viscosity: Values
    ) -> BallPocketFace:
        """Load, film and friction at a rigid gap.

        **Arguments:** `gap`, H, m, any sign; `gap_rate`, dH/dt, m/s; `speed_along`, `speed_across`, of the ball's
        surface at the wall along and across the pocket's axis, m/s, signed; `viscosity`, Pa s.
        """
        least = jnp.sqrt(jnp.square(speed_along) + jnp.square(self.minimum_speed))
        rolling = self._entrainment(least, speed_across, viscosity)
        mean_radius = jnp.sqrt(self.ball_radius * self.conforming_radius)
        entering = Entering(self._squeeze(gap_rate, viscosity), rolling, mean_radius)
        load, film, residual = yielding_film(gap, entering, self.stiffness, self.minimum_film)
        area = 2.0 * jnp.pi * mean_radius * jnp.log(jnp.maximum(CUT_FILMS, self.clearance / film))
        return BallPocketFace(
            load=load,
            film=film,
            friction_along=viscosity * speed_along * area,
            friction_across=viscosity * speed_across * area,
            residual=residual,
        )


class Entering(NamedTuple):
    """Terms of the load of a film, see `CompliantBallPocketFace`: `squeeze`, C, N; `rolling`, X over the root of the
    film, N/m^0.5; `mean_radius`, root of R_1 R_2, m."""

    squeeze: Batch
    rolling: Batch
    mean_radius: Values


def yielding_film(
    gap: Values, entering: Entering, stiffness: Scalar, minimum_film: Scalar
) -> tuple[Array, Array, Array]:
    """Load, N, film, m, and residual relative to the film at a compliant wall, see `CompliantBallPocketFace`.

    **Arguments:** `gap`, H, m, of either sign; `entering`, terms of the load; `stiffness`, N/m^1.5; `minimum_film`, m.
    """
    gap = jnp.asarray(gap)
    root = jnp.sqrt(jnp.square(gap) + 4.0 * jnp.square(minimum_film))
    positive = gap >= 0
    # below contact the difference cancels: use the conjugate
    closed = 2.0 * jnp.square(minimum_film) / (root - jnp.where(positive, 0.0, gap))
    smooth_gap = jnp.where(positive, 0.5 * (gap + root), closed)
    ratio = entering.squeeze / (entering.rolling * jnp.sqrt(smooth_gap))
    log_rigid = jnp.log(jnp.pi * entering.mean_radius * entering.rolling) + jnp.arcsinh(ratio)
    log_stiffness = jnp.log(stiffness)
    args = tuple(jnp.broadcast_arrays(gap, log_rigid, log_stiffness))
    pressed = 1.5 * jnp.log(jnp.maximum(minimum_film, -gap)) + log_stiffness
    guess = jnp.where(gap < minimum_film, pressed, log_rigid - 0.5 * jnp.log(smooth_gap))
    z = monotone_root(
        _balance,
        args,
        *LOG_LOAD_RANGE,
        guess + jnp.zeros_like(args[0]),
        tolerance=LOAD_STEP,
        expansion=_expansion,
    )
    film = jnp.exp(2.0 * (log_rigid - z.value))
    return jnp.exp(z.value), film, z.residual / film


def _balance(log_load: Array, args: tuple[Array, Array, Array]) -> Array:
    """Residual of the gap equation, H + flattening - film, m: increasing in ln W."""
    gap, log_rigid, log_stiffness = args
    return gap + jnp.exp(2.0 / 3.0 * (log_load - log_stiffness)) - jnp.exp(2.0 * (log_rigid - log_load))


def _expansion(log_load: Array, args: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
    """Value of `_balance` and its first and second derivative with respect to ln W."""
    gap, log_rigid, log_stiffness = args
    flat = jnp.exp(2.0 / 3.0 * (log_load - log_stiffness))
    film = jnp.exp(2.0 * (log_rigid - log_load))
    return gap + flat - film, 2.0 / 3.0 * flat + 2.0 * film, 4.0 / 9.0 * flat - 4.0 * film
