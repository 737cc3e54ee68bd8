"""Names of a [contact] table: each builds the law that it says; what does not fit the oil is refused or said."""

import tomllib

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.contacts import (
    BairWiner,
    BibouletHoupertPointRollingResistance,
    BibouletHoupertRollingResistance,
    DistributedTraction,
    DowsonHigginson,
    DowsonToyoda,
    ElsharkawyHamrock,
    FullRangeRollingResistance,
    GecimWiner,
    Grubin,
    Gupta,
    HsuLee,
    JoinedRollingResistance,
    LineContact,
    MartinBlend,
    MeanPressureTraction,
    Moes,
    NoThermalReduction,
    PanHamrockCentral,
    PointContact,
    ReeEyring,
    Resolution,
    RigidRollingResistance,
    SourceRollingResistance,
)
from jaxbearing.lubricants import NoPressureViscosity, WaltherRoelands
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.laws import (
    BALL_FILMS,
    LINE_THERMAL,
    POINT_ROLLING,
    POINT_THERMAL,
    RIB_FILMS,
    ROLLER_FILMS,
    ROLLING,
    TRACTIONS,
)
from jaxbearing.scenes.reader import builtin_text, load_scene, scene_from_tables

FILM = {
    "moes": Moes,
    "dowson_higginson": DowsonHigginson,
    "dowson_toyoda": DowsonToyoda,
    "pan_hamrock": PanHamrockCentral,
    "grubin": Grubin,
}
TRACTION = {
    "maxwell_eyring": ReeEyring,
    "ree_eyring": ReeEyring,
    "bair_winer": BairWiner,
    "gecim_winer": GecimWiner,
    "elsharkawy_hamrock": ElsharkawyHamrock,
}
PLAIN_OIL = (
    "{density = '870 kg/m^3', pressure_viscosity = '11 1/GPa', viscosity = {law = 'constant', value = '4.8 mPa*s'}}"
)
WATER = {"oil.viscosity": "{law = 'constant', value = '4.8 mPa*s'}"}
DATA_SHEET = {
    "density": "870 kg/m^3",
    "viscosity": {
        "law": "two_viscosities",
        "viscosity_1": "32 cSt",
        "temperature_1": "40 degC",
        "viscosity_2": "5.4 cSt",
        "temperature_2": "100 degC",
    },
}


def contact(**changes):
    return load_scene("turbine_roller", {f"contact.{name}": value for name, value in changes.items()}).contact


@pytest.mark.parametrize("name", FILM)
def test_film(name):
    film = contact(film=name).film
    if name == "moes":
        assert isinstance(film, Moes)
    else:
        # joined to Martin's rigid film, which an unloaded roller needs
        assert isinstance(film, MartinBlend)
        assert isinstance(film.film, FILM[name])


RACE = LineContact(5e-3, 0.014, 2.27e11)
BALL = PointContact(4e-3, 0.12, 2.27e11)
NAMED_FILMS = {f"line, {name}": (film, RACE) for name, film in ROLLER_FILMS.items()}
NAMED_FILMS |= {f"ball, {name}": (film, BALL) for name, film in BALL_FILMS.items()}
NAMED_FILMS |= {f"rib, {name}": (film, PointContact(0.2, 0.02, 2.27e11)) for name, film in RIB_FILMS.items()}


@pytest.mark.parametrize("name", NAMED_FILMS)
def test_films_that_scenes_name_from_no_load_to_full(name):
    """Finite with finite slopes at every load and at rest, thinner with more load; and an unloaded raceway contact has
    a film that fills any clearance, so that each of its rolling elements has a place."""
    film, contact = NAMED_FILMS[name][0](), NAMED_FILMS[name][1]
    loads = jnp.asarray([0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e5])
    law = lambda load, speed: film.log_thickness(contact, load, speed, 0.01, 1.5e-8)
    slopes = jax.jit(jax.vmap(jax.value_and_grad(law, (0, 1)), (0, None)))
    for speed in (0.0, 1e-3, 10.0, -100.0):
        value, slope = slopes(loads, speed)
        assert all(np.all(np.isfinite(part)) for part in (value, *slope))
        assert np.all(np.diff(value) <= 0.0)
        assert np.all(slope[0] <= 0.0)
    if not name.startswith("rib"):
        assert np.exp(law(jnp.asarray(0.0), 10.0)) > 1e-2
        # half of the load, twice (line) or four times (point) the film
        light = 0.1
        ratio = np.exp(law(jnp.asarray(0.5 * light), 10.0) - law(jnp.asarray(light), 10.0))
        np.testing.assert_allclose(ratio, 2.0 if name.startswith("line") else 4.0, rtol=1e-3)


@pytest.mark.parametrize(("name", "law"), [("gupta", Gupta), ("hsu_lee", HsuLee), ("none", NoThermalReduction)])
def test_thermal(name, law):
    assert isinstance(contact(thermal=name).thermal, law)


@pytest.mark.parametrize("name", TRACTION)
def test_traction(name):
    traction = contact(traction=name, traction_model="mean_pressure").traction
    assert isinstance(traction, MeanPressureTraction)
    assert isinstance(traction.viscous, TRACTION[name])
    followed = contact(traction=name).traction
    assert isinstance(followed, DistributedTraction)
    assert isinstance(followed.viscous, TRACTION[name])


def test_distributed_traction():
    law = contact(traction_model="distributed").traction
    assert isinstance(law, DistributedTraction)
    assert isinstance(law.viscous, ReeEyring)
    assert law.resolution == Resolution.for_accuracy(1e-3)
    finer = contact(traction="bair_winer", traction_model="distributed", traction_accuracy="1e-4").traction
    assert isinstance(finer.viscous, BairWiner)
    assert finer.resolution == Resolution.for_accuracy(1e-4)
    assert isinstance(contact(traction_model="mean_pressure").traction, MeanPressureTraction)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"traction_model": "hertz"}, ["contact.traction_model", "'mean_pressure', 'distributed'"]),
        ({"traction_model": "distributed", "traction_accuracy": "0.1"}, ["contact.traction_accuracy", "0.01, 0.001"]),
        ({"traction_model": "distributed", "traction_accuracy": "fine"}, ["contact.traction_accuracy", "'fine'"]),
        (
            {"traction_model": "mean_pressure", "traction_accuracy": "1e-3"},
            ["traction_accuracy", "only traction_model"],
        ),
        ({"traction_model": "distributed", "traction": "none"}, ["contact.traction", "is about"]),
    ],
    ids=str,
)
def test_distributed_traction_refusals(changes, words):
    with pytest.raises(SceneError) as caught:
        contact(**changes)
    assert all(word in str(caught.value) for word in words), str(caught.value)


@pytest.mark.parametrize(
    ("name", "law"),
    [
        ("full_range", FullRangeRollingResistance),
        ("biboulet_houpert", BibouletHoupertRollingResistance),
        ("rigid_isoviscous", RigidRollingResistance),
        ("ertel_grubin", JoinedRollingResistance),
        ("true", FullRangeRollingResistance),
    ],
)
def test_rolling_resistance(name, law):
    found = contact(rolling_resistance=name).rolling
    assert isinstance(found, law)
    assert name in (found.name, "true")


@pytest.mark.parametrize(
    ("name", "law"),
    [
        ("biboulet_houpert", BibouletHoupertPointRollingResistance),
        ("source_86", SourceRollingResistance),
        ("true", BibouletHoupertPointRollingResistance),
        ("houpert", SourceRollingResistance),  # an older name
    ],
)
def test_rolling_resistance_of_balls(name, law):
    found = load_scene("turbine_ball", {"contact.rolling_resistance": name}).contact.rolling
    assert isinstance(found, law)
    assert name in (found.name, "true", "houpert")


@pytest.mark.parametrize("scene", ["turbine_roller", "turbine_ball", "tapered_example"])
def test_inlet_heating_of_rolling_resistance(scene):
    rolling = {"contact.rolling_resistance": "biboulet_houpert"}
    assert load_scene(scene, rolling).contact.rolling_heating is None
    named = load_scene(scene, {**rolling, "contact.rolling_heating": "film_temperature"})
    assert named.contact.rolling_heating == "film_temperature"
    with pytest.raises(SceneError, match="found the text 'wilson'; expected one of 'aihara', 'film_temperature'"):
        load_scene(scene, {**rolling, "contact.rolling_heating": "wilson"})
    with pytest.raises(SceneError, match="expected a law, without which rolling_heating has no meaning"):
        load_scene(scene, {"contact.rolling_resistance": "none", "contact.rolling_heating": "aihara"})
    # a film without inlet heating needs no conductivity; a rolling resistance with Aihara's does
    cold = {**rolling, "contact.thermal": "none", "contact.traction": "none", "oil": PLAIN_OIL}
    cold |= {"kinematics.attitude": "outer"} if scene == "turbine_ball" else {}
    assert load_scene(scene, cold).contact.rolling_heating is None
    with pytest.raises(SceneError, match=r"oil\.conductivity.*contact\.rolling_heating = 'aihara'"):
        load_scene(scene, {**cold, "contact.rolling_heating": "aihara"})


def test_left_out():
    """What is said about the traction goes with it."""
    laws = contact(thermal="none", traction="none", rolling_resistance="none")
    assert isinstance(laws.thermal, NoThermalReduction)
    assert (laws.traction, laws.rolling) == (None, None)


def test_every_name_is_tested_here():
    assert set(ROLLER_FILMS) == set(FILM)
    assert {"gupta", "hsu_lee"} == set(LINE_THERMAL) > set(POINT_THERMAL)
    assert set(TRACTIONS) == set(TRACTION)
    assert {"full_range", "biboulet_houpert", "rigid_isoviscous", "ertel_grubin"} == set(ROLLING)
    assert {"biboulet_houpert", "source_86"} == set(POINT_ROLLING)
    for laws in (ROLLING, POINT_ROLLING):
        assert [law.name for law in laws.values()] == list(laws)


def test_exponent_is_that_of_the_oils_data():
    """Elsharkawy and Hamrock's function has an exponent, fitted with the oil's limiting stress."""
    law = load_scene("turbine_roller", {"oil.name": "pennzane_x2000", "contact.traction": "elsharkawy_hamrock"})
    assert law.contact.traction.viscous.exponent == law.oil.rheology.exponent == 2.0


@pytest.mark.parametrize("name", sorted(set(FILM) - {"moes"}))
def test_film_of_an_isoviscous_oil(name):
    with pytest.raises(SceneError) as caught:
        load_scene("turbine_roller", {**WATER, "contact.film": name})
    message = str(caught.value)
    assert message.startswith(f"turbine_roller with --set contact.film={name}: contact.film: found '{name}'; ")
    assert "expected 'moes': the other laws are for oils whose viscosity rises with pressure." in message
    assert "problems" not in message


def test_rolling_resistance_of_an_isoviscous_oil():
    with pytest.raises(
        SceneError, match=r"contact\.rolling_resistance: found 'ertel_grubin'; expected one of 'full_range"
    ):
        load_scene("turbine_roller", {**WATER, "contact.rolling_resistance": "ertel_grubin"})
    scene = load_scene("turbine_roller", {**WATER, "contact.rolling_resistance": "full_range"})
    assert isinstance(scene.oil.pressure_viscosity, NoPressureViscosity)
    # a coefficient that the scene gives is not refused
    given = {**WATER, "oil.pressure_viscosity": "10 1/GPa", "contact.film": "grubin"}
    assert isinstance(load_scene("turbine_roller", given).contact.film, MartinBlend)


def test_laws_for_isoviscous_oils():
    assert ROLLER_FILMS.isoviscous == tuple(name for name, law in ROLLER_FILMS.items() if not law().piezoviscous_only)
    assert ROLLER_FILMS.isoviscous == ("moes",)
    assert ROLLING.isoviscous == ("full_range", "biboulet_houpert", "rigid_isoviscous")
    assert BALL_FILMS.isoviscous == RIB_FILMS.isoviscous == ("nijenbanning",)


def mentioned(scene, words):
    return [text for text in scene.assumptions() if words in text]


def test_misfit_of_traction_law_and_data_is_said():
    assert mentioned(contact_scene("ree_eyring"), "was fitted with") == []
    assert mentioned(contact_scene("maxwell_eyring"), "was fitted with") == []
    assert mentioned(contact_scene("bair_winer"), "was fitted with") == [
        "contact.traction is bair_winer, the oil's rheology was fitted with ree_eyring"
    ]


@pytest.mark.parametrize(
    "name", ["turbine_ball", "turbine_roller", "tapered_example", "two_disk_mobil_jet_ii", "two_disk_pennzane"]
)
def test_every_machine_says_which_viscous_function_does_not_fit_its_oil(name):
    base = {} if name.startswith("two_disk") else {"oil.name": "pennzane_x2000"}
    fitted = load_scene(name, base).oil.rheology.viscous_function
    assert mentioned(load_scene(name, base | {"contact.traction": fitted}), "was fitted with") == []
    assert mentioned(load_scene(name, base | {"contact.traction": "gecim_winer"}), "was fitted with") == [
        f"contact.traction is gecim_winer, the oil's rheology was fitted with {fitted}"
    ]


def contact_scene(traction):
    return load_scene("turbine_roller", {"contact.traction": traction})


def test_notes_of_an_oil_are_said():
    assert mentioned(load_scene("turbine_roller"), "oil: ") == []
    pennzane = load_scene("turbine_roller", {"oil.name": "pennzane_x2000"})
    assert mentioned(pennzane, "oil: ") == [f"oil: {pennzane.oil.notes[0]}"]


def data_sheet_scene(**changes):
    """The oil of a data sheet, as an engineer writes it; without traction, of which a data sheet says nothing."""
    raw = tomllib.loads(builtin_text("turbine_roller"))
    raw["oil"] = {**DATA_SHEET, **changes}
    raw["contact"] = {"film": "moes"}
    del raw["cage"], raw["flange"], raw["drag"]
    return scene_from_tables(raw)


def test_oil_of_a_data_sheet():
    scene = data_sheet_scene()
    assert isinstance(scene.oil.viscosity, WaltherRoelands)
    assert len(mentioned(scene, "is estimated from its viscosity")) == 1
    given = {"viscosity": {**DATA_SHEET["viscosity"], "pressure_viscosity": "20 1/GPa"}}
    assert mentioned(data_sheet_scene(**given), "estimated") == []
    raw = tomllib.loads(builtin_text("turbine_roller"))
    raw["oil"] = {**DATA_SHEET, "conductivity": "0.14 W/(m*K)"}
    with pytest.raises(SceneError, match=r"oil\.rheology: found nothing; expected the law of rheology, which contact"):
        scene_from_tables(raw)


@pytest.mark.slow
def test_oil_of_a_data_sheet_solves():
    solution = jb.solve(data_sheet_scene())
    assert len([text for text in solution.warnings if "is estimated from its viscosity" in text]) == 1
    film = np.asarray(solution.elements.film_inner)
    assert np.all(np.isfinite(film))
    assert 0.1e-6 < film[0] < 2e-6


@pytest.mark.slow
def test_misfit_is_among_the_warnings_of_a_solution():
    solution = jb.solve(contact_scene("gecim_winer"))
    assert "contact.traction is gecim_winer, the oil's rheology was fitted with ree_eyring" in solution.warnings
