"""Reading of a designation for the makers' tables: family, series, bore, seals."""

from typing import NamedTuple

from ..designations import readings, suffixes

FAMILIES = {
    "ball_bearing": ("deep_groove", "angular_contact", "four_point"),
    "cylindrical_roller_bearing": ("cylindrical", "cylindrical_full"),
    "tapered_roller_bearing": ("tapered",),
}
"""Families of bearings in catalogues, by kind of scene."""


class Said(NamedTuple):
    """The contents of a designation; fields that it does not state are empty or `None`.

    - `family`: one of those of `FAMILIES`.
    - `series`: as named in the tables of constants, such as "62", "320X", "72B" and, for NU 2, "2".
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
    """Reads a designation. The result is empty for an unknown form: nothing is guessed.

    It knows 6205, 608, 61805, 16005 (deep groove), 7205 BE, 7205 AC, 3205 A (angular contact), QJ 205 (four-point),
    NU 205, N 205, NJ 205, NUP 205 (cylindrical), NCF 3005, SL18 3005 (full complement), 30206, 32008 X, 32206 B
    (tapered) and inch-size tapered bearings by their letters (LM, HM and others).
    """
    reading = next(readings(text), None)
    if reading is None:
        return Said()
    marks = suffixes(reading)
    bore = None if reading.bore is None else 1e-3 * reading.bore
    return Said(reading.family, reading.series + marks.letters, bore, *marks.seal)
