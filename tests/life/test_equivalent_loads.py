"""Equivalent loads by X and Y, static safety, least load and modified catalogue life."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.scene import BallOperation
from jaxbearing.bearings.bearing_life import ineffective_inputs
from jaxbearing.bearings.rated import sizes_of_loads
from jaxbearing.bearings.rating import Rating
from jaxbearing.contacts import LineContact
from jaxbearing.life import (
    ball_equivalent_load,
    ball_static_load,
    contact_safety,
    contamination_factor,
    deep_groove_equivalent_load,
    roller_static_capacity,
    roller_static_load,
)
from jaxbearing.life.equivalent import RELATIVE_LOADS, X, Y
from jaxbearing.life.static import STEEL_MODULUS

# e as ISO 281 prints it, by contact angle and, below 20 degrees, relative load [M]
PRINTED_LIMITS = {
    0: [0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44],
    10: [0.29, 0.32, 0.36, 0.38, 0.40, 0.44, 0.49, 0.54, 0.54],
    15: [0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56],
    20: [0.57],
    25: [0.68],
    30: [0.80],
    35: [0.95],
    40: [1.14],
    45: [1.34],
}


@pytest.mark.parametrize("degrees", PRINTED_LIMITS)
def test_tables_agree_with_the_printed_limits(degrees):
    """e = (1 - X)/Y: there both formulas of P give the radial load."""
    place = degrees // 5
    limits = (1.0 - X[place]) / Y[place][: len(PRINTED_LIMITS[degrees])]
    np.testing.assert_allclose(limits, PRINTED_LIMITS[degrees], atol=0.0075)


def test_rows_that_a_maker_prints():
    """Koyo's general catalogue, equivalent loads: f0 Fa/C0 at 15 degrees, and factors at 15, 30, 40 degrees."""
    printed = [0.178, 0.357, 0.714, 1.07, 1.43, 2.14, 3.57, 5.35, 7.14]
    np.testing.assert_allclose(RELATIVE_LOADS / np.cos(np.radians(15.0)), printed, rtol=5e-3)
    np.testing.assert_array_equal(Y[3], [1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00])
    assert [X[3], X[6], X[8], Y[6][0], Y[8][0]] == [0.44, 0.39, 0.35, 0.76, 0.57]


def test_loads_by_hand():
    at = lambda degrees, radial, axial: float(ball_equivalent_load(radial, axial, np.radians(degrees), 16, 22.23e-3))
    np.testing.assert_allclose(at(40.0, 1000.0, 2000.0), 0.35 * 1000.0 + 0.57 * 2000.0, rtol=1e-14)
    np.testing.assert_allclose(at(37.5, 0.0, 2000.0), 0.615 * 2000.0, rtol=1e-14)
    assert at(40.0, 1000.0, 500.0) == 1000.0
    np.testing.assert_allclose(at(45.0, 0.0, 1.0), 0.50, rtol=1e-14)
    assert np.isnan(at(46.0, 1000.0, 500.0))
    static = lambda degrees, radial, axial: float(ball_static_load(radial, axial, np.radians(degrees)))
    np.testing.assert_allclose(static(0.0, 1000.0, 2000.0), 1600.0, rtol=1e-14)
    assert static(0.0, 1000.0, 200.0) == 1000.0
    np.testing.assert_allclose(static(40.0, 1000.0, 4000.0), 500.0 + 0.26 * 4000.0, rtol=1e-14)
    np.testing.assert_allclose(roller_static_load(1000.0, 3000.0, np.arctan(0.25)), 500.0 + 0.88 * 3000.0, rtol=1e-14)


def test_deep_groove_bearings_as_the_formula_with_f0():
    """f0/C0 = 1/(Z D^2) by the definition of f0."""
    size = 9 * 7.938**2
    for axial in (50.0, 400.0, 3000.0):
        expected = deep_groove_equivalent_load(100.0, axial, size, 1.0)
        np.testing.assert_allclose(ball_equivalent_load(100.0, axial, 0.0, 9, 7.938e-3), expected, rtol=1e-12)
    ends = [float(ball_equivalent_load(0.0, 1.0 * load * size, 0.0, 9, 7.938e-3)) for load in RELATIVE_LOADS]
    np.testing.assert_allclose(ends, Y[0] * RELATIVE_LOADS * size, rtol=1e-12)


def test_equivalent_load_has_a_slope():
    slope = jax.grad(lambda axial: ball_equivalent_load(100.0, axial, 0.0, 9, 7.938e-3))(400.0)
    near = [float(ball_equivalent_load(100.0, axial, 0.0, 9, 7.938e-3)) for axial in (399.9, 400.1)]
    np.testing.assert_allclose(slope, (near[1] - near[0]) / 0.2, rtol=1e-8)


def test_static_safety_of_the_most_loaded_contact():
    pressures = jnp.array([1e9, 2.1e9, 0.0]), jnp.array([0.5e9, 1e9, 0.0])
    np.testing.assert_allclose(contact_safety(*pressures, "ball"), 8.0, rtol=1e-14)
    np.testing.assert_allclose(contact_safety(*pressures, "roller"), (4.0 / 2.1) ** 2, rtol=1e-14)
    assert np.isinf(contact_safety(jnp.zeros(3), jnp.zeros(3), "ball"))


def test_static_safety_of_rollers_by_laminae():
    """q0/q of the most loaded lamina with q0 = 5 C0/(Z n_s cos(alpha)): ISO 17956 as a public project reports it."""
    count, size, pitch, length, angle, laminae = 17, 10.5e-3, 69e-3, 14.8e-3, np.radians(15.6), 30
    limit = 5.0 * roller_static_capacity(count, size, pitch, length, angle) / (count * laminae * np.cos(angle))
    radius = 0.5 * size * (1.0 - size * np.cos(angle) / pitch)
    pressure = LineContact(radius, length / laminae, STEEL_MODULUS).hertz_pressure(limit / jnp.array([2.5, 4.0]))
    np.testing.assert_allclose(contact_safety(pressure, 0.5 * pressure, "roller"), 2.5, rtol=1e-12)


def test_angular_contact_bearing_under_both_loads():
    """Everything that a catalogue's reader computes, from one solve."""
    rating = Rating(viscosity_ratio=1.5, contamination_factor=0.5)
    scene = jb.load_scene("angular_contact_218").replace({"rating": rating})
    life = jb.solve(scene).life
    radial = float(scene.operation.radial_load or 0.0)
    axial = float(scene.operation.axial_load or 0.0)
    load = max(radial, 0.35 * radial + 0.57 * axial)
    np.testing.assert_allclose(life.catalogue_load, load, rtol=1e-12)
    np.testing.assert_allclose(life.static_load, max(radial, 0.5 * radial + 0.26 * axial), rtol=1e-12)
    np.testing.assert_allclose(life.L10, (life.dynamic_capacity / load) ** 3, rtol=1e-12)
    np.testing.assert_allclose(life.static_safety, life.static_capacity / life.static_load, rtol=1e-14)
    np.testing.assert_allclose(life.minimum_load, 0.01 * life.dynamic_capacity, rtol=1e-14)
    ratio = 0.5 * float(life.fatigue_load_limit) / load
    factor = min(0.1 * max(1.0 - (2.5671 - 1.9987 * 1.5**-0.071739) ** 0.83 * ratio ** (1 / 3), 0.05) ** -9.3, 50.0)
    np.testing.assert_allclose(life.L10m, factor * life.L10, rtol=1e-10)
    np.testing.assert_allclose(life.L10mh / life.L10h, factor, rtol=1e-10)


def test_a_factor_of_contamination_is_that_of_its_class():
    scene = jb.load_scene("reference_roller").replace(dict.fromkeys(("contact", "cage", "flange", "drag")))
    by_class = jb.solve(scene.replace({"rating": Rating(viscosity_ratio=1.5, cleanliness="grease_normal")})).life
    factor = float(contamination_factor(1.5, scene.geometry.pitch_diameter, "grease_normal"))
    np.testing.assert_allclose(by_class.contamination_factor, factor, rtol=1e-14)
    given = jb.solve(scene.replace({"rating": Rating(viscosity_ratio=1.5, contamination_factor=factor)})).life
    np.testing.assert_allclose(given.Lnmr, by_class.Lnmr, rtol=1e-12)
    np.testing.assert_allclose(given.L10m, by_class.L10m, rtol=1e-12)
    np.testing.assert_allclose(given.minimum_load, 0.02 * given.dynamic_capacity, rtol=1e-14)
    with pytest.raises(ValueError, match=r"rating\.contamination_factor: expected none beside rating\.cleanliness"):
        Rating(cleanliness="grease_normal", contamination_factor=0.5)
    with pytest.raises(ValueError, match=r"rating\.contamination_factor must be above 0 and at most 1"):
        Rating(contamination_factor=1.2)
    unknown = dataclasses.replace(given, viscosity_ratio=None)
    (note,) = ineffective_inputs(scene.replace({"rating": Rating(contamination_factor=0.5)}), unknown)
    assert note.startswith("rating.contamination_factor has no effect without")


def test_loads_of_the_catalogue():
    """Those that are given, those that hold a displaced ring, and none under a moment."""
    force = jnp.array([-300.0, 3.0, 4.0, 0.0, 0.0])
    both = BallOperation(1.0, radial_load=1500.0, radial_load_lateral=2000.0, axial_load=-200.0)
    np.testing.assert_allclose(sizes_of_loads(both), [2500.0, 200.0], rtol=1e-14)
    np.testing.assert_allclose(sizes_of_loads(BallOperation(1.0, radial_load=1500.0), force), [1500.0, 0.0])
    free = BallOperation(1.0, radial_load=1500.0, axial_load=200.0, moment=0.0, moment_lateral=0.0)
    np.testing.assert_allclose(sizes_of_loads(free), [1500.0, 200.0])
    tilted = BallOperation(1.0, radial_load=1500.0, axial_load=200.0, moment=1e-3)
    assert np.all(np.isnan(sizes_of_loads(tilted)))
    held = BallOperation(1.0, radial_load=1500.0, displacement={"axial": 1e-6})
    np.testing.assert_allclose(sizes_of_loads(held, force), [1500.0, 300.0])
    across = BallOperation(1.0, axial_load=200.0, displacement={"radial": 1e-6})
    np.testing.assert_allclose(sizes_of_loads(across, force), [5.0, 200.0])
    assert sizes_of_loads(held) == (None, None)
