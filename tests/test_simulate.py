"""Transient runs: energy, steadiness, early stops, orders of the solvers."""

import ast
import dataclasses
import functools
from pathlib import Path

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from moving_roller import start_of, table_16

import jaxbearing as jb
from jaxbearing._scene import number
from jaxbearing.bearings.cylindrical.motion.instants import pocket_loads
from jaxbearing.bearings.motion.runs import trajectory
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.motion.start import quasi_static_start
from jaxbearing.simulate import simulate
from jaxbearing.time_laws import AbstractTimeFactor, Ramp, RotatingLoad, Sinusoidal

SHORT = 2.56e-3
"""One segment of a run, s."""


def few_parts(drag):
    """The bearing of Table 16 with nothing beside its rollers' ends: the programs are smaller. With flanges: slow tests
    below, and the command's."""
    return table_16(drag).replace({"flange": None, "cage.pocket_axial_clearance": None})


class Known(AbstractTimeFactor):
    """A steady load of which nothing is known after some time, s: with a long one, and a short one, one program."""

    until: float = number(unit="s")

    def factor(self, time):
        return jnp.where(jnp.asarray(time) > self.until, jnp.nan, 1.0)

    def antiderivative(self, time):
        return jnp.asarray(time)


def test_energy_closes_on_a_short_run():
    history = simulate(few_parts(0.6), SHORT, simulation=Simulation(tolerance=1e-7, load=Known(1.0)))
    energy = history.energy
    assert history.completed
    assert abs(energy.error) < 1e-5
    terms = energy.dissipation + energy.pocket_films + energy.lever_arm + energy.kinetic
    np.testing.assert_allclose(terms, energy.drive, rtol=1e-5)
    # a steady load: its work is the load times the displacement
    ring = history.instants.ring.radial
    np.testing.assert_allclose(energy.load_on_ring, 25e3 * (ring[-1] - ring[0]), rtol=1e-9, atol=1e-12)
    # what the works say, the instants say too: trapezoids
    drive = np.trapezoid(history.instants.drive_power, history.time)
    np.testing.assert_allclose(energy.drive, drive, rtol=1e-4)


def test_a_steady_run_begins_at_the_steady_state():
    scene = few_parts(0.3)
    steady, history = jb.solve(scene), simulate(scene, SHORT, simulation=Simulation(load=Known(1.0)))
    first = lambda values: values[0]
    cage, elements = history.instants.cage, history.instants.elements
    np.testing.assert_allclose(first(cage.speed), steady.cage.speed, rtol=1e-12)
    np.testing.assert_allclose(first(cage.eccentricity_ratio), steady.cage.eccentricity_ratio, rtol=1e-4)
    # rollers stand up to half the pocket clearance off their equal distances: that much of the slope of the loads
    slope = np.abs(np.diff(steady.elements.load_inner)).max() / (2.0 * np.pi / 30.0)
    np.testing.assert_allclose(first(elements.load_inner), steady.elements.load_inner, atol=slope * 150e-6 / 71e-3)
    np.testing.assert_allclose(first(history.instants.power_loss.total), steady.power_loss.total, rtol=0.01)
    np.testing.assert_allclose(cage.speed, steady.cage.speed, rtol=2e-3)


def test_types_say_what_a_run_gives():
    """The type of a moving bearing does not say whether it has a thermal network, nor does what comes back, unless the
    arguments say it."""
    said = []
    source = Path(jb.__file__).with_name("simulate.py").read_text(encoding="utf-8")
    functions = (one for one in ast.parse(source).body if isinstance(one, ast.FunctionDef) and one.name == "simulate")
    for one in functions:
        text = lambda annotation: ast.unparse(annotation).strip("'")
        pairs = zip(one.args.kwonlyargs, one.args.kw_defaults, strict=True)
        given = tuple(text(arg.annotation) for arg, default in pairs if default is None)
        said.append((text(one.args.args[0].annotation), given, text(one.returns)))
    assert ("AbstractBearing", (), "History | WarmUpHistory") in said
    assert ("AbstractMovingBearing", ("History | LastState",), "History") in said
    for scene, instant in (("BallBearing", "BallInstant"), ("CylindricalRollerBearing", "RollerInstant")):
        assert (scene, (), f"History[{instant}] | WarmUpHistory") in said
        assert (scene, ("History | LastState",), f"History[{instant}]") in said
    assert ("AbstractBearing", ("WarmUpSimulation",), "WarmUpHistory") in said
    assert ("TaperedRollerBearing", (), "WarmUpHistory") in said


def test_a_run_that_stops_early_keeps_what_it_has():
    history = simulate(few_parts(0.6), SHORT, simulation=Simulation(load=Known(1e-3)), throw=False)
    assert not history.completed
    assert "diverged" in history.failure()
    np.testing.assert_allclose(history.time[-1], 1e-3, rtol=1e-3)
    assert history.instants.cage.speed.shape == history.time.shape
    assert np.all(np.isfinite(history.instants.state_elements))
    with pytest.raises(jb.SolveError, match="is kept"):
        history.raise_if_failed()


def test_without_a_cage_unloaded_rollers_slow_down():
    scene = dataclasses.replace(few_parts(0.6), cage=None, simulation=Simulation())
    with pytest.raises(ValueError, match="simulate"):
        jb.solve(scene)
    history = simulate(scene, SHORT)
    assert history.completed
    assert history.instants.cage is None
    elements = history.instants.elements
    speed, load = elements.orbital_speed, elements.load_inner[-1]
    # drag slows down the rollers that carry nothing, traction holds those that do
    assert speed[-1, int(np.argmin(load))] < 0.99 * speed[0, 0]
    np.testing.assert_allclose(speed[-1, int(np.argmax(load))], speed[0, 0], rtol=2e-3)
    assert abs(history.energy.error) < 1e-5


def test_bad_requests_are_refused():
    with pytest.raises(ValueError, match="duration"):
        simulate(table_16())
    with pytest.raises(ValueError, match="traction"):
        simulate(table_16().replace({"contact": None, "cage": None}), SHORT)
    with pytest.raises(ValueError, match="solver"):
        Simulation(solver="heun")


DRIVEN = {
    "perturbed speed": Simulation(speed=Sinusoidal(40.0, 0.1)),
    "ramp from 2 % of the speed": Simulation(speed=Ramp(0.02, 1.0, 15e-3)),
    "turning load": Simulation(rotating_load=RotatingLoad(5e3, 1466.0)),
    "sudden load step": Simulation(load=Ramp(1.0, 0.05, 0.2e-3, 1e-3)),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DRIVEN)
def test_driven_runs(name):
    history = simulate(table_16(0.6), 4 * SHORT, simulation=DRIVEN[name])
    assert history.completed
    assert abs(history.energy.error) < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("solver", ["kvaerno5", "auto"])
def test_run_up_from_one_percent_of_the_speed(solver):
    """tsit5 is held to steps of 0.3 us there: more than 3000 in the first millisecond."""
    history = simulate(table_16(0.6), 4 * SHORT, simulation=Simulation(speed=Ramp(0.01, 1.0, 15e-3), solver=solver))
    assert history.completed
    assert abs(history.energy.error) < 1e-5
    assert int(history.accepted) < 1000


# kvaerno4, between its neighbours, on a small system only: tests/numerics/test_integrate.py
ORDERS = {"implicit_euler": 1, "tsit5": 5, "dopri8": 8, "kvaerno3": 3, "kvaerno5": 5}


@eqx.filter_jit
def half_and_whole_ms(start, simulation):
    return trajectory(start, jnp.asarray([0.5e-3, 1e-3]), simulation)


def before_the_first_shock(solver, tolerance):
    """States, and the number of steps."""
    found = half_and_whole_ms(start_of(0.6), Simulation(solver=solver, tolerance=tolerance))
    assert int(found.status) == 0
    states = [found.states.elements[:, :2], found.states.globals[:, :6]]
    return np.concatenate([np.ravel(part) for part in states]), int(found.accepted)


@functools.cache
def reference_before_the_first_shock():
    return before_the_first_shock("dopri8", 1e-11)[0]


@pytest.mark.slow
@pytest.mark.parametrize("solver", ORDERS)
def test_error_falls_with_the_tolerance_before_the_first_shock(solver):
    """The step control holds the error of a step at the tolerance: that of the run goes with nearly its first power."""
    errors, steps = [], []
    for tolerance in (1e-3, 1e-4, 1e-5) if solver == "implicit_euler" else (1e-4, 1e-5, 1e-6, 1e-7):
        state, taken = before_the_first_shock(solver, tolerance)
        errors.append(np.abs(state - reference_before_the_first_shock()).max())
        steps.append(taken)
    slope = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert slope >= 0.8 * min(ORDERS[solver], 4)


@pytest.mark.slow
def test_slope_of_the_pocket_load_before_the_first_shock():
    """Through start and run, in forward mode, against a central difference (itself good to some 1e-7: step control)."""
    scene, simulation = table_16(0.6), Simulation(tolerance=1e-9)
    times = jnp.linspace(0.0, 0.5e-3, 6)[1:]

    def mean_load(clearance):
        start = quasi_static_start(scene.replace({"cage.pocket_clearance": clearance}), simulation)
        run = trajectory(start, times, simulation, adjoint=diffrax.ForwardMode())
        load = lambda given: start.dynamics.at(given[0], given[1]).pocket.front.load
        return jnp.mean(jax.lax.map(load, (times, run.states)))

    step, one, at = 1e-8, jnp.ones(()), jnp.asarray(300e-6)
    run = jax.jit(lambda x: jax.jvp(mean_load, (x,), (one,)))
    np.testing.assert_allclose(run(at)[1], (run(at + step)[0] - run(at - step)[0]) / (2.0 * step), rtol=2e-6)


@pytest.mark.slow
def test_slope_of_the_pocket_load_in_reverse_mode():
    """The same, with checkpoints, and at the tolerance at which the step control is felt."""
    scene, simulation = table_16(0.6), Simulation(tolerance=1e-8)
    times = jnp.linspace(0.0, 0.5e-3, 6)[1:]

    def mean_load(clearance):
        start = quasi_static_start(scene.replace({"cage.pocket_clearance": clearance}), simulation)
        run = trajectory(start, times, simulation)
        load = lambda given: pocket_loads(start.dynamics, *given)[0]
        return jnp.mean(jax.lax.map(load, (times, run.states)))

    run, step, at = jax.jit(jax.value_and_grad(mean_load)), 1e-8, jnp.asarray(300e-6)
    np.testing.assert_allclose(run(at)[1], (run(at + step)[0] - run(at - step)[0]) / (2.0 * step), rtol=1e-4)


@pytest.mark.slow
def test_peaks_are_those_of_a_ten_times_finer_run():
    """Up to the first shocks of all rollers that have one; instants alone are up to 60 % too low."""
    scene, simulation = table_16(1.2), Simulation(tolerance=1e-7)
    coarse, fine = (simulate(scene, 2 * SHORT, simulation=simulation, interval=every) for every in (20e-6, 2e-6))
    for face in ("front", "rear"):
        peaks, exact = (np.asarray(getattr(run.instants.pocket_peaks, face)).max(axis=0) for run in (coarse, fine))
        shocked = exact > 0.1 * exact.max()
        assert np.sum(shocked) >= 5
        np.testing.assert_allclose(peaks[shocked], exact[shocked], rtol=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["map", "vmap"])
def test_lanes_of_a_batch_are_single_runs(method):
    """Four loads, of which the second is none."""
    scene, simulation, every = table_16(0.6), Simulation(tolerance=1e-6), SHORT / 16
    loads = jnp.asarray([15e3, jnp.nan, 20e3, 25e3])
    over = {"operation.radial_load": loads}
    runs = jb.simulate_batch(scene, SHORT, over, simulation=simulation, interval=every, method=method)
    assert runs.converged.tolist() == [True, False, True, True]
    assert runs.instants.cage.speed.shape == (4, 17)
    assert np.all(np.isnan(runs.instants.cage.speed[1]))
    for index in (0, 2, 3):
        one = simulate(scene.at_operation(radial_load=loads[index]), SHORT, simulation=simulation)
        lane = runs.lane(index)
        assert lane.completed
        np.testing.assert_allclose(lane.time, one.time[::8], rtol=1e-12, atol=1e-18)
        np.testing.assert_allclose(lane.instants.cage.speed, one.instants.cage.speed[::8], rtol=1e-6)
        np.testing.assert_allclose(lane.instants.state_elements[-1, 0], one.instants.state_elements[-1, 0], atol=1e-8)
        assert abs(lane.energy.error) < 1e-5
    assert runs.lane(1).time.shape == (0,)


def test_batches_want_as_many_values_for_each_path():
    for over in ({}, {"operation.radial_load": 25e3}, {"operation.radial_load": jnp.ones(2), "a": jnp.ones(3)}):
        with pytest.raises(ValueError, match="over"):
            jb.simulate_batch(table_16(), SHORT, over)
