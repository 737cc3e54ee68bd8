r"""Equations of lubricated rollers that tilt, with or without sliding friction and a cage.

Each roller has one unknown more than a roller that carries evenly (`equations`): its tilt phi, which moves its end s =
l outwards. The approaches of its contacts at s are $\delta_o = f_o + \phi s$ and $\delta_i = f_i + (\tau' - \phi) s$.
The slope $\tau'$ is that of the inner race against the outer one at the roller (`tilting`). For a given slope a contact
carries the load Q of its roller at one $f$ only (`AbstractTiltedLine.approach_under`). The equations of the normal
direction are

- approach: the sum of both approaches in the middle of the roller, less both films, is the closing of the rings. The
  films are those of the whole contacts, as for rollers that carry evenly;
- moment: $M_o = M_i$ about the middle of the roller.

Films for friction, traction and rolling resistance are those of the laminae of each contact, each with its share of the
load. All laminae of a contact have one sliding speed, because a roller without skew is a cylinder between cylinders.
Forces, cage and power are those of `equations`. The tilting moment of friction on the rings is left out.
"""

import dataclasses
from typing import ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...contacts.laws import ContactLaws
from ...contacts.mixed import MixedState
from ...lubricants import InletOil, Lubricant
from ...numerics.arrow import ArrowPoint
from ...numerics.safe import largest
from ..elastic_ring import ElasticRing
from ..inlet import OilElsewhere
from ..ring import LENGTH_UNIT, InnerRing
from ..tapered.system import MOST_TILT
from .equations import APPROACH, LOG_LOAD_STEP, AbstractLubricatedRollers, LoadsAlong, PressedRollers, RollerState
from .forces import CageParts
from .kinematics import RollerKinematics
from .loads import LEAST_LOAD, LOG_LOAD_RANGE, approach_error, floating_films
from .tilting import TiltingRollers

FRICTION_LAMINAE = 10
"""Number of laminae for films and friction of straight rollers."""
FLOOR = 1e-8
"""Least load of a lamina, over the mean load of the laminae of its contact."""
LEAST_SHARE = 1e-3
"""Load of a lamina, over the largest of its contact, from which its film is a result."""
SOFT = 1e-3
"""Part of the films that is added to both sides of the equation of the approach, so that no side is 0 where only the
ends of a roller touch."""


class LubricatedTiltingSystem(AbstractLubricatedRollers[PressedRollers]):
    """Lubricated rollers that tilt (see the module). The unknowns of the normal direction are ln Qi and the tilt.

    - `dry`: the same bearing without friction and films, whose raceways and contact lines are used. Its guess, the
      equilibrium of the dry bearing, is where the iteration starts.
    - `heavier`: factor of the loads at this start.
    - `azimuth`: of the rollers, rad.
    - `roller_mass`: mass of a roller, kg.
    - `laminae`: number of laminae of a contact.
    """

    normal_names: ClassVar[tuple[str, ...]] = (APPROACH, "tilting moment of a roller")
    normal_caps: ClassVar[tuple[float, ...]] = (LOG_LOAD_STEP, 5.0)

    dry: TiltingRollers
    ring: InnerRing
    outer: ElasticRing | None
    inner: ElasticRing | None
    azimuth: Float[Array, " roller"]
    heavier: Float[Array, ""]
    kinematics: RollerKinematics
    contact: LineContact
    laws: ContactLaws
    oil: Lubricant
    inlet: InletOil
    roller_mass: Float[Array, ""]
    cage: CageParts | None
    elsewhere: OilElsewhere | None
    laminae: int = eqx.field(static=True)

    def initial(self) -> ArrowPoint:
        """Starts from rolling without slip at the equilibrium of the dry bearing, with Martin's film force on the
        rollers outside the loaded zone. Under a multiple of the loads, loads and displacements are larger as in a dry
        line contact."""
        guess, line, still = self.dry.initial(), self.dry.line, jnp.zeros(())
        state = self.dry.at(guess)
        mean_speed, _ = self.kinematics.surface_speeds(still, still)
        typical = 4.0 * self.load_scale() / self.azimuth.size + self.centrifugal(self.kinematics.free_orbit) + 1.0
        film, martin = floating_films(self.contact, self.laws, self.inlet, mean_speed, typical)
        opening = -jnp.sum(state.approach + 0.5 * line.length * state.slope, axis=0)
        load = self.heavier * state.load[0] + martin / (jnp.maximum(opening, 0.0) + film)
        log_load = jnp.clip(jnp.log(load), *LOG_LOAD_RANGE)
        ring = self.heavier**0.9 * guess.globals
        if self.cage is None:
            return ArrowPoint(jnp.stack([log_load, guess.elements[1]]), ring)
        return ArrowPoint(jnp.stack([log_load, guess.elements[1], jnp.zeros_like(log_load)]), jnp.append(ring, 0.0))

    def normal_bounds(self):
        """Tilts and rings have the bounds of the dry rollers: no equilibrium is sought beyond them."""
        tilt = MOST_TILT * self.dry.line.length / LENGTH_UNIT
        low, high = (
            ArrowPoint(jnp.stack([jnp.asarray(load), side * tilt])[:, None], dry.globals)
            for load, side, dry in zip(LOG_LOAD_RANGE, (-1.0, 1.0), self.dry.bounds(), strict=True)
        )
        return low, high

    def under(self, factor):
        ring, outer = self.rings_under(factor)
        # given displacements do not grow with the loads
        heavier = self.heavier * factor if self.freedoms else self.heavier
        return dataclasses.replace(self, ring=ring, outer=outer, heavier=heavier)

    def normal(self, unknowns, shared, orbit, spin):
        del spin
        dry, line = self.dry, self.dry.line
        length = jnp.asarray(line.length)
        inner = jnp.exp(unknowns[0])
        load = jnp.stack([inner, inner + self.centrifugal(orbit)])
        inward, turn = dry.held + LENGTH_UNIT * jnp.einsum("fn,fcn->cn", self.of_freedoms(shared), dry.columns)
        tilt = LENGTH_UNIT / length * unknowns[1]
        slope = jnp.stack([turn - tilt, tilt])
        start = line.approach_under(load, slope)
        _, moment = line.load_and_moment(start.value, slope)
        laminae = jnp.stack([line.of_race(k).laminae(start.value[k], slope[k], self.laminae) for k in (0, 1)])
        along = LoadsAlong(
            start.value,
            slope,
            moment - 0.5 * length * load,
            jnp.sqrt(jnp.square(laminae) + jnp.square(FLOOR / self.laminae * load)[..., None]),
            # the search for the approach under a load near 0 is not exact, and need not be
            jnp.max(jnp.abs(start.residual) * load / (load + LEAST_LOAD)),
        )
        opening = dry.radial_clearance - inward + sum(self.opened(shared).values())
        return PressedRollers(load, start.value + 0.5 * length * slope, opening, along)

    def films(self, pressed, mean_speed, sliding):
        assert pressed.along is not None
        loads = jnp.concatenate([pressed.load[..., None], pressed.along.laminae], axis=2)
        contact, inlet = self._cut([1.0] + [1.0 / self.laminae] * self.laminae)
        along = lambda speed: speed[..., None] + jnp.zeros_like(loads)
        state = self.laws.evaluate(contact, loads, along(mean_speed), along(sliding), self.oil, inlet)
        cut = lambda of: jax.tree.map(lambda leaf: of(leaf) if jnp.ndim(leaf) == 3 else leaf, state)
        whole, laminae = cut(lambda leaf: leaf[..., 0]), cut(lambda leaf: leaf[..., 1:])
        total = lambda force: None if force is None else jnp.sum(force, axis=2)
        sums = {"traction": total(laminae.traction), "rolling_force": total(laminae.rolling_force)}
        return whole._replace(**sums), laminae

    def _cut(self, parts: list[float]) -> tuple[LineContact, InletOil]:
        """Contact and oil of parts of the contacts, on a further axis. **Arguments:** `parts`: of the length and of the
        oil flow."""
        along = lambda tree: jax.tree.map(lambda leaf: leaf[..., None] if jnp.ndim(leaf) else leaf, tree)
        contact, inlet, share = along(self.contact), along(self.inlet), jnp.asarray(parts)[None, None, :]
        if inlet.flow is not None:
            inlet = dataclasses.replace(inlet, flow=inlet.flow * share)
        return dataclasses.replace(contact, length=contact.length * share), inlet

    def normal_errors(self, pressed, contact):
        along = pressed.along
        assert along is not None
        size = self.load_scale() / self.azimuth.size + self.centrifugal(self.kinematics.free_orbit)
        # both sides of the balance stay positive: a middle that does not touch counts as a film
        film = contact.separation + jnp.maximum(-pressed.approach, 0.0) + SOFT * contact.separation
        pressing = jnp.maximum(pressed.approach, 0.0) + SOFT * contact.separation
        tilting = (along.moment[1] - along.moment[0]) / (self.dry.line.length * size)
        return approach_error(pressing, film, pressed.opening), tilting

    def on_ring(self, pressed):
        assert pressed.along is not None
        on_race = jnp.stack([pressed.load[0], pressed.along.moment[0]])
        totals = jnp.einsum("fcn,cn->fn", self.dry.columns, on_race)
        return self.on_both(totals, pressed.load[1], pressed.load[0]) if self.bent else totals

    def ring_rows(self, globals_, totals):
        return self.ring_balance(globals_, totals, self.ring.needs_held_load) / self.load_scale()

    def mixed(self, state):
        """The film ratio is that of the whole contact, forces and powers are sums over the laminae, and the flash
        temperature is the highest one."""
        if self.laws.mixed is None:
            return None
        assert state.pressed.along is not None
        assert state.laminae is not None
        contact, inlet = self._cut([1.0 / self.laminae] * self.laminae)
        load = state.pressed.along.laminae
        along = lambda speed: speed[..., None] + jnp.zeros_like(load)
        speeds = along(state.mean_speed), along(state.sliding_speed)
        parts = self.laws.mixed_state(contact, load, state.laminae, *speeds, inlet)
        assert parts is not None
        whole = self.laws.asperities(self.contact, state.load, state.contact.film, state.mean_speed, self.inlet)
        return MixedState(
            film_ratio=whole.film_ratio,
            share=jnp.sum(parts.share * load, axis=2) / jnp.sum(load, axis=2),
            boundary=jnp.sum(parts.boundary, axis=2),
            boundary_power=jnp.sum(parts.boundary_power, axis=2),
            flash=largest(parts.flash, axis=2),
        )


def least_films(state: RollerState[PressedRollers]) -> dict[str, Array]:
    """Thinnest films along the rollers, of laminae that carry load, m: names of the results -> values."""
    assert state.laminae is not None
    assert state.pressed.along is not None
    load = state.pressed.along.laminae
    carries = load > LEAST_SHARE * jnp.max(load, axis=2, keepdims=True)
    least = -largest(jnp.where(carries, -state.laminae.film, -jnp.inf), axis=2)
    return {"film_least_inner": least[0], "film_least_outer": least[1]}
