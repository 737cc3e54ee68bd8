"""Balls in a flexible outer ring, and between races that are not round: the check value of the sheet, balances,
limits, derivatives, refusals."""

import dataclasses
import functools

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import check_derivatives, lobes, unbalance, unbalance_of

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.scene import BallBearing
from jaxbearing.bearings.checks import input_excess
from jaxbearing.bearings.elastic_ring import elastic_ring
from jaxbearing.bearings.mounted import running_scene
from jaxbearing.bearings.ring import LENGTH_UNIT
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
# with as many orders as balls, each ball presses a wave of its own
HOUSING = {"thickness": 3e-3, "width": 15e-3, "harmonics": 8, "housing_stiffness": 5e9}
"""A ring on a soft housing."""
STIFF = 1e16
"""Stiffness of a housing in which the ring is rigid, N/m^2."""


@functools.cache
def flat(**changes: str) -> BallBearing:
    """The 6205 under a radial and an axial load: its inner ring does not tilt."""
    loads = {"radial_load": "3 kN", "axial_load": "500 N", "moment": "none"} | changes
    return jb.load_scene("deep_groove_6205", {f"operation.{name}": value for name, value in loads.items()})


@functools.cache
def tilting(**changes: float) -> BallBearing:
    """The 6205, whose inner ring moves as it likes: loads of any values are solved by one program."""
    loads = {"axial_load": 500.0, "radial_load": 3e3, "radial_load_lateral": 0.0, "moment": 5.0, "moment_lateral": 0.0}
    return jb.load_scene("deep_groove_6205").at_operation(**(loads | changes))


def on_housing(scene: BallBearing, **changes) -> BallBearing:
    return dataclasses.replace(scene, outer_ring=FlexibleRing(**(HOUSING | changes)))


def with_lobes(scene: BallBearing, outer=(2, 0.0), inner=(2, 0.0)) -> BallBearing:
    """Lobes on both races, by default without height. **Arguments:** order, height, m, and angle, rad, of each."""
    parts = {"outer_roundness": lobes(OuterRoundness, *outer), "inner_roundness": lobes(InnerRoundness, *inner)}
    return dataclasses.replace(scene, **parts)


def bent(housing: float = 5e9, outer=(2, 0.0), inner=(2, 0.0), **loads: float) -> BallBearing:
    """The tilting 6205 in a housing, with lobes: one program serves all numbers."""
    return with_lobes(on_housing(tilting(**loads), housing_stiffness=housing), outer, inner)


build = jax.jit(build_core, static_argnums=1)


@jax.jit
def solved(core):
    """How the solve of the equations alone ended, the balls, the inner ring, and the deflected ring."""
    system, found = newton_solve(core.started()[0])
    rings = system.bent.results(system.amplitudes(found.point.globals))
    return found.status, system.at(found.point), system.ring.displacement(found.point.globals), rings["outer_ring"]


def sheet_core(housing: float = 3e9, radial_load: float = 10e3, outer=(2, 0.0)):
    """The bearing of the sheet in its ring."""
    scene = with_lobes(jb.scene_from_mapping(SHEET).at_operation(radial_load=radial_load), outer)
    core = build(scene, True)
    ring = FlexibleRing(thickness=6e-3, width=25e-3, harmonics=6, housing_stiffness=housing)
    # the radius of its centroid is 46 mm there, that of the raceway 43 mm
    ring = elastic_ring(ring, scene.materials.rings, 86e-3, None, core.azimuth)
    return dataclasses.replace(core, outer=jax.tree.map(jnp.asarray, ring))


def test_the_ring_of_the_sheet():
    expected = {
        STIFF: (5.54658210e-5, [3896.3599, 2980.0365, 946.5224]),
        3e9: (8.71226628e-5, [3408.5990, 2916.3236, 1549.2822, 0.0]),
    }
    for housing, (shift, loads) in expected.items():
        status, balls, moved, ring = solved(sheet_core(housing))
        assert int(status) == Status.CONVERGED
        np.testing.assert_allclose(moved.radial, shift, rtol=1e-6)
        np.testing.assert_allclose(balls.load[0, : len(loads)], loads, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(ring.cosines[:3], [2.41567e-6, 2.30869e-5, 1.03692e-5], rtol=3e-6)


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
        pytest.param(bent, id="dry, tilting"),
        pytest.param(lambda: bent(radial_load_lateral=1e3), id="dry, load beside the line"),
        pytest.param(with_films, id="films", marks=pytest.mark.slow),
        pytest.param(with_cage, id="sliding, cage", marks=pytest.mark.slow),
    ],
)
def test_the_ring_is_in_balance(make):
    scene = make()
    solution = jb.solve(scene)
    assert unbalance(scene, solution) < 1e-9
    rigid = jb.solve(scene.replace({"outer_ring.housing_stiffness": STIFF}))
    # the ring yields under the most loaded ball
    assert float(np.max(solution.elements.load_outer)) < float(np.max(rigid.elements.load_outer))
    if solution.drive_power is not None:
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)


def test_the_ring_is_in_balance_under_four_contacts():
    """Both outer contacts of each ball press it."""
    scene = jb.load_scene("four_point_qj", {"operation.radial_load": "8 kN", "operation.axial_load": "3 kN"})
    most = {}
    for housing in (5e9, STIFF):
        one = on_housing(scene, thickness=6e-3, width=25e-3, housing_stiffness=housing)
        core = build(one, None)
        status, balls, _, ring = solved(core)
        assert int(status) == Status.CONVERGED
        force = np.sum(balls.load[2:] * np.cos(balls.angle[2:]), axis=0)
        assert unbalance_of(one, ring, np.asarray(core.azimuth), force) < 1e-9
        most[housing] = np.max(balls.load[2:])
    assert np.all(np.max(balls.load[2:], axis=1) > 1.0)
    assert most[5e9] < most[STIFF]


def test_stiff_housing_is_the_rigid_ring():
    rigid, stiff = jb.solve(tilting()), jb.solve(bent(STIFF))
    np.testing.assert_allclose(stiff.elements.load_inner, rigid.elements.load_inner, rtol=1e-5, atol=1e-3)
    np.testing.assert_allclose(stiff.ring.tilt, rigid.ring.tilt, rtol=1e-5)
    np.testing.assert_allclose(stiff.stiffness, rigid.stiffness, rtol=1e-4, atol=1e-6 * np.max(np.abs(rigid.stiffness)))


def test_no_harmonics_are_the_same_equations():
    rigid, none = (build(scene, None) for scene in (flat(), on_housing(flat(), harmonics=0)))
    assert eqx.tree_equal(rigid, none)
    assert none.outer is None


def test_axial_load_only():
    """All balls are alike and the ring widens evenly: the solve still has every ball."""
    solution = jb.solve(bent(radial_load=0.0, axial_load=2e3, moment=0.0))
    load = np.asarray(solution.elements.load_inner)
    np.testing.assert_allclose(load, load[0], rtol=1e-9)
    np.testing.assert_allclose(solution.outer_ring.deflection, solution.outer_ring.cosines[0], atol=1e-15)
    assert float(solution.outer_ring.cosines[0]) > 0.0
    alike = on_housing(flat(radial_load="none"))
    assert [eqx.filter_eval_shape(build_core, one).azimuth.size for one in (alike, flat(radial_load="none"))] == [9, 1]


def test_a_lobe_of_order_1_moves_the_ring():
    """It is a displacement of the raceway: the contacts of a ring that follows it stay as they are."""
    height, shift = 7e-6, 20e-6
    centre = build(flat(), False).free_centre() + np.asarray([[3e-6], [-5e-6]]) * np.ones((2, 9))

    @jax.jit
    def touch(scene, radial):
        core = build_core(scene, False)
        shared = jnp.zeros((2, 9)).at[core.freedoms.index("radial")].set(radial / LENGTH_UNIT)
        found = core.touch(shared, centre)
        return found.apart, found.normals, found.angle

    plain = touch(with_lobes(flat()), shift)
    # the outer race moves outwards; the centres of the balls count from it, and stay where they are
    inner = touch(with_lobes(flat(), inner=(1, height)), shift - height)
    outer = touch(with_lobes(flat(), outer=(1, height)), shift + height)
    for moved in (inner, outer):
        for here, there in zip(*map(jax.tree.leaves, (moved, plain)), strict=True):
            np.testing.assert_allclose(here, there, rtol=1e-12)


def test_an_oval_race_pinches_more_balls():
    def loads(**changes):
        status, balls, *_ = solved(sheet_core(radial_load=100.0, **changes))
        assert int(status) == Status.CONVERGED
        return np.asarray(balls.load[0])

    oval = (2, 20e-6)
    light, pinched, yielding = loads(housing=STIFF), loads(housing=STIFF, outer=oval), loads(housing=5e9, outer=oval)
    assert np.sum(pinched > 1e-3) > np.sum(light > 1e-3)
    # a flexible ring yields to the lobes
    assert np.max(yielding) < np.max(pinched)


def test_tilting_ring_between_races_that_are_not_round():
    """Lobes of order 0 on both races cancel each other, with the exact rotation of the ring too."""
    plain, grown = jb.solve(bent()), jb.solve(bent(outer=(0, 3e-6), inner=(0, 3e-6)))
    np.testing.assert_allclose(grown.elements.load_inner, plain.elements.load_inner, rtol=1e-8, atol=1e-6)


@pytest.mark.slow
def test_derivatives():
    """By a number of the ring and one of its roundness; among the fast tests those of rollers are in
    tests/bearings/test_inner_rings.py::test_derivatives."""

    def most(housing, height):
        oval = OuterRoundness(lobe_order=[2.0], lobe_height=jnp.stack([height]), lobe_angle=[0.3])
        scene = on_housing(flat(), housing_stiffness=housing, harmonics=4)
        return jb.solve(dataclasses.replace(scene, outer_roundness=oval)).elements.load_inner[0]

    check_derivatives(most, (5e9, 3e-6))


def test_reaction_is_the_load():
    # a lobe beside the load line pushes the ring sideways
    scene = bent(outer=(2, 3e-6, 0.3))
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
    core = build(scene, None)
    status, balls, _, ring = solved(core)
    assert int(status) == Status.CONVERGED
    np.testing.assert_allclose(np.sum(balls.load[0] * np.cos(core.azimuth)), 2 * force, rtol=1e-8)
    # the teeth press it inwards at their places
    across = np.interp(0.5 * np.pi, ring.azimuth, ring.deflection)
    assert across < 0.0
    with pytest.raises(ValueError, match="must balance"):
        dataclasses.replace(scene, outer_ring=dataclasses.replace(scene.outer_ring, load_tangential=[force, 0.0]))


def test_refusals():
    with pytest.raises(ValueError, match=r"outer_ring\.width: a flexible ring needs a width"):
        dataclasses.replace(
            jb.scene_from_mapping(SHEET), outer_ring=FlexibleRing(thickness=3e-3, housing_stiffness=1e10)
        )
    # a rigid ring needs none
    dataclasses.replace(jb.scene_from_mapping(SHEET), outer_ring=FlexibleRing(thickness=3e-3, harmonics=0))
    with pytest.raises(ValueError, match="nothing holds the ring"):
        on_housing(flat(), housing_stiffness=None)
    moving = jb.load_scene("turbine_ball_dynamic")
    with pytest.raises(ValueError, match="inner_roundness: a transient run has rigid, round rings"):
        dataclasses.replace(moving, inner_roundness=lobes(InnerRoundness, 2, 1e-6))


def test_width_and_wall_of_a_bearing_on_its_seats():
    """A ring without a width takes that of the bearing, also between seats; one higher than its wall has a warning."""
    mounted = jb.load_scene("deep_groove_6205_fitted")

    @jax.jit
    def mounted_ring(scene):
        running, *_ = running_scene(scene)
        higher = [value for text, value in input_excess(running).items() if "more than the wall" in text]
        return build_core(running).outer.ring.section, higher

    thin, [less] = mounted_ring(on_housing(mounted, thickness=2.5e-3, width=None))
    given, _ = mounted_ring(on_housing(mounted, thickness=2.5e-3))
    assert eqx.tree_equal(thin, given)
    _, [more] = mounted_ring(on_housing(mounted))
    assert less < 0.0 < more


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
