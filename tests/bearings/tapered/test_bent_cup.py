"""Tapered rollers in a cup that bends, and between raceways that are not round: balances, limits, derivatives."""

import dataclasses
import functools

import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import check_derivatives, lobes, unbalance

import jaxbearing as jb
from jaxbearing.bearings.ring_shape import FlexibleRing, InnerRoundness, OuterRoundness
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.bearings.tapered.scene import TaperedRollerBearing

HOUSING = {"thickness": 4e-3, "width": 14e-3, "housing_stiffness": 5e9}


@functools.cache
def dry(**changes: str) -> TaperedRollerBearing:
    """The bearing of the 30206 class under combined load; its cone does not tilt."""
    parts = {"contact": "none", "operation.axial_load": "2 kN", "operation.radial_load": "4 kN"}
    return jb.load_scene("tapered_example", parts | changes)


def on_housing(scene: TaperedRollerBearing, **changes) -> TaperedRollerBearing:
    return dataclasses.replace(scene, outer_ring=FlexibleRing(**(HOUSING | changes)))


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda: on_housing(dry()), id="dry"),
        pytest.param(lambda: on_housing(dry(**{"operation.moment": "450 N*m"})), id="dry, tilting"),
        pytest.param(lambda: on_housing(jb.load_scene("tapered_example")), id="films", marks=pytest.mark.slow),
    ],
)
def test_the_cup_is_in_balance(make):
    scene = make()
    solution, rigid = jb.solve(scene), jb.solve(dataclasses.replace(scene, outer_ring=None))
    assert unbalance(scene, solution) < 1e-9
    # the cup yields under the most loaded roller
    assert float(np.max(solution.elements.load_outer)) < float(np.max(rigid.elements.load_outer))


def test_the_cone_carries_its_loads():
    solution = jb.solve(on_housing(dry()))
    elements = solution.elements
    outer, angle = np.asarray(elements.load_outer), np.asarray(elements.contact_angle_outer)
    # what the cup takes from the rollers is what the cone gets: their centrifugal forces cancel round the bearing
    turning = np.sum(outer * np.cos(angle) * np.cos(np.asarray(elements.azimuth)))
    np.testing.assert_allclose(turning, 4e3, rtol=1e-8)
    np.testing.assert_allclose(np.sum(outer * np.sin(angle)), 2e3, rtol=1e-8)


def test_stiff_housing_is_the_rigid_cup():
    rigid, stiff = jb.solve(dry()), jb.solve(on_housing(dry(), housing_stiffness=1e16))
    np.testing.assert_allclose(stiff.elements.load_outer, rigid.elements.load_outer, rtol=1e-5, atol=1e-3)
    np.testing.assert_allclose(stiff.ring.radial, rigid.ring.radial, rtol=1e-5)


def test_no_harmonics_is_the_same_program():
    rigid, none = jb.solve(dry()), jb.solve(on_housing(dry(), harmonics=0))
    np.testing.assert_array_equal(rigid.elements.load_inner, none.elements.load_inner)
    assert rigid.unknowns == none.unknowns


def test_a_lobe_of_order_1_moves_the_cone():
    """It is a displacement of the raceway, which rollers and cone follow."""
    plain = jb.solve(dry())
    moved = jb.solve(dataclasses.replace(dry(), outer_roundness=lobes(OuterRoundness, 1, 7e-6)))
    np.testing.assert_allclose(moved.elements.load_inner, plain.elements.load_inner, rtol=1e-7, atol=1e-5)
    np.testing.assert_allclose(moved.ring.radial - plain.ring.radial, 7e-6, rtol=1e-7)
    np.testing.assert_allclose(moved.ring.axial, plain.ring.axial, rtol=1e-7)


def test_a_larger_inner_raceway_pulls_the_cone_out():
    """A lobe of order 0 is a taller cone, which stands further from the apex."""
    plain = jb.solve(dry())
    grown = jb.solve(dataclasses.replace(dry(), inner_roundness=lobes(InnerRoundness, 0, 2e-6)))
    assert float(grown.ring.axial) < float(plain.ring.axial)


def test_derivatives():
    def most(housing, height):
        oval = OuterRoundness(lobe_order=[2.0], lobe_height=jnp.stack([height]), lobe_angle=[0.3])
        scene = on_housing(dry(), housing_stiffness=housing, harmonics=4)
        return jb.solve(dataclasses.replace(scene, outer_roundness=oval)).elements.load_inner[0]

    check_derivatives(most, (5e9, 3e-6), forward=False)


def test_reaction_is_the_load():
    # a lobe beside the load line pushes the cone sideways
    free = dry(**{"operation.radial_load_lateral": "0 N"})
    scene = dataclasses.replace(on_housing(free), outer_roundness=lobes(OuterRoundness, 2, 3e-6, 0.3))
    solution = jb.solve(scene)
    held = jb.reaction(scene, [float(getattr(solution.ring, name)) for name in RING_FREEDOMS], at="ring")
    np.testing.assert_allclose(held.force[:3], [2e3, 4e3, 0.0], rtol=1e-7, atol=1e-3)
    largest = np.max(np.abs(held.stiffness))
    np.testing.assert_allclose(held.stiffness, solution.stiffness, rtol=1e-6, atol=1e-9 * largest)


def test_refusals():
    with pytest.raises(ValueError, match="nothing holds the ring"):
        on_housing(dry(), housing_stiffness=None)
