"""Monotone root with its implicit derivative; safe functions against the plain ones and at the singular points."""

import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import lambertw

from jaxbearing.numerics.precision import as_float
from jaxbearing.numerics.quadrature import gauss_legendre
from jaxbearing.numerics.roots import monotone_root
from jaxbearing.numerics.safe import (
    largest,
    nonnegative_pressure,
    positive_power,
    regular_power,
    safe_norm,
    smooth_abs,
    smooth_sign,
    smoothstep,
    softplus_floor,
)


def cubic(x, args):
    a, b = args
    return x**3 + a * x - b


ROOT = jax.jit(lambda b: monotone_root(cubic, (2.0, b), -1e4, 1e4, 3.0))


@pytest.mark.parametrize("b", [-1e6, -1.0, 0.0, 1e-9, 5.0, 1e9])
def test_root_against_cardano(b):
    """x^3 + a x = b has one real root for a > 0."""
    root = ROOT(b)
    real = [r.real for r in np.roots([1.0, 0.0, 2.0, -b]) if abs(r.imag) < 1e-6 * max(1.0, abs(r))]
    np.testing.assert_allclose(root.value, real[0], rtol=1e-12, atol=1e-15)
    assert root.residual <= 1e-9 * max(1.0, abs(b))


def test_root_derivative_is_implicit_in_both_modes():
    value = lambda a, b: monotone_root(cubic, (a, b), -10.0, 10.0, 1.0).value
    x = value(2.0, 5.0)
    exact = (-x / (3 * x**2 + 2), 1 / (3 * x**2 + 2))
    for mode in (jax.jacfwd, jax.jacrev):
        np.testing.assert_allclose(jax.jit(mode(value, argnums=(0, 1)))(2.0, 5.0), exact, rtol=1e-13)


def test_root_elementwise_and_batched():
    b = jnp.linspace(-3.0, 9.0, 7)
    together = monotone_root(cubic, (2.0, b), -10.0, 10.0, jnp.zeros(7)).value
    each = jax.jit(jax.vmap(lambda b_: monotone_root(cubic, (2.0, b_), -10.0, 10.0, 0.0).value))(b)
    np.testing.assert_allclose(together, each, rtol=1e-14)
    np.testing.assert_allclose(cubic(np.asarray(together), (2.0, np.asarray(b))), 0.0, atol=1e-13)


def test_halley_steps_are_of_third_order_and_keep_the_derivative():
    """x + e^x = b: three steps from 0.3 away where Newton's take five; also from far outside."""
    f = lambda x, b: x + jnp.exp(x) - b
    expansion = lambda x, b: (f(x, b), 1.0 + jnp.exp(x), jnp.exp(x))
    exact = lambda b: b - lambertw(np.exp(b)).real
    solve = lambda b, guess, **more: monotone_root(f, b, -60.0, 20.0, guess, expansion=expansion, **more).value
    limited = {n: jax.jit(functools.partial(solve, max_steps=n)) for n in (1, 2)}
    tolerant = jax.jit(jax.value_and_grad(functools.partial(solve, tolerance=1e-5)))
    for b, guess in ((2.0, 0.8), (2.0, 19.0), (-30.0, 3.0)):
        found, slope = tolerant(b, guess)
        np.testing.assert_allclose(found, exact(b), rtol=1e-14)
        # what is left is the cube of the last step, not its square
        steps = [abs(float(limited[n](b, guess)) - exact(b)) for n in (1, 2)]
        if guess == 0.8:
            assert steps[1] < 0.3 * steps[0] ** 3
        np.testing.assert_allclose(slope, 1.0 / (1.0 + np.exp(exact(b))), rtol=1e-13)


@pytest.mark.parametrize(("b", "end"), [(1e9, 10.0), (-1e9, -10.0)])
def test_root_outside_the_bracket_is_its_end_and_says_so(b, end):
    solve = lambda b_: monotone_root(cubic, (2.0, b_), -10.0, 10.0, 0.0)
    root = solve(b)
    assert root.value == end
    assert root.residual > 1e8
    assert jax.grad(lambda b_: solve(b_).value)(b) == 0.0


def test_root_of_a_flat_start_bisects():
    """Slope 0 at the guess: Newton alone would divide by zero."""
    root = monotone_root(lambda x, a: jnp.where(x > 1, (x - 1) ** 2, 0.0) - a, 4.0, -5.0, 50.0, 0.0)
    np.testing.assert_allclose(root.value, 3.0, rtol=1e-12)


def check_gradients(function, points):
    three = jax.jit(lambda x: (function(x), jax.jacfwd(function)(x), jax.jacrev(function)(x)))
    for x in points:
        value, forward, reverse = three(x)
        assert all(np.isfinite(v) for v in (value, forward, reverse)), (x, value, forward, reverse)
        # a slope of order 1 that cancels to nothing far away leaves round-off
        np.testing.assert_allclose(forward, reverse, rtol=1e-12, atol=1e-15)


def test_safe_functions_are_finite_at_their_singular_points():
    hard = [0.0, -1.0, 1.0, 1e-300, -1e-300, 1e12, -1e12]
    check_gradients(lambda x: softplus_floor(x, 0.1, 0.02), hard)
    check_gradients(lambda x: smooth_abs(x, 1e-6), hard)
    check_gradients(lambda x: smooth_sign(x, 1e-6), hard)
    check_gradients(lambda x: positive_power(x, 1.1), hard)
    check_gradients(lambda x: safe_norm(x, 0.0), hard)
    check_gradients(lambda x: nonnegative_pressure(x), hard)
    check_gradients(lambda x: regular_power(x, 0.42, 1e-9), [0.0, 1e-300, 1e-9, 1.0, 1e12])
    check_gradients(smoothstep, hard)


def test_stated_errors_against_the_plain_formulas():
    np.testing.assert_allclose(softplus_floor(1.0, 0.05, 0.02), 1.0, rtol=1e-14)
    np.testing.assert_allclose(softplus_floor(0.05, 0.05, 0.02) - 0.05, 0.02 * np.log(2), rtol=1e-12)
    np.testing.assert_allclose(smooth_abs(-3.0, 1e-6) / 3.0 - 1.0, 0.5e-12 / 9.0, atol=1e-15)
    # the stated relative error (1 - m) w^2 / (2 x^2), with m = 0.42, w/x = 1e-6: 0.29e-12
    np.testing.assert_allclose(regular_power(1e-3, 0.42, 1e-9), 1e-3**0.42, rtol=0.29 * 1e-12)
    np.testing.assert_allclose(jax.grad(lambda x: regular_power(x, 0.42, 1e-9))(0.0), 1e-9**-0.58, rtol=1e-12)
    np.testing.assert_allclose(nonnegative_pressure(0.0), 0.0)
    np.testing.assert_allclose(jax.grad(nonnegative_pressure)(-1e-6), 1.0, rtol=1e-11)
    assert nonnegative_pressure(-1e12) >= -1e6


@settings(deadline=None, derandomize=True, max_examples=50)
@given(st.floats(-2.0, 3.0))
def test_smoothstep_is_monotone_and_bounded(t):
    assert 0.0 <= smoothstep(t) <= 1.0
    assert jax.grad(smoothstep)(t) >= 0.0


@pytest.mark.parametrize("n", [1, 8, 40])
def test_gauss_rule_is_exact_to_degree_2n_minus_1(n):
    nodes, weights = gauss_legendre(n)
    for degree in (0, n, 2 * n - 1):
        np.testing.assert_allclose(np.sum(weights * nodes**degree), 1.0 / (degree + 1), rtol=1e-12)


def test_numbers_become_float64_leaves_and_float32_is_refused():
    for value in (3, 2.5, np.float64(2.5), np.arange(3), jnp.arange(3)):
        assert as_float(value).dtype == np.float64
    for narrow in (np.float32(1.0), jnp.ones(3, dtype=jnp.float32)):
        with pytest.raises(TypeError, match="64-bit"):
            as_float(narrow)


def test_the_largest_of_equal_values_has_a_derivative():
    """Also inside of a program, where an entry may be computed twice: that of the first one."""
    places = jnp.linspace(-1.0, 1.0, 20)
    bell = lambda width: largest(jnp.log1p(-0.99 * jnp.square(places)[:, None] * width[None]), axis=0)
    width = jnp.asarray([1.0, 0.7, 0.3])
    value, slope = jax.jit(lambda w: jax.jvp(bell, (w,), (jnp.ones_like(w),)))(width)
    middle = 0.99 * places[9] ** 2
    np.testing.assert_allclose(value, jnp.log1p(-middle * width), rtol=1e-14)
    np.testing.assert_allclose(slope, -middle / (1.0 - middle * width), rtol=1e-12)
