"""Single transient runs of a bearing of any family, also as a pure function. Batches of runs are in `batch`."""

import contextlib
import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...numerics.arrow import ArrowPoint
from ...numerics.checks import check_inputs
from ...numerics.integrator import Segment
from ...numerics.interrupts import Deferral, deferred_interrupts
from ...numerics.precision import as_float
from ...numerics.status import SolveError, Status
from ...numerics.structure import static_number
from ...programs import KeptProgram
from ..checks import input_excess
from ..facts import Excess
from ..mounted import fit_excess, running_scene
from ..supplied import supply_notes
from .checks import largest
from .family import AbstractDynamics, AbstractMovingBearing, Resumed, Start
from .history import Energy, History, Instant, LastState
from .run import FIELD, UNKNOWN, Advanced, advance, check_fits, identity
from .settings import Simulation
from .start import at_start

if TYPE_CHECKING:
    import diffrax as dfx

FIRST_STEP = 1e-7
"""First step that the integrator tries, s."""
SEGMENT = 128
"""Number of instants that one call of the compiled program computes."""
ENERGY_LIMIT = 1e-3
"""Relative error of the energy balance above which a warning is given."""
MOST_INSTANTS = 1_000_000
"""Largest number of instants of a run; each takes some kilobytes."""
Progress = Callable[[float, float], None]


def trajectory(
    start: Start, times: Float[Array, " time"], simulation: Simulation, adjoint: "dfx.AbstractAdjoint | None" = None
) -> Segment:
    """The motion at given times, as one program that is pure, jit-able, vmap-able and differentiable.

    Derivatives are meaningful until the first shocks; after them neighbouring trajectories separate. Reverse mode uses
    checkpoints and needs an explicit solver:

        def mean_load(clearance):
            start = jb.quasi_static_start(scene.replace({"cage.pocket_clearance": clearance}), simulation)
            run = jb.trajectory(start, times, simulation)
            load = lambda given: jb.pocket_loads(start.dynamics, *given)[0]
            return jnp.mean(jax.lax.map(load, (times, run.states)))

        jax.jit(jax.grad(mean_load))(300e-6)  # N per m

    If the start was not found, no step is taken: the trajectory has the status of the start, and its states are NaN.

    **Arguments:**
    - `start`: result of `quasi_static_start`.
    - `times`: positive and increasing times, s, shape (time,).
    - `simulation`: settings, of which solver and tolerance are used.
    - `adjoint`: an adjoint of diffrax such as `diffrax.ForwardMode()`; by default reverse mode with checkpoints.
    """
    from ...numerics.integrate import integrate_segment  # diffrax, which nothing else needs, takes a second to import

    zero, dynamics = jnp.zeros(()), start.dynamics
    options, idle = simulation.options, len(dynamics.works)
    # a guessed first step may be so long that the rates at its end are NaN. The integrator then shortens it, but
    # reverse mode would carry the NaN back
    first = jnp.asarray(FIRST_STEP)
    begun = start.status == Status.CONVERGED
    until = jnp.where(begun, times, zero)
    run = integrate_segment(
        FIELD, start.state, zero, until, dynamics, options, first_step=first, adjoint=adjoint, idle=idle
    )
    states = jax.tree.map(lambda leaf: jnp.where(begun, leaf, jnp.nan), run.states)
    return run._replace(states=states, status=jnp.where(begun, run.status, start.status))


def _quasi_static(scene: AbstractMovingBearing) -> Any:
    return scene.motion.quasi_static(scene)


def _begin(scene: AbstractMovingBearing, simulation: Simulation, steady: Any) -> Start:
    return scene.motion.begin(scene, simulation, steady)


def _resume(scene: AbstractMovingBearing, simulation: Simulation, last: LastState) -> Resumed:
    return scene.motion.resume(scene, simulation, last)


def _energy(dynamics: AbstractDynamics, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
    return dynamics.energy(state, first, last)


def _range_excess(scene: AbstractMovingBearing, instants: Instant) -> Excess:
    return scene.motion.range_excess(scene, instants)


# all programs but `advance` run only once or take little time: compiling them takes longer than running them
_QUASI_STATIC = KeptProgram(_quasi_static, quick=True)
_BEGIN = KeptProgram(_begin, quick=True)
_RESUME = KeptProgram(_resume, quick=True)
_ADVANCE = KeptProgram(advance, quick=False)
_ENERGY = KeptProgram(_energy, quick=True)
_EXCESS = KeptProgram(_range_excess, quick=True)


def requested(
    scene: AbstractMovingBearing, duration: float | None, simulation: Simulation | None, interval: float
) -> tuple[Simulation, float]:
    """Checks and returns the settings of a run and its duration, s."""
    scene.motion.require_moving(scene)
    check_inputs(scene)
    chosen = simulation or scene.simulation or Simulation()
    if not isinstance(chosen, Simulation):
        raise TypeError(
            f"simulation: expected a Simulation for a scene without [thermal], got a {type(chosen).__name__}"
        )
    check_inputs(chosen)
    scene.motion.require_settings(scene, chosen)
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: pass one, or give the scene a simulation.duration")
    length, interval = static_number("duration", duration, float), static_number("interval", interval, float)
    if not (length > 0 and interval > 0):
        raise ValueError(f"duration and interval must be > 0 s, got {length:g} and {interval:g}")
    if length / interval > MOST_INSTANTS:
        raise ValueError(
            f"duration and interval must make at most {MOST_INSTANTS} instants, got {length:g} and {interval:g} s"
        )
    # the compiled program must not depend on the length of the run
    return dataclasses.replace(chosen, duration=None), length


def simulate_bearing(
    scene: AbstractMovingBearing,
    duration: float | None,
    *,
    simulation: object,
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
    chosen, length = requested(scene, duration, simulation, interval)
    last = restart.last_state() if isinstance(restart, History) else restart
    if last is not None:
        check_fits(scene, last)
    begin_time = 0.0 if last is None else float(last.time)
    stop = begin_time + length
    # the compiled program has the same shapes for every duration
    pieces = max(1, round(length / (SEGMENT * interval)))
    times = np.linspace(begin_time, stop, pieces * SEGMENT + 1)
    scene, chosen = (jax.tree.map(as_float, tree) for tree in (scene, chosen))
    # with the weak type of a Python number the program would be compiled again for the second piece
    step = jnp.asarray(FIRST_STEP, dtype=float)

    if last is None:
        result = _QUASI_STATIC(at_start(scene, chosen))
        if int(result.status) != Status.CONVERGED:
            status = Status(int(result.status))
            raise SolveError(f"the quasi-static start of the run was not found: {status.text}", status)
        begun = _BEGIN(scene, chosen, result)
        dynamics, state = begun.dynamics, begun.state
    else:
        # the identity has been compared above; the program does not need it
        dynamics, state = _RESUME(scene, chosen, dataclasses.replace(last, identity=None))
    done: list[tuple[np.ndarray, Instant, Segment, Excess]] = []
    with contextlib.ExitStack() as stack:
        interrupt = Deferral()
        try:
            for piece in range(pieces):
                here = times[piece * SEGMENT : (piece + 1) * SEGMENT + 1]
                result = _ADVANCE(dynamics, state, jnp.asarray(here[0]), jnp.asarray(here[1:]), chosen.options, step)
                state, step = result.segment.last, result.segment.step
                done.append((*_kept(result, here, first=piece == 0), _EXCESS(scene, result.instants)))
                if piece == 0:
                    # from now on an interrupt ends the run but keeps its results
                    interrupt = stack.enter_context(deferred_interrupts())
                if int(result.segment.status) != Status.CONVERGED:
                    break
                if progress is not None:
                    progress(float(result.segment.last_time), stop)
                if interrupt.seen:
                    break
        except KeyboardInterrupt:
            # raised by `progress`, or by a second Ctrl-C
            if not done:
                raise
            interrupt.seen = True
        interrupted = interrupt.seen and len(done) < pieces
        unknown = last is not None and last.identity is None
        notes = (*((UNKNOWN,) if unknown else ()), *scene.assumptions(), *supply_notes(scene), *notes_of_seats(scene))
        history = _history(scene, chosen, dynamics, done, stop, interrupted, notes)
        interrupt.taken()
    # a user who interrupts a run wants the results so far
    if throw and not interrupted:
        history.raise_if_failed()
    return history


def notes_of_seats(scene: AbstractMovingBearing) -> tuple[str, ...]:
    return () if scene.fits is None else scene.fits.assumptions()


def _history(
    scene: AbstractMovingBearing,
    chosen: Simulation,
    dynamics: AbstractDynamics,
    done: list[tuple[np.ndarray, Instant, Segment, Excess]],
    stop: float,
    interrupted: bool,
    notes: tuple[str, ...],
) -> History:
    """Joins the pieces of a run to its history."""
    kept_times, kept, segments, excess = zip(*done, strict=True)
    instants = jax.tree.map(lambda *leaves: np.concatenate(leaves), *kept)
    ends = [jax.tree.map(lambda leaf, at=at: leaf[at], instants) for at in (0, -1)]
    found_energy = _ENERGY(dynamics, segments[-1].last, *ends)
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
        checks=run_checks(scene, found_energy, largest(list(excess))),
        solver=chosen.solver,
        interrupted=interrupted,
        element_name=scene.element,
        notes=notes,
        identity=identity(scene),
        cage_section=scene.cage_section,
    )


def run_checks(scene: AbstractMovingBearing, energy: Energy, excess: Excess) -> dict[str, Array]:
    """Warnings of a run: those of its energy balance, of its results, of the inputs and of the fits."""
    text = f"the energy balance leaves more than {ENERGY_LIMIT:g} of the drive work open: choose a smaller tolerance"
    all_excess = input_excess(scene) | excess
    _, fit, _ = running_scene(scene)
    if fit is not None:
        all_excess |= fit_excess(scene, fit)
    return {text: jnp.abs(energy.error) > ENERGY_LIMIT} | {warning: value > 0 for warning, value in all_excess.items()}


def _kept(advanced: Advanced, times: np.ndarray, first: bool) -> tuple[np.ndarray, Instant, Segment]:
    """Times and instants of a segment that the history keeps: those that were reached, without the start except in the
    first piece, and with the last state if the segment stopped early."""
    segment = advanced.segment
    good = np.append(times <= float(segment.last_time), int(segment.status) != Status.CONVERGED)
    good[0] = first
    return (
        np.asarray(advanced.times)[good],
        jax.tree.map(lambda leaf: np.asarray(leaf)[good], advanced.instants),
        segment,
    )
