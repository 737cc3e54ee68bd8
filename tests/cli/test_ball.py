"""`solve` of ball bearings: screen, JSON, files, refusals, exit codes."""

import json
import os

import numpy as np
import pytest
import xarray as xr

ELEMENTS = (
    *("azimuth", "load_inner", "load_outer", "contact_angle_inner", "contact_angle_outer", "pressure_inner"),
    *("pressure_outer", "orbital_speed", "spin_speed", "attitude_angle", "raceway_control"),
)


def test_screen(jaxbearing_command):
    result = jaxbearing_command("solve", "angular_contact_218", "--full")
    assert (result.code, result.err) == (0, "")
    for word in ("CONVERGED", "16 of 16 balls", "Contact angles", "43.13 deg", "raceway control 100.0 %", "all"):
        assert word in result.out
    assert max(map(len, result.out.splitlines())) <= 100


@pytest.mark.slow
def test_json_and_files(jaxbearing_command, folder):
    arguments = ("solve", "deep_groove_6205", "--json", "--plot", "a.svg", "--out", "a.nc")
    result = jaxbearing_command(*arguments)
    assert (result.code, result.err) == (0, "")
    assert sorted(os.listdir(folder)) == ["a.nc", "a.svg"]
    solution = json.loads(result.out)
    assert (solution["converged"], solution["status"], solution["warnings"]) == (True, "converged", [])
    assert all(len(solution["elements"][name]) == 9 for name in ELEMENTS)
    assert set(solution["ring"]) == {"axial", "radial", "lateral", "tilt", "tilt_lateral"}
    stiffness = np.array(solution["stiffness"], dtype=float)  # no null: the model has all entries
    assert stiffness.shape == (5, 5)
    assert np.all(np.diag(stiffness) > 0.0)
    assert solution["operation"]["moment"] == 0.0
    assert solution["operation"]["oil_temperature"] is None
    with xr.open_dataset(folder / "a.nc") as dataset:
        assert all(variable.attrs["units"] for variable in dataset.variables.values())
        np.testing.assert_array_equal(dataset["load_inner"], solution["elements"]["load_inner"])


@pytest.mark.parametrize(
    ("scene", "change", "path", "words"),
    [
        ("angular_contact_218", "geometry.contact_angle=none", "geometry.contact_angle", ["neither"]),
        ("angular_contact_218", "geometry.contact_angle=95 deg", "geometry.contact_angle", ["below 90 deg"]),
        ("angular_contact_218", "geometry.n_balls=40", "geometry.n_balls", ["do not fit"]),
        (
            "angular_contact_218",
            "geometry.conformity_inner=0.49",
            "geometry.conformity_inner",
            ["above 0.5"],
        ),
        ("angular_contact_218", "operation.axial_load=none", "operation.axial_load", ["needs an axial_load"]),
        ("angular_contact_218", "operation.axial_load=0 N", "operation.axial_load", ["all loads are 0"]),
        ("angular_contact_218", "kinematics.attitude=equilibrium", "kinematics.attitude", ["needs traction"]),
        ("angular_contact_218", "kinematics.attitude=out", "kinematics.attitude", ["'outer'"]),
        ("angular_contact_218", "kinematics.gyroscopic=on", "kinematics.gyroscopic", ["'capped'"]),
        ("deep_groove_6205", "operation.misalignment=1 mrad", "operation.misalignment", ["operation.moment"]),
        ("turbine_ball", "oil=none", "oil", ["[contact] needs"]),
        ("turbine_ball", "operation.oil_flow=none", "operation.oil_flow", ["[drag] needs"]),
        ("turbine_ball", "cage.inner_diameter=100 mm", "cage.inner_diameter", ["must lie between"]),
        ("turbine_ball", "operation.inner_speed=0 rpm", "operation.inner_speed", ["turn against each other"]),
        ("turbine_ball", "contact.thermal=hsu_lee", "contact.thermal", ["'gupta'"]),
        ("turbine_ball", "cage.pocket_axial_clearance=1 mm", "cage.pocket_axial_clearance", ["unknown name"]),
    ],
)
def test_bad_input(scene, change, path, words, jaxbearing_command, folder):
    result = jaxbearing_command("solve", scene, "--set", change, "--out", "a.nc")
    assert (result.code, result.out) == (2, "")
    assert "Traceback" not in result.err
    assert path in result.err
    for word in words:
        assert word in " ".join(result.err.split())
    assert not os.listdir(folder)
