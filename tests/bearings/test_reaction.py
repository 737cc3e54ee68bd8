"""The port of a bearing: displacements of the inner ring in, what holds it there out."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tapered_cases import tapered

import jaxbearing as jb
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.cylindrical.geometry import RollerGeometry
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.parts import Materials
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.materials import Material

RPM = np.pi / 30.0
STEEL = Material(207e9, 0.3, 7850.0)
MICRO = np.array([1e-6, 1e-6, 1e-6, 1e-3, 1e-3])
"""um and mrad."""


def balls(geometry, rpm):
    operation = BallOperation(inner_speed=rpm * RPM, axial_load=1e3, radial_load=5e3)
    return BallBearing(geometry, BallMaterials(STEEL, STEEL), operation, BallAttitude("outer"))


T15 = balls(BallGeometry(20, 153e-3, 20.638e-3, 0.5225, 0.51125, np.radians(30.0)), 12500.0)
DEEP_GROOVE = balls(BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=12e-6), 6000.0)
N7 = CylindricalRollerBearing(
    RollerGeometry(13, 54e-3, 10e-3, 10e-3, 25e-6),
    Materials(STEEL, STEEL),
    Operation(6000.0 * RPM, radial_load=1e3, moment=1.0),
)
# Held at displacements, they forget their loads.
# The sheet "several bearings together", section 9, rows A1 to A4: scene, displacement (um, mrad), expansion, force,
# diagonal of the stiffness, other entries of it. Its grooves move to first order with a tilt.
ROWS = {
    "A1": (
        T15,
        [50.0, 20.0, 10.0, 0.2, -0.1],
        0.0,
        [32379.75499, 20701.16782, 3506.465670, 1079.334811, 139.8436025],
        [6.830736748e8, 6.871205636e8, 6.948187676e8, 2.011064775e6, 1.997116095e6],
        {(0, 1): 3.24638509e8, (1, 3): 3.36536763e7},
    ),
    "A1, 5 um larger": (
        T15,
        [50.0, 20.0, 10.0, 0.2, -0.1],
        5e-6,
        [37001.67090, 23367.49084, 4043.209181, 1202.798450, 158.7357020],
        [7.455497816e8, 7.542830078e8, 7.873918801e8, 2.164983624e6, 2.209541222e6],
        {},
    ),
    "A2": (
        DEEP_GROOVE,
        [5.0, 15.0, -4.0, 0.3, -0.2],
        0.0,
        [18.03723968, 465.6725706, -116.2460194, 0.2940006670, -0.08925098055],
        [1.775083169e6, 8.084642307e7, 3.761847169e7, 513.1104332, 149.4130195],
        {(1, 2): -9.83673706e6},
    ),
    "A3": (
        tapered(1e3, rpm=3000),
        [20.0, 8.0, -3.0, 0.2, 0.1],
        0.0,
        [3950.655452, 10205.05627, -2742.352855, 59.69825829, -14.6170543],
        [1.215995864e8, 8.231234100e8, 1.122540248e9, 3.367169780e4, 4.641827771e4],
        {},
    ),
    "A4": (
        N7.replace_geometry(flange_stiffness=3e8, flange_gap=50e-6),
        [53.0, 20.0, 5.0, 0.2, 0.1],
        0.0,
        [219.0732320, 3015.603280, 755.6441753, 0.9394418602, 0.3037072956],
        [8.113823408e7, 5.201873945e8, 1.909527048e8, 4332.734343, 1589.543594],
        {(0, 1): 0.0, (1, 0): 0.0},
    ),
    "A4, no flanges": (
        N7,
        [53.0, 20.0, 5.0, 0.2, 0.1],
        0.0,
        [0.0, 3015.603280, 755.6441753, 0.9394418602, 0.3037072956],
        [0.0, 5.201873945e8, 1.909527048e8, 4332.734343, 1589.543594],
        {(0, 1): 0.0},
    ),
}


@pytest.mark.parametrize("row", ROWS)
def test_check_values(row):
    scene, displacement, expansion, force, stiffness, others = ROWS[row]
    found = jb.reaction(scene, displacement * MICRO, expansion=expansion)
    np.testing.assert_allclose(found.force, force, rtol=1e-8)
    np.testing.assert_allclose(np.diag(found.stiffness), stiffness, rtol=1e-8)
    for place, value in others.items():
        np.testing.assert_allclose(found.stiffness[place], value, rtol=1e-8)


def test_stiffness_is_not_symmetric_with_centrifugal_forces_of_the_balls_own():
    scene, displacement, *_ = ROWS["A1"]
    k = np.asarray(jb.reaction(scene, displacement * MICRO).stiffness)
    size = np.sqrt(np.diag(k))
    np.testing.assert_allclose(np.max(np.abs(k - k.T) / np.outer(size, size)), 6.63e-3, rtol=1e-3)


def test_check_values_of_a_mirrored_bearing_from_another_point():
    scene, displacement, *_ = ROWS["A1"]
    mirror = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    found = jb.reaction(scene, displacement * MICRO)
    back = np.asarray(shift_matrix(jnp.asarray(-30e-3)))
    force = back.T @ (mirror * np.asarray(found.force))
    expected = [-32379.75499, 20701.16782, 3506.465670, -458.2997761, -34.64963237]
    np.testing.assert_allclose(force, expected, rtol=1e-8)
    stiffness = back.T @ (mirror[:, None] * np.asarray(found.stiffness) * mirror) @ back
    np.testing.assert_allclose(stiffness[3, 3], 617649.4767, rtol=1e-7)


@pytest.mark.slow
def test_the_exact_tilt_differs_by_what_the_docstring_says():
    for row, size in (("A1", 1e-3), ("A2", 2e-2)):
        scene, displacement, _, force, *_ = ROWS[row]
        exact = np.asarray(jb.reaction(scene, displacement * MICRO, tilt="exact").force)
        away = np.abs(exact / force - 1.0)
        assert 0.05 * size < np.max(away) < size
        straight = np.array([50.0, 0.0, 0.0, 0.0, 0.0]) * MICRO
        both = [jb.reaction(scene, straight, tilt=tilt).force[0] for tilt in ("exact", "linear")]
        np.testing.assert_allclose(*both, rtol=1e-9)


LONG = (
    "films",
    "cage and traction",
    "deep groove, free tilt",
    "deep groove, no tilt",
    "deep groove, held tilt",
    "tapered",
    "tapered, loads at the row",
)
"""Cases with large programs. A mounted deep groove ball bearing with a free tilt: `test_mounted`."""
RETURNED = {
    "deep groove, free tilt": ("deep_groove_6205", {}),
    "deep groove, no tilt": ("deep_groove_6205", {"operation.moment": "none"}),
    "deep groove, held tilt": ("deep_groove_6205", {"operation.moment": "none", "operation.misalignment": "1 mrad"}),
    "tapered": ("tapered_example", {}),
    "tapered, loads at the row": ("tapered_example", {"operation.load_position": "-80 mm"}),
    "films": (
        "deep_groove_6205",
        {
            "oil.name": "mobil_jet_ii",
            "operation.oil_temperature": "60 degC",
            "contact.film": "nijenbanning",
            "operation.misalignment": "0 mrad",
            "operation.moment": "none",
        },
    ),
    "cage and traction": ("turbine_ball", {"operation.radial_load": "3 kN"}),
}


@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=pytest.mark.slow) if one in LONG else one for one in RETURNED]
)
def test_displacements_of_a_solve_need_its_loads(name):
    assert_returned(jb.load_scene(*RETURNED[name]), "ring")


def test_displacements_of_rollers_with_a_moment_need_it():
    """Their port is the point where the displacements count."""
    assert_returned(N7, "port")


def assert_returned(scene, at):
    solved = jb.solve(scene)
    given = {
        "axial": getattr(scene.operation, "axial_load", None),
        "radial": scene.operation.radial_load,
        "tilt": scene.operation.moment,
    }
    for freedom, load in given.items():
        if load is not None:
            found = solved.force[RING_FREEDOMS.index(freedom)]
            np.testing.assert_allclose(found, load, rtol=1e-9, atol=1e-8)
    back = jb.reaction(scene, solved.ring, at=at)
    size = np.max(np.abs(solved.force[:3]))
    np.testing.assert_allclose(back.force, solved.force, rtol=1e-9, atol=1e-9 * size)
    scale = np.sqrt(np.outer(*2 * [np.diag(solved.stiffness)])) + 1e-9
    np.testing.assert_allclose(back.stiffness / scale, solved.stiffness / scale, atol=1e-8)
    np.testing.assert_allclose(back.elements.load_inner, solved.elements.load_inner, atol=1e-9 * size)


def assert_slopes(found, slopes, tolerance):
    size = np.sqrt(np.diag(found.stiffness)) + 1e-9
    np.testing.assert_allclose(found.stiffness / np.outer(size, size), slopes / np.outer(size, size), atol=tolerance)


@pytest.mark.parametrize("row", ["A1", "A2", "A3", "A4"])
def test_stiffness_is_the_slope_of_the_force(row):
    scene, displacement, *_ = ROWS[row]
    place, step = displacement * MICRO, 1e-4 * MICRO
    force = lambda q: np.asarray(jb.reaction(scene, q).force)
    ends = [np.stack([force(place + sign * one) for one in np.diag(step)]) for sign in (1.0, -1.0)]
    assert_slopes(jb.reaction(scene, place), (ends[0] - ends[1]).T / (2.0 * step), 2e-6)


@pytest.mark.parametrize("row", ["A4", *(pytest.param(row, marks=pytest.mark.slow) for row in ("A1", "A2", "A3"))])
def test_stiffness_is_the_derivative_of_the_force(row):
    scene, displacement, *_ = ROWS[row]
    place = displacement * MICRO
    exact = jax.jit(jax.jacfwd(lambda q: jb.reaction(scene, q).force))(place)
    assert_slopes(jb.reaction(scene, place), exact, 1e-10)


def test_an_empty_half_carries_nothing():
    found = jb.reaction(DEEP_GROOVE, np.array([0.0, 30.0, 0.0, 0.0, 0.0]) * MICRO)
    load = np.asarray(found.elements.load_inner)
    assert np.all(load[np.cos(np.asarray(found.elements.azimuth)) < 0] == 0.0)
    np.testing.assert_allclose(found.force[1], np.sum(load * np.cos(found.elements.azimuth)), rtol=1e-8)


@pytest.mark.parametrize("row", ["A2", "A3", "A4"])
def test_turning_everything_by_one_pitch_turns_the_force(row):
    scene, displacement, *_ = ROWS[row]
    count = getattr(scene.geometry, "n_balls", None) or scene.geometry.n_rollers
    cosine, sine = np.cos(2.0 * np.pi / count), np.sin(2.0 * np.pi / count)
    turn = np.eye(5)
    for first in (1, 3):
        turn[first : first + 2, first : first + 2] = [[cosine, -sine], [sine, cosine]]
    place = displacement * MICRO
    force, turned = jb.reaction(scene, place).force, jb.reaction(scene, turn @ place).force
    np.testing.assert_allclose(turned, turn @ np.asarray(force), rtol=1e-9, atol=1e-9 * np.max(np.abs(force)))


@pytest.mark.slow
def test_gradient_by_a_number_of_the_scene():
    scene, displacement, *_ = ROWS["A1"]
    force = jax.jit(lambda w: jb.reaction(scene.at_operation(inner_speed=w), displacement * MICRO).force)
    speed = 12500.0 * RPM
    slope = jax.jit(jax.jacrev(force))(speed)
    step = 1e-3 * speed
    np.testing.assert_allclose(slope, (force(speed + step) - force(speed - step)) / (2.0 * step), rtol=1e-5)


@pytest.mark.parametrize("row", ["A1", "A4"])
def test_closure_is_an_axial_displacement(row):
    scene, displacement, *_ = ROWS[row]
    place = displacement * MICRO
    closed = jb.reaction(scene, place, closure=3e-6)
    moved = jb.reaction(scene, place + np.array([3e-6, 0.0, 0.0, 0.0, 0.0]))
    np.testing.assert_allclose(closed.force, moved.force, rtol=1e-12)
    np.testing.assert_allclose(closed.ring.axial, displacement[0] * 1e-6)
    np.testing.assert_allclose(closed.ring.tilt, 0.2e-3)


def test_flanges_over_displacements():
    """One at -x, one at +x; alone and in a batch, with the derivative, which is 0 at the touch."""
    scene, (_, *held) = ROWS["A4"][0], ROWS["A4"][1] * MICRO
    place = lambda axial: jnp.stack([axial, *held])

    def force(axial):
        found = jb.reaction(scene, place(axial), throw=False)
        return found.force[0], (found.force, found.stiffness)

    axials = np.array([-120e-6, -50e-6, 0.0, 50e-6, 50.01e-6, 90e-6])
    pressed = np.maximum(np.abs(axials) - 50e-6, 0.0)
    (along, batch), slopes = jax.jit(jax.vmap(jax.value_and_grad(force, has_aux=True)))(axials)
    np.testing.assert_allclose(along, np.sign(axials) * 3e8 * pressed ** (10 / 9), rtol=1e-12)
    np.testing.assert_allclose(slopes, 10 / 9 * 3e8 * pressed ** (1 / 9), rtol=1e-12)
    for axial, *lane in zip(axials, *batch, strict=True):
        found = jb.reaction(scene, place(axial))
        for one, alone in zip(lane, (found.force, found.stiffness), strict=True):
            np.testing.assert_allclose(one, alone, rtol=1e-9, atol=1e-9 * np.max(np.abs(alone)))
        np.testing.assert_allclose(found.force[0], lane[0][0], rtol=1e-12)
        np.testing.assert_allclose(found.stiffness[0, 0], lane[1][0, 0], rtol=1e-12)


def test_ways_to_give_displacements():
    scene, displacement, *_ = ROWS["A2"]
    force = jb.reaction(scene, displacement * MICRO).force
    numbers = (displacement * MICRO).tolist()
    by_name = dict(zip(RING_FREEDOMS, numbers, strict=True))
    for given in (numbers, tuple(numbers), by_name, jnp.asarray(numbers), [jnp.asarray(one) for one in numbers]):
        np.testing.assert_array_equal(jb.reaction(scene, given).force, force)


@pytest.mark.slow
def test_a_failed_lane_says_so_and_leaves_the_others_alone():
    """Both lanes share the geometry, on which the point of the ring that is shown depends."""
    scene, displacement, *_ = ROWS["A1"]
    places = jnp.stack([jnp.asarray(displacement * MICRO), jnp.asarray([0.0, np.nan, 0.0, 0.0, 0.0])])

    def lanes(diameter, places, options=None):
        changed = scene.replace_geometry(ball_diameter=diameter)
        return jax.jit(jax.vmap(lambda q: jb.reaction(changed, q, throw=False, options=options)))(places)

    def total(diameter, places, options=None):
        found = lanes(diameter, places, options)
        return jnp.sum(jnp.where(found.converged[:, None], found.force, 0.0))

    diameter = scene.geometry.ball_diameter
    found = lanes(diameter, places)
    assert found.status.tolist() == [jb.Status.CONVERGED, jb.Status.INVALID_INPUT]
    for results in (found.force, found.stiffness, found.ring.radial):
        assert np.all(np.isfinite(results[0]))
        assert np.all(np.isnan(results[1]))
    slope, alone = (jax.jit(jax.grad(total))(diameter, some) for some in (places, places[:1]))
    np.testing.assert_allclose(slope, alone, rtol=1e-12)
    few = jb.NewtonOptions(max_steps=2, continuation=False)
    assert not np.any(lanes(diameter, places, few).converged)
    assert float(jax.grad(total)(diameter, places, few)) == 0.0


EMPTY = {"nothing moves": np.zeros(5), "drawn apart": np.array([-20.0, 0.0, 0.0, 0.0, 0.0]) * MICRO}


@pytest.mark.parametrize("row", ["A1", "A2", "A3", "A4"])
@pytest.mark.parametrize("name", EMPTY)
def test_a_ring_that_touches_little(row, name):
    scene = ROWS[row][0]
    found = jb.reaction(scene, EMPTY[name])
    assert np.all(np.isfinite(found.force))
    assert np.all(np.isfinite(found.stiffness))


def test_warnings_are_about_the_ring_that_is_held():
    """Nothing is said of the loads of the operating point; of a tilt, whether the operating point names one or not."""
    assert not any("1.22" in text for text in jb.reaction(T15, [30e-6, 0.0, 0.0, 0.0, 0.0]).warnings)
    assert any("10 mrad" in text for text in jb.reaction(DEEP_GROOVE, [0.0, 0.0, 0.0, 0.02, 0.0]).warnings)


def test_what_it_does_not_take():
    with pytest.raises(ValueError, match="displacement must have five numbers, axial, radial"):
        jb.reaction(T15, [1e-6, 0.0])
    for wrong in ([1e-6, None, 2e-6, 0.0, 0.0, 0.0], [[1e-6, 0.0], [0.0, 0.0, 0.0]], "five", {"axial": 1e-6}):
        with pytest.raises(ValueError, match="displacement must have five numbers, axial, radial"):
            jb.reaction(T15, wrong)
    with pytest.raises(ValueError, match="displacement, lateral, must be a number"):
        jb.reaction(T15, [0.0, 0.0, "3 um", 0.0, 0.0])
    with pytest.raises(ValueError, match="closure must be a number"):
        jb.reaction(T15, np.zeros(5), closure="3 um")
    with pytest.raises(ValueError, match=r"expansion must be one number, got shape \(3,\)"):
        jb.reaction(T15, np.zeros(5), expansion=np.zeros(3))
    with pytest.raises(ValueError, match="tilt must be one of 'exact', 'linear', got 'iso'"):
        jb.reaction(T15, np.zeros(5), tilt="iso")
    with pytest.raises(TypeError, match="reaction takes a bearing, got a TwoDisk"):
        jb.reaction(jb.load_scene("two_disk_etm"), np.zeros(5))
    invalid = jax.jit(lambda w: jb.reaction(N7.replace_geometry(roller_length=w), np.zeros(5), throw=False).status)
    assert int(invalid(-1.0)) == jb.Status.INVALID_INPUT


@pytest.mark.slow
def test_rollers_that_slide_are_held_where_a_solve_brings_them():
    """Cage, losses and stiffness are those of the solve, whose rollers carry evenly. Under a ring that tilts the
    balance of power closes too."""
    scene = jb.load_scene("reference_roller").replace({"ring_freedom": ("radial", "lateral")})
    solved = jb.solve(scene)
    place = jnp.asarray([0.0, solved.ring.radial, solved.ring.lateral, 0.0, 0.0])
    held = jax.jit(lambda q: jb.reaction(scene, q, throw=False))(place)
    np.testing.assert_allclose(held.force, solved.force, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(held.power_loss.total, solved.power_loss.total, rtol=1e-9)
    np.testing.assert_allclose(held.cage.speed, solved.cage.speed, rtol=1e-12)
    scale = float(solved.stiffness[1, 1])
    np.testing.assert_allclose(held.stiffness[1:3, 1:3] / scale, solved.stiffness[1:3, 1:3] / scale, atol=1e-8)
    tilted = jax.jit(lambda q: jb.reaction(scene, q))(place.at[3].set(1e-3))
    for solution in (held, tilted):
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-11)
    assert float(tilted.force[3]) > 10.0
