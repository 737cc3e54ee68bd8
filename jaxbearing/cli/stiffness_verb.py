"""`jaxbearing stiffness`: the stiffness of a bearing over shaft speed, also as a bearing of a rotor model."""

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .messages import NOT_CONVERGED, bad_input, refuse
from .options import ColumnsOption, JsonOption, SceneArgument, SetOption, labelled, option_quantity
from .output_files import ForceOption, Output, check_files, deliver
from .terminal import console

if TYPE_CHECKING:
    from .._scene import AbstractScene
    from ..report.shaft.stiffness import ShaftStiffness
    from ..report.stiffness import StiffnessTable

MOST_SPEEDS = 10_000
SHAFT = "shaft"
"""Kind of scenes with several bearings."""
_EXAMPLE = "'2000 rpm:20000 rpm:10'"
Speeds = Annotated[
    str,
    typer.Option(
        "--speeds",
        metavar="FIRST:LAST:NUMBER",
        help=f"Shaft (inner ring) speeds at equal distances, e.g. {_EXAMPLE}.",
    ),
]
Ross = Annotated[
    Path | None,
    typer.Option(
        "--ross",
        metavar="FILE.toml",
        help="Write the bearing for the rotordynamics package ROSS: rs.BearingElement.load(FILE); of a shaft with "
        "sections the rotor: rs.Rotor.load(FILE). Damping is 0: the model has none.",
    ),
]
RossVersion = Annotated[
    int,
    typer.Option(
        "--ross-version",
        metavar="2|3",
        min=2,
        max=3,
        help="Of ROSS: 3 reads speed, 2 frequency.",
    ),
]
LoadDirection = Annotated[
    str,
    typer.Option(
        "--load-direction", metavar="ANGLE", help="Of the load line, from ROSS's x axis towards its y axis; z is axial."
    ),
]


def stiffness(
    scene: SceneArgument,
    speeds: Speeds,
    changes: SetOption = None,
    as_json: JsonOption = False,
    ross: Ross = None,
    ross_version: RossVersion = 3,
    load_direction: LoadDirection = "-90 deg",
    force: ForceOption = False,
    full: ColumnsOption = False,
) -> None:
    """Stiffness of a bearing, or of all bearings and bearing sets of a shaft, against shaft speed at the loads of the
    scene. On request the bearing or the rotor is written for ROSS."""
    with bad_input():
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene
        from ..scenes.units import ANGLE

        values = _speeds(speeds)
        angle = option_quantity("--load-direction", load_direction, ANGLE)
        model = load_scene(scene, split_assignments(changes or []))
        _check(scene, model, values, ross)
        check_files((("--ross", ross, (".toml",)),), force)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    failure = ""
    with without_false_alarms():
        from ..numerics.status import SolveError

        try:
            table = _table(model, values)
        except SolveError as error:
            failure = str(error)
        else:
            read = "Rotor" if model.kind == SHAFT else "BearingElement"
            other = {3: "; ROSS 2: --ross-version 2", 2: ""}[ross_version]
            wrote = "" if as_json else f"wrote {ross}: read it with ross.{read}.load (ROSS {ross_version}{other})"
            output = Output(ross, lambda path: _write(table, path, scene, model, changes, angle, ross_version), wrote)
            deliver(lambda: _print(table, label, as_json, full), (output,))
    if failure:
        _print_failure(failure, label, ross, as_json)
        raise typer.Exit(NOT_CONVERGED)


def _speeds(text: str) -> list[float]:
    """Speeds, rad/s, from the text FIRST:LAST:NUMBER. **Raises:** `SceneError` for any other text."""
    from ..scenes.errors import SceneError
    from ..scenes.units import SPEED
    from ..scenes.words import describe

    parts = [part.strip() for part in text.split(":")]
    if len(parts) != 3:
        raise SceneError("--speeds", "", describe(text), f"FIRST:LAST:NUMBER, e.g. {_EXAMPLE}")
    first, last = (option_quantity("--speeds", part, SPEED, ">= 0") for part in parts[:2])
    if not re.fullmatch(r"[0-9]{1,9}", parts[2]) or not 2 <= int(parts[2]) <= MOST_SPEEDS:
        raise SceneError("--speeds", "", describe(parts[2]), f"a whole number of speeds from 2 to {MOST_SPEEDS}")
    if not first < last:
        raise SceneError("--speeds", "", describe(text), "a first speed below the last one")
    number = int(parts[2])
    steps = [i / (number - 1) for i in range(number)]
    return [first * (1.0 - step) + last * step for step in steps]


def _check(scene: str, model: "AbstractScene", values: list[float], ross: Path | None) -> None:
    from ..report.shaft.ross import require_rotor
    from ..report.shaft.stiffness import shaft_at_speeds
    from ..report.stiffness import at_speeds
    from ..shafts.scene import ShaftSystem

    shaft = model.kind == SHAFT
    try:
        (shaft_at_speeds if shaft else at_speeds)(model, values)
    except TypeError:
        refuse(
            f"SCENE: found '{scene}', a {type(model).__name__}, which has no stiffness; expected a bearing or a shaft"
        )
    except ValueError as error:
        refuse(f"--speeds: {error}")
    if isinstance(model, ShaftSystem) and ross is not None:
        try:
            require_rotor(model)
        except ValueError as error:
            refuse(f"--ross: {error}")


def _table(model: "AbstractScene", values: list[float]) -> "StiffnessTable | ShaftStiffness":
    """Stiffness at all speeds, rad/s. **Raises:** `SolveError` for a speed without a solution."""
    from ..report.shaft.stiffness import shaft_stiffness_over_speed
    from ..report.stiffness import stiffness_over_speed
    from ..solve import solve_once

    of = shaft_stiffness_over_speed if model.kind == SHAFT else stiffness_over_speed
    return of(model, values, solver=solve_once)


def _write(
    table: "StiffnessTable | ShaftStiffness",
    file: Path,
    scene: str,
    model: "AbstractScene",
    changes: list[str] | None,
    angle: float,
    ross_version: int,
) -> None:
    from ..report.ross import write_ross
    from ..report.shaft.ross import write_ross_rotor
    from ..report.shaft.stiffness import ShaftStiffness
    from ..shafts.scene import ShaftSystem

    label, version = labelled(Path(scene).name, changes), 2 if ross_version == 2 else 3
    if isinstance(table, ShaftStiffness):
        assert isinstance(model, ShaftSystem)
        write_ross_rotor(table, model, file, label, load_direction=angle, version=version)
        return
    name = Path(scene).stem
    tag = re.sub(r"[^A-Za-z0-9_-]+", "_", name) or "bearing"
    write_ross(table, file, label, load_direction=angle, tag=tag, version=version)


def _print(table: "StiffnessTable | ShaftStiffness", label: str, as_json: bool, full: bool) -> None:
    from ..report.shaft.stiffness import ShaftStiffness, print_shaft_stiffness, shaft_stiffness_to_dict
    from ..report.stiffness import stiffness_to_dict
    from ..report.stiffness_table import print_stiffness

    if as_json:
        numbers = shaft_stiffness_to_dict(table) if isinstance(table, ShaftStiffness) else stiffness_to_dict(table)
        report = {"converged": True, "failure": None, **numbers}
        typer.echo(json.dumps(report, allow_nan=False))
    elif isinstance(table, ShaftStiffness):
        print_shaft_stiffness(table, label, console(), full)
    else:
        print_stiffness(table, label, console(), full)


def _print_failure(failure: str, label: str, ross: Path | None, as_json: bool) -> None:
    if as_json:
        typer.echo(json.dumps({"converged": False, "failure": failure}))
        typer.echo(f"not converged: {label}: {failure}", err=True)
    else:
        from ..report.backends.screen import print_failure

        print_failure(label, "one speed failed", failure, console())
    if ross is not None:
        typer.echo(f"not written: {ross}", err=True)
