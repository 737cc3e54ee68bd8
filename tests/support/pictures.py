"""What can be asserted of a picture: which texts lie on each other, which legends on curves, which cells are empty."""

import itertools

from matplotlib.text import Text

from jaxbearing.report.backends.matplotlib.legends import covered

TOUCHING = 1.0
"""Pixels by which two boxes may overlap: boxes are a little larger than their letters."""


def texts(figure):
    """Words and box of every text that is seen."""
    figure.draw_without_rendering()
    hidden = {id(text) for axes in figure.axes for text in _hidden(axes)}
    seen = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    return [(text.get_text(), text.get_window_extent()) for text in seen if id(text) not in hidden]


def _hidden(axes):
    """Texts of an axis that is switched off, labels of ticks beyond its ends, and ticks that are kept and not drawn."""
    for axis in (axes.xaxis, axes.yaxis):
        if not axes.axison:
            yield from axis.findobj(Text)
            continue
        ends = axis.get_view_interval()
        margin = 1e-9 * abs(ends[1] - ends[0])
        drawn = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        for tick in (*axis.majorTicks, *axis.minorTicks):
            within = min(ends) - margin <= tick.get_loc() <= max(ends) + margin
            if tick not in drawn or (not within and axes.name == "rectilinear"):
                yield from (tick.label1, tick.label2)


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
