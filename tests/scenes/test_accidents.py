"""What accidents make of a scene file is a scene, or one clear refusal; never another error, nor a warning."""

import equinox as eqx
import pytest
from scene_accidents import mutated

import jaxbearing as jb
from jaxbearing.scenes.reader import builtin_names, builtin_text


def read(seed, folder):
    """The scene of an accident, or None where it was refused."""
    names = builtin_names()
    file = folder / "scene.toml"
    file.write_text(mutated(builtin_text(names[seed % len(names)]), seed), encoding="utf-8")
    try:
        return jb.load_scene(str(file))
    except jb.SceneError as error:
        said = str(error).replace(str(file), file.name)  # the folder is that of the tests
    # each problem has a line that can be read
    assert len(said) < 450 * (1 + said.count("\n"))
    assert "scene.toml" in said
    return None


def count(seeds, folder):
    return sum(read(seed, folder) is not None for seed in seeds)


def test_accidents(tmp_path):
    # one in eight does no harm
    assert 10 < count(range(400), tmp_path) < 100


@pytest.mark.slow
def test_many_accidents(tmp_path):
    assert 300 < count(range(400, 4000), tmp_path) < 700


@pytest.mark.slow
def test_scenes_that_are_read_can_be_solved(tmp_path):
    """As far as it shows without computing: no law meets what it cannot take."""
    scenes = [scene for scene in (read(seed, tmp_path) for seed in range(4000, 4400)) if scene is not None]
    assert len(scenes) > 20
    for scene in scenes:
        eqx.filter_eval_shape(jb.solve, scene, throw=False)
