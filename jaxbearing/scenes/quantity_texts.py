"""Writes numbers as texts with units from which exactly the same numbers are read back."""

import math
from collections.abc import Iterator

from pydantic_core import PydanticCustomError

from . import units
from .usual_units import USUAL

_READABLE = {
    units.LENGTH: ("mm", "um", "m", "nm"),
    units.ANGLE: ("deg", "mrad", "rad"),
    units.SPEED: ("rpm", "rad/s"),
    units.SURFACE_SPEED: ("m/s", "mm/s", "um/s"),
    units.FORCE: ("N", "kN", "MN"),
    units.LINE_LOAD: ("N/mm", "kN/m", "N/m", "N/um"),
    units.MASS: ("kg", "g"),
    units.TILT_STIFFNESS: ("N*m/rad", "kN*m/rad"),
    units.MOMENT: ("N*m", "kN*m", "N*mm"),
    units.PRESSURE: ("GPa", "MPa", "kPa", "Pa"),
    units.INVERSE_PRESSURE: ("1/GPa", "1/Pa"),
    units.TEMPERATURE: ("degC", "K"),
    units.FLOW: ("l/h", "m^3/s"),
    units.VISCOSITY: ("Pa*s", "mPa*s"),
    units.KINEMATIC_VISCOSITY: ("cSt", "m^2/s"),
    units.KELVIN_PER_PRESSURE: ("K/GPa", "K/Pa"),
    units.KELVIN2_PER_PRESSURE: ("K^2/GPa", "K^2/Pa"),
    units.TIME: ("ms", "s", "us"),
    units.FREQUENCY: ("Hz", "kHz"),
    units.LINE_CONTACT_STIFFNESS: ("N/um^(10/9)", "N/mm^(10/9)", "N/m^(10/9)"),
}
"""Dimension -> customary units, the preferred unit first; quantities of other dimensions are written in SI units."""
_DIGITS = (6, 9, 12, 15, 16, 17)


def quantity_text(value: float, dimension: units.Dimension) -> str:
    """The text from which a value in SI is read back exactly, in the unit in which the number is shortest.

    A unit is used only if it gives the value back to the last bit; the SI unit always does.
    """
    return min(_texts(value, dimension), key=_length)


def text_in(unit: str, value: float, dimension: units.Dimension) -> str:
    """The text of a value in SI in a unit of `usual_units`. It is exact for a value that was typed in this unit; other
    values have 15 digits."""
    factor, zero = USUAL[dimension.si][unit]
    return _exact(unit, value, dimension) or f"{(value - zero) / factor:.15g} {unit}"


def _length(text: str) -> int:
    """Length of the number in a text, with a penalty for numbers that begin with "0." or are 10 000 or more."""
    number = text.partition(" ")[0].lstrip("-")
    return len(number.replace(".", "")) + (2 if number.startswith("0.") else 3 if float(number) >= 1e4 else 0)


def _texts(value: float, dimension: units.Dimension) -> Iterator[str]:
    """Exact texts of a value, first in the preferred units, last in the SI unit."""
    for unit in _READABLE.get(dimension, (dimension.si,)):
        exact = _exact(unit, value, dimension)
        if exact is not None:
            yield exact
    yield f"{value!r} {dimension.si}"


def _exact(unit: str, value: float, dimension: units.Dimension) -> str | None:
    """The shortest text in a unit from which exactly this value is read; `None` if there is none."""
    factor, zero = USUAL[dimension.si][unit]
    scaled = (value - zero) / factor
    texts = (f"{scaled:.{digits}g} {unit}" for digits in _DIGITS)
    return next((text for text in texts if _is_read_as(value, text, dimension)), None)


def _is_read_as(value: float, text: str, dimension: units.Dimension) -> bool:
    """True if exactly this value is read from the text; rounding can prevent it."""
    try:
        parsed = units.parse(text, dimension)
    except PydanticCustomError:
        # rounded up beyond the largest number, or no number at all
        return False
    return parsed == value and math.copysign(1.0, parsed) == math.copysign(1.0, value)
