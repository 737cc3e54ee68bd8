"""The verb for runs in time: a scene and a duration in, a history out."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any, Literal, overload

from .bearings.cylindrical.scene import CylindricalRollerBearing
from .bearings.motion.history import History, LastState
from .bearings.motion.run import check_fits
from .bearings.motion.runs import FIELD, INTERVAL, simulate_roller_batch, simulate_rollers, trajectory
from .bearings.motion.settings import Simulation
from .ehl import EHLLineContact, FilmSimulation, FilmState, LineContactHistory, simulate_film
from .ehl import check_restart as check_film_restart
from .numerics.arguments import require_choice, require_outside
from .numerics.checks import check_inputs
from .numerics.garbage import rare_garbage_collection
from .numerics.precision import require_x64
from .numerics.structure import static_number

__all__ = ["FIELD", "INTERVAL", "check_restart", "simulate", "simulate_batch", "trajectory"]

Progress = Callable[[float, float], None]


@overload
def simulate(
    scene: EHLLineContact,
    duration: float | None = None,
    *,
    simulation: FilmSimulation | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: LineContactHistory | FilmState | None = None,
) -> LineContactHistory: ...
@overload
def simulate(
    scene: CylindricalRollerBearing,
    duration: float | None = None,
    *,
    simulation: Simulation | None = None,
    interval: float = INTERVAL,
    throw: bool = True,
    progress: Progress | None = None,
    restart: History | LastState | None = None,
) -> History: ...
@rare_garbage_collection()
def simulate(
    scene: Any,
    duration: float | None = None,
    *,
    simulation: Any = None,
    interval: float = INTERVAL,
    throw: bool = True,
    progress: Progress | None = None,
    restart: Any = None,
) -> Any:
    """Run a bearing in time from the quasi-static state of its operating point, or a line contact from its steady film.

    A run that is interrupted by Ctrl-C comes back with what was computed until then (`history.completed`); so does one
    that fails, with `throw=False`.

    **Arguments:**
    - `duration`: s; that of the scene's simulation where not given.
    - `simulation`: speeds and loads over time, solver, tolerance; the scene's where not given, or else a steady
      operating point with the default solver.
    - `interval`: about the time between the instants of the history, s; of a line contact every step is kept.
    - `throw`: raise where the run stops early.
    - `progress`: called with the time reached and the time of the end, s.
    - `restart`: an earlier run, or its last state (`jaxbearing.read_last_state` of a NetCDF file): it goes on from
      there by `duration`. The clock and with it speeds and loads over time go on too. The scene may have another
      `operation`, `oil`, `contact` (laws), `drag`, `simulation` or `rating`; all that describes the bearing (geometry,
      materials, cage, flanges, profile) must be the same to 1e-9. Of a line contact `oil`, `simulation`,
      `contact.film_limit`, speed and temperature may differ; load, mesh and all else may not. A file of an earlier
      version, which does not say what it is of, is taken, and a note of the history says so.

    **Raises:** `SolveError` where the quasi-static start is not found or (with `throw`) the run stops early;
    `ValueError` without a duration, for a scene that does not move, inside of `jax.jit`, `jax.vmap` and `jax.grad`
    (`simulate_batch`, or `quasi_static_start` and `trajectory`, are for them), or for a `restart` from another bearing
    (the fields that differ are named, with both values); `TypeError` for another kind of scene.
    """
    require_x64()
    instead = "" if isinstance(scene, EHLLineContact) else f"use {_PURE} there, or "
    require_outside(
        "simulate",
        f"a run in time goes on piece by piece, by what it finds; {instead}call simulate outside, with plain numbers",
        (scene, duration, simulation, interval, restart),
    )
    if isinstance(scene, EHLLineContact):
        return _run_film(scene, duration, simulation, restart, throw, progress)
    if not isinstance(scene, CylindricalRollerBearing):
        taken = "CylindricalRollerBearing, EHLLineContact"
        raise TypeError(f"cannot simulate a {type(scene).__name__}; simulate takes: {taken}")
    if isinstance(restart, LineContactHistory | FilmState):
        raise ValueError(_OTHER_KIND.format("line contact", "bearing"))
    if not isinstance(restart, History | LastState | None):
        raise TypeError(f"restart must be a History or a LastState (jb.read_last_state of a file), got {restart!r}")
    if not isinstance(simulation, Simulation | None):
        raise TypeError(f"simulation must be a Simulation, got {simulation!r}")
    return simulate_rollers(
        scene, duration, simulation=simulation, interval=interval, throw=throw, progress=progress, restart=restart
    )


_PURE = "simulate_batch, or quasi_static_start and trajectory,"
_OTHER_KIND = "restart: a state of a {}, for a scene of a {}"


def check_restart(scene: Any, restart: LastState | FilmState, duration: float | None = None) -> None:
    """Checks a last state as `simulate` does, before it begins. **Raises:** `ValueError`."""
    if isinstance(scene, EHLLineContact):
        if not isinstance(restart, FilmState):
            raise ValueError(_OTHER_KIND.format("bearing", "line contact"))
        chosen, length = _length(scene, duration, None)
        check_film_restart(scene, chosen, restart, length)
    else:
        if not isinstance(restart, LastState):
            raise ValueError(_OTHER_KIND.format("line contact", "bearing"))
        check_fits(scene, restart)


def _length(
    scene: EHLLineContact, duration: float | None, simulation: FilmSimulation | None
) -> tuple[FilmSimulation, float]:
    chosen = simulation or scene.simulation or FilmSimulation()
    duration = duration if duration is not None else chosen.duration
    if duration is None:
        raise ValueError("simulate needs a duration: give it, or name it in the scene's simulation")
    length = static_number("duration", duration, float)
    if not length > 0:
        raise ValueError(f"duration must be > 0 s, got {length:g}")
    return chosen, length


def _run_film(
    scene: EHLLineContact,
    duration: float | None,
    simulation: FilmSimulation | None,
    restart: Any,
    throw: bool,
    progress: Progress | None,
) -> LineContactHistory:
    check_inputs(scene)
    chosen, length = _length(scene, duration, simulation)
    check_inputs(chosen)
    if isinstance(restart, LineContactHistory):
        restart = restart.last_state
    if not isinstance(restart, FilmState | None):
        raise ValueError(_OTHER_KIND.format("bearing", "line contact"))
    # the length of the run is no part of the program
    chosen, scene = dataclasses.replace(chosen, duration=None), dataclasses.replace(scene, simulation=None)
    history = simulate_film(scene, length, chosen, start=restart, progress=progress)
    if throw:
        history.raise_if_failed()
    return history


@rare_garbage_collection()
def simulate_batch(
    scene: CylindricalRollerBearing,
    duration: float,
    over: Mapping[str, Any],
    *,
    simulation: Simulation | None = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> History:
    """Many runs at once, each with a status of its own: a run that fails leaves the others alone. Pure.

    The result is a `History` with the lanes in front of every array (`history.status`, `history.instants.cage.speed`
    of shape (lane, time)); beyond the place where a lane stopped it is NaN. `history.lane(3)` is one of them, for
    files and plots. Compiled once for a number of lanes and of instants:

        speeds = jnp.linspace(800.0, 1600.0, 8)
        runs = jb.simulate_batch(scene, 5e-3, {"operation.inner_speed": speeds})
        runs.converged  # which lanes reached the end
        runs.instants.cage.slip[:, -1]

    **Arguments:**
    - `over`: dotted paths of the scene -> values, as many for each; "simulation.load" and the like take time laws
      whose leaves have the lanes in front.
    - `duration`, `interval`, `simulation`: as in `simulate`.
    - `method`: "map" runs lane by lane, "vmap" all in step, each waiting for the one with most steps. Lanes are shared
      out among all local devices where they divide; on a CPU let JAX have as many as there are cores, before anything
      runs on it: `jax.config.update("jax_num_cpu_devices", 2)`. Measured, 32 lanes of 5 ms from 15 to 30 kN, a lane:
      "map" 75 ms on one device and 43 on two, "vmap" 102 and 52; in batches of nearly equal lanes "vmap" overtakes.

    **Raises:** as `simulate`, but not for a run that fails; `ValueError` where the values are not equally many.
    """
    require_x64()
    if not isinstance(scene, CylindricalRollerBearing):
        raise TypeError(f"cannot simulate a {type(scene).__name__}; simulate_batch takes: CylindricalRollerBearing")
    require_choice("method", method, ("map", "vmap"))
    return simulate_roller_batch(scene, duration, over, simulation=simulation, interval=interval, method=method)
