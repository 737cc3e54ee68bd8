"""The oil file of a fit: what is read from it is the fitted oil to the last digit, and scenes take it."""

import dataclasses
import tomllib

import equinox as eqx
import jax
import numpy as np
import pytest
from fit_results import made_up
from reference_oils import fomblin_z25, mobil_jet_ii, nye_186a, pennzane_x2000

import jaxbearing as jb
from fitting.io.oil_file import fitted_oil_text, write_oil
from jaxbearing.lubricants import (
    Barus,
    ConstantPressureViscosity,
    ConstantViscosity,
    IntegratedPressureViscosity,
    LinearDensity,
    Lubricant,
    NoPressureViscosity,
    Roelands,
    WaltherRoelands,
)
from jaxbearing.scenes import units
from jaxbearing.scenes.data_files import builtin_text, oil_names
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.oil.catalogue import load_oil, lubricant, missing_sources
from jaxbearing.scenes.oil.files import read_oil
from jaxbearing.scenes.oil.schema import OilTable
from jaxbearing.scenes.oil.writer import oil_text
from jaxbearing.scenes.quantity_texts import quantity_text
from jaxbearing.scenes.reader import oil_origins

DENSITY = LinearDensity(850.0, -0.7, 288.75)
WALTHER = WaltherRoelands(68e-6, 313.15, 8.7e-6, 373.15, DENSITY)
BARUS = Barus(0.03, 313.15, 2e-8 / 3.0, 4321.0)
ROELANDS = Roelands(0.1 / 3.0, 313.15, 0.6, 1.1)
OILS = {
    "mobil_jet_ii": mobil_jet_ii(),
    "pennzane_x2000": pennzane_x2000(),
    "nye_186a": nye_186a(),
    "fomblin_z25": fomblin_z25(),
    "walther": Lubricant(WALTHER, IntegratedPressureViscosity(WALTHER), density=DENSITY),
    "walther_given": Lubricant(
        dataclasses.replace(WALTHER, pressure_viscosity=1.7e-8), ConstantPressureViscosity(1.7e-8), density=DENSITY
    ),
    "barus": Lubricant(BARUS, IntegratedPressureViscosity(BARUS)),
    "roelands": Lubricant(ROELANDS, ConstantPressureViscosity(1e-8 / 7.0)),
    "constant": Lubricant(ConstantViscosity(0.1 / 7.0), NoPressureViscosity()),
}


def same(left, right):
    """All numbers to the last digit, the same laws; notes aside."""
    left, right = (dataclasses.replace(oil, notes=()) for oil in (left, right))
    assert jax.tree.structure(left) == jax.tree.structure(right)
    for a, b in zip(jax.tree.leaves(left), jax.tree.leaves(right), strict=True):
        assert float(a) == float(b)


@pytest.mark.parametrize("name", OILS)
def test_every_law_comes_back_to_the_last_digit(name, tmp_path):
    text = oil_text(OILS[name], name, "an oil", ["Written by a test."])
    (tmp_path / "oil.toml").write_text(text, encoding="utf-8")
    tables = read_oil(str(tmp_path / "oil.toml"))
    assert missing_sources(tables) == []
    same(lubricant(OilTable.model_validate(tables)), OILS[name])


def test_a_law_that_files_do_not_know_is_refused():
    class Own(ConstantViscosity):
        pass

    with pytest.raises(ValueError, match="cannot hold the law Own"):
        oil_text(Lubricant(Own(0.1), NoPressureViscosity()), "own", "", [])


@pytest.mark.parametrize("value", [1e9 / 3.0, 4.82e4, 5e-324, -2.2e-12, 0.0, 1.7976931348623157e308, 0.1 + 0.2])
@pytest.mark.parametrize("dimension", [units.PRESSURE, units.INVERSE_PRESSURE, units.TEMPERATURE_DIFFERENCE])
def test_texts_of_numbers_are_exact(value, dimension):
    assert units.parse(quantity_text(value, dimension), dimension) == value


def test_short_numbers_stay_short():
    for text, dimension in (("6.11 1/GPa", units.INVERSE_PRESSURE), ("4.7 mPa*s", units.VISCOSITY)):
        assert quantity_text(units.parse(text, dimension), dimension) == text


@pytest.fixture(scope="module")
def fitted():
    return made_up()


@pytest.fixture(scope="module")
def file(fitted, tmp_path_factory):
    path = tmp_path_factory.mktemp("fit") / "fitted_oil.toml"
    write_oil(fitted, path, "curves.csv", "two_disk_etm", oil_origins("two_disk_etm"))
    return path


def with_oil(file, scene="two_disk_etm", **more):
    return jb.load_scene(scene, {"oil.file": str(file), **more})


def test_round_trip(fitted, file):
    same(with_oil(file).oil, fitted.oil)


def test_every_number_has_its_source(file):
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    assert missing_sources(data) == []
    assert data["name"] == "fitted_oil"
    # what the fit did not touch is as the catalogue has it
    assert data["viscosity"]["glass_viscosity"] == "1e+12 Pa*s"
    assert data["viscosity"]["sources"]["glass_temperature"] == "source, table 5 (-107.4 C)"
    assert data["rheology"]["sources"] == {
        "viscous_function": "chosen for the fit",
        "reference_temperature": "as in two_disk_etm",
        "shear_modulus": "fitted to curves.csv, standard error 3.7 kPa, 95 % interval 26.7 to 41.7 kPa",
        "shear_modulus_pressure": "held at the value of two_disk_etm: one pressure only",
        "shear_modulus_temperature": "held at the value of two_disk_etm: one temperature only",
        "stress": "fitted to curves.csv, standard error 0.59 kPa, 95 % interval 4.29 to 6.70 kPa",
        "stress_pressure": "fitted to curves.csv; no interval: its effect on the data is uncertain by a factor of 17 "
        "to either side",
        "stress_temperature": "held at the value of two_disk_etm: as asked",
    }


def test_header_says_where_it_comes_from(file, fitted):
    header = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    for words in ("curves.csv, 18 points in 1 curve;", "two_disk_etm", "ree_eyring", "0.00662", jb.__version__):
        assert any(words in line for line in header), words
    for note in fitted.notes:
        assert f"# {note}" in header


def test_solutions_say_what_the_data_could_not_tell(file):
    notes = with_oil(file).assumptions()
    assert any("does not determine alpha_G, beta_G, alpha_tau: elsewhere it is a guess" in note for note in notes)


def test_exponent_is_written(tmp_path):
    result = made_up(model="elsharkawy_hamrock")
    write_oil(result, tmp_path / "oil.toml", "a.csv", "two_disk_etm")
    read = with_oil(tmp_path / "oil.toml", **{"contact.traction": "elsharkawy_hamrock"})
    same(read.oil, result.oil)
    assert read.contact.traction.viscous.exponent == 2.0
    assert "elsharkawy_hamrock with the exponent 2" in (tmp_path / "oil.toml").read_text(encoding="utf-8")


def test_names_of_files_are_not_code(tmp_path):
    data, scene = 'a"\\\n[x]\x1b\udcff.csv', "b'#\u2028.toml"
    text = fitted_oil_text(made_up(), 'n"\\', data, scene)
    assert text.isprintable() or all(line.isprintable() for line in text.split("\n"))
    assert tomllib.loads(text)["name"] == 'n"\\'


def test_notes_of_other_laws_are_kept(tmp_path):
    """Of an oil with sources, in the law that they belong to; of another one with the viscosity."""
    assumed = "the thermal conductivity of this oil is not known"
    columns = "slide_to_roll,traction_coefficient,pressure [GPa],entrainment_speed [m/s],temperature [degC]\n"
    rows = "".join(f"{slide},{0.5 * slide},1.2,3,40\n" for slide in (0.01, 0.02, 0.05))
    (tmp_path / "curves.csv").write_text(columns + rows, encoding="utf-8")
    result = made_up(scene="two_disk_pennzane", file=tmp_path / "curves.csv")
    text = fitted_oil_text(result, "oil", "a.csv", "two_disk_pennzane", oil_origins("two_disk_pennzane"))
    assert assumed in tomllib.loads(text)["conductivity"]["note"]
    assert "note" not in tomllib.loads(text)["viscosity"]
    assert assumed in tomllib.loads(fitted_oil_text(result, "oil", "a.csv", "mine"))["viscosity"]["note"]


def test_a_fit_that_failed_writes_nothing(tmp_path):
    with pytest.raises(ValueError, match="not converged"):
        write_oil(made_up(converged=False), tmp_path / "oil.toml", "a.csv", "b")
    assert list(tmp_path.iterdir()) == []


# scenes with an oil file


def test_a_bearing_takes_it(file, fitted):
    same(with_oil(file, "turbine_roller").oil, fitted.oil)
    same(with_oil(file, "turbine_roller", **{"oil.name": "none"}).oil, fitted.oil)


def test_the_file_replaces_the_whole_oil_of_the_scene(file):
    """The scene amends the rheology of its own oil; that does not speak for another one."""
    assert float(jb.load_scene("two_disk_etm").oil.rheology.stress) < 5e3
    assert float(with_oil(file).oil.rheology.stress) == 5362.815555151545
    assert float(with_oil(file, **{"oil.rheology.stress": "1 MPa"}).oil.rheology.stress) == 1e6
    assert float(with_oil(file, **{"oil.density": "900 kg/m^3"}).oil.density.value) == 900.0


def test_a_path_is_relative_to_the_scene_file(file, tmp_path, monkeypatch):
    folder = file.parent / "scenes"
    folder.mkdir(exist_ok=True)
    text = builtin_text("turbine_roller").replace('name = "mobil_jet_ii"', 'file = "../fitted_oil.toml"')
    (folder / "scene.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert float(jb.load_scene(folder / "scene.toml").oil.rheology.stress) == 5362.815555151545
    # an override is typed where one is
    monkeypatch.chdir(file.parent)
    assert jb.load_scene(folder / "scene.toml", {"oil.file": "fitted_oil.toml"}).oil.rheology is not None
    same(jb.load_scene(folder / "scene.toml", {"oil.name": "mobil_jet_ii"}).oil, load_oil("mobil_jet_ii"))


@pytest.mark.parametrize("name", oil_names())
def test_files_of_the_catalogue_are_oil_files(name, tmp_path):
    from jaxbearing.scenes.data_files import oil_text as catalogue_text

    (tmp_path / "mine.toml").write_text(catalogue_text(name), encoding="utf-8")
    oil = lubricant(OilTable.model_validate(read_oil(str(tmp_path / "mine.toml"))))
    assert eqx.tree_equal(oil, load_oil(name))


BROKEN = {
    "missing": (None, ["no such file", "an oil file"]),
    "empty": ("", ["empty", "an oil file"]),
    "not_toml": ("a b\n", ["syntax"]),
    "scene": (builtin_text("turbine_roller"), ["kind", "a scene", "an oil file"]),
    "no_law": ("name = 'x'\n", ["viscosity", "nothing"]),
    "unknown_name": ("colour = 'green'\n", ["colour", "unknown name"]),
    "wrong_unit": ("[viscosity]\nlaw = 'constant'\nvalue = '3 m'\n", ["viscosity.value", "3 m"]),
    "another_file": ("file = 'b.toml'\n", ["file", "stands alone"]),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_no_oil_is_refused_by_its_own_name(name, tmp_path):
    text, words = BROKEN[name]
    path = tmp_path / "oil.toml"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError) as error:
        with_oil(path)
    assert str(error.value).startswith(f"{path}: ")
    for word in ("found", "expected", *words):
        assert word in str(error.value)


def test_name_and_file_exclude_each_other(file):
    with pytest.raises(SceneError, match=r"oil.file: .* none beside 'name'"):
        with_oil(file, **{"oil.name": "mobil_jet_ii"})
    with pytest.raises(SceneError, match=r"oil.file: found the number 3"):
        jb.load_scene("turbine_roller", {"oil.file": "3"})
    with pytest.raises(SceneError, match=r"oil.density: .* the oil file .* has one"):
        with_oil(file, **{"oil.density": "none"})


def test_origins_follow_the_scene(file):
    etm = oil_origins("two_disk_etm")
    assert etm["rheology"].sources["stress"] == "as in two_disk_etm"
    assert etm["rheology"].sources["stress_pressure"] == "source, table 8"
    again = oil_origins("two_disk_etm", {"oil.file": str(file), "oil.density": "900 kg/m^3"})
    assert again["density"].sources["value"] == "as in two_disk_etm"
    assert again["rheology"].sources["stress"].startswith("fitted to curves.csv")
    assert "does not determine" in again["rheology"].note


def test_numpy_and_jax_numbers_are_written():
    oil = dataclasses.replace(OILS["constant"], viscosity=ConstantViscosity(jax.numpy.asarray(0.25)))
    assert 'value = "250 mPa*s"' in oil_text(oil, "a", "b", [])
    oil = dataclasses.replace(OILS["constant"], viscosity=ConstantViscosity(np.float64(0.25)))
    assert 'value = "250 mPa*s"' in oil_text(oil, "a", "b", [])
