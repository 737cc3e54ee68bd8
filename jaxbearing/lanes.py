"""Many scenes of one structure solved by one compiled program, whatever their number and that of the devices.

The program solves a fixed number of lanes on one device; more lanes are more calls of it, on whichever device is free.
So a lane's numbers do not depend on how many others there are, where among them it stands, or how many devices share
the work. `jax.shard_map` would be another program for another number of devices: measured, loads of a dry bearing
then differ in the last bits between one device and two.
"""

import functools
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool

from ._scene import AbstractScene, AbstractSolution
from .numerics.compiling import quick_options
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.quiet import compiling_quietly
from .numerics.status import Status
from .programs import KeptProgram
from .solve import require_solvable, solve

if TYPE_CHECKING:
    import numpy.typing as npt

Method = Literal["map", "vmap"]
"""Order in which a device solves its lanes: one after the other, or all in step, each waiting for the slowest."""


_COMPILING = threading.Semaphore(2)
"""XLA compiles once for each device and takes up to 1 GB for it; those that are compiled already solve meanwhile."""


def default_method() -> Method:
    """The faster way to solve many scenes: on a CPU one by one ("map", 4 to 9 times faster), on a GPU in step."""
    return "map" if jax.default_backend() == "cpu" else "vmap"


class LaneProgram:
    """Solves lanes of scenes: `program(inputs, active)` gives their solutions as numpy arrays with the lanes in front.

    **Arguments:**
    - `make`: from the base and a lane's inputs to its scene. Of a function of this package the program is kept between
      processes (`programs.KeptProgram`) where one device of a CPU does all.
    - `base`: numbers that all lanes share: a pytree.
    - `example`: the inputs of one lane, a pytree of float64 numbers and arrays.
    - `lanes`: that each device solves in one call.
    - `devices`: how many of the local ones share the work; all if not given.
    - `quick`: compile quickly (see `numerics.compiling`): for few lanes.
    """

    def __init__(
        self,
        make: Callable[[Any, Any], AbstractScene],
        base: Any,
        example: object,
        *,
        method: Method = "map",
        lanes: int,
        devices: int | None = None,
        options: NewtonOptions | None = None,
        quick: bool = False,
    ):
        require_x64()
        self.base = jax.tree.map(as_float, base)
        self.lanes = lanes
        self.devices = jax.local_devices()[:devices]
        self._example = jax.tree.map(as_float, example)
        require_solvable(make(self.base, self._example))
        self._static = (make, method, options)
        self._quick = quick
        self._kept = KeptProgram(_lanes, quick)
        self._compiled: dict[Any, Callable[[Any], Any]] = {}
        self._tracing = threading.Lock()

    @functools.cached_property
    def structure(self) -> AbstractSolution:
        """The solution of one lane, with shapes for arrays."""
        inputs = jax.tree.map(lambda leaf: np.asarray(leaf)[None], self._example)
        leaves, structure = self._flat(self._filled(inputs, np.zeros(1, dtype=bool), 0))
        solution = self._kept.result(structure, leaves) if len(self.devices) == 1 else None
        if solution is None:
            make, _, options = self._static
            return jax.eval_shape(functools.partial(_lane, make, options), self.base, self._example)
        return jax.tree.map(lambda leaf: jax.ShapeDtypeStruct(leaf.shape[1:], leaf.dtype), solution)

    def __call__(
        self, inputs: object, active: np.ndarray, progress: Callable[[int], None] = lambda lanes: None
    ) -> AbstractSolution:
        """Solutions of as many lanes as there are.

        **Arguments:**
        - `inputs`: those of each lane, lanes in front of every array.
        - `active`: which lanes are solved, shape (lane,); the others are `invalid_input`, and their results NaN.
        - `progress`: called with the number of lanes that were finished.
        """
        count, done = len(active), []
        free: SimpleQueue[Any] = SimpleQueue()
        for device in self.devices:
            free.put(device)

        def solved(start: int) -> AbstractSolution:
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

    def _filled(self, inputs: object, active: np.ndarray, start: int) -> tuple[Any, np.ndarray, Any]:
        """Gives what the lanes of one call share, which of them are solved, and their inputs. The last block is filled
        up with lanes that are not solved."""

        def part(values: "npt.ArrayLike") -> np.ndarray:
            values = np.asarray(values)[start : start + self.lanes]
            return np.concatenate([values, np.repeat(values[-1:], self.lanes - len(values), axis=0)])

        wanted = np.zeros(self.lanes, dtype=bool)
        wanted[: min(self.lanes, len(active) - start)] = active[start : start + self.lanes]
        return self.base, wanted, jax.tree.map(part, inputs)

    def _flat(self, filled: Any) -> tuple[list[Any], Any]:
        """Leaves and structure of all arguments of `_lanes`, from what `_filled` gives."""
        return jax.tree.flatten((*self._static, *filled))

    def _block(self, device: object, inputs: object, active: np.ndarray, start: int) -> AbstractSolution:
        """Lanes of one call."""
        filled = self._filled(inputs, active, start)
        if device not in self._compiled:
            self._compiled[device] = self._prepared(device, filled)
        count = min(self.lanes, len(active) - start)
        return jax.tree.map(lambda leaf: np.asarray(leaf)[:count], self._compiled[device](filled))

    def _prepared(self, device: Any, filled: object) -> Callable[[Any], Any]:
        """The program for a device, of what `_filled` gives: kept, or compiled here."""
        leaves, structure = self._flat(filled)
        kept = self._kept.ready(structure, leaves) if len(self.devices) == 1 else None
        if kept is not None:
            return lambda block: kept(self._flat(block)[0])
        options = quick_options() if self._quick and device.platform == "cpu" else None
        with self._tracing:
            lowered = jax.jit(functools.partial(_lanes, *self._static)).lower(*jax.device_put(filled, device))
        with _COMPILING, compiling_quietly():
            compiled = lowered.compile(options)
        return lambda block: compiled(*jax.device_put(block, device))


def _lane(
    make: Callable[[Any, Any], AbstractScene], options: NewtonOptions | None, shared: object, inputs: object
) -> AbstractSolution:
    return solve(make(shared, inputs), throw=False, options=options)


def _lanes(
    make: Callable[[Any, Any], AbstractScene],
    method: Method,
    options: NewtonOptions | None,
    shared: object,
    active: Bool[Array, " lane"],
    inputs: object,
) -> AbstractSolution:
    """Solutions of all lanes of one call."""
    solve_lane = functools.partial(_lane, make, options)
    first = jax.tree.map(lambda leaf: jax.ShapeDtypeStruct(leaf.shape[1:], leaf.dtype), inputs)
    empty = _without_result(jax.eval_shape(solve_lane, shared, first))

    def lane(shared: object, active: Array, inputs: object) -> AbstractSolution:
        return jax.lax.cond(active, lambda: solve_lane(shared, inputs), lambda: empty)

    if method == "map":
        return jax.lax.map(lambda pair: lane(shared, pair[0], pair[1]), (active, inputs))
    return jax.vmap(lane, in_axes=(None, 0, 0))(shared, active, inputs)


def _without_result(structure: AbstractSolution) -> AbstractSolution:
    """The solution of a lane that is not solved, because its scene was refused."""

    def nothing(leaf: jax.ShapeDtypeStruct) -> Array:
        return jnp.full(leaf.shape, jnp.nan if jnp.issubdtype(leaf.dtype, jnp.inexact) else 0, leaf.dtype)

    status = jnp.full(structure.status.shape, int(Status.INVALID_INPUT), structure.status.dtype)
    return eqx.tree_at(lambda solution: solution.status, jax.tree.map(nothing, structure), status)
