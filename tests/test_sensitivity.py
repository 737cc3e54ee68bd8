"""Sensitivities of each family's results: against differences of `solve`, failed lanes, `jit` and `vmap`."""

import ast
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of
from roller_cases import dry_roller, reference_roller
from warm_cases import warm

import jaxbearing as jb
from jaxbearing.numerics.status import Status
from jaxbearing.sensitivity import largest

# input: relative step of the central difference; it balances truncation and rounding
INPUTS = {
    "operation.inner_speed": 1e-4,
    "operation.radial_load": 1e-4,
    "operation.oil_temperature": 1e-5,
    "operation.oil_flow": 1e-3,
    "geometry.diametral_clearance": 1e-3,
    "geometry.roller_diameter": 1e-5,
    "geometry.pitch_diameter": 1e-5,
    "cage.guiding_clearance": 1e-4,
    "cage.land_width": 1e-4,
    "cage.pocket_clearance": 1e-4,
    "drag.coefficient": 1e-3,
    "materials.rings.youngs_modulus": 1e-4,
    "materials.rollers.density": 1e-3,
    "oil.rheology.shear_modulus": 1e-3,
    "oil.viscosity.c1": 1e-5,
    "oil.pressure_viscosity.value": 1e-4,
    "contact.entrainment_offset": 1e-2,
    "flange.axial_clearance": 1e-3,
    "flange.height": 1e-3,
}


def test_largest():
    values = {"a.b": 1.0, "oil.c": 5.0, "d": -3.0, "e": 0.0, "f": float("nan"), "g": 2.0}
    assert largest(values, 2) == ["oil.c", "d"]
    assert largest(values, 9, ("oil.",)) == ["d", "g", "a.b"]


@pytest.fixture
def made_up(monkeypatch):
    """Solutions without a solve: what is refused is refused before derivatives are computed."""
    monkeypatch.setattr("jaxbearing.sensitivity.solve_with_roots", lambda scene, options: (solution_of(scene), ()))


@pytest.mark.usefixtures("made_up")
def test_scenes_without_any_of_the_results_are_refused():
    with pytest.raises(ValueError, match=r"neither power loss nor cage slip nor life.*contact\.traction.*rating"):
        jb.sensitivities(dry_roller())
    with pytest.raises(ValueError, match=r"31 points; expected one point.*slide_to_roll"):
        jb.sensitivities(jb.load_scene("two_disk_etm"))


CALLERS = {
    # the table of solvers names them
    **dict.fromkeys(("solve_ball", "solve_rollers", "solve_tapered", "solve_line_contact"), ()),
    "solve_tilting": ("steady.py",),
    "solve_two_disk": ("two_disk.py",),
    "steady_solution": ("solve.py",),
    "with_life": ("solve.py", "steady.py"),  # of a shaft, which rates its bearings itself
    # of a warm-up the losses are asked for alone
    "solve_ring": ("bearing.py", "port.py", "programs.py", "batches.py"),
}
"""Function that gives a solution without life or checked inputs -> the files that may call it."""


def test_one_function_from_scene_to_solution():
    """The families' own solves give no life: nothing but `solve`, `reaction` and shafts may call them."""
    package = Path(jb.__file__).parent
    found = set()
    for folder in (package, package.parent / "fitting"):
        for path in folder.rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if not isinstance(node, ast.Call):
                    continue
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                found.add(name)
                assert path.name in CALLERS.get(name, (path.name,)), f"{path} calls {name}"
    assert {name for name, files in CALLERS.items() if files} <= found


RESULTS = {
    "power_loss": lambda solution: solution.power_loss.total,
    "slip": lambda solution: solution.cage.slip,
    "life": lambda solution: solution.life.L10r,
    "modified_life": lambda solution: solution.life.Lnmr,
    "film": lambda solution: solution.film.central,
    "traction": lambda solution: solution.traction_coefficient.reshape(()),
}
DRY_ROLLER = (
    "reference_roller",
    dict.fromkeys(("contact", "oil", "cage", "flange", "drag"), "none")
    | {"rating.viscosity_ratio": 1.5, "rating.cleanliness": "grease_normal"},
)
DRY_BALL = (
    "deep_groove_6205",
    {"operation.moment": "none", "rating.viscosity_ratio": 1.5, "rating.cleanliness": "grease_normal"},
)
TAPERED = ("tapered_example", {"contact.traction_accuracy": 1e-2})
NO_CAGE = ("turbine_ball", {"cage": "none", "contact.traction_accuracy": 1e-2})
TILTED = ("turbine_roller", {"contact": "none", "operation.misalignment": "1 mrad", "rating.grooves": "scene"})
ONE = {"slide_to_roll": 0.02, "entrainment_speed": "20 m/s", "temperature": "373 K", "pressure": "1.05 GPa"}
POINT = ("two_disk_mobil_jet_ii", {f"operation.{name}": value for name, value in ONE.items()})
FILM = ("satellite_contact_1", {"contact.accuracy": 1e-2})
FAMILIES = [
    # scene, results that it has, inputs with the relative step of their difference
    pytest.param(
        DRY_ROLLER,
        {"life", "modified_life"},
        {"operation.radial_load": 1e-3, "geometry.roller_diameter": 1e-5, "rating.viscosity_ratio": 1e-3},
        id="roller-dry",
    ),
    pytest.param(
        DRY_BALL,
        {"life", "modified_life"},
        {"operation.radial_load": 1e-3, "geometry.ball_diameter": 1e-5, "rating.viscosity_ratio": 1e-3},
        id="ball-dry",
    ),
    pytest.param(POINT, {"traction"}, {"operation.slide_to_roll": 1e-3, "oil.rheology.stress": 1e-3}, id="two-disk"),
    pytest.param(
        TILTED,
        {"life"},
        {"operation.misalignment": 1e-3, "geometry.roller_diameter": 1e-5},
        id="roller-tilted",
        marks=pytest.mark.slow,
    ),
    pytest.param(
        FILM,
        {"film"},
        {"operation.load_per_length": 1e-3, "operation.oil_temperature": 1e-5},
        id="line-contact",
        marks=pytest.mark.slow,
    ),
    pytest.param(
        TAPERED,
        {"power_loss", "life", "modified_life"},
        {"operation.axial_load": 1e-3, "operation.oil_temperature": 1e-5, "geometry.roller_diameter": 1e-5},
        id="tapered",
        marks=pytest.mark.slow,
    ),
    pytest.param(
        NO_CAGE,
        {"power_loss"},
        {"operation.inner_speed": 1e-4, "operation.oil_temperature": 1e-5, "geometry.ball_diameter": 1e-5},
        id="ball-without-cage",
        marks=pytest.mark.slow,
    ),
]


def differences(scene, path, step, results):
    """Slopes of results by the logarithm of an input, of fourth order, by the program of `solve`."""
    start = input_value(scene, path)
    solved = {k: jb.solve(scene.replace({path: start * (1.0 + k * step)})) for k in (-2, -1, 1, 2)}
    for name, value in results.items():
        at = {k: value(one) for k, one in solved.items()}
        yield name, (8.0 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12.0 * step)


@pytest.mark.parametrize(("scene", "results", "inputs"), FAMILIES)
def test_of_every_family(scene, results, inputs):
    scene = jb.load_scene(*scene)
    solution, slopes = jb.sensitivities(scene)
    assert set(slopes.modelled()) == results
    plain = jb.solve(scene)
    for name, found in slopes.modelled().items():
        np.testing.assert_allclose(RESULTS[name](solution), RESULTS[name](plain), rtol=1e-9)
        assert all(np.isfinite(slope) for slope in found.values())
    logs = {name: lambda one, name=name: np.log(float(RESULTS[name](one))) for name in results}
    for path, step in inputs.items():
        for name, difference in differences(scene, path, step, logs):
            found = getattr(slopes, name)[path]
            # as below; what does not depend on the input at all is 0 here and round-off over the step there
            np.testing.assert_allclose(found, difference, rtol=1e-5, atol=1e-7, err_msg=f"{name}, {path}")


def hottest(solution):
    return max(float(getattr(solution.thermal.temperatures, name)) for name in solution.thermal.nodes)


ON_DEMAND = [
    pytest.param(
        lambda: jb.load_scene(*DRY_ROLLER),
        {"stiffness": lambda solution: np.log(float(solution.stiffness[1, 1]))},
        {"geometry.roller_length": 1e-3, "operation.radial_load": 1e-3, "materials.rings.youngs_modulus": 1e-3},
        id="stiffness-roller",
    ),
    pytest.param(
        lambda: jb.load_scene("deep_groove_6205", {"operation.moment": "none"}),
        {
            "stiffness": lambda solution: np.log(float(solution.stiffness[1, 1])),
            "axial_stiffness": lambda solution: np.log(float(solution.stiffness[0, 0])),
        },
        {"operation.radial_load": 1e-3, "geometry.conformity_inner": 1e-5},
        id="stiffness-ball",
        marks=pytest.mark.slow,
    ),
    pytest.param(
        lambda: warm("roller", 1),
        {"temperature": hottest},
        {"operation.inner_speed": 1e-3, "thermal.ambient": 1e-4},
        id="temperature",
        marks=pytest.mark.slow,
    ),
]


@pytest.mark.parametrize(("scene", "results", "inputs"), ON_DEMAND)
def test_results_on_demand(scene, results, inputs):
    """Stiffness and temperature, which are not among the usual results, against differences of `solve`."""
    scene = scene()
    _, slopes = jb.sensitivities(scene, of=results)
    assert set(slopes.modelled()) == set(results)
    for path, step in inputs.items():
        for name, difference in differences(scene, path, step, results):
            found = getattr(slopes, name)[path]
            np.testing.assert_allclose(found, difference, rtol=1e-5, atol=1e-7, err_msg=f"{name}, {path}")


@pytest.mark.usefixtures("made_up")
def test_results_that_are_not_there_are_named():
    with pytest.raises(ValueError, match=r"does not model temperature; expected one of stiffness"):
        jb.sensitivities(dry_roller(), of="temperature")
    with pytest.raises(ValueError, match=r"of must be one of .*'axial_stiffness'"):
        jb.sensitivities(dry_roller(), of=("stiffness", "lives"))
    with pytest.raises(ValueError, match=r"found a TwoDiskSolution; expected a bearing"):
        jb.sensitivities(jb.load_scene("two_disk_etm"), of="life")


@pytest.fixture(scope="module")
def reference():
    """Solution and sensitivities, compiled once."""
    return jb.sensitivities(reference_roller())


@pytest.fixture(scope="module")
def fast():
    """One program for all inputs."""
    return jb.jit_solver(reference_roller())


def input_value(scene, path):
    for name in path.split("."):
        scene = getattr(scene, name)
    return np.asarray(scene)


@pytest.mark.slow
def test_solution_is_that_of_solve(reference):
    solution, slopes = reference
    plain = jb.solve(reference_roller())
    # two programs of the same equations: round-off of a converged solve
    np.testing.assert_allclose(solution.power_loss.total, plain.power_loss.total, rtol=1e-9)
    np.testing.assert_allclose(solution.cage.slip, plain.cage.slip, rtol=1e-9)
    assert set(slopes.power_loss) == set(slopes.slip)
    assert all(np.isfinite(value) for value in [*slopes.power_loss.values(), *slopes.slip.values()])
    # an input that is 0
    assert float(slopes.power_loss["operation.outer_speed"]) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("path", INPUTS)
def test_against_differences_of_solve(reference, fast, path):
    _, slopes = reference
    scene = reference_roller()
    value, step = input_value(scene, path), INPUTS[path]

    def at(k):
        solution = fast(scene.replace({path: value * (1.0 + k * step)}))
        assert bool(solution.converged)
        return np.array([np.log(float(solution.power_loss.total)), float(solution.cage.slip)])

    # fourth order, per unit of ln(input)
    difference = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step)
    found = np.array([float(slopes.power_loss[path]), float(slopes.slip[path])])
    # ln(power) is of order 1 and slip of order 0.1: what hardly depends on the input is compared on that scale
    np.testing.assert_allclose(found, difference, rtol=1e-5, atol=1e-10)


@pytest.mark.slow
def test_no_numbers_where_the_solve_failed():
    scene = reference_roller().replace({"operation.radial_load": 1e200})
    solution, slopes = jb.sensitivities(scene, throw=False)
    assert not bool(solution.converged)
    assert all(np.isnan(value) for value in [*slopes.power_loss.values(), *slopes.slip.values()])
    with pytest.raises(jb.SolveError):
        jb.sensitivities(scene)


@pytest.mark.slow
def test_under_jit_and_vmap(reference):
    scene = reference_roller()
    speeds = jnp.asarray([float(scene.operation.inner_speed), jnp.nan, 900.0])
    at_speed = lambda speed: jb.sensitivities(scene.at_operation(inner_speed=speed), throw=False)
    solutions, slopes = jax.jit(jax.vmap(at_speed))(speeds)
    np.testing.assert_array_equal(solutions.status == int(Status.CONVERGED), [True, False, True])
    for batch, alone in ((slopes.power_loss, reference[1].power_loss), (slopes.slip, reference[1].slip)):
        for path, values in batch.items():
            np.testing.assert_allclose(values[0], alone[path], rtol=1e-7, atol=1e-12)
            np.testing.assert_array_equal(np.isnan(values), [False, True, False])
