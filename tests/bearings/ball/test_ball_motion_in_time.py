"""Transient runs of balls with a closed traction law: balances, steady limits, rolling, meeting, derivatives."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from diffrax import ForwardMode
from moving_balls import BALL, INERTIA, LEVER, MASS, PITCH, dynamics

from jaxbearing.bearings.ball.motion import energy
from jaxbearing.bearings.ball.motion.bodies import MovingRing, TurningBody
from jaxbearing.bearings.ball.motion.layout import SLOW
from jaxbearing.bearings.ball.motion.neighbours import Neighbours, neighbour_place, neighbour_speeds
from jaxbearing.bearings.ball.motion.quasi_static import quasi_static_dynamics
from jaxbearing.bearings.motion.run import FIELD
from jaxbearing.contacts import PointContact
from jaxbearing.gaps.meeting_balls import MeetingBalls
from jaxbearing.numerics.integrate import integrate_segment
from jaxbearing.numerics.integrator import IntegratorOptions
from jaxbearing.numerics.status import Status

WORKS = 6
STEADY = {
    (40000.0, 12500.0): (6.40406772e-05, 586.971646, 4355.18646, 2181.90913, -36.2951835, 3214.04659, 4001.15667),
    (5000.0, 5000.0): (1.45439927e-05, 233.564433, 1780.99507, 779.883919, -10.3606485, 431.835977, 561.345635),
}
"""Axial load of 20 balls, N, and speed of the shaft, rpm -> displacement, m, orbit, spins, rad/s, loads, N, with the
closed law, without cage and drag: of an independent steady solver."""
ANGLES = {(40000.0, 12500.0): (0.658321413, 0.485958274), (5000.0, 5000.0): (0.599398295, 0.426666855)}


def some_balls(count, axial=40e3, rpm=12500.0, orbit=586.971646, **changes):
    """`count` of 20 balls under as much each, on a ring that moves along the axis alone."""
    free = {"cage": None, "drag": None, "drag_viscosity": None} | changes
    load = jnp.zeros(5).at[0].set(axial * count / 20)
    body = TurningBody(jnp.asarray(5.0), jnp.asarray(0.015), jnp.asarray(0.02))
    ring = MovingRing(body, load, jnp.zeros(5), jnp.asarray(1e4), jnp.asarray(LEVER), (True, *(False,) * 4))
    of = dynamics(orbit, azimuth=jnp.asarray(2.0 * np.pi * np.arange(count) / count), ring=ring, **free)
    motion = dataclasses.replace(of.kinematics, inner_speed=jnp.asarray(rpm * np.pi / 30.0))
    return dataclasses.replace(of, kinematics=motion)


def steady_state(of, case, cage=False):
    """The printed steady state; places of the balls from angle and load on the outer race."""
    displacement, _, w_x, w_r, w_t, _, outer = STEADY[case]
    angle, grooves = ANGLES[case][1], of.levers.grooves
    arm = grooves.offset[1] + (outer / grooves.stiffness[1]) ** (2.0 / 3.0)
    x, r = arm * jnp.sin(angle) - of.free_offset, arm * jnp.cos(angle) - of.free_radius
    ball = 0.5 * BALL
    one = jnp.stack([jnp.zeros(()), jnp.zeros(()), *(ball * jnp.asarray([w_x, w_r, w_t])), x, r, *jnp.zeros(2)])
    shared = jnp.zeros(22).at[12].set(displacement).at[0].set(x if cage else 0.0)
    return of.scaled(jnp.tile(one[:, None], (1, of.azimuth.shape[0])), shared)


@eqx.filter_jit
def run(of, state, times, tolerance=1e-5):
    options = IntegratorOptions(tolerance=tolerance)
    return integrate_segment(FIELD, state, jnp.zeros(()), times, of, options, jnp.asarray(1e-7), idle=WORKS)


def left_open(of, state, found):
    """What the balance of a run leaves open over the work of the drive, and the works."""
    full = getattr(of, "full", of)
    stored = jax.jit(lambda given: energy.kinetic_energy(full, full.at(0.0, given)))
    begin, end = (float(stored(one)) for one in (state, found.last))
    works = dict(zip(energy.WORKS, np.asarray(full.unscaled(found.last)[2]), strict=True))
    spent = sum(works[name] for name in ("dissipation", "damping", "pocket_films", "raceways"))
    return (works["drive"] + works["load"] - spent - (end - begin)) / abs(works["drive"]), works


def test_energy_of_a_run():
    """Three balls, pushed off their steady state, with a cage that they strike; `test_balls_meet` has none."""
    of = some_balls(3, cage=dynamics().cage)
    state = steady_state(of, (40000.0, 12500.0), True)
    pushed = state.elements.at[1].add(jnp.asarray([3.0, -2.0, 5.0])).at[7].set(0.1).at[2].add(0.5)
    state = state._replace(elements=pushed)
    found = run(of, state, jnp.asarray([1e-4, 2e-3]))
    assert int(found.status) == Status.CONVERGED
    left, works = left_open(of, state, found)
    assert abs(left) < 1e-5
    assert works["dissipation"] > 0
    assert abs(works["pocket_films"]) > 1e-5


@eqx.filter_jit
def instant(of, state):
    """What happens in a state, and the rates."""
    return of.at(0.0, state), of.rates(0.0, state)


@pytest.mark.parametrize("case", STEADY)
def test_steady_state_stays(case):
    """In the printed steady state, with the balls on the pitch circle as a steady solver has them, all is at rest."""
    of = some_balls(3, *case, orbit=STEADY[case][1], on_pitch_circle=True)
    now, rates = instant(of, steady_state(of, case))
    balls, shared, _ = map(np.asarray, of.unscaled(rates))
    np.testing.assert_allclose(now.load, np.asarray(STEADY[case][5:])[:, None] * np.ones((1, 3)), rtol=2e-7)
    # against some 2e4 m/s^2 of the orbit
    np.testing.assert_allclose(balls[[1, 2, 3, 4, 7, 8]], 0.0, atol=0.02)
    np.testing.assert_allclose(shared[17], 0.0, atol=0.02)


@pytest.mark.parametrize("meridian", ["dynamic", pytest.param("quasi_static", marks=pytest.mark.slow)])
def test_ends_in_the_steady_state(meridian):
    """Constant speed and load end in the printed state from a start beside it, whichever equations move the balls."""
    case = (40000.0, 12500.0)
    of = some_balls(3, on_pitch_circle=True)
    state = steady_state(of, case)
    away = state._replace(elements=state.elements.at[2:5].add(jnp.asarray([[0.2], [-0.1], [0.1]])).at[1].add(0.3))
    if meridian == "quasi_static":
        of, away = quasi_static_dynamics(of, away)
    # the slowest mode, of the attitude of the spin, decays at 290 1/s
    found = run(of, away, jnp.asarray([32e-3]), 1e-7)
    assert int(found.status) == Status.CONVERGED
    full = getattr(of, "full", of)
    last = of.whole(found.last, of.solved(0.0, found.last)[0]) if meridian == "quasi_static" else found.last
    now, _ = instant(full, last)
    displacement, orbit, *spins, inner, outer = STEADY[case]
    np.testing.assert_allclose(now.rates.orbit, orbit, rtol=1e-6)
    scale = spins[0]
    np.testing.assert_allclose(now.rates.spin / scale, np.asarray(spins)[:, None] / scale * np.ones((1, 3)), atol=1e-6)
    np.testing.assert_allclose(now.load, np.asarray([inner, outer])[:, None] * np.ones((1, 3)), rtol=1e-6)
    np.testing.assert_allclose(now.places.ring[0], displacement, rtol=1e-6)


def test_sliding_ball_ends_rolling():
    """Balls on the outer race alone, pressed by their centrifugal force, start to slide without any rotation in space.
    They end rolling at 5/7 of their speed, for any law of friction: m v + J W/r_b is constant, W the rotation in space.
    """
    of, speed = some_balls(3), 45.0
    free = eqx.tree_at(lambda law: law.stiffness, of.races, of.races.stiffness.at[0].set(0.0))
    # nothing moves the ring
    ring = dataclasses.replace(of.ring, load=jnp.zeros(5))
    of = dataclasses.replace(of, races=free, ring=ring, reference_speed=jnp.asarray(0.0), on_pitch_circle=True)
    load, grooves = MASS * speed**2 / PITCH, of.levers.grooves
    one = jnp.zeros(9).at[1].set(speed).at[2].set(0.5 * BALL * speed / PITCH).at[5].set(-of.free_offset)
    one = one.at[6].set(grooves.offset[1] + (load / grooves.stiffness[1]) ** (2.0 / 3.0) - of.free_radius)
    found = run(of, of.scaled(jnp.tile(one[:, None], (1, 3)), jnp.zeros(22)), jnp.asarray([25e-3]), 1e-7)
    assert int(found.status) == Status.CONVERGED
    _, rates = of.moving(25e-3, found.last)
    # the ball moves inward by 5 um as its centrifugal force falls, against 76.5 mm
    rolling = 1.0 / (1.0 + INERTIA / (MASS * (0.5 * BALL) ** 2))
    np.testing.assert_allclose(rolling, 5.0 / 7.0, rtol=1e-6)
    np.testing.assert_allclose(rates.orbit * PITCH / speed, rolling, rtol=3e-4)
    np.testing.assert_allclose(0.5 * BALL * (rates.spin[0] - rates.orbit), rates.orbit * PITCH, rtol=1e-6)


def meeting(count=3):
    """Balls in a full ring, a hundredth of a millimetre apart."""
    contact = PointContact(0.25 * BALL, 0.25 * BALL, 207e9 / (1 - 0.3**2))
    law = MeetingBalls(jnp.asarray(0.5 * BALL), contact.stiffness_constant())
    of = some_balls(count, neighbours=Neighbours(law, jnp.asarray(4.7e-3)))
    angle = 2.0 * np.arcsin((0.5 * BALL + 5e-6) / PITCH)
    levers = dataclasses.replace(of.levers, balls_meet=True)
    return dataclasses.replace(of, levers=levers, azimuth=jnp.asarray(angle * np.arange(count)))


def test_balls_that_turn_as_one_body_do_not_rub():
    """Any rotation and any shift of all balls together: no pair moves against each other."""
    of = meeting(5)
    turn, shift = np.asarray([3.0, -2.0, 5.0]), np.asarray([0.3, 0.2, -0.4])

    @jax.jit
    def turning_together(state):
        places, rates = of.moving(0.0, state._replace(elements=state.elements.at[5].add(jnp.arange(5.0))))
        cosine, sine = jnp.cos(places.azimuth), jnp.sin(places.azimuth)
        centre = jnp.stack([places.centre[0], places.radius * cosine, places.radius * sine])
        moving = jnp.cross(turn[:, None], centre, axis=0) + shift[:, None]
        outward, along = moving[1] * cosine + moving[2] * sine, moving[2] * cosine - moving[1] * sine
        orbit = along / places.radius
        about = jnp.stack(
            [orbit - turn[0], turn[1] * cosine + turn[2] * sine, turn[2] * cosine - turn[1] * sine],
        )
        together = rates._replace(orbit=orbit, spin=about, centre=jnp.stack([moving[0], outward]))
        return neighbour_speeds(places, neighbour_place(places), together)

    found = turning_together(steady_state(of, (40000.0, 12500.0)))
    np.testing.assert_allclose(found.apart, 0.0, atol=1e-13)
    np.testing.assert_allclose(found.sliding, 0.0, atol=1e-13)


def test_balls_meet():
    """A fast ball strikes the next one: it hands its speed on, the load is equal and opposite, the energy balances."""
    of = meeting()
    state = steady_state(of, (40000.0, 12500.0))
    state = state._replace(elements=state.elements.at[1, 0].add(5.0 / SLOW))
    found = run(of, state, jnp.asarray([1.5e-4]))
    assert int(found.status) == Status.CONVERGED
    left, works = left_open(of, state, found)
    assert abs(left) < 1e-5
    speeds = np.asarray(of.unscaled(found.last)[0][1])
    assert speeds[0] < 2.5
    assert speeds[1:].max() > 2.0
    assert works["pocket_films"] != 0.0


@pytest.mark.parametrize("mode", ["forward", pytest.param("reverse", marks=pytest.mark.slow)])
def test_derivatives_of_a_run(mode):
    """Derivative of the speed of a ball after a short run over its first one, against a difference."""
    of = some_balls(3)
    start = steady_state(of, (40000.0, 12500.0))
    options = IntegratorOptions(tolerance=1e-9)
    adjoint = ForwardMode() if mode == "forward" else None

    def speed(push):
        state = start._replace(elements=start.elements.at[2, 0].add(push))
        found = integrate_segment(
            FIELD, state, jnp.zeros(()), jnp.asarray([2e-5]), of, options, jnp.asarray(1e-7), adjoint, WORKS
        )
        return found.states.elements[-1, 3, 0]

    forward = lambda push: jax.jvp(speed, (push,), (jnp.ones(()),))
    both, step = jax.jit(forward if mode == "forward" else jax.value_and_grad(speed)), 1e-3
    low, (_, slope), high = (both(jnp.asarray(0.5 + away)) for away in (-step, 0.0, step))
    np.testing.assert_allclose(slope, (high[0] - low[0]) / (2 * step), rtol=1e-5)
