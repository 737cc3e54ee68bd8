"""Traction curves from the text exports of PCS Instruments' machines MTM (mini traction) and ETM (EHL traction).

The layout was taken from a published ETM export of 2019 (repository moritzploss/tribology, 518 steps) and compared
with the headers of an MTM and an EHD export there: tab-separated text, for each step a line "Step 3 started at ...", a
line "Step type<tab>Traction...", values of the step, a header with units in round brackets, and the rows. The MTM
export has no traction step, so that MTM traction curves are read on the assumption that their table is the ETM's.
Steps of a slide-to-roll sweep are those of the type "Traction" in any case of letters. Others (mapper, timed, film,
Stribeck, bidirectional traction) are ignored with a note, and a file without traction steps is refused.
"""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float64

from jaxbearing.scenes.csv_files import NumberReader

from .checks import check_count, check_sliding, remarks
from .columns import REQUIRED, Column, check_unit, to_si
from .errors import CurveError, refusing
from .pcs_steps import Step, steps_of
from .table import CurveTable

_SOURCES: dict[str, tuple[str, ...]] = {
    "slide_to_roll": ("srr",),
    "traction_coefficient": ("traction coeff", "traction coefficient"),
    "load": ("ball load",),
    "entrainment_speed": ("rolling speed",),
    "temperature": ("lube rtd temp", "lube temp", "pot rtd temp", "pot temp"),
}
"""Headings of each column, without units, the preferred one first. As in this package, the rolling speed of these
machines is the mean of the two surface speeds, and their SRR is the difference divided by that mean."""
_FORCE = "traction force"
_REQUIRED_HEADINGS = {"slide_to_roll": "SRR (%)", "traction_coefficient": "Traction Coeff (-)"}
_LAYOUT = "a table with the columns 'SRR (%)' and 'Traction Coeff (-)' in each 'Traction' step"


def parse_pcs(text: str, path: Path) -> CurveTable:
    """Points of the traction steps of an export; each step is one curve.

    Load, speed and temperature are read where every traction step has them; the temperature is the lubricant's, else
    the pot's. The machine prints the traction coefficient without a sign. Where the export has the traction force, the
    coefficient is given the sign of that force, reversed in steps where force and slide-to-roll ratio have opposite
    signs at most points.

    **Arguments:**
    - `text`: the content of the file.
    - `path`: its place, for messages.

    **Returns:** a `CurveTable`, in SI.

    **Raises:** `CurveError`.
    """
    file = str(path)
    steps = steps_of(text)
    sweeps = [step for step in steps if step.is_traction and step.rows]
    if not sweeps:
        raise CurveError(file, None, "", _kinds(steps), _LAYOUT)
    reader = _Reader(file, sweeps)
    lines = [row.number for step in sweeps for row in step.rows]
    check_count(file, len(lines), lines[-1], "two points")
    values = {name: reader.column(name, heading) for name, heading in reader.chosen.items()}
    check_sliding(file, sweeps[0].headings["srr"].text, values["slide_to_roll"])
    values["traction_coefficient"], sign_note = reader.signed(values)
    curve = np.repeat(np.arange(len(sweeps)), [len(step.rows) for step in sweeps])
    names = tuple(f"step {step.number}" for step in sweeps)
    unusual = remarks(values["slide_to_roll"], values["traction_coefficient"])
    notes = (*_step_notes(steps), *reader.notes(), sign_note, *unusual)
    return CurveTable(**values, curve=curve, curve_names=names, notes=notes, origin=path.name)


class _Reader:
    """Columns over all sweeps of one file, one after the other."""

    def __init__(self, file: str, sweeps: Sequence[Step]):
        self._file, self._sweeps = file, sweeps
        self._numbers = NumberReader(refusing(file), comma_allowed=True)
        self._check_rows()
        self.chosen = self._choose()

    def _check_rows(self) -> None:
        for step in self._sweeps:
            for row in step.rows:
                cells = row.text.rstrip().count("\t") + 1
                if cells > step.width:
                    expected = f"at most {step.width}, as in the header (line {step.line})"
                    raise CurveError(self._file, row.number, "", f"{cells} cells", expected)

    def _choose(self) -> dict[str, str]:
        """The heading that is read for each column."""
        chosen = {}
        for name, headings in _SOURCES.items():
            heading = next((heading for heading in headings if self._has(heading, name in REQUIRED)), None)
            if heading is not None:
                chosen[name] = heading
            elif name in REQUIRED:
                self._refuse_missing(name)
        return chosen

    def column(self, name: str, heading: str) -> Float64[np.ndarray, " point"]:
        """Values of a column in SI, over all sweeps."""
        return np.concatenate([self._column_of_step(name, heading, step) for step in self._sweeps])

    def signed(self, values: dict[str, np.ndarray]) -> tuple[Float64[np.ndarray, " point"], str]:
        """Traction coefficients with the sign of the force, and a note about the sign."""
        coefficient = values["traction_coefficient"]
        if not self._has(_FORCE, required=False):
            return coefficient, "The export has no traction force: coefficients are taken as printed, without sign."
        sense, start = np.empty_like(coefficient), 0
        for step in self._sweeps:
            part = slice(start, start + len(step.rows))
            force = self._raw(step, _FORCE)
            braking = np.sum(np.sign(force) * np.sign(values["slide_to_roll"][part]))
            sense[part] = np.where(force < 0.0, -1.0, 1.0) * (-1.0 if braking < 0.0 else 1.0)
            start = part.stop
        return np.abs(coefficient) * sense, "Traction coefficients have the sign of the traction force."

    def notes(self) -> list[str]:
        """Notes on conditions that are not in the export, and on the thermometer that was taken."""
        absent = [name for name in _SOURCES if name not in self.chosen]
        notes = [f"Not every traction step has '{_SOURCES[name][0]}': {name} is not read." for name in absent]
        if "temperature" in self.chosen:
            notes.append(f"Temperature is that of '{self._sweeps[0].headings[self.chosen['temperature']].text}'.")
        return notes

    def _has(self, heading: str, required: bool) -> bool:
        """True if all sweeps have this heading; an optional column must also have at least one value in each sweep."""
        if not all(heading in step.headings for step in self._sweeps):
            return False
        return required or all(any(_cell(row.text, step, heading) for row in step.rows) for step in self._sweeps)

    def _refuse_missing(self, name: str) -> None:
        headings = _SOURCES[name]
        lacking = (step for step in self._sweeps if not any(heading in step.headings for heading in headings))
        step = next(lacking, self._sweeps[0])
        actual = "the columns " + ", ".join(f"'{heading.text}'" for heading in list(step.headings.values())[:4])
        raise CurveError(self._file, step.line, _REQUIRED_HEADINGS[name], actual, _LAYOUT)

    def _column_of_step(self, name: str, heading: str, step: Step) -> Float64[np.ndarray, " row"]:
        there = step.headings[heading]
        column = Column(name, there.unit, there.text, step.line, there.index)
        check_unit(column, self._file)
        return to_si(self._raw(step, heading), column, [row.number for row in step.rows], self._file)

    def _raw(self, step: Step, heading: str) -> Float64[np.ndarray, " row"]:
        label = step.headings[heading].text
        return np.array([self._numbers.number(_cell(row.text, step, heading), row.number, label) for row in step.rows])


def _cell(row: str, step: Step, heading: str) -> str:
    cells, index = row.split("\t"), step.headings[heading].index
    return cells[index].strip() if index < len(cells) else ""


def _step_notes(steps: Sequence[Step]) -> list[str]:
    notes = []
    others = Counter(step.kind or "unknown" for step in steps if not step.is_traction)
    if others:
        kinds = ", ".join(f"{count} {kind}" for kind, count in others.items())
        notes.append(f"Steps of other types are ignored: {kinds}.")
    empty = [str(step.number) for step in steps if step.is_traction and not step.rows]
    if empty:
        notes.append(f"Traction steps without a table of points are ignored: {', '.join(empty[:10])}.")
    return notes


def _kinds(steps: Sequence[Step]) -> str:
    if not steps:
        return "no steps"
    if any(step.is_traction for step in steps):
        return "traction steps without a table"
    kinds = ", ".join(dict.fromkeys(step.kind or "unknown" for step in steps))
    return f"steps of the types {kinds} only"
