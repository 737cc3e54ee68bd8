"""Lanes shared out among the devices of this process."""

from collections.abc import Callable
from typing import Any

import jax
from jax.sharding import PartitionSpec

AXIS = "lane"


def shared_out(run: Callable[..., Any]) -> Callable[..., Any]:
    """A function of lanes (a pytree with the lanes in front of every array) and of what all lanes share, of which each
    device runs a part for itself; unchanged where there is one device, or the lanes are no multiple of the devices.

    For the inside of `jax.jit`. On a CPU, two devices on two cores go through lanes in step (`vmap`) in half of the
    time of one device, which shares out its small operations one by one.
    """

    def split(lanes: Any, *shared: Any) -> Any:
        devices = jax.local_devices()
        if len(devices) == 1 or jax.tree.leaves(lanes)[0].shape[0] % len(devices):
            return run(lanes, *shared)
        mesh = jax.make_mesh((len(devices),), (AXIS,), axis_types=(jax.sharding.AxisType.Auto,), devices=devices)
        given = PartitionSpec(AXIS), *[PartitionSpec()] * len(shared)
        part = jax.shard_map(run, mesh=mesh, in_specs=given, out_specs=PartitionSpec(AXIS), check_vma=False)
        return part(lanes, *shared)

    return split
