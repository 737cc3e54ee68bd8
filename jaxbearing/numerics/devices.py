"""Distribution of the lanes of a batch over the devices of this process."""

from collections.abc import Callable
from typing import TypeVar

import jax
from jax.core import Tracer
from jax.sharding import PartitionSpec

AXIS = "lane"
Result = TypeVar("Result")


def shared_out(run: Callable[..., Result]) -> Callable[..., Result]:
    """The function, run by each device for its part of the lanes.

    It is used inside of `jax.jit`, if `may_be_shared_out` is True for the arguments of the outermost call. On a CPU,
    two devices on two cores take half of the time of one device for lanes in step (`vmap`), because one device
    distributes each small operation by itself.

    **Arguments:** `run`: function of a pytree with the lanes in front of every array, and of values that all lanes
    share.

    **Returns:** the same function; it is not distributed if there is one device, or if the number of lanes is no
    multiple of the number of devices.
    """

    def split(lanes: object, *shared: object) -> Result:
        devices = jax.local_devices()
        if len(devices) == 1 or jax.tree.leaves(lanes)[0].shape[0] % len(devices):
            return run(lanes, *shared)
        mesh = jax.make_mesh((len(devices),), (AXIS,), axis_types=(jax.sharding.AxisType.Auto,), devices=devices)
        specs = PartitionSpec(AXIS), *[PartitionSpec()] * len(shared)
        part = jax.shard_map(run, mesh=mesh, in_specs=specs, out_specs=PartitionSpec(AXIS), check_vma=False)
        return part(lanes, *shared)

    return split


def may_be_shared_out(arguments: object) -> bool:
    """True if nothing has chosen devices yet: not `jax.device_put`, a mesh, a default device, or a transformation of
    JAX around the call (whose devices are unknown)."""
    if getattr(jax.config, "jax_default_device", None) is not None or not jax.sharding.get_abstract_mesh().empty:
        return False
    chosen = lambda leaf: isinstance(leaf, Tracer) or getattr(leaf, "committed", False)
    return not any(chosen(leaf) for leaf in jax.tree.leaves(arguments))
