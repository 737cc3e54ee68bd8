"""Reading of text files, with errors that a user understands."""

from pathlib import Path

from jaxbearing.scenes.csv_files import numbered_lines
from jaxbearing.scenes.input_files import LARGEST_TABLE, UnfitFileError
from jaxbearing.scenes.input_files import read_bytes as read_at_most

from .errors import CurveError

_EXPECTED = "a file with traction curves"


def read_bytes(path: Path) -> bytes:
    """The content of a file.

    **Raises:** `CurveError` for a file that is missing, a folder, a device, too large or unreadable.
    """
    try:
        return read_at_most(path, LARGEST_TABLE)
    except UnfitFileError as error:
        raise CurveError(str(path), None, "", error.found, _EXPECTED) from None


def decode(raw: bytes, path: Path) -> str:
    """UTF-8 text, with or without a byte order mark.

    **Raises:** `CurveError` with the line of the first byte that is not UTF-8.
    """
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = len(numbered_lines(raw[: error.start].decode("latin-1")))
        actual = f"bytes that are not UTF-8 text (at byte {error.start})"
        raise CurveError(str(path), line, "", actual, "a text file in UTF-8") from None
