"""Files that appear whole or not at all: the one way in which the package writes a file.

The content of a file is built in memory and passed to `write_whole`; content that may be larger than memory is written
through `atomic_file`. Libraries that do not survive a full disk (HDF5 crashes the process) never write to the disk
themselves.
"""

import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_unfinished: set[Path] = set()
"""Temporary files and folders that this process has made and not yet removed."""


def write_whole(path: str | os.PathLike[str], content: str | bytes | memoryview) -> None:
    """Writes a file, text in UTF-8; it appears whole or not at all.

    **Raises:** `OSError` if the file cannot be written or the disk is full; an earlier file at `path` then stays as it
    was.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    with atomic_file(path) as temporary, _named(path), temporary.open("wb") as file:
        file.write(data)


@contextmanager
def atomic_file(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary path in the same folder to write to, which replaces `path` when the block ends without an error.

    If the block fails, the temporary file is removed and an earlier file at `path` stays as it was.

    **Raises:** `OSError` if the file cannot be written (before the block is run), or if `path` is not an ordinary file.
    """
    check_place(path)
    target = Path(os.path.realpath(path))  # a link stays a link
    # A random name, not the process number: a file left by a killed process would block the next process with the same
    # number, and in a container every run has the same. 60 letters: file systems limit bytes, and a letter may have
    # four.
    temporary = target.with_name(f".{target.name[:60]}.{secrets.token_hex(4)}.part")
    _unfinished.add(temporary)
    try:
        with _named(path):
            temporary.open("xb").close()
        yield temporary
        with _named(path):
            if target.exists():
                shutil.copymode(target, temporary)
            # some file systems report only now that they are full
            with temporary.open("rb") as file:
                os.fsync(file.fileno())
            os.replace(temporary, target)
    finally:
        # it may not exist, or may already have replaced the target
        with suppress(OSError):
            temporary.unlink()
        _unfinished.discard(temporary)


@contextmanager
def _named(path: str | os.PathLike[str]) -> Iterator[None]:
    """Errors in the block name the path that the user gave, not that of the temporary file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), os.fspath(path)) from None


def check_place(path: str | os.PathLike[str]) -> None:
    """Checks that a file may be written at a path.

    **Raises:** `OSError` if a file must not replace what is there: a folder, a device (such as /dev/null), or a
    write-protected file."""
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise IsADirectoryError(21, "Is a directory", os.fspath(path))
    if target.exists():
        if not target.is_file():
            raise OSError(22, "Not an ordinary file", os.fspath(path))
        if not os.access(target, os.W_OK):
            raise PermissionError(13, "Permission denied", os.fspath(path))


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A folder for files written by other programs, in the system's temporary folder; removed at the end of the block.

    **Raises:** `OSError`.
    """
    with tempfile.TemporaryDirectory(prefix="jaxbearing-") as name:
        folder = Path(name)
        _unfinished.add(folder)
        try:
            yield folder
        finally:
            _unfinished.discard(folder)


def remove_unfinished() -> None:
    """Removes the temporary files and folders of this process, for use when it ends abruptly, as after Ctrl-C."""
    for path in list(_unfinished):
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            with suppress(OSError):
                path.unlink()
