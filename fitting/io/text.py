"""Files as text: reading with errors for a person, lines numbered as in an editor."""

import re
from pathlib import Path
from typing import NamedTuple

from .errors import CurveError

_EXPECTED = "a file with traction curves"


class Line(NamedTuple):
    """One line of a file: its number as in an editor, from 1, and its text without the end of line."""

    number: int
    text: str


def read_bytes(path: Path) -> bytes:
    """The content of a file.

    **Raises:** `CurveError` for a file that is missing, a folder or unreadable.
    """
    label = str(path)
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise CurveError(label, None, "", "no such file", _EXPECTED) from None
    except IsADirectoryError:
        raise CurveError(label, None, "", "a folder", _EXPECTED) from None
    except (OSError, ValueError) as error:
        # ValueError: a path with a null byte
        reason = getattr(error, "strerror", None) or str(error)
        raise CurveError(label, None, "", f"a file that cannot be read: {reason}", _EXPECTED) from None


def decode(raw: bytes, path: Path) -> str:
    """UTF-8 text, with or without a byte order mark.

    **Raises:** `CurveError` with the line of the first byte that is not UTF-8.
    """
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = len(numbered_lines(raw[: error.start].decode("latin-1")))
        found = f"bytes that are not UTF-8 text (at byte {error.start})"
        raise CurveError(str(path), line, "", found, "a text file in UTF-8") from None


def numbered_lines(text: str) -> list[Line]:
    """All lines. Not `str.splitlines`, which also splits where editors do not (form feed, U+2028)."""
    return [Line(number, line) for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1)]
