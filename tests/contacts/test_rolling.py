"""Rolling resistance: its constants derived anew, full solutions, signs, hard cases, gradients; the contact laws."""

import itertools
import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii
from scipy.integrate import quad
from scipy.optimize import brentq

from jaxbearing.contacts import (
    BibouletHoupertRollingResistance,
    DowsonHigginson,
    ErtelGrubinRollingResistance,
    FullRangeRollingResistance,
    Gupta,
    JoinedRollingResistance,
    LineContact,
    MartinBlend,
    Moes,
    RigidRollingResistance,
    RollingInlet,
)
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.contacts.rolling import INLET_CONSTANT, RIGID_CONSTANT

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "line_contact.toml").read_text())["rolling"]
LAWS = [
    RigidRollingResistance(),
    ErtelGrubinRollingResistance(),
    JoinedRollingResistance(),
    FullRangeRollingResistance(),
    BibouletHoupertRollingResistance(),
]  # new law: add a line, get the general tests
NAMES = lambda law: type(law).__name__
CONTACT = LineContact(0.0055, 0.0124, 2.3e11)
NOMINAL = (2500.0, 4e-7, 32.0, 4.87e-3, 1.04e-8)
"""load, film, entrainment speed, viscosity, pressure viscosity"""


def force_of(law):
    """The force from load, film, entrainment speed, viscosity and pressure viscosity."""

    def force(contact, load, film, speed, viscosity, pressure_viscosity):
        return law.force(contact, RollingInlet(load, speed, viscosity, pressure_viscosity, film))

    return force


JITTED = {law: jax.jit(force_of(law)) for law in LAWS}


def test_rigid_constant_from_reynolds_equation():
    """p' = 12 mu u (h - h_exit)/h^3 on h = h0 + x^2/(2R), p = p' = 0 at the exit; x = sqrt(2 R h0) tan t."""
    slope = lambda t, t_exit: np.cos(t) ** 2 - np.cos(t) ** 4 / np.cos(t_exit) ** 2  # dp/dt
    end = brentq(lambda e: quad(slope, -np.pi / 2, e, args=(e,), epsabs=1e-13)[0], 0.1, 1.0, xtol=1e-14)
    # h/h0 = 1/cos^2 t: int h dp = 12 mu u sqrt(2R/h0) int (1 - cos^2 t/cos^2 e) dt
    power = quad(lambda t: 1 - np.cos(t) ** 2 / np.cos(end) ** 2, -np.pi / 2, end, epsabs=1e-13)[0]
    np.testing.assert_allclose(12 * power, RIGID_CONSTANT, rtol=1e-7)  # seven printed digits


def inlet_integral(gap):
    """int (h - h_c) dp alpha/h_c with h/h_c = 1 + gap(t), t the root of the distance from the Hertz zone.

    With the reduced pressure q = (1 - e^(-alpha p))/alpha, dq ~ (h - h_c)/h^3, alpha q = 1 at the zone's edge,
    dp = dq/(1 - alpha q).
    """
    flow = lambda t: 2 * t * gap(t) / (1 + gap(t)) ** 3
    left = lambda t: quad(flow, 0, t, epsabs=0, epsrel=1e-10)[0]
    near = quad(lambda t: gap(t) * flow(t) / left(t), 1e-3, 1, epsrel=1e-8)[0]
    far = quad(lambda y: gap(1 / y) * flow(1 / y) / left(1 / y) / y**2, 1e-3, 1, epsrel=1e-8)[0]
    return near + far


def test_inlet_constant():
    # what lies beyond 1e-3 and 1e3: 5 t^3/3 and 2/(0.2687 t) at the ends: 7.4e-3
    rest = 2 * 1e-3 / 0.268711
    np.testing.assert_allclose(inlet_integral(lambda t: t**3) + rest, INLET_CONSTANT, rtol=1e-6)
    np.testing.assert_allclose(INLET_CONSTANT, 6.6, rtol=0.011)  # the rounded figure of the model sheet


@pytest.mark.parametrize("case", range(6))
def test_full_solutions(case):
    """Ertel and Grubin for the oil, rigid cylinders for the isoviscous oil; and the rigid law is no upper bound."""
    alpha, u, exact = (PUBLISHED[name][case] for name in ("pressure_viscosity", "speed", "force"))
    load = PUBLISHED["load"][case]
    central, minimum = PUBLISHED["central_film"][case], PUBLISHED["minimum_film"][case]
    rigid = force_of(RigidRollingResistance())(CONTACT, load, minimum, u, 4.87e-3, alpha) / exact
    inlet = force_of(ErtelGrubinRollingResistance())(CONTACT, load, central, u, 4.87e-3, alpha) / exact
    if alpha > 1e-10:
        assert 0.99 < inlet < 1.26
        assert 0.6 < rigid < 0.8
        joined = force_of(JoinedRollingResistance())(CONTACT, load, central, u, 4.87e-3, alpha) / exact
        assert 0.97 < joined < 1.22
        martin = 4.894968 * 4.87e-3 * u * 0.0055 * 0.0124 / load
        bound = force_of(RigidRollingResistance())(CONTACT, load, martin, u, 4.87e-3, alpha)
        assert bound > 1.5 * exact  # with the rigid film under the same load it is one
    else:
        np.testing.assert_allclose(rigid, 1.0, rtol=0.05)


def test_plain_formulas():
    load, film, u, mu, alpha = NOMINAL
    rigid = 6.506905 * mu * u * 0.0124 * np.sqrt(2 * 0.0055 / film)
    loaded = 6.532471 * 0.0124 * film / alpha
    np.testing.assert_allclose(JITTED[LAWS[0]](CONTACT, load, film, -u, mu, alpha), -rigid, rtol=1e-13)
    np.testing.assert_allclose(JITTED[LAWS[1]](CONTACT, load, film, -u, mu, alpha), -loaded)
    number = load / (0.0124 * 2.3e11 * 0.0055) / np.sqrt(mu * 2 * u / (2.3e11 * 0.0055))
    weight = (number / 1.2) ** 2
    joined = (rigid + weight * loaded) / (1 + weight)
    np.testing.assert_allclose(JITTED[LAWS[2]](CONTACT, load, film, -u, mu, alpha), -joined, rtol=1e-12)


def test_joined_law_is_the_rigid_one_without_load():
    _, film, u, mu, alpha = NOMINAL
    rigid, _, joined = (JITTED[law](CONTACT, 0.0, film, u, mu, alpha) for law in LAWS[:3])
    np.testing.assert_allclose(joined, rigid, rtol=1e-13)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_odd_and_smooth_in_speed(law):
    load, film, _, mu, alpha = NOMINAL
    u = jnp.concatenate([jnp.zeros(1), jnp.logspace(-9, 2, 45)])
    forward = JITTED[law](CONTACT, load, film, u, mu, alpha)
    np.testing.assert_array_equal(JITTED[law](CONTACT, load, film, -u, mu, alpha), -forward)
    assert forward[0] == 0
    if not isinstance(law, JoinedRollingResistance):  # whose load number falls with the speed, at a given film
        assert jnp.all(jnp.diff(forward) >= 0)
    assert jax.grad(JITTED[law], argnums=3)(CONTACT, load, film, 0.0, mu, alpha) > 0


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_hard_cases_value_and_gradient(law):
    derivative = jax.jit(jax.grad(lambda *a: jnp.sum(force_of(law)(*a)), argnums=(0, 1, 2, 3, 4, 5)))
    film = jnp.asarray([1e-15, 1e-7, 1e-2])[:, None]
    speed = jnp.asarray([0.0, 1e-12, -1e-6, 1e3])[None, :]
    for alpha, load in itertools.product((0.0, 1e-8), (0.0, 1e5)):
        assert jnp.all(jnp.isfinite(JITTED[law](CONTACT, load, film, speed, 1e-3, alpha)))
        gradient = derivative(CONTACT, load, film, speed, 1e-3, alpha)
        assert all(jnp.all(jnp.isfinite(leaf)) for leaf in jax.tree.leaves(gradient))


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_gradients(law):
    function = lambda *inputs: JITTED[law](CONTACT, *inputs)
    gradient = jax.jit(jax.grad(function, argnums=(0, 1, 2, 3, 4)))(*NOMINAL)
    for i, value in enumerate(NOMINAL):
        # wide differences of fourth order: a plateau in the load has a slope near the round-off
        at = lambda part, i=i, value=value: function(*NOMINAL[:i], value * (1 + part), *NOMINAL[i + 1 :])
        slope = (8 * (at(1e-3) - at(-1e-3)) - (at(2e-3) - at(-2e-3))) / 12e-3
        # the smoothed sign of the speed has a slope of 1e-15, lost in round-off
        np.testing.assert_allclose(gradient[i] * value, slope, rtol=1e-7, atol=1e-11)


def test_contact_laws_use_the_heated_oil_and_the_sign_of_the_mean_speed():
    oil = mobil_jet_ii()
    inlet = oil.at(373.15)
    speed = jnp.asarray([30.0, -30.0])
    laws = ContactLaws(film=Moes(), thermal=Gupta(), rolling=RigidRollingResistance())
    state = jax.jit(lambda u: laws.evaluate(CONTACT, 2500.0, u, 0.0, oil, inlet))(speed)
    assert state.rolling_force is not None
    assert state.temperature_rise is not None
    assert jnp.all(state.temperature_rise > 1)
    heated = oil.viscosity.viscosity(0.0, 373.15 + state.temperature_rise)
    expected = 6.506905 * heated * speed * 0.0124 * jnp.sqrt(2 * 0.0055 / state.film)
    np.testing.assert_allclose(state.rolling_force, expected, rtol=1e-12)


def test_contact_laws_without_heating_and_without_rolling():
    oil = mobil_jet_ii()
    film = MartinBlend(DowsonHigginson())
    with_rolling = ContactLaws(film=film, rolling=ErtelGrubinRollingResistance(), entrainment_offset=1e-3)
    state = with_rolling.evaluate(CONTACT, 2500.0, -30.0, 0.0, oil, oil.at(373.15))
    alpha = oil.pressure_viscosity.coefficient(373.15)
    np.testing.assert_allclose(state.rolling_force, -6.532471 * 0.0124 * state.film / alpha, rtol=1e-12)
    assert ContactLaws(film=film).evaluate(CONTACT, 2500.0, 30.0, 0.0, oil, oil.at(373.15)).rolling_force is None
