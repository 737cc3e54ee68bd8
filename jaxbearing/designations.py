"""Parser of bearing designations such as 6205-2RSH, NU 311 or 32008 X: family, series, bore code and suffixes.

Dimensions are in `catalogue`, and the names of the makers' tables of constants in `makers`.
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
"""Series of cylindrical roller bearings; the constants above have those of the other families."""
CYLINDRICAL_TYPES = ("NUP", "NU", "NJ", "NF", "N")
INCH = ("LL", "LM", "L", "HM", "HH", "H", "M")
"""Prefix letters of inch-size tapered roller bearings."""
_END = r"(?!\d(?!RS|RZ|Z|HRS|BRS|ELS))"
"""End of the bore code: no further digit follows, except the 2 of a seal suffix such as 2RS or 2Z."""
_SEALS = r"2?RSR|2?RSH|2?RSL|2?RS1|2?RS2|2?RST|2?RSD|2?RS|2?RZ|2?HRS|2?BRS|2?ELS|2?RU|2?RD|2?NSE|"
_SEALS += r"LLU|LLB|LLH|LLC|DDU|DDW|DD|DU|LU|LB|LH|LS|VV|ZZ|2?Z"
_CAGES = r"TV[PH]B?\d?|TYN|TYP|TY|TNH|TNG|TN\d*|TPA|TP(?!\d)|TA|TB|TR|T\d*|MP(?!\d)[AB]?|ML|MR|M[AB]?\d?[AB]?|F[1AP]|"
_CAGES += r"JP\d?|JR|JW|J\d?|PH[AL]?|P(?!\d)|W|G[12](?!\d)|Y|Q|X|A|H\d?|R\d?"
_OTHERS = r"XL|DY|CL7[ABC]|V[A-Z]\d+|V\d(?!\d)|W(?:20|33|64)X?|K30|S[0-4](?!\d)|SN\d*|H[ABNTV]\d*|QE\d|E6|NS7S?|5K|"
_OTHERS += r"(?:LHT|HLT|MT|LT|GE|WT)[A-Z]?\d*|GJN|L\d{3}"
_MARKS = (
    ("clearance", r"C[2345](?!\d)|CN(?!\d)|CM"),
    ("tolerance", r"P[0-9][ASXY]?(?!\d)|PA\d+[A-Z]?|ABEC\d|SP(?!\w)|UP(?!\w)|HG(?!\w)"),
    ("ceramic", r"HC5?"),
    ("other", _OTHERS),
    ("seal", _SEALS),
    ("cage", _CAGES),
)
_OF_FAMILY = {
    "deep_groove": (("other", r"C(?![2-5NM])|NR|N(?![UJF\d])"),),
    "cylindrical": (("bore", r"K(?=C[2-5]|\b)"), ("other", r"NR|N(?![UJF\d])")),
    "tapered": (("other", r"U(?=R|\b)|ST"),),
}
"""Family -> kinds and patterns of the suffixes that only this family has."""
_SETS = r"D[BFTG](?:(?:EL|L|M|H)(?=P\d|\b))?|[TQ]BT|TFT|Q[BF]C"
_FOR_SETS = r"[SD]?U(?:EL|[AOLMHX])|C[ABC]|G[ABCLNMH]"
"""Patterns of the suffixes of bearing sets (`_SETS`), and of angular contact bearings that are ground for sets, with
classes of clearance or preload (`_FOR_SETS`)."""
_ANGLES: dict[str, tuple[str, float]] = {}
_ANGLES |= dict.fromkeys(("ACD", "ACE", "AC"), ("AC", 25.0)) | dict.fromkeys(("CD", "CE", "C"), ("C", 15.0))
_ANGLES |= dict.fromkeys(("B", "BE", "BEP"), ("B", 40.0)) | {"A15": ("", 15.0), "A": ("", 30.0)}
_ANGLES |= dict.fromkeys(("E", "A25", "A5", "AD"), ("", 25.0))
"""Suffix of an angular contact bearing -> letters that belong to its series, and contact angle, degrees. A is used by
NSK and SKF, A5 by NSK, AD by NTN, E by Schaeffler."""
_ANGLE = r"ACD|ACE|AC|A15|A25|A5|AD|A|CD|CE|BEP|BE|B|E|C(?![N2-5](?!\d))"
"""Pattern of the suffixes in `_ANGLES`. C2 to C5 and CN are excluded: they are clearance classes."""
_PREFIXES = r"(HR|4T|ET) ?(?=3\d)|(HCB|B)(?=7\d)|(E2|W|S) ?(?=6\d)"
"""Makers' prefixes: one group each for tapered roller, spindle and deep groove ball bearings."""
_STEEP = re.compile(r"303([01]\d) ?D(?=[JUR]|D[BFT]|\b)")
"""Pattern of NSK, NTN and JTEKT for bearings of series 313, such as 30306 D for 31306. Up to 95 mm bore, series 303 and
313 have the same boundary dimensions."""


class Reading(NamedTuple):
    """One way to read the number of a designation.

    **Arguments:**
    - `family`: "deep_groove", "angular_contact", "four_point", "cylindrical", "cylindrical_full" or "tapered".
    - `design`: type of a cylindrical roller bearing, such as "NU"; empty for others.
    - `series`: such as "62" or "302"; for an inch-size bearing, its letters.
    - `code`: bore code; empty for an inch-size bearing.
    - `rest`: the suffixes, still with the spaces between them.
    - `prefix`: prefix of a maker, such as "HR".
    """

    family: str
    design: str
    series: str
    code: str
    rest: str
    prefix: str = ""

    @property
    def bore(self) -> float | None:
        """Bore by the bore code, mm; `None` without a code."""
        return bore_of(self.code) if self.code else None


class Suffixes(NamedTuple):
    """The suffixes of a designation.

    **Arguments:**
    - `letters`: letters that belong to the series: "B", "AC" or "C" of single row angular contact bearings, "A" or "B"
      of double row ones, "X" or "B" of tapered bearings (the C of NSK and NTN is the B of other makers).
    - `angle`: contact angle of a single row angular contact bearing, degrees, if the suffix states one.
    - `reinforced`: True for E or EC of a cylindrical roller bearing.
    - `marks`: kind and text of each known prefix and suffix; kinds are "prefix", "angle", "set", "clearance",
      "tolerance", "ceramic", "seal", "cage", "bore" and "other".
    - `unread`: the characters that are not recognised.
    """

    letters: str
    angle: float | None
    reinforced: bool
    marks: tuple[tuple[str, str], ...]
    unread: str

    @property
    def seal(self) -> tuple[str, int]:
        """Name and number of the seals: "RSH" and 2 for 2RSH; "" and 0 if there are none."""
        text = next((text for kind, text in self.marks if kind == "seal"), "")
        if text in ("ZZ", "VV"):
            return text[0], 2
        if text.startswith("2"):
            return text[1:], 2
        return text, 2 if text[:2] in ("DD", "LL") else int(bool(text))


def readings(text: str) -> Iterator[Reading]:
    """Every way to read a designation, the most likely first; spaces, dashes and lower case do not matter."""
    spaced = re.sub(r"[\s_\-.]+|/(?!\s*\d)", " ", text).strip().upper()
    spaced = re.sub(rf"^({'|'.join(CYLINDRICAL_TYPES)}) ", r"\1", spaced)
    prefix = re.match(_PREFIXES, spaced)
    own = next(filter(None, prefix.groups())) if prefix else ""
    spaced = _STEEP.sub(r"313\1 D", spaced[prefix.end() :] if prefix else spaced)
    for number in dict.fromkeys((spaced, spaced.replace(" ", ""))):
        for reading in _number_readings(number):
            yield reading._replace(rest=reading.rest.strip(), prefix=own)


def _number_readings(text: str) -> Iterator[Reading]:
    for family, types, series in (
        ("cylindrical", "|".join(CYLINDRICAL_TYPES), "|".join(CYLINDRICAL)),
        ("cylindrical_full", r"NCF|NJG|SL ?18", "18|29|30|22|23"),
    ):
        match = re.match(rf"({types}) ?({series})(\d\d{_END}|/\d+)(.*)", text)
        if match:
            yield Reading(family, match[1], match[2], match[3], match[4])
    match = re.match(rf"QJ ?([23])(\d\d){_END}(.*)", text)
    if match:
        yield Reading("four_point", "", f"QJ{match[1]}", match[2], match[3])
    match = re.match(rf"({'|'.join(INCH)}) ?\d{{4,}}(.*)", text)
    if match:
        yield Reading("tapered", "", match[1], "", match[2])
    match = re.match(rf"({'|'.join(TAPERED)})(\d\d{_END}|/\d+)(.*)", text)
    if match:
        yield Reading("tapered", "", match[1], match[2], match[3])
    for family, every in (("deep_groove", DEEP_GROOVE), ("angular_contact", (*ANGULAR_CONTACT, *DOUBLE_ROW))):
        for series in sorted(every, key=len, reverse=True):
            yield from _ball_readings(text, family, series)


def _ball_readings(text: str, family: str, series: str) -> Iterator[Reading]:
    codes = [rf"\d\d{_END}", r"/\d+", rf"\d{_END}"] if family == "deep_groove" else [rf"\d\d{_END}"]
    # a slash precedes bores of 22, 28 and 32 mm and from 500 mm, and in series of three digits those below 10 mm
    for code in codes[:2] if len(series) == 3 else codes:
        match = re.match(rf"{series}({code})(.*)", text)
        if match:
            yield Reading(family, "", series, match[1], match[2])


def bore_of(code: str) -> float:
    """Bore, mm, by the bore code. "00" to "03" are 10, 12, 15 and 17 mm; other two-digit codes are a fifth of the bore;
    one digit, or a number after a slash, is the bore itself."""
    if code.startswith("/"):
        return float(code[1:])
    if len(code) == 1:
        return float(code)
    number = int(code)
    return {0: 10.0, 1: 12.0, 2: 15.0, 3: 17.0}.get(number, 5.0 * number)


def suffixes(reading: Reading) -> Suffixes:
    """Splits the suffixes of a designation (`Reading.rest`)."""
    rest, letters, angle, reinforced = reading.rest, "", None, False
    before = [("prefix", reading.prefix)] if reading.prefix else []
    if reading.family == "cylindrical" and rest.startswith("E"):
        rest, reinforced = re.sub(r"^EC?", "", rest), True
    elif reading.family == "angular_contact":
        letters, angle, rest = _row(reading.series, rest)
    elif reading.family == "tapered":
        match = re.match(r"B|C(?=[JU]|\b)|D(?=[JUR]|D[BFT]|\b)" if reading.series == "313" else r"B|C(?=[JU]|\b)", rest)
        if match:
            before.append(("angle", match[0]))
            letters, rest = "" if match[0] == "D" else "B", rest[1:]
        elif rest.startswith("X"):
            # X (metric design) stays in the rest: it is also a mark
            letters = "X"
    marks, unread = _marks(reading.family, rest)
    return Suffixes(letters, angle, reinforced, (*before, *marks), unread)


def _row(series: str, rest: str) -> tuple[str, float | None, str]:
    """Letters that belong to the series, contact angle, degrees, and remaining suffixes of an angular contact ball
    bearing."""
    if series in DOUBLE_ROW:
        return (rest[:1], None, rest[1:]) if rest.startswith(("A", "B")) else ("", None, rest)
    match = re.match(_ANGLE, rest)
    if match:
        return (*_ANGLES[match[0]], rest[match.end() :])
    return "", None, rest


def _marks(family: str, rest: str) -> tuple[tuple[tuple[str, str], ...], str]:
    sets = {"cylindrical": (), "angular_contact": (_SETS, _FOR_SETS)}.get(family, (_SETS,))
    marks = (*(("set", pattern) for pattern in sets), *_OF_FAMILY.get(family, ()), *_MARKS)
    known, unread = [], ""
    while rest := rest.lstrip(" /"):
        tried = ((mark, re.match(pattern, rest)) for mark, pattern in marks)
        kind, match = next(((mark, match) for mark, match in tried if match), ("", None))
        if match is None:
            unread, rest = unread + rest[0], rest[1:]
        else:
            known.append((kind, match[0]))
            rest = rest[match.end() :]
    return tuple(known), unread
