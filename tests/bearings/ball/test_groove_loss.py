"""Where across a groove sliding takes power: places of strips, sums, and the side to which the strips count."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.arcs import RACE_SENSES
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.kinematics import BallMotion
from jaxbearing.bearings.ball.motion.groove_loss import ANGLES, EDGES, groove_loss
from jaxbearing.bearings.ball.motion.speeds import Levers, Meridian
from jaxbearing.contacts.distributed import StripPower

SCENE = jb.load_scene("turbine_ball")
CORE = build_core(SCENE)
LEVERS = Levers(CORE.grooves, 0.5 * CORE.kinematics.ball_diameter, 0.5 * CORE.kinematics.pitch_diameter)
RADII = float(SCENE.geometry.ball_diameter) * np.array(
    [float(SCENE.geometry.conformity_inner), float(SCENE.geometry.conformity_outer)]
)
"""Of the grooves of both races, m."""


def losses(power, width, angle):
    """Losses across the grooves of one ball. **Arguments:** `power`, W, and `width`, m, of the strips on both races."""
    width = jnp.asarray(width)[:, None]
    strips = StripPower(jnp.asarray(power)[:, None], jnp.zeros_like(width), width)
    angle = jnp.asarray(angle)[:, None]
    one = jnp.ones_like(angle)
    return np.asarray(groove_loss(LEVERS, Meridian(jnp.sin(angle), jnp.cos(angle), one, one[0]), strips))


def test_strips_lie_where_their_angles_are():
    """One strip of three has all the power: on the inner race the last one lies at larger angles, on the outer one at
    smaller ones; both with the width of the strip over the radius of the groove."""
    width = np.radians([5.0, 4.0, 3.0])[None] * RADII[:, None]
    found = losses([[0.0, 0.0, 6.0], [0.0, 0.0, 9.0]], width, np.radians([30.0, 20.0]))
    touched = [np.degrees(ANGLES[np.flatnonzero(one > 1e-9)]) for one in found]
    np.testing.assert_allclose(touched[0], [33.5, 34.5, 35.5])
    np.testing.assert_allclose(touched[1], [14.5, 15.5, 16.5])
    np.testing.assert_allclose(found[0][found[0] > 1e-9], 2.0, rtol=1e-9)
    np.testing.assert_allclose(found[1][found[1] > 1e-9], 3.0, rtol=1e-9)


def test_nothing_is_lost_between_intervals():
    random = np.random.default_rng(0)
    power, width = random.random((2, 7)), 1e-4 * (1.0 + random.random((2, 7)))
    found = losses(power, width, [1.55, -0.7])
    np.testing.assert_allclose(np.sum(found, axis=1), np.sum(power, axis=1), rtol=1e-12)
    assert EDGES[0] < -np.pi / 2 < np.pi / 2 < EDGES[-1]


def test_derivatives():
    """A turn of the contact moves all of its loss along: the mean angle times the loss grows by the loss; the loss of
    all intervals together does not change. Strips of whole degrees make both exact."""
    width = jnp.asarray(np.radians([5.0, 4.0, 3.0])[None, None] * RADII[:, None, None])
    power = jnp.asarray([[[1.0, 0.0, 6.0]], [[2.0, 3.0, 9.0]]])

    def moments(angle):
        one = jnp.ones((2, 1))
        place = Meridian(jnp.sin(angle), jnp.cos(angle), one, one[0])
        found = groove_loss(LEVERS, place, StripPower(power, jnp.zeros_like(width), width))
        return jnp.stack([jnp.sum(found, axis=1), jnp.sum(found * ANGLES[None], axis=1)])

    slopes = jax.jacfwd(moments)(jnp.asarray([[0.513], [-0.402]]))[..., 0]
    np.testing.assert_allclose(slopes[0], 0.0, atol=1e-9)
    np.testing.assert_allclose(slopes[1], np.diag(np.sum(power, axis=(1, 2))), rtol=1e-9, atol=1e-9)
    backward = jax.jacrev(moments)(jnp.asarray([[0.513], [-0.402]]))[..., 0]
    np.testing.assert_allclose(backward, slopes, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("race", [0, 1])
def test_spin_tells_the_side_of_a_strip(race):
    """The traction law's sliding at the distance y, that of the middle less spin times y, is the ball's sliding at
    the contact angle there: larger by y over the radius of the ball on the inner race, smaller on the outer one."""
    kinematics = CORE.kinematics
    motion = BallMotion(*(jnp.asarray([value]) for value in (610.0, 5200.0, 0.3, 40.0)))
    angle, y, radius = jnp.asarray([[0.5], [0.4]]), 1e-6, 0.5 * float(SCENE.geometry.ball_diameter)
    here, there = (kinematics.races(motion, angle + turn * RACE_SENSES * y / radius) for turn in (-1.0, 1.0))
    slope = (RACE_SENSES * (there.rolling - here.rolling) / (2.0 * y))[race]
    np.testing.assert_allclose(slope, -kinematics.races(motion, angle).spin[race], rtol=1e-8)
