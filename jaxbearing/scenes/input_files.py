"""Reading the files that a user names: regular files of sane size, and nothing else.

Devices and named pipes are refused: a device may be endless, and a named pipe may have no writer. A pipe that the shell
has opened for this process, as for `<(command)` and `/dev/stdin`, is read up to the same size, since the user meant it.
"""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LARGEST_TEXT = 4 * 2**20
"""Largest scene or oil file, bytes: a thousand times the usual size."""
LARGEST_TABLE = 32 * 2**20
"""Largest table of numbers, bytes: about a million rows."""
_PIPES = ("/dev/fd/", "/dev/stdin", "/proc/self/fd/")
_read_pipes: dict[tuple[int, int], bytes] = {}
"""Contents of pipes, by device and inode number: a pipe can be read only once, but some inputs are read twice."""
_inputs: set[tuple[int, int]] | None = None
"""Files that were read inside `remembered_inputs`, by device and inode number; `None` outside."""


@contextmanager
def remembered_inputs() -> Iterator[None]:
    """Context that records the files which are read inside it, for `is_input`."""
    global _inputs
    before, _inputs = _inputs, set()
    try:
        yield
    finally:
        _inputs = before


def is_input(path: str | os.PathLike[str]) -> bool:
    """True for a file that was read inside the present `remembered_inputs`, under any name or link."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return False
    return _inputs is not None and (status.st_dev, status.st_ino) in _inputs


def _remember(status: os.stat_result) -> None:
    if _inputs is not None:
        _inputs.add((status.st_dev, status.st_ino))


class UnfitFileError(ValueError):
    """Raised for a file that must not or cannot be read. **Attributes:** `found`: description of the file; `missing`:
    True if there is no file."""

    def __init__(self, found: str, missing: bool = False):
        super().__init__(found)
        self.found, self.missing = found, missing


def read_bytes(path: str | os.PathLike[str], largest: int = LARGEST_TEXT) -> bytes:
    """The content of a file of at most `largest` bytes.

    **Raises:** `UnfitFileError` for a file that is missing, too large, unreadable, or not regular (see above).
    """
    try:
        status = os.stat(path)
        if stat.S_ISFIFO(status.st_mode) and os.fspath(path).startswith(_PIPES):
            return _pipe_bytes(path, status, largest)
        _check(status, largest)
        # non-blocking, because the file may have been replaced by a pipe since the check
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
        with open(descriptor, "rb") as file:
            _check(status := os.fstat(descriptor), largest)
            _remember(status)
            # some regular files (in /proc) do not report their size
            return _bounded(file.read(largest + 1), largest)
    except FileNotFoundError:
        raise UnfitFileError("no such file", missing=True) from None
    except OSError as error:
        raise UnfitFileError(f"a file that cannot be read: {error.strerror or error}") from None
    except UnfitFileError:
        raise
    except ValueError as error:
        # a path with a null byte
        raise UnfitFileError(f"a file that cannot be read: {error}") from None


def check_regular(path: str | os.PathLike[str]) -> None:
    """Checks a file for readers that open it themselves.

    **Raises:** `OSError` if there is no such file, or if it is not a regular one.
    """
    try:
        _check(status := os.stat(path))
        _remember(status)
    except UnfitFileError as error:
        raise OSError(22, f"it is {error.found}", os.fspath(path)) from None


_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def _check(status: os.stat_result, largest: int | None = None) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise UnfitFileError(next((words for is_kind, words in _KINDS if is_kind(status.st_mode)), "no regular file"))
    if largest is not None and status.st_size > largest:
        raise UnfitFileError(f"a file of {status.st_size / 2**20:.4g} MiB, more than {largest >> 20} MiB")


def _pipe_bytes(path: str | os.PathLike[str], status: os.stat_result, largest: int) -> bytes:
    key = status.st_dev, status.st_ino
    if key not in _read_pipes:
        with Path(path).open("rb") as file:
            _read_pipes[key] = _bounded(file.read(largest + 1), largest)
    return _read_pipes[key]


def _bounded(content: bytes, largest: int) -> bytes:
    if len(content) > largest:
        raise UnfitFileError(f"more than {largest >> 20} MiB")
    return content
