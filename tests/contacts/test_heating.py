"""Heat of the film: exact solutions of the linear relations, balances, limits; the traction that depends on it."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import nye_186a, pennzane_x2000

from jaxbearing.contacts import ContactPatch, DistributedTraction, ElsharkawyHamrock, FilmHeating, Resolution, Sliding
from jaxbearing.contacts.heating import HeatFlow, limited_rise
from jaxbearing.lubricants import Lubricant

STEEL = 7800.0 * 460.0 * 46.0
HALF_WIDTH, FILM, SPEED, CONDUCTIVITY = 3e-4, 1e-6, 3.0, 0.14
PENNZANE = pennzane_x2000()
VISCOUS = ElsharkawyHamrock(jnp.asarray(2.0))
LINE = ContactPatch(jnp.asarray(1.2e9), jnp.asarray(HALF_WIDTH), jnp.asarray(0.5), line=True)
traction = eqx.filter_jit(lambda law, *arguments: law.traction(*arguments))


def flow_of(steps, heating, film=FILM):
    return HeatFlow(heating, steps, *(jnp.asarray(x) for x in (HALF_WIDTH, film, SPEED, CONDUCTIVITY)))


def marched(flow, source):
    """Film and surface rise, flux into one surface in each cell, and the rise of the film that leaves."""
    flux, entering, rows = np.zeros(len(source)), 0.0, []
    for i, q in enumerate(source):
        before = float(flow.surface_rise) * (flow.history[i] @ flux)
        heat = flow.step(flow.own[i], flow.widths[i], before, entering)
        film = float(heat.base + heat.slope * q)
        surface, into = flow.surface(flow.own[i], before, film)
        flux[i] = into
        entering = float(flow.leaving(flow.widths[i], entering, film))
        rows.append((film, float(surface), float(into)))
    return (*np.asarray(rows).T, entering)


@pytest.mark.parametrize("steps", [7, 50])
def test_uniform_source(steps):
    """The square-root law, exact at any number of cells, and the parabola across the film."""
    q = 3e13
    film, surface, into, _ = marched(flow_of(steps, FilmHeating()), np.full(steps, q))
    distance = HALF_WIDTH * (1 - np.cos((np.arange(steps) + 0.5) * np.pi / steps))
    np.testing.assert_allclose(into, q * FILM / 2, rtol=1e-11)
    np.testing.assert_allclose(surface, q * FILM * np.sqrt(distance / (np.pi * STEEL * SPEED)), rtol=1e-11)
    np.testing.assert_allclose(film - surface, q * FILM**2 / (12 * CONDUCTIVITY), rtol=1e-11)


def test_flux_of_another_shape():
    """phi = sqrt(x + a): the surface rises by pi (x + a)/2; the cells converge with order 2 or nearly."""
    errors = []
    for steps in (25, 50, 100, 200):
        distance = 1 - np.cos((np.arange(steps) + 0.5) * np.pi / steps)
        _, surface, _, _ = marched(flow_of(steps, FilmHeating()), 1e13 * np.sqrt(distance))
        exact = 1e13 * FILM / 2 * np.sqrt(HALF_WIDTH / (np.pi * STEEL * SPEED)) * np.pi / 2 * distance
        errors.append(np.max(np.abs(surface - exact)) / exact[-1])
    assert np.polyfit(np.log([25, 50, 100, 200]), np.log(errors), 1)[0] < -1.4
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("film", [1e-7, 1e-6, 2e-5])
@pytest.mark.parametrize("capacity", [None, 1.7e6])
def test_heat_balance(film, capacity):
    """Heat made = heat into both surfaces + heat carried out, whatever the source and the cells."""
    steps = 30
    source = 1e13 * np.random.default_rng(2).uniform(0, 1, steps)
    flow = flow_of(steps, FilmHeating(film_heat_capacity=capacity), film)
    _, _, into, out = marched(flow, source)
    made = np.sum(source * film * flow.widths) * HALF_WIDTH
    carried = 0.0 if capacity is None else capacity * SPEED * film * out
    # the thickest film: a cell is 1e-3 of the length in which the film takes its temperature, so three digits are lost
    np.testing.assert_allclose(2 * np.sum(into * flow.widths) * HALF_WIDTH + carried, made, rtol=1e-9)
    if capacity is not None:
        assert carried > 0


def test_no_heat_capacity():
    """The limit of no convection, with a gradient."""
    source = 1e13 * np.sin(np.linspace(0.1, 3.0, 20))
    plain = marched(flow_of(20, FilmHeating()), source)
    for capacity in (0.0, 1e-6):
        convective = marched(flow_of(20, FilmHeating(film_heat_capacity=jnp.asarray(capacity))), source)
        for a, b in zip(plain[:3], convective[:3], strict=True):
            np.testing.assert_allclose(a, b, rtol=1e-9)

    def film(capacity):
        flow = flow_of(20, FilmHeating(film_heat_capacity=capacity))
        heat = flow.step(flow.own[3], flow.widths[3], 1.0, 2.0)
        return heat.base + heat.slope * 1e13

    slope = jax.grad(film)(0.0)
    # linear but for 1e2/1.7e6 of the Peclet number
    np.testing.assert_allclose(slope, (film(1e2) - film(0.0)) / 1e2, rtol=1e-5)
    np.testing.assert_allclose(slope, jax.grad(film)(1e-3), rtol=1e-6)


def test_peclet_number():
    np.testing.assert_allclose(
        FilmHeating(film_heat_capacity=1.7e6).peclet_number(3e-4, 1e-6, 3.0, 0.14),
        1.7e6 * 3.0 * 1e-12 / (12 * 0.14 * 3e-4),
        rtol=1e-14,
    )
    with pytest.raises(ValueError, match="film_heat_capacity"):
        FilmHeating().peclet_number(3e-4, 1e-6, 3.0, 0.14)


def test_limited_rise():
    assert abs(limited_rise(100.0) - 100.0) < 1e-9
    assert limited_rise(1e6) <= 500.0
    assert jnp.isfinite(jax.grad(limited_rise)(1e300))


SLIDING = jnp.asarray([0.0, 1e-9, 0.06, 0.6])
"""The same for all tests: they share a compilation."""


def run(heating, sliding=SLIDING, steps=64, film=FILM, oil=PENNZANE):
    law = DistributedTraction(VISCOUS, Resolution(steps, 1), heating=heating)
    arguments = (jnp.asarray(film), jnp.asarray(SPEED), Sliding(sliding), jnp.asarray(313.0))
    return traction(law, LINE, *arguments, oil)


def test_little_heat_changes_little():
    """A film that leads heat away at once and surfaces that never warm: the isothermal force."""
    cold = FilmHeating(jnp.asarray(1e9), jnp.asarray(1e18))
    heated, isothermal = run(cold), run(None)
    assert jnp.max(heated.film_rise) < 1e-5
    np.testing.assert_allclose(heated.rolling, isothermal.rolling, rtol=1e-7)  # 1 % a kelvin
    assert heated.rolling[0] == 0
    assert abs(heated.film_rise[0]) < 1e-12  # the limit of 500 K
    # with the oil's own heat conductivity: warming grows with the square of a small sliding
    heated = run(FilmHeating(jnp.asarray(CONDUCTIVITY)))
    np.testing.assert_allclose(heated.rolling[:2], isothermal.rolling[:2], rtol=1e-12)
    assert heated.rolling[3] > isothermal.rolling[3]  # this oil's limiting stress rises with temperature
    assert 0 < heated.surface_rise[3] < heated.film_rise[3]


@pytest.mark.slow
def test_order_of_convergence():
    steps = np.asarray([16, 32, 64, 128])
    force = np.asarray([run(FilmHeating(), steps=int(n)).rolling[3] for n in (*steps, 384)])
    assert np.polyfit(np.log(steps), np.log(np.abs(force[:-1] / force[-1] - 1)), 1)[0] < -1.6


@pytest.mark.slow
def test_great_heat_is_limited():
    """Sliding at 100 m/s: the rise stays below 500 K, value and gradient finite, the solves converged."""
    sliding = jnp.asarray([1.0, 10.0, 30.0, 100.0])
    heating = FilmHeating(jnp.asarray(CONDUCTIVITY), film_heat_capacity=jnp.asarray(1.7e6))
    found = run(heating, sliding)
    assert jnp.all((found.film_rise > 0) & (found.film_rise <= 500.0))
    assert jnp.all(found.inner_residual < 1e-6)
    slope = jax.jit(jax.grad(lambda s: jnp.sum(run(heating, s, steps=16).rolling)))(sliding)
    assert jnp.all(jnp.isfinite(slope))


def test_convection_cools():
    """Heat that the film carries along warms the inlet side less."""
    conductivity = jnp.asarray(CONDUCTIVITY)
    without = run(FilmHeating(conductivity), film=5e-6)
    carried = run(FilmHeating(conductivity, film_heat_capacity=jnp.asarray(1.7e6)), film=5e-6)
    assert carried.surface_rise[3] < without.surface_rise[3]
    assert carried.film_rise[3] < without.film_rise[3]


def test_conductivity_is_asked_for():
    fields = {field.name: getattr(PENNZANE, field.name) for field in dataclasses.fields(PENNZANE)}
    unknown = Lubricant(**fields | {"conductivity": None})
    with pytest.raises(ValueError, match="conductivity"):
        run(FilmHeating(), oil=unknown)
    with pytest.raises(ValueError, match="rheology"):
        run(FilmHeating(), oil=nye_186a())
    film, speed, temperature = jnp.asarray(FILM), jnp.asarray(SPEED), jnp.asarray(313.0)
    law = DistributedTraction(VISCOUS, Resolution(4, 1), heating=FilmHeating())
    own = traction(law, LINE, film, speed, Sliding(SLIDING), temperature, PENNZANE)
    given = dataclasses.replace(law, heating=FilmHeating(jnp.asarray(0.14)))
    np.testing.assert_allclose(
        traction(given, LINE, film, speed, Sliding(SLIDING), temperature, unknown).rolling, own.rolling, rtol=1e-12
    )
