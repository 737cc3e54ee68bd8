"""Four-point bearings on a shaft, on their seats and with the temperatures of their parts."""

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.parts import Materials
from jaxbearing.materials import Material
from jaxbearing.numerics.newton import NewtonOptions
from jaxbearing.shafts import MatchedSet, MountedBearing, PointLoad, Preload, Shaft, ShaftSystem

LOADS = {"axial_load": 3e3, "radial_load": 1e3, "moment": 10.0}
SEATED = {
    "materials.rings": "52100",
    "materials.balls": "52100",
    "geometry.bore": "45 mm",
    "geometry.outside_diameter": "100 mm",
    "geometry.width": "25 mm",
    "fits.shaft_tolerance": "k5",
    "fits.housing_tolerance": "J7",
    "fits.at": "mean",
    "fits.housing_outside": "140 mm",
    "oil.name": "mobil_jet_ii",
    "oil.heat_capacity": "2150 J/(kg*K)",
    "contact.film": "nijenbanning",
    "contact.thermal": "gupta",
    "contact.rolling_resistance": "source_86",
    "thermal.nodes": "4",
    "thermal.ambient": "20 degC",
    "operation.oil_temperature": "40 degC",
    "operation.oil_flow": "20 l/h",
    "rating": "none",
}

STEEL = Material(207e9, 0.3, 7850.0)
FOUR = jb.load_scene("four_point_qj").geometry
LOADED = ("load_inner", "load_outer", "contact_angle_inner", "contact_angle_outer", "orbital_speed")
RPM = np.pi / 30.0


@pytest.mark.slow
def test_alone_on_a_rigid_shaft():
    """The shaft is carried as the ring of the bearing alone, to first order in the tilt: displacements and loads."""
    scene = jb.load_scene("four_point_qj", {"operation.inner_speed": "0 rpm", "operation.moment": "10 N*m"})
    scene = scene.at_operation(**LOADS)
    alone = scene.solve_ring(NewtonOptions(), None, False)
    force = PointLoad("load", 0.0, axial=LOADS["axial_load"], radial=LOADS["radial_load"], moment=LOADS["moment"])
    shaft = ShaftSystem(Shaft(0.0), bearings=[MountedBearing("A", scene, 0.0)], forces=[force])
    found = jb.solve(shaft).bearings["A"]
    for name in ("axial", "radial", "tilt"):
        np.testing.assert_allclose(getattr(found.ring, name), getattr(alone.ring, name), rtol=1e-7)
    for name in ("load_inner", "load_inner_second", "load_outer", "load_outer_second"):
        there = getattr(alone.elements, name)
        np.testing.assert_allclose(getattr(found.solution.elements, name), there, atol=1e-6 * np.max(there) + 1e-9)


@pytest.mark.slow
def test_growth_closes_the_play():
    """A tight seat and a hotter inner ring take clearance between four contacts."""
    seats = {name: value for name, value in SEATED.items() if name.startswith(("geometry", "fits", "materials"))}
    hot = {"temperatures.inner_ring": "80 degC", "temperatures.outer_ring": "60 degC"}
    plain = jb.solve(jb.load_scene("four_point_qj"))
    seated = jb.solve(jb.load_scene("four_point_qj", seats))
    warm = jb.solve(jb.load_scene("four_point_qj", seats | hot))
    np.testing.assert_allclose(seated.fit.drawn, 30e-6, rtol=1e-12)
    assert float(warm.fit.clearance) < float(seated.fit.clearance) < 30e-6
    # less play: nearer to the middle under the same thrust
    assert float(warm.ring.axial) < float(seated.ring.axial) < float(plain.ring.axial)


@pytest.mark.slow
def test_thermal_state():
    """Temperatures of four nodes are results; what leaves as heat is the power loss."""
    found = jb.solve(jb.load_scene("four_point_qj", SEATED))
    total = float(found.power_loss.total)
    np.testing.assert_allclose(found.drive_power, total, rtol=1e-8)
    np.testing.assert_allclose(found.thermal.heat_to_oil + found.thermal.heat_to_ambient, total, rtol=1e-8)
    # between the ambient and what friction would heat it to: cold surroundings take more than friction gives here
    assert 293.15 < float(found.thermal.temperatures.inner_ring) < 373.15


def dry(two_arcs):
    """The bearing of the scene with two arcs on each ring, or with one and the same contact angle."""
    angle = np.arctan2(float(FOUR.free_sine), float(FOUR.free_cosine))
    sizes = (12, 72.5e-3, 17.4625e-3, 0.525, 0.525)
    geometry = FOUR if two_arcs else jb.BallGeometry(*sizes, contact_angle=angle)
    operation = BallOperation(0.0, axial_load=1e3)
    return BallBearing(geometry, BallMaterials(STEEL, STEEL), operation, BallAttitude("linear_slip"))


def plane_apart():
    """By how much the plane of the inner groove centres lies nearer to the middle of the ring that has two arcs, m."""
    return float(FOUR.arcs.inner - FOUR.inner_offset * FOUR.free_sine)


def half_play():
    return float(FOUR.centre_distance * FOUR.free_sine - sum(FOUR.arcs))


def agree(four, two):
    """Loads and motion of bearings whose second flanks are open; displacements count from the middle of the play."""
    assert np.max(np.asarray(four.solution.elements.load_inner_second)) == 0.0
    for name in LOADED:
        here, there = getattr(four.solution.elements, name), getattr(two.solution.elements, name)
        np.testing.assert_allclose(here, there, rtol=1e-8)
    np.testing.assert_allclose(four.ring.tilt, two.ring.tilt, rtol=1e-7, atol=1e-12)


@pytest.mark.slow
def test_on_a_shaft_as_with_two_contacts():
    """A located bearing beside a roller bearing: as long as the thrust keeps the second flanks open, forces, loads and
    displacements are those of the bearing with one arc on each ring. Forces and moments balance."""
    rollers = jb.load_scene("reference_roller").geometry
    floating = CylindricalRollerBearing(rollers, Materials(STEEL, STEEL), Operation(0.0, radial_load=1e3))
    found = []
    for scene, place in ((dry(True), 0.0), (dry(False), plane_apart())):
        bearings = [MountedBearing("A", scene, place), MountedBearing("B", floating, 0.2)]
        force = PointLoad("gear", 0.05, axial=6e3, radial=2e3)
        found.append(jb.solve(ShaftSystem(Shaft(3000.0 * RPM), bearings=bearings, forces=[force])))
    four, two = found
    agree(four.bearings["A"], two.bearings["A"])
    np.testing.assert_allclose(four.bearings["A"].ring.axial - half_play(), two.bearings["A"].ring.axial, rtol=1e-7)
    np.testing.assert_allclose(four.bearings["B"].force, two.bearings["B"].force, rtol=1e-7, atol=1e-4)
    for solved in found:
        on_shaft = np.sum([one.on_shaft[:3] for one in solved.bearings.values()], axis=0)
        np.testing.assert_allclose(on_shaft, [-6e3, -2e3, 0.0], atol=1e-5)


@pytest.mark.slow
def test_set_as_with_two_contacts():
    """Two bearings against each other, preloaded by a force: each is loaded on one flank, as with one arc a ring."""
    found = []
    for scene, shift in ((dry(True), 0.0), (dry(False), plane_apart())):
        pair = MatchedSet("set", "<>", scene, 0.0, 60e-3 - 2.0 * shift, Preload(force=1e3))
        force = PointLoad("load", 0.0, axial=300.0, radial=500.0)
        found.append(jb.solve(ShaftSystem(Shaft(3000.0 * RPM), sets=[pair], forces=[force])))
    four, two = found
    for name in ("set.1", "set.2"):
        agree(four.bearings[name], two.bearings[name])
    for solved in found:
        on_shaft = np.sum([one.on_shaft[:3] for one in solved.bearings.values()], axis=0)
        np.testing.assert_allclose(on_shaft, [-300.0, -500.0, 0.0], atol=1e-5)
    closures = [float(solved.sets["set"].closure) for solved in found]
    np.testing.assert_allclose(closures[0] - half_play(), closures[1], rtol=1e-7)
