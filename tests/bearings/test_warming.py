"""Temperatures of a bearing in time: the steady end, energies, what is kept, tables of time, limits, refusals."""

import dataclasses
import io
import json

import jax
import numpy as np
import pytest
import xarray as xr
from rich.console import Console
from warm_cases import CHANGES, NAMES, SEATS, warm

import jaxbearing as jb
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.warming.runs import PIECE, pieces_of, wanted_times
from jaxbearing.bearings.warming.settings import INSTANTS
from jaxbearing.report import histories
from jaxbearing.report.backends.matplotlib.animations import save_animation
from jaxbearing.report.dataset import write_netcdf
from jaxbearing.report.plots import save_plot
from jaxbearing.time_laws import LinearRamp, RotatingLoad, Tabulated

SLOW = pytest.mark.slow
HOURS = 3600.0


@pytest.fixture(scope="module")
def run():
    return jb.simulate(warm("roller"), 2.0 * HOURS)


def test_ends_at_the_steady_state(run):
    """1e-6 K; what was at the start is the cold bearing."""
    steady = jb.solve(warm("roller"))
    assert run.completed
    np.testing.assert_allclose(run.node_temperatures()[0], 293.15, rtol=1e-15)
    np.testing.assert_allclose(run.node_temperatures()[-1], steady.thermal.node_temperatures(), atol=1e-6)
    last = run.at(-1)
    np.testing.assert_allclose(last.power_loss.total, steady.power_loss.total, rtol=1e-8)
    np.testing.assert_allclose(last.heat_to_oil, steady.thermal.heat_to_oil, rtol=1e-8)
    load = max(np.max(steady.elements.load_inner), np.max(steady.elements.load_outer))
    np.testing.assert_allclose(last.largest_load, load, rtol=1e-8)
    assert np.all(np.diff(run.time) > 0.0)
    assert run.time.shape == (INSTANTS + 1,)


def test_energy_closes(run):
    # energies are integrated in the state of the temperatures: what is left open is round-off, whatever the tolerance
    energy = run.energy
    assert abs(float(energy.error)) < 1e-12
    left = float(energy.to_oil + energy.to_ambient + energy.stored)
    np.testing.assert_allclose(float(energy.losses), left, rtol=1e-12)
    instants = run.instants
    stored = np.asarray(instants.power_loss.total - instants.heat_to_oil - instants.heat_to_ambient)
    np.testing.assert_allclose(instants.heat_stored, stored, atol=1e-8 * float(instants.power_loss.total[0]))
    # by the instants alone, which are far apart for the first seconds
    late = np.asarray(run.time) > 60.0
    late_power, late_time = np.asarray(instants.heat_to_ambient)[late], np.asarray(run.time)[late]
    by_instants = np.sum(0.5 * (late_power[1:] + late_power[:-1]) * np.diff(late_time))
    assert 0.9 < by_instants / float(energy.to_ambient) < 1.0


def test_goes_on_from_its_end(run, tmp_path):
    """In two parts, the second one from a file, the temperatures are those of one run."""
    scene = warm("roller")
    first = jb.simulate(scene, 60.0, interval=20.0)
    write_netcdf(histories.history_to_dataset(first), tmp_path / "run.nc")
    last = jb.read_last_state(tmp_path / "run.nc")
    second = jb.simulate(scene, 60.0, interval=30.0, restart=last)
    np.testing.assert_allclose(second.time, [60.0, 90.0, 120.0])
    whole = jb.simulate(scene, 120.0, interval=60.0)
    np.testing.assert_allclose(second.node_temperatures()[-1], whole.node_temperatures()[-1], atol=5e-3)
    other = warm("roller", geometry__width="21 mm")
    with pytest.raises(ValueError, match=r"geometry\.width"):
        jb.simulate(other, 60.0, restart=last)
    with pytest.raises(ValueError, match="a state of 4 nodes"):
        jb.simulate(warm("roller", 1), 60.0, restart=first)


def test_a_node_that_passes_the_limit_ends_the_run():
    scene = warm("roller", limit="130 degC")
    found = jb.simulate(scene, HOURS, throw=False)
    assert not found.completed
    assert jb.Status(int(found.status)) == jb.Status.THERMAL_RUNAWAY
    last = np.asarray(found.node_temperatures()[-1])
    np.testing.assert_allclose(last.max(), 403.15, rtol=1e-6)
    assert 0.0 < float(found.time[-1]) < 1.0
    assert np.all(np.isfinite(np.asarray(found.instants.power_loss.total)))
    assert "a node passed thermal.limit" in found.failure()
    with pytest.raises(jb.SolveError, match=r"the oil, at 130\.0 degC"):
        jb.simulate(scene, HOURS)


@SLOW
def test_tables_of_time(run):
    """A load that is cut and a flow that is doubled at given times end where the other scene is steady."""
    scene = warm("roller")
    settings = jb.WarmUpSimulation(
        load=LinearRamp(start=1.0, stop=0.5, duration=0.0, begin=100.0),
        oil_flow=Tabulated(np.asarray([0.0, 50.0, 70.0]), np.asarray([1.0, 1.0, 2.0])),
        start=350.0,
    )
    found = jb.simulate(scene, HOURS, simulation=settings)
    changed = scene.at_operation(radial_load=0.5 * scene.operation.radial_load, oil_flow=2 * scene.operation.oil_flow)
    steady = jb.solve(changed)
    np.testing.assert_allclose(found.node_temperatures()[-1], steady.thermal.node_temperatures(), atol=1e-6)
    np.testing.assert_allclose(found.node_temperatures()[0], 350.0)
    time, load = np.asarray(found.time), np.asarray(found.instants.largest_load)
    before, after = load[time <= 100.0], load[time > 100.0]
    assert before.min() > 1.2 * after.max()
    assert abs(float(found.energy.error)) < 1e-4


@SLOW
def test_simulation_of_rollers_gives_speed_and_load():
    scene = warm("roller")
    rollers = Simulation(duration=100.0, load=LinearRamp(start=0.5, stop=1.0, duration=50.0))
    found = jb.simulate(dataclasses.replace(scene, simulation=rollers), interval=25.0)
    assert float(found.time[-1]) == 100.0
    assert np.all(np.diff(np.asarray(found.instants.largest_load)[:3]) > 0.0)
    turning = Simulation(rotating_load=RotatingLoad(load=10.0, speed=100.0))
    with pytest.raises(ValueError, match="rotating_load"):
        jb.simulate(scene, 1.0, simulation=turning)


def test_pieces_end_at_kinks():
    times = wanted_times(0.0, 100.0, 1.0)
    pieces = list(pieces_of(0.0, times, np.asarray([0.0, 10.5, 10.5, 50.0, 200.0])))
    assert all(piece.times.size <= PIECE for piece in pieces)
    ends = [float(piece.times[-1]) for piece in pieces]
    assert {10.5, 50.0, 100.0} <= set(ends)
    np.testing.assert_array_equal([piece.begin for piece in pieces][1:], ends[:-1])
    kept = [time for piece in pieces for time in (piece.times if piece.end_wanted else piece.times[:-1])]
    np.testing.assert_allclose(kept, times)


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        (lambda: warm("roller", 6), r"thermal\.capacity\.shaft, thermal\.capacity\.housing: found nothing"),
        (lambda: jb.load_scene("tapered_example"), "cannot simulate a TaperedRollerBearing"),
    ],
)
def test_refusals(scene, message):
    with pytest.raises((ValueError, TypeError), match=message):
        jb.simulate(scene(), 60.0)


def test_refuses_other_settings():
    scene = warm("roller")
    with pytest.raises(ValueError, match="duration"):
        jb.simulate(scene)
    with pytest.raises(TypeError, match="WarmUpSimulation"):
        jb.simulate(scene, 1.0, simulation="fast")
    with pytest.raises(ValueError, match="instants"):
        jb.simulate(scene, HOURS, interval=1e-3)


def test_an_interrupt_keeps_what_was_computed():
    def progress(reached, stop):
        raise KeyboardInterrupt

    found = jb.simulate(warm("roller"), 2.0 * HOURS, progress=progress)
    assert found.interrupted
    assert not found.completed
    assert found.time.shape == (PIECE + 1,)
    assert "interrupted" in found.failure()


def test_files_and_screen(run, tmp_path):
    told = histories.history_to_dict(run)
    assert json.loads(json.dumps(told))["summary"]["temperatures"]["oil"]["end"] == float(
        run.instants.temperatures.oil[-1]
    )
    dataset = histories.history_to_dataset(run)
    write_netcdf(dataset, tmp_path / "run.nc")
    with xr.open_dataset(tmp_path / "run.nc", engine="h5netcdf", decode_times=False) as read:
        assert read["temperatures_inner_ring"].dims == ("time",)
        assert all("units" in read[name].attrs for name in read.variables)
        assert read["power_loss_total"].attrs["units"] == "W"
    screen = io.StringIO()
    histories.print_history(run, "a title", Console(file=screen, width=100))
    text = screen.getvalue()
    assert "COMPLETED" in text
    assert "inner ring, degC" in text
    assert "kJ of losses" in text
    assert "the contact load is largest at the end" in text


@SLOW
def test_pictures(run, tmp_path):
    save_plot(histories.plot_history(run, "a title"), tmp_path / "run.svg")
    assert (tmp_path / "run.svg").stat().st_size > 10_000
    few = jax.tree.map(lambda leaf: leaf[::96] if np.shape(leaf)[:1] == np.shape(run.time) else leaf, run)
    for suffix in ("gif", "html"):
        save_animation(histories.animate_history(few, warm("roller"), "a title"), tmp_path / f"run.{suffix}")
        assert (tmp_path / f"run.{suffix}").stat().st_size > 10_000


def test_near_the_steady_state_no_step_is_rejected(run):
    """The noise of the bearing's solve is no error of a step. At the start, where the oil thins by a factor of ten in
    seconds, some steps are too long."""
    assert int(run.rejected) < 10
    assert int(run.accepted) < 100
    more = jb.simulate(warm("roller"), 2.0 * HOURS, restart=run)
    assert int(more.rejected) == 0
    assert int(more.accepted) < 60


@SLOW
def test_one_node_rejects_no_step():
    found = jb.simulate(warm("roller", 1), 2.0 * HOURS)
    assert (int(found.rejected), found.completed) == (0, True)
    assert int(found.accepted) < 70


@SLOW
@pytest.mark.parametrize("kind", ["ball", "tapered"])
def test_other_families_on_seats(kind):
    """The clearance follows the temperatures: it is least before the end, for the inner ring warms first."""
    scene = jb.load_scene(NAMES[kind], CHANGES[kind] | {"thermal.nodes": "4"} | SEATS)
    found, steady = jb.simulate(scene, 6.0 * HOURS), jb.solve(scene)
    np.testing.assert_allclose(found.node_temperatures()[-1], steady.thermal.node_temperatures(), atol=1e-6)
    play = "clearance" if kind == "ball" else "axial_shift"
    np.testing.assert_allclose(getattr(found.at(-1).fit, play), getattr(steady.fit, play), atol=1e-12)
    values, peaks = np.asarray(getattr(found.instants.fit, play)), found.peaks
    assert 0.0 < float(peaks.least_play_time) < float(found.time[-1])
    assert float(peaks.least_play) <= values.min() < values[-1] - 1e-9
    # the top of the peak is found between few instants, to a third of the tolerance: 3e-3 K of about 0.5 um/K
    few = jb.simulate(scene, 6.0 * HOURS, simulation=jb.WarmUpSimulation(instants=24))
    np.testing.assert_allclose(few.peaks.least_play, peaks.least_play, atol=0.5e-9)
    np.testing.assert_allclose(few.peaks.least_play_time, peaks.least_play_time, atol=2.0)
    assert abs(float(found.energy.error)) < 1e-4
    # the instants of a long interval do not show it, but the steps do
    coarse = jb.simulate(scene, 6.0 * HOURS, interval=6.0 * HOURS)
    assert np.min(np.asarray(getattr(coarse.instants.fit, play))) > float(peaks.least_play) + 1e-9
    np.testing.assert_allclose(coarse.peaks.least_play, peaks.least_play, atol=0.5e-9)
    np.testing.assert_allclose(coarse.peaks.least_play_time, peaks.least_play_time, atol=2.0)
