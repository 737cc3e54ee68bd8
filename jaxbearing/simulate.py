"""The verb for transient runs: a scene and a duration in, a history out."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal, overload

from ._forwarding import attributes_of
from ._scene import SIMULATED, AbstractHistory, AbstractScene
from .numerics.arguments import require_choice
from .numerics.compiling import require_outside
from .numerics.garbage import rare_garbage_collection
from .numerics.precision import require_x64

if TYPE_CHECKING:
    from .bearings.ball.motion.results import BallInstant
    from .bearings.ball.scene import BallBearing
    from .bearings.bearing import AbstractBearing
    from .bearings.cylindrical.motion.results import RollerInstant
    from .bearings.cylindrical.scene import CylindricalRollerBearing
    from .bearings.motion.family import AbstractMovingBearing
    from .bearings.motion.history import History, LastState
    from .bearings.motion.settings import Simulation
    from .bearings.tapered.scene import TaperedRollerBearing
    from .bearings.warming.history import WarmState, WarmUpHistory
    from .bearings.warming.settings import WarmUpSimulation
    from .ehl import EHLLineContact, FilmSimulation, FilmState, LineContactHistory

INTERVAL = 20e-6
"""Time between the instants of a history where a run does not say, s."""
Progress = Callable[[float, float], None]


@overload
def simulate(
    scene: "EHLLineContact",
    duration: float | None = None,
    *,
    simulation: "FilmSimulation | None" = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "LineContactHistory | FilmState | None" = None,
) -> "LineContactHistory": ...
@overload
def simulate(
    scene: "AbstractBearing",
    duration: float | None = None,
    *,
    simulation: "WarmUpSimulation",
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "WarmUpHistory | WarmState | None" = None,
) -> "WarmUpHistory": ...
@overload
def simulate(
    scene: "AbstractBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "WarmUpHistory | WarmState",
) -> "WarmUpHistory": ...
@overload
def simulate(
    scene: "BallBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "History | LastState",
) -> "History[BallInstant]": ...
@overload
def simulate(
    scene: "CylindricalRollerBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "History | LastState",
) -> "History[RollerInstant]": ...
@overload
def simulate(
    scene: "AbstractMovingBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: "History | LastState",
) -> "History": ...
@overload
def simulate(
    scene: "TaperedRollerBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: None = None,
) -> "WarmUpHistory": ...
@overload
def simulate(
    scene: "BallBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: None = None,
) -> "History[BallInstant] | WarmUpHistory": ...
@overload
def simulate(
    scene: "CylindricalRollerBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: None = None,
) -> "History[RollerInstant] | WarmUpHistory": ...
@overload
def simulate(
    scene: "AbstractBearing",
    duration: float | None = None,
    *,
    simulation: "Simulation | None" = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: None = None,
) -> "History | WarmUpHistory": ...
@overload
def simulate(
    scene: AbstractScene,
    duration: float | None = None,
    *,
    simulation: object = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: object = None,
) -> Any: ...
@rare_garbage_collection()
def simulate(
    scene: Any,
    duration: float | None = None,
    *,
    simulation: object = None,
    interval: float | None = None,
    throw: bool = True,
    progress: Progress | None = None,
    restart: object = None,
) -> AbstractHistory:
    """Run a bearing in time from the quasi-static state of its operating point, or a line contact from its steady film.

    A bearing with `[thermal]` runs in another way, whatever its family: the run is of its temperatures, from cold, and
    the bearing is in its steady state at each instant. A run of the rolling elements needs the table left out. The
    result is a `WarmUpHistory`, that of a run of rolling elements a `History`; the type of a scene does not say whether
    it has the table.
    A run of temperatures ends with the status `thermal_runaway` where a node passes `thermal.limit`.

    A run that is interrupted by Ctrl-C comes back with what was computed until then (`history.completed`); so does one
    that fails, with `throw=False`.

    **Arguments:**
    - `duration`: s; that of the scene's simulation where not given.
    - `simulation`: speeds and loads over time, solver, tolerance; the scene's where not given, or else a steady
      operating point with the default solver. Of temperatures a `WarmUpSimulation`; of a `Simulation` speed, load and
      tolerance are taken.
    - `interval`: about the time between the instants of the history, s, 20 us where not given; of a line contact every
      step is kept. Of temperatures `simulation.instants` where not given, 192 by default, closer together at the start.
    - `throw`: raise where the run stops early.
    - `progress`: called with the time reached and the time of the end, s.
    - `restart`: an earlier run, or its last state (`jaxbearing.read_last_state` of a NetCDF file): it goes on from
      there by `duration`. The clock and with it speeds and loads over time go on too. The scene may have another
      `operation`, `oil`, `contact` (laws), `drag`, `simulation` or `rating`; all that describes the bearing (geometry,
      materials, cage, flanges, profile) must be the same to 1e-9. Of a line contact `oil`, `simulation`,
      `contact.film_limit`, speed and temperature may differ; load, mesh and all else may not. A file of an earlier
      version, which does not say what it is of, is taken, and a note of the history says so. Of temperatures
      `thermal` may differ too, but for the number of nodes.

    **Raises:** `SolveError` where the quasi-static start is not found or (with `throw`) the run stops early;
    `ValueError` without a duration, for a scene that does not move or whose heat capacities are not known, inside of
    `jax.jit`, `jax.vmap` and `jax.grad` (`simulate_batch`, or `quasi_static_start` and `trajectory`, are for them), or
    for a `restart` from another bearing (the fields that differ are named, with both values); `TypeError` for another
    kind of scene.
    """
    require_x64()
    _require_moving(scene, "simulated")
    instead = f"use {_PURE} there, or " if scene.runs_in_programs else ""
    require_outside(
        "simulate",
        f"a transient run goes on piece by piece, by what it finds; {instead}call simulate outside, with plain numbers",
        (scene, duration, simulation, interval, restart),
    )
    if interval is None and getattr(scene, "thermal", None) is None:
        interval = INTERVAL
    return scene.simulated(
        duration, simulation=simulation, interval=interval, throw=throw, progress=progress, restart=restart
    )


_PURE = "simulate_batch, or quasi_static_start and trajectory,"


def _require_moving(scene: object, method: str) -> None:
    """**Raises:** `TypeError` for what is no scene, or for a kind that does not move."""
    if isinstance(scene, AbstractScene) and getattr(type(scene), method) is not getattr(AbstractScene, method):
        return
    name, taken = "simulate", SIMULATED
    if method == "simulated_batch":
        name, taken = ("simulate_batch", "a ball or cylindrical roller bearing with contact.traction")
    raise TypeError(f"cannot simulate a {type(scene).__name__}; {name} takes: {taken}")


@overload
def simulate_batch(
    scene: "BallBearing",
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: "Simulation | None" = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> "History[BallInstant]": ...
@overload
def simulate_batch(
    scene: "CylindricalRollerBearing",
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: "Simulation | None" = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> "History[RollerInstant]": ...
@overload
def simulate_batch(
    scene: "AbstractMovingBearing",
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: "Simulation | None" = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> "History": ...
@overload
def simulate_batch(
    scene: AbstractScene,
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: object = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> Any: ...
@rare_garbage_collection()
def simulate_batch(
    scene: Any,
    duration: float,
    over: Mapping[str, object],
    *,
    simulation: object = None,
    interval: float = INTERVAL,
    method: Literal["map", "vmap"] = "map",
) -> Any:
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
    _require_moving(scene, "simulated_batch")
    require_choice("method", method, ("map", "vmap"))
    return scene.simulated_batch(duration, over, simulation=simulation, interval=interval, method=method)


__getattr__ = attributes_of(__name__)
