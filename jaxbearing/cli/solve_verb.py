"""`jaxbearing solve`: one steady state on the screen, as JSON, as a picture, as a file."""

import dataclasses
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

import typer

from . import solve_sensitivities as extra
from .messages import NOT_CONVERGED, bad_input, refuse
from .options import DragPriorOption, JsonOption, SceneArgument, SetOption, labelled
from .output_files import PICTURES, ForceOption, Output, check_files, deliver
from .terminal import console

if TYPE_CHECKING:
    from .._scene import AbstractScene, AbstractSolution
    from ..bearings.ball.scene import BallBearing
    from ..life.result import CatalogueLife

OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.nc", help="Write all results, with units, as NetCDF.")
]
PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="FILE",
        help="Draw power loss, loads and films, traction curves, or pressure and film; .png, .svg or .pdf.",
    ),
]
FullOption = Annotated[
    bool,
    typer.Option(
        "--full",
        help="All of a bearing on the screen: assumptions, each loaded element, spin, heat, seats, oil supply, "
        "frequencies; every column of a table.",
    ),
]

LineContactOption = Annotated[
    tuple[str, Path] | None,
    typer.Option(
        "--line-contact",
        metavar="RACE FILE.toml",
        help="Of a ball bearing: write the contact of the most loaded ball with the inner or outer race as the scene "
        "of a line contact, for its field solver.",
    ),
]


class _Contact(NamedTuple):
    """A contact of a bearing that is to be written as a scene."""

    bearing: "BallBearing"
    race: Literal["inner", "outer"]
    path: Path


def solve(
    scene: SceneArgument,
    changes: SetOption = None,
    as_json: JsonOption = False,
    sensitivities: extra.SensitivitiesOption = False,
    plot: PlotOption = None,
    out: OutOption = None,
    line_contact: LineContactOption = None,
    drag_prior: DragPriorOption = True,
    sensitivities_of: extra.SensitivitiesOfOption = None,
    sensitivities_by: extra.SensitivitiesByOption = extra.BY[0],
    full: FullOption = False,
    force: ForceOption = False,
) -> None:
    """Steady state: life, power loss, loads, films, pressures, speeds; of a two-disk machine, its traction curves; of a
    line contact, its film."""
    notes: list[str] = []
    with bad_input(notes):
        from ..scenes.marks import notes_of_file
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        assignments = split_assignments(changes or [])
        model = load_scene(scene, assignments)
        marked = notes_of_file(scene, assignments)
        asked = extra.asked(sensitivities, sensitivities_of, sensitivities_by, drag_prior)
        wanted = _line_contact(line_contact, model, scene)
        contact = None if wanted is None else wanted.path
        files = (("--plot", plot, PICTURES), ("--out", out, (".nc",)), ("--line-contact", contact, (".toml",)))
        check_files(files, force)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    notes += marked
    enable_compilation_cache()
    with without_false_alarms():
        solution, slopes = extra.solved(model, asked)
        solution = dataclasses.replace(solution, notes=(*solution.notes, *notes)) if notes else solution
        failure = "" if bool(solution.converged) else solution.failure()
        moved = extra.moved(model, solution, slopes, asked, scene, assignments)
        needless = _without_equilibrium(model, solution)
        show = lambda: (
            _print_json(solution, moved, needless) if as_json else _print_screen(solution, moved, label, full, needless)
        )
        bridge = lambda _: _write_line_contact(wanted, solution, scene, changes)
        taken = "" if as_json else f"wrote {contact}: take it as a scene, jaxbearing solve {contact}"
        outputs = (
            Output(out, lambda path: _write_data(solution, path)),
            Output(contact, bridge, taken),
            Output(plot, lambda path: _write_plot(solution, label, path, model), long=True),
        )
        deliver(show, () if failure else outputs, as_json=as_json)
    if failure:
        left_out = [str(path) for path in (plot, out, contact) if path is not None]
        if left_out:
            typer.echo(f"not written: {', '.join(left_out)}", err=True)
        if as_json:
            typer.echo(f"not converged: {label}: {failure}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _line_contact(wanted: tuple[str, Path] | None, model: "AbstractScene", scene: str) -> _Contact | None:
    """The contact that `--line-contact` names, checked; `None` without this option."""
    if wanted is None:
        return None
    from ..bearings.ball.scene import BallBearing

    race, path = wanted
    if race != "inner" and race != "outer":
        refuse(f"--line-contact: found '{race}'; expected inner or outer, and a file")
    if not isinstance(model, BallBearing):
        refuse(f"--line-contact: found '{scene}', a {type(model).__name__}; expected a scene of the kind ball_bearing")
    if model.oil is None:
        refuse(f"--line-contact: found '{scene}', which has no oil; expected a ball bearing with an oil")
    return _Contact(model, race, path)


def _write_line_contact(
    wanted: _Contact | None, solution: "AbstractSolution", scene: str, changes: list[str] | None
) -> None:
    import numpy as np

    from ..bearings.ball.line_contact_bridge import line_contact_of
    from ..bearings.solution import Solution
    from ..report.files import write_whole
    from ..scenes.line_contact.writer import line_contact_text
    from ..scenes.overrides import split_assignments
    from ..scenes.reader import oil_origins

    assert wanted is not None
    assert isinstance(solution, Solution)
    race = wanted.race
    ball = int(np.argmax(np.asarray(getattr(solution.elements, f"load_{race}"))))
    contact = line_contact_of(wanted.bearing, solution, race=race, ball=ball)
    header = [
        f"Equivalent line contact of ball {ball}, the most loaded one, with the {race} race of",
        labelled(Path(scene).name, changes),
        "Same Hertz pressure and half width along rolling; mean of both surfaces' speeds; no side leakage, no spin.",
    ]
    text = line_contact_text(contact, header, oil_origins(scene, split_assignments(changes or [])))
    write_whole(wanted.path, text)


def _write_data(solution: "AbstractSolution", out: Path) -> None:
    from ..report.dataset import solution_to_dataset, write_netcdf

    write_netcdf(solution_to_dataset(solution), out)


def _write_plot(solution: "AbstractSolution", label: str, plot: Path, model: "AbstractScene") -> None:
    from ..report.plots import plot_solution, save_plot

    save_plot(plot_solution(solution, label, model), plot)


def _without_equilibrium(model: "AbstractScene", solution: "AbstractSolution") -> "CatalogueLife | None":
    """The life by catalogue formulas of a bearing whose loads have no equilibrium; `None` of all others."""
    from ..bearings.bearing import AbstractBearing
    from ..bearings.solution import Solution
    from ..numerics.status import Status

    if not isinstance(model, AbstractBearing) or not isinstance(solution, Solution) or model.rating is None:
        return None
    if int(solution.status) != Status.NO_EQUILIBRIUM:
        return None
    from ..bearings.bearing_life import catalogue_life

    life = catalogue_life(model)
    return life if math.isfinite(float(life.L10)) else None


def _print_json(
    solution: "AbstractSolution", moved: extra.Moved | None, needless: "CatalogueLife | None" = None
) -> None:
    from ..report.json_report import solution_to_dict

    results = solution_to_dict(solution)
    if moved is not None:
        results |= extra.as_json(moved)
    if needless is not None:
        from ..report.backends.json import plain

        results["catalogue_life"] = plain(needless)
    typer.echo(json.dumps(results, allow_nan=False))


def _print_screen(
    solution: "AbstractSolution",
    moved: extra.Moved | None,
    label: str,
    full: bool,
    needless: "CatalogueLife | None" = None,
) -> None:
    from ..report.summary import print_summary

    print_summary(solution, label, console(), full)
    if needless is not None:
        from ..report.backends.screen import print_line
        from ..report.bearing.life_facts import catalogue_fact

        print_line(*catalogue_fact(needless), console())
    if not full and _has_more(solution):
        console().print(
            "  More: --full (assumptions, each loaded element, spin, heat, seats, oil supply, frequencies)", style="dim"
        )
    if moved is not None and bool(solution.converged):
        extra.print_screen(moved)


def _has_more(solution: "AbstractSolution") -> bool:
    """True for a bearing that was solved, whose full summary has more than the usual one."""
    from ..bearings.solution import Solution

    return isinstance(solution, Solution) and bool(solution.converged)
