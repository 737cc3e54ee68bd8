"""Lanes shared out among the devices of this process."""

from collections.abc import Callable
from typing import Any

import jax
from jax.core import Tracer
from jax.sharding import PartitionSpec

AXIS = "lane"


def shared_out(run: Callable[..., Any]) -> Callable[..., Any]:
    """A function of lanes (a pytree with the lanes in front of every array) and of what all lanes share, of which each
    device runs a part for itself; unchanged where there is one device, or the lanes are no multiple of the devices.

    For the inside of `jax.jit`, where `may_be_shared_out` says so of what is given from outside. On a CPU, two devices
    on two cores go through lanes in step (`vmap`) in half of the time of one, which shares out its small operations
    one by one.
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


def may_be_shared_out(given: Any) -> bool:
    """True if nobody has chosen devices already: by `jax.device_put`, by a mesh, by a default, or by a transformation
    of JAX around the call, of which nothing is known."""
    if getattr(jax.config, "jax_default_device", None) is not None or not jax.sharding.get_abstract_mesh().empty:
        return False
    chosen = lambda leaf: isinstance(leaf, Tracer) or getattr(leaf, "committed", False)
    return not any(chosen(leaf) for leaf in jax.tree.leaves(given))
