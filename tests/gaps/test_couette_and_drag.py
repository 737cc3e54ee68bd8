"""Roller ends against flange and cage rails; oil drag; the quadrature rule."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from jaxbearing.gaps import (
    Flange,
    PocketEdge,
    ReynoldsDrag,
    RollerDrag,
    air_density,
    ball_frontal_area,
    cylinder_drag_coefficient,
    mixture_density,
    parker_oil_fraction,
    saturated_oil_fraction,
    sphere_drag_coefficient,
)
from jaxbearing.gaps.drag import FLOW_WIDTH
from jaxbearing.numerics.quadrature import gauss_legendre

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "gaps.toml").read_text())
MU = 4.7e-3
INNER = Flange(65e-3, 67.5e-3, 71e-3, 6e-3, 15e-6, float(np.deg2rad(0.375)))
OUTER = Flange(77e-3, 74.5e-3, 71e-3, 6e-3, 15e-6, float(np.deg2rad(0.375)))
EDGE = PocketEdge(67.5e-3, 73e-3, 71e-3, 6e-3, 175e-6)
INNER_FILM = jax.jit(lambda spin, ring: INNER.coefficients(MU).evaluate(spin, ring))
OUTER_FILM = jax.jit(lambda spin, ring: OUTER.coefficients(MU).evaluate(spin, ring))
FLOW = 150e-3 / 3600.0
SPEED = 10500.0 * np.pi / 30.0


def all_finite(tree):
    return all(bool(np.all(np.isfinite(leaf))) for leaf in jax.tree.leaves(tree))


@pytest.mark.parametrize("row", PUBLISHED["flange"]["rows"])
def test_flange_rows(row):
    got = INNER_FILM(row[0], row[1])
    np.testing.assert_allclose(got, row[2:], rtol=PUBLISHED["flange"]["rtol"])


def test_pocket_edge_rows():
    rows = PUBLISHED["pocket_edge"]
    got = jax.jit(lambda spin: EDGE.coefficients(MU).evaluate(spin))(-6467.0)
    expected = [rows["tangential_force"], rows["moment"], 0.0, rows["power"]]
    np.testing.assert_allclose(got, expected, rtol=rows["rtol"])
    np.testing.assert_allclose(EDGE.overlap_area(), rows["overlap"], rtol=rows["rtol"])


@settings(deadline=None, derandomize=True, max_examples=25)
@given(st.floats(-1e4, 1e4), st.floats(-2e3, 2e3), st.booleans())
def test_flange_identities(spin, ring, inner):
    flange = INNER if inner else OUTER
    end = (INNER_FILM if inner else OUTER_FILM)(spin, ring)
    r_m = flange.pitch_radius
    scale = abs(r_m * end.tangential_force) + abs(end.moment) + abs(end.ring_moment)
    # M is the small difference of terms about (R_m/R_R)^2 larger: round-off times 140
    atol = 1e-12 * float(scale) + 1e-15 * (abs(spin) + abs(ring))
    np.testing.assert_allclose(r_m * end.tangential_force + end.moment + end.ring_moment, 0.0, atol=atol)
    assert float(end.power) >= -1e-12


@pytest.mark.parametrize("flange", [INNER, OUTER, Flange(66e-3, 80e-3, 71e-3, 6e-3, 15e-6, 0.005)])
def test_flange_against_plain_quadrature(flange):
    """Traction -mu dv/h summed over the lens in polar coordinates by scipy, without our formulas."""
    w, om, r_m, r_r = -6467.0, 597.0, 71e-3, 6e-3
    lo, hi = sorted((flange.race_radius, flange.rim_radius))
    lo, hi = max(lo, r_m - r_r), min(hi, r_m + r_r)

    def ring(r, which):
        phi = np.arccos(np.clip((r * r + r_m**2 - r_r**2) / (2 * r * r_m), -1, 1))
        h = flange.side_clearance + abs(r - flange.race_radius) * np.tan(flange.angle)

        def density(a):  # bearing centre O, roller centre on the y axis; e_t of the roller = -x
            x, y = r * np.sin(a), r * np.cos(a)
            vx = -w * (y - r_m) + om * y
            vy = w * x - om * x
            tx, ty = -MU * vx / h, -MU * vy / h
            return {"force": -tx, "moment": x * ty - (y - r_m) * tx, "ring": -(x * ty - y * tx)}[which]

        nodes, weights = gauss_legendre(20)
        return sum(wt * 2 * phi * density(phi * (2 * n - 1)) for n, wt in zip(nodes, weights, strict=True)) * r

    got = flange.coefficients(MU).evaluate(w, om)
    for which, value in zip(("force", "moment", "ring"), got[:3], strict=True):
        expected = 2 * quad(ring, lo, hi, args=(which,), epsabs=0, epsrel=1e-11, limit=300)[0]
        # scipy's rule has to resolve the square root at the circle's edge, and cancels in the moment
        np.testing.assert_allclose(value, expected, rtol=1e-8)


def test_whole_roller_is_covered():
    """A rail that covers the roller: area pi R^2, int rho^2 = pi R^4/2, no net force."""
    edge = PocketEdge(60e-3, 80e-3, 71e-3, 6e-3, 175e-6, n_sides=1)
    np.testing.assert_allclose(edge.overlap_area(), np.pi * 36e-6, rtol=1e-12)
    coefficients = edge.coefficients(MU)
    np.testing.assert_allclose(coefficients.polar, MU / 175e-6 * np.pi * 6e-3**4 / 2, rtol=1e-11)
    np.testing.assert_allclose(coefficients.first, 0.0, atol=1e-12 * float(coefficients.polar) / 6e-3)


def test_rail_that_hardly_touches():
    rails = [(60e-3, 65e-3), (50e-3, 60e-3), (77e-3, 80e-3), (80e-3, 82e-3), (64e-3, 65.001e-3), (71e-3, 71e-3)]

    def f(*a):
        edge = PocketEdge(*a)
        return edge.overlap_area(), *edge.coefficients(MU).evaluate(-6467.0)

    args = jnp.asarray([(*r, 71e-3, 6e-3, 175e-6) for r in rails]).T
    values = jax.jit(jax.vmap(f))(*args)
    assert all_finite(values)
    # at most 1 um deep: area 4/3 depth sqrt(2 depth R) = 1.5e-10 m^2
    assert np.all((np.asarray(values[0]) >= 0) & (np.asarray(values[0]) < 2e-10))
    for mode in (jax.jacfwd, jax.jacrev):
        assert all_finite(jax.jit(jax.vmap(mode(f, argnums=tuple(range(5)))))(*args))


def test_flange_hard_cases():
    def f(race, rim, film, spin, ring):
        return Flange(race, rim, 71e-3, 6e-3, film, 0.0).coefficients(MU).evaluate(spin, ring)

    cases = [
        (flange.race_radius, rim, film, spin, 0.0)
        for flange in (INNER, OUTER)
        for rim in (flange.rim_radius, flange.race_radius)  # a flange of no height too
        for film in (0.0, -1e-6, 15e-6)
        for spin in (0.0, -6e3)
    ]
    args = jnp.asarray(cases).T
    assert all_finite(jax.jit(jax.vmap(f))(*args))
    for mode in (jax.jacfwd, jax.jacrev):
        assert all_finite(jax.jit(jax.vmap(mode(f, argnums=tuple(range(5)))))(*args))


def test_gradients_finite_at_the_tangent_race_in_every_argument():
    args = (65e-3, 67.5e-3, 71e-3, 6e-3, 15e-6, 0.0065)
    f = lambda *a: Flange(*a).coefficients(MU).evaluate(-6467.0, 597.0)
    for mode in (jax.jacfwd, jax.jacrev):
        assert all_finite(jax.jit(mode(f, argnums=tuple(range(6))))(*args))


@pytest.mark.parametrize("kind", ["flange", "edge"])
def test_gradients_with_respect_to_geometry(kind):
    if kind == "flange":
        args = np.array([65.3e-3, 67.5e-3, 71e-3, 6e-3, 15e-6, 0.0065])
        f = lambda *a: jnp.stack(Flange(*a).coefficients(MU).evaluate(-6467.0, 597.0))
    else:
        args = np.array([67.5e-3, 73e-3, 71e-3, 6e-3, 175e-6])
        f = lambda *a: jnp.stack(PocketEdge(*a).coefficients(MU).evaluate(-6467.0))
    f = jax.jit(f)
    jac = jax.jit(jax.jacfwd(f, argnums=tuple(range(len(args)))))(*args)
    for i in range(len(args)):
        h = 1e-5 * args[i]
        up, down = args.copy(), args.copy()
        up[i] += h
        down[i] -= h
        fd = np.asarray(f(*up) - f(*down)) / (2 * h)
        # round-off: the moment is a difference of terms 140 times larger, hence 1e-13 over h
        noise = 1e-13 * np.abs(np.asarray(f(*args))) / h
        assert np.all(np.abs(jac[i] - fd) <= 1e-6 * np.abs(fd) + noise)


def test_tangent_race_gradient():
    """At R_race = R_m - R_R exactly, the seed geometry: the slope towards a larger race is met."""
    f = jax.jit(lambda race: INNER.__class__(race, 67.5e-3, 71e-3, 6e-3, 15e-6, 0.0065).coefficients(MU).second)
    h = 1e-8
    fd = (f(65e-3 + h) - f(65e-3)) / h
    # one-sided difference across a 3/2 power: error about sqrt(h/R) times a coefficient of order 1
    np.testing.assert_allclose(jax.grad(f)(65e-3), fd, rtol=2e-2)


def test_flange_batches():
    spin = jnp.linspace(-7000.0, 0.0, 5)
    batch = INNER_FILM(spin, 597.0)
    one = INNER_FILM(spin[2], 597.0)
    np.testing.assert_allclose(np.stack(one), np.stack(batch)[:, 2], rtol=1e-12)
    mu = jnp.asarray([1e-3, 2e-3])
    two = INNER.coefficients(mu).evaluate(-5000.0, 700.0)
    np.testing.assert_allclose(two.power[1], 2.0 * two.power[0], rtol=1e-12)


def test_gauss_rule():
    nodes, weights = gauss_legendre(5)
    for power in range(10):
        np.testing.assert_allclose(np.sum(weights * nodes**power), 1.0 / (power + 1), rtol=1e-14)
    with pytest.raises(ValueError, match="n >= 1"):
        gauss_legendre(0)


@pytest.mark.parametrize("row", PUBLISHED["drag"]["rows"])
def test_drag_rows(row):
    got = [sphere_drag_coefficient(row[0]), cylinder_drag_coefficient(row[0])]
    np.testing.assert_allclose(got, row[1:], rtol=PUBLISHED["drag"]["rtol"])


def test_oil_fraction_rows():
    got = 100.0 * parker_oil_fraction(FLOW, -SPEED, 0.142)
    np.testing.assert_allclose(got, PUBLISHED["drag"]["oil_percent"], rtol=PUBLISHED["drag"]["rtol"])
    printed = PUBLISHED["drag"]["printed"]
    np.testing.assert_allclose(got, printed["oil_percent"], atol=printed["atol"])
    # saturation: relative X^4/4 = 5.1e-7 at 3.8 %
    np.testing.assert_allclose(100.0 * saturated_oil_fraction(FLOW, SPEED, 0.142), got, rtol=1e-6)
    half = parker_oil_fraction(FLOW, SPEED, 0.142, 0.5) / parker_oil_fraction(FLOW, SPEED, 0.142)
    np.testing.assert_allclose(half, 0.5**0.37, rtol=1e-12)


def test_oil_fraction_limits():
    flow = jnp.asarray([0.0, 1e-12, 1e-6, 1.0, 1e3])
    speeds = jnp.asarray([0.0, -5.0, 1e-30, 1e3])
    x = np.asarray(jax.jit(saturated_oil_fraction)(flow[:, None], speeds[None, :], 0.142))
    assert np.all(x[0] == 0.0)
    assert np.all((x >= 0) & (x <= 1))
    for mode in (jax.jacfwd, jax.jacrev):
        slopes = jax.vmap(mode(saturated_oil_fraction, argnums=(0, 1, 2)), (0, 0, None))
        assert all_finite(jax.jit(slopes)(jnp.asarray([0.0, 0.0, 1e-9, 0.0]), speeds, 0.142))
    slope = jax.jit(jax.grad(parker_oil_fraction))(0.0, SPEED, 0.142)
    np.testing.assert_allclose(slope, 1e5 * 6e7 * FLOW_WIDTH**-0.63 / (10500.0 * 142.0**1.7), rtol=1e-12)
    # below 100 rpm nothing changes any more, but for the smoothing (7 % at 100 rpm)
    np.testing.assert_allclose(parker_oil_fraction(FLOW, 0.0, 0.142), parker_oil_fraction(FLOW, 5.0, 0.142), rtol=1e-2)


def test_drag_coefficients_finite():
    re = jnp.asarray([0.0, 1e-9, 1e-4, 1.0, 2e5, 3e5, 1e9])
    for law in (sphere_drag_coefficient, cylinder_drag_coefficient):
        assert np.all(np.asarray(law(re)) > 0)
        assert all_finite([jax.jit(jax.vmap(mode(law)))(re) for mode in (jax.jacfwd, jax.jacrev)])
    np.testing.assert_array_equal(sphere_drag_coefficient(1e9), sphere_drag_coefficient(3e5))
    np.testing.assert_array_equal(cylinder_drag_coefficient(1e9), cylinder_drag_coefficient(2e5))


def test_stokes_limit():
    np.testing.assert_allclose(sphere_drag_coefficient(1e-4) * 1e-4, 24.0, rtol=5e-4)  # next term 0.15 Re^0.687


def test_roller_drag():
    drag = RollerDrag(1.2, 14e-3 * 6.5e-3)
    density = mixture_density(saturated_oil_fraction(FLOW, SPEED, 0.142), 938.2, air_density(373.15))
    v = jnp.asarray([-40.0, 0.0, 40.0])
    f = drag.force(v, density)
    np.testing.assert_allclose(f, 0.5 * density * 1.2 * 91e-6 * np.array([-1600.0, 0.0, 1600.0]), rtol=1e-13)
    np.testing.assert_allclose(drag.power(v, density), np.abs(f * v), rtol=1e-14)
    assert float(jax.grad(drag.force)(0.0, 30.0)) == 0.0
    np.testing.assert_allclose(air_density(293.15), 1.2056, rtol=1e-4)  # hand calculation, 5 digits
    np.testing.assert_allclose(air_density(293.15, 2 * 101325.0), 2 * air_density(293.15), rtol=1e-14)


def test_cylinder_drag_below_its_range_follows_lamb():
    """Cd Re = 8 pi/ln(7.406/Re) of a slow cylinder, 7.406 = 8 exp(1/2 - Euler's constant)."""
    re = np.logspace(-5.5, -4, 4)
    lamb = 8 * np.pi / np.log(8 * np.exp(0.5 - np.euler_gamma) / re)
    np.testing.assert_allclose(cylinder_drag_coefficient(re) * re, lamb, rtol=0.12)


def test_reynolds_drag_is_the_printed_formula():
    """F = 1/2 rho Cd S V|V|, on both sides of the frozen Reynolds numbers."""
    v = np.asarray([-90.0, -3.0, 1e-3, 1.0, 50.0, 1e4])
    for shape, law in (("sphere", sphere_drag_coefficient), ("cylinder", cylinder_drag_coefficient)):
        drag = ReynoldsDrag(12e-3, 91e-6, shape)
        force = np.asarray(jax.jit(drag.force)(v, 36.3, MU))
        plain = 0.5 * 36.3 * np.asarray(law(36.3 * np.abs(v) * 12e-3 / MU)) * 91e-6 * v * np.abs(v)
        # |Re| is smoothed by 1e-6: 1e-8 at the smallest, Re = 0.09
        np.testing.assert_allclose(force, plain, rtol=1e-9)
        np.testing.assert_allclose(jax.jit(drag.power)(v, 36.3, MU), force * v, rtol=1e-14)


def test_reynolds_drag_at_rest_is_stokes():
    area = 0.25 * np.pi * 36e-6
    drag = ReynoldsDrag(6e-3, area)
    # 3 pi mu D = 12 S mu/D; next term 0.15 Re^0.687 with Re = 1e-6 at rest
    np.testing.assert_allclose(jax.jit(jax.grad(drag.force))(0.0, 30.0, MU), 3 * np.pi * MU * 6e-3, rtol=2e-5)
    assert drag.force(0.0, 30.0, MU) == 0


def test_reynolds_drag_hard_cases_and_gradients():
    v = jnp.asarray([0.0, 1e-12, -1e-6, 1.0, -1e3, 1e6])
    density, viscosity = jnp.full(6, 30.0), jnp.full(6, MU)
    for shape in ("sphere", "cylinder"):
        force = jax.jit(ReynoldsDrag(12e-3, 91e-6, shape).force)
        slopes = jax.jit(jax.vmap(jax.grad(force, argnums=(0, 1, 2))))
        assert all_finite([force(v, density, viscosity), slopes(v, density, viscosity)])
        state = np.array([2.0, 30.0, MU])
        got = slopes(*(np.full(6, x) for x in state))
        for i in range(3):
            step = 1e-5 * state[i] * np.eye(3)[i]
            central = (force(*(state + step)) - force(*(state - step))) / (2e-5 * state[i])
            np.testing.assert_allclose(got[i][0], central, rtol=1e-8)


def test_ball_frontal_area():
    np.testing.assert_allclose(ball_frontal_area(0.02, 0.005), np.pi * 1e-4 - 1e-4, rtol=1e-14)
    assert ball_frontal_area(0.02, 0.03) == 0  # a cage thicker than the ball covers it


@pytest.mark.parametrize(("litres", "error"), [(0.1, 0.104), (1.0, 1.6e-5), (10.0, 1.6e-9), (150.0, 1e-13)])
def test_parkers_law_is_met_above_the_width_of_its_linear_part(litres, error):
    """The regularised law is too low, by no more than its docstring says."""
    flow = litres * 1e-3 / 3600.0
    exact = 1e5 * (flow * 6e7) ** 0.37 / (10500.0 * 142.0**1.7)
    low = 1.0 - float(parker_oil_fraction(flow, SPEED, 0.142)) / exact
    assert -1e-13 < low <= error
