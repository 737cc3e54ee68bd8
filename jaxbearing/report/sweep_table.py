"""A sweep as a table, one case a row: a few columns on the screen, all of them in a CSV file."""

import csv
import os
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

CONVERGED = "converged"
_EXACT = 10
"""Digits of the numbers in a file."""


class Column(NamedTuple):
    """Numbers of all cases in the unit in which results are shown."""

    name: str
    unit: str
    values: np.ndarray

    @property
    def header(self) -> str:
        """Name and unit, as a list of cases for a sweep has them."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


def failures(dataset: xr.Dataset) -> np.ndarray:
    """Reason of each case that failed, "" for the others."""
    return dataset["failure"].values.astype(object).ravel()


def fields(dataset: xr.Dataset) -> list[Column]:
    """The fields that the sweep varies, under their paths in a scene file."""
    return [_column(dataset, path.replace(".", "_"), path) for path in dataset.attrs["sweep_fields"].split()]


def results(dataset: xr.Dataset, names: Iterable[str] | None = None) -> list[Column]:
    """Results that are one number a case. **Arguments:** `names`: those that are wanted and there; `None`: all."""
    cases = set(dataset["failure"].dims)
    varied = {path.replace(".", "_") for path in dataset.attrs["sweep_fields"].split()}
    wanted = dataset.data_vars if names is None else [name for name in names if name in dataset]
    return [
        _column(dataset, str(name), str(name))
        for name in wanted
        if set(dataset[name].dims) == cases and np.issubdtype(dataset[name].dtype, np.floating) and name not in varied
    ]


def print_cases(dataset: xr.Dataset, names: Iterable[str], console: Console) -> None:
    """The fields, where one failed how each case ended, and the named results that are not 0 everywhere."""
    own = fields(dataset)
    shown = [*own, *(one for one in results(dataset, names) if np.nansum(np.abs(one.values)))]
    last = [one.name.rpartition(".")[2] for one in shown]
    short = {one.name: name if last.count(name) == 1 else one.name for one, name in zip(shown, last, strict=True)}
    columns = {f"{short[one.name]}\n{one.unit}": [digits(float(value)) for value in one.values] for one in shown}
    first = {title: columns.pop(title) for title in list(columns)[: len(own)]}
    failed = failures(dataset)
    if any(failed):
        first["case"] = ["failed" if failure else "" for failure in failed]
    print_columns(first, columns, console, full=False, left=("case",), way="--table FILE")


def write_table(path: Path, file: str | os.PathLike[str]) -> None:
    """Writes a sweep as a CSV file: the fields, all results that are one number a case, and the reason of each failure.

    A number that a case lacks is left empty. Units are those of the screen.

    **Arguments:** `path`: of the CSV file, which appears whole or not at all; `file`: the store of the sweep.

    **Raises:** `OSError` if the file cannot be written.
    """
    with opened(file) as dataset, atomic_file(path) as temporary:
        columns, failed = [*fields(dataset), *results(dataset)], failures(dataset)
        with temporary.open("w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow([*(one.header for one in columns), "status"])
            for case, failure in enumerate(failed):
                numbers = (float(one.values[case]) for one in columns)
                cells = [f"{one:.{_EXACT}g}" if np.isfinite(one) else "" for one in numbers]
                writer.writerow([*cells, failure or CONVERGED])


def _column(dataset: xr.Dataset, name: str, path: str) -> Column:
    cases = dataset["failure"]
    values = dataset[name].broadcast_like(cases).transpose(*cases.dims).values.ravel()
    unit = label_unit(str(dataset[name].attrs["units"]))
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    return Column(path, display_unit(unit, largest), displayed(1.0, unit, largest) * values)
