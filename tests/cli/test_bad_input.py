"""Every kind of broken scene: exit code 2, one message with file and field, no traceback, nothing written."""

import json
import os
import subprocess
import sys
import tomllib

import pytest
from command_process import environment

from jaxbearing.scenes.data_files import builtin_text

TEXT = builtin_text("turbine_roller")


def without_table(name):
    """The scene without the table `name`."""
    parts = ("\n" + TEXT).split(f"\n[{name}]")
    rest = parts[1].split("\n[", 1)
    return parts[0] + ("\n[" + rest[1] if len(rest) > 1 else "\n")


def line(old, new):
    """The scene with one line (found by its beginning, comments and spaces aside) replaced."""
    lines = TEXT.splitlines()
    places = [i for i, text in enumerate(lines) if text.split("#")[0].split("=")[0].strip() == old]
    assert len(places) == 1, old
    lines[places[0]] = new
    return "\n".join(lines) + "\n"


# name: (text of the file, dotted path, words of the message)
BROKEN = {
    "unknown_key": (line("guidance", 'guidence = "inner_ring"'), "cage.guidence", ["'guidance'", "Did you mean"]),
    "unknown_table": (TEXT + "\n[flanges]\n", "flanges", ["Did you mean 'flange'"]),
    "unknown_key_hides_missing": (
        line("radial_load", 'radial_laod = "1 N"'),
        "operation.radial_laod",
        ["Did you mean 'radial_load'"],
    ),
    "wrong_unit": (
        line("pitch_diameter", 'pitch_diameter = "142 N"'),
        "geometry.pitch_diameter",
        ["142 N", "a length"],
    ),
    "unknown_unit": (line("pitch_diameter", 'pitch_diameter = "142 mmm"'), "geometry.pitch_diameter", ["mmm"]),
    "frequency": (line("inner_speed", 'inner_speed = "175 Hz"'), "operation.inner_speed", ["rpm"]),
    "bare_number": (
        line("roller_length", "roller_length = 14"),
        "geometry.roller_length",
        ["bare number 14", "'12 mm'"],
    ),
    "unit_without_number": (line("roller_length", 'roller_length = "mm"'), "geometry.roller_length", ["a length"]),
    "decimal_comma": (line("roller_length", 'roller_length = "1,4 mm"'), "geometry.roller_length", ["1,4 mm"]),
    "negative_diameter": (line("roller_diameter", 'roller_diameter = "-12 mm"'), "geometry.roller_diameter", ["> 0"]),
    "missing_load": (line("radial_load", ""), "operation.radial_load", ["nothing", "required"]),
    "missing_speed": (line("inner_speed", ""), "operation.inner_speed", ["nothing", "required"]),
    "missing_temperature": (line("oil_temperature", ""), "operation.oil_temperature", ["[contact] needs"]),
    "missing_flow": (line("oil_flow", ""), "operation.oil_flow", ["[drag] needs"]),
    "missing_film": (line("film", ""), "contact.film", ["nothing", "required"]),
    "missing_table": (without_table("materials"), "materials", ["nothing", "required"]),
    "zero_load": (line("radial_load", 'radial_load = "0 N"'), "operation.radial_load", ["'0 N'", "> 0"]),
    "text_for_a_number": (
        line("coefficient", 'coefficient = "0.3"'),
        "drag.coefficient",
        ["a number", "without quotes"],
    ),
    "boolean": (line("coefficient", "coefficient = true"), "drag.coefficient", ["boolean true"]),
    "array": (line("inner_speed", 'inner_speed = ["1 rpm"]'), "operation.inner_speed", ["an array"]),
    "date": (line("inner_speed", "inner_speed = 2020-01-01"), "operation.inner_speed", ["2020-01-01"]),
    "fraction_for_a_count": (line("n_rollers", "n_rollers = 30.5"), "geometry.n_rollers", ["30.5", "whole number"]),
    "zero_rollers": (line("n_rollers", "n_rollers = 0"), "geometry.n_rollers", [">= 1"]),
    "huge_number": (line("coefficient", f"coefficient = 1{'0' * 400}"), "drag.coefficient", ["not finite"]),
    "endless_number": (line("coefficient", f"coefficient = 1{'0' * 5000}"), "", ["syntax"]),
    "nan": (line("coefficient", "coefficient = nan"), "drag.coefficient", ["nan", "not finite"]),
    "nan_with_unit": (line("radial_load", 'radial_load = "nan N"'), "operation.radial_load", ["not finite"]),
    "infinity": (line("radial_load", 'radial_load = "1e999 N"'), "operation.radial_load", ["not finite"]),
    "oil_unknown": (line("name", 'name = "mobil_jet_2"'), "oil.name", ["mobil_jet_2", "Did you mean 'mobil_jet_ii'"]),
    "oil_without_laws": (line("name", ""), "oil.viscosity", ["nothing", "'name'"]),
    "oil_law_unknown": (TEXT + '[oil.density]\nlaw = "linar"\n', "oil.density.law", ["'linear'"]),
    "oil_law_missing_parameter": (
        TEXT + '[oil.pressure_viscosity]\nlaw = "constant"\n',
        "oil.pressure_viscosity.value",
        ["required"],
    ),
    "oil_law_unknown_parameter": (
        TEXT + '[oil.pressure_viscosity]\na0 = "1 K/Pa"\n',
        "oil.pressure_viscosity.a0",
        ["'a00'", "Did you mean"],
    ),
    "oil_text": ("oil = 'mobil_jet_ii'\n" + without_table("oil"), "oil", ["a table"]),
    "material_unknown": (line("rings", 'rings = "M51"'), "materials.rings", ["'52100'", "Did you mean 'M50'"]),
    "material_incomplete": (line("rings", 'rings = {density = "1 kg/m^3"}'), "materials.rings.", ["required"]),
    "poisson_ratio": (
        line("rings", 'rings = {density = "7850 kg/m^3", youngs_modulus = "210 GPa", poisson_ratio = 0.6}'),
        "materials.rings.poisson_ratio",
        ["0.6", "0.5"],
    ),
    "rollers_do_not_fit": (line("n_rollers", "n_rollers = 40"), "geometry.n_rollers", ["40", "do not fit"]),
    "contact_longer_than_roller": (
        line("contact_length", 'contact_length = "15 mm"'),
        "geometry.contact_length",
        ["14"],
    ),
    "cage_inside_out": (line("inner_diameter", 'inner_diameter = "147 mm"'), "cage.inner_diameter", ["146 mm"]),
    "flange_angle": (line("angle", 'angle = "90 deg"'), "flange.angle", ["below 90 deg"]),
    "below_absolute_zero": (line("oil_temperature", 'oil_temperature = "-300 degC"'), "operation.oil_temperature", []),
    "enum": (line("guidance", 'guidance = "inner"'), "cage.guidance", ["'inner_ring'", "Did you mean"]),
    "film_unknown": (line("film", 'film = "mos"'), "contact.film", ["'dowson_higginson'", "Did you mean 'moes'"]),
    "table_for_a_number": (TEXT + "[geometry.extra]\na = 1\n", "geometry.extra", ["unknown name"]),
    "number_for_a_table": (without_table("cage").replace("kind ", "cage = 3\nkind ", 1), "cage", ["a table"]),
    "lubricated_without_cage": (without_table("cage"), "cage", ["simulate"]),
    "contact_without_oil": (without_table("oil"), "oil", ["[contact] needs"]),
    "not_yet": (TEXT + "[kinematics]\n", "kinematics", ["not available in this version"]),
    "no_axial_freedom": (
        TEXT.replace("[operation]", '[operation]\naxial_load = "1 N"'),
        "operation.axial_load",
        ["no axial freedom"],
    ),
    "kind_unknown": (
        line("kind", 'kind = "cylindrical_roler_bearing"'),
        "kind",
        ["Did you mean 'cylindrical_roller_bear"],
    ),
    "kind_missing": (line("kind", ""), "kind", ["nothing", 'kind = "cylindrical_roller_bearing"']),
    "kind_misspelt": (line("kind", 'knid = "cylindrical_roller_bearing"'), "kind", ["'knid'", "Did you mean 'kind'"]),
    "kind_number": (line("kind", "kind = 3"), "kind", ["the number 3"]),
    "syntax": (line("roller_diameter", "roller_diameter = 12 mm"), "geometry.roller_diameter", ["line", "syntax"]),
    "duplicate_key": (line("roller_length", "n_rollers = 3"), "geometry.n_rollers", ["line", "syntax"]),
    "empty": ("", "", ["empty", "kind ="]),
    "blank": (" \n\n", "", ["empty"]),
    "comment_only": ("# nothing\n", "kind", ["nothing"]),
    "not_toml": ("<scene/>", "", ["TOML"]),
}


def check(result, folder, file, path, words):
    assert result.code == 2
    assert result.out == ""
    message = result.err
    first, *more = message.splitlines()
    if more:
        # the most telling problem first
        assert first == f"error: {file}: {len(more)} problems:"
        assert all(one.startswith("  - ") for one in more)
        first = more[0].replace("  - ", f"error: {file}: ", 1)
    assert first.startswith(f"error: {file}: {path}") if path else first.startswith(f"error: {file}: found")
    assert "found" in first
    assert "expected" in message
    assert "Traceback" not in message
    assert "pydantic" not in message
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    ("name", "options"), [*((name, ()) for name in BROKEN), *((name, ("--json",)) for name in ("syntax", "wrong_unit"))]
)
def test_broken_scene(name, options, jaxbearing_command, folder):
    text, path, words = BROKEN[name]
    file = f"{name}.toml"
    (folder / file).write_text(text, encoding="utf-8")
    result = jaxbearing_command("solve", file, *options)
    check(result, folder, file, path, words)
    assert os.listdir(folder) == [file]


def test_missing_file(jaxbearing_command, folder):
    check(jaxbearing_command("solve", "nowhere.toml"), folder, "nowhere.toml", "", ["no such file", "turbine_roller"])
    assert os.listdir(folder) == []


@pytest.mark.parametrize("name", ["turbine_rolller", "turbine-roller", "Turbine_Roller"])
def test_misspelt_builtin_name(name, jaxbearing_command, folder):
    check(jaxbearing_command("solve", name), folder, name, "", ["Did you mean 'turbine_roller'"])


def test_folder(jaxbearing_command, folder):
    (folder / "scene.toml").mkdir()
    check(jaxbearing_command("solve", "scene.toml"), folder, "scene.toml", "", ["a folder", "a scene file"])


def test_not_utf8(jaxbearing_command, folder):
    (folder / "scene.toml").write_bytes("# Größe\n".encode("latin-1"))
    check(jaxbearing_command("solve", "scene.toml"), folder, "scene.toml", "", ["UTF-8"])


def test_binary_file(jaxbearing_command, folder):
    (folder / "scene.toml").write_bytes(bytes(range(256)))
    check(jaxbearing_command("solve", "scene.toml"), folder, "scene.toml", "", ["UTF-8"])


def test_path_with_null_byte(jaxbearing_command, folder):
    check(jaxbearing_command("solve", "a\0b"), folder, r"a\x00b", "", ["cannot be read"])


def test_unreadable_file(jaxbearing_command, folder, monkeypatch):
    # the permission bits do not stop root, so the refusal is made here
    (folder / "scene.toml").write_text(TEXT, encoding="utf-8")

    def refuse(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("jaxbearing.scenes.input_files._check", refuse)
    check(jaxbearing_command("solve", "scene.toml"), folder, "scene.toml", "", ["Permission denied"])


@pytest.mark.parametrize(
    ("change", "path", "words"),
    [
        ("operation.inner_speed=12000", "operation.inner_speed", ["bare number 12000"]),
        ("operation.iner_speed=1 rpm", "operation.iner_speed", ["Did you mean 'inner_speed'"]),
        ("radial_load=3 kN", "radial_load", ["Did you mean 'operation.radial_load'"]),
        ("rating.eta_c=0.5", "rating.eta_c", ["Did you mean 'contamination_factor'"]),
        ("operation.speed=3000 rpm", "operation.speed", ["Did you mean 'inner_speed'"]),
        ("cage=none", "cage", ["simulate"]),
        ("cagee=none", "cagee", ["Did you mean 'cage'"]),
        ("operation.radial_load=none", "operation.radial_load", ["required"]),
        ("contact.film.order=3", "contact.film.order", ["a table"]),
        ("cage.guidence=none", "cage.guidence", ["Did you mean 'guidance'"]),
        ("flang.ring=none", "flang", ["unknown name 'flang'", "Did you mean 'flange'"]),
        ("kinematics=none", "kinematics", ["not available in this version", "belongs to ball bearings"]),
        ("contact.thermal=off", "contact.thermal", ["or leave it out (--set contact.thermal=none)"]),
        ("kind=none", "kind", ["found nothing", "kind ="]),
    ],
)
def test_set(change, path, words, jaxbearing_command, folder):
    result = jaxbearing_command("solve", "turbine_roller", "--set", change)
    assert result.code == 2
    assert result.out == ""
    assert result.err.startswith(f"error: turbine_roller with --set {change}: {path}: found")
    assert all(word in result.err for word in words)


@pytest.mark.parametrize("change", ["operation.inner_speed", "=3", "operation..inner_speed=3 rpm"])
def test_malformed_set(change, jaxbearing_command):
    result = jaxbearing_command("solve", "turbine_roller", "--set", change)
    assert result.code == 2
    assert "path=value" in result.err


def test_a_table_that_is_repeated_with_one_bracket(jaxbearing_command, folder):
    (folder / "scene.toml").write_text("[state]\nshare = 0.5\n[state]\nshare = 0.5\n", encoding="utf-8")
    words = ["Cannot declare", "such as [[state]], has two brackets"]
    check(jaxbearing_command("solve", "scene.toml"), folder, "scene.toml", "state", words)


@pytest.mark.parametrize("arguments", [["solve"], ["slove", "a"], ["solve", "a", "--jsn"], ["solve", "a", "b"]])
def test_wrong_usage(arguments, jaxbearing_command):
    result = jaxbearing_command(*arguments)
    assert result.code == 2
    assert result.out == ""
    assert result.err.startswith("error: ")
    assert result.err.count("\n") == 1


def test_set_without_a_value(jaxbearing_command):
    result = jaxbearing_command("solve", "turbine_roller", "--set")
    assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)


def test_control_characters_and_long_names_are_not_printed(jaxbearing_command, folder):
    for key in ('"\\u001b[31mred"', '"' + "k" * 3000 + '"'):
        (folder / "scene.toml").write_text(f"{key} = 1\n" + TEXT, encoding="utf-8")
        result = jaxbearing_command("solve", "scene.toml")
        assert result.code == 2
        assert "unknown name" in result.err
        assert "\x1b" not in result.err
        assert len(result.err) < 600


def test_a_wrong_law_is_one_problem(jaxbearing_command, folder):
    (folder / "scene.toml").write_text(TEXT + '[oil.density]\nlaw = "linar"\nslpe = 3\n', encoding="utf-8")
    result = jaxbearing_command("solve", "scene.toml")
    assert result.err.startswith("error: scene.toml: oil.density.law: found")
    assert "problems" not in result.err


def test_all_problems_of_a_file_in_one_message(jaxbearing_command, folder):
    text = (
        line("pitch_diameter", 'pitch_diameter = "142 N"').replace('"M50"', '"M51"').replace("guidance ", "guidence ")
    )
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    result = jaxbearing_command("solve", "scene.toml", "--set", "operation.oil_temperature=none")
    assert (result.code, result.out) == (2, "")
    header, *lines = result.err.splitlines()
    assert header == "error: 5 problems:"
    for path, words in {
        "cage.guidence": "Did you mean 'guidance'?",
        "geometry.pitch_diameter": "142 N",
        "materials.rings": "Did you mean 'M50'?",
        "materials.rollers": "Did you mean 'M50'?",
        "operation.oil_temperature": "--set operation.oil_temperature=none",
    }.items():
        (found,) = [one for one in lines if f": {path}: found" in one]
        assert words in found
        assert "expected" in found


def test_name_of_a_file_that_is_too_long(jaxbearing_command, folder):
    result = jaxbearing_command("scenes", "--copy", "turbine_roller", "--to", "a" * 300)
    assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)
    assert os.listdir(folder) == []


UNCHECKED = """
import contextlib, io, json, sys
sys.orig_argv = ["python", "-m", "jaxbearing"]
from jaxbearing.cli import main
found = []
main.leave = found.append
for words in {commands!r}:
    sys.argv = ["jaxbearing", *words]
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        main.main()
    found[-1] = found[-1], out.getvalue(), err.getvalue()
print(json.dumps(found))
"""
"""Commands in one process. The checks of annotations that tests switch on would find some things first."""


def test_without_checks_of_annotations(folder):
    names = "bare_number", "lubricated_without_cage"
    for name in names:
        (folder / f"{name}.toml").write_text(BROKEN[name][0], encoding="utf-8")
    commands = [["solve", f"{name}.toml", "--json"] for name in names]
    commands.append(["solve", "deep_groove_6205_mounted", "--set", "fits.shaft_interference=10 um"])
    program = UNCHECKED.format(commands=commands)
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=folder, env=environment(), capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    *broken, tolerance = json.loads(done.stdout)
    for name, (code, out, err) in zip(names, broken, strict=True):
        _, path, words = BROKEN[name]
        assert (code, out) == (2, "")
        assert err.startswith(f"error: {name}.toml: {path}: found")
        assert err.count("\n") == 1
        assert all(word in err for word in words)
    code, _, err = tolerance
    assert (code, err.count("\n")) == (2, 1)
    assert "fits.shaft_tolerance: found the text 'k5'; expected none beside" in err
    assert sorted(os.listdir(folder)) == sorted(f"{name}.toml" for name in names)


def test_the_scenes_are_broken_in_one_place_only():
    assert tomllib.loads(TEXT)["kind"]
    assert len(BROKEN) >= 20
