"""The root of an implicit step: against mpmath, derivatives, extreme numbers."""

import jax
import jax.numpy as jnp
import mpmath
import numpy as np
import pytest

from jaxbearing.contacts import BairWiner, ElsharkawyHamrock, GecimWiner, ReeEyring

LAWS = [ReeEyring(), BairWiner(), GecimWiner()] + [
    ElsharkawyHamrock(jnp.asarray(n)) for n in (0.5, 1.0, 2.0, 3.0, 20.0)
]
IDS = lambda law: law.name + str(getattr(law, "exponent", ""))  # new law: add a line above, get every test
SIZE = 4096
# the law is an argument and all arrays have the same length, so that tests and exponents share a compilation
STRESS = jax.jit(lambda law, trial, relaxation: law.relaxed_stress_ratio(trial, relaxation))
SLOPES = jax.jit(lambda *a: jax.jvp(STRESS, *a)[1])


def padded(trial, relaxation):
    return (jnp.asarray(np.resize(np.asarray(value, dtype=float), SIZE)) for value in (trial, relaxation))


def stress_ratio(law, trial, relaxation):
    return np.asarray(STRESS(law, *padded(trial, relaxation)))[: np.size(trial)]


def slopes(law, trial, relaxation):
    """Derivatives with respect to trial, relaxation and the exponent."""
    point = (law, *padded(trial, relaxation))
    zero = jax.tree.map(jnp.zeros_like, point)
    found = []
    for index in (1, 2, 0) if hasattr(law, "exponent") else (1, 2):
        tangent = list(zero)
        tangent[index] = jax.tree.map(jnp.ones_like, point[index])
        found.append(np.asarray(SLOPES(point, tuple(tangent)))[: np.size(trial)])
    return found


def exact_flow(law, q):
    """s, ds/dq in mpmath."""
    if law.name == "ree_eyring":
        return mpmath.asinh(q), 1 / mpmath.sqrt(1 + q * q)
    if law.name == "bair_winer":
        return -mpmath.expm1(-q), mpmath.exp(-q)
    if law.name == "gecim_winer":
        return mpmath.tanh(q), mpmath.sech(q) ** 2
    n = mpmath.mpf(float(law.exponent))
    return q * (1 + q**n) ** (-1 / n), (1 + q**n) ** (-1 / n - 1)


def exact_root(law, trial, relaxation):
    """s, ds/dtrial, ds/drelaxation by bisection in ln q."""
    trial, relaxation = mpmath.mpf(trial), mpmath.mpf(relaxation)
    excess = lambda x: exact_flow(law, mpmath.exp(x))[0] + relaxation * mpmath.exp(x) - trial
    low, high = mpmath.log(trial / (1 + relaxation)) - 1e-9, mpmath.log(trial) + mpmath.log(1 + 1 / relaxation)
    high = min(high, mpmath.log(mpmath.sinh(trial))) if law.name == "ree_eyring" else high
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    x = low
    for _ in range(3):  # Newton on ln q
        q = mpmath.exp(x)
        stress, slope = exact_flow(law, q)
        x -= (stress + relaxation * q - trial) / ((slope + relaxation) * q)
    q = mpmath.exp(x)
    stress, slope = exact_flow(law, q)
    return stress, slope / (slope + relaxation), -q * slope / (slope + relaxation)


def sample(seed, n):
    rng = np.random.default_rng(seed)
    trial = 10 ** rng.uniform(-12, 2, n)
    near = rng.random(n) < 0.3  # of the corner at trial = 1
    trial[near] = 1 + (rng.choice([-1, 1], n) * 10 ** rng.uniform(-6, -0.5, n))[near]
    return trial, 10 ** rng.uniform(-30, 30, n)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_against_mpmath(law):
    trial, relaxation = sample(1, 80)
    exact = []
    for point in zip(trial, relaxation, strict=True):
        with mpmath.workdps(80):
            exact.append([float(value) for value in exact_root(law, *point)])
    stress, by_trial, by_relaxation = np.asarray(exact).T
    # Halley's last step; an exponent of 1/2 needs one more for round-off
    rtol = 1e-9 if getattr(law, "exponent", 1.0) < 1 else 1e-13
    np.testing.assert_allclose(stress_ratio(law, trial, relaxation), stress, rtol=rtol)
    found = slopes(law, trial, relaxation)
    # the slope over trial falls from 1 to 0 near trial = 1, and trial - 1 = 1e-6 is known to 1e-10
    np.testing.assert_allclose(found[0], by_trial, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(
        found[1] * relaxation / stress, by_relaxation * relaxation / stress, rtol=1e-9, atol=1e-9
    )


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_the_equation_is_met(law):
    """Backward error: the trial stress that belongs to the answer, over the whole range and on the corner itself."""
    trial, relaxation = sample(2, SIZE)
    trial[::7] = 1 + np.random.default_rng(3).choice([-1, 0, 1], trial[::7].size) * 2.0**-52
    trial[::11] *= 10
    stress = stress_ratio(law, trial, relaxation)
    assert jnp.all((stress > 0) & (stress <= trial * (1 + 1e-14)))  # round-off
    assert law.name == "ree_eyring" or jnp.all(stress <= 1)
    resolved = stress < 0.9 if law.name != "ree_eyring" else stress < 80  # where F(s) can be formed from s
    rate = law.rate_ratio(jnp.where(resolved, stress, 0.5))
    closure = (stress + relaxation * rate - trial) / (trial + relaxation * stress)
    assert jnp.max(jnp.where(resolved, jnp.abs(closure), 0.0)) < (1e-8 if getattr(law, "exponent", 1.0) < 1 else 1e-12)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_limits(law):
    # no relaxation: the trial stress, up to the limiting one
    trial = jnp.asarray([0.0, 1e-12, 0.3, 0.999, 5.0, 100.0])
    kept = trial if law.name == "ree_eyring" else jnp.minimum(trial, 1.0)
    np.testing.assert_allclose(stress_ratio(law, trial, jnp.zeros(6)), kept, rtol=1e-13)
    # all relaxation: the viscous law
    q = jnp.asarray([1e-9, 0.1, 1.0, 30.0])
    np.testing.assert_allclose(stress_ratio(law, 1e25 * q, jnp.full(4, 1e25)), law.stress_ratio(q), rtol=1e-12)
    # small stress: trial/(1 + relaxation)
    tiny = 1e-30 if getattr(law, "exponent", 1.0) < 1 else 1e-12
    relaxation = jnp.asarray([1e-9, 0.5, 1e9])
    np.testing.assert_allclose(stress_ratio(law, jnp.full(3, tiny), relaxation), tiny / (1 + relaxation), rtol=2e-12)


@pytest.mark.parametrize("law", LAWS, ids=IDS)
def test_hard_cases_value_and_gradient(law):
    trial, relaxation = jnp.meshgrid(
        jnp.asarray([0.0, 1e-300, 1e-12, 0.5, 1.0, 1.0 + 1e-15, 2.0, 100.0, 1e6]),
        jnp.asarray([0.0, 1e-300, 1e-100, 1e-30, 1e-12, 1.0, 1e30, 1e150]),
    )
    trial, relaxation = trial.ravel(), relaxation.ravel()
    assert jnp.all(jnp.isfinite(stress_ratio(law, trial, relaxation)))
    assert all(jnp.all(jnp.isfinite(slope)) for slope in slopes(law, trial, relaxation))


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0, 3.0])
def test_exponent_has_a_gradient(exponent):
    trial, relaxation = jnp.asarray([0.3, 0.9, 1.0, 1.5, 40.0]), jnp.asarray([1e-3, 0.5, 1e-6, 1e-2, 30.0])
    law = lambda change: ElsharkawyHamrock(jnp.asarray(exponent + change))
    up, down = (stress_ratio(law(change), trial, relaxation) for change in (1e-5, -1e-5))
    # round-off 1e-16/1e-5; an exponent of 1/2: see the accuracy of its root
    atol = 1e-5 if exponent < 1 else 1e-10
    np.testing.assert_allclose(slopes(law(0.0), trial, relaxation)[2], (up - down) / 2e-5, rtol=1e-7, atol=atol)
