"""A calibration on the screen and as JSON."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table

from fitting.posterior import Posterior
from fitting.predictive import Predictive

from ..report.backends.json import finite
from ..report.backends.screen import counted, headline, print_failure, print_line, print_rule, print_warnings
from ..report.display import digits, displayed, span, with_unit
from ..report.labels import label_unit
from ..sweeps.fields import label_of
from .next_point import Candidate
from .prediction import Predicted
from .result import Calibration

CANDIDATES = 10
"""Largest number of candidates that are shown, the best first."""
STRONG = 0.5
"""Magnitude of a correlation from which two fields are named."""


def print_calibration(
    calibration: Calibration,
    label: str,
    notes: Iterable[str],
    ranked: Sequence[Candidate],
    posterior: Posterior | None,
    predicted: Mapping[str, Predicted],
    console: Console,
    again: Predictive | None = None,
) -> None:
    """Print a calibration or, if it failed, only the reason.

    **Arguments:** `label`: names of scenes and files; `notes`: notes on these; `ranked`: candidates; `posterior`:
    samples, or `None`; `predicted`: results of other scenes; `again`: prediction of a repeated measurement.
    """
    if calibration.status == "not_converged":
        print_failure(label, "not converged", calibration.failure(), console)
        return
    values = counted(len(calibration.measured), "value")
    state = f"{values}, {counted(len(calibration.fitted), 'field')} fitted, {calibration.options.loss} loss"
    headline(
        label, calibration.status.upper(), "bold green" if calibration.converged else "bold yellow", state, console
    )
    if not calibration.converged:
        print_line("why", calibration.reason, console)
    print_rule(f"Fields, {100.0 * calibration.options.level:g} % intervals", console)
    console.print(Padding(_fields(calibration), (0, 1)))
    print_rule("Measured and calculated", console)
    console.print(Padding(_misfits(calibration), (0, 1)))
    if calibration.held_back is not None:
        held_back = calibration.held_back
        text = (
            f"{counted(len(held_back.place), 'value')} predicted without a fit to it, "
            f"{100.0 * held_back.relative:.3g} % rms; "
        )
        print_line("held back", f"{text}{100.0 * held_back.inside:.0f} % inside their intervals", console)
    for text in _together(calibration):
        print_line("correlation", text, console)
    if posterior is not None:
        print_rule("Posterior", console)
        console.print(Padding(_posterior(calibration, posterior), (0, 1)))
        print_line("sampler", posterior.in_words(), console)
    if again is not None:
        print_line("predictive", again.in_words(), console)
    if predicted:
        print_rule("Predictions with these fields", console)
        console.print(Padding(_predictions(predicted), (0, 1)))
    if ranked:
        print_rule("Next operating point, the one that tells most first", console)
        console.print(Padding(_ranked(calibration, ranked), (0, 1)))
    print_warnings([*calibration.notes, *([] if posterior is None else posterior.warnings), *notes], console)


def _table(*columns: str) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column(columns[0], no_wrap=True)
    for title in columns[1:]:
        table.add_column(title, justify="right", overflow="fold")
    return table


def _fields(calibration: Calibration) -> Table:
    table = _table("", "value", "std. error", "interval", "start")
    for field in calibration.fields:
        parameter, unit = calibration.parameters[field.path], field.unit
        start = with_unit(field.start, unit)
        if parameter.standard_error is None or parameter.lower is None or parameter.upper is None:
            why = f"{'held' if parameter.fixed else 'no interval'}: {parameter.reason}"
            table.add_row(field.path, with_unit(parameter.value, unit), "", why, start)
            continue
        in_unit = lambda value, size=parameter.value, unit=unit: displayed(value, unit, size)
        error = digits(in_unit(parameter.value + parameter.standard_error) - in_unit(parameter.value), 2)
        table.add_row(
            field.path, with_unit(parameter.value, unit), error, span(parameter.lower, parameter.upper, unit), start
        )
    return table


def _misfits(calibration: Calibration) -> Table:
    table = _table("", "values", "rms difference", "mean difference", "rms, relative")
    several = len(calibration.data) > 1
    for misfit in calibration.misfits:
        name = f"{calibration.data[misfit.rig].origin}: {misfit.name}" if several else misfit.name
        shown = (_difference(part, misfit.unit) for part in (misfit.rms, misfit.mean))
        table.add_row(name, str(misfit.points), *shown, f"{100.0 * misfit.relative:.3g} %")
    return table


def _difference(value: float, unit: str) -> str:
    return f"{digits(value, 3)} K" if unit == "K" else with_unit(value, unit)


def _together(calibration: Calibration) -> Iterable[str]:
    for i, first in enumerate(calibration.fitted):
        for j in range(i):
            value = float(calibration.correlation[i, j])
            if abs(value) >= STRONG:
                yield f"{calibration.fitted[j]} and {first}: {value:.2f}"


def _predictions(predicted: Mapping[str, Predicted]) -> Table:
    table = _table("", "value", "interval", "interval by the priors alone")
    ends = lambda result: span(result.lower, result.upper, result.unit)
    for name, prediction in predicted.items():
        table.add_row(
            name,
            with_unit(prediction.value, prediction.unit),
            ends(prediction),
            "" if prediction.before is None else ends(prediction.before),
        )
    return table


def _ranked(calibration: Calibration, ranked: Sequence[Candidate]) -> Table:
    paths = list(ranked[0].conditions)
    last = lambda path: path.rpartition(".")[2]
    table = _table(
        "candidate", *map(last, paths), "information", *(f"error of {last(path)}" for path in calibration.fitted)
    )
    unit_of = {path: label_unit(label_of(calibration.scenes[0], path)["units"]) for path in paths}
    units = {field.path: field.unit for field in calibration.fields}
    for candidate in ranked[:CANDIDATES]:
        information = "no solution" if not math.isfinite(candidate.information) else f"{candidate.information:.3f}"
        errors = [
            "" if not math.isfinite(candidate.information) else _error(candidate, p, units[p])
            for p in calibration.fitted
        ]
        values = (with_unit(candidate.conditions[path], unit_of[path]) for path in paths)
        table.add_row(str(candidate.place + 1), *values, information, *errors)
    return table


def _error(candidate: Candidate, path: str, unit: str) -> str:
    return _difference(candidate.standard_errors[path], unit)


def _posterior(calibration: Calibration, posterior: Posterior) -> Table:
    table = _table("", "median", "interval", "R-hat", "effective samples")
    units = {field.path: field.unit for field in calibration.fields}
    for path, parameter in posterior.parameters.items():
        unit = units[path]
        ends = span(parameter.lower, parameter.upper, unit)
        table.add_row(
            path, with_unit(parameter.median, unit), ends, f"{parameter.r_hat:.4f}", f"{parameter.effective:.0f}"
        )
    return table


def calibration_to_dict(
    calibration: Calibration,
    notes: Iterable[str],
    ranked: Sequence[Candidate] = (),
    posterior: Posterior | None = None,
    predicted: Mapping[str, Predicted] = {},
    again: Predictive | None = None,
) -> dict[str, Any]:
    """A calibration as plain values in SI; numbers that are not finite are `None`. **Arguments:** as for
    `print_calibration`."""
    parameters = {path: parameter._asdict() for path, parameter in calibration.parameters.items()}
    for field in calibration.fields:
        parameters[field.path] |= {"unit": field.unit, "start": field.start}
    whole: dict[str, Any] = {
        "converged": calibration.converged,
        "status": calibration.status,
        "failure": None if calibration.converged else calibration.failure(),
        "parameters": parameters,
        "fitted": list(calibration.fitted),
        "unidentifiable": [path for path, parameter in calibration.parameters.items() if parameter.fixed],
        "correlation": calibration.correlation.tolist(),
        "error_scale": calibration.scale,
        "loss": calibration.loss,
        "evaluations": calibration.evaluations,
        "misfits": [vars(misfit) for misfit in calibration.misfits],
        "values": [
            {"rig": int(rig), "point": int(point), "name": name, "measured": m, "predicted": p, "deviation": d}
            for rig, point, name, m, p, d in zip(
                *(calibration.rigs, calibration.points, calibration.names),
                *(
                    map(float, part)
                    for part in (calibration.measured, calibration.predicted, calibration.scale * calibration.deviation)
                ),
                strict=True,
            )
        ],
        "held_back": None,
        "predictions": {name: asdict(prediction) for name, prediction in predicted.items()},
        "next": [candidate.__dict__ for candidate in ranked],
        "posterior": None if posterior is None else posterior.to_dict(),
        "predictive": None if again is None else again.to_dict(),
        "warnings": [*calibration.notes, *([] if posterior is None else posterior.warnings), *notes],
    }
    if calibration.held_back is not None:
        held_back = calibration.held_back
        whole["held_back"] = {
            "values": [int(place) for place in held_back.place],
            "predicted": np.asarray(held_back.predicted).tolist(),
            "deviation": np.asarray(held_back.deviation).tolist(),
            "inside": held_back.inside,
            "relative": held_back.relative,
            "converged": held_back.converged,
        }
    return finite(whole)
