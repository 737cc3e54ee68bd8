"""Files of a cache: each appears whole or not at all, and only the user's own are read."""

import hashlib
import os
import tempfile
import time
from contextlib import suppress
from pathlib import Path

SUFFIX = ".program"
MOST_BYTES = 500_000_000
"""Size of all files together from which on those that were used longest ago are removed."""
ABANDONED = 3600.0
"""Age from which on a file that is still being written belongs to a process that was killed, s."""
_MAGIC = b"jaxbearing program 1\n"


def read(path: Path) -> bytes | None:
    """The content that `write` was given, or `None` where the file is not there, is damaged, belongs to another user,
    or may be written by others. A file that is read counts as used."""
    with suppress(OSError):
        about = path.stat()
        if about.st_mode & 0o022 or (hasattr(os, "geteuid") and about.st_uid != os.geteuid()):
            return None
        whole = path.read_bytes()
        head, content = whole[: len(_MAGIC) + 32], whole[len(_MAGIC) + 32 :]
        if head == _head(content):
            os.utime(path)
            return content
    return None


def write(path: Path, content: bytes) -> None:
    """Writes a file, and removes old ones where there is no room.

    **Raises:** `OSError`; nothing is left behind then.
    """
    _make_room(path.parent, len(content))
    handle, name = tempfile.mkstemp(suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(_head(content) + content)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def _head(content: bytes) -> bytes:
    return _MAGIC + hashlib.sha256(content).digest()


def _make_room(folder: Path, size: int) -> None:
    """Removes the files that were used longest ago, and what killed processes left half written."""
    for path in folder.glob("*.part"):
        if path.stat().st_mtime < time.time() - ABANDONED:
            path.unlink(missing_ok=True)
    files = sorted((path.stat().st_mtime, path.stat().st_size, path) for path in folder.glob(f"*{SUFFIX}"))
    excess = sum(size for _, size, _ in files) + size - MOST_BYTES
    for _, size, path in files:
        if excess <= 0:
            return
        path.unlink(missing_ok=True)
        excess -= size
