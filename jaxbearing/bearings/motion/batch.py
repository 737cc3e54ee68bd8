"""Batches of transient runs of a bearing of any family, in one compiled program."""

from collections.abc import Mapping
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._checks import Checks
from ...numerics.devices import may_be_shared_out, shared_out
from ...numerics.precision import as_float
from ...numerics.status import Status
from ..supplied import supply_notes
from .family import AbstractMovingBearing
from .history import History
from .run import advance, identity
from .runs import FIRST_STEP, notes_of_seats, requested, run_checks
from .settings import Simulation
from .start import at_start, checked_lane


def simulate_bearing_batch(
    scene: AbstractMovingBearing,
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: Simulation | None = None,
    interval: float,
    method: Literal["map", "vmap"] = "map",
) -> History:
    """See `jaxbearing.simulate_batch`."""
    chosen, length = requested(scene, duration, simulation, interval)
    values = {path: jax.tree.map(as_float, value) for path, value in over.items()}
    sizes = {np.shape(leaf)[:1] for leaf in jax.tree.leaves(values)}
    if len(sizes) != 1 or () in sizes or (0,) in sizes:
        raise ValueError(
            "over: expected the same number of values for each path, one or more, as arrays with the lanes in front"
        )
    scene, chosen = (jax.tree.map(as_float, tree) for tree in (scene, chosen))
    pieces = max(1, round(length / interval))
    times = jnp.linspace(0.0, length, pieces + 1)[1:]
    # without a given simulation each lane takes that of its scene, which may differ between lanes
    shared = simulation is not None or scene.simulation is None
    share = may_be_shared_out((scene, chosen, values))
    return _batch(scene, chosen if shared else None, values, times, method, share)


@eqx.filter_jit
def _batch(
    scene: AbstractMovingBearing,
    simulation: Simulation | None,
    values: Mapping[str, object],
    times: Float[Array, " time"],
    method: str,
    share: bool,
) -> History:
    numbers, rest = eqx.partition((scene, simulation), eqx.is_array_like)

    def lanes(values: Mapping[str, object], numbers: Any, times: Float[Array, " time"]) -> History:
        scene, simulation = eqx.combine(numbers, rest)
        lane = lambda changes: _lane(scene.replace(changes), simulation, times)
        return jax.lax.map(lane, values) if method == "map" else jax.vmap(lane)(values)

    return (shared_out(lanes) if share else lanes)(values, numbers, times)


def _lane(scene: AbstractMovingBearing, chosen: Simulation | None, times: Float[Array, " time"]) -> History:
    """One complete run of the batch, from its quasi-static start; pure."""
    simulation: Simulation = chosen or scene.simulation or Simulation()
    operation = scene.operation
    scene, inputs = checked_lane(scene, simulation)
    motion = scene.motion
    start = motion.begin(scene, simulation, motion.quasi_static(at_start(scene, simulation)))
    zero = jnp.zeros(())
    begun = jnp.where(inputs.valid, start.status, int(Status.INVALID_INPUT))
    # a lane whose start was not found takes no steps, so that the other lanes need not wait for it
    until = jnp.where(begun == Status.CONVERGED, times, zero)
    advanced = advance(start.dynamics, start.state, zero, until, simulation.options, jnp.asarray(FIRST_STEP))
    segment = advanced.segment
    status = jnp.where(begun == Status.CONVERGED, segment.status, begun)
    # a run that stopped early has its last state after the instants that it reached
    reached = jnp.sum(times <= segment.last_time) + 1
    stopped = status != Status.CONVERGED
    shown = jnp.arange(times.shape[0] + 1) < jnp.where(stopped, reached + 1, reached)
    shown = shown & (begun == Status.CONVERGED)
    masked = lambda leaf: jnp.where(jnp.reshape(shown, (-1, *(1 for _ in leaf.shape[1:]))), leaf[:-1], jnp.nan)
    ends = [jax.tree.map(lambda leaf, at=at: leaf[at], advanced.instants) for at in (0, -1)]
    energy = start.dynamics.energy(segment.last, *ends)
    return History(
        status=jnp.asarray(status),
        time=masked(advanced.times),
        stop=times[-1],
        accepted=segment.accepted,
        rejected=segment.rejected,
        reference_speed=start.dynamics.reference_speed,
        operation=jax.tree.map(jnp.asarray, operation),
        instants=jax.tree.map(masked, advanced.instants),
        energy=energy,
        checks=Checks(
            run_checks(scene, energy, motion.range_excess(scene, advanced.instants)), inputs.broken, inputs.rules
        ),
        solver=simulation.solver,
        element_name=scene.element,
        notes=(*scene.assumptions(), *supply_notes(scene), *notes_of_seats(scene)),
        identity=jax.tree.map(jnp.asarray, identity(scene)),
        cage_section=scene.cage_section,
    )
