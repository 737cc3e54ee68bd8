"""`laws = "best"` on the command line: the note, the list of `fields`, copies."""

import json

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
