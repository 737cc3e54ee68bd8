"""Values within an implicit step: degree five where the motion is smooth, the cubic after a transient."""

import diffrax as dfx
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.numerics.stage_predictors import stage_places
from jaxbearing.numerics.two_step_interpolation import TwoStepInterpolation, bend_and_tilt

PLACES = stage_places(dfx.Kvaerno5.tableau)
WEIGHTS = jnp.asarray(dfx.Kvaerno5.tableau.b_sol)
"""Quadrature of order five: exact for the rates of a polynomial of degree five."""


def within(motion, rate, length, before, place, past=None):
    """The interpolated motion at a place of the step from 0 to `length`, and a and b."""
    start, end = motion(0.0), motion(length)
    rates = jnp.asarray([rate(c * length) for c in PLACES])
    past = jnp.asarray([rate((c - 1.0) * before) for c in PLACES]) if past is None else past
    found = bend_and_tilt(start, end, rates, jnp.asarray(length), past, jnp.asarray(before), PLACES, WEIGHTS)
    step = TwoStepInterpolation(t0=0.0, t1=length, y0=start, y1=end, k=length * rates, bend=found[0], tilt=found[1])
    return step.evaluate(place * length), found


@pytest.mark.parametrize("before", [0.5, 1.0, 2.5])
def test_polynomials_of_degree_five_are_exact(before):
    polynomial = np.polynomial.Polynomial([0.3, -1.0, 2.0, 0.7, -0.4, 0.9])
    motion, rate = (lambda t: jnp.atleast_1d(polynomial(t))), (lambda t: jnp.atleast_1d(polynomial.deriv()(t)))
    for place in (0.0, 0.3, 0.7, 1.0):
        value, _ = within(motion, rate, 0.8, before, place)
        np.testing.assert_allclose(value, motion(0.8 * place), rtol=1e-12)


@pytest.mark.parametrize("before", [0.0, 0.05, 9.0])
def test_cubic_without_a_step_before_or_with_one_of_another_size(before):
    motion, rate = (lambda t: jnp.atleast_1d(jnp.sin(t))), (lambda t: jnp.atleast_1d(jnp.cos(t)))
    _, found = within(motion, rate, 0.8, before, 0.5)
    np.testing.assert_array_equal(found, 0.0)


def test_cubic_after_a_transient():
    """A component whose step before began far from its slow motion has the cubic; its neighbour has degree five."""
    motion = lambda t: jnp.asarray([jnp.sin(t), jnp.sin(t)])
    rate = lambda t: jnp.asarray([jnp.cos(t), jnp.cos(t)])
    past = jnp.asarray([rate((c - 1.0) * 0.2) for c in PLACES]).at[0, 0].set(1e3)
    value, found = within(motion, rate, 0.2, 0.2, 0.5, past)
    assert float(found[0][0]) == 0.0
    assert float(found[0][1]) != 0.0
    errors = np.abs(value - motion(0.1))
    assert errors[0] < 1e-5
    assert errors[1] < 0.01 * errors[0]
