"""Scatter of results on the screen, as JSON and as a data set."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import xarray as xr
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table

from .. import __version__
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


def print_tolerances(found: Tolerances, label: str, seconds: float, console: Console) -> None:
    """Prints fields, results, contributions and notes."""
    samples = found.samples
    state = f"{counted(len(found.fields), 'field')} with a tolerance, delta method"
    if samples is not None:
        state += f", Monte Carlo with {counted(samples.count, 'sample')} (seed {samples.seed})"
    failed = 0 if samples is None else samples.count - samples.converged
    status, style = ("CONVERGED", "bold green") if not failed else (f"{failed} SAMPLES FAILED", "bold red")
    headline(label, status, style, f"{state}; {seconds:.1f} s", console)
    print_rule("Fields", console)
    for path, one in found.fields.items():
        print_line(path, _field(one, label_unit(found.units[path]), found.origins.get(path, "")), console, 32)
    print_rule("Results", console)
    console.print(Padding(_results(found), (0, 1)))
    for text in _likely(found):
        print_line("power loss", text, console)
    for text in _preloaded(found):
        print_line("preload", text, console)
    print_rule("Share of each field in the variance", console)
    for name, spread in found.results.items():
        print_line(short(name), _shares(spread), console, 32)
    print_warnings([*_failures(found), *found.warnings], console)


def short(name: str) -> str:
    """The name of a result without the prefix of the results of rolling elements."""
    return name.removeprefix("elements.")


def _field(one: Distribution, unit: str, origin: str) -> str:
    text = "" if one.median is None else f"median {with_unit(one.median, unit)}, mean "
    text += f"{with_unit(one.mean, unit)}, deviation {with_unit(one.deviation, unit)}, {one.shape}, "
    text += span(one.lowest, one.highest, unit)
    return f"{text} ({origin})" if origin else text


def _results(found: Tolerances) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column("", no_wrap=True)
    for title in ("mean", "deviation", "limits", "worst cases"):
        table.add_column(title, justify="right", overflow="fold")
    for name, one in found.results.items():
        unit = one.unit
        shown = lambda value, unit=unit, size=one.mean: displayed(value, unit, size)
        worst = _range(one.worst_low, one.worst_high, shown)
        mean, deviation = (with_unit(value, unit) for value in (one.mean, one.deviation))
        table.add_row(short(name), mean, deviation, _range(one.low, one.high, shown), worst)
        if one.sampled is not None:
            table.add_row("  Monte Carlo", *_sampled(one.sampled, unit, shown), "")
    return table


def _range(low: float, high: float, shown: Callable[[float], float]) -> str:
    """Text of a range. **Arguments:** `shown`: gives a number in the unit of the row's mean."""
    return f"{digits(shown(low))} to {digits(shown(high))}"


def _sampled(one: Sampled, unit: str, shown: Callable[[float], float]) -> Iterator[str]:
    yield f"{digits(shown(one.mean))} ± {digits(shown(one.mean_error), 2)}"
    size = one.deviation
    yield f"{digits(displayed(size, unit, size))} ± {digits(displayed(one.deviation_error, unit, size), 2)}"
    yield _range(one.low, one.high, shown)


def _shares(spread: Spread) -> str:
    if not spread.moves:
        return "not changed by these fields"
    large = sorted(spread.contributions.items(), key=lambda item: -item[1])
    named = [f"{path} {100.0 * share:.1f} %" for path, share in large if abs(share) >= _LEAST]
    return ", ".join(named) or "none by its derivatives at the means"


def _preloaded(found: Tolerances) -> Iterator[str]:
    """Says how many of the bearings have a negative clearance."""
    spread = found.results.get(CLEARANCE)
    if spread is not None:
        text = f"radial, in {_percent(spread.below_zero)} of the bearings by the normal distribution"
        yield text if spread.sampled is None else f"{text}, in {_percent(spread.sampled.below_zero)} of the samples"


def _likely(found: Tolerances) -> Iterator[str]:
    """Total loss, its likely limits, and the field that contributes most to its scatter."""
    spread = found.results.get(POWER)
    if spread is None or not spread.moves or not spread.deviation:
        return
    low, high = (with_unit(value, spread.unit) for value in spread.likely)
    path, share = max(spread.contributions.items(), key=lambda item: item[1])
    by = "by" if share > 1.0 - _LEAST else "mostly by" if share > 0.5 else "first of all by"
    said = f"{with_unit(spread.value, spread.unit)}, 90 % between {low} and {high}, {by} {path}"
    yield f"{said}; counted: only the fields above; {not_counted(found.fields)}"


def _percent(share: float) -> str:
    return f"{digits(100.0 * share, 3)} %"


def _failures(found: Tolerances) -> Iterator[str]:
    samples = found.samples
    if samples is None or not samples.failures:
        return
    yield f"the statistics are those of the {samples.converged} of {samples.count} samples that have results"
    for text, count in list(samples.failures.items())[:_REASONS]:
        yield f"{counted(count, 'sample')} failed: {text}"
    if len(samples.failures) > _REASONS:
        yield f"{counted(sum(list(samples.failures.values())[_REASONS:]), 'sample')} failed otherwise"


def tolerances_to_dict(found: Tolerances) -> dict[str, Any]:
    """All numbers in SI units; those that are not finite are `None`."""
    samples = found.samples
    sampling = None
    if samples is not None:
        sampling = {"count": samples.count, "converged": samples.converged}
        sampling |= {"failed": samples.count - samples.converged, "failures": dict(samples.failures)}
        sampling |= {"seed": samples.seed, "file": samples.file}
    return {
        "converged": True,
        "status": "converged",
        "warnings": list(found.warnings),
        "fields": {
            path: {
                "mean": one.mean,
                "deviation": one.deviation,
                "shape": one.shape,
                "median": one.median,
                "low": one.lowest,
                "high": one.highest,
                "unit": found.units[path],
                "origin": found.origins.get(path),
            }
            for path, one in found.fields.items()
        },
        "not_counted": not_counted(found.fields),
        "tolerances": {name: _spread(name, one) for name, one in found.results.items()},
        "samples": sampling,
    }


def _spread(name: str, one: Spread) -> dict[str, Any]:
    numbers = ("value", "mean", "deviation", "low", "high", "worst_low", "worst_high")
    said: dict[str, Any] = {word: finite(getattr(one, word)) for word in numbers}
    said |= {"likely": [finite(value) for value in one.likely], "unit": one.unit, "description": one.description}
    said |= {word: {p: finite(v) for p, v in getattr(one, word).items()} for word in ("contributions", "derivatives")}
    sampled = one.sampled
    words = ("mean", "mean_error", "deviation", "deviation_error", "low", "high")
    if name == CLEARANCE:
        said["below_zero"] = one.below_zero
        words = (*words, "below_zero")
    said["monte_carlo"] = None if sampled is None else {word: finite(getattr(sampled, word)) for word in words}
    return said


def tolerances_to_dataset(found: Tolerances, label: str) -> xr.Dataset:
    """All numbers with the dimensions `result` and `field`; units differ along both and stand in `result_units` and
    `field_units`."""
    spreads, fields = list(found.results.values()), list(found.fields.items())
    of_result = lambda text: {"units": "see result_units", "long_name": text}
    made = xr.Dataset(
        attrs={
            "title": f"Tolerances of {label}",
            "source": f"jaxbearing {__version__}",
            "jaxbearing_version": __version__,
            "warnings": "\n".join(found.warnings),
        }
    )
    for word, text in _OF_RESULTS.items():
        made[word] = ("result", [getattr(one, word) for one in spreads], of_result(text))
    for word, text, units in (
        ("contributions", "share of a field in the variance of a result", "1"),
        ("derivatives", "derivative of a result by a field", "result_units over field_units"),
    ):
        table = [[getattr(one, word)[path] for path, _ in fields] for one in spreads]
        made[word] = (("result", "field"), table, {"units": units, "long_name": text})
    for word, text in _OF_FIELDS.items():
        values = [getattr(one, word.removeprefix("field_")) for _, one in fields]
        made[word] = ("field", values, {"units": "see field_units", "long_name": text})
    if found.samples is not None:
        for word in _OF_SAMPLES:
            values = [np.nan if one.sampled is None else getattr(one.sampled, word) for one in spreads]
            made[f"monte_carlo_{word}"] = ("result", values, of_result(f"{word.replace('_', ' ')}, of random samples"))
        counts = {"count": found.samples.count, "converged": found.samples.converged, "seed": found.samples.seed}
        made.attrs |= {f"samples_{word}": value for word, value in counts.items()}
        made.attrs |= {"samples_failures": "\n".join(f"{n}: {text}" for text, n in found.samples.failures.items())}
        made.attrs |= {"samples_file": found.samples.file or ""}
    return made.assign_coords(
        result=("result", list(found.results), {"units": "1", "long_name": "result"}),
        result_units=("result", [udunits_or_text(one.unit) for one in spreads], _UNIT),
        result_long_name=("result", [one.description for one in spreads], {"units": "1", "long_name": "description"}),
        field=("field", [path for path, _ in fields], {"units": "1", "long_name": "field of the scene"}),
        field_units=("field", [found.units[path] for path, _ in fields], _UNIT),
        field_shape=("field", [one.shape for _, one in fields], {"units": "1", "long_name": "distribution"}),
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
