"""Kinematic frequencies against closed forms and published factors."""

import math
from types import SimpleNamespace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.frequencies import frequencies_of_motion, textbook_frequencies

INCH, HERTZ = 0.0254, 2.0 * math.pi
NAMES = ("cage", "outer_pass", "inner_pass", "element_spin")


def ball_scene(inner=HERTZ, outer=0.0, **changes):
    scene = jb.load_scene("deep_groove_6205", {"contact": "none"})
    return scene.replace({"operation.inner_speed": inner, "operation.outer_speed": outer} | changes)


def moving(loads, orbits, spins):
    """Elements of which the frequencies need to know no more."""
    loads, orbits, spins = (jnp.asarray(one, dtype=float) for one in (loads, orbits, spins))
    return SimpleNamespace(load_inner=loads, load_outer=loads + 5.0, orbital_speed=orbits, spin_speed=spins)


def test_published_factors_of_a_6205():
    """9 balls of 0.3126 in on 1.537 in: the factors that the Bearing Data Center of Case Western Reserve University
    prints for its drive end bearing. It prints twice the spin, and a factor of the cage that is 7e-5 below a ninth of
    its own factor of the outer race, which is taken instead."""
    sizes = {"geometry.ball_diameter": 0.3126 * INCH, "geometry.pitch_diameter": 1.537 * INCH}
    found = textbook_frequencies(ball_scene(**sizes))
    printed = {"cage": 3.5848 / 9.0, "outer_pass": 3.5848, "inner_pass": 5.4152, "element_spin": 4.7135 / 2.0}
    for name, value in printed.items():
        np.testing.assert_allclose(getattr(found, name), value, rtol=2e-5)


def test_elements_pass_one_ring_or_the_other():
    """Both passing frequencies together are Z times the relative speed of the rings, whatever the cage does."""
    scene = ball_scene(inner=700.0, outer=-200.0)
    one = frequencies_of_motion(scene.operation, moving([1.0] * 9, [123.0] * 9, [900.0] * 9), None)
    for found in (textbook_frequencies(scene), one):
        np.testing.assert_allclose(found.outer_pass + found.inner_pass, 9 * 900.0 / HERTZ, rtol=1e-14)


def test_only_relative_speeds_count():
    """A bearing whose rings both turn faster by the same speed has the same passing and spin frequencies, and its cage
    turns faster by that speed."""
    slow, fast = textbook_frequencies(ball_scene(600.0, 100.0)), textbook_frequencies(ball_scene(650.0, 150.0))
    for name in ("outer_pass", "inner_pass", "element_spin"):
        np.testing.assert_allclose(getattr(fast, name), getattr(slow, name), rtol=1e-13)
    np.testing.assert_allclose(fast.cage - slow.cage, 50.0 / HERTZ, rtol=1e-13)


def test_a_contact_angle_makes_the_cage_faster():
    """The textbook's angle is that of the drawing: $\\omega_c/\\omega_i = (1 - D\\cos\\alpha/d_m)/2$."""
    scene: Any = jb.load_scene("angular_contact_218", {"contact": "none"})
    geometry, speed = scene.geometry, float(scene.operation.inner_speed)
    ratio = geometry.ball_diameter * math.cos(float(geometry.contact_angle)) / geometry.pitch_diameter
    np.testing.assert_allclose(textbook_frequencies(scene).cage, 0.5 * speed * (1.0 - ratio) / HERTZ, rtol=1e-14)


def test_loaded_elements_and_the_cage_are_heard():
    """Means are weighted by the load on the inner raceway: elements that only centrifugal forces press outwards do not
    count. A cage that is modelled says its speed itself."""
    elements = moving([3.0, 1.0, *[0.0] * 7], [40.0, 44.0, *[20.0] * 7], [200.0, 240.0, *[90.0] * 7])
    alone = frequencies_of_motion(ball_scene(100.0).operation, elements, None)
    np.testing.assert_allclose(alone.cage, 41.0 / HERTZ, rtol=1e-14)
    np.testing.assert_allclose(alone.element_spin, 210.0 / HERTZ, rtol=1e-14)
    caged = frequencies_of_motion(ball_scene(100.0).operation, elements, SimpleNamespace(speed=jnp.asarray(39.0)))
    np.testing.assert_allclose(caged.cage, 39.0 / HERTZ, rtol=1e-14)
    np.testing.assert_allclose(caged.inner_pass, 9 * 61.0 / HERTZ, rtol=1e-14)


def test_nothing_loaded_and_nothing_turning_is_finite():
    elements = moving([0.0] * 9, [40.0] * 9, [200.0] * 9)
    np.testing.assert_allclose(
        frequencies_of_motion(ball_scene(100.0).operation, elements, None).cage, 40.0 / HERTZ, rtol=1e-14
    )
    slopes = jax.grad(lambda speed: textbook_frequencies(ball_scene(speed)).inner_pass)(0.0)
    assert np.isfinite(slopes)


@pytest.mark.parametrize("outer", [0.0, 300.0])
def test_rollers_without_traction_roll_as_in_the_textbook(outer):
    scene = jb.load_scene("reference_roller", dict.fromkeys(("contact", "cage", "flange", "drag"), "none"))
    solution = jb.solve(scene.at_operation(outer_speed=outer))
    for name in NAMES:
        found, known = (getattr(one, name) for one in (solution.frequencies, solution.textbook_frequencies))
        np.testing.assert_allclose(found, known, rtol=1e-12)


def test_a_failed_solve_has_none():
    solution = jb.solve(ball_scene(600.0), options=jb.NewtonOptions(max_steps=1), throw=False)
    assert not solution.converged
    assert all(np.isnan(getattr(solution.frequencies, name)) for name in NAMES)
