"""Files that a verb writes: checked before the work begins, written after it."""

import os
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import typer

from .messages import NO_OUTPUT, refuse, say

PICTURES = (".png", ".svg", ".pdf")


def check_files(wanted: Iterable[tuple[str, Path | None, tuple[str, ...]]]) -> None:
    """Refuse a name that cannot be written before the work, not after it.

    **Arguments:** option, path (`None`: nothing is written) and the suffixes that it may have, of each file.
    """
    from ..scenes.errors import one_of

    for option, path, suffixes in wanted:
        if path is None:
            continue
        if path.suffix.lower() not in suffixes:
            refuse(f"{option}: found '{path}'; expected a file name that ends in {one_of(suffixes)}")
        if not path.parent.is_dir() or path.is_dir():
            refuse(f"{option}: found '{path}'; expected a file in an existing folder")
        with writing(path):
            try_to_write(path)


def try_to_write(path: Path) -> None:
    """**Raises:** `OSError` where no file can be made, or one that is there is write-protected."""
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(13, "Permission denied")
    tempfile.TemporaryFile(dir=path.parent).close()


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turns what keeps a file from being written into one message and exit code 1."""
    try:
        yield
    except OSError as error:
        message = f"the output cannot be written: {path}: {error.strerror or error}"
        raise typer.Exit(say(message, NO_OUTPUT)) from None
