"""The scene file of a two-disk machine: what it builds, and one clear message for everything that is wrong with it."""

import tomllib

import jax
import numpy as np
import pytest
from two_disk_cases import mobil_jet_ii

from jaxbearing.contacts import (
    BairWiner,
    ElsharkawyHamrock,
    FilmHeating,
    GecimWiner,
    GivenCompliance,
    Gupta,
    HamrockDowsonCentral,
    HsuLee,
    NijenbanningVennerMoes,
    NoThermalReduction,
    ReeEyring,
    Resolution,
)
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.laws import ANY_FILMS, LINE_FILMS, POINT_FILMS
from jaxbearing.scenes.reader import builtin_text, load_scene, scene_from_tables

NAME = "two_disk_mobil_jet_ii"
LINE = {"geometry.contact_length": "10 mm", "contact.film": "moes"}
WATER = {"oil.viscosity": "{law = 'constant', value = '4.8 mPa*s'}"}


def scene(**changes):
    return load_scene(NAME, {path.replace("__", "."): value for path, value in changes.items()})


def operation(**changes):
    return load_scene(NAME, {f"operation.{name}": value for name, value in changes.items()}).operation


def contact(name=NAME, **changes):
    return load_scene(name, {f"contact.{field}": value for field, value in changes.items()}).contact


def raw():
    return tomllib.loads(builtin_text(NAME))


def test_file_and_python_are_the_same_scene():
    read, built = load_scene(NAME), mobil_jet_ii()
    assert jax.tree.structure(read) == jax.tree.structure(built)
    for (path, a), b in zip(jax.tree_util.tree_leaves_with_path(read), jax.tree.leaves(built), strict=True):
        # one conversion of units
        np.testing.assert_allclose(a, b, rtol=1e-12, err_msg=jax.tree_util.keystr(path))


def test_no_array_is_on_a_device():
    for name in (NAME, "two_disk_pennzane", "two_disk_etm"):
        assert not any(isinstance(leaf, jax.Array) for leaf in jax.tree.leaves(load_scene(name)))


def test_pennzane():
    read = load_scene("two_disk_pennzane")
    assert isinstance(read.contact.film, NijenbanningVennerMoes)
    assert isinstance(read.contact.thermal, Gupta)
    assert read.contact.warm_inlet
    law = read.contact.traction
    assert isinstance(law.viscous, ElsharkawyHamrock)
    assert law.viscous.exponent == 2.0
    assert isinstance(law.heating, FilmHeating)
    np.testing.assert_allclose(read.oil.conductivity.conductivity(313.0), 0.14, rtol=1e-12)
    slide = np.asarray(read.operation.slide_to_roll)
    np.testing.assert_array_equal(slide, -slide[::-1])
    assert (slide.min(), slide.max()) == (-0.2, 0.2)
    np.testing.assert_allclose(read.operation.pressure, [0.6e9, 1.2e9, 1.8e9], rtol=1e-12)
    assert len([text for text in read.assumptions() if "0.14 W/(m K) is assumed" in text]) == 1


def test_etm():
    read = load_scene("two_disk_etm")
    np.testing.assert_allclose(read.operation.load, [1647.0])
    np.testing.assert_allclose(read.operation.entrainment_speed, [0.025])
    np.testing.assert_allclose(read.operation.temperature, [313.15])
    np.testing.assert_allclose(read.geometry.reduced_radius_rolling, 0.5 * 19.05e-3)
    assert read.operation.pressure is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.05", [0.05]),
        ("-1", [-1.0]),
        ("5 %", [0.05]),
        ("'5%'", [0.05]),
        ("[0, 0.1, '-20 %', ' 1e-2 % ']", [0.0, 0.1, -0.2, 1e-4]),
        ("{start = -0.2, stop = '20 %', count = 5}", [-0.2, -0.1, 0.0, 0.1, 0.2]),
        ("{start = '0.1 %', stop = '10 %', count = 3, spacing = 'log'}", [1e-3, 1e-2, 1e-1]),
        ("{start = -1e-3, stop = -0.1, count = 3, spacing = 'log'}", [-1e-3, -1e-2, -1e-1]),
        ("{start = 0.3, stop = 0.3, count = 1}", [0.3]),
    ],
)
def test_slide_to_roll(text, expected):
    np.testing.assert_allclose(operation(slide_to_roll=text).slide_to_roll, expected, rtol=1e-12, atol=1e-17)


def test_a_range_can_be_changed_in_part():
    read = load_scene(NAME, {"operation.slide_to_roll.count": "3", "operation.slide_to_roll.stop": "1 %"})
    np.testing.assert_allclose(read.operation.slide_to_roll, [1e-4, 1e-3, 1e-2], rtol=1e-12)


def test_one_or_several():
    read = operation(temperature="['297 K', '100 degC']", entrainment_speed="25 mm/s", pressure="['1 GPa']")
    np.testing.assert_allclose(read.temperature, [297.0, 373.15])
    np.testing.assert_allclose(read.entrainment_speed, [0.025])
    np.testing.assert_allclose(read.pressure, [1e9])


def test_set_of_load_or_pressure_takes_the_other_out():
    loaded = operation(load="1647 N")
    assert loaded.pressure is None
    np.testing.assert_allclose(loaded.load, [1647.0])
    pressed = load_scene("two_disk_etm", {"operation.pressure": "1 GPa"}).operation
    assert pressed.load is None
    with pytest.raises(SceneError, match=r"operation\.pressure: found both of pressure and load"):
        operation(load="1647 N", pressure="1 GPa")
    both = raw()
    both["operation"]["load"] = "1 N"
    with pytest.raises(SceneError, match=r"operation\.pressure: found both of pressure and load"):
        scene_from_tables(both)


@pytest.mark.parametrize(
    ("name", "law"),
    [
        ("ree_eyring", ReeEyring),
        ("bair_winer", BairWiner),
        ("gecim_winer", GecimWiner),
        ("elsharkawy_hamrock", ElsharkawyHamrock),
    ],
)
def test_traction(name, law):
    laws = contact(traction=name)
    assert isinstance(laws.traction.viscous, law)
    assert laws.traction.resolution == Resolution.for_accuracy(1e-4)
    misfit = [text for text in scene(contact__traction=name).assumptions() if "was fitted with" in text]
    assert misfit == (
        [] if name == "ree_eyring" else [f"contact.traction is {name}, the oil's rheology was fitted with ree_eyring"]
    )


@pytest.mark.parametrize("name", POINT_FILMS)
def test_point_film(name):
    assert isinstance(
        contact(film=name).film, {"hamrock_dowson": HamrockDowsonCentral}.get(name, NijenbanningVennerMoes)
    )


@pytest.mark.parametrize("name", LINE_FILMS)
def test_line_film_is_the_plain_formula(name):
    read = load_scene(NAME, {**LINE, "contact.film": name})
    assert type(read.contact.film) is LINE_FILMS[name]
    assert isinstance(load_scene(NAME, {**LINE, "contact.thermal": "hsu_lee"}).contact.thermal, HsuLee)


def test_how_the_laws_are_put_together():
    plain = contact()
    assert isinstance(plain.thermal, NoThermalReduction)
    assert (plain.traction.compliance, plain.traction.heating, plain.traction.elastic) == (None, None, True)
    assert not plain.half_space_compliance
    given = contact(
        traction_accuracy="1e-6",
        compliance="1e-15 m/Pa",
        film_heating="true",
        inlet="cold",
        elastic="false",
        thermal="gupta",
    )
    assert given.traction.resolution == Resolution.for_accuracy(1e-6)
    assert isinstance(given.traction.compliance, GivenCompliance)
    np.testing.assert_allclose(given.traction.compliance.value, 1e-15)
    assert isinstance(given.traction.heating, FilmHeating)
    assert (given.warm_inlet, given.traction.elastic) == (False, False)
    assert contact(compliance="half_space").half_space_compliance
    assert contact(compliance="1 nm/GPa").traction.compliance.value == pytest.approx(1e-18)


def test_materials_by_name_or_table():
    read = load_scene(NAME, {"materials.body_1": "52100", "materials.body_2.poisson_ratio": "0.25"})
    np.testing.assert_allclose(read.materials.body_1.youngs_modulus, 208e9)
    np.testing.assert_allclose(read.materials.body_2.poisson_ratio, 0.25)


def test_isoviscous_oils():
    assert set(ANY_FILMS.isoviscous) == {"moes", "nijenbanning"}
    assert set(ANY_FILMS) == set(LINE_FILMS) | set(POINT_FILMS)
    load_scene(NAME, WATER)
    with pytest.raises(SceneError, match=r"contact\.film: found 'hamrock_dowson'; expected one of 'nijenb"):
        load_scene(NAME, {**WATER, "contact.film": "hamrock_dowson"})


def test_an_oil_may_bring_its_own_conductivity():
    read = load_scene("two_disk_pennzane", {"oil.conductivity": "0.12 W/(m*K)"})
    np.testing.assert_allclose(read.oil.conductivity.conductivity(300.0), 0.12)
    assert not [text for text in read.assumptions() if "is assumed" in text]


# name: (changes, path, words of the message)
WRONG = {
    "unknown field": ({"operation.slide_to_rol": "0.1"}, "operation.slide_to_rol", ["Did you mean 'slide_to_roll'"]),
    "unknown table": ({"cage.guidance": "inner_ring"}, "cage", ["unknown name 'cage'"]),
    "unknown film": ({"contact.film": "nijenbaning"}, "contact.film", ["Did you mean 'nijenbanning'"]),
    "film of a line": ({"contact.film": "moes"}, "contact.film", ["point contact", "'nijenbanning', 'hamrock_dowson'"]),
    "film of a point": ({"geometry.contact_length": "1 cm"}, "contact.film", ["line contact", "'moes'"]),
    "both shapes": (
        {**LINE, "geometry.reduced_radius_transverse": "10 mm"},
        "geometry.reduced_radius_transverse",
        ["10 mm", "contact_length"],
    ),
    "thermal of a line": ({"contact.thermal": "hsu_lee"}, "contact.thermal", ["'hsu_lee'", "point contact", "'gupta'"]),
    "unknown traction": ({"contact.traction": "ree"}, "contact.traction", ["'ree_eyring'"]),
    "no traction": ({"contact.traction": "none"}, "contact.traction", ["found nothing", "required"]),
    "accuracy": ({"contact.traction_accuracy": "1e-5"}, "contact.traction_accuracy", ["1e-05", "0.01, 0.001"]),
    "accuracy as text": ({"contact.traction_accuracy": "'1e-4'"}, "contact.traction_accuracy", ["without quotes"]),
    "bare compliance": ({"contact.compliance": "1e-15"}, "contact.compliance", ["bare number", "'half_space' or"]),
    "negative compliance": ({"contact.compliance": "-1e-15 m/Pa"}, "contact.compliance", ["'half_space' or"]),
    "compliance in words": ({"contact.compliance": "half_spce"}, "contact.compliance", ["Did you mean 'half_space'"]),
    "compliance of another kind": ({"contact.compliance": "1 GPa"}, "contact.compliance", ["another kind", "m/Pa"]),
    "heating": ({"contact.film_heating": "'yes'"}, "contact.film_heating", ["true or false"]),
    "elastic": ({"contact.elastic": "1"}, "contact.elastic", ["true or false"]),
    "inlet": ({"contact.inlet": "wram"}, "contact.inlet", ["Did you mean 'warm'"]),
    "neither pressure nor load": ({"operation.pressure": "none"}, "operation.pressure", ["neither of"]),
    "bare pressure": ({"operation.pressure": "1e9"}, "operation.pressure", ["bare number", "list of such texts"]),
    "negative pressure": ({"operation.pressure": "-1 GPa"}, "operation.pressure", ["> 0", "'-1 GPa'"]),
    "pressure in newton": ({"operation.pressure": "1647 N"}, "operation.pressure", ["another kind"]),
    "zero load": ({"operation.load": "['1 N', '0 N']"}, "operation.load", ["'0 N' (value 2 of 2)", "> 0"]),
    "bare number in a list": (
        {"operation.temperature": "['297 K', 378]"},
        "operation.temperature",
        ["bare number 378 (value 2 of 2)"],
    ),
    "absolute zero": ({"operation.temperature": "-300 degC"}, "operation.temperature", ["above absolute zero"]),
    "empty list": ({"operation.temperature": "[]"}, "operation.temperature", ["an empty list"]),
    "nested list": ({"operation.temperature": "[['1 K']]"}, "operation.temperature", ["an array"]),
    "zero speed": ({"operation.entrainment_speed": "0 m/s"}, "operation.entrainment_speed", ["> 0"]),
    "speed in rpm": ({"operation.entrainment_speed": "3 rpm"}, "operation.entrainment_speed", ["another kind"]),
    "missing speed": (
        {"operation.entrainment_speed": "none"},
        "operation.entrainment_speed",
        ["required: a speed > 0"],
    ),
    "missing slide": ({"operation.slide_to_roll": "none"}, "operation.slide_to_roll", ["required: a number"]),
    "empty slides": ({"operation.slide_to_roll": "[]"}, "operation.slide_to_roll", ["an empty list"]),
    "slide with a unit": ({"operation.slide_to_roll": "5 m/s"}, "operation.slide_to_roll", ["'5 m/s'", "per cent"]),
    "slide as text": ({"operation.slide_to_roll": "'0.05'"}, "operation.slide_to_roll", ["'0.05'", "('5 %')"]),
    "slide not finite": ({"operation.slide_to_roll": "[nan]"}, "operation.slide_to_roll", ["not finite"]),
    "slide not finite in per cent": ({"operation.slide_to_roll": "inf %"}, "operation.slide_to_roll", ["'inf %'"]),
    "boolean slide": ({"operation.slide_to_roll": "true"}, "operation.slide_to_roll", ["boolean"]),
    "logarithm of zero": (
        {"operation.slide_to_roll.start": "0"},
        "operation.slide_to_roll.start",
        ["one sign", "'log'"],
    ),
    "range without a count": (
        {"operation.slide_to_roll": "{start = 0, stop = 1}"},
        "operation.slide_to_roll.count",
        [],
    ),
    "count": ({"operation.slide_to_roll.count": "0"}, "operation.slide_to_roll.count", [">= 1"]),
    "unknown name in a range": (
        {"operation.slide_to_roll.spacin": "log"},
        "operation.slide_to_roll.spacin",
        ["Did you mean 'spacing'"],
    ),
    "spacing": ({"operation.slide_to_roll.spacing": "lin"}, "operation.slide_to_roll.spacing", ["'linear'"]),
    "no rheology": ({"oil.name": "nye_186a"}, "oil.rheology", ["contact.traction = 'ree_eyring' needs"]),
    "material": ({"materials.body_1": "M51"}, "materials.body_1", ["Did you mean 'M50'"]),
    "missing material": ({"materials.body_2": "none"}, "materials.body_2", ["required"]),
    "zero radius": ({"geometry.reduced_radius_rolling": "0 mm"}, "geometry.reduced_radius_rolling", ["> 0"]),
    "missing radius": ({"geometry.reduced_radius_rolling": "none"}, "geometry.reduced_radius_rolling", ["a length"]),
    "missing table": ({"contact": "none"}, "contact", ["found nothing", "'film', 'traction'"]),
    "field of a bearing": ({"operation.radial_load": "1 N"}, "operation.radial_load", ["'load'"]),
}


@pytest.mark.parametrize("case", WRONG)
def test_one_message(case):
    changes, path, words = WRONG[case]
    with pytest.raises(SceneError) as caught:
        load_scene(NAME, changes)
    message = str(caught.value)
    assert caught.value.path == path, message
    assert "\n" not in message
    assert "pydantic" not in message
    for word in ("found", "expected", *words):
        assert word in message, message


def conductivity_left_out(**contact_fields):
    """The oil without its conductivity, which its name would bring back."""
    from jaxbearing.scenes.oil.catalogue import oil_data

    tables = raw()
    tables["oil"] = {name: law for name, law in oil_data("mobil_jet_ii").items() if name != "conductivity"}
    del tables["oil"]["name"]
    tables["contact"] |= contact_fields
    return tables


@pytest.mark.parametrize(
    ("fields", "user"),
    [({"thermal": "gupta"}, "contact.thermal = 'gupta'"), ({"film_heating": True}, "contact.film_heating")],
    ids=str,
)
def test_heat_needs_a_conductivity(fields, user):
    scene_from_tables(conductivity_left_out())
    with pytest.raises(SceneError) as caught:
        scene_from_tables(conductivity_left_out(**fields))
    assert caught.value.path == "oil.conductivity"
    assert f"the law of conductivity, which {user} needs" in str(caught.value)
