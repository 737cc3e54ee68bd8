"""`jaxbearing calibrate`: fields of scenes from measurements, with intervals and with what these cannot tell."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .messages import NOT_CONVERGED, UNDETERMINED, bad_input, refuse
from .options import JsonOption, LossOption, SceneArgument, SetOption, labelled
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
    from collections.abc import Callable

    from fitting.posterior import Posterior
    from fitting.predictive import Predictive

    from .._scene import AbstractScene
    from ..calibration import Calibration
    from ..calibration.next_point import Candidate
    from ..calibration.prediction import Predicted
    from ..calibration.sources import Given

DataArgument = Annotated[
    Path,
    typer.Argument(
        metavar="DATA.csv",
        help="Measurements, one row an operating point: fields of the scene such as 'operation.inner_speed [rpm]', and "
        "results such as 'power_loss.total [W]', with 'power_loss.total.deviation [W]' where it is known.",
    ),
]
FreeOption = Annotated[
    list[str], typer.Option("--free", metavar="PATH", help="A field that is fitted, e.g. drag.coefficient. Repeatable.")
]
PriorOption = Annotated[
    list[str] | None,
    typer.Option(
        "--prior",
        metavar="PATH={...}",
        help="What is known of a free field before: --prior drag.coefficient='{median = 0.3, log_deviation = 0.9}', "
        "or =assumed for the package's own. Repeatable.",
    ),
]
BoundOption = Annotated[
    list[str] | None,
    typer.Option("--bound", metavar="PATH=LOW:HIGH", help="Bounds of a free field; either may be empty. Repeatable."),
]
RigOption = Annotated[
    list[str] | None,
    typer.Option("--rig", metavar="SCENE:DATA.csv", help="A further scene with its measurements. Repeatable."),
]
ErrorOption = Annotated[
    str,
    typer.Option("--relative-error", metavar="X", help="Assumed error of values that have none, e.g. '2 %'."),
]
KnownOption = Annotated[
    bool,
    typer.Option("--known-errors", help="The errors are those given, and not estimated from the differences."),
]
LevelOption = Annotated[str, typer.Option("--level", help="Confidence of the intervals, e.g. 0.95.")]
StartsOption = Annotated[int, typer.Option("--starts", min=1, help="Number of starting points.")]
FoldsOption = Annotated[
    int, typer.Option("--folds", min=0, help="Part the points into so many and predict each from the others; 0: none.")
]
NextOption = Annotated[
    Path | None,
    typer.Option(
        "--next",
        metavar="CANDIDATES.csv",
        help="Operating points of the first rig that could be measured next: which of them tells most?",
    ),
]
PredictOption = Annotated[
    list[str] | None,
    typer.Option(
        "--predict",
        metavar="SCENE=RESULT",
        help="A result of another scene with the calibrated fields, with its interval: turbine_roller="
        "power_loss.total. Repeatable.",
    ),
]
OutOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--out",
        metavar="FILE",
        help="FILE.toml: the first scene with the calibrated values; FILE.nc: the fields with what they share, and the "
        "samples of --posterior, for jaxbearing tolerances --posterior. Repeatable.",
    ),
]
PlotOption = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw measured and calculated values; .png, .svg or .pdf."),
]
OUT = ".toml", ".nc"


def calibrate(
    scene: SceneArgument,
    data: DataArgument,
    free: FreeOption,
    priors: PriorOption = None,
    bounds: BoundOption = None,
    rigs: RigOption = None,
    changes: SetOption = None,
    loss: LossOption = "linear",
    relative_error: ErrorOption = "2 %",
    known_errors: KnownOption = False,
    level: LevelOption = "0.95",
    starts: StartsOption = 1,
    folds: FoldsOption = 0,
    candidates: NextOption = None,
    predictions: PredictOption = None,
    posterior: PosteriorOption = False,
    samples: SamplesOption = 1000,
    as_json: JsonOption = False,
    out: OutOption = None,
    plot: PlotOption = None,
    plot_posterior: PlotPosteriorOption = None,
    force: ForceOption = False,
) -> None:
    """Any numbers of a scene from measured torque, power, temperature, speed or displacement at many operating points:
    values, intervals, and which of them the measurements cannot tell."""
    with bad_input():
        from fitting.io.typed import choice, ratio
        from fitting.loss import LOSSES

        from ..calibration.search import Options
        from ..calibration.sources import given_of
        from ..calibration.table import read_candidates
        from ..scenes.overrides import split_assignments

        options = Options(
            loss=choice("--loss", loss, LOSSES),
            relative_error=ratio("--relative-error", relative_error, "'2 %'"),
            known_errors=known_errors,
            level=ratio("--level", level, "0.95", largest=1.0),
            starts=starts,
        )
        _check(options.level, options.relative_error, folds)
        further = [_rig(text) for text in rigs or []]
        inputs = given_of([(scene, data), *further], split_assignments(changes or []), free, priors or [], bounds or [])
        wanted = None if candidates is None else read_candidates(candidates, inputs.sources[0])
        others = [_prediction(text) for text in predictions or []]
        sampling = sampling_of(posterior, samples, plot_posterior)
        pictures = ("--plot", plot, PICTURES), ("--plot-posterior", plot_posterior, PICTURES)
        check_files((*pictures, *(("--out", file, OUT) for file in out or [])), force)

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = " and ".join([labelled(scene, changes), *(name for name, _ in further)])
    enable_compilation_cache()
    with without_false_alarms():
        with working("compiling", as_json) as tell:
            calibration, ranked = _calibrated(inputs, options, folds, wanted, label, as_json, _counted(tell))
            outputs = lambda drawn, again: (
                *(_output(calibration, drawn, label, file, as_json) for file in out or []),
                Output(plot, lambda path: _write_plot(calibration, label, path), long=True),
                Output(
                    plot_posterior, lambda path: _write_posterior(calibration, drawn, again, label, path), long=True
                ),
            )
            plain = lambda: _print(calibration, label, inputs.notes, ranked, None, None, {}, as_json)
            files = outputs(None, None) if calibration.converged else ()
            with kept_if_interrupted(plain, files, "without what comes after the fit", tell.stop):
                if sampling is not None:
                    tell("sampling the posterior")
                drawn, again = _sampled(calibration, sampling)
                if others:
                    tell("predicting")
                predicted = _predicted(calibration, others, drawn)
        show = lambda: _print(calibration, label, inputs.notes, ranked, drawn, again, predicted, as_json)
        deliver(show, outputs(drawn, again) if calibration.converged else (), as_json=as_json)
    if not calibration.converged:
        left_out = [str(path) for path in (*(out or []), plot, plot_posterior) if path is not None]
        if left_out:
            typer.echo(f"not written: {', '.join(left_out)}", err=True)
        if as_json:
            typer.echo(f"{calibration.status.replace('_', ' ')}: {label}: {calibration.failure()}", err=True)
        raise typer.Exit(UNDETERMINED if calibration.undetermined else NOT_CONVERGED)


def _counted(tell: "Callable[[str], None]") -> "Callable[[int], None]":
    """Tells how many operating points have been solved."""
    solved = 0

    def count(points: int) -> None:
        nonlocal solved
        solved += points
        tell(f"calibrating, {solved} operating points solved")

    return count


def _check(level: float, relative_error: float, folds: int) -> None:
    """Message on options that make no sense."""
    if level == 0.0:
        refuse("--level: found 0; expected a number between 0 and 1, e.g. 0.95")
    if relative_error == 0.0:
        refuse("--relative-error: found 0; expected an error > 0")
    if folds == 1:
        refuse("--folds: found 1; expected 0, or 2 or more")


def _rig(text: str) -> tuple[str, Path]:
    scene, colon, file = text.rpartition(":")
    if not colon or not scene or not file:
        refuse(f"--rig: found '{text}'; expected SCENE:DATA.csv, e.g. turbine_roller:rig_2.csv")
    return scene, Path(file)


def _calibrated(
    inputs: "Given",
    options: Any,
    folds: int,
    candidates: Any,
    label: str,
    as_json: bool,
    progress: "Callable[[int], None]",
) -> "tuple[Calibration, tuple[Candidate, ...]]":
    """The calibration and its candidates; ends the command where these cannot be."""
    from ..calibration.next_point import next_points
    from ..calibration.verb import calibrate as calibrate_scenes
    from ..numerics.status import SolveError

    try:
        calibration = calibrate_scenes(
            inputs.scenes,
            inputs.data,
            inputs.free,
            priors=inputs.priors,
            bounds=inputs.bounds,
            folds=folds,
            options=options,
            progress=progress,
        )
        ranked = () if candidates is None or not calibration.converged else next_points(calibration, candidates)
    except SolveError as error:
        _print_failure(str(error), error.status.name.lower(), label, as_json)
        raise typer.Exit(NOT_CONVERGED) from None
    except ValueError as error:
        refuse(str(error))
    return calibration, ranked


def _sampled(calibration: "Calibration", sampling: Any) -> "tuple[Posterior | None, Predictive | None]":
    """The posterior that is asked for, of a calibration that converged, and what it predicts to be measured again; ends
    the command where they cannot be."""
    from ..calibration.posterior import posterior_of, predictive

    if sampling is None or not calibration.converged:
        return None, None
    try:
        drawn = posterior_of(calibration, sampling)
        return drawn, predictive(calibration, drawn)
    except ValueError as error:
        refuse(f"--{error}")


def _prediction(text: str) -> tuple[str, Any, str]:
    """Label, scene and result of a text SCENE=RESULT."""
    from ..scenes.reader import load_scene

    scene, equals, result = text.partition("=")
    if not (equals and scene.strip() and result.strip()):
        refuse(f"--predict: found '{text}'; expected SCENE=RESULT, e.g. turbine_roller=power_loss.total")
    return text, load_scene(scene.strip()), result.strip()


def _predicted(
    calibration: "Calibration", others: "list[tuple[str, AbstractScene, str]]", drawn: "Posterior | None"
) -> "dict[str, Predicted]":
    """Results of other scenes, of a calibration that converged; ends the command where there are none."""
    from ..calibration.prediction import predict

    if not calibration.converged:
        return {}
    predicted = {}
    for text, scene, result in others:
        try:
            (predicted[text],) = predict(calibration, scene, [result], posterior=drawn).values()
        except ValueError as error:
            refuse(f"--predict: {text}: {error}")
    return predicted


def _write_posterior(
    calibration: "Calibration", drawn: Any, again: "Predictive | None", label: str, path: Path
) -> None:
    write_posterior(drawn, again, {field.path: field.unit for field in calibration.fields}, label, path)


def _output(calibration: "Calibration", drawn: "Posterior | None", label: str, file: Path, as_json: bool) -> Output:
    """A file of `--out`: by its suffix the scene, or the fields with what they share."""
    if file.suffix.lower() == OUT[0]:
        text = "" if as_json else f"wrote {file}: the scene with the calibrated values"
        return Output(file, lambda path: _write_scene(calibration, path), text)
    text = "" if as_json else f"wrote {file}: the fields with what they share; jaxbearing tolerances --posterior {file}"
    return Output(file, lambda path: _write_joint(calibration, drawn, label, path), text)


def _write_joint(calibration: "Calibration", drawn: "Posterior | None", label: str, out: Path) -> None:
    from ..calibration.prediction import joint_of
    from ..report.joint_file import write_joint

    units = {field.path: field.unit for field in calibration.fields}
    write_joint(joint_of(calibration, drawn), units, out, f"Calibration of {label}")


def _write_scene(calibration: "Calibration", out: Path) -> None:
    from ..scenes.save import save_scene

    save_scene(calibration.scenes[0], out)


def _write_plot(calibration: "Calibration", label: str, plot: Path) -> None:
    from ..plots import calibration as draw
    from ..report.plots import save_plot

    save_plot(draw(calibration, title=label), plot)


def _print(
    calibration: "Calibration",
    label: str,
    notes: list[str],
    ranked: "tuple[Candidate, ...]",
    drawn: "Posterior | None",
    again: "Predictive | None",
    predicted: "dict[str, Predicted]",
    as_json: bool,
) -> None:
    from ..calibration.report import calibration_to_dict, print_calibration

    if as_json:
        typer.echo(
            json.dumps(calibration_to_dict(calibration, notes, ranked, drawn, predicted, again), allow_nan=False)
        )
    else:
        print_calibration(calibration, label, notes, ranked, drawn, predicted, console(), again)


def _print_failure(failure: str, status: str, label: str, as_json: bool) -> None:
    if as_json:
        typer.echo(json.dumps({"converged": False, "status": status, "failure": failure}))
        typer.echo(f"not converged: {label}: {failure}", err=True)
        return
    from ..report.backends.screen import print_failure

    print_failure(label, status.replace("_", " "), failure, console())
