"""Pictures of a solution, whatever its kind, and the files they are written to."""

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
"""Kinds of files that a figure can be written to."""


def plot_solution(
    solution: "AbstractSolution", title: str, scene: "AbstractScene | None" = None
) -> "matplotlib.figure.Figure":
    """A page of plots of one solution: of a bearing, power loss, loads, films, pressures and sliding speeds; of a
    two-disk machine, its traction curves; of a shaft, its bending line, moments and cut forces.

    **Arguments:**
    - `solution`: one solution that converged.
    - `title`: name of the scene, at the head of the page.
    - `scene`: of the solution; a shaft is drawn to scale with it.

    **Raises:** `ValueError` for a batch, and for a solution that did not converge: it has no results; `TypeError`
    for another kind of solution.
    """
    draw = output(solution, "plots", "plot")
    if np.ndim(solution.converged) != 0:
        raise ValueError("plot_solution draws one solution, got a batch: take one lane of it")
    check_converged(solution)
    solution = without_round_off(solution)
    return draw(solution, title) if scene is None or scene.kind != "shaft" else draw(solution, title, scene)


def save_plot(figure: "matplotlib.figure.Figure", path: str | os.PathLike[str]) -> None:
    """Write a figure in the format that the suffix says: png, svg or pdf. The file appears whole or not at all.

    **Raises:** `ValueError` for another suffix; `OSError` where the place cannot be written.
    """
    suffix = Path(path).suffix.lower()
    check_suffix(path)
    made = io.BytesIO()
    figure.savefig(made, format=suffix.removeprefix("."), dpi=150)
    write_whole(path, made.getbuffer())


def check_suffix(path: str | os.PathLike[str]) -> None:
    """Checks the suffix of a figure's file.

    **Raises:** `ValueError` for a suffix that no figure can have.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        found = f"{os.fspath(path)} has {f'the suffix {suffix!r}' if suffix else 'no suffix'}"
        raise ValueError(f"a plot is written as {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}; {found}")
