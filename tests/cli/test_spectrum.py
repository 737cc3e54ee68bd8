"""`spectrum`: screen, JSON, page, refusals, exit codes; what other verbs say of a load spectrum."""

import json
import os
import re
import sys
from pathlib import Path

import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import MadeUpProgram, solution_of
from html_pages import Page

import jaxbearing as jb
from jaxbearing.numerics.status import Status
from jaxbearing.scenes.states import load_states
from jaxbearing.spectrum.states import require_rated

PAGE = Path(__file__).parents[2] / "docs" / "spectrum.md"
(DUTY,) = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
NAMES = ["cruise", "full load", "start"]


@pytest.fixture
def duty(folder):
    (folder / "duty.toml").write_text(DUTY, encoding="utf-8")
    return "duty.toml"


@pytest.fixture
def made_up(monkeypatch):
    """Results without a solve."""
    monkeypatch.setattr("jaxbearing.spectrum.verb.LaneProgram", MadeUpProgram)
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)


class _OneFails(MadeUpProgram):
    def __call__(self, inputs, active, progress=lambda lanes: None):
        solution = super().__call__(inputs, active, progress)
        status = jnp.asarray([0, int(Status.DIVERGED), 0], solution.status.dtype)
        object.__setattr__(solution, "status", status)
        for name in ("damage_rate", "equivalent_load", "catalogue_load"):
            values = getattr(solution.life, name)
            object.__setattr__(solution.life, name, jnp.where(status == 0, values, jnp.nan))
        return solution


@pytest.mark.usefixtures("made_up")
def test_screen_and_json(jaxbearing_command, duty):
    shown = jaxbearing_command("spectrum", duty)
    assert (shown.code, shown.err) == (0, "")
    for word in ("CONVERGED", "3 states", "operation.radial_load = 3 kN", *NAMES, "Governed by", "modified life Lnmr"):
        assert word in shown.out, word
    assert max(map(len, shown.out.splitlines())) <= 100
    told = jaxbearing_command("spectrum", duty, "--json")
    assert (told.code, told.err) == (0, "")
    found = json.loads(told.out)
    assert found["converged"] is True
    assert found["status"] == "converged"
    assert [one["name"] for one in found["states"]] == NAMES
    assert [one["share"] for one in found["states"]] == [0.7, 0.25, 0.05]
    assert found["states"][2]["changes"]["operation.inner_speed"] == "500 rpm"
    assert found["governing_state"] in NAMES
    np.testing.assert_allclose(sum(one["damage"] for one in found["states"]), 1.0)
    lives = [one["solution"]["life"]["damage_rate"] for one in found["states"]]
    rate = sum(one["revolutions"] * each for one, each in zip(found["states"], lives, strict=True))
    np.testing.assert_allclose(found["life"]["L10r"], 1.0 / rate, rtol=1e-12)


@pytest.mark.usefixtures("made_up")
def test_over_a_field(jaxbearing_command, duty):
    over = ("--over", "geometry.diametral_clearance=5 um:20 um:4")
    shown = jaxbearing_command("spectrum", duty, *over)
    assert (shown.code, shown.err) == (0, "")
    words = "4 values of geometry.diametral_clearance", "3 states each", "clearance", "Lnmr", "governed by", "15.00"
    for word in words:
        assert word in shown.out, word
    assert max(map(len, shown.out.splitlines())) <= 100
    told = jaxbearing_command("spectrum", duty, *over, "--json")
    assert (told.code, told.err) == (0, "")
    found = json.loads(told.out)
    assert (found["converged"], found["over"], found["unit"]) == (True, "geometry.diametral_clearance", "m")
    np.testing.assert_allclose(found["values"], [5e-6, 10e-6, 15e-6, 20e-6])
    assert [[one["name"] for one in each["states"]] for each in found["spectra"]] == [NAMES] * 4
    lives = [one["solution"]["life"]["damage_rate"] for one in found["spectra"][2]["states"]]
    rate = sum(one["revolutions"] * each for one, each in zip(found["spectra"][2]["states"], lives, strict=True))
    np.testing.assert_allclose(found["spectra"][2]["life"]["L10r"], 1.0 / rate, rtol=1e-12)


def test_a_state_that_fails_is_named(jaxbearing_command, duty, monkeypatch):
    monkeypatch.setattr("jaxbearing.spectrum.verb.LaneProgram", _OneFails)
    shown = jaxbearing_command("spectrum", duty)
    assert shown.code == 3
    assert "1 STATE FAILED" in shown.out
    assert "none: full load failed" in shown.out
    assert "million revolutions" not in shown.out
    told = jaxbearing_command("spectrum", duty, "--json")
    assert told.code == 3
    assert "state 'full load': diverged" in told.err
    found = json.loads(told.out)
    assert (found["converged"], found["status"], found["life"], found["governing_state"]) == (
        False,
        "diverged",
        None,
        None,
    )
    assert [bool(one["failure"]) for one in found["states"]] == [False, True, False]


@pytest.mark.usefixtures("made_up")
def test_page(jaxbearing_command, duty, folder):
    result = jaxbearing_command("report", duty)
    assert (result.code, result.err) == (0, "")
    page = Page((folder / "duty_report.html").read_text(encoding="utf-8"))
    for word in ("Load spectrum", *NAMES, "Governed by"):
        assert word in page.text, word


@pytest.mark.usefixtures("made_up")
def test_other_verbs_take_the_scene_without_states_and_say_so(jaxbearing_command, duty):
    said = "the scene leaves out its 3 [[state]] tables; 'jaxbearing spectrum' solves them"
    solved = jaxbearing_command("solve", duty, "--json")
    assert (solved.code, solved.err) == (0, "")
    assert any(said in text for text in json.loads(solved.out)["warnings"])


REFUSED = {
    "no states": (("deep_groove_6205",), "deep_groove_6205: state: found nothing; expected a load spectrum"),
    "unknown field": (
        ("duty.toml", "--set", "operation.radal_load=3 kN"),
        "duty.toml with --set operation.radal_load=3 kN: operation.radal_load: found the unknown name",
    ),
    "given twice": (
        ("duty.toml", "--set", "operation.radial_load=3 kN"),
        "duty.toml, state 'full load': operation.radial_load: found a field that --set or --over gives too",
    ),
    "over without values": (("duty.toml", "--over", "operation.oil_flow"), "--over: operation.oil_flow: found"),
    "over an unknown field": (
        ("duty.toml", "--over", "geometry.clearance=1 um:2 um:3"),
        "--over: geometry.clearance: found the unknown name",
    ),
    "over what a state changes": (
        ("duty.toml", "--over", "operation.radial_load=1 kN:2 kN:3"),
        "duty.toml, state 'full load': operation.radial_load: found a field that --set or --over gives too",
    ),
    "no rating": (("duty.toml", "--set", "rating=none"), "rating"),
}


def test_states_are_of_one_bearing(jaxbearing_command, folder):
    """Another number of balls, another diameter and another material are another bearing; the clearance is not. States
    without a name have their number."""
    head = DUTY.split("[[state]]")[0]
    for change, words in {
        "geometry.n_balls = 8": "geometry.n_balls",
        'geometry.ball_diameter = "7 mm"': "geometry.ball_diameter",
        'materials.balls = "Si3N4"': "materials.balls.youngs_modulus",
    }.items():
        text = f"{head}\n[[state]]\nshare = 0.5\n[[state]]\nshare = 0.5\n{change}\n"
        (folder / "other.toml").write_text(text, encoding="utf-8")
        for verb in ("spectrum", "report"):
            refused = jaxbearing_command(verb, "other.toml")
            assert refused.code == 2
            assert f"{words}: found one value in state '1' and another in state '2'" in refused.err
    text = text.replace(change, 'geometry.diametral_clearance = "20 um"')
    (folder / "other.toml").write_text(text, encoding="utf-8")
    assert [one.name for one in load_states("other.toml")] == ["1", "2"]
    require_rated({one.name: one.scene for one in load_states("other.toml")})
    with pytest.raises(ValueError, match="changes that leave each bearing the same"):
        jb.load_scene("gear_shaft").replace(
            {"states": (jb.shafts.ShaftState(share=1.0, changes={"bearing.rear.geometry.roller_diameter": 9e-3}),)}
        )


@pytest.mark.parametrize("case", REFUSED)
def test_refusals(case, jaxbearing_command, duty, folder):
    arguments, message = REFUSED[case]
    result = jaxbearing_command("spectrum", *arguments)
    assert (result.code, result.out) == (2, "")
    assert message in result.err
    assert "Traceback" not in result.err
    assert os.listdir(folder) == [duty]
