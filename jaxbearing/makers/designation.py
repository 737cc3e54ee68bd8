"""A designation in the terms of the makers' tables: family, series, bore, seals."""

from typing import NamedTuple

from ..designations import readings, suffixes

FAMILIES = {
    "ball_bearing": ("deep_groove", "angular_contact", "four_point"),
    "cylindrical_roller_bearing": ("cylindrical", "cylindrical_full"),
    "tapered_roller_bearing": ("tapered",),
}
"""Kind of scene -> families of catalogues."""


class Said(NamedTuple):
    """The contents of a designation; what is not in it is empty or `None`.

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
    """Reads a designation. The contents of one of an unknown form are empty: nothing is guessed.

    It knows 6205, 608, 61805, 16005 (deep groove), 7205 BE, 7205 AC, 3205 A (angular contact), QJ 205 (four-point),
    NU 205, N 205, NJ 205, NUP 205 (cylindrical), NCF 3005, SL18 3005 (full complement), 30206, 32008 X, 32206 B
    (tapered) and inch-size tapered bearings by their letters (LM, HM and others).
    """
    found = next(readings(text), None)
    if found is None:
        return Said()
    marks = suffixes(found)
    bore = None if found.bore is None else 1e-3 * found.bore
    return Said(found.family, found.series + marks.letters, bore, *marks.seal)
