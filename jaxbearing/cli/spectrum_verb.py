"""`jaxbearing spectrum`: life of a bearing under the load spectrum of its scene file."""

import dataclasses
import json
import time
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .completion import assignments
from .messages import NOT_CONVERGED, bad_input, refuse
from .options import ColumnsOption, JsonOption, SceneArgument, SetOption, labelled
from .output_files import deliver
from .terminal import console

if TYPE_CHECKING:
    from ..scenes.states import FileState
    from ..spectrum import Spectrum
    from ..sweeps.fields import Field

OverOption = Annotated[
    str | None,
    typer.Option(
        "--over",
        metavar="NAME=START:STOP:COUNT[:log]",
        help="A field and its values, e.g. geometry.diametral_clearance='0 um:30 um:7': the life at each of them.",
        autocompletion=assignments,
    ),
]


def spectrum(
    scene: SceneArgument,
    changes: SetOption = None,
    over: OverOption = None,
    as_json: JsonOption = False,
    full: ColumnsOption = False,
) -> None:
    """Life under the load spectrum of a scene file: its [[state]] tables, each with a name, a share of the time and
    changes of the scene, solved with one program. The damages of all states are added (Palmgren and Miner). Prints
    share, life, loss, pressure and static safety by state, then the life, the equivalent load and the state that
    governs; with --over the life at each value of a field."""
    begin = time.monotonic()
    notes: list[str] = []
    with bad_input(notes):
        from ..scenes.marks import notes_of_file
        from ..scenes.overrides import split_assignments
        from ..scenes.states import load_states
        from ..spectrum.states import require_rated

        overrides = split_assignments(changes or [])
        varied = None if over is None else _values(scene, over, overrides)
        texts = [{}] if varied is None else [{varied[0].path: varied[0].text(value)} for value in varied[1]]
        cases = [load_states(scene, {**overrides, **text}) for text in texts]
        marked = notes_of_file(scene, {**overrides, **texts[0]})
        try:
            for states in cases:
                require_rated(_scenes(states))
        except (TypeError, ValueError) as error:
            refuse(f"{scene}: {error}")

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    notes += marked
    enable_compilation_cache()
    with without_false_alarms():
        from ..spectrum.verb import solve_cases

        spectra = solve_cases([_scenes(states) for states in cases], [state.share for state in cases[0]])
        spectra = [dataclasses.replace(solved, notes=tuple(notes)) for solved in spectra]
        seconds = time.monotonic() - begin
        if varied is None:
            typed = {state.name: state.changes for state in cases[0]}
            deliver(lambda: _print(spectra[0], typed, label, seconds, as_json, full))
        else:
            deliver(lambda: _print_over(*varied, spectra, label, seconds, as_json, full))
    _end_if_failed(spectra, label, as_json)


def _scenes(states: "tuple[FileState, ...]") -> dict[str, Any]:
    return {state.name: state.scene for state in states}


def _values(scene: str, over: str, overrides: dict[str, str]) -> "tuple[Field, list[float]]":
    """The field of `--over` and its values in SI."""
    from ..scenes.reader import read_tables
    from ..sweeps.fields import SceneSource, grid_of, parse_over

    # the states are solved: no warning says that they are left out
    fields, ranges = parse_over([over], SceneSource(*read_tables(scene), overrides), counted=True)
    try:
        cases = grid_of(ranges)
    except ValueError as error:
        refuse(f"--over: {error}")
    return next(iter(fields.values())), [float(value) for value in cases.values[0]]


def _end_if_failed(spectra: "list[Spectrum]", label: str, as_json: bool) -> None:
    failures = [(name, text) for solved in spectra for name, text in solved.failures.items()]
    if not failures:
        return
    if as_json:
        summary = "; ".join(f"state '{name}': {text}" for name, text in failures)
        typer.echo(f"not converged: {label}: {summary}", err=True)
    raise typer.Exit(NOT_CONVERGED)


def _print(
    solved: "Spectrum", changes: dict[str, dict[str, str]], label: str, seconds: float, as_json: bool, full: bool
) -> None:
    from ..spectrum.tables import print_spectrum, spectrum_to_dict

    if as_json:
        typer.echo(json.dumps(spectrum_to_dict(solved, changes), allow_nan=False))
    else:
        print_spectrum(solved, changes, label, seconds, console(), full)


def _print_over(
    field: "Field",
    values: list[float],
    spectra: "list[Spectrum]",
    label: str,
    seconds: float,
    as_json: bool,
    full: bool,
) -> None:
    from ..spectrum.over import over_to_dict, print_over

    unit = "" if field.dimension is None else field.dimension.si
    if as_json:
        typer.echo(json.dumps(over_to_dict(field.path, unit, values, spectra), allow_nan=False))
    else:
        print_over(field.path, unit, values, spectra, label, seconds, console(), full)
