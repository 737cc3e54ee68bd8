"""Every freedom of the inner ring under a load or at a displacement, in scenes of every family."""

import math

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.operation import HELD_FIELDS, LOAD_FIELDS, HeldDisplacement, Operation
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.bearings.tapered.scene import TaperedOperation
from jaxbearing.materials import Material

TURN = 0.3
"""Angle by which loads and rolling elements are turned, rad; the load line is no line of symmetry then."""
DRY = {"contact": "none", "cage": "none"}
BEARINGS = {
    "rollers, dry": ("reference_roller", DRY),
    "rollers that tilt": ("reference_roller", {**DRY, "operation.misalignment": "0 mrad"}),
    "balls": ("deep_groove_6205", {"operation.moment": "none"}),
    "tapered": ("tapered_example", {}),
}
SLOW = {
    "rollers that slide": ("reference_roller", {}),
    "balls that slide": ("turbine_ball", {"operation.radial_load": "3 kN"}),
}
QUICK = ("rollers, dry",)
"""Those whose programs are small."""


def slow_but(names, quick):
    return [name if name in quick else pytest.param(name, marks=pytest.mark.slow) for name in names]


NAMES = slow_but([*BEARINGS, *SLOW], QUICK)


def bearing(name):
    return jb.load_scene(*(BEARINGS | SLOW)[name])


def turned(scene):
    """The loads of a scene turned forward by `TURN`."""
    load = scene.operation.radial_load
    return scene.at_operation(radial_load=load * math.cos(TURN), radial_load_lateral=load * math.sin(TURN))


def assert_alike(found, expected, tolerance=1e-9):
    size = np.max(np.abs(expected.elements.load_inner))
    for side in ("inner", "outer"):
        loads = [getattr(one.elements, f"load_{side}") for one in (found, expected)]
        np.testing.assert_allclose(*loads, rtol=0, atol=tolerance * size)
    if expected.power_loss.total is not None:
        np.testing.assert_allclose(found.power_loss.total, expected.power_loss.total, rtol=tolerance)


def assert_held(scene, loaded, held):
    """The ring of a scene held, in some degrees of freedom, where loads brought it: the others stay, and the loads
    come back."""
    forces = [name for name in RING_FREEDOMS[:3] if name in scene.unknown_freedoms]
    places = {freedom: float(getattr(loaded.ring, freedom)) for freedom in held}
    found = jb.solve(scene.at_operation(displacement=places, **{LOAD_FIELDS[freedom]: None for freedom in held}))
    assert_alike(found, loaded)
    assert set(held) <= set(found.held_freedom)
    assert set(forces) <= set(found.ring_freedom)
    size = np.linalg.norm(loaded.force[:3])
    np.testing.assert_allclose(found.force[:3], loaded.force[:3], rtol=0, atol=1e-9 * size)
    for freedom in forces:
        np.testing.assert_allclose(getattr(found.ring, freedom), getattr(loaded.ring, freedom), rtol=1e-8, atol=1e-15)


@pytest.mark.parametrize("name", NAMES)
def test_turned_loads_and_held_rings(name):
    """Loads turned forward act as elements turned back, and displacements turn with the loads; the ring held there
    needs them."""
    scene = bearing(name)
    skewed = scene.replace({"geometry.first_element_angle": -TURN})
    assert "lateral" in skewed.unknown_freedoms
    assert "lateral" not in scene.unknown_freedoms
    # a lateral load of 0 beside it: the same program
    back = jb.solve(skewed.at_operation(radial_load=scene.operation.radial_load, radial_load_lateral=0.0))
    across = turned(scene.replace({"geometry.first_element_angle": 0.0}))
    found = jb.solve(across)
    assert_alike(found, back)
    np.testing.assert_allclose(back.elements.azimuth[0], -TURN)
    rotation = np.array([[math.cos(TURN), -math.sin(TURN)], [math.sin(TURN), math.cos(TURN)]])
    place = lambda one: np.array([one.ring.radial, one.ring.lateral])
    np.testing.assert_allclose(place(found), rotation @ place(back), rtol=1e-9, atol=1e-15)
    # the load line is no line of symmetry
    load = np.asarray(back.elements.load_inner)
    assert np.max(np.abs(load[1:] - load[:0:-1])) > 1e-3 * np.max(load)
    assert_held(across, found, [freedom for freedom in RING_FREEDOMS[:3] if freedom in across.unknown_freedoms])
    assert_held(across, found, ["radial"])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rollers, dry", "balls", "tapered"])
def test_other_freedoms_held(name):
    scene = bearing(name)
    straight = jb.solve(scene)
    nothing = jb.solve(scene.replace({"geometry.first_element_angle": 0.0}))
    assert_alike(nothing, straight)
    assert abs(float(nothing.ring.lateral)) < 1e-9 * abs(float(straight.ring.radial))
    across = turned(scene)
    loaded = jb.solve(across)
    for freedom in ("axial", "lateral"):
        if freedom in across.unknown_freedoms:
            assert_held(across, loaded, [freedom])


TILTS = {
    "balls": ("deep_groove_6205", {"operation.moment": "none"}, 5.0, -2.0),
    "rollers": ("reference_roller", DRY, 15.0, -8.0),
    "tapered": ("tapered_example", {"operation.load_position": "-80 mm"}, 320.0, -30.0),
}


@pytest.mark.parametrize("name", slow_but(TILTS, ("rollers",)))
def test_moments_about_both_axes(name):
    """Moments free both tilts; where one of these tilts is held, the ring needs its moment."""
    file, changes, moment, across = TILTS[name]
    scene = jb.load_scene(file, changes)
    loaded = jb.solve(scene.at_operation(moment=moment, moment_lateral=across))
    np.testing.assert_allclose(loaded.force[3:], [moment, across], rtol=1e-8)
    assert abs(float(loaded.force[2])) < 1e-8 * np.linalg.norm(loaded.force[:3])  # the lateral load is 0
    one = jb.solve(scene.at_operation(moment=moment, misalignment_lateral=loaded.ring.tilt_lateral))
    assert_alike(one, loaded, 1e-8)
    np.testing.assert_allclose(one.force[3:], [moment, across], rtol=1e-7)
    assert one.held_freedom[-1] == "tilt_lateral"
    # the other way round across the load line: the mirror image
    mirrored = jb.solve(scene.at_operation(moment=moment, moment_lateral=-across))
    np.testing.assert_allclose(mirrored.ring.tilt_lateral, -loaded.ring.tilt_lateral, rtol=1e-8)
    np.testing.assert_allclose(mirrored.ring.lateral, -loaded.ring.lateral, rtol=1e-6)
    np.testing.assert_allclose(mirrored.ring.tilt, loaded.ring.tilt, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", TILTS)
def test_both_tilts_held_need_their_moments(name):
    """One of them: `test_moments_about_both_axes`; both, by their displacements: `test_reaction`."""
    file, changes, moment, across = TILTS[name]
    scene = jb.load_scene(file, changes)
    loaded = jb.solve(scene.at_operation(moment=moment, moment_lateral=across))
    tilts = {"misalignment": loaded.ring.tilt, "misalignment_lateral": loaded.ring.tilt_lateral}
    held = jb.solve(scene.at_operation(**tilts))
    assert_alike(held, loaded, 1e-8)
    np.testing.assert_allclose(held.force[3:], [moment, across], rtol=1e-7)


def test_a_moment_about_the_load_axis():
    """7 balls of 11.5 mm at rest under 1 kN radially, 1 kN axially and 1 N m about the load axis."""
    steel = Material(youngs_modulus=210e9, poisson_ratio=0.3, density=7800.0)
    geometry = BallGeometry(7, 43.5e-3, 11.5e-3, 0.52, 0.53, diametral_clearance=10e-6)
    operation = BallOperation(0.0, axial_load=1e3, radial_load=1e3, moment_lateral=1.0)
    scene = BallBearing(geometry, BallMaterials(steel, steel), operation, BallAttitude("outer"))
    solution = jb.solve(scene)
    assert float(solution.residual_norm) < 1e-9
    assert solution.ring.tilt_lateral > 0.0
    np.testing.assert_allclose(solution.force[:3], [1e3, 1e3, 0.0], rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(solution.force[4], 1.0, rtol=1e-9)
    # what reaches the outer ring, from the printed loads and angles; forces along the orbit, 5e-4 here, do not: the
    # balls of a bearing at rest are held in their places
    elements = solution.elements
    load, angle, psi = elements.load_outer, elements.contact_angle_outer, elements.azimuth
    np.testing.assert_allclose(jnp.sum(load * jnp.sin(angle)), 1e3, rtol=1e-9)
    across = load * jnp.cos(angle)
    np.testing.assert_allclose(jnp.sum(across * jnp.cos(psi)), 1e3, rtol=1e-3)
    np.testing.assert_allclose(jnp.sum(across * jnp.sin(psi)), 0.0, atol=1e-2)


@pytest.mark.slow
def test_derivatives_by_displacements_and_lateral_loads():
    scene = jb.load_scene("deep_groove_6205", {"operation.moment": "none"}).at_operation(
        axial_load=None, radial_load=None, displacement={"axial": 60e-6, "radial": 4e-6, "lateral": 1e-6}
    )
    force = jax.jit(lambda q: _held_at(scene, q).force[:3])
    place = jnp.asarray([60e-6, 4e-6, 1e-6])
    np.testing.assert_allclose(jax.jacrev(force)(place), _held_at(scene, place).stiffness[:3, :3], rtol=1e-8, atol=1e-3)
    loaded = jb.load_scene("deep_groove_6205", {"operation.moment": "none"})
    place_of = jax.jit(
        lambda f: jnp.stack([(r := jb.solve(loaded.at_operation(radial_load_lateral=f)).ring).radial, r.lateral])
    )
    slope, step = jax.jacfwd(place_of)(300.0), 1e-3
    differences = (place_of(300.0 + step) - place_of(300.0 - step)) / (2.0 * step)
    np.testing.assert_allclose(slope, differences, rtol=1e-6)


def _held_at(scene, place):
    return jb.solve(scene.at_operation(displacement=dict(zip(RING_FREEDOMS, place, strict=False))), throw=False)


def test_a_batch_of_displacements_of_which_one_is_no_number():
    scene = jb.load_scene("reference_roller", DRY).at_operation(radial_load=None, displacement={"radial": 30e-6})
    places = jnp.asarray([20e-6, jnp.nan, 30e-6])

    @jax.jit
    @jax.vmap
    def solve(place):
        found = jb.solve(scene.at_operation(displacement={"radial": place}), throw=False)
        return found.converged, found.force

    (converged, force), (all_converged, good) = solve(places), solve(places.at[1].set(25e-6))
    assert converged.tolist() == [True, False, True]
    assert np.all(all_converged)
    np.testing.assert_array_equal(force[::2], good[::2])
    np.testing.assert_allclose(force[2], jb.solve(scene).force, rtol=1e-9, atol=1e-6)
    assert np.all(np.isnan(force[1]))


CONFLICTS = [(TaperedOperation, freedom, load, HELD_FIELDS[freedom]) for freedom, load in LOAD_FIELDS.items()]


@pytest.mark.parametrize(("kind", "freedom", "load", "held"), CONFLICTS)
def test_a_load_and_a_displacement_of_one_freedom(kind, freedom, load, held):
    given = {"axial_load": 1e3, load: 1e3}
    given |= {"displacement": {freedom: 1e-6}} if "." in held else {held: 1e-3}
    with pytest.raises(ValueError, match=rf"operation\.{held}: expected none beside operation\.{load}, which sets"):
        kind(100.0, **given)


def test_what_a_bearing_needs_and_does_not_have():
    with pytest.raises(ValueError, match=r"operation\.radial_load: found nothing, expected a force"):
        Operation(100.0, moment=1.0)
    rollers = jb.load_scene("reference_roller", DRY)
    for wrong in ({"axial_load": 1.0}, {"displacement": HeldDisplacement(axial=1e-6)}):
        with pytest.raises(ValueError, match=r"operation\.(axial_load|displacement\.axial): .*no axial freedom"):
            rollers.at_operation(**wrong)
    with pytest.raises(ValueError, match=r"operation\.axial_load: found nothing, expected a force"):
        TaperedOperation(100.0, radial_load=1e3)
    with pytest.raises(ValueError, match=r"operation\.axial_load: a ball bearing needs"):
        BallOperation(100.0)
    with pytest.raises(ValueError, match=r"operation\.displacement has axial, radial and lateral, got tilt"):
        BallOperation(100.0, displacement={"tilt": 1e-3})
    with pytest.raises(ValueError, match=r"operation\.displacement must be"):
        BallOperation(100.0, displacement=1e-6)
    run = jb.load_scene("turbine_roller_dynamic")
    with pytest.raises(ValueError, match=r"operation\.displacement: expected none in a transient run"):
        run.at_operation(radial_load=None, displacement={"radial": 1e-6})


@pytest.mark.slow
def test_a_run_in_time_under_a_lateral_load_starts_as_the_solve():
    scene = jb.load_scene("turbine_roller_dynamic")
    across = turned(scene).replace({"simulation": None})
    start = jb.quasi_static_start(across, scene.simulation)
    straight = jb.quasi_static_start(
        scene.replace({"simulation": None, "geometry.first_element_angle": -TURN}), scene.simulation
    )
    assert int(start.status) == int(straight.status) == 0
    size = np.max(np.abs(straight.state.elements), axis=1, keepdims=True)
    np.testing.assert_allclose(start.state.elements / size, straight.state.elements / size, atol=1e-7)


def test_a_ring_held_inside_its_play():
    """No ball is touched: the ring floats along its axis, and needs no force."""
    scene = jb.load_scene("deep_groove_6205", {"operation.moment": "none"})
    for place in (0.0, 1e-6):
        free = scene.at_operation(axial_load=None, radial_load=None, displacement={"radial": place})
        assert np.max(np.abs(jb.solve(free).force[:3])) < 0.2  # the floor of the centrifugal force, 1 mN a ball


def test_no_load_at_all_is_refused():
    scene = jb.load_scene("reference_roller", DRY)
    with pytest.raises(ValueError, match=r"operation\.radial_load_lateral: it is 0, and nothing else loads"):
        scene.at_operation(radial_load=None, radial_load_lateral=0.0)
    lateral = lambda load: scene.at_operation(radial_load=None, radial_load_lateral=load)
    converged = jax.jit(jax.vmap(lambda load: jb.solve(lateral(load), throw=False).converged))
    assert converged(jnp.asarray([1e3, 0.0])).tolist() == [True, False]


@pytest.mark.slow
def test_bounds_of_moments_turn_with_the_loads():
    """Loads turned by 45 degrees are refused without a step as well."""
    scene = jb.load_scene("tapered_example", {"contact": "none", "operation.load_position": "-80 mm"})
    half = math.sqrt(0.5)
    load = float(scene.operation.radial_load)
    across = scene.at_operation(
        radial_load=half * load, radial_load_lateral=half * load, moment=half * 450.0, moment_lateral=half * 450.0
    )
    for one in (scene.at_operation(moment=450.0), across):
        failed = jb.solve(one, throw=False)
        assert int(failed.iterations) == 0
        assert "N m must lie between" in failed.failure()
    assert "both moments together" in failed.failure()


def test_displacements_by_their_paths():
    scene = jb.load_scene("reference_roller", DRY)
    by_path = scene.replace({"operation.radial_load": None, "operation.displacement.radial": 3e-5})
    assert float(by_path.operation.displacement.radial) == 3e-5
    both = by_path.replace({"operation.displacement.lateral": 1e-6})
    assert float(both.operation.displacement.radial) == 3e-5
