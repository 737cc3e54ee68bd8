"""A sweep as a table with one row for each case: some columns on the screen, all in a CSV file."""

import csv
import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr
from rich.console import Console

from .backends.screen import print_columns
from .display import digits, display_unit, displayed
from .files import atomic_file
from .labels import label_unit
from .stores import opened

CONVERGED, YIELDS = "converged", "yields"
_LIFE = re.compile(r"(.*_)?L(10|n)")
"""Pattern of the beginning of the names of lives, of bearings and systems, in hours or millions of turns."""
_EXACT = 10
"""Significant digits of the numbers in a file."""


class Column(NamedTuple):
    """Values of a field or result in all cases, in the display unit."""

    name: str
    unit: str
    values: np.ndarray

    @property
    def header(self) -> str:
        """Heading with name and unit, in the form of a list of cases for a sweep."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


def failures(dataset: xr.Dataset) -> np.ndarray:
    """Reason of failure of each case; "" for a case that converged."""
    return dataset["failure"].values.astype(object).ravel()


def yielding(dataset: xr.Dataset) -> xr.DataArray:
    """True for each case in which elements and raceways yield, because a static safety is below 1."""
    cases = dataset["failure"]
    yields = xr.zeros_like(cases, dtype=bool)
    for name in dataset.data_vars:
        if str(name).endswith("static_safety"):
            low = dataset[name] < 1.0
            yields |= low.any([dim for dim in low.dims if dim not in cases.dims])
    return yields


def without_lives_that_yield(dataset: xr.Dataset) -> xr.Dataset:
    """The sweep with NaN for the lives of cases that yield, for which `solve` gives no life either."""
    good = ~yielding(dataset)
    return dataset.assign(
        {name: array.where(good) for name, array in dataset.data_vars.items() if _LIFE.match(str(name))}
    )


def ends(dataset: xr.Dataset) -> list[str]:
    """State of each case: its reason of failure, `YIELDS` or `CONVERGED`."""
    own = yielding(dataset).transpose(*dataset["failure"].dims).values.ravel()
    return [why or (YIELDS if bad else CONVERGED) for why, bad in zip(failures(dataset), own, strict=True)]


def fields(dataset: xr.Dataset) -> list[Column]:
    """Columns of the fields that the sweep varies, under their paths in a scene file."""
    return [_column(dataset, path.replace(".", "_"), path) for path in dataset.attrs["sweep_fields"].split()]


def results(dataset: xr.Dataset, names: Iterable[str] | None = None) -> list[Column]:
    """Columns of the results with one number per case. **Arguments:** `names`: wanted results; `None`: all."""
    cases = set(dataset["failure"].dims)
    varied = {path.replace(".", "_") for path in dataset.attrs["sweep_fields"].split()}
    wanted = dataset.data_vars if names is None else [name for name in names if name in dataset]
    return [
        _column(dataset, str(name), str(name))
        for name in wanted
        if set(dataset[name].dims) == cases and np.issubdtype(dataset[name].dtype, np.floating) and name not in varied
    ]


def print_cases(dataset: xr.Dataset, names: Iterable[str], console: Console) -> None:
    """Prints the varied fields, the state of each case unless all are `CONVERGED`, and results not all 0."""
    own = fields(dataset)
    shown = [*own, *(column for column in results(dataset, names) if np.nansum(np.abs(column.values)))]
    last = [column.name.rpartition(".")[2] for column in shown]
    short = {
        column.name: name if last.count(name) == 1 else column.name for column, name in zip(shown, last, strict=True)
    }
    columns = {
        f"{short[column.name]}\n{column.unit}": [digits(float(value)) for value in column.values] for column in shown
    }
    first = {title: columns.pop(title) for title in list(columns)[: len(own)]}
    words = ["" if end == CONVERGED else end if end == YIELDS else "failed" for end in ends(dataset)]
    if any(words):
        first["case"] = words
    print_columns(first, columns, console, full=False, named="case", way="--table FILE")


def write_table(path: Path, file: str | os.PathLike[str]) -> None:
    """Writes a sweep as a CSV file: varied fields, all results with one number per case, and the state of each case.

    Cells of missing numbers and of the lives of cases that yield are empty. Units are those of the screen.

    **Arguments:** `path`: path of the CSV file, which appears whole or not at all; `file`: store of the sweep.

    **Raises:** `OSError` if the file cannot be written.
    """
    with opened(file) as whole, atomic_file(path) as temporary:
        dataset = without_lives_that_yield(whole)
        columns = [*fields(dataset), *results(dataset)]
        with temporary.open("w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow([*(column.header for column in columns), "status"])
            for case, end in enumerate(ends(dataset)):
                numbers = (float(column.values[case]) for column in columns)
                cells = [f"{number:.{_EXACT}g}" if np.isfinite(number) else "" for number in numbers]
                writer.writerow([*cells, end])


def _column(dataset: xr.Dataset, name: str, path: str) -> Column:
    cases = dataset["failure"]
    values = dataset[name].broadcast_like(cases).transpose(*cases.dims).values.ravel()
    unit = label_unit(str(dataset[name].attrs["units"]))
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    return Column(path, display_unit(unit, largest), displayed(1.0, unit, largest) * values)
