"""One view of a drawing."""

from typing import TYPE_CHECKING

from ...colours import INK

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure


def view(
    figure: "matplotlib.figure.Figure", title: str, place: tuple[float, float, float, float]
) -> "matplotlib.axes.Axes":
    """Axes without a frame, both to one scale. **Arguments:** `place`: left, bottom, width, height of the figure."""
    axes = figure.add_axes(place)
    axes.set_aspect("equal", adjustable="box")
    axes.axis("off")
    axes.set_title(title, fontsize=10.5, fontweight="bold", color=INK, pad=4)
    return axes
