"""Thermal film reduction and the inlet temperature rise."""

import tomllib
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii

from jaxbearing.contacts import Gupta, HsuLee, LineContact, Moes, NoThermalReduction, inlet_temperature_rise
from jaxbearing.lubricants import InletOil

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "line_contact.toml").read_text())
CONTACT = LineContact(0.006, 0.012, 2.25275e11)
MOES = Moes()


def load_at(hertz_pressure):
    return 2 * np.pi * 0.006 * 0.012 * hertz_pressure**2 / 2.25275e11


def oil_with_loading(loading):
    """At u = 2 m/s: L = mu beta u^2/k = loading."""
    return InletOil(300.0, 0.1, 2e-8, -loading * 0.14 / 0.1 / 4.0, conductivity=0.14)


def film_at(temperature, args):
    lubricant, contact, load, speed = args
    viscosity = lubricant.viscosity.viscosity(0.0, temperature)
    return MOES.log_thickness(contact, load, speed, viscosity, lubricant.pressure_viscosity.coefficient(temperature))


def test_gupta_check_values():
    row = PUBLISHED["gupta"][0]
    for p0, loading, slide, value in zip(
        row["hertz_pressure"], row["loading"], row["slide_ratio"], row["value"], strict=True
    ):
        got = Gupta().log_factor(CONTACT, load_at(p0), 2.0, 2.0 * slide, oil_with_loading(loading))
        np.testing.assert_allclose(jnp.exp(got), value, rtol=row["rtol"])


def test_gupta_groups():
    oil = mobil_jet_ii().at(373.0)
    np.testing.assert_allclose(Gupta().thermal_loading(40.0, oil), 1.047939, rtol=1e-6)  # seven digits
    np.testing.assert_allclose(Gupta().slide_ratio(-40.0, 8.0), 0.2, rtol=1e-14)  # 2|u1-u2|/|u1+u2|


def test_gupta_against_the_plain_formula():
    loading = np.logspace(-3, 1.3, 7)[:, None]
    slide = np.asarray([0.0, 1e-3, 0.1, 1.0, 2.0])[None, :]
    plain = (1 - 13.2 * 1e9 / 2.25275e11 * loading**0.42) / (1 + 0.213 * (1 + 2.23 * slide**0.83) * loading**0.64)
    got = jax.jit(Gupta().log_factor)(CONTACT, load_at(1e9), 2.0, 2.0 * slide, oil_with_loading(loading))
    np.testing.assert_allclose(np.exp(got), plain, rtol=1e-6)


def test_gupta_tends_to_one():
    oil = mobil_jet_ii().at(373.0)
    # at 1 mm/s L is 6e-10: 13.2 p0/E' L^0.42 is below 1e-5
    np.testing.assert_allclose(Gupta().log_factor(CONTACT, load_at(1e9), 1e-3, 0.0, oil), 0.0, atol=1e-5)
    np.testing.assert_allclose(Gupta().log_factor(CONTACT, load_at(1e9), 0.0, 5.0, oil), 0.0, atol=1e-15)


def test_gupta_hard_cases_value_and_gradient():
    law, lubricant = Gupta(), mobil_jet_ii()
    load = jnp.asarray([0.0, 1e-3, 1e9])[:, None, None]
    speed = jnp.asarray([0.0, 1e-9, -1.0, 50.0, 1e4])[:, None]
    sliding = jnp.asarray([0.0, 1e-12, -5.0, 1e4])
    inputs = jnp.broadcast_arrays(load, speed, sliding)
    function = jax.jit(lambda load, u, du, t: law.log_factor(CONTACT, load, u, du, lubricant.at(t)))
    derivative = jax.jit(jax.grad(lambda *a: jnp.sum(function(*a)), argnums=(0, 1, 2, 3)))
    for temperature in (243.0, 373.0, 473.0):
        value = function(*inputs, temperature)
        assert value.shape == (3, 5, 4)
        assert jnp.all(jnp.isfinite(value))
        assert jnp.all(value <= 1e-15)
        gradient = derivative(*inputs, temperature)
        assert all(jnp.all(jnp.isfinite(g)) for g in gradient)


def test_gupta_gradients():
    law, oil = Gupta(), mobil_jet_ii().at(373.0)
    state = (2000.0, 30.0, 2.0)
    function = jax.jit(lambda *inputs: law.log_factor(CONTACT, *inputs, oil))
    gradient = jax.jit(jax.grad(function, argnums=(0, 1, 2)))(*state)
    for i, value in enumerate(state):
        step = 1e-4 * value
        up, down = ((*state[:i], value + sign * step, *state[i + 1 :]) for sign in (1, -1))
        central = (function(*up) - function(*down)) / (2 * step)
        np.testing.assert_allclose(gradient[i], central, rtol=1e-7)


def test_gupta_asks_for_the_conductivity():
    with pytest.raises(ValueError, match="conductivity"):
        Gupta().log_factor(CONTACT, 1000.0, 20.0, 0.0, InletOil(300.0, 0.1, 2e-8, -0.04))


def test_no_thermal_reduction_is_zero_of_the_right_shape():
    oil = mobil_jet_ii().at(373.0)
    got = NoThermalReduction().log_factor(CONTACT, jnp.ones((2, 3)), jnp.ones((2, 1)), 0.0, oil)
    np.testing.assert_array_equal(got, np.zeros((2, 3)))


def hsu_lee_inputs(material, load, loading, slide):
    """Contact, load, speeds and oil with the given groups G, W, L, S."""
    oil = eqx.tree_at(lambda o: o.pressure_viscosity, oil_with_loading(loading), material / 2.25275e11)
    return CONTACT, load * 2.25275e11 * 0.006 * 0.012, 2.0, 2.0 * slide, oil


HSU_LEE = jax.jit(HsuLee().log_factor)


def test_hsu_lee_check_value():
    row = PUBLISHED["hsu_lee"][0]
    got = HSU_LEE(*hsu_lee_inputs(row["material"], row["load"], row["loading"], row["slide_ratio"]))
    np.testing.assert_allclose(jnp.exp(got), row["value"], rtol=row["rtol"])


def test_hsu_lee_against_the_plain_formula():
    for material, load, loading, slide in (
        (3000.0, 1e-5, 0.1, 0.5),
        (6000.0, 3e-4, 20.0, 2.0),
        (4000.0, 1e-4, 3.0, 0.0),
    ):
        plain = 1 / (1 + 0.0766 * material**0.687 * load**0.447 * loading**0.527 * np.exp(0.875 * slide))
        # the linear power of L, 0.24 (1e-9/L)^2, and the limit of S, exp(-40)
        got = jnp.exp(HSU_LEE(*hsu_lee_inputs(material, load, loading, slide)))
        np.testing.assert_allclose(got, plain, rtol=1e-12)


def test_hsu_lee_limits():
    at = lambda *groups: HSU_LEE(*hsu_lee_inputs(*groups))
    np.testing.assert_allclose(at(5000.0, 1e-4, 0.0, 1.0), 0.0, atol=1e-15)
    np.testing.assert_allclose(at(0.0, 1e-4, 10.0, 2.0), 0.0, atol=1e-10)  # (1e-25 E')^0.687: an isoviscous oil
    np.testing.assert_allclose(at(5000.0, 0.0, 10.0, 2.0), 0.0, atol=1e-4)  # at 1e-9 N
    # S beyond 10 counts as 10
    ratio = 1 / (1 + 0.0766 * 5000**0.687 * 1e-4**0.447 * np.exp(8.75))
    np.testing.assert_allclose(jnp.exp(at(5000.0, 1e-4, 1.0, 1e4)), ratio, rtol=1e-9)


def test_hsu_lee_hard_cases_and_gradients():
    lubricant = mobil_jet_ii()

    @jax.jit
    def function(load, u, du, t, alpha):
        oil = eqx.tree_at(lambda o: o.pressure_viscosity, lubricant.at(t), alpha)
        return HsuLee().log_factor(CONTACT, load, u, du, oil)

    derivative = jax.jit(jax.vmap(jax.grad(function, argnums=(0, 1, 2, 3, 4))))
    load, speed, sliding = (
        a.ravel() for a in jnp.meshgrid(*(jnp.asarray(v) for v in ([0.0, 1e9], [0.0, -1e-9, 1e4], [0.0, 1e-12, -1e5])))
    )
    for temperature in (243.0, 473.0):
        for alpha in (0.0, 1e-8):
            state = (load, speed, sliding, *(jnp.full(load.shape, v) for v in (temperature, alpha)))
            value = function(*state)
            assert jnp.all(jnp.isfinite(value))
            assert jnp.all(value <= 0)
            assert all(jnp.all(jnp.isfinite(g)) for g in derivative(*state))
    state = (2000.0, 30.0, 2.0, 373.0, 1e-8)
    gradient = derivative(*(jnp.full(1, v) for v in state))
    for i, value in enumerate(state):
        step = 1e-5 * value
        up, down = (function(*state[:i], value + s * step, *state[i + 1 :]) for s in (1, -1))
        # round-off 1e-16/1e-5; the temperature enters by exponentials of width 10 K
        np.testing.assert_allclose(gradient[i][0], (up - down) / (2 * step), rtol=1e-6)


def test_hsu_lee_asks_for_the_conductivity():
    with pytest.raises(ValueError, match="HsuLee's thermal factor needs the lubricant's conductivity"):
        HsuLee().log_factor(CONTACT, 1000.0, 20.0, 0.0, InletOil(300.0, 0.1, 2e-8, -0.04))


ARGS = (mobil_jet_ii(), CONTACT, 2000.0, 30.0)


@jax.jit
def rise_of(log_factor, temperature, load):
    lubricant, contact, _, speed = ARGS
    args = (lubricant, contact, load, speed)
    return inlet_temperature_rise(film_at, args, temperature, film_at(temperature, args), log_factor)


@jax.jit
def rise_gradient(*state):
    return jax.grad(lambda *inputs: jnp.sum(rise_of(*inputs).value), argnums=(0, 1, 2))(*state)


def test_no_reduction_no_rise():
    rise = rise_of(0.0, 373.0, 2000.0)
    assert rise.value == 0.0
    slope = rise_gradient(0.0, 373.0, 2000.0)[0]
    film_slope = jax.grad(film_at)(373.0, ARGS)
    np.testing.assert_allclose(slope, 1 / film_slope, rtol=1e-12)  # implicit function, exact


def test_rise_meets_the_reduced_film():
    factor = jnp.log(jnp.asarray([1.0, 0.9, 0.5, 0.2]))
    rise = rise_of(factor, 373.0, 2000.0)
    got = film_at(373.0 + rise.value, ARGS) - film_at(jnp.asarray(373.0), ARGS)
    np.testing.assert_allclose(got, factor, atol=1e-13)
    assert jnp.all(jnp.diff(rise.value) > 0)


def test_rise_gradients_both_modes():
    state = (-0.3, 373.0, 2000.0)
    function = lambda *inputs: rise_of(*inputs).value
    gradient = rise_gradient(*state)
    tangent_of = jax.jit(lambda tangent: jax.jvp(function, state, tangent)[1])
    for i, step in enumerate((1e-4, 1e-2, 1.0)):
        up, down = ((*state[:i], state[i] + sign * step, *state[i + 1 :]) for sign in (1, -1))
        central = (function(*up) - function(*down)) / (2 * step)
        np.testing.assert_allclose(gradient[i], central, rtol=1e-6)
        tangent = tuple(float(j == i) for j in range(3))
        np.testing.assert_allclose(tangent_of(tangent), gradient[i], rtol=1e-10)


def test_rise_without_a_root_says_so():
    rise = rise_of(-50.0, 373.0, 2000.0)
    assert rise.value == 500.0  # the end of the search
    assert rise.residual > 1.0


def test_rise_in_the_cold_and_the_heat():
    temperature = jnp.asarray([243.0, 300.0, 473.0])
    rise = rise_of(-1.0, temperature, 2000.0)
    assert jnp.all(rise.residual < 1e-12)
    assert jnp.all(jnp.isfinite(rise_gradient(-1.0, temperature, 2000.0)[1]))
