r"""Equations of lubricated balls with one contact on each ring.

Unknowns of each ball: $\ln Q_i$ and the inner contact angle, and those of its motion (`equations`).

The force of the inner race, the centrifugal force and the pocket's friction along the radius, $F_{C2} - F_{C1}$, give
load and angle of the outer contact, so that both force balances of a ball hold identically (source eqs. (14)-(15)), and
what is solved is that the centres fit (source eqs. (23)-(26)): with $n = (\sin\alpha, \cos\alpha)$,
$t = (\cos\alpha, -\sin\alpha)$ and $l_k = g_k + (Q_k/K_k)^{2/3} - h_k$, $l_in_i + l_on_o = A$, its component along
$n_i$ as the logarithm of the ratio of the positive terms on its two sides.
"""

from typing import ClassVar

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts.point_laws import PointFilm
from ...numerics.arrow import ArrowPoint
from ...numerics.safe import safe_norm
from .core import orbit_totals
from .equations import AbstractBallEquations, OfContacts
from .kinematics import BallMotion
from .state import BallGuess, BallsState
from .system import InnerArm, OnRing, unit_normals

ROLLING_PASSES = 5
"""Newton steps for the orbital speed of a ball that rolls without sliding, with the outer contact angle that goes with
it. Light balls between fast rings that turn against each other take all of them, usual ones two."""
FRICTION_PASSES = 3
"""Load and angle of the outer contact under the friction that carries the couple: the error falls as fast."""
LOG_LOAD_RANGE = (-200.0, 18.0)
"""ln(load / 1 N) that an iterate may take."""


class LubricatedBallSystem(AbstractBallEquations):
    """Lubricated balls with two contacts; see the module."""

    of_contacts: ClassVar[OfContacts] = OfContacts(
        names=("approach of the rings at a ball", "direction of the contacts of a ball"),
        caps=(12.0, 0.2),
        lowest=(LOG_LOAD_RANGE[0], -1.6),
        highest=(LOG_LOAD_RANGE[1], 1.6),
    )

    def initial(self) -> ArrowPoint:
        guess = self.guess
        assert isinstance(guess, BallGuess)
        inner = guess.angle
        outward = self.centrifugal(self.reference.orbital_speed)
        outer = self._outer_contact(guess.log_load, inner, outward, None)[1]
        rolling = self.kinematics.rolling(inner, outer, guess.attitude)
        held = lambda orbit: self.kinematics.held(orbit, inner, outer, guess.attitude)
        return self._started((guess.log_load, inner), guess.ring, jnp.exp(guess.log_load), rolling, held)

    # -- physics --------------------------------------------------------------------------------------------------

    def frictionless(
        self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"], film: PointFilm | None = None
    ) -> BallsState:
        """All but what traction does; `film`: where it is known and stays."""
        d = len(self.freedoms)
        own = dict(zip(self.own_unknowns, unknowns[2:], strict=True))
        log_load, inner = unknowns[0], unknowns[1]
        orbit = None
        if self.slips or self.common_orbit:
            orbit = self.orbit(shared[d] if self.global_orbit else own["orbit"])
        pocket = self.friction_scale() * own["outward"] if "outward" in own else None
        turned = None if self.ring_motion is None else self.ring_motion.frame(shared[:d]).turned
        seen = inner if turned is None else inner - turned  # by the tilted race
        load, outer, motion, friction, orbit_residual = self._contacts(log_load, inner, seen, orbit, own, pocket)
        angle, direction = jnp.stack([seen, outer]), jnp.stack([inner, outer])
        races = self.races_of(motion, angle)
        cosine = jnp.cos(angle)
        contact = self.geometry.contacts(cosine[0], cosine[1], self.reduced_modulus).shaped()
        if film is None:
            film = self.laws.film_state(contact, load, races.mean_speed, races.rolling, self.oil, self.inlet)
        normal = unit_normals(direction)
        fit, centre, arm, on_ring = self._fit(load, outer - inner, normal, film.separation, shared)
        forces, moment = self.forces(load, normal, friction)
        sideways = ()
        if arm.along is not None:
            # a film thicker than the groove's radius is larger than the ball's puts the ball beyond the groove centre
            forward = jnp.sum(arm.in_plane * normal[:, 0], axis=0) > 0
            within = arm.length * arm.share
            sideways = ((load[0] * arm.along / jnp.where(forward, within, -within))[None],)
        on_ring = on_ring((jnp.concatenate([forces[:, 0], *sideways]),), moment)
        if self.bent:
            on_ring = self.on_both(on_ring, forces[1, 1], forces[1, 0])
        if pocket is not None and self.cage is not None and self.cage.guidance == "inner_ring":
            on_ring = on_ring + self._through_land(pocket)
        return BallsState(
            load=load,
            angle=angle,
            centre=centre,
            motion=motion,
            contact=contact,
            races=races,
            friction=friction,
            film=film,
            orbit_residual=orbit_residual,
            traction=None,
            rolling=None,
            curvature=None,
            pocket_force=pocket,
            pocket=None,
            drag_force=None,
            fit=fit,
            rows=(),
            on_ring=on_ring,
            cage_moment=None,
            cage_force=None,
        )

    def free_rolling(self, state: BallsState) -> Float[Array, " ball"]:
        return self.kinematics.rolling(state.angle[0], state.angle[1], state.motion.attitude).orbital_speed

    def constrained(self, state: BallsState) -> BallMotion:
        rolling = self.kinematics.rolling(state.angle[0], state.angle[1], state.motion.attitude)
        own = rolling.orbital_speed
        less, weight = jnp.sum(orbit_totals(state.load[0], own, jnp.zeros_like(own)), axis=1)
        return rolling._replace(orbital_speed=jnp.full_like(own, -less / weight))

    def _outer_contact(
        self, log_load: Array, inner: Array, outward: Array, friction: Array | None
    ) -> tuple[Array, Array]:
        """Load and angle of the outer contact from the forces on the ball; `outward`, N, those along the radius;
        `friction` T_i, T_o with its sign."""
        load = jnp.exp(log_load)
        axial, radial = load * jnp.sin(inner), load * jnp.cos(inner) + outward
        if friction is None:
            return safe_norm(axial, radial), jnp.arctan2(axial, radial)
        axial, radial = axial + friction[0] * jnp.cos(inner), radial - friction[0] * jnp.sin(inner)
        # the outer race's load and friction, at right angles to each other, carry that
        total = jnp.square(axial) + jnp.square(radial)
        outer = jnp.sqrt(jnp.maximum(total - jnp.square(friction[1]), 1e-6 * total))
        return outer, jnp.arctan2(axial, radial) - jnp.arctan2(friction[1], outer)

    def _contacts(self, log_load, inner, seen, orbit, own, pocket):
        """Loads, outer angle, motion of the ball, friction that carries the couple, and by how much the centrifugal
        force misses that of rolling, over the loads.

        `inner`: direction of the inner normal force, `seen`: contact angle on the inner race, rad; `pocket`: its force
        outward.
        """
        motion_at = lambda angle, orbital: self._motion(seen, angle, orbital, own)
        rolls, friction, residual = orbit is None, None, jnp.zeros(())
        if orbit is None:
            orbit = self._rolling_orbit(log_load, inner, seen, own)
        outward = self.centrifugal(orbit) if pocket is None else self.centrifugal(orbit) + pocket
        load, outer = self._outer_contact(log_load, inner, outward, None)
        motion = motion_at(outer, orbit)
        if rolls:
            # the motion is that of rolling at the angles which the orbital speed makes
            missed = self.centrifugal(motion.orbital_speed) - self.centrifugal(orbit)
            residual = jnp.max(jnp.abs(missed) / (jnp.exp(log_load) + self.centrifugal(orbit)))
        for _ in range(0 if self.gyroscopic is None and not self.resolved else FRICTION_PASSES):
            couple = self.couple(motion)
            if self.gyroscopic is None:
                taken = 2.0 * couple / self.kinematics.ball_diameter
                carried = self.friction_scale() * own["carried"]
                friction = jnp.stack([carried, taken - carried])
            else:
                parts = self.gyroscopic.friction(couple, self.kinematics.ball_diameter, jnp.exp(log_load), load)
                friction = self.gyroscopic.sign * jnp.stack(parts)
            load, outer = self._outer_contact(log_load, inner, outward, friction)
            motion = motion_at(outer, orbit)
        return jnp.stack([jnp.exp(log_load), load]), outer, motion, friction, residual

    def _rolling_orbit(self, log_load: Array, inner: Array, seen: Array, own: dict[str, Array]) -> Array:
        """Orbital speed without sliding, rad/s: it needs the outer angle, which needs the centrifugal force."""

        def next_orbit(orbit: Array) -> Array:
            angle = self._outer_contact(log_load, inner, self.centrifugal(orbit), None)[1]
            return jnp.broadcast_to(self._motion(seen, angle, None, own).orbital_speed, inner.shape)

        def better(_, orbit: Array) -> Array:
            value, slope = jax.jvp(next_orbit, (orbit,), (jnp.ones_like(orbit),))
            return orbit - (value - orbit) / (slope - 1.0)

        start = jnp.broadcast_to(self.reference.orbital_speed, inner.shape)
        return jax.lax.fori_loop(0, ROLLING_PASSES, better, start)

    def _fit(
        self, load: Array, turned: Array, normal: Array, film: Array, shared: Array
    ) -> tuple[Float[Array, "2 ball"], Float[Array, "2 ball"], InnerArm, OnRing]:
        """Misfit of the centres, along the inner contact's normal, as a logarithm, and across it; ball centres, from
        the outer groove centre, m, the arms from them to the inner groove, and what forces there do.

        **Arguments:** `turned`: angle from the inner to the outer normal, rad; `normal`: of `unit_normals`."""
        grooves = self.grooves
        if not self.slips:
            film = self.film_share * film
        compression = jnp.cbrt(jnp.square(load / grooves.stiffness[:, None]))
        reach = grooves.offset[1] + compression[1] - film[1]
        centre = reach[None] * normal[:, 1]
        (arm,), on_ring = self.reach(shared, centre)
        # the arm laid into the half-plane
        groove = centre + (arm.in_plane / arm.share[None] if self.exact else arm.in_plane)
        cosine, sine = jnp.cos(turned), jnp.sin(turned)
        along = jnp.sum(groove * normal[:, 0], axis=0)
        across = groove[0] * normal[1, 0] - groove[1] * normal[0, 0]
        opening = grooves.offset[0] + grooves.offset[1] * cosine - along
        # all terms of both sides are positive, also of contacts whose normals make an obtuse angle
        same, against = jnp.maximum(cosine, 0.0), jnp.maximum(-cosine, 0.0)
        apart = compression[0] + compression[1] * same + film[1] * against + jnp.maximum(opening, 0.0)
        together = film[0] + film[1] * same + compression[1] * against + jnp.maximum(-opening, 0.0)
        fit = jnp.stack([jnp.log(apart / together), (reach * sine - across) / grooves.centre_distance])
        return fit, centre, arm, on_ring
