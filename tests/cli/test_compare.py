"""`compare`: screen, JSON, refusals, exit codes; the table in `report`."""

import json
import re
import sys

import pytest
from filled_results import solution_of

import jaxbearing as jb
from jaxbearing.makers.designation import FAMILIES, read_designation
from jaxbearing.scenes.bearing.catalogue import load_catalogue
from jaxbearing.scenes.reader import builtin_text

GIVEN = ("--set", "catalogue.designation=30206", "--set", "catalogue.outside_diameter=62 mm")


@pytest.fixture
def without_solves(monkeypatch):
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)


@pytest.mark.usefixtures("without_solves")
def test_screen(jaxbearing_command):
    result = jaxbearing_command("compare", "tapered_example", *GIVEN)
    assert (result.code, result.err) == (0, "")
    for word in ("CONVERGED", "physical model", "SKF", "Palmgren, INA", "assumed:", "Y = 0.4 cot", "series 302"):
        assert word in result.out
    # what lacks an input says so
    for word in ("drag: give catalogue.oil_level", "Timken: no moment; give catalogue.timken_g1"):
        assert word in " ".join(result.out.split())
    assert max(map(len, result.out.splitlines())) <= 100


@pytest.mark.usefixtures("without_solves")
def test_json(jaxbearing_command):
    result = jaxbearing_command("compare", "tapered_example", *GIVEN, "--json")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert found["converged"] is True
    laws = {one["law"]: one for one in found["laws"]}
    assert set(laws) == {"skf", "palmgren_ina", "timken_tapered"}
    assert laws["skf"]["total"] == pytest.approx(sum(value or 0.0 for value in laws["skf"]["parts"].values()))
    assert laws["skf"]["ratio"] == pytest.approx(laws["skf"]["total"] / found["physical"]["total"])
    assert laws["timken_tapered"]["total"] is None
    assert laws["timken_tapered"]["inside_range"] is None
    assert found["spread"] > 1.0


def test_refusals(jaxbearing_command):
    for arguments, said in (
        (("two_disk_etm",), "expected a bearing"),
        (("tapered_example", "--set", "catalogue.bore=3"), "a length with a unit"),
        (("tapered_example", "--set", "catalogue.lubrication=bath"), "Did you mean 'oil_bath'"),
        (("tapered_example", "--set", "catalogue.designation=true"), "expected text"),
        (("tapered_example", "--set", "catalogue.bores=30 mm"), "Did you mean 'bore'"),
    ):
        result = jaxbearing_command("compare", *arguments)
        assert result.code == 2
        assert said in result.err
        assert result.out == ""


@pytest.mark.usefixtures("failing_solve")
def test_not_converged(jaxbearing_command):
    screen = jaxbearing_command("compare", "deep_groove_6205")
    assert screen.code == 3
    assert "NOT CONVERGED" in screen.out
    as_json = jaxbearing_command("compare", "deep_groove_6205", "--json")
    assert as_json.code == 3
    assert json.loads(as_json.out)["status"] == "diverged"
    assert "not converged: deep_groove_6205" in as_json.err


@pytest.mark.usefixtures("without_solves")
def test_report_has_the_table_where_the_scene_has_one(jaxbearing_command, folder):
    taken_out = ("--set", "catalogue=none")
    for file, arguments in {"a": (), "b": taken_out}.items():
        assert jaxbearing_command("report", "tapered_example", *arguments, "--out", f"{file}.html").code == 0
    # without an oil no formula has a total
    assert jaxbearing_command("report", "deep_groove_6205", "--out", "c.html").code == 0
    pages = [(folder / name).read_text(encoding="utf-8") for name in ("a.html", "b.html", "c.html")]
    assert ["Beside the makers" in page for page in pages] == [True, False, False]
    assert "Palmgren, INA" in pages[0]


def test_scenes_of_a_standard_bearing_know_their_designation():
    """Those whose first comment names one: `compare` asks none of them for it."""
    named = {}
    for name in jb.builtin_names():
        head = builtin_text(name).partition("kind = ")[0]
        if re.search(r"of the \d{4,5} class|bearing 218|QJ \d+", head) and not name.endswith("_pair"):
            catalogue = load_catalogue(name)
            assert catalogue is not None, name
            named[name] = read_designation(catalogue.designation)
    bores = {name: one.bore for name, one in named.items()}
    assert bores == pytest.approx(
        {
            "angular_contact_218": 90e-3,
            **dict.fromkeys(("deep_groove_6205", "deep_groove_6205_fitted", "deep_groove_6205_mounted"), 25e-3),
            "four_point_qj": 45e-3,
            "tapered_example": 30e-3,
        }
    )
    assert all(one.family in FAMILIES[jb.load_scene(name).kind] for name, one in named.items())
