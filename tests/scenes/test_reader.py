"""Built-in scenes, overrides, oils."""

import dataclasses
import tomllib
import typing

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.bearings.ball.scene import BallBearing
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing
from jaxbearing.bearings.tapered.scene import TaperedRollerBearing
from jaxbearing.contacts import (
    DistributedTraction,
    DowsonHigginson,
    Gupta,
    MartinBlend,
    MeanPressureTraction,
    Moes,
    NoThermalReduction,
    ReeEyring,
    Resolution,
)
from jaxbearing.ehl import EHLLineContact
from jaxbearing.gaps import BlendedTurbulence, FullTurbulence, Laminar
from jaxbearing.lubricants import ConstantPressureViscosity, FittedPressureViscosity, IntegratedPressureViscosity
from jaxbearing.machines import TwoDisk
from jaxbearing.scenes.data_files import oil_names
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.oil.catalogue import load_oil, missing_sources, oil_data
from jaxbearing.scenes.overrides import parse_value, split_assignments
from jaxbearing.scenes.reader import builtin_names, builtin_summary, builtin_text, load_scene, scene_from_tables
from jaxbearing.shafts.scene import ShaftSystem

KINDS = {
    "ball_bearing": BallBearing,
    "cylindrical_roller_bearing": CylindricalRollerBearing,
    "tapered_roller_bearing": TaperedRollerBearing,
    "two_disk": TwoDisk,
    "line_contact": EHLLineContact,
    "shaft": ShaftSystem,
}


@pytest.mark.parametrize("name", builtin_names())
def test_builtin_scenes_load(name, tmp_path):
    kind = tomllib.loads(builtin_text(name))["kind"]
    assert isinstance(load_scene(name), KINDS[kind])
    assert len(builtin_summary(name)) > 20
    copy = tmp_path / "copy.toml"
    copy.write_text(builtin_text(name), encoding="utf-8")
    load_scene(copy)
    load_scene(str(copy))


def test_editors_know_the_class_of_each_builtin_scene():
    """The overloads of `load_scene` name every built-in scene, each with the class that it has."""
    named = {}
    for way in typing.get_overloads(load_scene)[:-1]:
        hints = way.__annotations__
        named |= dict.fromkeys(typing.get_args(hints["source"]), hints["return"])
    assert sorted(named) == sorted(builtin_names())
    for name, kind in named.items():
        assert type(load_scene(name)).__name__ == kind


def test_turbine_roller():
    scene = load_scene("turbine_roller")
    assert scene.geometry.n_rollers == 30
    # as printed; 1e-12: one conversion of units
    close = lambda value, expected: np.testing.assert_allclose(value, expected, rtol=1e-12)
    close(scene.geometry.pitch_diameter, 0.142)
    close(scene.geometry.contact_length, 0.0124)
    close(scene.cage.guiding_clearance, 480e-6)
    close(scene.cage.land_width, 3.98e-3)
    close(scene.flange.angle, np.radians(0.375))
    close(scene.operation.inner_speed, 10500 * np.pi / 30)
    close(scene.operation.radial_load, 25000.0)
    close(scene.operation.oil_flow, 0.150 / 3600)
    close(scene.operation.oil_temperature, 373.15)
    close(scene.drag.coefficient, 0.3)
    close(scene.materials.rings.youngs_modulus, 203e9)
    assert isinstance(scene.contact.film, Moes)
    assert isinstance(scene.contact.thermal, Gupta)
    assert scene.contact.traction == DistributedTraction(ReeEyring(), Resolution.for_accuracy(1e-3))
    assert isinstance(scene.cage.turbulence, BlendedTurbulence)
    assert isinstance(scene.oil.pressure_viscosity, FittedPressureViscosity)


def test_reference_roller_has_the_reference_closure():
    scene = load_scene("reference_roller")
    assert isinstance(scene.contact.film, MartinBlend)
    assert isinstance(scene.contact.film.film, DowsonHigginson)
    assert isinstance(scene.contact.thermal, NoThermalReduction)
    assert isinstance(scene.oil.pressure_viscosity, ConstantPressureViscosity)
    np.testing.assert_allclose(scene.oil.pressure_viscosity.value, 10.4e-9, rtol=1e-12)
    np.testing.assert_allclose(scene.contact.entrainment_offset, 1e-3, rtol=1e-12)
    np.testing.assert_allclose(scene.drag.coefficient, 1.2, rtol=1e-12)
    np.testing.assert_allclose(scene.materials.rollers.youngs_modulus, 210e9, rtol=1e-12)


def test_a_table_left_out_is_not_modelled():
    scene = load_scene("turbine_roller", {"contact": "none", "cage": "none", "flange": "none", "drag": "none"})
    assert (scene.contact, scene.cage, scene.flange, scene.drag) == (None, None, None, None)


@pytest.mark.parametrize(
    ("name", "law"), [("laminar", Laminar), ("blend", BlendedTurbulence), ("pure", FullTurbulence)]
)
def test_turbulence_names(name, law):
    assert isinstance(load_scene("turbine_roller", {"cage.turbulence": name}).cage.turbulence, law)


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        ("operation.inner_speed", "12000 rpm", 12000 * np.pi / 30),
        ("operation.inner_speed", '"12000 rpm"', 12000 * np.pi / 30),
        ("operation.outer_speed", "-100rpm", -100 * np.pi / 30),
        ("operation.oil_temperature", "60degC", 333.15),
        ("drag.coefficient", "0.6", 0.6),
        ("drag.coefficient", "1", 1.0),
        ("geometry.n_rollers", "12", 12),
        ("cage.n_lands", "1", 1),
        ("geometry.diametral_clearance", "-10 um", -10e-6),
        ("oil.rheology.stress_temperature", "786 K", 786.0),
    ],
)
def test_set(path, text, expected):
    value = load_scene("turbine_roller", {path: text})
    for name in path.split("."):
        value = getattr(value, name)
    np.testing.assert_allclose(value, expected, rtol=1e-12)


def test_set_creates_and_removes():
    dry = {"contact": "none", "cage": "none", "oil": "none", "flange": "none", "drag": "none"}
    assert load_scene("turbine_roller", dry).oil is None
    isothermal = load_scene("turbine_roller", {"contact.thermal": "none"})
    assert isinstance(isothermal.contact.thermal, NoThermalReduction)
    created = load_scene("turbine_roller", {"flange": "{ring = 'both', axial_clearance = '1 mm'}"})
    assert created.flange.ring == "both"
    recreated = load_scene(
        "turbine_roller", {"flange": "none", "flange.ring": "outer", "flange.axial_clearance": "20um"}
    )
    assert recreated.flange.height is None
    # taking out what is not there is no error, nor does it make its table
    assert load_scene("turbine_roller", {"flange": "none", "flange.height": "none"}).flange is None
    assert load_scene("reference_roller", {"contact.thermal": "none"}).contact.traction is not None


def test_flow_is_asked_for_only_where_it_is_used():
    no_flow = {"operation.oil_flow": "none"}
    assert load_scene("turbine_roller", no_flow | {"contact": "none", "cage": "none"}).drag is not None
    assert load_scene("turbine_roller", no_flow | {"drag": "none"}).operation.oil_flow == 0.0
    with pytest.raises(SceneError, match="oil_flow"):
        load_scene("turbine_roller", no_flow)


def test_set_material_by_name_that_is_a_number():
    steel = load_scene("turbine_roller", {"materials.rings": "52100"}).materials.rings
    np.testing.assert_allclose(steel.youngs_modulus, 208e9, rtol=1e-12)


def test_traction_alias():
    mean = {"contact.traction": "ree_eyring", "contact.traction_model": "mean_pressure"}
    assert isinstance(load_scene("turbine_roller", mean).contact.traction, MeanPressureTraction)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("1.5", 1.5),
        (".3", 0.3),
        ("-1.", -1.0),
        ("+.5e2", 50.0),
        ("true", True),
        ("12000 rpm", "12000 rpm"),
        ('"a"', "a"),
        ("'a'", "a"),
        ("a\nb = 3", "a\nb = 3"),
        ("1\nb = 3", "1\nb = 3"),
        ("9" * 5000, "9" * 5000),
        ("{a = 1}", {"a": 1}),
    ],
    ids=lambda value: str(value)[:12],
)
def test_override_values_are_toml_or_text(text, value):
    assert parse_value(text) == value


def test_assignments():
    assert split_assignments(["a.b = 1 ", "a.c=x=y", "a.b=2"]) == {"a.b": "2", "a.c": "x=y"}


@pytest.mark.parametrize("text", ["a", "=1", "a=", "a..b=1", ".a=1", ""])
def test_broken_assignments(text):
    with pytest.raises(SceneError, match="--set"):
        split_assignments([text])


@pytest.mark.parametrize("name", oil_names())
def test_oil_files_are_complete_and_say_their_sources(name):
    assert missing_sources(oil_data(name)) == []
    assert load_oil(name).pressure_viscosity is not None


def test_a_missing_source_is_named():
    data = oil_data("mobil_jet_ii")
    del data["viscosity"]["sources"]["c1"]
    assert missing_sources(data) == ["viscosity.c1"]


def test_unknown_oil():
    with pytest.raises(SceneError, match="Did you mean 'mobil_jet_ii'"):
        load_oil("mobil_jet_2")


def test_oil_from_tables_alone():
    raw = tomllib.loads(builtin_text("turbine_roller"))
    tables = oil_data("mobil_jet_ii")
    raw["oil"] = {name: table for name, table in tables.items() if isinstance(table, dict)}
    raw["oil"]["pressure_viscosity"] = {"law": "integrated"}
    oil = scene_from_tables(raw).oil
    assert isinstance(oil.pressure_viscosity, IntegratedPressureViscosity)
    assert oil.pressure_viscosity.viscosity is oil.viscosity


def test_fields_of_the_file_are_those_of_the_classes():
    """One word list: every name that the schema knows is an attribute of the part that it builds, except for how the
    traction law is made."""
    scene = load_scene("turbine_roller")
    raw = tomllib.loads(builtin_text("turbine_roller"))
    for table in ("geometry", "operation", "cage", "flange", "drag", "contact", "materials"):
        attributes = {field.name for field in dataclasses.fields(getattr(scene, table))}
        assert set(raw[table]) - {"traction_model", "traction_accuracy"} <= attributes


def test_no_array_is_on_a_device():
    """Reading a scene must not start JAX: parameters are Python or numpy numbers."""
    import jax

    assert not any(isinstance(leaf, jax.Array) for leaf in jax.tree.leaves(load_scene("turbine_roller")))


@pytest.mark.parametrize("name", builtin_names())
def test_summaries_are_whole_sentences(name):
    assert builtin_summary(name).endswith(".")


def test_numbers_from_python_stand_for_what_would_be_typed():
    scene = load_scene("turbine_roller", {"drag.coefficient": 0.9, "geometry.n_rollers": 28})
    assert float(scene.drag.coefficient) == 0.9
    assert scene.geometry.n_rollers == 28
    with pytest.raises(SceneError, match=r"contact\.traction_model: .*a list"):
        load_scene("turbine_roller", {"contact.traction_model": ["mean_pressure"]})
    with pytest.raises(SceneError, match=r"operation\.inner_speed"):
        load_scene("turbine_roller", {"operation.inner_speed": 12000})


def test_numbers_of_numpy_and_jax():
    """They are the same numbers; arrays and traced values are no numbers of a file."""
    mapping = {"geometry.n_balls": 12, "geometry.conformity_inner": 0.515625, "contact.heathcote": True}
    plain = load_scene("turbine_ball", mapping)
    for make in (np.asarray, jnp.asarray, lambda value: np.asarray(value)[()], lambda value: np.float32(value)):
        changes = {path: make(value) if value == 0.515625 else np.asarray(value)[()] for path, value in mapping.items()}
        found = load_scene("turbine_ball", changes)
        assert found.geometry.n_balls == plain.geometry.n_balls
        assert type(found.geometry.n_balls) is int
        assert found.geometry.conformity_inner == plain.geometry.conformity_inner
        assert found.contact.heathcote is True
        assert found.replace(changes if make is np.asarray else {}).geometry.n_balls == 12
    with pytest.raises(SceneError, match=r"geometry\.conformity_inner: found a ndarray; expected text"):
        load_scene("turbine_ball", {"geometry.conformity_inner": np.ones(1)})
    with pytest.raises(SceneError, match=r"geometry\.conformity_inner: found a traced value; expected text"):
        jax.jit(lambda x: load_scene("turbine_ball", {"geometry.conformity_inner": x}).geometry.conformity_inner)(0.52)
    # in the tables themselves, and in lists of them
    tables = tomllib.loads(builtin_text("two_disk_etm"))
    tables["operation"]["slide_to_roll"] = [np.int64(0), np.float32(0.25)]
    assert list(scene_from_tables(tables).operation.slide_to_roll) == [0.0, 0.25]
