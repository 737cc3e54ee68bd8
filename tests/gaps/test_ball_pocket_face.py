"""Ball at one wall of its round pocket: the exact film of rolling and squeeze together, and the wall that yields."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.gaps import BallPocket, CompliantBallPocketFace
from jaxbearing.gaps.ball_pocket_face import _balance, _expansion

MU = 4.7e-3
CLEARANCE, RADIUS = 3e-4, 10.319e-3
STIFFNESS = 4.30944084e10
"""K of a steel ball in a bronze pocket of these radii, N/m^1.5."""
FACE = CompliantBallPocketFace(CLEARANCE, RADIUS, STIFFNESS)
FACES = jax.jit(FACE.face)
CONFORMING = RADIUS * (RADIUS + 0.5 * CLEARANCE) / (0.5 * CLEARANCE)
RADII = np.array([RADIUS, CONFORMING])


def pressure(x, y, film, film_rate, along, across):
    """The solution as it is printed, Pa, at a place, m."""
    c1, c2 = (
        -6.0 * MU * u / (3.0 + 2.0 * r / other) for u, r, other in zip((along, across), RADII, RADII[::-1], strict=True)
    )
    gap = film + x**2 / (2.0 * RADII[0]) + y**2 / (2.0 * RADII[1])
    return (-6.0 * MU * film_rate / (1.0 / RADII).sum() + c1 * x + c2 * y) / gap**2


@pytest.mark.parametrize("place", [(1e-4, 3e-4), (-3e-4, 2e-3), (0.0, -1e-3)])
def test_solution_fulfils_reynolds_equation(place):
    """div(h^3 grad p) = 6 mu u.grad h + 12 mu dh/dt, by autodiff."""
    film, film_rate, along, across = 20e-6, -0.05, 40.0, 20.0
    gap = lambda x, y: film + x**2 / (2.0 * RADII[0]) + y**2 / (2.0 * RADII[1])
    p = lambda x, y: pressure(x, y, film, film_rate, along, across)
    flow = [lambda x, y, i=i: gap(x, y) ** 3 * jax.grad(p, i)(x, y) for i in range(2)]
    left = sum(jax.grad(flow[i], i)(*place) for i in range(2))
    slopes = [jax.grad(gap, i)(*place) for i in range(2)]
    right = 6.0 * MU * (along * slopes[0] + across * slopes[1]) + 12.0 * MU * film_rate
    np.testing.assert_allclose(left, right, rtol=1e-10)


def quadrature(film, film_rate, along, across, n=1500):
    """Load of max(p, 0), N, by the midpoint rule in polar coordinates of the elliptical gap."""
    t, angle = (np.arange(n) + 0.5) / n, 2.0 * np.pi * (np.arange(n) + 0.5) / n
    r = (t / (1.0 - t))[:, None]
    x, y = (np.sqrt(2.0 * R * film) * r * f(angle) for R, f in zip(RADII, (np.cos, np.sin), strict=True))
    area = 2.0 * film * np.sqrt(RADII.prod()) * r / ((1.0 - t) ** 2)[:, None]
    p = np.maximum(pressure(x, y, film, film_rate, along, across), 0.0)
    return np.sum(p * area) * (1.0 / n) * (2.0 * np.pi / n)


@pytest.mark.parametrize("rate", [-0.05, 0.0, 0.02, 1.0])
def test_rigid_load_is_the_integral_of_the_pressure(rate):
    """The midpoint rule is good to 1e-5, and to 1e-4 where the film separates at 1 m/s and is loaded far out alone."""
    found = FACE.rigid_load(20e-6, rate, 40.0, 20.0, MU)
    np.testing.assert_allclose(found, quadrature(20e-6, rate, 40.0, 20.0), rtol=1e-4 if rate == 1.0 else 1e-5)


def test_check_values_of_the_wall():
    """To the printed digits: a rigid film, then gap, its rate, speeds along and across -> load, film."""
    np.testing.assert_allclose(FACE.rigid_load(20e-6, -0.05, 40.0, 20.0, MU), 3.45296921, rtol=2e-9)
    rows = np.array(
        [
            (0.0001, 0.0, 45.0, 22.0, 1.6354965, 0.000100112933),
            (1e-06, -0.2, 45.0, 22.0, 28.0274841, 1.75065802e-06),
            (-2e-06, 0.0, 40.0, 10.0, 123.159784, 1.38726224e-08),
            (1e-05, 0.3, 45.0, 0.0, 3.29801847, 1.01802553e-05),
        ]
    )
    found = FACES(*rows[:, :4].T, MU)
    np.testing.assert_allclose(found.load, rows[:, 4], rtol=1e-7)
    np.testing.assert_allclose(found.film, rows[:, 5], rtol=1e-7)
    assert np.all(np.asarray(found.residual) < 1e-6)


def test_limits_of_the_rigid_film():
    film = np.geomspace(1e-7, 1e-4, 4)
    # no squeeze: the wall of the balanced pocket; root of squares
    pocket = BallPocket(CLEARANCE, RADIUS)
    balanced = pocket.balance(2.0, 4000.0, 2500.0, MU)
    alone = FACE.rigid_load(
        balanced.film_front, 0.0, RADIUS * np.hypot(4000.0, 1.0), RADIUS * np.hypot(2500.0, 1.0), MU
    )
    np.testing.assert_allclose(balanced.load_front, alone, rtol=1e-13)
    # no entrainment
    closing = 12.0 * np.pi * MU * 0.1 * np.sqrt(RADII.prod()) / (film * (1.0 / RADII).sum())
    np.testing.assert_allclose(FACE.rigid_load(film, -0.1, 0.0, 0.0, MU), closing, rtol=1e-13)
    np.testing.assert_allclose(FACE.rigid_load(film, 0.1, 0.0, 0.0, MU), 0.0, atol=1e-290)
    # separation: positive, as 1/speed
    fast = FACE.rigid_load(1e-6, np.array([1e3, 1e4]), 45.0, 22.0, MU)
    assert np.all(np.asarray(fast) > 0.0)
    np.testing.assert_allclose(fast[0] / fast[1], 10.0, rtol=1e-4)


def test_equal_films_add_as_the_root_of_squares():
    """Both entrainments carry the same: the sum of the source is higher by the root of two, and by 41 %."""
    ratio = RADIUS / CONFORMING
    equal = (np.sqrt(ratio) * (3.0 + 2.0 / ratio)) / (3.0 + 2.0 * ratio)
    loads = [
        BallPocket(CLEARANCE, RADIUS, superposition=how).balance(0.0, 4000.0, 4000.0 * equal, MU).load_front
        for how in ("sum", "root_of_squares")
    ]
    np.testing.assert_allclose(loads[0] / loads[1], np.sqrt(2.0), rtol=1e-6)
    alone = [
        BallPocket(CLEARANCE, RADIUS, superposition=how).balance(0.0, 1e6, 0.0, MU).load_front
        for how in ("sum", "root_of_squares")
    ]
    np.testing.assert_allclose(alone[0], alone[1], rtol=1e-5)


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 0.0, -1e-6, -2e-5])
@pytest.mark.parametrize("rate", [0.0, -1.0, 1.0])
def test_wall_of_hard_cases(gap, rate):
    """Finite load and derivatives, and the derivative is right, from a free gap to a shock."""
    found = FACES(gap, rate, 45.0, 22.0, MU)
    assert 0.0 < float(found.load) < 1e5
    np.testing.assert_allclose(
        found.film - (found.load / STIFFNESS) ** (2.0 / 3.0), gap, rtol=1e-9, atol=1e-12 * float(found.film)
    )
    load = lambda g, v: jnp.log(FACE.face(g, v, 45.0, 22.0, MU).load)
    slopes = jax.jit(jax.grad(load, argnums=(0, 1)))(gap, rate)
    assert np.all(np.isfinite(slopes))
    step = 1e-3 * max(abs(gap), 1e-6)
    h = np.array([-2.0, -1.0, 1.0, 2.0])
    logs = np.log(np.asarray(FACES(gap + step * h, rate, 45.0, 22.0, MU).load))
    np.testing.assert_allclose(slopes[0], (logs @ np.array([1.0, -8.0, 8.0, -1.0])) / (12.0 * step), rtol=1e-6)


def test_wall_is_rigid_when_light_and_hertz_when_deep():
    light = FACES(2e-4, 0.0, 45.0, 0.0, MU)
    np.testing.assert_allclose(light.load, FACE.rigid_load(light.film, 0.0, np.hypot(45.0, 0.5), 0.0, MU), rtol=1e-9)
    deep = FACES(-1e-4, 0.0, 45.0, 0.0, MU)
    np.testing.assert_allclose(deep.load, STIFFNESS * 1e-4**1.5, rtol=1e-4)
    loads = jnp.linspace(0.0, 300.0, 3001)
    work = np.trapezoid(np.asarray(loads), np.asarray((loads / STIFFNESS) ** (2.0 / 3.0)))
    np.testing.assert_allclose(FACE.elastic_energy(300.0), work, rtol=1e-5)


def test_friction_takes_power():
    found = FACES(np.array([1e-5, -1e-6]), 0.0, -45.0, 22.0, MU)
    assert np.all(np.asarray(found.friction_along) * -45.0 + np.asarray(found.friction_across) * 22.0 > 0.0)
    np.testing.assert_allclose(found.friction_along / found.friction_across, -45.0 / 22.0, rtol=1e-13)


def test_expansion_of_the_balance():
    args = (jnp.asarray(1e-6), jnp.asarray(-6.0), jnp.log(STIFFNESS))
    for z in jnp.asarray([-3.0, 2.0, 6.0]):
        value, slope, curvature = _expansion(z, args)
        balance = lambda z: _balance(z, args)
        np.testing.assert_allclose(value, balance(z), rtol=1e-13)
        np.testing.assert_allclose(slope, jax.grad(balance)(z), rtol=1e-13)
        np.testing.assert_allclose(curvature, jax.grad(jax.grad(balance))(z), rtol=1e-12)
