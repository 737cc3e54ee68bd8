"""Fields that shape a program: what they take, and that no JAX number ends up among the constants of a program."""

import dataclasses
import importlib
import pkgutil
import types
import typing
import warnings
from typing import Literal

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


WORDS = [
    ("turbine_ball", "kinematics.attitude", "inner"),
    ("turbine_ball", "kinematics.orbit", "own"),
    ("turbine_ball", "cage.guidance", "inner_ring"),
    ("turbine_roller", "flange.ring", "both"),
    ("turbine_roller", "ring_freedom", ("radial", "lateral")),
    ("turbine_roller_dynamic", "simulation.solver", "dopri8"),
    ("turbine_ball", "oil.rheology.viscous_function", "bair_winer"),
    ("deep_groove_6205", "rating.cleanliness", "grease_high"),
    ("deep_groove_6205", "rating.grooves", "scene"),
    ("deep_groove_6205", "rating.tilt", "iso"),
]


@pytest.mark.parametrize(("name", "path", "word"), WORDS)
def test_words(name, path, word):
    """What is none of the words is refused by the name of the field, before it is looked at as a constant."""
    scene = jb.load_scene(name, {"rating.cleanliness": "grease_normal"} if path.startswith("rating") else None)
    field = path.removeprefix("oil.")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        same = (word, np.str_(word), np.asarray(word)) if isinstance(word, str) else (word, list(word))
        for given in same:
            found = value_at(scene.replace({path: given}), path)
            assert type(found) is type(word)
            assert found == word
        for wrong in (jnp.ones(2), jnp.asarray(1.0), np.ones(2), 3, True, [1.0], "", "innr", ("lateral",)):
            with pytest.raises(ValueError, match=rf"{field} must be .*, got"):
                scene.replace({path: wrong})
        for transformed in (jax.jit, jax.vmap):
            with pytest.raises(ValueError, match=rf"{field}(: got a traced value| must be)"):
                transformed(lambda x: scene.replace({path: x}))(jnp.ones(2))


PARTS = ("lubricants", "contacts", "gaps", "bearings", "machines", "ehl")
INSIDE = (
    "Equations",
    "Dynamics",
    "Levers",
    "System",
    "Core",
    "Problem",
    "Patch",
    "Fluid",
    "History",
    "State",
    "Solution",
    "Loads",
    "InnerRing",
    "Result",
    "ByRace",
)
"""What the solvers make of a scene: its static numbers and words follow from fields that were checked."""


def static_fields():
    """(class, field) of static fields in what scenes are made of."""
    for package in PARTS:
        folder = importlib.import_module(f"jaxbearing.{package}")
        for module in pkgutil.walk_packages(folder.__path__, f"jaxbearing.{package}."):
            found = importlib.import_module(module.name)
            for kind in vars(found).values():
                if isinstance(kind, type) and issubclass(kind, eqx.Module) and kind.__module__ == found.__name__:
                    for field in dataclasses.fields(kind):
                        if field.metadata.get("static"):
                            yield kind, field


def static_numbers():
    """(class, field) of those annotated as a number or truth value."""
    for kind, field in static_fields():
        if field.type in (int, float, bool, int | None, float | None):
            yield kind, field


def static_words():
    """(class, field) of static fields that hold a word, in what scenes are made of."""
    for kind in {kind for kind, _ in static_fields()}:
        hints = typing.get_type_hints(kind)
        for field in dataclasses.fields(kind):
            hint = hints[field.name]
            words = typing.get_args(hint) if isinstance(hint, types.UnionType) else (hint,)
            if field.metadata.get("static") and (str in words or typing.get_origin(hint) is Literal):
                yield kind, field


def test_every_static_word_is_checked():
    found = [(kind, field) for kind, field in static_words() if not kind.__name__.endswith((*INSIDE, "Parts"))]
    unchecked = {f"{kind.__name__}.{field.name}" for kind, field in found if "converter" not in field.metadata}
    assert not unchecked
    assert len(found) > 8


def test_every_static_number_is_checked():
    unchecked = {
        f"{kind.__name__}.{field.name}"
        for kind, field in static_numbers()
        if "converter" not in field.metadata and not kind.__name__.endswith(INSIDE)
    }
    assert not unchecked
