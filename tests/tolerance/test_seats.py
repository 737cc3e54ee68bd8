"""What a seat presses whose interference scatters, against integration and against a million samples."""

import jax.numpy as jnp
import numpy as np
import pytest
from scipy import integrate
from scipy.stats import norm

from jaxbearing.mounting import Fits
from jaxbearing.tolerance.seats import Seat, seat_of

UM = 1e-6
BENDS = {
    "given smoothing": ((1.0, 2.0),),
    "held by temperatures": ((1.0, -6.5), (-1.0, 0.0), (1.0, 2.0)),
}


def pressing(bends, interference):
    return sum(slope * np.maximum(interference - bend, 0.0) for slope, bend in bends)


@pytest.mark.parametrize("mean", [-20.0, -3.0, 1.0, 9.5, 40.0])
@pytest.mark.parametrize("bends", BENDS.values(), ids=BENDS)
def test_moments_against_integration(bends, mean):
    deviation = 5.4
    seat = Seat("housing", mean, deviation, bends)
    ends = sorted({mean - 12 * deviation, mean + 12 * deviation, *(bend for _, bend in bends)})

    def integral(what):
        parts = (
            integrate.quad(lambda x: what(x) * norm.pdf(x, mean, deviation), *ends[i : i + 2], epsabs=1e-13)[0]
            for i in range(len(ends) - 1)
        )
        return sum(parts)

    expected = integral(lambda x: pressing(bends, x))
    square = integral(lambda x: pressing(bends, x) ** 2)
    covariance = integral(lambda x: pressing(bends, x) * (x - mean))
    np.testing.assert_allclose(seat.moments(), (expected, square - expected**2), rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(seat.gain, covariance / deviation**2, rtol=1e-8, atol=1e-9)
    loose = norm.cdf((bends[0][1] - mean) / deviation)
    np.testing.assert_allclose(seat.loose_share, loose, rtol=1e-10)


def test_a_tight_seat_follows_its_interference():
    seat = Seat("shaft", 100.0, 1.0, ((1.0, 2.0),))
    assert not seat.bends_within
    assert (seat.slope, seat.gain, seat.tight) == (1.0, 1.0, 100.0)
    np.testing.assert_allclose(seat.moments(), (98.0, 1.0), rtol=1e-10)


def test_nothing_that_scatters():
    seat = Seat("shaft", 9.0, 0.0, ((1.0, 2.0),))
    assert seat.moments() == (7.0, 0.0)
    assert (seat.gain, seat.loose_share, seat.bends_within) == (1.0, 0.0, False)


@pytest.mark.parametrize("smoothing", [None, 1e-6])
@pytest.mark.parametrize("held", [-1.5, 0.0, 6.5])
def test_bends_are_those_of_the_fit(smoothing, held):
    """`held`: interference by temperatures and speed, um."""
    fits = Fits(shaft_interference=0.0, smoothing=smoothing)
    running = lambda interference: interference - float(fits.smoothed(jnp.asarray(interference))) + held * UM
    for given in np.linspace(-12.0, 12.0, 49) * UM:
        seat = seat_of(fits, "shaft", given, running(given), 1e-6)
        np.testing.assert_allclose(seat.pressing, max(running(given), 0.0), atol=1e-18)
        step = 1e-4 * UM
        rising = (max(running(given + step), 0.0) - max(running(given), 0.0)) / step
        np.testing.assert_allclose(seat.slope, rising, atol=1e-6)
        # where it is tight it presses as much and has the slope 1
        np.testing.assert_allclose(max(running(seat.tight), 0.0), seat.pressing, atol=1.01e-12)
        np.testing.assert_allclose((max(running(seat.tight + step), 0.0) - max(running(seat.tight), 0.0)) / step, 1.0)
