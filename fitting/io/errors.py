"""The error of curve files: file, line and column, what was found, what is expected, and the nearest valid name."""

from typing import NoReturn

from jaxbearing.scenes.csv_files import Refuse
from jaxbearing.scenes.errors import printable
from jaxbearing.scenes.words import shortened


class CurveError(ValueError):
    """A curve file that cannot be read or does not make sense; the message is one paragraph for a person.

    **Arguments:**
    - `file`: the file as it was given.
    - `line`: number of the line as in an editor, from 1; `None` where the file as a whole is meant.
    - `column`: name of the column; empty where a line or the file as a whole is meant.
    - `found`, `expected`: in words.
    - `suggestion`: nearest valid name.
    """

    def __init__(self, file: str, line: int | None, column: str, found: str, expected: str, suggestion: str = ""):
        self.file, self.line, self.column = file, line, column
        self.found, self.expected, self.suggestion = found, expected, suggestion
        super().__init__(self._message())

    def _message(self) -> str:
        places = [f"line {self.line}"] if self.line is not None else []
        places += [f"column {shortened(repr(self.column))}"] if self.column else []
        place = f"{self.file}: {', '.join(places)}" if places else self.file
        text = f"{place}: found {self.found}; expected {self.expected}."
        if self.suggestion:
            text += f" Did you mean '{self.suggestion}'?"
        return printable(" ".join(text.split()))


def refusing(file: str) -> Refuse:
    """A function that raises `CurveError` for a cell of this file."""

    def refuse(line: int, column: str, actual: str, expected: str) -> NoReturn:
        raise CurveError(file, line, column, actual, expected)

    return refuse
