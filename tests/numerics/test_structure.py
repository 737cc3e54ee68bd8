"""Fields that shape a program: what they take, and that no JAX number ends up among the constants of a program."""

import dataclasses
import importlib
import pkgutil
import warnings

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.ehl import FilmModel

COUNTS = [
    ("deep_groove_6205", "geometry.n_balls", 8),
    ("turbine_roller", "geometry.n_rollers", 29),
    ("turbine_roller", "cage.n_lands", 1),
    ("tapered_example", "geometry.n_rollers", 16),
    ("tapered_example", "rating.n_laminae", 31),
    ("satellite_contact_1", "contact.nodes", 201),
]


def value_at(scene, path):
    for name in path.split("."):
        scene = getattr(scene, name)
    return scene


@pytest.mark.parametrize(("name", "path", "number"), COUNTS)
def test_whole_numbers(name, path, number):
    scene = jb.load_scene(name)
    with warnings.catch_warnings():
        # "A JAX array is being set as static!" would be one
        warnings.simplefilter("error")
        for given in (number, np.int64(number), np.asarray(number), jnp.asarray(number)):
            found = value_at(scene.replace({path: given}), path)
            assert type(found) is int
            assert found == number
        for wrong in (float(number), True, str(number), np.nan, [number], jnp.asarray([number, number])):
            with pytest.raises(ValueError, match=rf"{path} must be a whole number, got"):
                scene.replace({path: wrong})
        with pytest.raises(ValueError, match=rf"{path}: got a traced value, but it is structure"):
            jax.jit(lambda n: scene.replace({path: n}))(number)
        with pytest.raises(ValueError, match=rf"{path}: got a traced value, but it is structure"):
            jax.vmap(lambda n: scene.replace({path: n}))(jnp.arange(3))


def test_other_kinds():
    scene = jb.load_scene("turbine_ball")
    assert scene.replace({"contact.heathcote": jnp.asarray(True)}).contact.heathcote is True
    with pytest.raises(ValueError, match=r"contact\.heathcote must be True or False, got 1"):
        scene.replace({"contact.heathcote": 1})
    with pytest.raises(ValueError, match=r"contact\.heathcote: got a traced value"):
        jax.jit(lambda on: scene.replace({"contact.heathcote": on}))(True)
    assert FilmModel(inlet=jnp.asarray(8)).inlet == 8.0
    with pytest.raises(ValueError, match=r"contact\.inlet must be one finite number, got inf"):
        FilmModel(inlet=np.inf)


PARTS = ("lubricants", "contacts", "gaps", "bearings", "machines", "ehl")
INSIDE = ("System", "Core", "Problem", "Patch", "Fluid", "History", "State", "Solution", "Loads")
"""What the solvers make of a scene: their static numbers follow from fields that were checked."""


def static_numbers():
    """(class, field) of static fields annotated as a number or truth value, in what scenes are made of."""
    for package in PARTS:
        folder = importlib.import_module(f"jaxbearing.{package}")
        for module in pkgutil.iter_modules(folder.__path__):
            found = importlib.import_module(f"jaxbearing.{package}.{module.name}")
            for kind in vars(found).values():
                if isinstance(kind, type) and issubclass(kind, eqx.Module) and kind.__module__ == found.__name__:
                    for field in dataclasses.fields(kind):
                        if field.metadata.get("static") and field.type in (int, float, bool, int | None, float | None):
                            yield kind, field


def test_every_static_number_is_checked():
    unchecked = {
        f"{kind.__name__}.{field.name}"
        for kind, field in static_numbers()
        if "converter" not in field.metadata and not kind.__name__.endswith(INSIDE)
    }
    assert not unchecked
