"""The steps of a PCS Instruments export: first line, kind and table of each step."""

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from jaxbearing.scenes.csv_files import Line, numbered_lines

_TITLE = re.compile(r"\s*(?:MTM|ETM|EHD|EHS)\w* Test Data File\b")
_STEP = re.compile(r"Step (\d+)\b[^\t]*\bstarted at\b")
_WITH_UNIT = re.compile(r"(?P<name>[^()]*\S)\s*\((?P<unit>[^()]*)\)")
_HAS_NUMBER = re.compile(r"[+-]?[.,]?\d")


@dataclass(frozen=True)
class Heading:
    """The header cell of a table: its text, the name in lower case, the unit, and its place in the rows."""

    text: str
    name: str
    unit: str
    index: int


@dataclass(frozen=True)
class Step:
    """One step of a test.

    **Arguments:**
    - `number`: number of the step in the file, from 1.
    - `kind`: type of the step as in the file, e.g. `Traction` or `BOD_TIMED`; empty if the file gives none.
    - `line`: number of the header line of its table or, without a table, of its first line.
    - `width`: number of cells of that header.
    - `headings`: headings of its table by name; the first one of a repeated name. Empty without a table.
    - `rows`: the lines of its table.
    """

    number: int
    kind: str
    line: int
    width: int
    headings: dict[str, Heading]
    rows: tuple[Line, ...]

    @property
    def is_traction(self) -> bool:
        """True if it is a sweep of the slide-to-roll ratio in one direction."""
        return self.kind.lower() == "traction"


def is_pcs_export(text: str) -> bool:
    """True if a text is an export of such a machine: it has the title or the first line of a step."""
    return any(_TITLE.match(line.text) or _STEP.match(line.text) for line in numbered_lines(text))


def steps_of(text: str) -> list[Step]:
    """All steps of an export, in order."""
    return [_step(first, lines) for first, lines in _parted(numbered_lines(text))]


def _parted(lines: Sequence[Line]) -> Iterator[tuple[Line, Sequence[Line]]]:
    starts = [place for place, line in enumerate(lines) if _STEP.match(line.text)]
    for start, end in itertools.pairwise([*starts, len(lines)]):
        yield lines[start], lines[start + 1 : end]


def _step(first: Line, lines: Sequence[Line]) -> Step:
    match = _STEP.match(first.text)
    number = int(match[1][:9]) if match else 0
    kind = next((line.text.split("\t")[1].strip() for line in lines if line.text.startswith("Step type\t")), "")
    header = next((place for place, line in enumerate(lines) if _is_header(line)), None)
    if header is None:
        return Step(number, kind, first.number, 0, {}, ())
    rows = tuple(line for line in lines[header + 1 :] if not _is_remark(line))
    width = len(lines[header].text.split("\t"))
    return Step(number, kind, lines[header].number, width, _headings(lines[header]), rows)


def _is_header(line: Line) -> bool:
    """True if a line has at least two names with units and no number; lines above a table have one name and its
    value."""
    cells = [cell.strip() for cell in line.text.split("\t") if cell.strip()]
    return sum(map(bool, map(_WITH_UNIT.fullmatch, cells))) > 1 and not any(map(_HAS_NUMBER.match, cells))


def _is_remark(line: Line) -> bool:
    """True if a line is blank or a sentence, e.g. that all steps are completed, and not a row of the table."""
    text = line.text.strip()
    return not text or ("\t" not in line.text.rstrip() and text[0].isalpha())


def _headings(line: Line) -> dict[str, Heading]:
    headings: dict[str, Heading] = {}
    for index, cell in enumerate(line.text.split("\t")):
        match = _WITH_UNIT.fullmatch(cell.strip())
        if match:
            heading = Heading(cell.strip(), match["name"].lower(), match["unit"].strip(), index)
            headings.setdefault(heading.name, heading)
    return headings
