"""What the benchmarks share: the best of several times, errors, batches over all devices."""

import time

import jax
import numpy as np

from jaxbearing.numerics.devices import shared_out


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
