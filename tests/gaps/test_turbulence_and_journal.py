"""Journal lands: published rows, quadrature, limits, hard cases, gradients, the static inverse."""

import functools
import itertools
import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from jaxbearing.gaps import BlendedTurbulence, FullTurbulence, Laminar, LongJournal, ShortJournal
from jaxbearing.gaps.journal import OFFSET_SHIFT, _film_integrals, saturated_eccentricity

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "gaps.toml").read_text())
LAND = ShortJournal(0.0675, 3.98e-3, 1.2e-4)
MU = 4.7e-3
TURBULENCE = [Laminar(), BlendedTurbulence(), FullTurbulence()]


def force(e, v, wj, wb, land=LAND):
    """Without the shift of the offset that the law adds, so that closed forms are met to round-off."""
    x = jnp.asarray(e[0]) - OFFSET_SHIFT * land.clearance
    return jnp.stack(land.force_on_journal(x, e[1], v[0], v[1], wj, wb, MU, 12.0))


FORCE = jax.jit(force)


def static_force(st_film, wj, wb, land=LAND):
    """Film force at the static place, journal along +x."""
    x = st_film.eccentricity_ratio * land.clearance - OFFSET_SHIFT * land.clearance
    return jnp.stack(land.force_on_journal(x, 0.0, 0.0, 0.0, wj, wb, MU, 12.0))


gauss = functools.cache(np.polynomial.legendre.leggauss)
STATIC = jax.jit(lambda load, wj, wb: LAND.static_equilibrium(load, wj, wb, MU, 12.0))
STATIC_FORCE = jax.jit(static_force)


def all_finite(tree):
    return all(bool(np.all(np.isfinite(leaf))) for leaf in jax.tree.leaves(tree))


def with_slopes(f):
    """A program for rows of numbers: values of `f`, and their derivatives in both modes."""
    return jax.jit(jax.vmap(lambda row: (f(row), jax.jacfwd(f)(row), jax.jacrev(f)(row))))


@pytest.mark.parametrize("row", PUBLISHED["short_journal"]["rows"])
def test_force_rows(row):
    ex, ey, vx, vy, wj, wb, fx, fy = row
    size = np.hypot(fx, fy)
    # e = 0 has no direction of its own: the plain call, with the shift
    got = LAND.force_on_journal(ex, ey, vx, vy, wj, wb, MU, 12.0) if ex == ey == 0 else force(row[:2], row[2:4], wj, wb)
    np.testing.assert_allclose(got, [fx, fy], rtol=PUBLISHED["short_journal"]["rtol"], atol=1e-6 * size)
    # the shift moves the journal by 1e-7 c: measured 1.3e-6 at eps = 0.93
    shifted = LAND.force_on_journal(ex, ey, vx, vy, wj, wb, MU, 12.0)
    np.testing.assert_allclose(shifted, [fx, fy], atol=3e-6 * size)


def test_torque_and_static_rows():
    rows = PUBLISHED["land_torque"]
    land = ShortJournal(0.0675, 3.98e-3, 2.4e-4)
    film = land.static_equilibrium(rows["load"], 1099.557, 502.4, MU, 12.0)
    # the printed load has 8 digits, so eps has as many
    np.testing.assert_allclose(film.eccentricity_ratio, 0.2, rtol=2e-8)
    np.testing.assert_allclose(jnp.rad2deg(film.attitude_angle), rows["attitude_degrees"], rtol=rows["rtol"])
    tj, tb = land.torques(film.eccentricity_ratio, film.tangential_force, 1099.557, 502.4, MU, 1.0)
    np.testing.assert_allclose([tj, tb], [rows["journal"], rows["bush"]], rtol=rows["rtol"])
    power = land.dissipation(tj, tb, 1099.557, 502.4)
    np.testing.assert_allclose(power, -tj * 1099.557 - tb * 502.4, rtol=1e-12)


@pytest.mark.parametrize("row", PUBLISHED["turbulence"]["rows"])
def test_turbulence_rows(row):
    speed, re, critical, k_z, c_f = row
    land = ShortJournal(0.0675, 3.98e-3, 2.4e-4)
    got = land.film_factors(938.2, MU, -speed)
    np.testing.assert_allclose(got, [k_z, c_f], rtol=PUBLISHED["turbulence"]["rtol"])
    np.testing.assert_allclose(BlendedTurbulence().factors(re, critical), [k_z, c_f], rtol=1e-6)


def test_turbulence_modes():
    re = np.linspace(0.0, 5000.0, 301)
    factors = jax.jit(lambda re: [jnp.stack(jnp.broadcast_arrays(*t.factors(re, 700.0))) for t in TURBULENCE])
    laminar, blend, full = (np.asarray(both) for both in factors(re))
    for k in range(2):
        below, above = re <= 700.0, re >= 1400.0
        np.testing.assert_array_equal(blend[k][below], laminar[k][below])
        np.testing.assert_array_equal(blend[k][above], full[k][above])
        assert np.all(np.diff(blend[k]) >= 0)
    # 56 % too much friction at the onset
    np.testing.assert_allclose(FullTurbulence().factors(691.0, 691.0)[1] - 1.0, 0.56, atol=5e-3)


@pytest.mark.parametrize("law", TURBULENCE, ids=lambda law: type(law).__name__)
def test_turbulence_finite(law):
    land = ShortJournal(0.0675, 3.98e-3, 2.4e-4, law)
    run = with_slopes(lambda row: jnp.stack(jnp.broadcast_arrays(*land.film_factors(*row))))
    assert all_finite(run(np.array([(938.2, MU, speed) for speed in (0.0, 1e-300, 213.0, -597.0, 1e6)])))


@pytest.mark.parametrize("eps", [0.0, 1e-9, 0.3, 0.9, 0.97])
@pytest.mark.parametrize("v", [(0.0, -1.0), (1.0, 0.0), (-1.0, 0.3), (0.2, 2.0), (-1.0, -3.0)])
def test_film_integrals_against_quadrature(eps, v):
    start = np.arctan2(v[0], -v[1])
    # Gauss-Legendre on either side of the peak at theta = pi (mod 2 pi), 300 nodes each: converged
    cuts = [start, *[p for p in (-np.pi, np.pi) if start < p < start + np.pi], start + np.pi]
    x, w = gauss(300)
    expected = np.zeros(3)
    for lo, hi in itertools.pairwise(cuts):
        t = 0.5 * (hi - lo) * x + 0.5 * (hi + lo)
        kernels = np.stack([np.sin(t) ** 2, np.sin(t) * np.cos(t), np.cos(t) ** 2])
        expected += kernels @ (w / (1 + eps * np.cos(t)) ** 3) * 0.5 * (hi - lo)
    got = _film_integrals(eps, v[0], v[1], 1e-16)
    # round-off, relative to the largest integral: B may vanish by symmetry
    np.testing.assert_allclose(got, expected, rtol=1e-10, atol=1e-10 * max(map(abs, expected)))


def test_concentric_limit():
    """F = -(pi/2) K v, v the velocity seen in the mean-rotating frame, next term O(eps)."""
    k = LAND.film_constant(MU, 12.0)
    np.testing.assert_allclose(
        force((1e-14, 0.0), (0.1, -0.2), 0.0, 0.0), -np.pi / 2 * k * np.array([0.1, -0.2]), rtol=1e-8
    )


@settings(deadline=None, derandomize=True, max_examples=30)
@given(st.floats(0.01, 0.98), st.floats(-3, 3), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-3e3, 3e3))
def test_rotation_and_dissipation(eps, angle, vx, vy, speed):
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    e = np.array([eps * LAND.clearance, 0.0])
    v = np.array([vx, vy])
    f = FORCE(e, v, speed, 0.0)
    # K v / (1-eps^2)^2.5 amplifies round-off of the angle
    scale = 1e-9 * float(np.linalg.norm(f)) + 1e-13
    np.testing.assert_allclose(FORCE(turn @ e, turn @ v, speed, 0.0), turn @ np.asarray(f), atol=scale)
    # the film takes power from the velocity seen in the mean-rotating frame
    seen = v - 0.5 * speed * np.array([0.0, e[0]])
    assert float(f @ seen) <= 1e-12


HARD = [
    (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.0, 0.0, 0.0, 0.0, 1000.0, 400.0),
    (0.0, 0.0, 0.1, 0.0, 1000.0, 400.0),
    (-1.2e-11, 0.0, 0.1, 0.0, 1000.0, 400.0),
    (1e-5, 0.0, 0.0, 0.0, 500.0, -500.0),
    (1e-5, 0.0, 0.0, 0.3, 500.0, -500.0),
    (1e-5, -1e-5, 0.1, 0.0, -500.0, -800.0),
    (1.2e-4, 0.0, 0.1, 0.0, 500.0, 100.0),
    (1e-3, -3e-3, 0.1, -5.0, 500.0, 100.0),
    (1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
]


def test_force_hard_cases_and_gradient():
    """Values and derivatives are finite; of a usual case they are those of differences."""
    run = with_slopes(lambda row: jnp.stack(LAND.force_on_journal(*row, MU, 12.0)))
    cases = np.array([(5e-5, 3e-5, -0.05, 0.03, 1100.0, 500.0), *HARD])
    found = run(cases)
    assert all_finite(found)
    for i, h in enumerate([1e-10, 1e-10, 1e-6, 1e-6, 1e-2, 1e-2]):
        step = h * np.eye(6)[i]
        # central differences: truncation about h^2, round-off about 1e-16/h, both below 1e-6
        fd = (run(cases + step)[0][0] - run(cases - step)[0][0]) / (2 * h)
        for slopes in found[1:]:
            np.testing.assert_allclose(slopes[0][:, i], fd, rtol=1e-6)


def test_force_pushes_back_beyond_the_clearance():
    e = np.linspace(0.9, 3.0, 200) * LAND.clearance
    along = jax.jit(lambda e, journal, bush: LAND.force_on_journal(e, 0.0, 0.0, 0.0, journal, bush, MU, 12.0)[0])
    fx, still = np.asarray(along(e, 1466.0, 670.0)), np.asarray(along(e, 0.0, 0.0))
    assert np.all(np.diff(fx) < 0)
    # no film: contact alone
    np.testing.assert_allclose(np.diff(still)[-1] / np.diff(e)[-1], -1e8, rtol=1e-10)


def test_saturation_is_the_identity_below():
    eps = jnp.linspace(0.0, 0.98, 50)
    np.testing.assert_allclose(saturated_eccentricity(eps), eps, rtol=4e-10)
    assert float(saturated_eccentricity(1e6)) < 1.0


SPEEDS = [(1466.0, 670.0), (-1466.0, -670.0), (300.0, -299.0), (0.0, 0.0), (500.0, -500.0)]


@pytest.mark.parametrize(("wj", "wb"), SPEEDS)
def test_static_equilibrium_is_the_inverse(wj, wb):
    load = jnp.asarray([1e-12, 1e-9, 1e-3, 0.1, 3.0, 20.0, 1e3, 1e6])
    film = STATIC(load, wj, wb)
    f = STATIC_FORCE(film, wj, wb)
    # |mean speed| is smoothed by 1e-12 rad/s: a film of at most 1e-11 N (2e-9 N at 1 MN) at rest
    atol = 0.0 if wj + wb else 1e-11
    np.testing.assert_allclose(np.linalg.norm(f, axis=0), load, rtol=1e-10, atol=atol)
    assert np.all(np.asarray(film.residual) < 1e-11)
    if wj + wb:
        np.testing.assert_allclose(f[1], film.tangential_force, rtol=1e-10)
        phi = np.arctan2(np.abs(f[1]), -f[0])
        np.testing.assert_allclose(film.attitude_angle, phi, rtol=1e-9)
        assert np.all(np.sign(film.tangential_force) == np.sign(wj + wb))


def test_static_torque_power_is_force_times_velocity():
    """Dissipation = shear heat + pumping F_t e omega_s, both >= 0."""
    film = LAND.static_equilibrium(2.0, 1466.0, 670.0, MU, 12.0)
    tj, tb = LAND.torques(film.eccentricity_ratio, film.tangential_force, 1466.0, 670.0, MU, 1.3)
    pumping = film.tangential_force * film.eccentricity_ratio * LAND.clearance * 0.5 * (1466.0 + 670.0)
    shear = 0.5 * (tb - tj) * (1466.0 - 670.0)
    np.testing.assert_allclose(LAND.dissipation(tj, tb, 1466.0, 670.0), shear + pumping, rtol=1e-12)
    assert pumping > 0
    assert shear > 0


def test_static_equilibrium_hard_cases_and_gradients():
    """Values and derivatives are finite; of usual cases they are those of differences; at no load there is a closed
    form."""

    def f(row):
        load, wj, wb, mu, k_z, radius, width, clearance = row
        film = ShortJournal(radius, width, clearance).static_equilibrium(load, wj, wb, mu, k_z)
        return jnp.stack([film.eccentricity_ratio, film.attitude_angle, film.tangential_force, film.residual])

    run, base = with_slopes(f), np.array([MU, 12.0, 0.0675, 3.98e-3, 1.2e-4])
    hard = [(w, *speeds, *base) for w in (0.0, 1e-12, 0.1, 30.0, 1e6) for speeds in SPEEDS]
    first = (0.0, 1000.0, 400.0, *base)
    points = np.array([(load, 1466.0, 670.0, MU, 14.0, *base[2:]) for load in (0.01, 0.5, 30.0, 500.0)])
    cases = np.array([*points, first, *hard])
    value, forward, reverse = (np.asarray(found) for found in run(cases))
    assert all_finite((value, forward, reverse))
    unloaded = cases[:, 0] == 0
    assert np.all(value[unloaded, 0] == 0.0)
    np.testing.assert_allclose(value[unloaded, 1], np.pi / 2, rtol=1e-15)
    exact = 1.0 / (LAND.film_constant(MU, 12.0) * LAND.clearance * 700.0 * np.pi / 2)
    np.testing.assert_allclose(reverse[4, 0, 0], exact, rtol=1e-12)
    value, forward, reverse = value[:4, :3], forward[:4, :3], reverse[:4, :3]
    np.testing.assert_allclose(reverse, forward, rtol=1e-9)
    for i in range(points.shape[1]):
        step = np.zeros_like(cases)
        step[:4, i] = h = 1e-5 * points[:, i]
        fd = np.asarray(run(cases + step)[0] - run(cases - step)[0])[:4, :3] / (2 * h[:, None])
        # truncation h^2 times third derivatives; round-off 1e-13 of the value over h
        noise = 1e-13 * np.abs(value) / h[:, None]
        assert np.all(np.abs(forward[:, :, i] - fd) <= 1e-6 * np.abs(fd) + noise)


def test_eager_jit_vmap_agree():
    load = jnp.linspace(0.0, 40.0, 20_001)
    f = lambda w: LAND.static_equilibrium(w, 1466.0, 670.0, MU, 12.0).eccentricity_ratio
    batch = f(load)
    # a lane of a batch takes a few more Newton steps than alone: round-off
    np.testing.assert_allclose(jax.jit(jax.vmap(f))(load), batch, rtol=1e-12)
    np.testing.assert_allclose(f(load[17_001]), batch[17_001], rtol=1e-12)
    assert np.all(np.diff(batch) > 0)


def test_bad_count_refused():
    with pytest.raises(ValueError, match="n_lands"):
        ShortJournal(0.1, 0.01, 1e-4, n_lands=0)


BALL = LongJournal(0.01, 1.0, 1e-4)


@pytest.mark.parametrize("row", PUBLISHED["long_journal"]["rows"])
def test_long_journal_rows(row):
    eps, rate, speed, fr, ft = row
    got = BALL.force_on_journal(eps, rate, 2.0 * speed + 40.0, 0.0, 20.0, MU)
    np.testing.assert_allclose(got, [fr, ft], rtol=PUBLISHED["long_journal"]["rtol"])


def test_long_journal_wedge_against_reynolds():
    """Independent: p of the long bearing by quadrature of Reynolds' equation, cut to 0..pi."""
    eps, speed = 0.6, 500.0
    h = lambda t: 1 + eps * np.cos(t)
    i2, i3 = (quad(lambda t, n=n: h(t) ** -n, 0, 2 * np.pi)[0] for n in (2, 3))
    slope = lambda t: (h(t) - i2 / i3) / h(t) ** 3  # dp/dtheta / (12 mu w R^2/c^2)
    cos = quad(lambda t: slope(t) * np.sin(t), 0, np.pi)[0]  # int p cos = -int p' sin
    sin = quad(lambda t: slope(t) * np.cos(t), 0, np.pi)[0]  # int p sin = +int p' cos, p(0) = p(pi) = 0
    scale = 12 * MU * speed * 0.01**3 / 1e-8
    # force on the journal = -int p e_n over its surface; p acts from the bush side towards it
    fr, ft = BALL.force_on_journal(eps, 0.0, 2 * speed, 0.0, 0.0, MU)
    np.testing.assert_allclose([abs(fr), abs(ft)], [abs(scale * cos), abs(scale * sin)], rtol=1e-9)
    assert fr < 0 < ft


def test_long_journal_finite():
    def f(row):
        eps, _, speed = row
        return jnp.stack([*BALL.force_on_journal(*row, 0.0, 0.0, MU), *BALL.torques(eps, 3.0, speed, 0.0, MU)])

    assert all_finite(with_slopes(f)(np.array([(eps, 0.1, 500.0) for eps in (0.0, 0.5, 0.999, 1.5, 1e3)])))


def test_petroff_limit():
    petroff = 2 * np.pi * MU * 500.0 * 0.01**3 / 1e-4
    np.testing.assert_allclose(BALL.friction_torque(0.0, 500.0, 0.0, MU), petroff, rtol=1e-13)
