"""`jaxbearing compare`: makers' friction formulas beside the losses of a bearing."""

import json
from typing import TYPE_CHECKING

import typer

from .messages import NOT_CONVERGED, bad_input, refuse
from .options import ColumnsOption, JsonOption, SceneArgument, SetOption, labelled
from .output_files import deliver
from .terminal import console

if TYPE_CHECKING:
    from ..makers import Comparison


def compare(
    scene: SceneArgument, changes: SetOption = None, as_json: JsonOption = False, full: ColumnsOption = False
) -> None:
    """Friction by the formulas of makers (SKF, Palmgren with the constants of INA and Timken, Timken) beside the losses
    of a bearing: totals, parts, ranges that are left. What the formulas need beside the scene is said in its table
    [catalogue], e.g. --set catalogue.designation=6205-2RSH. No result depends on it."""
    with bad_input():
        from ..bearings.bearing import AbstractBearing
        from ..scenes.bearing.catalogue import load_catalogue
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        overrides = split_assignments(changes or [])
        model = load_scene(scene, overrides)
        if not isinstance(model, AbstractBearing):
            refuse(
                f"SCENE: found '{scene}', a {type(model).__name__}; expected a bearing, of which makers have formulas"
            )
        catalogue = load_catalogue(scene, overrides)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with without_false_alarms():
        from ..makers import compared
        from ..solve import solve_once

        solution = solve_once(model)
        if not bool(solution.converged):
            _print_failure(solution, label, as_json)
            raise typer.Exit(NOT_CONVERGED)
        comparison = compared(model, solution, catalogue)
        deliver(lambda: _print(comparison, label, as_json, full), ())


def _print(comparison: "Comparison", label: str, as_json: bool, full: bool) -> None:
    from ..report.makers_table import comparison_to_dict, print_comparison

    if as_json:
        typer.echo(json.dumps(comparison_to_dict(comparison), allow_nan=False))
    else:
        print_comparison(comparison, label, console(), full)


def _print_failure(solution: object, label: str, as_json: bool) -> None:
    from ..bearings.solution import Solution
    from ..numerics.status import Status

    assert isinstance(solution, Solution)
    failure, status = solution.failure(), Status(int(solution.status))
    if as_json:
        typer.echo(json.dumps({"converged": False, "status": status.name.lower(), "failure": failure}))
        typer.echo(f"not converged: {label}: {failure}", err=True)
        return
    from ..report.backends.screen import print_failure

    print_failure(label, status.text, failure, console())
