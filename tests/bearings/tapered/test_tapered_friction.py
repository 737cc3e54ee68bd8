"""Friction of the tapered roller bearing: kinematics and balances against vectors in space, energy, limits, a catalogue
formula, gradients, batches, warnings."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tapered_cases import G1, RPM, tapered

import jaxbearing as jb
from jaxbearing.bearings.tapered.build import rolling_motion
from jaxbearing.bearings.tapered.friction import rib_motion, tapered_friction
from jaxbearing.bearings.tapered.geometry import TaperedGeometry
from jaxbearing.bearings.tapered.system import TaperedState

CUP, HALF, FLANGE, SPHERE = (G1[name] for name in ("contact_angle", "roller_half_angle", "flange_angle", "end_radius"))
CONE, AXIS = CUP - 2 * HALF, CUP - HALF
SPEEDS = {
    "cone": (3000.0, 0.0),
    "cone backwards": (-3000.0, 0.0),
    "cup": (0.0, 2000.0),
    "against each other": (1500.0, -2500.0),
    "with each other": (3000.0, 1000.0),
    "nearly alike": (3000.0, 2990.0),
}
# meridian plane (a, r), and around the bearing: right-handed
A, R, T = np.eye(3)
ALONG = np.cos(AXIS) * A - np.sin(AXIS) * R
TO_RIB = -SPHERE * (np.cos(FLANGE) * A - np.sin(FLANGE) * R)
NORMAL = -TO_RIB / SPHERE
DIAMETER, LENGTH = G1["roller_diameter"], G1["roller_length"]
CENTRE = (SPHERE * np.sqrt(1 - (DIAMETER / 2 / SPHERE) ** 2) - DIAMETER / 2 / np.tan(HALF)) * ALONG  # of the sphere
AT_RIB = CENTRE + TO_RIB


def line(angle):
    """Unit vector from the apex along a line of contact."""
    return np.sin(angle) * R - np.cos(angle) * A


@pytest.fixture(scope="module")
def scene():
    return jb.load_scene("tapered_example", {"rating": "none"})


@pytest.fixture(scope="module")
def friction(scene):
    """Of any loads on the 17 rollers, at speeds in rpm: no solve."""

    @jax.jit
    def found(inner, outer, load, rib):
        zeros = jnp.zeros_like(load)
        state = TaperedState(zeros, zeros, rib, load, zeros, rib)
        changed = scene.at_operation(inner_speed=inner * RPM, outer_speed=outer * RPM)
        return tapered_friction(changed, state), rolling_motion(changed.geometry, changed.operation)

    return found


def some_loads():
    """Also rollers that touch nothing, one race, or one race and the rib."""
    rng = np.random.default_rng(3)
    load, rib = rng.uniform(50.0, 3000.0, (2, 17)), rng.uniform(5.0, 200.0, 17)
    load[0, 3] = load[0, 4] = load[1, 4] = load[0, 5] = load[1, 5] = rib[4] = rib[5] = rib[7] = 0.0
    return jnp.asarray(load), jnp.asarray(rib)


@pytest.mark.parametrize("name", SPEEDS)
def test_kinematics_against_rotations(name):
    inner, outer = (speed * RPM for speed in SPEEDS[name])
    geometry = TaperedGeometry(**G1)
    operation = tapered(1e4).at_operation(inner_speed=inner, outer_speed=outer).operation
    motion = rolling_motion(geometry, operation)
    orbit, spin = float(motion.orbital_speed), float(motion.spin_speed)
    roller = orbit * A - spin * ALONG
    scale = max(abs(inner), abs(outer)) * 0.03
    for angle, ring in ((CONE, inner), (CUP, outer)):
        for reach in (0.105, 0.114):
            point = reach * line(angle)
            np.testing.assert_allclose(np.cross(roller, point), np.cross(ring * A, point), atol=1e-13 * scale)
    # the same as finite rotations: orbit of the roller after its spin, over 1e-7 rad; what is left is of second order
    time = 1e-7 / max(abs(inner), abs(outer))
    turned = Rotation.from_rotvec(orbit * time * A) * Rotation.from_rotvec(-spin * time * ALONG)
    point = 0.11 * line(CONE)
    moved = Rotation.from_rotvec(inner * time * A).apply(point) - turned.apply(point)
    assert np.linalg.norm(moved) < 1e-4 * 1e-7 * np.linalg.norm(point @ R)
    rib = rib_motion(geometry, motion.spin_speed)
    end, on_rib = (np.cross(speed - orbit * A, AT_RIB) @ T for speed in (roller, inner * A))
    np.testing.assert_allclose(rib.sliding_speed, on_rib - end, rtol=1e-12, atol=1e-13 * scale)
    np.testing.assert_allclose(rib.mean_speed, 0.5 * (on_rib + end), rtol=1e-12, atol=1e-13 * scale)
    np.testing.assert_allclose(rib.spin, (inner * A - roller) @ NORMAL, rtol=1e-12, atol=1e-13 * scale)
    np.testing.assert_allclose(geometry.flange_radius, AT_RIB @ R, rtol=1e-13)


@pytest.mark.parametrize("name", SPEEDS)
def test_balances_in_space_and_energy(name, friction):
    """Forces and moments on every roller as vectors in space, about the middle of its axis, with the constraint forces
    put at two places of each line; and the power of the rings against the sum of all dissipations."""
    load, rib_load = some_loads()
    found, _ = friction(*SPEEDS[name], load, rib_load)
    balance, races, rib = found.balance, found.races, found.rib.traction
    reach = DIAMETER / 2 / np.sin(HALF) - LENGTH / 2
    middle = -float(TaperedGeometry(**G1).pitch_diameter) / 2 / np.sin(AXIS) * ALONG
    lean = np.asarray(races.radius)[:, 0] / (reach * np.tan(HALF)) - 0.5
    drag = float(found.drag_force)
    torque = np.zeros(2)
    for j in range(17):
        force, moment = -drag * T, np.zeros(3)
        for k, (angle, sign) in enumerate(((CONE, 1.0), (CUP, -1.0))):
            rolling, arm = float(races.rolling[k, j]), float(balance.arms[k, j])
            total = float(balance.traction[k, j]) + sign * rolling * lean[k]
            # two forces with this sum and this moment about the apex
            near, far = reach - LENGTH / 2, reach + LENGTH / 2
            first = (total * far - arm) / (far - near)
            for size, distance in ((first, near), (total - first, far)):
                point = distance * line(angle)
                force, moment = force + size * T, moment + np.cross(point - middle, size * T)
                torque[k] += np.cross(point, size * T) @ A
            couple = -rolling * float(races.radius[k, 0]) * line(angle)
            moment, torque[k] = moment + couple, torque[k] + couple @ A
        sheared, about = float(rib.rolling[j]) * T, float(rib.moment[j]) * NORMAL
        force, moment = force + sheared, moment + np.cross(AT_RIB - middle, sheared) + about
        torque[0] += np.cross(AT_RIB, sheared) @ A + about @ A
        scale = 1.0 + np.abs(balance.traction[:, j]).sum()
        np.testing.assert_allclose(force, 0.0, atol=1e-12 * scale)
        np.testing.assert_allclose(moment, 0.0, atol=1e-12 * scale * 0.1)
    np.testing.assert_allclose((found.totals.inner_torque, found.totals.outer_torque), torque, rtol=1e-10)
    inner, outer = (speed * RPM for speed in SPEEDS[name])
    parts = inner * float(found.totals.inner_torque), outer * float(found.totals.outer_torque)
    size = np.abs(parts).sum()
    np.testing.assert_allclose(sum(parts), found.totals.power_loss.total, rtol=1e-12, atol=1e-13 * size)
    entries = [found.totals.power_loss.rolling_resistance, found.totals.power_loss.flange, found.totals.power_loss.drag]
    np.testing.assert_allclose(sum(entries), found.totals.power_loss.total, rtol=1e-14)
    assert all(entry > 0 for entry in entries)


def test_the_rolling_resistance_alone_in_closed_form(friction):
    """The power is (P_i + P_o) u, with the speed of the raceways against the line of contact."""
    load, _ = some_loads()
    found, motion = friction(3000.0, 0.0, load, jnp.zeros(17))
    assert found.totals.power_loss.flange == 0.0
    assert np.all(np.isnan(found.rib.film))
    speed = float(motion.spin_speed) * (DIAMETER / 2 - LENGTH / 2 * np.sin(HALF))
    np.testing.assert_allclose(
        found.totals.power_loss.rolling_resistance, speed * np.sum(found.races.rolling), rtol=1e-13
    )
    np.testing.assert_allclose(found.races.speed, speed, rtol=1e-13)


def test_nothing_touches_and_nothing_turns(friction):
    none = friction(3000.0, 0.0, jnp.zeros((2, 17)), jnp.zeros(17))[0]
    assert np.all(np.isnan(none.races.film))
    np.testing.assert_allclose(none.totals.power_loss.total, none.totals.power_loss.drag, rtol=1e-15)
    still = friction(0.0, 0.0, *some_loads())[0]
    assert still.totals.power_loss.total == 0.0
    assert (still.totals.inner_torque, still.totals.outer_torque) == (0.0, 0.0)


def test_backwards_is_the_same(friction):
    forth, back = (friction(sign * 3000.0, sign * 500.0, *some_loads())[0] for sign in (1.0, -1.0))
    np.testing.assert_allclose(back.totals.power_loss.total, forth.totals.power_loss.total, rtol=1e-12)
    np.testing.assert_allclose(back.totals.inner_torque, -forth.totals.inner_torque, rtol=1e-12)
    np.testing.assert_allclose(back.races.film, forth.races.film, rtol=1e-12)


@pytest.fixture(scope="module")
def solver(scene):
    def solve(axial_load=5e3, radial_load=10e3, rpm=3000.0):
        changed = scene.at_operation(axial_load=axial_load, radial_load=radial_load, inner_speed=rpm * RPM)
        return jb.solve(changed, throw=False)

    return solve


@pytest.mark.slow
def test_solution_closes_and_has_the_size_of_the_catalogue_formula(solver):
    """Palmgren's M0 + M1 (f0 = 4, f1 = 4e-4, P1 = 0.8 Fa cot(alpha) as in Harris): an order of magnitude, no more."""
    found = solver()
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-12)
    np.testing.assert_allclose(found.elements.load_inner[0], 2452.596, rtol=3e-7)  # friction does not change loads
    diameter, viscosity = 46.0, 7.3  # mm, cSt at 80 degC
    no_load = 4e-7 * (viscosity * 3000.0) ** (2 / 3) * diameter**3
    load = 4e-4 * 0.8 * 5e3 / np.tan(CUP) * diameter
    assert 0.3 < float(found.inner_torque) / (1e-3 * (no_load + load)) < 3.0
    assert found.warnings == []


def test_idle_rollers_have_no_film(solver):
    """At rest and partly loaded, some rollers touch nothing; their film is not a number, their load not -0."""
    found = solver(axial_load=3e3)
    e = found.elements
    idle = e.load_inner == 0.0
    assert 0 < np.sum(idle) < 17
    assert np.all(np.isnan(e.film_inner) == idle)
    assert not np.any(np.signbit(np.stack([e.load_inner, e.load_outer, e.load_flange])))
    assert np.all(np.isnan(e.traction_inner) == idle)
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-12)


def test_warnings(solver):
    said = lambda **operation: " ".join(
        text for text, broken in solver(**operation).range_checks.items() if bool(np.asarray(broken))
    )
    assert "skid" in said(axial_load=500.0, radial_load=100.0, rpm=10000.0)
    assert "skid" not in said()
    assert "100 rpm" in said(rpm=50.0)


@pytest.mark.slow
def test_large_tilts_are_said():
    found = jb.solve(tapered(8e3, 6e3, 3000, misalignment=11e-3), throw=False)
    assert bool(found.converged)
    assert any("10 mrad" in text for text in found.warnings)


@pytest.mark.slow
def test_gradients_and_batches(scene):
    """Of the losses through the solve, for all rollers loaded and for some."""

    def measured(numbers):
        changed = scene.at_operation(axial_load=numbers[0], inner_speed=numbers[1], oil_temperature=numbers[2])
        changed = changed.replace_geometry(end_radius=numbers[3])
        options = jb.NewtonOptions(residual_tolerance=1e-13, step_tolerance=1e-11)
        found = jb.solve(changed, throw=False, options=options)
        results = jnp.stack([found.power_loss.total, found.inner_torque, found.power_loss.flange])
        return results, results

    both = jax.jit(jax.jacfwd(measured, has_aux=True))
    value, slope = lambda point: both(point)[1], lambda point: both(point)[0]
    points = [[5e3, 314.0, 353.0, 108e-3], [3e3, 314.0, 353.0, 108e-3]]
    for point in map(jnp.asarray, points):
        found = slope(point)
        for i in range(4):
            step = 1e-3 * point[i]
            near, far = (value(point.at[i].add(k * step)) - value(point.at[i].add(-k * step)) for k in (1, 2))
            central = (8.0 * near - far) / (12.0 * step)
            np.testing.assert_allclose(found[:, i], central, rtol=1e-6, atol=1e-7 * float(jnp.max(jnp.abs(central))))
    still = jnp.asarray([3e3, 0.0, 353.0, 108e-3])
    assert np.all(np.isfinite(slope(still)))
    assert np.all(np.isfinite(jax.jit(jax.jacrev(measured, has_aux=True))(still)[0]))
    batch = jax.jit(jax.vmap(lambda point: measured(point)[0]))(jnp.asarray(points))
    np.testing.assert_allclose(batch, np.stack([value(jnp.asarray(p)) for p in points]), rtol=1e-10)
