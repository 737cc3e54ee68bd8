"""Line contacts with a varying approach: check values, energy, hard cases, laminae and profiles."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import scipy.integrate

from jaxbearing.contacts import CrownedProfile, LineContact, LogarithmicProfile, SlicedLine, StraightLine
from jaxbearing.contacts.profile import lundberg_drop
from jaxbearing.contacts.tilted_line import palmgren_stiffness

MODULUS = 206e9 / (1.0 - 0.09)
LENGTH = 9.6e-3
K = palmgren_stiffness(LENGTH, MODULUS)
EXACT = StraightLine(K, LENGTH)
CASES = [(2e-6, 0.0), (2e-6, 1e-3), (-2e-6, 1e-3), (2e-6, -1e-3), (2e-6, -1e-4), (2e-6, 1e-9), (5e-6, 2e-4)]


@eqx.filter_jit
def loads_of_arrays(line, f, g):
    return line.load_and_moment(f, g)


def loads(line, f, g):
    """Compiled once for each kind of line."""
    return loads_of_arrays(line, jnp.asarray(f), jnp.asarray(g))


def test_check_values():
    np.testing.assert_allclose(K, 1.3498969e11, rtol=5e-8)
    expected = {
        (2e-6, 0.0): (603.091107, 2.89483731),
        (2e-6, 1e-3): (2374.43590, 14.3290322),
        (-2e-6, 1e-3): (996.823318, 7.13440689),
    }
    for (f, g), values in expected.items():
        np.testing.assert_allclose(loads(EXACT, f, g), values, rtol=5e-9)


@pytest.mark.parametrize(("f", "g"), CASES)
def test_against_quadrature(f, g):
    density = lambda s: float(K) * max(f + g * s, 0.0) ** (10.0 / 9.0)
    edge = [-f / g] if g and 0.0 < -f / g < LENGTH else None
    options = {"points": edge, "epsabs": 0.0, "epsrel": 1e-12, "limit": 200}
    load = scipy.integrate.quad(density, 0.0, LENGTH, **options)[0]
    moment = scipy.integrate.quad(lambda s: density(s) * s, 0.0, LENGTH, **options)[0]
    np.testing.assert_allclose(loads(EXACT, f, g), (load, moment), rtol=1e-10)


def test_even_contact_is_palmgrens():
    plain = LineContact(1e-3, LENGTH, MODULUS)
    load, moment = loads(EXACT, 3e-6, 0.0)
    np.testing.assert_allclose(load, plain.palmgren_load(3e-6), rtol=1e-13)
    np.testing.assert_allclose(moment, load * LENGTH / 2.0, rtol=1e-13)


def test_both_ways_of_integrating_meet():
    """Where the smaller approach is 0.3 of the larger one, on both sides."""
    for rising in (True, False):
        ends = np.array([0.3, 1.0]) * 1e-5
        low, high = ends if rising else ends[::-1]
        f, g = low, (high - low) / LENGTH
        beside = [np.array(loads(EXACT, f + h, g - h / LENGTH)) for h in (-1e-17, 1e-17)]
        np.testing.assert_allclose(beside[0], beside[1], rtol=1e-11)


PROFILES = {"straight": None, "crowned": CrownedProfile(5e-6, 0.4), "logarithmic": LogarithmicProfile(5e-6)}
LINES = {"exact": EXACT} | {name: SlicedLine(K, LENGTH, profile) for name, profile in PROFILES.items()}


@pytest.mark.parametrize("name", LINES)
def test_loads_are_the_gradient_of_the_energy(name):
    line = LINES[name]
    for f, g in CASES:
        slope, ((_, load_g), (moment_f, _)) = slopes(line, jnp.asarray(f), jnp.asarray(g))
        np.testing.assert_allclose(slope, loads(line, f, g), rtol=1e-8)
        np.testing.assert_allclose(load_g, moment_f, rtol=1e-7)


@eqx.filter_jit
def slopes(line, f, g):
    """Of the energy, and of load and moment."""
    return jax.grad(line.energy, argnums=(0, 1))(f, g), jax.jacfwd(line.load_and_moment, argnums=(0, 1))(f, g)


@pytest.mark.slow
@pytest.mark.parametrize("name", LINES)
def test_finite_everywhere(name):
    line = LINES[name]
    for f in (-1e-3, -1e-6, 0.0, 1e-300, 1e-6, 1e-2):
        for g in (-1.0, -1e-3, -1e-300, 0.0, 1e-12, 1e-3, 1.0):
            value = line.load_and_moment(f, g)
            slopes = jax.jacfwd(line.load_and_moment, argnums=(0, 1))(f, g)
            back = jax.jacrev(line.load_and_moment, argnums=(0, 1))(f, g)
            assert np.all(np.isfinite(np.array(value)))
            assert np.all(np.isfinite(np.array(slopes)))
            assert np.all(np.isfinite(np.array(back)))
            assert value[0] >= 0.0
            if max(f, f + g * LENGTH) <= 0.0:
                assert value == (0.0, 0.0)


@pytest.mark.parametrize(("f", "g"), [(2e-6, 1e-3), (4e-6, -3e-4)])
def test_laminae_converge_to_the_integral(f, g):
    exact = np.array(loads(EXACT, f, g))
    counts = np.array([6, 12, 24, 48])
    errors = [np.abs(np.array(loads(SlicedLine(K, LENGTH, count=int(n)), f, g)) / exact - 1.0) for n in counts]
    orders = [np.polyfit(np.log(counts), np.log([error[i] for error in errors]), 1)[0] for i in range(2)]
    np.testing.assert_allclose(orders, -4.0, atol=0.2)
    thirty = np.array(loads(SlicedLine(K, LENGTH), f, g))
    np.testing.assert_allclose(thirty, exact, rtol=2e-6)  # asked: 1e-4


def test_laminae_add_up():
    line = SlicedLine(K, LENGTH, PROFILES["logarithmic"])
    f, g = jnp.asarray([4e-6, -1e-6, 1e-6]), jnp.asarray([1e-4, 4e-4, -1e-3])
    laminae = np.asarray(line.laminae(f, g, 30))
    assert laminae.shape == (3, 30)
    np.testing.assert_allclose(np.sum(laminae, axis=1), loads(line, f, g)[0], rtol=1e-13)
    fine = jax.jit(lambda f, g: jnp.sum(EXACT.laminae(f, g, 4000), axis=1))
    np.testing.assert_allclose(fine(f, g), loads(EXACT, f, g)[0], rtol=1e-6)


def test_profiles():
    drop_at = eqx.filter_jit(lambda profile, x: profile.drop_at(x))
    x = np.linspace(-1.0, 1.0, 21)
    for profile in PROFILES.values():
        if profile is not None:
            drop = np.asarray(drop_at(profile, x))
            np.testing.assert_allclose(drop[[0, 10, 20]], [5e-6, 0.0, 5e-6], rtol=1e-12, atol=1e-20)
            assert np.all(np.diff(drop[10:]) >= 0.0)
    # Lundberg's profile away from the ends
    amplitude, ratio = 0.00035 * 12e-3, 1e-9
    inside = np.linspace(-0.9, 0.9, 7)
    found = drop_at(LogarithmicProfile(lundberg_drop(amplitude, ratio), ratio), inside)
    np.testing.assert_allclose(found, amplitude * np.log(1.0 / (1.0 - inside**2)), rtol=1e-7, atol=1e-20)
    # the parabola
    near = drop_at(LogarithmicProfile(5e-6, 1.0 - 1e-6), x)
    np.testing.assert_allclose(near, 5e-6 * x**2, atol=1e-11)
    with pytest.raises(ValueError, match=r"profile.drop must be >= 0"):
        CrownedProfile(-1e-6)


INVERTED = {
    "straight": EXACT,
    "unlike races": StraightLine(K, LENGTH, ratio=jnp.asarray([[0.8], [1.2]])),
    "logarithmic": SlicedLine(K, LENGTH, LogarithmicProfile(5e-6)),
    "crowned": SlicedLine(K, LENGTH, CrownedProfile(2e-6), count=11),
}
SLOPES = (0.0, 1e-9, 2e-5, -1e-4, 1e-3, -1e-2)


@pytest.mark.parametrize("name", INVERTED)
def test_the_approach_under_a_load_is_the_inverse_of_the_load(name):
    """From almost no load to 100 kN, from an even contact to one that touches at an end only; and its derivatives are
    those of the implicit function."""
    line = INVERTED[name]
    load = jnp.broadcast_to(jnp.asarray([1e-3, 1.0, 3e3, 1e5])[:, None], (2, 4, len(SLOPES)))
    slope = jnp.broadcast_to(jnp.asarray(SLOPES), load.shape)
    load, slope = load.reshape(2, -1), slope.reshape(2, -1)
    inverse = lambda q, g: line.approach_under(q, g).value

    @jax.jit
    def both(load, slope):
        ones, zero = jnp.ones_like(load), jnp.zeros_like(load)
        f = inverse(load, slope)
        forward = [jax.jvp(inverse, (load, slope), seeds)[1] for seeds in ((ones, zero), (zero, ones))]
        back = [
            jax.jvp(lambda f, g: line.load_and_moment(f, g)[0], (f, slope), s)[1] for s in ((ones, zero), (zero, ones))
        ]
        return line.load_and_moment(f, slope)[0], forward, back, line.approach_under(load, slope).residual

    carried, (by_load, by_slope), (stiffness, turning), residual = both(load, slope)
    # where an end touches by 1e-12 m, the approach at the other end has its last digit there
    np.testing.assert_allclose(carried, load, rtol=2e-9)
    np.testing.assert_allclose(carried[:, len(SLOPES) :], load[:, len(SLOPES) :], rtol=1e-11)
    assert np.max(np.abs(residual)) < 2e-9
    np.testing.assert_allclose(by_load * stiffness, 1.0, rtol=1e-6)
    np.testing.assert_allclose(by_slope, -turning / stiffness, rtol=1e-6)
