"""Tilted inner ring of a ball bearing: exact motion of the grooves, work-conjugate moment, the equations of ISO 16281.

Check values: model sheet "Four-point contact, exact ring tilt, flexible and out-of-round rings", sections A2 and A7
(computed there by a second route: brute-force minimum over the circle of groove centres), rtol 1e-6 where nothing else
is said.
"""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.checks import missing_thrust
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.groove_motion import conjugate_loads, half_planes, inner_arm, length_of, ring_frame
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.ball.steady import overload
from jaxbearing.bearings.rating import Rating
from jaxbearing.materials import Material, reduced_modulus
from jaxbearing.numerics.newton import NewtonOptions, newton_solve

STEEL = BallMaterials(*(Material(np.float64(207e9), np.float64(0.3), np.float64(7850.0)),) * 2)
GROOVE = BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=12e-6)
SCENE = BallBearing(
    geometry=GROOVE,
    materials=STEEL,
    operation=BallOperation(0.0, axial_load=0.0, radial_load=0.0, moment=10.0),
    kinematics=BallAttitude("outer"),
)
"""Of the sheet; compiled once for the module."""


@pytest.fixture(scope="module")
def any_load():
    return jb.jit_solver(SCENE)


# azimuth, side, arm from the ball to the inner groove; G4: two arcs, shims of 32 degrees
ARMS = [
    (0.0, 1.0, 5.540572052836e-4),
    (0.0, -1.0, 3.964915246640e-4),
    (1.1, 1.0, 4.291109442666e-4),
    (2.5, -1.0, 5.052632053157e-4),
    (4.0, 1.0, 4.159211445325e-4),
]


@jax.jit
def arms(ring, azimuth, centre, lever, side=0.0):
    """From balls to the inner groove, and their lengths."""
    seen = jnp.einsum("ijn,jn->in", half_planes(azimuth), jnp.broadcast_to(ring, (5, azimuth.size)))
    arm = inner_arm(ring_frame(seen), centre, lever, side).vector
    return arm, length_of(arm)


@pytest.mark.parametrize(("azimuth", "side", "expected"), ARMS)
def test_exact_arms_of_five_freedoms(azimuth, side, expected):
    lever, arc = 0.03661272600, 2.313428788e-4
    ring = np.asarray([20e-6, 30e-6, -15e-6, 4e-3, -2.5e-3])[:, None]
    # ball centre along the axis, and from the axis less R_i
    centre = np.asarray([[3e-6], [-3.6e-4]])
    _, found = arms(ring, np.asarray([azimuth]), centre, lever, side * arc)
    # R_i is printed to 1e-12 m
    np.testing.assert_allclose(found, expected, rtol=1e-8)


def test_arm_is_the_least_distance_from_the_circle():
    """Against the distance minimised over a dense circle, at a large tilt and displacement."""
    lever, azimuth = 0.02, np.array([0.4, 2.0])
    shift, tilt = np.array([5e-5, -3e-5, 4e-5]), np.array([0.03, -0.05])
    centre = np.array([[1e-5, -2e-5], [0.0199, 0.0198]])
    ring = np.asarray([*shift, *tilt])[:, None] * np.ones((1, 2))
    _, found = arms(ring, azimuth, centre - np.array([[0.0], [lever]]), lever)
    # rotation vector tilt[1] Y - tilt[0] Z, by Rodrigues
    size = np.hypot(*tilt)
    about = np.array([0.0, tilt[1], -tilt[0]]) / size
    cross = np.array([[0.0, -about[2], about[1]], [about[2], 0.0, -about[0]], [-about[1], about[0], 0.0]])
    turn = np.eye(3) + np.sin(size) * cross + (1.0 - np.cos(size)) * cross @ cross
    for j in range(2):
        ball = np.array([centre[0, j], *(centre[1, j] * np.array([np.cos(azimuth[j]), np.sin(azimuth[j])]))])
        around = azimuth[j] + np.linspace(-0.02, 0.02, 40001)
        circle = turn @ (lever * np.array([0.0 * around, np.cos(around), np.sin(around)])) + shift[:, None]
        least = np.min(np.linalg.norm(circle - ball[:, None], axis=0))
        np.testing.assert_allclose(found[j], least, rtol=1e-6)


@pytest.mark.parametrize("tilt", [0.0, 1e-4, 8e-3, -0.1])
def test_closed_form_in_the_plane_of_the_moment(tilt):
    """No clearance: the groove centres come apart by sqrt(A^2 + 4 R_i R_e sin^2(t/2)) - A, R_e = R_i - A."""
    lever, apart = 0.0194, 3.2e-4
    outer = lever - apart
    ring = np.asarray([0.0, 0.0, 0.0, tilt, 0.0])[:, None]
    found = np.asarray(arms(ring, np.zeros(1), np.asarray([[0.0], [-apart]]), lever)[1]) - apart
    expected = np.sqrt(apart**2 + 4.0 * lever * outer * np.sin(0.5 * tilt) ** 2) - apart
    np.testing.assert_allclose(found, [expected], rtol=1e-11, atol=1e-17)


@jax.jit
def works_and_loads(displaced, moment):
    """Derivatives of the work of given forces by the displacements of the ring, the loads of the formulas, and how both
    change along a direction. **Arguments:** `moment`: turning moments on the grooves, or `None`."""
    lever, offsets = 0.0194, (2.3e-4, -2.3e-4)
    centre = jnp.asarray([[1e-5, -2e-5, 4e-5], [-3.1e-4, -3.4e-4, -2.8e-4]])
    forces = [jnp.asarray([[300.0, -200.0, 10.0], [500.0, 900.0, -40.0], [0.2, -0.1, 3.0]]), jnp.full((3, 3), -80.0)]

    def work(displaced):
        frame = ring_frame(displaced)
        arms = [inner_arm(frame, centre, lever, offset) for offset in offsets]
        done = sum(jnp.sum(arm.vector * force) for arm, force in zip(arms, forces, strict=True))
        return done if moment is None else done + jnp.sum(frame.turned * moment)

    def loads(displaced):
        frame = ring_frame(displaced)
        return conjugate_loads(frame, [inner_arm(frame, centre, lever, offset) for offset in offsets], forces, moment)

    way = jnp.asarray([[1.0], [-0.5], [0.3], [20.0], [-35.0]]) * jnp.ones((1, 3))
    return [jax.jvp(function, (displaced,), (way,)) for function in (jax.grad(work), loads)]


@pytest.mark.parametrize("tilt", [(0.0, 0.0), (1e-9, -2e-9), (3e-5, 1e-5), (6e-3, -2e-3), (-0.2, 0.3)])
@pytest.mark.parametrize("moment", [None, -0.7])
def test_loads_do_the_work_of_the_forces_on_the_grooves(tilt, moment):
    """The formulas against a reverse pass through the arms of two circles, and so their derivatives."""
    shift = np.asarray([[2e-5, 1e-5, -3e-5], [3e-5, -1e-5, 2e-5], [-1e-5, 4e-5, 1e-5]])
    displaced = np.concatenate([shift, np.asarray(tilt)[:, None] * np.ones((2, 3))])
    (expected, expected_slope), (found, slope) = works_and_loads(
        displaced, None if moment is None else np.full(3, moment)
    )
    unit = np.array([1.0, 1.0, 1.0, 0.02, 0.02])[:, None]
    np.testing.assert_allclose(found / unit, expected / unit, rtol=1e-13, atol=1e-10)
    # of a slope 1e6 N/m of the displacements; where the tilt is near its floor, both ways lose digits of 1e-7 of it
    np.testing.assert_allclose(slope / unit, expected_slope / unit, rtol=1e-9, atol=1e-3)


# moment, N m: tilt and largest load, exact and to first order
ROWS = {
    10.0: ((6.061637263e-3, 549.32494), (6.003441636e-3, 545.99015)),
    20.0: ((6.961239413e-3, 928.74601), (6.893337361e-3, 922.99914)),
}


@pytest.mark.parametrize("moment", ROWS)
def test_pure_moment_on_a_deep_groove_bearing(any_load, moment):
    solution = any_load(moment=moment)
    assert bool(solution.converged)
    tilt, largest = ROWS[moment][0]
    np.testing.assert_allclose(solution.ring.tilt, tilt, rtol=1e-6)
    np.testing.assert_allclose(jnp.max(solution.elements.load_inner), largest, rtol=1e-6)
    stiffness = np.asarray(solution.stiffness)
    size = np.sqrt(np.outer(np.diag(stiffness), np.diag(stiffness)))
    assert np.max(np.abs(stiffness - stiffness.T) / size) < 1e-12
    # the exact potential is not convex by construction, and is at its solutions
    assert np.min(np.linalg.eigvalsh(stiffness / size)) > 0.05


def test_loads_of_the_linear_form():
    def state(scene):
        system, result = newton_solve(build_core(scene, exact=False).started()[0], NewtonOptions())
        return system.ring.displacement(result.point.globals), system.at(result.point).load[0]

    displacement, load = jax.jit(state)(SCENE)
    np.testing.assert_allclose((displacement.tilt, jnp.max(load)), ROWS[10.0][1], rtol=1e-6)


# Fr and Fa, kN, M across Fr, N m, clearance, um: displacement, um, and tilt, mrad, as two programs print them, tilt and
# L10r by an own solution of the standard's equations with scipy, and L10r as printed. The printed lives differ from the
# equations by what an equilibrium that is 2e-5 of the loads off (7e-5 under M alone) makes: the purely axial one, which
# needs no iteration, agrees to its digits. Printed tilts are up to 3e-5 off.
PRINTED = {
    "M": ((0.0, 0.0, 1.0, 0.0), (None, None, 3.6957), (3.69557632, 785313.77), 785145.0),
    "Fr, Fa, M": ((1.0, 1.0, 1.0, 10.0), (19.714, 146.308, 2.7239), (2.72388862, 1627.77999), 1627.75),
    "Fr, Fa": ((1.0, 1.0, 0.0, 10.0), (19.592, 146.460, 2.6872), (2.68711257, 1630.61064), 1630.54),
    "Fr": ((1.0, 0.0, None, 0.0), (15.110, None, None), (None, 13162.7717), 13163.0),
    "Fr, clearance": ((1.0, 0.0, None, 10.0), (21.223, None, None), (None, 10796.5178), 10795.8),
    "Fa": ((0.0, 1.0, None, 10.0), (None, 149.172, None), (None, 3115.88363), 3115.88),
}


@pytest.mark.slow
def test_tilt_by_the_standard():
    """`rating.tilt = "iso"`: half the pitch diameter is the lever, in lives and in displacements."""
    steel = Material(210e9, 0.3, 7850.0)
    free = BallBearing(
        geometry=BallGeometry(7, 43.5e-3, 11.5e-3, 0.52, 0.53, diametral_clearance=0.0),
        materials=BallMaterials(steel, steel),
        operation=BallOperation(0.0, axial_load=0.0, radial_load=1e3, moment=0.0, moment_lateral=0.0),
        kinematics=BallAttitude("outer"),
        rating=Rating(dynamic_capacity=23.4e3, tilt="iso"),
    )
    held = free.replace({"operation.moment": None, "operation.moment_lateral": None})
    solve = jax.jit(lambda scene: jb.solve(scene, throw=False))
    for (radial, axial, moment, clearance), printed, (tilt, life), printed_life in PRINTED.values():
        loads = {"operation.radial_load": 1e3 * radial, "operation.axial_load": 1e3 * axial}
        loads |= {"geometry.diametral_clearance": 1e-6 * clearance}
        scene = held.replace(loads) if moment is None else free.replace(loads | {"operation.moment_lateral": moment})
        found = solve(scene)
        ring = found.ring
        lateral = 0.0 if ring.lateral is None else ring.lateral
        values = [1e6 * np.hypot(ring.radial, lateral), 1e6 * ring.axial]
        for value, digits in zip(values, printed, strict=False):
            assert digits is None or f"{value:.3f}" == f"{digits:.3f}"
        if moment is not None:
            # centrifugal forces are at least 1 mN, and the standard has sin(tilt)
            turned = 1e3 * np.hypot(ring.tilt, ring.tilt_lateral)
            np.testing.assert_allclose(turned, tilt, rtol=5e-6)
            np.testing.assert_allclose(turned, printed[2], rtol=5e-5)
            assert any("ISO 16281" in note for note in found.notes)
        np.testing.assert_allclose(found.life.L10r, life, rtol=2e-5)
        np.testing.assert_allclose(found.life.L10r, printed_life, rtol=2.5e-4 if life > 1e5 else 7e-5)
    # the same place and loads by the port, where an explicit tilt has the true lever
    scene = free.replace({"operation.radial_load": 1e3, "operation.axial_load": 1e3, "operation.moment_lateral": 1.0})
    solution = solve(scene)
    again = jb.reaction(scene, solution.ring, at="ring")
    np.testing.assert_allclose(again.force, [1e3, 1e3, 0.0, 0.0, 1.0], rtol=0, atol=1e-5)
    assert abs(jb.reaction(scene, solution.ring, at="ring", tilt="linear").force[4] - 1.0) > 1e-3


def test_forces_and_moments_balance(any_load):
    """In vectors, from the places of the balls: forces along the arms carry the loads of the ring."""
    axial, radial, moment = 300.0, 1500.0, 6.0
    solution = any_load(axial_load=axial, radial_load=radial, moment=moment)
    assert bool(solution.converged)
    e, ring = jax.tree.map(np.asarray, (solution.elements, solution.ring))
    tilt, lever = float(ring.tilt), float(GROOVE.groove_circle_radius)
    assert abs(tilt) > 2e-3
    cosine, sine = np.cos(e.azimuth), np.sin(e.azimuth)
    contact = GROOVE.free_contacts(reduced_modulus(STEEL.rings, STEEL.balls))
    reach = GROOVE.outer_offset + (e.load_outer / contact.stiffness_constant()[1]) ** (2.0 / 3.0)
    outer_circle = lever - float(GROOVE.centre_distance * GROOVE.free_cosine)
    angle = np.asarray(e.contact_angle_outer)
    centre = np.stack([reach * np.sin(angle), outer_circle + reach * np.cos(angle)])
    moved = np.array([ring.axial, ring.radial, 0.0, tilt, 0.0])[:, None] * np.ones((1, 9))
    arm, length = (np.asarray(part) for part in arms(moved, e.azimuth, centre - np.array([[0.0], [lever]]), lever))
    force = np.asarray(e.load_inner) * arm / length
    close = lambda found, given: np.testing.assert_allclose(found, given, rtol=0, atol=1e-8 * radial)
    close(np.sum(force[0]), axial)
    close(np.sum(force[1] * cosine - force[2] * sine), radial)
    # about the lateral axis through the displaced centre, from the nearest groove centres
    on_line = force[1] * cosine - force[2] * sine
    nearest = centre + np.asarray(arm[:2])
    turned = force[0] * (nearest[1] * cosine - arm[2] * sine - float(ring.radial))
    turned = turned - on_line * (nearest[0] - float(ring.axial))
    np.testing.assert_allclose(np.sum(turned), moment, rtol=0, atol=1e-8 * lever * radial)
    # the balls, and the contact angle on the tilted race
    loaded = np.asarray(e.load_inner) > 1.0
    close(force[0], e.load_outer * np.sin(angle))
    in_ring = np.arctan2(arm[0], arm[1]) - np.arctan2(np.sin(tilt) * cosine, np.cos(tilt))
    np.testing.assert_allclose(e.contact_angle_inner[loaded], in_ring[loaded], rtol=0, atol=1e-5)


@pytest.mark.slow
def test_held_tilt_is_the_free_one(any_load):
    """Held at the tilt that a moment makes, the ring finds the same place, with the same loads."""
    free = any_load(axial_load=300.0, radial_load=1500.0, moment=6.0)
    operation = BallOperation(0.0, axial_load=300.0, radial_load=1500.0, misalignment=free.ring.tilt)
    held = jb.solve(SCENE.replace({"operation": operation}))
    np.testing.assert_allclose(held.ring.axial, free.ring.axial, rtol=1e-8)
    np.testing.assert_allclose(held.elements.load_inner, free.elements.load_inner, rtol=1e-7, atol=1e-6)
    np.testing.assert_allclose(held.stiffness, free.stiffness, rtol=1e-6, atol=1e-6 * float(free.stiffness[1, 1]))


@pytest.mark.slow
def test_slope_of_the_tilt(any_load):
    """Derivative of the tilt with respect to the moment and to the clearance, against differences."""

    def tilt(moment, clearance):
        changed = SCENE.replace({"geometry.diametral_clearance": clearance, "rating": None})
        return jb.solve(changed.at_operation(moment=moment), throw=False).ring.tilt

    slopes = jax.jit(jax.grad(tilt, (0, 1)))(10.0, 12e-6)
    steps = (1e-3, 1e-9)
    for i, step in enumerate(steps):
        ends = []
        for sign in (1.0, -1.0):
            moment, clearance = (10.0 + sign * step, 12e-6) if i == 0 else (10.0, 12e-6 + sign * step)
            scene = SCENE.replace({"geometry.diametral_clearance": clearance})
            ends.append(float(any_load(scene, moment=moment).ring.tilt))
        np.testing.assert_allclose(slopes[i], (ends[0] - ends[1]) / (2.0 * step), rtol=1e-6)


def test_large_tilt_is_warned_of(any_load):
    wide = any_load(SCENE.replace({"geometry.diametral_clearance": 100e-6}), moment=20.0)
    assert abs(float(wide.ring.tilt)) > 10e-3
    assert any("10 mrad" in text for text in wide.warnings)
    assert not any("10 mrad" in text for text in any_load(moment=10.0).warnings)


# -- zero of the axial displacement


def test_axial_displacement_counts_from_the_middle_of_the_play(any_load):
    """Bearings given by their clearance: 0 under radial load, and the same both ways under thrust, beginning with half
    of the play BD sin(alpha0)."""
    assert float(any_load(radial_load=1500.0, moment=0.0).ring.axial) == 0.0
    there, back = (any_load(axial_load=sign * 1.0, radial_load=0.0, moment=0.0).ring.axial for sign in (1.0, -1.0))
    np.testing.assert_allclose(there, -back, rtol=1e-12)
    np.testing.assert_allclose(there, GROOVE.centre_distance * GROOVE.free_sine, rtol=3e-2)
    contact = BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, contact_angle=0.4)
    assert float(GROOVE.aligned) == 0.0
    np.testing.assert_allclose(contact.aligned, -contact.centre_distance * np.sin(0.4), rtol=1e-14)


@pytest.mark.parametrize("clearance", [2e-6, 12e-6, 100e-6])
def test_any_radial_load_finds_the_untilted_ring(any_load, clearance):
    """By symmetry the ring stays untilted in the middle of its play, however light the load and free the tilt."""
    scene = SCENE.replace({"geometry.diametral_clearance": clearance, "operation.inner_speed": 600.0})
    for load in (0.1, 1.0, 20.0, 300.0, 2e4):
        solution = any_load(scene, radial_load=load, moment=0.0)
        assert bool(solution.converged), load
        assert (float(solution.ring.axial), float(solution.ring.tilt)) == (0.0, 0.0)


def test_an_untilted_ring_that_the_least_thrust_tips_is_called_unstable(any_load):
    """A load through the middle of the ring that few balls carry: an inverted pendulum, as the tangent stiffness and a
    thrust of 1 uN show."""
    unstable = lambda solution: any("unstable" in text for text in solution.warnings)
    alone, beside = (any_load(radial_load=20.0, axial_load=axial, moment=0.0) for axial in (0.0, 1e-6))
    assert unstable(alone)
    assert not unstable(beside)
    assert abs(float(beside.ring.tilt)) > 1e-3
    assert not unstable(any_load(radial_load=1500.0, axial_load=200.0, moment=0.0))


# -- loads that the bearing is not made for


def test_overload_says_by_how_much(any_load):
    solution = any_load(radial_load=2e5, moment=0.0)
    assert not bool(solution.converged)
    assert "times that at which the most loaded ball reaches 4.2 GPa" in solution.failure()
    assert "times that" not in any_load(radial_load=1500.0, moment=0.0).failure()


def test_thrust_that_an_angular_contact_bearing_needs():
    scene = jb.load_scene("angular_contact_218", {"operation.radial_load": "1 kN", "operation.axial_load": "1 kN"})
    least = 1.22 * 1000.0 * np.tan(np.radians(40.0))
    for thrust, missing in ((0.0, least), (-0.9 * least, 0.1 * least), (1.1 * least, -0.1 * least)):
        np.testing.assert_allclose(missing_thrust(scene.at_operation(axial_load=thrust)), missing, rtol=1e-12)
    # the static rating by its definition: 4.2 GPa where the mean load of the balls is a fifth of the largest
    contact = scene.geometry.free_contacts(reduced_modulus(scene.materials.rings, scene.materials.balls))
    largest = float(overload(scene.at_operation(radial_load=1e5, axial_load=0.0)))
    load = 1e5 / largest * 5.0 / (16 * np.cos(np.radians(40.0)))
    np.testing.assert_allclose(contact.hertz_pressure(load)[0], 4.2e9, rtol=0.05 / 3.0)  # the load within 5 %
