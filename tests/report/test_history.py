"""A transient run as file, statistics, plots, moving pictures, and as the begin of another run; one compiled
program."""

import dataclasses
import json
import math
import shutil
from types import SimpleNamespace

import equinox as eqx
import numpy as np
import pytest
import xarray as xr
from filled_results import history_of
from matplotlib.text import Text
from moving_roller import table_16
from pictures import hidden_by_legends, outside, overlapping

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.motion.start import resume
from jaxbearing.numerics.status import SolveError, Status
from jaxbearing.report import histories, history_shocks
from jaxbearing.report.backends.matplotlib import animations
from jaxbearing.report.backends.matplotlib.animations import save_animation
from jaxbearing.report.bearing.run.animation import exaggeration
from jaxbearing.report.dataset import write_netcdf
from jaxbearing.report.histories import animate_history, history_to_dataset, history_to_dict, plot_history
from jaxbearing.report.plots import save_plot
from jaxbearing.time_laws import Ramp

SHORT = 2.56e-3
"""One segment of a run, s."""
TIGHT = jb.Simulation(tolerance=1e-7)


@pytest.fixture(scope="module")
def scene():
    return table_16(1.2)


@pytest.fixture(scope="module")
def whole(scene):
    return jb.simulate(scene, 2 * SHORT, simulation=TIGHT)


@pytest.fixture(scope="module")
def file(scene, tmp_path_factory):
    """The first half of it."""
    path = tmp_path_factory.mktemp("half") / "half.nc"
    write_netcdf(history_to_dataset(jb.simulate(scene, SHORT, simulation=TIGHT)), path)
    return path


def test_two_halves_make_a_whole(scene, whole, file):
    half = jb.simulate(scene, SHORT, simulation=TIGHT, restart=jb.read_last_state(file))
    assert half.completed
    n = half.time.shape[0]
    np.testing.assert_allclose(half.time, whole.time[-n:], rtol=1e-14)
    np.testing.assert_allclose(half.stop, 2 * SHORT, rtol=1e-14)
    # to the tolerance of the integration, times what the path with a first shock makes of it
    for name, unit in (("state_elements", [1e-5, 0.1, 1.0]), ("state_cage", [1e-5] * 3 + [0.1] * 3)):
        one, other = np.asarray(getattr(half.instants, name)), np.asarray(getattr(whole.instants, name)[-n:])
        scale = np.reshape(unit, (-1, *(1,) * (one.ndim - 2))) * (1.0 + np.abs(other).max())
        assert np.abs((one - other) / scale).max() < 1e-4
    assert abs(half.energy.error) < 1e-5
    # a history goes on as its file does
    first = jb.read_last_state(file)
    assert first.time == SHORT


def test_nothing_jumps_where_the_speed_goes_on_otherwise(scene, file):
    """Another course of the speed turns the frame otherwise: rollers and cage are where they were, and as fast."""
    last, other = jb.read_last_state(file), jb.Simulation(speed=Ramp(0.9, 1.1, 1.0))
    dynamics, state = eqx.filter_jit(resume)(scene, other, last)
    (q, v, u), (x, _, q_c, _, _, v_c), _ = dynamics.unscaled(state)
    turned, turning, _ = dynamics.frame(last.time)
    assert abs(turned - last.frame_angle) > 0.1
    pitch = 71e-3
    with xr.open_dataset(file) as old:
        places = 2.0 * math.pi * np.arange(30) / 30
        np.testing.assert_allclose(places + q / pitch + turned, old["azimuth"][-1], rtol=1e-13)
        np.testing.assert_allclose(turning + v / pitch, old["orbital_speed"][-1], rtol=1e-13)
        np.testing.assert_allclose(u / 6e-3, old["spin_speed"][-1], rtol=1e-13)
        np.testing.assert_allclose(turning + v_c / pitch, old["cage_speed"][-1], rtol=1e-13)
        np.testing.assert_allclose(x, old["cage_x"][-1], rtol=1e-13)
    np.testing.assert_allclose(q_c - q, last.cage[2] - last.elements[0], atol=1e-14)


def test_other_bearings_and_other_files_are_refused(scene, file, tmp_path):
    last = jb.read_last_state(file)
    for changes, reason in (
        ({"geometry.n_rollers": 28}, "30 rollers, for a scene with 28"),
        ({"cage": None, "simulation": TIGHT}, "without a cage"),
        ({"geometry.pitch_diameter": 0.1425}, "geometry.pitch_diameter is 0.142 there and 0.1425 here"),
        ({"cage.pocket_clearance": 290e-6}, "cage.pocket_clearance is .* there and 0.00029 here"),
    ):
        with pytest.raises(ValueError, match=reason):
            jb.simulate(scene.replace(changes), SHORT, restart=last)
    with pytest.raises(ValueError, match="pitch circle"):
        jb.simulate(
            scene.replace_geometry(pitch_diameter=0.1425), SHORT, restart=dataclasses.replace(last, identity=None)
        )
    broken = eqx.tree_at(lambda s: s.elements, last, np.full((3, 30), np.nan))
    with pytest.raises(ValueError, match="not finite"):
        jb.simulate(scene, SHORT, restart=broken)
    with pytest.raises(FileNotFoundError):
        jb.read_last_state(tmp_path / "gone.nc")
    half = tmp_path / "half.nc"
    half.write_bytes(file.read_bytes()[:5000])
    for path in (half, __file__):
        with pytest.raises(ValueError, match="not a NetCDF file"):
            jb.read_last_state(path)
    other = tmp_path / "other.nc"
    write_netcdf(xr.Dataset({"time": ("time", np.zeros(3), {"units": "s"})}), other)
    with pytest.raises(ValueError, match="it has no state_elements"):
        jb.read_last_state(other)


def test_a_file_of_an_earlier_version(scene, file, tmp_path):
    """It does not say which bearing it is of: the run goes on from it, and says so."""
    with xr.open_dataset(file, engine="h5netcdf", decode_times=False) as dataset:
        old = dataset.load()
    told = json.loads(old.attrs.pop("scene_identity"))
    assert told["geometry.roller_diameter"] == scene.geometry.roller_diameter
    old.rename(state_elements="state_rollers").to_netcdf(tmp_path / "old.nc", engine="h5netcdf")
    history = jb.simulate(scene, SHORT, simulation=TIGHT, restart=jb.read_last_state(tmp_path / "old.nc"))
    assert history.completed
    assert any(text.startswith("restart: the state does not say of which bearing") for text in history.warnings)
    # from then on it does
    assert history.last_state().identity is not None
    old.attrs["scene_identity"] = "[1, 2"
    old.to_netcdf(tmp_path / "damaged.nc", engine="h5netcdf")
    with pytest.raises(ValueError, match="scene_identity cannot be read"):
        jb.read_last_state(tmp_path / "damaged.nc")


def test_statistics(whole):
    instants, peaks = whole.instants, history_shocks.pocket_peaks(whole)
    now = np.stack([instants.elements.pocket_load_front, instants.elements.pocket_load_rear])
    assert np.all(peaks >= now * (1.0 - 1e-9))
    found = history_to_dict(whole)
    json.dumps(found, allow_nan=False)
    assert found["not_modelled"] == list(whole.not_modelled)
    assert "rolling_resistance" in whole.not_modelled
    summary = found["summary"]
    assert summary["pocket_load"]["front"]["max"] == peaks[0].max()
    shocks = summary["shocks"]
    assert shocks["threshold"] >= 0.1 * peaks.max()
    assert len(shocks["front"]["count"]) == 12
    assert sum(shocks["front"]["count"]) > 0
    highest = max(peak for peak in shocks["front"]["mean_peak"] if peak is not None)
    assert shocks["threshold"] < highest <= peaks[0].max()


def test_every_variable_of_the_file_has_its_unit(whole):
    dataset = history_to_dataset(whole)
    for name, variable in dataset.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert dataset["pocket_peaks_front"].dims == ("time", "element")
    assert dataset["turn_peak"].dims == ("face", "turn", "element")
    np.testing.assert_array_equal(dataset["turn_peak"].max("turn")[1], dataset["pocket_peaks_rear"].max("time"))
    assert int(dataset["shock_count"].sum()) > 0
    assert dataset["power_loss_total"].dims == ("time",)
    assert dataset.attrs["not_modelled"] == ", ".join(whole.not_modelled)
    np.testing.assert_allclose(dataset["energy_error"], whole.energy.error)


def test_shocks_of_a_known_course():
    load = np.array([0.0, 3.0, 5.0, 2.0, 0.5, 4.0, 0.0, 2.0])
    assert history_shocks.single_shocks(load, 1.0) == [(2, 5.0), (5, 4.0), (7, 2.0)]
    assert history_shocks.single_shocks(load, 9.0) == []


@pytest.mark.parametrize("speed", [300.0, -120.0])
def test_whirl_of_a_circle(speed):
    """Round a place off the centre, 3 turns and a bit, with uneven steps."""
    time = np.linspace(0.0, 1.0, 400) ** 1.1 * 3.1 * 2.0 * math.pi / abs(speed)
    x, y = 40e-6 * np.cos(speed * time) - 2e-6, 40e-6 * np.sin(speed * time) + 1e-6
    np.testing.assert_allclose(history_shocks.mean_whirl(time, x, y), speed, rtol=0.02)


def test_whirl_needs_a_turn_and_an_orbit():
    """Of an arc and of a centre that stays where it is there is none."""
    for turns, radius, expected in ((3.1, 40e-6, 0.5), (0.4, 40e-6, None), (3.1, 1e-14, None)):
        time = np.linspace(0.0, turns * 2.0 * math.pi / 600.0, 4000)
        cage = SimpleNamespace(
            x=radius * np.cos(300.0 * time), y=radius * np.sin(300.0 * time), speed=np.full(time.size, 600.0)
        )
        history = SimpleNamespace(instants=SimpleNamespace(cage=cage), time=time)
        found = history_shocks.whirl_ratio(history)
        assert found is None if expected is None else abs(found - expected) < 0.02


def test_plot(whole, tmp_path):
    figure = plot_history(whole, "a bearing")
    save_plot(figure, tmp_path / "run.png")
    assert (tmp_path / "run.png").stat().st_size > 20_000
    assert overlapping(figure) == []
    assert hidden_by_legends(figure) == []
    # the load points down as in the drawings, and the page is not mirrored
    (orbit,) = [axes for axes in figure.axes if axes.get_title().startswith("Cage centre")]
    assert orbit.yaxis_inverted()
    assert orbit.xaxis_inverted()


def test_letters_of_an_animation_can_be_read(scene, whole):
    """12 pixels and more; no text lies on another."""
    moving = animate_history(
        whole, scene, "a bearing"
    )  # kept: Matplotlib warns of one that is dropped before it is drawn
    figure = moving._fig
    figure.canvas.draw()
    sizes = [text.get_fontsize() for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    assert min(sizes) * animations._DOTS / 72.0 >= 12.0
    assert overlapping(figure) == []
    assert outside(figure) == []


@pytest.mark.parametrize("suffix", [".gif", ".html"])
def test_animation(suffix, scene, whole, tmp_path, monkeypatch):
    monkeypatch.setattr("jaxbearing.report.backends.matplotlib.animations.PICTURES", 6)
    told = []
    path = tmp_path / f"run{suffix}"
    save_animation(animate_history(whole, scene, "a bearing"), path, lambda done, of: told.append((done, of)))
    assert 5_000 < path.stat().st_size < 1_000_000
    assert told[-1] == (6.0, 6.0)
    assert [item.name for item in tmp_path.iterdir()] == [path.name]


def test_clearances_are_drawn_larger_but_rollers_do_not_meet(scene):
    factor = exaggeration(scene)
    gap = math.pi * 142e-3 / 30 - 12e-3
    assert factor > 2.0
    assert factor * 150e-6 <= 0.3 * gap
    assert exaggeration(scene.replace({"cage": None, "simulation": TIGHT})) == 1.0


@pytest.mark.skipif(shutil.which("ffmpeg") is not None, reason="ffmpeg is there")
def test_films_need_ffmpeg(tmp_path):
    with pytest.raises(OSError, match="ffmpeg"):
        save_animation(None, tmp_path / "run.mp4")
    with pytest.raises(ValueError, match=r"\.html or \.mp4"):
        save_animation(None, tmp_path / "run.avi")


@pytest.mark.parametrize("name", ["turbine_roller_dynamic", "satellite_contact_1"])
def test_a_run_that_does_not_begin_has_the_same_keys(name):
    """Who reads the JSON of a run asks for the same names, whether it ran or not."""
    scene = jb.load_scene(name)
    begun = histories.history_to_dict(history_of(scene))
    error = SolveError("no start", Status.DIVERGED)
    found = json.loads(json.dumps(histories.not_begun_to_dict(scene, 1e-3, error), allow_nan=False))
    assert set(found) == set(begun) | {"failure"}
    assert set(found["time"]) == set(begun["time"])
    assert (found["completed"], found["status"], found["failure"]) == (False, "diverged", str(error))
    assert found["time"]["wanted"] == 1e-3
    assert found["solver"] == getattr(scene.simulation, "solver", "bdf2")
    assert found["warnings"] == []
    assert found["operation"].keys() == begun["operation"].keys()


def test_a_run_that_does_not_begin_warns_of_its_scene():
    scene = jb.load_scene("turbine_roller_dynamic", {"operation.inner_speed": "50 rpm"})
    found = histories.not_begun_to_dict(scene, 1e-3, SolveError("no start", Status.DIVERGED))
    assert any("less than 100 rpm" in text for text in found["warnings"])
