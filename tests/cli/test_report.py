"""`report`: one file or none, exit codes, refusals before the solve."""

import json
import os
import sys

import pytest
from html_pages import Page

DRY = ("report", "reference_roller", "--set", "contact=none")


@pytest.fixture
def no_solve(monkeypatch):
    def solve_once(scene):
        raise AssertionError("solved before the refusal")

    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solve_once)


def test_page(jaxbearing_command, folder):
    result = jaxbearing_command(*DRY)
    assert (result.code, result.err) == (0, "")
    assert result.out == "wrote reference_roller_report.html: open it in a browser\n"
    assert os.listdir(folder) == ["reference_roller_report.html"]
    page = Page((folder / "reference_roller_report.html").read_text(encoding="utf-8"))
    solved = json.loads(jaxbearing_command("solve", *DRY[1:], "--json").out)
    assert page.data("solution") == solved
    assert "reference_roller --set contact=none" in page.text


def test_json_beside_the_page(jaxbearing_command, folder):
    result = jaxbearing_command(*DRY, "--out", "a.html", "--json")
    assert (result.code, result.err) == (0, "wrote a.html: open it in a browser\n")
    page = Page((folder / "a.html").read_text(encoding="utf-8"))
    assert json.loads(result.out) == page.data("solution")


@pytest.mark.usefixtures("failing_solve")
def test_json_of_a_failed_solve(jaxbearing_command, folder):
    result = jaxbearing_command(*DRY, "--json")
    assert (result.code, result.err) == (3, "not written: reference_roller_report.html\n")
    assert json.loads(result.out)["converged"] is False
    assert os.listdir(folder) == []


def test_a_name_that_is_markup(jaxbearing_command, folder):
    name = "<img src=x onerror=alert(1)>.toml"
    jaxbearing_command("scenes", "--copy", "reference_roller")
    (folder / "reference_roller.toml").rename(folder / name)
    assert jaxbearing_command("report", name, "--set", "contact=none", "--out", "a.HTML").code == 0
    page = Page((folder / "a.HTML").read_text(encoding="utf-8"))
    assert name in page.text
    assert not page.attributes("img")


@pytest.mark.usefixtures("failing_solve")
def test_failed_solve_writes_nothing(jaxbearing_command, folder):
    (folder / "a.html").write_text("mine", encoding="utf-8")
    result = jaxbearing_command(*DRY, "--out", "a.html")
    assert result.code == 3
    assert "NOT CONVERGED" in result.out
    assert result.err == "not written: a.html\n"
    assert os.listdir(folder) == ["a.html"]
    assert (folder / "a.html").read_text(encoding="utf-8") == "mine"


@pytest.mark.usefixtures("no_solve")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((*DRY, "--out", "a.pdf"), ["--out", "'a.pdf'", "'.html'"]),
        ((*DRY, "--out", "no/a.html"), ["--out", "'no/a.html'", "existing folder"]),
        (("report", "nowhere.toml"), ["nowhere.toml"]),
        (("report", "reference_roller", "--set", "geometry.n_roller=3"), ["n_roller", "n_rollers"]),
    ],
    ids=lambda value: " ".join(value),
)
def test_refused_before_the_solve(arguments, words, jaxbearing_command, folder):
    result = jaxbearing_command(*arguments)
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("error: ")
    assert result.err.count("\n") == 1
    assert all(word in result.err for word in words)
    assert os.listdir(folder) == []


def test_a_write_that_breaks_off(jaxbearing_command, folder, monkeypatch):
    (folder / "a.html").write_text("mine", encoding="utf-8")

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("jaxbearing.report.files.os.fsync", full)
    result = jaxbearing_command(*DRY, "--out", "a.html")
    assert result.code == 1
    assert "CONVERGED" in result.out
    assert result.err == "error: the output cannot be written: a.html: No space left on device\n"
    assert os.listdir(folder) == ["a.html"]
    assert (folder / "a.html").read_text(encoding="utf-8") == "mine"


def test_interval_of_the_power_loss(jaxbearing_command, folder):
    """By the assumed drag coefficient, by one of the file's own, and not where it is switched off."""
    title = "How well the power loss is known"
    found = {}
    for name, more in (
        ("assumed", ()),
        ("own", ("--set", "drag.coefficient={mean = 0.4, deviation = 0.02}")),
        ("none", ("--no-drag-prior",)),
    ):
        assert jaxbearing_command("report", "reference_roller", *more, "--out", f"{name}.html").code == 0
        found[name] = Page((folder / f"{name}.html").read_text(encoding="utf-8")).text
    assert title in found["assumed"]
    assert "assumed: lognormal, median 0.3" in found["assumed"]
    assert "normal, mean 0.4, deviation 0.02" in found["own"]
    assert title not in found["none"]
