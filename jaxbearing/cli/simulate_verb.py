"""`jaxbearing simulate`: a run in time on the screen, as JSON, as a picture, as a file."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from .messages import INTERRUPTED, NOT_CONVERGED, bad_input, refuse
from .options import JsonOption, SceneArgument, SetOption, labelled
from .output_files import PICTURES, check_files, writing
from .terminal import console

Duration = Annotated[
    str | None,
    typer.Option("--duration", metavar="TIME", help="Of the run, e.g. '50 ms'; that of the scene if not given."),
]
Interval = Annotated[
    str, typer.Option("--interval", metavar="TIME", help="About the time between the results that are kept.")
]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.nc", help="Write all results over time, with units, as NetCDF.")
]
PlotOption = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw orbit, speeds, loads and power; .png, .svg or .pdf."),
]


def simulate(
    scene: SceneArgument,
    duration: Duration = None,
    changes: SetOption = None,
    as_json: JsonOption = False,
    interval: Interval = "20 us",
    plot: PlotOption = None,
    out: OutOption = None,
) -> None:
    """A run in time, from the steady state of the operating point: motion of rolling elements and cage, shocks between
    them, power. Ctrl-C ends the run and keeps what was computed."""
    with bad_input():
        from ..scenes.errors import SceneError
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        model: Any = load_scene(scene, split_assignments(changes or []))
        length = None if duration is None else _time("--duration", duration)
        every = _time("--interval", interval)
        if length is None and getattr(getattr(model, "simulation", None), "duration", None) is None:
            raise SceneError("--duration", "", "nothing", "a time with a unit, e.g. '50 ms'")
        if not getattr(model, "slips", False) or not hasattr(model, "simulation"):
            refuse(f"SCENE: found '{scene}'; expected a cylindrical roller bearing with contact.traction")
        check_files((("--plot", plot, PICTURES), ("--out", out, (".nc",))))

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with without_false_alarms():
        from ..numerics.status import SolveError
        from ..simulate import simulate as run

        try:
            with _progress(as_json) as progress:
                history = run(model, length, interval=every, throw=False, progress=progress)
        except SolveError as error:
            _no_start(str(error), label, as_json)
            raise typer.Exit(NOT_CONVERGED) from None
        _write_files(history, label, plot, out)
        _print(history, label, as_json)
    if not history.completed:
        raise typer.Exit(INTERRUPTED if history.interrupted else NOT_CONVERGED)


def _time(option: str, text: str) -> float:
    from pydantic_core import PydanticCustomError

    from ..scenes.errors import SceneError
    from ..scenes.units import TIME, quantity

    try:
        return quantity(text.strip(), TIME, "> 0")
    except PydanticCustomError as error:
        context = error.context or {}
        raise SceneError(option, "", context["found"], context["expected"]) from None


@contextmanager
def _progress(as_json: bool) -> Iterator[Callable[[float, float], None] | None]:
    """A bar on the terminal; nothing where nobody looks."""
    if as_json or not sys.stdout.isatty():
        yield None
        return
    from rich.progress import Progress

    with Progress(console=console(), transient=True) as bar:
        task = bar.add_task("start and compilation", total=None)

        def show(reached: float, stop: float) -> None:
            text = f"{1e3 * reached:.4g} of {1e3 * stop:.4g} ms"
            bar.update(task, description=text, total=stop, completed=reached)

        yield show


def _write_files(history: Any, label: str, plot: Path | None, out: Path | None) -> None:
    if out is not None:
        from ..report.dataset import write_netcdf
        from ..report.history_dataset import history_to_dataset

        with writing(out):
            write_netcdf(history_to_dataset(history), out)
    if plot is not None:
        from ..report.history_plots import plot_history
        from ..report.plots import save_plot

        with writing(plot):
            save_plot(plot_history(history, label), plot)


def _print(history: Any, label: str, as_json: bool) -> None:
    from ..report.history_summary import history_to_dict, print_history

    if as_json:
        typer.echo(json.dumps(history_to_dict(history), allow_nan=False))
        if not history.completed:
            typer.echo(f"not completed: {label}: {history.failure()}", err=True)
    else:
        print_history(history, label, console())


def _no_start(message: str, label: str, as_json: bool) -> None:
    if as_json:
        empty = {"completed": False, "status": "not_converged", "time": None, "steps": None, "energy_error": None}
        typer.echo(json.dumps(empty | {"failure": message, "summary": {}}))
    typer.echo(f"not converged: {label}: {message}", err=True)
