"""The oil of a scene file: laws, defaults, texts for laws, refusals."""

import jax
import numpy as np
import pytest
from pydantic import ValidationError

from jaxbearing.lubricants import (
    Barus,
    ConstantViscosity,
    FittedPressureViscosity,
    IntegratedPressureViscosity,
    ModifiedWLF,
    NoPressureViscosity,
    Roelands,
    WaltherRoelands,
)
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.oil import catalogue as oils
from jaxbearing.scenes.oil import writer as oil_writer
from jaxbearing.scenes.oil.schema import OilTable
from jaxbearing.scenes.problems import from_validation
from jaxbearing.scenes.reader import load_scene

TWO_VISCOSITIES = {
    "law": "two_viscosities",
    "viscosity_1": "32 cSt",
    "temperature_1": "40 degC",
    "viscosity_2": "5.4 mm^2/s",
    "temperature_2": "100 degC",
}
BARUS = {
    "law": "barus",
    "reference_viscosity": "30 mPa*s",
    "reference_temperature": "40 degC",
    "pressure_viscosity": "20 1/GPa",
    "temperature_viscosity": "0 K",
}
ROELANDS = {
    "law": "roelands",
    "reference_viscosity": "30 mPa*s",
    "reference_temperature": "313.15 K",
    "pressure_exponent": 0.6,
    "temperature_exponent": 1.1,
}


def read(**table):
    return oils.lubricant(OilTable.model_validate(oils.with_catalogue(table)))


def without(table, *names):
    return {name: value for name, value in table.items() if name not in names}


def test_the_oil_of_a_data_sheet():
    oil = read(viscosity=TWO_VISCOSITIES, density="870 kg/m^3", conductivity="0.14 W/(m*K)")
    assert isinstance(oil.viscosity, WaltherRoelands)
    assert isinstance(oil.pressure_viscosity, IntegratedPressureViscosity)
    assert oil.pressure_viscosity.viscosity is oil.viscosity
    assert not any(isinstance(leaf, jax.Array) for leaf in jax.tree.leaves(oil))
    hot = oil.at(373.15)
    np.testing.assert_allclose(hot.viscosity, 870 * 5.4e-6, rtol=1e-13)
    np.testing.assert_allclose([hot.density, oil.at(300.0).density], 870.0, rtol=1e-15)
    np.testing.assert_allclose([hot.conductivity, oil.at(300.0).conductivity], 0.14, rtol=1e-13)
    assert len(oil.notes) == 1
    assert "estimated" in oil.notes[0]


def test_alpha_of_a_data_sheet_is_no_estimate():
    oil = read(viscosity={**TWO_VISCOSITIES, "pressure_viscosity": "20 1/GPa"}, density="870 kg/m^3")
    np.testing.assert_allclose(jax.grad(oil.viscosity.log_viscosity)(0.0, 313.15), 20e-9, rtol=1e-12)
    assert oil.notes == ()


def test_other_laws():
    barus = read(viscosity=BARUS)
    assert isinstance(barus.viscosity, Barus)
    np.testing.assert_allclose(barus.at(350.0).pressure_viscosity, 20e-9, rtol=1e-11)
    roelands = read(viscosity=ROELANDS)
    assert isinstance(roelands.viscosity, Roelands)
    assert isinstance(roelands.pressure_viscosity, IntegratedPressureViscosity)
    np.testing.assert_allclose(roelands.at(313.15).viscosity, 0.03, rtol=1e-13)
    water = read(viscosity={"law": "constant", "value": "1 mPa*s"})
    assert isinstance(water.viscosity, ConstantViscosity)
    assert isinstance(water.pressure_viscosity, NoPressureViscosity)
    assert water.at(300.0).pressure_viscosity == 0.0


def test_heat_capacity_is_read_and_written():
    """A number, or a linear law; the oils of the source have none."""
    of_the_source = ("fomblin_z25", "mobil_jet_ii", "nye_186a", "pennzane_x2000")
    assert all(oils.load_oil(name).heat_capacity is None for name in of_the_source)
    constant = read(name="mobil_jet_ii", heat_capacity="2.15 kJ/(kg*K)")
    np.testing.assert_allclose(constant.heat_capacity.heat_capacity(400.0), 2150.0, rtol=1e-15)
    law = {"value": "1670 J/(kg*K)", "slope": "4.3 J/(kg*K^2)", "reference_temperature": "273 K"}
    linear = read(name="mobil_jet_ii", heat_capacity={"law": "linear", **law})
    np.testing.assert_allclose(linear.heat_capacity.heat_capacity(373.0), 2100.0, rtol=1e-15)
    for oil in (constant, linear):
        for written in (oil_writer.scene_oil(oil), {"name": "mobil_jet_ii", **oil_writer.sourced_laws(oil)}):
            assert read(**written).heat_capacity == oil.heat_capacity
    assert oil_writer.scene_oil(constant) == {"name": "mobil_jet_ii", "heat_capacity": "2150 J/(kg*K)"}


def test_catalogue():
    pennzane = oils.load_oil("pennzane_x2000")
    assert (pennzane.rheology.viscous_function, pennzane.rheology.exponent) == ("elsharkawy_hamrock", 2.0)
    mobil = oils.load_oil("mobil_jet_ii")
    assert (mobil.rheology.viscous_function, mobil.rheology.exponent) == ("ree_eyring", None)
    assert mobil.notes == ()
    assert oils.load_oil("nye_186a").density is None
    for name in ("nye_186a", "fomblin_z25"):
        assert oils.load_oil(name).rheology is None
        with pytest.raises(SceneError, match=r"oil\.rheology: found nothing; expected the law of rheology"):
            load_scene("turbine_roller", {"oil.name": name})


def test_a_note_leaves_with_the_value_it_is_about():
    assert len(oils.load_oil("pennzane_x2000").notes) == 1
    assert read(name="pennzane_x2000", conductivity="0.15 W/(m*K)").notes == ()
    assert read(name="pennzane_x2000", conductivity={"value": "0.15 W/(m*K)"}).notes == ()
    assert len(read(name="pennzane_x2000", density="860 kg/m^3").notes) == 1


def test_changed_viscosity_has_its_own_coefficient():
    same = read(name="mobil_jet_ii", viscosity={"c1": 16.342})
    assert isinstance(same.pressure_viscosity, FittedPressureViscosity)
    changed = read(name="mobil_jet_ii", viscosity={"c1": 16.0})
    assert isinstance(changed.viscosity, ModifiedWLF)
    assert isinstance(changed.pressure_viscosity, IntegratedPressureViscosity)
    replaced = read(name="mobil_jet_ii", viscosity=TWO_VISCOSITIES)
    assert isinstance(replaced.pressure_viscosity, IntegratedPressureViscosity)
    assert replaced.viscosity.density is replaced.density
    given = read(name="mobil_jet_ii", viscosity={"c1": 16.0}, pressure_viscosity="10 1/GPa")
    np.testing.assert_allclose(given.at(300.0).pressure_viscosity, 10e-9, rtol=1e-14)


def test_scene_with_an_oil_of_a_data_sheet():
    overrides = {f"oil.viscosity.{name}": value for name, value in TWO_VISCOSITIES.items()}
    overrides |= {"oil": "{conductivity = '0.14 W/(m*K)', density = '870 kg/m^3'}", "contact.traction": "none"}
    overrides |= {"cage": "none", "flange": "none", "drag": "none"}
    ordered = {"oil": overrides.pop("oil"), **overrides}
    scene = load_scene("turbine_roller", ordered)
    assert isinstance(scene.oil.viscosity, WaltherRoelands)


DENSE = {"density": "870 kg/m^3"}
REFUSALS = {
    "no_density": ({"viscosity": TWO_VISCOSITIES}, "density", ["nothing", "'870 kg/m^3'"]),
    "no_viscosity": ({}, "viscosity", ["nothing", "'name'"]),
    "unknown_law": ({"viscosity": {"law": "walther", "a": 3}}, "viscosity.law", ["'walther'", "'two_viscosities'"]),
    "misspelt_law": ({"viscosity": {"law": "two_viscosity"}}, "viscosity.law", ["Did you mean 'two_viscosities'"]),
    "no_law": ({"viscosity": {"value": "1 mPa*s"}}, "viscosity.law", ["nothing", "required"]),
    "viscosity_is_a_text": ({"viscosity": "32 cSt"}, "viscosity", ["the text '32 cSt'", "a table with a 'law'"]),
    "missing_parameter": (
        {"viscosity": without(TWO_VISCOSITIES, "viscosity_2"), **DENSE},
        "viscosity.viscosity_2",
        ["nothing", "required"],
    ),
    "unknown_parameter": (
        {"viscosity": {**TWO_VISCOSITIES, "pressure_viscosty": "20 1/GPa"}, **DENSE},
        "viscosity.pressure_viscosty",
        ["Did you mean 'pressure_viscosity'"],
    ),
    "dynamic_for_kinematic": (
        {"viscosity": {**TWO_VISCOSITIES, "viscosity_2": "5 mPa*s"}, **DENSE},
        "viscosity.viscosity_2",
        ["of another kind", "'32 cSt'"],
    ),
    "temperatures_in_the_wrong_order": (
        {"viscosity": {**TWO_VISCOSITIES, "temperature_2": "30 degC"}, **DENSE},
        "viscosity.temperature_2",
        ["30 degC", "above temperature_1, 40 degC"],
    ),
    "viscosity_that_rises": (
        {"viscosity": {**TWO_VISCOSITIES, "viscosity_2": "33 cSt"}, **DENSE},
        "viscosity.viscosity_2",
        ["33 cSt", "less than viscosity_1, 32 cSt"],
    ),
    "viscosity_too_small": (
        {"viscosity": {**TWO_VISCOSITIES, "viscosity_2": "0.29 cSt"}, **DENSE},
        "viscosity.viscosity_2",
        ["> 0.3 cSt"],
    ),
    "density_without_unit": ({"viscosity": TWO_VISCOSITIES, "density": 870}, "density", ["bare number 870", "kg/m^3"]),
    "conductivity_of_another_kind": (
        {"viscosity": BARUS, "conductivity": "0.14 W"},
        "conductivity",
        ["of another kind", "W/(m*K)"],
    ),
    "density_law": ({"viscosity": BARUS, "density": {"law": "linar"}}, "density.law", ["Did you mean 'linear'"]),
    "barus_without_temperature": (
        {"viscosity": without(BARUS, "temperature_viscosity")},
        "viscosity.temperature_viscosity",
        ["required"],
    ),
    "roelands_too_thin": (
        {"viscosity": {**ROELANDS, "reference_viscosity": "0.06 mPa*s"}},
        "viscosity.reference_viscosity",
        ["0.06 mPa*s", "0.063"],
    ),
    "roelands_too_cold": (
        {"viscosity": {**ROELANDS, "reference_temperature": "130 K"}},
        "viscosity.reference_temperature",
        ["130 K", "138 K"],
    ),
    "nothing_to_integrate": (
        {"viscosity": {"law": "constant", "value": "1 mPa*s"}, "pressure_viscosity": {"law": "integrated"}},
        "pressure_viscosity.law",
        ["'integrated'", "constant"],
    ),
    "viscous_function": (
        {"name": "mobil_jet_ii", "rheology": {"viscous_function": "ree_eyrng"}},
        "rheology.viscous_function",
        ["Did you mean 'ree_eyring'"],
    ),
    "exponent_missing": (
        {"name": "mobil_jet_ii", "rheology": {"viscous_function": "elsharkawy_hamrock"}},
        "rheology.exponent",
        ["nothing", "e.g. 2"],
    ),
    "exponent_of_another_law": (
        {"name": "mobil_jet_ii", "rheology": {"exponent": 2}},
        "rheology.exponent",
        ["the number 2", "'elsharkawy_hamrock'"],
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals_are_one_message(name):
    table, path, words = REFUSALS[name]
    with pytest.raises(ValidationError) as caught:
        OilTable.model_validate(oils.with_catalogue(table))
    message = str(from_validation(caught.value, OilTable, "oil.toml"))
    assert message.startswith(f"oil.toml: {path}: found ")
    assert all(word in message for word in words), message
    assert "pydantic" not in message
    assert "problems" not in message


@pytest.mark.parametrize("field", ["pressure_viscosity", "conductivity", "viscosity", "rheology.viscous_function"])
def test_taking_out_what_the_catalogue_brings_back_is_refused(field):
    with pytest.raises(SceneError, match="catalogue's mobil_jet_ii"):
        load_scene("turbine_roller", {f"oil.{field}": "none"})


def test_another_viscous_function_leaves_the_exponent_of_the_catalogue_out():
    changes = {"oil.name": "pennzane_x2000", "oil.rheology.viscous_function": "ree_eyring"}
    rheology = load_scene("turbine_roller", changes).oil.rheology
    assert (rheology.viscous_function, rheology.exponent) == ("ree_eyring", None)
