"""Temperatures in time: check values, energies, overheating, limits of a start, tables of time."""

import dataclasses

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from thermal_cases import AMBIENT, CAPACITY, FEEDBACK, INLET, losses_of, six_nodes

from jaxbearing.numerics.integrator import IntegratorOptions
from jaxbearing.numerics.status import Status
from jaxbearing.thermal.network import NodeHeat, OilFlow, network_of
from jaxbearing.thermal.solve import solve_network
from jaxbearing.thermal.warming_up import usual_options, warm_up

DAY = 86400.0


def run(speed, times, tolerance=1e-5, settings=None, **options):
    losses = losses_of(6, speed=speed, **(settings or {}))
    given = IntegratorOptions(solver="kvaerno5", tolerance=tolerance, max_steps=20_000)
    always = lambda temperatures, time: losses(temperatures)
    return warm_up(six_nodes(), always, CAPACITY, jnp.asarray(times), options=given, **options)


@jax.jit
def run_at(numbers, times, tolerance, start, limit):
    speed, settings = numbers["speed"], {name: value for name, value in numbers.items() if name != "speed"}
    return run(speed, times, tolerance, settings, start=start, limit=limit, adjoint=dfx.ForwardMode())


def six(speed, times, tolerance, start=AMBIENT, limit=523.15, f1=3e-4, preload=2000.0, feedback=0.0):
    """One program for four instants, whatever the numbers."""
    numbers = {"speed": speed, "f1": f1, "preload": preload, "feedback": feedback}
    numbers, tolerance, limit = jax.tree.map(lambda one: jnp.asarray(one, dtype=float), (numbers, tolerance, limit))
    return run_at(numbers, jnp.asarray(times), tolerance, jnp.full(6, start), limit)


def with_feedback(speed, start, limit):
    return six(speed, [1200.0, 2400.0, 3600.0, 3 * DAY], 1e-7, start, limit, **FEEDBACK)


@jax.jit
def steady_at(speed, f1, preload, feedback):
    return solve_network(six_nodes(), losses_of(6, speed=speed, f1=f1, preload=preload, feedback=feedback))


def steady(speed=6000.0, f1=3e-4, preload=2000.0, feedback=0.0):
    return steady_at(speed, f1, preload, feedback)


def test_warm_up_and_its_end():
    """Instants of the sheet, 1e-9; after six hours the steady state."""
    found = six(6000.0, [10.0, 60.0, 600.0, 21600.0], 1e-11)
    expected = [
        [303.8217199, 300.7336504, 315.568946, 309.8607598, 293.5404936, 293.2815514],
        [312.4508008, 307.950065, 321.744131, 314.3870309, 298.1784092, 294.9830119],
        [322.1802795, 315.8959345, 325.5132132, 318.5388198, 317.4420428, 307.4130406],
    ]
    assert int(found.status) == Status.CONVERGED
    np.testing.assert_allclose(found.temperatures[:3], expected, rtol=1e-9)
    np.testing.assert_allclose(found.total[:3], [329.5336485, 272.251754, 234.622106], rtol=1e-9)
    np.testing.assert_allclose(found.temperatures[3], steady().temperatures, rtol=1e-11)
    assert abs(float(found.energy_error)) < 1e-9


def test_tolerance_and_energy():
    """With the default tolerance a warm-up takes some fifty steps; its energies close to ten times it."""
    found = six(6000.0, [60.0, 120.0, 600.0, 21600.0], IntegratorOptions().tolerance)
    assert int(found.accepted) < 150
    assert abs(float(found.energy_error)) < 10 * 1e-5
    stored = jnp.sum(CAPACITY * (found.last - AMBIENT))
    left = found.oil_energy + found.ambient_energy
    np.testing.assert_allclose(found.losses_energy, left + stored, rtol=1e-4)
    np.testing.assert_allclose(found.temperatures[0, 0], 312.4508008, atol=2e-3)


@jax.jit
def one_node(loss, fall, noise, time, tolerance):
    """One node of 22 W/K, whose loss falls with its temperature and is noisy."""
    network = network_of(1, {}, {"bearing": 2.0}, AMBIENT, OilFlow(20.0, AMBIENT))
    noisy = lambda temperatures: 1.0 + noise * jnp.sin(1e12 * jax.lax.stop_gradient(temperatures))
    heat = lambda temperatures, time: NodeHeat(loss * jnp.exp(-fall * (temperatures - AMBIENT)) * noisy(temperatures))
    options = dataclasses.replace(usual_options(), tolerance=tolerance)
    return warm_up(network, heat, jnp.asarray([400.0]), jnp.atleast_1d(time), options=options)


def test_one_node_with_a_constant_loss_is_an_exponential():
    found = one_node(100.0, 0.0, 0.0, 30.0, 1e-11)
    np.testing.assert_allclose(found.temperatures[0, 0], 296.8225004, rtol=1e-9)
    np.testing.assert_allclose(found.temperatures[0, 0], 293.15 + 100.0 / 22.0 * -np.expm1(-1.65), rtol=1e-12)


def test_noise_of_the_losses_rejects_no_step():
    """Near the steady state all that changes between two iterates is noise, here of 1e-9 of the losses."""
    found = one_node(1e4, 0.02, 1e-9, 1e6, float(usual_options().tolerance))
    assert int(found.status) == Status.CONVERGED
    assert int(found.rejected) <= 1


@pytest.mark.slow
def test_runs_away_after_four_minutes():
    """1.1 times the speed of the fold: a node passes 250 degC after 3.87 min, and the run ends there."""
    found = with_feedback(1.1 * 9237.123042, AMBIENT, 523.15)
    assert Status(int(found.status)) == Status.THERMAL_RUNAWAY
    np.testing.assert_allclose(found.end / 60.0, 3.87, atol=0.005)
    np.testing.assert_allclose(jnp.max(found.last), 523.15, rtol=1e-6)
    assert np.all(np.isnan(np.asarray(found.temperatures)))
    # without a limit it is lost at seven minutes
    lost = with_feedback(1.1 * 9237.123042, AMBIENT, 1e9)
    assert int(lost.status) != Status.CONVERGED
    np.testing.assert_allclose(lost.end / 60.0, 7.0, atol=0.5)


@pytest.mark.parametrize(("start", "speed"), [(293.15, 7806.0), (313.15, 8141.0), (350.0, 8516.0)])
def test_limit_of_a_start(start, speed):
    """A start at speed runs away although there is a steady state, and a stable one. The limits are those of a run that
    may pass 600 K; at 250 degC the first is 7771 rpm."""
    reached, beyond = (with_feedback(speed + more, start, 600.0) for more in (0.0, 1.0))
    assert Status(int(reached.status)) == Status.CONVERGED
    assert Status(int(beyond.status)) == Status.THERMAL_RUNAWAY
    assert int(steady(speed + 1.0, **FEEDBACK).status) == Status.CONVERGED
    if start == AMBIENT:
        cooler, hotter = (with_feedback(one, start, 523.15) for one in (7770.0, 7772.0))
        assert Status(int(cooler.status)) == Status.CONVERGED
        assert Status(int(hotter.status)) == Status.THERMAL_RUNAWAY


def test_ends_at_the_steady_state_with_feedback():
    found = with_feedback(7000.0, AMBIENT, 523.15)
    np.testing.assert_allclose(found.last, steady(7000.0, **FEEDBACK).temperatures, rtol=1e-8)


@pytest.mark.slow
def test_tables_of_time():
    """A speed that doubles and an oil inlet that cools, both at given times."""
    speeds = lambda time: jnp.where(time < 100.0, 3000.0, 6000.0)
    inlet = lambda time: jnp.interp(time, jnp.asarray([0.0, 200.0]), jnp.asarray([INLET, INLET - 10.0]))
    found = warm_up(
        lambda time: six_nodes(inlet=inlet(time)),
        lambda temperatures, time: losses_of(6, speed=speeds(time))(temperatures),
        CAPACITY,
        jnp.asarray([99.0, 101.0, 40_000.0]),
        jumps=jnp.asarray([100.0, 200.0]),
        options=IntegratorOptions(solver="kvaerno5", tolerance=1e-8, max_steps=20_000),
    )
    end = solve_network(six_nodes(inlet=INLET - 10.0), losses_of(6))
    np.testing.assert_allclose(found.temperatures[2], end.temperatures, rtol=1e-9)
    assert float(found.total[1]) > 1.5 * float(found.total[0])
    assert abs(float(found.energy_error)) < 1e-7


@pytest.mark.slow
def test_losses_that_fail_end_the_run():
    def heat(temperatures, time):
        failed = temperatures[0] > 310.0
        return NodeHeat(
            losses_of(6)(temperatures).heat,
            jnp.where(failed, int(Status.NO_EQUILIBRIUM), int(Status.CONVERGED)),
        )

    found = warm_up(six_nodes(), heat, CAPACITY, jnp.asarray([1.0, 600.0]))
    assert Status(int(found.status)) == Status.NO_EQUILIBRIUM
    assert np.all(np.isfinite(np.asarray(found.temperatures[0])))
    assert np.all(np.isnan(np.asarray(found.temperatures[1])))
    np.testing.assert_allclose(found.last[0], 310.0, atol=1e-3)


@pytest.mark.slow
def test_derivatives_of_a_run():
    """Temperatures and energies."""

    def shown(speed, **options):
        found = run(speed, [60.0, 600.0], 1e-8, **options)
        energies = jnp.stack([found.losses_energy, found.oil_energy, found.ambient_energy])
        return jnp.concatenate([found.temperatures[1], energies])

    forward = jax.jit(jax.jacfwd(lambda speed: shown(speed, adjoint=dfx.ForwardMode())))(6000.0)
    evaluate = jax.jit(shown)
    np.testing.assert_allclose(forward, (evaluate(6003.0) - evaluate(5997.0)) / 6.0, rtol=2e-5)


@pytest.mark.slow
def test_lanes_of_a_batch():
    speeds = jnp.asarray([4000.0, 10_000.0])
    found = jax.vmap(lambda speed: with_feedback(speed, AMBIENT, 523.15))(speeds)
    assert [Status(int(one)) for one in found.status] == [Status.CONVERGED, Status.THERMAL_RUNAWAY]
    alone = with_feedback(4000.0, AMBIENT, 523.15)
    np.testing.assert_allclose(found.last[0], alone.last, rtol=1e-12)
