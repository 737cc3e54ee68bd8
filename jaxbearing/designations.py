"""Grammar of bearing designations such as 6205-2RSH, NU 311 or 32008 X: family, series, bore code and suffixes.

It knows no dimensions: `catalogue` adds these, `makers` the names of the makers' tables of constants.
"""

import re
from collections.abc import Iterator
from typing import NamedTuple

DEEP_GROOVE = ("60", "62", "63", "64", "42", "43", "160", "161", "617", "618", "619", "622", "623", "628", "630", "637")
DEEP_GROOVE += ("638", "639")
ANGULAR_CONTACT = ("70", "72", "73", "718", "719")
DOUBLE_ROW = ("32", "33")
TAPERED = ("302", "303", "313", "320", "322", "323", "329", "330", "331", "332")
CYLINDRICAL = ("10", "12", "19", "20", "22", "23", "30", "2", "3", "4")
"""Series of the families."""
CYLINDRICAL_TYPES = ("NUP", "NU", "NJ", "NF", "N")
INCH = ("LL", "LM", "L", "HM", "HH", "H", "M")
"""Letters of tapered roller bearings of inch sizes."""
_END = r"(?!\d(?!RS|RZ|Z))"
"""No further digit of the number: the 2 of 2RS and 2Z belongs to the seals."""
_SEALS = r"2?RSR|2?RSH|2?RSL|2?RS1|2?RS|2?RZ|LLU|LLB|LLH|DDU|DU|LU|LS|VV|ZZ|2?Z"
_MARKS = (
    ("clearance", r"C[2345](?!\d)|CN(?!\d)"),
    ("tolerance", r"P[0-9]S?(?!\d)|SP(?!\w)|UP(?!\w)|HG(?!\w)"),
    ("seal", _SEALS),
    ("cage", r"TVP\d?|TVH|TN\d?|TA|MA|MB|ML|M|P|J\d?|Y|Q|X|A|H\d?|R\d?|JR|T"),
)
_SETS = r"D[BFT]|[TQ]BT|TFT|Q[BF]C"
_FOR_SETS = r"U[AOLM]|C[ABC]|G[ABC]"
"""Suffixes of sets of bearings, and of angular contact bearings that are ground for sets, with classes of clearance or
preload."""
_ANGLES = {"ACD": ("AC", 25.0), "AC": ("AC", 25.0), "CD": ("C", 15.0), "C": ("C", 15.0), "E": ("", 25.0)}
_ANGLES |= dict.fromkeys(("B", "BE", "BEP"), ("B", 40.0))
"""Suffix of an angular contact bearing -> letters of its series, contact angle, degrees."""
_ANGLE = r"ACD|AC|CD|BEP|BE|B|E|C(?![N2-5](?!\d))"
"""C2 to C5 and CN are classes of clearance."""


class Reading(NamedTuple):
    """One way to read the number of a designation.

    **Arguments:**
    - `family`: "deep_groove", "angular_contact", "four_point", "cylindrical", "cylindrical_full" or "tapered".
    - `design`: type of a cylindrical roller bearing, such as "NU"; empty for others.
    - `series`: such as "62" or "302"; of an inch-size bearing its letters.
    - `code`: bore code; empty for an inch-size bearing.
    - `rest`: the suffixes, without spaces.
    """

    family: str
    design: str
    series: str
    code: str
    rest: str

    @property
    def bore(self) -> float | None:
        """By the bore code, mm."""
        return bore_of(self.code) if self.code else None


class Suffixes(NamedTuple):
    """The suffixes of a designation.

    **Arguments:**
    - `letters`: those that belong to the series: "B", "AC" or "C" of angular contact, "X" or "B" of tapered, "A" or
      "B" of double row bearings.
    - `angle`: contact angle of a single row angular contact bearing, degrees, if the suffix states one.
    - `reinforced`: True for E or EC of a cylindrical roller bearing.
    - `marks`: kind, "set", "clearance", "tolerance", "seal" or "cage", and text of each suffix that is known.
    - `unread`: the rest.
    """

    letters: str
    angle: float | None
    reinforced: bool
    marks: tuple[tuple[str, str], ...]
    unread: str

    @property
    def seal(self) -> tuple[str, int]:
        """Name of the seal, "RSH" of 2RSH, and the number of seals; "", 0 without one."""
        text = next((text for what, text in self.marks if what == "seal"), "")
        if text in ("ZZ", "VV"):
            return text[0], 2
        if text.startswith("2"):
            return text[1:], 2
        return text, 2 if text[:2] in ("DD", "LL") else int(bool(text))


def readings(text: str) -> Iterator[Reading]:
    """Every way to read a designation, the most likely first; spaces, dashes and lower case do not matter."""
    spaced = re.sub(r"[\s_\-.]+|/(?!\s*\d)", " ", text).strip().upper()
    spaced = re.sub(rf"^({'|'.join(CYLINDRICAL_TYPES)}) ", r"\1", spaced)
    for number in dict.fromkeys((spaced, spaced.replace(" ", ""))):
        for found in _of_number(number):
            yield found._replace(rest=found.rest.replace(" ", ""))


def _of_number(text: str) -> Iterator[Reading]:
    for family, types, series in (
        ("cylindrical", "|".join(CYLINDRICAL_TYPES), "|".join(CYLINDRICAL)),
        ("cylindrical_full", r"NCF|NJG|SL ?18", "18|29|30|22|23"),
    ):
        match = re.match(rf"({types}) ?({series})(\d\d){_END}(.*)", text)
        if match:
            yield Reading(family, match[1], match[2], match[3], match[4])
    match = re.match(rf"QJ ?([23])(\d\d){_END}(.*)", text)
    if match:
        yield Reading("four_point", "", f"QJ{match[1]}", match[2], match[3])
    match = re.match(rf"({'|'.join(INCH)}) ?\d{{4,}}(.*)", text)
    if match:
        yield Reading("tapered", "", match[1], "", match[2])
    match = re.match(rf"({'|'.join(TAPERED)})(\d\d){_END}(.*)", text)
    if match:
        yield Reading("tapered", "", match[1], match[2], match[3])
    for family, every in (("deep_groove", DEEP_GROOVE), ("angular_contact", (*ANGULAR_CONTACT, *DOUBLE_ROW))):
        for series in sorted(every, key=len, reverse=True):
            yield from _of_balls(text, family, series)


def _of_balls(text: str, family: str, series: str) -> Iterator[Reading]:
    codes = [rf"\d\d{_END}", r"/\d+", rf"\d{_END}"] if family == "deep_groove" else [rf"\d\d{_END}"]
    # bores below 10 mm of the thin series stand after a stroke
    for code in codes[:2] if len(series) == 3 else codes:
        match = re.match(rf"{series}({code})(.*)", text)
        if match:
            yield Reading(family, "", series, match[1], match[2])


def bore_of(code: str) -> float:
    """Bore, mm, of a bore code: "00" to "03" are 10, 12, 15 and 17 mm, other numbers a fifth of the bore; one digit,
    or a number after a stroke, is the bore itself."""
    if code.startswith("/"):
        return float(code[1:])
    if len(code) == 1:
        return float(code)
    number = int(code)
    return {0: 10.0, 1: 12.0, 2: 15.0, 3: 17.0}.get(number, 5.0 * number)


def suffixes(reading: Reading) -> Suffixes:
    """The suffixes of a designation that was read so."""
    rest, letters, angle, reinforced = reading.rest, "", None, False
    if reading.family == "cylindrical" and rest.startswith("E"):
        rest, reinforced = re.sub(r"^EC?", "", rest), True
    elif reading.family == "angular_contact":
        letters, angle, rest = _row(reading.series, rest)
    elif reading.family == "tapered":
        letters = rest[:1] if rest.startswith(("X", "B")) else ""
        # X, of the metric design, is a mark of its own
        rest = rest[1:] if letters == "B" else rest
    return Suffixes(letters, angle, reinforced, *_marks(reading.family, rest))


def _row(series: str, rest: str) -> tuple[str, float | None, str]:
    """Letters of the series, contact angle and the suffixes that are left, of an angular contact ball bearing."""
    if series in DOUBLE_ROW:
        return (rest[:1], None, rest[1:]) if rest.startswith(("A", "B")) else ("", None, rest)
    match = re.match(_ANGLE, rest)
    if match:
        return (*_ANGLES[match[0]], rest[match.end() :])
    match = re.match(r"A(15|25)", rest)
    return ("", float(match[1]), rest[match.end() :]) if match else ("", None, rest)


def _marks(family: str, rest: str) -> tuple[tuple[tuple[str, str], ...], str]:
    sets = {"cylindrical": (), "angular_contact": (_SETS, _FOR_SETS)}.get(family, (_SETS,))
    marks = (*(("set", pattern) for pattern in sets), *_MARKS)
    found, unread = [], ""
    while rest:
        tried = ((what, re.match(pattern, rest)) for what, pattern in marks)
        what, match = next(((what, match) for what, match in tried if match), ("", None))
        if match is None:
            unread, rest = unread + rest[0], rest[1:]
        else:
            found.append((what, match[0]))
            rest = rest[match.end() :]
    return tuple(found), unread
