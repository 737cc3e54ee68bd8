"""The moving ball bearing of the check values: Table 15 with a closed traction law and a decided cage."""

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.kinematics import BallKinematics
from jaxbearing.bearings.ball.motion.bodies import MovingCage, MovingRing, TurningBody
from jaxbearing.bearings.ball.motion.races import AbstractRaceLaw, Pressed, RaceFriction
from jaxbearing.bearings.ball.motion.rates import BallDynamics
from jaxbearing.bearings.ball.motion.speeds import Levers
from jaxbearing.bearings.ball.state import BallDrag
from jaxbearing.bearings.ball.system import Grooves
from jaxbearing.contacts import PointContact
from jaxbearing.gaps import CompliantBallPocketFace, Laminar, RollerDrag, ShortJournal
from jaxbearing.lubricants import InletOil
from jaxbearing.numerics.safe import positive_power

COUNT, BALL, PITCH = 20, 20.638e-3, 0.5 * 153e-3
MASS, INERTIA = 0.0361302614, 1.53888554e-6
STIFFNESS = (3.99516324e10, 5.26635887e10)
VISCOSITY = 4.7e-3
POCKET = CompliantBallPocketFace(300e-6, 0.5 * BALL, 4.30944084e10)
CAGE = (0.493071058, 2.893464239e-3, 1.481045526e-3)
GEOMETRY = BallGeometry(COUNT, 2 * PITCH, BALL, 0.5225, 0.51125, contact_angle=np.radians(30.0))
LEVER = float(GEOMETRY.groove_circle_radius)


class ClosedTraction(AbstractRaceLaw):
    """mu_inf Q u/v_e, v_e^2 = u_t^2 + u_b^2 + (l w_s)^2 + s_0^2 (U^2 + 0.01), l = 3/8 a E(m); no film."""

    contact: PointContact
    stiffness: Float[Array, "2 1"]
    friction_limit: float = 0.05
    slip: float = 0.005

    def pressed(self, approach, meridian, races):
        return Pressed(self.stiffness * positive_power(approach, 1.5), self.contact, None)

    def friction(self, pressed, load, races):
        ellipse = self.contact.ellipse(load)
        arm = 0.375 * ellipse.transverse * jnp.exp(self.contact.log_second_kind())
        smallest = self.slip**2 * (races.mean_speed**2 + 0.01)
        speed = jnp.sqrt(races.rolling**2 + races.transverse**2 + (arm * races.spin) ** 2 + smallest)
        rate = -self.friction_limit * load / speed
        return RaceFriction(rate * races.rolling, rate * races.transverse, rate * arm**2 * races.spin)


def levers(with_cage=True):
    cosine, sine = jnp.cos(jnp.radians(30.0)), jnp.sin(jnp.radians(30.0))
    distance = jnp.asarray(GEOMETRY.centre_distance)
    grooves = Grooves(
        offset=jnp.stack([GEOMETRY.inner_offset, GEOMETRY.outer_offset]),
        stiffness=jnp.asarray(STIFFNESS),
        centre_distance=distance,
        free_cosine=cosine,
        free_sine=sine,
        aligned=-distance * sine,
        lever=jnp.asarray(LEVER),
        groove_arm=jnp.asarray(0.5225 * BALL),
    )
    places = jnp.asarray([-12.5e-3, 12.5e-3]) if with_cage else None
    return Levers(grooves, jnp.asarray(0.5 * BALL), jnp.asarray(PITCH), places)


def moving_cage():
    oil = InletOil(373.15, jnp.asarray(VISCOSITY), 1.04e-8, 0.0, density=jnp.asarray(900.0))
    land = ShortJournal(jnp.asarray(72.5e-3), jnp.asarray(3.98e-3), jnp.asarray(240e-6), Laminar(), 2)
    body = TurningBody(*map(jnp.asarray, CAGE))
    return MovingCage(body, POCKET, jnp.asarray(VISCOSITY), land, oil, jnp.zeros(()))


def dynamics(speed=587.0, **changes):
    inner = 12500.0 * 2.0 * np.pi / 60.0
    cosine = np.full(1, np.cos(np.radians(30.0)))
    contact = GEOMETRY.contacts(cosine, cosine, 207e9 / (1 - 0.3**2))
    parts = {
        "kinematics": BallKinematics(*map(jnp.asarray, (inner, 0.0, 2 * PITCH, BALL))),
        "levers": levers(changes.get("cage", True) is not None),
        "azimuth": jnp.asarray(2.0 * np.pi * np.arange(COUNT) / COUNT),
        "mass": jnp.asarray(MASS),
        "inertia": jnp.asarray(INERTIA),
        "races": ClosedTraction(contact, jnp.asarray(STIFFNESS)[:, None]),
        "contact_damping": jnp.asarray(0.05),
        "free_offset": jnp.asarray(GEOMETRY.outer_offset * np.sin(np.radians(30.0))),
        "free_radius": jnp.asarray(GEOMETRY.outer_offset * np.cos(np.radians(30.0))),
        "ring": MovingRing(
            TurningBody(jnp.asarray(5.0), jnp.asarray(0.015), jnp.asarray(0.02)),
            jnp.asarray([20e3, 8e3, 1e3, 20.0, -10.0]),
            jnp.zeros(5),
            jnp.zeros(()),
            jnp.asarray(LEVER),
            (True,) * 5,
        ),
        "reference_speed": jnp.asarray(speed),
        "cage": moving_cage(),
        "drag": BallDrag(RollerDrag(coefficient=0.45, area=1.694183181e-4), jnp.asarray(36.0)),
        "drag_viscosity": jnp.asarray(VISCOSITY),
    }
    return BallDynamics(**parts | changes)


def state_fa(of):
    """State FA of the check values."""
    j = np.arange(COUNT)
    ball = 0.5 * BALL
    balls = np.stack(
        [
            30e-6 * np.sin(1 + j),
            0.05 * np.cos(j),
            ball * 4350 + 0.1 * np.sin(2 * j),
            ball * 2190 + 0.1 * np.cos(2 * j),
            -ball * 36 + 0.05 * np.sin(3 * j),
            3e-6 * np.sin(j),
            2e-5 + 3e-6 * np.cos(j),
            0.01 * np.sin(j),
            0.02 * np.cos(j),
        ]
    )
    cage = [20e-6, 20e-6, -30e-6, PITCH * 1e-4, -PITCH * 2e-4, 3e-6]
    cage += [1e-3, 2e-3, -1e-3, PITCH * 0.02, PITCH * 0.01, 0.01]
    ring = [6e-5, 1e-5, 5e-6, -2e-4 * LEVER, 1e-4 * LEVER, 1e-3, -2e-3, 1e-3, 2e-3, -1e-3]
    return of.scaled(jnp.asarray(balls), jnp.asarray(cage + ring))


def accelerations(of, state):
    """What happens in a state, and accelerations in SI: of the balls in the order of `BALL_STATE`, of cage and ring in
    that of `GLOBAL_STATE`, and powers in that of `WORKS`."""
    now, found = jax.jit(lambda given: (of.at(0.0, given), of.rates(0.0, given)))(state)
    return now, *map(np.asarray, of.unscaled(found))
