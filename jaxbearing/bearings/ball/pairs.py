r"""Equations of lubricated balls with one contact on each ring.

Unknowns of each ball: $\ln Q_i$, the contact angle $\alpha_i$ at the inner race, and the unknowns of its motion
(`equations`).

The forces of the inner race, the centrifugal force and the radial friction of the pocket, $F_{C2} - F_{C1}$, determine
the load and the angle of the outer contact. Both force balances of a ball then hold identically (source eqs.
(14)-(15)). The equations that remain say that the ball fits between the grooves (source eqs. (23)-(26)):

$$l_in_i + l_on_o = A, \quad l_k = g_k + (Q_k/K_k)^{2/3} - h_k,$$

with $n = (\sin\alpha, \cos\alpha)$ and the vector A from the outer to the inner groove centre. The distance of the
centres of ball and groove is $l_k$, at first contact $g_k$; $K_k$ is the stiffness and $h_k$ the film of the contact.
The component along $t_i = (\cos\alpha_i, -\sin\alpha_i)$ is divided by the length of A at first contact. In the
component along $n_i$ the terms are arranged so that all of them are positive, and the residual is the logarithm of the
ratio of the two sides.
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
"""Newton steps for the orbital speed of a ball that rolls without sliding; the outer contact angle follows from it.
Light balls between fast rings that turn in opposite directions need all steps, usual balls two."""
FRICTION_PASSES = 3
"""Fixed-point passes for the load and angle of the outer contact if friction carries the gyroscopic couple."""
LOG_LOAD_RANGE = (-200.0, 18.0)
"""Bounds of the unknown ln(Q_i / 1 N) during the iteration."""


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
        """State of the balls without traction. **Arguments:** `film`: films of the contacts if they are given; `None`:
        they are computed."""
        d = len(self.freedoms)
        own = dict(zip(self.own_unknowns, unknowns[2:], strict=True))
        log_load, inner = unknowns[0], unknowns[1]
        orbit = None
        if self.slips or self.common_orbit:
            orbit = self.orbit(shared[d] if self.global_orbit else own["orbit"])
        pocket = self.friction_scale() * own["outward"] if "outward" in own else None
        turned = None if self.ring_motion is None else self.ring_motion.frame(shared[:d]).turned
        seen = inner if turned is None else inner - turned  # contact angle on the tilted race
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
            # a film thicker than the difference of the radii of groove and ball puts the ball beyond the groove centre
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
        """Load, N, and contact angle, rad, at the outer race, from the balances of forces on the ball.

        **Arguments:** `inner`: direction of the inner normal force, rad; `outward`: centrifugal force and outward force
        of the pocket, N; `friction`: T_i and T_o with their sign, N; `None`: no friction.
        """
        load = jnp.exp(log_load)
        axial, radial = load * jnp.sin(inner), load * jnp.cos(inner) + outward
        if friction is None:
            return safe_norm(axial, radial), jnp.arctan2(axial, radial)
        axial, radial = axial + friction[0] * jnp.cos(inner), radial - friction[0] * jnp.sin(inner)
        # load and friction of the outer race are perpendicular to each other and carry the sum of these forces
        total = jnp.square(axial) + jnp.square(radial)
        outer = jnp.sqrt(jnp.maximum(total - jnp.square(friction[1]), 1e-6 * total))
        return outer, jnp.arctan2(axial, radial) - jnp.arctan2(friction[1], outer)

    def _contacts(self, log_load, inner, seen, orbit, own, pocket):
        """Loads, N, outer contact angle, rad, motion of the ball, friction that carries the couple, N, and, if the
        balls roll without sliding, the largest error of the centrifugal force over its sum with the inner load; else 0.

        **Arguments:** `log_load`: ln(Q_i / 1 N); `inner`: direction of the inner normal force, rad; `seen`: contact
        angle on the inner race, rad; `orbit`: orbital speed, rad/s, `None` if the ball rolls without sliding; `own`:
        scaled unknowns of the motion; `pocket`: outward force of the pocket, N.
        """
        motion_at = lambda angle, orbital: self._motion(seen, angle, orbital, own)
        rolls, friction, residual = orbit is None, None, jnp.zeros(())
        if orbit is None:
            orbit = self._rolling_orbit(log_load, inner, seen, own)
        outward = self.centrifugal(orbit) if pocket is None else self.centrifugal(orbit) + pocket
        load, outer = self._outer_contact(log_load, inner, outward, None)
        motion = motion_at(outer, orbit)
        if rolls:
            # rolling without sliding at the contact angles that follow from the orbital speed
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
        """Orbital speed of rolling without sliding, rad/s. It depends on the outer contact angle, which depends on the
        orbital speed through the centrifugal force."""

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
        """Residuals of $l_in_i + l_on_o = A$ (see the module), along $n_i$ and along $t_i$; ball centres from the outer
        groove centre, m; arms from the ball centres to the inner groove centres; and `OnRing`.

        **Arguments:** `load`: of both contacts, N; `turned`: angle from the inner to the outer normal, rad; `normal`:
        from `unit_normals`; `film`: thicknesses, m; `shared`: unknowns that all balls share."""
        grooves = self.grooves
        if not self.slips:
            film = self.film_share * film
        compression = jnp.cbrt(jnp.square(load / grooves.stiffness[:, None]))
        reach = grooves.offset[1] + compression[1] - film[1]
        centre = reach[None] * normal[:, 1]
        (arm,), on_ring = self.reach(shared, centre)
        # the direction of the arm in the half-plane, with the full length of the arm
        groove = centre + (arm.in_plane / arm.share[None] if self.exact else arm.in_plane)
        cosine, sine = jnp.cos(turned), jnp.sin(turned)
        along = jnp.sum(groove * normal[:, 0], axis=0)
        across = groove[0] * normal[1, 0] - groove[1] * normal[0, 0]
        opening = grooves.offset[0] + grooves.offset[1] * cosine - along
        # all terms of both sides are positive, even if the angle between the normals is obtuse
        same, against = jnp.maximum(cosine, 0.0), jnp.maximum(-cosine, 0.0)
        apart = compression[0] + compression[1] * same + film[1] * against + jnp.maximum(opening, 0.0)
        together = film[0] + film[1] * same + compression[1] * against + jnp.maximum(-opening, 0.0)
        fit = jnp.stack([jnp.log(apart / together), (reach * sine - across) / grooves.centre_distance])
        return fit, centre, arm, on_ring
