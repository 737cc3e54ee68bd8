"""Cells of a table to numbers, with one decimal mark throughout a file."""

import math
import re
from typing import NoReturn

from jaxbearing.scenes.units import describe

from .errors import CurveError

# Stricter than `float`, which takes "1_000", digits of other scripts and "infinity".
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?P<mark>[.,])?[0-9]*|(?P<leading_mark>[.,])[0-9]+)(?:[eE][+-]?[0-9]+)?")
_NON_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_MARK_NAMES = {".": "point", ",": "comma"}


class NumberReader:
    """Reads the cells of one file. The first decimal mark decides: "0,05" and "0.05" in one file are a mistake.

    **Arguments:**
    - `file`: for messages.
    - `comma_allowed`: whether "0,05" may be a number: not where the comma separates columns.
    """

    def __init__(self, file: str, comma_allowed: bool):
        self._file, self._comma_allowed = file, comma_allowed
        self._mark, self._mark_line = "", 0

    def number(self, cell: str, line: int, column: str) -> float:
        """A finite number.

        **Raises:** `CurveError` for an empty cell, for text, for what is not finite and for a second decimal mark.
        """
        text = cell.strip()
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

    def _refuse(self, line: int, column: str, found: str, expected: str) -> NoReturn:
        raise CurveError(self._file, line, column, found, expected)
