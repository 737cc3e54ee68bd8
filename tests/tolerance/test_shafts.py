"""Tolerances of a shaft on several bearings: results are found by the names of bearings and sets."""

import numpy as np
import pytest
from shaft_cases import P, pair

import jaxbearing as jb
from jaxbearing.shafts import LinearBearing, MatchedSet, MountedBearing, PointLoad, Section, Shaft, ShaftSystem
from jaxbearing.tolerance.usual import usual_tolerances

STIFFNESS = np.diag([1e8, 1e8, 1e8, 1e4, 1e4])
RESULT = "bearings.A.1.on_shaft[1]"


def linear_shaft():
    """A beam on two linear bearings, the first with a dot in its name as those of sets have."""
    return ShaftSystem(
        Shaft(100.0, [Section(0.2, 0.03)]),
        bearings=[
            MountedBearing("A.1", LinearBearing(STIFFNESS), 0.02),
            MountedBearing("B", LinearBearing(STIFFNESS), 0.18),
        ],
        forces=[PointLoad("load", 0.06, radial=1000.0)],
    )


def test_scatter_of_a_reaction():
    """By the position of the load, 1 mm: nearly what statics say of a beam on two supports; and in samples."""
    over = {"force.load.position": {"mean": 0.06, "deviation": 1e-3}}
    found = jb.tolerances(linear_shaft(), over, results=[RESULT, "torque.drive"], samples=64)
    one = found[RESULT]
    assert (one.unit, one.description.partition(",")[0]) == ("N", "force of the bearing on the shaft at its position")
    assert one.description.endswith(", radial")
    # the supports also resist tilting, which statics of a beam on two points leave out
    np.testing.assert_allclose(one.deviation, 1000.0 / 0.16 * 1e-3, rtol=0.1)
    np.testing.assert_allclose(one.sampled.mean, one.mean, atol=4.0 * one.deviation / 8.0)
    # 64 samples tell a deviation to 9 %; three of these errors
    np.testing.assert_allclose(one.sampled.deviation, one.deviation, rtol=0.3)


def test_results_that_a_shaft_does_not_have():
    over = {"force.load.position": {"mean": 0.06, "deviation": 1e-3}}
    with pytest.raises(ValueError, match=r"did you mean 'bearings\.B\.on_shaft'"):
        jb.tolerances(linear_shaft(), over, results=["bearings.B.on_shft[1]"])
    with pytest.raises(ValueError, match="5 numbers; expected one of them"):
        jb.tolerances(linear_shaft(), over, results=["bearings.B.on_shaft"])


def test_usual_tolerances_of_different_bearings_of_a_set():
    other = P.replace({"geometry.ball_diameter": 6e-3})
    mixed = pair(scene=P)
    mixed = ShaftSystem(mixed.shaft, sets=[MatchedSet("set", "<>", (P, other), 0.0, 0.016)])
    found = usual_tolerances(mixed)
    assert found["set.set.bearing.2.geometry.ball_diameter"].size == 5e-6
    assert not any(path.startswith("set.set.geometry") for path in found)
