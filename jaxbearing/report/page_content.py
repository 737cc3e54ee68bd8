"""Content of the report page of a solution of any kind."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from .diagrams import Diagram
from .panels import Panel
from .tables import Column, Row


@dataclass(frozen=True)
class Sketch:
    """A drawing with heading and caption; `markup` is an SVG element, which is put into the page unescaped."""

    title: str
    markup: str
    caption: str


@dataclass(frozen=True)
class Listing:
    """A table of texts with its own heading, and remarks below it.

    - `in_words`: True if the last column is set as text, not as numbers like the columns between it and the first.
    """

    title: str
    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    remarks: Sequence[str] = ()
    in_words: bool = False


@dataclass(frozen=True)
class Content:
    """Sections of the report page; empty ones are left out.

    - `operation`: the operating point in words.
    - `headlines`: name and value of the few results at the top.
    - `facts`: name and text of further results, under the heading `facts_title`.
    - `not_modelled`: effects that the scene leaves out, in words.
    - `convergence`: name and text of each line on how the solve ended.
    - `checks`: text of each range check of a law, and True if the range was left.
    - `stiffness`: names of the rows and columns, and rows of texts with units; "-" for an entry that is not modelled.
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
