"""Balls in a flexible outer ring, and between races that are not round: the check value of the sheet, balances,
limits, derivatives, refusals."""

import dataclasses
import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import check_derivatives, check_no_harmonics, lobes, unbalance

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.scene import BallBearing
from jaxbearing.bearings.elastic_ring import elastic_ring
from jaxbearing.bearings.ring_shape import FlexibleRing, InnerRoundness, OuterRoundness
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.numerics.status import Status

STEEL = {"youngs_modulus": 207e9, "poisson_ratio": 0.3, "density": 7850.0}
SHEET = {
    "kind": "ball_bearing",
    "geometry": {
        "n_balls": 12,
        "ball_diameter": 17.4625e-3,
        "pitch_diameter": 72.5e-3,
        "conformity_inner": 0.525,
        "conformity_outer": 0.525,
        "diametral_clearance": 20e-6,
    },
    "materials": {"rings": STEEL, "balls": STEEL},
    "operation": {"inner_speed": 0.0, "radial_load": 10e3, "displacement": {"axial": 0.0}},
}
"""The bearing of four_point_and_flexible_rings.md, section B7, with one arc on each ring, and its balls in the middle
plane."""
HOUSING = {"thickness": 3e-3, "width": 15e-3, "housing_stiffness": 5e9}
"""A ring on a soft housing."""


def sheet_bearing() -> BallBearing:
    return jb.scene_from_mapping(SHEET)


@functools.cache
def deep_groove(**changes: str) -> BallBearing:
    """The 6205 under a radial load, an axial one and a moment: its inner ring tilts."""
    loads = {"radial_load": "3 kN", "axial_load": "500 N", "moment": "5 N*m"} | changes
    return jb.load_scene("deep_groove_6205", {f"operation.{name}": value for name, value in loads.items()})


def flat(**changes: str) -> BallBearing:
    """The 6205 whose inner ring does not tilt."""
    return deep_groove(moment="none", **changes)


def on_housing(scene: BallBearing, **changes) -> BallBearing:
    return dataclasses.replace(scene, outer_ring=FlexibleRing(**(HOUSING | changes)))


def test_the_ring_of_the_sheet():
    scene = sheet_bearing()
    rigid = build_core(scene, exact=True)
    ring = FlexibleRing(thickness=6e-3, width=25e-3, harmonics=6, housing_stiffness=3e9)
    # the radius of its centroid is 46 mm there, that of the raceway 43 mm
    outer = elastic_ring(ring, scene.materials.rings, 86e-3, None, rigid.azimuth)
    expected = {
        "rigid": (5.54658210e-5, [3896.3599, 2980.0365, 946.5224]),
        "flexible": (8.71226628e-5, [3408.5990, 2916.3236, 1549.2822, 0.0]),
    }

    @jax.jit
    def solved(core):
        system, result = newton_solve(core.started()[0])
        return result.status, 1e-5 * result.point.globals, system.at(result.point).load[0]

    for core, (shift, loads) in zip((rigid, dataclasses.replace(rigid, outer=outer)), expected.values(), strict=True):
        status, moved, found = solved(core)
        assert int(status) == Status.CONVERGED
        np.testing.assert_allclose(moved[0], shift, rtol=1e-6)
        np.testing.assert_allclose(found[: len(loads)], loads, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(moved[1:4], [2.41567e-6, 2.30869e-5, 1.03692e-5], rtol=3e-6)


def four_point():
    changes = {"operation.radial_load": "8 kN", "operation.axial_load": "3 kN"}
    return on_housing(jb.load_scene("four_point_qj", changes), thickness=6e-3, width=25e-3)


def with_cage():
    scene = jb.load_scene("turbine_ball", {"operation.radial_load": "5 kN", "contact.traction_accuracy": "1e-2"})
    return on_housing(scene, thickness=8e-3, width=30e-3)


def with_films():
    oil = {"oil.name": "mobil_jet_ii", "operation.oil_temperature": "60 degC", "contact.film": "hamrock_dowson"}
    scene = jb.load_scene("deep_groove_6205", oil | {"operation.radial_load": "3 kN", "operation.moment": "5 N*m"})
    return on_housing(scene, housing_stiffness=2e9)


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda: on_housing(deep_groove()), id="dry, tilting"),
        pytest.param(lambda: on_housing(deep_groove(radial_load_lateral="1 kN")), id="dry, load beside the line"),
        pytest.param(four_point, id="four contacts"),
        pytest.param(with_films, id="films", marks=pytest.mark.slow),
        pytest.param(with_cage, id="sliding, cage", marks=pytest.mark.slow),
    ],
)
def test_the_ring_is_in_balance(make):
    scene = make()
    solution = jb.solve(scene)
    assert unbalance(scene, solution) < 1e-9
    rigid = jb.solve(dataclasses.replace(scene, outer_ring=None))
    # the ring yields under the most loaded ball
    assert float(np.max(solution.elements.load_outer)) < float(np.max(rigid.elements.load_outer))
    if solution.drive_power is not None:
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)


def test_stiff_housing_is_the_rigid_ring():
    rigid, stiff = jb.solve(deep_groove()), jb.solve(on_housing(deep_groove(), housing_stiffness=1e16))
    np.testing.assert_allclose(stiff.elements.load_inner, rigid.elements.load_inner, rtol=1e-5, atol=1e-3)
    np.testing.assert_allclose(stiff.ring.tilt, rigid.ring.tilt, rtol=1e-5)
    np.testing.assert_allclose(stiff.stiffness, rigid.stiffness, rtol=1e-4, atol=1e-6 * np.max(np.abs(rigid.stiffness)))


def test_no_harmonics_is_the_same_program():
    check_no_harmonics(jb.solve(flat()), jb.solve(on_housing(flat(), harmonics=0)), "outer_ring")


def test_axial_load_only():
    """All balls are alike and the ring widens evenly: the solve still has every ball."""
    # with as many orders as balls, each ball presses a wave of its own
    solution = jb.solve(on_housing(flat(radial_load="none", axial_load="2 kN"), harmonics=8))
    load = np.asarray(solution.elements.load_inner)
    np.testing.assert_allclose(load, load[0], rtol=1e-9)
    np.testing.assert_allclose(solution.outer_ring.deflection, solution.outer_ring.cosines[0], atol=1e-15)
    assert float(solution.outer_ring.cosines[0]) > 0.0


def test_a_lobe_of_order_1_moves_the_ring():
    """It is a displacement of the raceway, which the inner ring follows."""
    height = 7e-6
    plain = jb.solve(flat())
    for part, kind, sign in (("outer_roundness", OuterRoundness, 1.0), ("inner_roundness", InnerRoundness, -1.0)):
        moved = jb.solve(dataclasses.replace(flat(), **{part: lobes(kind, 1, height)}))
        np.testing.assert_allclose(moved.elements.load_inner, plain.elements.load_inner, rtol=1e-8, atol=1e-6)
        np.testing.assert_allclose(moved.ring.radial - plain.ring.radial, sign * height, rtol=1e-8)


def test_an_oval_race_pinches_more_balls():
    light = flat(radial_load="100 N", axial_load="none")
    count = lambda scene: int(np.sum(np.asarray(jb.solve(scene).elements.load_inner) > 1e-3))
    oval = dataclasses.replace(light, outer_roundness=lobes(OuterRoundness, 2, 20e-6))
    assert count(oval) > count(light)
    bent = on_housing(oval)
    loads = [np.max(np.asarray(jb.solve(scene).elements.load_inner)) for scene in (oval, bent)]
    # a flexible ring yields to the lobes
    assert loads[1] < loads[0]


def test_tilting_ring_between_races_that_are_not_round():
    """Lobes of order 0 on both races cancel each other, with the exact rotation of the ring too."""
    both = {"inner_roundness": lobes(InnerRoundness, 0, 3e-6), "outer_roundness": lobes(OuterRoundness, 0, 3e-6)}
    plain, grown = jb.solve(deep_groove()), jb.solve(dataclasses.replace(deep_groove(), **both))
    np.testing.assert_allclose(grown.elements.load_inner, plain.elements.load_inner, rtol=1e-8, atol=1e-6)


def test_derivatives():
    def most(housing, height):
        oval = OuterRoundness(lobe_order=[2.0], lobe_height=jnp.stack([height]), lobe_angle=[0.3])
        scene = on_housing(flat(), housing_stiffness=housing, harmonics=4)
        return jb.solve(dataclasses.replace(scene, outer_roundness=oval)).elements.load_inner[0]

    check_derivatives(most, (5e9, 3e-6))


def test_reaction_is_the_load():
    # a lobe beside the load line pushes the ring sideways
    free = deep_groove(radial_load_lateral="0 N", moment_lateral="0 N*m")
    scene = dataclasses.replace(on_housing(free), outer_roundness=lobes(OuterRoundness, 2, 3e-6, 0.3))
    solution = jb.solve(scene)
    held = jb.reaction(scene, [float(getattr(solution.ring, name)) for name in RING_FREEDOMS], at="ring")
    np.testing.assert_allclose(held.force, [500.0, 3e3, 0.0, 5.0, 0.0], rtol=1e-8, atol=1e-4)
    np.testing.assert_allclose(
        held.stiffness, solution.stiffness, rtol=1e-6, atol=1e-9 * np.max(np.abs(held.stiffness))
    )
    np.testing.assert_allclose(held.outer_ring.deflection, solution.outer_ring.deflection, atol=1e-13)


def test_a_gear_on_balls():
    """Nothing but its teeth holds a rim: forces from outside balance the load, and the ring bends under them."""
    force = 1.5e3
    teeth = {
        "load_angle": [0.5 * np.pi, -0.5 * np.pi],
        "load_radial": [-500.0, -500.0],
        "load_tangential": [force, -force],
        "load_radius": [30e-3, 30e-3],
    }
    scene = dataclasses.replace(
        flat(axial_load="none"), outer_ring=FlexibleRing(thickness=4e-3, width=15e-3, harmonics=8, **teeth)
    )
    solution = jb.solve(scene)
    elements = solution.elements
    np.testing.assert_allclose(np.sum(elements.load_inner * np.cos(elements.azimuth)), 2 * force, rtol=1e-8)
    # the teeth press it inwards at their places
    across = np.interp(0.5 * np.pi, solution.outer_ring.azimuth, solution.outer_ring.deflection)
    assert across < 0.0
    with pytest.raises(ValueError, match="must balance"):
        dataclasses.replace(scene, outer_ring=dataclasses.replace(scene.outer_ring, load_tangential=[force, 0.0]))


def test_refusals():
    with pytest.raises(ValueError, match=r"outer_ring\.width: a flexible ring needs a width"):
        dataclasses.replace(sheet_bearing(), outer_ring=FlexibleRing(thickness=3e-3, housing_stiffness=1e10))
    # a rigid ring needs none
    dataclasses.replace(sheet_bearing(), outer_ring=FlexibleRing(thickness=3e-3, harmonics=0))
    with pytest.raises(ValueError, match="nothing holds the ring"):
        on_housing(flat(), housing_stiffness=None)
    moving = jb.load_scene("turbine_ball_dynamic")
    with pytest.raises(ValueError, match="inner_roundness: a transient run has rigid, round rings"):
        dataclasses.replace(moving, inner_roundness=lobes(InnerRoundness, 2, 1e-6))


def test_width_and_wall_of_a_bearing_on_its_seats():
    """A ring without a width takes that of the bearing, also between seats; one higher than its wall has a warning."""
    said = lambda solution: [text for text in solution.warnings if "more than the wall" in text]
    mounted = jb.load_scene("deep_groove_6205_fitted")
    thin = jb.solve(on_housing(mounted, thickness=2.5e-3, width=None, harmonics=2))
    given = jb.solve(on_housing(mounted, thickness=2.5e-3, width=15e-3, harmonics=2))
    np.testing.assert_array_equal(thin.elements.load_inner, given.elements.load_inner)
    assert not said(thin)
    assert said(jb.solve(on_housing(mounted, harmonics=2)))


def test_scene_files(tmp_path):
    scene = dataclasses.replace(on_housing(flat()), inner_roundness=lobes(InnerRoundness, 2, 1e-6, 0.2))
    path = tmp_path / "ring.toml"
    jb.save_scene(scene, path)
    read = jb.load_scene(path)
    for name in ("outer_ring", "inner_roundness"):
        for here, there in zip(*map(jax.tree.leaves, (getattr(scene, name), getattr(read, name))), strict=True):
            np.testing.assert_allclose(here, there, rtol=1e-15)


def on_supports(*degrees: float) -> BallBearing:
    count = len(degrees)
    supports = {"support_angle": np.radians(degrees), "support_stiffness": [2e8] * count, "support_gap": [0.0] * count}
    ring = FlexibleRing(thickness=4e-3, width=15e-3, harmonics=4, **supports)
    return dataclasses.replace(flat(), outer_ring=ring)


def test_supports_bear_the_load():
    solution = jb.solve(on_supports(-30.0, 30.0))
    forces, elements = np.asarray(solution.outer_ring.support_forces), solution.elements
    outward = np.asarray(elements.load_outer) * np.cos(np.asarray(elements.contact_angle_outer))
    # the load, and the centrifugal forces of balls that orbit at different speeds
    along = np.sum(outward * np.cos(np.asarray(elements.azimuth)))
    np.testing.assert_allclose(along, 3e3, rtol=1e-3)
    np.testing.assert_allclose(forces, along / (2.0 * np.cos(np.radians(30.0))), rtol=1e-8)


def test_supports_that_the_load_leaves():
    """Supports push only: where none stands in the way of the load there is no equilibrium, and the reason is said."""
    solution = jb.solve(on_supports(150.0, 210.0), throw=False)
    assert int(solution.status) == Status.NO_EQUILIBRIUM
    assert "outer_ring.support_angle" in solution.failure()
    assert np.all(np.isnan(solution.elements.load_inner))


def test_a_free_rim_without_loads():
    """No force is out of balance."""
    nothing = {"load_angle": [0.0], "load_radial": [0.0], "load_tangential": [0.0], "load_radius": [30e-3]}
    ring = FlexibleRing(thickness=4e-3, width=15e-3, harmonics=4, **nothing)
    dataclasses.replace(flat(radial_load="0 N"), outer_ring=ring)
