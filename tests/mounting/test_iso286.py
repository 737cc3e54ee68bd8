"""Tolerance classes against the table that was read in a maker's fit tables (`iso286_limits.json`, with its source)."""

import itertools
import json
from pathlib import Path

import jax
import numpy as np
import pytest

from jaxbearing.mounting import hole_limits, iso286, shaft_limits

TABLE = json.loads((Path(__file__).parent / "iso286_limits.json").read_text(encoding="utf-8"))
EDGES = TABLE["edges_mm"]
MIDDLES = [0.5 * (low + high) for low, high in itertools.pairwise(EDGES)]
UM = 1e-6


def limits(found):
    return np.asarray([found.lower, found.upper]) / UM


@pytest.mark.parametrize("place", range(13))
def test_every_range_of_shafts(place):
    size, width = 1e-3 * MIDDLES[place], {int(grade): row[place] for grade, row in TABLE["IT"].items()}
    for grade, wide in width.items():
        for letter, row in TABLE["shaft_es"].items():
            expected = [row[place] - wide, row[place]]
            np.testing.assert_allclose(limits(shaft_limits(f"{letter}{grade}", size)), expected, atol=1e-9)
        for letter, row in TABLE["shaft_ei"].items():
            low = 0 if letter == "k" and grade > 7 else row[place]
            np.testing.assert_allclose(limits(shaft_limits(f"{letter}{grade}", size)), [low, low + wide], atol=1e-9)
        np.testing.assert_allclose(limits(shaft_limits(f"js{grade}", size)), [-wide / 2, wide / 2], atol=1e-9)
    for grade, rows in TABLE["j_shaft"].items():
        expected = rows[place] if rows[place] is not None else [np.nan, np.nan]
        np.testing.assert_allclose(limits(shaft_limits(f"j{grade}", size)), expected[::-1], atol=1e-9)


@pytest.mark.parametrize("place", range(13))
def test_every_range_of_holes(place):
    size, width = 1e-3 * MIDDLES[place], {int(grade): row[place] for grade, row in TABLE["IT"].items()}
    for grade, wide in width.items():
        for letter, row in TABLE["shaft_es"].items():
            expected = [-row[place], wide - row[place]]
            np.testing.assert_allclose(limits(hole_limits(f"{letter.upper()}{grade}", size)), expected, atol=1e-9)
        np.testing.assert_allclose(limits(hole_limits(f"JS{grade}", size)), [-wide / 2, wide / 2], atol=1e-9)
        for letter, row in TABLE["shaft_ei"].items():
            if grade == 4:
                continue
            step = 0 if place == 0 or (letter, grade) == ("p", 8) else wide - width[grade - 1]
            high = -9 if (letter, grade, EDGES[place]) == ("m", 6, 250) else step - row[place]
            expected = [high - wide, high]
            np.testing.assert_allclose(limits(hole_limits(f"{letter.upper()}{grade}", size)), expected, atol=1e-9)
    for grade, rows in TABLE["J_hole"].items():
        expected = rows[place] if rows[place] is not None else [np.nan, np.nan]
        np.testing.assert_allclose(limits(hole_limits(f"J{grade}", size)), expected[::-1], atol=1e-9)


def test_normal_class_of_bearings():
    for name, found in (("bore", iso286.bore_limits), ("outside", iso286.outside_limits)):
        for (low, high), deviation in TABLE[f"{name}_normal_class"]:
            for size in (low + 1e-3, 0.5 * (low + high), high):
                np.testing.assert_allclose(limits(found(1e-3 * size)), [deviation, 0.0], atol=1e-9)


@pytest.mark.parametrize(
    ("tolerance", "diameter", "expected"),
    [
        *(("m5", 25, (17.5, 27, 8)), ("k5", 25, (11.5, 21, 2)), ("j5", 25, (5.5, 15, -4)), ("n6", 80, (37, 54, 20))),
        *(
            ("k6", 120, (24, 45, 3)),
            ("p6", 140, (68, 93, 43)),
            ("H7", 52, (-21.5, 0, -43)),
            ("J7", 52, (-9.5, 12, -31)),
        ),
        *(("M7", 140, (11, 40, -18)), ("P7", 140, (39, 68, 10)), ("K6", 90, (-0.5, 18, -19))),
    ],
)
def test_interferences(tolerance, diameter, expected):
    """Mean, largest and smallest interference, um, of the sheet's table."""
    found = iso286.shaft_interference if tolerance[0].islower() else iso286.housing_interference
    low, high = limits(found(tolerance, 1e-3 * diameter))
    np.testing.assert_allclose([(low + high) / 2, high, low], expected, atol=1e-9)


def test_ends_belong_to_the_lower_range_also_where_they_are_traced():
    for end in EDGES[1:]:
        sizes = np.asarray([end, end * (1 + 1e-9)]) * 1e-3
        at, above = jax.jit(jax.vmap(lambda size: shaft_limits("m6", size).upper))(sizes) / UM
        place = EDGES.index(end) - 1
        np.testing.assert_allclose(at, TABLE["shaft_ei"]["m"][place] + TABLE["IT"]["6"][place], atol=1e-9)
        if end == EDGES[-1]:
            assert np.isnan(above)
        else:
            np.testing.assert_allclose(
                above, TABLE["shaft_ei"]["m"][place + 1] + TABLE["IT"]["6"][place + 1], atol=1e-9
            )


@pytest.mark.parametrize("tolerance", ["k9", "K4", "j7", "J5", "zz6", "K6", "", "5k"])
def test_what_the_tables_lack_is_refused(tolerance):
    wrong = hole_limits if tolerance in ("K4", "J5") else shaft_limits
    with pytest.raises(ValueError, match="tolerance class"):
        wrong(tolerance, 0.05)
