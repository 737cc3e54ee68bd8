"""Boundary dimensions and internal clearances of standard bearings, from the tables in `data`."""

import functools
import tomllib
from importlib import resources
from typing import Any


def boundary_dimensions(kind: str, series: str, bore: float) -> tuple[float, ...] | None:
    """The dimensions of a bearing other than its bore, mm; `None` if the table does not have this bore.

    **Arguments:** `kind`: of `Designation`; `series`: dimension series of ISO 15, or series of tapered roller bearings;
    `bore`: mm.

    Radial bearings have outside diameter and width. Tapered ones have D, T, B, C, and the usual half angle of the cup
    with its standard deviation, degrees.
    """
    rows = _tables(_file(kind))[series]["sizes"]
    return next((tuple(map(float, row[1:])) for row in rows if row[0] == bore), None)


def bores(kind: str, series: str) -> list[float]:
    """All bores of a series in the table, mm; arguments as for `boundary_dimensions`."""
    return [float(row[0]) for row in _tables(_file(kind))[series]["sizes"]]


def clearance_limits(kind: str, clearance_class: str, bore: float) -> tuple[float, float] | None:
    """Least and greatest radial internal clearance as defined in ISO 5753-1, which is diametral, micrometres; `None`
    beyond the table.

    **Arguments:** `kind`: "deep_groove" or "cylindrical"; `clearance_class`: "C2", "CN", "C3" or "C4"; `bore`: mm.
    """
    column = 2 + 2 * ("C2", "CN", "C3", "C4").index(clearance_class)
    rows = _tables("clearances")[kind]
    limits = (row[column : column + 2] for row in rows if row[0] < bore <= row[1])
    return next(((float(least), float(greatest)) for least, greatest in limits), None)


def _file(kind: str) -> str:
    return "tapered" if kind == "tapered" else "radial"


@functools.cache
def _tables(name: str) -> dict[str, Any]:
    file = resources.files("jaxbearing.catalogue") / "data" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))
