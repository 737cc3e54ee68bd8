"""Martin's film and the roller in its pocket."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from jaxbearing.gaps import (
    MARTIN_LOAD,
    MARTIN_ROLLING,
    MARTIN_SHEAR,
    CompliantPocketFace,
    LongJournal,
    Pocket,
    ShortJournal,
    martin_exit,
    martin_factors,
    martin_load,
    martin_rolling,
    martin_shear,
    side_leakage_factor,
)
from jaxbearing.gaps.pocket import _face_balance, _face_expansion

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "gaps.toml").read_text())
MU, R, LENGTH = 4.7e-3, 6e-3, 14e-3
MODULUS = 2.0 / ((1 - 0.3**2) / 210e9 + (1 - 0.34**2) / 110e9)
FACE = CompliantPocketFace(R, LENGTH, MODULUS, 10.4e-9)
FACE_MU = 0.004867548502744159
POCKET = Pocket(300e-6, LENGTH, R)
BALANCE = jax.jit(POCKET.balance)
FACE_PROGRAM = jax.jit(FACE.face)


def faces(gap, rate, speed):
    """Faces of up to 500 cases, by one program."""
    cases = np.broadcast_arrays(*map(np.atleast_1d, (gap, rate, speed)))
    padded = (jnp.asarray(np.pad(case, (0, 500 - len(case)), mode="edge")) for case in cases)
    return jax.tree.map(lambda leaf: leaf[: len(cases[0])], FACE_PROGRAM(*padded, FACE_MU))


def all_finite(tree):
    return all(bool(np.all(np.isfinite(leaf))) for leaf in jax.tree.leaves(tree))


def with_slopes(f):
    """A program for rows of numbers: values of `f`, and their derivatives in both modes."""
    return jax.jit(jax.vmap(lambda row: (f(row), jax.jacfwd(f)(row), jax.jacrev(f)(row))))


@pytest.mark.parametrize("row", PUBLISHED["martin"]["rows"])
def test_martin_rows(row):
    s, t, *factors = row
    np.testing.assert_allclose(martin_exit(s), t, rtol=PUBLISHED["martin"]["rtol"])
    np.testing.assert_allclose(martin_factors(s), factors, rtol=PUBLISHED["martin"]["rtol"])


def test_martin_constants():
    np.testing.assert_allclose(martin_factors(0.0), [MARTIN_LOAD, MARTIN_SHEAR, MARTIN_ROLLING], rtol=1e-15)


def reference_factors(s):
    """Reynolds' equation by Gauss quadrature and bisection, no closed form of ours.

    Units h0, sqrt(2 R h0), mu u sqrt(2 R h0)/h0^2: (h^3 p'/12)' = h' + s, h = 1 + X^2, p' = 0 and
    p = 0 at the exit T, p = 0 far ahead: p' = 12 (X - T)(X + T + s)/h^3. With X = -cot(b) the
    integrands are trigonometric polynomials, which 60 nodes integrate to round-off.
    """
    nodes, weights = np.polynomial.legendre.leggauss(60)

    def integrate(t, weight):
        end = np.arctan2(1.0, -t)
        b = 0.5 * end * (nodes + 1.0)
        x = -np.cos(b) / np.sin(b)
        slope = 12.0 * (x - t) * (x + t + s) * np.sin(b) ** 6
        return np.sum(weights * weight(x) * slope / np.sin(b) ** 2) * 0.5 * end

    t = brentq(integrate, -0.5 * abs(s) - 1.0, abs(s) + 1.0, args=(np.ones_like,), xtol=1e-13, rtol=1e-14)
    # W = integral of 2 p dX in units of mu u R L/h0, by parts
    load = -2.0 * integrate(t, lambda x: x)
    return t, load, np.arctan(t) + 0.5 * np.pi, integrate(t, lambda x: 1.0 + x * x)


@pytest.mark.parametrize("s", [0.0, -0.7, 1.3, -40.0, 25.0, -299.0, 299.0, -1e3, 1e3])
def test_factors_against_quadrature_of_reynolds(s):
    t, load, shear, rolling = reference_factors(s)
    # round-off of the reference: at s = -299 its rolling integral cancels terms 1e4 times larger
    np.testing.assert_allclose(martin_exit(s), t, rtol=1e-12)
    np.testing.assert_allclose(martin_factors(s), [load, shear, rolling], rtol=1e-10)


@pytest.mark.parametrize("size", [1e4, 1e8, 1e18])
def test_martin_limits(size):
    # the next terms are 1.83/s^2 of the loads and at most 0.48/s of the others; rounding is below 1e-12
    approach, apart = martin_factors(-size), martin_factors(size)
    np.testing.assert_allclose([martin_exit(-size), martin_exit(size)], [size, -0.375 * size], rtol=2 / size + 1e-14)
    limits = [3 * np.pi * size, 128 / (27 * size**2)]
    np.testing.assert_allclose([approach.load, apart.load], limits, rtol=2 / size**2 + 1e-12)
    np.testing.assert_allclose([approach.shear, apart.shear * size], [np.pi, 8 / 3], rtol=2 / size + 1e-12)
    np.testing.assert_allclose([approach.rolling, apart.rolling * size], [4 * np.pi, 64 / 9], rtol=2 / size + 1e-12)


def test_martin_is_monotone():
    s = np.concatenate([-np.geomspace(1e6, 1e-6, 300), np.geomspace(1e-6, 1e6, 300)])
    factors, place = jax.jit(lambda s: (martin_factors(s), martin_exit(s)))(s)
    load = np.asarray(factors.load)
    assert np.all(load > 0)
    assert np.all(np.diff(load) <= 0)
    assert np.all(np.diff(np.asarray(place)) <= 0)


def test_martin_gradients():
    s = np.asarray([-250.0, -3.0, -1e-3, 0.0, 0.7, 2.0, 40.0, 250.0])
    h = 1e-5 * np.maximum(1.0, np.abs(s))
    run = with_slopes(lambda s: jnp.stack([martin_exit(s), *martin_factors(s)]))
    value, forward, reverse = run(s)
    np.testing.assert_allclose(reverse, forward, rtol=1e-12)
    fd = np.subtract(run(s + h)[0], run(s - h)[0]) / (2 * h[:, None])
    # h^2 truncation and round-off of T (1e-14 of it) over h
    noise = 1e-14 * np.abs(np.asarray(value)) / h[:, None]
    assert np.all(np.abs(forward - fd) <= 1e-6 * np.abs(fd) + noise)


@pytest.mark.parametrize("row", PUBLISHED["pocket_wall"]["rows"])
def test_wall_rows(row):
    film, rate, w, fs, half_p = row
    u = 38.8 / 2
    rtol = PUBLISHED["pocket_wall"]["rtol"]
    np.testing.assert_allclose(martin_load(MU, u, R, LENGTH, film, rate), w, rtol=rtol)
    np.testing.assert_allclose(martin_shear(MU, 38.8, u, R, LENGTH, film, rate), fs, rtol=rtol)
    np.testing.assert_allclose(0.5 * martin_rolling(MU, u, R, LENGTH, film, rate), half_p, rtol=rtol)


def test_wall_hard_cases():
    cases = [(0.0, 0.0), (0.0, -0.1), (0.0, 0.1), (1e-12, -1.0), (50.0, -1e3), (50.0, 1e3)]

    def walls(row):
        u, rate, film = row
        load, rolling = (law(MU, u, R, LENGTH, film, rate) for law in (martin_load, martin_rolling))
        return jnp.stack([load, martin_shear(MU, u, u, R, LENGTH, film, rate), rolling])

    assert all_finite(with_slopes(walls)(np.array([(*case, 1e-6) for case in cases])))


def test_pure_squeeze_of_a_line_contact():
    r"""u = 0: Reynolds' equation integrates to $W = 3\sqrt2\pi\mu L(R/h)^{3/2}(-\dot h)$, 40.76 N here."""
    film, rate = 1e-6, -0.1
    load = lambda u, h, v: martin_load(MU, u, R, LENGTH, h, v)
    slopes_of_load = jax.jit(jax.grad(load, (0, 1, 2)))
    exact = 3 * np.sqrt(2) * np.pi * MU * LENGTH * (R / film) ** 1.5 * -rate
    np.testing.assert_allclose(exact, 40.760443, rtol=1e-8)
    # the next term is of order (u/w)^2 of it, w = hdot sqrt(2R/h) = 11 m/s
    for u in (0.0, 1e-6, 1e-3):
        np.testing.assert_allclose(load(u, film, rate), exact, rtol=1e-14 + u**2 / 50)
        slopes = slopes_of_load(u, film, rate)
        np.testing.assert_allclose(slopes[1:], [-1.5 * exact / film, exact / rate], rtol=1e-13 + u**2 / 10)
        np.testing.assert_allclose(slopes[0], 0.0, atol=10 * u)
    assert 0 < load(0.0, film, -rate) < 1e-20  # separating: (128/27) mu u L R/h (u/w)^2
    np.testing.assert_allclose(load(0.1, film, -rate) / load(0.05, film, -rate), 8.0, rtol=1e-3)
    side = MU * LENGTH * np.sqrt(2 * R / film)
    np.testing.assert_allclose(martin_shear(MU, 1.0, 0.0, R, LENGTH, film, rate), np.pi * side, rtol=1e-9)
    for other in (martin_shear(MU, 1.0, 0.0, R, LENGTH, film, -rate), martin_rolling(MU, 0.0, R, LENGTH, film, rate)):
        np.testing.assert_allclose(other, 0.0, atol=2e-8 * side)  # u is 1e-9 m/s at rest


LAND, BALL_POCKET = ShortJournal(0.0675, 3.98e-3, 1.2e-4), LongJournal(0.01, 0.01, 1e-4)
AT_REST = {
    "line film": lambda speed, rate: martin_load(MU, speed, R, LENGTH, 1e-6, rate),
    "line shear": lambda speed, rate: martin_shear(MU, 1.0, speed, R, LENGTH, 1e-6, rate),
    "pocket face": lambda speed, rate: FACE.face(2e-6, rate, speed, MU).load,
    "cage land": lambda speed, rate: LAND.force_on_journal(6e-5, 0.0, -rate, 0.0, speed, speed, MU, 12.0)[0],
    "ball pocket": lambda speed, rate: BALL_POCKET.force_on_journal(0.5, -rate, speed, 0.0, 0.0, MU)[0],
}


@pytest.mark.parametrize("name", AT_REST)
@pytest.mark.parametrize("rate", [-0.1, -10.0])
def test_squeeze_film_has_a_limit_at_rest(name, rate):
    """What a film carries by squeeze is there at every speed of the surfaces: no floor of the speed may take it."""
    law = jax.jit(jax.value_and_grad(AT_REST[name], (0, 1)))
    rest, slopes = law(0.0, rate)
    assert abs(rest) > 0
    assert all_finite(slopes)
    for speed in (1e-9, 1e-6, 1e-4):
        value, along = law(speed, rate)
        np.testing.assert_allclose(value, rest, rtol=1e-3 * speed / 1e-4 + 1e-9)
        np.testing.assert_allclose(along[1], slopes[1], rtol=1e-3, atol=1e-3 * abs(rest / rate))


@settings(deadline=None, derandomize=True, max_examples=40)
@given(st.floats(-1e5, 1e5), st.floats(-1e4, 1e4))
def test_pocket_balance(load, spin):
    film = BALANCE(load, spin, MU)
    # each load is k/film, so their difference is P to round-off of the larger
    np.testing.assert_allclose(film.load_front - film.load_rear, load, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(film.film_front + film.film_rear, POCKET.clearance, rtol=1e-14)
    assert min(film.film_front, film.film_rear) > 0
    assert (film.friction_front + film.friction_rear) * spin >= 0
    mirror = BALANCE(-load, spin, MU)
    # at P = 0 the tight and the wide film are computed differently: round-off
    np.testing.assert_allclose([mirror.film_front, mirror.load_rear], [film.film_rear, film.load_front], rtol=1e-13)


def test_pocket_meets_martin():
    spin = 38.8 / R
    film = BALANCE(4.0, spin, MU)
    u = 0.5 * spin * R
    args = (R, LENGTH, film.film_front, 0.0)
    # the load speed is 1.2e-8 too high by design
    np.testing.assert_allclose(film.load_front, martin_load(MU, u, *args), rtol=2e-8)
    np.testing.assert_allclose(film.friction_front, martin_shear(MU, 2 * u, u, *args), rtol=1e-12)
    with_rolling = jax.jit(Pocket(300e-6, LENGTH, R, rolling=True).balance)(4.0, spin, MU)
    extra = with_rolling.friction_front - film.friction_front
    np.testing.assert_allclose(extra, 0.5 * martin_rolling(MU, u, *args), rtol=1e-12)
    assert film.film_front < film.film_rear  # P > 0 presses on the front wall


def test_pocket_finite_and_gradient():
    loads, spins = [0.0, 1e-9, -1e-9, 5.0, -5.0, 1e6], [0.0, 6467.0, -10.0]
    cases = np.array([(p, w, MU) for p in loads for w in spins])
    run = with_slopes(lambda row: jnp.stack(POCKET.balance(*row)))
    value, forward, reverse = run(cases)
    assert all_finite((value, forward, reverse))
    # a step small against the load at which the films become unequal, 2 k/Jp
    k = 0.5 * MARTIN_LOAD * MU * np.sqrt(cases[:, 1] ** 2 + 1) * R**2 * LENGTH
    h = 1e-4 * (k / POCKET.clearance + np.abs(cases[:, 0]))[:, None]
    step = h * [1.0, 0.0, 0.0]
    fd = np.subtract(run(cases + step)[0], run(cases - step)[0]) / (2 * h)
    # truncation (1e-4)^2; the wide film moves by round-off only when the other one is tight
    noise = 1e-14 * np.abs(np.asarray(value)) / h
    for slope in (forward, reverse):
        assert np.all(np.abs(slope[..., 0] - fd) <= 1e-6 * np.abs(fd) + noise)


def test_compliant_rows():
    rows = np.array(PUBLISHED["compliant_face"]["rows"]).T
    got = faces(*rows[:3])
    np.testing.assert_allclose(jnp.stack(got[:3]), rows[3:], rtol=PUBLISHED["compliant_face"]["rtol"])
    # film - flattening = gap, to round-off; the reported residual is that before the last step, whose cube is left
    np.testing.assert_allclose(got.film - FACE.compliance * got.load**0.9, rows[0], atol=1e-14 * np.max(got.film))
    assert np.all(np.asarray(got.residual) < 1e-5)


def test_compliant_face_is_monotone_and_meets_its_limits():
    gap = jnp.concatenate([jnp.linspace(-1e-5, 1e-5, 400), jnp.geomspace(1.1e-5, 1e-3, 100)])
    face = faces(gap, 0.0, 51.0)
    assert np.all(np.diff(face.load) < 0)
    # wide gap: Martin with the speed sqrt(U^2 + 0.25)/2; flattening shortens the gap by < 1e-6 of it
    martin = martin_load(FACE_MU, 0.5 * np.sqrt(51.0**2 + 0.25), R, LENGTH, 1e-3, 0.0)
    np.testing.assert_allclose(face.load[-1], martin, rtol=1e-5)
    np.testing.assert_allclose(face.film - FACE.compliance * face.load**0.9, gap, atol=1e-14 * 1e-3)
    # deep overlap: Palmgren's flattening is the overlap plus the elastic film
    deep = faces(-1e-5, 0.0, 51.0)
    delta = 0.39 * (8 / MODULUS) ** 0.9 / LENGTH**0.8 * deep.load**0.9
    np.testing.assert_allclose(deep.film - delta, -1e-5, rtol=1e-10)


def test_value_slope_and_curvature_of_the_face_are_those_of_its_balance():
    z = jnp.linspace(-12.0, 12.0, 25)
    args = tuple(jnp.full(z.shape, value) for value in (5e-6, -12.0, -14.5, -18.0))
    one = lambda x, a: jnp.squeeze(_face_balance(x[None], tuple(v[None] for v in a)))
    slope = jax.grad(one)
    exact = jax.vmap(lambda x, a: (one(x, a), slope(x, a), jax.grad(slope)(x, a)))
    all_found, all_wanted = jax.jit(lambda z, args: (_face_expansion(z, args), exact(z, args)))(z, args)
    for found, wanted in zip(all_found, all_wanted, strict=True):
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-20)


HARD_FACES = [
    (0.0, 0.0, 0.0),
    (-1e-5, 0.3, 0.0),
    (1e-3, -0.3, 0.0),
    (-1e-3, -1.0, 51.0),
    (1e-3, 5.0, -51.0),
    (1e-7, -100.0, 1e-3),
    (1.0, 1e3, 0.0),
]


POINTS = [(1e-6, -0.2, 51.0), (-2e-6, 0.1, 40.0), (5e-5, 0.05, -30.0)]


def test_compliant_hard_cases_and_gradient():
    """Values and derivatives are finite; of a usual case they are those of differences."""
    out = faces(*np.transpose(HARD_FACES))
    assert all_finite(out)
    assert np.all(np.asarray(out.load) > 0)
    assert np.all(np.asarray(out.residual) < 1e-9)
    run = with_slopes(lambda row: jnp.stack(FACE.face(*row)[:3]))
    points = np.array([[*case, FACE_MU] for case in (*POINTS, *HARD_FACES)])
    value, forward, reverse = (np.asarray(found) for found in run(points))
    assert all_finite((value, forward, reverse))
    usual = slice(0, len(POINTS))
    np.testing.assert_allclose(reverse[usual], forward[usual], rtol=1e-9)
    for i, h in enumerate([1e-10, 1e-5, 1e-2, 1e-7]):
        step = h * np.eye(4)[i]
        fd = np.asarray(run(points + step)[0] - run(points - step)[0])[usual] / (2 * h)
        # h^2 truncation; roots are found to 1e-14 of ln Q
        noise = 1e-13 * np.abs(value[usual]) / h
        assert np.all(np.abs(forward[usual, :, i] - fd) <= 1e-6 * np.abs(fd) + noise)


def test_side_leakage():
    # -12 % at 100 um (-12.5 by the fit), -1.2 % at 1 um, as stated for 14 mm
    np.testing.assert_allclose(side_leakage_factor(LENGTH, R, jnp.asarray([1e-4, 1e-6])), [0.8746, 0.988], atol=5e-4)
    assert all_finite(jax.jit(jax.grad(side_leakage_factor, argnums=(0, 1, 2)))(LENGTH, R, 1e-6))
