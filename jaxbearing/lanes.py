"""Many scenes of one structure solved by one compiled program, whatever their number and that of the devices.

The program solves a fixed number of lanes on each device; more lanes are more calls of it. So a lane's numbers do not
depend on how many others there are, where in the batch it stands, or how many devices share the work.
"""

from collections.abc import Callable
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import PartitionSpec
from jaxtyping import Array, Bool

from ._scene import AbstractScene
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.status import Status
from .solve import solve, steady_function

Method = Literal["map", "vmap"]
"""How a device goes through its lanes: one after the other, or all in step, each waiting for the slowest."""


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
        chosen = jax.local_devices()[:devices]
        self.width = self.lanes * len(chosen)
        """Lanes of one call on all devices."""
        self._order = np.arange(self.width).reshape(self.lanes, len(chosen)).T.ravel()

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

        mesh = jax.make_mesh((len(chosen),), ("lane",), axis_types=(jax.sharding.AxisType.Auto,), devices=chosen)
        split, same = PartitionSpec("lane"), PartitionSpec()
        self._call = jax.jit(
            jax.shard_map(device, mesh=mesh, in_specs=(same, split, split), out_specs=split, check_vma=False)
        )

    def __call__(self, inputs: Any, active: np.ndarray, progress: Callable[[int], None] = lambda lanes: None) -> Any:
        """Solutions of as many lanes as there are.

        **Arguments:**
        - `inputs`: those of each lane, lanes in front of every array.
        - `active`: which lanes are solved, shape (lane,); the others are not converged, and their results NaN.
        - `progress`: called with the number of lanes that were finished.
        """
        count, done = len(active), []
        pending: list[tuple[int, Any]] = []
        for start in range(0, count, self.width):
            # one call is on its way while the results of the one before are fetched
            pending.append((min(self.width, count - start), self._start(inputs, active, start)))
            if len(pending) > 1:
                done.append(self._fetch(*pending.pop(0), progress))
        done += [self._fetch(*one, progress) for one in pending]
        return jax.tree.map(lambda *parts: np.concatenate(parts), *done)

    def _start(self, inputs: Any, active: np.ndarray, start: int) -> Any:
        """Neighbours go to different devices: they cost about the same."""

        def block(values: Any) -> np.ndarray:
            part = np.asarray(values)[start : start + self.width]
            filled = np.concatenate([part, np.repeat(part[-1:], self.width - len(part), axis=0)])
            return filled[self._order]

        wanted = np.zeros(self.width, dtype=bool)
        wanted[: len(active) - start] = active[start : start + self.width]
        return self._call(self.base, wanted[self._order], jax.tree.map(block, inputs))

    def _fetch(self, lanes: int, result: Any, progress: Callable[[int], None]) -> Any:
        places = np.empty_like(self._order)
        places[self._order] = np.arange(self.width)
        fetched = jax.tree.map(lambda leaf: np.asarray(leaf)[places[:lanes]], result)
        progress(lanes)
        return fetched


def _without_result(structure: Any) -> Any:
    """A solution that says nothing but that it is none."""

    def nothing(leaf: Any) -> Array:
        return jnp.full(leaf.shape, jnp.nan if jnp.issubdtype(leaf.dtype, jnp.inexact) else 0, leaf.dtype)

    status = jnp.full(structure.status.shape, int(Status.NOT_CONVERGED), structure.status.dtype)
    return eqx.tree_at(lambda one: one.status, jax.tree.map(nothing, structure), status)
