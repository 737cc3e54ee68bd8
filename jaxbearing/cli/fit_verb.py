"""`jaxbearing fit`: the rheology of an oil from measured traction curves."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .completion import scene_names
from .messages import BAD_INPUT, NOT_CONVERGED, UNDETERMINED, bad_input, refuse, say
from .options import SCENE_HELP, JsonOption, LossOption, SetOption, labelled
from .output_files import PICTURES, ForceOption, Output, check_files, deliver, kept_if_interrupted
from .posterior_options import (
    PlotPosteriorOption,
    PosteriorOption,
    SamplesOption,
    sampling_of,
    write_posterior,
)
from .terminal import console, working

if TYPE_CHECKING:
    from fitting.comparison import ModelRow
    from fitting.measurements import Measurements
    from fitting.options import FitOptions
    from fitting.posterior import Posterior, Sampling
    from fitting.predictive import Predictive
    from fitting.result import FitResult

    from ..machines import TwoDisk

ALL = "all"
Data = Annotated[
    Path,
    typer.Argument(
        metavar="DATA.csv",
        help="Traction curves: CSV with the columns 'slide_to_roll [%]' and 'traction_coefficient', and 'pressure "
        "[GPa]' or 'load [N]', 'entrainment_speed [m/s]', 'temperature [degC]', 'curve' where they vary; or a text "
        "export of a PCS machine.",
    ),
]
Scene = Annotated[
    str,
    typer.Option(
        "--scene",
        metavar="SCENE",
        help=f"The two-disk machine, its oil and its contact laws. {SCENE_HELP}",
        autocompletion=scene_names,
    ),
]
Model = Annotated[
    str | None,
    typer.Option(
        "--model",
        help="Viscous function: ree_eyring, bair_winer, gecim_winer, elsharkawy_hamrock, or all to compare them; the "
        "scene's if not given.",
    ),
]
Fixed = Annotated[
    list[str] | None,
    typer.Option("--fix", metavar="NAME", help="Hold a parameter at the scene's value. May be repeated."),
]
Free = Annotated[
    list[str] | None,
    typer.Option("--free", metavar="NAME", help="Fit a parameter although the data cannot tell it. May be repeated."),
]
Bounds = Annotated[
    list[str] | None,
    typer.Option(
        "--bound", metavar="NAME=LOW:HIGH", help="Bounds, e.g. --bound stress='1 MPa:20 MPa'. May be repeated."
    ),
]
Method = Annotated[str, typer.Option("--method", help="levenberg_marquardt, bfgs or gradient_descent.")]
Starts = Annotated[int, typer.Option("--starts", help="Number of starting points.")]
RelativeError = Annotated[
    str, typer.Option("--relative-error", metavar="X", help="Of the traction coefficient, e.g. '2 %'.")
]
Floor = Annotated[
    str | None,
    typer.Option(
        "--floor",
        metavar="X",
        help="Smallest error of the traction coefficient; a fifth of the relative error of the largest one of a curve "
        "if not given.",
    ),
]
SlideError = Annotated[
    str, typer.Option("--slide-error", metavar="X", help="Error of the slide-to-roll ratio, e.g. '1 %'.")
]
Level = Annotated[str, typer.Option("--level", help="Confidence of the intervals, e.g. 0.95.")]
Plot = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw points, curves and differences; .png, .svg or .pdf."),
]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out", metavar="FILE.toml", help="Write the fitted oil, for a scene: [oil] file = ..., --set oil.file=..."
    ),
]


def fit(
    data: Data,
    scene: Scene,
    changes: SetOption = None,
    model: Model = None,
    fixed: Fixed = None,
    free: Free = None,
    bounds: Bounds = None,
    loss: LossOption = "linear",
    method: Method = "levenberg_marquardt",
    starts: Starts = 3,
    relative_error: RelativeError = "0.02",
    floor: Floor = None,
    slide_error: SlideError = "0",
    level: Level = "0.95",
    posterior: PosteriorOption = False,
    samples: SamplesOption = 1000,
    as_json: JsonOption = False,
    plot: Plot = None,
    plot_posterior: PlotPosteriorOption = None,
    out: Out = None,
    force: ForceOption = False,
) -> None:
    """Fits shear modulus and stress of an oil to traction curves, with confidence intervals, and says which parameters
    the curves do not determine.

    Names: shear_modulus (G0), shear_modulus_pressure (alpha_G), shear_modulus_temperature (beta_G), stress (tau0),
    stress_pressure (alpha_tau), stress_temperature (beta_tau).
    """
    with bad_input():
        from fitting.estimation import METHODS
        from fitting.io import typed
        from fitting.loss import LOSSES, Errors
        from fitting.options import FitOptions
        from fitting.viscous import VISCOUS

        models = _models(model, list(VISCOUS))
        options = FitOptions(
            model=None if model == ALL else model,
            method=typed.choice("--method", method, METHODS),
            loss=typed.choice("--loss", loss, LOSSES),
            errors=Errors(
                relative=typed.ratio("--relative-error", relative_error, "'2 %'"),
                floor=None if floor is None else typed.ratio("--floor", floor, "0.0005"),
                slide_to_roll=typed.ratio("--slide-error", slide_error, "'1 %'"),
            ),
            fixed=typed.parameter_names("--fix", fixed or []),
            free=typed.parameter_names("--free", free or []),
            bounds=typed.bounds("--bound", bounds or []),
            starts=starts,
            level=typed.ratio("--level", level, "0.95", largest=1.0),
        )
        _check_options(options)
        machine, measurements, notes = _loaded(data, scene, changes)
        sampling = sampling_of(posterior, samples, plot_posterior)
        pictures = ("--plot", plot, PICTURES), ("--plot-posterior", plot_posterior, PICTURES)
        check_files((*pictures, ("--out", out, (".toml",))), force)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with without_false_alarms():
        with working("fitting", as_json) as tell:
            result, rows = _fitted(measurements, machine, models, options, tell)
            wrote = "" if as_json else f"wrote {out}: use it with [oil] file = ... or --set oil.file={out}"
            outputs = lambda drawn, again: (
                Output(out, lambda path: _write_oil(result, path, data, scene, changes), wrote),
                Output(plot, lambda path: _write_plot(result, path, data, label, notes), long=True),
                Output(plot_posterior, lambda path: _write_posterior(drawn, again, data, path), long=True),
            )
            show = lambda drawn, again: _print(result, rows, data, label, notes, out, as_json, drawn, again)
            plain = outputs(None, None) if result.converged else ()
            with kept_if_interrupted(lambda: show(None, None), plain, "without the posterior", tell.stop):
                if sampling is not None:
                    tell("sampling the posterior")
                drawn, again = _sampled(result, sampling)
        files = outputs(drawn, again)
        delivered = files if result.converged else files[:2] if result.undetermined else ()
        deliver(lambda: show(drawn, again), delivered, as_json=as_json)
    if result.undetermined:
        if plot_posterior is not None:
            typer.echo(f"not written: {plot_posterior}", err=True)
        if as_json:
            typer.echo(f"{data}: {result.failure()}", err=True)
        raise typer.Exit(UNDETERMINED)
    if not result.converged:
        left_out = [str(path) for path in (plot, plot_posterior, out) if path is not None]
        if left_out:
            typer.echo(f"not written: {', '.join(left_out)}", err=True)
        if as_json:
            typer.echo(f"not converged: {data}: {result.failure()}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _models(model: str | None, known: list[str]) -> list[str | None]:
    """Names of the viscous functions to fit; `None` stands for the one of the scene."""
    from fitting.io.typed import choice

    if model == ALL:
        return [*known]
    return [None if model is None else choice("--model", model, [*known, ALL])]


def _check_options(options: "FitOptions") -> None:
    """Ends the command with a message if options contradict each other or are out of range."""
    both = [name for name in options.fixed if name in options.free]
    if both:
        refuse(f"--free: found '{both[0]}', which --fix holds; expected one of the two")
    if options.starts < 1:
        refuse(f"--starts: found {options.starts}; expected a whole number >= 1")
    if options.level == 0.0:
        refuse("--level: found 0; expected a number between 0 and 1, e.g. 0.95")
    if options.errors.relative == 0.0 and not options.errors.floor:
        refuse("--relative-error: found 0 without a --floor; expected an error > 0, or a --floor > 0")


def _loaded(data: Path, scene: str, changes: list[str] | None) -> "tuple[TwoDisk, Measurements, list[str]]":
    """The two-disk machine, the measurements, and notes on the data and the oil."""
    from fitting.io import CurveError, read_curves
    from fitting.measurements import MeasurementError, Measurements

    from ..machines import TwoDisk
    from ..scenes.overrides import split_assignments
    from ..scenes.reader import load_scene

    machine = load_scene(scene, split_assignments(changes or []))
    if not isinstance(machine, TwoDisk):
        refuse(
            f"--scene: found '{scene}', a {type(machine).__name__}; expected a scene of the kind two_disk, e.g. "
            "two_disk_mobil_jet_ii"
        )
    try:
        table = read_curves(data)
        measurements = Measurements.of(table, machine)
    except CurveError as error:
        refuse(str(error))
    except MeasurementError as error:
        raise typer.Exit(say(f"{data} with the scene {scene}: {error}", BAD_INPUT)) from None
    return machine, measurements, [*table.notes, *(f"Oil: {note}." for note in machine.oil.notes)]


def _fitted(
    measurements: "Measurements",
    machine: "TwoDisk",
    models: Sequence[str | None],
    options: "FitOptions",
    tell: Callable[[str], None],
) -> "tuple[FitResult, Sequence[ModelRow]]":
    """Result of the fit of one model, or of the best of several with the comparison of all.

    **Arguments:** `models`: names of the viscous functions to fit; `tell`: shows a message on the progress.
    """
    from fitting.fit import fit as fit_one

    try:
        if len(models) == 1:
            return fit_one(measurements, machine, options), ()
        results = {}
        for model in models:
            # all models together take minutes
            tell(f"fitting {model}")
            results[str(model)] = fit_one(measurements, machine, options._replace(model=model))
    except ValueError as error:
        refuse(str(error))
    from fitting.comparison import compare

    tell("comparing")
    rows = compare(results)
    return results[rows[0].model], rows


def _sampled(result: "FitResult", sampling: "Sampling | None") -> "tuple[Posterior | None, Predictive | None]":
    """The posterior and its predictive distribution; `None` and `None` if no posterior was requested or the fit did not
    converge. Ends the command with a message if they cannot be computed."""
    from fitting.oil_posterior import posterior_of, predictive

    if sampling is None or not result.converged:
        return None, None
    try:
        drawn = posterior_of(result, sampling)
        return drawn, predictive(result, drawn)
    except ValueError as error:
        refuse(f"--{error}")


def _write_posterior(drawn: Any, again: "Predictive | None", data: Path, path: Path) -> None:
    from fitting.parameters import NAMES, UNITS

    write_posterior(drawn, again, dict(zip(NAMES, UNITS, strict=True)), str(data), path)


def _write_oil(result: "FitResult", out: Path, data: Path, scene: str, changes: list[str] | None) -> None:
    from fitting.io.oil_file import write_oil

    from ..scenes.overrides import split_assignments
    from ..scenes.reader import oil_origins

    label = labelled(Path(scene).name, changes)
    origins = oil_origins(scene, split_assignments(changes or []))
    write_oil(result, out, data.name, label, origins)


def _write_plot(result: "FitResult", plot: Path, data: Path, label: str, notes: list[str]) -> None:
    from fitting.io.plots import plot_fit

    from ..report.plots import save_plot

    save_plot(plot_fit(result, data.name, label, notes), plot)


def _print(
    result: "FitResult",
    rows: "Sequence[ModelRow]",
    data: Path,
    label: str,
    notes: list[str],
    out: Path | None,
    as_json: bool,
    drawn: "Posterior | None",
    again: "Predictive | None",
) -> None:
    if as_json:
        from fitting.io.json_report import fit_to_dict

        oil = str(out) if out is not None and result.status != "not_converged" else None
        report = fit_to_dict(result, str(data), label, notes, oil, rows)
        if drawn is not None:
            report["posterior"] = drawn.to_dict()
        if again is not None:
            report["predictive"] = again.to_dict()
        typer.echo(json.dumps(report, allow_nan=False))
        return
    from fitting.io.summary import print_comparison, print_fit

    screen = console()
    print_fit(result, str(data), label, notes, screen)
    if rows:
        print_comparison(rows, screen)
    if drawn is not None:
        from fitting.io.posterior_table import print_posterior

        print_posterior(drawn, screen, again)
