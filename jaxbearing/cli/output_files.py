"""Files that a verb writes: checked before the work begins, written after the results have been shown."""

import os
import sys
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, NamedTuple

import typer

from ..numerics.interrupts import INTERRUPTED, deferred_interrupts
from .interrupt import ALL, NOTHING, if_interrupted, tell
from .messages import NO_OUTPUT, refuse, say

PICTURES = (".png", ".svg", ".pdf")
ForceOption = Annotated[
    bool,
    typer.Option("--force", help="Overwrite a .toml file that exists; a file that this command reads never is."),
]


class Output(NamedTuple):
    """A file to write: where (`None`: nowhere), how, what to say when it is there (`None`: its name), and whether it
    takes so long that Ctrl-C leaves it out instead of waiting for it."""

    path: Path | None
    write: Callable[[Path], None]
    done: str | None = None
    long: bool = False


def check_files(wanted: Iterable[tuple[str, Path | None, tuple[str, ...]]], force: bool = False) -> None:
    """Refuse a name that cannot be written before the work, not after it, when all files that are read have been.

    **Arguments:** option, path (`None`: nothing is written) and the suffixes that it may have, of each file; `force`:
    whether a scene or an oil that is there may be overwritten.
    """
    from ..report.files import check_place
    from ..scenes.errors import one_of

    places: dict[str, str] = {}
    for option, path, suffixes in wanted:
        if path is None:
            continue
        if path.suffix.lower() not in suffixes:
            refuse(f"{option}: found '{path}'; expected a file name that ends in {one_of(suffixes)}")
        if not path.parent.is_dir() or path.is_dir():
            refuse(f"{option}: found '{path}'; expected a file in an existing folder")
        place = os.path.realpath(path)
        if place in places:
            refuse(f"{option}: found '{path}', which {places[place]} writes; expected another file")
        places[place] = option
        # scenes and oils are somebody's work; results and pictures can be made again, and are replaced
        check_kept(option, path, force or path.suffix.lower() != ".toml")
        try:
            check_place(path)
            try_to_write(path)
        except OSError as error:
            raise typer.Exit(unwritten(path, error)) from None


def check_kept(option: str, path: Path, force: bool) -> None:
    """Refuses to overwrite a file that the command has read, in any case, and without `force` any file."""
    from ..scenes.input_files import is_input

    if is_input(path):
        refuse(f"{option}: found '{path}', which this command reads; expected another file")
    if not force and path.exists():
        refuse(f"{option}: found '{path}', a file that exists already; expected a new file, or --force to overwrite it")


def try_to_write(path: Path) -> None:
    """Checks that a file can be written.

    **Raises:** `OSError` if no file can be made, or if one that is there is write-protected.
    """
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(13, "Permission denied")
    tempfile.TemporaryFile(dir=path.parent).close()


def unwritten(path: Path, error: Exception) -> int:
    """Prints why a file cannot be written, in one line; returns the exit code."""
    reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return say(f"the output cannot be written: {path}: {reason}", NO_OUTPUT)


def deliver(
    show: Callable[[], None], files: Sequence[Output] = (), notes_to_stderr: bool = False, as_json: bool = False
) -> None:
    """Show the results, then write the files. What goes wrong with one costs neither the results nor the other files,
    and is said in one sentence each. Ctrl-C does not stop what is under way, but for a `long` file, and leaves out the
    files that come after it.

    **Arguments:** `show`: prints the results; `files`: the long ones last; `notes_to_stderr`: whether stdout is for
    the results alone; `as_json`: whether files without words of their own are written in silence.

    **Raises:** `typer.Exit` with the code for a file that is not there; what `show` raises, with the files written.
    """
    left = [file for file in files if file.path is not None]
    written: list[Output] = []
    code = 0
    try:
        with deferred_interrupts() as interrupt:
            _set_if_interrupted(left)
            try:
                show()
                sys.stdout.flush()
            finally:
                while left and not left[0].long and not interrupt.seen:
                    code = max(code, _write(left, written))
        while left:
            code = max(code, _write(left, written))
    except KeyboardInterrupt:
        if_interrupted(f"not written: {_file_names(left)}" if left else ALL)
        tell()
        code = INTERRUPTED
    else:
        if_interrupted(ALL)
    for file in written:
        text = file.done if file.done is not None or as_json else f"wrote {file.path}"
        if text:
            typer.echo(text, err=notes_to_stderr)
    if code:
        raise typer.Exit(code)


@contextmanager
def kept_if_interrupted(
    show: Callable[[], None], files: Sequence[Output], without: str, stop: Callable[[], None]
) -> Iterator[None]:
    """Ctrl-C inside the block shows the results that are there already, and writes their files, but for the long ones.

    **Arguments:** `show`: prints them; `without`: what is not there; `stop`: takes the line of progress away.
    """
    ending = threading.Lock()

    def words() -> str:
        ending.acquire()  # for good: the process ends, and the block must not deliver the same again
        left = [file for file in files if file.path is not None and file.long]
        with suppress(Exception):  # a pipe that has gone must not cost the files
            stop()
            show()
            sys.stdout.flush()
        for file in files:
            if file.path is not None and not file.long:
                try:
                    file.write(file.path)
                except (OSError, MemoryError):
                    left.append(file)
        return f"{without}; not written: {_file_names(left)}" if left else without

    if_interrupted(words)
    try:
        yield
    finally:
        with ending:
            if_interrupted(NOTHING)


def _write(left: list[Output], written: list[Output]) -> int:
    """Write the first of the files that are left; returns the exit code."""
    _set_if_interrupted(left)
    file = left[0]
    code = 0
    try:
        if file.path is not None:
            file.write(file.path)
        written.append(file)
    except (OSError, MemoryError) as error:
        code = unwritten(file.path or Path(), error)
    del left[0]
    return code


def _set_if_interrupted(left: Sequence[Output]) -> None:
    if_interrupted(f"not written: {_file_names(left)}" if left else "while the results were printed")


def _file_names(files: Sequence[Output]) -> str:
    return ", ".join(str(file.path) for file in files)
