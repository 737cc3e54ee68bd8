"""`laws = "best"` on the command line: the note, the list of `fields`, copies."""

import json
import sys

import pytest
from filled_results import MadeUpProgram, solution_of
from html_pages import Page

import jaxbearing as jb

BEST = ("--set", "laws=best")
OIL = ("--set", "oil.grade=ISO VG 68", "--set", "operation.oil_temperature=60 degC")


def test_fields_lists_it_law_by_law(jaxbearing_command):
    screen = " ".join(jaxbearing_command("fields", "deep_groove_ball_bearing").out.split())
    assert 'laws = "best" stands for' in screen
    assert "contact.film 'nijenbanning'" in screen
    assert "cage.land_width estimated: 0.15 of the diameter" in screen
    assert "stands for" not in jaxbearing_command("fields", "two_disk").out


def test_the_note_is_a_warning_of_the_solution(jaxbearing_command):
    """The laws are taken out again: what is left to say is why the rest is left out."""
    off = ("--set", "contact=none", "--set", "kinematics=none")
    result = jaxbearing_command("solve", "angular_contact_218", *BEST, *off, "--json")
    assert (result.code, result.err) == (0, "")
    assert any("nothing slides without contact.traction" in text for text in json.loads(result.out)["warnings"])


def test_a_copy_marks_what_is_estimated(jaxbearing_command, folder):
    result = jaxbearing_command("scenes", "--copy", "deep_groove_6205", *BEST, *OIL, "--to", "a.toml")
    assert result.code == 0
    text = (folder / "a.toml").read_text(encoding="utf-8")
    comments = " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
    assert "estimated: cage.guiding_clearance = '0.154 mm'" in comments
    assert jb.load_scene(folder / "a.toml").cage is not None


STATES = """
[[state]]
name = "one"
share = 0.4
[[state]]
name = "two"
share = 0.6
operation.radial_load = "2 kN"
"""


@pytest.fixture
def new_scene(folder, monkeypatch):
    """A scene as `jaxbearing new` writes it, with a load spectrum; results without a solve."""
    text = jb.catalogue.find("NU 2210", oil="ISO VG 68").text()
    (folder / "a.toml").write_text(text, encoding="utf-8")
    (folder / "states.toml").write_text(text + STATES, encoding="utf-8")
    monkeypatch.setattr("jaxbearing.spectrum.verb.LaneProgram", MadeUpProgram)
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)


SAID = (
    "estimated: cage.guiding_clearance = '0.282 mm'",
    "by the marks in the scene file: estimated: geometry.n_rollers, geometry.pitch_diameter",
    "an example: operation.inner_speed",
    "geometry.diametral_clearance is the clearance before mounting",
)


@pytest.mark.usefixtures("new_scene")
@pytest.mark.parametrize("command", [("solve", "a.toml"), ("spectrum", "states.toml")])
def test_screen_and_json_say_what_nobody_gave(jaxbearing_command, command):
    """On the screen in one line, which `solve --full` lists."""
    shown = " ".join(jaxbearing_command(*command).out.split())
    assert "entries, which solve --full lists" in shown
    full = " ".join(jaxbearing_command("solve", "a.toml", "--full").out.split())
    warnings = json.loads(jaxbearing_command(*command, "--json").out)["warnings"]
    for text in SAID:
        assert text in full
        assert text not in shown
        assert sum(text in one for one in warnings) == 1


@pytest.mark.usefixtures("new_scene")
def test_so_does_the_page(jaxbearing_command, folder):
    result = jaxbearing_command("report", "a.toml", "--out", "a.html")
    assert (result.code, result.err) == (0, "")
    page = Page((folder / "a.html").read_text(encoding="utf-8"))
    for text in SAID:
        assert any(text in one for one in page.data("solution")["warnings"])
    said = " ".join(page.text.split())
    assert "before mounting, and is taken as that of the running bearing" in said
    assert "estimated by laws = 'best'" in said
    assert "estimated, by the file" in said
