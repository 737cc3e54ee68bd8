"""Derivatives through the solve: against central differences, both modes, finite at the hard cases."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import HARD_CASES, RPM, changed, reference_roller, turbine_roller

import jaxbearing as jb

# compiling derivatives takes most of the time: one closure with the fast tests, the other with the slow ones
BOTH = [
    pytest.param(reference_roller, id="reference"),
    pytest.param(turbine_roller, id="turbine", marks=pytest.mark.slow),
]

# input: (value, relative step of the central difference); the step balances its own truncation and rounding error
INPUTS = {
    "operation.inner_speed": (10500 * RPM, 1e-5),
    "operation.radial_load": (25e3, 1e-5),
    "operation.oil_temperature": (373.15, 1e-6),
    "operation.oil_flow": (150e-3 / 3600, 1e-4),
    "geometry.diametral_clearance": (30e-6, 1e-4),
    "geometry.roller_diameter": (12e-3, 1e-6),
    "cage.guiding_clearance": (480e-6, 1e-5),
    "drag.coefficient": (0.6, 1e-4),
    "oil.rheology.shear_modulus": (4.82e4, 1e-4),
    "materials.rings.youngs_modulus": (210e9, 1e-5),
    "flange.axial_clearance": (30e-6, 1e-4),
}


def outputs(solution):
    return jnp.stack([solution.power_loss.total, solution.cage.slip, jnp.max(solution.elements.load_inner)])


def function_of_inputs(scene):
    def function(values):
        found = outputs(jb.solve(scene.replace(dict(zip(INPUTS, values, strict=True))), throw=False))
        return found, found

    return function


@pytest.mark.slow
@pytest.mark.parametrize("scene", BOTH)
def test_gradients_against_central_differences(scene):
    both = jax.jit(jax.jacfwd(function_of_inputs(scene()), has_aux=True))
    function = lambda values: both(values)[1]
    values = jnp.asarray([value for value, _ in INPUTS.values()])
    forward = np.asarray(both(values)[0])
    scale = np.abs(np.asarray(function(values)))[:, None] / np.asarray(values)[None, :]
    if scene is reference_roller:  # one structure is enough: the rule of the solve is the same, and compiling is slow
        reverse = np.asarray(jax.jit(jax.jacrev(function_of_inputs(scene()), has_aux=True))(values)[0])
        # modes agree to rounding of quantities of the scale output / input
        assert np.all(np.abs(forward - reverse) <= 1e-10 * np.abs(forward) + 1e-12 * scale)
    for i, (name, (value, relative)) in enumerate(INPUTS.items()):
        step = value * relative
        difference = central_difference(function, values, i, step)
        error = np.abs(forward[:, i] - difference) / np.abs(difference)
        # an output that hardly depends on an input: what counts is the error against its natural scale
        error = np.minimum(error, 1e2 * np.abs(forward[:, i] - difference) / scale[:, i])
        assert np.all(error <= 1e-6), (name, error, forward[:, i], difference, scale[:, i])


def central_difference(function, values, index, step):
    """Fourth order: the truncation error falls below the rounding error at comfortable steps."""
    at = lambda k: np.asarray(function(values.at[index].add(k * step)))
    return (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step)


@pytest.fixture(scope="module", params=BOTH)
def reverse_gradient(request):
    def total(scene):
        solution = jb.solve(scene, throw=False)
        return solution.power_loss.total + solution.cage.slip + jnp.sum(solution.elements.film_inner)

    scene = request.param()
    return scene, jax.jit(jax.grad(lambda floats: total(rebuild(scene, floats))))


def floats_of(scene):
    return [jnp.asarray(leaf, dtype=float) for leaf in jax.tree.leaves(scene)]


def rebuild(scene, floats):
    return jax.tree.unflatten(jax.tree.structure(scene), floats)


@pytest.mark.slow
@pytest.mark.parametrize("case", HARD_CASES.values(), ids=HARD_CASES.keys())
def test_gradient_of_every_number_is_finite_at_hard_cases(reverse_gradient, case):
    scene, gradient = reverse_gradient
    for value in gradient(floats_of(changed(scene, case))):
        assert np.isfinite(value)


@pytest.mark.slow
def test_python_of_the_manual():
    """Two of the calls that the interface promises, as a user types them; the third, the gradient, is README's."""
    scene = jb.load_scene("turbine_roller")
    fast = jb.jit_solver(scene)
    speeds = jnp.asarray([900.0, 1100.0])
    batch = jax.vmap(lambda n: jb.solve(scene.at_operation(inner_speed=n), throw=False))(speeds)
    np.testing.assert_allclose(batch.power_loss.total[1], fast(inner_speed=1100.0).power_loss.total, rtol=1e-10)
