"""Lists that begin right below a line of text, as docstrings and README have them: Python-Markdown wants a blank line."""

import re

from markdown.extensions import Extension
from markdown.preprocessors import Preprocessor

_ITEM = re.compile(r"(?:[-*]|\d+\.) ")
_FENCE = re.compile(r"\s*(```|~~~)")


def with_blank_lines(lines):
    """The lines with a blank one before each list that has none."""
    found, fenced = [], False
    for line in lines:
        above = found[-1] if found else ""
        inside = above.startswith("  ") or _ITEM.match(above)
        if not fenced and _ITEM.match(line) and above.strip() and not inside:
            found.append("")
        found.append(line)
        if _FENCE.match(line):
            fenced = not fenced
    return found


class GfmLists(Extension):
    def extendMarkdown(self, md):
        # before fenced blocks (25) are taken out, after line ends are normalised (30)
        md.preprocessors.register(_Blank(md), "gfm_lists", 29)


class _Blank(Preprocessor):
    def run(self, lines):
        return with_blank_lines(lines)
