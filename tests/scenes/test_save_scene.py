"""A scene that is saved and read again is the same scene: parts, laws, words, and every number to the last bit."""

import dataclasses
import importlib.metadata
import os
import tomllib

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from campaign.draws import single
from campaign.structures import STRUCTURES
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_accidents import mutated

import jaxbearing as jb
from jaxbearing.contacts import (
    DistributedTraction,
    DowsonHigginson,
    HalfSpaceCompliance,
    MartinBlend,
    MeanPressureTraction,
    Resolution,
)
from jaxbearing.contacts.viscous import BairWiner
from jaxbearing.lubricants import (
    Barus,
    ConstantPressureViscosity,
    ConstantViscosity,
    IntegratedPressureViscosity,
    LinearConductivity,
    LinearDensity,
    Lubricant,
    NoPressureViscosity,
    WaltherRoelands,
)
from jaxbearing.scenes import units
from jaxbearing.scenes.data_files import builtin_text, oil_names
from jaxbearing.scenes.laws import BALL_FILMS, ENTRY_POINTS, POINT_ROLLING, ROLLER_FILMS, ROLLING, TRACTIONS
from jaxbearing.scenes.quantity_texts import quantity_text
from jaxbearing.time_laws import LinearRamp, Tabulated


def assert_same(one, other):
    """The same structure, static values with it; bits and types of all numbers."""
    assert jax.tree.structure(one) == jax.tree.structure(other)
    for a, b in zip(jax.tree.leaves(one), jax.tree.leaves(other), strict=True):
        assert np.shape(a) == np.shape(b)
        assert np.asarray(a, dtype=float).tobytes() == np.asarray(b, dtype=float).tobytes()


def back(scene, folder):
    """The scene after a round trip, and the tables of its file."""
    file = folder / "scene.toml"
    jb.save_scene(scene, file)
    read = jb.load_scene(file)
    assert_same(read, scene)
    return tomllib.loads(file.read_text(encoding="utf-8"))


# what comes back


@pytest.mark.parametrize("name", jb.builtin_names())
def test_built_in_scenes(name, tmp_path):
    """Files have the tables of the built-in ones, in their order, and no other part."""
    there = tomllib.loads(builtin_text(name))
    written = back(jb.load_scene(name), tmp_path)
    # balls have their kinematics, said or not
    assert [table for table in written if table != "kinematics"] == [
        table for table in _in_order(there) if table != "kinematics"
    ]
    assert written["oil"] == there["oil"] if "oil" in there else "oil" not in written


def _in_order(tables):
    if tables["kind"] == "shaft":  # [life] without a slope of its own stands for tables [rating] of the bearings
        return [name for name in ("kind", "shaft", "set", "bearing", "force", "state") if name in tables]
    order = ("kind", "geometry", "outer_ring", "materials", "oil", "contact")
    order = (*order, "kinematics", "cage", "flange", "drag", "rating")
    return [name for name in (*order, "operation", "fits", "temperatures", "thermal", "simulation") if name in tables]


def test_units_are_those_that_people_use(tmp_path):
    written = back(jb.load_scene("turbine_roller"), tmp_path)
    assert written["geometry"]["pitch_diameter"] == "142 mm"
    assert written["geometry"]["diametral_clearance"] == "30 um"
    assert written["flange"]["angle"] == "0.375 deg"
    assert written["materials"] == {"rings": "M50", "rollers": "M50"}
    operation = {"inner_speed": "10500 rpm", "radial_load": "25 kN", "oil_flow": "150 l/h", "outer_speed": "0 rpm"}
    assert written["operation"] == operation | {"oil_temperature": "100 degC"}
    assert "oil_temperature" not in back(jb.load_scene("deep_groove_6205"), tmp_path)["operation"]


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_random_scenes(structure, tmp_path):
    """Those of the campaign: the first two that can be built."""
    dice, built = np.random.default_rng(7), 0
    for point in dice.random((6, structure.size)):
        if built == 2:
            break
        try:
            scene = structure.single_scene(single(structure.at(point[None]), 0))
        except ValueError:
            continue
        back(scene, tmp_path)
        built += 1
    assert built


@pytest.mark.slow
def test_scenes_that_accidents_made(tmp_path):
    names, read = jb.builtin_names(), 0
    for seed in range(160):
        (tmp_path / "a.toml").write_text(mutated(builtin_text(names[seed % len(names)]), seed), encoding="utf-8")
        try:
            scene = jb.load_scene(tmp_path / "a.toml")
        except jb.SceneError:
            continue
        back(scene, tmp_path)
        read += 1
    assert read > 5


MOUNTED = "deep_groove_6205_mounted"
ROLLERS, BALLS, DISKS, LINE = "turbine_roller", "turbine_ball", "two_disk_mobil_jet_ii", "satellite_contact_1"
DRY = dict.fromkeys(("contact", "cage", "flange", "drag", "oil"), "none")
VARIED = [
    *((ROLLERS, {"contact.film": name}) for name in ROLLER_FILMS),
    *((ROLLERS, {"contact.traction": name}) for name in TRACTIONS),
    *((ROLLERS, {"contact.traction_accuracy": accuracy}) for accuracy in ("1e-2", "1e-4", "1e-6")),
    *((ROLLERS, {"contact.rolling_resistance": name}) for name in ROLLING),
    (ROLLERS, {"contact.rolling_resistance": "true", "contact.rolling_heating": "aihara"}),
    *((BALLS, {"contact.rolling_resistance": name}) for name in POINT_ROLLING),
    (BALLS, {"contact.rolling_heating": "film_temperature"}),
    ("tapered_example", {"contact.rolling_resistance": "true", "contact.rolling_heating": "film_temperature"}),
    *((ROLLERS, {"cage.turbulence": name}) for name in ("laminar", "pure")),
    *((BALLS, {"contact.film": name}) for name in BALL_FILMS),
    (
        ROLLERS,
        {"contact.thermal": "hsu_lee", "contact.entrainment_offset": "1 mm/s", "geometry.contact_length": "none"},
    ),
    (
        ROLLERS,
        {"contact.traction": "none", "cage": "none", "profile.n_laminae": "7", "geometry.first_element_angle": "3 deg"},
    ),
    (ROLLERS, {**DRY, "profile.shape": "crowned", "profile.drop": "8 um", "operation.moment": "0 N*m"}),
    (ROLLERS, {**DRY, "profile.shape": "logarithmic", "profile.drop": "8 um", "operation.misalignment": "-1 mrad"}),
    (ROLLERS, {**DRY, "operation.radial_load": "none", "operation.displacement.radial": "60 um"}),
    (ROLLERS, {"rating.edge_factor": "true", "rating.n_laminae": "11", "rating.dynamic_capacity": "90 kN"}),
    (ROLLERS, {"oil.viscosity.c1": "16", "oil.density": "900 kg/m^3", "oil.rheology.stress": "4 MPa"}),
    (ROLLERS, {"oil.name": "fomblin_z25", "oil.density": "1800 kg/m^3", "contact.traction": "none", "cage": "none"}),
    (ROLLERS, {"simulation.speed_ramp.start": "0.1", "simulation.speed_ramp.duration": "20 ms"}),
    (ROLLERS, {"simulation.load_perturbation.frequency": "40 Hz", "simulation.load_perturbation.amplitude": "0.1"}),
    (ROLLERS, {"simulation.rotating_load.load": "5 kN", "simulation.rotating_load.speed": "14000 rpm"}),
    (ROLLERS, {"simulation.speed_table.times": "['0 ms', '7 ms']", "simulation.speed_table.factors": "[1, 0.3]"}),
    (BALLS, {"kinematics.gyroscopic": "shared"}),
    (BALLS, {"kinematics.gyroscopic": "shared", "kinematics.inner_share": "0.3", "kinematics.gyroscopic_sign": "-1"}),
    (BALLS, {"kinematics.gyroscopic": "capped", "kinematics.gyroscopic_friction": "0.07"}),
    (BALLS, {"kinematics.gyroscopic": "resolved", "contact.heathcote": "true", "contact.traction_accuracy": "1e-6"}),
    (BALLS, {"contact.traction": "none", "kinematics.attitude": "inner", "kinematics.orbit": "common"}),
    (
        BALLS,
        {"operation.displacement.axial": "40 um", "operation.axial_load": "none", "operation.moment_lateral": "1 N*m"},
    ),
    (MOUNTED, {"fits.shaft_tolerance": "none", "fits.shaft_interference": "11.7 um", "fits.at": "loosest"}),
    (
        MOUNTED,
        {
            "fits.shaft_material": "{youngs_modulus = '210 GPa', poisson_ratio = 0.31, density = '7800 kg/m^3', "
            "thermal_expansion = '12e-6 1/K'}",
        },
    ),
    (
        "turbine_ball_mounted",
        {
            "materials.rings": "{youngs_modulus = '210 GPa', poisson_ratio = 0.3, density = '7850 kg/m^3', "
            "thermal_expansion = '12.3e-6 1/K', heat_capacity = '460 J/(kg*K)'}",
            "fits.housing_material": "aluminium",
            "temperatures.elements": "none",
        },
    ),
    (
        MOUNTED,
        # as steel of the catalogue, but without its thermal properties
        {
            "thermal": "none",
            "fits.shaft_material": "{youngs_modulus = '210 GPa', poisson_ratio = 0.3, density = '7850 kg/m^3'}",
        },
    ),
    (
        MOUNTED,
        {
            "thermal.nodes": "6",
            "thermal.stability": "true",
            "thermal.oil_inlet": "35.5 degC",
            "thermal.conductance.housing_oil": "1.25 W/K",
            "thermal.capacity.shaft": "900 J/K",
            "thermal.capacity.housing": "4000 J/K",
            "thermal.factor.oil": "2.5",
            "thermal.share.inner_raceway": "0.4",
            "thermal.housing_diameter": "80 mm",
            "thermal.housing_area": "0.0123 m^2",
        },
    ),
    (MOUNTED, {"thermal": "none", "temperatures.inner_ring": "80 degC", "temperatures.outer_ring": "70 degC"}),
    ("turbine_roller", {"geometry.flange_stiffness": "60 N/um^(10/9)", "geometry.flange_gap": "15 um"}),
    ("angular_contact_218", {"geometry.contact_angle": "none", "geometry.diametral_clearance": "0.1 mm"}),
    (
        "tapered_example",
        {"contact.flange_film": "nijenbanning", "contact.traction": "bair_winer", "oil.name": "pennzane_x2000"},
    ),
    (
        "tapered_example",
        {"contact.traction": "none", "contact.thermal": "hsu_lee", "operation.load_position": "-0.11 m"},
    ),
    ("tapered_example", {"profile.shape": "crowned", "profile.drop": "8 um", "profile.straight_fraction": "0.5"}),
    (DISKS, {"contact.compliance": "half_space", "contact.elastic": "false", "contact.inlet": "cold"}),
    (
        DISKS,
        {"contact.compliance": "3e-15 m/Pa", "contact.film_heating": "true", "operation.slide_to_roll": "[0.1, 0.3]"},
    ),
    (
        DISKS,
        {"operation.slide_to_roll": "{start = '-5 %', stop = '5 %', count = 7}", "operation.temperature": "40 degC"},
    ),
    (LINE, {"contact.nodes": "101", "contact.inlet": "5.5", "simulation": "none"}),
    (LINE, {"contact.accuracy": "1e-3", "contact.inlet": "none", "simulation.speed_ramp.shape": "smooth"}),
    (
        LINE,
        {
            "simulation.speed_ramp": "none",
            "simulation.speed_table.times": "['0 s', '1 s']",
            "simulation.speed_table.factors": "[1, -1]",
        },
    ),
    (
        LINE,
        {
            "simulation.speed_ramp": "none",
            "simulation.speed_perturbation.frequency": "100 Hz",
            "simulation.speed_perturbation.amplitude": "2",
        },
    ),
]


@pytest.mark.parametrize(("name", "changes"), VARIED, ids=lambda value: value if isinstance(value, str) else "")
def test_variations(name, changes, tmp_path):
    back(jb.load_scene(name, changes), tmp_path)


def test_numbers_from_python_and_devices(tmp_path):
    scene = jb.load_scene("deep_groove_6205").at_operation(inner_speed=jnp.asarray(1234.5), radial_load=1e4 / 3.0)
    written = back(scene.replace_geometry(diametral_clearance=-0.0, conformity_inner=0.52), tmp_path)
    assert written["operation"]["inner_speed"] == "1234.5 rad/s"
    assert written["geometry"]["diametral_clearance"] == "-0 mm"
    assert written["geometry"]["conformity_inner"] == 0.52


NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
DIMENSIONS = [one for one in vars(units).values() if isinstance(one, units.Dimension)]


@settings(deadline=None, derandomize=True, max_examples=300)
@given(NUMBERS, st.sampled_from(DIMENSIONS))
def test_texts_of_numbers_give_them_back(value, dimension):
    found = units.parse(quantity_text(value, dimension), dimension)
    assert np.float64(found).tobytes() == np.float64(value).tobytes()


@settings(deadline=None, derandomize=True, max_examples=200)
@given(st.floats(1.0, 5000.0), st.sampled_from(["mm", "um", "m"]))
def test_texts_with_few_digits_stay_short(number, unit):
    text = f"{number:.4g} {unit}"
    written = quantity_text(units.parse(text, units.LENGTH), units.LENGTH)
    digits = lambda one: len(one.partition(" ")[0].replace(".", ""))
    assert digits(written) <= digits(text) + 2


@settings(deadline=None, derandomize=True, max_examples=12)
@given(st.floats(1e-7, 40e-6), st.floats(1e-3, 1e5), st.floats(200.0, 500.0), st.floats(-3000.0, 3000.0))
def test_any_numbers(tmp_path_factory, clearance, load, temperature, speed):
    changes = {"operation.radial_load": load, "operation.inner_speed": speed, "operation.oil_temperature": temperature}
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    back(scene.replace(changes | {"geometry.diametral_clearance": clearance}), tmp_path_factory.mktemp("any"))


DENSITY = LinearDensity(850.0, -0.7, 288.75)
WALTHER = WaltherRoelands(68e-6, 313.15, 8.7e-6, 373.15, DENSITY)
BARUS = Barus(0.03, 313.15, 2e-8 / 3.0, 4321.0)
NOTE = "the thermal conductivity is a guess: \"0.14\", \t'é'\n"
OILS = {
    "estimated": Lubricant(WALTHER, IntegratedPressureViscosity(WALTHER), density=DENSITY, notes=WALTHER.notes),
    "noted": Lubricant(
        BARUS,
        ConstantPressureViscosity(1.7e-8),
        density=LinearDensity(850.0, 0.0, 293.15),
        conductivity=LinearConductivity(0.14, 0.0, 293.15),
        notes=(NOTE,),
    ),
    "two notes": Lubricant(BARUS, IntegratedPressureViscosity(BARUS), notes=("first", "second")),
    "isoviscous": Lubricant(ConstantViscosity(0.1 / 7.0), NoPressureViscosity()),
    **{name: jb.load_oil(name) for name in oil_names()},
}


@pytest.mark.parametrize("name", OILS)
def test_oils(name, tmp_path):
    scene = jb.load_scene("satellite_contact_1").replace({"oil": OILS[name]})
    written = back(scene, tmp_path)["oil"]
    assert (written == {"name": name}) == (name in oil_names())
    if name == "noted":
        # the note stands with the law that it is about, the other numbers stand alone
        assert written["conductivity"]["note"] == NOTE
        assert (written["density"], written["pressure_viscosity"]) == ("850 kg/m^3", "17 1/GPa")


def test_an_oil_that_differs_in_a_value_keeps_its_name(tmp_path):
    oil = jb.load_scene("two_disk_etm").oil
    written = back(jb.load_scene("turbine_roller").replace({"oil": oil}), tmp_path)["oil"]
    assert written == {"name": "mobil_jet_ii", "rheology": {"stress": "4 kPa"}}


def test_a_table_of_a_csv_file_stands_in_the_scene(tmp_path):
    (tmp_path / "speed.csv").write_text("time [ms],speed [rpm]\n-3,9000\n0,10000\n7,12345.6\n", encoding="utf-8")
    (tmp_path / "load.csv").write_text("time [s];factor\n0;1\n1e-3;0\n", encoding="utf-8")
    files = {f"simulation.{name}_table.file": str(tmp_path / f"{name}.csv") for name in ("speed", "load")}
    written = back(jb.load_scene("turbine_roller_dynamic", files), tmp_path)["simulation"]
    assert written["load_table"] == {"times": ["0 ms", "1 ms"], "factors": [1.0, 0.0]}
    assert written["speed_table"]["times"] == ["-3 ms", "0 ms", "7 ms"]


def test_a_mesh_that_the_load_has_chosen_stays(tmp_path):
    """At another load the accuracy alone would choose another one."""
    scene = jb.load_scene(LINE, {"contact.accuracy": "3e-4"}).at_operation(load_per_length=4e5)
    written = back(scene, tmp_path)["contact"]
    assert (written["accuracy"], written["nodes"]) == (3e-4, scene.contact.nodes)
    assert (
        jb.load_scene(LINE, {"contact.accuracy": "3e-4", "operation.load_per_length": "400 N/mm"}).contact.nodes > 1601
    )


def test_the_same_solve(tmp_path):
    scene = jb.load_scene("reference_roller", DRY)
    jb.save_scene(scene, tmp_path / "scene.toml")
    assert_same(jb.solve(jb.load_scene(tmp_path / "scene.toml")), jb.solve(scene))


class OwnFilm(DowsonHigginson):
    """A film law of another package."""


class OwnFlow(BairWiner):
    """A viscous function of another package."""


@pytest.fixture
def registered(monkeypatch):
    """Laws of another package, as `docs/contributing.md` names them, beside one that cannot be loaded."""

    class Entry:
        value = "other_package.laws:Law"

        def __init__(self, name, held):
            self.name, self.held = name, held

        def load(self):
            if self.held is None:
                raise ImportError("no module named 'other_package'")
            return self.held

    entries = [Entry("broken", None), Entry("own_flow", OwnFlow), Entry("own_film", OwnFilm)]
    installed = importlib.metadata.entry_points

    def entry_points(group, **params):
        if group != ENTRY_POINTS:
            return installed(group=group, **params)
        return [one for one in entries if params.get("name", one.name) == one.name]

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)


@pytest.mark.usefixtures("registered")
def test_registered_laws(tmp_path):
    scene = jb.load_scene("turbine_roller", {"contact.film": "own_film", "contact.traction": "own_flow"})
    written = back(scene, tmp_path)["contact"]
    assert (written["film"], written["traction"]) == ("own_film", "own_flow")


# what is refused


def replaced(name, path, value, changes=None):
    """The scene with another leaf or part, past its own checks."""
    at = lambda tree: _at(tree, path)
    return eqx.tree_at(at, jb.load_scene(name, changes or {}), value, is_leaf=lambda leaf: leaf is None)


def _at(tree, path):
    for name in path.split("."):
        tree = getattr(tree, name)
    return tree


BATCH = jax.tree.map(lambda leaf: np.stack([leaf, leaf]), jb.load_scene("deep_groove_6205"))
MARCH = DistributedTraction(viscous=BairWiner(), resolution=Resolution(10, 10))
REFUSED = {
    "nan": (replaced(ROLLERS, "operation.radial_load", np.float64("nan")), "operation.radial_load", "nan, which"),
    "infinite": (replaced(ROLLERS, "oil.viscosity.c1", np.inf), "oil.viscosity.c1", "inf, which is not finite"),
    "nan in a list": (replaced(DISKS, "operation.pressure", np.array([1e9, np.nan])), "operation.pressure", "nan"),
    "batch": (BATCH, "", r"3 problems:\n  - geometry.pitch_diameter: .*shape \(2,\); expected one number; of a batch"),
    "float32": (replaced(ROLLERS, "oil.viscosity.c1", np.float32(16.0)), "oil.viscosity.c1", "float32; .* 64 bits"),
    "placeholder": (
        jax.eval_shape(lambda: jb.load_scene("deep_groove_6205").at_operation(radial_load=jnp.ones(()))),
        "",
        "3 problems:\\n  - geometry.pitch_diameter: found a traced number; expected a known",
    ),
    "own film": (replaced(ROLLERS, "contact.film", OwnFilm()), "contact.film", "'moes', .* entry point of"),
    "own numbers": (
        replaced(ROLLERS, "contact.film", MartinBlend(DowsonHigginson(), 2.0)),
        "contact.film",
        "found MartinBlend",
    ),
    "bare film": (replaced(ROLLERS, "contact.film", DowsonHigginson()), "contact.film", "found DowsonHigginson"),
    "own oil law": (
        replaced(LINE, "oil.viscosity", type("Own", (ConstantViscosity,), {})(0.1)),
        "oil.viscosity",
        "hold the law Own",
    ),
    "law of the oil": (
        replaced(ROLLERS, "contact.traction", MeanPressureTraction()),
        "contact.traction.viscous",
        "found None",
    ),
    "resolution": (
        replaced(ROLLERS, "contact.traction", MARCH),
        "contact.traction.resolution",
        "steps=10.* one of those that traction_accuracy has: Resolution",
    ),
    "elastic": (
        replaced(ROLLERS, "contact.traction", dataclasses.replace(MARCH, resolution=Resolution(40, 16), elastic=False)),
        "contact.traction.elastic",
        "found False; expected True",
    ),
    "other viscosity": (
        replaced(LINE, "oil", dataclasses.replace(OILS["estimated"], density=LinearDensity(800.0, -0.7, 288.75))),
        "oil.viscosity.density.value",
        "found 850",
    ),
    "many notes": (
        replaced(LINE, "oil", dataclasses.replace(OILS["isoviscous"], notes=("a", "b"))),
        "oil.notes",
        "found 2 notes; expected at most 1",
    ),
    "surrogate": (
        replaced(LINE, "oil", dataclasses.replace(OILS["isoviscous"], notes=("\udcff",))),
        "oil.notes",
        "UTF-8",
    ),
    "freedom": (
        jb.load_scene("reference_roller", {"contact": "none"}).replace({"ring_freedom": ("radial", "lateral")}),
        "ring_freedom.*",
        "radial",
    ),
    "smoothing": (
        jb.load_scene(ROLLERS).replace({"contact.entrainment_smoothing": 1e-6}),
        "contact.entrainment_smoothing",
        "found .*1.e-06.*; expected .*5.e-07",
    ),
    "half space": (
        replaced(DISKS, "contact.traction.compliance", HalfSpaceCompliance(2e11)),
        "contact.traction.compliance",
        "GivenCompliance",
    ),
    "heating": (
        replaced(DISKS, "contact.traction.heating.solid_density", np.float64(7000.0), {"contact.film_heating": "true"}),
        "contact.traction.heating.solid_density",
        "found .*7000.*; expected .*7800",
    ),
    "rib": (replaced("tapered_example", "rib", None), "rib", "found None"),
    "rib without traction": (replaced("tapered_example", "rib.traction", None), "rib.traction", "found None"),
    "rib of its own": (
        replaced("tapered_example", "rib.traction.viscous", BairWiner()),
        "rib.traction.viscous",
        "found BairWiner",
    ),
    "shares": (
        replaced(BALLS, "kinematics.gyroscopic.outer_share", np.float64(0.3), {"kinematics.gyroscopic": "shared"}),
        "kinematics.outer_share",
        "add up to 2",
    ),
    "couple": (
        dataclasses.replace(
            jb.load_scene(BALLS), kinematics=dataclasses.replace(jb.BallAttitude(), gyroscopic=OwnFilm())
        ),
        "kinematics.gyroscopic",
        "None or one of SharedCouple, CappedCouple, ResolvedCouple",
    ),
    "ramp": (
        jb.load_scene("turbine_roller_dynamic").replace({"simulation.speed": LinearRamp(1.0, 2.0, 1e-3)}),
        "simulation.speed_ramp.shape",
        "found 'linear'; expected 'smooth' without",
    ),
    "standstill": (
        jb.load_scene("turbine_roller_dynamic").replace({"simulation.speed": Tabulated([0.0, 1.0], [1.0, 0.0])}),
        "simulation.speed_table.factors",
        "at rest the films vanish",
    ),
    "long table": (
        jb.load_scene("turbine_roller_dynamic").replace(
            {"simulation.speed": Tabulated(np.arange(1.2e5) / 3.0, np.full(120_000, 1.0 / 3.0))}
        ),
        "",
        "MiB of text; expected a scene of at most 4 MiB",
    ),
    "accuracy": (
        jb.load_scene(LINE, {"contact.accuracy": "none", "contact.nodes": "101"}).replace({"contact.accuracy": 0.5}),
        "contact.accuracy",
        "found the number 0.5; expected one of 0.01",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_file_cannot_hold_is_refused(name, tmp_path):
    scene, path, words = REFUSED[name]
    file = tmp_path / "a.toml"
    file.write_text("there before", encoding="utf-8")
    place = rf": {path}:" if path else ":"
    with pytest.raises(ValueError, match=rf"a\.toml{place} .*{words}") as caught:
        jb.save_scene(scene, file)
    assert isinstance(caught.value, jb.SceneError)
    assert (os.listdir(tmp_path), file.read_text(encoding="utf-8")) == (["a.toml"], "there before")


def test_all_numbers_that_are_refused_are_named(tmp_path):
    scene = replaced(ROLLERS, "operation.radial_load", np.float64("nan"))
    scene = eqx.tree_at(lambda tree: tree.geometry.roller_length, scene, np.float64("inf"))
    with pytest.raises(jb.SceneError) as caught:
        jb.save_scene(scene, tmp_path / "a.toml")
    assert [one.path for one in caught.value.problems] == ["geometry.roller_length", "operation.radial_load"]


@pytest.mark.parametrize("transformed", [jax.jit, jax.grad, lambda f: lambda load: jax.vmap(f)(load[None])])
def test_traced_scenes_are_refused(transformed, tmp_path):
    def saved(load):
        jb.save_scene(jb.load_scene("deep_groove_6205").at_operation(radial_load=load), tmp_path / "a.toml")
        return load

    with pytest.raises(jb.SceneError, match=r"operation\.radial_load: found a traced number; .* outside of jax\.jit"):
        transformed(saved)(jnp.asarray(1500.0))
    assert os.listdir(tmp_path) == []


def test_what_is_no_scene_is_refused(tmp_path):
    class Mine(jb.BallBearing):
        pass

    scene = jb.load_scene("deep_groove_6205")
    parts = {field.name: getattr(scene, field.name) for field in dataclasses.fields(scene)}
    with pytest.raises(jb.SceneError, match="kind: found a Mine; expected a scene of a class that files know"):
        jb.save_scene(Mine(**parts), tmp_path / "a.toml")
    with pytest.raises(TypeError, match="takes a scene, got a Material"):
        jb.save_scene(scene.materials.rings, tmp_path / "a.toml")
    with pytest.raises(OSError, match="gone"):
        jb.save_scene(scene, tmp_path / "gone" / "a.toml")
    assert os.listdir(tmp_path) == []


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "a.toml").write_text("before", encoding="utf-8")
    (tmp_path / "link.toml").symlink_to("a.toml")
    jb.save_scene(jb.load_scene("deep_groove_6205"), str(tmp_path / "link.toml"))
    assert (tmp_path / "link.toml").is_symlink()
    assert_same(jb.load_scene(tmp_path / "a.toml"), jb.load_scene("deep_groove_6205"))
