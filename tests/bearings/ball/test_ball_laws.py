"""Laws of the ball bearing by themselves: gyroscopic couple, pocket, kinematics; limits and derivatives."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.gyroscopic import CappedCouple, SharedCouple
from jaxbearing.bearings.ball.kinematics import BallKinematics
from jaxbearing.contacts import RollingInlet
from jaxbearing.contacts.point_laws import PointFilm
from jaxbearing.gaps import BallPocket
from jaxbearing.materials import reduced_modulus

RPM = 2.0 * np.pi / 60.0
DIAMETER = 20.638e-3


def difference(function, x, step):
    """Fourth-order central difference."""
    at = lambda k: np.asarray(function(x + k * step))
    return (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step)


def test_capped_couple_is_whole_when_small_and_friction_when_large():
    law = CappedCouple()
    for couple in (1e-9, 1e-3, 0.1):
        inner, outer = law.friction(couple, DIAMETER, 3000.0, 4000.0)
        np.testing.assert_allclose(inner / 3000.0, outer / 4000.0, rtol=1e-14)
        whole = 2.0 * couple / DIAMETER
        np.testing.assert_allclose(inner + outer, whole, rtol=(whole / (0.05 * 7000.0)) ** 2 + 1e-9)
    np.testing.assert_allclose(law.friction(1e9, DIAMETER, 3000.0, 4000.0), (150.0, 200.0), rtol=1e-14)
    np.testing.assert_array_equal(law.friction(2.5, DIAMETER, 0.0, 0.0), (0.0, 0.0))
    # an open inner contact carries nothing, where constant shares ask it for friction
    assert float(law.friction(2.5, DIAMETER, 0.0, 900.0)[0]) == 0.0
    np.testing.assert_allclose(SharedCouple(0.0, 2.0).friction(2.5, DIAMETER, 0.0, 900.0), (0.0, 5.0 / DIAMETER))
    np.testing.assert_allclose(sum(SharedCouple().friction(2.5, DIAMETER, 1.0, 9.0)), 5.0 / DIAMETER)


@pytest.mark.parametrize("place", [(2.5, 3000.0, 4000.0), (0.0, 3000.0, 4000.0), (2.5, 0.1, 900.0), (-1.0, 50.0, 70.0)])
def test_capped_couple_derivatives(place):
    law = CappedCouple()
    value = jax.jit(lambda x: jnp.stack(law.friction(x[0], DIAMETER, x[1], x[2])))
    slopes = jax.jit(jax.jacfwd(value))
    found = np.asarray(slopes(np.asarray(place)))
    assert np.all(np.isfinite(found))
    for i, (x, step) in enumerate(zip(place, (1e-3, 1e-2 * place[1], 1e-1), strict=True)):
        along = lambda v, i=i: value(np.asarray([*place[:i], v, *place[i + 1 :]]))
        np.testing.assert_allclose(found[:, i], difference(along, x, step), rtol=1e-7, atol=1e-7)
    for corner in ((0.0, 0.0, 0.0), (2.5, 0.0, 0.0)):
        assert np.all(np.isfinite(slopes(np.asarray(corner))))


def pocket_values(pocket, x):
    film = pocket.balance(x[0], x[1], x[2], x[3])
    return jnp.stack([1e4 * film.film_front, film.load_front, film.friction, film.transverse])


POCKET_VALUES = jax.jit(pocket_values)
POCKET_SLOPES = jax.jit(jax.jacfwd(pocket_values, argnums=1))


@pytest.mark.parametrize("net", [-200.0, -1.0, 0.0, 1e-3, 30.0])
@pytest.mark.parametrize("spin", [4800.0, 10.0, 0.0])
def test_pocket_derivatives(net, spin):
    pocket = BallPocket(clearance=3e-4, ball_radius=0.5 * DIAMETER)
    load = float(pocket.balance(0.0, spin, 0.6 * spin, 5e-3).load_front)
    scale = np.array([load, spin + 0.1, spin + 0.1, 5e-3])
    place = np.array([net, spin, 0.6 * spin, 5e-3])
    found = np.asarray(POCKET_SLOPES(pocket, place)) * scale
    assert np.all(np.isfinite(found))
    for i in range(4):
        along = lambda s, i=i: POCKET_VALUES(pocket, place + s * scale * np.eye(4)[i])
        np.testing.assert_allclose(found[:, i], difference(along, 0.0, 1e-3), rtol=1e-6, atol=1e-6)
    swapped = pocket.balance(-net, spin, 0.6 * spin, 5e-3)
    np.testing.assert_allclose(swapped.film_rear, pocket.balance(net, spin, 0.6 * spin, 5e-3).film_front, rtol=1e-12)


def test_pocket_friction_takes_power_and_vanishes_at_rest():
    pocket = BallPocket(clearance=3e-4, ball_radius=0.5 * DIAMETER)
    film = pocket.balance(3.0, -4800.0, 2800.0, 5e-3)
    assert float(film.friction) * -4800.0 > 0.0
    assert float(film.transverse) * 2800.0 > 0.0
    still = pocket.balance(3.0, 0.0, 0.0, 5e-3)
    assert (float(still.friction), float(still.transverse)) == (0.0, 0.0)
    np.testing.assert_allclose(still.load_front - still.load_rear, 3.0, rtol=1e-9)


def kinematics(inner, outer, ratio=0.135):
    return BallKinematics(
        jnp.asarray(inner * RPM), jnp.asarray(outer * RPM), jnp.asarray(0.15), jnp.asarray(0.15 * ratio)
    )


def test_kinematics_limits():
    """A cylinder between two rings at contact angle 0; both rings alike: no rolling; rest: everything is 0."""
    motion = kinematics(9000.0, 0.0).rolling(0.0, 0.0, 0.0)
    np.testing.assert_allclose(motion.orbital_speed, 0.5 * (1.0 - 0.135) * 9000.0 * RPM, rtol=1e-14)
    np.testing.assert_allclose(motion.spin_speed, 0.5 * (1.0 / 0.135 - 0.135) * 9000.0 * RPM, rtol=1e-14)
    together = kinematics(5000.0, 5000.0).rolling(0.6, 0.5, 0.5)
    np.testing.assert_allclose([together.orbital_speed, together.spin_speed], [5000.0 * RPM, 0.0], atol=1e-10)
    rest = kinematics(0.0, 0.0)
    motion = rest.rolling(0.6, 0.5, 0.5)
    for race in (rest.inner_race(motion, 0.6), rest.outer_race(motion, 0.5)):
        assert all(float(value) == 0.0 for value in race)


@pytest.mark.parametrize("angles", [(0.65, 0.51), (0.1, 0.02), (1.2, 0.9)])
def test_race_control_is_the_attitude_without_spin_there(angles):
    inner, outer = angles
    kin = kinematics(12500.0, -2000.0)
    at_inner, at_outer = kin.inner_control(inner), kin.outer_control(outer)
    np.testing.assert_allclose(kin.inner_race(kin.rolling(inner, outer, at_inner), inner).spin, 0.0, atol=1e-9)
    np.testing.assert_allclose(kin.outer_race(kin.rolling(inner, outer, at_outer), outer).spin, 0.0, atol=1e-9)
    np.testing.assert_allclose(kin.raceway_control(inner, outer, at_inner), 0.0, atol=1e-10)
    np.testing.assert_allclose(kin.raceway_control(inner, outer, at_outer), 100.0, rtol=1e-12)
    assert float(kin.raceway_control(0.0, 0.0, 0.1)) == 100.0
    slopes = jax.grad(lambda a: kin.raceway_control(a, a, 0.0))(0.0)
    assert np.isfinite(slopes)


def test_rolling_resistance_takes_power_whichever_way_a_ball_turns():
    """Rolling without sliding at any angle: the law's own moment; else of the sign of the roll, bounded."""
    scene = jb.load_scene("turbine_ball")
    motion = BallKinematics(*(jnp.asarray(x) for x in (1309.0, 0.0, 153e-3, 20.638e-3)))
    modulus = reduced_modulus(scene.materials.rings, scene.materials.balls)
    inner, outer = jnp.asarray(0.65), jnp.asarray(0.51)
    contact = scene.geometry.contacts(jnp.cos(inner), jnp.cos(outer), modulus)
    rolling = motion.rolling(inner, outer, jnp.asarray(0.6))
    races = motion.inner_race(rolling, inner), motion.outer_race(rolling, outer)
    roll = jnp.stack([races[0].roll, -races[1].roll])
    speed = jnp.stack([race.mean_speed for race in races])
    radius = contact.reduced_radius_rolling
    np.testing.assert_allclose(roll * radius / speed, 1.0, rtol=1e-12)
    inlet, load = scene.oil.at(373.15), jnp.asarray([3300.0, 4100.0])
    film = PointFilm(load, load, None, inlet.viscosity * jnp.ones(2), load)
    moment = jax.jit(lambda speed, roll: scene.contact.rolling_moment(contact, load, film, speed, roll, inlet))
    entering = RollingInlet(load, speed, inlet.viscosity, inlet.pressure_viscosity, film.film)
    own = scene.contact.rolling.moment(contact, entering)
    np.testing.assert_allclose(moment(speed, roll), own, rtol=1e-12)
    assert np.all(own > 0.0)
    for factor in (-20.0, -1.0, -1e-3, 0.0, 1e-3, 0.5, 30.0):
        found = np.asarray(moment(speed, factor * roll))
        assert np.all(found * factor >= 0.0)
        assert np.all(np.abs(found) <= np.sqrt(2.0) * np.asarray(own))
        np.testing.assert_allclose(moment(-speed, factor * roll), found, rtol=1e-12)
    slopes = jax.jit(jax.grad(lambda s, r: jnp.sum(moment(s, r)), argnums=(0, 1)))(np.zeros(2), np.zeros(2))
    assert np.all(np.isfinite(np.asarray(slopes)))


@pytest.mark.slow
def test_reverse_derivatives_where_the_attitude_takes_least_power():
    """Combined load: against differences; pure radial load without clearance, where inner and outer control agree and
    the power does not depend on the attitude: finite."""
    scene = jb.load_scene("turbine_ball").replace({"cage": None, "drag": None, "kinematics.attitude": "min_power"})
    scene = scene.replace({"operation.radial_load": 0.0, "geometry.n_balls": 4})
    scene = scene.replace({"contact.traction.resolution": jb.contacts.Resolution(12, 4, True)})

    def total(numbers):
        angle, axial, radial, speed = numbers
        changed = scene.replace({"geometry.contact_angle": angle, "operation.inner_speed": 1e3 * speed})
        solution = jb.solve(changed.at_operation(axial_load=1e4 * axial, radial_load=1e4 * radial), throw=False)
        return solution.power_loss.total, solution.status

    run = jax.jit(jax.value_and_grad(total, has_aux=True))
    (value, status), slope = run(jnp.asarray([0.0, 0.0, 0.5, 1.3]))
    assert int(status) == 0
    assert float(value) > 0.0
    assert np.all(np.isfinite(slope))

    combined, step = jnp.asarray([0.5, 0.8, 0.3, 1.3]), 1e-4
    (value, status), slope = run(combined)
    assert int(status) == 0
    for i, direction in enumerate(step * jnp.eye(4)):
        at = lambda k, direction=direction: float(run(combined + k * direction)[0][0])
        difference = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step)
        np.testing.assert_allclose(slope[i], difference, rtol=1e-6, atol=1e-6 * float(value))
