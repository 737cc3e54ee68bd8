"""Files that appear whole or not at all: the one way in which the package writes a file.

What a file holds is made in memory and handed to `write_whole`; what may be larger than memory goes through
`atomic_file`. Libraries that do not survive a disk that fills up (HDF5 crashes the process) never see the disk.
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
    """Write a file, text in UTF-8; it appears whole or not at all.

    **Raises:** `OSError` where the place cannot be written or the disk is full: nothing is there then, or what was
    there before.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    with atomic_file(path) as temporary, _named(path), temporary.open("wb") as file:
        file.write(data)


@contextmanager
def atomic_file(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary path in the same folder to write to; it takes the place of `path` when the block ends well.

    Where the block fails the temporary file is removed, and a file that was at `path` is what it was.

    **Raises:** `OSError` where the place cannot be written (before the block is run), or is no ordinary file.
    """
    check_place(path)
    target = Path(os.path.realpath(path))  # a link stays a link
    # Not the number of the process: what a killed one left would be in the way of the next with the same number, which
    # a container gives to every run. File systems count bytes, of which a letter may have four.
    temporary = target.with_name(f".{target.name[:60]}.{secrets.token_hex(4)}.part")
    _unfinished.add(temporary)
    try:
        with _named(path):
            temporary.open("xb").close()
        yield temporary
        with _named(path):
            if target.exists():
                shutil.copymode(target, temporary)
            # some file systems tell only now that they have no room
            with temporary.open("rb") as file:
                os.fsync(file.fileno())
            os.replace(temporary, target)
    finally:
        # it may not have been made, or is in its place
        with suppress(OSError):
            temporary.unlink()
        _unfinished.discard(temporary)


@contextmanager
def _named(path: str | os.PathLike[str]) -> Iterator[None]:
    """The user knows the place by the name given, not by that of the temporary file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), os.fspath(path)) from None


def check_place(path: str | os.PathLike[str]) -> None:
    """**Raises:** `OSError` where something is that a file must not take the place of: a folder, a device (/dev/null
    must stay one), a file that is write-protected, which it is on purpose."""
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
    """A folder for files that other programs write, in the system's place for temporary files; it is removed.

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
    """Remove the temporary files and folders of this process: for one that ends at once, as after Ctrl-C."""
    for path in list(_unfinished):
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            with suppress(OSError):
                path.unlink()
