"""Reading of bearing designations such as 6207, 7312-B, NU 311, 30206 or 7014 C: type, series, bore and suffixes."""

import difflib
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import NamedTuple

from ..designations import CYLINDRICAL_TYPES, Reading, Suffixes, readings, suffixes
from ..designations import TAPERED as TAPERED_SERIES
from ..designations import bore_of as bore_of
from ..scenes.errors import SceneError
from .dimensions import bores, boundary_dimensions

CLEARANCES = ("C2", "CN", "C3", "C4")
"""Clearance classes whose limits are in the tables."""
RADIAL_SERIES = {
    "deep_groove": {"618": "18", "619": "19", "160": "00", "60": "10", "62": "02", "63": "03", "64": "04"},
    "angular_contact": {"72": "02", "73": "03"},
    "spindle": {"718": "18", "719": "19", "70": "10"},
    "cylindrical": {"10": "10", "22": "22", "23": "23", "2": "02", "3": "03", "4": "04"},
}
"""Dimension series of ISO 15 by type and series of the designation."""
STEEP = 20.5, 1.5
"""Cup angle of tapered roller bearings with the suffix B, and its standard deviation, degrees."""
_KIND_IN_WORDS = {
    "deep_groove": "deep groove ball bearing",
    "angular_contact": "angular contact ball bearing",
    "spindle": "angular contact ball bearing of a spindle series",
    "cylindrical": "cylindrical roller bearing",
    "tapered": "tapered roller bearing",
}
_NO_MODEL, _NO_SIZE = ", which is not modelled", ", whose dimensions are not in the tables"
_OTHERS = (
    (r"2(13|22|23|30|31|32|39|40|41)\d\d", f"a spherical roller bearing{_NO_MODEL}"),
    (r"(10|12|13|22|23)\d\d", f"a self-aligning ball bearing{_NO_MODEL}"),
    (r"(32|33|52|53)\d\d", f"a double row angular contact ball bearing{_NO_MODEL}"),
    (r"42\d\d|43\d\d", f"a double row deep groove ball bearing{_NO_MODEL}"),
    (r"5[1-4]\d\d\d|8\d\d\d\d|29\d\d\d", f"a thrust bearing{_NO_MODEL}"),
    (r"NNU?\d+|N[AK]I?\d+|RNA\d+|HK\d+|BK\d+", f"a needle or double row roller bearing{_NO_MODEL}"),
    (
        r"(U(C|K|EL|ER|R|S)|S(A|B|ER)|Y(AR|ET|EL|SA)|G(RAE|YE|E)?)[A-Z]*\d{3}",
        "an insert bearing, whose inside is that of a deep groove ball bearing 62 or 63 with its number",
    ),
    (
        r"(HS|HC|XC|XCB|HCS|HSS|RS)(70|718|719|72)\d\d",
        "a spindle bearing with small balls or of another steel, whose inside is not estimated",
    ),
    (r"(NCF|NJG|SL)\d+", f"a full complement cylindrical roller bearing{_NO_SIZE}"),
    (r"QJ\d+", f"a four-point contact ball bearing{_NO_SIZE}"),
    (r"T[2-7][A-H][B-E]\d+|(LL|LM|L|HM|HH|H|M)\d{4,}", f"a tapered roller bearing{_NO_SIZE}"),
)
"""Bearings that are recognized but not in the catalogue: pattern of the designation, and text for the message."""
_PREFIX_IN_WORDS = {
    "HR": "more or longer rollers than usual, which the maker's C and C0 tell",
    "E2": "less friction than usual, which is not modelled",
    **dict.fromkeys(("W", "S"), "stainless steel; the maker's C and C0 tell what it carries"),
}
_ANGLE_IN_WORDS = {
    "C": "a larger contact angle than without it, the B of other makers",
    "D": "the steep contact angle of series 313",
}


class Designation(NamedTuple):
    """The contents of a designation.

    **Arguments:**
    - `text`: the designation as it was typed.
    - `kind`: "deep_groove", "angular_contact", "spindle", "cylindrical" or "tapered".
    - `series`: of the designation, such as "62" or "302".
    - `design`: type of a cylindrical roller bearing, such as "NU"; empty for others.
    - `bore`, `outside`, `width`: boundary dimensions, mm; the width is T of a tapered roller bearing.
    - `contact_angle`: contact angle stated by a suffix, degrees; `None` if none states it.
    - `clearance_class`: "C2", "CN", "C3" or "C4".
    - `tightness`: standard deviation of the usual cup angle of a tapered roller bearing, degrees, else `None`.
    - `cup_width`: C of a tapered roller bearing, mm, else `None`.
    - `usual_angle`: usual cup angle of a tapered roller bearing of this size, degrees, else `None`.
    - `notes`: sentences on parts that were understood but do not change the scene.
    - `ceramic`: True for rolling elements of silicon nitride.
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
    ceramic: bool = False

    @property
    def name(self) -> str:
        """The designation as a file name, e.g. "NU_311"."""
        return re.sub(r"[^A-Za-z0-9]+", "_", self.text).strip("_")

    @property
    def race_width(self) -> float:
        """Width to which the roller length is related: C of a tapered roller bearing, otherwise the width, mm."""
        return self.width if self.cup_width is None else self.cup_width

    @property
    def in_words(self) -> str:
        """Kind of bearing in words."""
        return _KIND_IN_WORDS[self.kind]


def parse(text: str) -> Designation:
    """The designation in a text; spaces, dashes and lower case do not matter.

    **Raises:** `SceneError` for a part that is not understood, and, for an unknown designation, with the nearest known
    ones.
    """
    match = next((entry for entry in map(_known, readings(text)) if entry is not None), None)
    if match is None:
        raise _unknown(text)
    kind, reading, bore, sizes = match
    marks = suffixes(reading)
    if marks.unread:
        raise _unread(text, marks.unread)
    cup, usual, spread = sizes[3:6] if kind == "tapered" else (None, None, None)
    if kind == "tapered" and marks.letters == "B":
        usual, spread = STEEP
    clearance, notes = _clearance_and_notes(kind, marks)
    numbers = (bore, sizes[0], sizes[1], marks.angle)
    ceramic = reading.prefix.startswith("HC") or any(mark == "ceramic" for mark, _ in marks.marks)
    return Designation(
        text.strip(), kind, reading.series, reading.design, *numbers, clearance, cup, usual, spread, notes, ceramic
    )


def parse_several(text: str) -> tuple[Designation, ...]:
    """The designations in a text, separated by spaces. The words are combined to as few designations as possible, since
    "NU 311 ECP" is one.

    **Raises:** `SceneError` as `parse` does for the whole text, if it cannot be split.
    """
    words = text.replace(",", " ").split()
    fewest: list[tuple[Designation, ...] | None] = [()]
    for end in range(1, len(words) + 1):
        ways = []
        for begin, before in enumerate(fewest):
            with suppress(SceneError):
                if before is not None:
                    ways.append((*before, parse(" ".join(words[begin:end]))))
        fewest.append(min(ways, key=len, default=None))
    return fewest[-1] or (parse(text),)


def known_designations() -> Iterator[str]:
    """Every basic designation whose dimensions are known."""
    for kind, table in RADIAL_SERIES.items():
        designs = CYLINDRICAL_TYPES if kind == "cylindrical" else ("",)
        for series, dimension_series in table.items():
            for bore in bores(kind, dimension_series):
                code = _code(bore, series in ("618", "619"))
                # other kinds have no bores in between, and small ones of spindle bearings stand in no designation
                plain = len(code) == 2 or (kind == "cylindrical" and bore >= 500.0)
                if not plain and kind != "deep_groove":
                    continue
                yield from (f"{design} {series}{code}".strip() for design in designs)
    for series in TAPERED_SERIES:
        yield from (f"{series}{_code(bore)}" for bore in bores("tapered", series))


def _code(bore: float, thin: bool = False) -> str:
    """The bore code; it has a slash from 500 mm on, for bores that are not a multiple of 5 mm, and below 10 mm in the
    `thin` series."""
    if bore < 10.0:
        return f"/{bore:g}" if thin else f"{bore:g}"
    code = {10.0: "00", 12.0: "01", 15.0: "02", 17.0: "03"}.get(bore)
    return code or (f"/{bore:g}" if bore % 5.0 or bore >= 500.0 else f"{round(bore / 5.0):02d}")


class _Known(NamedTuple):
    """A reading whose dimensions are known: kind of bearing, bore and boundary dimensions, mm."""

    kind: str
    reading: Reading
    bore: float
    sizes: tuple[float, ...]


def _known(reading: Reading) -> _Known | None:
    """Kind and dimensions of a reading; `None` if the tables do not have its dimensions."""
    kinds = (kind for kind, series in RADIAL_SERIES.items() if reading.series in series and _fits(kind, reading))
    kind = "tapered" if reading.family == "tapered" else next(kinds, None)
    if kind is None or reading.bore is None:
        return None
    dimension_series = RADIAL_SERIES.get(kind, {}).get(reading.series, reading.series)
    sizes = boundary_dimensions(kind, dimension_series, reading.bore)
    return None if sizes is None else _Known(kind, reading, reading.bore, sizes)


def _fits(kind: str, reading: Reading) -> bool:
    """True if a kind of bearing of the tables belongs to the family that was read."""
    return kind == reading.family or (kind == "spindle" and reading.family == "angular_contact")


def _clearance_and_notes(kind: str, marks: Suffixes) -> tuple[str, tuple[str, ...]]:
    """Clearance class, and notes about the other suffixes."""
    clearance, notes = "CN", []
    if marks.reinforced:
        # today's bearings usually have it
        notes.append("E, EC: reinforced inner design, as all estimates of this type assume")
    for mark, text in marks.marks:
        clearance, note = _note(kind, mark, text, clearance)
        notes += [note] if note else []
    return clearance, tuple(dict.fromkeys(notes))


def _note(kind: str, mark: str, text: str, clearance: str) -> tuple[str, str]:
    if mark == "clearance":
        if kind not in ("deep_groove", "cylindrical"):
            return clearance, f"{text}: clearance class, not used: such bearings are given by their contact angle"
        if text not in CLEARANCES:
            return clearance, f"{text}: clearance class without a table here; set geometry.diametral_clearance"
        return text, ""
    if mark == "set":
        of_pairs = (
            "a scene of the kind shaft names this file twice and makes a set of it: twenty lines to copy stand in "
            "docs/worked_examples.md, 'The pair 7312-B itself'; 'jaxbearing fields shaft' lists all fields"
        )
        return clearance, f"{text}: of bearings for sets; the scene has one bearing, without preload: {of_pairs}"
    if mark == "prefix":
        return clearance, f"{text}: {_PREFIX_IN_WORDS[text]}" if text in _PREFIX_IN_WORDS else ""
    if mark == "angle":
        return clearance, "" if text == "B" else f"{text}: {_ANGLE_IN_WORDS[text]}"
    if mark == "ceramic":
        return clearance, ""
    if mark == "bore":
        return clearance, f"{text}: tapered bore, whose seat is not modelled"
    if mark == "other":
        return clearance, f"{text}: design, heat treatment, grease or noise class of a maker, not modelled"
    if mark == "tolerance":
        return clearance, f"{text}: tolerance class, not modelled; [fits] takes the normal class"
    if mark == "seal":
        return clearance, f"{text}: seals or shields, whose friction is not modelled"
    return clearance, f"{text}: cage or design of a maker, not modelled"


def _unread(text: str, part: str) -> SceneError:
    expected = (
        "known parts: leave this one out if it does not change the inside of the bearing, or give what it changes "
        "(--dynamic-capacity, --contact-angle, --balls and others)"
    )
    return SceneError("new", "", f"'{text.strip()}', of which '{part}' is not understood", expected)


def _unknown(text: str) -> SceneError:
    plain = re.sub(r"[\s_\-.]+|/(?!\s*\d)", "", text).upper()
    known = list(known_designations())
    by_plain = {name.replace(" ", "").replace("/", ""): name for name in known}
    near = difflib.get_close_matches(plain.replace("/", "")[:8], by_plain, n=3, cutoff=0.6)
    names = ", ".join(f"'{by_plain[key]}'" for key in near)
    other = next((words for pattern, words in _OTHERS if re.match(rf"(?:{pattern})(?!\d)", plain)), "")
    actual = f"'{text.strip()}'" + (f", {other}" if other else "")
    expected = "the designation of a bearing, such as 6207, 7312-B, NU 311, 30206 or 7014 C"
    if names and not other:
        expected += f"; the nearest that are known: {names}"
    return SceneError("new", "", actual, expected)
