"""Tidy CSV files: one row for each point, one column for each quantity, units in the header."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Int64

from jaxbearing.scenes.csv_files import SEPARATORS, Line, NumberReader, cells_of, name_and_unit, telling_lines
from jaxbearing.scenes.errors import nearest
from jaxbearing.scenes.words import shortened

from .checks import check_count, check_sliding, remarks
from .columns import ALSO_CALLED, CURVE, DIMENSIONS, EXAMPLES, KNOWN, REQUIRED, Column, check_unit, fits, to_si
from .errors import CurveError, refusing
from .grouping import group
from .table import CurveTable
from .units_file import side_units, units_path


@dataclass(frozen=True)
class _Layout:
    """Layout of one file: separator of the cells, header, and the columns that are read."""

    path: Path
    separator: str
    header: Line
    width: int
    columns: dict[str, Column]
    ignored: tuple[str, ...]

    @property
    def file(self) -> str:
        return str(self.path)


def parse_tidy_csv(text: str, path: Path) -> CurveTable:
    """Points of a tidy CSV file.

    Columns, in any order: `slide_to_roll` (a ratio; `slide_to_roll [%]` in percent) and `traction_coefficient`, which
    are required; `pressure [GPa]` or `load [N]`, `entrainment_speed [m/s]`, `temperature [degC]` with any unit of the
    dimension in the brackets; `curve`, any text. Upper and lower case are the same. Other columns are ignored with a
    note, unless their unit is that of a condition that the file lacks: such a column is refused. Units may be in a side
    file instead, see `units_file`. Without `curve` the points are grouped by conditions, see `grouping`.

    Columns are separated by commas, semicolons or tabs; decimal commas need one of the latter two. Blank lines and
    lines that begin with `#` are skipped.

    **Arguments:**
    - `text`: the content of the file.
    - `path`: its place, for messages and for the side file.

    **Returns:** a `CurveTable`, in SI.

    **Raises:** `CurveError`.
    """
    lines = telling_lines(text)
    if not lines:
        raise CurveError(str(path), None, "", "an empty file", f"a header such as '{','.join(_examples(REQUIRED))}'")
    layout = _layout(lines[0], path)
    rows = _rows(lines[1:], layout)
    numbers = [number for number, _ in rows]
    check_count(layout.file, len(rows), numbers[-1] if rows else layout.header.number)
    values = _values(rows, numbers, layout)
    check_sliding(layout.file, "slide_to_roll", values["slide_to_roll"])
    curve, names, notes = _curves(rows, values, layout)
    notes = (*_ignored_notes(layout), *notes, *remarks(values["slide_to_roll"], values["traction_coefficient"]))
    return CurveTable(**values, curve=curve, curve_names=names, notes=notes, origin=path.name)


def _layout(header: Line, path: Path) -> _Layout:
    separator = _separator(header)
    cells = _cells(header, separator, path)
    parted = [(name.lower() if name.lower() in KNOWN else name, unit) for name, unit in map(name_and_unit, cells)]
    names = [name for name, _ in parted]
    _check_mixed(cells, separator, header, path)
    _check_names(names, header, path)
    side = side_units(path, [name for name in names if name])
    columns = {}
    for index, (name, unit) in enumerate(parted):
        if name in KNOWN:
            columns[name] = _column(name, unit, side.get(name), index, header.number, path)
    _check_unread(parted, columns, header, path)
    ignored = tuple(name for name in names if name and name not in KNOWN)
    return _Layout(path, separator, header, len(cells), columns, ignored)


def _separator(header: Line) -> str:
    """The separator that gives the most known columns or, with equal counts, the most cells."""

    def score(separator: str) -> tuple[int, int]:
        names = [re.sub(r"\[.*", "", cell).strip(' "') for cell in header.text.split(separator)]
        return sum(name.lower() in KNOWN for name in names), len(names)

    return max(SEPARATORS, key=score)


def _cells(line: Line, separator: str, path: Path) -> list[str]:
    try:
        return cells_of(line.text, separator)
    except ValueError as error:
        actual = f"a line that cannot be parted into cells ({error})"
        expected = f"cells separated by {SEPARATORS[separator]}, quotation marks in pairs"
        raise CurveError(str(path), line.number, "", actual, expected) from None


def _check_mixed(cells: list[str], separator: str, header: Line, path: Path) -> None:
    for other in SEPARATORS:
        for cell in cells:
            parts = [part.split("[")[0].strip() for part in cell.split(other)]
            if other != separator and len(parts) > 1 and any(part in KNOWN for part in parts):
                actual = f"{SEPARATORS[separator]} and {SEPARATORS[other]} between columns"
                raise CurveError(str(path), header.number, "", actual, "one separator throughout the file")


def _check_names(names: list[str], header: Line, path: Path) -> None:
    file, line = str(path), header.number
    for name in KNOWN:
        if names.count(name) > 1:
            raise CurveError(file, line, name, f"{names.count(name)} columns of this name", "one")
    for name in REQUIRED:
        if name not in names:
            others = [other for other in names if other and not other.startswith(KNOWN)]
            renamed = [other for other in others if ALSO_CALLED.get(other.lower()) == name]
            misspelt = renamed[0] if renamed else nearest(name, others)
            listed = ", ".join(repr(other) for other in names if other)
            actual = f"the column {shortened(repr(misspelt))}" if misspelt else f"the columns {shortened(listed)}"
            expected = f"a column '{EXAMPLES[name]}', which is required, and ',', ';' or tabs between the columns"
            raise CurveError(file, line, name, actual, expected, name if misspelt else "")
    if "pressure" in names and "load" in names:
        raise CurveError(file, line, "load", "a column 'pressure' and a column 'load'", "one of the two")


def _check_unread(
    parted: Sequence[tuple[str, str | None]], columns: Mapping[str, Column], header: Line, path: Path
) -> None:
    """Refuses a column that may be a missing condition under another name, which the scene's value would replace."""
    loaded = {"pressure", "load"} if columns.keys() & {"pressure", "load"} else set()
    lacking = [name for name in DIMENSIONS if name not in columns and name not in loaded]
    for name, unit in parted:
        for condition in lacking:
            if name not in KNOWN and unit and fits(unit, DIMENSIONS[condition]):
                actual = f"a column in {unit} that is not read, and no column '{condition}'"
                expected = f"'{EXAMPLES[condition]}' if it holds that, else a heading without a unit in brackets"
                raise CurveError(str(path), header.number, name, actual, expected)


def _column(name: str, unit: str | None, side: str | None, index: int, line: int, path: Path) -> Column:
    if name == CURVE:
        if unit or side:
            raise CurveError(str(path), line, name, f"the unit '{unit or side}'", "names of curves, without a unit")
        return Column(name, "", name, line, index)
    if unit and side is not None and unit != side:
        actual = f"the unit '{unit}' in the header and '{side}' in '{units_path(path).name}'"
        raise CurveError(str(path), line, name, actual, "a unit in one of the two")
    column = Column(name, unit or side or "", name, line, index)
    hint = f", or {name} = \"...\" under [units] in a file '{units_path(path).name}'" if not column.unit else ""
    if side is not None:
        file, column_there = str(units_path(path)), Column(name, side, name, None, index)
        check_unit(column_there, file)
    check_unit(column, str(path), hint)
    return column


def _rows(lines: Sequence[Line], layout: _Layout) -> list[tuple[int, list[str]]]:
    rows = []
    header = _cells(layout.header, layout.separator, layout.path)
    for line in lines:
        cells = _cells(line, layout.separator, layout.path)
        if not any(cells):
            continue  # spreadsheets write their empty rows as ";;;"
        if len(cells) != layout.width:
            others = [shown for mark, shown in SEPARATORS.items() if mark != layout.separator and mark in line.text]
            actual = f"{len(cells)} cell{'s' if len(cells) > 1 else ''}" + "".join(f" and {other}" for other in others)
            there = f"in the header (line {layout.header.number})"
            expected = f"{layout.width} cells separated by {SEPARATORS[layout.separator]}, as {there}"
            raise CurveError(layout.file, line.number, "", actual, expected)
        if cells == header:
            raise CurveError(layout.file, line.number, "", "the header once more", "a row of numbers")
        rows.append((line.number, cells))
    return rows


def _values(rows: list[tuple[int, list[str]]], numbers: list[int], layout: _Layout) -> dict[str, np.ndarray]:
    reader = NumberReader(refusing(layout.file), comma_allowed=layout.separator != ",")
    used = [column for name, column in layout.columns.items() if name != CURVE]
    # row by row, so that the first wrong line is reported
    raw = np.array(
        [[reader.number(cells[column.index], line, column.label) for column in used] for line, cells in rows]
    )
    return {column.name: to_si(raw[:, place], column, numbers, layout.file) for place, column in enumerate(used)}


def _curves(
    rows: list[tuple[int, list[str]]], values: dict[str, np.ndarray], layout: _Layout
) -> tuple[Int64[np.ndarray, " point"], tuple[str, ...], tuple[str, ...]]:
    if CURVE not in layout.columns:
        return group({name: values[name] for name in DIMENSIONS if name in values}, len(rows))
    index: dict[str, int] = {}
    place = layout.columns[CURVE].index
    for line, cells in rows:
        if not cells[place]:
            raise CurveError(layout.file, line, CURVE, "an empty cell", "the name of a curve")
        index.setdefault(cells[place], len(index))
    return np.array([index[cells[place]] for _, cells in rows], dtype=np.int64), tuple(index), ()


def _ignored_notes(layout: _Layout) -> list[str]:
    absent = [name for name in KNOWN if name not in layout.columns]
    notes = []
    for name in layout.ignored:
        near = nearest(name, absent)
        question = f" (did you mean '{EXAMPLES.get(near, near)}'?)" if near else ""
        notes.append(f"Column {shortened(repr(name))} is ignored{question}.")
    return notes


def _examples(names: Sequence[str]) -> list[str]:
    return [EXAMPLES[name] for name in names]
