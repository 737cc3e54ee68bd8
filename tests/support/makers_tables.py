"""Bearings of makers' tables in `tests/catalogue` and `docs/examples`: dimensions, ratings, and of spindle bearings the
internal geometry."""

import csv
from pathlib import Path
from typing import NamedTuple

FOLDERS = [Path(__file__).parents[1] / "catalogue", Path(__file__).parents[2] / "docs" / "examples"]
NOT_IN_THE_TABLES = {"NU 1292", "NU 2268", "NU 2272", "NU 2276 ECMA", "NU 2292"}
"""Bearings of these tables whose dimensions the package does not have."""


class Printed(NamedTuple):
    """A row of a table: mm, N, degrees; what it does not have is `None`."""

    designation: str
    bore: float
    outside: float
    width: float
    dynamic_capacity: float
    static_capacity: float
    pitch_diameter: float | None = None
    ball_diameter: float | None = None
    n_balls: int | None = None
    contact_angle: float | None = None


def _rows(name):
    (file,) = (folder / name for folder in FOLDERS if (folder / name).exists())
    lines = file.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def spindle_bearings():
    """The 257 spindle bearings of one maker with printed geometry."""
    return [
        Printed(
            row["designation"],
            *(float(row[name]) for name in ("d", "D", "B", "C_N", "C0_N", "dm", "Dw")),
            int(row["Z"]),
            float(row["alpha0_deg"]),
        )
        for row in _rows("gmn_spindle_bearings.csv")
    ]


def rated_bearings():
    """Deep groove and cylindrical roller bearings with printed ratings."""
    return [
        Printed(
            row["designation"],
            *(float(row[name]) for name in ("d", "D", "B")),
            *(1e3 * float(row[name]) for name in ("C_kN", "C0_kN")),
        )
        for row in _rows("skf_ratings.csv")
    ]
