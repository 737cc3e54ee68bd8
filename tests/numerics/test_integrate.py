"""Solvers by name on a small system with a known solution: order, status, works that nothing depends on."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.integrate import integrate_segment
from jaxbearing.numerics.integrator import IntegratorOptions, NestedField
from jaxbearing.numerics.status import Status

RATES = jnp.asarray([1.0, 30.0, 1000.0])
ZERO = jnp.zeros(())


def decay(time, state, args):
    """Decaying elements drive a global, whose square is integrated beside."""
    driven, _ = state.globals
    return ArrowPoint(-RATES[None, :] * state.elements, jnp.stack([state.elements[0, 0] - driven, driven * driven]))


START = ArrowPoint(jnp.ones((1, 3)), jnp.zeros(2))


def exact(t):
    """driven = t e^-t; its square integrates to (1 - e^-2t (1 + 2t + 2t^2))/4."""
    return np.exp(-np.asarray(RATES) * t), t * np.exp(-t), 0.25 * (1.0 - np.exp(-2.0 * t) * (1.0 + 2.0 * t * (1.0 + t)))


def run(field, options):
    """The status word, and the end of the known solution to 200 tolerances."""
    times = jnp.asarray([0.5, 1.0])
    found = jax.jit(lambda y: integrate_segment(field, y, ZERO, times, None, options, idle=1))(START)
    assert int(found.status) == Status.CONVERGED
    elements, driven, square = exact(1.0)
    atol = 200.0 * float(options.tolerance)
    np.testing.assert_allclose(found.last.elements[0], elements, atol=atol)
    np.testing.assert_allclose(found.last.globals, [driven, square], atol=atol)
    assert found.states.elements.shape == (2, 1, 3)
    np.testing.assert_allclose(found.states.globals[0], exact(0.5)[1:], atol=atol)


@pytest.mark.parametrize(
    ("solver", "elimination"),
    [
        ("kvaerno4", "arrow"),
        ("implicit_euler", "arrow"),
        ("kvaerno3", "dense"),
        ("auto", "dense"),
    ],
)
def test_known_solution(solver, elimination):
    """With a kept Jacobian, with diffrax's own iterations; tsit5: next test; what is in `NESTED` is not repeated."""
    # implicit Euler is of first order
    tolerance = 1e-4 if solver == "implicit_euler" else 1e-7
    run(decay, IntegratorOptions(solver=solver, tolerance=tolerance, elimination=elimination))


def test_last_good_state_is_kept():
    """A solution that ends at t = 1, steps that run out: what was reached, and the word for it. And round-off leaves
    1e-16 s, less than the shortest step, between a first step and the end of a run, which is complete."""

    @jax.jit
    def powers(factor, tolerance, times, first_step):
        blow_up = lambda t, y, args: jax.tree.map(lambda leaf: args * jnp.square(leaf), y)
        options = IntegratorOptions(tolerance=tolerance, max_steps=400)
        return integrate_segment(blow_up, START, ZERO, times, factor, options, first_step)

    found = powers(1.0, 1e-6, jnp.asarray([0.5, 2.0]), jnp.asarray(1e-3))
    assert int(found.status) in (Status.DIVERGED, Status.NOT_CONVERGED)
    assert 0.9 < found.last_time < 1.0 + 1e-3
    np.testing.assert_allclose(found.states.elements[0], 2.0, rtol=1e-4)
    assert np.all(np.isfinite(found.last.elements))
    short = powers(1.0, 1e-15, jnp.asarray([0.5, 2.0]), jnp.asarray(1e-3))
    assert int(short.status) == Status.NOT_CONVERGED
    assert short.last_time < 0.9
    np.testing.assert_allclose(short.last.elements, 1.0 / (1.0 - short.last_time), rtol=1e-4)
    first = jnp.asarray(1e-3 - 1e-16)
    assert 0.0 < 1e-3 - float(first) < IntegratorOptions().shortest_step
    still = powers(0.0, 1e-5, jnp.asarray([5e-4, 1e-3]), first)
    assert int(still.accepted) == 2
    assert int(still.status) == Status.CONVERGED
    assert float(still.last_time) == 1e-3
    np.testing.assert_array_equal(still.states.elements[-1], START.elements)


def test_unknown_names_are_refused():
    with pytest.raises(ValueError, match="kvaerno5"):
        IntegratorOptions(solver="euler")
    with pytest.raises(ValueError, match="arrow"):
        IntegratorOptions(elimination="sparse")


def steps_recorded(guesses):
    """`decay` whose global is driven through a solve, z^3 = element 0, with what it is asked to begin with."""

    def rates(time, state, args, guess, tolerance):
        z = jnp.cbrt(state.elements[0, 0])
        jax.debug.callback(lambda *given: guesses.append(tuple(float(g) for g in given)), time, guess.globals[0], z)
        plain = decay(time, state, args)
        driven = z**3 - state.globals[0]
        return plain._replace(globals=plain.globals.at[0].set(driven)), ArrowPoint(jnp.zeros((1, 0)), z[None])

    return NestedField(rates, lambda time, state, args: ArrowPoint(jnp.zeros((1, 0)), jnp.asarray([0.5])))


NESTED = ("tsit5", "dopri8", "kvaerno3", "kvaerno5", "auto")


@pytest.mark.parametrize("solver", NESTED)
def test_a_solve_inside_begins_where_the_last_one_ended(solver):
    """Same motion. Explicit solvers extrapolate what was found, to third order in the step."""
    guesses = []
    run(steps_recorded(guesses), IntegratorOptions(solver=solver, tolerance=1e-7))
    jax.effects_barrier()
    if solver == "kvaerno3":
        assert all(guess == 0.5 for _, guess, _ in guesses)
    else:
        time, guess, z = np.asarray(guesses).T
        late = time > 0.2
        # implicit solvers begin with what the last iteration found, without extrapolation
        assert np.max(np.abs(guess[late] - z[late])) < (5e-7 if solver in ("tsit5", "dopri8") else 0.1)
        assert np.max(np.abs(guess - 0.5)) > 0.1
