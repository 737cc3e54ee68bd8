"""Roller loads of a lubricated bearing from the approach of the rings: the equation of one roller, a guess of all
loads, and the load distribution for given roller speeds and positions (source eqs. (37)-(39), (41))."""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Values
from ...contacts import LineContact
from ...contacts.film import MARTIN_CONSTANT
from ...contacts.laws import ContactLaws
from ...lubricants import InletOil, Lubricant
from ...numerics.arrow import AbstractArrowSystem, ArrowPoint
from ...numerics.plain_newton import plain_newton
from ...numerics.roots import monotone_root
from ...numerics.safe import positive_power, safe_norm
from ..inlet import of_inner_race
from ..ring import LENGTH_UNIT

LOG_LOAD_RANGE = (-40.0, 18.0)
"""Bounds of ln(load / 1 N) in the iteration."""
LEAST_SPEED = 1e-3
"""Added to the mean surface speed in `RaceLoads.smoothed`, m/s, so that there is a film at rest too."""
LEAST_LOAD = 1e-3
"""Small load, N, that is added to the load on the ring to avoid divisions by 0."""


def per_race(values: Array) -> Float[Array, "2"]:
    """Values of a contact property at the inner and the outer race. **Arguments:** `values`: one number for both races,
    or an array of shape (2, 1)."""
    return jnp.broadcast_to(values, (2, 1))[:, 0]


def approach_error(
    approach: Float[Array, "2 roller"], film: Float[Array, "2 roller"], opening: Float[Array, " roller"]
) -> Float[Array, " roller"]:
    """Residual of the approach equation of a roller: elastic approaches + opening = film thicknesses.

    Negative openings go to the other side, and the residual is the logarithm of the ratio of the two sides. It is
    nearly linear in ln Q both for a film in a gap and for a contact with negligible film.

    **Arguments:** `approach`, `film`: on both races, m; `opening`: between the rings at each roller, m.
    """
    apart = jnp.sum(approach, axis=0) + jnp.maximum(opening, 0.0)
    together = jnp.sum(film, axis=0) + jnp.maximum(-opening, 0.0)
    return jnp.log(apart / together)


def floating_films(
    contact: LineContact, laws: ContactLaws, inlet: InletOil, mean_speed: Float[Array, "2"], load: Array
) -> tuple[Array, Array]:
    """Films of a first guess: the sum of the films on both races under a load, N, in m, and the constant of Martin's
    film force of a rigid roller, force times gap, N m. **Arguments:** `mean_speed`: on both races, m/s."""
    film = laws.film.log_thickness(contact, load, mean_speed[:, None], inlet.viscosity, inlet.pressure_viscosity)
    size = per_race(contact.reduced_radius * contact.length)[0]
    return jnp.sum(jnp.exp(film)), MARTIN_CONSTANT * of_inner_race(inlet.viscosity) * jnp.abs(mean_speed[0]) * size


def guessed_loads(
    contact: LineContact,
    laws: ContactLaws,
    inlet: InletOil,
    mean_speed: Float[Array, "2"],
    cosine: Float[Array, " roller"],
    total: Float[Array, ""],
    centrifugal: Float[Array, ""],
    opening: Float[Array, "*roller"],
) -> tuple[Float[Array, ""], Float[Array, " roller"]]:
    """First guess of the ring displacement along the load, m, and of ln Qi.

    The loads are those of a dry elastic bearing whose clearance is reduced by the films, plus Martin's film force on
    the rollers outside the loaded zone. The displacement is the one at which they carry the load.

    **Arguments:**
    - `mean_speed`, m/s, and `centrifugal`, N: mean surface speeds and centrifugal force of a typical roller.
    - `cosine`: cosine of the angle between each roller and the load.
    - `total`: load on the ring, N.
    - `opening`: opening between races and roller if the ring is not displaced along the load, m.
    """
    film, martin = floating_films(contact, laws, inlet, mean_speed, total * 4.0 / cosine.shape[0] + centrifugal + 1.0)
    kappa = per_race(contact.palmgren_compliance)
    stiff = jnp.sum(kappa)

    def loads(shift, args):
        film_, martin_, centrifugal_, clearance, cosine_, _, compliance = args
        compression = shift * cosine_ - clearance + film_
        elastic = positive_power(positive_power(compression / compliance, 10.0 / 9.0) - 0.5 * centrifugal_, 1.0 + 1e-9)
        return elastic + martin_ / (jnp.maximum(-compression, 0.0) + film_)

    def balance(shift, args):
        return jnp.sum(loads(shift, args) * args[4]) / args[5] - 1.0

    args = (film, martin, centrifugal, opening, cosine, total, stiff)
    high = jnp.max(opening) + stiff * (total + centrifugal) ** 0.9
    low = jnp.minimum(-high, -LENGTH_UNIT)
    high = jnp.maximum(high, LENGTH_UNIT)
    shift = monotone_root(balance, args, low, high, high, tolerance=1e-6).value
    return shift, jnp.clip(jnp.log(loads(shift, args)), *LOG_LOAD_RANGE)


class RaceLoads(AbstractArrowSystem):
    """Equations of the roller loads for given positions and speeds of the rollers. The unknowns are ln Qi of each
    roller and the ring displacement.

    `radial_clearance`: half the diametral clearance, m; if the rings are not round, their radial opening at each
    roller.
    """

    contact: LineContact
    laws: ContactLaws
    oil: Lubricant
    inlet: InletOil
    directions: Float[Array, "freedom roller"]
    mean_speed: Float[Array, "2 roller"]
    sliding_speed: Float[Array, "2 roller"]
    centrifugal: Float[Array, " roller"]
    ring_load: Float[Array, " freedom"]
    radial_clearance: Float[Array, "*roller"]

    def load_scale(self) -> Array:
        """Scale of the load balance, N: the load on the ring and a typical centrifugal force, added in squares. It is
        not 0 without load."""
        return safe_norm(jnp.sqrt(jnp.sum(jnp.square(self.ring_load))), jnp.mean(self.centrifugal) + LEAST_LOAD)

    def equation_names(self) -> tuple[str, ...]:
        return ("approach of the rings at a roller", *("load balance of the ring" for _ in self.ring_load))

    def step_caps(self) -> ArrowPoint:
        return ArrowPoint(jnp.asarray([[3.0]]), jnp.full(self.ring_load.shape, 5.0))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        low, high = LOG_LOAD_RANGE
        ring = jnp.full(self.ring_load.shape, 1e4)
        return ArrowPoint(jnp.asarray([[low]]), -ring), ArrowPoint(jnp.asarray([[high]]), ring)

    def initial(self) -> ArrowPoint:
        total = safe_norm(jnp.sqrt(jnp.sum(jnp.square(self.ring_load))), LEAST_LOAD)
        along = self.ring_load / total
        cosine = jnp.sum(along[:, None] * self.directions, axis=0)
        speed, centrifugal = jnp.mean(self.mean_speed, axis=1), jnp.mean(self.centrifugal)
        shift, log_load = guessed_loads(
            self.contact, self.laws, self.inlet, speed, cosine, total, centrifugal, self.radial_clearance
        )
        return ArrowPoint(log_load[None, :], along * shift / LENGTH_UNIT)

    def element(self, unknowns, shared):
        load = self.both(unknowns[0])
        film, residual = self.laws.separation(
            self.contact, load, self.mean_speed, self.sliding_speed, self.oil, self.inlet
        )
        opening = self.radial_clearance - jnp.sum(shared * self.directions, axis=0) * LENGTH_UNIT
        error = approach_error(self.contact.palmgren_approach(load), film, opening)
        return error[None, :], load[0][None, :] * self.directions, jnp.max(residual)

    def global_residual(self, globals_, totals):
        return (totals - self.ring_load) / self.load_scale(), jnp.zeros(())

    def smoothed(self, point: ArrowPoint) -> ArrowPoint:
        """The unknowns in a form that changes smoothly with the roller positions, for extrapolation over time.

        The slope of ln Q over time jumps where a roller enters the loaded zone. In its place stands k Q - M/Q in units
        of `LENGTH_UNIT`: the compression of a linear spring minus the thickness of a Martin film. This is roughly the
        approach of the rings at the roller.
        """
        spring, film = self._gap_law()
        load = jnp.exp(point.elements)
        return ArrowPoint(spring * load - film / load, point.globals)

    def unsmoothed(self, smooth: ArrowPoint) -> ArrowPoint:
        """The inverse of `smoothed`."""
        spring, film = self._gap_law()
        closing = smooth.elements
        root = jnp.sqrt(jnp.square(closing) + 4.0 * spring * film)
        pressed = closing > 0
        # each branch avoids cancellation
        load = jnp.where(pressed, root + closing, 4.0 * spring * film / (root - jnp.where(pressed, 0.0, closing)))
        return ArrowPoint(jnp.clip(jnp.log(load / (2.0 * spring)), *LOG_LOAD_RANGE), smooth.globals)

    def _gap_law(self) -> tuple[Array, Array]:
        """Constants k, 1/N, and M, N, of `smoothed` for a typical roller; lengths in `LENGTH_UNIT`."""
        typical = 4.0 * self.load_scale() / self.centrifugal.shape[0]
        spring = jnp.sum(per_race(self.contact.palmgren_compliance)) * typical**-0.1 / LENGTH_UNIT
        size = per_race(self.contact.reduced_radius * self.contact.length)[0]
        speed = jnp.abs(jnp.mean(self.mean_speed[0])) + LEAST_SPEED
        return spring, MARTIN_CONSTANT * self.inlet.viscosity * speed * size / LENGTH_UNIT

    def both(self, log_load: Float[Array, " roller"]) -> Float[Array, "2 roller"]:
        """Loads on both races, N, from ln Qi."""
        inner = jnp.exp(log_load)
        return jnp.stack([inner, inner + self.centrifugal])


class Distribution(NamedTuple):
    """A load distribution.

    - `load`: on both races, N.
    - `ring`: displacement of the inner ring along its degrees of freedom, m.
    - `residual`: scaled residual of the solve.
    - `point`: the unknowns, which can be the guess for a similar state.
    """

    load: Float[Array, "2 roller"]
    ring: Float[Array, " freedom"]
    residual: Float[Array, ""]
    point: ArrowPoint


def distributed_loads(
    system: RaceLoads, tolerance: Values, max_steps: int, guess: ArrowPoint | None = None
) -> Distribution:
    """Solves for the loads of all rollers together. First derivatives are implicit. The cost is proportional to the
    number of rollers."""
    if guess is None:
        guess = jax.lax.stop_gradient(system).initial()
    root = plain_newton(system, guess, tolerance=tolerance, max_steps=max_steps)
    load, ring = system.both(root.point.elements[0]), root.point.globals * LENGTH_UNIT
    return Distribution(load, ring, root.residual, root.point)
