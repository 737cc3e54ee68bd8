"""Line contact: Hertz and Palmgren against check values, hard cases, gradients, shapes."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jaxbearing.contacts import LineContact

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "line_contact.toml").read_text())
CONTACT = LineContact(0.006, 0.012, 2.2747252747e11)


def test_check_values():
    row = PUBLISHED["hertz"][0]
    contact = LineContact(row["reduced_radius"], row["length"], row["youngs_modulus"] / (1 - row["poisson_ratio"] ** 2))
    for name in ("half_width", "hertz_pressure", "palmgren_approach"):
        np.testing.assert_allclose(getattr(contact, name)(row["load"]), row[name], rtol=row["rtol"])


def test_palmgren_in_millimetres():
    row = PUBLISHED["palmgren"][0]
    contact = LineContact(0.006, 1e-3, row["youngs_modulus"] / 0.91)
    np.testing.assert_allclose(1e3 * contact.palmgren_approach(1.0), row["factor"], rtol=row["rtol"])


def test_pressure_carries_the_load():
    load = jnp.asarray([1.0, 1e3, 1e5])
    carried = 0.5 * np.pi * CONTACT.hertz_pressure(load) * CONTACT.half_width(load) * CONTACT.length
    np.testing.assert_allclose(carried, load, rtol=1e-13)
    carried = 2 * CONTACT.mean_pressure(load) * CONTACT.half_width(load) * CONTACT.length
    np.testing.assert_allclose(carried, load, rtol=1e-13)


@settings(deadline=None, derandomize=True, max_examples=30)
@given(st.floats(1.0, 1e6))
def test_palmgren_inverse(load):
    # the linear part below 1e-6 N costs 5e-14 at 1 N
    np.testing.assert_allclose(CONTACT.palmgren_load(CONTACT.palmgren_approach(load)), load, rtol=1e-12)


def test_palmgren_plain_formula():
    load = np.logspace(-2, 6, 9)
    plain = 0.39 * (2 * 4 * 0.91 / 207e9) ** 0.9 * load**0.9 / 0.012**0.8
    # at 0.01 N: 0.05 (1e-6/0.01)^2 = 5e-10; E' has eleven digits
    np.testing.assert_allclose(CONTACT.palmgren_approach(load), plain, rtol=1e-9)
    np.testing.assert_allclose(CONTACT.palmgren_load(plain), load, rtol=1e-9)


QUANTITIES = ["half_width", "hertz_pressure", "mean_pressure", "palmgren_approach"]
VALUES_AND_SLOPES = {
    name: jax.jit(jax.value_and_grad(lambda contact, load, name=name: getattr(contact, name)(load), argnums=(0, 1)))
    for name in QUANTITIES
}


@pytest.mark.parametrize("name", QUANTITIES)
@pytest.mark.parametrize("load", [0.0, -1.0, -1e9, 1e-300, 1e-9, 1e-3, 1e9])
def test_hard_loads_value_and_gradient(name, load):
    value, gradient = VALUES_AND_SLOPES[name](CONTACT, load)
    assert np.isfinite(value)
    assert all(np.isfinite(leaf) for leaf in jax.tree.leaves(gradient))


@pytest.mark.parametrize("approach", [0.0, -1.0, -1e-9, 1e-300, 1e-12, 1.0])
def test_hard_approaches_value_and_gradient(approach):
    value, slope = jax.value_and_grad(CONTACT.palmgren_load)(approach)
    assert jnp.isfinite(value)
    assert jnp.isfinite(slope)
    assert value >= 0
    if approach <= 0:
        assert value == 0
        assert slope == 0


def test_no_load_no_approach():
    assert CONTACT.palmgren_approach(0.0) == 0
    assert CONTACT.palmgren_approach(-5.0) == 0


@pytest.mark.parametrize("name", ["half_width", "hertz_pressure", "palmgren_approach"])
def test_gradient(name):
    function = getattr(CONTACT, name)
    central = (function(500.05) - function(499.95)) / 0.1
    np.testing.assert_allclose(jax.grad(function)(500.0), central, rtol=1e-7)


def test_two_races_of_n_rollers():
    contact = LineContact(jnp.asarray([[0.005], [0.0065]]), 0.0124, 2.3e11)
    load = jnp.linspace(1.0, 5000.0, 14).reshape(2, 7)
    assert contact.half_width(load).shape == contact.palmgren_load(load * 1e-9).shape == (2, 7)
    assert contact.palmgren_approach(jnp.asarray(100.0)).shape == ()  # independent of the radius
    assert contact.half_width(100.0).shape == (2, 1)


def test_eager_is_jit_is_vmap():
    load = jnp.linspace(0.0, 5000.0, 20_001)
    for name in ("half_width", "palmgren_approach"):
        function = getattr(CONTACT, name)
        eager = function(load)
        np.testing.assert_allclose(jax.jit(function)(load), eager, rtol=1e-13)
        np.testing.assert_allclose(jax.vmap(function)(load), eager, rtol=1e-13)
