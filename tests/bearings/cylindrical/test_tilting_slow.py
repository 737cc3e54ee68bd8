"""Bearings of tilting rollers that turn slowly: rollers that carry nothing are held by next to nothing."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import dry_roller

import jaxbearing as jb
from jaxbearing.bearings.profile import RollerProfile
from jaxbearing.contacts.profile import CrownedProfile
from jaxbearing.numerics.status import Status

SPEEDS = np.concatenate([[0.0], np.geomspace(1e-3, 1e3, 13)])
"""rad/s."""


@pytest.fixture(scope="module")
def slow_and_fast():
    """Found by the campaign of random scenes: such bearings did not converge when they turned slowly."""
    crowned = RollerProfile(CrownedProfile(drop=8e-6), n_laminae=30)
    scene = dry_roller().replace(
        {"geometry.n_rollers": 10, "profile": crowned, "operation.misalignment": 2e-3, "operation.radial_load": 300.0}
    )
    solve = lambda speed: jb.solve(scene.at_operation(inner_speed=speed), throw=False)
    return jax.jit(lambda speeds: jax.lax.map(solve, speeds))(jnp.asarray(SPEEDS))


def test_converge_in_few_steps(slow_and_fast):
    assert np.all(slow_and_fast.status == Status.CONVERGED)
    assert np.max(slow_and_fast.iterations) <= 40


def test_rollers_are_in_balance(slow_and_fast):
    """Every roller leans on the outer race with the inner load and its centrifugal force, however small that is."""
    elements = slow_and_fast.elements
    scene = dry_roller()
    geometry, density = scene.geometry, scene.materials.rollers.density
    mass = density * np.pi / 4.0 * geometry.roller_diameter**2 * geometry.roller_length
    outward = mass * geometry.pitch_radius * elements.orbital_speed**2
    np.testing.assert_allclose(elements.load_outer - elements.load_inner, outward, rtol=1e-6, atol=3e-9)


def test_slow_is_at_rest(slow_and_fast):
    loads = np.asarray(slow_and_fast.elements.load_inner)
    np.testing.assert_allclose(loads[1], loads[0], atol=1e-8 * loads[0].max())
