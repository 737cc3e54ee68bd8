"""One view of a drawing."""

from typing import Any

from ...colours import INK


def view(figure: Any, title: str, place: tuple[float, float, float, float]) -> Any:
    """Axes without a frame, both to one scale. **Arguments:** `place`: left, bottom, width, height of the figure."""
    axes = figure.add_axes(place)
    axes.set_aspect("equal", adjustable="box")
    axes.axis("off")
    axes.set_title(title, fontsize=10.5, fontweight="bold", color=INK, pad=4)
    return axes
