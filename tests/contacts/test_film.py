"""Film thickness: check values, the source's full solutions, asymptotes, hard cases, gradients."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii, pennzane_x2000
from scipy.integrate import quad
from scipy.optimize import brentq

from jaxbearing.contacts import (
    DowsonHigginson,
    DowsonToyoda,
    Grubin,
    LineContact,
    MartinBlend,
    Moes,
    PanHamrockCentral,
    PanHamrockMinimum,
)
from jaxbearing.contacts.film import MARTIN_CONSTANT
from jaxbearing.contacts.traction import INLET_COUETTE_CONSTANT

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "line_contact.toml").read_text())
POWER_LAWS = [DowsonHigginson(), DowsonToyoda(), PanHamrockCentral(), PanHamrockMinimum(), Grubin()]
FILMS = [Moes(), MartinBlend(DowsonHigginson()), *POWER_LAWS]  # new law: add it, get every test
JITTED = {film: jax.jit(film.log_thickness) for film in FILMS}
NAMES = lambda film: type(film).__name__
PENNZANE_AT = jax.jit(pennzane_x2000().at)
PENNZANE_CONTACT = LineContact(0.002435, 1.0, 2.25275e11)
CONTACT = LineContact(0.006, 0.012, 2.3e11)
NOMINAL = (1000.0, 20.0, 5e-3, 1.04e-8)
"""load, entrainment speed, viscosity, pressure viscosity"""


@pytest.mark.parametrize("row", PUBLISHED["film"], ids=lambda row: str(row["temperature"]))
def test_check_values(row):
    oil = PENNZANE_AT(row["temperature"])
    inputs = (row["load_per_length"], row["entrainment_speed"], oil.viscosity, oil.pressure_viscosity)
    for film, key in ((Moes(), "moes"), (DowsonHigginson(), "dowson_higginson"), (DowsonToyoda(), "dowson_toyoda")):
        # the speed floor: (1e-6/0.04)^2/2 * 0.7 = 2e-10
        np.testing.assert_allclose(jnp.exp(JITTED[film](PENNZANE_CONTACT, *inputs)), row[key], rtol=row["rtol"])


def test_moes_groups_of_the_check_rows():
    for temperature, w, u, m, l_group in (
        (293.15, 76310.0, 0.02, 31.35154, 8.823514),
        (400.0, 300000.0, 30.0, 21.48465, 11.9368),
    ):
        oil = PENNZANE_AT(temperature)
        speed = oil.viscosity * 2 * u / (2.25275e11 * 0.002435)
        np.testing.assert_allclose(w / (2.25275e11 * 0.002435) / np.sqrt(speed), m, rtol=1e-6)
        np.testing.assert_allclose(oil.pressure_viscosity * 2.25275e11 * speed**0.25, l_group, rtol=1e-6)


@pytest.mark.parametrize("deviation", PUBLISHED["full_solution"][0]["deviation"], ids=lambda d: d["law"])
def test_full_solutions_of_the_source(deviation):
    row = PUBLISHED["full_solution"][0]
    film = next(film for film in FILMS if type(film).__name__ == deviation["law"])
    oil = PENNZANE_AT(jnp.asarray(row["temperature"]))
    inputs = (jnp.asarray(row["load_per_length"]), 0.02, oil.viscosity, oil.pressure_viscosity)
    ratio = jnp.exp(JITTED[film](PENNZANE_CONTACT, *inputs)) / np.asarray(row[deviation["film"]])
    np.testing.assert_allclose(100 * (ratio - 1), deviation["percent"], atol=deviation["atol"])
    if deviation["law"] in ("Moes", "DowsonHigginson"):  # what the scenes use
        np.testing.assert_allclose(ratio, 1, rtol=row["rtol"])


@pytest.mark.parametrize("film", POWER_LAWS, ids=NAMES)
def test_power_laws_near_the_limit_of_their_regime(film):
    """The laws of the elastic-piezoviscous regime against its limit, Ertel-Grubin's 1.311 M^(-1/8) L^(3/4)."""
    modulus, radius, length, speed, viscosity, alpha = 2.3e11, 0.006, 0.012, 20.0, 5e-3, 1.5e-8
    load = 3e3
    u = viscosity * 2 * speed / (modulus * radius)
    m, l_group = load / (length * modulus * radius) / np.sqrt(u), alpha * modulus * u**0.25
    limit = 1.311 * m**-0.125 * l_group**0.75 * radius * np.sqrt(u)
    got = jnp.exp(JITTED[film](CONTACT, load, speed, viscosity, alpha))
    assert 0.55 < got / limit < 1.0  # every one is a fit of finite M, L or a minimum film


def test_isoviscous_oil():
    for m in (0.1, 1.0, 100.0):
        ri, ei = 3 / m, 2.621 * m**-0.2
        # M is floored: (1e-6/0.1)^2/2
        np.testing.assert_allclose(moes_h(m, 0.0), (ri ** (7 / 3) + ei ** (7 / 3)) ** (3 / 7), rtol=1e-10)
    load, speed, viscosity, _ = NOMINAL
    martin = 4.894968 * viscosity * speed * 0.006 * 0.012 / load
    got = JITTED[MartinBlend(DowsonHigginson())](CONTACT, load, speed, viscosity, 0.0)
    np.testing.assert_allclose(jnp.exp(got), martin, rtol=1e-9)
    assert [film.piezoviscous_only for film in FILMS] == [False] + [True] * 6


def test_martin_constants_from_reynolds_equation():
    """p' = 6 mu (u1+u2) (h - h_exit)/h^3 on h = h0 + x^2/(2R), p = p' = 0 at the exit; x = sqrt(2 R h0) tan t."""
    slope = lambda t, t_exit: np.cos(t) ** 2 - np.cos(t) ** 4 / np.cos(t_exit) ** 2
    pressure = lambda t, t_exit: quad(slope, -np.pi / 2, t, args=(t_exit,), epsabs=1e-13)[0]
    t_exit = brentq(lambda t: pressure(t, t), 0.1, 1.0, xtol=1e-14)
    load = quad(lambda t: pressure(t, t_exit) / np.cos(t) ** 2, -np.pi / 2 + 1e-9, t_exit, epsabs=1e-9)[0]
    # p = 6 mu (u1+u2) sqrt(2R h0)/h0^2 P(t): load = 12 mu (u1+u2) R/h0 * integral; u1+u2 = 2u.
    np.testing.assert_allclose(24 * load, MARTIN_CONSTANT, rtol=2e-7)  # seven printed digits
    np.testing.assert_allclose(np.pi / 2 + t_exit, INLET_COUETTE_CONSTANT, rtol=3e-6)  # six printed digits


@jax.jit
def moes_h(m, l_group):
    """H of Moes at (M, L), from the law itself: U = 1e-12, R = 6 mm, l = 12 mm."""
    stiffness, speed = 2.3e11 * 0.006, 1e-12
    load = m * np.sqrt(speed) * stiffness * 0.012
    viscosity = speed * stiffness / 40.0
    alpha = l_group / speed**0.25 / 2.3e11
    return jnp.exp(Moes().log_thickness(CONTACT, load, 20.0, viscosity, alpha)) / 0.006 / np.sqrt(speed)


def test_moes_rigid_isoviscous_limit():
    # next terms: the floor of M, (1e-6/1e-3)^2/2 = 5e-7, and 3/7 (H_EI/H_RI)^(7/3) = 8e-7
    np.testing.assert_allclose(moes_h(1e-3, 1e-9), 3 / 1e-3, rtol=3e-6)


def test_moes_elastic_isoviscous_limit():
    np.testing.assert_allclose(moes_h(1e6, 1e-9), 2.621 * 1e6**-0.2, rtol=1e-5)


def test_moes_elastic_piezoviscous_limit():
    # s = 7/5; next terms 5/7 (H_EI/H_EP)^1.4 = 1.2e-4 and -2/7 (H_EP/H_RP)^3.5 = -1e-4
    np.testing.assert_allclose(moes_h(1e10, 1000.0), 1.311 * 1e10**-0.125 * 1000**0.75, rtol=3e-4)


def test_moes_rigid_piezoviscous_limit():
    # M small enough for H_EP >> H_RP, large enough for H_RI << H_RP
    np.testing.assert_allclose(moes_h(2.0, 1e6), 1.287 * 1e6 ** (2 / 3), rtol=2e-2)


def test_moes_against_the_plain_formula():
    for m in (0.1, 1.0, 20.0, 1000.0):
        for l_group in (0.5, 5.0, 20.0):
            ri, ei = 3 / m, 2.621 * m**-0.2
            rp, ep = 1.287 * l_group ** (2 / 3), 1.311 * m**-0.125 * l_group**0.75
            s = (7 + 8 * np.exp(-2 * ei / ri)) / 5
            h = (ri ** (7 / 3) + ei ** (7 / 3)) ** (3 * s / 7) + (rp**-3.5 + ep**-3.5) ** (-2 * s / 7)
            np.testing.assert_allclose(moes_h(m, l_group), h ** (1 / s), rtol=1e-6)


def test_martin_blend_limits_and_reference_closure():
    load = np.logspace(-3, 4, 8)
    u, mu, alpha = 20.0, 5e-3, 1.04e-8
    elastic = 2.65 * 0.006 * (mu * u / (2.3e11 * 0.006)) ** 0.7 * (alpha * 2.3e11) ** 0.54
    elastic = elastic * (load / (2.3e11 * 0.006 * 0.012)) ** -0.13
    martin = 4.894968 * mu * u * 0.006 * 0.012 / load
    blend = MartinBlend(DowsonHigginson())
    got = np.exp(blend.log_thickness(CONTACT, load, u, mu, alpha))
    np.testing.assert_allclose(got, (elastic**3 + martin**3) ** (1 / 3), rtol=1e-12)
    np.testing.assert_allclose(got[0], martin[0], rtol=1e-6)
    np.testing.assert_allclose(got[-1], elastic[-1], rtol=1e-3)


def test_blend_is_the_reference_closure_of_the_source_bearing():
    oil = mobil_jet_ii().at(373.15)
    modulus = 210e9 / 0.91
    radius = 1 / (1 / 0.006 + 1 / 0.065)
    contact = LineContact(radius, 0.0124, modulus)
    h_e = 2.65 * radius * (0.00486754888 * 35 / (modulus * radius)) ** 0.7 * (10.4e-9 * modulus) ** 0.54
    h_e *= (2500 / (modulus * radius * 0.0124)) ** -0.13
    h_m = 4.894968 * 0.00486754888 * 35 * radius * 0.0124 / 2500
    got = jnp.exp(MartinBlend(DowsonHigginson()).log_thickness(contact, 2500.0, 35.0, oil.viscosity, 10.4e-9))
    np.testing.assert_allclose(got, (h_e**3 + h_m**3) ** (1 / 3), rtol=1e-7)  # seven digits of the viscosity


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_hard_cases_value_and_gradient(film):
    load = jnp.asarray([0.0, 1e-12, 1e-3, 1.0, 1e9])[:, None]
    speed = jnp.asarray([0.0, 1e-9, -1e-3, 1.0, 1e3])[None, :]
    function = JITTED[film]
    total = lambda contact, *inputs: jnp.sum(film.log_thickness(contact, *inputs))
    derivative = jax.jit(jax.grad(total, argnums=(0, 1, 2, 3, 4)))
    for viscosity, alpha in ((1e-4, 1e-8), (1e4, 1e-8), (1e-4, 0.0), (1e4, 0.0)):
        value = function(CONTACT, load, speed, viscosity, alpha)
        assert value.shape == (5, 5)
        assert jnp.all(jnp.isfinite(value))
        gradient = derivative(CONTACT, load, speed, viscosity, alpha)
        assert all(jnp.all(jnp.isfinite(leaf)) for leaf in jax.tree.leaves(gradient))


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_gradients(film):
    function = lambda *inputs: JITTED[film](CONTACT, *inputs)
    gradient = jax.jit(jax.grad(function, argnums=(0, 1, 2, 3)))(*NOMINAL)
    for i, value in enumerate(NOMINAL):
        step = 1e-4 * value
        shifted = [(*NOMINAL[:i], value + sign * step, *NOMINAL[i + 1 :]) for sign in (1, -1)]
        central = (function(*shifted[0]) - function(*shifted[1])) / (2 * step)
        # truncation step^2/6 f''' = 3e-9, round-off of ln h 4e-15/1e-4/0.1
        np.testing.assert_allclose(gradient[i], central, rtol=1e-7)


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_direction_of_rolling_does_not_matter(film):
    load, speed, viscosity, alpha = NOMINAL
    forward, backward = (JITTED[film](CONTACT, load, s, viscosity, alpha) for s in (speed, -speed))
    assert forward == backward


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_film_falls_with_load_and_rises_with_speed(film):
    load = np.logspace(-1, 5, 50)
    assert np.all(np.diff(JITTED[film](CONTACT, load, 20.0, 5e-3, 1e-8)) < 0)
    speed = np.logspace(-4, 3, 50)
    assert np.all(np.diff(JITTED[film](CONTACT, 1000.0, speed, 5e-3, 1e-8)) > 0)


@pytest.mark.parametrize("film", FILMS, ids=NAMES)
def test_eager_is_jit_is_vmap(film):
    load = jnp.logspace(-3, 5, 20_001)
    function = lambda load: film.log_thickness(CONTACT, load, 20.0, 5e-3, 1e-8)
    np.testing.assert_allclose(jax.jit(function)(load), function(load), rtol=1e-13)
    np.testing.assert_allclose(jax.vmap(function)(load), function(load), rtol=1e-13)
