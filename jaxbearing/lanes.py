"""Many scenes of one structure solved by one compiled program, whatever their number and that of the devices.

The program solves a fixed number of lanes on one device; more lanes are more calls of it, on whichever device is free.
So a lane's numbers do not depend on how many others there are, where among them it stands, or how many devices share
the work. `jax.shard_map` would be another program for another number of devices: measured, loads of a dry bearing
then differ in the last bits between one device and two.
"""

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from queue import SimpleQueue
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool

from ._scene import AbstractScene
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.status import Status
from .solve import solve, steady_function

Method = Literal["map", "vmap"]
"""How a device goes through its lanes: one after the other, or all in step, each waiting for the slowest."""


_COMPILING = threading.Semaphore(2)
"""XLA compiles once for each device and takes up to 1 GB for it; those that are compiled already solve meanwhile."""


def default_method() -> Method:
    """On a CPU one by one, 4 to 9 times faster than in step; on a GPU the answer reverses."""
    return "map" if jax.default_backend() == "cpu" else "vmap"


class LaneProgram:
    """Solves lanes of scenes: `program(inputs, active)` gives their solutions as numpy arrays with the lanes in front.

    **Arguments:**
    - `make`: from the base and a lane's inputs to its scene.
    - `base`: numbers that all lanes share: a pytree.
    - `example`: the inputs of one lane, a pytree of float64 numbers and arrays.
    - `lanes`: that each device solves in one call.
    - `devices`: how many of the local ones share the work; all if not given.
    """

    def __init__(
        self,
        make: Callable[[Any, Any], AbstractScene],
        base: Any,
        example: Any,
        *,
        method: Method = "map",
        lanes: int,
        devices: int | None = None,
        options: NewtonOptions | None = None,
    ):
        require_x64()
        self.base = jax.tree.map(as_float, base)
        self.lanes = lanes
        self.devices = jax.local_devices()[:devices]

        def one(shared: Any, inputs: Any) -> Any:
            return solve(make(shared, inputs), throw=False, options=options)

        example = jax.tree.map(as_float, example)
        steady_function(make(self.base, example))
        self.structure = jax.eval_shape(one, self.base, example)
        """The solution of one lane, with shapes for arrays."""
        empty = _without_result(self.structure)

        def lane(shared: Any, active: Array, inputs: Any) -> Any:
            return jax.lax.cond(active, lambda: one(shared, inputs), lambda: empty)

        def device(shared: Any, active: Bool[Array, " lane"], inputs: Any) -> Any:
            if method == "map":
                return jax.lax.map(lambda given: lane(shared, given[0], given[1]), (active, inputs))
            return jax.vmap(lane, in_axes=(None, 0, 0))(shared, active, inputs)

        self._program = jax.jit(device)
        self._compiled: dict[Any, Any] = {}
        self._tracing = threading.Lock()

    def __call__(self, inputs: Any, active: np.ndarray, progress: Callable[[int], None] = lambda lanes: None) -> Any:
        """Solutions of as many lanes as there are.

        **Arguments:**
        - `inputs`: those of each lane, lanes in front of every array.
        - `active`: which lanes are solved, shape (lane,); the others are `invalid_input`, and their results NaN.
        - `progress`: called with the number of lanes that were finished.
        """
        count, done = len(active), []
        free: SimpleQueue[Any] = SimpleQueue()
        for one in self.devices:
            free.put(one)

        def solved(start: int) -> Any:
            chosen = free.get()
            try:
                return self._block(chosen, inputs, active, start)
            finally:
                free.put(chosen)

        # compiled programs run outside Python's lock
        with ThreadPoolExecutor(len(self.devices)) as threads:
            for block in threads.map(solved, range(0, count, self.lanes)):
                progress(len(block.status))
                done.append(block)
        return jax.tree.map(lambda *parts: np.concatenate(parts), *done)

    def _block(self, device: Any, inputs: Any, active: np.ndarray, start: int) -> Any:
        """Lanes of one call; the last block is filled up with lanes that are not solved."""

        def part(values: Any) -> np.ndarray:
            values = np.asarray(values)[start : start + self.lanes]
            return np.concatenate([values, np.repeat(values[-1:], self.lanes - len(values), axis=0)])

        wanted = np.zeros(self.lanes, dtype=bool)
        count = min(self.lanes, len(active) - start)
        wanted[:count] = active[start : start + count]
        given = jax.device_put((self.base, wanted, jax.tree.map(part, inputs)), device)
        if device not in self._compiled:
            with self._tracing:
                lowered = self._program.lower(*given)
            with _COMPILING:
                self._compiled[device] = lowered.compile()
        return jax.tree.map(lambda leaf: np.asarray(leaf)[:count], self._compiled[device](*given))


def _without_result(structure: Any) -> Any:
    """The solution of a lane that is not solved, because its scene was refused."""

    def nothing(leaf: Any) -> Array:
        return jnp.full(leaf.shape, jnp.nan if jnp.issubdtype(leaf.dtype, jnp.inexact) else 0, leaf.dtype)

    status = jnp.full(structure.status.shape, int(Status.INVALID_INPUT), structure.status.dtype)
    return eqx.tree_at(lambda one: one.status, jax.tree.map(nothing, structure), status)
