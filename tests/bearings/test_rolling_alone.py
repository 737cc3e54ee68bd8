"""Rolling resistance without traction: it works in every kind of bearing, its loss is the power that the rings bring,
and what else is not modelled is said."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core, build_lubricated
from jaxbearing.bearings.ball.rolling import rolling_balance, rolling_resistance

ROLLING_BALLS = {
    "contact.traction": "none",
    "contact.traction_accuracy": "none",
    "contact.thermal": "none",
    "cage": "none",
    "drag": "none",
    "kinematics.attitude": "outer",
}
NO_TRACTION = dict.fromkeys(("contact.traction", "cage", "flange", "drag"))


def balls(**changes):
    return jb.load_scene("turbine_ball", ROLLING_BALLS | changes)


def check(solution, operation):
    """The loss is positive, the only one, and what the torques bring."""
    loss = solution.power_loss
    assert bool(solution.converged)
    assert float(loss.total) > 1.0
    assert loss.total == loss.rolling_resistance
    assert loss.drag is None
    assert "rolling_resistance" not in solution.not_modelled
    assert "drag" in solution.not_modelled
    torques = operation[0] * solution.inner_torque + operation[1] * solution.outer_torque
    np.testing.assert_allclose(torques, solution.drive_power, rtol=1e-13)
    np.testing.assert_allclose(solution.drive_power, loss.total, rtol=1e-12)


@pytest.mark.parametrize("attitude", ["outer", "inner"])
def test_constraint_forces_balance_each_ball(attitude):
    """Moments about the axis and about the radius and the force along the orbit, as `ball.friction` prints them."""
    angle = np.asarray([[0.7, 0.3], [0.45, 0.52]])

    @eqx.filter_jit
    def balanced(scene):
        system = build_lubricated(scene, build_core(scene))
        state = system.at(system.initial())
        widened = jax.tree.map(lambda leaf: jnp.broadcast_to(leaf, (*leaf.shape[:-1], 2)), state)
        load = jnp.asarray([[900.0, 400.0], [1200.0, 800.0]])
        widened = widened._replace(angle=jnp.asarray(angle), load=load)
        resistance = rolling_resistance(system, widened)
        assert resistance is not None
        found = rolling_balance(system, widened, resistance)
        return found.forward, found.about, resistance, system.kinematics.ball_diameter

    found = jax.tree.map(np.asarray, balanced(balls(**{"kinematics.attitude": attitude})))
    (f_i, f_o), (s_i, s_o), (r_i, r_o), diameter = found
    (a_i, a_o), arm = angle, 2.0 / diameter
    axis = f_o * np.cos(a_o) - f_i * np.cos(a_i) + arm * (s_o * np.sin(a_o) - s_i * np.sin(a_i))
    axis = axis + arm * (r_o * np.cos(a_o) + r_i * np.cos(a_i))
    radius = -f_o * np.sin(a_o) + f_i * np.sin(a_i) + arm * (s_o * np.cos(a_o) - s_i * np.cos(a_i))
    radius = radius - arm * (r_o * np.sin(a_o) + r_i * np.sin(a_i))
    size = float(np.max(np.abs(f_i)))
    assert size > 0.1
    for left in (axis, radius, f_i + f_o):
        np.testing.assert_allclose(left, 0.0, atol=1e-13 * size)
    free = s_i if attitude == "outer" else s_o
    np.testing.assert_array_equal(free, 0.0)  # no moment on the race where the ball spins


@pytest.mark.parametrize("attitude", ["outer", pytest.param("inner", marks=pytest.mark.slow)])
def test_balls_that_roll_alone(attitude):
    scene = balls(**{"kinematics.attitude": attitude})
    solve = jb.jit_solver(scene)
    for speeds in ((1309.0, 0.0), (900.0, -400.0), (-1309.0, 0.0)):
        check(solve(inner_speed=speeds[0], outer_speed=speeds[1]), speeds)


def test_balls_without_rolling_resistance_have_no_total():
    scene = balls(**{"contact.rolling_resistance": "none"})
    solution = eqx.filter_eval_shape(lambda scene: jb.solve(scene, throw=False), scene)  # structure alone
    assert solution.power_loss.total is solution.drive_power is solution.inner_torque is None
    expected = {"inner_raceway", "outer_raceway", "rolling_resistance", "pocket", "cage_pilot", "drag"}
    assert set(solution.not_modelled) == expected


def test_rollers_that_roll_alone_cost_what_they_do_under_a_misalignment_of_zero():
    scene = jb.load_scene("turbine_roller", {"contact.rolling_resistance": "ertel_grubin", "contact.thermal": "none"})
    plain = scene.replace(NO_TRACTION)
    solve = jb.jit_solver(plain)
    for speeds in ((1100.0, 0.0), (1100.0, -400.0)):
        check(solve(inner_speed=speeds[0], outer_speed=speeds[1]), speeds)
    assert "contact.rolling_resistance" not in plain.unused_parts()
    straight = jb.solve(plain.replace({"operation.misalignment": 0.0}))
    check(straight, (float(plain.operation.inner_speed), 0.0))
    np.testing.assert_allclose(straight.power_loss.total, solve().power_loss.total, rtol=1e-10)
