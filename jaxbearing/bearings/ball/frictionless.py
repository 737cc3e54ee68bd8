r"""Lubricated balls without traction: loads, contact angles, motion and films for given unknowns.

The force of the inner race, the centrifugal force and the pocket's friction along the radius, $F_{C2} - F_{C1}$, give
load and angle of the outer contact, so that both force balances of a ball hold identically (source eqs. (14)-(15)), and
what is solved is that the centres fit (source eqs. (23)-(26)): with $n = (\sin\alpha, \cos\alpha)$,
$t = (\cos\alpha, -\sin\alpha)$ and $l_k = g_k + (Q_k/K_k)^{2/3} - h_k$, $l_in_i + l_on_o = A$, its component along
$n_i$ as the logarithm of the ratio of the positive terms on its two sides.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar
from ...contacts.point_laws import PointFilm, PointLaws
from ...lubricants import InletOil, Lubricant
from ...numerics.precision import as_float
from ...numerics.safe import safe_norm
from ..inlet import AbstractOils, OilElsewhere
from .geometry import BallGeometry
from .kinematics import BallMotion
from .state import BallCageParts, BallDrag, BallGuess, BallsState
from .system import AbstractBallSystem, InnerArm, OnRing

ROLLING_PASSES = 5
"""Newton steps for the orbital speed of a ball that rolls without sliding, with the outer contact angle that goes with
it. Light balls between fast rings that turn against each other take all of them, usual ones two."""
FRICTION_PASSES = 3
"""Load and angle of the outer contact under the friction that carries the couple: the error falls as fast."""


class AbstractLubricatedBallSystem(AbstractOils, AbstractBallSystem):
    """Geometry, laws and parts of lubricated balls, and what they do without traction; see the module."""

    geometry: BallGeometry
    reduced_modulus: Float[Array, ""]
    laws: PointLaws
    oil: Lubricant
    inlet: InletOil
    guess: BallGuess
    reference: BallMotion
    """Rolling at the free contact angle, half way between outer and inner control."""
    orbit_unit: Float[Array, ""]
    """Scale of orbital speeds, rad/s; not 0 while a ring turns."""
    resolved: bool = eqx.field(static=True, default=False)
    cage: BallCageParts | None = None
    drag: BallDrag | None = None
    common_orbit: bool = eqx.field(static=True, default=False)
    """True if balls that roll without sliding have one orbital speed."""
    slide_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Part of the sliding that the traction law sees: 1, less in an easier system."""
    heavy_guess: BallGuess | None = None
    """The easiest system starts here; only balls that do not slide have it."""
    heavier: Float[Array, ""] | None = None
    """The easiest load over the load on the ring."""
    film_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Part of the films that keeps the surfaces apart: 1, less in an easier system."""
    elsewhere: OilElsewhere | None = None
    """Oil of the other interactions where it is not that of the raceways, `inlet`."""

    # -- structure ------------------------------------------------------------------------------------------------

    @property
    def slips(self) -> bool:
        return self.laws.traction is not None

    @property
    def own_unknowns(self) -> tuple[str, ...]:
        """Names of a ball's unknowns beside load and angle."""
        if not self.slips:
            return ()
        names = ["spin"]
        if self.attitude == "equilibrium":
            names = ["axial spin", "radial spin"]
        elif self.attitude == "min_power":
            names.append("attitude")
        names.append("orbit" if self.cage is None else "outward")
        if self.resolved:
            names += ["transverse", "carried"]
        return tuple(names)

    @property
    def global_orbit(self) -> bool:
        return self.cage is not None or self.common_orbit

    # -- scales ---------------------------------------------------------------------------------------------------

    def spin_unit(self) -> Array:
        return self.orbit_unit / self.kinematics.ratio

    def load_scale(self) -> Array:
        return self.ring.size()

    def friction_scale(self) -> Array:
        """Scale of a ball's friction forces, N: 1 % of its share of the load and of its centrifugal force."""
        force = self.centrifugal(self.reference.orbital_speed)
        return 0.01 * (self.load_scale() / self.ball_count + force)

    # -- physics --------------------------------------------------------------------------------------------------

    def orbit(self, scaled: Array) -> Array:
        return self.reference.orbital_speed + self.orbit_unit * scaled

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
        turned = self.ring_frame(shared[:d]).turned if self.exact else None
        seen = inner if turned is None else inner - turned  # by the tilted race
        load, outer, motion, friction, orbit_residual = self._contacts(log_load, inner, seen, orbit, own, pocket)
        angle, direction = jnp.stack([seen, outer]), jnp.stack([inner, outer])
        races = jax.tree.map(
            lambda a, b: jnp.stack([a, b]),
            self.kinematics.inner_race(motion, seen),
            self.kinematics.outer_race(motion, outer),
        )
        cosine = jnp.cos(angle)
        contact = self.geometry.contacts(cosine[0], cosine[1], self.reduced_modulus).shaped()
        if film is None:
            film = self.laws.film_state(contact, load, races.mean_speed, races.rolling, self.oil, self.inlet)
        fit, centre, arm, on_ring = self._fit(load, direction, film.separation, shared[:d])
        axial, radial, moment = self.with_friction(load, direction, friction)
        sideways = ()
        if arm.along is not None:
            # a film thicker than the groove's radius is larger than the ball's puts the ball beyond the groove centre
            forward = arm.in_plane[0] * jnp.sin(inner) + arm.in_plane[1] * jnp.cos(inner) > 0
            within = arm.length * arm.share
            sideways = (load[0] * arm.along / jnp.where(forward, within, -within),)
        on_ring = on_ring((jnp.stack([axial[0], radial[0], *sideways]),), moment)
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

    def _through_land(self, pocket: Float[Array, " ball"]) -> Float[Array, "freedom ball"]:
        """Gives the contributions of the pockets' outward friction, N, to the forces on the ring.

        They go through cage and land and act in the middle plane, hence without a moment."""
        along = {"radial": jnp.cos(self.azimuth), "lateral": jnp.sin(self.azimuth)}
        zero = jnp.zeros_like(pocket)
        rows = [along.get(name, zero) * pocket for name in self.freedoms]
        return self.multiplicity * jnp.stack(rows) if rows else zero[None][:0]

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

    def _motion(self, inner: Array, outer: Array, orbit: Array | None, own: dict[str, Array]) -> BallMotion:
        reference, unit = self.reference, self.spin_unit()
        if self.attitude == "equilibrium":
            axial, radial = (ref + unit * own[name] for name, ref in self._spin_parts(reference))
            sense = jnp.where(reference.spin_speed < 0, -1.0, 1.0)
            spin = sense * safe_norm(axial, radial)
            still = (axial == 0) & (radial == 0)
            attitude = jnp.arctan2(sense * jnp.where(still, 0.0, radial), sense * jnp.where(still, sense, axial))
        else:
            attitude = self._assumed_attitude(inner, outer, own)
            if not self.slips:
                rolling = self.kinematics.rolling(inner, outer, attitude)
                return rolling._replace(orbital_speed=orbit) if self.common_orbit and orbit is not None else rolling
            spin = reference.spin_speed + unit * own["spin"]
        assert orbit is not None
        transverse = unit * own["transverse"] if self.resolved else jnp.zeros_like(spin)
        return BallMotion(orbit, spin, attitude, transverse)

    @staticmethod
    def _spin_parts(motion: BallMotion) -> tuple[tuple[str, Array], ...]:
        """Names of the unknowns of the spin in equilibrium, and their values, rad/s."""
        return ("axial spin", motion.axial_spin), ("radial spin", motion.radial_spin)

    def _assumed_attitude(self, inner: Array, outer: Array, own: dict[str, Array]) -> Array:
        if self.attitude == "outer":
            return self.kinematics.outer_control(outer)
        if self.attitude == "inner":
            return self.kinematics.inner_control(inner)
        return own["attitude"]

    def _fit(
        self, load: Array, angle: Array, film: Array, shift: Array
    ) -> tuple[Float[Array, "2 ball"], Float[Array, "2 ball"], InnerArm, OnRing]:
        """Misfit of the centres, along the inner contact's normal, as a logarithm, and across it; ball centres, from
        the outer groove centre, m, the arms from them to the inner groove, and what forces there do. `angle`: of the
        normal forces."""
        grooves = self.grooves
        if not self.slips:
            film = self.film_share * film
        compression = jnp.cbrt(jnp.square(load / grooves.stiffness[:, None]))
        reach = grooves.offset[1] + compression[1] - film[1]
        centre = reach[None] * jnp.stack([jnp.sin(angle[1]), jnp.cos(angle[1])])
        (arm,), on_ring = self.reach(shift, centre)
        # the arm laid into the half-plane
        groove = centre + (arm.in_plane / arm.share[None] if self.exact else arm.in_plane)
        turned = angle[1] - angle[0]
        cosine, sine = jnp.cos(turned), jnp.sin(turned)
        along = groove[0] * jnp.sin(angle[0]) + groove[1] * jnp.cos(angle[0])
        across = groove[0] * jnp.cos(angle[0]) - groove[1] * jnp.sin(angle[0])
        opening = grooves.offset[0] + grooves.offset[1] * cosine - along
        # all terms of both sides are positive, also of contacts whose normals make an obtuse angle
        same, against = jnp.maximum(cosine, 0.0), jnp.maximum(-cosine, 0.0)
        apart = compression[0] + compression[1] * same + film[1] * against + jnp.maximum(opening, 0.0)
        together = film[0] + film[1] * same + compression[1] * against + jnp.maximum(-opening, 0.0)
        fit = jnp.stack([jnp.log(apart / together), (reach * sine - across) / grooves.centre_distance])
        return fit, centre, arm, on_ring
