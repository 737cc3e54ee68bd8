"""Sensitivities of power loss and slip: against differences of `solve`, failed lanes, `jit` and `vmap`."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import dry_roller, reference_roller

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


def test_scenes_without_power_loss_are_refused():
    with pytest.raises(ValueError, match=r"scene with power loss: one with contact\.traction and a cage"):
        jb.sensitivities(dry_roller())


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
    return float(scene)


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
