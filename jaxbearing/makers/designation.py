"""What the designation of a catalogue bearing says: family, series, bore, seals."""

import re
from typing import NamedTuple

FAMILIES = {
    "ball_bearing": ("deep_groove", "angular_contact", "four_point"),
    "cylindrical_roller_bearing": ("cylindrical", "cylindrical_full"),
    "tapered_roller_bearing": ("tapered",),
}
"""Kind of scene -> families of catalogues."""
_FIRST_BORES = {"00": 10.0, "01": 12.0, "02": 15.0, "03": 17.0}
_DEEP_GROOVE = ("617", "618", "619", "622", "623", "628", "630", "637", "638", "639", "160", "161")
_TAPERED = ("302", "303", "313", "320", "322", "323", "329", "330", "331", "332")
_INCH = ("LL", "LM", "L", "HM", "HH", "H", "M")
_CYLINDRICAL = ("NUP", "NU", "NJ", "N")
_FULL = ("NCF", "NJG", "SL")
_SEAL = re.compile(r"(?<![A-Z])(2?)(RS[A-Z0-9]?|RZ|LS|Z|DDU|LLU|DU|LU)(?![A-Z0-9])")
_BOTH = ("DDU", "LLU")
"""Suffixes of other makers that stand for two seals."""


class Said(NamedTuple):
    """What a designation says; what it does not say is empty or `None`.

    - `family`: one of those of `FAMILIES`.
    - `series`: as the tables of constants name it, such as "62", "NU 2" as "2", "320X", "72B".
    - `bore`: by the bore code, m.
    - `seal`: SKF's name of the seal, "Z" for shields, which do not rub, or a name whose constants are not known, such
      as "RS"; `n_seals`: 1 or 2.
    """

    family: str = ""
    series: str = ""
    bore: float | None = None
    seal: str = ""
    n_seals: int = 0


def read_designation(text: str) -> Said:
    """What a designation says. One of an unknown form says nothing: nothing is guessed.

    It knows 6205, 61805, 16005 (deep groove), 7205 BE, 7205 AC, 3205 A (angular contact), QJ 205 (four-point), NU 205,
    N 205, NJ 205, NUP 205 (cylindrical), NCF 3005, SL18 3005 (full complement), 30206, 32008 X, 32206 B (tapered) and
    inch-size tapered bearings by their letters (LM, HM and others).
    """
    upper = text.upper().strip()
    parted = re.fullmatch(r"([A-Z]*)\s*([0-9]+)(.*)", upper)
    if parted is None:
        return Said()
    prefix, digits, suffix = parted.group(1), parted.group(2), parted.group(3)
    if prefix == "SL":
        digits = re.sub(r"^18\s*", "", (digits + suffix).strip())[:4]
        prefix, suffix = ("SL", "") if digits.isdigit() else ("?", "")
    found = _family(prefix, digits, suffix)
    if not found.family:
        return found
    seal = _SEAL.search(suffix)
    if seal is None:
        return found
    return found._replace(seal=seal.group(2), n_seals=2 if seal.group(1) or seal.group(2) in _BOTH else 1)


def _family(prefix: str, digits: str, suffix: str) -> Said:
    series, code = digits[:-2], digits[-2:]
    bore = _bore(code)
    letters = suffix.lstrip(" -")
    if prefix in _INCH and len(digits) >= 4:
        return Said("tapered", prefix)
    if prefix == "QJ" and series in ("2", "3"):
        return Said("four_point", f"QJ{series}", bore)
    if prefix in _CYLINDRICAL and series in ("2", "3", "4", "10", "12", "19", "20", "22", "23", "30"):
        return Said("cylindrical", series, bore)
    if prefix in _FULL and series in ("18", "29", "30", "22", "23"):
        return Said("cylindrical_full", series, bore)
    if prefix:
        return Said()
    if series in ("60", "62", "63", "64", "42", "43", *_DEEP_GROOVE):
        return Said("deep_groove", series, bore)
    if series in ("70", "72", "73", "718", "719"):
        angle = re.match(r"AC|B|C", letters)
        return Said("angular_contact", series + (angle.group() if angle else ""), bore)
    if series in ("32", "33"):
        angle = re.match(r"A|B", letters)
        return Said("angular_contact", series + (angle.group() if angle else ""), bore)
    if series in _TAPERED:
        letter = re.match(r"X|B", letters)
        return Said("tapered", series + (letter.group() if letter else ""), bore)
    return Said()


def _bore(code: str) -> float | None:
    """Bore by its code, m: 00 to 03 by a list, from 04 on five times the code in mm."""
    millimetres = _FIRST_BORES.get(code, 5.0 * int(code) if int(code) >= 4 else None)
    return None if millimetres is None else 1e-3 * millimetres
