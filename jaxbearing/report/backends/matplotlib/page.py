"""A page of paper A4 to draw on; only what draws imports it, and with it matplotlib."""

import io

from matplotlib.figure import Figure

NOTEBOOK_RESOLUTION = 90
"""Dots per inch of a page that a notebook shows."""
WIDTH, HEIGHT = 11.69, 8.27
"""Paper A4 landscape, inches."""


class Page(Figure):
    """White, A4 landscape if no size in inches is given. Made without pyplot: no window, no state, no display; a
    notebook shows it by itself."""

    def __init__(self, width: float = WIDTH, height: float = HEIGHT):
        super().__init__(figsize=(width, height), facecolor="white")

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", dpi=NOTEBOOK_RESOLUTION)
        return buffer.getvalue()
