"""`solve` of the tapered roller bearing: screen, JSON with the fixed keys, refusals, no equilibrium; lives."""

import json
import sys

import numpy as np
import pytest
from filled_results import solution_of

LEFT_OUT = [word for name in ("contact", "drag", "rating") for word in ("--set", f"{name}=none")]
DRY = ("solve", "tapered_example", *LEFT_OUT, "--set", "operation.moment=0 N*m")
"""The load acts at the apex."""
CENTRED = (*DRY, "--set", "operation.load_position=-110 mm")


def test_screen_and_files(jaxbearing_command, folder):
    result = jaxbearing_command("solve", "tapered_example", "--plot", "a.png", "--out", "a.nc")
    assert (result.code, result.err) == (0, "")
    for word in (
        "CONVERGED",
        "Rib",
        "sliding",
        "flange",
        "Drive power",
        "Life",
        "L10r",
        "Rating",
        "kappa",
        "axial displacement",
        "about the apex",
    ):
        assert word in result.out
    assert max(map(len, result.out.splitlines())) <= 100
    assert (folder / "a.png").stat().st_size > 1000
    assert (folder / "a.nc").stat().st_size > 1000


def test_json(jaxbearing_command, folder):
    result = jaxbearing_command("solve", "tapered_example", "--json")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert found["converged"] is True
    assert found["cage"] is None
    assert np.array(found["stiffness"], dtype=float).shape == (5, 5)
    assert set(found["ring"]) == {"axial", "radial", "lateral", "tilt", "tilt_lateral"}
    for name in ("load_inner", "load_outer", "load_flange", "film_inner", "pressure_outer", "contact_angle_outer"):
        assert len(found["elements"][name]) == 17
    np.testing.assert_allclose(found["elements"]["load_inner"][0], 2452.596, rtol=3e-7)
    assert found["life"]["L10r"] > 0
    assert found["life"]["L10r_hours"] > 0
    losses = found["power_loss"]
    assert set(losses) == {"total", "rolling_resistance", "flange", "drag"}
    assert min(losses.values()) > 0
    np.testing.assert_allclose(sum(losses.values()), 2 * losses["total"], rtol=1e-12)
    np.testing.assert_allclose(found["drive_power"], losses["total"], rtol=1e-12)
    np.testing.assert_allclose(found["inner_torque"] * 100 * np.pi, losses["total"], rtol=1e-12)  # 3000 rpm


def test_idle_rollers_and_dry_ones(jaxbearing_command, folder):
    """A roller that touches nothing has no film; a scene without friction no losses: both null."""
    result = jaxbearing_command(
        "solve", "tapered_example", "--set", "operation.axial_load=3 kN", "--plot", "a.png", "--json"
    )
    assert (result.code, result.err) == (0, "")
    elements = json.loads(result.out)["elements"]
    assert elements["load_inner"][8] == 0.0
    assert elements["film_inner"][8] is None
    assert elements["film_inner"][0] > 0
    assert elements["traction_inner"][8] is None
    screen = jaxbearing_command("solve", "tapered_example", "--set", "operation.axial_load=3 kN")
    assert "nan" not in screen.out
    found = json.loads(jaxbearing_command(*CENTRED, "--json").out)
    assert found["power_loss"] == {"total": None}
    assert (found["drive_power"], found["inner_torque"], found["converged"]) == (None, None, True)
    assert "Power" not in jaxbearing_command(*CENTRED, "--plot", "b.png", "--out", "b.nc").out


def test_no_equilibrium(jaxbearing_command, folder):
    result = jaxbearing_command("solve", "tapered_example", "--set", "operation.radial_load=21 kN", "--json")
    assert result.code == 3
    found = json.loads(result.out)
    assert (found["converged"], found["status"]) == (False, "no_equilibrium")
    assert found["elements"]["load_inner"] is None or None in found["elements"]["load_inner"]
    assert "no_equilibrium" in result.err
    assert found["iterations"] == 0  # the loads alone tell


def test_a_catalogue_life_needs_no_equilibrium(jaxbearing_command, folder):
    """A radial load alone opens the bearing, P = F_r: no results, but the life of the catalogue, and the way to hold
    the ring. A load with an equilibrium, and one that the bearing cannot carry, have no such line."""
    alone = ("--set", "operation.axial_load=0 N", "--set", "operation.radial_load=5 kN")
    found = json.loads(jaxbearing_command("solve", "tapered_example", *alone, "--json").out)
    assert (found["converged"], found["life"]["L10"], found["ring"]["axial"]) == (False, None, None)
    life = found["catalogue_life"]
    assert life["catalogue_load"] == 5e3
    np.testing.assert_allclose(life["L10"], (life["dynamic_capacity"] / 5e3) ** (10.0 / 3.0), rtol=1e-12)
    np.testing.assert_allclose(life["L10h"], life["L10"] * 1e6 / (60.0 * 3000.0), rtol=1e-12)
    result = jaxbearing_command("solve", "tapered_example", *alone)
    said = " ".join(result.out.split())
    assert result.code == 3
    assert "operation.displacement.axial" in said
    assert f"Catalogue life needs no equilibrium: ISO 281 L10 {life['L10h']:.0f} h" in said
    for change in ("operation.axial_load=5 kN", "operation.axial_load=-5 kN"):
        result = jaxbearing_command("solve", "tapered_example", "--set", change, "--json")
        assert "catalogue_life" not in json.loads(result.out)


def test_a_moment_about_the_apex_is_warned_of(jaxbearing_command, folder):
    """The radial load then has a lever of 110 mm, which no cup can hold: on the screen with the reason."""
    result = jaxbearing_command(*DRY)
    said = " ".join(result.out.split() + result.err.split())
    assert result.code == 3
    assert "proved by the loads alone" in said
    assert "operation.load_position is 0" in said


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("geometry.n_rollers=30", ["geometry.n_rollers", "do not fit"]),
        ("geometry.flange_angle=13 deg", ["geometry.flange_angle", "below its axis"]),
        ("operation.axial_load=none", ["operation.axial_load", "a force"]),
        ("rating.reliability=0.94", ["rating.reliability", "0.95"]),
        ("rating.cleanliness=dirty", ["rating.cleanliness", "grease_normal"]),
        ("rating.roughness_rings=0.2 um", ["rating.roughness_elements"]),
        ("profile.shape=logarithmic", ["profile.drop", "8 um"]),
        ("operation.oil_flow=none", ["operation.oil_flow", "[drag]"]),
        ("contact.flange_film=moes", ["contact.flange_film", "chittenden"]),
    ],
)
def test_bad_input(change, words, jaxbearing_command, folder):
    result = jaxbearing_command("solve", "tapered_example", "--set", change)
    assert (result.code, result.out) == (2, "")
    for word in words:
        assert word in result.err


def test_life_of_the_other_kinds(jaxbearing_command, folder, monkeypatch):
    changes = ("--set", "rating.dynamic_capacity=14 kN", "--set", "operation.moment=none")
    ball = json.loads(jaxbearing_command("solve", "deep_groove_6205", "--json", *changes).out)
    assert ball["life"]["dynamic_capacity"] == 14e3
    assert ball["life"]["L10r"] > 0
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)
    without = json.loads(jaxbearing_command("solve", "deep_groove_6205", "--json").out)
    assert without["life"] is None


def test_misaligned_cylindrical_rollers(jaxbearing_command, folder):
    dry = [word for name in ("contact", "oil", "cage", "flange", "drag") for word in ("--set", f"{name}=none")]
    profile = ("--set", "profile.shape=logarithmic", "--set", "profile.drop=5 um", "--set", "rating.n_laminae=30")
    tilt = ("--set", "operation.misalignment=1 mrad")
    result = jaxbearing_command("solve", "turbine_roller", *dry, *profile, *tilt, "--json")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert found["ring"]["tilt"] == pytest.approx(1e-3)
    assert found["life"]["L10r"] > 0
    moving = jaxbearing_command("simulate", "turbine_roller_dynamic", *tilt)
    assert moving.code == 2
    assert "operation.misalignment: found the text '1 mrad'; expected none in a transient" in " ".join(
        moving.err.split()
    )
