"""`jaxbearing report`: a solve as one HTML page."""

import dataclasses
import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .messages import NOT_CONVERGED, bad_input, refuse
from .options import DragPriorOption, JsonOption, SceneArgument, SetOption, labelled
from .output_files import Output, check_files, deliver
from .terminal import console

if TYPE_CHECKING:
    from .._scene import AbstractScene, AbstractSolution
    from ..loss_interval import PowerInterval
    from ..makers import Catalogue
    from ..report.page_content import Listing
    from ..scenes.inputs import SceneInput
    from ..scenes.states import FileState

OutOption = Annotated[
    Path | None,
    typer.Option("--out", metavar="FILE.html", help="The page; SCENE_report.html if not given."),
]
SUFFIXES = (".html", ".htm")


def report(
    scene: SceneArgument,
    changes: SetOption = None,
    out: OutOption = None,
    as_json: JsonOption = False,
    drag_prior: DragPriorOption = True,
) -> None:
    """One HTML page of a steady solve that needs no network: drawing with the loads, tables, interactive charts,
    convergence and validity. The power loss has an interval where inputs are known by a distribution only. With
    `--json` the object that `solve` prints, and the page's name on stderr."""
    target = out if out is not None else Path(f"{Path(scene).stem}_report.html")
    notes: list[str] = []
    with bad_input(notes):
        from ..scenes.bearing.catalogue import load_catalogue
        from ..scenes.inputs import scene_inputs
        from ..scenes.marks import notes_of_file
        from ..scenes.overrides import split_assignments
        from ..scenes.states import base_scene, has_states, load_states
        from ..spectrum.states import require_rated

        overrides = split_assignments(changes or [])
        model = base_scene(scene, overrides)
        states = load_states(scene, overrides) if has_states(scene) else ()
        try:
            require_rated({state.name: state.scene for state in states})
        except (TypeError, ValueError) as error:
            refuse(f"{scene}: {error}")
        inputs = scene_inputs(scene, overrides, model)
        marked = notes_of_file(scene, overrides)
        catalogue = load_catalogue(scene, overrides)
        check_files([("--out", target, SUFFIXES)])

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    notes += marked
    enable_compilation_cache()
    with without_false_alarms():
        from ..solve import solve_once

        solution = solve_once(model)
        solution = dataclasses.replace(solution, notes=(*solution.notes, *notes)) if notes else solution
        converged = bool(solution.converged)
        title = labelled(Path(scene).name, changes)
        listings = [_spectrum(states)] if states and converged else []
        interval = _interval(model, solution, scene, overrides, drag_prior) if converged else None
        page = Output(
            target,
            lambda path: _write(model, solution, title, inputs, (catalogue, listings, interval), path),
            f"wrote {target}: open it in a browser",
        )
        try:
            deliver(lambda: _show(solution, label, as_json), (page,) if converged else (), notes_to_stderr=as_json)
        except typer.Exit:
            if not as_json:
                # the results are not lost with the page
                _print_summary(solution, label, interval)
            raise
    if not converged:
        typer.echo(f"not written: {target}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _spectrum(states: "Sequence[FileState]") -> "Listing":
    """The table of the load spectrum."""
    from ..spectrum.tables import spectrum_listing
    from ..spectrum.verb import solve_states

    return spectrum_listing(
        solve_states({state.name: state.scene for state in states}, [state.share for state in states])
    )


def _interval(
    model: "AbstractScene", solution: "AbstractSolution", source: str, changes: dict[str, str], drag_prior: bool
) -> "PowerInterval | None":
    """The interval of the power loss, by the assumed distributions and those that the file and its oil have."""
    from ..loss_interval import numbers_among, power_interval
    from ..scenes.errors import SceneError
    from ..scenes.reader import load_distributions
    from ..solve import solve_once

    distributions: dict[str, Any] = {}
    with suppress(SceneError):  # a pipe cannot be read twice
        distributions |= load_distributions(source, changes)
    return power_interval(model, solution, solve_once, numbers_among(model, distributions), drag_prior)


def _show(solution: "AbstractSolution", label: str, as_json: bool) -> None:
    """The object; of a solve that failed what `solve` prints: the page, which has it otherwise, is not written then."""
    if as_json:
        from ..report.json_report import solution_to_dict

        typer.echo(json.dumps(solution_to_dict(solution), allow_nan=False))
    elif not bool(solution.converged):
        _print_summary(solution, label)


def _print_summary(solution: "AbstractSolution", label: str, interval: "PowerInterval | None" = None) -> None:
    from ..report.interval_listing import interval_lines
    from ..report.summary import print_summary

    print_summary(solution, label, console())
    for line in () if interval is None else interval_lines(interval):
        console().print(f"  {line}", markup=False, highlight=False)


def _write(
    model: "AbstractScene",
    solution: "AbstractSolution",
    title: str,
    inputs: "Mapping[str, Sequence[SceneInput]]",
    beside: "tuple[Catalogue | None, Sequence[Listing], PowerInterval | None]",
    target: Path,
) -> None:
    """**Arguments:** `beside`: the bearing in a catalogue, further tables, and the interval of the power loss."""
    from datetime import UTC, datetime

    from ..report.files import write_whole
    from ..report.html_report import html_report

    text = html_report(model, solution, title, inputs, datetime.now(UTC), *beside)
    write_whole(target, text)
