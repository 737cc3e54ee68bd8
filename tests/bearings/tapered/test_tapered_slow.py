"""Tapered bearings that turn slowly: rollers that carry nothing are brought to their places by next to nothing."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.numerics.status import Status

SMALL = {
    "geometry.n_rollers": "12",
    "geometry.roller_diameter": "5 mm",
    "geometry.roller_half_angle": "1 deg",
    "geometry.flange_angle": "12 deg",
    "geometry.end_radius": "120 mm",
    "operation.misalignment": "0 mrad",
}
DRY = {"oil": "none", "contact": "none", "drag": "none", "rating": "none"}
FOUND = {
    "geometry.roller_diameter": 10.045e-3,
    "geometry.roller_length": 21.116e-3,
    "geometry.contact_angle": 0.41928,
    "geometry.roller_half_angle": 0.059362,
    "geometry.flange_angle": 0.33361,
    "geometry.end_radius": 80.336e-3,
    "operation.axial_load": 234.07,
    "operation.radial_load": 394.67,
    "operation.misalignment": -1.7159e-3,
}
"""By the campaign of random scenes, where it turns at 5.8e-3 rad/s: it did not converge."""
SPEEDS = np.concatenate([[0.0], np.geomspace(1e-3, 10.0, 9)])
"""rad/s."""


@pytest.fixture(scope="module")
def scene():
    return jb.load_scene("tapered_example", {**SMALL, **DRY}).replace(FOUND)


@pytest.fixture(scope="module")
def found(scene):
    solve = lambda speed: jb.solve(scene.at_operation(inner_speed=speed), throw=False)
    return jax.jit(lambda speeds: jax.lax.map(solve, speeds))(jnp.asarray(SPEEDS))


def test_converge(found):
    assert np.all(found.status == Status.CONVERGED)


def test_loads_are_those_at_rest(found):
    """But for centrifugal forces, which go with the square of the speed."""
    loads = np.asarray(found.elements.load_outer)
    change = np.max(np.abs(loads - loads[0]), axis=1) / np.max(loads[0])
    assert np.all(change <= 1e-8 + 1e-4 * (SPEEDS / SPEEDS[-1]) ** 2)


def test_rollers_are_in_balance(scene, found):
    """Along the bearing's axis, where no inertia acts; to what counts as converged, 1e-10 of the load."""
    elements, geometry = found.elements, scene.geometry
    cup, half, rib = (float(getattr(geometry, name)) for name in ("contact_angle", "roller_half_angle", "flange_angle"))
    forces = (
        np.asarray(elements.load_outer) * np.sin(cup)
        - np.asarray(elements.load_inner) * np.sin(cup - 2.0 * half)
        - np.asarray(elements.load_flange) * np.cos(rib)
    )
    total = np.hypot(FOUND["operation.axial_load"], FOUND["operation.radial_load"])
    np.testing.assert_allclose(forces, 0.0, atol=1e-9 * total)
    # every roller leans on the cup as soon as it turns
    assert np.all(np.asarray(elements.load_outer)[2:] > 0.0)
