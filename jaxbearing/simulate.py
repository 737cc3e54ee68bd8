"""The verb for runs in time: a scene and a duration in, a history out."""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .bearings.cylindrical_roller import CylindricalRollerBearing
from .bearings.history import Energy, History, Instant
from .bearings.roller_dynamics import WORKS, RollerDynamics
from .bearings.roller_instants import observe
from .bearings.roller_motion import IMMOBILE, QuasiStatic, Start, at_start, begin, quasi_static
from .bearings.simulation import Simulation
from .numerics.arrow import ArrowPoint
from .numerics.compiling import quickly_compiled
from .numerics.integrator import IntegratorOptions, Segment
from .numerics.precision import as_float, require_x64
from .numerics.status import SolveError, Status

INTERVAL = 20e-6
"""Time between the instants of a history where a run does not say, s."""
FIRST_STEP = 1e-7
"""First step that is tried, s."""
SEGMENT = 128
"""Instants that are computed in one go."""
Progress = Callable[[float, float], None]


class _Advanced(NamedTuple):
    """A segment, and the instants of its begin, of the times asked for, and of its last state."""

    segment: Segment
    instants: Instant


def rates(time: Any, state: ArrowPoint, dynamics: RollerDynamics) -> ArrowPoint:
    """The vector field as diffrax wants it."""
    return dynamics.rates(time, state)


def trajectory(start: Start, times: Float[Array, " time"], simulation: Simulation, adjoint: Any = None) -> Segment:
    """The motion at given times, > 0 and increasing, in one go: pure, jit-able, vmap-able, differentiable.

    Derivatives have a meaning until the first shocks; behind them trajectories separate. **Arguments:** `adjoint`: of
    diffrax, e.g. `diffrax.ForwardMode()`.
    """
    from .numerics.integrate import integrate_segment  # diffrax, which nothing else needs, takes a second to import

    zero = jnp.zeros(())
    options = simulation.options
    return integrate_segment(rates, start.state, zero, times, start.dynamics, options, adjoint=adjoint, idle=len(WORKS))


# solved once a run: to compile takes longer than to run
_quasi_static = quickly_compiled(quasi_static)


@eqx.filter_jit
def _begin(scene: CylindricalRollerBearing, simulation: Simulation, found: QuasiStatic) -> Start:
    return begin(scene, simulation, found)


@eqx.filter_jit
def _advance(
    dynamics: RollerDynamics, state: ArrowPoint, start: Array, times: Array, options: IntegratorOptions, step: Array
) -> _Advanced:
    from .numerics.integrate import integrate_segment

    segment = integrate_segment(rates, state, start, times, dynamics, options, first_step=step, idle=len(WORKS))
    reached = times <= segment.last_time
    # beyond the place where a run stopped there are no states
    safe = jax.tree.map(
        lambda ys, end: jnp.where(jnp.reshape(reached, (-1, *(1 for _ in end.shape))), ys, end[None]),
        segment.states,
        segment.last,
    )
    states = jax.tree.map(lambda a, ys, b: jnp.concatenate([a[None], ys, b[None]]), state, safe, segment.last)
    at = jnp.concatenate([start[None], jnp.minimum(times, segment.last_time), segment.last_time[None]])
    return _Advanced(segment, jax.lax.map(lambda given: observe(dynamics, *given), (at, states)))


def simulate(
    scene: CylindricalRollerBearing,
    duration: float | None = None,
    *,
    simulation: Simulation | None = None,
    interval: float = INTERVAL,
    throw: bool = True,
    progress: Progress | None = None,
) -> History:
    """Run a bearing in time from the quasi-static state of its operating point.

    A run that fails, or is interrupted by Ctrl-C, keeps what was computed until then: `history.completed`.

    **Arguments:**
    - `duration`: s; that of the scene's simulation where not given.
    - `simulation`: speeds and loads over time, solver, tolerance; the scene's where not given, or else a steady
      operating point with the default solver.
    - `interval`: about the time between the instants of the history, s.
    - `throw`: raise where the run stops early.
    - `progress`: called with the time reached and the time of the end, s.

    **Raises:** `SolveError` where the quasi-static start is not found or (with `throw`) the run stops early;
    `ValueError` without a duration, or for a scene that does not move; `TypeError` for another kind of scene.
    """
    require_x64()
    if not isinstance(scene, CylindricalRollerBearing):
        raise TypeError(f"cannot simulate a {type(scene).__name__}; simulate takes: CylindricalRollerBearing")
    if not scene.slips:
        raise ValueError(IMMOBILE)
    chosen = simulation or scene.simulation or Simulation()
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: give it, or name it in the scene's simulation")
    stop = float(duration)
    if not (stop > 0 and np.isfinite(stop) and interval > 0):
        raise ValueError(f"duration and interval must be > 0 s, got {stop:g} and {interval:g}")
    # one shape of the compiled program, whatever the duration
    pieces = max(1, round(stop / (SEGMENT * interval)))
    times = np.linspace(0.0, stop, pieces * SEGMENT + 1)
    # the length of the run is no part of the program
    chosen = dataclasses.replace(chosen, duration=None)
    scene, chosen = (jax.tree.map(as_float, tree) for tree in (scene, chosen))

    found = _quasi_static(at_start(scene, chosen))
    if int(found.status) != Status.CONVERGED:
        raise SolveError(f"the quasi-static start of the run was not found: {Status(int(found.status)).text}")
    start = _begin(scene, chosen, found)
    state, status, interrupted = start.state, Status.CONVERGED, False
    step = jnp.asarray(FIRST_STEP)
    taken = refused = 0
    kept_times, kept = [], []
    try:
        for piece in range(pieces):
            here = times[piece * SEGMENT : (piece + 1) * SEGMENT + 1]
            segment, instants = _advance(
                start.dynamics, state, jnp.asarray(here[0]), jnp.asarray(here[1:]), chosen.options, step
            )
            taken, refused = taken + int(segment.accepted), refused + int(segment.rejected)
            state, status, step = segment.last, Status(int(segment.status)), segment.step
            good = np.append(here <= float(segment.last_time), status != Status.CONVERGED)
            good[0] = piece == 0
            kept_times.append(np.append(here, float(segment.last_time))[good])
            kept.append(jax.tree.map(lambda leaf, good=good: np.asarray(leaf)[good], instants))
            if status != Status.CONVERGED:
                break
            if progress is not None:
                progress(float(segment.last_time), stop)
    except KeyboardInterrupt:
        if not kept:
            raise
        status, interrupted = Status.NOT_CONVERGED, True
    instants = jax.tree.map(lambda *leaves: np.concatenate(leaves), *kept)
    history = History(
        status=jnp.asarray(int(status)),
        time=jnp.asarray(np.concatenate(kept_times)),
        stop=jnp.asarray(stop),
        accepted=jnp.asarray(taken),
        rejected=jnp.asarray(refused),
        reference_speed=jnp.asarray(start.dynamics.reference_speed),
        operation=scene.operation,
        instants=instants,
        energy=_energy(start.dynamics, state, instants),
        checks={},
        solver=chosen.solver,
        interrupted=interrupted,
        notes=scene.assumptions(),
    )
    if throw:
        history.raise_if_failed()
    return history


def _energy(dynamics: RollerDynamics, state: ArrowPoint, instants: Instant) -> Energy:
    """The works of the run, and how well they balance."""
    works = dict(zip(WORKS, jnp.asarray(dynamics.unscaled(state)[2]), strict=True))
    gain = lambda values: jnp.asarray(values[-1] - values[0])
    kinetic = gain(instants.kinetic_energy)
    left = works["drive"] - works["dissipation"] - works["pocket_films"] - works["lever_arm"] - kinetic
    load, ring = instants, instants.ring
    stored = load.radial_load * ring.radial + load.lateral_load * ring.lateral
    return Energy(
        drive=works["drive"],
        dissipation=works["dissipation"],
        pocket_films=works["pocket_films"],
        lever_arm=works["lever_arm"],
        kinetic=kinetic,
        pocket_elastic=gain(instants.pocket_energy),
        raceway_elastic=gain(instants.raceway_energy),
        load_on_ring=gain(stored) + works["load"],
        error=left / np.maximum(np.abs(works["drive"]), 1e-300),
    )
