"""Files as text: reading with errors for a person."""

from pathlib import Path

from jaxbearing.scenes.csv_files import numbered_lines

from .errors import CurveError

_EXPECTED = "a file with traction curves"


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
