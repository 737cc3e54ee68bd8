"""Summary of a solution of any kind on the screen."""

from typing import TYPE_CHECKING

from rich.console import Console

from .registry import output
from .round_off import without_round_off

if TYPE_CHECKING:
    from .._scene import AbstractSolution


def print_summary(solution: "AbstractSolution", scene_label: str, console: Console, full: bool = False) -> None:
    """Prints one solution; if the solve failed, status, residual and worst equation instead of results.

    **Arguments:**
    - `scene_label`: name or file of the scene.
    - `console`: console to print to; it determines colours, width and characters.
    - `full`: True to list assumptions, and to print all results of a bearing, with a row for each loaded element.

    **Raises:** `TypeError` for a solution of a kind that has no summary.
    """
    output(solution, "summary", "summary")(without_round_off(solution), scene_label, console, full)
