"""The common part of all comparisons: their form, readers of the data, texts of deviations and tables."""

import csv
import importlib.util
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

TOP = Path(__file__).parents[3]
DOCS = TOP / "docs"
MEASURED = DOCS / "examples" / "measured"


class Found(NamedTuple):
    """The results of a comparison.

    **Arguments:**
    - `headings`, `rows`: of its table, texts.
    - `deviations`: what -> model over measurement, less 1: those that the verdict is about.
    - `said`: the deviation in words, where it is none in per cent.
    - `told`: a sentence on what was fitted, where numbers of the comparison stand in it.
    """

    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    deviations: Mapping[str, float]
    said: str = ""
    told: str = ""

    @property
    def deviation(self) -> str:
        """Least and largest deviation in words."""
        return self.said or ends(list(self.deviations.values()))

    @property
    def table(self) -> str:
        """The table in Markdown."""
        rule = "|---" * len(self.headings) + "|"
        first, *rest = (f"| {' | '.join(line)} |" for line in (self.headings, *self.rows))
        return "\n".join([first, rule, *rest])


KINDS = {
    "measured": "Somebody measured it. Unless the comparison says otherwise, a third party read the numbers off a "
    "printed figure.",
    "computed": "Somebody else computed it. No measurement is behind it.",
    "catalogue": "A maker prints it. The catalogue does not say whether it was measured or computed.",
    "estimate": "We computed it. There is nothing to compare it with.",
}
"""Kinds of data, in the words of the page."""


@dataclass(frozen=True)
class Comparison:
    """One comparison with measured or printed data.

    **Arguments:**
    - `name`: of its place on the page; `quantity`, `data`: in words.
    - `kind`: one of `KINDS`; `conditions`: load, oil, flow and temperatures of the data, in sentences.
    - `free`: what was fitted to these data or chosen with knowledge of them; `assumed`: what is not known of the rig
      and was taken; both in sentences.
    - `missed`: what the model does not reproduce, and the reason or that it is not known, in sentences.
    - `believe`: per cent to which the verdict says that the model can be believed; `None`: it names none.
    - `data_error`: of the data themselves, per cent, as their source claims or the caution says.
    - `verdict`: short sentences; `{believe}` stands for the number.
    - `compute`: the table and the deviations.
    - `dear`: whether that takes more than some seconds.
    """

    name: str
    quantity: str
    data: str
    kind: str
    conditions: str
    free: str
    assumed: str
    missed: str
    believe: float | None
    data_error: float
    verdict: str
    compute: Callable[[], Found]
    dear: bool = True

    @property
    def believed(self) -> str:
        """The number of the verdict."""
        return "-" if self.believe is None else f"{self.believe:g} %"

    def __post_init__(self):
        if self.kind not in KINDS:
            raise ValueError(f"{self.name}: kind is '{self.kind}'; expected one of {', '.join(KINDS)}")

    @property
    def sentence(self) -> str:
        """The verdict with its number."""
        return self.verdict if self.believe is None else self.verdict.format(believe=f"{self.believe:g}")


def ends(values: Sequence[float]) -> str:
    """Least and largest of relative deviations, per cent, with the digits that their size deserves."""
    largest = max(map(abs, values))
    places = 0 if largest >= 0.05 else 1 if largest >= 0.005 else 2 if largest >= 5e-4 else 3
    low, high = (f"{100.0 * value:+.{places}f}" for value in (min(values), max(values)))
    return f"{low} %" if low == high else f"{low} to {high} %"


def beside(found: float, measured: float, places: int = 0) -> str:
    """A number with its deviation in brackets."""
    return f"{found:.{places}f} ({100.0 * (found / measured - 1.0):+.0f} %)"


def rows_of(file: Path) -> list[dict[str, str]]:
    """Rows of a CSV file without its notes."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def script(name: str) -> ModuleType:
    """A script of `docs/examples`, as a module."""
    spec = importlib.util.spec_from_file_location(name, DOCS / "examples" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def table_of_page(page: str, first_heading: str, beginning: str = "") -> list[list[str]]:
    """Rows of all tables of a page whose first heading this is; those that begin so."""
    rows, inside = [], False
    for line in (DOCS / page).read_text(encoding="utf-8").splitlines():
        row = cells(line)
        if row[:1] == [first_heading]:
            inside = True
        elif not row:
            inside = False
        elif inside and not row[0].startswith("---") and row[0].startswith(beginning):
            rows.append(row)
    if not rows:
        raise ValueError(f"{page}: found no table that begins with '{first_heading}', with rows '{beginning}'")
    return rows


def cells(line: str) -> list[str]:
    """Cells of a line of a table."""
    return [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else []
