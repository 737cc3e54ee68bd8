"""Roller between the walls of its cage pocket: balance of two rigid films, and the film at one compliant wall."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.compiling import compiled_by_hand
from ..numerics.roots import monotone_root
from ..numerics.safe import log_add
from ..numerics.structure import switch
from .martin import MARTIN_LOAD, MARTIN_ROLLING, MARTIN_SHEAR, martin_factors

SPIN_FLOOR = 1.0
"""Smoothing of |spin|, rad/s: keeps a film on a roller at rest and raises the load speed by 1.4e-8 at 6000 rad/s."""
LOG_LOAD_RANGE = (-80.0, 35.0)
"""Bracket of ln(load/N) at a compliant wall."""
LOAD_STEP = 1e-5
"""Largest last step in the search for ln(load), which leaves an error of about its cube."""


class PocketFilm(NamedTuple):
    """Films (m), loads (N) and friction forces (N) on the front and the rear pocket wall."""

    film_front: Batch
    film_rear: Batch
    load_front: Batch
    load_rear: Batch
    friction_front: Batch
    friction_rear: Batch


class Pocket(Checked):
    r"""A roller floating between two flat parallel walls, with rigid Martin films and without squeeze.

    The front wall is ahead of the roller in the sense of orbit. The films fill the clearance, $H_1 + H_2 = J_p$, and
    the load on each wall is $Q = k/H \ge 0$, $k = 2.447\,\mu URL$ (entrainment U/2).

    In the load the surface speed is $U = R_R\sqrt{s^2 + 1}$ (s the spin in rad/s; see `SPIN_FLOOR`), so that a film
    remains at rest; in the friction it is $R_R s$, so that friction vanishes at rest and its power is >= 0.
    The friction is the Couette force only; `rolling=True` adds half of the pressure-flow force, P/2, the part that has
    a moment on the roller.

    **Validity:** rigid, isoviscous, no side leakage (`side_leakage_factor`), light loads; for shocks use
    `CompliantPocketFace`.
    **Reference:** Martin (1916); Dowson, Markho and Jones (1976); source, Table 3 row 2.

    **Arguments:**
    - `clearance`: J_p, TOTAL circumferential clearance of the roller, front and rear together, m, > 0.
    - `length`: L of the roller along the walls, m, > 0.
    - `roller_radius`: R_R, m, > 0.
    - `rolling`: whether half of the pressure-flow force counts as friction; structure.
    """

    clearance: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    roller_radius: Scalar = bounded("> 0")
    rolling: bool = switch("rolling", False)

    def balance(self, net_load: Values, spin_speed: Values, viscosity: Values) -> PocketFilm:
        r"""Films that carry a given net load, in closed form.

        $H_1 = 2kJ_p/(PJ_p + 2k + \sqrt{(PJ_p)^2 + 4k^2})$ is evaluated for the thinner film; the other one is $J_p$
        minus it, so that nothing cancels at any |P|.

        **Arguments:**
        - `net_load`: P = front load minus rear load, N, of either sign (the roller pushes on the front wall when the
          cage holds it back).
        - `spin_speed`: spin relative to the cage, rad/s, positive in the sense in which an orbiting roller spins
          (against the orbit). The friction forces have its sign; their moment R_R (front + rear) opposes the spin.
        - `viscosity`, Pa s.
        """
        spin_speed = jnp.asarray(spin_speed)
        load_speed = self.roller_radius * jnp.sqrt(jnp.square(spin_speed) + SPIN_FLOOR**2)
        k = 0.5 * MARTIN_LOAD * viscosity * load_speed * (self.roller_radius * self.length)
        forward = jnp.asarray(net_load) >= 0
        # `where` and not `abs`, whose slope is 0 at P = 0, where the films depend on P
        push = jnp.where(forward, net_load, -jnp.asarray(net_load)) * self.clearance
        tight = 2.0 * k * self.clearance / (push + 2.0 * k + jnp.sqrt(jnp.square(push) + 4.0 * jnp.square(k)))
        wide = self.clearance - tight
        front = jnp.where(forward, tight, wide)
        rear = jnp.where(forward, wide, tight)
        factor = MARTIN_SHEAR + (0.25 * MARTIN_ROLLING if self.rolling else 0.0)  # P/2 at u = U/2
        drag = factor * viscosity * (self.roller_radius * spin_speed) * self.length
        return PocketFilm(
            film_front=front,
            film_rear=rear,
            load_front=k / front,
            load_rear=k / rear,
            friction_front=drag * jnp.sqrt(2.0 * self.roller_radius / front),
            friction_rear=drag * jnp.sqrt(2.0 * self.roller_radius / rear),
        )


class PocketFace(NamedTuple):
    """Results at one compliant wall: load (N), film (m), friction on the roller (N, signed as the surface speed),
    residual of the gap equation relative to the film."""

    load: Batch
    film: Batch
    friction: Batch
    residual: Batch


class CompliantPocketFace(Checked):
    r"""Squeeze film between a roller and one flat compliant wall, for any rigid gap, also negative.

    The load Q follows from $h(Q) - \delta(Q) = H$, the rigid gap, with the film $h = (h_M^3 + h_E^3)^{1/3}$ of Martin's
    film with squeeze, $h_M = \mu uRLG_w(s)/Q$, and Dowson and Higginson's elastic film,
    $h_E = 2.65R(\mu u/E'R)^{0.7}(\alpha E')^{0.54}(Q/E'RL)^{-0.13}$, and with Palmgren's flattening
    $\delta = 0.39(8/E')^{0.9}L^{-0.8}Q^{0.9}$. The speed is $u = \sqrt{U^2+U_{min}^2}/2$, the squeeze number
    $s = (\dot H/u)\sqrt{2R/h_s}$ with $h_s = (H+\sqrt{H^2+4h_{min}^2})/2$.

    **Limits:** wide gap: Martin; deep overlap: Palmgren's flattening. The blend exceeds the larger of the two films by
    at most 26 %.
    **Validity:** E' is 2/[(1-v1^2)/E1 + (1-v2^2)/E2]; no side leakage.
    **Reference:** Martin (1916); Dowson, Markho and Jones (1976); Dowson and Higginson (1966);
    Palmgren (1959), source eq. (41).

    **Arguments:**
    - `roller_radius`: R, m, > 0.
    - `length`: L along the wall, m, > 0.
    - `reduced_modulus`: E', Pa, > 0.
    - `pressure_viscosity`: alpha, 1/Pa, >= 0.
    - `minimum_speed`: U_min, floor of the surface speed, m/s, > 0.
    - `minimum_film`: h_min, floor of the film in the squeeze number, m, > 0.
    """

    roller_radius: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    reduced_modulus: Scalar = bounded("> 0")
    pressure_viscosity: Scalar = bounded(">= 0")
    minimum_speed: Scalar = bounded("> 0", default=0.5)
    minimum_film: Scalar = bounded("> 0", default=0.3e-6)

    @property
    def compliance(self) -> Scalar:
        """Constant k of the flattening k Q^0.9, m/N^0.9."""
        return 0.39 * (8.0 / self.reduced_modulus) ** 0.9 / self.length**0.8

    def flattening_energy(self, load: Values) -> Batch:
        r"""Elastic energy of the flattening, J: $\int Q\,d\delta = \tfrac{0.9}{1.9}kQ^{1.9}$, Q the `load`, N."""
        return 0.9 / 1.9 * self.compliance * jnp.asarray(load) ** 1.9

    @compiled_by_hand
    def face(self, gap: Values, gap_rate: Values, surface_speed: Values, viscosity: Values) -> PocketFace:
        """Load, film and friction at a rigid gap.

        **Arguments:** `gap`, H, m, any sign; `gap_rate`, dH/dt, m/s; `surface_speed`, of the roller
        along the wall, m/s, signed; `viscosity`, Pa s.
        """
        speed = 0.5 * jnp.sqrt(jnp.square(surface_speed) + jnp.square(self.minimum_speed))
        gap = jnp.asarray(gap)
        root = jnp.sqrt(jnp.square(gap) + 4.0 * jnp.square(self.minimum_film))
        positive = gap >= 0
        # below contact the difference cancels: use the conjugate
        closed = 2.0 * jnp.square(self.minimum_film) / (root - jnp.where(positive, 0.0, gap))
        smooth_gap = jnp.where(positive, 0.5 * (gap + root), closed)
        factors = martin_factors(gap_rate / speed * jnp.sqrt(2.0 * self.roller_radius / smooth_gap))

        modulus, radius = self.reduced_modulus, self.roller_radius
        log_martin = jnp.log(viscosity * speed * (radius * self.length) * factors.load)
        log_elastic = (
            jnp.log(2.65 * radius)
            + 0.7 * jnp.log(viscosity * speed / (modulus * radius))
            + 0.54 * jnp.log(self.pressure_viscosity * modulus)
            + 0.13 * jnp.log(modulus * radius * self.length)
        )
        log_flat = jnp.log(self.compliance)
        args = tuple(jnp.broadcast_arrays(gap, log_martin, log_elastic, log_flat))
        pressed = (jnp.log(jnp.maximum(self.minimum_film, -gap)) - log_flat) / 0.9
        guess = jnp.where(gap < -self.minimum_film, pressed, log_martin - jnp.log(smooth_gap))
        z = monotone_root(
            _face_balance,
            args,
            *LOG_LOAD_RANGE,
            guess + jnp.zeros_like(args[0]),
            tolerance=LOAD_STEP,
            expansion=_face_expansion,
        )
        film = _face_film(z.value, args[1], args[2])
        drag = viscosity * surface_speed * self.length * factors.shear
        return PocketFace(
            load=jnp.exp(z.value),
            film=film,
            friction=drag * jnp.sqrt(2.0 * radius / film),
            residual=z.residual / film,
        )


def _face_film(log_load: Array, log_martin: Array, log_elastic: Array) -> Array:
    """Film (hM^3 + hE^3)^(1/3), m, at ln Q."""
    return jnp.exp(log_add(3.0 * (log_martin - log_load), 3.0 * (log_elastic - 0.13 * log_load)) / 3.0)


def _face_balance(log_load: Array, args: tuple[Array, Array, Array, Array]) -> Array:
    """Residual of the gap equation, H + flattening - film, m: increasing in ln Q."""
    gap, log_martin, log_elastic, log_flat = args
    return gap + jnp.exp(log_flat + 0.9 * log_load) - _face_film(log_load, log_martin, log_elastic)


def _face_expansion(log_load: Array, args: tuple[Array, Array, Array, Array]) -> tuple[Array, Array, Array]:
    r"""Value of `_face_balance` and its first and second derivative with respect to z = ln Q.

    With $M = h_M^3$, $E = h_E^3$ and a = E/(M + E): $h = (M + E)^{1/3}$, $h' = -(1 - 0.87a)h$,
    $h'' = [(1 - 0.87a)^2 + 3\,0.87^2a(1 - a)]h$.
    """
    gap, log_martin, log_elastic, log_flat = args
    flat = jnp.exp(log_flat + 0.9 * log_load)
    # no overflow within the bracket: cubes of films of 1e-12 m to 1e30 m
    martin, elastic = jnp.exp(3.0 * (log_martin - log_load)), jnp.exp(3.0 * (log_elastic - 0.13 * log_load))
    total = martin + elastic
    film = jnp.exp(jnp.log(total) / 3.0)
    share = elastic / total
    fall = 1.0 - 0.87 * share
    # d(share)/dz = 3 (1 - 0.13) share (1 - share)
    bend = fall * fall + 3.0 * 0.87**2 * share * (1.0 - share)
    return gap + flat - film, 0.9 * flat + film * fall, 0.81 * flat - film * bend


def side_leakage_factor(length: Values, radius: Values, film: Values) -> Batch:
    r"""Load of a film of finite length over that of a long one, $1/(1 + 1.58/\lambda + 3.3/\lambda^2)$.

    $\lambda = L/\sqrt{2Rh_0}$. Fitted to two-dimensional solutions of Reynolds' equation with p >= 0 and no squeeze:
    error <= 2 % for 2 <= lambda <= 64. No model applies it (-12 % at a film of 100 um, -1.2 % at 1 um, L = 14 mm).

    **Arguments:** `length`, `radius` (equivalent), `film` > 0, m.
    """
    require_numbers("> 0", length=length, radius=radius, film=film)
    inverse = jnp.sqrt(2.0 * jnp.asarray(radius) * film) / length
    return 1.0 / (1.0 + 1.58 * inverse + 3.3 * jnp.square(inverse))
