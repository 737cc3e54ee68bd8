"""Meaning of the columns of a curve file: their dimensions, their units, and their values in SI."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float64
from pydantic_core import PydanticCustomError

from jaxbearing.scenes.units import FORCE, PRESSURE, SURFACE_SPEED, TEMPERATURE, Dimension, parse, registry
from jaxbearing.scenes.words import describe

from .errors import CurveError

REQUIRED = ("slide_to_roll", "traction_coefficient")
DIMENSIONS: dict[str, Dimension] = {
    "pressure": PRESSURE,
    "load": FORCE,
    "entrainment_speed": SURFACE_SPEED,
    "temperature": TEMPERATURE,
}
CURVE = "curve"
KNOWN = (*REQUIRED, *DIMENSIONS, CURVE)
EXAMPLES = {
    "slide_to_roll": "slide_to_roll [%]",
    "traction_coefficient": "traction_coefficient",
    "pressure": "pressure [GPa]",
    "load": "load [N]",
    "entrainment_speed": "entrainment_speed [m/s]",
    "temperature": "temperature [degC]",
}
ALSO_CALLED = {
    "mu": "traction_coefficient",
    "cof": "traction_coefficient",
    "traction": "traction_coefficient",
    "friction_coefficient": "traction_coefficient",
    "srr": "slide_to_roll",
    "slide_roll_ratio": "slide_to_roll",
    "slip": "slide_to_roll",
}
"""Headings of other programs, in lower case, and the column to suggest: such headings are not read, because their
signs and units differ."""
_RATIO_UNITS = {"": 1.0, "-": 1.0, "1": 1.0, "%": 100.0, "percent": 100.0}
"""Units of a ratio, with the divisor of numbers in that unit."""


@dataclass(frozen=True)
class Column:
    """One column that is read from a file.

    **Arguments:**
    - `name`: which of `KNOWN` it is.
    - `unit`: as written; empty where the file gives none.
    - `label`: its name in messages.
    - `line`: of its header; `None` where the unit comes from elsewhere.
    - `index`: place in the rows, from 0.
    """

    name: str
    unit: str
    label: str
    line: int | None
    index: int


def check_unit(column: Column, file: str, hint: str = "") -> None:
    """Refuses a unit that the column cannot have.

    `hint` says where else a unit may stand.

    **Raises:** `CurveError` for a missing unit, an unknown unit and a unit of another dimension.
    """
    dimension = DIMENSIONS.get(column.name)
    if dimension is None:
        if column.unit not in _RATIO_UNITS:
            expected = "a ratio, without a unit or in '%'"
            raise CurveError(file, column.line, column.label, f"the unit {describe_unit(column.unit)}", expected)
        return
    expected = f"the unit of {dimension.name}, e.g. '{EXAMPLES[column.name]}'{hint}"
    if not column.unit:
        raise CurveError(file, column.line, column.label, "no unit", expected)
    quantity = f"1 {column.unit}"
    try:
        parse(quantity, dimension)
    except PydanticCustomError as error:
        # `parse` speaks of the text of a quantity: "the text '1 foo', where 'foo' is not a unit"
        reason = str((error.context or {}).get("found", "")).removeprefix(describe(quantity))
        actual = f"the unit {describe_unit(column.unit)}"
        actual += ", which is not known" if "is not a unit" in reason else reason
        raise CurveError(file, column.line, column.label, actual, expected) from None


def fits(unit: str, dimension: Dimension) -> bool:
    """True if a unit has this dimension."""
    try:
        parse(f"1 {unit}", dimension)
    except PydanticCustomError:
        return False
    return True


def describe_unit(unit: str) -> str:
    """A unit as written, for messages."""
    return describe(unit).removeprefix("the text ")


def to_si(
    values: Float64[np.ndarray, " point"], column: Column, lines: Sequence[int], file: str
) -> Float64[np.ndarray, " point"]:
    """The values of a column whose unit was checked, in SI (ratios as ratios).

    `lines` are the numbers of the lines that the values stand in.

    **Raises:** `CurveError` for pressures, loads, speeds and absolute temperatures that are not > 0, and for numbers
    that are not finite in SI.
    """
    dimension = DIMENSIONS.get(column.name)
    if dimension is None:
        return values / _RATIO_UNITS[column.unit]
    units = registry()
    with np.errstate(over="ignore"):
        result = units.Quantity(values, units.Unit(column.unit)).to(dimension.si).magnitude
    wrong = np.flatnonzero(~(np.isfinite(result) & (result > 0.0)))
    if wrong.size:
        actual = f"{values[wrong[0]]:g} {column.unit}"
        raise CurveError(file, lines[wrong[0]], column.label, actual, dimension.expected("> 0"))
    return np.asarray(result, dtype=np.float64)
