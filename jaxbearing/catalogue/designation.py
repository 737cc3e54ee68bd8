"""Reading of bearing designations such as 6207, 7312-B, NU 311, 30206 or 7014 C: type, series, bore and suffixes."""

import difflib
import re
from collections.abc import Iterator
from typing import NamedTuple

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
TAPERED_SERIES = ("302", "303", "313", "320", "322", "323", "329", "330", "331", "332")
STEEP = 20.5, 1.5
"""Cup angle of tapered roller bearings with the suffix B and its standard deviation, degrees."""
CYLINDRICAL_TYPES = ("NUP", "NU", "NJ", "NF", "N")
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
_SEALS = r"2RSR|2RSH|2RSL|2RS1|2RS|2RZ|RSH|RSL|RS1|RSR|RS|LLU|LLB|LLH|DDU|VV|2Z|ZZ|RZ|Z"
_SUFFIXES = (
    ("clearance", r"C[2345](?!\d)|CN(?!\d)"),
    ("tolerance", r"P[0-9]S?(?!\d)|SP(?!\w)|UP(?!\w)|HG(?!\w)"),
    ("seal", _SEALS),
    ("cage", r"TVP\d?|TVH|TN\d?|TA|MA|MB|ML|M|P|J\d?|Y|Q|X|A|H\d?|R\d?|JR|T"),
)
_SETS = r"D[BFT]|[TQ]BT|TFT|Q[BF]C"
_FOR_SETS = r"U[AOLM]|C[ABC]|G[ABC]"
"""Suffixes of sets of bearings, and of angular contact bearings that are ground for sets, with classes of clearance or
preload."""
_ANGLES = {"AC": 25.0, "ACD": 25.0, "C": 15.0, "CD": 15.0, "E": 25.0, "B": 40.0, "BE": 40.0, "BEP": 40.0}
_END = r"(?!\d(?!RS|RZ|Z))"
"""No further digit of the number: the 2 of 2RS and 2Z belongs to the seals."""
_BOTH = "angular_contact", "spindle"


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
    def in_words(self) -> str:
        """Kind of bearing in words."""
        return _KIND_IN_WORDS[self.kind]


def parse(text: str) -> Designation:
    """The designation in a text; spaces, dashes and lower case do not matter.

    **Raises:** `SceneError` with the nearest designations if the text is none that is known.
    """
    spaced = re.sub(r"[\s_\-.]+|/(?!\s*\d)", " ", text).strip().upper()
    spaced = re.sub(rf"^({'|'.join(CYLINDRICAL_TYPES)}) ", r"\1", spaced)
    plain = spaced.replace(" ", "")
    found = _basic(spaced) or _basic(plain)
    if found is None:
        raise _unknown(text, plain)
    kind, design, series, bore, sizes, rest = found
    angle, rest = _angle(kind, rest)
    cup, usual, spread = sizes[3:6] if kind == "tapered" else (None, None, None)
    if kind == "tapered" and rest.startswith("B"):
        usual, spread, rest = *STEEP, rest[1:]
    clearance, notes = _suffixes(kind, rest)
    return Designation(
        *(text.strip(), kind, series, design, bore, sizes[0], sizes[1], angle, clearance, cup, usual, spread, notes)
    )


def bore_of(code: str) -> float:
    """Bore, mm, of a bore code: "00" to "03" are 10, 12, 15 and 17 mm, other numbers a fifth of the bore; one digit,
    or a number after a stroke, is the bore itself."""
    if code.startswith("/"):
        return float(code[1:])
    if len(code) == 1:
        return float(code)
    number = int(code)
    return {0: 10.0, 1: 12.0, 2: 15.0, 3: 17.0}.get(number, 5.0 * number)


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


class _Basic(NamedTuple):
    """The contents of a number: type, series, bore and boundary dimensions, mm, and the suffixes that are left."""

    kind: str
    design: str
    series: str
    bore: float
    sizes: tuple[float, ...]
    rest: str


def _basic(text: str) -> _Basic | None:
    """The number of a designation; `None` if it is none whose dimensions are known."""
    for kind, design, series, code, rest in _readings(text):
        bore = bore_of(code)
        sizes = boundary_dimensions(kind, RADIAL_SERIES.get(kind, {}).get(series, series), bore)
        if sizes is not None:
            return _Basic(kind, design, series, bore, sizes, rest.replace(" ", ""))
    return None


def _readings(text: str) -> Iterator[tuple[str, str, str, str, str]]:
    """Kind, type, series, bore code and the rest, in every way in which a designation may be read."""
    match = re.match(rf"({'|'.join(CYLINDRICAL_TYPES)})(10|22|23|2|3|4)(\d\d){_END}(.*)", text)
    if match:
        yield "cylindrical", match[1], match[2], match[3], match[4]
    match = re.match(rf"({'|'.join(TAPERED_SERIES)})(\d\d){_END}(.*)", text)
    if match:
        yield "tapered", "", match[1], match[2], match[3]
    for kind in ("deep_groove", "spindle", "angular_contact"):
        for series in sorted(RADIAL_SERIES[kind], key=len, reverse=True):
            codes = [rf"\d\d{_END}", r"/\d+", rf"\d{_END}"] if kind == "deep_groove" else [rf"\d\d{_END}"]
            # bores below 10 mm of the thin series stand after a stroke
            for code in codes[:2] if len(series) == 3 else codes:
                match = re.match(rf"{series}({code})(.*)", text)
                if match:
                    yield kind, "", series, match[1], match[2]


def _angle(kind: str, rest: str) -> tuple[float | None, str]:
    """Contact angle of the suffix of an angular contact bearing, degrees, and the suffixes that are left."""
    if kind not in _BOTH:
        return None, rest
    # C2 to C5 are classes of clearance, and 25 or 15 after the number is the angle itself
    match = re.match(r"(ACD|AC|CD|BEP|BE|B|E|C(?![N2-5](?!\d)))", rest)
    if match:
        return _ANGLES[match[1]], rest[match.end() :]
    match = re.match(r"A(15|25)", rest)
    return (float(match[1]), rest[match.end() :]) if match else (None, rest)


def _suffixes(kind: str, rest: str) -> tuple[str, tuple[str, ...]]:
    """Clearance class, and notes about the other suffixes."""
    clearance, notes, unread = "CN", [], ""
    if kind == "cylindrical" and rest.startswith("E"):
        # reinforced inner design: the rule for today's bearings
        rest = re.sub(r"^EC?", "", rest)
        notes.append("E, EC: reinforced inner design, as all estimates of this type assume")
    sets = {"cylindrical": (), "angular_contact": (_SETS, _FOR_SETS), "spindle": (_SETS, _FOR_SETS)}.get(kind, (_SETS,))
    suffixes = (*(("set", pattern) for pattern in sets), *_SUFFIXES)
    while rest:
        tried = ((what, re.match(pattern, rest)) for what, pattern in suffixes)
        what, match = next(((what, match) for what, match in tried if match), ("", None))
        if match is None:
            unread, rest = unread + rest[0], rest[1:]
            continue
        rest = rest[match.end() :]
        clearance, note = _said(kind, what, match[0], clearance)
        notes += [note] if note else []
    if unread:
        notes.append(f"'{unread}' was not understood")
    return clearance, tuple(dict.fromkeys(notes))


def _said(kind: str, what: str, text: str, clearance: str) -> tuple[str, str]:
    if what == "clearance":
        if kind not in ("deep_groove", "cylindrical"):
            return clearance, f"{text}: clearance class, not used: such bearings are given by their contact angle"
        if text not in CLEARANCES:
            return clearance, f"{text}: clearance class without a table here; set geometry.diametral_clearance"
        return text, ""
    if what == "set":
        return clearance, f"{text}: of bearings for sets; the scene has one bearing, without preload"
    if what == "tolerance":
        return clearance, f"{text}: tolerance class, not modelled; [fits] takes the normal class"
    if what == "seal":
        return clearance, f"{text}: seals or shields, whose friction is not modelled"
    return clearance, f"{text}: cage or design of a maker, not modelled"


def _unknown(text: str, plain: str) -> SceneError:
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
