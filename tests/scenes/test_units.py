"""Texts with units."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic_core import PydanticCustomError

from jaxbearing.scenes import units
from jaxbearing.scenes.usual_units import USUAL

DIMENSIONS = [one for one in vars(units).values() if isinstance(one, units.Dimension)]

# (text, dimension, SI value): conversion factors by definition, not from the units library
DEFINITIONS = [
    ("30 um", units.LENGTH, 30e-6),
    ("30 µm", units.LENGTH, 30e-6),
    ("12mm", units.LENGTH, 12e-3),
    ("1 in", units.LENGTH, 0.0254),
    ("2000N", units.FORCE, 2000.0),
    ("2500 daN", units.FORCE, 25000.0),
    ("25 kN", units.FORCE, 25000.0),
    ("10500 rpm", units.SPEED, 10500 * 2 * math.pi / 60),
    ("-1 rad/s", units.SPEED, -1.0),
    ("0.375 deg", units.ANGLE, math.radians(0.375)),
    ("60degC", units.TEMPERATURE, 333.15),
    ("60 degC", units.TEMPERATURE, 333.15),
    ("-40 °C", units.TEMPERATURE, 233.15),
    ("212 degF", units.TEMPERATURE, 373.15),
    ("300 K", units.TEMPERATURE, 300.0),
    ("29.406 K", units.TEMPERATURE_DIFFERENCE, 29.406),
    ("2 delta_degC", units.TEMPERATURE_DIFFERENCE, 2.0),
    ("150 l/h", units.FLOW, 0.15 / 3600),
    ("10.4 1/GPa", units.INVERSE_PRESSURE, 10.4e-9),
    ("203 GPa", units.PRESSURE, 203e9),
    ("1 mm/s", units.SURFACE_SPEED, 1e-3),
    ("4.7 cP", units.VISCOSITY, 4.7e-3),
    ("32 cSt", units.KINEMATIC_VISCOSITY, 32e-6),
    ("32 mm^2/s", units.KINEMATIC_VISCOSITY, 32e-6),
    ("32mm²/s", units.KINEMATIC_VISCOSITY, 32e-6),
    ("0.32 St", units.KINEMATIC_VISCOSITY, 32e-6),
    ("-0.752 kg/m^3/K", units.DENSITY_SLOPE, -0.752),
    ("-14648.747 K^2/GPa", units.KELVIN2_PER_PRESSURE, -14648.747e-9),
    ("  1e-3   m  ", units.LENGTH, 1e-3),
    ("+.5 m", units.LENGTH, 0.5),
    ("7850 kg m**-3", units.DENSITY, 7850.0),
    ("7850 kg/m³", units.DENSITY, 7850.0),
    ("7850 kg·m⁻³", units.DENSITY, 7850.0),
    ("0.147 W / (m K)", units.CONDUCTIVITY, 0.147),
    ("60 N/um^(10/9)", units.LINE_CONTACT_STIFFNESS, 60.0 * 1e6 ** (10 / 9)),
    ("8.06e4 N/mm**(10/9)", units.LINE_CONTACT_STIFFNESS, 8.06e4 * 1e3 ** (10 / 9)),
    ("2 kN / µm^(10/9)", units.LINE_CONTACT_STIFFNESS, 2e3 * 1e6 ** (10 / 9)),
]


@pytest.mark.parametrize(("text", "dimension", "expected"), DEFINITIONS, ids=lambda value: str(value)[:20])
def test_definitions(text, dimension, expected):
    result = units.parse(text, dimension)
    assert type(result) is float
    assert result == pytest.approx(expected, rel=1e-14)


def refusal(value, dimension):
    with pytest.raises(PydanticCustomError) as caught:
        units.parse(value, dimension)
    return caught.value.context


@pytest.mark.parametrize(
    ("value", "dimension", "found"),
    [
        (12, units.LENGTH, "the bare number 12"),
        (12.5, units.LENGTH, "the bare number 12.5"),
        ("12", units.LENGTH, "without a unit"),
        (True, units.LENGTH, "the boolean true"),
        (["12 mm"], units.LENGTH, "an array"),
        ({"value": 1}, units.LENGTH, "a table"),
        ("12 N", units.LENGTH, "another kind"),
        ("12 mmm", units.LENGTH, "'mmm' is not a unit"),
        ("mm", units.LENGTH, "does not begin with a number"),
        ("", units.LENGTH, "does not begin with a number"),
        ("nan m", units.LENGTH, "not finite"),
        ("inf m", units.LENGTH, "not finite"),
        (math.nan, units.LENGTH, "not finite"),
        (math.inf, units.LENGTH, "not finite"),
        (10**400, units.LENGTH, "not finite"),
        ("1e400 m", units.LENGTH, "not finite"),
        ("1,5 mm", units.LENGTH, "',5 mm' is not a unit"),  # pint alone: 15 mm
        ("1 000 m", units.LENGTH, "'000 m' is not a unit"),  # pint alone: 0 m
        ("2*3 m", units.LENGTH, "not a unit"),
        ("12 m/", units.LENGTH, "not a unit"),
        ("12 (m", units.LENGTH, "not a unit"),
        ("5 C", units.TEMPERATURE, "another kind"),  # coulomb
        ("100 Hz", units.SPEED, "another kind"),  # 100/s is not 100 rad/s
        ("10500 1/min", units.SPEED, "another kind"),
        ("0.1 %", units.ANGLE, "not a unit"),
        ("12 m**9**9**9", units.LENGTH, "not a unit"),  # pint alone: hours
        ("12 (m^9)^9", units.LENGTH, "not a unit"),
        ("12 m^999", units.LENGTH, "not a unit"),
        ("12 Gm^99", units.LENGTH, "not a unit"),  # beyond the largest float
        ("12 m^0.5", units.LENGTH, "not a unit"),
        ("12 m^(1/2)", units.LENGTH, "another kind"),
        ("12 m^(2/1)^9", units.LENGTH, "not a unit"),
        ("12 m^(9**9)", units.LENGTH, "not a unit"),
        ("12 m^(1/0)", units.LENGTH, "not a unit"),
        ("60 N/um", units.LINE_CONTACT_STIFFNESS, "another kind"),
        ("12 square m", units.LENGTH, "not a unit"),
        ("142 mm%", units.LENGTH, "not a unit"),
        ("142 mm;", units.LENGTH, "not a unit"),
        ("142 {mm}", units.LENGTH, "not a unit"),
        ("142 [mm]", units.LENGTH, "not a unit"),
        ("1 rpm # comment", units.SPEED, "not a unit"),
        ("1 mm" + "*m/m" * 10, units.LENGTH, "not a unit"),
        ("2 delta_degC", units.TEMPERATURE, "a difference of temperatures"),
        ("2 Δ°C", units.TEMPERATURE, "not a unit"),
        ("29 degC", units.TEMPERATURE_DIFFERENCE, "its own zero"),
    ],
    ids=lambda value: str(value)[:20],
)
def test_refusals_say_what_was_found_and_what_is_expected(value, dimension, found):
    context = refusal(value, dimension)
    assert found in context["found"]
    assert dimension.name in context["expected"]
    assert dimension.example in context["expected"]


def test_frequencies_are_told_from_speeds():
    assert "'rpm'" in refusal("100 Hz", units.SPEED)["expected"].split("turns")[1]


@pytest.mark.parametrize(
    "dimension", [d for d in vars(units).values() if isinstance(d, units.Dimension)], ids=lambda d: d.name
)
def test_every_example_is_valid(dimension):
    assert math.isfinite(units.parse(dimension.example, dimension))


SCALES = {"mm": 1e-3, "um": 1e-6, "m": 1.0, "km": 1e3, "inch": 0.0254}


@settings(deadline=None, derandomize=True)
@given(
    st.floats(-1e12, 1e12, allow_nan=False),
    st.sampled_from(sorted(SCALES)),
    st.sampled_from(["", " ", "  "]),
    st.sampled_from(["{!r}", "{:.17g}", "{:+.17e}"]),
)
def test_round_trip(value, unit, space, number):
    # 4 ulp: one conversion and one product; below 1e-300 the product is subnormal
    result = units.parse(f"{number.format(value)}{space}{unit}", units.LENGTH)
    assert result == pytest.approx(value * SCALES[unit], rel=1e-15, abs=1e-300)


@settings(deadline=None, derandomize=True)
@given(st.floats(-273.0, 5000.0, allow_nan=False))
def test_celsius_round_trip(value):
    assert units.parse(f"{value!r} degC", units.TEMPERATURE) == pytest.approx(value + 273.15, rel=1e-14)


@settings(deadline=None, derandomize=True, max_examples=300)
@given(st.text(max_size=30))
def test_any_text_is_read_or_refused_in_words(text):
    found = ""
    try:
        value = units.parse(text, units.LENGTH)
    except PydanticCustomError as error:
        value, found = 0.0, error.context["found"]
    assert found or math.isfinite(value)


USUAL_TEXTS = [(si, text) for si, texts in USUAL.items() for text in texts]


@pytest.mark.parametrize(("si", "text"), USUAL_TEXTS, ids=lambda value: value)
def test_usual_units_are_those_of_pint(si, text):
    """To the bit: whoever adds a unit to a file, so that pint reads it, changes no number."""
    registry, rng = units.registry(), np.random.default_rng(len(si) + 64 * len(text))
    numbers = [0.0, -0.0, 1.0, *rng.uniform(-300.0, 3000.0, 50), *10.0 ** rng.uniform(-12.0, 12.0, 50)]
    numbers = [float(number) for number in (*numbers, *np.round(numbers, 3))]
    unit, target = registry.Unit(text), registry.Unit(si)
    # "K" of a difference and of a temperature
    for dimension in (one for one in DIMENSIONS if one.si == si):
        if USUAL[si][text][1] and not dimension.offset_allowed:
            continue
        for number in numbers:
            expected = float(registry.Quantity(number, unit).to(target).magnitude)
            found = units.parse(f"{number!r} {text}", dimension)
            assert found.hex() == expected.hex(), dimension.name


def test_every_dimension_has_its_usual_units():
    """Without its SI unit a table would never be looked into."""
    assert set(USUAL) == {one.si for one in DIMENSIONS}
    assert all(texts[si] == (1.0, 0.0) for si, texts in USUAL.items())
