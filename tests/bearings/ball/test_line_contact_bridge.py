"""The line contact that stands for a ball on a race."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from ball_losses import SIMPLE, check_losses
from numpy.testing import assert_allclose

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.kinematics import BallMotion
from jaxbearing.bearings.ball.line_contact_bridge import line_contact_of
from jaxbearing.contacts import HamrockDowsonCentral
from jaxbearing.ehl import FilmModel
from jaxbearing.materials import reduced_modulus
from jaxbearing.numerics.status import Status

VISCOSITY, PRESSURE_VISCOSITY = 4.7e-3, 1.04e-8
"""Of the oil of the turbine at 100 degC, Pa s and 1/Pa."""
ROLLING = dict.fromkeys(("contact", "cage", "drag", "kinematics"), "none")
"""Without friction and films: balls roll without sliding."""


@pytest.fixture(scope="module")
def rolling():
    scene = jb.load_scene("turbine_ball", ROLLING)
    return scene, jb.solve(scene)


@pytest.fixture(scope="module")
def sliding():
    """A light load at high speed, against drag: the balls slide."""
    scene = jb.load_scene("turbine_ball").replace(SIMPLE | {"cage": None, "operation.axial_load": 500.0})
    return scene, jb.solve(scene)


def surfaces(scene, solution, race, ball=0):
    """Speeds of race and ball along rolling, relative to the contact, by hand."""
    elements, geometry = solution.elements, scene.geometry
    angle = float(getattr(elements, f"contact_angle_{race}")[ball])
    names = ("orbital_speed", "spin_speed", "attitude_angle")
    orbit, spin, attitude = (float(getattr(elements, name)[ball]) for name in names)
    pitch, diameter = float(geometry.pitch_diameter), float(geometry.ball_diameter)
    if race == "inner":
        ring = (float(scene.operation.inner_speed) - orbit) * 0.5 * (pitch - diameter * np.cos(angle))
    else:
        ring = (orbit - float(scene.operation.outer_speed)) * 0.5 * (pitch + diameter * np.cos(angle))
    return ring, 0.5 * spin * diameter * np.cos(angle - attitude)


@pytest.mark.parametrize("race", ["outer", pytest.param("inner", marks=pytest.mark.slow)])
@pytest.mark.parametrize("case", ["rolling", "sliding"])
def test_hertz_contact_is_that_of_the_ball(case, race, request):
    """Pressure and half width along rolling to round-off, those of the solution's own ellipse."""
    scene, solution = request.getfixturevalue(case)
    scales = line_contact_of(scene, solution, race=race).scales()
    elements = solution.elements
    assert_allclose(scales.hertz_pressure, getattr(elements, f"pressure_{race}")[0], rtol=1e-12)
    ellipse = ellipses(scene, elements)
    assert_allclose(scales.half_width, ellipse.rolling[("inner", "outer").index(race), 0], rtol=1e-12)


@eqx.filter_jit
def ellipses(scene, elements):
    cosines = jnp.cos(elements.contact_angle_inner), jnp.cos(elements.contact_angle_outer)
    modulus = reduced_modulus(scene.materials.rings, scene.materials.balls)
    loads = jnp.stack([elements.load_inner, elements.load_outer])
    return scene.geometry.contacts(*cosines, modulus).ellipse(loads)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_entrainment_is_the_mean_of_both_surfaces(rolling, sliding, race):
    """Rolling without sliding both surfaces are as fast as the race; with friction they differ by the sliding."""
    for scene, solution in (rolling, sliding):
        ring, ball = surfaces(scene, solution, race)
        found = float(line_contact_of(scene, solution, race=race).operation.entrainment_speed)
        assert_allclose(found, 0.5 * (ring + ball), rtol=1e-12)
        assert found > 0
    ring, ball = surfaces(*rolling, race)
    assert_allclose(ball, ring, rtol=1e-12)
    ring, ball = surfaces(*sliding, race)
    slid = float(getattr(sliding[1].elements, f"sliding_{race}")[0])
    assert_allclose(abs(ball - ring), abs(slid), rtol=1e-6)
    assert abs(slid) > 0.02 * abs(ring)


def test_energy_of_sliding_balls_closes(sliding):
    solution = sliding[1]
    check_losses(solution.power_loss, solution.drive_power, solution.raceway_power)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_a_like_film(rolling, race):
    scene, solution = rolling
    line = line_contact_of(scene, solution, race=race, model=FilmModel(nodes=101, compressible=False))
    cosine = np.cos(getattr(solution.elements, f"contact_angle_{race}")[0])
    ratio = 20.638 / 153.0 * cosine
    radius = 0.5 * 20.638e-3 * (1.0 - ratio if race == "inner" else 1.0 + ratio)
    assert_allclose(line.geometry.reduced_radius_rolling, radius, rtol=0.1)
    film = jb.solve(line).film
    point = float(films(scene, solution.elements)[("inner", "outer").index(race), 0])
    assert 0.6 < float(film.central) / point < 1.5


@eqx.filter_jit
def films(scene, elements):
    """Films of the contact ellipses by Hamrock and Dowson, m."""
    motion = build_core(scene).kinematics
    of = BallMotion(elements.orbital_speed, elements.spin_speed, elements.attitude_angle, jnp.zeros(()))
    angles = elements.contact_angle_inner, elements.contact_angle_outer
    modulus = reduced_modulus(scene.materials.rings, scene.materials.balls)
    contacts = scene.geometry.contacts(*map(jnp.cos, angles), modulus)
    races = motion.inner_race(of, angles[0]), motion.outer_race(of, angles[1])
    speed = jnp.stack([race.mean_speed for race in races])
    loads = jnp.stack([elements.load_inner, elements.load_outer])
    return jnp.exp(HamrockDowsonCentral().log_thickness(contacts, loads, speed, VISCOSITY, PRESSURE_VISCOSITY))


def test_refusals():
    scene = jb.load_scene("turbine_ball", ROLLING)
    solution = jb.solve(scene)
    with pytest.raises(ValueError, match="ball: found 20, expected a number from 0 to 19"):
        line_contact_of(scene, solution, ball=20)
    object.__setattr__(solution, "status", jnp.asarray(int(Status.DIVERGED)))
    with pytest.raises(jb.SolveError):
        line_contact_of(scene, solution)
