"""Palmgren and Miner: lives under several states, in closed form."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.life import mean_load, miner_rate, revolution_shares, spectrum_life
from jaxbearing.life.result import Life


def life_at(load, capacity=20e3, exponent=3.0, factor=None):
    """Life of a ball bearing by ISO 281 alone."""
    rate = (jnp.asarray(load) / capacity) ** exponent
    more = {} if factor is None else {"modification_factor": jnp.asarray(factor)}
    return Life(
        damage_rate=rate,
        L10r=1.0 / rate,
        L10r_hours=1.0 / rate,
        dynamic_capacity=jnp.asarray(capacity),
        static_capacity=jnp.asarray(1e4),
        equivalent_load=jnp.asarray(load),
        catalogue_load=jnp.asarray(load),
        reliability_factor=jnp.asarray(1.0),
        **more,
    )


def test_two_states_by_hand():
    """60 % of the time 2 kN at 1000 rpm, 40 % 4 kN at 500 rpm: 3/4 and 1/4 of the revolutions; 1000 and 125 million."""
    speeds = jnp.array([1000.0, 500.0]) * np.pi / 30.0
    found = spectrum_life([life_at(2e3), life_at(4e3)], jnp.array([0.6, 0.4]), speeds)
    np.testing.assert_allclose(found.revolutions, [0.75, 0.25], rtol=1e-14)
    rate = 0.75 / 1000.0 + 0.25 / 125.0
    np.testing.assert_allclose(found.L10r, 1.0 / rate, rtol=1e-13)
    np.testing.assert_allclose(found.L10, found.L10r, rtol=1e-13)
    np.testing.assert_allclose(found.damage, [0.75e-3 / rate, 2e-3 / rate], rtol=1e-13)
    np.testing.assert_allclose(found.mean_speed, 800.0 * np.pi / 30.0, rtol=1e-14)
    np.testing.assert_allclose(found.L10r_hours, 1e6 / rate / (60.0 * 800.0), rtol=1e-13)
    # hours of each state: its share of the time over its own hours
    hours = [1000e6 / (60.0 * 1000.0), 125e6 / (60.0 * 500.0)]
    np.testing.assert_allclose(found.L10r_hours, 1.0 / (0.6 / hours[0] + 0.4 / hours[1]), rtol=1e-13)
    np.testing.assert_allclose(found.equivalent_load, (0.75 * 2e3**3 + 0.25 * 4e3**3) ** (1.0 / 3.0), rtol=1e-13)
    np.testing.assert_allclose((20e3 / found.equivalent_load) ** 3, found.L10r, rtol=1e-13)
    assert found.Lnmr is found.L10m is None


def test_modified_damage_is_that_of_the_modified_lives():
    lives = [life_at(2e3, factor=4.0), life_at(4e3, factor=0.5)]
    found = spectrum_life(lives, jnp.array([0.5, 0.5]), jnp.array([100.0, -100.0]))
    rates = jnp.array([0.5 / (4.0 * 1000.0), 0.5 / (0.5 * 125.0)])
    np.testing.assert_allclose(found.Lnmr, 1.0 / rates.sum(), rtol=1e-13)
    np.testing.assert_allclose(found.damage, rates / rates.sum(), rtol=1e-13)
    np.testing.assert_allclose(found.reference_damage, jnp.array([1 / 1000, 1 / 125]) / (9 / 1000), rtol=1e-13)
    # a state without a_ISO leaves the spectrum without a modified life
    assert spectrum_life([lives[0], life_at(4e3)], jnp.array([0.5, 0.5]), jnp.ones(2)).Lnmr is None


def test_states_at_rest_and_without_load_do_no_damage():
    lives = [life_at(2e3), life_at(4e3)]
    found = spectrum_life(lives, jnp.array([0.5, 0.5]), jnp.array([100.0, 0.0]))
    np.testing.assert_allclose(found.damage, [1.0, 0.0])
    np.testing.assert_allclose(found.L10r, 1000.0, rtol=1e-13)
    at_rest = spectrum_life(lives, jnp.array([0.5, 0.5]), jnp.zeros(2))
    np.testing.assert_allclose(at_rest.revolutions, [0.5, 0.5])
    assert np.isinf(at_rest.L10r_hours)
    idle = spectrum_life([life_at(0.0)] * 2, jnp.array([0.5, 0.5]), jnp.ones(2))
    assert np.isinf(idle.L10r)
    np.testing.assert_array_equal(idle.damage, [0.0, 0.0])
    np.testing.assert_allclose(idle.equivalent_load, 0.0)


def test_a_failed_state_leaves_no_number():
    found = spectrum_life([life_at(2e3), life_at(jnp.nan)], jnp.array([0.5, 0.5]), jnp.array([1.0, jnp.nan]))
    for name in ("L10r", "L10r_hours", "L10", "equivalent_load", "mean_speed"):
        assert np.isnan(getattr(found, name)), name
    assert np.all(np.isnan(found.damage))
    assert np.all(np.isnan(found.revolutions))


def test_slopes():
    def hours(loads):
        lives = [life_at(load) for load in loads]
        return spectrum_life(lives, jnp.array([0.6, 0.4]), jnp.array([100.0, 50.0])).L10r_hours

    loads = jnp.array([2e3, 4e3])
    slope = jax.grad(hours)(loads)
    step = jnp.array([0.0, 1.0])
    np.testing.assert_allclose(slope[1], (hours(loads + step) - hours(loads - step)) / 2.0, rtol=1e-6)
    assert np.all(np.isfinite(jax.grad(lambda x: mean_load(jnp.array([0.5, 0.5]), x, 3.0))(jnp.array([0.0, 1e3]))))


def test_refusals():
    with pytest.raises(ValueError, match="time_shares must be >= 0"):
        revolution_shares(jnp.array([-0.5, 1.5]), jnp.ones(2))
    with pytest.raises(ValueError, match="rates must be >= 0"):
        miner_rate(jnp.ones(2), jnp.array([-1.0, 1.0]))
