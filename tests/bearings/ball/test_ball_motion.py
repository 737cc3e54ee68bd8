"""Accelerations of moving balls, cage and ring of given states, and what they must balance.

The check values are those of an independent program with 3-D vectors, which shares no code with this package. They are
of a closed traction law (`ClosedTraction`) and of the ball bearing of Table 15 with decided dimensions of its cage.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from moving_balls import BALL, COUNT, LEVER, PITCH, accelerations, dynamics, moving_cage, state_fa
from scipy.integrate import solve_ivp

from jaxbearing.bearings.ball.motion import energy, speeds
from jaxbearing.bearings.ball.motion.bodies import MovingRing
from jaxbearing.bearings.ball.motion.layout import BALL_UNITS, PLACE, Rates
from jaxbearing.bearings.ball.motion.quasi_static import FINE, quasi_static_dynamics


def truncated(monkeypatch):
    """Leaves the rotation of the tilting ring about the radius out, as the first check values do."""
    monkeypatch.setattr(speeds, "about_radius", lambda ring, cosine, sine: 0.0 * cosine)


BALLS_FA = {
    0: [-2110.93088, -1151.26771, -2221.70926, -212.422959, -33347.2272, -46328.2044],
    7: [979.415208, 524.433646, 563.460652, 1005.57787, 3931.66025, -4599.80966],
    13: [155.491223, 344.358168, -1320.98263, -1383.84368, -51938.1816, -73497.1108],
}
LOADS_FA = {
    0: [4778.61241, 1913.33003, 1.55931732, 0.986590729],
    7: [4870.84743, 4029.64682, 1.46839938, 1.23099094],
    13: [4898.65504, 847.713556, 0.387372056, 0.328683209],
}
CAGE_FA = [-5.43964763, -2.63585068, 6.64702086, -1.86516745, 5.97619916, 4.53470589]
RING_FA = [-3189.03839, 2155.04371, -2996.95692, 1085.22471, -3899.71071]


def test_check_values_of_the_full_model(monkeypatch):
    truncated(monkeypatch)
    of = dynamics()
    state = state_fa(of)
    now, balls, shared, _ = accelerations(of, state)
    for ball, row in LOADS_FA.items():
        np.testing.assert_allclose(np.asarray(now.load)[::-1, ball], row[:2], rtol=1e-8)
        # the printed loads are without the tilt rates of the cage, which change them by 2e-6 to 2e-5
        np.testing.assert_allclose(np.asarray(now.walls.load)[:, ball], row[2:], rtol=2e-5)
    for ball, row in BALLS_FA.items():
        np.testing.assert_allclose(balls[[1, 2, 3, 4, 7, 8], ball], row, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(shared[6:12], CAGE_FA, rtol=3e-6)
    np.testing.assert_allclose(shared[17:22], RING_FA, rtol=1e-6)
    kinetic, raceways = jax.jit(lambda now: (energy.kinetic_energy(of, now), energy.raceway_energy(of, now)))(now)
    np.testing.assert_allclose(kinetic, 1519.54265, rtol=1e-8)
    np.testing.assert_allclose(raceways, 1.04108667, rtol=1e-7)
    np.testing.assert_allclose(-now.generalised.races[0], 0.373015951, rtol=1e-7)


def test_cage_alone():
    cage = eqx.tree_at(lambda c: c.imbalance, moving_cage(), jnp.asarray(1e-5))
    rates = jnp.asarray([0.0, 0.0, 0.0, 1.5, -0.7, 570.0])
    found = cage.acceleration(jnp.asarray([1.0, 2.0, 3.0, 0.01, 0.02, 0.03]), rates, jnp.asarray(0.8))
    expected = [2.02810525, 6.31981059, 8.41500567, 786.263630, 1683.88607, 10.3681945]
    np.testing.assert_allclose(found, expected, rtol=1e-8)


def test_energy_balances_at_any_state():
    """The rate of the kinetic energy is what the works say, to round-off."""
    damped = eqx.tree_at(lambda d: d.ring.damping, dynamics(), jnp.asarray(1e3))
    of = eqx.tree_at(lambda d: d.cage.imbalance, damped, jnp.asarray(1e-5))

    def rates(state):
        now, found = of.at(0.0, state), of.rates(0.0, state)
        stored = lambda given: energy.kinetic_energy(of, of.at(0.0, given))
        return jax.jvp(stored, (state,), (found,))[1], energy.powers(of, 0.0, now)

    kinetic, powers = map(np.asarray, jax.jit(rates)(state_fa(of)))
    drive, dissipation, damping, films, raceways, load = powers
    assert dissipation > 0
    assert damping > 0
    np.testing.assert_allclose(kinetic, drive + load - dissipation - damping - films - raceways, rtol=1e-12)


@pytest.mark.parametrize("axis", [1, 2])
def test_turning_all_together_slides_nowhere(axis):
    """Balls, cage and inner ring that turn together about a line across the axis, through the centre of the ring, do
    not move against each other but for the displacements of the state over the radii: what is left of the moments about
    that line are forces times these displacements."""
    of = dynamics()
    zero = np.zeros(COUNT)

    @jax.jit
    def turning_together(state, turn):
        places, _ = of.moving(0.0, state)
        meridian = of.levers.meridian(places)
        cosine, sine = jnp.cos(places.azimuth), jnp.sin(places.azimuth)
        radial, along = turn[1] * cosine + turn[2] * sine, turn[2] * cosine - turn[1] * sine
        behind = -meridian.sine[0] * meridian.distance[0]
        cage_behind = of.free_offset + places.cage[0] - (of.levers.grooves.rest[0, 0] + places.ring[0])
        orbit, nothing = -behind * radial / places.radius, jnp.zeros(())
        rates = Rates(
            orbit=orbit,
            spin=jnp.stack([orbit, radial, along]),
            centre=jnp.stack([-along * places.radius, along * behind]),
            cage=jnp.stack([nothing, turn[2] * cage_behind, -turn[1] * cage_behind, -turn[2], turn[1], nothing]),
            ring=jnp.stack([nothing, nothing, nothing, -turn[2], turn[1]]),
            races=jnp.zeros(2),
        )
        return of.levers.speeds(places, meridian, rates)

    found = turning_together(state_fa(of), np.eye(3)[axis])
    assert found.pocket is not None
    assert found.lands is not None
    inner = [leaf[0] for leaf in (found.apart, found.races.rolling, found.races.transverse)]
    for length in (*inner, found.pocket.opening, found.pocket.surface, found.lands.offset):
        np.testing.assert_allclose(length, 0.0, atol=4e-4)  # m, at 1 rad/s: displacements of up to 0.1 mm
    np.testing.assert_allclose(found.races.spin[0], zero, atol=5e-3)


def test_free_flight():
    """Balls that touch nothing fly straight, at a constant angular velocity in space."""
    free = eqx.tree_at(lambda law: law.stiffness, dynamics().races, jnp.zeros((2, 1)))
    held = MovingRing(None, jnp.zeros(5), jnp.zeros(5), jnp.zeros(()), jnp.asarray(LEVER))
    of = dynamics(50.0, races=free, cage=None, drag=None, drag_viscosity=None, ring=held)
    orbit, ball = 5.0 / PITCH, 0.5 * BALL
    one = [0.0, 5.0 - 50.0 * PITCH, ball * (orbit - 10.0), ball * 200.0, -ball * 30.0, 0.0, 0.0, 0.3, 2.0]
    state = of.scaled(jnp.tile(jnp.asarray(one)[:, None], (1, COUNT)), jnp.zeros(22))
    field = lambda time, y: np.asarray(rates(time, of.scaled(*split(y))).elements * jnp.asarray(BALL_UNITS)[:, None])
    split = lambda y: (jnp.asarray(y).reshape(9, COUNT), jnp.zeros(22))
    rates = jax.jit(lambda time, given: of.rates(time, given))
    start = np.asarray(of.unscaled(state)[0]).ravel()
    run = solve_ivp(lambda t, y: field(t, y).ravel(), (0.0, 2e-3), start, "DOP853", rtol=1e-10, atol=1e-12)
    places, speed = of.moving(2e-3, of.scaled(*split(run.y[:, -1])))
    # the force of 1 mN that keeps an unloaded ball in its place moves it by 6e-8 m
    np.testing.assert_allclose(places.offset, 0.6e-3, rtol=1e-9)
    np.testing.assert_allclose(places.radius, 81.1187401e-3, rtol=1e-6)
    np.testing.assert_allclose(places.azimuth - of.azimuth, 0.123590469, rtol=2e-6)
    np.testing.assert_allclose(speed.orbit, 58.1284906, rtol=2e-6)
    expected = np.asarray([48.1284906, 194.776201, -54.4263877])[:, None]
    np.testing.assert_allclose(speed.spin, np.broadcast_to(expected, (3, COUNT)), rtol=2e-6)


BALLS_A = {
    0: ([7.79669751e-05, 3.62458084e-05], [3894.85188, 3007.44321], [1.30281711, 0.665666612]),
    7: ([9.16719279e-05, 2.43175663e-05], [1958.45045, 1145.85094], [1.05878943, 0.814543614]),
    13: ([0.000110814885, 1.65973428e-05], [2209.98122, 1450.51444], [0.334525711, 0.265923749]),
}
RATES_A = {
    0: [-7407.04069, -2093.93011, -3031.10986, -8215.93752],
    7: [-251.640001, 4611.88399, 2230.11775, -9840.07127],
    13: [1649.22066, 3271.24449, 2694.33565, -7815.80644],
}
CAGE_A = [-8.64429622, -1.37337153, 5.4827515, -5.28257624, 4.87218682, 5.04691157]
RING_A = [2.66392539e-05, 7.40221806e-05, 2.29188253e-05, -0.00129428234, -0.000412518518]
POWERS_A = [-35554.1722, 6617.06341 + 2485.74691 + 358.366725 + 205.716239, 0.0, 0.142788868, -0.110852417, 0.0]


def test_check_values_of_the_quasi_static_model(monkeypatch):
    """State A of the check values; friction and film of the pockets are those with the tilt rates of the cage."""
    truncated(monkeypatch)
    full = dynamics()
    of, state = quasi_static_dynamics(full, state_fa(full))

    def everything(given):
        found, solved = of.nested_rates(0.0, given, of.guess, FINE)
        now = of.full.at(0.0, of.whole(given, solved))
        return solved, now, found, energy.kinetic_energy(of.full, now)

    solved, now, found, kinetic = jax.jit(everything)(state)
    for ball, (place, loads, walls) in BALLS_A.items():
        offset = now.places.offset[ball] + of.full.free_offset
        np.testing.assert_allclose([offset, solved.elements[1, ball] * PLACE], place, rtol=1e-8)
        np.testing.assert_allclose(np.asarray(now.load)[::-1, ball], loads, rtol=1e-8)
        np.testing.assert_allclose(np.asarray(now.walls.load)[:, ball], walls, rtol=1e-7)
    np.testing.assert_allclose(now.places.ring, RING_A, rtol=1e-8)
    rates = np.asarray(found.elements) * np.asarray(BALL_UNITS)[:5, None]
    for ball, row in RATES_A.items():
        np.testing.assert_allclose(rates[1:, ball], row, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(np.asarray(found.globals)[6:12] * 0.1, CAGE_A, rtol=1e-6)
    powers = np.asarray(found.globals[12:] * of.full.work_unit)
    np.testing.assert_allclose(powers, POWERS_A, rtol=1e-8, atol=1e-6)
    np.testing.assert_allclose(kinetic, 1519.15819, rtol=1e-8)
