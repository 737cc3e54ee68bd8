"""Rheology, density, conductivity, the lubricant as a whole and its data file."""

import tomllib
from importlib import resources
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pint
import pytest
from reference_oils import FITTED_COEFFICIENTS, OILS, mobil_jet_ii

from jaxbearing.lubricants import ExponentialRheology, Lubricant

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "lubricants.toml").read_text())


def test_rheology_check_values():
    row = next(row for row in PUBLISHED["row"] if row["quantity"] == "rheology")
    for name, p, t, modulus, stress in zip(
        row["oil"], row["pressure"], row["temperature"], row["shear_modulus"], row["stress"], strict=True
    ):
        rheology = OILS[name].rheology
        np.testing.assert_allclose(jnp.exp(rheology.log_shear_modulus(p, t)), modulus, rtol=row["rtol"])
        np.testing.assert_allclose(jnp.exp(rheology.log_stress(p, t)), stress, rtol=row["rtol"])


def test_rheology_at_its_reference_and_far_away():
    rheology = mobil_jet_ii().rheology
    np.testing.assert_allclose(rheology.log_shear_modulus(0.0, 300.0), np.log(4.82e4), rtol=1e-15)
    np.testing.assert_allclose(rheology.log_stress(0.0, 300.0), np.log(1.56e5), rtol=1e-15)
    np.testing.assert_allclose(rheology.log_shear_modulus(1e12, 300.0), np.log(4.82e4) + 60, rtol=1e-15)
    for law in (rheology.log_shear_modulus, rheology.log_stress):
        slopes = jax.jit(jax.grad(law, argnums=(0, 1)))
        for state in ((0.0, 243.0), (6e9, 473.0), (1e12, 300.0), (-1e12, 300.0), (0.0, 1e-3)):
            # as a solver tries it: a person's 1e-3 K is refused
            assert np.isfinite(jax.jit(law)(*state))
            assert all(np.isfinite(g) for g in slopes(*state))
        central = (law(1e9 + 1e5, 350.0) - law(1e9 - 1e5, 350.0)) / 2e5  # linear in p: round-off only
        np.testing.assert_allclose(jax.grad(law)(1e9, 350.0), central, rtol=1e-9)


def test_conductivity():
    law = mobil_jet_ii().conductivity
    row = next(row for row in PUBLISHED["row"] if row["quantity"] == "mobil_jet_ii at 100 C")
    np.testing.assert_allclose(law.conductivity(row["temperature"]), row["conductivity"], rtol=row["rtol"])
    np.testing.assert_allclose(law.conductivity(300.0), 0.1635, rtol=4e-4)  # four printed digits
    t = np.linspace(243.0, 473.0, 24)
    # the floor: < 1e-12 on the range of use
    np.testing.assert_allclose(law.conductivity(t), 0.148676 - 2.22753e-4 * (t - 366.67), rtol=1e-12)
    hot = jnp.asarray([700.0, 1034.0, 5000.0])
    assert jnp.all(law.conductivity(hot) >= 0.05)
    assert np.all(np.isfinite(jax.jit(jax.vmap(jax.grad(law.conductivity)))(hot)))


def test_density():
    row = next(row for row in PUBLISHED["row"] if row["quantity"] == "mobil_jet_ii at 100 C")
    np.testing.assert_allclose(mobil_jet_ii().density.density(row["temperature"]), row["density"], rtol=1e-12)


def test_inlet_oil():
    lubricant = mobil_jet_ii()
    oil = lubricant.at(jnp.asarray([[300.0], [373.15]]))
    assert oil.viscosity.shape == oil.log_slope.shape == oil.conductivity.shape == (2, 1)
    np.testing.assert_allclose(oil.viscosity[1, 0], 0.004867549, rtol=1e-6)
    assert OILS["nye_186a"].at(300.0).density is None
    bare = Lubricant(lubricant.viscosity, lubricant.pressure_viscosity).at(300.0)
    assert (bare.density, bare.conductivity) == (None, None)
    batched = jax.jit(jax.vmap(lubricant.at))(jnp.asarray([300.0, 373.15]))
    np.testing.assert_allclose(batched.viscosity, oil.viscosity[:, 0], rtol=1e-14)


def test_rheology_refuses_an_unknown_viscous_function():
    with pytest.raises(ValueError, match=r"rheology\.viscous_function must be one of .*, got 'eyring'"):
        ExponentialRheology(300.0, 1e5, 0.0, 0.0, 1e6, 0.0, 0.0, viscous_function="eyring")


def reference(name, table):
    """The law in `reference_oils`; alpha* of the data files is the closed form."""
    if table == "pressure_viscosity" and name in FITTED_COEFFICIENTS:
        return FITTED_COEFFICIENTS[name]
    return getattr(OILS[name], table)


@pytest.mark.parametrize("table", ["viscosity", "pressure_viscosity", "rheology", "density", "conductivity"])
@pytest.mark.parametrize("name", list(OILS))
def test_data_file_is_the_reference_oil(name, table):
    file = resources.files("jaxbearing.lubricants") / "oils" / f"{name}.toml"
    data = tomllib.loads(file.read_text())
    assert data["name"] == name
    law = reference(name, table)
    assert (table in data) == (law is not None)
    if law is None:
        return
    entries = {key: value for key, value in data[table].items() if key not in ("law", "sources", "note")}
    sources = data[table]["sources"]
    units = pint.UnitRegistry()
    assert set(entries) == {key for key, value in vars(law).items() if value is not None}
    for key, value in entries.items():
        assert sources.get(key) or sources.get("all")
        if key == "viscous_function":
            assert value == law.viscous_function
            continue
        number = units.Quantity(value).to_base_units().magnitude if isinstance(value, str) else value
        # the unit conversion rounds in the last digits
        np.testing.assert_allclose(number, getattr(law, key), rtol=1e-14)


@pytest.mark.parametrize("name", ["pennzane_x2000", "fomblin_z25"])
def test_densities_of_table_9(name):
    printed = PUBLISHED["space_oils"][name]["density"]
    np.testing.assert_allclose(OILS[name].density.density(jnp.asarray([288.75, 373.15])), printed, rtol=1e-15)
