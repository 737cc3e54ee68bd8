"""A transient run of a line contact: from the steady film, segment after segment."""

import contextlib
import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..numerics.checks import check_inputs
from ..numerics.compiling import quickly_compiled
from ..numerics.interrupts import Deferral, deferred_interrupts
from ..numerics.precision import as_float
from ..numerics.status import SolveError, Status
from ..numerics.structure import static_number
from .equations import Point, film_shape
from .history import FilmHistory, LineContactHistory, PressureHistory, ProfileHistory, thin_note
from .last_state import UNKNOWN, FilmState, mesh_of_state, motion_of, state_of
from .line_contact import SMALLEST_MOES_LOAD, EHLLineContact, Scales
from .mesh import MeshKey, mesh
from .simulation import FilmSimulation
from .solution import HertzResult, central_value, range_checks
from .steady import SteadyRoot, existing, judged, steady_root
from .stepping import SEGMENT, Advanced, Drive, Motion, advance, at_rest

LOOKS = 2_001
"""Number of times at which the speed is evaluated, to find out if it becomes negative."""


class Begun(NamedTuple):
    """Steady start of a run, with the scales and the drive of the equations."""

    scales: Scales
    drive: Drive
    motion: Motion
    root: SteadyRoot


class Seen(NamedTuple):
    """Stored results of a step, SI."""

    central: Float[Array, ""]
    minimum: Float[Array, ""]
    minimum_position: Float[Array, ""]
    central_pressure: Float[Array, ""]
    largest_pressure: Float[Array, ""]
    pressure: Float[Array, " node"]
    film: Float[Array, " node"]


def drive_of(scene: EHLLineContact, simulation: FilmSimulation, scales: Scales) -> Drive:
    """Constants of the run."""
    unit = scales.half_width / scales.reference_speed
    base = jnp.asarray(scene.operation.entrainment_speed) / scales.reference_speed
    limit = scene.contact.film_limit / scales.film
    return Drive(scene.fluid(scales), scales.wedge, simulation.speed, unit, base, simulation.tolerance, limit)


def _steady_start(scene: EHLLineContact, simulation: FilmSimulation, key: MeshKey) -> Begun:
    scales = scene.scales()
    drive = drive_of(scene, simulation, scales)
    problem = scene.steady(scales, drive.speed_at(jnp.zeros(())))
    root = steady_root(problem, key=key)
    status = judged(root.status, existing(scales.wedge, problem.speed), scene.described(scales))
    root = root._replace(status=status)
    return Begun(scales, drive, at_rest(root.point, drive.fluid, mesh(key)), root)


# called once per run: compiling takes longer than running
_begin = quickly_compiled(_steady_start)


@eqx.filter_jit
def _prepare(scene: EHLLineContact, simulation: FilmSimulation) -> tuple[Scales, Drive]:
    scales = scene.scales()
    return scales, drive_of(scene, simulation, scales)


@eqx.filter_jit
def _advance(drive: Drive, motion: Motion, stop: Array, key: MeshKey) -> Advanced:
    return advance(drive, motion, stop, mesh(key))


@eqx.filter_jit
def _see(points: Point, scales: Scales, key: MeshKey) -> Seen:
    grid = mesh(key)

    def seen(point: Point) -> Seen:
        film = film_shape(point, grid)
        lowest = jnp.argmin(film)
        return Seen(
            central_value(film, grid) * scales.film,
            film[lowest] * scales.film,
            jnp.asarray(grid.x)[lowest] * scales.half_width,
            central_value(point.pressure, grid) * scales.hertz_pressure,
            jnp.max(point.pressure) * scales.hertz_pressure,
            point.pressure * scales.hertz_pressure,
            film * scales.film,
        )

    return jax.vmap(seen)(points)


def enters_behind(scene: EHLLineContact, simulation: FilmSimulation, begin: float, stop: float) -> bool:
    """True if oil enters from +x at some time from `begin` to `stop`, s."""
    factors = np.asarray(jax.vmap(simulation.speed.factor)(jnp.linspace(begin, stop, LOOKS)))
    return bool((float(scene.operation.entrainment_speed) * factors).min() < 0.0)


def check_restart(scene: EHLLineContact, simulation: FilmSimulation, state: FilmState, duration: float) -> MeshKey:
    """The mesh of a run that goes on from a state. **Raises:** `ValueError` where it does not fit."""
    begin = float(state.time)
    return mesh_of_state(scene, state, enters_behind(scene, simulation, begin, begin + duration))


def _no_start(begun: Begun) -> str:
    """The reason why there is no steady film, in words."""
    root, scales = begun.root, begun.scales
    if bool(root.iterations):
        reason = f"Newton's last step was {float(root.step):.3g}"
    elif float(scales.moes_load) < SMALLEST_MOES_LOAD:
        reason = (
            f"load number M = {float(scales.moes_load):.3g} is below {SMALLEST_MOES_LOAD:g}: the cylinders are all but "
            "rigid and this elastic model does not apply"
        )
    else:
        reason = "at rest there is none: the speed at the start carries no oil into the contact"
    return f"the steady film at the start of the run was not found: {Status(int(root.status)).text}: {reason}"


def simulate_film(
    scene: EHLLineContact,
    duration: float,
    simulation: FilmSimulation,
    *,
    start: FilmState | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> LineContactHistory:
    """Run a line contact in time; see `simulate`. Ctrl-C keeps what was computed.

    **Raises:** `SolveError` where there is no steady film to begin with; `ValueError` for a `start` of another contact
    or on another mesh.
    """
    scene, simulation = (jax.tree.map(as_float, tree) for tree in (scene, simulation))
    began = 0.0 if start is None else float(start.time)
    stop = began + duration
    if start is None:
        key = scene.run_mesh(enters_behind(scene, simulation, began, stop))
        begun = _begin(scene, simulation, key)
        if int(begun.root.status) != Status.CONVERGED:
            raise SolveError(_no_start(begun), Status(int(begun.root.status)))
        scales, drive, motion = begun.scales, begun.drive, begun.motion
    else:
        key = check_restart(scene, simulation, start, duration)
        scales, drive = _prepare(scene, simulation)
        motion = motion_of(start, scales)
    end = jnp.asarray(stop) / drive.unit
    unit = float(drive.unit)
    first = jax.tree.map(lambda leaf: jnp.broadcast_to(leaf[:1], (SEGMENT, *leaf.shape[1:])), motion.points)
    kept = [jax.tree.map(lambda leaf: np.asarray(leaf)[:1], _see(first, scales, key))]
    times, speeds = [np.asarray([began])], [np.asarray([float(drive.speed_at(motion.time))])]
    taken = refused = newton_steps = 0
    balance, status, thin, interrupted = 0.0, Status.CONVERGED, False, False
    with contextlib.ExitStack() as stack:
        interrupt = Deferral()
        try:
            while True:
                segment = _advance(drive, motion, end, key)
                count = int(segment.taken)
                seen = jax.tree.map(
                    lambda leaf, count=count: np.asarray(leaf)[:count], _see(segment.record.point, scales, key)
                )
                motion, kept = segment.motion, [*kept, seen]
                times.append(np.asarray(segment.record.time)[:count] * unit)
                speeds.append(np.asarray(segment.record.speed)[:count])
                taken, refused = taken + count, refused + int(segment.rejected)
                newton_steps += int(segment.newton_steps)
                balance = max(balance, float(np.max(np.asarray(segment.record.balance)[:count], initial=0.0)))
                if len(kept) == 2:
                    # from now on there is something to keep
                    interrupt = stack.enter_context(deferred_interrupts())
                if progress is not None:
                    progress(float(times[-1][-1]) if count else began, stop)
                if int(segment.status) >= 0:
                    status, thin = Status(int(segment.status)), bool(segment.thin)
                    break
                if interrupt.seen:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            # raised by `progress` or by a second Ctrl-C, too
            if len(kept) < 2:
                raise
            status, interrupted = Status.NOT_CONVERGED, True
        interrupt.taken()
    all_times = np.concatenate(times)
    if status == Status.CONVERGED and not thin:
        all_times[-1] = stop
    seen = jax.tree.map(lambda *leaves: jnp.asarray(np.concatenate(leaves)), *kept)
    unknown = start is not None and start.identity is None
    notes = (*((UNKNOWN,) if unknown else ()), *scene.assumptions())
    if thin:
        notes = (thin_note(float(all_times[-1]), scene.contact.film_limit), *notes)
    return LineContactHistory(
        status=jnp.asarray(int(status)),
        time=jnp.asarray(all_times),
        stop=jnp.asarray(stop, dtype=float),
        accepted=jnp.asarray(taken),
        rejected=jnp.asarray(refused),
        newton_steps=jnp.asarray(newton_steps),
        mass_balance=jnp.asarray(balance, dtype=float),
        entrainment_speed=jnp.asarray(np.concatenate(speeds)) * scales.reference_speed,
        film=FilmHistory(seen.central, seen.minimum, seen.minimum_position),
        pressure=PressureHistory(seen.central_pressure, seen.largest_pressure),
        profile=ProfileHistory(jnp.asarray(mesh(key).x) * scales.half_width, seen.pressure, seen.film),
        hertz=HertzResult(scales.half_width, scales.hertz_pressure),
        operation=scene.operation,
        last_state=state_of(motion, scales, key, scene),
        checks=range_checks(scene, scales),
        ended_thin=thin,
        interrupted=interrupted,
        notes=notes,
    )


def _length(
    scene: EHLLineContact, duration: float | None, simulation: FilmSimulation | None
) -> tuple[FilmSimulation, float]:
    chosen = simulation or scene.simulation or FilmSimulation()
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: pass one, or give the scene a simulation.duration")
    length = static_number("duration", duration, float)
    if not length > 0:
        raise ValueError(f"duration must be > 0 s, got {length:g}")
    return chosen, length


def _require_film(state: object) -> None:
    """Checks the kind of a state.

    **Raises:** `ValueError` for a state that is not one of a line contact.
    """
    if not isinstance(state, FilmState):
        kind = getattr(state, "of", type(state).__name__)
        raise ValueError(f"restart: a state of a {kind}, for a scene of a line contact")


def check_state(scene: EHLLineContact, state: Any, duration: float | None) -> None:
    """Checks a state as a run does before it begins. **Raises:** `ValueError`."""
    _require_film(state)
    chosen, length = _length(scene, duration, None)
    check_restart(scene, chosen, state, length)


def run_film(
    scene: EHLLineContact,
    duration: float | None,
    *,
    simulation: FilmSimulation | None,
    interval: float,
    throw: bool,
    progress: Callable[[float, float], None] | None,
    restart: Any,
) -> LineContactHistory:
    """See `jaxbearing.simulate`; every step is kept, whatever `interval`."""
    check_inputs(scene)
    chosen, length = _length(scene, duration, simulation)
    check_inputs(chosen)
    if isinstance(restart, LineContactHistory):
        restart = restart.last_state
    if restart is not None:
        _require_film(restart)
    # the length of the run is no part of the program
    chosen, scene = dataclasses.replace(chosen, duration=None), dataclasses.replace(scene, simulation=None)
    history = simulate_film(scene, length, chosen, start=restart, progress=progress)
    if throw:
        history.raise_if_failed()
    return history
