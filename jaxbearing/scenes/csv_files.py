"""CSV files that a person or a spreadsheet wrote: lines numbered as in an editor, cells, headers with units, numbers
with one decimal mark throughout a file. The callers interpret the content."""

import csv
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, NoReturn

from .errors import SceneError
from .input_files import LARGEST_TABLE
from .toml_files import read_text
from .words import describe

SEPARATORS = {",": "','", ";": "';'", "\t": "a tab"}
"""Separators of columns, with their names in messages. With decimal commas only the latter two are possible."""
_HEADER = re.compile(r"(?P<name>[^\[\]]*?(?:\[[0-9]+\])*)\s*(?:\[\s*(?P<unit>[^\[\]]*?)\s*\])?")
# Stricter than `float`, which takes "1_000", digits of other scripts and "infinity".
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?P<mark>[.,])?[0-9]*|(?P<leading_mark>[.,])[0-9]+)(?:[eE][+-]?[0-9]+)?")
_NON_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_MARK_NAMES = {".": "point", ",": "comma"}
_MINUS = "\N{MINUS SIGN}"
"""Character that typesetters and some spreadsheets write for "-"."""

Refuse = Callable[[int, str, str, str], NoReturn]
"""Raises the error of a reader: line, column, what was found, what is expected."""


class Line(NamedTuple):
    """One line of a file: its number as in an editor, from 1, and its text without the end of line."""

    number: int
    text: str


def numbered_lines(text: str) -> list[Line]:
    """All lines. Not `str.splitlines`, which also splits where editors do not (form feed, U+2028)."""
    return [Line(number, line) for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1)]


def telling_lines(text: str) -> list[Line]:
    """Lines that are neither blank nor comments, which begin with `#`."""
    return [line for line in numbered_lines(text) if line.text.strip() and not line.text.lstrip().startswith("#")]


def cells_of(text: str, separator: str) -> list[str]:
    """The cells of one line, without the spaces around them.

    **Raises:** `ValueError` for unpaired quotation marks.
    """
    try:
        # one line at a time: a quotation mark left open must not swallow the rest of the file
        cells = next(csv.reader([text], delimiter=separator, strict=True, skipinitialspace=True), [])
    except csv.Error as error:
        raise ValueError(str(error)) from None
    return [cell.strip() for cell in cells]


def name_and_unit(cell: str) -> tuple[str, str | None]:
    """Name and unit of a column headed `name [unit]`; `None` if there are no brackets. A number in brackets right
    after the name, as in `force[0] [N]`, belongs to the name. A cell of any other form is a name."""
    match = _HEADER.fullmatch(cell.strip())
    return (cell, None) if match is None else (match["name"], match["unit"])


class NumberReader:
    """Reads the cells of one file. The first decimal mark decides: "0,05" and "0.05" in one file are a mistake.

    **Arguments:**
    - `refuse`: raises the error.
    - `comma_allowed`: True if "0,05" may be a number, False if commas separate the columns.
    """

    def __init__(self, refuse: Refuse, comma_allowed: bool):
        self._refuse, self._comma_allowed = refuse, comma_allowed
        self._mark, self._mark_line = "", 0

    def number(self, cell: str, line: int, column: str) -> float:
        """The finite number in a cell. Refused are empty cells, text, numbers that are not finite, and a decimal mark
        other than that of the earlier cells."""
        text = cell.strip().replace(_MINUS, "-", 1)
        if not text:
            self._refuse(line, column, "an empty cell", "a number")
        if _NON_FINITE.fullmatch(text):
            self._refuse(line, column, f"{describe(text)}, which is not finite", "a number")
        match = _NUMBER.fullmatch(text)
        if match is None:
            self._refuse(line, column, describe(text), "a number")
        self._check_mark(match["mark"] or match["leading_mark"] or "", text, line, column)
        value = float(text.replace(",", "."))
        if not math.isfinite(value):
            self._refuse(line, column, f"{describe(text)}, which is not finite", "a number")
        return value

    def _check_mark(self, mark: str, text: str, line: int, column: str) -> None:
        if mark == "," and not self._comma_allowed:
            expected = "a decimal point (decimal commas need ';' or a tab between the columns)"
            self._refuse(line, column, describe(text), expected)
        if mark and self._mark and mark != self._mark:
            expected = f"a decimal {_MARK_NAMES[self._mark]}, as in line {self._mark_line}"
            self._refuse(line, column, describe(text), expected)
        if mark and not self._mark:
            self._mark, self._mark_line = mark, line


class Row(NamedTuple):
    """The cells of a line of a file."""

    number: int
    cells: list[str]


@dataclass(frozen=True)
class CsvTable:
    """A table of numbers that a scene or a sweep takes.

    **Arguments:**
    - `file`: name of the file, as given.
    - `header`: first line that is neither blank nor a comment.
    - `rows`: the following lines, each with as many cells as the header; empty rows are left out.
    - `separator`: between the cells.
    """

    file: str
    header: Row
    rows: tuple[Row, ...]
    separator: str

    @classmethod
    def of(cls, file: str | Path, expected: str) -> "CsvTable":
        """Read a file. The separator is the one that occurs most often in the header.

        **Arguments:** `expected`: expected content, for messages.

        **Raises:** `SceneError` that names file and line.
        """
        label = str(file)
        lines = telling_lines(read_text(file, expected, largest=LARGEST_TABLE))
        if not lines:
            raise SceneError(label, "", "no lines", expected)
        separator = max(SEPARATORS, key=lines[0].text.count)
        header, *rows = [_parted(label, line, separator) for line in lines]
        # spreadsheets write their empty rows as ";;;"
        rows = [row for row in rows if any(row.cells)]
        for row in rows:
            _check_width(label, row, header, separator)
        # and their empty columns likewise
        used = [i for i, name in enumerate(header.cells) if name or any(row.cells[i] for row in rows)]
        only = lambda row: Row(row.number, [row.cells[i] for i in used])
        return cls(label, only(header), tuple(map(only, rows)), separator)

    def numbers(self, labels: list[str]) -> list[list[float]]:
        """All cells below the header, row by row. **Arguments:** `labels`: names of the columns, for messages.

        **Raises:** `SceneError` for the first cell without a finite number.
        """

        def refuse(line: int, column: str, actual: str, expected: str) -> NoReturn:
            raise SceneError(self.at(line), column, actual, expected)

        reader = NumberReader(refuse, comma_allowed=self.separator != ",")
        read = lambda row: [
            reader.number(cell, row.number, label) for cell, label in zip(row.cells, labels, strict=True)
        ]
        return [read(row) for row in self.rows]

    def at(self, line: int) -> str:
        """Name of the file and number of a line, for messages."""
        return f"{self.file}, line {line}"


def _parted(file: str, line: Line, separator: str) -> Row:
    try:
        return Row(line.number, cells_of(line.text, separator))
    except ValueError as error:
        actual = f"a line that cannot be parted into cells ({error})"
        expected = f"cells separated by {SEPARATORS[separator]}, quotation marks in pairs"
        raise SceneError(f"{file}, line {line.number}", "", actual, expected) from None


def _check_width(file: str, row: Row, header: Row, separator: str) -> None:
    count, width = len(row.cells), len(header.cells)
    if count != width:
        actual = f"{count} cell{'s' * (count != 1)}"
        expected = f"{width} separated by {SEPARATORS[separator]}, as in the header (line {header.number})"
        raise SceneError(f"{file}, line {row.number}", "", actual, expected)
