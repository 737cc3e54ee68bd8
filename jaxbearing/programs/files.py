"""Files of a cache: each appears whole or not at all, and only the user's own are read."""

import hashlib
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

SUFFIX = ".program"
MOST_BYTES = 500_000_000
"""Size of all files together from which on those that were used longest ago are removed."""
ABANDONED = 3600.0
"""Age from which on a file that is still being written belongs to a process that was killed, s."""
_MAGIC = b"jaxbearing program 2\n"


def read(path: Path) -> bytes | None:
    """The content that `write` was given, or `None` where the file is not there, is damaged, belongs to another user,
    or may be written by others. A file that is read counts as used."""
    with suppress(OSError):
        # no link, and the file that is judged is the one that is read
        with open(os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0)), "rb") as file:
            if not _is_own(os.fstat(file.fileno())):
                return None
            whole = file.read()
        head, content = whole[: len(_MAGIC) + 32], whole[len(_MAGIC) + 32 :]
        if head == _head(path, content):
            with suppress(OSError):  # a disk that may only be read
                os.utime(path)
            return content
    return None


def own_folder(path: Path) -> bool:
    """Makes a folder that only the user may write, and says whether it is one."""
    with suppress(OSError):
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _is_own(os.stat(path), writable_for_others=True):
            if not _is_own(os.stat(path)):
                path.chmod(0o700)
            return True
    return False


def _is_own(about: os.stat_result, writable_for_others: bool = False) -> bool:
    """True if a file belongs to the user and nobody else may write it; Windows has other rights."""
    if not hasattr(os, "geteuid"):
        return True
    return about.st_uid == os.geteuid() and (writable_for_others or not about.st_mode & 0o022)


def write(path: Path, content: bytes) -> None:
    """Writes a file, and removes old ones where there is no room.

    **Raises:** `OSError`; nothing is left behind then.
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
    """The first bytes of a file; its name, which says what the content is, counts in the sum."""
    return _MAGIC + hashlib.sha256(path.name.encode() + b"\n" + content).digest()


def _make_room(folder: Path, size: int) -> None:
    """Removes the files that were used longest ago, and what killed processes left half written."""
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
    """Time of the last use, size and path of the files that are there; another process may remove some meanwhile."""
    for path in folder.glob(pattern):
        with suppress(OSError):
            about = path.stat()
            yield about.st_mtime, about.st_size, path
