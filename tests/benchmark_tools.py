"""What the benchmarks share: the best of several times, errors, batches over all devices."""

import time

import jax
import numpy as np
from jax.sharding import PartitionSpec


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
    devices = len(jax.devices())

    def split(batch, *shared):
        if devices == 1 or len(jax.tree.leaves(batch)[0]) % devices:
            return run(batch, *shared)
        mesh = jax.make_mesh((devices,), ("case",), axis_types=(jax.sharding.AxisType.Auto,))
        spec = PartitionSpec("case")
        given = spec, *[PartitionSpec()] * len(shared)
        return jax.shard_map(run, mesh=mesh, in_specs=given, out_specs=spec, check_vma=False)(batch, *shared)

    return jax.jit(split)
