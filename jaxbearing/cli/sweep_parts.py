"""Parts shared by the commands that run a sweep: options, checks before the run, display of progress."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .messages import NO_OUTPUT, refuse, say
from .output_files import check_kept, try_to_write, unwritten
from .terminal import console

if TYPE_CHECKING:
    from ..sweeps.engine import StoppedError, Watcher

EXTRA = "pip install 'jaxbearing[cluster]'"
SeedOption = Annotated[int, typer.Option("--seed", metavar="NUMBER", min=0, help="Of the random numbers.")]
OverwriteOption = Annotated[
    bool, typer.Option("--overwrite", help="Replace the file, and drop what is there of another sweep.")
]
ChunkOption = Annotated[
    int | None,
    typer.Option("--chunk", metavar="COUNT", min=1, help="Cases computed and kept at a time; what a kill can cost."),
]
DevicesOption = Annotated[
    int | None,
    typer.Option(
        "--devices",
        metavar="COUNT",
        min=1,
        help="Cores to use (or GPUs); all that the cases can keep busy if not given.",
    ),
]
WorkersOption = Annotated[
    int | None,
    typer.Option("--workers", metavar="COUNT", min=1, help="Compute in so many processes (needs the extra cluster)."),
]
SchedulerOption = Annotated[
    str | None,
    typer.Option(
        "--scheduler",
        metavar="ADDRESS",
        help="Compute on a running Dask cluster, e.g. tcp://host:8786 (extra cluster).",
    ),
]


def check_run_target(target: Path) -> None:
    """Ends the command with a message, before the run, if the output file cannot be written."""
    from importlib.util import find_spec

    from ..sweeps.engine import SweepError, check_target

    try:
        check_target(target)
    except SweepError as error:
        refuse(f"--out: {error}")
    if target.suffix.lower() == ".zarr" and find_spec("zarr") is None:
        refuse(f"--out: found '{target}', which needs the extra 'cluster'; expected .nc, or {EXTRA}")
    if not target.parent.is_dir():
        refuse(f"--out: found '{target}'; expected a file in an existing folder")
    check_kept("--out", target, force=True)
    try:
        try_to_write(target)
    except OSError as error:
        raise typer.Exit(unwritten(target, error)) from None


def check_extra(workers: int | None, scheduler: str | None) -> None:
    from importlib.util import find_spec

    if workers is not None and scheduler is not None:
        refuse("--scheduler: found --workers beside it; expected one of the two")
    if (workers is not None or scheduler is not None) and find_spec("distributed") is None:
        option = "--workers" if workers is not None else "--scheduler"
        refuse(f"{option}: found no Dask, which it needs; expected the extra 'cluster': {EXTRA}")


@contextmanager
def ends_in_words(
    target: Path, option: str, when_stopped: "Callable[[StoppedError], None] | None" = None
) -> "Iterator[None]":
    """Turns the errors of a sweep into messages and exit codes.

    **Arguments:** `target`: output file; `option`: option that the message of a `SweepError` names; `when_stopped`:
    shows the results so far if the output file could not be written.
    """
    from ..sweeps.engine import StoppedError, SweepError

    try:
        yield
    except StoppedError as stopped:
        if when_stopped is not None:
            when_stopped(stopped)
        message = f"the output cannot be written: {target}: {stopped.strerror}; {stopped.kept}"
        raise typer.Exit(say(message, NO_OUTPUT)) from None
    except OSError as error:
        raise typer.Exit(unwritten(target, error)) from None
    except SweepError as error:
        refuse(f"{option}: {error}")
    except ValueError as error:
        refuse(str(error))


@contextmanager
def shown_progress(cases: int, as_json: bool) -> "Iterator[Watcher]":
    """Shows a progress bar with rate and remaining time, and notes above it. With JSON output, or if the output is not
    a terminal, it shows only the notes, on stderr."""
    from ..sweeps.engine import Watcher

    note = lambda text: typer.echo(f"note: {text}", err=True)
    if as_json or not sys.stdout.isatty():
        yield Watcher(note=note)
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console(), transient=True) as bar:
        task = bar.add_task("compiling", total=cases, rate="")

        def done(count: int) -> None:
            bar.update(task, advance=count, description="solving")
            speed = bar.tasks[0].speed
            bar.update(task, rate=f"{speed:.0f} cases/s" if speed else "")

        yield Watcher(
            done, lambda text: bar.update(task, description=text), lambda text: bar.console.print(f"note: {text}")
        )
