"""Text and HTML that `print` and notebooks show for a scene or a solution (`_shown`)."""

import io

import numpy as np
from rich.console import Console

from .._scene import AbstractScene, AbstractSolution
from .scene_table import print_scene
from .summary import print_summary

WIDTH = 100
"""Width of the text in characters."""
_PAGE = '<pre style="line-height: 1.25; white-space: pre; overflow-x: auto">{code}</pre>'


def text(shown: AbstractScene | AbstractSolution, full: bool = False) -> str | None:
    """Plain text of a single scene or solution; `None` for a batch and for a scene that no file describes.

    **Arguments:** `full`: True for everything that `jaxbearing solve --full` shows.
    """
    console = Console(file=io.StringIO(), width=WIDTH, highlight=False, record=True, color_system=None)
    return console.export_text().rstrip() if _printed(shown, console, full) else None


def html(shown: AbstractScene | AbstractSolution) -> str | None:
    """The text of a scene or solution as HTML with colours; `None` as in `text`."""
    console = Console(file=io.StringIO(), width=WIDTH, highlight=False, record=True)
    return console.export_html(inline_styles=True, code_format=_PAGE) if _printed(shown, console) else None


def _printed(shown: AbstractScene | AbstractSolution, console: Console, full: bool = False) -> bool:
    """Prints the scene or solution; False if it cannot be shown, such as a batch."""
    if isinstance(shown, AbstractSolution):
        if np.ndim(shown.converged):
            return False
        print_summary(shown, type(shown).__name__, console, full)
        return True
    return print_scene(shown, console)
