"""Speed and load over time from CSV files, and from lists in the scene."""

import math
import tomllib

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.scenes.data_files import builtin_text

RPM = 2.0 * math.pi / 60.0
SPEED = "# a run up\ntime [ms], speed [rpm]\n0, 7000\n\n10, 14000\n"


def scene_with(folder, text, table="speed_table"):
    file = folder / "course.csv"
    file.write_text(text, encoding="utf-8")
    return jb.load_scene("turbine_roller_dynamic", {f"simulation.{table}.file": str(file)})


def test_speed_in_rpm_is_over_that_of_the_operating_point(tmp_path):
    law = scene_with(tmp_path, SPEED).simulation.speed
    np.testing.assert_allclose([law.factor(t) for t in (0.0, 5e-3, 1.0)], [0.5, 0.75, 1.0], rtol=1e-14)
    # the course by area: trapezoid
    np.testing.assert_allclose(law.integral(10e-3), 7.5e-3, rtol=1e-14)


@pytest.mark.parametrize("text", ["factor; time [s]\n2; 0\n1; 0,5\n", "time [s]\tload [kN]\n0\t50\n0.5\t25\n"])
def test_factor_or_load_and_other_separators(text, tmp_path):
    if "0,5" in text:
        text = text.replace("0,5", "0.5")
    law = scene_with(tmp_path, text, "load_table").simulation.load
    np.testing.assert_allclose([law.factor(t) for t in (0.0, 0.25, 0.5)], [2.0, 1.5, 1.0], rtol=1e-14)


def test_path_is_relative_to_the_scene(tmp_path, monkeypatch):
    folder = tmp_path / "scenes"
    folder.mkdir()
    (folder / "course.csv").write_text(SPEED, encoding="utf-8")
    text = builtin_text("turbine_roller_dynamic") + 'speed_table = { file = "course.csv" }\n'
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert jb.load_scene("scenes/scene.toml").simulation.speed.factor(0.0) == 0.5


REFUSED = {
    "time goes back": ("time [ms],speed [rpm]\n0,7000\n5,8000\n5,9000\n", ["line 4", "time", "increase"]),
    "no unit": ("time,speed [rpm]\n0,7000\n5,8000\n", ["line 1", "time [ms]", "without a unit"]),
    "a wrong unit": ("time [ms],speed [N]\n0,7000\n5,8000\n", ["line 1", "speed", "speed [rpm]"]),
    "a missing column": ("time [ms]\n0\n5\n", ["line 1", "speed [rpm]", "factor"]),
    "a misspelt column": ("time [ms],sped [rpm]\n0,1\n5,2\n", ["line 1", "Did you mean 'speed'"]),
    "not a number": ("time [ms],speed [rpm]\n0,7000\n5,nan\n", ["line 3", "speed", "finite"]),
    "text": ("time [ms],speed [rpm]\n0,7000\n5,fast\n", ["line 3", "speed", "fast"]),
    "one row": ("time [ms],speed [rpm]\n0,7000\n", ["one row", "two rows"]),
    "nothing": ("\n# nothing\n", ["no lines", "time [ms]"]),
    "too many cells": ("time [ms],speed [rpm]\n0,7000\n5,8000,1\n", ["line 3", "3 cells"]),
    "rest": ("time [ms],speed [rpm]\n0,0\n5,8000\n", ["line 2", "films vanish"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_files_are_refused_with_file_and_line(name, tmp_path):
    text, hints = REFUSED[name]
    with pytest.raises(jb.SceneError) as refused:
        scene_with(tmp_path, text)
    for hint in ["course.csv", *hints]:
        assert hint in str(refused.value)


def test_no_such_file_names_the_field():
    with pytest.raises(jb.SceneError, match=r"gone\.csv.*no such file.*simulation\.load_table\.file"):
        jb.load_scene("turbine_roller_dynamic", {"simulation.load_table.file": "gone.csv"})


def test_one_course_only(tmp_path):
    (tmp_path / "course.csv").write_text(SPEED, encoding="utf-8")
    changes = {"simulation.speed_table.file": str(tmp_path / "course.csv"), "simulation.speed_ramp.start": "0.1"}
    with pytest.raises(jb.SceneError, match="speed_table"):
        jb.load_scene("turbine_roller_dynamic", changes | {"simulation.speed_ramp.duration": "1 ms"})


def listed(changes, table="speed_table"):
    scene = tomllib.loads(builtin_text("turbine_roller_dynamic"))
    return jb.scene_from_mapping(scene | {"simulation": {**scene["simulation"], table: changes}})


def test_lists_in_the_scene(tmp_path):
    """As the file with the same numbers; `--set` of one takes the other out."""
    times, factors = ["0 ms", "10 ms"], [0.5, 1.0]
    law = listed({"times": times, "factors": factors}).simulation.speed
    assert str(law) == str(scene_with(tmp_path, SPEED).simulation.speed)
    (tmp_path / "scene.toml").write_text(
        builtin_text("turbine_roller_dynamic") + 'speed_table = { times = ["0 s", "1 s"], factors = [1, 2] }\n',
        encoding="utf-8",
    )
    file = {"simulation.speed_table.file": str(tmp_path / "course.csv")}
    assert jb.load_scene(tmp_path / "scene.toml", file).simulation.speed.factor(0.0) == 0.5
    changes = {"simulation.speed_table.times": "['0 s', '1 s']", "simulation.speed_table.factors": "[1, 3]"}
    assert jb.load_scene(tmp_path / "scene.toml", changes).simulation.speed.factor(1.0) == 3.0
    load = listed({"times": ["-1 ms", "1 s"], "factors": [1, 0]}, "load_table").simulation.load
    assert (load.times[0], load.factor(1.0)) == (-1e-3, 0.0)


BAD_LISTS = {
    "nothing": ({}, "file: found nothing; expected a CSV file, or times and factors"),
    "both": ({"file": "a.csv", "times": ["0 s", "1 s"]}, "times: found both; expected none beside 'file'"),
    "one list": ({"times": ["0 s", "1 s"]}, "factors: found nothing; expected a list as long as 'times'"),
    "lengths": ({"times": ["0 s", "1 s"], "factors": [1.0]}, "factors: found 1 factors and 2 times"),
    "order": (
        {"times": ["1 s", "0 s"], "factors": [1.0, 2.0]},
        "times: found some that do not; expected times that in",
    ),
    "rest": (
        {"times": ["0 s", "1 s"], "factors": [1.0, 0.0]},
        "factors: found the number 0; .* at rest the films vanish",
    ),
    "no unit": ({"times": ["0", "1 s"], "factors": [1.0, 2.0]}, "times: .*value 1 of 2.*; expected a time"),
}


@pytest.mark.parametrize("name", BAD_LISTS)
def test_bad_lists_are_refused(name):
    table, words = BAD_LISTS[name]
    with pytest.raises(jb.SceneError, match=rf"simulation\.speed_table\.{words}"):
        listed(table)


@pytest.mark.parametrize("factors", [[0.0, 1.0], [1.0, -1.0]])
def test_loads_that_no_run_begins_with(factors):
    with pytest.raises(jb.SceneError, match=r"load_table\.factors: found .*; expected numbers >= 0, the first one > 0"):
        listed({"times": ["0 s", "1 s"], "factors": factors}, "load_table")
