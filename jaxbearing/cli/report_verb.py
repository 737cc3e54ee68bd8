"""`jaxbearing report`: a solve as one HTML page."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from .messages import NOT_CONVERGED, bad_input
from .options import JsonOption, SceneArgument, SetOption, labelled
from .output_files import check_files, writing
from .terminal import console

OutOption = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE.html", help="The page; SCENE_report.html if not given."),
]
SUFFIXES = (".html", ".htm")


def report(scene: SceneArgument, changes: SetOption = None, out: OutOption = None, as_json: JsonOption = False) -> None:
    """One HTML page of a steady solve that needs no network: drawing with the loads, tables, interactive charts,
    convergence and validity. With `--json` the object that `solve` prints, and the page's name on stderr."""
    target = out if out is not None else Path(f"{Path(scene).stem}_report.html")
    with bad_input():
        from ..scenes.inputs import scene_inputs
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        overrides = split_assignments(changes or [])
        model = load_scene(scene, overrides)
        inputs = scene_inputs(scene, overrides, model)
        check_files([("--out", target, SUFFIXES)])

    from .cache import enable_compilation_cache
    from .interrupt import prompt_interrupt
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with prompt_interrupt(), without_false_alarms():
        from ..solve import solve_once

        solution = solve_once(model)
        if bool(solution.converged):
            _write(model, solution, labelled(Path(scene).name, changes), inputs, target)
            typer.echo(f"wrote {target}: open it in a browser", err=as_json)
        if as_json:
            from ..report.json_report import solution_to_dict

            typer.echo(json.dumps(solution_to_dict(solution), allow_nan=False))
        elif not bool(solution.converged):
            from ..report.summary import print_summary

            print_summary(solution, label, console())
    if not bool(solution.converged):
        typer.echo(f"not written: {target}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _write(model: Any, solution: Any, title: str, inputs: Any, target: Path) -> None:
    from datetime import UTC, datetime

    from ..report.files import appearing_whole
    from ..report.html_report import html_report

    text = html_report(model, solution, title, inputs, datetime.now(UTC))
    with writing(target), appearing_whole(target) as temporary:
        temporary.write_text(text, encoding="utf-8")
