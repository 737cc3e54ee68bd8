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
