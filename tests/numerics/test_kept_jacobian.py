"""Implicit methods that keep their Jacobian: right motion, few Jacobians and inverses, order, derivatives."""

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx
import pytest

from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.kept_jacobian import KeptJacobian
from jaxbearing.numerics.stage_predictors import predictor_nodes, stage_predictors

STIFF = jnp.logspace(2.0, 5.0, 6)
START = ArrowPoint(0.1 * jnp.ones((2, 6)), jnp.zeros(2))
METHODS = {"kvaerno3": dfx.Kvaerno3, "kvaerno4": dfx.Kvaerno4, "kvaerno5": dfx.Kvaerno5}


def rates(time, state, args, found):
    """Oscillators with traction of 1e2 to 1e5 1/s, driven through one global; beside it the work of the traction."""
    (x, v), (driven, _) = state.elements, state.globals
    drive = args * jnp.sin(40.0 * time)
    slip = v - jnp.tanh(driven + drive)
    pull = ArrowPoint(
        jnp.stack([v, -STIFF * slip - 1e3 * x - 20.0 * x**3]),
        jnp.stack([jnp.mean(v) - 5.0 * driven + drive, jnp.sum(v * v)]),
    )
    return pull, found


def run(name, tolerance, drive=1.0, end=0.5, dense=False):
    if name in METHODS:
        method = KeptJacobian(METHODS[name](), rates, lambda t, y, a: (), tolerance, idle=1, dense=dense)
    else:
        method = {"dopri8": dfx.Dopri8, "tsit5": dfx.Tsit5}[name]()
    return dfx.diffeqsolve(
        dfx.ODETerm(lambda t, y, a: rates(t, y, a, ())[0]),
        method,
        0.0,
        end,
        1e-5,
        START,
        jnp.asarray(drive),
        saveat=dfx.SaveAt(t1=True, solver_state=isinstance(method, KeptJacobian)),
        stepsize_controller=dfx.PIDController(
            rtol=tolerance, atol=tolerance, pcoeff=0.3, icoeff=0.4, norm=optx.rms_norm
        ),
        max_steps=100_000,
        adjoint=dfx.ForwardMode(),
    )


program = jax.jit(run, static_argnums=0, static_argnames="dense")
"""One for each method: tolerance, drive and end are numbers."""


def motion(name, tolerance, drive=1.0, end=0.5, dense=False):
    return program(name, *(jnp.asarray(number) for number in (tolerance, drive, end)), dense=dense)


def end_of(found):
    return np.concatenate([np.ravel(found.ys.elements[-1]), found.ys.globals[-1]])


@pytest.mark.parametrize(("name", "dense"), [*((name, False) for name in METHODS), ("kvaerno5", True)])
def test_motion_and_counts(name, dense):
    """As exact as its tolerance, with a Jacobian for several steps and at most three evaluations in a stage."""
    found, exact = motion(name, 1e-6, dense=dense), end_of(motion("dopri8", 1e-11))
    np.testing.assert_allclose(end_of(found), exact, atol=2e-5)
    steps, counts = int(found.stats["num_accepted_steps"]), found.solver_state.counts
    assert int(counts.jacobians) < 0.5 * steps
    assert int(counts.inverses) < steps
    stages = len(METHODS[name].tableau.b_sol) - 1
    assert int(counts.evaluations) < 3 * stages * steps


def test_stiff_run_takes_fewer_evaluations_than_an_explicit_one():
    found, explicit = motion("kvaerno5", 1e-6), motion("tsit5", 1e-6)
    assert 5 * int(found.solver_state.counts.evaluations) < 6 * int(explicit.stats["num_steps"])


def test_error_falls_with_the_order():
    """Steps over the range of tolerances: the error falls with at least 0.8 of the order, 4 of the estimate."""
    errors, steps = [], []
    exact = end_of(motion("dopri8", 1e-12, end=0.05))
    for tolerance in (1e-4, 1e-5, 1e-6, 1e-7):
        found = motion("kvaerno5", tolerance, end=0.05)
        errors.append(np.abs(end_of(found) - exact).max())
        steps.append(int(found.stats["num_accepted_steps"]))
    assert -np.polyfit(np.log(steps), np.log(errors), 1)[0] > 3.2


def test_forward_mode_is_that_of_the_motion():
    def last(drive):
        states = run("kvaerno5", jnp.asarray(1e-8), drive).ys
        assert states is not None
        return states.globals[-1, 0]

    value, slope = jax.jit(lambda d: jax.jvp(last, (d,), (jnp.ones(()),)))(jnp.asarray(1.0))
    low, high = (motion("kvaerno5", 1e-8, drive).ys.globals[-1, 0] for drive in (0.99, 1.01))
    np.testing.assert_allclose(slope, (high - low) / 0.02, rtol=1e-4)
    assert np.isfinite(value)


def test_nodes_of_the_predictor():
    """Stages at the same place predict each other alone; the others from this step first."""
    places = np.array([0.0, 0.52, 1.23, 0.9, 0.44, 1.0, 1.0])
    assert predictor_nodes(places, 6) == [5]
    assert predictor_nodes(places, 1) == [0, ~3, ~1, ~4]
    assert predictor_nodes(places, 5) == [4, 3, 2, 1]


@pytest.mark.parametrize("name", METHODS)
def test_predictor_is_exact_for_polynomials_of_its_nodes(name):
    """Rates linear in time are predicted, from step to step of other lengths and within the first one."""
    tableau = METHODS[name].tableau
    places = np.concatenate([[0.0], tableau.c])
    for length, before in ((1.0, 0.7), (1.0, 1.3)):
        rates = np.concatenate([(places - 1.0) * before, places * length])
        weights = stage_predictors(tableau, jnp.asarray(length), jnp.asarray(before))[1:]
        np.testing.assert_allclose(weights @ rates, places[1:] * length, atol=1e-12)
        np.testing.assert_allclose(jnp.sum(weights, axis=1), 1.0, rtol=1e-12)
    for before in (0.0, 0.3):
        plain = stage_predictors(tableau, jnp.ones(()), jnp.asarray(before))
        assert np.all(np.isfinite(plain))
        np.testing.assert_array_equal(plain[:, : len(places)], 0.0)
