"""Sets and shafts whose bearings have flexible outer rings and races that are not round."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from bent_shafts import BEARINGS, HOUSING, SHAFT, SPEED, SUPPORTS, alone, bent, row_of, straight
from rings_that_bend import unbalance
from roller_cases import reference_roller
from shaft_cases import DEEP_GROOVE, P, axial_forces, pair

import jaxbearing as jb
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.bearings.ring_shape import FlexibleInnerRing, FlexibleRing
from jaxbearing.shafts import MountedBearing, PointLoad, Preload, Shaft, ShaftSystem, Support
from jaxbearing.shafts.batches import batches_of

DISPLACED = {
    "ball": [2e-5, 25e-6, 4e-6, 5e-4, 3e-4],
    "four_point": [1e-5, 30e-6, 6e-6, 3e-4, 2e-4],
    "cylindrical": [0.0, 40e-6, 5e-6, 1e-4, -1e-4],
    "tapered": [25e-6, 15e-6, 4e-6, 2e-4, 1e-4],
}
"""Displacements under which some elements carry and others do not, m and rad."""
LOADS = {"ball": (100.0, 2e3), "four_point": (1e3, 4e3), "cylindrical": (0.0, 3e3), "tapered": (4e3, 5e3)}
"""Axial and radial load, N."""
HELD = [
    pytest.param(HOUSING | SUPPORTS | {"inner": SHAFT}, id="all"),
    pytest.param(SUPPORTS, id="supports", marks=pytest.mark.slow),
]
SLOW = {"cylindrical", "four_point", "tapered"}
FAMILIES = [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in BEARINGS]


@pytest.mark.parametrize("ring", HELD)
@pytest.mark.parametrize("family", FAMILIES)
def test_force_and_stiffness_are_derivatives_of_the_energy(family, ring):
    """With all that holds a ring at once: housing, supports that are pressed and others that are not, and a shaft; and
    on supports alone."""
    row = row_of(bent(BEARINGS[family], **ring))
    hold = jax.jit(lambda q, state: row.hold(q, state))
    force_at = jax.jit(lambda q, state: (row.force_at(q, state), jax.jacfwd(row.force_at)(q, state)))
    at = np.asarray(DISPLACED[family])
    found = hold(at, row.initial(jnp.asarray(at)))
    force, stiffness = np.asarray(found.force), np.asarray(found.stiffness)
    unit = np.sqrt(np.maximum(np.diag(stiffness), 1e-300))
    size = np.max(np.abs(force / unit))
    # a ball of the bearing with four contacts is so near an arc that steps ten times as long see it touch
    for place, step in enumerate([1e-9, 1e-9, 1e-9, 1e-7, 1e-7]):
        moved = step * np.eye(5)[place]
        high, low = hold(at + moved, found.state), hold(at - moved, found.state)
        slope = (high.energy - low.energy) / (2.0 * step)
        np.testing.assert_allclose(slope, force[place], atol=1e-6 * size * unit[place])
        slopes = (np.asarray(high.force) - np.asarray(low.force)) / (2.0 * step)
        np.testing.assert_allclose(slopes / unit, stiffness[place] / unit, atol=1e-6 * unit[place])
    again, derived = map(np.asarray, force_at(at, found.state))
    np.testing.assert_allclose(again / unit, force / unit, atol=1e-9 * size)
    np.testing.assert_allclose(derived / unit / unit[:, None], stiffness / unit / unit[:, None], atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("inner", [None, SHAFT], ids=["outer ring", "both rings"])
@pytest.mark.parametrize("family", BEARINGS)
def test_a_rigid_shaft_on_one_bearing_is_that_bearing(family, inner):
    """As `test_each_bearing_of_a_shaft_is_that_bearing`, of all families."""
    scene, (axial, radial) = bent(BEARINGS[family], inner=inner), LOADS[family]
    solved, single = jb.solve(straight(scene, axial, radial)), jb.solve(alone(scene, axial, radial))
    one = solved.bearings["bearing"]
    np.testing.assert_allclose(one.force[:3], [axial, radial, 0.0], rtol=1e-9, atol=1e-9 * radial)
    largest = np.max(single.elements.load_outer)
    np.testing.assert_allclose(one.solution.elements.load_outer, single.elements.load_outer, atol=1e-8 * largest)
    bends = np.max(np.abs(single.outer_ring.deflection))
    np.testing.assert_allclose(one.solution.outer_ring.deflection, single.outer_ring.deflection, atol=1e-8 * bends)
    np.testing.assert_allclose(
        [one.ring.radial, one.ring.lateral], [single.ring.radial, single.ring.lateral], rtol=1e-7
    )
    assert unbalance(scene, one.solution) < 1e-9
    if inner is not None:
        assert unbalance(scene, one.solution, "inner") < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("family", ["ball", "cylindrical"])
def test_a_stiff_housing_is_a_rigid_ring(family):
    scene, load = bent(BEARINGS[family]), LOADS[family]
    stiff = dataclasses.replace(scene, outer_ring=FlexibleRing(**(HOUSING | {"housing_stiffness": 1e16})))
    rigid = dataclasses.replace(scene, outer_ring=None)
    first, second = (jb.solve(straight(one, *load)).bearings["bearing"] for one in (stiff, rigid))
    largest = np.max(second.solution.elements.load_outer)
    elements = [one.solution.elements.load_outer for one in (first, second)]
    np.testing.assert_allclose(*elements, atol=1e-5 * largest)
    np.testing.assert_allclose(first.ring.radial, second.ring.radial, rtol=1e-5)


def two_grooves(housing=5e9, height=3e-6, inner=SHAFT, at=80e-3, axial=100.0, azimuth=0.4, closure=0.0):
    """Two deep groove ball bearings on a rigid shaft under a load; both rings of each bend."""
    scene = bent(DEEP_GROOVE, height, inner, **(HOUSING | {"housing_stiffness": housing}))
    return ShaftSystem(
        Shaft(SPEED),
        bearings=[
            MountedBearing("A", scene, 20e-3, closure=closure),
            MountedBearing("B", scene, 180e-3, "-x", closure=closure),
        ],
        forces=[PointLoad("load", at, axial=axial, radial=2e3, azimuth=azimuth)],
    )


def test_two_bearings_balance_the_load():
    found = jb.solve(two_grooves())
    about = lambda at, load: np.asarray(shift_matrix(jnp.asarray(at))).T @ np.asarray(load)
    total = sum(about(one.position, one.on_shaft) for one in found.bearings.values())
    total = total + sum(about(*both) for both in zip(found.shaft.position, found.shaft.load, strict=True))
    np.testing.assert_allclose(total / [2e3, 2e3, 2e3, 160.0, 160.0], 0.0, atol=1e-9)
    for name, place in {"A": 0, "B": 1}.items():
        for side in ("outer", "inner"):
            assert unbalance(two_grooves().bearings[place].scene, found.bearings[name].solution, side) < 1e-9


def test_each_bearing_of_a_shaft_is_that_bearing():
    """Two that are closed against each other, with the load in their middle, do not tilt."""
    system = two_grooves(at=100e-3, axial=0.0, azimuth=0.0, closure=70e-6)
    solved = jb.solve(system)
    axial = float(solved.bearings["A"].force[0])
    assert axial > 100.0
    single = jb.solve(alone(system.bearings[0].scene, axial, 1e3))
    largest = np.max(single.elements.load_outer)
    for one in solved.bearings.values():
        np.testing.assert_allclose(one.force[:3], [axial, 1e3, 0.0], rtol=1e-9, atol=1e-6)
        loads = (one.solution.elements.load_outer, single.elements.load_outer)
        np.testing.assert_allclose(*loads, atol=1e-8 * largest)
        for ring in ("outer_ring", "inner_ring"):
            bends = [getattr(each, ring).deflection for each in (one.solution, single)]
            np.testing.assert_allclose(*bends, atol=1e-8 * np.max(np.abs(bends)))
        moved = [[each.ring.radial, each.ring.lateral] for each in (one, single)]
        np.testing.assert_allclose(*moved, rtol=1e-7)


@pytest.mark.slow
def test_derivatives_by_the_housing_and_by_a_lobe():
    """In both modes, against differences."""

    def results(x):
        found = jb.solve(two_grooves(x[0], x[1], inner=None), throw=False)
        bends = 1e9 * found.bearings["B"].solution.outer_ring.cosines[1:3]
        return jnp.concatenate([found.bearings["A"].on_shaft[3:4], 1e8 * found.shaft.displacement[-1, :3], bends])

    x = jnp.asarray([5e9, 3e-6])
    both = jax.jit(lambda x: (results(x), jax.jacfwd(results)(x)))
    forward, backward = (np.asarray(one) for one in (both(x)[1], jax.jit(jax.jacrev(results))(x)))
    size = np.max(np.abs(forward), axis=0)
    np.testing.assert_allclose(backward / size, forward / size, atol=1e-9)
    for place, one in enumerate(np.diag(1e-4 * np.asarray(x))):
        difference = np.asarray(both(x + one)[0] - both(x - one)[0]) / (2.0 * one[place])
        np.testing.assert_allclose(forward[:, place] / size[place], difference / size[place], atol=1e-6)


@pytest.mark.slow
def test_a_preloaded_pair_meets_its_preload():
    # races are round here: lobes move the mounted set across its axis, and it carries 2 % more
    scene = dataclasses.replace(P, outer_ring=FlexibleRing(**HOUSING))
    loose, loaded = (
        jb.solve(pair(preload=Preload(force=180.0), scene=scene, **load)) for load in ({}, {"axial": 100.0})
    )
    np.testing.assert_allclose(loose.sets["set"].preload, 180.0, rtol=1e-11)
    # balls of the loaded set have up to 1e-3 N outwards (`core.FORCE_FLOOR`), which those of the mounted one lack
    np.testing.assert_allclose(axial_forces(loose), 180.0, rtol=2e-6)
    np.testing.assert_allclose(np.diff(axial_forces(loaded)), -100.0, rtol=1e-9)
    # rings that yield take a larger closure
    rigid = jb.solve(pair(preload=Preload(force=180.0)))
    assert float(loose.sets["set"].closure) > float(rigid.sets["set"].closure)


@pytest.mark.slow
@pytest.mark.parametrize("preload", [{"class_force": 180.0}, {"spring_force": 180.0, "spring_stiffness": 2e6}])
def test_other_ways_of_preload(preload):
    solved = jb.solve(pair(preload=Preload(**preload), scene=bent(P), radial=150.0))
    first, second = axial_forces(solved)
    np.testing.assert_allclose(first, second, rtol=1e-8)
    if "spring_force" in preload:
        np.testing.assert_allclose(solved.sets["set"].spring_force, second, rtol=1e-8)


@pytest.mark.slow
def test_supports_that_all_stand_away_from_the_load():
    """The ring leaves them, and the shaft goes with it: a result without numbers, and a reason."""
    away = SUPPORTS | {"support_angle": [2.8, 3.1, 3.4]}

    def solved(radial):
        return jb.solve(straight(bent(DEEP_GROOVE, **away), 100.0, radial), throw=False)

    found = jax.jit(jax.vmap(solved))(jnp.asarray([-2e3, 2e3]))
    assert found.status.tolist() == [jb.Status.CONVERGED, jb.Status.NO_EQUILIBRIUM]
    assert np.all(np.isnan(found.bearings["bearing"].force[1]))
    np.testing.assert_allclose(found.bearings["bearing"].force[0, 1], -2e3, rtol=1e-9)


@pytest.mark.slow
def test_seats_of_a_bearing_whose_ring_bends():
    """A press fit takes the same clearance on a shaft as alone."""
    scene = bent(jb.load_scene("deep_groove_6205", {"contact": "none", "operation.moment": "none"}))
    fits = {"geometry.bore": 25e-3, "geometry.outside_diameter": 52e-3, "geometry.width": 15e-3}
    scene = scene.replace(fits).replace({"fits": jb.mounting.Fits(shaft_interference=15e-6)})
    one, single = jb.solve(straight(scene, 100.0)).bearings["bearing"].solution, jb.solve(alone(scene, 100.0))
    np.testing.assert_allclose(one.elements.load_outer, single.elements.load_outer, atol=1e-5)
    np.testing.assert_allclose(one.fit.clearance, single.fit.clearance, rtol=1e-12)


@pytest.mark.parametrize("place", ["set.front", "bearing.rear"])
def test_a_ring_on_a_shaft_is_held(place):
    part = {"thickness": "4 mm", "width": "15 mm"}
    with pytest.raises(jb.SceneError, match=rf"{place}\.outer_ring: .*nothing holds the ring"):
        jb.load_scene("gear_shaft", {f"{place}.outer_ring.{name}": value for name, value in part.items()})


def test_loads_from_outside_need_a_rigid_support():
    teeth = {"load_angle": [0.0], "load_radial": [10.0], "load_tangential": [0.0], "load_radius": [0.03]}
    scene = bent(DEEP_GROOVE, **HOUSING, **teeth)
    place = MountedBearing("A", scene, 0.0)
    ShaftSystem(Shaft(0.0), bearings=[place])
    with pytest.raises(
        ValueError, match=r"bearing\.A\.outer_ring\.load_angle: expected none beside an elastic support"
    ):
        ShaftSystem(Shaft(0.0), bearings=[dataclasses.replace(place, support=Support(radial=1e8))])


def test_sliding_rollers_in_one_batch():
    """Two such bearings are one stack of scenes with their rings and widths."""
    scene = dataclasses.replace(reference_roller(), inner_ring=FlexibleInnerRing(**SHAFT), outer_ring=None)
    system = ShaftSystem(
        Shaft(SPEED), bearings=[MountedBearing(name, scene, place) for name, place in (("A", 0.0), ("B", 0.2))]
    )
    (batch,) = jax.eval_shape(lambda speed: batches_of(system.places, speed), jnp.asarray(SPEED))
    assert batch.places == (0, 1)
    assert batch.scene.cage is not None
    assert batch.scene.inner_ring.thickness.shape == (2,)
