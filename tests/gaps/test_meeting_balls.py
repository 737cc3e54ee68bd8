"""Friction of the film between two balls that meet: a parabolic gap cut where it is as wide as their radius."""

import numpy as np
import pytest
from scipy.integrate import quad

from jaxbearing.gaps.meeting_balls import MeetingBalls

BALL, VISCOSITY = 10e-3, 5e-3
LAW = MeetingBalls(BALL, 2e10)


def friction(gap):
    return float(LAW.contact(gap, 0.0, 0.0, VISCOSITY).friction)


@pytest.mark.parametrize("part", [1e-3, 1e-2, 0.1])
def test_friction_of_a_parabolic_gap(part):
    """Stress mu u/gap over a disc that ends where the gap is as wide as the radius of the balls."""
    found = LAW.contact(part * BALL, 0.0, 0.0, VISCOSITY)
    film = float(found.film)
    end = np.sqrt(BALL * (BALL - film))
    exact = VISCOSITY * quad(lambda r: 2.0 * np.pi * r / (film + r**2 / BALL), 0.0, end, epsrel=1e-12)[0]
    np.testing.assert_allclose(float(found.friction), exact, rtol=1e-8)


def test_no_film_reaches_to_a_ball_far_away():
    """At seven radii a millionth of a hundredth of the friction at a hundredth of a radius."""
    assert friction(7.0 * BALL) < 1e-8 * friction(1e-2 * BALL)
