"""The table [simulation] of bearings with [thermal]: what it becomes, its way back to a file, what it refuses."""

import dataclasses

import jax
import numpy as np
import pytest
from warm_cases import CHANGES, NAMES, warm

import jaxbearing as jb
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.scenes.part_writer import differences
from jaxbearing.time_laws import LinearRamp, Ramp, Sinusoidal, Steady, Tabulated

KINDS = ("ball", "roller", "tapered")
every_kind = pytest.mark.parametrize("kind", KINDS)
TABLE = {
    "duration": "2 h",
    "start": "30 degC",
    "instants": "20",
    "solver": "kvaerno3",
    "tolerance": "1e-6",
    "speed_ramp.start": "0.2",
    "speed_ramp.duration": "60 s",
    "speed_ramp.shape": "linear",
    "load_ramp.start": "0.5",
    "load_ramp.duration": "10 min",
    "oil_inlet_table.times": '["0 s", "1800 s"]',
    "oil_inlet_table.factors": "[0.0, 1.0]",
    "oil_flow_perturbation.amplitude": "0.2",
    "oil_flow_perturbation.frequency": "0.01 Hz",
}


def with_table(kind, table, **changes):
    own = {f"simulation.{name}": value for name, value in table.items()}
    return jb.load_scene(NAMES[kind], CHANGES[kind] | {"thermal.nodes": "4"} | own | changes)


@every_kind
def test_the_settings_of_a_table(kind):
    found = with_table(kind, TABLE).simulation
    assert isinstance(found, jb.WarmUpSimulation)
    assert (float(found.duration), float(found.start), float(found.tolerance)) == (7200.0, 303.15, 1e-6)
    assert (found.instants, found.solver) == (20, "kvaerno3")
    laws = (LinearRamp, Ramp, Tabulated, Sinusoidal)
    assert tuple(map(type, (found.speed, found.load, found.oil_inlet, found.oil_flow))) == laws
    np.testing.assert_allclose(found.speed.factor(30.0), 0.6, rtol=1e-15)
    np.testing.assert_allclose(found.oil_inlet.factor(900.0), 0.5, rtol=1e-15)


@every_kind
def test_what_is_not_given_is_that_of_the_class(kind):
    found = with_table(kind, {"duration": "2 h"}).simulation
    assert next(differences(found, jb.WarmUpSimulation(duration=7200.0)), None) is None


@every_kind
@pytest.mark.parametrize(
    "law",
    [
        Steady(),
        Sinusoidal(frequency=0.01, amplitude=0.2),
        Ramp(start=0.1, stop=1.0, duration=7.0, begin=3.0),
        LinearRamp(start=0.1, stop=0.7, duration=0.0, begin=3.0),
        Tabulated(np.asarray([0.0, 1.0, 1e3]), np.asarray([0.1, 0.2, 0.3])),
    ],
    ids=lambda law: type(law).__name__,
)
def test_every_course_comes_back_from_a_file(kind, law, tmp_path):
    """Of speed, load, oil inlet and oil flow, to the last bit."""
    settings = jb.WarmUpSimulation(
        duration=1e4 / 3.0, speed=law, load=law, oil_inlet=law, oil_flow=law, start=301.0, instants=7, solver="kvaerno4"
    )
    scene = dataclasses.replace(warm(kind), simulation=settings)
    jb.save_scene(scene, tmp_path / "scene.toml")
    back = jb.load_scene(tmp_path / "scene.toml")
    assert jax.tree.structure(back) == jax.tree.structure(scene)
    assert next(differences(back, scene), None) is None


COURSES = {
    "oil_inlet": ("time [min], oil_inlet [degC]\n0, 20\n30, 60\n", [0.0, 0.5, 1.0]),
    "oil_flow": ("time [s];oil_flow [l/h]\n0;1\n1800;2\n", [0.5, 0.75, 1.0]),
    "speed": ("time [h], speed [rpm]\n0, 1200\n0.5, 12000\n", [0.1, 0.55, 1.0]),
    "load": ("time [s], factor\n0, 0.5\n1800, 2\n", [0.5, 1.25, 2.0]),
}


@pytest.mark.parametrize("name", COURSES)
def test_courses_from_csv_files(name, tmp_path):
    """Of 60 degC where the room has 20, of 2 l/h and of 12 000 rpm."""
    text, expected = COURSES[name]
    (tmp_path / "course.csv").write_text(text, encoding="utf-8")
    table = {f"{name}_table.file": str(tmp_path / "course.csv")}
    law = getattr(with_table("ball", table, **{"operation.inner_speed": "12000 rpm"}).simulation, name)
    np.testing.assert_allclose([law.factor(t) for t in (0.0, 900.0, 1800.0)], expected, rtol=1e-14, atol=1e-14)


def test_a_csv_file_is_relative_to_the_scene(tmp_path, monkeypatch):
    scene = with_table("ball", {"oil_inlet_table.times": '["0 s", "1 s"]', "oil_inlet_table.factors": "[1, 1]"})
    jb.save_scene(scene, tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text(encoding="utf-8")
    begin = text.index("[simulation.oil_inlet_table]")
    (tmp_path / "scene.toml").write_text(text[:begin] + '[simulation.oil_inlet_table]\nfile = "inlet.csv"\n')
    (tmp_path / "inlet.csv").write_text(COURSES["oil_inlet"][0], encoding="utf-8")
    monkeypatch.chdir("/")
    assert float(jb.load_scene(tmp_path / "scene.toml").simulation.oil_inlet.factor(900.0)) == 0.5


ROLLERS = {"thermal": "none"}
REFUSED = {
    "oil without a network": ("roller", {"oil_flow_ramp.start": "0.1", "oil_flow_ramp.duration": "1 s"}, ROLLERS),
    "start without a network": ("roller", {"start": "30 degC"}, ROLLERS),
    "instants without a network": ("roller", {"instants": "30"}, ROLLERS),
    "a kink of the rollers": (
        "roller",
        {"speed_ramp.start": "0.1", "speed_ramp.duration": "1 s", "speed_ramp.shape": "linear"},
        ROLLERS,
    ),
    "an explicit method": ("roller", {"solver": "tsit5"}, {}),
    "an unknown method": ("ball", {"solver": "tsit5"}, {}),
    "a turning load": ("roller", {"rotating_load.load": "10 N", "rotating_load.speed": "10 rpm"}, {}),
    "no instants": ("tapered", {"instants": "0"}, {}),
    "two courses": (
        "ball",
        {"oil_inlet_ramp.start": "0", "oil_inlet_ramp.duration": "1 s", "oil_inlet_perturbation.amplitude": "0.1"}
        | {"oil_inlet_perturbation.frequency": "1 Hz"},
        {},
    ),
    "a smooth jump": ("ball", {"oil_flow_ramp.start": "0.5", "oil_flow_ramp.duration": "0 s"}, {}),
    "a flow backwards": ("ball", {"oil_flow_table.times": '["0 s", "1 s"]', "oil_flow_table.factors": "[1, -1]"}, {}),
    "a start at rest": ("ball", {"speed_table.times": '["0 s", "1 s"]', "speed_table.factors": "[0, 1]"}, {}),
}
WORDS = {
    "oil without a network": "simulation.oil_flow_ramp",
    "start without a network": "simulation.start",
    "instants without a network": "simulation.instants",
    "a kink of the rollers": "a kink is a shock",
    "an explicit method": "whose run is stiff",
    "an unknown method": "simulation.solver",
    "a turning load": "simulation.rotating_load",
    "no instants": "simulation.instants",
    "two courses": "oil_inlet_perturbation and oil_inlet_ramp",
    "a smooth jump": "shape = 'linear'",
    "a flow backwards": "simulation.oil_flow_table.factors",
    "a start at rest": "films vanish",
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused(name):
    kind, table, changes = REFUSED[name]
    with pytest.raises(jb.SceneError) as refused:
        with_table(kind, table, **changes)
    assert WORDS[name] in str(refused.value)


NO_VALUES = {
    "oil_inlet": ("time [s], oil_inlet [degC]\n0, 20\n30, 60\n", {"thermal.ambient": "60 degC"}, "ambient"),
    "oil_flow": ("time [s], oil_flow [l/h]\n0, 1\n30, 2\n", {"operation.oil_flow": "0 l/h"}, "oil_flow is 0"),
    "load": ("time [s], load [N]\n0, 1\n30, 2\n", {"operation.radial_load": "100 N"}, "several loads"),
}


@pytest.mark.parametrize("name", NO_VALUES)
def test_values_that_make_no_factors(name, tmp_path):
    text, changes, word = NO_VALUES[name]
    (tmp_path / "course.csv").write_text(text, encoding="utf-8")
    with pytest.raises(jb.SceneError, match=word):
        with_table("ball", {f"{name}_table.file": str(tmp_path / "course.csv")}, **changes)


def test_oil_below_absolute_zero(tmp_path):
    (tmp_path / "course.csv").write_text("time [s], oil_inlet [degC]\n0, 20\n30, -300\n", encoding="utf-8")
    with pytest.raises(jb.SceneError, match="absolute zero"):
        with_table("ball", {"oil_inlet_table.file": str(tmp_path / "course.csv")})


def test_rollers_in_motion_keep_their_table():
    """Without [thermal] the table is that of a run of the rollers, with its own solvers."""
    found = jb.load_scene("turbine_roller_dynamic", {"simulation.solver": "dopri8"}).simulation
    assert isinstance(found, Simulation)
    assert found.solver == "dopri8"
    assert jb.load_scene("turbine_roller_dynamic").simulation.solver == Simulation().solver


def test_a_run_of_rollers_beside_a_network_is_no_file(tmp_path):
    """Files with [thermal] hold runs of temperatures."""
    scene = dataclasses.replace(warm("roller"), simulation=Simulation(duration=1.0))
    with pytest.raises(jb.SceneError, match=r"simulation\.solver"):
        jb.save_scene(scene, tmp_path / "scene.toml")


def test_settings_of_the_other_run_are_refused():
    scene = jb.load_scene("turbine_roller_dynamic")
    with pytest.raises(TypeError, match="expected a Simulation"):
        jb.simulate(dataclasses.replace(scene, simulation=jb.WarmUpSimulation()), 1e-3)
