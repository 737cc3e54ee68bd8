"""Four-point bearings on a shaft, on their seats and with the temperatures of their parts."""

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.numerics.newton import NewtonOptions
from jaxbearing.shafts import MountedBearing, PointLoad, Shaft, ShaftSystem

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
