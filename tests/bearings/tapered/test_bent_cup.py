"""Tapered rollers between a cup and a cone that bend, and between raceways that are not round: balances, limits,
derivatives."""

import dataclasses
import functools

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import check_derivatives, lobes, unbalance
from tapered_cases import CHECKS, check_values, tapered

import jaxbearing as jb
from jaxbearing.bearings.ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.bearings.tapered.build import build_tapered
from jaxbearing.bearings.tapered.scene import TaperedRollerBearing

HOUSING = {"thickness": 4e-3, "width": 14e-3, "harmonics": 4, "housing_stiffness": 5e9}
SHAFT = {"thickness": 3e-3, "width": 14e-3, "harmonics": 4, "shaft_stiffness": 5e9}
ROUND = {"outer": (1, 0.0), "inner": (0, 0.0)}
"""Order and height of the lobe of each raceway, m."""


@functools.cache
def dry() -> TaperedRollerBearing:
    """The bearing of row D of the sheet: its cone tilts, and may move sideways."""
    loads, moment, _ = CHECKS["D"]
    return tapered(*loads, **moment, radial_load_lateral=0.0)


def on_housing(scene: TaperedRollerBearing, **changes) -> TaperedRollerBearing:
    return dataclasses.replace(scene, outer_ring=FlexibleRing(**(HOUSING | changes)))


def between(housing=5e9, shaft=5e9, angle=0.0, **raceways) -> TaperedRollerBearing:
    """Both rings bend, and both raceways have a lobe: one program for all."""
    outer, inner = (ROUND | raceways).values()
    return dataclasses.replace(
        on_housing(dry(), housing_stiffness=housing),
        inner_ring=FlexibleInnerRing(**(SHAFT | {"shaft_stiffness": shaft})),
        outer_roundness=lobes(OuterRoundness, *outer, angle),
        inner_roundness=lobes(InnerRoundness, *inner),
    )


def solved(**changes):
    return jb.solve(between(**changes))


def test_both_rings_are_in_balance():
    found = solved()
    for side in ("outer", "inner"):
        assert unbalance(between(), found, side) < 1e-9
        # the rings yield under the most loaded roller
        loads = [np.max(getattr(one.elements, f"load_{side}")) for one in (found, solved(housing=1e18, shaft=1e18))]
        assert loads[0] < 0.999 * loads[1]


@pytest.mark.slow
def test_the_cup_is_in_balance_with_films():
    scene = on_housing(jb.load_scene("tapered_example"))
    solution, rigid = jb.solve(scene), jb.solve(dataclasses.replace(scene, outer_ring=None))
    assert unbalance(scene, solution) < 1e-9
    assert float(np.max(solution.elements.load_outer)) < float(np.max(rigid.elements.load_outer))


def test_the_cone_carries_its_loads():
    elements = solved().elements
    outer, angle = np.asarray(elements.load_outer), np.asarray(elements.contact_angle_outer)
    # what the cup takes from the rollers is what the cone gets: their centrifugal forces cancel round the bearing
    turning = np.sum(outer * np.cos(angle) * np.cos(np.asarray(elements.azimuth)))
    np.testing.assert_allclose(turning, 6e3, rtol=1e-8)
    np.testing.assert_allclose(np.sum(outer * np.sin(angle)), 8e3, rtol=1e-8)


def test_stiff_housing_and_shaft_are_the_rigid_rings():
    """Those of the sheet, to its printed digits."""
    found = check_values(solved(housing=1e18, shaft=1e18))
    np.testing.assert_allclose(found, CHECKS["D"][2], rtol=3e-6)


def test_no_harmonics_are_the_same_equations():
    rigid, none = (jax.jit(build_tapered)(scene) for scene in (dry(), on_housing(dry(), harmonics=0)))
    assert eqx.tree_equal(rigid, none)
    assert none.outer is None


def test_a_lobe_of_order_1_moves_the_cone():
    """It is a displacement of the raceway, which rollers and cone follow."""
    plain, moved = solved(), solved(outer=(1, 7e-6))
    np.testing.assert_allclose(moved.elements.load_inner, plain.elements.load_inner, rtol=1e-7, atol=1e-5)
    np.testing.assert_allclose(moved.ring.radial - plain.ring.radial, 7e-6, rtol=1e-7)
    np.testing.assert_allclose([moved.ring.axial, moved.ring.tilt], [plain.ring.axial, plain.ring.tilt], rtol=1e-7)


def test_a_larger_inner_raceway_pulls_the_cone_out():
    """A lobe of order 0 is a taller cone, which stands further from the apex."""
    assert float(solved(inner=(0, 2e-6)).ring.axial) < float(solved().ring.axial)


@pytest.mark.slow
def test_derivatives():
    def most(housing, height):
        oval = OuterRoundness(lobe_order=[2.0], lobe_height=jnp.stack([height]), lobe_angle=[0.3])
        scene = dataclasses.replace(between(housing=housing), outer_roundness=oval)
        return jb.solve(scene).elements.load_inner[0]

    check_derivatives(most, (5e9, 3e-6), forward=False)


def test_reaction_is_the_load():
    # a lobe beside the load line pushes the cone sideways
    scene = between(outer=(2, 3e-6), angle=0.3)
    solution = jb.solve(scene)
    assert abs(float(solution.ring.lateral)) > 1e-9
    held = jb.reaction(scene, [float(getattr(solution.ring, name)) for name in RING_FREEDOMS], at="ring")
    np.testing.assert_allclose(held.force[:4], [8e3, 6e3, 0.0, 660.0], rtol=1e-7, atol=1e-3)
    largest = np.max(np.abs(held.stiffness))
    np.testing.assert_allclose(held.stiffness, solution.stiffness, rtol=1e-6, atol=1e-9 * largest)
    for side in ("outer_ring", "inner_ring"):
        np.testing.assert_allclose(getattr(held, side).deflection, getattr(solution, side).deflection, atol=1e-13)


def test_refusals():
    with pytest.raises(ValueError, match="nothing holds the ring"):
        on_housing(dry(), housing_stiffness=None)
