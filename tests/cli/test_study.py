"""`jaxbearing study` through the command line. Its numbers: tests/bearings/cylindrical/test_claims.py."""

import json

import numpy as np
import pytest
import xarray as xr

import jaxbearing as jb


def test_refuses_what_has_no_power_loss(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "turbine_roller", "--set", "cage=none", "--set", "contact.traction=none")
    assert code == 2
    assert "without power loss" in err


def test_refuses_other_scenes(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "two_disk_etm")
    assert code == 2
    assert "expected a cylindrical roller or ball bearing" in err


def test_refuses_a_picture_of_another_kind(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "--plot", "page.txt")
    assert code == 2
    assert "--plot" in err


@pytest.mark.slow
def test_the_source_s_bearing(jaxbearing_command, folder):
    result = jaxbearing_command("study", "reference_roller", "--json", "--out", "a.nc", "--plot", "a.png")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert (found["failed"], found["left_out"]) == (0, [])
    assert [claim["number"] for claim in found["claims"]] == list(range(1, 13))
    assert sum(claim["holds"] for claim in found["claims"]) == 6
    tree = xr.open_datatree(folder / "a.nc")
    assert {group.removeprefix("/figure_") for group in tree.groups[1:]} == set(found["figures"])
    for name, figure in found["figures"].items():
        losses = {key: np.asarray(value) for key, value in figure.items() if key.startswith("power_loss_")}
        total = losses.pop("power_loss_total")
        np.testing.assert_allclose(sum(losses.values()), total, rtol=1e-12)
        np.testing.assert_array_equal(tree[f"figure_{name}"].power_loss_total, total)
    speeds = found["figures"]["39b"]["fields"]["operation.inner_speed"]
    alone = jb.solve(jb.load_scene("reference_roller").at_operation(inner_speed=speeds[0])).power_loss
    np.testing.assert_allclose(found["figures"]["39b"]["power_loss_drag"][0], alone.drag, rtol=1e-9)
    assert (folder / "a.png").stat().st_size > 50_000


@pytest.mark.slow
def test_what_is_not_there_is_left_out(jaxbearing_command):
    """No flange and no oil flow: neither their figures nor what the source says of them; the rest is judged."""
    result = jaxbearing_command(
        "study", "reference_roller", "--set", "flange=none", "--set", "operation.oil_flow=0 l/h"
    )
    assert (result.code, result.err) == (0, "")
    for words in ("operation.oil_flow is zero", "no flange.angle", "left out", "by location against speed"):
        assert words in " ".join(result.out.split())


@pytest.mark.slow
def test_ball_bearing(jaxbearing_command):
    """Quick laws; the source says nothing on it."""
    result = jaxbearing_command("study", "turbine_ball", "--set", "kinematics.attitude=outer", "--json")
    found = json.loads(result.out)
    assert (result.code, found["claims"], found["failed"]) == (0, [], 0)
    assert {"36", "37", "38", "39c", "40a", "40b", "40c"} <= set(found["figures"])
    assert np.all(np.diff(found["figures"]["39b"]["power_loss_total"]) > 0)
