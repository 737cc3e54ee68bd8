"""Values within an implicit step: degree five where the motion is smooth, the cubic after a transient."""

import diffrax as dfx
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.numerics.implicit_interpolation import ImplicitInterpolation, chosen_bends, stage_bends, two_step_bends
from jaxbearing.numerics.stage_predictors import stage_places

METHODS = {"kvaerno3": dfx.Kvaerno3, "kvaerno4": dfx.Kvaerno4, "kvaerno5": dfx.Kvaerno5}
PLACES = stage_places(dfx.Kvaerno5.tableau)
WEIGHTS = jnp.asarray(dfx.Kvaerno5.tableau.b_sol)
"""Quadrature of order five: exact for the rates of a polynomial of degree five."""


def at(place, motion, length, bends):
    """The interpolated motion at a place of the step from 0 to `length`."""
    step = ImplicitInterpolation(t0=0.0, t1=length, y0=motion(0.0), y1=motion(length), k=None, bends=bends)
    return step.evaluate(place * length)


def bends_of(motion, rate, length, before, past=None):
    rates = jnp.asarray([rate(c * length) for c in PLACES])
    past = jnp.asarray([rate((c - 1.0) * before) for c in PLACES]) if past is None else past
    return two_step_bends(
        motion(0.0), motion(length), rates, jnp.asarray(length), past, jnp.asarray(before), PLACES, WEIGHTS
    )


@pytest.mark.parametrize("before", [0.5, 1.0, 2.5])
def test_polynomials_of_degree_five_are_exact(before):
    polynomial = np.polynomial.Polynomial([0.3, -1.0, 2.0, 0.7, -0.4, 0.9])
    motion, rate = (lambda t: jnp.atleast_1d(polynomial(t))), (lambda t: jnp.atleast_1d(polynomial.deriv()(t)))
    bends = bends_of(motion, rate, 0.8, before)
    for place in (0.0, 0.3, 0.7, 1.0):
        np.testing.assert_allclose(at(place, motion, 0.8, bends), motion(0.8 * place), rtol=1e-12)


@pytest.mark.parametrize("before", [0.0, 0.05, 9.0])
def test_cubic_without_a_step_before_or_with_one_of_another_size(before):
    motion, rate = (lambda t: jnp.atleast_1d(jnp.sin(t))), (lambda t: jnp.atleast_1d(jnp.cos(t)))
    bends = bends_of(motion, rate, 0.8, before)
    np.testing.assert_array_equal(bends[2:], 0.0)
    assert abs(float(at(0.5, motion, 0.8, bends)[0]) - np.sin(0.4)) < 0.8**4 / 384.0


def test_cubic_after_a_transient():
    """A component whose step before began far from its slow motion has the cubic; its neighbour has degree five."""
    motion = lambda t: jnp.asarray([jnp.sin(t), jnp.sin(t)])
    rate = lambda t: jnp.asarray([jnp.cos(t), jnp.cos(t)])
    past = jnp.asarray([rate((c - 1.0) * 0.2) for c in PLACES]).at[0, 0].set(1e3)
    bends = bends_of(motion, rate, 0.2, 0.2, past)
    assert float(bends[3][0]) == 0.0
    assert float(bends[3][1]) != 0.0
    errors = np.abs(at(0.5, motion, 0.2, bends) - motion(0.1))
    assert errors[0] < 1e-5
    assert errors[1] < 0.01 * errors[0]


@pytest.mark.parametrize("name", METHODS)
def test_stiff_components_go_through_the_values_of_the_stages(name):
    places = stage_places(METHODS[name].tableau)
    inner = sum(0.0 < c < 1.0 for c in places)
    polynomial = np.polynomial.Polynomial([0.3, -1.0, 2.0, 0.7, -0.4][: inner + 2])
    motion = lambda t: jnp.full(2, polynomial(t))
    values = jnp.asarray([motion(0.8 * c) for c in places])
    stiff = stage_bends(motion(0.0), motion(0.8), values, places)
    bends = chosen_bends(jnp.ones((4, 2)), stiff, jnp.asarray([-1e4, -0.1]))
    for place in (0.0, 0.3, 0.7, 1.0):
        found = at(place, motion, 0.8, bends)
        np.testing.assert_allclose(found[0], polynomial(0.8 * place), rtol=1e-12)
    np.testing.assert_array_equal(bends[:, 1], 1.0)
