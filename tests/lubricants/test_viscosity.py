"""Modified WLF law: check values, printed viscosities, its singular places, gradients."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import mpmath
import numpy as np
import pytest
from reference_oils import OILS

from jaxbearing.lubricants import ModifiedWLF

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "lubricants.toml").read_text())

# The law is an argument, so that all oils share one compilation.
LOG_VISCOSITY = jax.jit(ModifiedWLF.log_viscosity)
DERIVATIVE = jax.jit(jax.grad(lambda law, p, t: jnp.sum(law.log_viscosity(p, t)), argnums=(0, 1, 2)))


def rows(quantity):
    return next(row for row in PUBLISHED["row"] if row["quantity"] == quantity)


def plain_log10(law: ModifiedWLF, pressure, temperature):
    """The law as printed, in 30 digits."""
    with mpmath.workdps(30):
        field = lambda name: mpmath.mpf(getattr(law, name))
        p, t = mpmath.mpf(pressure), mpmath.mpf(temperature)
        glass = field("glass_temperature") + field("glass_shift") * mpmath.log(1 + field("glass_shift_rate") * p)
        expansion = 1 - field("expansion_factor") * mpmath.log(1 + field("expansion_rate") * p)
        y = (t - glass) * expansion
        return float(mpmath.log10(field("glass_viscosity")) - field("c1") * y / (field("c2") + y))


def test_check_values():
    row = rows("viscosity")
    got = [
        OILS[oil].viscosity.viscosity(p, t)
        for oil, p, t in zip(row["oil"], row["pressure"], row["temperature"], strict=True)
    ]
    np.testing.assert_allclose(got, row["value"], rtol=row["rtol"])


def test_printed_viscosities_within_the_stated_deviation():
    row = PUBLISHED["viscosity"][0]
    got = OILS[row["oil"]].viscosity.viscosity(0.0, jnp.asarray(row["temperature"]))
    # the deviations are stated to 0.1 %
    np.testing.assert_allclose(np.asarray(got) / row["value"] - 1, row["deviation"], atol=1e-3)


def test_kinematic_viscosity_at_100_celsius():
    oil = OILS["mobil_jet_ii"].at(373.15)
    np.testing.assert_allclose(oil.viscosity / oil.density, 5.0e-6, rtol=0.04)  # "5 cSt": the law is 3.6 % above


def test_glass_point():
    law = OILS["mobil_jet_ii"].viscosity
    # y = 0 is the glass transition. The denominator is C2 - d_min = 4.6 K above its floor: 0.5 e^-9.2 K
    np.testing.assert_allclose(law.log_viscosity(0.0, 165.75) / np.log(10), 12.0, atol=1e-4)


@pytest.mark.parametrize("name", list(OILS))
def test_agrees_with_the_printed_law_away_from_its_pole(name):
    law = OILS[name].viscosity
    compared = 0
    for temperature in (253.15, 273.15, 313.15, 373.15, 473.15):
        for pressure in (0.0, 1e6, 1e8, 5e8, 1e9, 1.5e9):
            plain = plain_log10(law, pressure, temperature)
            if plain < 6.0:  # 9 K and more above the floor of the denominator
                got = LOG_VISCOSITY(law, pressure, temperature) / np.log(10)
                np.testing.assert_allclose(got, plain, rtol=1e-6, atol=1e-7)
                compared += 1
    assert compared > 20


@pytest.mark.parametrize("name", list(OILS))
def test_hard_cases_value_and_gradient(name):
    law = OILS[name].viscosity
    pressure = jnp.asarray([-1e10, -1e7, -1.0, 0.0, 1.0, 1e9, 3.56e9, 6e9, 9.35e9, 1e12])[:, None]
    temperature = jnp.asarray([1.0, 100.0, 136.344, 243.0, 300.0, 473.0, 2000.0])[None, :]
    value = LOG_VISCOSITY(law, pressure, temperature)
    assert jnp.all(jnp.isfinite(value))
    assert jnp.all(value <= 15 * np.log(10) * (1 + 1e-12))
    for leaf in jax.tree.leaves(DERIVATIVE(law, pressure, temperature)):
        assert jnp.all(jnp.isfinite(leaf))


def test_at_the_pole_of_the_printed_law():
    law = OILS["mobil_jet_ii"].viscosity
    pole = jnp.asarray(165.75 - 29.406)
    # as a solver tries it: a person's 136 K is refused
    np.testing.assert_allclose(jax.jit(law.log_viscosity)(0.0, pole), 15 * np.log(10), rtol=1e-2)
    assert jnp.isfinite(jax.grad(law.log_viscosity, argnums=1)(0.0, pole))


def test_ambient_value_and_slope_are_exact_at_zero_pressure():
    law = OILS["mobil_jet_ii"].viscosity
    np.testing.assert_allclose(law.log_viscosity(0.0, 300.0) / np.log(10), plain_log10(law, 0.0, 300.0), rtol=1e-14)
    below, above = (law.log_viscosity(p, 300.0) for p in (-10.0, 10.0))
    # one-sided clamp is C1: the central difference over 0 has an error of 10 Pa / 1 MPa / 2
    np.testing.assert_allclose((above - below) / 20.0, jax.grad(law.log_viscosity)(0.0, 300.0), rtol=1e-5)


@pytest.mark.parametrize("name", list(OILS))
@pytest.mark.parametrize(("pressure", "temperature"), [(0.0, 300.0), (5e8, 350.0), (2e9, 373.15), (4e9, 273.15)])
def test_gradients(name, pressure, temperature):
    law = OILS[name].viscosity
    by_temperature = lambda t: LOG_VISCOSITY(law, pressure, t)
    central = (by_temperature(temperature + 1e-2) - by_temperature(temperature - 1e-2)) / 2e-2
    # step^2/6 times f'''/f' (about 1e-3 1/K^2) is 2e-8; near the cap both are 0
    np.testing.assert_allclose(DERIVATIVE(law, pressure, temperature)[2], central, rtol=1e-6, atol=1e-10)
    if pressure > 0:
        by_pressure = lambda p: LOG_VISCOSITY(law, p, temperature)
        central = (by_pressure(pressure + 1e5) - by_pressure(pressure - 1e5)) / 2e5
        np.testing.assert_allclose(DERIVATIVE(law, pressure, temperature)[1], central, rtol=1e-6, atol=1e-18)


def test_log_slope():
    law = OILS["mobil_jet_ii"].viscosity
    # derivative of the printed form at p = 0: -ln(10) C1 C2/(C2 + T - Tg)^2
    expected = -np.log(10) * 16.342 * 29.406 / (29.406 + 373.0 - 165.75) ** 2
    np.testing.assert_allclose(law.log_slope(373.0), expected, rtol=1e-13)
    assert law.log_slope(jnp.asarray([300.0, 373.0])).shape == (2,)


@pytest.mark.parametrize("name", list(OILS))
def test_pressure_limit(name):
    row = rows("pressure_limit")
    got = OILS[name].viscosity.pressure_limit(jnp.asarray(row["celsius"]) + 273.15)
    np.testing.assert_allclose(got, row[name], atol=row["atol"])


def test_pressure_limit_has_no_gradient_and_survives_the_cold():
    law = OILS["mobil_jet_ii"].viscosity
    assert jax.grad(law.pressure_limit)(300.0) == 0.0
    assert law.pressure_limit(50.0) > 0


def test_eager_is_jit_is_vmap():
    law = OILS["mobil_jet_ii"].viscosity
    pressure = jnp.linspace(-1e7, 3e9, 20_001)
    temperature = jnp.linspace(243.0, 473.0, 20_001)
    eager = law.log_viscosity(pressure, temperature)
    # a fused kernel may differ in the last bits
    np.testing.assert_allclose(jax.jit(law.log_viscosity)(pressure, temperature), eager, rtol=1e-13)
    np.testing.assert_allclose(jax.vmap(law.log_viscosity)(pressure, temperature), eager, rtol=1e-13)
