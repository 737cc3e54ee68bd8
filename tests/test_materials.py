"""Materials: the reduced modulus and its limits; the catalogue starts no device."""

import dataclasses
import subprocess
import sys

import jax
import numpy as np
import pytest

from jaxbearing.materials import CATALOGUE, THERMAL_FIELDS, Material, catalogue_material, reduced_modulus


def test_equal_bodies():
    steel = CATALOGUE["steel"]
    # E/(1 - nu^2) of the source's roller bearing; round-off
    np.testing.assert_allclose(reduced_modulus(steel, steel), 210e9 / 0.91, rtol=1e-14)


def test_table_18_of_the_source():
    body = Material(205e9, 0.3, 7850.0)
    np.testing.assert_allclose(reduced_modulus(body, body), 225275e6, rtol=2e-6)  # six printed digits


def test_rigid_partner_doubles_the_modulus():
    rigid = Material(1e30, 0.3, 1.0)
    steel = CATALOGUE["52100"]
    np.testing.assert_allclose(reduced_modulus(steel, rigid), 2 * reduced_modulus(steel, steel), rtol=1e-14)


def test_symmetric_and_differentiable():
    a, b = CATALOGUE["M50"], CATALOGUE["Si3N4"]
    np.testing.assert_allclose(reduced_modulus(a, b), reduced_modulus(b, a), rtol=1e-14)
    value = lambda modulus: reduced_modulus(Material(modulus, 0.29, 7870.0), b)
    central = (value(203e9 * 1.0001) - value(203e9 * 0.9999)) / (203e9 * 2e-4)
    np.testing.assert_allclose(jax.grad(value)(203e9), central, rtol=1e-7)  # central difference, step 1e-4


@pytest.mark.parametrize("name", list(CATALOGUE))
def test_catalogue_is_physical(name):
    material = CATALOGUE[name]
    thermal = catalogue_material(name, thermal=True)
    assert all(isinstance(getattr(thermal, f.name), np.float64) for f in dataclasses.fields(material))
    assert {f.name for f in dataclasses.fields(material) if getattr(material, f.name) is None} == THERMAL_FIELDS
    assert 1e10 < material.youngs_modulus < 1e12
    assert 0 < material.poisson_ratio < 0.5
    assert 1e3 < material.density < 2e4


@pytest.mark.slow
def test_import_starts_no_device():
    code = "import jaxbearing.materials, jax._src.xla_bridge as b; assert not b._backends"
    subprocess.run([sys.executable, "-c", code], check=True)
