"""Rates of the moving cylindrical roller bearing: published values, balances, limits, hard states."""

import dataclasses
import tomllib
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from moving_roller import ZERO, all_at, built, rolling, shaken, start_of, table_16
from roller_cases import reference_roller

from jaxbearing.bearings.cylindrical.loads import LENGTH_UNIT
from jaxbearing.bearings.cylindrical.motion.energy import (
    WORKS,
    kinetic_energy,
    power_by_location,
    powers,
    raceway_energy,
)
from jaxbearing.bearings.cylindrical.motion.rates import FINE, LOAD_TOLERANCE
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.ring_shape import OuterRoundness
from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.time_laws import LinearRamp, Ramp, RotatingLoad, Sinusoidal, Tabulated

PUBLISHED = tomllib.loads((Path(__file__).parents[2] / "published" / "roller_dynamics.toml").read_text())
FIELD = PUBLISHED["vector_field"]


def with_land_speed(dynamics):
    """The turbulence of the lands at the reference speed: that of the cage where it turns with the frame."""
    return eqx.tree_at(lambda d: d.land_speed, dynamics, dynamics.reference_speed, is_leaf=lambda leaf: leaf is None)


def rolls():
    dynamics, state = rolling()
    return with_land_speed(dynamics), state


@pytest.mark.parametrize("row", FIELD["row"], ids=lambda row: f"drag {row['drag']}")
def test_vector_field_rows(row):
    # the dynamic reference closure: no offset of the entrainment
    scene = table_16(row["drag"]).replace({"contact.entrainment_offset": 0.0})
    dynamics = with_land_speed(built(scene, Simulation()))
    w_ref, motion = dynamics.reference_speed, dynamics.system.kinematics
    j = jnp.arange(30.0)
    rollers = jnp.stack(
        [
            row["amplitude"] * jnp.sin(1.0 + j),
            0.05 * jnp.cos(j),
            w_ref * motion.outer_radius + 0.1 * jnp.sin(2.0 * j),
        ]
    )
    state = dynamics.scaled(rollers, jnp.asarray([*row["centre"], 3e-6, 2e-3, -1e-3, 0.01]))
    now, rates = all_at(dynamics, ZERO, state)
    roller_rates, cage_rates, _ = dynamics.unscaled(rates)
    load, pocket = now.distribution.load[0], now.pocket
    ours = [now.distribution.ring[0], load[0], load[4], pocket.front.load[0], pocket.rear.load[0]]
    ours += [roller_rates[1, 0], roller_rates[1, 7], roller_rates[1, 15], roller_rates[2, 0], roller_rates[2, 7]]
    ours += [cage_rates[3], cage_rates[4], cage_rates[5]]
    for name, value, expected in zip(FIELD["quantities"], ours, row["values"], strict=True):
        np.testing.assert_allclose(value, expected, rtol=FIELD["rtol"], err_msg=name)


def test_residual_accelerations_of_the_quasi_static_start():
    start = start_of()
    _, rates = all_at(with_land_speed(start.dynamics), ZERO, start.state)
    rollers, cage, _ = start.dynamics.unscaled(rates)
    np.testing.assert_allclose(np.abs(rollers[1]).max(), PUBLISHED["start"]["orbital"], rtol=0.01)
    np.testing.assert_allclose(np.abs(rollers[2]).max(), PUBLISHED["start"]["spin"], rtol=0.04)
    # about 1 N on rollers and cage
    assert np.abs(rollers[1]).max() * start.dynamics.system.roller_mass < 1.5
    assert np.hypot(*cage[3:5]) * start.dynamics.cage_mass < 5.0


def test_loads_come_from_a_smooth_function_of_time():
    """`smoothed` and back: the same loads, of 1e-15 N to 1e7 N; and what is found does not depend on the guess."""
    dynamics, state = rolls()

    @eqx.filter_jit
    def there_and_back(dynamics, state, point):
        loads = dynamics.race_loads(ZERO, state)
        smoothed = loads.smoothed(point)
        return smoothed, loads.unsmoothed(smoothed)

    now, cold = all_at(dynamics, ZERO, state)
    found = now.distribution.point
    point = ArrowPoint(jnp.linspace(-34.0, 16.0, 30)[None, :], jnp.ones(found.globals.shape))
    smoothed, back = there_and_back(dynamics, state, point)
    np.testing.assert_allclose(back.elements, point.elements, atol=1e-12)
    np.testing.assert_array_equal(back.globals, point.globals)
    assert np.all(np.diff(smoothed.elements[0]) > 0)
    loads = there_and_back(dynamics, state, found)[0]
    off = jax.tree.map(lambda leaf: 1.05 * leaf, loads)
    warm, again = eqx.filter_jit(dynamics.nested_rates)(ZERO, state, off)
    for a, b in ((cold, warm), (loads, again)):
        for one, other in zip(a, b, strict=True):
            np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.max(np.abs(one)))


def test_loads_balance_and_close_the_gaps():
    dynamics, state = rolls()
    now, _ = all_at(dynamics, ZERO, shaken(dynamics, state))
    system, found = dynamics.system, now.distribution
    assert found.residual < LOAD_TOLERANCE * np.sqrt(FINE)
    load, azimuth = np.asarray(found.load), np.asarray(now.azimuth)
    np.testing.assert_allclose(np.sum(load[0] * np.cos(azimuth)), 25e3, rtol=1e-12)
    approach = np.asarray(eqx.filter_jit(lambda contact, load: contact.palmgren_approach(load))(system.contact, load))
    gap = float(system.radial_clearance) + np.sum(approach - np.asarray(now.contact.film), axis=0)
    np.testing.assert_allclose(gap, float(found.ring[0]) * np.cos(azimuth), atol=1e-10 * LENGTH_UNIT)


def driven(amplitude=0.0, load=1.0, across=0.0, height=0.0):
    """Rolling rollers in an oval outer race under speed, load and load direction that vary: one program for all
    numbers. **Arguments:** `amplitude`: of the speed; `load`: factor at the end of its ramp; `across`: load whose
    direction turns, N; `height`: of the oval, m."""
    settings = Simulation(
        speed=Sinusoidal(40.0, amplitude), load=Ramp(1.0, load, 4e-3), rotating_load=RotatingLoad(across, 1400.0, 0.4)
    )
    dynamics, state = rolling(simulation=settings)
    oval = OuterRoundness(lobe_order=[2.0], lobe_height=[height], lobe_angle=[ANGLE])
    return dataclasses.replace(dynamics, outer_roundness=oval), state


ANGLE = 0.3
"""Of the oval, rad."""
DRIVEN = {
    "steady": {},
    "oval outer race": {"height": 8e-6},
    "speed, load and load direction vary": {"amplitude": 0.1, "load": 0.3, "across": 3e3},
    "all of these": {"amplitude": 0.1, "load": 0.3, "across": 3e3, "height": 8e-6},
}


FINER = np.asarray(1e-18)
"""Of the loads: their derivatives are as good as the step before the last one."""


@eqx.filter_jit
def rates_of_energy(dynamics, time, state, tolerance):
    rates = dynamics.nested_rates(time, state, None, tolerance)[0]
    tangent = (jnp.ones(()), rates)
    kinetic = jax.jvp(lambda time, state: kinetic_energy(dynamics, time, state), (time, state), tangent)[1]

    def radial(time, state):
        now = dynamics.at(time, state, None, tolerance)
        approach = dynamics.system.contact.palmgren_approach(now.distribution.load)
        return (now.distribution.ring, raceway_energy(dynamics, now), now.contact.film, approach), now

    _, changes, now = jax.jvp(radial, (time, state), tangent, has_aux=True)
    return rates, kinetic, powers(dynamics, time, now), *changes, now


@pytest.mark.parametrize("name", [*DRIVEN, pytest.param("held across the load line", marks=pytest.mark.slow)])
def test_energy_is_balanced_at_every_state(name):
    """Both identities in the docstring of `cylindrical.motion.energy`, term by term from forces and local speeds."""
    dynamics, state = driven(**DRIVEN[name]) if name in DRIVEN else rolling()
    height, time = DRIVEN.get(name, {}).get("height", 0.0), jnp.asarray(1e-3)
    # the steady one at the tolerance of runs
    tolerance = np.asarray(FINE) if name == "steady" else FINER
    found = rates_of_energy(dynamics, time, shaken(dynamics, state), tolerance)
    _, kinetic, watts, ring, raceways, film, approach, now = found
    power = dict(zip(WORKS, watts, strict=True))
    balance = power["drive"] - power["dissipation"] - power["pocket_films"] - power["lever_arm"]
    np.testing.assert_allclose(kinetic, balance, atol=1e-12 * sum(map(abs, power.values())))

    # the radial direction: work of the load on the ring
    load, centrifugal = now.distribution.load, now.distribution.load[1] - now.distribution.load[0]
    work = jnp.sum(dynamics.ring_load(time) * ring)
    tangential = {"radial": -jnp.sin(now.azimuth), "lateral": jnp.cos(now.azimuth)}
    names = dynamics.system.freedoms
    slope = sum(d * tangential[name] for name, d in zip(names, now.distribution.ring, strict=True))
    slope += 2.0 * height * jnp.sin(2.0 * (now.azimuth - ANGLE))
    wedge = jnp.sum(load[0] * slope * now.orbit)
    on_films = jnp.sum(load[0] * jnp.sum(film, axis=0))
    thrown_out = jnp.sum(centrifugal * approach[1])
    size = jnp.sum(jnp.abs(load[0] * slope * now.orbit))
    np.testing.assert_allclose(work, raceways - wedge - on_films - thrown_out, atol=1e-9 * size)


def test_what_does_not_vary_may_be_left_out():
    """Laws of amplitude 0 and an oval of height 0 change nothing, nor does a ring that is free across the load line:
    the rollers are symmetric about it."""
    dynamics, state = rolling()
    state = state._replace(globals=shaken(dynamics, state).globals)
    expected, found = value_and_slope(dynamics, state)[0], rates_of_energy(driven()[0], ZERO, state, FINER)[0]
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.max(np.abs(other)))


def test_every_dissipation_is_positive():
    dynamics, state = rolls()
    for seed in range(3):
        now, _ = all_at(dynamics, ZERO, shaken(dynamics, state, seed=seed))
        loss = power_by_location(dynamics, now).power_loss
        named = ("inner_raceway", "outer_raceway", "pocket", "flange", "element_ends", "cage_pilot", "drag")
        assert all(getattr(loss, name) > 0 for name in named)


def test_turned_by_one_pitch():
    """A load that points to roller 1 does to roller j + 1 what one to roller 0 does to roller j."""
    pitch = 2.0 * np.pi / 30.0
    dynamics, state = driven()
    state = shaken(dynamics, state)
    rates = rates_of_energy(dynamics, ZERO, state, FINER)[0]
    turned_load = jnp.asarray([np.cos(pitch), np.sin(pitch)]) * dynamics.system.ring.load[0]
    turned = eqx.tree_at(lambda d: d.system.ring.load, dynamics, turned_load)
    cosine, sine = np.cos(pitch), np.sin(pitch)

    def turn(point):
        x, y, q, v_x, v_y, v, *works = point.globals
        cage = [
            cosine * x - sine * y,
            sine * x + cosine * y,
            q,
            cosine * v_x - sine * v_y,
            sine * v_x + cosine * v_y,
            v,
        ]
        return point._replace(elements=jnp.roll(point.elements, 1, axis=1), globals=jnp.stack([*cage, *works]))

    expected, ours = turn(rates), rates_of_energy(turned, ZERO, turn(state), FINER)[0]
    # the land's law shifts its offset by 1e-7 of the clearance along x
    for a, b in zip(ours, expected, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-4, atol=1e-5 * np.abs(b).max())


def test_cage_without_forces_keeps_its_momentum():
    """Wherever it is, and however it moves."""
    dynamics, rolls = rolling()
    none = lambda leaf: leaf is None
    parts = eqx.tree_at(lambda c: (c.land, c.rails), dynamics.system.cage, (None, None), is_leaf=none)
    free = eqx.tree_at(lambda d: (d.pocket, d.system.cage), dynamics, (None, parts), is_leaf=none)
    rates = eqx.filter_jit(lambda d, y: d.rates(ZERO, y))
    for cage in ([10e-6, -20e-6, 0.0, 1e-3, 2e-3, 0.05], [-90e-6, 70e-6, 30e-6, 0.3, -0.2, -0.5]):
        moving = free.unscaled(rates(free, free.scaled(free.unscaled(rolls)[0], jnp.asarray(cage))))[1]
        np.testing.assert_array_equal(moving[3:], 0.0)
        np.testing.assert_allclose(moving[:3], cage[3:], rtol=1e-12)


@eqx.filter_jit
def value_and_slope(dynamics, state):
    """Rates, and their derivatives along all components at once."""
    ones = jax.tree.map(jnp.ones_like, state)
    return jax.jvp(lambda y: dynamics.rates(ZERO, y), (state,), (ones,))


HARD = {
    "cold oil": {"operation.oil_temperature": 273.15},
    "light load": {"operation.radial_load": 300.0},
    "preload": {"geometry.diametral_clearance": -20e-6},
    "fast": {"operation.inner_speed": 20000 * np.pi / 30.0},
    "no drag": {"drag.coefficient": 0.0},
}


@pytest.mark.parametrize("name", HARD)
def test_hard_states_have_rates_and_derivatives(name):
    """Rollers pressed 20 um into the walls, stopped, spinning backwards: finite, and the slopes too."""
    dynamics = built(reference_roller().replace(HARD[name]), Simulation())
    j = jnp.arange(30.0)
    rollers = jnp.stack([170e-6 * jnp.sin(j), jnp.cos(j), 40.0 * jnp.cos(j) ** 3])
    state = dynamics.scaled(rollers, jnp.asarray([239e-6, 0.0, 0.0, 0.05, -0.05, 0.1]))
    for leaf in jax.tree.leaves(value_and_slope(dynamics, state)):
        assert np.all(np.isfinite(leaf))


LAWS = [
    Sinusoidal(40.0, 0.1),
    Ramp(0.1, 1.0, 2e-3, 1e-3),
    Ramp(0.1, 1.0, 2e-3, -1e-3),
    LinearRamp(0.1, 1.0, 2e-3, 1e-3),
    Tabulated(np.asarray([1e-3, 2e-3, 4e-3]), np.asarray([1.0, 3.0, 2.0])),
    Tabulated(np.asarray([-1e-2, 0.0, 1.0]), np.asarray([0.5, 1.0, 1.0])),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_integral_of_a_time_law(law):
    np.testing.assert_allclose(law.integral(0.0), 0.0, atol=1e-18)
    slope_at = jax.jit(jax.grad(law.integral))
    for time in (0.5e-3, 1.7e-3, 2.5e-3, 6e-3):
        slope = slope_at(time)
        np.testing.assert_allclose(slope, law.factor(time), rtol=1e-12)
