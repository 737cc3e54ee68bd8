"""Bearings whose rings are of two materials (`materials.inner_ring`)."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk
from support.tapered_cases import tapered
from support.warm_cases import BALLS

import jaxbearing as jb
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.line_contact_bridge import line_contact_of
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.cylindrical.geometry import RollerGeometry
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing, Operation
from jaxbearing.bearings.heat import heat_capacities
from jaxbearing.bearings.mounted import running_scene
from jaxbearing.bearings.parts import Materials
from jaxbearing.bearings.profile import RollerProfile, roller_line
from jaxbearing.life.static import STEEL_MODULUS, rated_modulus
from jaxbearing.materials import catalogue_material

STEEL, CERAMIC = catalogue_material("52100"), catalogue_material("Si3N4")
BALL = BallBearing(
    BallGeometry(16, 125.26e-3, 22.225e-3, 0.5232, 0.5182, contact_angle=np.radians(40.0)),
    BallMaterials(STEEL, STEEL),
    BallOperation(0.0, axial_load=10e3),
    BallAttitude("outer"),
)
ROLLER = CylindricalRollerBearing(
    RollerGeometry(13, 54e-3, 10e-3, 10e-3, 25e-6), Materials(STEEL, STEEL), Operation(0.0, radial_load=3e3)
)
INNER = "materials.inner_ring"
PRESSURES = ("pressure_inner", "pressure_outer")


def compliance(a, b):
    """1/E* of Johnson's *Contact Mechanics*, 1/Pa."""
    return sum((1.0 - body.poisson_ratio**2) / body.youngs_modulus for body in (a, b))


def hertz(load, short, long, soft):
    """Approach, m, and peak pressure, Pa, of bodies of the reduced radii `short` < `long`, m, by Johnson's *Contact
    Mechanics*, eqs. (4.25) to (4.28), with the elliptic integrals of scipy. `soft`: 1/E*."""

    def parts(axes):  # b/a
        m = 1.0 - axes**2
        first, second = ellipk(m), ellipe(m)
        return second / axes**2 - first, first - second, m, first

    axes = brentq(lambda x: parts(x)[0] / parts(x)[1] * short / long - 1.0, 1e-3, 0.999, xtol=1e-15, rtol=1e-14)
    above, below, m, first = parts(axes)
    a = np.cbrt(3.0 * load * np.sqrt(above * below * short * long) * soft / (np.pi * m))
    pressure = 1.5 * load / (np.pi * a**2 * axes)
    return pressure * axes * a * first * soft, pressure


def test_balls_by_the_formulas_of_hertz():
    """Thrust at rest: both approaches close the distance of the grooves. Loads and angles of both contacts are alike
    but for the least force on a ball, 1e-6 of the loads."""
    solution = jb.solve(BALL.replace({INNER: CERAMIC}))
    geometry, elements = BALL.geometry, solution.elements
    angle, approaches, ball = float(elements.contact_angle_inner[0]), 0.0, geometry.ball_diameter
    for ring, sense, conformity, name in ((CERAMIC, -1.0, 0.5232, "inner"), (STEEL, 1.0, 0.5182, "outer")):
        load = float(getattr(elements, f"load_{name}")[0])
        np.testing.assert_allclose(load, 10e3 / (16 * np.sin(angle)), rtol=2e-6)
        long, soft = conformity * ball / (2.0 * conformity - 1.0), compliance(ring, STEEL)
        short = lambda at, sense=sense: 0.5 * ball * (1.0 + sense * ball / geometry.pitch_diameter * np.cos(at))
        approaches += hertz(load, short(np.radians(40.0)), long, soft)[0]
        own = getattr(elements, f"contact_angle_{name}")[0]
        np.testing.assert_allclose(
            getattr(elements, f"pressure_{name}")[0], hertz(load, short(own), long, soft)[1], rtol=1e-9
        )
    distance = (0.5232 + 0.5182 - 1.0) * ball
    closed = distance * (np.cos(np.radians(40.0)) / np.cos(angle) - 1.0)
    np.testing.assert_allclose(approaches, closed, rtol=1e-4)
    oiled = dataclasses.replace(BALL, oil=jb.load_oil("mobil_jet_ii")).replace({INNER: CERAMIC})
    contact = line_contact_of(oiled, solution)
    assert contact.materials.body_1 == CERAMIC
    soft = np.pi * contact.geometry.reduced_radius_rolling * compliance(CERAMIC, STEEL)
    equivalent = np.sqrt(contact.operation.load_per_length / soft)
    np.testing.assert_allclose(equivalent, elements.pressure_inner[0], rtol=1e-9)


def test_rollers_by_the_formula_of_palmgren():
    """Rollers at rest: $0.39[4(1-\\nu_1^2)/E_1 + 4(1-\\nu_2^2)/E_2]^{0.9}Q^{0.9}/l^{0.8}$ of both contacts closes the
    clearance. The law has no radius: with the materials of the rings exchanged, loads and displacements stay, and the
    Hertz pressures are those of the other materials."""
    one = jb.solve(ROLLER.replace({INNER: CERAMIC}))
    load, soft = np.asarray(one.elements.load_inner), (compliance(CERAMIC, STEEL), compliance(STEEL, STEEL))
    closed = sum(0.39 * (4.0 * each) ** 0.9 for each in soft) * load**0.9 / 10e-3**0.8
    opened = float(one.ring.radial) * np.cos(np.asarray(one.elements.azimuth)) - 12.5e-6
    np.testing.assert_allclose(closed, np.maximum(opened, 0.0), atol=1e-15)
    loaded, radii = load > 0, (1.0 / (1.0 / 5e-3 + 1.0 / 22e-3), 1.0 / (1.0 / 5e-3 - 1.0 / 32e-3))
    for name, each, radius in zip(("inner", "outer"), soft, radii, strict=True):
        pressure = np.sqrt(load / (np.pi * radius * 10e-3 * each))
        np.testing.assert_allclose(getattr(one.elements, f"pressure_{name}")[loaded], pressure[loaded], rtol=1e-9)
    other = jb.solve(ROLLER.replace({"materials.rings": CERAMIC, INNER: STEEL}))
    np.testing.assert_allclose(other.elements.load_inner, load, rtol=1e-10)
    np.testing.assert_allclose(other.ring.radial, one.ring.radial, rtol=1e-12)


def test_lines_of_rollers_that_tilt():
    """Both races at once, or each by itself with its own modulus; two like them in series carry the same."""
    moduli = dataclasses.replace(ROLLER.materials, inner_ring=CERAMIC).race_modulus
    places = jnp.asarray([[4e-6, 5e-6], [2e-6, -1e-6]]), jnp.asarray([[1e-4, 0.0], [3e-4, 2e-4]])
    for profile in (None, RollerProfile()):
        both = roller_line(profile, moduli, 10e-3)
        together = [both.energy(*places), *both.load_and_moment(*places)]
        for race in (0, 1):
            alone = roller_line(profile, moduli[race, 0], 10e-3)
            place = [values[race] for values in places]
            for line in (alone, both.of_race(race)):
                each = [line.energy(*place), *line.load_and_moment(*place)]
                np.testing.assert_allclose([values[race] for values in together], each, rtol=1e-12)
                np.testing.assert_allclose(line.laminae(*place, 30), alone.laminae(*place, 30), rtol=1e-12)
        series = (
            np.mean(np.asarray(moduli) ** -0.9) ** (-10.0 / 9.0) * roller_line(profile, moduli[1, 0], 10e-3).stiffness
        )
        np.testing.assert_allclose(both.stiffness, series / moduli[1, 0], rtol=1e-12)


def _same(scene, rtol=1e-10):
    """An inner ring of the material of `rings` changes nothing; returns the results with one of ceramics."""
    plain, same, other = (jb.solve(scene.replace({INNER: one})) for one in (None, scene.materials.rings, CERAMIC))
    size = lambda values: np.max(np.abs(values), initial=0.0)
    for a, b in zip(jax.tree.leaves(plain.elements), jax.tree.leaves(same.elements), strict=True):
        np.testing.assert_allclose(a, b, rtol=0.0, atol=rtol * size(a))
    np.testing.assert_allclose(plain.stiffness, same.stiffness, rtol=0.0, atol=rtol * size(plain.stiffness))
    return plain, other


def test_inner_ring_of_the_same_material():
    for scene in (BALL, ROLLER):
        plain, other = _same(scene)
        stiffer = {name: np.max(getattr(other.elements, name) / getattr(plain.elements, name)[0]) for name in PRESSURES}
        assert stiffer["pressure_inner"] > 1.05 > stiffer["pressure_outer"]


@pytest.mark.slow
def test_inner_ring_of_the_same_material_where_rollers_tilt():
    """Under thrust alone, statics gives the loads of a tapered bearing: pressures go with the root of the modulus, at
    the rib, which is a part of the inner ring, with $E'^{2/3}$."""
    straight = ROLLER.replace({"profile": RollerProfile()})
    _, other = _same(straight)
    evenly = jb.solve(ROLLER.replace({INNER: CERAMIC}))
    np.testing.assert_allclose(other.elements.load_outer, evenly.elements.load_outer, rtol=1e-6, atol=1e-3)
    thrust = tapered(2e3).replace({"materials": Materials(STEEL, STEEL)})
    plain, other = _same(thrust)
    stiffer = compliance(STEEL, STEEL) / compliance(CERAMIC, STEEL)
    for name, power, rtol in (("inner", 1 / 2, 2e-2), ("outer", 0, 2e-2), ("flange", 2 / 3, 1e-3)):
        ratio = getattr(other.elements, f"pressure_{name}")[0] / getattr(plain.elements, f"pressure_{name}")[0]
        np.testing.assert_allclose(ratio, stiffer**power, rtol=rtol)


def test_rings_grow_and_store_heat_by_their_own_materials():
    """Loose rings at rest: each raceway grows by its own expansion; without one the field is named."""
    seats = {"fits.shaft_interference": "-40 um", "fits.housing_interference": "-40 um"}
    rest = {f"fits.{name}": "none" for name in ("shaft_tolerance", "housing_tolerance", "at")}
    changes = seats | rest | {INNER: "Si3N4", "operation.inner_speed": "0 rpm"}
    scene = jb.load_scene("deep_groove_6205_fitted", changes)
    fit = running_scene(scene)[1]
    assert fit is not None
    for growth, diameter, expansion, rise in zip(
        (fit.growth_inner, fit.growth_outer), scene.raceway_diameters, (3.2e-6, 12.5e-6), (60.0, 50.0), strict=True
    ):
        np.testing.assert_allclose(growth, expansion * rise * diameter, rtol=1e-9)
    with pytest.raises(ValueError, match=r"materials\.inner_ring\.thermal_expansion"):
        scene.replace({INNER: CERAMIC})
    network = jb.load_scene(
        "deep_groove_6205", BALLS | {"thermal.nodes": 4, "thermal.ambient": "20 degC", INNER: "Si3N4"}
    )
    steel, mixed = heat_capacities(network.replace({INNER: None})), heat_capacities(network)
    ratio = 3200.0 * 700.0 / (7830.0 * 460.0)
    np.testing.assert_allclose(mixed / steel, [ratio, 1.0, 1.0, 1.0], rtol=1e-12)
    with pytest.raises(ValueError, match=r"materials\.inner_ring\.conductivity"):
        network.replace({INNER: CERAMIC})


def test_static_rating_by_the_inner_contact():
    """E' of the rated contact over that of the rings' steel; a ring of the same steel changes nothing."""
    expected = STEEL_MODULUS * compliance(STEEL, STEEL) / compliance(CERAMIC, STEEL)
    np.testing.assert_allclose(rated_modulus(STEEL, STEEL, CERAMIC), expected, rtol=1e-14)
    assert rated_modulus(STEEL, CERAMIC, STEEL) == rated_modulus(STEEL, CERAMIC)


def test_scene_files_of_rings_of_two_materials(tmp_path):
    for name in ("deep_groove_6205", "turbine_roller", "tapered_example"):
        scene = jb.load_scene(name, {INNER: "Si3N4"})
        assert scene.materials.of_rings[0] == CERAMIC
        assert scene.materials.of_rings[1] == scene.materials.rings
        jb.save_scene(scene, tmp_path / "scene.toml")
        assert eqx.tree_equal(jb.load_scene(tmp_path / "scene.toml"), scene)
