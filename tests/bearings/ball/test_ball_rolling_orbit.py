"""Balls that roll without sliding, where the centrifugal force is large beside the loads: the orbital speed and the
outer contact angle belong together."""

import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb

LEFT_OUT = (
    "contact.traction",
    "contact.traction_accuracy",
    "contact.rolling_resistance",
    "contact.thermal",
    "drag",
    "cage",
)
SCENE = dict.fromkeys(LEFT_OUT, "none") | {"kinematics.attitude": "outer", "operation.radial_load": "1 kN"}
LIGHT = {
    "geometry.pitch_diameter": 0.07995659480691669,
    "geometry.ball_diameter": 0.016513728083646897,
    "geometry.conformity_inner": 0.5061907818811621,
    "geometry.conformity_outer": 0.5079024791617602,
    "geometry.contact_angle": 0.7244896880864421,
    "geometry.n_balls": 10,
    "materials.balls.density": 5165.233424306139,
    "operation.axial_load": 1238.4495066157806,
    "operation.radial_load": 372.9055590027865,
    "operation.oil_temperature": 455.8426580276181,
}
"""A bearing that the campaign of random scenes found."""


@pytest.fixture(scope="module")
def solver():
    scene = jb.load_scene("turbine_ball", SCENE).replace(LIGHT)
    return scene, jb.jit_solver(scene)


@pytest.mark.slow
@pytest.mark.parametrize(("inner", "outer"), [(1170.6, 0.0), (1170.6, -1170.6), (-800.0, 1500.0), (2000.0, 1500.0)])
def test_balls_are_in_balance(solver, inner, outer):
    scene, solve = solver
    found = solve(inner_speed=inner, outer_speed=outer)
    assert bool(found.converged)
    balls = found.elements
    mass = scene.materials.balls.density * np.pi / 6.0 * scene.geometry.ball_diameter**3
    radius = 0.5 * scene.geometry.pitch_diameter
    outward = mass * radius * jnp.square(balls.orbital_speed)
    radial = (
        balls.load_outer * jnp.cos(balls.contact_angle_outer)
        - balls.load_inner * jnp.cos(balls.contact_angle_inner)
        - outward
    )
    axial = balls.load_outer * jnp.sin(balls.contact_angle_outer) - balls.load_inner * jnp.sin(
        balls.contact_angle_inner
    )
    for left in (radial, axial):
        np.testing.assert_allclose(left, 0.0, atol=1e-11 * float(jnp.max(balls.load_outer)))


@pytest.mark.slow
def test_a_ball_that_is_caught_behind_the_groove_is_warned_of():
    """A radial load far above the axial one, and a moment: the groove of the model is a full circle."""
    scene = jb.load_scene("angular_contact_218", {"operation.radial_load": "5 kN", "operation.moment": "10 N*m"})
    solve = jb.jit_solver(scene)
    caught = solve(axial_load=1211.6, radial_load=48825.8, inner_speed=2602.4, moment=2101.2)
    usual = solve(axial_load=20e3, radial_load=5e3, inner_speed=500.0, moment=10.0)
    for found, behind in ((caught, True), (usual, False)):
        assert bool(found.converged)
        angle = jnp.where(found.elements.load_inner > 100.0, jnp.abs(found.elements.contact_angle_inner), 0.0)
        assert (float(jnp.max(angle)) > 0.5 * np.pi) is behind
        assert any("beyond 90°" in text for text in found.warnings) is behind
