"""Tapered rollers that may skid: balances against vectors in space, energy, the limit of strong traction, the mirror
image, derivatives, random scenes, parts of a scene."""

import dataclasses
import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tapered_cases import G1

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.kinematics import RollerKinematics
from jaxbearing.bearings.tapered.build import build_tapered, roller_body
from jaxbearing.bearings.tapered.friction import tapered_friction
from jaxbearing.bearings.tapered.geometry import TaperedCage, TaperedGeometry
from jaxbearing.bearings.tapered.skidding import build_skidding, skidding_friction
from jaxbearing.numerics.newton import NewtonOptions, newton_solve

CUP, HALF, FLANGE, SPHERE = (G1[name] for name in ("contact_angle", "roller_half_angle", "flange_angle", "end_radius"))
CONE, AXIS = CUP - 2 * HALF, CUP - HALF
DIAMETER, LENGTH = G1["roller_diameter"], G1["roller_length"]
REACH = DIAMETER / 2 / np.sin(HALF) - LENGTH / 2
A, R, T = np.eye(3)
ALONG, ACROSS = np.cos(AXIS) * A - np.sin(AXIS) * R, np.sin(AXIS) * A + np.cos(AXIS) * R
NORMAL = np.cos(FLANGE) * A - np.sin(FLANGE) * R
AT_RIB = (SPHERE * np.sqrt(1 - (DIAMETER / 2 / SPHERE) ** 2) - DIAMETER / 2 / np.tan(HALF)) * ALONG - SPHERE * NORMAL
MIDDLE = -REACH * np.cos(HALF) * ALONG
BODY = roller_body(TaperedGeometry(**G1), jnp.asarray(7850.0))
CAGE = TaperedCage(guidance="inner_ring", guiding_clearance=3e-4, pocket_clearance=3e-4, land_width=2e-3)


def line(angle):
    """Unit vector from the apex along a line of contact."""
    return np.sin(angle) * R - np.cos(angle) * A


@pytest.fixture(scope="module")
def scene():
    return dataclasses.replace(jb.load_scene("tapered_example", {"rating": "none"}), cage=CAGE)


@pytest.fixture(scope="module")
def solved(scene):
    """Solutions by changed numbers of the operating point: result of Newton, rollers, friction, land, and the friction
    of the same rollers without skidding."""

    @jax.jit
    def solution_of(scene):
        asked = build_tapered(scene)
        # rolling rollers would push the cone out in the fast case
        start = dataclasses.replace(asked, inertia=asked.inertia.times(0.3))
        dry, _ = start.started(jnp.asarray(False))
        system, result = newton_solve(build_skidding(scene, dry, jnp.ones(())), NewtonOptions())
        state = system.at(result.point)
        land = system.land_at(result.point, state)
        rolling = tapered_friction(scene, state.pressed.contacts)
        return result, state, skidding_friction(system, result, state), land, rolling

    at = lambda changes: {name: np.float64(value) for name, value in changes.items()}
    return functools.cache(lambda **changes: solution_of(scene.at_operation(**at(changes))))


CASES = {
    "heavy and light rollers": {},
    "cone backwards": {"inner_speed": -300.0},
    "cup": {"inner_speed": 0.0, "outer_speed": 200.0},
    "fast, lightly loaded": {"inner_speed": 1500.0, "axial_load": 120.0, "radial_load": 50.0},
}


def test_speeds_of_mid_length_are_those_of_cones():
    pitch, roller = REACH * np.cos(HALF) * np.sin(AXIS), REACH * np.sin(HALF)
    cosines = jnp.cos(AXIS), jnp.cos(HALF)
    motion = RollerKinematics(*map(jnp.asarray, (300.0, -50.0, pitch, roller)), *cosines)
    np.testing.assert_allclose(motion.inner_radius, REACH * np.sin(CONE), rtol=1e-14)
    np.testing.assert_allclose(motion.outer_radius, REACH * np.sin(CUP), rtol=1e-14)
    changes = jnp.asarray(3.0), jnp.asarray(-7.0)
    mean, sliding = motion.surface_speeds(*changes)
    orbit, spin = motion.free_orbit + changes[0], motion.free_spin + changes[1]
    for k, (angle, ring, sense) in enumerate(((CONE, 300.0, 1.0), (CUP, -50.0, -1.0))):
        point = REACH * line(angle)
        on_ring, on_roller = (
            float(np.cross(speed, point) @ T) for speed in ((ring - orbit) * A, -np.asarray(spin) * ALONG)
        )
        np.testing.assert_allclose(sense * (on_ring - on_roller), sliding[k], rtol=1e-12)
        np.testing.assert_allclose(sense * 0.5 * (on_ring + on_roller), mean[k], rtol=1e-12)


@pytest.mark.parametrize("name", CASES)
def test_balances_in_space_and_energy(name, solved):
    """Moments about the apex of all forces on every roller, and on the cage, as vectors in space; the power of the
    rings against the sum of the powers of all forces at their own speeds."""
    result, state, friction, land, _ = solved(**CASES[name])
    assert result.converged
    races, rib, pocket = friction.races, friction.rib.traction, friction.pocket
    roller = REACH * np.sin(HALF)
    drag, torque, on_cage = np.asarray(friction.drag_force), np.zeros(2), np.zeros(17)
    cage_force = np.zeros(2)
    for j in range(17):
        moment = np.cross(MIDDLE, -drag[j] * T)
        size = 0.0
        for k, (angle, sign) in enumerate(((CONE, 1.0), (CUP, -1.0))):
            point, rolling = REACH * line(angle), float(races.rolling[k, j])
            radius = float(races.radius[k, 0])
            # traction, shear of the film, and the displaced pressure, which acts through the roller axis
            force = float(friction.balance.traction[k, j]) + sign * rolling * (radius / (REACH * np.tan(HALF)) - 0.5)
            here = np.cross(point, force * T) - rolling * radius * line(angle)
            moment, torque[k], size = moment + here, torque[k] + here @ A, size + np.linalg.norm(here)
        of_rib = np.cross(AT_RIB, float(rib.rolling[j]) * T) + float(rib.moment[j]) * NORMAL
        moment, torque[0] = moment + of_rib, torque[0] + of_rib @ A
        net = float(pocket.load_front[j] - pocket.load_rear[j])
        rubbing = float(pocket.friction_front[j] + pocket.friction_rear[j])
        of_pocket = np.cross(MIDDLE, -net * T) + rubbing * roller * ALONG
        on_cage[j] = -of_pocket @ A
        # forward in front and outward by what both walls rub: t = (-cos, -sin), n = (-sin, cos) in (X, Y)
        azimuth = 2.0 * np.pi * j / 17
        outward = float(pocket.friction_front[j] - pocket.friction_rear[j]) * np.cos(AXIS)
        cage_force += -net * np.array([np.cos(azimuth), np.sin(azimuth)])
        cage_force += outward * np.array([-np.sin(azimuth), np.cos(azimuth)])
        # along the roller axis, with the centrifugal force of its own orbit
        contacts, orbit = state.pressed.contacts, float(state.orbital_speed[j])
        centrifugal = float(BODY.mass) * orbit**2 * (DIAMETER / 2 / np.tan(HALF) - float(BODY.centre)) * np.sin(AXIS)
        loads = np.asarray([*state.load[:, j], contacts.flange_load[j], centrifugal])
        along = np.array([-np.sin(HALF), -np.sin(HALF), np.cos(AXIS - FLANGE), -np.sin(AXIS)])
        np.testing.assert_allclose(loads @ along, 0.0, atol=1e-9 * np.abs(loads).max())
        np.testing.assert_allclose(moment + of_pocket, 0.0, atol=1e-11 * size)
    np.testing.assert_allclose(on_cage.sum(), -land.cage_torque, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(cage_force, np.sum(state.cage_force, axis=1), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(friction.totals.inner_torque + land.ring_torque, torque[0], rtol=1e-9)
    np.testing.assert_allclose(friction.totals.outer_torque, torque[1], rtol=1e-9)
    losses = {name: float(value) for name, value in vars(friction.totals.power_loss).items() if value is not None}
    assert all(value > 0 for value in losses.values())
    np.testing.assert_allclose(friction.totals.drive_power, losses.pop("total"), rtol=1e-11)
    np.testing.assert_allclose(sum(losses.values()), friction.totals.drive_power, rtol=1e-11)


def test_light_rollers_skid_first(solved):
    _, state, friction, _, _ = solved()
    slide = np.abs(friction.races.sliding / friction.races.speed)[0]
    order = np.argsort(np.asarray(state.load[0]))
    assert np.all(np.diff(slide[order][::2]) < 0.0)
    assert slide[order[0]] > 0.1
    assert slide[order[-1]] < 1e-4


def test_the_cage_covers_a_part_of_the_rollers(solved):
    """Oil drag on the uncovered part of the rollers, at the speed of the cage."""
    _, _, friction, _, rolling = solved()
    pitch, diameter = 2.0 * REACH * np.cos(HALF) * np.sin(AXIS), 2.0 * REACH * np.sin(HALF)
    thickness = 0.5 * ((pitch + diameter / 3.0) - (pitch - diameter * 7.0 / 12.0))
    slower = np.square(1.0 - float(friction.cage.slip))
    np.testing.assert_allclose(friction.drag_force, rolling.drag_force * (1.0 - thickness / diameter) * slower)


def test_the_mirror_image_has_the_same_losses(solved):
    ahead, back = solved(inner_speed=300.0)[2], solved(**CASES["cone backwards"])[2]
    for name, value in vars(ahead.totals.power_loss).items():
        np.testing.assert_allclose(getattr(back.totals.power_loss, name), value, rtol=1e-9)
    np.testing.assert_allclose(back.races.sliding, -ahead.races.sliding, rtol=1e-6)
    np.testing.assert_allclose(back.cage.slip, ahead.cage.slip, rtol=1e-6)


def test_strong_traction_is_rolling_without_sliding(solved):
    """As the pressure grows, and with it the viscosity of the films, sliding vanishes, and rolling resistance and the
    losses of the rib are those of rollers that roll about the apex."""
    errors, slides = [], []
    for load in (1e3, 5e3, 25e3):
        _, _, friction, _, rolling = solved(axial_load=load, radial_load=0.0)
        free = [getattr(rolling.totals.power_loss, name) for name in ("rolling_resistance", "flange")]
        own = [getattr(friction.totals.power_loss, name) for name in ("rolling_resistance", "flange")]
        errors.append(np.max(np.abs(np.asarray(own) / np.asarray(free) - 1.0)))
        slides.append(np.max(np.abs(friction.races.sliding / friction.races.speed)))
        assert float(friction.totals.power_loss.inner_raceway) > 0.0
    assert errors[0] > 10.0 * errors[1] > 100.0 * errors[2]
    assert slides[0] > 10.0 * slides[1] > 100.0 * slides[2]


def test_the_cup_can_guide_the_cage(scene):
    guided = dataclasses.replace(scene, cage=dataclasses.replace(CAGE, guidance="outer_ring"))
    parts = build_skidding(guided, build_tapered(guided), jnp.ones(())).cage
    outside = guided.cage.outside(guided.geometry)
    assert (parts.guidance, float(parts.land.radius)) == ("outer_ring", pytest.approx(float(outside) / 2.0))


def test_a_file_has_the_cage_and_what_it_lacks_is_said(scene, tmp_path):
    jb.save_scene(scene, tmp_path / "caged.toml")
    assert jb.load_scene(tmp_path / "caged.toml") == scene
    assert any("cage.inner_diameter is not given" in note for note in scene.assumptions())
    frictionless = dataclasses.replace(scene, contact=dataclasses.replace(scene.contact, traction=None, mixed=None))
    assert (scene.slips, scene.unused_parts()) == (True, ())
    assert (frictionless.slips, frictionless.unused_parts()) == (False, ("cage",))
    wide = dataclasses.replace(CAGE, pocket_clearance=5e-3)
    with pytest.raises(ValueError, match=r"cage\.pocket_clearance must lie between"):
        dataclasses.replace(scene, cage=wide)


@pytest.mark.slow
def test_derivatives_of_a_skidding_bearing(scene):
    """Loss, cage slip, spin of a light roller and load of a pocket, by numbers of the scene, against differences."""
    names = ["operation.axial_load", "operation.inner_speed", "cage.pocket_clearance", "operation.oil_temperature"]
    start = jnp.asarray([5e3, 300.0, 3e-4, 350.0])

    def results(values):
        changed = scene.replace({name: values[k] for k, name in enumerate(names)})
        dry, _ = build_tapered(changed).started(jnp.asarray(False))
        system, result = newton_solve(build_skidding(changed, dry, jnp.ones(())), NewtonOptions())
        state = system.at(result.point)
        friction = skidding_friction(system, result, state)
        loss, pocket = friction.totals.power_loss.total, friction.pocket
        return jnp.stack([loss, friction.cage.slip, state.spin_speed[8], pocket.load_rear[3]])

    slopes = jax.jit(jax.jacfwd(results))(start)
    values = jax.jit(results)
    for k in range(len(names)):
        step = jnp.zeros(4).at[k].set(1e-4 * start[k])
        ends = [values(start + sign * step) for sign in (-2.0, -1.0, 1.0, 2.0)]
        difference = (ends[0] - 8.0 * ends[1] + 8.0 * ends[2] - ends[3]) / (12.0 * step[k])
        np.testing.assert_allclose(slopes[:, k], difference, rtol=1e-5)


@pytest.mark.slow
def test_random_and_lightly_loaded_bearings_with_a_cage(scene):
    """All converge but those whose axial load cannot hold the cone without centrifugal forces; the power balances.
    Light loads on fast bearings: rollers that roll would push the cone out, those that skid orbit at half the speed."""
    rng = np.random.default_rng(11)
    count = 40
    between = lambda low, high: np.exp(rng.uniform(np.log(low), np.log(high), count))
    axial = between(20.0, 5e4)
    values = {
        "axial_load": axial,
        "radial_load": axial / np.tan(CUP) * rng.uniform(0.0, 0.95, count),
        "inner_speed": between(2.0, 2500.0) * rng.choice([-1, 1], count),
        "outer_speed": np.where(rng.random(count) < 0.3, between(1.0, 1500.0), 0.0),
        "oil_temperature": rng.uniform(290.0, 420.0, count),
    }
    solve = jax.jit(lambda point: jb.solve(scene.at_operation(**point), throw=False))
    solutions = [solve({name: jnp.asarray(numbers[k]) for name, numbers in values.items()}) for k in range(count)]
    held = values["axial_load"] > values["radial_load"] * np.tan(CUP)
    expected = np.where(held, int(jb.Status.CONVERGED), int(jb.Status.NO_EQUILIBRIUM))
    np.testing.assert_array_equal([int(solution.status) for solution in solutions], expected)
    point = {"radial_load": 0.0, "outer_speed": 0.0, "oil_temperature": 353.0}
    for axial, speed, slip in ((120.0, 1500.0, 0.5), (1.0, 314.0, 0.6), (150.0, 2500.0, 0.6)):
        light = point | {"axial_load": axial, "inner_speed": speed}
        solutions.append(solve({name: jnp.asarray(number) for name, number in light.items()}))
        assert solutions[-1].converged
        assert abs(float(solutions[-1].cage.slip) - slip) < 0.1
    for solution in solutions:
        if solution.converged:
            np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-10)


STEEL = {"conductivity": "46 W/(m*K)", "heat_capacity": "460 J/(kg*K)"}
BOUNDARY = {"geometry.bore": "30 mm", "geometry.outside_diameter": "62 mm", "geometry.width": "17.25 mm"}
PARTS = {
    "tilt and flexible cup": {
        "operation.load_position": "-88 mm",
        "operation.moment": "240 N*m",
        "outer_ring.thickness": "4 mm",
        "outer_ring.housing_stiffness": "1e10 N/m^2",
    },
    "rough, starved, guided by the cup": {
        "contact.mixed.roughness": "0.2 um",
        "contact.mixed.slide_width": "1 mm/s",
        "contact.supply.level": "jet",
        "cage.guidance": "outer_ring",
    },
    "thermal network": BOUNDARY
    | {f"materials.{part}.{name}": value for part in ("rings", "rollers") for name, value in STEEL.items()}
    | {"oil.heat_capacity": "2150 J/(kg*K)", "thermal.ambient": "20 degC"},
    "held": {"operation.axial_load": "none", "operation.displacement.axial": "30 um"},
}


@pytest.mark.slow
@pytest.mark.parametrize("parts", PARTS)
def test_with_other_parts(parts):
    """The power balances, and the cage turns nearly as the rollers roll."""
    cage = {"guidance": "inner_ring", "guiding_clearance": "0.3 mm", "pocket_clearance": "0.3 mm", "land_width": "2 mm"}
    changes = {"rating": "none"} | {f"cage.{name}": value for name, value in cage.items()} | PARTS[parts]
    solution = jb.solve(jb.load_scene("tapered_example", changes))
    assert solution.converged
    np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-9)
    assert abs(float(solution.cage.slip)) < 0.05
    rubbed = solution.boundary_power
    assert (rubbed is not None and float(rubbed.inner_raceway) > 0.0) == ("rough" in parts)


@pytest.mark.slow
def test_on_a_shaft_it_is_the_bearing_alone(scene):
    at_port = scene.replace({"operation.load_position": np.float64(scene.middle_position)})
    alone = jb.solve(at_port)
    names = ("axial", "radial", "lateral", "tilt", "tilt_lateral")
    held = jb.reaction(at_port, jnp.stack([getattr(alone.ring, name) for name in names]))
    np.testing.assert_allclose(held.force, alone.force, rtol=1e-6, atol=1e-3)
    np.testing.assert_allclose(held.stiffness, alone.stiffness, rtol=1e-5, atol=1e-4 * np.max(np.abs(alone.stiffness)))
