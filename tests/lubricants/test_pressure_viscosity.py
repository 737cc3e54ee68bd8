"""Pressure-viscosity coefficient: the integral, its closed form, the printed tables."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import FITTED_COEFFICIENTS, OILS
from scipy.integrate import quad

from jaxbearing.lubricants import ConstantPressureViscosity, IntegratedPressureViscosity

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "lubricants.toml").read_text())
# The law is an argument, so that laws of the same class share one compilation.
COEFFICIENT = jax.jit(lambda law, temperature: law.coefficient(temperature))
DERIVATIVE = jax.jit(jax.grad(lambda law, t: jnp.sum(law.coefficient(t)), argnums=(0, 1)))
INTEGRATED = {name: IntegratedPressureViscosity(oil.viscosity) for name, oil in OILS.items()}
LAWS = [OILS["mobil_jet_ii"].pressure_viscosity, *INTEGRATED.values()]


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
    # 32 nodes: 2e-8
    np.testing.assert_allclose(COEFFICIENT(INTEGRATED["pennzane_x2000"], 300.0), 1 / integral, rtol=5e-8)


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
    temperature = jnp.asarray([136.344, 186.0, 243.0, 300.0, 473.0, 900.0])
    value = COEFFICIENT(law, temperature)
    assert jnp.all(jnp.isfinite(value) & (value > 0))
    gradients = DERIVATIVE(law, temperature)
    assert all(jnp.all(jnp.isfinite(leaf)) for leaf in jax.tree.leaves(gradients))


@pytest.mark.parametrize("law", LAWS)
def test_gradient(law):
    # at a temperature where the upper limit of the integral does not jump within the step
    central = (COEFFICIENT(law, 351.01) - COEFFICIENT(law, 350.99)) / 0.02
    np.testing.assert_allclose(DERIVATIVE(law, 351.0)[1], central, rtol=1e-6)


def test_constant():
    law = ConstantPressureViscosity(10.4e-9)
    np.testing.assert_array_equal(law.coefficient(jnp.asarray([300.0, 400.0])), [10.4e-9, 10.4e-9])
    assert law.coefficient(300.0).shape == ()
