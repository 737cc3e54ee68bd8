"""`stiffness`: screen, JSON, the file for ROSS, refusals, exit codes."""

import json
import os
import tomllib

import numpy as np
import pytest

SPEEDS = ("--speeds", "2000 rpm:10000 rpm:3")
RPM = 2.0 * np.pi / 60.0


def test_screen_and_file(jaxbearing_command, folder):
    arguments = ("stiffness", "angular_contact_218", *SPEEDS, "--set", "operation.axial_load=10 kN")
    result = jaxbearing_command(*arguments, "--ross", "a.toml")
    assert (result.code, result.err) == (0, "")
    for word in ("CONVERGED", "3 speeds", "axial", "lateral", "N m/mrad", "N/um", "2000", "10000", "wrote a.toml"):
        assert word in result.out
    assert max(map(len, result.out.splitlines())) <= 100
    assert os.listdir(folder) == ["a.toml"]
    text = (folder / "a.toml").read_text(encoding="utf-8")
    assert "# Scene: angular_contact_218 --set operation.axial_load=10 kN" in text
    element = tomllib.loads(text)["BearingElement_angular_contact_218"]
    np.testing.assert_allclose(element["speed"], np.array([2000.0, 6000.0, 10000.0]) * RPM, rtol=1e-14)


def test_json_and_load_direction(jaxbearing_command, folder):
    arguments = ("stiffness", "deep_groove_6205", *SPEEDS, "--json", "--force", "--ross", "a.toml")
    found = {}
    for direction in ("-90 deg", "0 deg"):
        result = jaxbearing_command(*arguments, "--load-direction", direction)
        assert (result.code, result.err) == (0, "")
        found = json.loads(result.out)
        assert set(found) == {"converged", "failure", "speed", "stiffness", "freedom", "modelled", "warnings"}
        assert found["converged"] is True
        stiffness = np.array(found["stiffness"], dtype=float)
        assert stiffness.shape == (3, 5, 5)
        element = tomllib.loads((folder / "a.toml").read_text(encoding="utf-8"))["BearingElement_deep_groove_6205"]
        loaded = "kyy" if direction == "-90 deg" else "kxx"
        np.testing.assert_allclose(element[loaded], stiffness[:, 1, 1], rtol=1e-12)
    assert os.listdir(folder) == ["a.toml"]


@pytest.mark.usefixtures("failing_solve")
def test_not_converged(jaxbearing_command, folder):
    arguments = ("stiffness", "angular_contact_218", *SPEEDS, "--ross", "a.toml")
    screen = jaxbearing_command(*arguments)
    assert screen.code == 3
    assert "NOT CONVERGED" in screen.out
    assert "2000.0 rpm" in screen.out
    assert screen.err == "not written: a.toml\n"
    as_json = jaxbearing_command(*arguments, "--json")
    assert as_json.code == 3
    assert json.loads(as_json.out)["converged"] is False
    assert "2000.0 rpm" in json.loads(as_json.out)["failure"]
    assert "not converged: angular_contact_218" in as_json.err
    assert not os.listdir(folder)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--speeds", "2000 rpm"), ["--speeds", "FIRST:LAST:NUMBER"]),
        (("--speeds", "2000:9000:4"), ["--speeds", "a number without a unit"]),
        (("--speeds", "2000 rpm:9000 N:4"), ["--speeds", "a rotational speed"]),
        (("--speeds", "-5 rpm:9000 rpm:4"), ["--speeds", ">= 0"]),
        (("--speeds", "9000 rpm:2000 rpm:4"), ["first speed below the last"]),
        (("--speeds", "2000 rpm:9000 rpm:1"), ["from 2 to"]),
        (("--speeds", "2000 rpm:9000 rpm:2.5"), ["from 2 to"]),
        (("--speeds", "2000 rpm:9000 rpm:99999999"), ["from 2 to"]),
        ((*SPEEDS, "--load-direction", "3 m"), ["--load-direction", "an angle"]),
        ((*SPEEDS, "--ross", "a.nc"), ["--ross", ".toml"]),
        ((*SPEEDS, "--ross", "no/a.toml"), ["--ross", "existing folder"]),
        ((*SPEEDS, "--set", "operation.axial_load=1 m"), ["operation.axial_load"]),
        ((), ["--speeds"]),
    ],
)
def test_bad_input(arguments, words, jaxbearing_command, folder):
    result = jaxbearing_command("stiffness", "angular_contact_218", *arguments)
    assert (result.code, result.out) == (2, "")
    assert result.err.count("\n") == 1
    for word in words:
        assert word in result.err
    assert not os.listdir(folder)


def test_scenes_without_a_stiffness(jaxbearing_command):
    two_disk = jaxbearing_command("stiffness", "two_disk_etm", *SPEEDS)
    assert (two_disk.code, two_disk.out) == (2, "")
    assert "expected a bearing" in two_disk.err
    at_rest = jaxbearing_command("stiffness", "turbine_roller", "--speeds", "0 rpm:1000 rpm:4")
    assert (at_rest.code, at_rest.out) == (2, "")
    assert "turn against each other" in at_rest.err


def test_unwritable_file_is_said_before_solving(jaxbearing_command, folder, monkeypatch):
    def refused(path):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("jaxbearing.cli.output_files.try_to_write", refused)
    monkeypatch.setattr("jaxbearing.report.stiffness.stiffness_over_speed", lambda *_, **__: pytest.fail("solved"))
    result = jaxbearing_command("stiffness", "angular_contact_218", *SPEEDS, "--ross", "a.toml")
    assert (result.code, result.out) == (1, "")
    assert "cannot be written: a.toml: Permission denied" in result.err
    assert not os.listdir(folder)
