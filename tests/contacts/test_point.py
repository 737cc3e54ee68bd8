"""Point contact: Hertz ellipse, film thickness, rolling moment: check values, limits, hard cases, gradients."""

import dataclasses
import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii
from scipy.special import ellipe, ellipk

from jaxbearing.contacts import (
    ChittendenCentral,
    Gupta,
    HamrockDowsonCentral,
    HamrockDowsonMinimum,
    NijenbanningVennerMoes,
    NoThermalReduction,
    PointContact,
    RigidBlend,
    RollingInlet,
    SourceRollingResistance,
    inlet_temperature_rise,
)
from jaxbearing.contacts.point import hertz_shape, log_ellipticity
from jaxbearing.lubricants import IntegratedPressureViscosity

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "point_contact.toml").read_text())
STEEL = 2.2747252747e11
# new law: add it, get every test
FILMS = [
    NijenbanningVennerMoes(),
    HamrockDowsonCentral(),
    HamrockDowsonMinimum(),
    ChittendenCentral(),
    RigidBlend(HamrockDowsonCentral()),
]
NAMES = lambda film: type(film).__name__
JITTED = {film: jax.jit(film.log_thickness) for film in FILMS}


def moment(contact, load, speed, viscosity, pressure_viscosity):
    """The source's rolling moment."""
    return SourceRollingResistance().moment(contact, RollingInlet(load, speed, viscosity, pressure_viscosity, 1e-6))


MOMENT = jax.jit(moment)
CONTACT = PointContact(0.01, 0.2, 2.3e11)
NOMINAL = (1000.0, 20.0, 5e-3, 1.04e-8)
"""load, entrainment speed, viscosity, pressure viscosity"""


def of_groups(function, contact, speed, material, load):
    """A law at U (sum speed), G and W instead of physical inputs; Rx and E' from the contact."""
    modulus, radius = contact.reduced_modulus, contact.reduced_radius_rolling
    viscosity = speed * modulus * radius / 40.0
    return function(contact, load * modulus * radius**2, 20.0, viscosity, material / modulus)


# -- Hertz


def test_ellipticity_check_values():
    row = PUBLISHED["ellipse"]
    log_k = jax.jit(log_ellipticity)(jnp.log(jnp.asarray(row["ratio"])))
    np.testing.assert_allclose(jnp.exp(log_k), row["ellipticity"], rtol=row["rtol"])


def test_ellipse_equation_by_scipy():
    for ratio in (1.01, 3.0, 300.0):
        k = float(PointContact(1.0, ratio, STEEL).ellipticity())
        m = 1 - 1 / k**2
        b, d = ellipe(m) - ellipk(m) / k**2, ellipk(m) - ellipe(m)  # times m; the differences cost 1e-16/m
        np.testing.assert_allclose(k**2 * b / d, ratio, rtol=1e-13 / m)


@pytest.mark.parametrize("row", PUBLISHED["hertz"], ids=lambda row: row["name"])
def test_hertz_check_values(row):
    contact = PointContact(row["rolling"], row["transverse"], STEEL)
    got = [f(row["load"]) for f in (contact.semi_axis_transverse, contact.semi_axis_rolling, contact.hertz_pressure)]
    # eight printed digits of inputs and results
    np.testing.assert_allclose(got, [row["major"], row["minor"], row["pressure"]], rtol=1e-7)
    swapped = PointContact(row["transverse"], row["rolling"], STEEL)
    np.testing.assert_allclose(swapped.semi_axis_rolling(row["load"]), row["major"], rtol=1e-7)
    carried = 2 / 3 * np.pi * got[0] * got[1] * got[2]
    np.testing.assert_allclose(carried, row["load"], rtol=1e-9)  # (1e-3/100)^2/2, the smoothing of the load
    np.testing.assert_allclose(contact.mean_pressure(row["load"]) * np.pi * got[0] * got[1], row["load"], rtol=1e-9)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 7.0, 300.0])
def test_stiffness(ratio):
    r"""From the approach $3QK(e)/(2\pi E^*a)$, a the larger semi-axis: Johnson, eq. (4.26)."""
    contact, load = PointContact(0.01, 0.01 * ratio, 2.2e11), 500.0
    small, large = sorted((float(contact.semi_axis_rolling(load)), float(contact.semi_axis_transverse(load))))
    approach = 3.0 * load * ellipk(1.0 - (small / large) ** 2) / (2.0 * np.pi * 0.5 * 2.2e11 * large)
    np.testing.assert_allclose(contact.stiffness_constant(), load / approach**1.5, rtol=1e-10)
    if ratio == 1.0:
        # the approach sees the relative radius of a sphere: 4/3 E* sqrt(R)
        np.testing.assert_allclose(contact.stiffness_constant(), 4.0 / 3.0 * 1.1e11 * np.sqrt(0.01), rtol=1e-12)


def test_ellipse_gradients():
    x = jnp.asarray([-13.0, -1.0, -1e-4, 0.0, 1e-9, 0.5, 4.0, 13.0])
    slope = jax.jit(jax.vmap(jax.grad(log_ellipticity)))(x)
    central = (log_ellipticity(x + 1e-4) - log_ellipticity(x - 1e-4)) / 2e-4
    np.testing.assert_allclose(slope, central, rtol=1e-8)
    np.testing.assert_allclose(slope[3], 2 / 3, rtol=1e-14)
    np.testing.assert_array_equal(log_ellipticity(-x), -log_ellipticity(x))


@jax.jit
def hertz_sizes(rolling, transverse, modulus, load):
    contact = PointContact(rolling, transverse, modulus)
    return jnp.log(jnp.stack([f(load) for f in (contact.semi_axis_rolling, contact.hertz_pressure)]))


HERTZ_SLOPES = jax.jit(jax.jacfwd(hertz_sizes, argnums=(0, 1, 2, 3)))


@pytest.mark.parametrize("ratio", [0.3, 1.0, 20.0])
def test_hertz_gradients(ratio):
    state = (0.01, 0.01 * ratio, STEEL, 500.0)
    gradient = HERTZ_SLOPES(*state)
    for i, value in enumerate(state):
        step = 1e-4 * value
        up, down = (hertz_sizes(*state[:i], value + s * step, *state[i + 1 :]) for s in (1, -1))
        np.testing.assert_allclose(gradient[i], (up - down) / (2 * step), rtol=1e-7)


def test_second_derivatives_of_the_shape():
    """Against differences of the first ones; at a circle by the series to second order in x = ln(Ry/Rx): ln k = 2x/3,
    sqrt(k) E = (pi/2)(1 + 3 ln^2 k/16)."""
    first = jax.jit(jax.vmap(jax.jacfwd(hertz_shape)))
    second = jax.jit(jax.vmap(jax.jacrev(jax.jacfwd(hertz_shape))))
    x, step = jnp.asarray([-3.0, -0.3, 0.2, 1.0, 8.0]), 1e-4
    for slope, before, after in zip(second(x), first(x - step), first(x + step), strict=True):
        np.testing.assert_allclose(slope, (after - before) / (2.0 * step), rtol=1e-6, atol=1e-9)
    at_circle = second(jnp.zeros(1))
    np.testing.assert_allclose(at_circle.log_ellipticity, 0.0, atol=1e-14)
    np.testing.assert_allclose(at_circle.size, np.pi / 12.0, rtol=1e-13)


def test_a_shaped_contact_is_the_same_and_forgets_its_shape_with_its_radii():
    plain = PointContact(10e-3, 35e-3, 220e9)
    shaped = plain.shaped()
    for one, other in zip(plain.ellipse(500.0), shaped.ellipse(500.0), strict=True):
        assert float(one) == float(other)
    assert plain.shape is None
    wider = dataclasses.replace(shaped, reduced_radius_transverse=70e-3)
    assert wider.shape is None
    assert float(wider.ellipticity()) == float(PointContact(10e-3, 70e-3, 220e9).ellipticity())
    slope = lambda make: jax.grad(lambda r: make(PointContact(10e-3, r, 220e9)).semi_axis_transverse(500.0))(35e-3)
    np.testing.assert_allclose(slope(lambda contact: contact.shaped()), slope(lambda contact: contact), rtol=1e-13)


@pytest.mark.parametrize("load", [0.0, -1.0, 1e-300, 1e-3, 1e9])
def test_hertz_hard_loads(load):
    for ratio in (1e-6, 1.0, 1e6):
        state = (0.01, 0.01 * ratio, STEEL, load)
        assert jnp.all(jnp.isfinite(hertz_sizes(*state)))
        assert all(jnp.all(jnp.isfinite(g)) for g in HERTZ_SLOPES(*state))


# -- film


def test_film_check_values():
    rows = PUBLISHED["film"]
    for speed, material, load, ratio, value in zip(
        rows["speed"], rows["material"], rows["load"], rows["radius_ratio"], rows["nijenbanning"], strict=True
    ):
        contact = PointContact(0.01, 0.01 / ratio, 2.3e11)
        got = jnp.exp(of_groups(JITTED[FILMS[0]], contact, speed, material, load)) / 0.01
        np.testing.assert_allclose(got, value, rtol=rows["rtol"])
    first = (PointContact(0.01, 0.01, 2.3e11), rows["speed"][0], rows["material"][0], rows["load"][0])
    for film, name in ((FILMS[1], "central"), (FILMS[2], "minimum")):
        np.testing.assert_allclose(
            jnp.exp(of_groups(JITTED[film], *first)) / 0.01, rows["hamrock_dowson"][name], rtol=rows["rtol"]
        )


def test_printed_factors_of_hamrock_and_dowson():
    """U (sum speed) = G = W = 1 and a very wide contact leave the factor alone."""
    wide = PointContact(0.01, 1e6, 2.3e11)
    for film, name in ((FILMS[1], "central"), (FILMS[2], "minimum")):
        got = jnp.exp(of_groups(JITTED[film], wide, 1.0, 1.0, 1.0)) / 0.01
        np.testing.assert_allclose(got, PUBLISHED["film"]["printed"][name], rtol=PUBLISHED["film"]["printed"]["rtol"])


def nijenbanning_h(m, l_group, ratio=1.0):
    """H at (M, L)."""
    speed = 1e-12
    contact = PointContact(0.01, 0.01 / ratio, 2.3e11)
    got = of_groups(JITTED[FILMS[0]], contact, speed, l_group * speed**-0.25, m * speed**0.75)
    return jnp.exp(got) / 0.01 / np.sqrt(speed)


@pytest.mark.parametrize(
    ("m", "l_group", "limit", "rtol"),
    [
        (
            1e-3,
            1e-9,
            145 * 1.796 ** (-15 / 7) * 1e6,
            2e-6,
        ),  # rigid isoviscous 41.3/M^2; next: 1.8^1.5/H_RI^1.5, M floor
        (1e5, 1e-9, 3.18 * 1.63**-0.56 * 1e5 ** (-2 / 15), 2e-3),  # elastic isoviscous 2.42; next: H_00: (H_EI/1.8)^4/4
        (1e8, 1e3, 1.48 * 1.63**-0.35 * 1e8 ** (-1 / 12) * 1e3**0.75, 2e-3),  # elastic piezoviscous 1.25
        (30.0, 1e8, 1.29 * 1.691 ** (-2 / 3) * 1e8 ** (2 / 3), 1e-2),  # rigid piezoviscous 0.909
    ],
)
def test_nijenbanning_limits(m, l_group, limit, rtol):
    np.testing.assert_allclose(nijenbanning_h(m, l_group), limit, rtol=rtol)


def test_nijenbanning_against_the_plain_formula():
    for m, l_group, lam in ((10.0, 3.0, 1.0), (200.0, 10.0, 0.1), (1000.0, 15.0, 0.04), (3.0, 1.0, 0.5)):
        c = 1 + 0.006 * np.log(lam) + 0.63 * lam ** (4 / 7)
        ri = 145 * (1 + 0.796 * lam ** (14 / 15)) ** (-15 / 7) / lam * m**-2
        rp = 1.29 * (1 + 0.691 * lam) ** (-2 / 3) * l_group ** (2 / 3)
        ei = 3.18 * c ** (-14 / 25) * lam ** (-1 / 15) * m ** (-2 / 15)
        ep = 1.48 * c ** (-7 / 20) * lam ** (-1 / 24) * m ** (-1 / 12) * l_group**0.75
        s = 1.5 * (1 + np.exp(-1.2 * ei / ep))
        h = (ri**1.5 + (ei**-4 + (1.8 / lam) ** -4) ** (-3 / 8)) ** (2 * s / 3) + (rp**-8 + ep**-8) ** (-s / 8)
        # |u1 + u2| levels off: (1e-6/40)^2
        np.testing.assert_allclose(nijenbanning_h(m, l_group, lam), h ** (1 / s), rtol=1e-12)


def test_isoviscous_oil():
    ri, ei = 145 * 1.796 ** (-15 / 7) / 25.0, 3.18 * 1.63**-0.56 * 5 ** (-2 / 15)
    h = (ri**1.5 + (ei**-4 + 1.8**-4) ** (-3 / 8)) ** (2 / 3)
    np.testing.assert_allclose(nijenbanning_h(5.0, 0.0), h, rtol=1e-9)
    assert [film.piezoviscous_only for film in FILMS] == [False, True, True, True, True]


def test_the_two_central_films_agree():
    nijenbanning, hamrock = (
        jnp.exp(JITTED[f](PointContact(0.01, 0.01, 2.3e11), 100.0, 5.0, 0.02, 2e-8)) for f in FILMS[:2]
    )
    np.testing.assert_allclose(nijenbanning, hamrock, rtol=0.1)


def test_chittenden_s_film():
    """Hamrock and Dowson's of a circle at typical groups; far less where it rolls along the major axis of the ellipse,
    where the oil escapes to the sides: there the bracket is linear in (Ry/Rx)^(2/3)."""
    groups = (1e-11, 4500.0, 1e-6)
    film = lambda law, ratio: jnp.exp(of_groups(JITTED[law], PointContact(0.01, 0.01 * ratio, 2.3e11), *groups))
    np.testing.assert_allclose(film(FILMS[3], 1.0), film(FILMS[1], 1.0), rtol=0.05)
    np.testing.assert_allclose(film(FILMS[3], 1e-6) / film(FILMS[3], 1e-9), 100.0, rtol=1e-4)  # next: 1.23e-4/2
    plain = 4.31 * (0.5e-11) ** 0.68 * 4500**0.49 * 1e-6**-0.073 * (1 - np.exp(-1.23 * 0.06 ** (2 / 3)))
    np.testing.assert_allclose(film(FILMS[3], 0.06) / 0.01, plain, rtol=1e-12)


FILM_SLOPES = {
    f: jax.jit(jax.grad(lambda *a, f=f: jnp.sum(f.log_thickness(*a)), argnums=(0, 1, 2, 3, 4))) for f in FILMS
}


def test_film_of_light_loads():
    """Joined to the rigid film: at most r^3/3 above the wrapped law, r the ratio of both, and the rigid film of the
    other law as the load vanishes."""
    circle, speed = PointContact(0.01, 0.01, 2.3e11), 2e-11
    at = lambda film, m: of_groups(JITTED[film], circle, speed, 10.0 * speed**-0.25, m * speed**0.75)
    for m in (10.0, 30.0, 100.0):
        plain, rigid = at(FILMS[1], m), np.log(0.01 * speed**0.5 * 145.0 * 1.796 ** (-15 / 7) / m**2)
        excess = np.exp(3.0 * (rigid - plain)) / 3.0
        np.testing.assert_allclose(np.expm1(at(FILMS[4], m) - plain), excess, rtol=1e-3, atol=1e-14)
        assert excess < {10.0: 3e-4, 30.0: 4e-7, 100.0: 4e-10}[m]
    for m, within in ((1e-2, 1e-8), (1e-4, 1e-12), (0.0, 1e-12)):
        np.testing.assert_allclose(at(FILMS[4], m), at(FILMS[0], m), rtol=0, atol=within)


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_film_hard_cases_value_and_gradient(film):
    load = jnp.asarray([0.0, 1e-12, 1.0, 1e9])[:, None]
    speed = jnp.asarray([0.0, -1e-9, 1e-3, 1e3])[None, :]
    for viscosity in (1e-4, 1e4):
        for alpha in (0.0, 1e-8):
            for ratio in (0.1, 1.0, 1e6):
                inputs = (PointContact(0.01, 0.01 * ratio, 2.3e11), load, speed, viscosity, alpha)
                value = JITTED[film](*inputs)
                assert value.shape == (4, 4)
                assert jnp.all(jnp.isfinite(value))
                assert all(jnp.all(jnp.isfinite(g)) for g in jax.tree.leaves(FILM_SLOPES[film](*inputs)))


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_film_gradients(film):
    sizes = (0.01, 0.2, 2.3e11)
    function = lambda state: JITTED[film](PointContact(*state[:3]), *state[3:])
    state = np.asarray((*sizes, *NOMINAL))
    contact, *rest = FILM_SLOPES[film](PointContact(*sizes), *NOMINAL)
    for i, slope in enumerate((*jax.tree.leaves(contact), *rest)):
        step = 1e-4 * state[i] * np.eye(7)[i]
        central = (function(state + step) - function(state - step)) / (2e-4 * state[i])
        # relative to 1/argument: truncation and round-off of ln h
        np.testing.assert_allclose(slope * state[i], central * state[i], rtol=1e-7, atol=1e-10)
    load, speed, viscosity, alpha = NOMINAL
    assert JITTED[film](CONTACT, load, -speed, viscosity, alpha) == JITTED[film](CONTACT, load, speed, viscosity, alpha)


def test_inlet_temperature_rise_check_row():
    """Film, Gupta's factor and the rise of one and the same point contact."""
    oil = mobil_jet_ii()
    viscosity = oil.viscosity
    alpha = IntegratedPressureViscosity(viscosity)
    contact = PointContact(0.02, 0.02, 2.25275e11)
    load = np.pi**3 * 0.02**2 * 1.5e9**3 / (6 * (2.25275e11 / 2) ** 2)  # Hertz, sphere on flat
    film = lambda t, args: FILMS[0].log_thickness(
        args[0], args[1], 40.0, viscosity.viscosity(0.0, t), alpha.coefficient(t)
    )

    @jax.jit
    def everything(contact, load):
        isothermal = film(jnp.asarray(373.0), (contact, load))
        factor = Gupta().log_factor(contact, load, 40.0, 0.0, oil.at(373.0))
        return isothermal, factor, inlet_temperature_rise(film, (contact, load), 373.0, isothermal, factor).value

    isothermal, factor, rise = everything(contact, load)
    got = [jnp.exp(isothermal), jnp.exp(factor), rise]
    np.testing.assert_allclose(got, [6.017851e-7, 0.7465165, 18.28891], rtol=1e-6)  # seven printed digits
    assert NoThermalReduction().log_factor(contact, jnp.ones(3), 40.0, 0.0, oil.at(373.0)).shape == (3,)


# -- rolling moment


def test_rolling_arm_check_value():
    row = PUBLISHED["rolling_arm"]
    k = row["semi_axis_transverse"] / row["semi_axis_rolling"]
    m = 1 - 1 / k**2
    ratio = k**2 * (ellipe(m) - ellipk(m) / k**2) / (ellipk(m) - ellipe(m))  # the radii with this ellipse
    unit = PointContact(1.0, ratio, 2.147e11)
    size = unit.semi_axis_rolling(row["load"] * 2.147e11)  # a/Rx at this W
    contact = PointContact(row["semi_axis_rolling"] / size, ratio * row["semi_axis_rolling"] / size, 2.147e11)
    moment = of_groups(MOMENT, contact, row["speed"], row["material"], row["load"])
    load = row["load"] * 2.147e11 * contact.reduced_radius_rolling**2
    np.testing.assert_allclose(moment / load, row["arm"], rtol=row["rtol"])


def test_rolling_moment_of_a_circle_against_houpert():
    """F = 2.86 E' Rx^2 k^0.348 G^0.022 U^0.66 W^0.47 (U mean); the moment is 2 F Rx."""
    contact = PointContact(0.01, 0.01, 2.3e11)
    for speed, load in ((1e-11, 1e-6), (1e-10, 1e-5), (1e-11, 1e-4)):
        houpert = 2.86 * 2.3e11 * 1e-4 * 4000**0.022 * (speed / 2) ** 0.66 * load**0.47
        np.testing.assert_allclose(of_groups(MOMENT, contact, speed, 4000.0, load), 2 * houpert * 0.01, rtol=0.03)


def test_rolling_moment_exponents_and_sign():
    load, speed, viscosity, alpha = NOMINAL
    moment = MOMENT(CONTACT, load, speed, viscosity, alpha)
    assert moment > 0
    assert MOMENT(CONTACT, load, -speed, viscosity, alpha) == -moment
    np.testing.assert_allclose(MOMENT(CONTACT, load, 2 * speed, viscosity, alpha) / moment, 2**0.656, rtol=1e-12)
    more = MOMENT(CONTACT, 2 * load, speed, viscosity, alpha) / moment
    np.testing.assert_allclose(more, 2 ** (1 + 3 * 0.022 - 0.35 * 8 / 3 + 1 / 3), rtol=1e-9)  # load smoothing
    assert MOMENT(CONTACT, 0.0, speed, viscosity, alpha) == 0
    assert MOMENT(CONTACT, load, 0.0, viscosity, alpha) == 0


def test_rolling_moment_hard_cases_and_gradients():
    derivative = jax.jit(jax.grad(lambda *a: jnp.sum(moment(*a)), argnums=(0, 1, 2, 3, 4)))
    load = jnp.asarray([0.0, 1e-12, 1.0, 1e6])[:, None]
    speed = jnp.asarray([0.0, -1e-9, 1e-3, 1e3])[None, :]
    for alpha in (0.0, 1e-8):
        assert jnp.all(jnp.isfinite(MOMENT(CONTACT, load, speed, 5e-3, alpha)))
        assert all(jnp.all(jnp.isfinite(g)) for g in jax.tree.leaves(derivative(CONTACT, load, speed, 5e-3, alpha)))
    gradient = derivative(CONTACT, *NOMINAL)[1:]
    for i, value in enumerate(NOMINAL):
        step = 1e-4 * value
        up, down = (MOMENT(CONTACT, *NOMINAL[:i], value + s * step, *NOMINAL[i + 1 :]) for s in (1, -1))
        np.testing.assert_allclose(gradient[i], (up - down) / (2 * step), rtol=1e-7)
