"""Laws of Barus, Roelands, two viscosities, constant: what every law must do, and what each is."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import mpmath
import numpy as np
import pytest
from reference_oils import OILS

from jaxbearing.lubricants import (
    Barus,
    ConstantViscosity,
    IsoviscousLiquid,
    LinearDensity,
    Roelands,
    VogelDicke,
    WaltherPower,
    WaltherRoelands,
)
from jaxbearing.lubricants.viscosity import capped

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "lubricants.toml").read_text())

DENSITY = LinearDensity(880.0, -0.63, 303.15)
BARUS = Barus(0.03, 313.15, 2e-8, 3500.0)
ROELANDS = Roelands(0.02, 313.15, 0.6, 1.1)
WALTHER = WaltherRoelands(32e-6, 313.15, 5.4e-6, 373.15, DENSITY, 2e-8)
LAWS = {
    "constant": ConstantViscosity(1e-3),
    "barus": BARUS,
    "barus_isothermal": Barus(0.03, 313.15, 2e-8, 0.0),
    "roelands": ROELANDS,
    "walther_roelands": WALTHER,
    "estimated": WaltherRoelands(100e-6, 313.15, 14e-6, 373.15, DENSITY),
    "walther_power": WaltherPower(67e-6, 313.15, 8.5e-6, 373.15, 9.9e-9, 0.139, DENSITY),
    "vogel_dicke": VogelDicke(6.2e-5, 1021.7, 171.6, 3.278e7, 6.264e7, 4.419e-3, 3.4534e-2),
    "isoviscous": IsoviscousLiquid(6.5e-4, 313.15, 5017.0, 9.96),
    "modified_wlf": OILS["pennzane_x2000"].viscosity,
}
CAP = 15 * np.log(10)

# The law is an argument, so that laws of one class share a compilation.
LOG_VISCOSITY = jax.jit(lambda law, p, t: law.log_viscosity(p, t))
DERIVATIVE = jax.jit(jax.grad(lambda law, p, t: jnp.sum(law.log_viscosity(p, t)), argnums=(0, 1, 2)))

each_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS.keys())


@each_law
def test_hard_cases_value_and_gradient(law):
    pressure = np.asarray([-1e10, -1e7, -1.0, 0.0, 1.0, 1e9, 3e9, 1e10])[:, None]
    temperature = np.asarray([1.0, 50.0, 100.0, 138.0, 139.0, 250.0, 373.0, 1000.0])[None, :]
    value = LOG_VISCOSITY(law, pressure, temperature)
    assert value.shape == (8, 8)
    assert np.all(np.isfinite(value))
    # at 1 K the uncapped logarithm is 1e9, and its last digit 1e-7
    assert np.all(np.asarray(value) <= CAP + 1e-6)
    for leaf in jax.tree.leaves(DERIVATIVE(law, pressure, temperature)):
        assert np.all(np.isfinite(leaf))


@each_law
@pytest.mark.parametrize(("pressure", "temperature"), [(0.0, 300.0), (3e8, 350.0), (8e8, 373.15)])
def test_gradients(law, pressure, temperature):
    by_temperature = lambda t: LOG_VISCOSITY(law, pressure, t)
    central = (by_temperature(temperature + 1e-2) - by_temperature(temperature - 1e-2)) / 2e-2
    _, by_p, by_t = DERIVATIVE(law, pressure, temperature)
    # step^2/6 times f'''/f' (about 1e-3 1/K^2) is 2e-8
    np.testing.assert_allclose(by_t, central, rtol=1e-6, atol=1e-12)
    # at p = 0 the step stays on the exact side
    low, high = (0.0, 2e4) if pressure == 0.0 else (pressure - 1e5, pressure + 1e5)
    difference = (LOG_VISCOSITY(law, high, temperature) - LOG_VISCOSITY(law, low, temperature)) / (high - low)
    # one-sided at p = 0: half a step times f''/f' (3e-9 1/Pa)
    np.testing.assert_allclose(by_p, difference, rtol=1e-6 if pressure else 1e-4, atol=1e-20)


@each_law
def test_gradients_in_the_parameters(law):
    leaves, tree = jax.tree.flatten(law)
    slopes = jax.tree.leaves(DERIVATIVE(law, 4e8, 340.0)[0])
    value = lambda i, factor: LOG_VISCOSITY(
        jax.tree.unflatten(tree, [leaf * factor if i == j else leaf for j, leaf in enumerate(leaves)]), 4e8, 340.0
    )
    for i, (leaf, slope) in enumerate(zip(leaves, slopes, strict=True)):
        central = (value(i, 1 + 1e-5) - value(i, 1 - 1e-5)) / 2e-5
        # round-off of ln(viscosity) over the step is 1e-10
        np.testing.assert_allclose(slope * leaf, central, rtol=1e-6, atol=2e-9)


@each_law
def test_eager_is_jit_is_vmap(law):
    pressure = jnp.linspace(-1e7, 3e9, 20_001)
    temperature = jnp.linspace(200.0, 473.0, 20_001)
    eager = law.log_viscosity(pressure, temperature)
    # a fused kernel may differ in the last bits; 20 of ln(viscosity) is 1e-14 absolute
    np.testing.assert_allclose(LOG_VISCOSITY(law, pressure, temperature), eager, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(jax.vmap(law.log_viscosity)(pressure, temperature), eager, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("law", [law for name, law in LAWS.items() if name not in ("constant", "isoviscous")])
def test_rises_with_pressure_and_falls_with_temperature(law):
    pressure = np.linspace(0.0, 2e9, 101)
    assert np.all(np.diff(LOG_VISCOSITY(law, pressure, 330.0)) > 0)
    slope = law.log_slope(jnp.asarray([250.0, 313.0, 450.0]))
    assert jnp.all(slope == 0 if law is LAWS["barus_isothermal"] else slope < 0)


def test_cap():
    x = jnp.asarray([-50.0, 0.0, np.log(1e9), CAP, CAP + 100.0])
    got = capped(x)
    np.testing.assert_allclose(got[:2], x[:2], atol=1e-29)
    np.testing.assert_allclose(got[2], x[2], atol=5.5e-13)  # as stated: 0.5 exp(-2 ln 1e6)
    np.testing.assert_allclose(CAP - got[3], 0.5 * np.log(2), rtol=1e-12)  # as stated: 0.35
    np.testing.assert_allclose(got[4], CAP, rtol=1e-14)


def test_constant():
    law = LAWS["constant"]
    np.testing.assert_allclose(law.viscosity(jnp.asarray([0.0, 1e9]), 300.0), 1e-3, rtol=1e-15)
    assert law.log_slope(jnp.asarray([300.0, 400.0])).tolist() == [0.0, 0.0]


def test_barus_is_its_formula():
    np.testing.assert_allclose(BARUS.viscosity(0.0, 313.15), 0.03, rtol=1e-14)
    plain = 0.03 * np.exp(2e-8 * 4e8 + 3500.0 * (1 / 350.0 - 1 / 313.15))
    np.testing.assert_allclose(BARUS.viscosity(4e8, 350.0), plain, rtol=1e-13)
    np.testing.assert_allclose(BARUS.log_slope(350.0), -3500.0 / 350.0**2, rtol=1e-14)
    np.testing.assert_allclose(LAWS["barus_isothermal"].viscosity(4e8, 400.0), 0.03 * np.exp(8.0), rtol=1e-13)


def test_roelands_check_value():
    row = next(row for row in PUBLISHED["row"] if row["quantity"] == "roelands")
    names = ("reference_viscosity", "reference_temperature", "pressure_exponent", "temperature_exponent")
    law = Roelands(**{name: row[name] for name in names})
    np.testing.assert_allclose(law.viscosity(row["pressure"], row["temperature"]), row["value"], rtol=row["rtol"])


def plain_roelands(p, t):
    """In 30 digits."""
    with mpmath.workdps(30):
        log_reference = mpmath.log(mpmath.mpf(0.02))
        rate, pole = mpmath.mpf("5.1e-9"), 138
        ratio = (mpmath.mpf(t) - pole) / (mpmath.mpf(313.15) - pole)
        factor = (1 + rate * mpmath.mpf(p)) ** mpmath.mpf(0.6) * ratio ** (-mpmath.mpf(1.1))
        return float(log_reference + (log_reference + mpmath.mpf("9.67")) * (factor - 1))


@pytest.mark.parametrize("temperature", [200.0, 250.0, 313.15, 400.0, 1000.0])
@pytest.mark.parametrize("pressure", [0.0, 1e3, 3e8, 1e9])
def test_roelands_is_its_formula_where_it_is_not_clamped(pressure, temperature):
    plain = plain_roelands(pressure, temperature)
    if plain < np.log(1e9):
        np.testing.assert_allclose(ROELANDS.log_viscosity(pressure, temperature), plain, rtol=1e-12)


def test_roelands_clamp_does_not_bias():
    # stated: T exact to 1e-12 K above 167 K; a law this thin stays below the cap there
    thin = Roelands(1e-4, 313.15, 0.6, 1.1)
    plain = np.log(1e-4) + (np.log(1e-4) + 9.67) * ((29.0 / 175.15) ** -1.1 - 1)
    np.testing.assert_allclose(thin.log_viscosity(0.0, 167.0), plain, rtol=1e-12)


def test_roelands_slopes_at_its_reference():
    span = np.log(0.02) + 9.67
    np.testing.assert_allclose(jax.grad(ROELANDS.log_viscosity)(0.0, 313.15), 5.1e-9 * 0.6 * span, rtol=1e-13)
    np.testing.assert_allclose(ROELANDS.log_slope(313.15), -1.1 * span / 175.15, rtol=1e-13)
    np.testing.assert_allclose(ROELANDS.viscosity(0.0, 313.15), 0.02, rtol=1e-14)
