"""The interval of a power loss as a table for the page and as text for the screen."""

from collections.abc import Iterator

from ..loss_interval import PowerInterval, not_counted
from .display import with_unit
from .page_content import Listing

TITLE = "How well the power loss is known"
HEADINGS = ("by", "5 % of the losses are below", "95 % are below", "distribution")
REMARK = "Only these inputs are counted, each independent of the others. All other inputs are as the scene has them."


def interval_listing(interval: PowerInterval) -> Listing:
    """Table of the interval due to all inputs with a distribution together, then of those due to each input alone,
    widest first."""
    rows = [(part.path, with_unit(part.low, "W"), with_unit(part.high, "W"), part.assumed) for part in interval.parts]
    together = ("all of these", with_unit(interval.low, "W"), with_unit(interval.high, "W"), "")
    left_out = not_counted(part.path for part in interval.parts)
    remarks = (REMARK, f"{left_out[0].upper()}{left_out[1:]}.")
    return Listing(TITLE, HEADINGS, [together, *rows] if len(rows) > 1 else rows, remarks, in_words=True)


def interval_headline(interval: PowerInterval) -> tuple[str, str]:
    """Name and value of the interval for the main results at the top."""
    return "power loss, 90 % between", f"{with_unit(interval.low, 'W')} and {with_unit(interval.high, 'W')}"


def interval_lines(interval: PowerInterval) -> Iterator[str]:
    """The interval and the inputs behind it as a sentence."""
    name, limits = interval_headline(interval)
    paths = [part.path for part in interval.parts]
    text = f"{name} {limits}, {'by' if len(paths) == 1 else 'mostly by'} {interval.by} ({interval.assumed})"
    yield f"{text}; counted: only {', '.join(paths)}; {not_counted(paths)}"
