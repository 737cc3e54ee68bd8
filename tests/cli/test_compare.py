"""`compare`: screen, JSON, refusals, exit codes; the table in `report`."""

import json
import sys

import pytest
from filled_results import solution_of

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
    assert jaxbearing_command("report", "tapered_example", *GIVEN, "--out", "a.html").code == 0
    assert jaxbearing_command("report", "tapered_example", "--out", "b.html").code == 0
    with_table, without = ((folder / name).read_text(encoding="utf-8") for name in ("a.html", "b.html"))
    assert "Beside the makers" in with_table
    assert "Palmgren, INA" in with_table
    assert "Beside the makers" not in without
