"""`solve` with --plot, --out and --sensitivities: files, refusals, exit codes, what is printed."""

import io
import json
import math
import os
import re
import sys
from contextlib import redirect_stdout

import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr

import jaxbearing
from jaxbearing.cli.main import main
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.sensitivity import Sensitivities

DRY = ("solve", "reference_roller", "--set", "contact=none")
BEGINNINGS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.fixture
def no_solve(monkeypatch):
    """Fails where a solve is begun: a refusal must not make the user wait for one."""

    def solve_once(scene):
        raise AssertionError("solved before the refusal")

    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solve_once)


@pytest.mark.parametrize("suffix", [*BEGINNINGS, "PNG"])
def test_plot(suffix, jaxbearing_command, folder):
    plain = jaxbearing_command(*DRY, "--json")
    drawn = jaxbearing_command(*DRY, "--json", "--plot", f"picture.{suffix}")
    assert drawn == plain
    assert os.listdir(folder) == [f"picture.{suffix}"]
    assert (folder / f"picture.{suffix}").read_bytes().startswith(BEGINNINGS[suffix.lower()])


def test_out(jaxbearing_command, folder):
    plain = jaxbearing_command(*DRY)
    (folder / "sub").mkdir()
    written = jaxbearing_command(*DRY, "--out", "sub/results.nc")
    assert (written.code, written.out, written.err) == (0, plain.out + "wrote sub/results.nc\n", plain.err)
    assert os.listdir(folder / "sub") == ["results.nc"]
    check_netcdf(folder / "sub" / "results.nc", json.loads(jaxbearing_command(*DRY, "--json").out))


def check_netcdf(path, solution):
    """Labelled throughout, and the same numbers as the JSON."""
    with xr.open_dataset(path) as dataset:
        assert all(variable.attrs["units"] for variable in dataset.variables.values())
        np.testing.assert_allclose(dataset["load_inner"], solution["elements"]["load_inner"], rtol=1e-15)
        np.testing.assert_allclose(dataset["ring_radial"], solution["ring"]["radial"], rtol=1e-15)
        if solution.get("power_loss", {}).get("total") is not None:
            np.testing.assert_allclose(dataset["power_loss_total"], solution["power_loss"]["total"], rtol=1e-15)


def test_files_are_overwritten_and_both_can_be_wanted(jaxbearing_command, folder):
    (folder / "a.nc").write_text("old", encoding="utf-8")
    (folder / "a.png").write_text("old", encoding="utf-8")
    result = jaxbearing_command(*DRY, "--plot", "a.png", "--out", "a.nc", "--json")
    assert (result.code, result.err) == (0, "")
    assert sorted(os.listdir(folder)) == ["a.nc", "a.png"]
    check_netcdf(folder / "a.nc", json.loads(result.out))


@pytest.mark.usefixtures("no_solve")
@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--plot", "a.jpg"), ["--plot", "'a.jpg'", "'.png', '.svg', '.pdf'"]),
        (("--plot", "png"), ["--plot", "'png'", "ends in"]),
        (("--plot", ""), ["--plot", "ends in"]),
        (("--out", "a.csv"), ["--out", "'a.csv'", "'.nc'"]),
        (("--out", "."), ["--out", "'.nc'"]),
        (("--out", "no/a.nc"), ["--out", "'no/a.nc'", "existing folder"]),
        (("--plot", "no/a.png"), ["--plot", "'no/a.png'", "existing folder"]),
        (("--out", "folder.nc"), ["--out", "'folder.nc'", "a file in"]),
        (("--out", "scene.toml/a.nc"), ["--out", "existing folder"]),
        (("--plot", "a.png", "--out", "a.png"), ["--out", "'.nc'"]),
        (("--plot", "\x1b[31m.jpg"), ["--plot", "ends in"]),
        (("--sensitivities",), ["--sensitivities", "neither power loss", "contact.traction", "a rating"]),
        (("--sensitivities", "--set", "contact.film=moes", "--json"), ["--sensitivities", "contact.traction"]),
        (("--sensitivities", "--out", "a.nc"), ["--sensitivities"]),
    ],
    ids=lambda value: " ".join(value).replace("\x1b", "ESC"),
)
def test_refused_before_the_solve(options, words, jaxbearing_command, folder):
    (folder / "folder.nc").mkdir()
    (folder / "scene.toml").write_text("", encoding="utf-8")
    result = jaxbearing_command(*DRY, *options)
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("error: ")
    assert result.err.count("\n") == 1
    assert "\x1b" not in result.err
    for word in ("found", "expected", *words):
        assert word in result.err
    assert sorted(os.listdir(folder)) == ["folder.nc", "scene.toml"]


def test_a_broken_scene_is_said_before_a_wrong_file_name(jaxbearing_command, folder):
    result = jaxbearing_command("solve", "nowhere.toml", "--out", "a.csv")
    assert (result.code, result.err.count("\n")) == (2, 1)
    assert "nowhere.toml" in result.err


@pytest.mark.usefixtures("no_solve")
@pytest.mark.parametrize("options", [("--out", "a.nc"), ("--plot", "a.svg"), ("--json", "--out", "a.nc")], ids=str)
def test_a_place_that_cannot_be_written(options, jaxbearing_command, folder, monkeypatch):
    # the permission bits do not stop root, so the refusal is made here
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("jaxbearing.cli.output_files.tempfile.TemporaryFile", refuse)
    result = jaxbearing_command(*DRY, *options)
    assert (result.code, result.out) == (1, "")
    assert result.err == f"error: the output cannot be written: {options[-1]}: Permission denied\n"
    assert os.listdir(folder) == []


@pytest.mark.usefixtures("no_solve")
def test_a_write_protected_file(jaxbearing_command, folder, monkeypatch):
    (folder / "a.nc").write_text("mine", encoding="utf-8")
    monkeypatch.setattr("os.access", lambda _, mode, **__: mode != os.W_OK)
    result = jaxbearing_command(*DRY, "--out", "a.nc")
    assert (result.code, result.out) == (1, "")
    assert result.err == "error: the output cannot be written: a.nc: Permission denied\n"
    assert (folder / "a.nc").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("option", [("--out", "a.nc"), ("--plot", "a.pdf")], ids=str)
def test_a_disk_that_fills_up(option, jaxbearing_command, folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("jaxbearing.report.files.os.replace", full)
    result = jaxbearing_command(*DRY, *option)
    assert result.code == 1
    assert "CONVERGED" in result.out
    assert result.err == f"error: the output cannot be written: {option[1]}: No space left on device\n"
    assert os.listdir(folder) == []


@pytest.mark.usefixtures("failing_solve")
@pytest.mark.parametrize("screen", [(), ("--json",)], ids=["screen", "json"])
def test_not_converged_leaves_no_file(screen, jaxbearing_command, folder):
    (folder / "old.png").write_text("old", encoding="utf-8")
    result = jaxbearing_command(*DRY, *screen, "--out", "a.nc", "--plot", "old.png")
    assert result.code == 3
    assert "not written: old.png, a.nc\n" in result.err
    assert os.listdir(folder) == ["old.png"]
    assert (folder / "old.png").read_text(encoding="utf-8") == "old"
    if screen:
        assert json.loads(result.out)["converged"] is False
    else:
        assert "NOT CONVERGED" in result.out


SLOPES = {
    "operation.inner_speed": -1.5,
    "operation.outer_speed": 0.0,
    "geometry.roller_length": 1.25,
    "geometry.pitch_diameter": 0.75,
    "oil.viscosity.c1": 9.0,
    "contact.entrainment_offset": 8.0,
    "cage.land_width": 0.5,
    "cage.guiding_clearance": -0.25,
    "flange.angle": -2e-5,
    "drag.coefficient": 1e-7,
    "drag.through_flow_fraction": math.nan,
}


@pytest.fixture
def known_slopes(monkeypatch):
    """Sensitivities without the compilation of a lubricated scene: a dry solution and these numbers."""
    dry = jaxbearing.solve(jaxbearing.load_scene("reference_roller", {"contact": "none"}))
    slopes = Sensitivities(
        {path: jnp.asarray(value) for path, value in SLOPES.items()},
        {"drag.coefficient": jnp.asarray(0.0), "operation.inner_speed": jnp.asarray(-0.125)},
    )
    monkeypatch.setattr("jaxbearing.sensitivity.sensitivities", lambda scene, throw: (dry, slopes))


@pytest.mark.usefixtures("known_slopes")
def test_sensitivities(jaxbearing_command, folder):
    arguments = ("solve", "reference_roller", "--sensitivities")
    as_json = jaxbearing_command(*arguments, "--json", "--out", "a.nc", "--plot", "a.png")
    assert (as_json.code, as_json.err) == (0, "")
    assert sorted(os.listdir(folder)) == ["a.nc", "a.png"]
    slopes = json.loads(as_json.out)["sensitivities"]
    # every input, the largest first, what is not finite at the end
    ranked = sorted(SLOPES, key=lambda path: -abs(SLOPES[path]) if SLOPES[path] == SLOPES[path] else 1.0)
    assert list(slopes["power_loss.total"]) == ranked
    assert slopes["power_loss.total"] == {**SLOPES, "drag.through_flow_fraction": None}
    assert list(slopes["cage.slip"].values()) == [-0.125, 0.0]

    screen = jaxbearing_command(*arguments, "--sensitivities-by", "percent")
    assert (screen.code, screen.err) == (0, "")
    power, slip = shown(screen.out)
    # constants of laws are not shown; the five largest, then what nobody knows well
    chosen = [path for path in ranked if not path.startswith(("oil.", "contact."))]
    assert list(power) == [*chosen[:5], "drag.coefficient"]
    assert power["drag.coefficient"] == 1e-7
    assert slip == {"operation.inner_speed": -0.125, "drag.coefficient": 0.0}


@pytest.mark.usefixtures("known_slopes")
def test_sensitivities_by_usual_tolerances(jaxbearing_command):
    """One per cent of a pitch diameter is no tolerance of it: speed and cage clearance decide."""
    arguments = ("solve", "reference_roller", "--sensitivities")
    found = json.loads(jaxbearing_command(*arguments, "--json").out)["sensitivities_by_tolerance"]["power_loss.total"]
    speed = found["operation.inner_speed"]
    np.testing.assert_allclose(speed["effect"], -1.5 * 0.01, rtol=1e-12)
    np.testing.assert_allclose(speed["tolerance"], 0.01 * 10_500 * math.pi / 30.0, rtol=1e-12)
    assert list(found)[:3] == ["cage.guiding_clearance", "operation.inner_speed", "cage.land_width"]
    assert "oil.viscosity.c1" not in found
    assert abs(found["geometry.pitch_diameter"]["effect"]) < 1e-4
    screen = jaxbearing_command(*arguments).out
    table = screen.split("Sensitivities, by usual tolerances")[1]
    assert "-5.00 %" in table
    assert "+0.01 points" not in table
    assert max(len(line) for line in screen.splitlines()) <= 100


@pytest.mark.usefixtures("no_solve")
@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--sensitivities-of", "liffe"), ["--sensitivities-of", "'life'"]),
        (("--sensitivities-by", "per cent"), ["--sensitivities-by", "'percent'"]),
    ],
    ids=str,
)
def test_unknown_sensitivities_are_refused(options, words, jaxbearing_command):
    result = jaxbearing_command(*DRY, *options)
    assert (result.code, result.out) == (2, "")
    for word in ("found", "expected", *words):
        assert word in result.err


def test_sensitivities_of_the_stiffness(jaxbearing_command):
    """Of a dry bearing, which has neither loss nor life."""
    result = jaxbearing_command(*DRY, "--sensitivities-of", "stiffness", "--json")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert list(found["sensitivities"]) == ["stiffness.radial"]
    assert "power_loss_interval" not in found
    slopes = found["sensitivities"]["stiffness.radial"]
    assert slopes["materials.rings.youngs_modulus"] > 0.3
    lacking = jaxbearing_command(*DRY, "--sensitivities-of", "life")
    assert (lacking.code, lacking.out) == (2, "")
    assert "--sensitivities-of: found a bearing that does not model life; expected one of stiffness" in lacking.err


def shown(screen):
    """The numbers of both columns of the table of sensitivities."""
    # below the table stands how uncertain the loss is
    table = screen.split("Sensitivities")[1].split("Power loss")[0]
    lines = table.splitlines()
    middle = next(line.index("d(slip)") for line in lines if "d(slip)" in line)
    number = re.compile(r"([a-z_.]+) +([+-]?[0-9][0-9.e+-]*)")
    columns = []
    for part in (slice(None, middle), slice(middle, None)):
        found = [number.search(line[part]) for line in lines]
        columns.append({match[1]: float(match[2]) for match in found if match})
    return columns


def test_same_results_with_sensitivities_and_without(jaxbearing_command, folder):
    """All verbs and `jb.solve` give one result, its life too."""
    rated = ("reference_roller", "--set", "contact=none", "--set", "rating={}")
    plain = json.loads(jaxbearing_command("solve", *rated, "--json").out)
    differentiated = json.loads(jaxbearing_command("solve", *rated, "--sensitivities", "--json").out)
    differentiated.pop("sensitivities_by_tolerance")
    slopes = differentiated.pop("sensitivities")
    assert list(slopes) == ["life.L10r"]
    assert differentiated["life"]["L10r_hours"] > 0.0
    reported = json.loads(jaxbearing_command("report", *rated, "--json", "--out", "a.html").out)
    scene = jaxbearing.load_scene("reference_roller", {"contact": "none", "rating": "{}"})
    fast = solution_to_dict(jaxbearing.jit_solver(scene)())
    for other in (differentiated, reported, fast):
        assert numbers(other).keys() == numbers(plain).keys()
        for path, value in numbers(plain).items():
            # other programs of the same equations; residuals and what is 0 are round-off themselves
            if "residual" not in path and path != "iterations":
                np.testing.assert_allclose(numbers(other)[path], value, rtol=1e-9, atol=1e-12, err_msg=path)


def numbers(results, above=""):
    """All numbers of a JSON object by path."""
    if isinstance(results, dict | list):
        items = results.items() if isinstance(results, dict) else enumerate(results)
        return {path: x for key, value in items for path, x in numbers(value, f"{above}.{key}").items()}
    return {above.lstrip("."): results} if isinstance(results, int | float) else {}


@pytest.fixture(scope="module")
def lubricated(tmp_path_factory):
    """A lubricated scene, compiled once: everything wanted at once, then its screen."""
    folder = tmp_path_factory.mktemp("lubricated")
    file = lambda name: str(folder / name)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("JAXBEARING_CACHE", "off")
        everything = ("--json", "--sensitivities", "--plot", file("a.svg"), "--out", file("a.nc"))
        as_json = printed(patch, "reference_roller", *everything)
        screen = printed(patch, "reference_roller", "--sensitivities", "--sensitivities-by", "percent")
    return folder, json.loads(as_json), screen


def printed(patch, *arguments):
    patch.setattr("sys.argv", ["jaxbearing", "solve", *arguments])
    with redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit) as ended:
        main()
    assert not ended.value.code
    return out.getvalue()


@pytest.mark.slow
def test_everything_at_once(lubricated):
    folder, solution, _ = lubricated
    assert solution["status"] == "converged"
    assert sorted(os.listdir(folder)) == ["a.nc", "a.svg"]
    check_netcdf(folder / "a.nc", solution)


@pytest.mark.slow
def test_sensitivities_to_every_number(lubricated):
    _, solution, _ = lubricated
    slopes = solution["sensitivities"]
    assert list(slopes) == ["power_loss.total", "cage.slip"]
    for values in slopes.values():
        assert all(isinstance(value, float) and math.isfinite(value) for value in values.values())
        sizes = [abs(value) for value in values.values()]
        assert sizes == sorted(sizes, reverse=True)
        for path in (
            "geometry.diametral_clearance",
            "materials.rings.youngs_modulus",
            "oil.viscosity.c1",
            "oil.pressure_viscosity.value",
            "contact.entrainment_offset",
            "cage.guiding_clearance",
            "flange.axial_clearance",
            "drag.coefficient",
        ):
            assert path in values
    # the paths are those of --set and of the results; an input without effect is there too
    operation = {path.removeprefix("operation.") for path in slopes["cage.slip"] if path.startswith("operation.")}
    assert operation == set(solution["operation"])
    assert slopes["power_loss.total"]["operation.outer_speed"] == 0.0


@pytest.mark.slow
def test_sensitivities_on_the_screen(lubricated):
    _, solution, screen = lubricated
    assert max(len(line) for line in screen.splitlines()) <= 100
    assert "90 % between" in screen
    assert "assumed: lognormal, median 0.3" in " ".join(screen.split())
    for result, column in zip(("power_loss.total", "cage.slip"), shown(screen), strict=True):
        values = solution["sensitivities"][result]
        assert list(column)[:5] == [path for path in values if not path.startswith(("oil.", "contact."))][:5]
        assert "drag.coefficient" in column
        for path, value in column.items():
            np.testing.assert_allclose(value, values[path], atol=5.1e-4)


@pytest.mark.slow
def test_sensitivities_of_a_solve_that_fails(jaxbearing_command, monkeypatch):
    # a load that overflows: no solve survives it
    arguments = ("solve", "reference_roller", "--sensitivities", "--set", "operation.radial_load=1e200 N")
    as_json = jaxbearing_command(*arguments, "--json", "--out", "a.nc")
    assert as_json.code == 3
    assert "not written: a.nc" in as_json.err
    for values in json.loads(as_json.out)["sensitivities"].values():
        assert "drag.coefficient" in values
        assert set(values.values()) == {None}
    screen = jaxbearing_command(*arguments)
    assert screen.code == 3
    assert "Sensitivities" not in screen.out
