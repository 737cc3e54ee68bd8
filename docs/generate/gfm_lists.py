"""Lists right below a line of text, and "**Validity:**" that begins a line, as docstrings have them: Python-Markdown
wants a blank line above the one, and makes one paragraph of lines with the other."""

import re

from markdown.extensions import Extension
from markdown.preprocessors import Preprocessor

_ITEM = re.compile(r"(?:[-*]|\d+\.) ")
_PART = re.compile(r"\*\*[A-Z][\w ,]*[:.]\*\*")
_FENCE = re.compile(r"\s*(```|~~~)")


def with_blank_lines(lines):
    """The lines with a blank one before each list and each named part that has none."""
    found, fenced = [], False
    for line in lines:
        above = found[-1] if found else ""
        inside = above.startswith("  ") or _ITEM.match(above)
        begins = _PART.match(line) or (_ITEM.match(line) and not inside)
        if not fenced and begins and above.strip():
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
