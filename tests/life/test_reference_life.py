"""Reference life: check values of the specification, consistency with ISO 281, no load, gradients."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.life.capacity import ball_capacity, roller_capacity
from jaxbearing.life.reference import (
    ball_contact_capacities,
    ball_damage_rate,
    edge_factors,
    roller_contact_capacities,
    roller_damage_rate,
)

YES, NO = jnp.asarray(True), jnp.asarray(False)
CUP = np.radians(14.036)
G1 = (17, 7.6149648e-3, 45.4708581e-3)


def distribution(n, power, total):
    """Loads without clearance, cos^power, scaled to the radial load."""
    azimuth = 2.0 * np.pi * np.arange(n) / n
    share = np.maximum(np.cos(azimuth), 0.0) ** power
    return share * total / np.sum(share * np.cos(azimuth))


def test_check_value_6205():
    sizes = (9, 7.94e-3, 39.04e-3, 0.0)
    capacity = ball_capacity(*sizes)
    limits = ball_contact_capacities(capacity, *sizes, 0.52, 0.52)
    np.testing.assert_allclose(limits.inner, 3950.98000, rtol=1e-8)
    np.testing.assert_allclose(limits.outer, 8049.92163, rtol=1e-8)
    load = jnp.asarray(distribution(9, 1.5, 2000.0))
    np.testing.assert_allclose(1.0 / ball_damage_rate(load, load, limits, YES, NO), 341.178450, rtol=1e-8)
    np.testing.assert_allclose((capacity / 2000.0) ** 3, 345.377434, rtol=1e-8)


def test_a_million_revolutions_at_the_rating():
    sizes = (2000, 7.94e-3, 39.04, 0.0)  # many balls on a large circle
    limits = ball_contact_capacities(1e6, *sizes, 0.52, 0.52)
    load = jnp.asarray(distribution(2000, 1.5, 1e6))
    np.testing.assert_allclose(ball_damage_rate(load, load, limits, YES, NO), 1.0, rtol=2e-3)


@pytest.mark.parametrize(
    ("total", "slope", "with_edges", "without"),
    [(10e3, 0.0, 167.819765, 581.577482), (20e3, 0.6, 7.05147042, 30.0233663)],
)
def test_check_values_of_laminae(total, slope, with_edges, without):
    capacity = roller_capacity(*G1, 9.6e-3, CUP)
    limits = roller_contact_capacities(capacity, *G1, CUP)
    np.testing.assert_allclose(limits.inner, 8193.71616, rtol=1e-7)
    np.testing.assert_allclose(limits.outer, 12653.0842, rtol=1e-7)
    load = distribution(17, 10.0 / 9.0, total) / np.cos(CUP)
    share = (1.0 + slope * ((np.arange(1, 31) - 0.5) / 30 - 0.5)) / 30
    laminae = jnp.asarray(load[:, None] * share)
    for factors, expected in ((edge_factors(30), with_edges), (np.ones(30), without)):
        found = 1.0 / roller_damage_rate(laminae, laminae, limits, YES, NO, factors)
        np.testing.assert_allclose(found, expected, rtol=1e-7)


def test_edge_factors():
    """ISO 16281 as publicly transcribed: the ends have 1 - 0.01/ln(1.985/2), whatever the number of laminae."""
    factors = edge_factors(30)
    np.testing.assert_allclose(factors[[0, 1, 2, 14]], [2.32832706, 1.12660274, 1.06412383, 1.00296312], rtol=5e-9)
    for count in (2, 3, 30, 31, 50, 200):
        found = edge_factors(count)
        np.testing.assert_allclose(found[[0, -1]], 2.32832706, rtol=5e-9)
        np.testing.assert_allclose(found, found[::-1], rtol=1e-15)
        assert np.all(np.diff(found[: count // 2]) < 0)  # less towards the middle
    assert edge_factors(31)[15] == 1.0
    np.testing.assert_array_equal(edge_factors(1), 1.0)


def test_which_ring_turns():
    """A ring that turns shares its damage over the circle: a point at rest under the load fares worse."""
    sizes = (9, 7.94e-3, 39.04e-3, 0.0)
    limits = ball_contact_capacities(14e3, *sizes, 0.52, 0.52)
    load = jnp.asarray(distribution(9, 1.5, 2000.0))
    rates = [float(ball_damage_rate(load, load, limits, i, o)) for i, o in ((YES, NO), (NO, YES), (YES, YES))]
    assert rates[2] < rates[0] < rates[1]
    even = jnp.full(9, 300.0)
    rates = [float(ball_damage_rate(even, even, limits, i, o)) for i, o in ((YES, NO), (NO, YES), (YES, YES))]
    np.testing.assert_allclose(rates, rates[0], rtol=1e-13)


@pytest.mark.parametrize("scale", [0.0, 1e-6, 1.0, 1e6])
@pytest.mark.parametrize("turns", [(YES, NO), (NO, YES)])
def test_rates_have_finite_gradients(scale, turns):
    sizes = (9, 7.94e-3, 39.04e-3, 0.0)
    limits = ball_contact_capacities(14e3, *sizes, 0.52, 0.52)
    load = jnp.asarray(distribution(9, 1.5, 1.0)) * scale
    value, slope = jax.value_and_grad(lambda q: ball_damage_rate(q, q, limits, *turns))(load)
    assert np.isfinite(value)
    assert np.all(np.isfinite(slope))
    assert (value == 0.0) == (scale == 0.0)
    limits = roller_contact_capacities(40e3, *G1, CUP)
    laminae = jnp.broadcast_to(load[:, None] / 30.0, (9, 30))
    value, slope = jax.value_and_grad(lambda q: roller_damage_rate(q, q, limits, *turns, edge_factors(30)))(laminae)
    assert np.isfinite(value)
    assert np.all(np.isfinite(slope))
    assert (value == 0.0) == (scale == 0.0)


def test_loads_that_were_not_found_have_no_life():
    """A NaN of a solve that failed must not end as no damage, which is an endless life."""
    missing = jnp.full(3, jnp.nan)
    balls = ball_contact_capacities(14e3, 9, 7.94e-3, 39.04e-3, 0.0, 0.52, 0.52)
    assert bool(jnp.isnan(ball_damage_rate(missing, missing, balls, YES, NO)))
