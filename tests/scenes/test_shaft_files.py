"""Files of shafts: lists of tables by name, scenes of bearings, overrides by dotted paths, states, saving."""

import dataclasses
import re
import tomllib

import jax
import numpy as np
import pytest
from jax.test_util import check_grads

import jaxbearing as jb
from jaxbearing.scenes.data_files import builtin_text
from jaxbearing.scenes.overrides import split_assignments
from jaxbearing.shafts.paths import part_at, path_in_file
from jaxbearing.shafts.scene import ShaftState

PAIR = """
kind = "shaft"
[shaft]
speed = "1000 rpm"
sections = [{length = "100 mm", outer_diameter = "30 mm"}]
[[bearing]]
name = "left"
scene = "deep_groove_6205"
position = "10 mm"
[[bearing]]
name = "right"
scene = "SCENE"
position = "90 mm"
thrust = "-x"
[bearing.geometry]
diametral_clearance = "5 um"
"""


@pytest.fixture
def pair(tmp_path):
    """A shaft whose right bearing is a file beside it."""
    text = builtin_text("deep_groove_6205").replace('"7.938 mm"', '"7.9 mm"')
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    path = tmp_path / "shaft.toml"
    path.write_text(PAIR.replace("SCENE", "own.toml"), encoding="utf-8")
    return path


def refused(name, *changes):
    with pytest.raises(jb.SceneError) as caught:
        jb.load_scene(name, split_assignments(changes))
    return str(caught.value)


def test_scenes_of_bearings(pair):
    """A built-in one, and a file beside that of the shaft, changed by tables of the entry."""
    scene = jb.load_scene(pair)
    left, right = scene.bearings
    assert (left.name, right.name, right.sense) == ("left", "right", -1.0)
    alone = jb.load_scene("deep_groove_6205")
    assert jax.tree.structure(left.scene.geometry) == jax.tree.structure(alone.geometry)
    assert left.scene.geometry.ball_diameter == alone.geometry.ball_diameter
    assert right.scene.geometry.ball_diameter == 7.9e-3
    np.testing.assert_allclose(right.scene.geometry.diametral_clearance, 5e-6, rtol=1e-15)


def test_gear_shaft_is_the_one_of_the_docs():
    scene = jb.load_scene("gear_shaft")
    assert [place.name for place in scene.places] == ["front.1", "front.2", "rear"]
    np.testing.assert_allclose([float(place.position) for place in scene.places], [0.02, 0.037, 0.18], rtol=1e-14)
    assert [place.sense for place in scene.places] == [1.0, -1.0, 1.0]
    assert scene.forces[0].torque == 100.0
    assert scene.life.weibull is None
    assert all(place.scene.rating is not None for place in scene.places)


@pytest.mark.parametrize(
    ("change", "path", "value"),
    [
        ("bearing.rear.geometry.diametral_clearance=40 um", "", 40e-6),
        ("bearing.rear.position=150 mm", "", 0.15),
        ("force.pinion.torque=50 N*m", "", 50.0),
        ("force.wheel.mass=0.5 kg", "", 0.5),
        ("set.front.geometry.contact_angle=25 deg", "", np.radians(25.0)),
        ("set.front.preload.offset=2.6 um", "", 2.6e-6),
        ("set.front.support.tilt=200 kN*m/rad", "", 2e5),
        ("set.front.support.axial=200 N/um", "", 2e8),
        ("shaft.sections.2.outer_diameter=50 mm", "", 0.05),
        ("shaft.gravity.acceleration=1.62 m/s^2", "", 1.62),
        ("life.weibull=1.5", "", 1.5),
    ],
)
def test_overrides(change, path, value):
    scene = jb.load_scene("gear_shaft", split_assignments([change]))
    np.testing.assert_allclose(float(part_at(scene, change.partition("=")[0])), value, rtol=1e-14)


def test_another_preload_takes_the_place_of_the_one_of_the_file():
    scene = jb.load_scene("gear_shaft", {"set.front.preload.spring_force": "150 N"})
    assert (scene.sets[0].preload.force, scene.sets[0].preload.spring_force) == (None, 150.0)


def test_another_bearing_by_its_scene():
    scene = jb.load_scene("gear_shaft", {"bearing.rear.scene": "deep_groove_6205"})
    assert scene.bearings[0].scene.kind == "ball_bearing"
    np.testing.assert_allclose(scene.bearings[0].position, 0.18, rtol=1e-15)


def test_what_is_taken_out():
    scene = jb.load_scene("gear_shaft", {"bearing.rear": "none", "force.wheel": "none", "shaft.gravity": "none"})
    assert scene.bearings == ()
    assert [one.name for one in scene.forces] == ["pinion"]
    assert scene.shaft.gravity is None


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (("bearing.rear.position=250 mm",), "bearing.rear.position: found the text '250 mm'"),
        (("bearing.rear.position=250 mm",), r"250 mm lies beyond the shaft \(200 mm\)"),
        (("set.front.position=199 mm",), "set.front.position: .*front.2 at 207.5 mm lies beyond the shaft"),
        (("bearing.raer.position=1 mm",), "bearing.raer: .* Did you mean 'rear'?"),
        (("bearing.rear.positon=1 mm",), "bearing.rear.positon: .* Did you mean 'position'?"),
        (("bearing.rear.geometry.n_balls=9",), "bearing.rear.geometry.n_balls: found the unknown name"),
        (("bearing.rear.operation.radial_load=1 N",), "loads and speeds of a bearing on a shaft follow from"),
        (("bearing.rear.scene=two_disk_etm",), "expected the scene of a bearing"),
        (("force.pinion.kind=gaer",), "force.pinion.kind: .* Did you mean 'gear'?"),
        (("force.pinion.pitch_radius=0 mm",), "force.pinion.pitch_radius: .* expected a length > 0"),
        (("force.pinion.torque=100",), "force.pinion.torque: found the bare number 100; expected a moment"),
        (("set.front.geometry.pitch_diameter=5 mm",), "set.front.geometry.n_balls: .*do not fit on a pitch circle"),
        (("set.front.picture=<<",), "set.front.preload: .*tandem"),
        (("set.front.picture=OX",), "set.front.picture: found the text 'OX'"),
        (("set.front.preload.forse=1 N",), "Did you mean 'force'?"),
        (("set.front.support.tilt=200 N*m",), "expected a stiffness against tilting"),
        (("shaft.sections.2.inner_diameter=60 mm",), "inner_diameter 0.06 m must be smaller"),
        (("life.weibull=isso",), "life.weibull: found the text 'isso'; expected 'iso' or a number > 0"),
    ],
)
def test_errors_name_the_table(changes, said):
    found = refused("gear_shaft", *changes)
    assert re.search(said, found), found


def test_all_that_is_wrong_is_said_at_once():
    found = refused("gear_shaft", "force.pinion.torque=100", "bearing.rear.position=1", "set.front.distance=2")
    assert all(path in found for path in ("force.pinion.torque", "bearing.rear.position", "set.front.distance"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('kind = "shaft"\n[shaft]\nspeed = "1 rpm"\n', "bearing: found none"),
        (PAIR.replace('"right"', '"left"'), "'left' twice"),
        (PAIR.replace('name = "left"', 'name = "a.b"'), "bearing[0].name: found the text 'a.b'"),
        (PAIR.replace('name = "left"', 'name = "checks"'), "means something to the program"),
        (PAIR.replace("[[bearing]]", "[bearing]", 1).split("[[bearing]]")[0], "[[bearing]] tables in double brackets"),
        (PAIR.replace('scene = "deep_groove_6205"', ""), "bearing.left.scene: found nothing"),
        (PAIR.replace('scene = "deep_groove_6205"', 'sceen = "deep_groove_6205"'), "Did you mean 'scene'?"),
        (PAIR.replace('scene = "deep_groove_6205"', 'kind = "plain_bearing"'), "bearing.left.kind"),
    ],
)
def test_wrong_files(tmp_path, text, said):
    path = tmp_path / "shaft.toml"
    path.write_text(text.replace("SCENE", "deep_groove_6205"), encoding="utf-8")
    assert said in refused(path)


STATES = """
[[state]]
share = 0.7
[[state]]
share = 0.3
set = {"force.pinion.torque" = "50 N*m", "shaft.speed" = "3000 rpm"}
bearing.rear.geometry.diametral_clearance = "9 um"
"""


def test_states_of_a_duty_cycle(tmp_path):
    path = tmp_path / "duty.toml"
    path.write_text(builtin_text("gear_shaft") + STATES, encoding="utf-8")
    first, second = jb.load_scene(path).states
    assert (first.share, first.changes, first.name) == (0.7, {}, "1")
    assert second.changes == {
        "force.pinion.torque": 50.0,
        "shaft.speed": 3000.0 * np.pi / 30.0,
        "bearing.rear.geometry.diametral_clearance": 9e-6,
    }
    path.write_text(builtin_text("gear_shaft") + STATES.replace("0.7", "0.6"), encoding="utf-8")
    assert "shares that add up to 0.9" in refused(path)
    path.write_text(builtin_text("gear_shaft") + STATES.replace("pinion.torque", "pinion.torqe"), encoding="utf-8")
    assert "state '2': force.pinion.torqe" in refused(path)


def assert_same(one, other):
    assert jax.tree.structure(one) == jax.tree.structure(other)
    for a, b in zip(jax.tree.leaves(one), jax.tree.leaves(other), strict=True):
        assert np.asarray(a, dtype=float).tobytes() == np.asarray(b, dtype=float).tobytes()


def test_round_trip(pair, tmp_path):
    scene = jb.load_scene(
        "gear_shaft", {"set.front.mismatch": "['0 um', '1.3 um']", "set.front.support.radial": "1 N/m"}
    )
    matrix = np.diag([1e8, 2e8, 2.5e8, 3e4, 0.1])
    linear = jb.scene_from_mapping(
        {
            "kind": "shaft",
            "shaft": {"speed": 100.0},
            "bearing": [
                {"name": "a", "kind": "linear", "position": 0.0, "stiffness": matrix.tolist(), "support": {"tilt": 3e5}}
            ],
            "force": [{"kind": "point", "position": 0.1, "radial": 100.0, "azimuth": 0.3}],
        }
    )
    np.testing.assert_array_equal(linear.bearings[0].scene.stiffness, matrix)
    state = ShaftState(share=1.0, changes={"force.pinion.torque": 51.0}, name="half")
    with_states = dataclasses.replace(scene, states=(state,))
    for one in (scene, linear, with_states, jb.load_scene(pair)):
        jb.save_scene(one, tmp_path / "back.toml")
        assert_same(jb.load_scene(tmp_path / "back.toml"), one)
    written = tomllib.loads((tmp_path / "back.toml").read_text(encoding="utf-8"))
    assert [one["name"] for one in written["bearing"]] == ["left", "right"]


MIXED = """
kind = "shaft"
[shaft]
speed = "1000 rpm"
[housing]
matrix = MATRIX
[[set]]
name = "front"
picture = "<>"
scene = ["tapered_example", "own.toml"]
position = "10 mm"
distance = "30 mm"
preload = {offset = "3 um"}
[set.bearing.2.geometry]
pitch_diameter = "41 mm"
"""


@pytest.fixture
def mixed(tmp_path):
    """A set of a tapered roller bearing and of a ball bearing in a file beside that of the shaft."""
    text = builtin_text("deep_groove_6205").replace('"7.938 mm"', '"7.9 mm"')
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    entry = lambda i, j: (
        '"2 N"' if i != j and (i % 5 > 2) != (j % 5 > 2) else '"5 kN*m/rad"' if i % 5 > 2 else '"1 N/um"'
    )
    rows = ", ".join(
        "[" + ", ".join(entry(i, j) if i == j or j == 0 else "0" for j in range(10)) + "]" for i in range(10)
    )
    path = tmp_path / "mixed.toml"
    path.write_text(MIXED.replace("MATRIX", f"[{rows}]"), encoding="utf-8")
    return path


def test_a_set_of_different_bearings(mixed):
    """Found by their numbers from 1 in paths of files, of `replace` and of trees."""
    scene = jb.load_scene(mixed, {"set.front.bearing.2.geometry.n_balls": "8"})
    first, second = scene.sets[0].scenes
    assert (first.kind, second.kind) == ("tapered_roller_bearing", "ball_bearing")
    assert (second.geometry.n_balls, float(second.geometry.ball_diameter)) == (8, 7.9e-3)
    path = "set.front.bearing.2.geometry.pitch_diameter"
    assert float(part_at(scene, path)) == 41e-3
    changed = scene.replace({path: 42e-3})
    assert float(part_at(changed, path)) == 42e-3
    assert changed.sets[0].scenes[0] is first
    leaves, _ = jax.tree_util.tree_flatten_with_path(scene)
    for keys, value in leaves:
        path = path_in_file(scene, jax.tree_util.keystr(keys, simple=True, separator="."))
        assert part_at(scene, path) is value, path
    with pytest.raises(AttributeError, match="the set has bearings 1 to 2"):
        scene.replace({"set.front.bearing.3.geometry.pitch_diameter": 42e-3})
    other = jb.load_scene(mixed, {"set.front.bearing.1.scene": "deep_groove_6205"})
    assert [one.kind for one in other.sets[0].scenes] == ["ball_bearing"] * 2


def test_the_stiffness_of_a_housing(mixed):
    housing = jb.load_scene(mixed).housing
    assert housing.shape == (10, 10)
    np.testing.assert_array_equal(np.diag(housing), [1e6, 1e6, 1e6, 5e3, 5e3] * 2)
    assert (housing[3, 0], housing[5, 0], housing[0, 1]) == (2.0, 1e6, 0.0)
    text = mixed.read_text(encoding="utf-8")
    mixed.write_text(text.replace('[["1 N/um"', '[["1 N"'), encoding="utf-8")
    assert "housing.matrix: found the text '1 N', whose unit is of another kind (axial, axial)" in refused(mixed)
    mixed.write_text(text, encoding="utf-8")
    found = refused(mixed, "set.front.picture=<<>", "set.front.scene=tapered_example")
    assert re.search(r"housing: .* expected the shape|housing .*must have the shape \(15, 15\)", found), found


def test_different_bearings_and_a_housing_are_saved(mixed, tmp_path):
    scene = jb.load_scene(mixed)
    jb.save_scene(scene, tmp_path / "back.toml")
    assert_same(jb.load_scene(tmp_path / "back.toml"), scene)
    written = tomllib.loads((tmp_path / "back.toml").read_text(encoding="utf-8"))
    assert [one["kind"] for one in written["set"][0]["bearing"]] == ["tapered_roller_bearing", "ball_bearing"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"own.toml"]', "3]", "set.front.scene: found the .*number 3.* expected a scene, or a list of scenes"),
        ('"own.toml"]', '"two_disk_etm"]', "set.front.bearing.2.scene: .* expected the scene of a bearing"),
        (
            '"own.toml"]',
            '"own.toml", "own.toml"]',
            "one for each sign",
        ),
        ("[set.bearing.2.geometry]", "[set.geometry]", "set.front.geometry: found the unknown name"),
        (
            "pitch_diameter",
            "pich_diameter",
            "set.front.bearing.2.geometry.pich_diameter: .* Did you mean 'pitch_diameter'",
        ),
    ],
)
def test_wrong_sets_of_different_bearings(mixed, old, new, said):
    mixed.write_text(mixed.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    found = refused(mixed)
    assert re.search(said, found), found


def test_the_best_laws_of_a_bearing_on_a_shaft(tmp_path):
    """They stand in the table of the bearing, or in its own file; a warning says for what."""
    text = builtin_text("turbine_ball")
    alone = tmp_path / "alone.toml"
    kept = [line for line in text.splitlines() if not line.startswith(("film", "thermal", "traction", "rolling"))]
    alone.write_text("\n".join(kept), encoding="utf-8")
    path = tmp_path / "shaft.toml"
    path.write_text(PAIR.replace("SCENE", "alone.toml").partition("[bearing.geometry]")[0], encoding="utf-8")
    changes = {"bearing.right.laws": "best", "bearing.right.cage": "none", "bearing.right.drag": "none"}
    with pytest.warns(jb.PresetUsedWarning, match=r"stands for bearing\.right\.contact\.film = 'nijenbanning'"):
        scene = jb.load_scene(path, changes)
    with pytest.warns(jb.PresetUsedWarning):
        single = jb.load_scene(alone, {"laws": "best", "cage": "none", "drag": "none"})
    assert jax.tree.structure(scene.bearings[1].scene.contact) == jax.tree.structure(single.contact)
    assert scene.bearings[0].scene.contact is None


def test_what_a_file_cannot_hold():
    scene = jb.load_scene("gear_shaft")
    with pytest.raises(jb.SceneError, match="traced"):
        jax.jit(lambda torque: jb.save_scene(scene.replace({"force.pinion.torque": torque}), "never.toml"))(1.0)


def test_replace_takes_the_paths_of_files():
    scene = jb.load_scene("gear_shaft")
    changes = {
        "bearing.rear.geometry.diametral_clearance": 9e-6,
        "set.front.geometry.conformity_inner": 0.52,
        "set.front.preload.force": 300.0,
        "force.pinion.torque": 7.0,
        "shaft.sections.1.length": 0.061,
        "shaft.speed": 5.0,
    }
    changed = scene.replace(changes)
    for path, value in changes.items():
        assert float(part_at(changed, path)) == value, path
    with pytest.raises(AttributeError, match=r"no 'force\.pinoin'; there is pinion, wheel"):
        scene.replace({"force.pinoin.torque": 1.0})
    with pytest.raises(AttributeError, match=r"no 'force\.pinion\.tork'"):
        scene.replace({"force.pinion.tork": 1.0})


def test_every_number_has_a_path_of_files():
    scene = jb.load_scene("gear_shaft")
    leaves, _ = jax.tree_util.tree_flatten_with_path(scene)
    for keys, value in leaves:
        path = path_in_file(scene, jax.tree_util.keystr(keys, simple=True, separator="."))
        assert part_at(scene, path) is value, path


def test_numbers_of_a_shaft_can_be_differentiated():
    scene = jb.load_scene("gear_shaft")

    def last(torque):
        return scene.replace({"force.pinion.torque": torque}).forces[0].torque_given

    check_grads(last, (3.0,), order=1)
