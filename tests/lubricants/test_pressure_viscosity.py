"""Pressure-viscosity coefficient: the integral, its closed form, the printed tables."""

import functools
import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import FITTED_COEFFICIENTS, OILS
from scipy.integrate import quad

from jaxbearing.lubricants import (
    Barus,
    ConstantPressureViscosity,
    ConstantViscosity,
    IntegratedPressureViscosity,
    LinearDensity,
    NoPressureViscosity,
    Roelands,
    WaltherRoelands,
)

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "lubricants.toml").read_text())
# The law is an argument, so that laws of the same class share one compilation.
COEFFICIENT = jax.jit(lambda law, temperature: law.coefficient(temperature))
DERIVATIVE = jax.jit(jax.grad(lambda law, t: jnp.sum(law.coefficient(t)), argnums=(0, 1)))
gauss = functools.cache(np.polynomial.legendre.leggauss)
LOG_VISCOSITY = jax.jit(lambda law, p, t: law.log_viscosity(p, t))
INTEGRATED = {name: IntegratedPressureViscosity(oil.viscosity) for name, oil in OILS.items()}
OTHERS = [
    IntegratedPressureViscosity(Barus(0.03, 313.15, 2e-8, 3500.0)),
    IntegratedPressureViscosity(Roelands(0.02, 313.15, 0.6, 1.1)),
    IntegratedPressureViscosity(WaltherRoelands(32e-6, 313.15, 5.4e-6, 373.15, LinearDensity(870.0, -0.6, 288.15))),
]
LAWS = [OILS["mobil_jet_ii"].pressure_viscosity, *FITTED_COEFFICIENTS.values(), *INTEGRATED.values(), *OTHERS]


def test_check_values():
    row = next(row for row in PUBLISHED["row"] if row["quantity"] == "pressure_viscosity")
    got = [COEFFICIENT(INTEGRATED[oil], t) for oil, t in zip(row["oil"], row["temperature"], strict=True)]
    np.testing.assert_allclose(got, row["value"], rtol=row["rtol"])


@pytest.mark.parametrize("row", PUBLISHED["pressure_viscosity"], ids=lambda row: row["source"])
def test_printed_tables(row):
    temperature = jnp.asarray(row["temperature"])
    fitted = COEFFICIENT(OILS[row["oil"]].pressure_viscosity, temperature)
    integrated = COEFFICIENT(INTEGRATED[row["oil"]], temperature)
    for got in (fitted, integrated):
        np.testing.assert_allclose(got, row["value"], rtol=row["rtol"])
        np.testing.assert_allclose(got, row["computed"], rtol=4e-4)  # four printed digits


def test_integral_against_scipy():
    law = OILS["pennzane_x2000"].viscosity

    def ratio(pressure):
        glass = 185.691 + 69.8093 * np.log1p(1.67903e-9 * pressure)
        y = (300.0 - glass) * (1 - 0.212452 * np.log1p(11.8028e-9 * pressure))
        return 10 ** (11.8362 * 60.5908 * (1 / (60.5908 + 300.0 - 185.691) - 1 / (60.5908 + y)))

    integral = quad(ratio, 0.0, float(law.pressure_limit(300.0)), points=[1e8, 5e8], epsabs=0, epsrel=1e-11)[0]
    # 32 nodes: 1e-8
    np.testing.assert_allclose(COEFFICIENT(INTEGRATED["pennzane_x2000"], 300.0), 1 / integral, rtol=1e-8)


@pytest.mark.parametrize("name", list(OILS))
@pytest.mark.parametrize("temperature", [253.15, 313.15, 423.15])
def test_nodes_are_enough(name, temperature):
    law = OILS[name].viscosity
    nodes, weights = gauss(400)
    limit = float(law.pressure_limit(temperature))
    pressure = 0.5 * limit * ((0.5 * (nodes + 1)) ** 3)  # crowded at 0, where the integrand varies
    pressure, weight = 2 * pressure, limit * 1.5 * (0.5 * (nodes + 1)) ** 2 * weights
    rise = LOG_VISCOSITY(law, jnp.asarray(pressure), temperature) - LOG_VISCOSITY(law, 0.0, temperature)
    reference = 1.0 / np.sum(weight * np.exp(-np.asarray(rise)))
    np.testing.assert_allclose(COEFFICIENT(INTEGRATED[name], temperature), reference, rtol=1e-8)


@pytest.mark.parametrize("alpha", [1e-10, 1e-9, 2e-8, 1e-7])
@pytest.mark.parametrize("temperature", [260.0, 313.15, 400.0])
def test_integral_of_barus_is_alpha(alpha, temperature):
    law = IntegratedPressureViscosity(Barus(0.03, 313.15, alpha, 3500.0))
    # the nodes: 1e-12; the cap at 1e15 Pa s: 200 * 0.3 Pa s / 1e15 Pa s
    np.testing.assert_allclose(COEFFICIENT(law, temperature), alpha, rtol=1e-11)
    slope = jax.grad(lambda a: IntegratedPressureViscosity(Barus(0.03, 313.15, a, 3500.0)).coefficient(temperature))
    np.testing.assert_allclose(slope(alpha), 1.0, rtol=1e-9)


@pytest.mark.parametrize(("mu", "z"), [(2e-3, 0.5), (1e-3, 0.4), (0.03, 0.65), (5.0, 0.8)])
def test_integral_of_roelands_against_scipy(mu, z):
    law = IntegratedPressureViscosity(Roelands(mu, 313.15, z, 1.1))
    span = np.log(mu) + 9.67
    ratio = lambda p: np.exp(-span * ((1 + 5.1e-9 * p) ** z - 1))
    # in units of 0.1 GPa; to infinity, so that the error of the upper limit shows: 1.6e-7 for the second row
    integral = 1e8 * quad(lambda x: ratio(1e8 * x), 0.0, np.inf, epsabs=0, epsrel=1e-11, limit=200)[0]
    np.testing.assert_allclose(COEFFICIENT(law, 313.15), 1 / integral, rtol=1e-6)
    # below the slope at p = 0: Roelands grows less than exponentially
    assert 1 / integral < 5.1e-9 * z * span


def test_no_pressure_viscosity():
    np.testing.assert_array_equal(NoPressureViscosity().coefficient(jnp.asarray([300.0, 400.0])), [0.0, 0.0])
    assert NoPressureViscosity().coefficient(300.0) == 0.0
    with pytest.raises(ValueError, match="constant viscosity"):
        IntegratedPressureViscosity(ConstantViscosity(1e-3))


def test_pressure_limit_of_a_law_without_a_turning_point():
    law = Barus(0.03, 313.15, 2e-8, 3500.0)
    np.testing.assert_allclose(law.pressure_limit(jnp.asarray([300.0, 400.0])), 1e10, rtol=1e-9)
    assert jax.grad(law.pressure_limit)(300.0) == 0.0
    # the scale is bounded where nothing grows
    np.testing.assert_allclose(ConstantViscosity(1e-3).pressure_limit(300.0), 2e14, rtol=1e-12)


def test_own_fit_follows_the_integral():
    temperature = jnp.linspace(253.15, 473.15, 45)
    fitted = OILS["mobil_jet_ii"].pressure_viscosity.coefficient(temperature)
    np.testing.assert_allclose(fitted, COEFFICIENT(INTEGRATED["mobil_jet_ii"], temperature), rtol=3.5e-5)


@pytest.mark.parametrize(("name", "deviation"), [("pennzane_x2000", 5e-4), ("nye_186a", 4e-4), ("fomblin_z25", 2.4e-3)])
def test_fits_of_the_source_follow_the_integral(name, deviation):
    temperature = jnp.linspace(243.15, 573.15, 34)
    integrated = COEFFICIENT(INTEGRATED[name], temperature)
    np.testing.assert_allclose(FITTED_COEFFICIENTS[name].coefficient(temperature), integrated, rtol=deviation)


def test_fit_agrees_with_the_plain_formula():
    t = np.linspace(243.0, 473.0, 24)
    d = t - 136.344
    plain = 1e-9 * (-2348.772 / t + 403871.5 / t**2 + 3320.064 / d - 14648.747 / d**2)
    np.testing.assert_allclose(OILS["mobil_jet_ii"].pressure_viscosity.coefficient(t), plain, rtol=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_hard_cases_value_and_gradient(law):
    temperature = jnp.asarray([50.0, 136.344, 186.0, 243.0, 300.0, 473.0, 1000.0])
    value = COEFFICIENT(law, temperature)
    assert jnp.all(jnp.isfinite(value) & (value > 0))
    gradients = DERIVATIVE(law, temperature)
    assert all(jnp.all(jnp.isfinite(leaf)) for leaf in jax.tree.leaves(gradients))


@pytest.mark.parametrize("law", LAWS)
def test_gradient(law):
    # at a temperature where the upper limit of the integral does not jump within the step
    central = (COEFFICIENT(law, 351.01) - COEFFICIENT(law, 350.99)) / 0.02
    # round-off of the integral over the step: 1e-8 1/Pa * 1e-14 / 0.02 K; that of Barus' law does not change at all
    np.testing.assert_allclose(DERIVATIVE(law, 351.0)[1], central, rtol=1e-6, atol=1e-20)


def test_constant():
    law = ConstantPressureViscosity(10.4e-9)
    np.testing.assert_array_equal(law.coefficient(jnp.asarray([300.0, 400.0])), [10.4e-9, 10.4e-9])
    assert law.coefficient(300.0).shape == ()
