"""Roller loads of a lubricated bearing from the approach of the rings: the equation of one roller, a guess of all
loads, and the distribution at given speeds and places (source eqs. (37)-(39), (41))."""

from typing import TYPE_CHECKING, NamedTuple

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
from ..inlet import of_inner_race, oil_of_races
from ..ring import LENGTH_UNIT
from .kinematics import roller_kinematics

if TYPE_CHECKING:
    from .scene import CylindricalRollerBearing

LOG_LOAD_RANGE = (-40.0, 18.0)
"""ln(load / 1 N) that an iterate may take."""
LEAST_SPEED = 1e-3
"""Speed at which the film of an extrapolated load is still one, m/s."""
LEAST_LOAD = 1e-3
"""Load on the ring at which the guess still has a direction, N."""


def per_race(values: Array) -> Float[Array, "2"]:
    """A contact property, one number or of shape (2, 1), as (inner, outer)."""
    return jnp.broadcast_to(values, (2, 1))[:, 0]


def approach_error(
    approach: Float[Array, "2 roller"], film: Float[Array, "2 roller"], opening: Float[Array, " roller"]
) -> Float[Array, " roller"]:
    """0 where elastic approaches less films close the opening between the rings at a roller: the logarithm of the ratio
    of the two sides' positive terms, nearly linear in ln Q for a film in a gap and for steel on steel."""
    apart = jnp.sum(approach, axis=0) + jnp.maximum(opening, 0.0)
    together = jnp.sum(film, axis=0) + jnp.maximum(-opening, 0.0)
    return jnp.log(apart / together)


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
    """Ring displacement along the load, m, and ln Qi: a dry elastic distribution on rings swollen by the films, plus
    Martin's film force on the rollers outside the loaded zone, at the displacement that carries the load.

    **Arguments:** `cosine` of the angle between each roller and the load `total`, N; speeds and the `centrifugal`
    force, N, of a typical roller; `opening` between the races of each roller at that displacement 0, m.
    """
    kappa = per_race(contact.palmgren_compliance)
    typical = total * 4.0 / cosine.shape[0] + centrifugal + 1.0
    film = laws.film.log_thickness(contact, typical, mean_speed[:, None], inlet.viscosity, inlet.pressure_viscosity)
    film = jnp.sum(jnp.exp(film))
    # Martin's film of a rigid roller
    size = per_race(contact.reduced_radius * contact.length)[0]
    martin = MARTIN_CONSTANT * of_inner_race(inlet.viscosity) * jnp.abs(mean_speed[0]) * size
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
    """Loads of rollers whose places and speeds are given: unknowns ln Qi per roller and the ring displacement.

    `radial_clearance`: half the clearance, m, or the opening at each roller between rings that are not round.
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
        """Size of the load, N; not less than a typical centrifugal force, so that no load at all has a scale."""
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
        """The unknowns as numbers that follow the rollers' places smoothly, for extrapolation: instead of ln Q, whose
        course bends sharply where a roller enters the loaded zone, about the closing of the gap (in `LENGTH_UNIT`),
        k Q - M/Q, as of a linear spring and Martin's film."""
        spring, film = self._gap_law()
        load = jnp.exp(point.elements)
        return ArrowPoint(spring * load - film / load, point.globals)

    def unsmoothed(self, smooth: ArrowPoint) -> ArrowPoint:
        """The inverse of `smoothed`."""
        spring, film = self._gap_law()
        closing = smooth.elements
        root = jnp.sqrt(jnp.square(closing) + 4.0 * spring * film)
        pressed = closing > 0
        # no cancellation on either side
        load = jnp.where(pressed, root + closing, 4.0 * spring * film / (root - jnp.where(pressed, 0.0, closing)))
        return ArrowPoint(jnp.clip(jnp.log(load / (2.0 * spring)), *LOG_LOAD_RANGE), smooth.globals)

    def _gap_law(self) -> tuple[Array, Array]:
        """k, 1/N, and M, N, of a typical roller, in `LENGTH_UNIT`."""
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
    """Loads on both races, N, displacement of the inner ring along its degrees of freedom, m, the scaled residual, and
    the unknowns that were solved for: a guess for a bearing not far from this one."""

    load: Float[Array, "2 roller"]
    ring: Float[Array, " freedom"]
    residual: Float[Array, ""]
    point: ArrowPoint


def distributed_loads(
    system: RaceLoads, tolerance: Values, max_steps: int, guess: ArrowPoint | None = None
) -> Distribution:
    """Solve for all loads at once, with implicit (first) derivatives: O(number of rollers)."""
    if guess is None:
        guess = jax.lax.stop_gradient(system).initial()
    found = plain_newton(system, guess, tolerance=tolerance, max_steps=max_steps)
    load, ring = system.both(found.point.elements[0]), found.point.globals * LENGTH_UNIT
    return Distribution(load, ring, found.residual, found.point)


def film_growth(scene: "CylindricalRollerBearing", load: Float[Array, ""]) -> Float[Array, ""]:
    """See `AbstractBearing.film_growth`: films of rolling without sliding under the largest load of a roller of a
    bearing without clearance (Stribeck), a little more than nothing at least."""
    if scene.contact is None or scene.oil is None:
        return jnp.zeros(())
    zero = jnp.zeros((2, 1))
    speed = roller_kinematics(scene.geometry, scene.operation).surface_speeds(jnp.zeros(()), jnp.zeros(()))[0]
    most = 4.0 * jnp.asarray(load) / scene.geometry.n_rollers + 1.0
    film, _ = scene.contact.separation(
        scene.race_lines(None), most + zero, speed[:, None] + zero, zero, scene.oil, oil_of_races(scene)
    )
    return jnp.sum(film)
