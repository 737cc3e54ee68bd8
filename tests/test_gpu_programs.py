"""What is compiled for a GPU can be looked at without one: every operation has a CUDA form, all in float64, and nothing
calls back to the host."""

import re

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from fit_results import MEDIAN

import jaxbearing as jb
from fitting import Measurements, read_curves
from fitting.estimation import estimates
from fitting.options import FitOptions
from fitting.search import Search
from jaxbearing.scenes.data_files import builtin_names

LIBRARIES = {
    *("cu_lu_pivots_to_permutation", "cusolver_getrf_ffi"),
    *("cusolver_geqrf_ffi", "cusolver_ormqr_ffi", "cusolver_syevd_ffi"),
}
"""What is taken from CUDA's libraries: LU factors, in fits QR, eigenvalues of a free ring's stiffness."""


def program(function, arguments):
    """The program of a function of arrays, as XLA gets it for a GPU."""
    arrays, static = eqx.partition(arguments, eqx.is_array_like)
    traced = lambda arrays: eqx.filter(function(*eqx.combine(arrays, static)), eqx.is_array)
    return jax.jit(traced).trace(arrays).lower(lowering_platforms=("cuda",)).as_text()


def check(text):
    called = set(re.findall(r"custom_call @([\w$.]+)", text))
    assert not [name for name in called if "callback" in name], called
    assert called <= LIBRARIES, called
    assert re.search(r"tensor<[x0-9]*f64>", text)
    # a narrow float would be a number that lost its digits
    assert not re.search(r"tensor<[x0-9]*(f32|f16|bf16)>", text)


def test_what_the_check_sees():
    check(program(jnp.linalg.solve, (jnp.eye(3), jnp.ones(3))))
    with pytest.raises(AssertionError):
        check(program(lambda x: jnp.sin(x.astype(jnp.float32)), (jnp.ones(3),)))
    with pytest.raises(AssertionError):
        check(program(jnp.linalg.eigvals, (jnp.eye(3),)))
    # there is no such program without the machine
    with pytest.raises(ValueError, match="lowering platform"):
        program(lambda x: jax.pure_callback(np.sin, x, x), (jnp.ones(3),))


QUICK = ("reference_roller", "satellite_contact_1", "two_disk_etm")
"""Of each kind of equations the smallest program."""


@pytest.mark.parametrize(
    "name",
    [
        name if name in QUICK else pytest.param(name, marks=pytest.mark.slow)
        for name in builtin_names()
        if name != "satellite_contact_2"  # the program of the first
    ],
)
def test_steady_states(name):
    check(program(lambda scene: jb.solve(scene, throw=False), (jb.load_scene(name),)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["turbine_roller", "turbine_ball"])
def test_batches_and_gradients(name):
    scene = jb.load_scene(name)

    def total(speed):
        return jb.solve(scene.at_operation(inner_speed=speed), throw=False).power_loss.total

    check(program(jax.vmap(jax.value_and_grad(total)), (jnp.linspace(800.0, 1000.0, 3),)))


def only_errors(function, arguments):
    """The host is asked for one thing only: to raise the error of a check of optimistix' or diffrax' own."""
    arrays, static = eqx.partition(arguments, eqx.is_array_like)
    traced = lambda arrays: eqx.filter(function(*eqx.combine(arrays, static)), eqx.is_array)
    text = str(jax.make_jaxpr(traced)(arrays))
    assert set(re.findall(r"callback_func=<function (\w+)", text)) <= {"_error"}
    assert not re.search(r":(f32|f16|bf16)\[", text)


@pytest.mark.slow
def test_runs_in_time():
    scene = jb.load_scene("turbine_roller_dynamic")
    run = lambda speeds: jb.simulate_batch(scene, 1e-4, {"operation.inner_speed": speeds})
    only_errors(run, (jnp.full(2, 1000.0),))


@pytest.mark.slow
def test_fits():
    scene = jb.load_scene("two_disk_etm")
    search = Search(Measurements.of(read_curves(MEDIAN), scene), scene, FitOptions())
    problem = search.problem(search.free_by_rule()[0], {})
    fit = lambda method: lambda problem, starts: estimates(problem, starts, method)
    check(program(fit("levenberg_marquardt"), (problem, jnp.zeros((2, 6)))))
    for method in ("bfgs", "gradient_descent"):
        only_errors(fit(method), (problem, jnp.zeros((2, 6))))
