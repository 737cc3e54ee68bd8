"""Scatter of results on the screen, as JSON and as a data set."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import xarray as xr
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table

from .._version import __version__
from ..distribution import Distribution
from ..loss_interval import not_counted
from ..report.backends.json import finite
from ..report.backends.screen import counted, headline, print_line, print_rule, print_warnings
from ..report.display import digits, displayed, span, with_unit
from ..report.labels import label_unit, udunits
from .outcome import Sampled, Spread, Tolerances

CLEARANCE = "fit.clearance"
POWER = "power_loss.total"
_LEAST = 0.005
"""Contribution below which a field is not named on the screen."""
_REASONS = 3
"""Reasons of failed samples that are shown."""


def print_tolerances(tolerances: Tolerances, label: str, seconds: float, console: Console) -> None:
    """Prints fields, results, contributions and notes."""
    samples = tolerances.samples
    state = f"{counted(len(tolerances.fields), 'field')} with a tolerance, delta method"
    if samples is not None:
        state += f", Monte Carlo with {counted(samples.count, 'sample')} (seed {samples.seed})"
    failed = 0 if samples is None else samples.count - samples.converged
    status, style = ("CONVERGED", "bold green") if not failed else (f"{failed} SAMPLES FAILED", "bold red")
    headline(label, status, style, f"{state}; {seconds:.1f} s", console)
    print_rule("Fields", console)
    for path, field in tolerances.fields.items():
        print_line(
            path, _field(field, label_unit(tolerances.units[path]), tolerances.origins.get(path, "")), console, 32
        )
    print_rule("Results", console)
    console.print(Padding(_results(tolerances), (0, 1)))
    for text in _likely(tolerances):
        print_line("power loss", text, console)
    for text in _preloaded(tolerances):
        print_line("preload", text, console)
    print_rule("Share of each field in the variance", console)
    for name, spread in tolerances.results.items():
        print_line(short(name), _shares(spread), console, 32)
    print_warnings([*_failures(tolerances), *tolerances.warnings], console)


def short(name: str) -> str:
    """The name of a result without the prefix of the results of rolling elements."""
    return name.removeprefix("elements.")


def _field(field: Distribution, unit: str, origin: str) -> str:
    text = "" if field.median is None else f"median {with_unit(field.median, unit)}, mean "
    text += f"{with_unit(field.mean, unit)}, deviation {with_unit(field.deviation, unit)}, {field.shape}, "
    text += span(field.lowest, field.highest, unit)
    return f"{text} ({origin})" if origin else text


def _results(tolerances: Tolerances) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column("", no_wrap=True)
    for title in ("mean", "deviation", "limits", "worst cases"):
        table.add_column(title, justify="right", overflow="fold")
    for name, spread in tolerances.results.items():
        unit = spread.unit
        shown = lambda value, unit=unit, size=spread.mean: displayed(value, unit, size)
        worst = _range(spread.worst_low, spread.worst_high, shown)
        mean, deviation = (with_unit(value, unit) for value in (spread.mean, spread.deviation))
        table.add_row(short(name), mean, deviation, _range(spread.low, spread.high, shown), worst)
        if spread.sampled is not None:
            table.add_row("  Monte Carlo", *_sampled(spread.sampled, unit, shown), "")
    return table


def _range(low: float, high: float, shown: Callable[[float], float]) -> str:
    """Text of a range. **Arguments:** `shown`: gives a number in the unit of the row's mean."""
    return f"{digits(shown(low))} to {digits(shown(high))}"


def _sampled(sampled: Sampled, unit: str, shown: Callable[[float], float]) -> Iterator[str]:
    yield f"{digits(shown(sampled.mean))} ± {digits(shown(sampled.mean_error), 2)}"
    size = sampled.deviation
    yield f"{digits(displayed(size, unit, size))} ± {digits(displayed(sampled.deviation_error, unit, size), 2)}"
    yield _range(sampled.low, sampled.high, shown)


def _shares(spread: Spread) -> str:
    if not spread.moves:
        return "not changed by these fields"
    large = sorted(spread.contributions.items(), key=lambda item: -item[1])
    named = [f"{path} {100.0 * share:.1f} %" for path, share in large if abs(share) >= _LEAST]
    return ", ".join(named) or "none by its derivatives at the means"


def _preloaded(tolerances: Tolerances) -> Iterator[str]:
    """Says how many of the bearings have a negative clearance."""
    spread = tolerances.results.get(CLEARANCE)
    if spread is not None:
        text = f"radial, in {_percent(spread.below_zero)} of the bearings by the normal distribution"
        yield text if spread.sampled is None else f"{text}, in {_percent(spread.sampled.below_zero)} of the samples"


def _likely(tolerances: Tolerances) -> Iterator[str]:
    """Total loss, its likely limits, and the field that contributes most to its scatter."""
    spread = tolerances.results.get(POWER)
    if spread is None or not spread.moves or not spread.deviation:
        return
    low, high = (with_unit(value, spread.unit) for value in spread.likely)
    path, share = max(spread.contributions.items(), key=lambda item: item[1])
    by = "by" if share > 1.0 - _LEAST else "mostly by" if share > 0.5 else "first of all by"
    text = f"{with_unit(spread.value, spread.unit)}, 90 % between {low} and {high}, {by} {path}"
    yield f"{text}; counted: only the fields above; {not_counted(tolerances.fields)}"


def _percent(share: float) -> str:
    return f"{digits(100.0 * share, 3)} %"


def _failures(tolerances: Tolerances) -> Iterator[str]:
    samples = tolerances.samples
    if samples is None or not samples.failures:
        return
    yield f"the statistics are those of the {samples.converged} of {samples.count} samples that have results"
    for text, count in list(samples.failures.items())[:_REASONS]:
        yield f"{counted(count, 'sample')} failed: {text}"
    if len(samples.failures) > _REASONS:
        yield f"{counted(sum(list(samples.failures.values())[_REASONS:]), 'sample')} failed otherwise"


def tolerances_to_dict(tolerances: Tolerances) -> dict[str, Any]:
    """All numbers in SI units; those that are not finite are `None`."""
    samples = tolerances.samples
    sampling = None
    if samples is not None:
        sampling = {"count": samples.count, "converged": samples.converged}
        sampling |= {"failed": samples.count - samples.converged, "failures": dict(samples.failures)}
        sampling |= {"seed": samples.seed, "file": samples.file}
    return {
        "converged": True,
        "status": "converged",
        "warnings": list(tolerances.warnings),
        "fields": {
            path: {
                "mean": field.mean,
                "deviation": field.deviation,
                "shape": field.shape,
                "median": field.median,
                "low": field.lowest,
                "high": field.highest,
                "unit": tolerances.units[path],
                "origin": tolerances.origins.get(path),
            }
            for path, field in tolerances.fields.items()
        },
        "not_counted": not_counted(tolerances.fields),
        "tolerances": {name: _spread(name, spread) for name, spread in tolerances.results.items()},
        "samples": sampling,
    }


def _spread(name: str, spread: Spread) -> dict[str, Any]:
    numbers = ("value", "mean", "deviation", "low", "high", "worst_low", "worst_high")
    entry: dict[str, Any] = {word: finite(getattr(spread, word)) for word in numbers}
    entry |= {
        "likely": [finite(value) for value in spread.likely],
        "unit": spread.unit,
        "description": spread.description,
    }
    entry |= {
        word: {p: finite(v) for p, v in getattr(spread, word).items()} for word in ("contributions", "derivatives")
    }
    sampled = spread.sampled
    words = ("mean", "mean_error", "deviation", "deviation_error", "low", "high")
    if name == CLEARANCE:
        entry["below_zero"] = spread.below_zero
        words = (*words, "below_zero")
    entry["monte_carlo"] = None if sampled is None else {word: finite(getattr(sampled, word)) for word in words}
    return entry


def tolerances_to_dataset(tolerances: Tolerances, label: str) -> xr.Dataset:
    """All numbers with the dimensions `result` and `field`; units differ along both and stand in `result_units` and
    `field_units`."""
    spreads, fields = list(tolerances.results.values()), list(tolerances.fields.items())
    of_result = lambda text: {"units": "see result_units", "long_name": text}
    made = xr.Dataset(
        attrs={
            "title": f"Tolerances of {label}",
            "source": f"jaxbearing {__version__}",
            "jaxbearing_version": __version__,
            "warnings": "\n".join(tolerances.warnings),
        }
    )
    for word, text in _OF_RESULTS.items():
        made[word] = ("result", [getattr(spread, word) for spread in spreads], of_result(text))
    for word, text, units in (
        ("contributions", "share of a field in the variance of a result", "1"),
        ("derivatives", "derivative of a result by a field", "result_units over field_units"),
    ):
        table = [[getattr(spread, word)[path] for path, _ in fields] for spread in spreads]
        made[word] = (("result", "field"), table, {"units": units, "long_name": text})
    for word, text in _OF_FIELDS.items():
        values = [getattr(field, word.removeprefix("field_")) for _, field in fields]
        made[word] = ("field", values, {"units": "see field_units", "long_name": text})
    if tolerances.samples is not None:
        for word in _OF_SAMPLES:
            values = [np.nan if spread.sampled is None else getattr(spread.sampled, word) for spread in spreads]
            made[f"monte_carlo_{word}"] = ("result", values, of_result(f"{word.replace('_', ' ')}, of random samples"))
        counts = {
            "count": tolerances.samples.count,
            "converged": tolerances.samples.converged,
            "seed": tolerances.samples.seed,
        }
        made.attrs |= {f"samples_{word}": value for word, value in counts.items()}
        made.attrs |= {"samples_failures": "\n".join(f"{n}: {text}" for text, n in tolerances.samples.failures.items())}
        made.attrs |= {"samples_file": tolerances.samples.file or ""}
    return made.assign_coords(
        result=("result", list(tolerances.results), {"units": "1", "long_name": "result"}),
        result_units=("result", [udunits_or_text(spread.unit) for spread in spreads], _UNIT),
        result_long_name=(
            "result",
            [spread.description for spread in spreads],
            {"units": "1", "long_name": "description"},
        ),
        field=("field", [path for path, _ in fields], {"units": "1", "long_name": "field of the scene"}),
        field_units=("field", [tolerances.units[path] for path, _ in fields], _UNIT),
        field_shape=("field", [field.shape for _, field in fields], {"units": "1", "long_name": "distribution"}),
    )


_UNIT = {"units": "1", "long_name": "SI unit"}
_OF_RESULTS = {
    "value": "result of the scene whose fields have their means",
    "mean": "mean by the delta method",
    "deviation": "standard deviation by the delta method",
    "worst_low": "result in the worst case to the low side",
    "worst_high": "result in the worst case to the high side",
    "likely_low": "result below which 5 % of the bearings are by the delta method",
    "likely_high": "result below which 95 % of the bearings are by the delta method",
}
_OF_FIELDS = {
    "field_mean": "mean of a field",
    "field_deviation": "standard deviation of a field",
    "field_lowest": "low limit of a field",
    "field_highest": "high limit of a field",
}
_OF_SAMPLES = ("mean", "mean_error", "deviation", "deviation_error", "low", "high")


def udunits_or_text(unit: str) -> str:
    """A unit of the labels in UDUNITS's form; unchanged if it has no such form."""
    try:
        return udunits(unit)
    except ValueError:
        return unit
