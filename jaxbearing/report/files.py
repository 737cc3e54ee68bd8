"""Files that appear whole or not at all."""

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def appearing_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A temporary path in the same folder to write to; it takes the place of `path` when the block ends well.

    Where the block fails the temporary file is removed, and a file that was at `path` is what it was.

    **Raises:** `OSError` where the place cannot be written (before the block is run), or is no ordinary file.
    """
    target = Path(os.path.realpath(path))  # a link stays a link
    if target.is_dir():
        raise IsADirectoryError(21, "Is a directory", os.fspath(path))
    if target.exists():
        # a device such as /dev/null must not be replaced by a file; a file that is write-protected is so on purpose
        if not target.is_file():
            raise OSError(22, "Not an ordinary file", os.fspath(path))
        if not os.access(target, os.W_OK):
            raise PermissionError(13, "Permission denied", os.fspath(path))
    # Not the number of the process: what a killed one left would be in the way of the next with the same number, which
    # a container gives to every run. File systems count bytes, of which a letter may have four.
    temporary = target.with_name(f".{target.name[:60]}.{secrets.token_hex(4)}.part")
    try:
        temporary.open("xb").close()
    except OSError as error:
        # the user knows the place by the name given, not by that of the temporary file
        raise OSError(error.errno, error.strerror, os.fspath(path)) from None
    try:
        yield temporary
        if target.exists():
            shutil.copymode(target, temporary)
        os.replace(temporary, target)
    finally:
        with suppress(FileNotFoundError):
            temporary.unlink()
