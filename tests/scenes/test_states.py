"""The tables [[state]] of scene files: what they may say, and what is refused in one message that names the field."""

import warnings

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.scenes.data_files import builtin_text
from jaxbearing.scenes.states import MOST_STATES, load_states
from jaxbearing.sweeps.fields import SceneSource

BASE = builtin_text("deep_groove_6205") + "\n[rating]\n"
STATES = """
[[state]]
name = "cruise"
share = 0.6

[[state]]
name = "start"
share = 0.1
operation.radial_load = "4 kN"
"operation.inner_speed" = "500 rpm"

[[state]]
name = "full load"
share = 0.3
operation = {radial_load = "3 kN", moment = "none"}
rating.viscosity_ratio = 2
rating.grooves = "scene"
"""


@pytest.fixture
def written(tmp_path):
    def write(states, base=BASE):
        path = tmp_path / "duty.toml"
        path.write_text(base + states, encoding="utf-8")
        return path

    return write


def test_states_are_changes_of_the_scene(written):
    cruise, start, full = load_states(written(STATES), {"geometry.diametral_clearance": "15 um"})
    assert [one.name for one in (cruise, start, full)] == ["cruise", "start", "full load"]
    assert [one.share for one in (cruise, start, full)] == [0.6, 0.1, 0.3]
    assert cruise.scene.operation.radial_load == 1500.0
    assert start.scene.operation.radial_load == 4000.0
    np.testing.assert_allclose(start.scene.operation.inner_speed, 500.0 * np.pi / 30.0)
    assert start.changes == {"operation.radial_load": "4 kN", "operation.inner_speed": "500 rpm"}
    assert full.scene.operation.moment is None
    assert full.scene.rating.grooves == "scene"
    clearances = [one.scene.geometry.diametral_clearance for one in (cruise, start, full)]
    np.testing.assert_allclose(clearances, 15e-6, rtol=1e-12)


def test_other_readers_take_the_scene_without_them_and_say_so(written):
    path = written(STATES)
    with pytest.warns(jb.StatesUnusedWarning, match=r"leaves out its 3 \[\[state\]\] tables; 'jaxbearing spectrum'"):
        scene = jb.load_scene(path)
    assert scene.operation.radial_load == 1500.0
    with pytest.warns(jb.StatesUnusedWarning):
        SceneSource.of(path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_states(path)


def one(text="", share="1.0"):
    return f'[[state]]\nname = "a"\nshare = {share}\n{text}\n'


REFUSED = {
    "none": ("", "state: found nothing; expected a load spectrum"),
    "one table": ('[state]\nname = "a"\nshare = 1.0', "state: found a table"),
    "misspelt name": ('[[state]]\nnamee = "a"\nshare = 1.0', r"state '1': namee: found the unknown name 'namee'"),
    "number as a name": ("[[state]]\nname = 3\nshare = 1.0", r"state\[0\]\.name: found the number 3"),
    "twice": (one("", "0.5") + one("", "0.5"), r"state\[1\]\.name: found 'a' twice"),
    "no share": ('[[state]]\nname = "a"', r"state\[0\]\.share: found nothing"),
    "share of 0": (one("", "0"), r"state\[0\]\.share: found the number 0; expected a number above 0 and at most 1"),
    "share as a text": (one("", '"60 %"'), r"state\[0\]\.share: found .*; expected a number above 0 and at most 1"),
    "sum": (one("", "0.9"), r"state\.share: found shares that add up to 0\.9; expected shares that add up to 1"),
    "unknown field": (
        one('operation.radal_load = "1 kN"'),
        r"state 'a': operation\.radal_load: found the unknown name 'radal_load'.*Did you mean 'radial_load'",
    ),
    "unknown table": (one('operatoin.radial_load = "1 kN"'), r"state 'a': operatoin: found the unknown name"),
    "no unit": (one("operation.radial_load = 1000"), r"state 'a': operation\.radial_load: found"),
    "another kind": (one('kind = "two_disk"'), r"state 'a': kind: found another kind of scene"),
    "of --set too": (one("geometry.n_balls = 8"), r"geometry\.n_balls: found a field that --set or --over gives too"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals(case, written):
    states, message = REFUSED[case]
    with pytest.raises(jb.SceneError, match=message):
        load_states(written(states), {"geometry.n_balls": 9})


def test_more_states_than_can_be_solved_are_refused(written):
    states = '[[state]]\nshare = 1e-4\noperation.radial_load = "4 kN"\n' * (MOST_STATES + 1)
    with pytest.raises(jb.SceneError, match=f"state: found {MOST_STATES + 1} states; expected at most {MOST_STATES}"):
        load_states(written(states))


def test_all_states_that_are_wrong_are_named(written):
    states = one('operation.radal_load = "1 kN"', "0.5") + one("geometry.n_bals = 3", "0.5").replace('"a"', '"b"')
    with pytest.raises(jb.SceneError) as caught:
        load_states(written(states))
    assert [problem.path for problem in caught.value.problems] == ["operation.radal_load", "geometry.n_bals"]
