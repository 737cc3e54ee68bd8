"""Lubricated ball bearings with up to four contacts: against the bearing with two, balances, energy, gradients."""

import functools
from types import SimpleNamespace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import scipy.optimize

import jaxbearing as jb
from jaxbearing.bearings.ball.friction import _moments
from jaxbearing.bearings.ball.kinematics import BallKinematics, BallMotion
from jaxbearing.materials import Material, reduced_modulus
from jaxbearing.numerics.newton import NewtonOptions

DRY = "four_point_qj"
STEEL = Material(207e9, 0.3, 7850.0)
OIL = {
    "oil.name": "mobil_jet_ii",
    "operation.oil_temperature": "60 degC",
    "operation.oil_flow": "1 l/min",
    "operation.inner_speed": "6000 rpm",
    "rating": "none",
}
FILMS = {**OIL, "contact.film": "hamrock_dowson", "contact.rolling_resistance": "source_86"}
TRACTION = {
    **FILMS,
    "contact.traction": "maxwell_eyring",
    "contact.traction_accuracy": "1e-2",
    "kinematics.attitude": "equilibrium",
}
CAGE = {
    "cage.guidance": "inner_ring",
    "cage.guiding_clearance": "400 um",
    "cage.pocket_clearance": "300 um",
    "cage.land_width": "4 mm",
    "cage.n_lands": "2",
    "drag.through_flow_fraction": "1.0",
}
AXIAL = {"operation.radial_load": "none"}
ALL_FOUR = {"operation.axial_load": "2 kN", "operation.radial_load": "5 kN"}
CASES = {
    "films, axial": FILMS | AXIAL,
    "films, four contacts": FILMS | ALL_FOUR,
    "traction, axial": TRACTION | AXIAL,
    "traction, four contacts": TRACTION | ALL_FOUR,
    "traction, couple resolved": TRACTION | AXIAL | {"kinematics.gyroscopic": "resolved"},
    "traction, cage and drag": TRACTION | CAGE | AXIAL,
}


@functools.cache
def solved(name):
    return jb.solve(jb.load_scene(DRY, CASES[name]))


def one_arc():
    """Changes to one arc on each ring, with the same contact angle."""
    geometry = jb.load_scene(DRY).geometry
    angle = float(np.arctan2(geometry.free_sine, geometry.free_cosine))
    return {
        "geometry.shim_inner": "none",
        "geometry.shim_outer": "none",
        "geometry.diametral_clearance": "none",
        "geometry.contact_angle": f"{angle!r} rad",
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_energy_and_balance(name):
    """Drive power, from torques, is the sum of all losses; the sums over all contacts balance ring and balls."""
    found = solved(name)
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-8)
    for loss in jax.tree.leaves(found.power_loss):
        assert loss >= 0.0
    e, operation = found.elements, found.operation
    flanks = [("inner", -1.0), ("inner_second", -1.0), ("outer", 1.0), ("outer_second", 1.0)]
    axial, radial = np.zeros(12), np.zeros(12)
    on_ring = np.zeros((2, 12))
    for flank, sign in flanks:
        load, angle = np.asarray(getattr(e, f"load_{flank}")), np.asarray(getattr(e, f"contact_angle_{flank}"))
        axial, radial = axial + sign * load * np.sin(angle), radial + sign * load * np.cos(angle)
        if sign < 0.0:
            on_ring += load * np.stack([np.sin(angle), np.cos(angle)])
    thrust = float(operation.axial_load)
    if "resolved" in name:
        assert np.min(np.abs(e.transverse_spin)) > 0.0
        return  # the traction across rolling carries a part
    np.testing.assert_allclose(axial, 0.0, atol=1e-8 * thrust)
    np.testing.assert_allclose(np.sum(on_ring[0]), thrust, rtol=1e-8)
    if "cage" in name:
        return  # pockets carry a part
    np.testing.assert_allclose(radial, e.centrifugal_force, atol=1e-8 * thrust)
    across = 0.0 if operation.radial_load is None else float(operation.radial_load)
    np.testing.assert_allclose(np.sum(on_ring[1] * np.cos(e.azimuth)), across, atol=1e-8 * thrust)


@pytest.mark.slow
def test_open_second_contacts_change_nothing():
    """Under thrust, with a film that does not fill the gaps of the second flanks, loads, motion, films and power are
    those of the bearing with one arc on each ring: the equations are others, their unknowns too."""
    tight = NewtonOptions(residual_tolerance=1e-13)

    def run(changes):
        scene = jb.load_scene(DRY, {**CASES["traction, axial"], **changes})
        # scene files join this law to one of light loads, which fills any gap
        return jb.solve(scene.replace({"contact.film": scene.contact.film.film}), options=tight)

    four, two = run({}), run(one_arc())
    for name in ("load_inner_second", "load_outer_second"):
        np.testing.assert_allclose(getattr(four.elements, name), 0.0, atol=1e-8)
    for name in ("load_inner", "load_outer", "contact_angle_inner", "contact_angle_outer", "film_inner", "film_outer"):
        np.testing.assert_allclose(getattr(four.elements, name), getattr(two.elements, name), rtol=1e-9)
    for name in ("orbital_speed", "spin_speed", "attitude_angle"):
        np.testing.assert_allclose(getattr(four.elements, name), getattr(two.elements, name), rtol=1e-9)
    np.testing.assert_allclose(four.power_loss.total, two.power_loss.total, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["films, four contacts", "traction, axial"])
def test_gradients(name):
    """By loads, speed, clearance, shims and temperature, against central differences along one direction."""
    scene = jb.load_scene(DRY, CASES[name])
    paths = ["operation.axial_load", "operation.inner_speed", "operation.oil_temperature"]
    paths += ["geometry.diametral_clearance", "geometry.shim_inner", "geometry.shim_outer"]
    start = {path: functools.reduce(getattr, path.split("."), scene) * 1.0 for path in paths}

    @jax.jit
    def value(numbers):
        found = jb.solve(scene.replace(numbers), throw=False)
        e = found.elements
        loads = jnp.sum(jnp.square(e.load_inner)) + 2.0 * jnp.sum(jnp.square(e.load_outer_second))
        return jnp.log(loads) + jnp.log(found.power_loss.total) + 1e5 * found.ring.axial

    slope = jax.jit(jax.grad(value))(start)
    signs = dict(zip(paths, (1.0, -1.0, 1.0, 1.0, -1.0, 1.0), strict=True))
    step = 1e-5
    moved = lambda way: {path: start[path] * (1.0 + way * step * signs[path]) for path in paths}
    difference = (value(moved(1.0)) - value(moved(-1.0))) / (2.0 * step)
    along = [float(slope[path] * start[path] * signs[path]) for path in paths]
    assert np.all(np.isfinite(along))
    np.testing.assert_allclose(sum(along), difference, atol=1e-5 * sum(map(abs, along)))


@pytest.mark.slow
def test_four_contacts_lose_more():
    """Three contacts and more cannot all roll: at equal thrust a bearing that is pressed together, so that every ball
    has four contacts, loses several times as much as the same bearing with clearance, whose balls have two."""
    play = solved("traction, axial")
    # the same program with another number
    pressed = jb.solve(jb.load_scene(DRY, CASES["traction, axial"]).replace({"geometry.diametral_clearance": -20e-6}))
    assert np.all(play.elements.loaded_contacts == 2.0)
    assert np.all(pressed.elements.loaded_contacts == 4.0)
    slid = lambda found: float(found.power_loss.inner_raceway + found.power_loss.outer_raceway)
    assert slid(pressed) > 2.0 * slid(play)


def test_balance_of_a_ball_with_four_contacts():
    """The sheet's ball between four contacts under Coulomb friction: its speeds and its power, from the moments and
    forces of `friction` and tractions that are integrated here."""
    scene = jb.load_scene(DRY)
    load, angle = np.asarray([1750.0, 700.0, 1800.0, 760.0]), np.asarray([0.555, -0.53, 0.55, -0.535])
    arcs = scene.geometry.arcs
    # the sheet's ellipses are those at the contact angle of the unloaded bearing
    free = np.full(4, float(scene.geometry.free_cosine))
    contact = scene.geometry.contacts_on(free, arcs.races, reduced_modulus(STEEL, STEEL))
    ellipse = jax.tree.map(np.asarray, contact.ellipse(load))
    kinematics = BallKinematics(*(jnp.asarray(value) for value in (100.0 * np.pi, 0.0, 72.5e-3, 17.4625e-3)))
    nodes, weights = np.polynomial.legendre.leggauss(96)
    radius, turn = 0.5 * (nodes + 1.0), np.linspace(0.0, 2.0 * np.pi, 192, endpoint=False)
    # p dA over the load on the unit disk, and the places there
    share = 1.5 * np.sqrt(1.0 - radius**2) * radius * 0.5 * weights * (2.0 * np.pi / 192) / np.pi
    x = np.outer(radius, np.cos(turn))[None] * ellipse.rolling[:, None, None]
    y = np.outer(radius, np.sin(turn))[None] * ellipse.transverse[:, None, None]

    def balance(speeds):
        orbit, axial, radial = speeds
        motion = BallMotion(orbit, np.hypot(axial, radial), np.arctan2(radial, axial), 0.0)
        over = (kinematics.inner_race, kinematics.outer_race)
        races = [over[race](motion, angle[k]) for k, race in enumerate(arcs.races)]
        along = arcs.senses[:, 0] * np.asarray([float(one.rolling) for one in races])
        spin = np.asarray([float(one.spin) for one in races])
        slide = along[:, None, None] - spin[:, None, None] * y, spin[:, None, None] * x
        size = np.sqrt(slide[0] ** 2 + slide[1] ** 2 + 0.02**2)
        pull = 0.05 * load[:, None, None] * share[None, :, None] / size
        force = np.sum(pull * slide[0], axis=(1, 2))
        moment = np.sum(pull * (x * slide[1] - y * slide[0]), axis=(1, 2))
        forward, about = -arcs.senses * force[:, None], -moment[:, None]
        system = SimpleNamespace(kinematics=kinematics, arcs=arcs)
        rows = _moments(system, angle[:, None], jnp.asarray(forward), jnp.asarray(about), ())
        power = float(np.sum(force * along + moment * spin))
        return np.asarray([float(rows[0][0]), float(rows[1][0]), float(np.sum(forward))]), power

    found = scipy.optimize.root(lambda speeds: balance(speeds)[0], [124.8, 724.6, 17.3], tol=1e-12)
    assert found.success
    np.testing.assert_allclose(found.x[:2], [124.67855, 724.7495], rtol=1e-5)
    np.testing.assert_allclose(found.x[2], 15.8030, rtol=1e-4)
    np.testing.assert_allclose(balance(found.x)[1], 64.7467, rtol=1e-5)


def test_refusals():
    with pytest.raises(ValueError, match="expected 'equilibrium'"):
        jb.load_scene(DRY, TRACTION | {"kinematics.attitude": "outer"})
    with pytest.raises(ValueError, match="expected 'linear_slip'"):
        jb.load_scene(DRY, FILMS | {"kinematics.attitude": "outer"})
