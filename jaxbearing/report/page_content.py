"""Content of the report page of a solve, of any kind."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from .diagrams import Diagram
from .panels import Panel
from .tables import Column, Row


@dataclass(frozen=True)
class Sketch:
    """A drawing: an SVG element, which is markup and no text, with heading and caption."""

    title: str
    markup: str
    caption: str


@dataclass(frozen=True)
class Listing:
    """A table of texts under a heading of its own, with remarks below it.

    - `in_words`: the last column holds words and is set as text; all other columns behind the first hold numbers.
    """

    title: str
    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    remarks: Sequence[str] = ()
    in_words: bool = False


@dataclass(frozen=True)
class Content:
    """Parts of the page; what is empty is not on it.

    - `operation`: the operating point in words.
    - `headlines`: name, value of the few results at the top.
    - `facts`: name, text of further results in words, under `facts_title`.
    - `not_modelled`: what the scene leaves out, in words.
    - `convergence`: name, text on how the solve ended.
    - `checks`: text of each check of the laws' ranges, whether it was left.
    - `stiffness`: names of the rows and columns, texts of the rows with units; "-" where the model has none.
    """

    kind: str
    operation: str
    headlines: Sequence[tuple[str, str]] = ()
    sketches: Sequence[Sketch] = ()
    facts: Sequence[tuple[str, str]] = ()
    facts_title: str = "Motion, films and stiffness"
    life: Sequence[Row] = ()
    not_modelled: str = ""
    charts: Sequence[Panel] = ()
    diagrams: Sequence[Diagram] = ()
    listings: Sequence[Listing] = ()
    convergence: Sequence[tuple[str, str]] = ()
    checks: Sequence[tuple[str, bool]] = ()
    notes: Sequence[str] = ()
    results: Sequence[Row] = ()
    elements: Sequence[Column] = ()
    element_name: str = "element"
    stiffness: tuple[Sequence[str], Sequence[Sequence[str]]] = field(default=((), ()))
