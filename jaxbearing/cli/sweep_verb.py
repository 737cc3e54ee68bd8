"""`jaxbearing sweep`: many steady states in one labelled file."""

import json
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .completion import assignments
from .interrupt import if_interrupted
from .messages import NOT_CONVERGED, bad_input, refuse
from .options import JsonOption, SceneArgument, SetOption, labelled
from .output_files import Output, check_files, deliver
from .sweep_parts import (
    ChunkOption,
    DevicesOption,
    OverwriteOption,
    SchedulerOption,
    SeedOption,
    WorkersOption,
    check_extra,
    check_run_target,
    ends_in_words,
    shown_progress,
)
from .sweep_plot import check_plot, own_values, write_plot
from .terminal import console

if TYPE_CHECKING:
    from ..sweeps.cases import Cases
    from ..sweeps.engine import Outcome, StoppedError
    from ..sweeps.fields import Field, SceneSource

OverOption = Annotated[
    list[str] | None,
    typer.Option(
        "--over",
        metavar="NAME=START:STOP:COUNT[:log]",
        help="A field and its values, e.g. operation.inner_speed='2000 rpm:20000 rpm:10'; several make a grid. For "
        "samples NAME=START:STOP[:log].",
        autocompletion=assignments,
    ),
]
ListOption = Annotated[
    Path | None,
    typer.Option(
        "--list", metavar="FILE.csv", help="One case a row; columns are fields, 'operation.inner_speed [rpm]'."
    ),
]
RandomOption = Annotated[
    int | None, typer.Option("--random", metavar="COUNT", help="So many random cases within the ranges of --over.")
]
HypercubeOption = Annotated[
    int | None,
    typer.Option("--latin-hypercube", metavar="COUNT", help="As --random, evenly spread over the range of each field."),
]
OutOption = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="FILE",
        help="NetCDF (.nc) or Zarr (.zarr, needs the extra cluster); SCENE_sweep.nc if not given.",
    ),
]
PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="FILE",
        help="Picture of a grid, .png, .svg or .pdf: power loss by location against one field, a map over two; of a "
        "dry bearing life or stiffness. The scene's own operating point is marked.",
    ),
]
TableOption = Annotated[
    Path | None,
    typer.Option(
        "--table",
        metavar="FILE.csv",
        help="One case a row: the fields, every result that is one number, and how the case ended.",
    ),
]
NoElementsOption = Annotated[
    bool, typer.Option("--without-elements", help="Leave out the results of each rolling element, most of the file.")
]


def sweep(
    scene: SceneArgument,
    over: OverOption = None,
    cases_file: ListOption = None,
    random: RandomOption = None,
    latin_hypercube: HypercubeOption = None,
    seed: SeedOption = 0,
    changes: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
    plot: PlotOption = None,
    table: TableOption = None,
    overwrite: OverwriteOption = False,
    without_elements: NoElementsOption = False,
    chunk: ChunkOption = None,
    devices: DevicesOption = None,
    workers: WorkersOption = None,
    scheduler: SchedulerOption = None,
) -> None:
    """Many steady states: a grid, a list or samples of fields, in one labelled file. A sweep that is stopped goes on
    where it was when the same command is given again."""
    begin = time.monotonic()
    target = out if out is not None else Path(f"{Path(scene).stem}_sweep.nc")
    with bad_input():
        from ..scenes.overrides import split_assignments
        from ..sweeps.fields import SceneSource
        from ..sweeps.verb import calls_at_once

        _check_modes(over, cases_file, random, latin_hypercube)
        source = SceneSource.of(scene, split_assignments(changes or []))
        fields, cases = _cases(source, over, cases_file, random, latin_hypercube, seed)
        with _refused("--over"):
            recipe = source.recipe(cases, fields)
            source.warn_of_means(cases, fields)
        check_run_target(target)
        check_plot(plot, cases, recipe.example_scene)
        check_files([("--table", table, (".csv",))])
        check_extra(workers, scheduler)

    from .cache import enable_compilation_cache
    from .devices import cores, use_cores
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    most = devices or min(cores(), calls_at_once(recipe, cases, chunk))
    use_cores(most if workers is None and scheduler is None else 1)
    with without_false_alarms():
        from ..report.sweep_table import write_table
        from ..sweeps.engine import kept_words, run
        from ..sweeps.fields import described_fields
        from ..sweeps.verb import make_plan, runner_of

        stopped = lambda error: _print_stopped(error, label, time.monotonic() - begin, as_json)
        with ends_in_words(target, "--out", stopped):
            runner = runner_of(devices, workers, scheduler)
            metadata = described_fields(fields, recipe.example_scene)
            plan = make_plan(recipe, cases, metadata, label, elements=not without_elements, chunk=chunk)
            if_interrupted(lambda: kept_words(plan, target))
            with shown_progress(len(cases), as_json) as watcher:
                outcome = run(plan, target, runner=runner, overwrite=overwrite, watcher=watcher)
        seconds = time.monotonic() - begin
        point = {} if plot is None else own_values(source, fields)
        rows = Output(table, lambda path: write_table(path, target), f"wrote {table}: one case a row")
        picture = Output(plot, lambda path: write_plot(path, target, label, point), long=True)
        files = (rows, picture) if outcome.converged > 0 else (rows,)
        deliver(
            lambda: _print(outcome, label, target, seconds, as_json), files, notes_to_stderr=as_json, as_json=as_json
        )
    if outcome.converged == 0:
        if plot is not None:
            typer.echo(f"not written: {plot}", err=True)
        typer.echo(f"not converged: {label}: none of {outcome.cases} cases; {target} says why", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _check_modes(
    over: list[str] | None, cases_file: Path | None, random: int | None, latin_hypercube: int | None
) -> None:
    if cases_file is not None and (over or random is not None or latin_hypercube is not None):
        refuse("--list: found --over, --random or --latin-hypercube beside it; expected one way to choose the cases")
    if random is not None and latin_hypercube is not None:
        refuse("--random: found --latin-hypercube beside it; expected one of the two")
    if cases_file is None and not over:
        refuse(
            "--over: found nothing; expected a field to vary, e.g. --over operation.inner_speed='2000 rpm:20000 rpm:10'"
        )


def _cases(
    source: "SceneSource",
    over: list[str] | None,
    cases_file: Path | None,
    random: int | None,
    latin_hypercube: int | None,
    seed: int,
) -> "tuple[Mapping[str, Field], Cases]":
    from ..sweeps.case_lists import list_of
    from ..sweeps.fields import grid_of, parse_over, samples_of

    if cases_file is not None:
        with _refused("--list"):
            return list_of(cases_file, source)
    count, kind = (random, "random") if random is not None else (latin_hypercube, "latin_hypercube")
    fields, ranges = parse_over(over or [], source, counted=count is None)
    with _refused("--over" if count is None else f"--{kind.replace('_', '-')}"):
        return fields, grid_of(ranges) if count is None else samples_of(ranges, kind, count, seed)


@contextmanager
def _refused(option: str) -> Iterator[None]:
    """Message of the library on values that no sweep can have."""
    from ..scenes.errors import SceneError

    try:
        yield
    except SceneError:
        raise
    except ValueError as error:
        refuse(f"{option}: {error}")


def _print_stopped(stopped: "StoppedError", label: str, seconds: float, as_json: bool) -> None:
    """Shows the counts of a sweep whose file could not be written."""
    if as_json:
        counts = {
            "cases": stopped.cases,
            "converged": stopped.converged,
            "failed": stopped.computed - stopped.converged,
        }
        typer.echo(json.dumps(counts | {"file": None, "seconds": round(seconds, 3)}))
        return
    from ..report.backends.screen import headline

    words = f"{stopped.computed} of {stopped.cases} cases computed, {stopped.converged} converged, in {seconds:.1f} s"
    headline(label, "NOT WRITTEN", "bold red", words, console())


def _print(outcome: "Outcome", label: str, target: Path, seconds: float, as_json: bool) -> None:
    if as_json:
        counts = {"cases": outcome.cases, "converged": outcome.converged, "failed": outcome.failed}
        typer.echo(json.dumps(counts | {"file": str(target), "seconds": round(seconds, 3)}))
        return
    from ..report.sweep_summary import print_sweep

    print_sweep(target, label, outcome.kept, seconds, console())
