"""Mounted bearings of all families: the maps from growth to play against the check tables of the sheet on the operating
state, part A9, and what a solve of a mounted bearing must keep."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from moving_roller import built

import jaxbearing as jb
from jaxbearing.bearings.ball.checks import missing_thrust
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.mounting import groove_bottoms, running_geometry, running_play
from jaxbearing.bearings.cylindrical.motion.results import RollerEnergy
from jaxbearing.bearings.cylindrical.mounting import running_play as roller_play
from jaxbearing.bearings.growth import Growth
from jaxbearing.bearings.motion.history import LastState
from jaxbearing.bearings.motion.run import check_fits, identity
from jaxbearing.bearings.motion.runs import run_checks
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.mounted import running_scene
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.bearings.tapered.build import build_tapered
from jaxbearing.bearings.tapered.mounting import closing
from jaxbearing.bearings.tapered.mounting import running_play as tapered_play
from jaxbearing.time_laws import LinearRamp

UM = 1e-6
STEEL, M50, NITRIDE = 12.5e-6, 12.3e-6, 3.2e-6
DEEP_GROOVE = BallGeometry(9, 0.0385, 0.007938, 0.515, 0.525, diametral_clearance=12e-6)
SEATS = {
    "contact": "none",
    "geometry.bore": "25 mm",
    "geometry.outside_diameter": "52 mm",
    "fits.shaft_interference": "10 um",
    "fits.housing_interference": "8 um",
    "fits.housing_outside": "80 mm",
    "fits.smoothing": "0 um",
}
WARM = {
    "temperatures.inner_ring": "80 degC",
    "temperatures.outer_ring": "70 degC",
    "temperatures.elements": "82 degC",
    "temperatures.shaft": "75 degC",
    "temperatures.housing": "60 degC",
}


def growth(inner, outer, strains=(0.0, 0.0, 0.0)):
    return Growth(*(jnp.asarray(one, dtype=float) for one in (inner * UM, outer * UM, *strains)))


fit_of = eqx.filter_jit(lambda scene: running_scene(scene)[1])


def turbine():
    return jb.load_scene("turbine_ball").geometry


def test_groove_bottoms():
    np.testing.assert_allclose(groove_bottoms(DEEP_GROOVE), [0.0305575, 0.0464455], rtol=1e-9)
    np.testing.assert_allclose(groove_bottoms(turbine()), [0.132237576, 0.173700212], rtol=1e-8)
    np.testing.assert_allclose(np.degrees(np.arccos(DEEP_GROOVE.free_cosine)), 11.1561406, rtol=1e-8)


@pytest.mark.parametrize(
    ("of_rings", "expansion", "expected"),
    [
        # clearance, um; contact angle, deg
        ((29.8210948, 29.0284375), STEEL, (-1.09655731, 0.0)),
        ((31.4573543, 28.0169478), STEEL, (-3.74430652, 0.0)),
        ((31.4573543, 28.0169478), NITRIDE, (5.40979508, 7.43616805)),
    ],
)
def test_deep_groove_bearing(of_rings, expansion, expected):
    grown = growth(*of_rings, (STEEL * 60, STEEL * 50, expansion * 62))
    play = running_play(DEEP_GROOVE, grown)
    np.testing.assert_allclose(play.measure / UM, expected[0], rtol=3e-8)
    np.testing.assert_allclose(np.degrees(play.contact_angle), expected[1], rtol=1e-7)
    if expansion == STEEL and of_rings[0] < 30:
        running = running_geometry(DEEP_GROOVE, grown)
        np.testing.assert_allclose(running.pitch_diameter, 38.5303765e-3, rtol=1e-8)
        np.testing.assert_allclose(running.ball_diameter, 7.94415195e-3, rtol=1e-8)
        np.testing.assert_allclose(
            [running.conformity_inner, running.conformity_outer], [0.514987135, 0.524921311], rtol=1e-8
        )


@pytest.mark.parametrize(
    ("of_rings", "strains", "expected"),
    [
        # clearance, um; contact angle, deg; axial shift, um; pitch diameter, mm
        ((44.6608515, 0.0), (0.0,) * 3, (141.974469, 26.0925437, -41.9157243, 153.014887)),
        ((65.6159904, 0.0), (0.0,) * 3, (121.01933, 24.0588381, -64.3076664, 153.021872)),
        ((98.3060071, 0.0), (0.0,) * 3, (88.3293138, 20.5128628, -104.188965, 153.032769)),
        (
            (235.333296, 185.855826),
            (M50 * 110, M50 * 90, M50 * 115),
            (78.7729494, 19.4012777, -117.861351, 153.192838),
        ),
        ((235.333296, 185.855826), (M50 * 110, M50 * 90, NITRIDE * 115), (121.968283, 23.8322657, -59.2790602, None)),
    ],
)
def test_angular_contact_bearing(of_rings, strains, expected):
    grown = growth(*of_rings, strains)
    play, running = running_play(turbine(), grown), running_geometry(turbine(), grown)
    np.testing.assert_allclose(
        [play.measure / UM, np.degrees(play.contact_angle), play.axial_shift / UM], expected[:3], rtol=1e-7
    )
    if expected[3] is not None:
        np.testing.assert_allclose(running.pitch_diameter * 1e3, expected[3], rtol=1e-8)
    # the grown geometry has that clearance and that angle, and its displacements count from the drawing's first contact
    np.testing.assert_allclose(np.arccos(running.free_cosine), play.contact_angle, rtol=1e-12)
    np.testing.assert_allclose(-running.aligned, turbine().centre_distance * turbine().free_sine, rtol=1e-14)


def test_cylindrical_bearing():
    geometry = jb.load_scene("turbine_roller").geometry
    geometry = dataclasses.replace(geometry, roller_diameter=12e-3, diametral_clearance=60e-6)
    play = roller_play(geometry, growth(178.831148, 133.747481, (0.0, 0.0, M50 * 90)))
    np.testing.assert_allclose(play.measure / UM, -11.6516669, rtol=1e-8)
    steel = roller_play(geometry, growth(178.831148, 133.747481, (0.0, 0.0, STEEL * 90)))
    np.testing.assert_allclose(steel.measure / UM, -12.0837, rtol=1e-5)


def test_tapered_bearing():
    geometry = jb.load_scene("tapered_example").geometry
    cold = growth(2 * 4.0, 2 * -2.0)
    np.testing.assert_allclose(tapered_play(geometry, cold).measure / UM, -24.0004334, rtol=1e-8)
    warm = growth(2 * 15.0, 2 * 14.0, (0.0, 0.0, STEEL * 60))
    np.testing.assert_allclose(tapered_play(geometry, warm).measure / UM, -28.570167, rtol=1e-8)
    np.testing.assert_allclose(closing(geometry, warm) / UM, [17.7499107, -10.6025755, -2.60498652], rtol=1e-8)


def test_axial_shift_of_a_tapered_bearing_restores_touching():
    """At the displacement that the shift says there is a place of the roller where all three approaches are 0."""
    scene = jb.load_scene("tapered_example", {"contact": "none"})
    grown = growth(2 * 15.0, 2 * 14.0, (0.0, 0.0, STEEL * 60))

    @jax.jit
    def approaches_and_slopes(place):
        system, shift = build_tapered(scene.grown(grown)), tapered_play(scene.geometry, grown).measure

        def approaches(place):
            motion = jnp.stack([shift, 0.0, 0.0])[:, None]
            races, _, rib = system.approaches(jnp.stack([*place, 0.0])[:, None], motion)
            return jnp.concatenate([races[:, 0], rib])

        return approaches(place), jax.jacfwd(approaches)(place)

    # linear in the two displacements of the roller
    still, columns = approaches_and_slopes(jnp.zeros(2))
    place = np.linalg.lstsq(columns, -still, rcond=None)[0]
    np.testing.assert_allclose(approaches_and_slopes(jnp.asarray(place))[0], 0.0, atol=1e-17)


DIRECT = jb.NewtonOptions(continuation=False)
"""One way to the root, where none is hard to find: a smaller program."""


@pytest.fixture(scope="module")
def mounted():
    scene = jb.load_scene("deep_groove_6205", SEATS | WARM)
    return scene, jb.solve(scene)


def test_parts_add_up(mounted):
    _, solution = mounted
    fit = solution.fit
    np.testing.assert_allclose(fit.drawn + fit.by_fits + fit.by_temperatures + fit.by_speed, fit.clearance, atol=1e-19)
    assert float(fit.by_fits) < 0.0
    assert float(fit.by_speed) < 0.0
    np.testing.assert_allclose(fit.drawn, 12e-6, rtol=1e-12)


@pytest.mark.slow
def test_solve_of_a_mounted_bearing_is_that_of_its_running_dimensions():
    """Also by the equations of ISO 16281."""
    scene = jb.load_scene("deep_groove_6205", SEATS | WARM | {"rating.tilt": "iso", "rating.dynamic_capacity": "14 kN"})
    solution = jb.solve(scene)
    running, fit, impossible = running_scene(scene)
    assert not any(bool(reason.applies) for reason in impossible.values())
    own = jb.solve(running)
    assert own.fit is None
    # sizes of the ratings are those of the drawing
    np.testing.assert_allclose(own.life.L10r, solution.life.L10r, rtol=1e-4)
    np.testing.assert_allclose(fit.clearance, solution.fit.clearance, rtol=1e-12)
    np.testing.assert_allclose(own.elements.load_inner, solution.elements.load_inner, rtol=1e-12)
    # and of a bearing that is given by these dimensions
    geometry = running.geometry
    written = dataclasses.replace(
        running,
        geometry=BallGeometry(
            9,
            geometry.pitch_diameter,
            geometry.ball_diameter,
            geometry.conformity_inner,
            geometry.conformity_outer,
            diametral_clearance=geometry.running_clearance,
        ),
    )
    np.testing.assert_allclose(jb.solve(written).elements.load_inner, solution.elements.load_inner, rtol=1e-10)


def test_port_takes_the_running_bearing(mounted):
    """The port stays where it is on the drawing: it is a point of the shaft."""
    scene, solution = mounted
    distance = scene.port_distance
    assert abs(float(distance - eqx.filter_jit(lambda s: running_scene(s)[0].port_distance)(scene))) > 1e-6
    ring = jnp.stack([getattr(solution.ring, name) for name in RING_FREEDOMS])
    away, back = shift_matrix(distance), shift_matrix(-distance)
    held = jb.reaction(scene, back @ ring, options=DIRECT)
    np.testing.assert_allclose(held.force, away.T @ solution.force, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(held.fit.clearance, solution.fit.clearance, rtol=1e-12)
    # the tilt is free: stiffness and loads of the balls are those of the solve too
    size = np.max(np.abs(solution.force[:3]))
    np.testing.assert_allclose(held.elements.load_inner, solution.elements.load_inner, atol=1e-9 * size)
    scale = np.sqrt(np.outer(*2 * [np.diag(solution.stiffness)])) + 1e-9
    there = np.asarray(back.T @ held.stiffness @ back)
    np.testing.assert_allclose(there / scale, solution.stiffness / scale, atol=1e-8)


@pytest.mark.slow
def test_clearance_may_pass_zero():
    """Loads go on through zero clearance, and so does their slope."""
    scene = jb.load_scene("deep_groove_6205", SEATS | {"fits.housing_interference": "-1 um"})

    def outcome(interference):
        solution = jb.solve(scene.replace({"fits.shaft_interference": interference}), throw=False)
        return solution.fit.clearance, jnp.max(solution.elements.load_inner)

    # the clearance is 0 here
    zero = 12e-6 / 0.818129755
    sizes = zero + np.asarray([-1e-6, -1e-9, 0.0, 1e-9, 1e-6, 20e-6])
    clearance, load = jax.jit(lambda all_: jax.lax.map(outcome, all_))(sizes)
    assert np.all(np.isfinite(load))
    assert clearance[0] > 0.0 > clearance[-1]
    np.testing.assert_allclose(load[1:4], load[2], rtol=1e-4)
    slope = jax.jacfwd(lambda size: outcome(size)[1])
    around = np.asarray([slope(size) for size in sizes[1:4]])
    np.testing.assert_allclose(around, around[1], rtol=1e-3)
    differences = (load[4] - load[0]) / 2e-6
    np.testing.assert_allclose(around[1], differences, rtol=2e-2)


def test_one_temperature_and_one_material_only_scale():
    """Loose rings, everything 80 K warmer: the contact angle stays, loads change by the sizes alone."""
    loose = {"fits.shaft_interference": "-5 um", "fits.housing_interference": "-5 um"}
    warm = {f"temperatures.{name}": "100 degC" for name in ("inner_ring", "outer_ring")}
    scene = jb.load_scene("deep_groove_6205", SEATS | loose | warm | {"operation.inner_speed": "0 rpm"})
    fit = fit_of(scene)
    strain = STEEL * 80.0
    np.testing.assert_allclose(fit.clearance, 12e-6 * (1 + strain), rtol=1e-9)
    np.testing.assert_allclose(np.degrees(fit.contact_angle), 11.1561406, rtol=1e-8)


OPTIONS = jb.NewtonOptions(residual_tolerance=1e-13, step_tolerance=1e-12)
PATHS = ("fits.shaft_interference", "temperatures.inner_ring", "materials.rings.thermal_expansion")


@pytest.mark.slow
def test_derivatives_of_loads_and_clearance(mounted):
    scene, _ = mounted

    def outcome(values):
        changed = scene.replace(dict(zip((*PATHS, "operation.inner_speed"), values, strict=True)))
        solution = jb.solve(changed, throw=False, options=OPTIONS)
        return jnp.stack([solution.fit.clearance / UM, jnp.max(solution.elements.load_inner)])

    at = jnp.asarray([10e-6, 353.15, STEEL, 1000.0])
    forward = jax.jit(jax.jacfwd(outcome))(at)
    reverse = jax.jit(jax.jacrev(outcome))(at)
    np.testing.assert_allclose(forward, reverse, rtol=1e-8, atol=1e-12)
    run = jax.jit(outcome)
    for place, step in enumerate((1e-9, 1e-2, 1e-9, 1.0)):
        moved = lambda sign, place=place, step=step: run(at.at[place].add(sign * step))
        differences = (moved(1.0) - moved(-1.0)) / (2 * step)
        np.testing.assert_allclose(forward[:, place], differences, rtol=1e-6)


@pytest.mark.slow
def test_batch_of_seats_with_a_loose_one():
    scene = jb.load_scene("deep_groove_6205", SEATS)
    sizes = np.asarray([-5e-6, 0.0, 12e-6])
    solve = lambda size: jb.solve(scene.replace({"fits.shaft_interference": size}), throw=False)
    batch = jax.jit(jax.vmap(solve))(sizes)
    assert np.all(np.asarray(batch.converged))
    np.testing.assert_array_equal(np.asarray(batch.fit.pressure_inner) > 0.0, [False, False, True])
    loose = [text for text in batch.checks if "loose on the shaft" in text]
    np.testing.assert_array_equal(batch.checks[loose[0]], [True, True, False])


def test_seats_of_a_bearing_with_a_given_contact_angle():
    """A mounted angular contact bearing: its contact angle is a result, its ratings and checks keep the nominal one."""
    seats = {
        "geometry.bore": "120 mm",
        "geometry.outside_diameter": "190 mm",
        "fits.shaft_interference": "60 um",
        "fits.housing_interference": "-10 um",
        "fits.shaft_bore": "90 mm",
        "contact": "none",
        "cage": "none",
        "drag": "none",
        "kinematics": "none",
    }
    scene = jb.load_scene("turbine_ball", seats)
    solution = jb.solve(scene, options=DIRECT)
    assert 20.0 < np.degrees(float(solution.fit.contact_angle)) < 26.5
    assert float(np.min(solution.elements.load_inner)) > 0.0
    looser = jb.solve(scene.replace({"fits.shaft_interference": 20e-6}), options=DIRECT)
    # a flatter angle: higher loads for the same thrust
    assert float(solution.fit.contact_angle) < float(looser.fit.contact_angle)
    assert np.all(np.asarray(solution.elements.load_outer) > np.asarray(looser.elements.load_outer))


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"geometry.bore": "none"}, "geometry.bore"),
        ({"fits.shaft_bore": "26 mm"}, "fits.shaft_bore"),
        ({"fits.housing_outside": "50 mm"}, "fits.housing_outside"),
        ({"fits.shaft_tolerance": "k5"}, "fits.shaft_tolerance"),
        ({"fits.shaft_interference": "none", "fits.shaft_tolerance": "k9"}, "fits.shaft_tolerance"),
        ({"fits": "none", "temperatures.inner_ring": "80 degC", "temperatures.outer_ring": "80 degC"}, "temperatures"),
        ({"temperatures.inner_ring": "80 degC"}, "temperatures.outer_ring"),
    ],
)
def test_what_is_wrong_is_named(changes, field):
    with pytest.raises(ValueError, match=field):
        jb.load_scene("deep_groove_6205", SEATS | changes)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"geometry.bore": "31 mm"}, "geometry.bore: .* inner raceway, 0.0305575 m"),
        ({"geometry.outside_diameter": "46 mm"}, "geometry.outside_diameter: .* outer raceway, 0.0464455 m"),
    ],
)
def test_rings_without_a_wall_are_refused(changes, field):
    with pytest.raises(ValueError, match=field):
        jb.load_scene("deep_groove_6205", SEATS | changes)


@pytest.mark.slow
def test_lanes_without_a_wall_poison_no_derivatives():
    """Where bore and raceway are one circle a ring is infinitely soft."""
    loads = {"operation.radial_load": "none", "operation.moment": "none", "operation.axial_load": "500 N"}
    scene = jb.load_scene("deep_groove_6205", SEATS | loads)

    def total(interference, bores):
        def one(bore):
            lane = scene.replace({"geometry.bore": bore, "fits.shaft_interference": interference})
            solution = jb.solve(lane, throw=False)
            return solution.status, jnp.where(solution.converged, solution.elements.load_inner[0], 0.0)

        status, load = jax.vmap(one)(bores)
        return jnp.sum(load), status

    raceway = scene.raceway_diameters[0]
    slope = jax.jit(jax.value_and_grad(total, has_aux=True))
    (_, status), found = slope(10e-6, jnp.stack([raceway, 0.025]))
    np.testing.assert_array_equal(status, [4, 0])
    _, alone = slope(10e-6, jnp.stack([2.0 * raceway, 0.025]))
    assert float(alone) > 0.0
    np.testing.assert_allclose(found, alone, rtol=1e-12)


def test_derivatives_of_a_play_that_is_impossible():
    """Rings so far apart that balls cannot touch them: a play that is refused still has finite derivatives."""
    play = lambda inner: running_play(DEEP_GROOVE, growth(inner, 0.0))
    measures = lambda inner: jnp.stack([play(inner).measure, play(inner).contact_angle, play(inner).axial_shift])
    possible, slopes = jax.jit(lambda inner: (play(inner).possible, jax.jacrev(measures)(inner)))(-2000.0)
    assert not bool(possible)
    assert np.all(np.isfinite(slopes))


def test_thrust_that_loads_half_of_the_balls_is_that_of_the_running_angle():
    seats = {"geometry.bore": "120 mm", "geometry.outside_diameter": "190 mm", "fits.shaft_interference": "60 um"}
    plain = dict.fromkeys(("contact", "cage", "drag", "kinematics"), "none")
    scene = jb.load_scene("turbine_ball", seats | plain | {"operation.radial_load": "8 kN"})
    angle, missing = eqx.filter_jit(
        lambda scene: ((found := running_scene(scene))[1].contact_angle, missing_thrust(found[0]))
    )(scene)
    expected = 1.22 * 8e3 * np.tan(float(angle)) - float(scene.operation.axial_load)
    np.testing.assert_allclose(missing, expected, rtol=1e-9)


MOVING = {
    "geometry.bore": "118 mm",
    "geometry.outside_diameter": "175 mm",
    "fits.shaft_interference": "40 um",
    "fits.shaft_bore": "90 mm",
}


def test_clearance_in_motion_follows_the_speed():
    """A roller bearing on its shaft that turns faster and faster: at each speed the clearance of a steady solve."""
    scene = jb.load_scene("turbine_roller_dynamic", MOVING)
    dynamics = built(scene, Simulation(speed=LinearRamp(0.1, 1.0, 1.0)))
    clearance = jax.jit(lambda time: 2.0 * dynamics._radial_clearance(dynamics.motion(time)))
    found = [clearance(time) for time in (0.0, 0.5, 1.0)]
    factors = [0.1, 0.55, 1.0]
    speeds = [float(scene.operation.inner_speed) * factor for factor in factors]
    steady = [fit_of(scene.at_operation(inner_speed=speed)).clearance for speed in speeds]
    np.testing.assert_allclose(found, steady, rtol=1e-12)
    assert found[2] < found[1] < found[0]


def test_a_run_may_go_on_from_rollers_off_their_places():
    """Places along the grown pitch circle are those of the same bearing, also at other temperatures."""
    warm = {"temperatures.inner_ring": "130 degC", "temperatures.outer_ring": "110 degC"}
    scene = jb.load_scene("turbine_roller_dynamic", MOVING | warm)
    dynamics = built(scene, Simulation())
    rollers, zero = np.zeros((3, scene.geometry.n_rollers)), np.zeros(())
    rollers[0] = 1e-3
    azimuth = dynamics._places(0.0, dynamics.scaled(jnp.asarray(rollers), jnp.zeros(6)))[0]
    state = LastState(
        time=zero,
        elements=rollers,
        cage=np.zeros(6),
        frame_angle=zero,
        frame_speed=zero,
        reference_speed=np.ones(()),
        azimuth=np.asarray(azimuth),
        has_cage=True,
        identity=identity(scene),
    )
    check_fits(scene, state)
    check_fits(scene.replace({"temperatures.inner_ring": 293.15}), state)
    with pytest.raises(ValueError, match="shaft_interference"):
        check_fits(scene.replace({"fits.shaft_interference": 30e-6}), state)


def test_runs_warn_of_loose_rings():
    scene = jb.load_scene("turbine_roller_dynamic", MOVING | {"fits.shaft_interference": "0 um"})
    energy = RollerEnergy(*(np.zeros(()) for _ in dataclasses.fields(RollerEnergy)))
    found = eqx.filter_jit(lambda scene: run_checks(scene, energy, {}))(scene)
    assert any("loose on the shaft" in text and bool(said) for text, said in found.items())


def test_classes_of_tolerances_give_the_interference():
    classes = {"fits.shaft_interference": "none", "fits.housing_interference": "none"}
    classes |= {"fits.shaft_tolerance": "k5", "fits.housing_tolerance": "J7"}
    for at, expected in (("mean", (11.5, -9.5)), ("tightest", (21.0, 12.0)), ("loosest", (2.0, -31.0))):
        scene = jb.load_scene("deep_groove_6205", SEATS | classes | {"fits.at": at, "operation.inner_speed": "0 rpm"})
        fit = fit_of(scene)
        np.testing.assert_allclose([fit.interference_inner / UM, fit.interference_outer / UM], expected, rtol=1e-9)
