"""`jaxbearing new`: files, options, messages."""

import json
import os
import tomllib

import pytest

import jaxbearing as jb


def test_writes_a_scene(jaxbearing_command, folder):
    result = jaxbearing_command("new", "6207")
    assert result.code == 0
    assert "number of balls" in result.out
    assert "25.67 kN" in result.out
    assert "wrote 6207.toml: jaxbearing solve 6207.toml" in result.out
    text = (folder / "6207.toml").read_text(encoding="utf-8")
    assert "# estimated: 8 to 10" in text
    assert jb.load_scene("6207.toml").geometry.n_balls == 9
    assert jb.catalogue.find("6207").text() == text


def test_with_an_oil_it_has_the_best_laws(jaxbearing_command, folder):
    duty = ("--oil", "iso vg 68", "--radial-load", "3 kN", "--speed", "1500 rpm", "--oil-temperature", "70 degC")
    result = jaxbearing_command("new", "6207", *duty)
    assert result.code == 0
    assert "rolling resistance" in result.out
    tables = tomllib.loads((folder / "6207.toml").read_text(encoding="utf-8"))
    assert (tables["laws"], tables["oil"]["grade"]) == ("best", "ISO VG 68")
    assert tables["operation"]["radial_load"] == "3000 N"
    with pytest.warns(jb.PresetUsedWarning, match="rolling_resistance = 'biboulet_houpert'"):
        jb.load_scene("6207.toml")
    assert "dry: no films and no losses" in jaxbearing_command("new", "6208").out


def test_words_of_a_designation_need_no_quotes(jaxbearing_command, folder):
    assert jaxbearing_command("new", "NU", "311", "--output", "mine.toml").code == 0
    assert os.listdir(folder) == ["mine.toml"]
    assert tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8"))["kind"] == "cylindrical_roller_bearing"


def test_several_designations_make_a_file_each(jaxbearing_command, folder):
    """Nothing is written where one of them cannot be."""
    assert jaxbearing_command("new", "6308", "NU 308", "--radial-load", "1 kN").code == 0
    assert sorted(os.listdir(folder)) == ["6308.toml", "NU_308.toml"]
    kinds = [tomllib.loads((folder / name).read_text(encoding="utf-8"))["kind"] for name in sorted(os.listdir(folder))]
    assert kinds == ["ball_bearing", "cylindrical_roller_bearing"]
    for arguments, words in {
        ("6309", "NU", "308"): "found 'NU_308.toml', a file that exists already",
        ("6309", "6310", "--balls", "8"): "facts about the inside of one",
        ("6309", "6310", "--output", "a.toml"): "a folder that exists",
        ("6309", "6309"): "a designation twice",
    }.items():
        refused = jaxbearing_command("new", *arguments)
        assert refused.code == 2
        assert words in refused.err
    assert len(os.listdir(folder)) == 2
    found = json.loads(jaxbearing_command("new", "6309", "6310", "--json").out)
    assert [one["file"] for one in found["bearings"]] == ["6309.toml", "6310.toml"]


def test_given_numbers_are_shown_to_the_last_digit(jaxbearing_command, folder):
    known = ("--contact-angle", "38.1234 deg", "--static-capacity", "34219 N", "--pitch-diameter", "38.45671 mm")
    out = jaxbearing_command("new", "7205", *known).out
    for text in ("38.1234 deg", "34.219 kN", "38.45671 mm"):
        assert text in out
        assert f'"{text}"' in (folder / "7205.toml").read_text(encoding="utf-8")


def test_nothing_is_overwritten(jaxbearing_command, folder):
    (folder / "6207.toml").write_text("mine", encoding="utf-8")
    refused = jaxbearing_command("new", "6207")
    assert refused.code == 2
    assert "--force" in refused.err
    assert (folder / "6207.toml").read_text(encoding="utf-8") == "mine"
    assert jaxbearing_command("new", "6207", "--force").code == 0
    assert "ball_bearing" in (folder / "6207.toml").read_text(encoding="utf-8")


def test_what_is_known(jaxbearing_command, folder):
    known = ("--dynamic-capacity", "48.5 kN", "--static-capacity", "46 kN", "--balls", "21", "--json")
    result = jaxbearing_command("new", "7014 C", *known)
    assert result.code == 0
    found = json.loads(result.out)
    assert found["geometry"]["n_elements"] == {"value": 21, "least": 21, "greatest": 21, "given": True}
    assert found["dynamic_capacity"] == pytest.approx(48.5e3, rel=0.02)
    assert found["file"] == "7014_C.toml"
    scene = jb.load_scene("7014_C.toml")
    assert float(scene.rating.dynamic_capacity) == 48.5e3
    assert float(scene.geometry.ball_diameter) == pytest.approx(found["geometry"]["diameter"]["value"], rel=1e-4)


def test_json_of_rollers(jaxbearing_command):
    found = json.loads(jaxbearing_command("new", "30206", "--roller-length", "9.6 mm", "--rollers", "17", "--json").out)
    assert found["kind"] == "tapered"
    assert found["width"] == pytest.approx(17.25e-3)
    assert found["geometry"]["length"]["given"]
    assert found["geometry"]["contact_angle"]["least"] < found["geometry"]["contact_angle"]["greatest"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("6299",), "the nearest that are known: '629', '6219', '6209'"),
        (("22210",), "spherical roller bearing, which is not modelled"),
        (("32206D",), "of which 'D' is not understood"),
        (("6207", "--static-capacity", "15.3"), "--static-capacity"),
        (("6207", "--static-capacity", "15.3 mm"), "a force"),
        (("6207", "--contact-angle", "3 deg"), "follows from its clearance"),
        (("6207", "--balls", "30"), "30 balls"),
        (("6207", "--output", "no/such.toml"), "existing folder"),
        (("6207", "--oil", "ISO VG 70"), "ISO VG 68"),
        (("6207", "--base", "PAO"), "only allowed with an oil"),
        (("6207", "--speed", "3 kN"), "--speed"),
    ],
)
def test_bad_input(jaxbearing_command, folder, arguments, words):
    result = jaxbearing_command("new", *arguments)
    assert result.code == 2
    assert words in result.err
    assert result.err.startswith("error: ")
    assert result.err.count("\n") == 1
    assert os.listdir(folder) == []


@pytest.mark.parametrize("verb", ["solve", "report"])
def test_other_verbs_name_it(jaxbearing_command, verb):
    result = jaxbearing_command(verb, "6205")
    assert result.code == 2
    assert "'jaxbearing new 6205' writes a scene of this deep groove ball bearing." in result.err
    assert "jaxbearing new" not in jaxbearing_command(verb, "6299").err


def test_a_designation_of_two_words_in_place_of_a_scene(jaxbearing_command):
    result = jaxbearing_command("solve", "NU", "2210", "--json")
    assert result.code == 2
    assert "'jaxbearing new NU 2210' writes a scene of this cylindrical roller bearing." in result.err
    assert "jaxbearing new" not in jaxbearing_command("solve", "a", "b").err
    assert "writes a scene" not in jaxbearing_command("new", "NU", "2210", "--bogus").err


def test_oil_of_a_dry_scene_makes_the_viscosity_ratio(jaxbearing_command):
    """Only the rating takes it: the screen says what else the modified life needs."""
    assert jaxbearing_command("new", "NU", "2210").code == 0
    oil = ("--set", "oil.grade=ISO VG 68", "--set", "operation.oil_temperature=70 degC")
    shown = " ".join(jaxbearing_command("solve", "NU_2210.toml", *oil).out.split())
    assert "no a_ISO without rating.cleanliness or rating.contamination_factor" in shown
    assert "have no effect: oil" not in shown


def test_oil_that_only_the_rating_of_a_ball_bearing_takes():
    oil = {"oil.grade": "ISO VG 68", "operation.oil_temperature": "70 degC"}
    rated = jb.load_scene("deep_groove_6205", {**oil, "rating.cleanliness": "-/17/14"})
    assert rated.unused_parts() == ()
    assert jb.load_scene("deep_groove_6205", oil).unused_parts() == ("oil",)


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("jaxbearing new nu221", "nu2210"),
        ("jaxbearing new 620", "6205"),
        ("jaxbearing sp", "spectrum"),
        ("jaxbearing solve gear", "gear_shaft"),
        ("jaxbearing scenes --copy spin", "spindle_pair"),
        ("jaxbearing fields ball", "ball_bearing"),
        ("jaxbearing solve gear_shaft --set bearing.rear.pos", "bearing.rear.position="),
        ("jaxbearing solve deep_groove_6205 --set geo", "geometry."),
        ("jaxbearing sweep turbine_ball --over operation.inner", "operation.inner_speed="),
    ],
)
def test_completion_of_the_shell(words, found, jaxbearing_command, monkeypatch):
    monkeypatch.setenv("_JAXBEARING_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(words.count(" ")))
    result = jaxbearing_command()
    assert result.code == 0
    assert found in result.out.split()
