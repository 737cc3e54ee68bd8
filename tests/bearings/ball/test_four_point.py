"""Ball bearings with up to four contacts, without friction: geometry, kinematics, check values, limits, gradients.

The values are those of the model sheet of four-point contact: twelve balls, both rings with two arcs (G4) or the inner
ring only (G3). Its loads were computed with the exact motion of the grooves, without films, and with the centrifugal
forces given.
"""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.ball.core import FORCE_FLOOR, BallCore
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.groove_motion import half_planes, inner_arm, length_of, ring_frame
from jaxbearing.bearings.ball.kinematics import BallKinematics
from jaxbearing.bearings.ball.linear_slip import linear_slip, slip_weights
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.bearing_life import bearing_life
from jaxbearing.bearings.flanks import by_flank, on_heavier_flanks
from jaxbearing.materials import Material
from jaxbearing.numerics.newton import NewtonOptions, newton_solve
from jaxbearing.report.bearing.facts import extremes

RPM = 2.0 * np.pi / 60.0
STEEL = Material(np.float64(207e9), np.float64(0.3), np.float64(7850.0))
SHIM = np.radians(32.0)
SIZES = (12, 72.5e-3, 17.4625e-3, 0.525, 0.525)
G4 = BallGeometry(*SIZES, diametral_clearance=30e-6, shim_inner=SHIM, shim_outer=SHIM)
G3 = BallGeometry(*SIZES, diametral_clearance=30e-6, shim_inner=SHIM)


def bearing(geometry, rpm=0.0, **operation):
    return BallBearing(
        geometry=geometry,
        materials=BallMaterials(STEEL, STEEL),
        operation=BallOperation(rpm * RPM, **operation),
        kinematics=BallAttitude("linear_slip"),
    )


class Driven(BallCore):
    """Balls under a given centrifugal force."""

    given: jax.Array | None = None

    def outward_force(self, motion):
        return jnp.full_like(motion.orbital_speed, self.given + FORCE_FLOOR)


@eqx.filter_jit
def driven(scene, force, exact=True):
    """Displacements of the ring, m and rad, and loads and angles of the balls, under a given centrifugal force."""
    core = build_core(scene, exact)
    names = [field.name for field in dataclasses.fields(core)]
    core = Driven(**{name: getattr(core, name) for name in names}, given=force)
    system, result = newton_solve(core.started()[0], NewtonOptions())
    return system.ring.displacement(result.point.globals), system.at(result.point), result.converged


def close(found, printed, atol=0.0):
    np.testing.assert_allclose(np.asarray(found), printed, rtol=1e-6, atol=atol)


def test_geometry():
    """BD, e, A2, free angle, axial play, radius of the groove circle, contact constants of the sheet."""
    modulus = jb.materials.reduced_modulus(STEEL, STEEL)
    for geometry, across, angle, play, radius, constants in (
        (G4, 7.254519940e-4, 0.5901298557, 4.636233747e-5, 0.03661272600, (3.495457778e10, 3.707943301e10)),
        (G3, 7.917884970e-4, 0.4350608985, 2.732985946e-4, 0.03664589425, (3.484107767e10, 3.716397217e10)),
    ):
        apart = [offset for offset in geometry.arcs if offset is not None]
        close(geometry.centre_distance, 8.73125e-4)
        close(apart, 2.313428788e-4)
        close(geometry.centre_distance * geometry.free_cosine, across)
        close(jnp.arctan2(geometry.free_sine, geometry.free_cosine), angle)
        close(2.0 * (geometry.centre_distance * geometry.free_sine - sum(apart)), play)
        close(geometry.groove_circle_radius, radius)
        close(geometry.free_contacts(modulus).stiffness_constant(), constants)


def test_exact_distances():
    """Distances of a ball from the centres of both inner arcs, and what the first order leaves out."""
    printed = (
        (0.0, 1.0, 5.540572052836e-4),
        (0.0, -1.0, 3.964915246640e-4),
        (1.1, 1.0, 4.291109442666e-4),
        (2.5, -1.0, 5.052632053157e-4),
        (4.0, 1.0, 4.159211445325e-4),
    )
    lever, apart = G4.groove_circle_radius, G4.arcs.inner
    ring = np.asarray([20e-6, 30e-6, -15e-6, 4e-3, -2.5e-3])

    @jax.jit
    def distance(azimuth, side):
        frame = ring_frame(jnp.einsum("ijn,j->in", half_planes(azimuth[None]), ring))
        return length_of(inner_arm(frame, jnp.asarray([[3e-6], [-3.6e-4]]), lever, side * apart).vector)[0]

    for azimuth, side, length in printed:
        np.testing.assert_allclose(distance(azimuth, side), length, rtol=1e-11)


# geometry, loads, centrifugal force, displacements, {ball: (Q_i, Q_o, alpha_i, alpha_o)} with both sides of a ring
CASES = {
    "axial": (
        G4,
        {"axial_load": 5e3},
        0.0,
        {"axial": 4.925711991e-5},
        {0: ((722.6549, 0.0), (722.6558, 0.0), (0.6145337, -0.5176711), (0.6145329, -0.5183017))},
    ),
    "radial": (
        G4,
        {"axial_load": 0.0, "radial_load": 5e3},
        0.0,
        {"radial": 4.030094883e-5},
        {
            0: ((1273.3693,) * 2, (1273.8081,) * 2, (0.5432345, -0.5432345), (0.5438039, -0.5438039)),
            2: ((115.7534,) * 2, (115.7627,) * 2, (0.5553446, -0.5553446), (0.5554656, -0.5554656)),
        },
    ),
    "combined": (
        G4,
        {"axial_load": 2e3, "radial_load": 5e3},
        0.0,
        {"axial": 1.169056348e-5, "radial": 3.913243182e-5},
        {
            0: ((1751.7804, 707.0826), (1752.4630, 706.9442), (0.5552540, -0.5324349), (0.5553684, -0.5334209)),
            2: ((407.5833, 0.0), (407.5840, 0.0), (0.5670010, -0.5441475), (0.5669999, -0.5445563)),
        },
    ),
    "moment": (
        G4,
        {"axial_load": 0.0, "radial_load": 0.0, "moment": 100.0},
        0.0,
        {"tilt": 1.568612988e-3},
        {0: ((1068.9527, 0.0), (1068.9535, 0.0), (0.6207130, -0.5099854), (0.6222811, -0.5100910))},
    ),
    "turning": (
        G4,
        {"axial_load": 5e3},
        200.0,
        {"axial": 4.799708992e-5},
        {0: ((677.5457, 0.0), (822.7259, 45.6805), (0.6623411, -0.4969197), (0.5644797, -0.5396473))},
    ),
    "fast": (
        G4,
        {"axial_load": 5e3},
        800.0,
        {"axial": 5.065236795e-5},
        {0: ((667.3257, 0.0), (1164.0238, 388.6113), (0.6743411, -0.4917468), (0.5576595, -0.5386138))},
    ),
    "three": (
        G3,
        {"axial_load": 5e3},
        0.0,
        {"axial": 1.720326016e-4},
        {0: ((998.7229, 222.5849), (1117.6275,), (0.5603773, -0.5385415), (0.3820393,))},
    ),
    "three turning": (
        G3,
        {"axial_load": 2e3, "radial_load": 5e3},
        100.0,
        {"axial": 1.209266342e-4, "radial": 2.556813418e-5},
        {
            0: ((1552.4842, 602.8022), (2004.1409,), (0.5559064, -0.5341746), (0.2585215,)),
            6: ((29.7745, 0.0), (124.1635,), (0.7064284, -0.4928565), (0.1562952,)),
        },
    ),
    "all": (
        G4,
        {
            "axial_load": 3e3,
            "radial_load": 2e3,
            "radial_load_lateral": -500.0,
            "moment": 60.0,
            "moment_lateral": -40.0,
        },
        50.0,
        {
            "axial": 3.970014088e-5,
            "radial": -3.299590443e-6,
            "lateral": 2.363994412e-5,
            "tilt": 5.061058167e-4,
            "tilt_lateral": -1.094056532e-3,
        },
        {
            0: ((897.6905, 0.0), (938.2443, 0.0), (0.6404402, -0.5033822), (0.6090749, -0.5178009)),
            3: ((239.4768, 236.0887), (268.4169, 265.8597), (0.5534793, -0.5533539), (0.5532639, -0.5531763)),
        },
    ),
}


@pytest.mark.parametrize(
    "name",
    [name if name in ("axial", "turning", "fast") else pytest.param(name, marks=pytest.mark.slow) for name in CASES],
)
def test_check_values(name):
    geometry, loads, force, displacements, balls = CASES[name]
    ring, state, converged = driven(bearing(geometry, **loads), jnp.asarray(force))
    assert bool(converged)
    for freedom, value in displacements.items():
        close(getattr(ring, freedom), value)
    for ball, (inner, outer, inner_angle, outer_angle) in balls.items():
        # a bearing under axial load is solved with one ball for all
        place = ball if state.load.shape[1] > 1 else 0
        close(state.load[:, place], inner + outer, atol=1e-4)
        # the angle against a tilted ring leaves out tilt times displacement along the orbit over R_i
        close(state.angle[:, place], inner_angle + outer_angle, atol=1e-6)


@pytest.mark.slow
def test_first_order_of_the_tilt():
    """The tilt of first-order kinematics is smaller: what programs that use it get."""
    ring, state, converged = driven(bearing(G4, axial_load=0.0, radial_load=0.0, moment=100.0), jnp.zeros(()), False)
    assert bool(converged)
    close(ring.tilt, 1.566012812e-3)
    close(state.load[0, 0], 1067.4303)


spread_of = jax.jit(lambda scene: build_core(scene).spread)
slipping = jax.jit(lambda *given: linear_slip(*given, (0, 0, 1, 1)))


def test_linear_slip_of_one_ball():
    """Speeds that minimise sliding and spin of four given contacts; and three contacts that roll without sliding."""
    kinematics = BallKinematics(*(jnp.asarray(value) for value in (100.0 * np.pi, 0.0, 72.5e-3, 17.4625e-3)))
    spread = spread_of(bearing(G4, axial_load=5e3))
    angle = jnp.asarray([[0.555], [-0.53], [0.55], [-0.535]])
    load = jnp.asarray([[1750.0], [700.0], [1800.0], [760.0]])
    motion = slipping(kinematics, angle, load, spread)
    close(motion.orbital_speed, 124.830932)
    close(motion.axial_spin, 724.585815)
    close(motion.radial_spin, 17.256132)


def test_an_unloaded_ball_rolls_over_the_inner_ring():
    """A ball in both arcs of the outer ring alone orbits as one that rolls, whatever it weighs: it does not stop."""
    kinematics = BallKinematics(*(jnp.asarray(value) for value in (100.0 * np.pi, 0.0, 72.5e-3, 17.4625e-3)))
    spread, angle = spread_of(bearing(G4, axial_load=5e3)), jnp.asarray([[0.55], [-0.55], [0.55], [-0.55]])
    rolling = 0.5 * 100.0 * np.pi * (1.0 - 17.4625 / 72.5 * np.cos(0.55))
    for thrown in (0.1, 10.0, 1e3):
        weight = slip_weights(jnp.asarray([[0.0], [0.0], [thrown], [thrown]]), G4.arcs, FORCE_FLOOR)
        motion = slipping(kinematics, angle, weight, spread)
        np.testing.assert_allclose(motion.orbital_speed, rolling, rtol=0.03)


def test_check_value_at_speed():
    """15 000 rpm under axial load, where the second contact of the outer ring carries part of the centrifugal force."""
    # the same bearing, whose program the next tests use
    scene = jb.load_scene("four_point_qj").at_operation(inner_speed=15000 * RPM, axial_load=5e3, radial_load=0.0)
    for here, there in zip(*map(jax.tree.leaves, (scene.geometry, G4)), strict=True):
        np.testing.assert_allclose(here, there, rtol=1e-15)
    assert [float(one) for one in jax.tree.leaves(scene.materials.rings)] == [207e9, 0.3, 7850.0]
    solution = jb.solve(scene)
    elements = solution.elements
    close(elements.orbital_speed, 653.95575)
    close(solution.ring.axial, 4.860791126e-5)
    close(elements.load_inner, 674.6220, atol=1e-4)
    close(elements.load_inner_second, 0.0, atol=1e-4)
    close(elements.load_outer, 901.7381, atol=1e-4)
    close(elements.load_outer_second, 124.6905, atol=1e-4)
    close(elements.contact_angle_inner, 0.6657254)
    close(elements.contact_angle_outer, 0.5622856)
    close(elements.contact_angle_outer_second, -0.5396374)
    np.testing.assert_array_equal(elements.loaded_contacts, 3.0)
    assert any("more than two contacts" in text for text in solution.warnings)
    # race control is for balls with two contacts
    assert elements.raceway_control is None
    assert elements.control_angle_outer is None


@pytest.mark.slow
def test_open_second_contacts_change_nothing():
    """While one side carries, loads are those of the bearing with one arc on each ring and the same contact angle."""
    loads = {"axial_load": 5e3, "radial_load": 2e3}
    angle = float(jnp.arctan2(G4.free_sine, G4.free_cosine))
    four = jb.solve(bearing(G4, 2000.0, **loads))
    two = jb.solve(bearing(BallGeometry(*SIZES, contact_angle=angle), 2000.0, **loads))
    np.testing.assert_allclose(four.elements.load_inner_second, 0.0, atol=1e-9)
    for name in ("load_inner", "load_outer", "contact_angle_inner", "contact_angle_outer", "orbital_speed"):
        np.testing.assert_allclose(getattr(four.elements, name), getattr(two.elements, name), rtol=1e-9)
    # displacements count from the middle of the play, and those of the other bearing from first contact
    half_play = float(G4.centre_distance * G4.free_sine - sum(G4.arcs))
    np.testing.assert_allclose(four.ring.axial - half_play, two.ring.axial, rtol=1e-7, atol=1e-14)
    np.testing.assert_allclose(four.ring.radial, two.ring.radial, rtol=1e-8)
    np.testing.assert_allclose(four.stiffness[:3, :3], two.stiffness[:3, :3], rtol=1e-7, atol=1.0)


@pytest.mark.slow
def test_reversed_thrust_mirrors_the_sides():
    forth, back = (jb.solve(bearing(G4, 1000.0, axial_load=sign * 4e3, radial_load=3e3)) for sign in (1.0, -1.0))
    for name in ("load_inner", "load_outer"):
        first, second = getattr(forth.elements, name), getattr(forth.elements, f"{name}_second")
        np.testing.assert_allclose(getattr(back.elements, f"{name}_second"), first, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(getattr(back.elements, name), second, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(back.ring.axial, -forth.ring.axial, rtol=1e-8)


def test_reversed_thrust_has_the_same_life_and_report():
    """What is said of the bearing follows the flank that carries: life, safety, extremes, the section's ball."""
    scene = jb.load_scene("four_point_qj")
    forth, back = (jb.solve(scene.at_operation(axial_load=sign * 5e3)) for sign in (1.0, -1.0))
    for name in ("L10r", "L10", "contact_static_safety", "static_capacity"):
        np.testing.assert_allclose(getattr(back.life, name), getattr(forth.life, name), rtol=1e-9)
    for name, pick in (("load", np.argmax), ("pressure", np.argmax)):
        there, here = (list(extremes(one.elements, name, pick)) for one in (back, forth))
        assert there == here
    # rated as an angular contact bearing of its contact angle
    two = dataclasses.replace(scene.geometry, contact_angle=scene.geometry.nominal_angle, diametral_clearance=None)
    two = dataclasses.replace(two, shim_inner=None, shim_outer=None)
    gone = {name: None for name in vars(forth.elements) if name.endswith("_second") or name == "loaded_contacts"}
    alone = dataclasses.replace(forth, elements=dataclasses.replace(forth.elements, **gone))
    life = eqx.filter_jit(bearing_life)(dataclasses.replace(scene, geometry=two), alone)
    for name in ("L10r", "L10", "dynamic_capacity", "static_capacity"):
        np.testing.assert_allclose(getattr(life, name), getattr(forth.life, name), rtol=1e-8)
    one, other = by_flank(back.elements)
    np.testing.assert_array_equal(on_heavier_flanks(back.elements).load_inner, other.load_inner)
    assert np.all(other.load_inner > one.load_inner)


HARD = {
    "within the play": (60e-6, {"axial_load": 1.0}, 0.0),
    "sides in balance": (30e-6, {"axial_load": 0.0, "radial_load": 5e3}, 0.0),
    "little thrust": (30e-6, {"axial_load": 1e-3, "radial_load": 5e3}, 0.0),
    "preload": (-10e-6, {"axial_load": 1.0}, 0.0),
    "overspeed": (30e-6, {"axial_load": 10.0}, 15000.0),
    "pure moment": (30e-6, {"axial_load": 0.0, "radial_load": 0.0, "moment": 100.0}, 3000.0),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", HARD)
def test_hard_cases_converge_and_have_gradients(name):
    clearance, loads, rpm = HARD[name]

    def stiff(clearance, shim):
        geometry = BallGeometry(*SIZES, diametral_clearance=clearance, shim_inner=shim, shim_outer=shim)
        solution = jb.solve(bearing(geometry, rpm, **loads), throw=False)
        return jnp.sum(solution.elements.load_outer), solution.converged

    (_, converged), slopes = jax.value_and_grad(stiff, argnums=(0, 1), has_aux=True)(clearance, SHIM)
    assert bool(converged)
    assert np.all(np.isfinite(slopes))


def test_refusals():
    with pytest.raises(ValueError, match=r"geometry\.shim_inner"):
        BallGeometry(*SIZES, diametral_clearance=30e-6, shim_inner=np.radians(0.5))
    with pytest.raises(ValueError, match="linear_slip"):
        BallBearing(
            geometry=G3,
            materials=BallMaterials(STEEL, STEEL),
            operation=BallOperation(0.0, axial_load=5e3),
            kinematics=BallAttitude("outer"),
        )
