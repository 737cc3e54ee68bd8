"""`jaxbearing solve`: one steady state on the screen, as JSON, as a picture, as a file."""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from .messages import NO_OUTPUT, NOT_CONVERGED, bad_input, refuse, say
from .terminal import console

SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="A scene file (TOML), or the name of a built-in scene.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Change a field of the scene, e.g. --set operation.inner_speed='12000 rpm'; the value none takes an "
        "optional table or field out. May be repeated.",
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object in SI units, and nothing else.")]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.nc", help="Write all results, with units, as NetCDF.")
]
PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot", metavar="FILE", help="Draw power loss, loads and films, or traction curves; .png, .svg or .pdf."
    ),
]
SensitivitiesOption = Annotated[
    bool,
    typer.Option(
        "--sensitivities",
        help="Also by how much each input moves power loss and cage slip (the first time, this compiles for about a "
        "minute).",
    ),
]


def solve(
    scene: SceneArgument,
    changes: SetOption = None,
    as_json: JsonOption = False,
    sensitivities: SensitivitiesOption = False,
    plot: PlotOption = None,
    out: OutOption = None,
) -> None:
    """Steady state: power loss, loads, films, pressures, speeds; of a two-disk machine, its traction curves."""
    with bad_input():
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        model = load_scene(scene, split_assignments(changes or []))
        _check_files(plot, out)
        if sensitivities and not getattr(model, "slips", False):
            refuse(
                "--sensitivities: found a scene without power loss; expected a bearing with contact.traction and a cage"
            )

    from .cache import enable_compilation_cache
    from .interrupt import prompt_interrupt
    from .quiet import without_false_alarms

    label = " ".join([scene, *(f"--set {change}" for change in changes or [])])
    enable_compilation_cache()
    with prompt_interrupt(), without_false_alarms():
        solution, slopes = _solved(model, sensitivities)
        failure = "" if bool(solution.converged) else solution.failure()
        if not failure:
            # files first: what cannot be written is said before results scroll by
            _write_files(solution, label, plot, out)
        _print_json(solution, slopes) if as_json else _print_screen(solution, slopes, label)
    if failure:
        left_out = [str(path) for path in (plot, out) if path is not None]
        if left_out:
            typer.echo(f"not written: {', '.join(left_out)}", err=True)
        if as_json:
            typer.echo(f"not converged: {label}: {failure}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _solved(model: Any, sensitivities: bool) -> tuple[Any, Any]:
    if sensitivities:
        from ..sensitivity import sensitivities_once

        return sensitivities_once(model)
    from ..solve import solve_once

    return solve_once(model), None


def _check_files(plot: Path | None, out: Path | None) -> None:
    """Refuse a name that cannot be written before the solve, not after it."""
    from ..scenes.errors import one_of

    for option, path, suffixes in (("--plot", plot, (".png", ".svg", ".pdf")), ("--out", out, (".nc",))):
        if path is None:
            continue
        if path.suffix.lower() not in suffixes:
            refuse(f"{option}: found '{path}'; expected a file name that ends in {one_of(suffixes)}")
        if not path.parent.is_dir() or path.is_dir():
            refuse(f"{option}: found '{path}'; expected a file in an existing folder")
        with _writing(path):
            _try_to_write(path)


def _try_to_write(path: Path) -> None:
    """**Raises:** `OSError` where no file can be made, or one that is there is write-protected."""
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(13, "Permission denied")
    tempfile.TemporaryFile(dir=path.parent).close()


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Turns what keeps a file from being written into one message and exit code 1."""
    try:
        yield
    except OSError as error:
        message = f"the output cannot be written: {path}: {error.strerror or error}"
        raise typer.Exit(say(message, NO_OUTPUT)) from None


def _write_files(solution: Any, label: str, plot: Path | None, out: Path | None) -> None:
    if out is not None:
        from ..report.dataset import solution_to_dataset, write_netcdf

        with _writing(out):
            write_netcdf(solution_to_dataset(solution), out)
    if plot is not None:
        from ..report.plots import plot_solution, save_plot

        with _writing(plot):
            save_plot(plot_solution(solution, label), plot)


def _print_json(solution: Any, slopes: Any) -> None:
    from ..report.json_report import sensitivities_to_dict, solution_to_dict

    results = solution_to_dict(solution)
    if slopes is not None:
        results["sensitivities"] = sensitivities_to_dict(slopes)
    typer.echo(json.dumps(results, allow_nan=False))


def _print_screen(solution: Any, slopes: Any, label: str) -> None:
    from ..report.summary import print_summary

    print_summary(solution, label, console())
    if slopes is not None and bool(solution.converged):
        from ..report.sensitivity_table import print_sensitivities

        print_sensitivities(slopes, console())
