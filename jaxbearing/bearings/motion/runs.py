"""Runs in time of a moving cylindrical roller bearing: one at a time, many at once, and as a pure function."""

import contextlib
import dataclasses
from collections.abc import Callable, Mapping
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._checks import Checks
from ...numerics.checks import check_inputs
from ...numerics.devices import may_be_shared_out, shared_out
from ...numerics.integrator import Segment
from ...numerics.interrupts import Deferral, deferred_interrupts
from ...numerics.precision import as_float
from ...numerics.status import SolveError, Status
from ...numerics.structure import static_number
from ...programs import KeptProgram
from ..checks import input_excess
from ..cylindrical.scene import CylindricalRollerBearing
from ..facts import Excess
from ..mounted import fit_excess, running_scene
from .checks import largest, run_excess
from .history import Energy, History, LastState
from .rates import WORKS
from .run import FIELD, UNKNOWN, Advanced, advance, check_fits, energy_of, identity, resume
from .settings import Simulation
from .start import IMMOBILE, Start, at_start, begin, checked_lane, quasi_static

FIRST_STEP = 1e-7
"""First step that is tried, s."""
SEGMENT = 128
"""Instants that are computed in one go."""
ENERGY_LIMIT = 1e-3
"""Error of the energy balance from which on a run warns."""
MOST_INSTANTS = 1_000_000
"""Instants that a run may have: each takes some kilobytes."""
Progress = Callable[[float, float], None]


def trajectory(start: Start, times: Float[Array, " time"], simulation: Simulation, adjoint: Any = None) -> Segment:
    """The motion at given times, > 0 and increasing, in one go: pure, jit-able, vmap-able, differentiable.

    Derivatives have a meaning until the first shocks; behind them trajectories separate. In reverse mode, with
    checkpoints, explicit solvers only:

        def mean_load(clearance):
            start = jb.quasi_static_start(scene.replace({"cage.pocket_clearance": clearance}), simulation)
            run = jb.trajectory(start, times, simulation)
            load = lambda given: jb.pocket_loads(start.dynamics, *given)[0]
            return jnp.mean(jax.lax.map(load, (times, run.states)))

        jax.jit(jax.grad(mean_load))(300e-6)  # N per m

    A start that was not found takes no steps: its status is that of the trajectory, whose states are NaN.

    **Arguments:**
    - `start`: from `quasi_static_start`.
    - `times`: s, shape (time,).
    - `adjoint`: of diffrax, e.g. `diffrax.ForwardMode()`; reverse mode with checkpoints where not given.
    """
    from ...numerics.integrate import integrate_segment  # diffrax, which nothing else needs, takes a second to import

    zero = jnp.zeros(())
    options = simulation.options
    # a first step that is guessed may be so long that there are no rates at its end: it is then shortened, but its NaN
    # would come back in reverse mode
    first = jnp.asarray(FIRST_STEP)
    begun = start.status == Status.CONVERGED
    until = jnp.where(begun, times, zero)
    run = integrate_segment(
        FIELD, start.state, zero, until, start.dynamics, options, first_step=first, adjoint=adjoint, idle=len(WORKS)
    )
    states = jax.tree.map(lambda leaf: jnp.where(begun, leaf, jnp.nan), run.states)
    return run._replace(states=states, status=jnp.where(begun, run.status, start.status))


# solved once a run: to compile takes longer than to run
_quasi_static = KeptProgram(quasi_static, quick=True)
_begin = KeptProgram(begin, quick=True)
_resume = KeptProgram(resume, quick=True)
_advance = KeptProgram(advance, quick=False)
_energy = KeptProgram(energy_of, quick=True)
_excess = KeptProgram(run_excess, quick=True)


def _request(
    scene: CylindricalRollerBearing, duration: float | None, simulation: Simulation | None, interval: float
) -> tuple[Simulation, float]:
    """Checked request for a run: its settings, and its duration, s."""
    if not scene.slips:
        raise ValueError(IMMOBILE)
    check_inputs(scene)
    chosen = simulation or scene.simulation or Simulation()
    check_inputs(chosen)
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: give it, or name it in the scene's simulation")
    length, interval = static_number("duration", duration, float), static_number("interval", interval, float)
    if not (length > 0 and interval > 0):
        raise ValueError(f"duration and interval must be > 0 s, got {length:g} and {interval:g}")
    if length / interval > MOST_INSTANTS:
        raise ValueError(
            f"duration and interval must make at most {MOST_INSTANTS} instants, got {length:g} and {interval:g} s"
        )
    # the length of the run is no part of the program
    return dataclasses.replace(chosen, duration=None), length


def simulate_rollers(
    scene: CylindricalRollerBearing,
    duration: float | None,
    *,
    simulation: Any,
    interval: float,
    throw: bool,
    progress: Progress | None,
    restart: Any,
) -> History:
    """See `jaxbearing.simulate`."""
    if getattr(restart, "of", "bearing") != "bearing":
        raise ValueError(f"restart: a state of a {restart.of}, for a scene of a bearing")
    if not isinstance(restart, History | LastState | None):
        raise TypeError(f"restart must be a History or a LastState (jb.read_last_state of a file), got {restart!r}")
    if not isinstance(simulation, Simulation | None):
        raise TypeError(f"simulation must be a Simulation, got {simulation!r}")
    chosen, length = _request(scene, duration, simulation, interval)
    last = restart.last_state() if isinstance(restart, History) else restart
    if last is not None:
        check_fits(scene, last)
    begin_time = 0.0 if last is None else float(last.time)
    stop = begin_time + length
    # one shape of the compiled program, whatever the duration
    pieces = max(1, round(length / (SEGMENT * interval)))
    times = np.linspace(begin_time, stop, pieces * SEGMENT + 1)
    scene, chosen = (jax.tree.map(as_float, tree) for tree in (scene, chosen))
    # a weak type, as that of a Python number, would have the program compiled again for the second piece
    step = jnp.asarray(FIRST_STEP, dtype=float)

    if last is None:
        found = _quasi_static(at_start(scene, chosen))
        if int(found.status) != Status.CONVERGED:
            status = Status(int(found.status))
            raise SolveError(f"the quasi-static start of the run was not found: {status.text}", status)
        begun = _begin(scene, chosen, found)
        dynamics, state = begun.dynamics, begun.state
    else:
        # which bearing it is has been compared, and is no part of the program
        dynamics, state = _resume(scene, chosen, dataclasses.replace(last, identity=None))
    done: list[tuple[np.ndarray, Any, Segment, Excess]] = []
    with contextlib.ExitStack() as stack:
        interrupt = Deferral()
        try:
            for piece in range(pieces):
                here = times[piece * SEGMENT : (piece + 1) * SEGMENT + 1]
                found = _advance(dynamics, state, jnp.asarray(here[0]), jnp.asarray(here[1:]), chosen.options, step)
                state, step = found.segment.last, found.segment.step
                done.append((*_kept(found, here, first=piece == 0), _excess(scene, found.instants)))
                if piece == 0:
                    # from now on there is something to keep
                    interrupt = stack.enter_context(deferred_interrupts())
                if int(found.segment.status) != Status.CONVERGED:
                    break
                if progress is not None:
                    progress(float(found.segment.last_time), stop)
                if interrupt.seen:
                    break
        except KeyboardInterrupt:
            # of `progress`, or of a second Ctrl-C
            if not done:
                raise
            interrupt.seen = True
        interrupted = interrupt.seen and len(done) < pieces
        unknown = last is not None and last.identity is None
        notes = (*((UNKNOWN,) if unknown else ()), *scene.assumptions(), *_of_seats(scene))
        history = _history(scene, chosen, dynamics, done, stop, interrupted, notes)
        interrupt.taken()
    # who interrupts a run wants what there is
    if throw and not interrupted:
        history.raise_if_failed()
    return history


def _of_seats(scene: CylindricalRollerBearing) -> tuple[str, ...]:
    return () if scene.fits is None else scene.fits.assumptions()


def _history(
    scene: CylindricalRollerBearing,
    chosen: Simulation,
    dynamics: Any,
    done: list[tuple[np.ndarray, Any, Segment, Excess]],
    stop: float,
    interrupted: bool,
    notes: tuple[str, ...],
) -> History:
    """From the pieces of a run to the whole."""
    kept_times, kept, segments, excess = zip(*done, strict=True)
    instants = jax.tree.map(lambda *leaves: np.concatenate(leaves), *kept)
    ends = [jax.tree.map(lambda leaf, at=at: leaf[at], instants) for at in (0, -1)]
    found_energy = _energy(dynamics, segments[-1].last, *ends)
    status = Status.NOT_CONVERGED if interrupted else Status(int(segments[-1].status))
    return History(
        status=jnp.asarray(int(status)),
        time=jnp.asarray(np.concatenate(kept_times)),
        stop=jnp.asarray(stop),
        accepted=jnp.asarray(sum(int(segment.accepted) for segment in segments)),
        rejected=jnp.asarray(sum(int(segment.rejected) for segment in segments)),
        reference_speed=jnp.asarray(dynamics.reference_speed),
        operation=scene.operation,
        instants=instants,
        energy=found_energy,
        checks=_checks(scene, found_energy, largest(list(excess))),
        solver=chosen.solver,
        interrupted=interrupted,
        notes=notes,
        identity=identity(scene),
    )


def _checks(scene: CylindricalRollerBearing, energy: Energy, excess: Excess) -> dict[str, Any]:
    """Warnings of a run: its energy balance, and the range checks that a steady solve makes of the same scene."""
    text = f"the energy balance leaves more than {ENERGY_LIMIT:g} of the drive work open: choose a smaller tolerance"
    found = input_excess(scene) | excess
    _, fit, _ = running_scene(scene)
    if fit is not None:
        found |= fit_excess(scene, fit)
    return {text: jnp.abs(energy.error) > ENERGY_LIMIT} | {said: value > 0 for said, value in found.items()}


def _kept(found: Advanced, times: np.ndarray, first: bool) -> tuple[np.ndarray, Any, Segment]:
    """Times and instants of a segment that are new and were reached: its last state only where it stopped early."""
    segment = found.segment
    good = np.append(times <= float(segment.last_time), int(segment.status) != Status.CONVERGED)
    good[0] = first
    return np.asarray(found.times)[good], jax.tree.map(lambda leaf: np.asarray(leaf)[good], found.instants), segment


def simulate_roller_batch(
    scene: CylindricalRollerBearing,
    duration: float,
    over: Mapping[str, Any],
    *,
    simulation: Simulation | None = None,
    interval: float,
    method: Literal["map", "vmap"] = "map",
) -> History:
    """See `jaxbearing.simulate_batch`."""
    chosen, length = _request(scene, duration, simulation, interval)
    values = {path: jax.tree.map(as_float, value) for path, value in over.items()}
    sizes = {np.shape(leaf)[:1] for leaf in jax.tree.leaves(values)}
    if len(sizes) != 1 or () in sizes or (0,) in sizes:
        raise ValueError(
            "over: as many values for each path are wanted, one or more, as arrays with the lanes in front"
        )
    scene, chosen = (jax.tree.map(as_float, tree) for tree in (scene, chosen))
    pieces = max(1, round(length / interval))
    times = jnp.linspace(0.0, length, pieces + 1)[1:]
    # that of the scene may change from lane to lane
    given = simulation is not None or scene.simulation is None
    share = may_be_shared_out((scene, chosen, values))
    return _batch(scene, chosen if given else None, values, times, method, share)


@eqx.filter_jit
def _batch(
    scene: CylindricalRollerBearing,
    simulation: Simulation | None,
    values: dict[str, Any],
    times: Float[Array, " time"],
    method: str,
    share: bool,
) -> History:
    numbers, rest = eqx.partition((scene, simulation), eqx.is_array_like)

    def lanes(values: dict[str, Any], numbers: Any, times: Float[Array, " time"]) -> History:
        scene, simulation = eqx.combine(numbers, rest)
        lane = lambda changes: _lane(scene.replace(changes), simulation, times)
        return jax.lax.map(lane, values) if method == "map" else jax.vmap(lane)(values)

    return (shared_out(lanes) if share else lanes)(values, numbers, times)


def _lane(scene: CylindricalRollerBearing, simulation: Simulation | None, times: Float[Array, " time"]) -> History:
    """One whole run in one go, from its quasi-static start; pure."""
    simulation = simulation or scene.simulation or Simulation()
    operation = scene.operation
    scene, inputs = checked_lane(scene, simulation)
    start = begin(scene, simulation, quasi_static(at_start(scene, simulation)))
    zero = jnp.zeros(())
    begun = jnp.where(inputs.valid, start.status, int(Status.INVALID_INPUT))
    # a lane without a start takes no steps, for which the others would have to wait
    until = jnp.where(begun == Status.CONVERGED, times, zero)
    found = advance(start.dynamics, start.state, zero, until, simulation.options, jnp.asarray(FIRST_STEP))
    segment = found.segment
    status = jnp.where(begun == Status.CONVERGED, segment.status, begun)
    # a run that stopped early has its last state after the instants that it reached
    reached = jnp.sum(times <= segment.last_time) + 1
    stopped = status != Status.CONVERGED
    shown = jnp.arange(times.shape[0] + 1) < jnp.where(stopped, reached + 1, reached)
    shown = shown & (begun == Status.CONVERGED)
    masked = lambda leaf: jnp.where(jnp.reshape(shown, (-1, *(1 for _ in leaf.shape[1:]))), leaf[:-1], jnp.nan)
    ends = [jax.tree.map(lambda leaf, at=at: leaf[at], found.instants) for at in (0, -1)]
    energy = energy_of(start.dynamics, segment.last, *ends)
    return History(
        status=jnp.asarray(status),
        time=masked(found.times),
        stop=times[-1],
        accepted=segment.accepted,
        rejected=segment.rejected,
        reference_speed=start.dynamics.reference_speed,
        operation=jax.tree.map(jnp.asarray, operation),
        instants=jax.tree.map(masked, found.instants),
        energy=energy,
        checks=Checks(_checks(scene, energy, run_excess(scene, found.instants)), inputs.broken, inputs.rules),
        solver=simulation.solver,
        notes=(*scene.assumptions(), *_of_seats(scene)),
        identity=jax.tree.map(jnp.asarray, identity(scene)),
    )
