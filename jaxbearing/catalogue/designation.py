"""Reading of bearing designations such as 6207, 7312-B, NU 311, 30206 or 7014 C: type, series, bore and suffixes."""

import difflib
import re
from collections.abc import Iterator
from typing import NamedTuple

from ..designations import CYLINDRICAL_TYPES, Reading, Suffixes, readings, suffixes
from ..designations import TAPERED as TAPERED_SERIES
from ..designations import bore_of as bore_of
from ..scenes.errors import SceneError
from .dimensions import bores, boundary_dimensions

CLEARANCES = ("C2", "CN", "C3", "C4")
"""Clearance classes that are known by number."""
RADIAL_SERIES = {
    "deep_groove": {"618": "18", "619": "19", "160": "00", "60": "10", "62": "02", "63": "03", "64": "04"},
    "angular_contact": {"72": "02", "73": "03"},
    "spindle": {"718": "18", "719": "19", "70": "10"},
    "cylindrical": {"10": "10", "22": "22", "23": "23", "2": "02", "3": "03", "4": "04"},
}
"""Type -> series -> dimension series of ISO 15."""
STEEP = 20.5, 1.5
"""Cup angle of tapered roller bearings with the suffix B and its standard deviation, degrees."""
_KIND_IN_WORDS = {
    "deep_groove": "deep groove ball bearing",
    "angular_contact": "angular contact ball bearing",
    "spindle": "angular contact ball bearing of a spindle series",
    "cylindrical": "cylindrical roller bearing",
    "tapered": "tapered roller bearing",
}
_NOT_MODELLED = (
    (r"2(13|22|23|30|31|32|39|40|41)\d\d", "a spherical roller bearing"),
    (r"(10|12|13|22|23)\d\d", "a self-aligning ball bearing"),
    (r"(32|33|52|53)\d\d", "a double row angular contact ball bearing"),
    (r"42\d\d|43\d\d", "a double row deep groove ball bearing"),
    (r"5[1-4]\d\d\d|8\d\d\d\d|29\d\d\d", "a thrust bearing"),
    (r"NNU?\d+|N[AK]I?\d+|RNA\d+|HK\d+|BK\d+", "a needle or double row roller bearing"),
)


class Designation(NamedTuple):
    """The contents of a designation.

    **Arguments:**
    - `text`: the designation as it was typed.
    - `kind`: "deep_groove", "angular_contact", "spindle", "cylindrical" or "tapered".
    - `series`: of the designation, such as "62" or "302".
    - `design`: type of a cylindrical roller bearing, such as "NU"; empty for others.
    - `bore`, `outside`, `width`: boundary dimensions, mm; the width is T of a tapered roller bearing.
    - `contact_angle`: that the suffix states, degrees; `None` if none does.
    - `clearance_class`: "C2", "CN", "C3" or "C4".
    - `tightness`: standard deviation of the usual contact angle of a tapered roller bearing, degrees, else `None`.
    - `cup_width`: C of a tapered roller bearing, mm, else `None`.
    - `usual_angle`: cup angle of a tapered roller bearing that is usual for the size, degrees, else `None`.
    - `notes`: what was understood and does not change the scene, and what was not understood.
    """

    text: str
    kind: str
    series: str
    design: str
    bore: float
    outside: float
    width: float
    contact_angle: float | None
    clearance_class: str
    cup_width: float | None
    usual_angle: float | None
    tightness: float | None
    notes: tuple[str, ...]

    @property
    def name(self) -> str:
        """The designation as a file name, e.g. "NU_311"."""
        return re.sub(r"[^A-Za-z0-9]+", "_", self.text).strip("_")

    @property
    def race_width(self) -> float:
        """Width beside which rollers are as long: C of a tapered roller bearing, otherwise the width, mm."""
        return self.width if self.cup_width is None else self.cup_width

    @property
    def in_words(self) -> str:
        """Kind of bearing in words."""
        return _KIND_IN_WORDS[self.kind]


def parse(text: str) -> Designation:
    """The designation in a text; spaces, dashes and lower case do not matter.

    **Raises:** `SceneError` with the nearest designations if the text is none that is known.
    """
    found = next((one for one in map(_known, readings(text)) if one is not None), None)
    if found is None:
        raise _unknown(text)
    kind, reading, bore, sizes = found
    marks = suffixes(reading)
    cup, usual, spread = sizes[3:6] if kind == "tapered" else (None, None, None)
    if kind == "tapered" and marks.letters == "B":
        usual, spread = STEEP
    clearance, notes = _noted(kind, marks)
    numbers = (bore, sizes[0], sizes[1], marks.angle)
    return Designation(
        text.strip(), kind, reading.series, reading.design, *numbers, clearance, cup, usual, spread, notes
    )


def known_designations() -> Iterator[str]:
    """Every basic designation whose dimensions are known."""
    for kind, table in RADIAL_SERIES.items():
        designs = CYLINDRICAL_TYPES if kind == "cylindrical" else ("",)
        for series, dimension_series in table.items():
            for bore in bores(kind, dimension_series):
                code = _code(bore)
                single = len(code) == 1
                if single and kind != "deep_groove":
                    continue
                joint = "/" if single and series in ("618", "619") else ""
                yield from (f"{design} {series}{joint}{code}".strip() for design in designs)
    for series in TAPERED_SERIES:
        yield from (f"{series}{_code(bore)}" for bore in bores("tapered", series))


def _code(bore: float) -> str:
    if bore < 10.0:
        return f"{bore:g}"
    return {10.0: "00", 12.0: "01", 15.0: "02", 17.0: "03"}.get(bore, f"{round(bore / 5.0):02d}")


class _Known(NamedTuple):
    """A reading whose dimensions are known: kind of bearing, bore and boundary dimensions, mm."""

    kind: str
    reading: Reading
    bore: float
    sizes: tuple[float, ...]


def _known(reading: Reading) -> _Known | None:
    """`None` for a reading without dimensions in the tables."""
    kinds = (kind for kind, series in RADIAL_SERIES.items() if reading.series in series and _fits(kind, reading))
    kind = "tapered" if reading.family == "tapered" else next(kinds, None)
    if kind is None or reading.bore is None:
        return None
    dimension_series = RADIAL_SERIES.get(kind, {}).get(reading.series, reading.series)
    sizes = boundary_dimensions(kind, dimension_series, reading.bore)
    return None if sizes is None else _Known(kind, reading, reading.bore, sizes)


def _fits(kind: str, reading: Reading) -> bool:
    """True if a kind of the tables is one of the family that was read."""
    return kind == reading.family or (kind == "spindle" and reading.family == "angular_contact")


def _noted(kind: str, marks: Suffixes) -> tuple[str, tuple[str, ...]]:
    """Clearance class, and notes about the other suffixes."""
    clearance, notes = "CN", []
    if marks.reinforced:
        # the rule for today's bearings
        notes.append("E, EC: reinforced inner design, as all estimates of this type assume")
    for what, text in marks.marks:
        clearance, note = _said(kind, what, text, clearance)
        notes += [note] if note else []
    if marks.unread:
        notes.append(f"'{marks.unread}' was not understood")
    return clearance, tuple(dict.fromkeys(notes))


def _said(kind: str, what: str, text: str, clearance: str) -> tuple[str, str]:
    if what == "clearance":
        if kind not in ("deep_groove", "cylindrical"):
            return clearance, f"{text}: clearance class, not used: such bearings are given by their contact angle"
        if text not in CLEARANCES:
            return clearance, f"{text}: clearance class without a table here; set geometry.diametral_clearance"
        return text, ""
    if what == "set":
        of_pairs = (
            "a scene of the kind shaft names this file twice and makes a set of it: twenty lines to copy stand in "
            "docs/worked_examples.md, 'The pair 7312-B itself'; 'jaxbearing fields shaft' lists all fields"
        )
        return clearance, f"{text}: of bearings for sets; the scene has one bearing, without preload: {of_pairs}"
    if what == "tolerance":
        return clearance, f"{text}: tolerance class, not modelled; [fits] takes the normal class"
    if what == "seal":
        return clearance, f"{text}: seals or shields, whose friction is not modelled"
    return clearance, f"{text}: cage or design of a maker, not modelled"


def _unknown(text: str) -> SceneError:
    plain = re.sub(r"[\s_\-.]+|/(?!\s*\d)", "", text).upper()
    known = list(known_designations())
    by_plain = {one.replace(" ", "").replace("/", ""): one for one in known}
    near = difflib.get_close_matches(plain.replace("/", "")[:8], by_plain, n=3, cutoff=0.6)
    names = ", ".join(f"'{by_plain[one]}'" for one in near)
    other = next((words for pattern, words in _NOT_MODELLED if re.match(rf"(?:{pattern})(?!\d)", plain)), "")
    found = f"'{text.strip()}'" + (f", {other}, which is not modelled" if other else "")
    expected = "the designation of a bearing, such as 6207, 7312-B, NU 311, 30206 or 7014 C"
    if names and not other:
        expected += f"; the nearest that are known: {names}"
    return SceneError("new", "", found, expected)
