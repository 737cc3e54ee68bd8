"""Pictures of a solution, whatever its kind, and the files they are written to."""

import functools
import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..bearings.solution import Solution
from ..ehl import LineContactSolution
from ..machines import TwoDiskSolution
from .bearing.plots import plot_bearing
from .files import write_whole
from .line_contact.plots import plot_line_contact
from .two_disk.plots import plot_two_disk

if TYPE_CHECKING:
    import matplotlib.figure

SUFFIXES = (".png", ".svg", ".pdf")
"""Kinds of files that a figure can be written to."""


@functools.singledispatch
def plot_solution(solution: Any, title: str) -> "matplotlib.figure.Figure":
    """A page of plots of one solution: of a bearing, power loss, loads, films, pressures and sliding speeds; of a
    two-disk machine, its traction curves.

    **Arguments:**
    - `solution`: one solution that converged.
    - `title`: name of the scene, at the head of the page.

    **Raises:** `ValueError` for a solution that did not converge: it has no results; `TypeError` for another kind of
    solution.
    """
    raise TypeError(f"no plot of a {type(solution).__name__}")


plot_solution.register(Solution, plot_bearing)
plot_solution.register(TwoDiskSolution, plot_two_disk)
plot_solution.register(LineContactSolution, plot_line_contact)


def save_plot(figure: Any, path: str | os.PathLike[str]) -> None:
    """Write a figure in the format that the suffix says: png, svg or pdf. The file appears whole or not at all.

    **Raises:** `ValueError` for another suffix; `OSError` where the place cannot be written.
    """
    suffix = Path(path).suffix.lower()
    check_suffix(path)
    made = io.BytesIO()
    figure.savefig(made, format=suffix.removeprefix("."), dpi=150)
    write_whole(path, made.getbuffer())


def check_suffix(path: str | os.PathLike[str]) -> None:
    """**Raises:** `ValueError` where a figure cannot be written to a file of this name."""
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        found = f"{os.fspath(path)} has {f'the suffix {suffix!r}' if suffix else 'no suffix'}"
        raise ValueError(f"a plot is written as {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}; {found}")
