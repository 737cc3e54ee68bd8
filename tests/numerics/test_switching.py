"""The solver that chooses by stiffness: right motion, the right method, both ways."""

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx
import pytest
from scipy.special import erf

from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.kept_jacobian import KeptJacobian
from jaxbearing.numerics.switching import Switching

START = ArrowPoint(jnp.full((1, 3), 0.5), jnp.zeros(1))
TIMES = (0.25, 0.5, 1.0)
SPREAD = jnp.asarray([1.0, 3.0, 10.0])


def rates(time, state, stiffness, level, found):
    """Elements follow a sine, with rates of 1 to 10 times the stiffness; beside it the integral of their squares."""
    (x,), target = state.elements, jnp.sin(30.0 * time)
    pull = -stiffness(time, level) * SPREAD * (x - target) + 30.0 * jnp.cos(30.0 * time)
    return ArrowPoint(pull[None], jnp.sum(x * x)[None]), found


def run(stiffness, level=1e5, tolerance=1e-6):
    within = lambda t, y, a, f: rates(t, y, stiffness, a, f)
    kept = KeptJacobian(dfx.Kvaerno5(), within, lambda t, y, a: (), tolerance, 1)
    return dfx.diffeqsolve(
        dfx.ODETerm(lambda t, y, a: within(t, y, a, ())[0]),
        Switching(kept),
        0.0,
        1.0,
        1e-5,
        START,
        jnp.asarray(level),
        saveat=dfx.SaveAt(ts=jnp.asarray(TIMES), solver_state=True),
        stepsize_controller=dfx.PIDController(
            rtol=tolerance, atol=tolerance, pcoeff=0.3, icoeff=0.4, norm=optx.rms_norm
        ),
        max_steps=200_000,
    )


STIFFNESS = {
    "easy": lambda t, level: 5.0 + 0.0 * t,
    "stiff": lambda t, level: level + 0.0 * t,
    "both ways": lambda t, level: 5.0 + level * jnp.exp(-((t - 0.5) ** 2) / 0.01),
}
SUMS = {
    "easy": lambda t: 5.0 * t,
    "stiff": lambda t: 1e5 * t,
    "both ways": lambda t: 5.0 * t + 5e3 * np.sqrt(np.pi) * (erf(10.0 * (t - 0.5)) + erf(5.0)),
}
"""Integrals of the stiffness from 0 to t."""


def exact(name, times):
    """The elements, whose distance from the sine decays."""
    times = np.asarray(times)[..., None]
    return np.sin(30.0 * times) + 0.5 * np.exp(-np.asarray(SPREAD) * SUMS[name](times))


@pytest.mark.parametrize("name", ["easy", "stiff", "both ways"])
def test_motion(name):
    found = jax.jit(lambda: run(STIFFNESS[name]))()
    elements = np.asarray(found.ys.elements)[:, 0]
    # between the steps of kvaerno5 Hermite's cubic is less exact than the step
    np.testing.assert_allclose(elements[:-1], exact(name, TIMES[:-1]), atol=1e-4)
    np.testing.assert_allclose(elements[-1], exact(name, TIMES[-1]), atol=2e-5)
    fine = np.concatenate([np.geomspace(1e-9, 1e-3, 4001), np.linspace(1e-3, 1.0, 20001)[1:]])
    work = np.trapezoid(np.sum(exact(name, fine) ** 2, axis=-1), fine)
    np.testing.assert_allclose(found.ys.globals[-1, 0], work, atol=2e-5)
    choice, steps = found.solver_state, int(found.stats["num_accepted_steps"])
    if name == "easy":
        assert int(choice.explicit) == steps
        assert int(choice.switches) == 0
    else:
        assert int(choice.switches) >= (1 if name == "stiff" else 2)
        # stability would hold tsit5 to a step of 3.3e-6 s where it is stiff
        assert steps < 0.02 * 1.0 / (3.3 / 1e6)
        assert 0 < int(choice.explicit) < steps
    if name == "stiff":
        assert bool(choice.stiff)
    if name == "both ways":
        assert not bool(choice.stiff)


def test_batch_chooses_lane_by_lane():
    lanes = jax.jit(jax.vmap(lambda level: run(STIFFNESS["stiff"], level)))(jnp.asarray([5.0, 1e5]))
    assert [bool(flag) for flag in lanes.solver_state.stiff] == [False, True]
    alone = jax.jit(lambda: run(STIFFNESS["stiff"]))()
    np.testing.assert_allclose(lanes.ys.elements[1], alone.ys.elements, atol=2e-5)
