"""`jaxbearing solve`: one steady state on the screen, as JSON, as a picture, as a file."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from .messages import NOT_CONVERGED, bad_input, refuse
from .options import JsonOption, SceneArgument, SetOption, labelled
from .output_files import PICTURES, check_files, writing
from .terminal import console

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
        check_files((("--plot", plot, PICTURES), ("--out", out, (".nc",))))
        if sensitivities and not getattr(model, "slips", False):
            refuse(
                "--sensitivities: found a scene without power loss; expected a bearing with contact.traction (and a "
                "cage, if it is of rollers)"
            )

    from .cache import enable_compilation_cache
    from .interrupt import prompt_interrupt
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
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


def _write_files(solution: Any, label: str, plot: Path | None, out: Path | None) -> None:
    if out is not None:
        from ..report.dataset import solution_to_dataset, write_netcdf

        with writing(out):
            write_netcdf(solution_to_dataset(solution), out)
    if plot is not None:
        from ..report.plots import plot_solution, save_plot

        with writing(plot):
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
