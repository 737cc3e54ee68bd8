"""Transient runs of the temperatures of a bearing of any family, computed piece by piece."""

import contextlib
import dataclasses
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from ..._identity import Identity, identity_of, require_same
from ...numerics.checks import check_inputs
from ...numerics.interrupts import Deferral, deferred_interrupts
from ...numerics.precision import as_float
from ...numerics.status import SolveError, Status
from ...numerics.structure import static_number
from ...thermal.warming_up import AHEAD, ENERGY, Reached, run_status
from ..bearing import AbstractBearing
from ..checks import input_excess
from ..heat import heat_capacities, thermal_of, unknown_capacities
from ..motion.checks import AT_SOME_TIME
from ..motion.settings import Simulation
from ..supplied import supply_notes
from ..warm import network_notes
from .history import WarmEnergy, WarmInstant, WarmState, WarmUpHistory
from .peaks import find_peaks
from .programs import ADVANCE, LOOK, Seen
from .settings import INSTANTS, MOST_INSTANTS, WarmUpSimulation

PIECE = 16
"""Number of instants that one call of the compiled programs computes."""
FIRST_STEP = 1e-3
"""First step that the integrator tries, s."""
MAY_CHANGE = ("operation", "oil", "contact", "drag", "simulation", "rating", "ring_freedom", "thermal")
"""Parts of a scene that may differ from those of the earlier run that is continued."""
ENERGY_FACTOR = 10.0
"""Error of the energy balance over the tolerance of the run above which a warning is given."""
ROTATING = (
    "simulation.rotating_load: a run of the temperatures has none; leave it out, or leave [thermal] out for a run of "
    "the rollers"
)
SLOWLY = "the bearing is in its steady state at each instant; its own motion is not simulated"
Progress = Callable[[float, float], None]


def settings_of(scene: AbstractBearing, simulation: object) -> WarmUpSimulation:
    """Settings of a run: those given, or those of the scene. A `Simulation`, which is meant for runs of the rolling
    elements, is converted.

    **Raises:** `TypeError` for an object of another class; `ValueError` for a rotating load.
    """
    chosen = getattr(scene, "simulation", None) if simulation is None else simulation
    if chosen is None:
        return WarmUpSimulation()
    if isinstance(chosen, Simulation):
        if chosen.rotating_load is not None:
            raise ValueError(ROTATING)
        return WarmUpSimulation(
            duration=chosen.duration, speed=chosen.speed, load=chosen.load, tolerance=chosen.tolerance
        )
    if not isinstance(chosen, WarmUpSimulation):
        raise TypeError(f"simulation must be a WarmUpSimulation or a Simulation, got {chosen!r}")
    return chosen


def require_capacities(scene: AbstractBearing) -> None:
    """Checks that the heat capacities of all nodes are known.

    **Raises:** `ValueError` that names the unknown heat capacities."""
    unknown = unknown_capacities(scene)
    if unknown:
        names = ", ".join(f"thermal.capacity.{name}" for name in unknown)
        raise ValueError(f"{names}: found nothing, expected a number, which a transient run needs, e.g. '500 J/K'")


def identity(scene: AbstractBearing) -> Identity:
    """The identity of the bearing: geometry, materials, cage, flanges, profile, seats."""
    return identity_of(scene, MAY_CHANGE)


def check_restart(scene: AbstractBearing, last: object) -> WarmState:
    """Checks that a state belongs to this bearing and its nodes, and returns it.

    **Raises:** `ValueError` that names the difference."""
    if not isinstance(last, WarmState):
        of = getattr(last, "of", type(last).__name__)
        raise ValueError(f"restart: a state of a {of}, for a scene of a bearing with [thermal]")
    thermal = thermal_of(scene)
    if last.nodes != thermal.node_names:
        raise ValueError(f"restart: a state of {len(last.nodes)} nodes, for a scene with {thermal.nodes}")
    if not np.all(np.isfinite(np.append(last.temperatures, last.time))):
        raise ValueError("restart: a state with numbers that are not finite")
    if last.identity is not None:
        require_same(last.identity, identity(scene), "bearing")
    return last


def wanted_times(begin: float, length: float, interval: float | None, instants: int = INSTANTS) -> np.ndarray:
    """Times of the instants after the first one, s. They are equidistant if an interval is given; otherwise their
    number is `instants`, and they are denser at the start."""
    if interval is None:
        return begin + length * np.square(np.arange(1, instants + 1) / instants)
    count = max(1, round(length / interval))
    if count > MOST_INSTANTS:
        raise ValueError(
            f"duration and interval must make at most {MOST_INSTANTS} instants, got {length:g} and {interval:g} s"
        )
    return begin + length * np.arange(1, count + 1) / count


class _Piece(NamedTuple):
    """Start and instants of a piece, s. `end_wanted` is False if the last instant is not to be kept."""

    begin: float
    times: np.ndarray
    end_wanted: bool


def pieces_of(begin: float, times: np.ndarray, kinks: np.ndarray) -> Iterator[_Piece]:
    """Yields pieces of at most `PIECE` instants. A piece also ends at each kink of the functions of time."""
    stops = np.unique(kinks[(kinks > begin) & (kinks < times[-1])])
    for until in [*stops, times[-1]]:
        inside = times[(times > begin) & (times <= until)]
        wanted = bool(inside.size) and inside[-1] == until
        inside = inside if wanted else np.append(inside, until)
        for first in range(0, inside.size, PIECE):
            part = inside[first : first + PIECE]
            yield _Piece(begin, part, wanted or first + PIECE < inside.size)
            begin = float(part[-1])


class _Done(NamedTuple):
    """Results of one piece of a run. `step_times`, `step_nodes`: times of the ends of its steps, s, and the node
    temperatures at these times, K."""

    times: np.ndarray
    seen: Seen
    energies: np.ndarray
    accepted: int
    rejected: int
    step_times: np.ndarray
    step_nodes: np.ndarray


def simulate_warm_up(
    scene: AbstractBearing,
    duration: float | None,
    *,
    simulation: object,
    interval: float | None,
    throw: bool,
    progress: Progress | None,
    restart: object,
) -> WarmUpHistory:
    """See `jaxbearing.simulate`."""
    require_capacities(scene)
    check_inputs(scene)
    chosen = settings_of(scene, simulation)
    check_inputs(chosen)
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: pass one, or give the simulation one")
    length = static_number("duration", duration, float)
    every = None if interval is None else static_number("interval", interval, float)
    if not (length > 0 and (every is None or every > 0)):
        raise ValueError(f"duration and interval must be > 0 s, got {length:g} and {every}")
    state = restart.last_state() if isinstance(restart, WarmUpHistory) else restart
    last = None if state is None else check_restart(scene, state)
    begin = 0.0 if last is None else float(last.time)
    kinks = np.concatenate([np.asarray(law.kinks(), dtype=float) for law in chosen.laws])
    # the compiled program must not depend on duration, start temperature and number of instants of the run
    laws = dataclasses.replace(chosen, duration=None, start=None, instants=INSTANTS)
    bare = scene if getattr(scene, "simulation", None) is None else dataclasses.replace(scene, simulation=None)
    scene, laws = (jax.tree.map(as_float, tree) for tree in (bare, laws))
    run = _Run(scene, laws, begin, _start(scene, chosen, last))
    pieces = list(pieces_of(begin, wanted_times(begin, length, every, chosen.instants), kinks))
    interrupted = run.follow(pieces, progress)
    history = run.history(begin + length, interrupted)
    # a user who interrupts a run wants the results so far
    if throw and not interrupted:
        history.raise_if_failed()
    return history


def _start(scene: AbstractBearing, chosen: WarmUpSimulation, last: WarmState | None) -> np.ndarray:
    if last is not None:
        return np.asarray(last.temperatures, dtype=float)
    thermal = thermal_of(scene)
    own = thermal.ambient if chosen.start is None else chosen.start
    return np.full(thermal.nodes, float(own))


class _Run:
    """A run in progress, which is continued piece by piece."""

    def __init__(self, scene: AbstractBearing, settings: WarmUpSimulation, begin: float, start: np.ndarray):
        self.scene, self.settings = scene, settings
        self.first = self.now = start
        self.step, self.status = FIRST_STEP, Status.CONVERGED
        seen = self._look(np.asarray([begin]), start[None])
        status = Status(int(seen.status[0]))
        if status != Status.CONVERGED:
            raise SolveError(f"the bearing at the start of the run was not found: {status.text}", status)
        nothing = np.zeros(0), np.zeros((0, start.size))
        self.done = [_Done(np.asarray([begin]), seen, np.zeros(3), 0, 0, *nothing)]

    def _look(self, times: np.ndarray, temperatures: np.ndarray) -> Seen:
        """The bearing at given times, s, with given node temperatures, K; at most `PIECE` times."""
        count = times.size
        fill = PIECE - count
        padded = np.pad(times, (0, fill), mode="edge"), np.pad(temperatures, ((0, fill), (0, 0)), mode="edge")
        seen = LOOK(self.scene, self.settings, *(jnp.asarray(values) for values in padded))
        return jax.tree.map(lambda leaf: np.asarray(leaf)[:count], seen)

    def follow(self, pieces: list[_Piece], progress: Progress | None) -> bool:
        """Computes the pieces until all are done, one stops early or the user interrupts. **Returns:** True if the user
        interrupted the run."""
        interrupt = Deferral()
        with contextlib.ExitStack() as stack:
            try:
                for number, piece in enumerate(pieces):
                    self._advance(piece)
                    if number == 0:
                        # from now on an interrupt ends the run but keeps its results
                        interrupt = stack.enter_context(deferred_interrupts())
                    if self.status != Status.CONVERGED:
                        break
                    if progress is not None:
                        progress(float(piece.times[-1]), float(pieces[-1].times[-1]))
                    if interrupt.seen:
                        break
            except KeyboardInterrupt:
                # raised by `progress`, or by a second Ctrl-C
                if len(self.done) == 1:
                    raise
                interrupt.seen = True
            interrupted = interrupt.seen and len(self.done) <= len(pieces)
            interrupt.taken()
        return interrupted and self.status == Status.CONVERGED

    def _advance(self, piece: _Piece) -> None:
        count = piece.times.size
        reached = self._integrated(piece.begin, self.now, piece.times, self.step)
        nodes = self.now.size
        energies, self.now = ENERGY * np.asarray(reached.last)[nodes:], np.asarray(reached.last)[:nodes]
        end, finished = piece.begin + float(reached.end), bool(reached.finished)
        good = piece.times <= end if not finished else np.full(count, True)
        if finished and not piece.end_wanted:
            good[-1] = False
        times, states = piece.times[good], np.asarray(reached.states)[:count, :nodes][good]
        if not finished:
            times, states = np.append(times, end), np.concatenate([states, self.now[None]])
        self.step = max(float(reached.end) / max(int(reached.accepted), 1), FIRST_STEP)
        if times.size > PIECE:
            times, states = times[1:], states[1:]
        seen = self._look(times, states) if times.size else jax.tree.map(lambda leaf: leaf[:0], self.done[0].seen)
        steps = int(reached.accepted), int(reached.rejected)
        ends = np.asarray(reached.step_times)
        inside = np.isfinite(ends) & np.all(np.isfinite(np.asarray(reached.step_states)), axis=1)
        within = piece.begin + ends[inside], np.asarray(reached.step_states)[inside, :nodes]
        self.done.append(_Done(times, seen, energies, *steps, *within))
        if not finished:
            self.status = self._failure(reached, end, seen)

    def _integrated(self, begin: float, nodes: np.ndarray, times: np.ndarray, step: float) -> Reached:
        """Integrates from the time `begin`, s, with the node temperatures `nodes`, K.

        **Arguments:** `times`: requested times, s, at most `PIECE`; `step`: first step that is tried, s."""
        lengths = np.pad(times - begin, (0, PIECE - times.size), mode="edge")
        # a table may have a jump at the start, of which the value after the jump is wanted
        begin = np.nextafter(begin, math.inf) if begin > 0.0 else begin
        numbers = (jnp.asarray(number, dtype=float) for number in (nodes, begin, lengths, step))
        return ADVANCE(self.scene, self.settings, *numbers)

    def _between(self, time: np.ndarray, instants: WarmInstant, index: int) -> tuple[np.ndarray, WarmInstant]:
        """The bearing at close times between the two neighbours of an instant (see `peaks.Finer`)."""
        begin, end = float(time[index - 1]), float(time[index + 1])
        times = np.linspace(begin, end, PIECE + 1)[1:]
        nodes = np.asarray(
            [getattr(instants.temperatures, name)[index - 1] for name in thermal_of(self.scene).node_names]
        )
        result = self._integrated(begin, nodes, times, (end - begin) / PIECE)
        states = np.asarray(result.states)[:, : nodes.size]
        good = np.all(np.isfinite(states), axis=1) & (times <= begin + float(result.end))
        first = jax.tree.map(lambda leaf: np.asarray(leaf)[index - 1 : index], instants)
        if not np.any(good):
            return time[index - 1 : index], first
        seen = self._look(times[good], states[good])
        solved = seen.status == Status.CONVERGED
        result = jax.tree.map(lambda head, leaf: np.concatenate([head, leaf[solved]]), first, seen.instant)
        return np.append(time[index - 1], times[good][solved]), result

    def _with_steps(self, time: np.ndarray, instants: WarmInstant) -> tuple[np.ndarray, WarmInstant]:
        """Joins the instants and the bearing at the ends of the integrator steps between them, in order of time."""
        times = np.concatenate([piece.step_times for piece in self.done])
        nodes = np.concatenate([piece.step_nodes for piece in self.done])
        between = ~np.isin(times, time) & (times > time[0]) & (times < time[-1])
        times, nodes = times[between], nodes[between]
        parts = [slice(first, first + PIECE) for first in range(0, times.size, PIECE)]
        seen = [self._look(times[part], nodes[part]) for part in parts]
        solved = [look.status == Status.CONVERGED for look in seen]
        own = [times[part][good] for part, good in zip(parts, solved, strict=True)]
        pairs = zip(seen, solved, strict=True)
        at_steps = [jax.tree.map(lambda leaf, good=good: leaf[good], look.instant) for look, good in pairs]
        whole = np.concatenate([time, *own])
        order = np.argsort(whole, kind="stable")
        joined = jax.tree.map(lambda *leaves: np.concatenate(leaves)[order], instants, *at_steps)
        return whole[order], joined

    def _failure(self, reached: Reached, end: float, seen: Seen) -> Status:
        """The status of a piece that stopped early."""
        ahead = AHEAD * float(self.settings.options.shortest_step)
        beyond = self._look(np.asarray([end + ahead]), (self.now + ahead * seen.rates[-1])[None])
        return Status(int(run_status(reached, jnp.asarray(beyond.status[0]))))

    def history(self, stop: float, interrupted: bool) -> WarmUpHistory:
        """The history of all computed pieces."""
        scene = self.scene
        instants: WarmInstant = jax.tree.map(
            lambda *leaves: jnp.asarray(np.concatenate(leaves)), *(piece.seen.instant for piece in self.done)
        )
        time = np.concatenate([piece.times for piece in self.done])
        looked_at = (time, instants, None) if interrupted else (*self._with_steps(time, instants), self._between)
        energies = np.sum([piece.energies for piece in self.done], axis=0)
        capacity = np.asarray(heat_capacities(scene))
        stored = float(np.sum(capacity * (self.now - self.first)))
        losses, to_oil, to_ambient = (float(energy) for energy in energies)
        error = (losses - to_oil - to_ambient - stored) / (losses if losses else 1.0)
        return WarmUpHistory(
            status=jnp.asarray(int(Status.NOT_CONVERGED if interrupted else self.status)),
            time=jnp.asarray(time),
            stop=jnp.asarray(stop),
            accepted=jnp.asarray(sum(piece.accepted for piece in self.done)),
            rejected=jnp.asarray(sum(piece.rejected for piece in self.done)),
            operation=scene.operation,
            instants=instants,
            energy=WarmEnergy(*(jnp.asarray(number) for number in (losses, to_oil, to_ambient, stored, error))),
            peaks=find_peaks(*looked_at),
            checks=self._checks(error),
            nodes=thermal_of(scene).node_names,
            solver=self.settings.solver,
            interrupted=interrupted,
            element_name=scene.element,
            notes=(
                SLOWLY,
                *scene.assumptions(),
                *supply_notes(scene),
                *_of_seats(scene),
                *network_notes(scene),
            ),
            identity=identity(scene),
        )

    def _checks(self, error: float) -> dict[str, Array]:
        """Warnings about the energy balance, and about the bearing at any instant."""
        most = ENERGY_FACTOR * float(self.settings.tolerance)
        text = f"the energy balance leaves more than {most:g} of the losses open: choose a smaller tolerance"
        checks = {text: jnp.asarray(abs(error) > most)}
        own = input_excess(scene=self.scene)
        for name in self.done[0].seen.checks:
            applies = any(bool(np.any(piece.seen.checks[name])) for piece in self.done)
            checks[name if name in own else type(name)(AT_SOME_TIME + name)] = jnp.asarray(applies)
        return checks


def _of_seats(scene: AbstractBearing) -> tuple[str, ...]:
    return () if scene.fits is None else scene.fits.assumptions()
