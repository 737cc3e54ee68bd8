"""Functions of the physics say what they expect where they are given something else; traced values pass."""

import os
import subprocess
import sys
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.line_contact_bridge import line_contact_of
from jaxbearing.gaps.drag import air_density
from jaxbearing.life.basic import tapered_equivalent_load
from jaxbearing.life.capacity import ball_capacity, roller_capacity
from jaxbearing.life.modification import contamination_factor, fatigue_load_limit, modification_factor
from jaxbearing.life.reference import ball_contact_capacities, edge_factors, roller_contact_capacities
from jaxbearing.life.static import ball_static_capacity, roller_static_capacity
from jaxbearing.lubricants import Barus, ConstantViscosity, Roelands
from jaxbearing.scenes.oils import load_oil

OIL = load_oil("mobil_jet_ii")
TEMPERATURES = {
    "viscosity": lambda t: OIL.viscosity.viscosity(0.0, t),
    "log_viscosity": lambda t: OIL.viscosity.log_viscosity(1e9, t),
    "log_slope": OIL.viscosity.log_slope,
    "barus": lambda t: Barus(0.03, 300.0, 2e-8, 4e3).viscosity(0.0, t),
    "roelands": lambda t: Roelands(0.03, 300.0, 0.6, 1.1).viscosity(0.0, t),
    "constant": lambda t: ConstantViscosity(0.03).viscosity(0.0, t),
    "coefficient": OIL.pressure_viscosity.coefficient,
    "shear modulus": lambda t: OIL.rheology.log_shear_modulus(1e9, t),
    "stress": lambda t: OIL.rheology.log_stress(1e9, t),
    "density": OIL.density.density,
    "conductivity": OIL.conductivity.conductivity,
    "at": lambda t: OIL.at(t).viscosity,
    "air": air_density,
}
ANGLES = {
    "ball_capacity": lambda angle: ball_capacity(16, 0.01, 0.06, angle),
    "roller_capacity": lambda angle: roller_capacity(16, 0.01, 0.06, 0.01, angle),
    "ball_static_capacity": lambda angle: ball_static_capacity(16, 0.01, 0.06, angle),
    "roller_static_capacity": lambda angle: roller_static_capacity(16, 0.01, 0.06, 0.01, angle),
    "ball_contact_capacities": lambda angle: ball_contact_capacities(2e4, 16, 0.01, 0.06, angle, 0.52, 0.52).inner,
    "roller_contact_capacities": lambda angle: roller_contact_capacities(2e4, 16, 0.01, 0.06, angle).inner,
    "tapered_equivalent_load": lambda angle: tapered_equivalent_load(1e3, 2e3, angle),
}
COUNTS = {
    "ball_capacity": lambda n: ball_capacity(n, 0.01, 0.06, 0.2),
    "roller_capacity": lambda n: roller_capacity(n, 0.01, 0.06, 0.01),
    "ball_static_capacity": lambda n: ball_static_capacity(n, 0.01, 0.06, 0.2),
    "roller_static_capacity": lambda n: roller_static_capacity(n, 0.01, 0.06, 0.01),
    "ball_contact_capacities": lambda n: ball_contact_capacities(2e4, n, 0.01, 0.06, 0.2, 0.52, 0.52).inner,
    "roller_contact_capacities": lambda n: roller_contact_capacities(2e4, n, 0.01, 0.06).inner,
    "edge_factors": edge_factors,
}
CHOICES = {
    "modification_factor": (lambda family: modification_factor(1.0, 0.5, family), "balls", "'ball'"),
    "fatigue_load_limit": (lambda family: fatigue_load_limit(1e4, 0.06, family), "rollers", "'roller'"),
    "contamination_factor": (lambda name: contamination_factor(1.0, 0.06, name), "normal", "'grease_normal'"),
}


@pytest.mark.parametrize("name", TEMPERATURES)
def test_temperatures_in_degrees_celsius(name):
    function = TEMPERATURES[name]
    for wrong in (40.0, np.float64(40.0), jnp.asarray([313.15, 40.0])):
        with pytest.raises(ValueError, match=r"must be in K, at least 150, got 40 \(40 degC are 313\.15 K"):
            function(wrong)
    assert np.isfinite(function(1000.0))
    right = function(313.15)
    assert np.isfinite(right)
    # traced, the same number as eager
    np.testing.assert_allclose(jax.jit(function)(313.15), right, rtol=1e-12)


@pytest.mark.parametrize("name", ANGLES)
def test_angles_in_degrees(name):
    function = ANGLES[name]
    with pytest.raises(ValueError, match=r"contact_angle must be an angle in rad, .*got 40 \(40 degrees are 0\.6981"):
        function(40.0)
    for wrong in (-0.1, 0.5 * np.pi, np.nan, 100.0):
        with pytest.raises(ValueError, match=r"contact_angle must be an angle in rad, from 0 to below pi/2, got"):
            function(wrong)
    right = function(0.6)
    assert np.isfinite(right)
    np.testing.assert_allclose(jax.jit(function)(0.6), right, rtol=1e-12)


@pytest.mark.parametrize("name", COUNTS)
def test_numbers_of_elements(name):
    for wrong in (0, -3):
        with pytest.raises(ValueError, match=r"n_\w+ must be a whole number >= 1, got"):
            COUNTS[name](wrong)
    assert np.all(np.isfinite(COUNTS[name](16)))


OF_ANOTHER_TYPE = """
import jaxbearing, sys
sys.path.insert(0, {folder!r})
import test_wrong_arguments as cases

def said(function, *values):
    for value in values:
        try:
            function(value)
        except ValueError as error:
            print(error)

for name, (function, wrong, near) in cases.CHOICES.items():
    said(function, wrong, None, 3, ["ball"])
for function in cases.COUNTS.values():
    said(function, 16.0, "16", None, True)
said(cases.race, "iner")
"""


def race(name):
    return line_contact_of(jb.load_scene("turbine_ball"), None, race=name, ball=0)


def test_arguments_of_another_type():
    """In a process of its own: in these tests every annotation is checked before the functions are."""
    code = OF_ANOTHER_TYPE.format(folder=str(Path(__file__).parent))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    for _, wrong, near in CHOICES.values():
        assert any(f"got '{wrong}'; did you mean {near}?" in line for line in lines)
    assert sum("must be one of" in line for line in lines) == 4 * len(CHOICES) + 1
    assert "race must be one of 'inner', 'outer', got 'iner'; did you mean 'inner'?" in lines
    assert sum("must be a whole number >= 1, got" in line for line in lines) == 4 * len(COUNTS)
