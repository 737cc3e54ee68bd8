"""Speed, load or oil data over time from a CSV file with two columns and units in the header; checks of lists."""

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from pydantic_core import PydanticCustomError

from .csv_files import CsvTable, name_and_unit
from .errors import SceneError, nearest
from .table import Problems, refusal_at
from .units import FLOW, FORCE, SPEED, TEMPERATURE, TIME, Dimension, parse
from .words import describe, shortened

_QUANTITIES = {
    "speed": (SPEED, "speed [rpm]"),
    "load": (FORCE, "load [N]"),
    "oil_inlet": (TEMPERATURE, "oil_inlet [degC]"),
    "oil_flow": (FLOW, "oil_flow [l/h]"),
}
FACTOR = "factor"
"""Name of the column with values relative to the operating point."""


class TimeTable(NamedTuple):
    """Increasing times, s, and as many values: in SI units, or factors if `relative`."""

    times: np.ndarray
    values: np.ndarray
    relative: bool


def check_lists(times: Sequence[float], factors: Sequence[float]) -> Problems:
    """Refuses lists in a scene that do not define a function of time."""
    if len(times) < 2 or len(times) != len(factors):
        expected = "as many factors as times, two or more"
        yield refusal_at("factors", expected, f"{len(factors)} factors and {len(times)} times")
    if any(b <= a for a, b in itertools.pairwise(times)):
        yield refusal_at("times", "times that increase", "some that do not")


def read_time_table(file: str, quantity: str, field: str) -> TimeTable:
    """Read a table with columns such as `time [ms]` and `speed [rpm]`, or `factor` as second column. Blank lines and
    lines that begin with `#` are skipped; other columns are refused. Columns are separated by commas, semicolons or
    tabs; files with decimal commas need semicolons or tabs.

    **Arguments:** `file`: path; `quantity`: one of `_QUANTITIES`; `field`: dotted path of the field that names it.

    **Raises:** `SceneError` that names field, file and line.
    """
    dimension, example = _QUANTITIES[quantity]
    wanted = f"a CSV file for {field} with the columns 'time [ms]' and '{example}' or '{FACTOR}'"
    table = CsvTable.of(file, wanted)
    names, scales, zeros = _columns(table, quantity, dimension, wanted)
    if len(table.rows) < 2:
        content = "one row" if table.rows else "no rows"
        raise SceneError(file, "", content, f"two rows or more below the header, for {field}")
    with np.errstate(over="ignore"):
        values = np.asarray(table.numbers(names)) * np.asarray(scales) + np.asarray(zeros)
    times, content = values[:, names.index("time")], values[:, 1 - names.index("time")]
    _check_times(table, names.index("time"), times, field)
    _check_values(table, 1 - names.index("time"), content, quantity, field)
    return TimeTable(times, content, FACTOR in names)


def _columns(
    table: CsvTable, quantity: str, dimension: Dimension, wanted: str
) -> tuple[list[str], list[float], list[float]]:
    """Names of the two columns, and the SI values of their units and of the zeros of these units."""
    valid, place = ("time", quantity, FACTOR), table.at(table.header.number)
    parted = [name_and_unit(cell) for cell in table.header.cells]
    names = [name for name, _ in parted]
    for name in names:
        if name not in valid or names.count(name) > 1:
            twice = " twice" if name in valid else ""
            actual = f"the column {shortened(repr(name))}{twice}"
            raise SceneError(place, "", actual, wanted, "" if twice else nearest(name, valid))
    if "time" not in names or len(names) != 2:
        actual = f"the column{'s' * (len(names) > 1)} {', '.join(repr(name) for name in names)}"
        raise SceneError(place, "", actual, wanted)
    dimensions, scales, zeros = {"time": TIME, quantity: dimension}, [], []
    for name, unit in parted:
        if name == FACTOR:
            if unit not in (None, "", "1"):
                raise SceneError(place, name, f"the unit {shortened(repr(unit))}", "a column without a unit")
            scales.append(1.0)
            zeros.append(0.0)
            continue
        try:
            zeros.append(parse(f"0 {unit or ''}", dimensions[name]))
            scales.append(parse(f"1 {unit or ''}", dimensions[name]) - zeros[-1])
        except PydanticCustomError:
            actual = f"the unit {shortened(repr(unit))}" if unit else "a column without a unit"
            example = "time [ms]" if name == "time" else _QUANTITIES[quantity][1]
            raise SceneError(place, name, actual, f"a unit of it in brackets, e.g. '{example}'") from None
    return names, scales, zeros


def _check_times(table: CsvTable, column: int, times: np.ndarray, field: str) -> None:
    for i, time in enumerate(times):
        row = table.rows[i]
        if not np.isfinite(time):
            raise SceneError(table.at(row.number), "time", describe(row.cells[column]), f"a finite time, for {field}")
        if i and time <= times[i - 1]:
            text = f"{shortened(repr(row.cells[column]))} after {shortened(repr(table.rows[i - 1].cells[column]))}"
            raise SceneError(table.at(row.number), "time", text, f"times that increase, for {field}")


def _check_values(table: CsvTable, column: int, values: np.ndarray, quantity: str, field: str) -> None:
    """Refuses values that a run cannot have. It begins with the steady state of its first row, which needs speed and
    load."""
    name = name_and_unit(table.header.cells[column])[0]
    for i, value in enumerate(values):
        if not np.isfinite(value):
            expected = f"a finite number, for {field}"
        elif quantity == "speed" and value <= 0.0:
            expected = f"a number > 0, for {field}: at rest the films vanish"
        elif quantity == "oil_inlet" and value <= 0.0 and name != FACTOR:
            expected = f"a temperature above absolute zero, for {field}"
        elif quantity == "oil_flow" and value < 0.0:
            expected = f"a number >= 0, for {field}"
        elif quantity == "load" and (value < 0.0 or (i == 0 and value == 0.0)):
            expected = f"{'a number > 0 in the first row' if i == 0 else 'a number >= 0'}, for {field}"
        else:
            continue
        row = table.rows[i]
        raise SceneError(table.at(row.number), name, shortened(repr(row.cells[column])), expected)
