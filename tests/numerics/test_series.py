"""Power series, and cosine and sine by them."""

import jax
import jax.numpy as jnp
import mpmath
import numpy as np
import pytest

from jaxbearing.numerics.series import cosine_and_sine, horner


def test_horner():
    x = jnp.asarray([-2.0, 0.0, 3.0])
    np.testing.assert_allclose(horner((1.0, -2.0, 0.5), x), 1.0 - 2.0 * x + 0.5 * x**2, rtol=1e-15)


@pytest.mark.parametrize("size", [1e-9, 1.0, 10.0, 1e3, 1e6])
def test_cosine_and_sine_against_mpmath(size):
    angle = np.random.default_rng(0).uniform(-size, size, 2000)
    cosine, sine = (np.asarray(values) for values in cosine_and_sine(angle))
    with mpmath.workdps(30):
        exact = [(float(mpmath.cos(a)), float(mpmath.sin(a))) for a in map(mpmath.mpf, angle)]
    np.testing.assert_allclose(np.stack([cosine, sine], axis=1), exact, rtol=0.0, atol=2.3e-16)
    np.testing.assert_allclose(sine[np.abs(angle) < 0.5], np.sin(angle[np.abs(angle) < 0.5]), rtol=1e-15)
    assert np.all(np.abs(cosine) <= 1.0)
    assert np.all(np.abs(sine) <= 1.0)


def test_quarter_turns():
    turns = np.arange(-9, 10)
    cosine, sine = cosine_and_sine(0.5 * np.pi * turns)
    np.testing.assert_allclose(cosine, np.asarray([1.0, 0.0, -1.0, 0.0])[turns % 4], atol=2e-15)
    np.testing.assert_allclose(sine, np.asarray([0.0, 1.0, 0.0, -1.0])[turns % 4], atol=2e-15)


def test_large_angles_are_off_by_their_last_bits():
    angle = np.random.default_rng(1).uniform(1e6, 1e9, 2000)
    cosine, sine = cosine_and_sine(angle)
    apart = np.maximum(np.abs(cosine - np.cos(angle)), np.abs(sine - np.sin(angle)))
    assert np.all(apart < 2.0 * np.spacing(angle))


def test_cosine_and_sine_have_derivatives_of_any_order_in_both_modes():
    angle = jnp.asarray(2.3)
    for k, (name, sign) in enumerate([("cos", 1.0), ("sin", -1.0), ("cos", -1.0), ("sin", 1.0)]):
        wanted = sign * getattr(np, name)(2.3)
        forward = reverse = lambda x: cosine_and_sine(x)[0]
        for _ in range(k):
            forward, reverse = jax.jacfwd(forward), jax.grad(reverse)
        np.testing.assert_allclose([jax.jit(forward)(angle), jax.jit(reverse)(angle)], wanted, rtol=1e-14)


def test_what_is_not_finite_or_has_no_digits_behind_the_point_has_no_cosine():
    for values in cosine_and_sine(jnp.asarray([jnp.nan, jnp.inf, -jnp.inf, 1e18, -1e300])):
        assert np.all(np.isnan(values))
