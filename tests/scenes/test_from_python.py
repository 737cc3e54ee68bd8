"""Scenes from tables of SI numbers, and oils by name or file."""

import tomllib

import jax
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.scenes.data_files import builtin_text
from jaxbearing.scenes.oil.writer import oil_text


def tables(name="deep_groove_6205"):
    return tomllib.loads(builtin_text(name))


@pytest.mark.parametrize("name", jb.builtin_names())
def test_texts_with_units_are_read_as_from_a_file(name):
    assert str(jb.scene_from_mapping(tables(name))) == str(jb.load_scene(name))


def test_numbers_are_si_values():
    changed = tables()
    changed["geometry"] |= {"pitch_diameter": np.float64(38.5e-3), "diametral_clearance": "12 um"}
    changed["operation"] |= {"inner_speed": 200.0 * np.pi, "oil_temperature": np.asarray(373.15), "axial_load": 200}
    scene, expected = jb.scene_from_mapping(changed), jb.load_scene("deep_groove_6205")
    for a, b in zip(jax.tree.leaves(scene), jax.tree.leaves(expected), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-15)
    # in a file a bare number is refused still
    with pytest.raises(jb.SceneError, match="bare number"):
        jb.load_scene("deep_groove_6205", {"operation.axial_load": "200"})


def test_everything_that_is_wrong_is_said_at_once():
    changed = tables()
    changed["geometry"] |= {"pitch_diameter": -1.0, "n_balls": "nine"}
    changed["operation"]["speed"] = 1.0
    with pytest.raises(jb.SceneError) as caught:
        jb.scene_from_mapping(changed)
    for path in ("geometry.pitch_diameter", "geometry.n_balls", "operation.speed"):
        assert path in str(caught.value)
    with pytest.raises(jb.SceneError, match="not finite"):
        jb.scene_from_mapping(tables() | {"operation": tables()["operation"] | {"axial_load": float("nan")}})
    with pytest.raises(TypeError, match="takes the tables of a scene, got a str"):
        jb.scene_from_mapping("deep_groove_6205")


def test_traced_numbers_are_refused_with_a_way_out():
    def made(load):
        return jb.scene_from_mapping(tables() | {"operation": tables()["operation"] | {"axial_load": load}})

    with pytest.raises(TypeError, match=r"operation\.axial_load: a traced number; make the scene .* with replace"):
        jax.eval_shape(made, 200.0)


def test_oils_by_name_and_by_file(tmp_path):
    oil = jb.load_oil("mobil_jet_ii")
    assert float(oil.viscosity.viscosity(0.0, 373.15)) == pytest.approx(4.7e-3, rel=0.1)
    file = tmp_path / "mine.toml"
    file.write_text(oil_text(oil, "mine", "the same", []), encoding="utf-8")
    same = jb.load_oil(file)
    np.testing.assert_allclose(same.viscosity.viscosity(1e9, 350.0), oil.viscosity.viscosity(1e9, 350.0), rtol=1e-15)
    with pytest.raises(jb.SceneError, match="an oil of the catalogue"):
        jb.load_oil("mobil_jet")
    with pytest.raises(jb.SceneError, match="no such file"):
        jb.load_oil(tmp_path / "nothing.toml")
