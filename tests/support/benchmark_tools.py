"""Tools of the benchmarks: best of several times, errors, batches over all devices, transient runs beside scipy's."""

import functools
import sys
import time
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

from jaxbearing.numerics.devices import shared_out
from jaxbearing.numerics.status import Status

EXPLICIT = ("RK45", "DOP853")
"""Methods of scipy that need no Jacobian."""


def best_time(function, repeats):
    """Shortest wall time of a call, s."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        jax.block_until_ready(function())
        times.append(time.perf_counter() - start)
    return min(times)


def error_of(found, exact):
    """Largest relative error."""
    return float(np.max(np.abs(np.asarray(found) / np.asarray(exact) - 1.0)))


def sharded(run):
    """A function of a batch (pytree with a leading axis) and of what its lanes share, compiled; the batch is split over
    all devices where it can be."""
    return jax.jit(shared_out(run))


def time_at(error, points):
    """Time at which a method is as exact as asked, from (error, time) pairs; interpolated between its tolerances, in
    logarithms; None where it never is."""
    good = sorted((e, t) for e, t in points if e <= error)
    worse = sorted((e, t) for e, t in points if e > error)
    if not good:
        return None
    best = min(t for _, t in good)
    if worse:
        (e1, t1), (e2, t2) = good[-1], worse[0]
        share = np.log(error / e1) / np.log(e2 / e1)
        best = min(best, float(np.exp((1.0 - share) * np.log(t1) + share * np.log(t2))))
    return best


def fastest(error, rivals):
    """Shortest time at which any method is as exact as asked; `None` where none is. **Arguments:** `rivals`: lists of
    (error, time) pairs by method."""
    times = [time_at(error, points) for points in rivals.values()]
    return min((t for t in times if t is not None), default=None)


def times_as_fast(error, seconds, rivals):
    """Time of the fastest rival that is at least as exact, over ours; `None` where none is."""
    best = fastest(error, rivals)
    return None if best is None else best / seconds


def said(row):
    """The row, shown at once, for benchmarks that take minutes."""
    print(*(f"{value:.3g}" if isinstance(value, float) else value for value in row), file=sys.stderr, flush=True)
    return row


def scipy_run(functions, y0, times, method, tolerance, first_step=None):
    """A run by scipy: states as rows at the times (`None` where it failed), calls of the field, wall time, s.

    **Arguments:**
    - `functions`: compiled vector field and its Jacobian, both of time, state and tolerance.
    - `first_step`: s; `None`: scipy guesses it.
    """
    field, jacobian = functions
    count = [0]

    def f(t, y):
        count[0] += 1
        return np.asarray(field(np.float64(t), y, tolerance))

    more: Any = {} if method in EXPLICIT else {"jac": lambda t, y: np.asarray(jacobian(np.float64(t), y, tolerance))}
    begin = time.perf_counter()
    found = solve_ivp(
        f, (0.0, times[-1]), y0, method, t_eval=times, rtol=tolerance, atol=tolerance, first_step=first_step, **more
    )
    seconds = time.perf_counter() - begin
    return (found.y.T if found.success else None), count[0], seconds


@functools.cache
def _batch_program(run, static):
    return sharded(
        jax.vmap(lambda given, numbers, times: run(eqx.combine(numbers, static), *given, times), (0, None, None))
    )


def batches_of(run, start, values, times, tolerances):
    """By tolerance: seconds a run of a batch, and the lanes that failed; one program.

    **Arguments:**
    - `run`: pure function of start, one of `values`, tolerance and times, with a status in its result.
    - `start`: what all lanes begin from.
    - `values`: array with the lanes in front.
    """
    numbers, static = eqx.partition(start, eqx.is_array)
    given = lambda tolerance: (values, jnp.full(len(values), tolerance))
    program = _batch_program(run, static).lower(given(tolerances[0]), numbers, times).compile()
    for tolerance in tolerances:
        begin = time.perf_counter()
        found = jax.block_until_ready(program(given(tolerance), numbers, times))
        seconds = time.perf_counter() - begin
        yield tolerance, seconds / len(values), int(np.sum(np.asarray(found.status) != Status.CONVERGED))
