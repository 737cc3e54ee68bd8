"""Numbers with units as a person writes them ("30 um", "60degC", "10.4 1/GPa"), turned into SI floats for pydantic.

pint defines all units; `usual_units` holds its factors for the most common ones. Number and unit are separated here
first, because pint's own reader of quantities takes "1,5 mm" for 15 mm and "1 000 m" for 0 m.
"""

import functools
import math
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from ..numerics.ranges import CLOSURES, RANGES
from .usual_units import USUAL
from .words import describe, is_finite, short, shortened

if TYPE_CHECKING:
    import pint

_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
_NAME = r"[A-Za-z°µμΩÅ_][A-Za-z0-9°µμΩÅ_]*"
_FRACTION = r"\([1-9][0-9]?/[1-9][0-9]?\)"
_POWER = rf"(?: *(?:\*\*|\^) *(?:[+-]?[0-9]{{1,2}}(?![0-9])|{_FRACTION})|⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]{{1,2}})"
_FACTOR = rf"\(* *(?:{_NAME}{_POWER}?|[0-9]+(?:\.[0-9]+)?) *\)*"
_UNIT = re.compile(rf"{_FACTOR}(?:(?: *[*/·] *| +){_FACTOR})*")
"""Syntax of a unit, checked because pint evaluates its input, skips comments and ignores unknown characters. Brackets
cannot have a power, so that powers are not nested. A power may be a fraction of whole numbers in brackets."""
_WORDS = re.compile(r"\b(?:square|sq|squared|cubic|cubed|per)\b", re.IGNORECASE)
"""Words that pint replaces by powers or a division, which `_UNIT` does not recognise."""
_LONGEST_UNIT = 40
_NON_FINITE = re.compile(r"\s*[+-]?(nan|inf|infinity)\b", re.IGNORECASE)
_SI_NUMBERS: ContextVar[bool] = ContextVar("bare numbers are SI values", default=False)
_REMEMBERED = 1024
"""Number of cached units: pint takes a millisecond to read a unit, which dominated the reading of a scene."""


@dataclass(frozen=True)
class Dimension:
    """Physical dimension of a field: name in messages, SI unit, example, and whether units with an offset (degC) are
    allowed."""

    name: str
    si: str
    example: str
    offset_allowed: bool = False

    def expected(self, bound: str = "finite") -> str:
        """Expected content of a field of this dimension, within a bound of `numerics.ranges.RANGES`, in words."""
        bound = "" if bound == "finite" else bound
        if bound == "> 0" and self.offset_allowed:
            bound = "above absolute zero"
        example = "5 um" if bound == CLOSURES else self.example
        return f"{self.name}{bound and ' '}{bound} with a unit, e.g. '{example}'"


LENGTH = Dimension("a length", "m", "12 mm")
ANGLE = Dimension("an angle", "rad", "0.375 deg")
SPEED = Dimension("a rotational speed", "rad/s", "10500 rpm")
SURFACE_SPEED = Dimension("a speed", "m/s", "1 mm/s")
FORCE = Dimension("a force", "N", "25 kN")
LINE_LOAD = Dimension("a load per length or a stiffness", "N/m", "76.31 N/mm")
FOUNDATION = Dimension("a stiffness per length", "N/m^2", "1e10 N/m^2")
LINE_CONTACT_STIFFNESS = Dimension("a stiffness of line contacts", "N/m^(10/9)", "60 N/um^(10/9)")
MOMENT = Dimension("a moment", "N*m", "50 N*m")
PRESSURE = Dimension("a pressure or modulus", "Pa", "203 GPa")
INVERSE_PRESSURE = Dimension("a reciprocal pressure", "1/Pa", "10.4 1/GPa")
TEMPERATURE = Dimension("a temperature", "K", "100 degC", offset_allowed=True)
TEMPERATURE_DIFFERENCE = Dimension("a temperature difference", "K", "29.406 K")
FLOW = Dimension("a volume flow", "m^3/s", "150 l/h")
DENSITY = Dimension("a density", "kg/m^3", "7850 kg/m^3")
DENSITY_SLOPE = Dimension("a change of density with temperature", "kg/m^3/K", "-0.752 kg/m^3/K")
VISCOSITY = Dimension("a dynamic viscosity", "Pa*s", "4.7 mPa*s")
KINEMATIC_VISCOSITY = Dimension("a kinematic viscosity", "m^2/s", "32 cSt")
CONDUCTIVITY = Dimension("a thermal conductivity", "W/(m*K)", "0.147 W/(m*K)")
CONDUCTIVITY_SLOPE = Dimension("a change of conductivity with temperature", "W/(m*K^2)", "-2.2e-4 W/(m*K^2)")
HEAT_CAPACITY_SLOPE = Dimension("a change of heat capacity with temperature", "J/(kg*K^2)", "4.3 J/(kg*K^2)")
KELVIN_PER_PRESSURE = Dimension("a temperature over a pressure", "K/Pa", "-2348.8 K/GPa")
KELVIN2_PER_PRESSURE = Dimension("a squared temperature over a pressure", "K^2/Pa", "403871.5 K^2/GPa")
TIME = Dimension("a time", "s", "50 ms")
FREQUENCY = Dimension("a frequency", "1/s", "40 Hz")
THERMAL_EXPANSION = Dimension("a thermal expansion", "1/K", "12.5e-6 1/K")
HEAT_CAPACITY = Dimension("a specific heat capacity", "J/(kg*K)", "460 J/(kg*K)")
HEAT_CONDUCTANCE = Dimension("a heat conductance", "W/K", "2.5 W/K")
BODY_HEAT_CAPACITY = Dimension("a heat capacity", "J/K", "120 J/K")
AREA = Dimension("an area", "m^2", "0.02 m^2")
MASS = Dimension("a mass", "kg", "4 kg")
ACCELERATION = Dimension("an acceleration", "m/s^2", "9.81 m/s^2")
TILT_STIFFNESS = Dimension("a stiffness against tilting", "N*m/rad", "200 kN*m/rad")
TANGENTIAL_COMPLIANCE = Dimension("a tangential compliance", "m/Pa", "1e-15 m/Pa")
DAMPING = Dimension("a damping constant", "N*s/m", "1000 N*s/m")
CONTACT_DAMPING = Dimension("a damping over a load", "s/m", "0.05 s/m")


_BY_UNIT = {
    dimension.si.replace("*", " "): dimension
    for dimension in (
        *(LENGTH, ANGLE, SPEED, SURFACE_SPEED, FORCE, LINE_LOAD, MOMENT, PRESSURE, INVERSE_PRESSURE, TEMPERATURE, FLOW),
        *(DENSITY, VISCOSITY, KINEMATIC_VISCOSITY, CONDUCTIVITY, CONDUCTIVITY_SLOPE, KELVIN_PER_PRESSURE),
        *(KELVIN2_PER_PRESSURE, TIME, FREQUENCY, TANGENTIAL_COMPLIANCE, LINE_CONTACT_STIFFNESS, THERMAL_EXPANSION),
        *(HEAT_CAPACITY, HEAT_CAPACITY_SLOPE, HEAT_CONDUCTANCE, BODY_HEAT_CAPACITY, AREA),
        *(MASS, ACCELERATION, TILT_STIFFNESS, DAMPING, CONTACT_DAMPING, FOUNDATION),
    )
} | {"kg/(m^3 K)": DENSITY_SLOPE}


def dimension_of_unit(unit: str, difference: bool = False) -> Dimension:
    """The dimension of a field with this SI unit; `difference`: True for a temperature difference."""
    return TEMPERATURE_DIFFERENCE if difference and unit == "K" else _BY_UNIT[unit]


@functools.cache
def registry() -> Any:
    """The unit registry of pint, made at first use (0.5 s on an idle machine)."""
    import pint

    return pint.UnitRegistry()


def refusal(expected: str, found: str, suggestion: str = "") -> PydanticCustomError:
    """The error of a field, with the texts that `SceneError` shows. As context they may contain braces."""
    return PydanticCustomError(
        "scene", "found {found}, expected {expected}", {"found": found, "expected": expected, "suggestion": suggestion}
    )


@contextmanager
def bare_numbers_are_si() -> Iterator[None]:
    """Context in which a number without a unit is an SI value, for scenes that are made in Python."""
    token = _SI_NUMBERS.set(True)
    try:
        yield
    finally:
        _SI_NUMBERS.reset(token)


def parse(value: object, dimension: Dimension) -> float:
    """SI value of a text with a unit.

    **Raises:** `PydanticCustomError` that says what was found and what is expected, for a bare number, a boolean,
    an unknown unit, a unit of another dimension, or a number that is not finite.
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        if _SI_NUMBERS.get() and is_finite(value):
            return float(value)
        bare = f"the bare number {short(value)}" if is_finite(value) else describe(value)
        raise refusal(dimension.expected(), bare)
    if not isinstance(value, str):
        raise refusal(dimension.expected(), describe(value))
    if _NON_FINITE.match(value):
        raise refusal(dimension.expected(), f"{describe(value)}, which is not finite")
    parted = _NUMBER_AND_UNIT.fullmatch(value)
    if parted is None:
        raise refusal(dimension.expected(), f"{describe(value)}, which does not begin with a number")
    number, unit_text = float(parted[1]), parted[2]
    if not unit_text:
        raise refusal(dimension.expected(), f"{describe(value)}, a number without a unit")
    usual = _usual(number, unit_text, dimension)
    result = _in_si(number, _unit(unit_text, value, dimension), value, dimension) if usual is None else usual
    if not math.isfinite(result):
        raise refusal(dimension.expected(), f"{describe(value)}, which is not finite")
    return result


def _usual(number: float, unit: str, dimension: Dimension) -> float | None:
    """The SI value if the unit is in `usual_units` for this dimension, else `None`."""
    factor, zero = USUAL.get(dimension.si, {}).get(unit, (None, 0.0))
    if factor is None or (zero and not dimension.offset_allowed):
        return None
    return number * factor + zero if zero else number * factor


def _unit(text: str, value: str, dimension: Dimension) -> "pint.Unit":
    actual = f"{describe(value)}, where {shortened(repr(text))} is not a unit"
    if len(text) > _LONGEST_UNIT or not _UNIT.fullmatch(text) or _WORDS.search(text):
        raise refusal(dimension.expected(), actual)
    unit = _read_unit(text)
    if unit is None:
        raise refusal(dimension.expected(), actual)
    return unit


@functools.lru_cache(_REMEMBERED)
def _read_unit(text: str) -> "pint.Unit | None":
    """A unit, or `None`."""
    read = registry().Unit
    try:
        unit = read(text)
        # a factor beyond the range of numbers ("Gm^99") shows here
        _root(unit)
    # pint's reader of units lets many exception types through (tokenizer, arithmetic, attribute errors)
    except Exception:
        return None
    return unit


def _in_si(number: float, unit: "pint.Unit", value: str, dimension: Dimension) -> float:
    target = _read_unit(dimension.si)
    # Root units and not dimensions are compared: an angle has no dimension for pint, which would take "100 Hz" or
    # "10500 1/min" as a speed in rad/s, a factor 2 pi from what was meant.
    if _root(unit) != _root(target):
        hint = "; a rotational speed counts turns: 'rpm', 'rad/s'" if _is_frequency(unit, dimension) else ""
        raise refusal(dimension.expected() + hint, f"{describe(value)}, whose unit is of another kind")
    quantity = registry().Quantity(number, unit)
    if dimension.offset_allowed and "delta_" in str(unit):
        raise refusal(dimension.expected(), f"{describe(value)}, a difference of temperatures")
    if not dimension.offset_allowed and not _is_proportional(unit):
        raise refusal(dimension.expected(), f"{describe(value)}, a temperature on a scale with its own zero")
    return float(quantity.to(target).magnitude)


@functools.lru_cache(_REMEMBERED)
def _root(unit: "pint.Unit") -> Any:
    return registry().Quantity(1.0, unit).to_root_units().units


def _is_frequency(unit: "pint.Unit", dimension: Dimension) -> bool:
    return dimension is SPEED and _root(unit) == registry().Unit("1/s")


@functools.lru_cache(_REMEMBERED)
def _is_proportional(unit: "pint.Unit") -> bool:
    zero = registry().Quantity(0.0, unit).to_root_units().magnitude
    return zero == 0.0


def quantity(text: object, dimension: Dimension, bound: str = "finite") -> float:
    """SI value of a text with a unit, within a bound of `numerics.ranges.RANGES`. **Raises:** as `parse`."""
    value = parse(text, dimension)
    if not RANGES[bound].holds(value):
        raise refusal(dimension.expected(bound), describe(text))
    return value


@dataclass(frozen=True, slots=True)
class QuantityValidator(BeforeValidator):
    """Validator of a field with a unit; it stores the dimension for the writers of files."""

    dimension: Dimension | None = None


def _quantity(dimension: Dimension, bound: str = "finite") -> QuantityValidator:
    return QuantityValidator(lambda value: quantity(value, dimension, bound), dimension=dimension)


def several(raw: object, read: Callable[[Any], float], expected: str) -> tuple[float, ...]:
    """One value or a list of values, each read by `read`. **Arguments:** `expected`: expected content, for messages."""
    values = raw if isinstance(raw, list) else [raw]
    if not values:
        raise refusal(expected, "an empty list")
    return tuple(_item(value, i, len(values), read, expected) for i, value in enumerate(values))


def _item(value: object, index: int, count: int, read: Callable[[Any], float], expected: str) -> float:
    try:
        return read(value)
    except PydanticCustomError as error:
        context = error.context or {}
        place = f" (value {index + 1} of {count})" if count > 1 else ""
        raise refusal(expected, f"{context['found']}{place}", context["suggestion"]) from None


def several_note(bound: str, unit: str = "1") -> BeforeValidator:
    """Validator of a number or a list of numbers; arguments as for `number_note`."""
    if unit == "1":
        words = "" if bound == "finite" else f" {bound}"
        expected, read = f"a number{words}, or a list of them", lambda value: number(value, bound)
    else:
        dimension = dimension_of_unit(unit)
        expected = f"{dimension.expected(bound)}, or a list of such texts"
        read = lambda value: quantity(value, dimension, bound)
        return QuantityValidator(lambda raw: several(raw, read, expected), dimension=dimension)
    return BeforeValidator(lambda raw: several(raw, read, expected))


def _switch(value: object) -> bool:
    if not isinstance(value, bool):
        raise refusal("true or false, without quotes", describe(value))
    return value


def number(value: Any, bound: str = "finite") -> float:
    """A finite number without a unit, within a bound of `numerics.ranges.RANGES`."""
    good = isinstance(value, int | float) and not isinstance(value, bool) and is_finite(value)
    if not good or not RANGES[bound].holds(float(value)):
        words = "" if bound == "finite" else f" {bound}"
        raise refusal(f"a number{words} without a unit and without quotes", describe(value))
    return float(value)


LARGEST_COUNT = 1_000_000
"""Largest count in a scene; a larger count would only exhaust the memory."""


def _count_up_to(least: int | None, most: int | None) -> Callable[[Any], int]:
    low, high = 1 if least is None else least, LARGEST_COUNT if most is None else most

    def read(value: object) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise refusal(f"a whole number >= {low} and <= {high}, without quotes", describe(value))
        return value

    return read


def count_note(least: int | None = None, most: int | None = None) -> BeforeValidator:
    """Validator of a whole number from `least` (default 1) to `most` (default `LARGEST_COUNT`)."""
    return BeforeValidator(_count_up_to(least, most))


def number_note(bound: str, unit: str = "1", difference: bool = False) -> BeforeValidator:
    """Validator of a number.

    **Arguments:**
    - `bound`: one of `numerics.ranges.RANGES`.
    - `unit`: SI unit as in the classes of the library; "1" for a number without a unit.
    - `difference`: True if a number in K is a temperature difference.
    """
    if unit == "1":
        return BeforeValidator(lambda value: number(value, bound))
    return _quantity(dimension_of_unit(unit, difference), bound)


def among_note(numbers: Iterable[float]) -> BeforeValidator:
    """Validator of a number that must be one of `numbers`."""
    known = tuple(numbers)

    def read(value: object) -> float:
        parsed = number(value)
        if parsed not in known:
            words = ", ".join(f"{choice:g}" for choice in known)
            raise refusal(f"one of {words}, without quotes", describe(value))
        return parsed

    return BeforeValidator(read)


def _text(value: object) -> str:
    """A text, which may look like a number: the designation 6205 may have quotes or not."""
    if isinstance(value, bool) or not isinstance(value, str | int) or not str(value).strip():
        raise refusal("text, e.g. '6205-2RSH'", describe(value))
    return str(value).strip()


# types of fields that no class has
Text = Annotated[str, BeforeValidator(_text)]
Count = Annotated[int, count_note()]
Switch = Annotated[bool, BeforeValidator(_switch)]
PositiveNumber = Annotated[float, number_note("> 0")]
NonNegativeNumber = Annotated[float, number_note(">= 0")]
Number = Annotated[float, number_note("finite")]
Fraction = Annotated[float, number_note("between 0 and 1")]
Numbers = Annotated[tuple[float, ...], several_note("finite")]
Times = Annotated[tuple[float, ...], several_note(">= 0", "s")]
