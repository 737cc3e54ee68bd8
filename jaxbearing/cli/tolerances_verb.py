"""`jaxbearing tolerances`: scatter of the results of a scene whose fields have tolerances."""

import json
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .interrupt import if_interrupted
from .messages import NOT_CONVERGED, bad_input, refuse
from .options import DragPriorOption, JsonOption, SceneArgument, SetOption, labelled
from .output_files import PICTURES, Output, check_files, deliver
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
from .terminal import console, working

if TYPE_CHECKING:
    from ..tolerance import Tolerances
    from ..tolerance.verb import Analysis

ResultsOption = Annotated[
    list[str] | None,
    typer.Option(
        "--results",
        metavar="NAME,NAME...",
        help="Results to look at, e.g. fit.clearance,power_loss.total; of one rolling element contact_angle_inner[0]. "
        "Not given: clearance, contact angles, displacements, power loss, life, as far as the scene has them.",
    ),
]
SamplesOption = Annotated[
    int,
    typer.Option("--samples", metavar="COUNT", min=0, help="So many random samples beside the delta method; 0: none."),
]
OutOption = Annotated[
    Path | None,
    typer.Option(
        "--out", metavar="FILE.nc", help="Write all numbers as NetCDF; the samples go to FILE_samples.nc beside it."
    ),
]
PlotOption = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw distributions and the share of each field; .png, .svg or .pdf."),
]
PosteriorOption = Annotated[
    Path | None,
    typer.Option(
        "--posterior",
        metavar="FILE.nc",
        help="Fields that scatter together, as a calibration leaves them: the file of jaxbearing calibrate --out "
        "FILE.nc.",
    ),
]


def tolerances(
    scene: SceneArgument,
    results: ResultsOption = None,
    samples: SamplesOption = 0,
    seed: SeedOption = 0,
    changes: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
    plot: PlotOption = None,
    overwrite: OverwriteOption = False,
    chunk: ChunkOption = None,
    devices: DevicesOption = None,
    workers: WorkersOption = None,
    scheduler: SchedulerOption = None,
    drag_prior: DragPriorOption = True,
    posterior: PosteriorOption = None,
) -> None:
    """Mean, standard deviation and limits of clearance, contact angle, power loss, life from the tolerances of seats
    and of fields that are given as {mean, deviation}, {low, high} or {median, log_deviation}, and which of them
    contribute most. The drag coefficient scatters by an assumed distribution. Samples that are stopped go on where they
    were when the same command is given again."""
    begin = time.monotonic()
    with bad_input():
        from ..numerics.newton import NewtonOptions
        from ..scenes.overrides import split_assignments
        from ..tolerance.scatter import scatter_of_source
        from ..tolerance.verb import Analysis, posterior_of

        wanted = _names(results)
        if samples == 1:
            refuse("--samples: found 1; expected 0, or 2 or more")
        try:
            joint = posterior_of(posterior)
        except ValueError as error:
            refuse(f"--posterior: {error}")
        try:
            label, scatter = scatter_of_source(scene, split_assignments(changes or []), drag_prior, joint)
        except ValueError as error:
            refuse(str(error) if type(error) is not ValueError else f"{scene}: {error}")
        check_files((("--plot", plot, PICTURES), ("--out", out, (".nc",))))
        target = _samples_file(scene, out)
        if samples:
            check_run_target(target)
            check_extra(workers, scheduler)

    from .cache import enable_compilation_cache
    from .devices import cores, use_cores
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    analysis = Analysis(scatter, label, NewtonOptions())
    enable_compilation_cache()
    local = samples and workers is None and scheduler is None
    use_cores((devices or min(cores(), -(-samples // _LANES))) if local else 1)
    with without_false_alarms():
        from ..numerics.status import SolveError

        try:
            with working("solving at the means, with derivatives", as_json):
                result = analysis.tolerances(wanted)
        except SolveError as error:
            _print_failure(str(error), error.status.name.lower(), label, as_json)
            raise typer.Exit(NOT_CONVERGED) from None
        except ValueError as error:
            refuse(f"--{error}")
        if samples:
            result = _sampled(
                analysis, result, target, (samples, seed, chunk), (devices, workers, scheduler), overwrite, as_json
            )
        seconds = time.monotonic() - begin
        outputs = (
            Output(out, lambda path: _write_data(result, label, path)),
            Output(plot, lambda path: _write_plot(result, label, path), long=True),
        )
        deliver(lambda: _print(result, label, seconds, as_json), outputs, as_json=as_json)
    if samples and not as_json:
        typer.echo(f"wrote {target}: the samples; open it with xarray.open_dataset")


_LANES = 125
"""Samples that a core solves in one call."""


def _names(results: list[str] | None) -> list[str] | None:
    """Names of results; commas or several options part them."""
    if results is None:
        return None
    names = [name.strip() for text in results for name in text.split(",")]
    if not all(names):
        refuse(f"--results: found '{','.join(results)}'; expected names with commas between them")
    return names


def _samples_file(scene: str, out: Path | None) -> Path:
    if out is not None:
        return out.with_name(f"{out.stem}_samples.nc")
    return Path(f"{Path(scene).stem}_tolerances_samples.nc")


def _sampled(
    analysis: "Analysis",
    result: "Tolerances",
    target: Path,
    sizes: tuple[int, int, int | None],
    runner: tuple[int | None, int | None, str | None],
    overwrite: bool,
    as_json: bool,
) -> "Tolerances":
    """The scatter with its samples. **Arguments:** `sizes`: samples, seed, chunk; `runner`: as those of `runner_of`."""
    from ..report.stores import opened
    from ..sweeps.engine import kept_words, run
    from ..sweeps.verb import runner_of

    count, seed, chunk = sizes
    with ends_in_words(target, "samples"):
        computes = runner_of(*runner)
        plan = analysis.plan(result, count, seed, chunk)
        if_interrupted(lambda: kept_words(plan, target))
        with shown_progress(count, as_json) as watcher:
            run(plan, target, runner=computes, overwrite=overwrite, watcher=watcher)
        with opened(target) as dataset:
            return analysis.with_samples(result, dataset, seed, str(target))


def _write_data(result: "Tolerances", label: str, out: Path) -> None:
    from ..report.dataset import write_netcdf
    from ..tolerance.tables import tolerances_to_dataset

    write_netcdf(tolerances_to_dataset(result, label), out)


def _write_plot(result: "Tolerances", label: str, plot: Path) -> None:
    from ..plots import tolerances as draw
    from ..report.plots import save_plot

    save_plot(draw(result, title=label), plot)


def _print(result: "Tolerances", label: str, seconds: float, as_json: bool) -> None:
    from ..tolerance.tables import print_tolerances, tolerances_to_dict

    if as_json:
        typer.echo(json.dumps(tolerances_to_dict(result), allow_nan=False))
    else:
        print_tolerances(result, label, seconds, console())


def _print_failure(failure: str, status: str, label: str, as_json: bool) -> None:
    """The scene does not converge at the means of its fields."""
    if as_json:
        typer.echo(json.dumps({"converged": False, "status": status, "failure": failure}))
        typer.echo(f"not converged: {label}: {failure}", err=True)
        return
    from ..report.backends.screen import print_failure

    print_failure(label, status.replace("_", " "), failure, console())
