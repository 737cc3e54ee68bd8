"""Viscous functions: inverses, limits, hard cases, gradients."""

import itertools

import jax
import jax.numpy as jnp
import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jaxbearing.contacts import BairWiner, ElsharkawyHamrock, GecimWiner, ReeEyring
from jaxbearing.contacts.viscous import asinh_of_scaled

LAWS = [ReeEyring(), BairWiner(), GecimWiner(), ElsharkawyHamrock(1.0), ElsharkawyHamrock(2.0), ElsharkawyHamrock(3.0)]
LIMITED = LAWS[1:]
IDS = lambda law: law.name + str(getattr(law, "exponent", ""))  # new law: add a line above, get every test
SCALED = {law: jax.jit(law.stress_ratio_of_scaled) for law in LAWS}
SLOPES = {law: jax.jit(jax.vmap(jax.grad(law.stress_ratio_of_scaled, argnums=(0, 1)))) for law in LAWS}
EXACT = {
    "ree_eyring": mpmath.asinh,
    "bair_winer": lambda q: 1 - mpmath.exp(-q),
    "gecim_winer": mpmath.tanh,
}


def exact_stress(law, q):
    if isinstance(law, ElsharkawyHamrock):
        return q * (1 + q ** mpmath.mpf(law.exponent)) ** (-1 / mpmath.mpf(law.exponent))
    return EXACT[law.name](q)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_against_mpmath(law):
    for log_scale, x in (
        (0.0, 1e-12),
        (-300.0, 1e125),
        (3.0, 0.01),
        (0.0, 1.0),
        (1.0, 1.0),
        (300.0, 1e-129),
        (5.0, 9.0),
    ):
        with mpmath.workdps(60):
            exact = float(exact_stress(law, mpmath.exp(mpmath.mpf(log_scale)) * mpmath.mpf(x)))
        # exp(s) carries the rounding of s: |s| eps
        np.testing.assert_allclose(SCALED[law](log_scale, x), exact, rtol=3e-13)
        assert SCALED[law](log_scale, -x) == -SCALED[law](log_scale, x)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_inverse_both_ways(law):
    q = jnp.asarray([-20.0, -3.0, -0.5, -1e-9, 0.0, 1e-9, 0.5, 3.0])
    # near the limiting stress 1 - s carries eps/(1 - s): e^3 for Bair and Winer, (1 - s^n)^-1 for the others
    stress_ratio, rate_ratio = jax.jit(law.stress_ratio), jax.jit(law.rate_ratio)
    s = stress_ratio(q)
    np.testing.assert_allclose(rate_ratio(s)[1:], q[1:], rtol=1e-12)
    s = jnp.asarray([-0.9, -0.1, 0.0, 1e-9, 0.3, 0.99])
    np.testing.assert_allclose(stress_ratio(rate_ratio(s)), s, rtol=1e-13)
    np.testing.assert_allclose(SCALED[law](0.0, q), stress_ratio(q), rtol=1e-14)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_newtonian_at_rest(law):
    slopes = [jax.jit(jax.grad(function))(0.0) for function in (law.rate_ratio, law.stress_ratio)]
    np.testing.assert_allclose(slopes, 1.0, rtol=1e-15)
    np.testing.assert_allclose(SLOPES[law](jnp.full(1, 2.0), jnp.zeros(1))[1], np.exp(2.0), rtol=1e-14)


@pytest.mark.parametrize("law", LIMITED, ids=IDS)
def test_limiting_stress(law):
    assert float(law.stress_ratio(1e300)) == 1.0
    np.testing.assert_array_equal(SCALED[law](jnp.asarray([600.0, 600.0]), jnp.asarray([1e100, -1e-200])), [1.0, -1.0])
    assert np.all(np.asarray(jax.jit(law.stress_ratio)(np.logspace(-3, 1, 20))) < 1)


def test_order_of_the_limiting_laws():
    """At the same q: Newton above all; E-H rises towards its square corner min(q, 1) with n."""
    q = np.logspace(-1, 1, 9)
    at = jax.jit(lambda exponent, q: ElsharkawyHamrock(exponent).stress_ratio(q))
    stress = [np.asarray(at(n, q)) for n in (1.0, 2.0, 3.0, 200.0)]
    assert all(np.all(low < high) for low, high in itertools.pairwise(stress))
    np.testing.assert_allclose(stress[-1], np.minimum(q, 1.0), rtol=4e-3)  # ln(2)/200 at q = 1


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_hard_cases_value_and_gradient(law):
    log_scale, x = np.meshgrid([-800.0, -600.0, 0.0, 229.9, 600.0, 800.0], [0.0, 1e-300, -1e-9, 1.0, 1e12])
    assert np.all(np.isfinite(SCALED[law](log_scale, x)))
    assert all(np.all(np.isfinite(g)) for g in SLOPES[law](log_scale.ravel(), x.ravel()))
    slopes = jax.jit(jax.vmap(jax.grad(law.stress_ratio)))
    assert all(np.all(np.isfinite(slopes(q))) for q in (x.ravel(), 1e200 * x.ravel()))


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_gradients(law):
    log_scale = np.asarray([-2.0, 0.0, 1.5, 40.0])
    x = np.asarray([3.0, -1.0 - 1e-3, 0.2, 1e-18])
    gradient = SLOPES[law](log_scale, x)
    for i, step in enumerate((1e-5 * np.ones(4), 1e-5 * np.abs(x))):
        up, down = ((log_scale + s * step, x) if i == 0 else (log_scale, x + s * step) for s in (1, -1))
        central = np.subtract(SCALED[law](*up), SCALED[law](*down)) / (2 * step)
        # round-off 1e-16/1e-5 of values of order 1, truncation 1e-10
        np.testing.assert_allclose(gradient[i] * step, central * step, rtol=1e-7, atol=4e-16)


def test_exponent_has_a_gradient_at_rest():
    slope = jax.grad(lambda n, q: ElsharkawyHamrock(n).stress_ratio(q))
    assert slope(2.0, 0.0) == 0
    central = (ElsharkawyHamrock(2.0001).stress_ratio(0.7) - ElsharkawyHamrock(1.9999).stress_ratio(0.7)) / 2e-4
    np.testing.assert_allclose(slope(2.0, 0.7), central, rtol=1e-7)


@settings(deadline=None, derandomize=True, max_examples=60)
@given(st.floats(-40, 600), st.floats(-12, 6))
def test_asinh_of_scaled_against_mpmath(log_scale, log10_x):
    x = 10.0**log10_x
    with mpmath.workdps(40):
        exact = float(mpmath.asinh(mpmath.exp(mpmath.mpf(log_scale)) * mpmath.mpf(x)))
    # exp(s) carries the rounding of s: |s| eps, s up to 600
    np.testing.assert_allclose(asinh_of_scaled(log_scale, x), exact, rtol=1e-13)
    assert asinh_of_scaled(log_scale, -x) == -asinh_of_scaled(log_scale, x)


def test_asinh_of_scaled_gradient_is_continuous_at_the_switch():
    for x in (1 - 1e-9, 1 + 1e-9):
        np.testing.assert_allclose(jax.grad(asinh_of_scaled, argnums=1)(0.0, x), 1 / np.sqrt(2), rtol=1e-8)
