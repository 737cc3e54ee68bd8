"""Console of the screen output, and the line that says what is being done."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from rich.console import Console

PIPE_WIDTH = 100
"""Columns of an output that is not a terminal, where `COLUMNS` does not say another number: they hold every table."""


def console() -> "Console":
    """Standard output, as wide as the terminal, or as the environment variable `COLUMNS` says."""
    from rich.console import Console

    columns = os.environ.get("COLUMNS", "")
    width = int(columns) if columns.isdecimal() and int(columns) > 0 else None
    return Console(highlight=False, width=width or (None if sys.stdout.isatty() else PIPE_WIDTH))


class Working(NamedTuple):
    """A line on the terminal. A call changes its text, and `stop` takes it away."""

    change: Callable[[str], None]
    stop: Callable[[], None]

    def __call__(self, text: str) -> None:
        self.change(text)


@contextmanager
def working(text: str, as_json: bool) -> Iterator[Working]:
    """A line with what is being done and since when, on a terminal only."""
    if as_json or not sys.stdout.isatty():
        yield Working(lambda _: None, lambda: None)
        return
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=console(), transient=True) as line:
        task = line.add_task(text, total=None)
        yield Working(lambda changed: line.update(task, description=changed), line.stop)
