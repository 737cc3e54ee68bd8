"""Reads TOML files that a user names; every error becomes a `SceneError`."""

import os
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path

from .errors import SceneError, nearest
from .input_files import LARGEST_TEXT, UnfitFileError, read_bytes
from .words import describe, shortened


def read_text(path: str | Path, expected: str, near: Iterable[str] = (), largest: int = LARGEST_TEXT) -> str:
    """Text of a file in UTF-8.

    **Arguments:** `expected`: expected content, for messages; `near`: names to suggest if the file does not exist;
    `largest`: largest size, bytes.

    **Raises:** `SceneError`.
    """
    label = str(path)
    if not isinstance(path, str | os.PathLike):
        raise SceneError(shortened(label), "", describe(path), f"the path of {expected}")
    try:
        return read_bytes(path, largest).decode("utf-8-sig")
    except UnfitFileError as error:
        suggestion = nearest(Path(path).name.removesuffix(".toml"), near) if error.missing else ""
        raise SceneError(label, "", error.found, expected, suggestion) from None
    except UnicodeDecodeError as error:
        actual = f"bytes that are not UTF-8 text (at byte {error.start})"
        raise SceneError(label, "", actual, "a file in UTF-8") from None


def parse_toml(text: str, label: str, expected: str) -> dict[str, object]:
    """The tables of a TOML text. **Arguments:** `label`: name of the file; `expected`: expected content, for messages.

    **Raises:** `SceneError`.
    """
    if not text.strip():
        raise SceneError(label, "", "an empty file", expected)
    try:
        return tomllib.loads(text)
    # ValueError: also a number of thousands of digits
    except ValueError as error:
        path = _path_near(text, str(error))
        expected = "a valid TOML file"
        if "Cannot declare" in str(error):
            expected += "; a table that is repeated, such as [[state]], has two brackets"
        raise SceneError(label, path, f"a TOML syntax error, {error}", expected) from None
    except RecursionError:
        raise SceneError(label, "", "tables nested too deeply", "a valid TOML file") from None


def _path_near(text: str, message: str) -> str:
    """Dotted path of the field on the line of a syntax error, as far as it can be found."""
    match = re.search(r"at line (\d+)", message)
    if match is None and "end of document" not in message:
        return ""
    lines = text.splitlines()[: int(match[1]) if match else None]
    headers = [header[1] for line in lines if (header := re.match(r"\s*\[\s*([\w.]+)\s*\]", line))]
    key = re.match(r"\s*([\w.]+)\s*=", lines[-1]) if lines else None
    return ".".join(headers[-1:] + ([key[1]] if key else []))
