"""The texts that `print` and a notebook show for a scene or a solution (`_shown`)."""

import io

import numpy as np
from rich.console import Console

from .._scene import AbstractScene, AbstractSolution
from .scene_table import print_scene
from .summary import print_summary

WIDTH = 100
"""Columns."""
_PAGE = '<pre style="line-height: 1.25; white-space: pre; overflow-x: auto">{code}</pre>'


def text(shown: AbstractScene | AbstractSolution, full: bool = False) -> str | None:
    """Plain text; `None` for what is not one scene or solution. **Arguments:** `full`: all that there is, as
    `jaxbearing solve --full` shows it."""
    console = Console(file=io.StringIO(), width=WIDTH, highlight=False, record=True, color_system=None)
    return console.export_text().rstrip() if _printed(shown, console, full) else None


def html(shown: AbstractScene | AbstractSolution) -> str | None:
    """The same with colours."""
    console = Console(file=io.StringIO(), width=WIDTH, highlight=False, record=True)
    return console.export_html(inline_styles=True, code_format=_PAGE) if _printed(shown, console) else None


def _printed(shown: AbstractScene | AbstractSolution, console: Console, full: bool = False) -> bool:
    """Prints, and tells whether there was something to print."""
    if isinstance(shown, AbstractSolution):
        if np.ndim(shown.converged):
            return False
        print_summary(shown, type(shown).__name__, console, full)
        return True
    return print_scene(shown, console)
