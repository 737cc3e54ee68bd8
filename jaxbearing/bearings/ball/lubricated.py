"""Base class of the equations of lubricated balls with any number of contacts: laws, parts, scales and speeds."""

import abc

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar
from ...contacts.point_laws import PointLaws
from ...lubricants import InletOil, Lubricant
from ...numerics.precision import as_float
from ...numerics.safe import safe_norm
from ..inlet import AbstractOils, OilElsewhere
from .geometry import BallGeometry
from .kinematics import BallMotion, RaceMotion
from .state import BallCageParts, BallDrag, BallGuess, BallPlaces, BallsState
from .system import AbstractBallSystem


class AbstractLubricatedBallSystem(AbstractOils, AbstractBallSystem):
    """Geometry, laws and parts of lubricated balls."""

    geometry: BallGeometry
    reduced_modulus: Float[Array, ""] | Float[Array, "2 1"]
    laws: PointLaws
    oil: Lubricant
    inlet: InletOil
    guess: BallGuess | BallPlaces
    reference: BallMotion
    """Rolling without sliding at the free contact angle, with the mean attitude of outer and inner race control."""
    orbit_unit: Float[Array, ""]
    """Scale of orbital speeds, rad/s; not 0 while a ring turns."""
    resolved: bool = eqx.field(static=True, default=False)
    cage: BallCageParts | None = None
    drag: BallDrag | None = None
    common_orbit: bool = eqx.field(static=True, default=False)
    """True if all balls share one orbital speed; only for balls without traction."""
    slide_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Factor on the sliding in the traction law: 1, or less in an easier system of a homotopy."""
    heavy_guess: BallGuess | BallPlaces | None = None
    """Initial guess of the easiest system of the load homotopy; `None` for balls with traction."""
    heavier: Float[Array, ""] | None = None
    """Load of the easiest system over the load on the ring; `None` for balls with traction."""
    film_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Fraction of the film thickness that separates the surfaces: 1, or less in an easier system of a homotopy."""
    elsewhere: OilElsewhere | None = None
    """Oil that enters the other interactions; `None` if it is that of the raceways, `inlet`."""

    # -- structure ------------------------------------------------------------------------------------------------

    @property
    def slips(self) -> bool:
        return self.laws.traction is not None

    @property
    def own_unknowns(self) -> tuple[str, ...]:
        """Names of the unknowns of a ball, without the two of its contacts."""
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
        """Scale of the friction forces on a ball, N: 1 % of the sum of its share of the load and its centrifugal
        force."""
        force = self.centrifugal(self.reference.orbital_speed)
        return 0.01 * (self.load_scale() / self.ball_count + force)

    # -- physics --------------------------------------------------------------------------------------------------

    def orbit(self, scaled: Array) -> Array:
        return self.reference.orbital_speed + self.orbit_unit * scaled

    @abc.abstractmethod
    def frictionless(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        """State of the balls without traction."""

    @abc.abstractmethod
    def free_rolling(self, state: BallsState) -> Float[Array, " ball"]:
        """Orbital speeds of balls that roll without sliding (with more than two contacts: with least sliding), rad/s.
        The slip of the cage is measured against them."""

    @abc.abstractmethod
    def constrained(self, state: BallsState) -> BallMotion:
        """Motion of balls without traction that cannot each roll without sliding, because all have one orbital speed or
        because they have more than two contacts."""

    def races_of(self, motion: BallMotion, angle: Float[Array, "contact ball"]) -> RaceMotion:
        """Motion of the balls relative to the race at each contact."""
        return self.kinematics.races(motion, angle, self.arcs.senses)

    def _through_land(self, pocket: Float[Array, " ball"]) -> Float[Array, "row ball"]:
        """Contributions of the outward pocket friction `pocket`, N, to the forces on the rings.

        The cage transmits this friction to its land on the inner ring. It acts in the middle plane, so it gives no
        moment, and it loads the shaft without bending a flexible inner ring."""
        along = {"radial": jnp.cos(self.azimuth), "lateral": jnp.sin(self.azimuth)}
        zero = jnp.zeros_like(pocket)
        rows = [along.get(name, zero) * pocket for name in self.freedoms]
        through = self.multiplicity * jnp.stack(rows) if rows else zero[None][:0]
        return self.on_both(through, zero, zero)

    def _motion(self, inner: Array, outer: Array, orbit: Array | None, own: dict[str, Array]) -> BallMotion:
        reference, unit = self.reference, self.spin_unit()
        if "axial spin" in own:
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
        """Names of the two spin unknowns of the attitude "equilibrium", and their values in a motion, rad/s."""
        return ("axial spin", motion.axial_spin), ("radial spin", motion.radial_spin)

    def _assumed_attitude(self, inner: Array, outer: Array, own: dict[str, Array]) -> Array:
        if self.attitude == "outer":
            return self.kinematics.outer_control(outer)
        if self.attitude == "inner":
            return self.kinematics.inner_control(inner)
        return own["attitude"]
