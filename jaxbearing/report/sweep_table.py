"""A sweep as a table, one case a row: a few columns on the screen, all of them in a CSV file."""

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
"""Beginning of the names of lives, in hours, in millions of turns, of a bearing and of a system."""
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


def yielding(dataset: xr.Dataset) -> xr.DataArray:
    """True for each case whose elements and races yield: one of its static safeties is below 1."""
    cases = dataset["failure"]
    yields = xr.zeros_like(cases, dtype=bool)
    for name in dataset.data_vars:
        if str(name).endswith("static_safety"):
            low = dataset[name] < 1.0
            yields |= low.any([dim for dim in low.dims if dim not in cases.dims])
    return yields


def without_lives_that_yield(dataset: xr.Dataset) -> xr.Dataset:
    """The sweep with NaN for the lives of cases that yield, as `solve` gives none."""
    good = ~yielding(dataset)
    return dataset.assign({name: one.where(good) for name, one in dataset.data_vars.items() if _LIFE.match(str(name))})


def ends(dataset: xr.Dataset) -> list[str]:
    """The reason of failure of each case, or `YIELDS`, or `CONVERGED`."""
    own = yielding(dataset).transpose(*dataset["failure"].dims).values.ravel()
    return [why or (YIELDS if bad else CONVERGED) for why, bad in zip(failures(dataset), own, strict=True)]


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
    """The fields, how each case ended unless all are well, and the named results that are not 0 everywhere."""
    own = fields(dataset)
    shown = [*own, *(one for one in results(dataset, names) if np.nansum(np.abs(one.values)))]
    last = [one.name.rpartition(".")[2] for one in shown]
    short = {one.name: name if last.count(name) == 1 else one.name for one, name in zip(shown, last, strict=True)}
    columns = {f"{short[one.name]}\n{one.unit}": [digits(float(value)) for value in one.values] for one in shown}
    first = {title: columns.pop(title) for title in list(columns)[: len(own)]}
    words = ["" if end == CONVERGED else end if end == YIELDS else "failed" for end in ends(dataset)]
    if any(words):
        first["case"] = words
    print_columns(first, columns, console, full=False, named="case", way="--table FILE")


def write_table(path: Path, file: str | os.PathLike[str]) -> None:
    """Writes a sweep as a CSV file: the fields, all results that are one number a case, and how each case ended.

    A number that a case lacks is left empty, as are the lives of a bearing that yields. Units are those of the screen.

    **Arguments:** `path`: of the CSV file, which appears whole or not at all; `file`: the store of the sweep.

    **Raises:** `OSError` if the file cannot be written.
    """
    with opened(file) as whole, atomic_file(path) as temporary:
        dataset = without_lives_that_yield(whole)
        columns = [*fields(dataset), *results(dataset)]
        with temporary.open("w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow([*(one.header for one in columns), "status"])
            for case, end in enumerate(ends(dataset)):
                numbers = (float(one.values[case]) for one in columns)
                cells = [f"{one:.{_EXACT}g}" if np.isfinite(one) else "" for one in numbers]
                writer.writerow([*cells, end])


def _column(dataset: xr.Dataset, name: str, path: str) -> Column:
    cases = dataset["failure"]
    values = dataset[name].broadcast_like(cases).transpose(*cases.dims).values.ravel()
    unit = label_unit(str(dataset[name].attrs["units"]))
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    return Column(path, display_unit(unit, largest), displayed(1.0, unit, largest) * values)
