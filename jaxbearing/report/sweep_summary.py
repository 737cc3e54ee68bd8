"""Summary of a sweep on the screen: number of cases, reasons of failures, range of the main results."""

import collections
import os
from collections.abc import Iterator

import numpy as np
import xarray as xr
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..bearings.operation import HELD_FIELDS, LOAD_FIELDS
from .backends.screen import counted, headline, print_warnings
from .display import with_unit
from .labels import label_unit
from .stores import opened
from .sweep_table import failures, print_cases, without_lives_that_yield, yielding

_MAIN = (
    "power_loss_total",
    "cage_slip",
    "ring_radial",
    "ring_axial",
    "film_central",
    "film_minimum",
    "life_Lnmr_hours",
    "life_L10r_hours",
    "system_Lnmr_hours",
    "system_L10r_hours",
    "system_L10h",
    "bearing_largest_load",
    "torque_power_loss",
)
"""Results that are shown, if the data set has them."""
_FEW, _FEW_FIELDS = 20, 3
"""Numbers of cases and of varied fields, up to which all cases are listed."""
_REASONS = 3
"""Number of reasons of failures that are shown, the most frequent ones first."""


def print_sweep(file: str | os.PathLike[str], label: str, kept: int, seconds: float, console: Console) -> None:
    """Prints the summary of a sweep.

    **Arguments:** `file`: store of the sweep; `kept`: number of cases computed by an earlier run; `seconds`: duration
    of this run, s.
    """
    with opened(file) as whole:
        dataset, failure = without_lives_that_yield(whole), failures(whole)
        failed = int(np.sum(failure != ""))
        status, style = ("ALL CONVERGED", "bold green") if failed == 0 else (f"{failed} FAILED", "bold red")
        new = failure.size - kept
        rate = (
            f", {new / seconds:.{0 if new > 10 * seconds else 1}f} cases/s with start and compilation"
            if new and seconds > 0
            else ""
        )
        headline(label, status, style, f"{counted(failure.size, 'case')} in {seconds:.1f} s{rate}", console)
        rows = {path: _spread(dataset[path.replace(".", "_")]) for path in dataset.attrs["sweep_fields"].split()}
        rows |= {
            name: _spread(dataset[name])
            for name in _MAIN
            if name in dataset and np.nansum(np.abs(dataset[name].values))
        }
        rows |= _held(dataset)
        if dataset.attrs.get("not_modelled"):
            rows["Not modelled:"] = dataset.attrs["not_modelled"].replace("_", " ")
        grid = Table.grid(padding=(0, 2, 0, 0))
        for name, text in rows.items():
            grid.add_row(Text(f"  {name}"), Text(text))
        console.print(grid)
        if 1 < failure.size <= _FEW and len(dataset.attrs["sweep_fields"].split()) <= _FEW_FIELDS:
            print_cases(dataset, _MAIN, console)
        warnings = filter(None, dataset.attrs.get("warnings", "").split("\n"))
        print_warnings([*_reasons(failure), *_yield(whole), *warnings], console)
    console.print(Text(f"wrote {os.fspath(file)}: open it with xarray.open_dataset"))


def _reasons(failure: np.ndarray) -> Iterator[str]:
    counts = collections.Counter(text for text in failure.tolist() if text)
    for text, count in counts.most_common(_REASONS):
        yield f"{counted(count, 'case')} failed: {text}"
    if len(counts) > _REASONS:
        others = sum(count for _, count in counts.most_common()[_REASONS:])
        yield f"{counted(others, 'case')} failed otherwise"


def _yield(dataset: xr.Dataset) -> Iterator[str]:
    number = int(yielding(dataset).sum())
    if number:
        yield f"in {counted(number, 'case')} elements and races yield (static safety below 1): these have no life"


def _held(dataset: xr.Dataset) -> dict[str, str]:
    """Name -> range of the load that results for each prescribed displacement."""
    ranges = {}
    for freedom, load in LOAD_FIELDS.items():
        held = f"operation_{HELD_FIELDS[freedom].replace('.', '_')}"
        if "force" in dataset and held in dataset:
            force = dataset["force"].sel(freedom=freedom)
            unit = str(dataset["force_units"].sel(freedom=freedom).values)
            ranges[f"force, {load}"] = _spread(force.assign_attrs(units=unit))
    return ranges


def _spread(values: xr.DataArray) -> str:
    """Text of the smallest and largest finite value, in display units; "-" if there is none."""
    numbers = values.values[np.isfinite(values.values)]
    if numbers.size == 0:
        return "-"
    unit = label_unit(str(values.attrs["units"]))
    return f"{with_unit(float(numbers.min()), unit)} to {with_unit(float(numbers.max()), unit)}"
