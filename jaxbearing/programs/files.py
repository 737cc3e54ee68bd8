"""Files of the program cache: a file is written completely or not at all, and only files of the user are read."""

import hashlib
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

SUFFIX = ".program"
MOST_BYTES = 500_000_000
"""Largest total size of the files, bytes; above it, the least recently used files are removed."""
ABANDONED = 3600.0
"""Age, s, above which an unfinished file is taken as left behind by a killed process."""
_MAGIC = b"jaxbearing program 2\n"


def read(path: Path) -> bytes | None:
    """Reads the content of a file that `write` wrote, and marks the file as used. Returns `None` if the file does not
    exist, is damaged, belongs to another user, or may be written by others."""
    with suppress(OSError):
        # follow no link, and check the permissions of the open file, so that no other file can take its place
        with open(os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0)), "rb") as file:
            if not _is_own(os.fstat(file.fileno())):
                return None
            whole = file.read()
        head, content = whole[: len(_MAGIC) + 32], whole[len(_MAGIC) + 32 :]
        if head == _head(path, content):
            with suppress(OSError):  # the disk may be read-only
                os.utime(path)
            return content
    return None


def own_folder(path: Path) -> bool:
    """Makes a folder in which only the user may write. Returns False if that is impossible."""
    with suppress(OSError):
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _is_own(os.stat(path), writable_for_others=True):
            if not _is_own(os.stat(path)):
                path.chmod(0o700)
            return True
    return False


def _is_own(about: os.stat_result, writable_for_others: bool = False) -> bool:
    """True if a file belongs to the user and nobody else may write it. Always True on Windows, which has other
    permissions.

    **Arguments:** `writable_for_others`: accept a file that others may write.
    """
    if not hasattr(os, "geteuid"):
        return True
    return about.st_uid == os.geteuid() and (writable_for_others or not about.st_mode & 0o022)


def write(path: Path, content: bytes) -> None:
    """Writes a file. If the cache is full, the least recently used files are removed first.

    **Raises:** `OSError` if the file cannot be written; no part of it remains.
    """
    _make_room(path.parent, len(content))
    handle, name = tempfile.mkstemp(suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_head(path, content) + content)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _head(path: Path, content: bytes) -> bytes:
    """First bytes of a file: its format, and a checksum of its name and content. The name identifies the content."""
    return _MAGIC + hashlib.sha256(path.name.encode() + b"\n" + content).digest()


def _make_room(folder: Path, size: int) -> None:
    """Removes unfinished files of killed processes. Then removes the least recently used files until a file of `size`
    bytes fits into the cache."""
    for used, _, path in _ages(folder, "*.part"):
        if used < time.time() - ABANDONED:
            path.unlink(missing_ok=True)
    files = sorted(_ages(folder, f"*{SUFFIX}"))
    excess = sum(size for _, size, _ in files) + size - MOST_BYTES
    for _, size, path in files:
        if excess <= 0:
            return
        path.unlink(missing_ok=True)
        excess -= size


def _ages(folder: Path, pattern: str) -> Iterator[tuple[float, int, Path]]:
    """Time of the last use, size and path of each file that matches the pattern. Files that another process removes
    meanwhile are left out."""
    for path in folder.glob(pattern):
        with suppress(OSError):
            about = path.stat()
            yield about.st_mtime, about.st_size, path
