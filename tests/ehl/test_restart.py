"""Runs that go on from earlier ones, from memory and from a file; steps that end where the speed bends or jumps."""

import os
import subprocess
import sys

import equinox as eqx
import numpy as np
import pytest
import xarray as xr
from line_contacts import satellite
from numpy.testing import assert_allclose

import jaxbearing as jb
from jaxbearing.ehl import FilmSimulation
from jaxbearing.report.dataset import write_netcdf
from jaxbearing.report.histories import history_to_dataset
from jaxbearing.time_laws import LinearRamp, Ramp, Sinusoidal, Steady, Tabulated

SCENE = satellite(1, 101)
STRAIGHT = Tabulated(np.array([0.0, 1e-3, 4e-3]), np.array([1.0, 0.75, 0.0]))
"""A ramp in 4 ms with a point at 1 ms: a run through that point halts there too."""


def run(duration, speed, scene=SCENE, **options):
    return jb.simulate(scene, duration, simulation=FilmSimulation(speed=speed), **options)


@pytest.fixture(scope="module")
def first():
    return run(1e-3, STRAIGHT)


@pytest.fixture(scope="module")
def file(first, tmp_path_factory):
    path = tmp_path_factory.mktemp("film") / "film.nc"
    write_netcdf(history_to_dataset(first), path)
    return path


def test_two_parts_make_a_whole(first, file):
    """Every step of 1 ms and 2 ms more is one of the run in 3 ms, but for the rounding of its units."""
    whole = run(3e-3, STRAIGHT)
    for start in (first, jb.read_last_state(file)):
        second = run(2e-3, STRAIGHT, restart=start)
        n = second.time.size
        assert first.time.size + n - 1 == whole.time.size
        assert_allclose(second.time, whole.time[-n:], rtol=1e-9)
        assert_allclose(second.film.minimum, whole.film.minimum[-n:], rtol=1e-8)
        assert_allclose(second.profile.film, whole.profile.film[-n:], rtol=1e-8)
        assert float(second.mass_balance) < 1e-8


def test_the_file_holds_the_state_to_the_last_digit(first, file):
    last = jb.read_last_state(file)
    for name in ("x", "time", "pressure", "offset", "mass", "steps", "known", "proposal"):
        np.testing.assert_array_equal(np.asarray(getattr(last, name)), np.asarray(getattr(first.last_state, name)))
    with xr.open_dataset(file, engine="h5netcdf", decode_times=False) as dataset:
        assert dataset["last_state_mass"].dims == ("last_time", "x")
        assert dataset["last_state_steps"].attrs["units"] == "s"
        assert dataset["last_state_pressure"].attrs["units"] == "Pa"


def test_another_speed_and_viscosity_go_on_without_a_jump(first):
    """The clock goes on in seconds, and the film is where it was."""
    warmer = SCENE.at_operation(entrainment_speed=0.04, oil_temperature=303.15)
    history = run(1e-3, Steady(), warmer, restart=first)
    assert_allclose([float(history.time[0]), float(history.time[-1])], [1e-3, 2e-3], rtol=1e-12)
    assert_allclose(history.profile.film[0], first.profile.film[-1], rtol=1e-9)
    assert_allclose(float(history.entrainment_speed[-1]), 0.04, rtol=1e-12)
    assert history.completed


def test_other_contacts_are_refused(first):
    other = lambda **changes: SCENE.at_operation(**changes)
    cases = [
        (satellite(1, 201), "contact.nodes is 101 there and 201 here"),
        (satellite(1, 101, inlet=5.0), "contact.inlet is 4 there and 5 here"),
        (other(load_per_length=80e3), "Hertz half width"),
        (satellite(1, 101, compressible=True), "contact.compressible"),
        (other(entrainment_speed=-0.02), "no inlet on that side"),
    ]
    for scene, reason in cases:
        with pytest.raises(ValueError, match=reason):
            run(1e-3, STRAIGHT, scene, restart=first)
    broken = eqx.tree_at(lambda state: state.pressure, first.last_state, np.full((3, 101), np.nan))
    with pytest.raises(ValueError, match="not finite"):
        run(1e-3, STRAIGHT, restart=broken)
    bearing = jb.load_scene("turbine_roller_dynamic")
    with pytest.raises(ValueError, match="a state of a line contact, for a scene of a bearing"):
        jb.simulate(bearing, 1e-3, restart=first)


@pytest.mark.parametrize("change", ["missing", "shape"])
def test_other_files_are_refused(change, file, tmp_path):
    with xr.open_dataset(file, engine="h5netcdf", decode_times=False) as dataset:
        changed = dataset.load()
    if change == "missing":
        changed, reason = changed.drop_vars("last_state_mass"), "it has no last_state_mass"
    else:
        changed, reason = changed.isel(last_time=slice(2)), "another shape"
    changed.to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(ValueError, match=reason):
        jb.read_last_state(tmp_path / "other.nc")


DAMAGE = """
import random, sys
import jaxbearing as jb
whole, to, dice, refused = open(sys.argv[1], "rb").read(), sys.argv[2], random.Random(3), 0
good = jb.read_last_state(sys.argv[1])
for i in range(300):
    made = bytearray(whole)
    if i % 3 == 0:
        made = made[: dice.randrange(len(made))]
    for _ in range(dice.choice((1, 1, 5, 100)) if i % 3 else 0):
        made[dice.randrange(len(made))] = dice.randrange(256)
    with open(to, "wb") as file:
        file.write(made)
    try:
        found = jb.read_last_state(to)
    except ValueError as error:
        assert str(error).startswith(to) and "\\n" not in str(error), error
        refused += 1
        continue
    for name in ("x", "pressure", "mass", "steps", "offset"):
        assert (getattr(found, name) == getattr(good, name)).all(), (i, name)
print(refused)
"""


@pytest.mark.slow
def test_damaged_files_are_refused(file, tmp_path):
    """Cut short, or with other bytes: refused, unless the damage is in what a run does not go on from. In a process of
    its own, since a library that reads such files may end it."""
    program = [sys.executable, "-c", DAMAGE, str(file), str(tmp_path / "damaged.nc")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    process = subprocess.run(program, env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert process.returncode == 0, process.stderr
    assert 100 <= int(process.stdout) < 300


def test_a_mesh_with_two_inlets_takes_both_directions():
    """A run that reverses can go on with a speed that does not, and the other way round."""
    back = Tabulated(np.array([0.0, 0.5e-3, 1e-3]), np.array([1.0, -0.5, 1.0]))
    first = run(0.6e-3, back)
    assert float(first.entrainment_speed.min()) < 0
    second = run(0.3e-3, Steady(), restart=first)
    assert second.completed
    assert second.profile.x.size == first.profile.x.size


def test_steps_end_where_the_speed_bends_or_jumps():
    bends = Tabulated(np.array([0.2e-3, 0.5e-3, 0.9e-3]), np.array([1.0, 0.5, 1.0]))
    jump = LinearRamp(1.0, 0.3, 0.0, 0.5e-3)
    for law, times in (
        (bends, (0.2e-3, 0.5e-3, 0.9e-3)),
        (jump, (0.5e-3,)),
        (LinearRamp(1.0, 0.0, 1e-3, 2e-4), (2e-4,)),
    ):
        history = run(1e-3, law)
        for time in times:
            assert np.min(np.abs(np.asarray(history.time) / time - 1.0)) < 1e-12
        assert float(history.mass_balance) < 1e-8
    history = run(1e-3, jump)
    before = np.asarray(history.time) <= 0.5e-3 * (1 + 1e-12)
    assert_allclose(np.asarray(history.entrainment_speed)[before], 0.02, rtol=1e-12)
    assert_allclose(np.asarray(history.entrainment_speed)[~before], 0.006, rtol=1e-12)
    # steady until the jump, to the tolerance of Newton's method
    assert_allclose(np.asarray(history.film.minimum)[before], history.film.minimum[0], rtol=1e-7)


def test_kinks():
    assert Steady().kinks().size == Sinusoidal(1.0, 1.0).kinks().size == Ramp(1.0, 0.0, 1.0).kinks().size == 0
    assert_allclose(LinearRamp(1.0, 0.0, 3.0, 1.0).kinks(), [1.0, 4.0])
    assert_allclose(STRAIGHT.kinks(), [0.0, 1e-3, 4e-3])
