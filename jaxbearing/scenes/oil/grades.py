"""Standard oils: the tables of an ISO viscosity grade by base stock."""

import functools
import math
import re
import tomllib
from collections.abc import Mapping
from typing import Any

from ..data_files import grades_text
from ..errors import nearest, one_of

DEFAULT_BASE = "mineral"
"""Base stock of a grade if none is given."""
POINTS = (313.15, 373.15)
"""Temperatures, K, of the two viscosities that define the law of a grade."""
_ALSO = {"pag": "polyglycol"}
"""Further names of base stocks."""
_LAWS = ("viscosity", "rheology", "density", "conductivity", "heat_capacity")
_GRADE = re.compile(r"(?:ISO[\s-]*)?(?:VG[\s-]*)?(\d{1,5})", re.IGNORECASE)


@functools.cache
def _data() -> dict[str, Any]:
    return tomllib.loads(grades_text())


def bases() -> tuple[str, ...]:
    """Names of the base stocks."""
    return tuple(_data())


def base_named(value: object) -> str | None:
    """The base stock with this name in upper or lower case, e.g. "pao" or "PAG"; `None` if there is none."""
    by_lower = {base.lower(): base for base in bases()} | _ALSO
    return by_lower.get(value.strip().lower()) if isinstance(value, str) else None


def grades(base: str | None = None) -> tuple[str, ...]:
    """Grades of a base stock, or of all base stocks, in the order of rising viscosity."""
    chosen = bases() if base is None else (base,)
    numbers = {int(number) for stock in chosen for number in _data()[stock]["grades"]}
    return tuple(_name(number) for number in sorted(numbers))


def grade_named(value: object) -> str | None:
    """The grade "ISO VG 68" for a text such as "iso vg 68" or "VG68", or for 68; `None` for other values."""
    if isinstance(value, int) and not isinstance(value, bool):
        return _name(value)
    match = _GRADE.fullmatch(value.strip()) if isinstance(value, str) else None
    return None if match is None else _name(int(match[1]))


def nearest_grade(value: object, known: tuple[str, ...]) -> str:
    """The known grade with the nearest viscosity by ratio. For a text without a number the nearest name, or ""."""
    grade = grade_named(value)
    if grade is None:
        return nearest(value, known) if isinstance(value, str) else ""
    asked = math.log(max(number_of(grade), 1))
    return min(known, key=lambda name: abs(math.log(number_of(name)) - asked))


def number_of(grade: str) -> int:
    """Nominal viscosity of a grade at 40 degC, cSt."""
    return int(grade.rpartition(" ")[2])


def _name(number: int) -> str:
    return f"ISO VG {number}"


def grade_of(oil: Mapping[str, object]) -> tuple[str, str] | None:
    """Grade and base stock of an oil table; `None` without a grade, and if they are invalid."""
    grade, base = grade_named(oil.get("grade")), base_named(oil.get("base", DEFAULT_BASE))
    if grade is None or base is None or grade not in grades(base):
        return None
    return grade, base


def grade_tables(grade: str, base: str) -> dict[str, Any]:
    """The tables of the laws of a standard oil, as in an oil file."""
    data = _data()[base]
    tables = {law: dict(data[law]) for law in _LAWS}
    line = data["grades"][str(number_of(grade))]
    first, second = (viscosity_at(line["m"], line["n"], temperature) for temperature in POINTS)
    tables["viscosity"] |= {
        "viscosity_1": f"{first!r} mm^2/s",
        "temperature_1": f"{POINTS[0]!r} K",
        "viscosity_2": f"{second!r} mm^2/s",
        "temperature_2": f"{POINTS[1]!r} K",
    }
    return {"description": f"standard oil, {grade}, {base}", **tables}


def viscosity_at(m: float, n: float, temperature: float) -> float:
    """Kinematic viscosity on Walther's line, cSt. **Arguments:** `temperature`, K."""
    return 10.0**10.0 ** (m - n * math.log10(temperature)) - 0.7


def refused(base: str) -> str:
    """Text for messages that lists the grades of a base stock."""
    return (
        f"a grade of {base} oils: {one_of(grades(base))}; for another oil give two viscosities of its data sheet: "
        "[oil.viscosity] with law = 'two_viscosities'"
    )
