"""What can be asserted of a picture: which texts lie on each other, which legends on curves, which cells are empty."""

import itertools

from matplotlib.text import Text

from jaxbearing.report.backends.matplotlib.legends import covered

TOUCHING = 1.0
"""Pixels by which two boxes may overlap: boxes are a little larger than their letters."""


def texts(figure):
    """Words and box of every text that is seen; an axis that is hidden has none."""
    figure.draw_without_rendering()
    found = []
    for text in figure.findobj(Text):
        axes = text.axes
        hidden = axes is not None and not axes.axison and text not in (*axes.texts, axes.title)
        if not text.get_visible() or not text.get_text().strip() or hidden or _off(text):
            continue
        found.append((text.get_text(), text.get_window_extent()))
    return found


def _off(text):
    """True for the label of a tick beyond the ends of its axis, or of one that is kept and not drawn."""
    axes = text.axes
    if axes is None or axes.name != "rectilinear":
        return False
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        margin = 1e-9 * abs(ends[1] - ends[0])
        drawn = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        for tick in (*axis.majorTicks, *axis.minorTicks):
            if text in (tick.label1, tick.label2):
                within = min(ends) - margin <= tick.get_loc() <= max(ends) + margin
                return tick not in drawn or not within
    return False


def overlapping(figure):
    """Pairs of texts that lie on each other."""
    pairs = itertools.combinations(texts(figure), 2)
    return [(one, other) for (one, a), (other, b) in pairs if _overlap(a, b)]


def _overlap(a, b):
    across = min(a.x1, b.x1) - max(a.x0, b.x0)
    up = min(a.y1, b.y1) - max(a.y0, b.y0)
    return across > TOUCHING and up > TOUCHING


def outside(figure):
    """Texts that the edge of the page cuts."""
    page = figure.bbox
    found = texts(figure)
    return [
        words for words, box in found if box.x0 < page.x0 or box.x1 > page.x1 or box.y0 < page.y0 or box.y1 > page.y1
    ]


def hidden_by_legends(figure):
    """Titles of the axes in which a legend lies on a curve."""
    figure.draw_without_rendering()
    return [axes.get_title() for axes in figure.axes if covered(axes)]


def empty_cells(figure):
    """Number of axes in which nothing is drawn."""
    return sum(not axes.has_data() and not axes.texts for axes in figure.axes)
