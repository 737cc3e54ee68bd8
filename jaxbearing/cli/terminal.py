"""Console of the screen output."""

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

PIPE_WIDTH = 100
"""Columns of an output that is not a terminal, where `COLUMNS` does not say another number: they hold every table."""


def console() -> "Console":
    """Standard output, as wide as the terminal, or as the environment variable `COLUMNS` says."""
    from rich.console import Console

    columns = os.environ.get("COLUMNS", "")
    said = int(columns) if columns.isdecimal() and int(columns) > 0 else None
    return Console(highlight=False, width=said or (None if sys.stdout.isatty() else PIPE_WIDTH))
