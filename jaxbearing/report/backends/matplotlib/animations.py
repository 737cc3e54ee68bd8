"""Parts common to all animations of runs: choice of the instants, heading with a clock, and the file."""

import os
import shutil
import subprocess
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...colours import INK
from ...files import check_place, temporary_folder, write_whole

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.artist
    import matplotlib.figure
    import matplotlib.text

SUFFIXES = (".gif", ".html", ".mp4")
PICTURES = 120
"""Number of pictures of an animation; smaller if the run has fewer instants."""
PER_SECOND = 15
_DOTS = 100
"""Dots per inch: text of 9 points is 12 pixels high, and 120 pictures take about 5 MB."""
_LETTERS = 12.4
"""Characters per inch in the small print."""


def instants(first: float, last: float, at_most: int = PICTURES) -> np.ndarray:
    """Evenly spaced times, or indices of instants, from `first` to `last`: one for each picture, at most `at_most`."""
    return np.linspace(first, last, min(PICTURES, at_most))


def moving_head(figure: "matplotlib.figure.Figure", title: str, words: str) -> "matplotlib.text.Text":
    """Draws the title and the small print `words`; returns the still empty text below them, for the clock."""
    shown = title if len(title) <= 80 else title[:77] + "..."
    lines = textwrap.wrap(words, int(_LETTERS * 0.94 * figure.get_figwidth()))
    figure.text(0.03, 0.965, shown, fontsize=11, fontweight="bold", color=INK, va="center", parse_math=False)
    figure.text(0.03, 0.943, "\n".join(lines), fontsize=9, color=INK, va="top", linespacing=1.25)
    return figure.text(0.03, 0.92 - 0.025 * len(lines), "", fontsize=10, color=INK, va="center")


def moving(
    figure: "matplotlib.figure.Figure", update: "Callable[[int], list[matplotlib.artist.Artist]]", pictures: int
) -> "matplotlib.animation.FuncAnimation":
    """Animation of a figure. **Arguments:** `update`: draws the picture with a given number; `pictures`: how many."""
    import matplotlib.animation

    return matplotlib.animation.FuncAnimation(figure, update, frames=pictures, interval=1000.0 / PER_SECOND)


def save_animation(
    animation: "matplotlib.animation.Animation",
    path: str | os.PathLike[str],
    progress: Callable[[float, float], None] | None = None,
) -> None:
    """Writes a gif, an html page or (with the program ffmpeg) an mp4. If writing fails, no partial file is left.

    **Raises:** `ValueError` for another suffix; `OSError` if the file cannot be written or ffmpeg is missing.
    """
    import matplotlib as mpl
    from matplotlib.animation import FFMpegWriter, HTMLWriter, PillowWriter

    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise ValueError(f"an animation is written as {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}; found {path}")
    if suffix == ".mp4" and shutil.which("ffmpeg") is None:
        raise OSError(2, "the program ffmpeg, which makes .mp4, is not there", os.fspath(path))
    kinds: dict[str, Any] = {".gif": PillowWriter, ".mp4": FFMpegWriter}
    writer = kinds[suffix](fps=PER_SECOND) if suffix in kinds else HTMLWriter(fps=PER_SECOND, embed_frames=True)
    callback = None if progress is None else lambda number, count: progress(float(number + 1), float(count))
    check_place(path)
    # the writers need the right suffix, and leave other files behind if they fail
    with temporary_folder() as folder:
        made = folder / f"animation{suffix}"
        try:
            with mpl.rc_context():
                mpl.rcParams["animation.embed_limit"] = 100.0
                animation.save(made, writer=writer, dpi=_DOTS, progress_callback=callback)
            content = made.read_bytes()
        except OSError as error:
            reason = f"{error.strerror or error} (in the folder for temporary files, {folder.parent})"
            raise OSError(error.errno or 5, reason, os.fspath(path)) from None
        except subprocess.CalledProcessError as error:
            lines = (error.stderr or b"").decode(errors="replace").strip().splitlines()
            raise OSError(5, f"ffmpeg failed: {lines[-1] if lines else error}", os.fspath(path)) from None
        write_whole(path, content)
