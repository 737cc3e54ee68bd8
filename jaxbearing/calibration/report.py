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
    found: Calibration,
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
    if found.status == "not_converged":
        print_failure(label, "not converged", found.failure(), console)
        return
    values = counted(len(found.measured), "value")
    state = f"{values}, {counted(len(found.fitted), 'field')} fitted, {found.options.loss} loss"
    headline(label, found.status.upper(), "bold green" if found.converged else "bold yellow", state, console)
    if not found.converged:
        print_line("why", found.reason, console)
    print_rule(f"Fields, {100.0 * found.options.level:g} % intervals", console)
    console.print(Padding(_fields(found), (0, 1)))
    print_rule("Measured and calculated", console)
    console.print(Padding(_misfits(found), (0, 1)))
    if found.held_back is not None:
        one = found.held_back
        text = f"{counted(len(one.place), 'value')} predicted without a fit to it, {100.0 * one.relative:.3g} % rms; "
        print_line("held back", f"{text}{100.0 * one.inside:.0f} % inside their intervals", console)
    for text in _together(found):
        print_line("correlation", text, console)
    if posterior is not None:
        print_rule("Posterior", console)
        console.print(Padding(_posterior(found, posterior), (0, 1)))
        print_line("sampler", posterior.in_words(), console)
    if again is not None:
        print_line("predictive", again.in_words(), console)
    if predicted:
        print_rule("Predictions with these fields", console)
        console.print(Padding(_predictions(predicted), (0, 1)))
    if ranked:
        print_rule("Next operating point, the one that tells most first", console)
        console.print(Padding(_ranked(found, ranked), (0, 1)))
    print_warnings([*found.notes, *([] if posterior is None else posterior.warnings), *notes], console)


def _table(*columns: str) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column(columns[0], no_wrap=True)
    for title in columns[1:]:
        table.add_column(title, justify="right", overflow="fold")
    return table


def _fields(found: Calibration) -> Table:
    table = _table("", "value", "std. error", "interval", "start")
    for field in found.fields:
        one, unit = found.parameters[field.path], field.unit
        start = with_unit(field.start, unit)
        if one.standard_error is None or one.lower is None or one.upper is None:
            why = f"{'held' if one.fixed else 'no interval'}: {one.reason}"
            table.add_row(field.path, with_unit(one.value, unit), "", why, start)
            continue
        in_unit = lambda value, size=one.value, unit=unit: displayed(value, unit, size)
        error = digits(in_unit(one.value + one.standard_error) - in_unit(one.value), 2)
        table.add_row(field.path, with_unit(one.value, unit), error, span(one.lower, one.upper, unit), start)
    return table


def _misfits(found: Calibration) -> Table:
    table = _table("", "values", "rms difference", "mean difference", "rms, relative")
    several = len(found.data) > 1
    for one in found.misfits:
        name = f"{found.data[one.rig].origin}: {one.name}" if several else one.name
        shown = (_difference(part, one.unit) for part in (one.rms, one.mean))
        table.add_row(name, str(one.points), *shown, f"{100.0 * one.relative:.3g} %")
    return table


def _difference(value: float, unit: str) -> str:
    return f"{digits(value, 3)} K" if unit == "K" else with_unit(value, unit)


def _together(found: Calibration) -> Iterable[str]:
    for i, first in enumerate(found.fitted):
        for j in range(i):
            value = float(found.correlation[i, j])
            if abs(value) >= STRONG:
                yield f"{found.fitted[j]} and {first}: {value:.2f}"


def _predictions(predicted: Mapping[str, Predicted]) -> Table:
    table = _table("", "value", "interval", "interval by the priors alone")
    ends = lambda one: span(one.lower, one.upper, one.unit)
    for name, one in predicted.items():
        table.add_row(name, with_unit(one.value, one.unit), ends(one), "" if one.before is None else ends(one.before))
    return table


def _ranked(found: Calibration, ranked: Sequence[Candidate]) -> Table:
    paths = list(ranked[0].conditions)
    last = lambda path: path.rpartition(".")[2]
    table = _table("candidate", *map(last, paths), "information", *(f"error of {last(path)}" for path in found.fitted))
    unit_of = {path: label_unit(label_of(found.scenes[0], path)["units"]) for path in paths}
    units = {field.path: field.unit for field in found.fields}
    for one in ranked[:CANDIDATES]:
        told = "no solution" if not math.isfinite(one.information) else f"{one.information:.3f}"
        errors = ["" if not math.isfinite(one.information) else _error(one, p, units[p]) for p in found.fitted]
        values = (with_unit(one.conditions[path], unit_of[path]) for path in paths)
        table.add_row(str(one.place + 1), *values, told, *errors)
    return table


def _error(one: Candidate, path: str, unit: str) -> str:
    return _difference(one.standard_errors[path], unit)


def _posterior(found: Calibration, posterior: Posterior) -> Table:
    table = _table("", "median", "interval", "R-hat", "effective samples")
    units = {field.path: field.unit for field in found.fields}
    for path, one in posterior.parameters.items():
        unit = units[path]
        ends = span(one.lower, one.upper, unit)
        table.add_row(path, with_unit(one.median, unit), ends, f"{one.r_hat:.4f}", f"{one.effective:.0f}")
    return table


def calibration_to_dict(
    found: Calibration,
    notes: Iterable[str],
    ranked: Sequence[Candidate] = (),
    posterior: Posterior | None = None,
    predicted: Mapping[str, Predicted] = {},
    again: Predictive | None = None,
) -> dict[str, Any]:
    """A calibration as plain values in SI; numbers that are not finite are `None`. **Arguments:** as for
    `print_calibration`."""
    parameters = {path: one._asdict() for path, one in found.parameters.items()}
    for field in found.fields:
        parameters[field.path] |= {"unit": field.unit, "start": field.start}
    whole: dict[str, Any] = {
        "converged": found.converged,
        "status": found.status,
        "failure": None if found.converged else found.failure(),
        "parameters": parameters,
        "fitted": list(found.fitted),
        "unidentifiable": [path for path, one in found.parameters.items() if one.fixed],
        "correlation": found.correlation.tolist(),
        "error_scale": found.scale,
        "loss": found.loss,
        "evaluations": found.evaluations,
        "misfits": [vars(one) for one in found.misfits],
        "values": [
            {"rig": int(rig), "point": int(point), "name": name, "measured": m, "predicted": p, "deviation": d}
            for rig, point, name, m, p, d in zip(
                *(found.rigs, found.points, found.names),
                *(map(float, part) for part in (found.measured, found.predicted, found.scale * found.deviation)),
                strict=True,
            )
        ],
        "held_back": None,
        "predictions": {name: asdict(one) for name, one in predicted.items()},
        "next": [one.__dict__ for one in ranked],
        "posterior": None if posterior is None else posterior.to_dict(),
        "predictive": None if again is None else again.to_dict(),
        "warnings": [*found.notes, *([] if posterior is None else posterior.warnings), *notes],
    }
    if found.held_back is not None:
        one = found.held_back
        whole["held_back"] = {
            "values": [int(place) for place in one.place],
            "predicted": np.asarray(one.predicted).tolist(),
            "deviation": np.asarray(one.deviation).tolist(),
            "inside": one.inside,
            "relative": one.relative,
            "converged": one.converged,
        }
    return finite(whole)
