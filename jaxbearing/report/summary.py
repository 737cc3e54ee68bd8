"""The summary of a solution on the screen, whatever its kind."""

import functools
from typing import Any

from rich.console import Console

from ..bearings.solution import Solution
from ..ehl import LineContactSolution
from ..machines import TwoDiskSolution
from .bearing.summary import print_bearing
from .line_contact.summary import print_line_contact
from .two_disk.summary import print_two_disk


@functools.singledispatch
def print_summary(solution: Any, scene_label: str, console: Console) -> None:
    """Print one solution; where the solve failed, status, residual and worst equation and no result.

    **Arguments:**
    - `scene_label`: name or file of the scene.
    - `console`: where to; it decides on colours, width and characters.

    **Raises:** `TypeError` for another kind of solution.
    """
    raise TypeError(f"no summary of a {type(solution).__name__}")


print_summary.register(Solution, print_bearing)
print_summary.register(TwoDiskSolution, print_two_disk)
print_summary.register(LineContactSolution, print_line_contact)
