"""Standard oils in scenes: names as people type them, refusals, saving, priors, bearings from a catalogue alone."""

from pathlib import Path

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.lubricants import IntegratedPressureViscosity, ProportionalRheology, WaltherPower
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.oil import grades
from jaxbearing.scenes.oil import writer as oil_writer
from jaxbearing.scenes.reader import load_scene, oil_origins
from jaxbearing.sweeps.fields import SceneSource
from jaxbearing.tolerance.scatter import scatter_of_source

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
SCENE = "turbine_roller"
PRIORS = {
    "oil.viscosity.pressure_coefficient": (6.4376e-9, 9.904e-9, 13.3704e-9),
    "oil.rheology.stress_ratio": (0.04, 0.07, 0.1),
    "oil.rheology.shear_modulus_ratio": (0.005, 0.02, 0.035),
}


def oil_of(**table):
    return load_scene(SCENE, {f"oil.{name}": value for name, value in table.items()}).oil


@pytest.mark.parametrize("grade", ["ISO VG 68", "iso vg 68", "VG 68", "ISO VG68", "VG68", "ISO-VG-68", "68"])
def test_names_of_a_grade(grade):
    assert oil_writer.scene_oil(oil_of(grade=grade)) == {"grade": "ISO VG 68", "base": "mineral"}


@pytest.mark.parametrize(
    ("base", "meant"), [("PAO", "PAO"), ("pao", "PAO"), ("Polyglycol", "polyglycol"), ("PAG", "polyglycol")]
)
def test_names_of_a_base_stock(base, meant):
    oil = oil_of(grade="ISO VG 220", base=base)
    assert oil_writer.scene_oil(oil) == {"grade": "ISO VG 220", "base": meant}


@pytest.mark.parametrize("name", ["FVA3", "fva3", "Mobil Jet II", "MOBIL_JET_II"])
def test_names_of_the_catalogue(name):
    known = "fva3" if name.lower() == "fva3" else "mobil_jet_ii"
    assert oil_writer.scene_oil(oil_of(name=name)) == {"name": known}
    assert oil_writer.scene_oil(jb.load_oil(name)) == {"name": known}


def test_oil_of_a_grade():
    oil = oil_of(grade="ISO VG 32")
    assert isinstance(oil.viscosity, WaltherPower)
    assert isinstance(oil.rheology, ProportionalRheology)
    assert oil.pressure_viscosity.viscosity is oil.viscosity
    assert oil.viscosity.density is oil.density
    assert (oil.rheology.viscous_function, oil.rheology.exponent) == ("elsharkawy_hamrock", 2.0)
    coefficient, note = oil.notes
    assert "9.904 (nu/cSt)^0.139 1/GPa, a prior of +-35 %" in coefficient
    assert "a prior" in note
    assert "0.07 of the pressure (0.04 to 0.1)" in note
    assert all(
        word in oil_origins(SCENE, {"oil.grade": "ISO VG 32"})["density"].sources["value"]
        for word in ("GEARpie", "15 C")
    )


def test_python_takes_a_grade():
    oil = jb.load_oil("VG 100", base="PAO")
    np.testing.assert_allclose(1e6 * oil.at(313.15).viscosity / oil.density.density(313.15), 99.404, rtol=1e-5)
    with pytest.raises(SceneError, match=r"base: found the text 'PA'; expected a base stock"):
        jb.load_oil("VG 100", base="PA")
    tables = {"oil": {"grade": "ISO VG 68"}}
    assert "ISO VG 68" in oil_writer.oil_text(jb.load_oil("68"), "my_oil", "standard oil, ISO VG 68", [])
    assert tables["oil"] == {"grade": "ISO VG 68"}


def test_the_grade_takes_the_place_of_the_oil_of_the_scene():
    """`turbine_roller` names an oil; `reference_roller` changes its coefficient too, which goes with it."""
    oil = load_scene("reference_roller", {"oil.grade": "ISO VG 46"}).oil
    assert isinstance(oil.pressure_viscosity, IntegratedPressureViscosity)
    back = load_scene(EXAMPLES / "catalogue_nu311.toml", {"oil.name": "mobil_jet_ii"}).oil
    assert oil_writer.scene_oil(back) == {"name": "mobil_jet_ii"}


REFUSALS = {
    "between": ({"grade": "ISO VG 70"}, "oil.grade", "Did you mean 'ISO VG 68'?"),
    "beyond": ({"grade": "ISO VG 1000"}, "oil.grade", "Did you mean 'ISO VG 680'?"),
    "no_grade": ({"grade": "SAE 30"}, "oil.grade", "an ISO viscosity grade: one of 'ISO VG 32', "),
    "other_base": ({"grade": "ISO VG 68", "base": "PAO"}, "oil.grade", "Did you mean 'ISO VG 100'?"),
    "other_base_in_words": ({"grade": "ISO VG 68", "base": "ester"}, "oil.grade", "law = 'two_viscosities'"),
    "base": ({"grade": "ISO VG 68", "base": "minerl"}, "oil.base", "Did you mean 'mineral'?"),
    "base_alone": ({"base": "PAO"}, "oil.base", "none without 'grade', e.g. 'ISO VG 68'"),
    "two_oils": ({"grade": "ISO VG 68", "name": "fva3"}, "oil.grade", "none beside 'name'"),
    "law_is_the_grade's": (
        {"grade": "ISO VG 68", "density": "none"},
        "oil.density",
        "the standard oil ISO VG 68 has one",
    ),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals_are_one_message(name):
    table, path, words = REFUSALS[name]
    with pytest.raises(SceneError) as caught:
        oil_of(**table)
    message = str(caught.value)
    assert f"{path}: found " in message
    assert words in message
    assert len(caught.value.problems) == 1


def test_an_oil_file_holds_laws(tmp_path):
    (tmp_path / "oil.toml").write_text('grade = "ISO VG 68"\n')
    with pytest.raises(SceneError, match=r"grade: found the grade 'ISO VG 68'; expected the laws themselves"):
        load_scene(SCENE, {"oil.file": str(tmp_path / "oil.toml")})


@pytest.mark.parametrize(
    "changes",
    [
        {"grade": "ISO VG 320", "base": "ester"},
        {"grade": "ISO VG 68", "rheology.stress_ratio": "0.06"},
        {"grade": "ISO VG 68", "density": "870 kg/m^3"},
        {"name": "fva3"},
        {"name": "water", "conductivity": "0.6 W/(m*K)"},
    ],
)
def test_saving_and_reading(changes, tmp_path):
    thin = (
        {} if "water" not in changes.values() else {"contact": "none", "cage": "none", "flange": "none", "drag": "none"}
    )
    scene = load_scene(SCENE, thin | {f"oil.{name}": value for name, value in changes.items()})
    jb.save_scene(scene, tmp_path / "mine.toml")
    again = load_scene(tmp_path / "mine.toml")
    assert again.oil == scene.oil or oil_writer.same(again.oil, scene.oil)


def test_priors_scatter():
    found = jb.load_distributions(SCENE, {"oil.grade": "ISO VG 68"})
    assert {path: (one.lowest, one.mean, one.highest) for path, one in found.items()} == {
        path: tuple(pytest.approx(number, rel=1e-12) for number in numbers) for path, numbers in PRIORS.items()
    }
    assert {one.shape for one in found.values()} == {"uniform"}
    # what the scene gives itself is no prior
    given = {"oil.grade": "ISO VG 68", "oil.rheology.stress_ratio": "0.06"}
    assert set(jb.load_distributions(SCENE, given)) == set(PRIORS) - {"oil.rheology.stress_ratio"}
    other = {"oil.grade": "ISO VG 68", "oil.rheology.stress_ratio": "{mean = 0.06, deviation = 0.002}"}
    assert jb.load_distributions(SCENE, other)["oil.rheology.stress_ratio"].deviation == 0.002
    assert jb.load_distributions(SCENE) == {}
    assert set(jb.load_distributions(SCENE, {"oil.name": "fva3"})) == {path for path in PRIORS if "rheology" in path}


@pytest.mark.parametrize("base", grades.bases())
def test_the_means_of_the_priors_are_the_values_of_the_oil(base):
    grade = grades.grades(base)[-1]
    overrides = {"oil.grade": grade, "oil.base": base}
    oil = load_scene(SCENE, overrides).oil
    for path, one in jb.load_distributions(SCENE, overrides).items():
        _, law, name = path.split(".")
        np.testing.assert_allclose(getattr(getattr(oil, law), name), one.mean, rtol=1e-12)


def test_a_prior_is_one_number_of_the_scene():
    label, scatter = scatter_of_source(SCENE, {"oil.grade": "ISO VG 68"}, drag_prior=False)
    assert label == SCENE
    assert set(scatter.fields) == set(PRIORS)
    _, with_drag = scatter_of_source(SCENE, {"oil.grade": "ISO VG 68"})
    assert set(with_drag.fields) == {*PRIORS, "drag.coefficient"}


def test_a_viscosity_and_its_integral_change_together():
    """The film coefficient is that of the new viscosity, and both have the new density, as when a file changes."""
    scene = load_scene(SCENE, {"oil.grade": "ISO VG 68"})
    for path, value in (("viscosity.pressure_coefficient", 12e-9), ("density.value", 850.0)):
        changed = scene.replace({f"oil.{path}": np.float64(value)}).oil
        text = {"viscosity.pressure_coefficient": "12 1/GPa", "density.value": "850 kg/m^3"}[path]
        read = load_scene(SCENE, {"oil.grade": "ISO VG 68", f"oil.{path}": text}).oil
        np.testing.assert_allclose(changed.at(350.0).pressure_viscosity, read.at(350.0).pressure_viscosity, rtol=1e-13)
        np.testing.assert_allclose(changed.at(350.0).viscosity, read.at(350.0).viscosity, rtol=1e-13)
    kept = scene.replace({"oil.pressure_viscosity": scene.oil.pressure_viscosity}).oil
    assert kept.pressure_viscosity is scene.oil.pressure_viscosity


def losses(scene):
    solution = jb.solve(scene)
    power = {name: float(value) for name, value in vars(solution.power_loss).items() if value is not None}
    parts = sum(value for name, value in power.items() if name != "total")
    np.testing.assert_allclose(parts, power["total"], rtol=1e-9)
    assert any("a prior" in note for note in solution.warnings)
    return power


@pytest.mark.parametrize("bearing", ["6207", "nu311", "30206"])
def test_scenes_of_the_examples_have_a_standard_oil(bearing):
    scene = load_scene(EXAMPLES / f"catalogue_{bearing}.toml")
    assert oil_writer.scene_oil(scene.oil) == {"grade": "ISO VG 68", "base": "mineral"}
    other = load_scene(EXAMPLES / f"catalogue_{bearing}.toml", {"oil.grade": "ISO VG 32"})
    assert float(other.oil.at(313.15).viscosity) < 0.5 * float(scene.oil.at(313.15).viscosity)


def test_a_sweep_takes_no_grade():
    with pytest.raises(SceneError, match=r"oil\.grade: found a choice of words"):
        SceneSource.of(SCENE, {"oil.grade": "ISO VG 68"}).field("oil.grade", "--over")


@pytest.mark.slow  # a solve with the heat of films
def test_30206_from_its_catalogue():
    power = losses(load_scene(EXAMPLES / "catalogue_30206.toml"))
    assert set(power) == {"rolling_resistance", "flange", "total"}
    assert 100.0 < power["total"] < 200.0


@pytest.mark.slow  # two bearings with a cage
def test_nu_311_from_its_catalogue():
    power = losses(load_scene(EXAMPLES / "catalogue_nu311.toml"))
    assert {"inner_raceway", "outer_raceway", "rolling_resistance", "pocket"} < set(power)
    assert 200.0 < power["total"] < 600.0


@pytest.mark.slow  # as dear as turbine_ball
@pytest.mark.parametrize("bearing", ["6207", "6205"])
def test_deep_groove_bearings_from_their_catalogue(bearing):
    of_6205 = {
        "geometry.bore": "25 mm",
        "geometry.outside_diameter": "52 mm",
        "geometry.width": "15 mm",
        "geometry.ball_diameter": "7.938 mm",
        "geometry.pitch_diameter": "38.5 mm",
        "cage.inner_diameter": "33.9 mm",
        "cage.outer_diameter": "43 mm",
        "rating.dynamic_capacity": "14.8 kN",
        "rating.static_capacity": "7.8 kN",
        "operation.radial_load": "1.48 kN",
        "operation.axial_load": "300 N",
    }
    power = losses(load_scene(EXAMPLES / "catalogue_6207.toml", of_6205 if bearing == "6205" else {}))
    assert {"inner_raceway", "outer_raceway", "rolling_resistance", "pocket"} < set(power)
    low, high = {"6207": (10.0, 50.0), "6205": (4.0, 25.0)}[bearing]
    assert low < power["total"] < high
