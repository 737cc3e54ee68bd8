"""The summary of a solution on the screen, whatever its kind."""

from typing import TYPE_CHECKING

from rich.console import Console

from .registry import output
from .round_off import without_round_off

if TYPE_CHECKING:
    from .._scene import AbstractSolution


def print_summary(solution: "AbstractSolution", scene_label: str, console: Console, full: bool = False) -> None:
    """Print one solution; where the solve failed, status, residual and worst equation and no result.

    **Arguments:**
    - `scene_label`: name or file of the scene.
    - `console`: where to; it decides on colours, width and characters.
    - `full`: whether assumptions are listed, and a bearing's summary has all that there is, with a row for each loaded
      element.

    **Raises:** `TypeError` for another kind of solution.
    """
    output(solution, "summary", "summary")(without_round_off(solution), scene_label, console, full)
