"""Speed or load over time from a CSV file: two columns, units in the header, one row a time."""

import csv
import math
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from pydantic_core import PydanticCustomError

from .errors import SceneError, nearest, one_of
from .toml_files import read_text
from .units import FORCE, SPEED, TIME, Dimension, parse, shortened

_HEADER = re.compile(r"\s*(?P<name>[^\[\]]*?)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?\s*")
_SEPARATORS = (",", ";", "\t")
_QUANTITIES = {"speed": (SPEED, "speed [rpm]"), "load": (FORCE, "load [N]")}
FACTOR = "factor"
"""The column of a table that is relative to the operating point."""


class TimeTable(NamedTuple):
    """Times, s, increasing, and values, as many: SI, or factors where `relative`."""

    times: np.ndarray
    values: np.ndarray
    relative: bool


class _Line(NamedTuple):
    number: int
    cells: list[str]


def read_time_table(file: str, quantity: str, field: str) -> TimeTable:
    """Read `time [ms], speed [rpm]`, or `factor` in place of the second column; blank lines and lines that begin with
    `#` are skipped, other columns are refused.

    **Arguments:** `file`; `quantity`: "speed" or "load"; `field`: dotted path of the scene that names the file.

    **Raises:** `SceneError` that names field, file and line.
    """
    dimension, example = _QUANTITIES[quantity]
    wanted = f"a CSV file for {field} with the columns 'time [ms]' and '{example}' or '{FACTOR}'"
    lines = _lines(read_text(file, wanted))
    if not lines:
        raise SceneError(file, "", "no lines", wanted)
    names, scales = _columns(file, lines[0], quantity, dimension, wanted)
    if len(lines) < 3:
        rows = "one row" if len(lines) == 2 else "no rows"
        raise SceneError(file, "", rows, f"two rows or more below the header, for {field}")
    values = np.asarray([_numbers(file, line, names) for line in lines[1:]]) * np.asarray(scales)
    times, found = values[:, names.index("time")], values[:, 1 - names.index("time")]
    for i in range(1, len(times)):
        if times[i] <= times[i - 1]:
            text = f"'{lines[i + 1].cells[names.index('time')]}' after '{lines[i].cells[names.index('time')]}'"
            raise SceneError(_at(file, lines[i + 1]), "time", text, f"times that increase, for {field}")
    _check_sign(file, lines, names, found, quantity, field)
    return TimeTable(times, found, FACTOR in names)


def _at(file: str, line: _Line) -> str:
    return f"{file}, line {line.number}"


def _lines(text: str) -> list[_Line]:
    numbered = [(n, line) for n, line in enumerate(text.splitlines(), 1) if line.strip() and line.lstrip()[0] != "#"]
    if not numbered:
        return []
    separator = max(_SEPARATORS, key=numbered[0][1].count)
    # one line at a time: a quotation mark left open must not swallow the rest of the file
    rows = ((n, next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])) for n, line in numbered)
    return [_Line(n, [cell.strip() for cell in cells]) for n, cells in rows]


def _columns(
    file: str, header: _Line, quantity: str, dimension: Dimension, wanted: str
) -> tuple[list[str], list[float]]:
    """Names of the two columns, and what their numbers are in SI."""
    valid = ("time", quantity, FACTOR)
    parted = [_HEADER.fullmatch(cell) for cell in header.cells]
    names = [match["name"] if match else cell for match, cell in zip(parted, header.cells, strict=True)]
    for name in names:
        if name not in valid or names.count(name) > 1:
            twice = " twice" if name in valid else ""
            found = f"the column {shortened(repr(name))}{twice}"
            raise SceneError(_at(file, header), "", found, wanted, "" if twice else nearest(name, valid))
    if "time" not in names or len(names) != 2:
        found = f"the column{'s' * (len(names) > 1)} {', '.join(repr(name) for name in names)}"
        raise SceneError(_at(file, header), "", found, wanted)
    dimensions = {"time": TIME, quantity: dimension}
    scales = []
    for name, match in zip(names, parted, strict=True):
        unit = match["unit"] if match else None
        if name == FACTOR:
            if unit not in (None, "", "1"):
                raise SceneError(_at(file, header), name, f"the unit '{unit}'", "a column without a unit")
            scales.append(1.0)
            continue
        try:
            scales.append(parse(f"1 {unit or ''}", dimensions[name]))
        except PydanticCustomError as error:
            found = "a column without a unit" if not unit else f"the unit '{unit}'"
            example = "time [ms]" if name == "time" else _QUANTITIES[quantity][1]
            del error
            raise SceneError(_at(file, header), name, found, f"a unit of it in brackets, e.g. '{example}'") from None
    return names, scales


def _numbers(file: str, line: _Line, names: Sequence[str]) -> list[float]:
    if len(line.cells) != len(names):
        found = f"{len(line.cells)} cell{'s' * (len(line.cells) != 1)}"
        raise SceneError(_at(file, line), "", found, f"{len(names)}, {one_of(names).removeprefix('one of ')}")
    numbers = []
    for name, cell in zip(names, line.cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise SceneError(_at(file, line), name, f"'{shortened(cell)}'", "a finite number, with a decimal point")
        numbers.append(value)
    return numbers


def _check_sign(file: str, lines: list[_Line], names: list[str], values: np.ndarray, quantity: str, field: str) -> None:
    """A run begins with the steady state of its first row, which needs speed and load."""
    column = 1 - names.index("time")
    for i, value in enumerate(values):
        if quantity == "speed" and value <= 0.0:
            expected = f"a number > 0, for {field}: at rest the films vanish"
        elif quantity == "load" and (value < 0.0 or (i == 0 and value == 0.0)):
            expected = f"{'a number > 0 in the first row' if i == 0 else 'a number >= 0'}, for {field}"
        else:
            continue
        raise SceneError(_at(file, lines[i + 1]), names[column], f"'{lines[i + 1].cells[column]}'", expected)
