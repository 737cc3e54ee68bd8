"""Plots of a solution of any kind, and files to which they are written."""

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .files import write_whole
from .registry import check_converged, output
from .round_off import without_round_off

if TYPE_CHECKING:
    import matplotlib.figure

    from .._scene import AbstractScene, AbstractSolution

SUFFIXES = (".png", ".svg", ".pdf")
"""Suffixes of the file formats of a figure."""


def plot_solution(
    solution: "AbstractSolution", title: str, scene: "AbstractScene | None" = None
) -> "matplotlib.figure.Figure":
    """Plots one solution on a page.

    The page shows power loss, loads, films, pressures and sliding speeds of a bearing; traction curves of a two-disk
    machine; bending line, moments and internal forces of a shaft.

    **Arguments:**
    - `solution`: one solution that converged.
    - `title`: name of the scene, at the head of the page.
    - `scene`: scene of the solution; if it is given, a shaft is also drawn to scale.

    **Raises:** `ValueError` for a batch, and for a solution that did not converge and so has no results; `TypeError`
    for a solution of a kind that has no plots.
    """
    draw = output(solution, "plots", "plot")
    if np.ndim(solution.converged) != 0:
        raise ValueError("plot_solution draws one solution, got a batch: take one lane of it")
    check_converged(solution)
    solution = without_round_off(solution)
    return draw(solution, title) if scene is None or scene.kind != "shaft" else draw(solution, title, scene)


def save_plot(figure: "matplotlib.figure.Figure", path: str | os.PathLike[str]) -> None:
    """Writes a figure in the format of the suffix, png, svg or pdf. The file appears whole or not at all.

    **Raises:** `ValueError` for another suffix; `OSError` if the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    check_suffix(path)
    made = io.BytesIO()
    figure.savefig(made, format=suffix.removeprefix("."), dpi=150)
    write_whole(path, made.getbuffer())


def check_suffix(path: str | os.PathLike[str]) -> None:
    """Checks the suffix of the file of a figure.

    **Raises:** `ValueError` for a suffix that is not in `SUFFIXES`.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        actual = f"{os.fspath(path)} has {f'the suffix {suffix!r}' if suffix else 'no suffix'}"
        raise ValueError(f"a plot is written as {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}; {actual}")
