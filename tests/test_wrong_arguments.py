"""Functions of the physics say what they expect where they are given something else; traced values pass."""

import os
import subprocess
import sys
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.line_contact_bridge import line_contact_of
from jaxbearing.contacts import (
    ContactPatch,
    HalfSpaceCompliance,
    HamrockDowsonCentral,
    LineContact,
    PointContact,
    Resolution,
    RigidBlend,
    SlicedLine,
    StraightLine,
    palmgren_stiffness,
)
from jaxbearing.contacts.viscous import viscous_function
from jaxbearing.gaps import (
    BallPocket,
    CompliantBallPocketFace,
    CompliantPocketFace,
    Flange,
    LongJournal,
    Pocket,
    PocketEdge,
    ReynoldsDrag,
    RollerDrag,
    ShortJournal,
    ball_frontal_area,
    mixture_density,
    parker_oil_fraction,
    side_leakage_factor,
)
from jaxbearing.gaps.drag import air_density, cylinder_drag_coefficient, sphere_drag_coefficient
from jaxbearing.gaps.journal import saturated_eccentricity
from jaxbearing.gaps.martin import martin_exit, martin_factors, martin_load, martin_rolling, martin_shear
from jaxbearing.life.basic import basic_life, deep_groove_equivalent_load, tapered_equivalent_load
from jaxbearing.life.capacity import ball_capacity, ball_factor, roller_capacity, roller_factor
from jaxbearing.life.modification import (
    contamination_factor,
    fatigue_load_limit,
    film_ratio,
    modification_factor,
    reference_viscosity,
)
from jaxbearing.life.reference import (
    ball_contact_capacities,
    ball_damage_rate,
    edge_factors,
    roller_contact_capacities,
    roller_damage_rate,
)
from jaxbearing.life.static import ball_static_capacity, roller_static_capacity
from jaxbearing.lubricants import Barus, ConstantViscosity, Roelands
from jaxbearing.lubricants.two_viscosities import wooster_pressure_viscosity
from jaxbearing.numerics.integrator import IntegratorOptions
from jaxbearing.scenes.oil.catalogue import load_oil

OIL = load_oil("mobil_jet_ii")
TEMPERATURES = {
    "viscosity": lambda t: OIL.viscosity.viscosity(0.0, t),
    "log_viscosity": lambda t: OIL.viscosity.log_viscosity(1e9, t),
    "log_slope": OIL.viscosity.log_slope,
    "barus": lambda t: Barus(0.03, 300.0, 2e-8, 4e3).viscosity(0.0, t),
    "roelands": lambda t: Roelands(0.03, 300.0, 0.6, 1.1).viscosity(0.0, t),
    "constant": lambda t: ConstantViscosity(0.03).viscosity(0.0, t),
    "coefficient": OIL.pressure_viscosity.coefficient,
    "shear modulus": lambda t: OIL.rheology.log_shear_modulus(1e9, t),
    "stress": lambda t: OIL.rheology.log_stress(1e9, t),
    "density": OIL.density.density,
    "conductivity": OIL.conductivity.conductivity,
    "at": lambda t: OIL.at(t).viscosity,
    "air": air_density,
}
ANGLES = {
    "ball_capacity": lambda angle: ball_capacity(16, 0.01, 0.06, angle),
    "roller_capacity": lambda angle: roller_capacity(16, 0.01, 0.06, 0.01, angle),
    "ball_static_capacity": lambda angle: ball_static_capacity(16, 0.01, 0.06, angle),
    "roller_static_capacity": lambda angle: roller_static_capacity(16, 0.01, 0.06, 0.01, angle),
    "ball_contact_capacities": lambda angle: ball_contact_capacities(2e4, 16, 0.01, 0.06, angle, 0.52, 0.52).inner,
    "roller_contact_capacities": lambda angle: roller_contact_capacities(2e4, 16, 0.01, 0.06, angle).inner,
    "tapered_equivalent_load": lambda angle: tapered_equivalent_load(1e3, 2e3, angle),
}
COUNTS = {
    "ball_capacity": lambda n: ball_capacity(n, 0.01, 0.06, 0.2),
    "roller_capacity": lambda n: roller_capacity(n, 0.01, 0.06, 0.01),
    "ball_static_capacity": lambda n: ball_static_capacity(n, 0.01, 0.06, 0.2),
    "roller_static_capacity": lambda n: roller_static_capacity(n, 0.01, 0.06, 0.01),
    "ball_contact_capacities": lambda n: ball_contact_capacities(2e4, n, 0.01, 0.06, 0.2, 0.52, 0.52).inner,
    "roller_contact_capacities": lambda n: roller_contact_capacities(2e4, n, 0.01, 0.06).inner,
    "edge_factors": edge_factors,
}
CHOICES = {
    "modification_factor": (lambda family: modification_factor(1.0, 0.5, family), "balls", "'ball'"),
    "fatigue_load_limit": (lambda family: fatigue_load_limit(1e4, 0.06, family), "rollers", "'roller'"),
    "contamination_factor": (lambda name: contamination_factor(1.0, 0.06, name), "normal", "'grease_normal'"),
    "viscous_function": (lambda name: viscous_function(name, None), "ree_eyrin", "'ree_eyring'"),
}

BATCH = jnp.asarray([[1e3, 2e3], [0.0, 4e3]])
LIMITS = ball_contact_capacities(1.4e4, 9, 7.94e-3, 39.04e-3, 0.0, 0.52, 0.52)
RUNNING = (jnp.asarray(True), jnp.asarray(False))
FILM = {"viscosity": 5e-3, "radius": 6e-3, "length": 0.014, "film": 1e-6}
FORMULAS = {
    "martin_load": (martin_load, FILM | {"entrainment_speed": 1.0, "squeeze_rate": 1e-3}, 4),
    "martin_shear": (martin_shear, FILM | {"sliding_speed": 0.1, "entrainment_speed": 1.0, "squeeze_rate": 1e-3}, 4),
    "martin_rolling": (martin_rolling, FILM | {"entrainment_speed": 1.0, "squeeze_rate": 1e-3}, 4),
    "martin_exit": (martin_exit, {"s": 0.3}, 0),
    "martin_factors": (lambda s: jnp.stack(martin_factors(s)), {"s": 0.3}, 0),
    "sphere_drag_coefficient": (sphere_drag_coefficient, {"reynolds": 1e3}, 0),
    "cylinder_drag_coefficient": (cylinder_drag_coefficient, {"reynolds": 1e3}, 0),
    "saturated_eccentricity": (saturated_eccentricity, {"eccentricity_ratio": 0.5}, 0),
    "wooster_pressure_viscosity": (wooster_pressure_viscosity, {"viscosity": 0.03}, 1),
    # function, its numbers by name, and how many of them, from the first on, may not be 0
    "basic_life": (lambda **loads: basic_life(exponent=3.0, **loads), {"capacity": 1e4, "equivalent_load": 5e3}, 1),
    "tapered_equivalent_load": (tapered_equivalent_load, {"contact_angle": 0.2, "radial": 1e3, "axial": 2e3}, 1),
    "deep_groove_equivalent_load": (
        deep_groove_equivalent_load,
        {"static_capacity": 8e3, "load_factor": 14.0, "radial": 1e3, "axial": 500.0},
        2,
    ),
    "ball_factor": (ball_factor, {"conformity_inner": 0.52, "conformity_outer": 0.53, "gamma": 0.2}, 2),
    "roller_factor": (roller_factor, {"gamma": 0.2}, 0),
    "ball_capacity": (
        lambda **sizes: ball_capacity(9, contact_angle=0.0, **sizes),
        {
            "ball_diameter": 8e-3,
            "pitch_diameter": 0.04,
            "conformity_inner": 0.52,
            "conformity_outer": 0.52,
            "material_factor": 1.3,
        },
        5,
    ),
    "roller_capacity": (
        lambda **sizes: roller_capacity(9, **sizes),
        {"roller_diameter": 8e-3, "pitch_diameter": 0.04, "length": 8e-3, "material_factor": 1.1},
        4,
    ),
    "ball_contact_capacities": (
        lambda **sizes: (
            ball_contact_capacities(
                n_balls=9, contact_angle=0.0, conformity_inner=0.52, conformity_outer=0.52, **sizes
            ).inner
        ),
        {"capacity": 1e4, "ball_diameter": 8e-3, "pitch_diameter": 0.04},
        3,
    ),
    "roller_contact_capacities": (
        lambda **sizes: roller_contact_capacities(n_rollers=9, **sizes).outer,
        {"capacity": 1e4, "roller_diameter": 8e-3, "pitch_diameter": 0.04},
        3,
    ),
    "ball_static_capacity": (
        lambda **sizes: ball_static_capacity(9, contact_angle=0.0, **sizes),
        {"ball_diameter": 8e-3, "pitch_diameter": 0.04, "conformity_inner": 0.52, "modulus": 2.3e11},
        4,
    ),
    "roller_static_capacity": (
        lambda **sizes: roller_static_capacity(9, **sizes),
        {"roller_diameter": 8e-3, "pitch_diameter": 0.04, "length": 8e-3, "modulus": 2.3e11},
        4,
    ),
    "reference_viscosity": (lambda **sizes: reference_viscosity(100.0, **sizes), {"pitch_diameter": 0.04}, 1),
    "modification_factor": (
        lambda **sizes: modification_factor(family="ball", **sizes),
        {"kappa": 1.0, "load_ratio": 0.5},
        0,
    ),
    "contamination_factor": (
        lambda **sizes: contamination_factor(cleanliness="grease_high", **sizes),
        {"pitch_diameter": 0.04, "kappa": 1.0},
        1,
    ),
    "fatigue_load_limit": (
        lambda **sizes: fatigue_load_limit(family="ball", **sizes),
        {"static_capacity": 8e3, "pitch_diameter": 0.04},
        2,
    ),
    "film_ratio": (film_ratio, {"film": 5e-7, "roughness_a": 3e-7, "roughness_b": 4e-7}, 0),
    "parker_oil_fraction": (
        parker_oil_fraction,
        {"pitch_diameter": 0.14, "oil_flow": 4e-5, "shaft_speed": 1e3, "through_flow_fraction": 0.5},
        1,
    ),
    "air_density": (lambda pressure: air_density(300.0, pressure), {"pressure": 1e5}, 0),
    "mixture_density": (mixture_density, {"oil_fraction": 0.02, "oil_density": 900.0, "gas_density": 1.2}, 0),
    "ball_frontal_area": (ball_frontal_area, {"diameter": 0.02, "cage_thickness": 5e-3}, 1),
    "side_leakage_factor": (side_leakage_factor, {"length": 0.01, "radius": 5e-3, "film": 1e-6}, 3),
    "palmgren_stiffness": (palmgren_stiffness, {"length": 0.01, "reduced_modulus": 2.3e11}, 2),
    "PointContact": (
        lambda **sizes: PointContact(**sizes).semi_axis_rolling(100.0),
        {"reduced_radius_rolling": 0.01, "reduced_radius_transverse": 0.1, "reduced_modulus": 2.3e11},
        3,
    ),
    "LineContact": (
        lambda **sizes: LineContact(**sizes).half_width(100.0),
        {"reduced_radius": 0.01, "length": 0.01, "reduced_modulus": 2.3e11},
        3,
    ),
    "ContactPatch": (
        lambda **sizes: ContactPatch(**sizes).load,
        {"pressure": 1e9, "half_width": 1e-4, "half_length": 1e-3},
        3,
    ),
    "HalfSpaceCompliance": (
        lambda reduced_modulus: HalfSpaceCompliance(reduced_modulus).compliance(ContactPatch(1e9, 1e-4, 1e-3)),
        {"reduced_modulus": 2.3e11},
        1,
    ),
}
ANY_SIGN = ("shaft_speed", "entrainment_speed", "squeeze_rate", "sliding_speed", "s", "reynolds", "eccentricity_ratio")
PARTS = {
    # class, its numbers by name, and how many of them, from the first on, may not be 0
    "ShortJournal": (ShortJournal, {"radius": 0.07, "width": 4e-3, "clearance": 1e-4}, 3),
    "LongJournal": (LongJournal, {"radius": 0.07, "width": 4e-3, "clearance": 1e-4}, 3),
    "Pocket": (Pocket, {"clearance": 3e-4, "length": 0.01, "roller_radius": 6e-3}, 3),
    "CompliantPocketFace": (
        CompliantPocketFace,
        {
            "roller_radius": 6e-3,
            "length": 0.01,
            "reduced_modulus": 2.3e11,
            "minimum_speed": 0.5,
            "minimum_film": 1e-7,
            "pressure_viscosity": 1e-8,
        },
        5,
    ),
    "BallPocket": (BallPocket, {"clearance": 3e-4, "ball_radius": 5e-3}, 2),
    "CompliantBallPocketFace": (
        CompliantBallPocketFace,
        {
            "clearance": 3e-4,
            "ball_radius": 5e-3,
            "stiffness": 4e10,
            "minimum_speed": 0.5,
            "minimum_film": 1e-7,
        },
        5,
    ),
    "Flange": (
        Flange,
        {
            "race_radius": 65e-3,
            "rim_radius": 67e-3,
            "pitch_radius": 71e-3,
            "roller_radius": 6e-3,
            "side_clearance": 15e-6,
            "angle": 0.005,
        },
        4,
    ),
    "PocketEdge": (
        PocketEdge,
        {
            "inner_radius": 65e-3,
            "outer_radius": 73e-3,
            "pitch_radius": 71e-3,
            "roller_radius": 6e-3,
            "side_clearance": 15e-6,
        },
        4,
    ),
    "ReynoldsDrag": (ReynoldsDrag, {"diameter": 0.01, "area": 1e-4}, 1),
    "RollerDrag": (RollerDrag, {"coefficient": 1.2, "area": 1e-4}, 0),
    "StraightLine": (StraightLine, {"stiffness": 1e10, "length": 0.01}, 2),
    "SlicedLine": (SlicedLine, {"stiffness": 1e10, "length": 0.01}, 2),
    "RigidBlend": (lambda exponent: RigidBlend(HamrockDowsonCentral(), exponent), {"exponent": 3.0}, 1),
}
COUNTED = {
    "ShortJournal": lambda n: ShortJournal(0.07, 4e-3, 1e-4, n_lands=n),
    "Flange": lambda n: Flange(65e-3, 67e-3, 71e-3, 6e-3, 15e-6, 0.005, n_sides=n),
    "PocketEdge": lambda n: PocketEdge(65e-3, 73e-3, 71e-3, 6e-3, 15e-6, n_sides=n),
    "SlicedLine": lambda n: SlicedLine(1e10, 0.01, count=n),
    "Resolution, steps": lambda n: Resolution(n, 2),
    "Resolution, strips": lambda n: Resolution(2, n),
    "NewtonOptions": lambda n: jb.NewtonOptions(max_steps=n),
    "IntegratorOptions": lambda n: IntegratorOptions(max_steps=n),
}


@pytest.mark.parametrize("name", TEMPERATURES)
def test_temperatures_in_degrees_celsius(name):
    function = TEMPERATURES[name]
    for wrong in (40.0, np.float64(40.0), jnp.asarray([313.15, 40.0])):
        with pytest.raises(ValueError, match=r"must be in K, at least 150, got 40 \(40 degC are 313\.15 K"):
            function(wrong)
    assert np.isfinite(function(1000.0))
    right = function(313.15)
    assert np.isfinite(right)
    # traced, the same number as eager
    np.testing.assert_allclose(jax.jit(function)(313.15), right, rtol=1e-12)


@pytest.mark.parametrize("name", ANGLES)
def test_angles_in_degrees(name):
    function = ANGLES[name]
    with pytest.raises(ValueError, match=r"contact_angle must be an angle in rad, .*got 40 \(40 degrees are 0\.6981"):
        function(40.0)
    for wrong in (-0.1, 0.5 * np.pi, np.nan, 100.0):
        with pytest.raises(ValueError, match=r"contact_angle must be an angle in rad, from 0 to below pi/2, got"):
            function(wrong)
    right = function(0.6)
    assert np.isfinite(right)
    np.testing.assert_allclose(jax.jit(function)(0.6), right, rtol=1e-12)


@pytest.mark.parametrize("name", COUNTS)
def test_numbers_of_elements(name):
    for wrong in (0, -3):
        with pytest.raises(ValueError, match=r"n_\w+ must be a whole number >= 1, got"):
            COUNTS[name](wrong)
    assert np.all(np.isfinite(COUNTS[name](16)))


@pytest.mark.parametrize("name", FORMULAS)
def test_numbers_of_formulas(name):
    function, right, positive = FORMULAS[name]
    found = function(**right)
    assert np.all(np.isfinite(found))
    traced = jax.jit(function)
    np.testing.assert_allclose(traced(**right), found, rtol=1e-12)
    for place, field in enumerate(right):
        wrong = () if field in ANY_SIGN else (-1e-9, -1.0, np.float64(-1.0), jnp.asarray(-1.0), -np.inf)
        for value in (*wrong, 0.0) if place < positive else wrong:
            with pytest.raises(ValueError, match=rf"{field} must be .*, got -?(\d|inf)"):
                function(**{**right, field: value})
            # where it is traced it is a number like any other
            traced(**{**right, field: float(value)})
        if field != "contact_angle":
            # as that of a failed solve
            assert np.all(np.isnan(function(**{**right, field: np.nan})))


def test_numbers_of_batches():
    """One wrong number among right ones is enough; batches, 0 and infinite loads are as before."""
    np.testing.assert_allclose(basic_life(1e4, BATCH, 3.0), [[1e3, 125.0], [np.inf, 15.625]])
    assert basic_life(1e4, 0.0, 3.0) == np.inf
    assert modification_factor(1.0, np.inf, "ball") == 50.0
    assert film_ratio(BATCH, 1.0, 0.0).shape == (2, 2)
    assert PointContact(jnp.asarray([[1e-2], [2e-2]]), jnp.ones((1, 3)), 2.3e11).ellipticity().shape == (2, 3)
    assert float(HalfSpaceCompliance(np.inf).compliance(ContactPatch(1e9, 1e-4, 1e-3))) == 0.0
    with pytest.raises(ValueError, match="equivalent_load must be >= 0, got -2000"):
        basic_life(1e4, BATCH.at[0, 1].set(-2e3), 3.0)
    with pytest.raises(ValueError, match=r"reduced_radius_rolling must be > 0, got -0\.5"):
        PointContact(jnp.asarray([1e-2, -0.5]), 0.1, 2.3e11)
    with pytest.raises(ValueError, match="exponent must be > 0, got 0"):
        basic_life(1e4, 5e3, 0.0)
    for smooth in (0.0, np.zeros(2)):
        with pytest.raises(ValueError, match="roughness must be > 0, got 0"):
            film_ratio(5e-7, smooth, smooth)


def test_loads_of_contacts():
    load = jnp.asarray([1e3, -1.0, 0.0])
    with pytest.raises(ValueError, match="outer must be >= 0, got -1"):
        ball_damage_rate(jnp.abs(load), load, LIMITS, *RUNNING)
    with pytest.raises(ValueError, match="inner must be >= 0, got -1"):
        roller_damage_rate(load[:, None], load[:, None], LIMITS, *RUNNING, factors=np.ones(1))
    with pytest.raises(ValueError, match=r"capacities\.inner must be > 0, got 0"):
        ball_damage_rate(jnp.abs(load), jnp.abs(load), LIMITS._replace(inner=jnp.asarray(0.0)), *RUNNING)


def test_elements_that_are_larger_than_the_pitch_circle():
    for capacity in (ball_capacity, ball_static_capacity):
        with pytest.raises(ValueError, match=r"gamma must be >= 0 and below 1, got 1\.5"):
            capacity(9, 0.06, 0.04, 0.0)
    for conformity in (0.5, 0.4, 1.1):
        with pytest.raises(ValueError, match=r"conformity_inner must be above 0\.5 and at most 1, got"):
            ball_static_capacity(9, 8e-3, 0.04, 0.0, conformity)


@pytest.mark.parametrize("name", PARTS)
def test_numbers_of_parts(name):
    kind, right, positive = PARTS[name]
    kind(**right)
    for place, field in enumerate(right):
        traced = jax.jit(lambda value, field=field: jax.tree.leaves(kind(**{**right, field: value})))
        for value in (-1e-9, np.nan, np.inf, *([0.0] if place < positive else [])):
            with pytest.raises(ValueError, match=rf"{field} must be .*, got"):
                kind(**{**right, field: value})
            traced(value)


@pytest.mark.parametrize("name", COUNTED)
def test_counts_of_parts(name):
    COUNTED[name](2)
    for wrong in (0, -1):
        with pytest.raises(ValueError, match=rf"must be >= 1, got {wrong}"):
            COUNTED[name](wrong)


def test_options_of_solvers():
    for name in ("residual_tolerance", "step_tolerance", "inner_tolerance"):
        for wrong in (0.0, -1e-9):
            with pytest.raises(ValueError, match=rf"{name} must be > 0, got"):
                jb.NewtonOptions(**{name: wrong})
    for name in ("tolerance", "shortest_step"):
        with pytest.raises(ValueError, match=rf"{name} must be > 0, got -1"):
            IntegratorOptions(**{name: -1.0})


def test_runs_in_time_are_no_part_of_a_program():
    scene, film = jb.load_scene("turbine_roller"), jb.load_scene("satellite_contact_1")
    at = lambda speed: scene.replace({"operation.inner_speed": speed})
    bearing = r"simulate was called inside of jit, .*use simulate_batch, or quasi_static_start and trajectory"
    contact = r"simulate was called inside of jit, (?!.*simulate_batch).*call simulate outside"
    calls = {
        bearing: [
            lambda x: jb.simulate(at(x), 1e-4).time,
            # of a scene that is known
            lambda x: jb.simulate(scene, 1e-4).time * x,
        ],
        contact: [lambda x: jb.simulate(film.replace({"operation.entrainment_speed": x}), 1e-4).time],
        "sweep was called inside of jit, .*solve": [
            lambda x: jb.sweep(at(x), {"operation.radial_load": [1e3]}),
            lambda x: jb.sweep(scene, {"operation.radial_load": [x]}),
        ],
    }
    for words, functions in calls.items():
        for function in functions:
            with pytest.raises(ValueError, match=words):
                jax.jit(function)(1000.0)
    with pytest.raises(ValueError, match=bearing):
        jax.grad(lambda x: jb.simulate(at(x), 1e-4).time[-1])(1000.0)


OF_ANOTHER_TYPE = """
import jaxbearing, sys
from jaxbearing.contacts import DistributedTraction
from jaxbearing.bearings.bearing_life import bearing_life
sys.path.insert(0, {folder!r})
import test_wrong_arguments as cases

def said(function, *values):
    for value in values:
        try:
            function(value)
        except ValueError as error:
            print(error)

for name, (function, wrong, near) in cases.CHOICES.items():
    said(function, wrong, None, 3, ["ball"])
for function in cases.COUNTS.values():
    said(function, 16.0, "16", None, True)
said(cases.race, "iner")
for function, right, _ in cases.FORMULAS.values():
    for field in right:
        said(lambda value: function(**{{**right, field: value}}), *cases.NO_NUMBERS)
for function in (*cases.TEMPERATURES.values(), *cases.ANGLES.values()):
    said(function, *cases.NO_NUMBERS)
for kind, right, _ in cases.PARTS.values():
    for field in right:
        said(lambda value: kind(**{{**right, field: value}}), "a", None, [1.0])
for function in cases.COUNTED.values():
    said(function, 1.5, "2", None, True)
said(jaxbearing.load_scene, *cases.NO_PATHS)
said(cases.load_oil, *cases.NO_PATHS)
said(lambda overrides: jaxbearing.load_scene("turbine_ball", overrides), 3, ["a"], "geometry.n_balls=3", {{3: 3}})
same = cases.Resolution(cases.np.int64(4), 2, cases.np.bool_(True)), cases.Resolution(4, 2, True)
assert same[0] == same[1] and hash(same[0]) == hash(same[1])
scene = jaxbearing.load_scene("turbine_roller")
said(lambda none: bearing_life(scene, none), None)
said(cases.jax.jit(lambda x: jaxbearing.simulate(scene, x).time), 1e-4)
said(cases.jax.jit(lambda x: jaxbearing.simulate_batch(scene, x, {{"operation.inner_speed": [1e3, 2e3]}}).time), 1e-4)
said(lambda x: jaxbearing.simulate(scene, x), "1 ms")
said(lambda resolution: DistributedTraction(resolution=resolution), None, (40, 16))
"""


NO_NUMBERS = ("a", None, [300.0], True, 1j)

NO_PATHS = (3, None, b"turbine_ball", ["turbine_ball"], {"kind": "ball_bearing"}, 3.5)


def race(name):
    return line_contact_of(jb.load_scene("turbine_ball"), None, race=name, ball=0)


def test_arguments_of_another_type():
    """In a process of its own: in these tests every annotation is checked before the functions are."""
    code = OF_ANOTHER_TYPE.format(folder=str(Path(__file__).parent))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    for _, wrong, near in CHOICES.values():
        assert any(f"got '{wrong}'; did you mean {near}?" in line for line in lines)
    assert sum("must be one of" in line for line in lines) == 4 * len(CHOICES) + 1
    assert "race must be one of 'inner', 'outer', got 'iner'; did you mean 'inner'?" in lines
    assert sum("must be a whole number >= 1, got" in line for line in lines) == 4 * len(COUNTS)
    numbers = sum(len(right) for _, right, _ in FORMULAS.values()) + len(TEMPERATURES) + len(ANGLES)
    assert sum("must be a number or an array of numbers, got" in line for line in lines) == len(NO_NUMBERS) * numbers
    parts = sum(len(right) for _, right, _ in PARTS.values())
    assert sum("must be one number, got" in line for line in lines) == 3 * parts
    assert sum("must be a whole number, got" in line for line in lines) == 4 * len(COUNTED)
    assert sum("expected the path of a scene file, or a built-in scene (" in line for line in lines) == len(NO_PATHS)
    assert sum("expected an oil of the catalogue" in line for line in lines) == len(NO_PATHS)
    assert sum("overrides: found" in line and "expected dotted paths with" in line for line in lines) == 3
    assert sum("overrides: 3: found the number 3; expected a dotted path" in line for line in lines) == 1
    for words in (
        "bearing_life needs a scene with a rating",
        "simulate was called inside of jit",
        "duration: got a traced value",
        "duration must be one finite number, got '1 ms'",
    ):
        assert sum(words in line for line in lines) == 1, words
    assert sum("resolution must be a Resolution, got" in line for line in lines) == 2


@pytest.mark.parametrize("values", [["a"], [1j], None, [[1.0], [1.0, 2.0], [3.0]], "5 kN"])
def test_values_of_a_sweep(values):
    with pytest.raises(ValueError, match=r"operation\.radial_load: expected .* finite numbers"):
        jb.sweeps.grid({"operation.radial_load": values})
    with pytest.raises(ValueError, match=r"operation\.radial_load: expected (lowest and highest|one or more)"):
        jb.sweeps.random({"operation.radial_load": values}, 3)
    with pytest.raises(ValueError, match="over must map dotted paths"):
        jb.sweeps.listed(values)


def test_changes_of_a_scene_and_files_of_a_run():
    with pytest.raises(TypeError, match="replace takes a mapping from dotted paths to values, got 3"):
        jb.load_scene("reference_roller").replace(3)
    with pytest.raises(TypeError, match="read_last_state takes the path of a file, got 3"):
        jb.read_last_state(3)


def test_built_in_scenes_inside_of_programs():
    for name in jb.builtin_names():
        loaded = jax.jit(lambda x, name=name: x * len(jax.tree.leaves(jb.load_scene(name))))(1.0)
        assert loaded > 0.0


def test_truth_values_are_no_numbers():
    scene = jb.load_scene("deep_groove_6205")
    for value in (True, np.True_, jnp.array(True)):
        for path in ("operation.radial_load", "geometry.pitch_diameter", "operation.outer_speed"):
            with pytest.raises(ValueError, match=f"{path} must be one number, got"):
                scene.replace({path: value})
        with pytest.raises(ValueError, match="radial_load must be one number"):
            jb.BallOperation(inner_speed=100.0, radial_load=value)
    with pytest.raises(ValueError, match="must be one number"):
        jax.jit(lambda load: scene.replace({"operation.radial_load": load > 0.0}).operation.radial_load)(1.0)


def test_unknown_fields_in_python_suggest_the_nearest():
    ball, shaft = jb.load_scene("deep_groove_6205"), jb.load_scene("gear_shaft")
    for scene, path, meant in (
        (ball, "operation.radial_laod", "operation.radial_load"),
        (ball, "operatoin.radial_load", "operation"),
        (shaft, "bearing.raer.position", "bearing.rear"),
        (shaft, "bearing.rear.positon", "bearing.rear.position"),
        (shaft, "bearing.rear.geometry.pitch_diametr", "bearing.rear.geometry.pitch_diameter"),
        (shaft, "set.front.geometry.n_bals", "set.front.geometry.n_balls"),
        (shaft, "force.pinion.torqe", "force.pinion.torque"),
    ):
        with pytest.raises(AttributeError, match=f"the scene has no '.*did you mean '{meant}'"):
            scene.replace({path: 1.0})
    with pytest.raises(TypeError, match="BallGeometry has no argument 'n_bals'; did you mean 'n_balls'"):
        jb.BallGeometry(n_bals=9)
    with pytest.raises(TypeError, match="BallBearing has no argument 'geometri'; did you mean 'geometry'"):
        jb.BallBearing(geometri=1)
