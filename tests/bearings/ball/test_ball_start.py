"""First guesses of ball bearings: where loose and pressed balls lie between given grooves."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball import start as ball_start
from jaxbearing.bearings.ball.build import build_core, build_lubricated
from jaxbearing.bearings.ball.start import free_centres

SCENE = jb.load_scene("angular_contact_218", {"operation.axial_load": "10 N"})
PROBLEM = eqx.filter_jit(lambda scene: build_core(scene)._estimates()[0])(SCENE)
INNER, OUTER = (float(offset) for offset in PROBLEM.offset)
centres = eqx.filter_jit(free_centres)


def placed(length, angle, force):
    """Distances of a ball centre from the centres of the outer and the inner groove, and its angle on the outer one."""
    groove = length * np.asarray([[np.sin(angle)], [np.cos(angle)]])
    problem = dataclasses.replace(PROBLEM, centrifugal=jnp.asarray([force]))
    centre, lost = (np.asarray(part) for part in centres(problem, jnp.asarray(groove)))
    away, outer = (groove - centre)[:, 0], centre[:, 0]
    return np.hypot(*outer), np.hypot(*away), np.arctan2(*outer), bool(lost[0])


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("loose", [0.99, 0.9])
def test_a_loose_ball_lies_on_the_outer_race_and_touches_the_inner_one(side, loose):
    """Where the ring has lifted off by less than the groove is deep, the inner race holds the ball up."""
    outer, inner, angle, lost = placed(loose * (INNER + OUTER), side * 0.7, 1e-3)
    assert not lost
    assert abs(outer / OUTER - 1.0) < 1e-4
    assert abs(inner / INNER - 1.0) < 1e-4
    assert 0.0 < side * angle < 0.7


def test_a_pressed_ball_turns_outward_under_its_centrifugal_force():
    length = INNER + OUTER + 20e-6
    still, fast = (placed(length, 0.7, force) for force in (1e-6, 500.0))
    assert abs(still[2] - 0.7) < 1e-6
    assert 0.0 < fast[2] < 0.7 - 1e-3
    for outer, inner, _, _ in (still, fast):
        assert outer > OUTER
        assert inner > INNER


def test_a_ball_far_from_the_inner_race_rests_at_the_bottom():
    _, inner, angle, lost = placed(0.2 * INNER, 0.3, 5.0)
    assert lost
    assert angle == 0.0
    assert inner < INNER + OUTER


FILMS = {
    "oil.name": "mobil_jet_ii",
    "operation.oil_temperature": "15 degC",
    "contact.film": "nijenbanning",
    "operation.inner_speed": "4000 rpm",
    "operation.axial_load": "4 N",
    "operation.radial_load": "1 N",
    "operation.moment": "0 N m",
}


@pytest.fixture(scope="module")
def light():
    return jb.solve(jb.load_scene("angular_contact_218", FILMS))


@pytest.mark.slow
def test_films_that_fill_the_play_of_a_light_bearing(light):
    """They push the rings back until the balls run in the middle of the grooves; forces balance all the same."""
    e, angle = light.elements, np.asarray(light.elements.contact_angle_inner)
    assert float(light.ring.axial) < -20e-6
    assert np.degrees(angle).max() < 40.0
    scale = float(np.sum(np.asarray(e.load_inner)))
    axial = float(np.sum(np.asarray(e.load_inner) * np.sin(angle)))
    assert abs(axial - 4.0) < 1e-4 * scale


@pytest.mark.slow
def test_an_orbital_speed_that_was_not_found_is_no_result():
    """Rings that turn against each other, heavy balls and hardly any load: two orbital speeds belong to one angle."""
    scene = jb.load_scene("angular_contact_218", FILMS)
    speeds = jnp.linspace(-0.6, -1.1, 6) * scene.operation.inner_speed

    def judged(outer_speed):
        solution = jb.solve(scene.at_operation(outer_speed=outer_speed), throw=False)
        e, geometry, balls = solution.elements, scene.geometry, scene.materials.balls
        force = 0.5 * geometry.mass(balls.density) * geometry.pitch_diameter * jnp.square(e.orbital_speed)
        left = e.load_outer * jnp.cos(e.contact_angle_outer) - e.load_inner * jnp.cos(e.contact_angle_inner) - force
        scale = jnp.max(e.load_outer) + jnp.max(force)
        return solution.converged, jnp.max(jnp.abs(left)) / scale

    converged, left = (np.asarray(part) for part in jax.jit(lambda s: jax.lax.map(judged, s))(speeds))
    assert converged.any()
    assert left[converged].max() < 1e-5  # a ring that tilts is not in the half-plane of the ball


@pytest.mark.parametrize("load", [1000.0, np.nan])
def test_a_lane_without_numbers_is_given_up_at_once(load, monkeypatch):
    """Where lanes are solved at once, all wait for the slowest: one with an invalid input took 2 400 trials."""
    forces, calls = ball_start.forces_at, []
    monkeypatch.setattr(ball_start, "forces_at", lambda *given: calls.append(None) or forces(*given))
    problem = dataclasses.replace(PROBLEM, ring_load=load * jnp.ones_like(PROBLEM.ring_load))
    with jax.disable_jit():
        found = ball_start.start(problem, ball_start.ring_estimate(problem))
    assert bool(jnp.all(jnp.isfinite(found.ring))) == np.isfinite(load)
    assert len(calls) < (60 if np.isfinite(load) else 4)


@pytest.mark.parametrize("guidance", ["inner_ring", "outer_ring"])
def test_friction_of_pockets_goes_through_the_land_without_a_moment(guidance):
    scene = jb.load_scene("turbine_ball", COMBINED | {"cage.guidance": guidance})
    pocket = np.linspace(-1.0, 3.0, scene.geometry.n_balls)

    @eqx.filter_jit
    def through_land(scene, pocket):
        system = build_lubricated(scene, build_core(scene))
        return system.freedoms, system._through_land(pocket), system.azimuth

    freedoms, contributions, azimuth = through_land(scene, jnp.asarray(pocket))
    found = dict(zip(freedoms, np.sum(contributions, axis=1), strict=True))
    radial = float(np.sum(pocket * np.cos(azimuth)))
    assert found["radial"] == pytest.approx(radial, rel=1e-14)
    assert all(value == 0.0 for name, value in found.items() if name != "radial")


COMBINED = {"operation.radial_load": "5 kN", "operation.moment": "20 N m"}
