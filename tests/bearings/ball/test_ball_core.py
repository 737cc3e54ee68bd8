"""Ball bearing without friction: check values, static load sharing, convergence, hard cases, stiffness, gradients."""

import functools
from types import SimpleNamespace

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.gyroscopic import CappedCouple, SharedCouple
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.materials import Material
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.solve import jit_solver

RPM = 2.0 * np.pi / 60.0
STEEL = Material(np.float64(207e9), np.float64(0.3), np.float64(7850.0))
T15 = BallGeometry(20, 153e-3, 20.638e-3, 0.5225, 0.51125, contact_angle=np.radians(30.0))
B218 = BallGeometry(16, 125.26e-3, 22.225e-3, 0.5232, 0.5232, contact_angle=np.radians(40.0))


def bearing(geometry, rpm, axial=None, radial=None, attitude="outer", couple=None, material=STEEL, **operation):
    return BallBearing(
        geometry=geometry,
        materials=BallMaterials(material, material),
        operation=BallOperation(rpm * RPM, axial_load=axial, radial_load=radial, **operation),
        kinematics=BallAttitude(attitude, couple),
    )


# Q_i, Q_o, alpha_i, alpha_o, beta_i, beta_o, omega_m, omega_R, F_C, delta_a
CHECKS = {
    "T15": (
        (T15, 12500, 40e3),
        {},
        (3302.154, 4101.234, 0.6506016, 0.5094053, 0.7418681, 0.4506237, 587.1704, 4874.031, 952.9305, 6.658603e-5),
    ),
    "shared": (
        (T15, 12500, 40e3),
        {"attitude": "inner", "couple": SharedCouple()},
        (3127.349, 3871.345, 0.648054, 0.5061536, 0.7390375, 0.4477248, 573.5876, 4885.86, 909.353, 6.415236e-5),
    ),
    "printed sign": (
        (T15, 12500, 40e3),
        {"attitude": "inner", "couple": SharedCouple(sign=-1.0)},
        (3491.863, 4273.26, 0.6496924, 0.5197811, 0.7408581, 0.4598765, 574.7803, 4878.747, 913.1389, 6.918508e-5),
    ),
    "outer share": (
        (T15, 12500, 40e3),
        {"couple": SharedCouple(0.0, 2.0)},
        (3245.621, 4044.11, 0.6639275, 0.4733742, 0.7566613, 0.4185259, 590.3099, 4909.046, 963.1482, 6.35191e-5),
    ),
    "capped": (
        (T15, 12500, 40e3),
        {"couple": CappedCouple()},
        (3198.611, 3988.179, 0.6517322, 0.501625, 0.7431241, 0.4436884, 587.613, 4879.683, 954.368, 6.491233e-5),
    ),
    "light": (
        (T15, 5000, 5e3),
        {},
        (447.6086, 579.0598, 0.5926049, 0.4464147, 0.6772325, 0.3945421, 233.7537, 1946.399, 151.0262, 1.625734e-5),
    ),
    "fast": (
        (T15, 20000, 50e3),
        {},
        (3868.933, 6028.874, 0.7025592, 0.4275814, 0.7994194, 0.3778031, 957.3765, 7978.588, 2533.368, 7.146788e-5),
    ),
    "218 static": (
        (B218, 0, 17.8e3),
        {},
        (1679.016, 1679.017, 0.7242719, 0.7242715, None, None, 0.0, 0.0, 0.0, 3.598691e-5),
    ),
    "218": (
        (B218, 5000, 17.8e3),
        {},
        (1627.266, 1737.475, 0.7527689, 0.6948849, 0.891224, 0.5952341, 228.0903, 1468.001, 147.0255, 3.535287e-5),
    ),
    "218 fast": (
        (B218, 12000, 17.8e3),
        {},
        (1445.834, 2160.553, 0.8779825, 0.540908, 1.030757, 0.4617734, 573.243, 3733.888, 928.654, 1.472622e-5),
    ),
}


def equations(scene):
    """The solved equations alone: whether they converged, the displacement of the ring, the balls, and the attitudes of
    inner and outer race control."""
    system, found = newton_solve(build_core(scene).started()[0])
    balls, motion = system.at(found.point), system.kinematics
    controls = motion.inner_control(balls.angle[0]), motion.outer_control(balls.angle[1])
    return found.converged, system.ring.displacement(found.point.globals), balls, controls


solved = jax.jit(equations)


def results(scene):
    """The same of a whole solve, which has them for every ball."""
    solution = jb.solve(scene)
    e = solution.elements
    assert e.load_inner.shape == e.load_outer.shape == (scene.geometry.n_balls,)
    motion = SimpleNamespace(orbital_speed=e.orbital_speed, spin_speed=e.spin_speed, attitude=e.attitude_angle)
    load, angle = (e.load_inner, e.load_outer), np.stack([e.contact_angle_inner, e.contact_angle_outer])
    balls = SimpleNamespace(load=load, angle=angle, motion=motion)
    return solution.converged, solution.ring, balls, (e.control_angle_inner, e.control_angle_outer)


WHOLE = ("T15", "light", "fast", "shared", "capped")
"""Three of one structure, that of the tests below, and one of each law of the couple."""


@pytest.mark.parametrize("name", CHECKS)
def test_check_values(name):
    arguments, options, (q_i, q_o, a_i, a_o, b_i, b_o, orbit, spin, force, shift) = CHECKS[name]
    scene = bearing(*arguments, **options)
    converged, ring, balls, controls = (results if name in WHOLE else solved)(scene)
    geometry, motion = scene.geometry, balls.motion
    assert bool(converged)

    def close(found, *printed, rtol=1.5e-6):
        for one, expected in zip(found, printed, strict=True):
            np.testing.assert_allclose(one, expected, rtol=rtol, atol=1e-9)

    close(balls.load, q_i, q_o)
    close(balls.angle, a_i, a_o)
    close((motion.orbital_speed, motion.spin_speed, ring.axial), orbit, spin, shift)
    if b_i is not None:
        close(controls, b_i, b_o, rtol=1e-6)
        close([motion.attitude], b_i if options.get("attitude") == "inner" else b_o, rtol=1e-6)
    found = 0.5 * geometry.mass(7850.0) * geometry.pitch_diameter * motion.orbital_speed**2
    np.testing.assert_allclose(found, force, rtol=2e-6, atol=1.1e-3)  # the printed ones hold 1 mN more


def test_sign_and_friction_of_the_capped_couple():
    """The couple of the printed sign turns the outer contact the other way; without friction there is none."""
    angle = lambda couple: float(solved(bearing(T15, 12500, 40e3, couple=couple))[2].angle[1, 0])
    without = float(results(bearing(T15, 12500, 40e3))[2].angle[1, 0])
    with_, printed = angle(CappedCouple()), angle(CappedCouple(sign=-1.0))
    assert with_ < without < printed
    np.testing.assert_allclose(angle(CappedCouple(1e-9)), without, rtol=1e-8)


def test_combined_load():
    solution = jb.solve(bearing(T15, 10000, 20e3, 8e3))
    np.testing.assert_allclose(solution.ring.axial, 4.0573248e-5, rtol=1e-6)
    np.testing.assert_allclose(solution.ring.radial, 1.2507175e-5, rtol=1e-6)
    np.testing.assert_allclose(
        solution.elements.load_inner[jnp.array([0, 5, 10])], [2764.9817, 1601.4255, 882.49571], rtol=1e-7
    )
    np.testing.assert_allclose(
        solution.elements.load_outer[jnp.array([0, 5, 10])], [3279.4878, 2125.2229, 1430.2197], rtol=1e-7
    )


ISO = BallGeometry(7, 43.5e-3, 11.5e-3, 0.52, 0.53, diametral_clearance=0.0)


def test_the_couple_carries_a_part_of_the_thrust():
    """At the inner race it pushes the balls in the direction of the thrust, as Euler's equation says, so that the
    normal loads carry less of it."""
    _, _, balls, _ = solved(bearing(T15, 12500, 40e3, couple=SharedCouple()))
    motion, load, angle = balls.motion, balls.load[0], balls.angle[0]
    couple = T15.inertia(7850.0) * motion.spin_speed * motion.orbital_speed * np.sin(motion.attitude)
    friction = 20 * couple / T15.ball_diameter * np.cos(angle)
    assert friction > 0.01 * 40e3
    np.testing.assert_allclose(20 * load * np.sin(angle), 40e3 - friction, rtol=1e-9)


@jax.jit
@functools.partial(jax.value_and_grad, has_aux=True)
def equations_and_slopes(scene):
    converged, ring, balls, _ = equations(scene)
    return balls.load[1].sum() + balls.angle[0].sum() + ring.axial, (converged, ring)


def test_iso_16281_load_sharing():
    """Without inertia, 7 balls: radial 1000 N and axial 1000 N; asked: 0.1 %."""
    steel = Material(np.float64(2.10e11), np.float64(0.3), np.float64(7850.0))
    ring = lambda **loads: equations_and_slopes(bearing(ISO, 0.0, material=steel, **loads))[0][1][1]
    np.testing.assert_allclose(ring(axial=0.0, radial=1000.0).radial, 15.110e-6, rtol=1e-3)
    np.testing.assert_allclose(ring(axial=1000.0, radial=0.0).axial, 133.54e-6, rtol=1e-3)


def test_one_ball_for_all_is_all():
    one, all_ = jb.solve(bearing(T15, 12500, 40e3)), jb.solve(bearing(T15, 12500, 40e3, 0.0))
    np.testing.assert_allclose(one.elements.load_inner, all_.elements.load_inner, rtol=1e-9)
    np.testing.assert_allclose(one.stiffness, all_.stiffness, rtol=1e-7, atol=1e-9 * float(one.stiffness[0, 0]))
    assert (one.unknowns, all_.unknowns) == (3, 42)


@pytest.mark.slow
def test_stiffness_is_symmetric_and_that_of_the_solve():
    """Of the static bearing, whose load is conservative, and against differences of the load-displacement solve."""
    scene = bearing(T15, 0.0, 20e3, 8e3, moment=0.0)
    stiffness = np.asarray(jb.solve(scene).stiffness)
    size = np.sqrt(np.outer(np.diag(stiffness), np.diag(stiffness)))
    assert np.max(np.abs(stiffness - stiffness.T) / size) < 1e-8
    turning = bearing(T15, 10000, 20e3, 8e3, moment=0.0)
    stiffness = np.asarray(jb.solve(turning).stiffness)[np.ix_([0, 1, 3], [0, 1, 3])]
    fast = jit_solver(turning)
    names, steps = ("axial_load", "radial_load", "moment"), (2.0, 2.0, 0.1)
    base = {"axial_load": 20e3, "radial_load": 8e3, "moment": 0.0}
    compliance = []
    for name, step in zip(names, steps, strict=True):
        ends = [fast(**(base | {name: base[name] + sign * step})).ring for sign in (1.0, -1.0)]
        difference = [(getattr(ends[0], f) - getattr(ends[1], f)) / (2.0 * step) for f in ("axial", "radial", "tilt")]
        compliance.append([float(d) for d in difference])
    np.testing.assert_allclose(np.linalg.inv(np.array(compliance).T), stiffness, rtol=1e-5, atol=1e-6 * stiffness[0, 0])


HARD = {
    "at rest": bearing(T15, 0.0, 1000.0, 500.0),
    "radial with clearance": bearing(
        BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=2e-5), 6000, radial=1500.0
    ),
    "overspeed": bearing(T15, 40000, 100.0, 0.0),
    "one ball loaded": bearing(
        BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=1e-4), 0.0, radial=20.0
    ),
    "three balls": bearing(BallGeometry(3, 153e-3, 20.638e-3, 0.5225, 0.51125, contact_angle=0.5), 5000, 2e3, 300.0),
    "hundred balls": bearing(BallGeometry(100, 700e-3, 20.638e-3, 0.5225, 0.51125, contact_angle=0.5), 2000, 2e4, 5e3),
    "backwards": bearing(T15, -12500, -40e3, 0.0),
    "both rings": bearing(T15, 12500, 40e3, 0.0, outer_speed=-3000 * RPM),
    "steep, radial": bearing(B218, 5000, 0.0, 5000.0),
    "steep, radial, nearly no thrust": bearing(B218, 5000, 1.0, -20000.0),
    "light and fast": bearing(
        BallGeometry(20, 167.54e-3, 22.225e-3, 0.52, 0.515, contact_angle=np.radians(27.0)), 20000, 200.0, 0.0
    ),
}
HARD |= {
    f"{name}, one ball for all": HARD[name].replace({"operation.radial_load": None})
    for name in ("overspeed", "backwards", "both rings", "light and fast")
}
LONG = ("steep, radial", "steep, radial, nearly no thrust", "radial with clearance", "one ball loaded")
LONG += ("three balls", "hundred balls")


@jax.jit
@functools.partial(jax.value_and_grad, has_aux=True)
def results_and_slopes(scene):
    solution = jb.solve(scene, throw=False)
    found = solution.elements.load_outer.sum() + solution.elements.contact_angle_inner.sum() + solution.ring.axial
    return found, solution.converged


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in HARD])
def test_hard_cases_have_finite_results_and_derivatives(name):
    (value, converged), slopes = results_and_slopes(HARD[name])
    assert bool(converged)
    assert np.isfinite(value)
    for leaf in jax.tree.leaves(slopes):
        assert np.all(np.isfinite(leaf))


def test_contact_angle_0_has_finite_results_and_derivatives():
    (value, (converged, _)), slopes = equations_and_slopes(bearing(ISO, 3000.0, 0.0, 1000.0))
    assert bool(converged)
    assert np.isfinite(value)
    for leaf in jax.tree.leaves(slopes):
        assert np.all(np.isfinite(leaf))


def test_balances():
    """Loads of a ring that does not tilt from the balls' loads, to round-off; `test_ball_tilt` has the tilted one."""
    solution = jb.solve(bearing(T15, 10000, 20e3, 8e3))
    e = solution.elements
    axial, radial = e.load_inner * jnp.sin(e.contact_angle_inner), e.load_inner * jnp.cos(e.contact_angle_inner)
    np.testing.assert_allclose(jnp.sum(axial), 20e3, rtol=1e-9)
    np.testing.assert_allclose(jnp.sum(radial * jnp.cos(e.azimuth)), 8e3, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    "couple", [None, CappedCouple(), CappedCouple(sign=-1.0)], ids=["off", "capped", "printed sign"]
)
@pytest.mark.parametrize("kind", ["axial", "combined", "moment", "deep groove"])
def test_random_bearings_converge(kind, couple, request):
    if kind == "combined":
        request.getfixturevalue("optimized")  # as users run it; the others quickly compiled
    rng = np.random.default_rng(5)
    n = 300
    logs = lambda a, b: jnp.asarray(np.exp(rng.uniform(np.log(a), np.log(b), n)))
    axial = logs(500.0, 5e4)
    numbers = {"inner_speed": jnp.asarray(rng.uniform(0.0, 20000.0, n)) * RPM, "axial_load": axial}
    groove = BallGeometry(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=2e-5)
    if kind == "axial":
        scene = bearing(T15, 1.0, 1.0, couple=couple)
        numbers = {"inner_speed": jnp.asarray(rng.uniform(0.0, 40000.0, n)) * RPM, "axial_load": logs(1.0, 1e5)}
    elif kind == "deep groove":
        scene = bearing(groove, 1.0, 1.0, 1.0, couple=couple)
        numbers = {"inner_speed": jnp.asarray(rng.uniform(0.0, 30000.0, n)) * RPM}
        numbers |= {
            "axial_load": logs(1.0, 5e3) * (rng.uniform(size=n) > 0.3).astype(float),
            "radial_load": logs(10.0, 7e3),
        }
    else:
        extra = {"moment": 0.0} if kind == "moment" else {"misalignment": 0.0}
        scene = bearing(T15, 1.0, 1.0, 1.0, couple=couple, **extra)
        numbers["radial_load"] = axial * rng.uniform(0.0, 1.5, n)
        if kind == "moment":
            numbers["moment"] = 0.03 * axial * rng.uniform(-1.0, 1.0, n)
        else:
            numbers["misalignment"] = jnp.asarray(rng.uniform(-1e-3, 1e-3, n))
    solve = jax.jit(lambda x: jax.lax.map(lambda o: jb.solve(scene.at_operation(**o), throw=False), x))
    solution = solve(numbers)
    assert np.all(np.asarray(solution.converged))
    # of both phases; asked: 8 without the couple
    assert np.median(np.asarray(solution.iterations)) <= (8 if couple is None else 9)
    assert np.all(np.isfinite(np.asarray(solution.stiffness)))


def test_bad_bearings_are_refused():
    with pytest.raises(ValueError, match="one of the two"):
        BallGeometry(20, 153e-3, 20.638e-3, 0.5225, 0.51125)
    with pytest.raises(ValueError, match=r"above 0\.5 and at most 1"):
        BallGeometry(20, 153e-3, 20.638e-3, 0.5, 0.51125, contact_angle=0.5)
    with pytest.raises(ValueError, match="do not fit"):
        BallGeometry(30, 153e-3, 20.638e-3, 0.5225, 0.51125, contact_angle=0.5)
    with pytest.raises(ValueError, match="needs an axial_load"):
        BallOperation(100.0)
    with pytest.raises(ValueError, match="needs traction"):
        bearing(T15, 1000, 1e3, attitude="equilibrium")


def test_forces_of_motion_are_results():
    """The printed centrifugal force closes a ball's balance; the couple is that of spin and orbit; beta lies between
    the attitudes of both races' control."""
    scene = bearing(T15, 10000, 20e3, 8e3)
    elements = jb.solve(scene).elements
    inner, outer = elements.load_inner, elements.load_outer
    open_ = inner * jnp.cos(elements.contact_angle_inner) - outer * jnp.cos(elements.contact_angle_outer)
    # loose balls are held by 1 mN
    np.testing.assert_allclose(open_ + elements.centrifugal_force, 0.0, atol=2e-3)
    geometry, density = scene.geometry, scene.materials.balls.density
    spin = elements.spin_speed * elements.orbital_speed * jnp.sin(elements.attitude_angle)
    np.testing.assert_allclose(elements.gyroscopic_couple, geometry.inertia(density) * spin, rtol=1e-12)
    np.testing.assert_allclose(elements.attitude_angle, elements.control_angle_outer, rtol=1e-12)
    assert np.all(elements.control_angle_inner > elements.control_angle_outer)


def asymmetry(solution):
    stiffness = np.asarray(solution.stiffness)
    size = np.sqrt(np.outer(np.diag(stiffness), np.diag(stiffness)))
    return np.max(np.abs(stiffness - stiffness.T) / size)


def test_stiffness_is_symmetric_at_speed_where_the_load_is_conservative():
    """Rings that turn alike carry the balls round with them at any contact angle: the centrifugal force is constant.
    Where only one turns, the force follows the contact angles by the rolling of the balls, and has no potential."""
    both = jb.solve(bearing(T15, 10000.0, 20e3, 8e3, outer_speed=10000.0 * RPM))
    np.testing.assert_allclose(both.elements.orbital_speed, 10000.0 * RPM, rtol=1e-12)
    assert asymmetry(both) < 1e-8
    assert asymmetry(jb.solve(bearing(T15, 10000.0, 20e3, 8e3))) > 1e-4


# -- one orbital speed for all

COMMON = {"kinematics.orbit": "common"}


def rolling(films, axial, radial):
    if not films:
        return bearing(T15, 12500, axial, radial)
    parts = {"contact.traction": None, "cage": None, "drag": None, "kinematics.attitude": "outer"}
    loads = {"operation.axial_load": axial, "operation.radial_load": radial}
    return jb.load_scene("turbine_ball").replace(parts | loads)


@pytest.mark.parametrize(
    ("films", "radial"),
    [(False, 0.0), (False, None), pytest.param(True, None, marks=pytest.mark.slow)],
    ids=["dry", "dry, one ball for all", "films, one ball for all"],
)
def test_common_orbit_under_axial_load_changes_nothing(films, radial):
    scene = rolling(films, 40e3, radial)
    own, common = jb.solve(scene), jb.solve(scene.replace(COMMON))
    assert common.unknowns == own.unknowns + 1
    for name in ("load_inner", "load_outer", "contact_angle_outer", "orbital_speed", "spin_speed"):
        np.testing.assert_allclose(getattr(common.elements, name), getattr(own.elements, name), rtol=1e-10)
    np.testing.assert_allclose(common.ring.axial, own.ring.axial, rtol=1e-10)
    np.testing.assert_allclose(common.stiffness[0, 0], own.stiffness[0, 0], rtol=1e-9)
    if films:  # rolling resistance: by virtual work, and by the forces on each ball
        np.testing.assert_allclose(common.inner_torque, own.inner_torque, rtol=1e-9)
        np.testing.assert_allclose(common.outer_torque, own.outer_torque, rtol=1e-9)


@jax.jit
def own_orbits(scene, inner, outer):
    kinematics = build_core(scene).kinematics
    return kinematics.rolling(inner, outer, kinematics.outer_control(outer)).orbital_speed


@pytest.mark.parametrize("films", [False, pytest.param(True, marks=pytest.mark.slow)], ids=["dry", "films"])
def test_common_orbit_under_combined_load(films):
    scene = rolling(films, 20e3, 8e3)
    own, common = jb.solve(scene), jb.solve(scene.replace(COMMON))
    e = common.elements
    assert np.ptp(e.orbital_speed) == 0.0
    assert np.ptp(own.elements.orbital_speed) > 1.0
    # the weighted mean of the balls' own speeds, from the loads and angles of the result
    inner, outer = e.contact_angle_inner, e.contact_angle_outer
    speeds = own_orbits(scene, inner, outer)
    weights = e.load_inner + 1e-3
    np.testing.assert_allclose(jnp.sum(weights * speeds) / jnp.sum(weights), e.orbital_speed[0], rtol=1e-9)
    change = np.abs(np.asarray(e.load_outer / own.elements.load_outer - 1.0))
    assert 5e-3 < np.max(change) < 0.08  # centrifugal forces move by a few per cent
    np.testing.assert_allclose(jnp.sum(e.load_inner * jnp.sin(inner)), 20e3, rtol=1e-9)
    np.testing.assert_allclose(jnp.sum(e.load_inner * jnp.cos(inner) * jnp.cos(e.azimuth)), 8e3, rtol=1e-9)
    assert any("kinematics.orbit" in note for note in common.notes)
    if films:
        for found in (own, common):
            np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-9)
            assert found.power_loss.total == found.power_loss.rolling_resistance
        np.testing.assert_allclose(common.power_loss.total, own.power_loss.total, rtol=0.01)
