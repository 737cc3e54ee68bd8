"""Formulas as MathML, which browsers draw by themselves: no script, no network, one font that comes with a package."""

import html
import re
from importlib.util import find_spec
from pathlib import Path

_NAMES = "sin|cos|tan|ln|exp|sinh|asinh|artanh"
_FUNCTION = re.compile(rf"(?<!<msup>)(?<!<msub>)(<mi>(?:{_NAMES})</mi>)(?=<m(?:i|n|sub|sup|frac)>)")
"""A named function before its argument without brackets: a thin space is wanted between them."""
_FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', flags=re.DOTALL)


def to_mathml(page):
    """The page with the formulas that `pymdownx.arithmatex` marked turned into MathML."""
    return _FORMULA.sub(_one, page)


def _one(found):
    from latex2mathml.converter import convert

    display = "block" if found[2] == "[" else "inline"
    formula = convert(html.unescape(found[3]).strip(), display=display)
    return _FUNCTION.sub(r'\1<mspace width="0.17em" />', formula)


def font():
    """STIX Two Math (SIL Open Font License): without a font made for formulas, indices and fractions sit badly."""
    # found, not imported, which warns
    (folder,) = find_spec("ziamath").submodule_search_locations
    return (Path(folder) / "fonts" / "STIXTwoMath-Regular.ttf").read_bytes()
