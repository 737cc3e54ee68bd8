"""`jaxbearing simulate`: a transient run on the screen, as JSON, as a picture, as a file."""

import json
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .interrupt import if_interrupted, tell
from .messages import INTERRUPTED, NOT_CONVERGED, bad_input, refuse
from .options import JsonOption, SceneArgument, SetOption, labelled, option_quantity
from .output_files import PICTURES, Output, check_files, deliver
from .terminal import console

if TYPE_CHECKING:
    from .._scene import AbstractScene
    from ..bearings.motion.family import AbstractMovingBearing
    from ..bearings.motion.history import History, LastState
    from ..bearings.warming.history import WarmState, WarmUpHistory
    from ..ehl import LineContactHistory
    from ..ehl.last_state import FilmState
    from ..numerics.status import SolveError

ANIMATIONS = (".gif", ".html", ".mp4")
Progress = Callable[[float, float], None]
Duration = Annotated[
    str | None,
    typer.Option("--duration", metavar="TIME", help="Of the run, e.g. '50 ms'; that of the scene if not given."),
]
Interval = Annotated[
    str | None,
    typer.Option(
        "--interval",
        metavar="TIME",
        help="Of a bearing: about the time between the results that are kept, 20 us if not given; of temperatures 192 "
        "results if not given, closer together at the start.",
    ),
]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.nc", help="Write all results over time, with units, as NetCDF.")
]
PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="FILE",
        help="Draw orbit, speeds, loads and power, or temperatures or films over time; .png, .svg or .pdf.",
    ),
]
AnimationOption = Annotated[
    Path | None,
    typer.Option(
        "--animation",
        metavar="FILE",
        help="Show rollers, cage and loads, temperatures, or pressure and film, in motion; .gif, .html, or .mp4 (needs "
        "ffmpeg).",
    ),
]
RestartOption = Annotated[
    Path | None,
    typer.Option(
        "--restart", metavar="FILE.nc", help="Go on, by the duration, from the end of an earlier run that --out wrote."
    ),
]


def simulate(
    scene: SceneArgument,
    duration: Duration = None,
    changes: SetOption = None,
    as_json: JsonOption = False,
    interval: Interval = None,
    plot: PlotOption = None,
    out: OutOption = None,
    animation: AnimationOption = None,
    restart: RestartOption = None,
) -> None:
    """A transient run, from the steady state of the operating point: motion of rolling elements and cage, shocks
    between them, power; of a bearing with [thermal], its temperatures from cold; of a line contact, the film while its
    speed changes. Ctrl-C ends the run and keeps what was computed."""
    with bad_input():
        from .._scene import SIMULATED
        from ..ehl import EHLLineContact
        from ..scenes.errors import SceneError
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene
        from ..scenes.units import TIME

        model: Any = load_scene(scene, split_assignments(changes or []))
        length = None if duration is None else option_quantity("--duration", duration, TIME, "> 0")
        every = None if interval is None else option_quantity("--interval", interval, TIME, "> 0")
        if length is None and getattr(getattr(model, "simulation", None), "duration", None) is None:
            raise SceneError("--duration", "", "nothing", "a time with a unit, e.g. '50 ms'")
        film, warms = isinstance(model, EHLLineContact), _warms(model)
        if not film and not warms and not (getattr(model, "slips", False) and model.runs_in_programs):
            refuse(f"SCENE: found '{scene}', a {model.kind.replace('_', ' ')} without these; expected {SIMULATED}")
        if film and every is not None:
            refuse(
                f"--interval: found '{interval}' for a line contact; expected none: every step is kept "
                "(simulation.tolerance says how long they are)"
            )
        if warms:
            _check_warm_up(model, length, every)
        elif not film:
            _check_motion(model, length or float(model.simulation.duration), every)
        last = None if restart is None else _last_state(restart, model, scene, length)
        check_files((("--plot", plot, PICTURES), ("--out", out, (".nc",)), ("--animation", animation, ANIMATIONS)))
        _check_animation(animation)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with without_false_alarms():
        from ..numerics.status import SolveError
        from ..simulate import simulate as run

        try:
            unit = ("min", 1.0 / 60.0) if warms else ("ms", 1e3)
            with _progress(as_json, "start and compilation", *unit) as shown:

                def progress(reached: float, stop: float) -> None:
                    # for a second Ctrl-C
                    if_interrupted("what was computed is not kept")
                    if shown is not None:
                        shown(reached, stop)

                more: Any = {} if every is None else {"interval": every}
                history = run(model, length, throw=False, progress=progress, restart=last, **more)
        except SolveError as error:
            _no_start(error, model, length, label, as_json)
            raise typer.Exit(NOT_CONVERGED) from None
        outputs = (
            Output(out, lambda path: _write_data(history, path)),
            Output(plot, lambda path: _write_plot(history, label, path), long=True),
            Output(animation, lambda path: _animate(history, model, label, path, as_json), long=True),
        )
        deliver(lambda: _print(history, label, as_json), outputs, as_json=as_json)
    if not history.completed:
        if history.interrupted:
            tell(elsewhere=True)
        raise typer.Exit(INTERRUPTED if history.interrupted else NOT_CONVERGED)


def _warms(model: object) -> bool:
    """True for a bearing with a thermal network; that of a shaft has no transient run."""
    from ..bearings.bearing import AbstractBearing

    return isinstance(model, AbstractBearing) and model.thermal is not None


def _check_motion(model: "AbstractMovingBearing", length: float, every: float | None) -> None:
    """Refuses a run of moving elements with too many instants, and a scene or settings that it cannot have."""
    from ..bearings.motion.runs import MOST_INSTANTS, requested
    from ..simulate import INTERVAL

    if length / (every or INTERVAL) > MOST_INSTANTS:
        refuse(
            f"--duration: found {length:g} s with results every {every or INTERVAL:g} s; expected at most "
            f"{MOST_INSTANTS} results: choose a longer --interval"
        )
    try:
        requested(model, length, None, every or INTERVAL)
    except ValueError as error:
        refuse(str(error))


def _check_warm_up(model: Any, length: float | None, every: float | None) -> None:
    """Refuses a run of temperatures whose heat capacities are not known, or with too many instants."""
    from ..bearings.warming.runs import require_capacities, settings_of, wanted_times
    from ..numerics.structure import static_number

    try:
        require_capacities(model)
        # without a length of its own the scene has one
        settings = settings_of(model, None)
        duration = settings.duration if length is None else length
        wanted_times(0.0, static_number("duration", duration, float), every, settings.instants)
    except ValueError as error:
        refuse(str(error))


def _check_animation(path: Path | None) -> None:
    """Refuses a film that needs ffmpeg before the run, if ffmpeg is missing."""
    if path is not None and path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        refuse(
            f"--animation: found '{path}'; expected .gif or .html: .mp4 needs the program ffmpeg, which is not there"
        )


def _last_state(
    path: Path, model: "AbstractScene", scene: str, duration: float | None
) -> "LastState | FilmState | WarmState":
    """The end of an earlier run, checked against the scene."""
    from ..report.last_state import read_last_state

    wanted = "a NetCDF file of an earlier run of this scene, as --out writes it"
    try:
        last = read_last_state(path)
        model.check_restart(last, duration)
    except OSError as error:
        refuse(f"--restart: found '{path}', which cannot be read ({error.strerror or error}); expected {wanted}")
    except ValueError as error:
        reason = str(error).removeprefix("restart: ").removeprefix(f"{path} ")
        refuse(f"--restart: found '{path}' for '{scene}': {reason}; expected {wanted}")
    return last


@contextmanager
def _progress(as_json: bool, begin: str, unit: str = "ms", factor: float = 1e3) -> Iterator[Progress | None]:
    """Progress bar on a terminal; otherwise nothing is shown."""
    if as_json or not sys.stdout.isatty():
        yield None
        return
    from rich.progress import Progress as Bar

    with Bar(console=console(), transient=True) as bar:
        task = bar.add_task(begin, total=None)

        def show(reached: float, stop: float) -> None:
            text = f"{factor * reached:.4g} of {factor * stop:.4g} {unit}"
            bar.update(task, description=text, total=stop, completed=reached)

        yield show


def _animate(
    history: "History | LineContactHistory | WarmUpHistory",
    model: "AbstractScene",
    label: str,
    path: Path,
    as_json: bool,
) -> None:
    from ..report.backends.matplotlib.animations import save_animation
    from ..report.histories import animate_history

    with _progress(as_json, "drawing", "pictures", 1.0) as progress:
        save_animation(animate_history(history, model, label), path, progress)


def _write_data(history: "History | LineContactHistory | WarmUpHistory", out: Path) -> None:
    from ..report.dataset import write_netcdf
    from ..report.histories import history_to_dataset

    write_netcdf(history_to_dataset(history), out)


def _write_plot(history: "History | LineContactHistory | WarmUpHistory", label: str, plot: Path) -> None:
    from ..report.histories import plot_history
    from ..report.plots import save_plot

    save_plot(plot_history(history, label), plot)


def _print(history: "History | LineContactHistory | WarmUpHistory", label: str, as_json: bool) -> None:
    from ..report.histories import history_to_dict, print_history

    if as_json:
        typer.echo(json.dumps(history_to_dict(history), allow_nan=False))
        if not history.completed:
            typer.echo(f"not completed: {label}: {history.failure()}", err=True)
    else:
        print_history(history, label, console())


def _no_start(error: "SolveError", model: "AbstractScene", length: float | None, label: str, as_json: bool) -> None:
    if as_json:
        from ..report.histories import not_begun_to_dict

        typer.echo(json.dumps(not_begun_to_dict(model, length, error), allow_nan=False))
    typer.echo(f"not converged: {label}: {error}", err=True)
