"""The steady cylindrical roller bearing against check values from independent implementations."""

import numpy as np
import pytest
from roller_cases import PUBLISHED, RPM, changed, dry_roller, reference_roller

import jaxbearing as jb

QUASI_STATIC = PUBLISHED["quasi_static"]


@pytest.mark.parametrize("row", QUASI_STATIC["row"], ids=lambda row: row["name"])
def test_quasi_static_rows(row):
    solution = jb.solve(changed(reference_roller(), row["change"]))
    ours = {
        "cage_speed": solution.cage.speed,
        "slip": solution.cage.slip,
        "load_max": solution.elements.load_inner.max(),
        "eccentricity": solution.cage.eccentricity_ratio,
        "total": solution.power_loss.total,
    }
    locations = ("inner_raceway", "outer_raceway", "pocket", "flange", "element_ends", "cage_pilot", "drag")
    ours |= {name: getattr(solution.power_loss, name) for name in locations}
    for name, value in ours.items():
        np.testing.assert_allclose(value, row[name], rtol=QUASI_STATIC["rtol"], err_msg=name)
    np.testing.assert_allclose(solution.drive_power, row["total"], rtol=QUASI_STATIC["rtol"])


def test_nominal_spins_and_displacement():
    solution = jb.solve(reference_roller())
    np.testing.assert_allclose(solution.elements.spin_speed[0], QUASI_STATIC["spin_loaded"], rtol=1e-6)
    np.testing.assert_allclose(solution.elements.spin_speed[15], QUASI_STATIC["spin_unloaded"], rtol=1e-6)
    np.testing.assert_allclose(solution.ring.radial, QUASI_STATIC["ring_radial"], rtol=1e-6)


@pytest.mark.parametrize("row", PUBLISHED["closures"]["row"], ids=lambda row: f"{row['radial_load']:g} N")
def test_cage_slip_of_the_mean_pressure_closure(row):
    for coefficient, percent in zip(PUBLISHED["closures"]["drag_coefficients"], row["slip_percent"], strict=True):
        scene = reference_roller().replace(
            {"operation.radial_load": row["radial_load"], "drag.coefficient": coefficient}
        )
        # printed with two or three digits
        digits = 0.5 * 10.0 ** -(len(str(percent).split(".")[1]))
        np.testing.assert_allclose(100 * jb.solve(scene).cage.slip, percent, atol=1.02 * digits)


@pytest.mark.parametrize("row", PUBLISHED["trends"]["row"], ids=lambda row: str(row["change"]))
def test_total_power_of_single_changes(row):
    total = jb.solve(changed(reference_roller(), row["change"])).power_loss.total
    # rounded to 1 W
    np.testing.assert_allclose(total, row["total"], rtol=PUBLISHED["trends"]["rtol"], atol=0.5)


@pytest.mark.parametrize("row", PUBLISHED["dry"]["row"], ids=lambda row: f"{row['radial_load']:g} N")
def test_dry_load_distribution(row):
    scene = dry_roller().replace(
        {
            "operation.radial_load": row["radial_load"],
            "operation.inner_speed": row["rpm"] * RPM,
            "geometry.diametral_clearance": row["diametral_clearance"],
        }
    )
    solution = jb.solve(scene)
    load = np.asarray(solution.elements.load_inner)
    rtol = PUBLISHED["dry"]["rtol"]
    np.testing.assert_allclose(solution.ring.radial, row["ring"], rtol=rtol)
    np.testing.assert_allclose(solution.elements.load_outer - load, row["centrifugal"], rtol=rtol)
    for index, value in row["loads"].items():
        np.testing.assert_allclose(load[int(index)], value, rtol=rtol)
    assert np.sum(load > 0) == row["loaded"]
