"""Mixed friction of one contact: check rows of the specification, closed forms, hard cases, gradients, batches."""

import dataclasses
import itertools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii
from scipy.integrate import quad

from jaxbearing.contacts import (
    DowsonHigginson,
    FilmHeating,
    Gupta,
    HamrockDowsonCentral,
    HamrockDowsonMinimum,
    JoinedRollingResistance,
    LineContact,
    MartinBlend,
    MaxwellEyring,
    Moes,
    PointContact,
    PointLaws,
    Sliding,
    Supply,
    Traction,
)
from jaxbearing.contacts.hysteresis import point_hysteresis
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.contacts.load_share import (
    HEIGHT_INTEGRAL,
    ErrorFunctionShare,
    GreenwoodTripp,
    GreenwoodTrippPressure,
    ZhouHoeprich,
    log_height_integral,
)
from jaxbearing.contacts.minimum_film import LINE_SHARE
from jaxbearing.contacts.mixed import FLASH_CONSTANT, InletState, MixedFriction, flash_temperature

SHARES = [ZhouHoeprich(), ZhouHoeprich(2.1, 0.85), GreenwoodTripp(), GreenwoodTrippPressure(), ErrorFunctionShare()]
MODULUS = 206e9 / 0.91
LINE = LineContact(0.0055, 0.0124, MODULUS)
POINT = PointContact(0.005, 0.08, MODULUS)
INLET = InletState(5.0, 0.01, 2e-8)

# film ratio, shares of Zhou and Hoeprich on raceway and rib and of Greenwood and Tripp, F_5/2: section 8 of the sheet
SHARE_ROWS = [
    (0.0, 1.0, 1.0, 1.0, 0.6166342),
    (0.5, 0.3059376, 0.384194, 0.3898609, 0.2404016),
    (1.0, 0.09827359, 0.1495686, 0.1306485, 0.08056234),
    (2.0, 0.01062538, 0.02296575, 0.00879566, 0.005423705),
    (3.0, 0.00118935, 0.003560972, 0.0002771059, 0.000170873),
]


@pytest.mark.parametrize(("ratio", "raceway", "rib", "tripp", "integral"), SHARE_ROWS)
def test_load_shares_are_those_of_the_check_rows(ratio, raceway, rib, tripp, integral):
    found = [law.share(ratio, 1e9, MODULUS) for law in (ZhouHoeprich(), ZhouHoeprich(1.90, 0.99), GreenwoodTripp())]
    found.append(jnp.exp(log_height_integral(ratio)))
    np.testing.assert_allclose(found, [raceway, rib, tripp, integral], rtol=1e-6)


def test_asperity_pressure_of_the_check_row():
    law = GreenwoodTrippPressure(0.05, 1e-3)
    pressure = float(jnp.exp(law.log_pressure(1.0, MODULUS)))
    np.testing.assert_allclose(pressure, 3416343, rtol=1e-6)
    np.testing.assert_allclose(law.share(1.0, 0.5e9, MODULUS), pressure / 0.5e9, rtol=1e-8)  # 0.7 %


def test_error_function_share():
    np.testing.assert_allclose(ErrorFunctionShare().share(1.0, 1e9, MODULUS), 0.157299207050285, rtol=1e-12)


@pytest.mark.parametrize(("slide", "force", "power"), [(0.01, 3.972316, 0.03972316), (1.0, 5.099592, 5.099592)])
def test_mixed_force_of_the_check_rows(slide, force, power):
    mixed = MixedFriction(0.3e-6, mu_boundary=0.12, slide_width=0.02)
    found = mixed.force(170.0, 0.1, 3.4, slide)
    np.testing.assert_allclose([found, found * slide], [force, power], rtol=1e-6)


def test_flash_temperature_of_the_check_row():
    contact = LineContact(0.0055, 0.0124, MODULUS)
    load = contact.load_at_pressure(1.0) * (0.0002 * MODULUS / (4.0 * 0.0055)) ** 2  # half-width 0.2 mm
    np.testing.assert_allclose(contact.half_width(load), 0.0002, rtol=1e-12)
    rise = flash_temperature(contact, load, 40.0 * 2.0, 38.0, 2.0)
    np.testing.assert_allclose(rise, 2.264008, rtol=1e-6)
    heating = FilmHeating()
    steel = heating.solid_density * heating.solid_heat_capacity * heating.solid_conductivity
    np.testing.assert_allclose(jnp.sqrt(steel), 12847.1, rtol=1e-6)


def test_flash_constant_is_that_of_a_hertz_distributed_source():
    """A half-space that passes under a band with q ~ sqrt(1 - x^2), half of the heat into each body: the largest rise
    is int q(y)/sqrt(x - y) dy/sqrt(pi) in units of q_mean sqrt(2)."""
    rise = lambda x: quad(lambda s: 2.0 * np.sqrt(max(1.0 - (x - s * s) ** 2, 0.0)), 0.0, np.sqrt(x + 1.0))[0]
    largest = max(rise(x) for x in np.linspace(0.3, 0.9, 601))
    # 1/2 of (4/pi) q_mean into each, and 1/(sqrt(u1) + sqrt(u2)) is 1/(2 sqrt(u))
    np.testing.assert_allclose(4.0 / np.pi * largest / np.sqrt(2.0 * np.pi), FLASH_CONSTANT, rtol=1e-5)


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.7, 2.0, 5.0, 10.0])
def test_height_integral_by_quadrature(ratio):
    value = quad(lambda s: s**2.5 * np.exp(-0.5 * s * s - ratio * s), 0.0, 40.0, epsabs=0.0, epsrel=1e-12)[0]
    expected = np.log(value / np.sqrt(2.0 * np.pi)) - 0.5 * ratio**2
    np.testing.assert_allclose(log_height_integral(ratio), expected, rtol=1e-10)
    np.testing.assert_allclose(np.exp(log_height_integral(0.0)), HEIGHT_INTEGRAL, rtol=1e-13)


@pytest.mark.parametrize("law", SHARES, ids=lambda law: f"{type(law).__name__}")
def test_a_share_falls_from_one_to_nothing_with_finite_slopes(law):
    ratios = jnp.concatenate([jnp.zeros(1), jnp.geomspace(1e-9, 1e3, 200)])
    both = jax.jit(jax.vmap(jax.value_and_grad(lambda ratio: law.share(ratio, 1e9, MODULUS))))
    share, slope = both(ratios)
    assert np.all(np.isfinite(share))
    assert np.all(np.isfinite(slope))
    assert np.all((share >= 0.0) & (share <= 1.0 + 1e-15))
    assert np.all(np.diff(share) <= 1e-15)
    assert np.all(slope <= 0.0)
    assert share[-1] == slope[-1] == 0.0
    for ratio in (0.01, 0.3, 1.1, 2.5):
        difference = (law.share(ratio * 1.0001, 1e9, MODULUS) - law.share(ratio * 0.9999, 1e9, MODULUS)) / (
            2e-4 * ratio
        )
        np.testing.assert_allclose(jax.grad(law.share)(ratio, 1e9, MODULUS), difference, rtol=1e-6)


def test_asperities_carry_a_contact_without_load():
    law = GreenwoodTrippPressure()
    value, slopes = jax.value_and_grad(law.share, (0, 1))(0.5, 1e-6, MODULUS)
    np.testing.assert_allclose(value, 1.0, rtol=1e-15)
    assert np.all(np.isfinite(slopes))


@pytest.mark.parametrize("law", SHARES, ids=lambda law: f"{type(law).__name__}")
@pytest.mark.parametrize("contact", [LINE, POINT], ids=["line", "point"])
def test_hard_cases_have_finite_values_and_gradients(law, contact):
    mixed = MixedFriction(0.3e-6, law)
    film_law = Moes() if contact is LINE else HamrockDowsonCentral()

    def results(load, film, speed, slide):
        inlet = InletState(speed, 0.01, 2e-8)
        found = mixed.asperities(film_law, contact, load, film, inlet)
        force = mixed.force(load, found.share, 1e-2 * load * jnp.tanh(slide), slide)
        return (*mixed.state(contact, load, found, speed, Sliding(slide), force * slide), force)

    cases = itertools.product((1e-6, 1e3), (0.0, 1e-30, 0.3e-6, 15e-6), (-5.0, 0.0, 5.0), (-1.0, 0.0, 1e-12, 1.0))
    cases = jnp.asarray(list(cases))
    values = jax.jit(jax.vmap(results))(*cases.T)
    slopes = jax.jit(jax.vmap(jax.jacrev(results, (0, 1, 2, 3))))(*cases.T)
    assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves((values, slopes)))
    force, slide = values[-1], cases[:, 3]
    assert np.all(force * slide >= 0.0)


def test_without_a_film_the_contact_is_dry():
    mixed = MixedFriction(0.3e-6, mu_boundary=0.1, slide_width=1e-4)
    share = mixed.asperities(Moes(), LINE, 1e3, 0.0, INLET).share
    assert share == 1.0
    np.testing.assert_allclose(mixed.force(1e3, share, 7.0, 2.0), 0.1 * 1e3, rtol=1e-8)
    assert mixed.force(1e3, share, 7.0, 0.0) == 0.0
    thick = mixed.asperities(Moes(), LINE, 1e3, 15e-6, INLET).share
    np.testing.assert_allclose(mixed.force(1e3, thick, 7.0, 2.0), 7.0, rtol=1e-14)


def test_force_is_odd_and_grows_with_sliding():
    mixed, slide = MixedFriction(0.3e-6), np.linspace(-0.01, 0.01, 101)
    force = mixed.force(1e3, 0.2, 1e3 * slide, slide)
    np.testing.assert_allclose(force, -force[::-1], atol=1e-13)
    assert np.all(np.diff(force) > 0.0)
    slope = jax.grad(mixed.boundary_force, 2)(1e3, 0.2, 0.0)
    np.testing.assert_allclose(slope, 0.2 * 1e3 * 0.12 / 1e-3, rtol=1e-14)


def test_minimum_film_gives_a_larger_share():
    central, least = MixedFriction(0.3e-6), MixedFriction(0.3e-6, film="minimum")
    ratios = lambda law, contact: [
        float(one.asperities(law, contact, 500.0, 0.3e-6, INLET).film_ratio) for one in (central, least)
    ]
    np.testing.assert_allclose(ratios(MartinBlend(Moes()), LINE), [1.0, LINE_SHARE], rtol=1e-14)
    np.testing.assert_allclose(ratios(DowsonHigginson(), LINE), [1.0 / LINE_SHARE, 1.0], rtol=1e-14)
    np.testing.assert_allclose(ratios(MartinBlend(DowsonHigginson()), LINE), [1.0 / LINE_SHARE, 1.0], rtol=1e-14)
    of_points = ratios(HamrockDowsonCentral(), POINT)[1]
    assert 0.5 < of_points < 0.9
    np.testing.assert_allclose(ratios(HamrockDowsonMinimum(), POINT), [1.0 / of_points, 1.0], rtol=1e-14)


@pytest.mark.parametrize("transverse", [None, 0.3])
def test_traction_of_a_point_contact_takes_the_power_of_its_forces(transverse):
    mixed, load, share = MixedFriction(0.3e-6), 500.0, 0.25
    sliding = Sliding(-0.4, transverse, 50.0)
    sheared = Traction(
        *(jnp.asarray(one) for one in (-8.0, 0.0 if transverse is None else 6.0, 0.01)), jnp.asarray(0.0)
    )
    power = sheared.rolling * -0.4 + sheared.transverse * (transverse or 0.0) + sheared.moment * 50.0
    found = mixed.traction(load, share, sheared._replace(power=power), sliding)
    taken = found.rolling * -0.4 + found.transverse * (transverse or 0.0) + found.moment * 50.0
    np.testing.assert_allclose(found.power, taken, rtol=1e-13)
    boundary = jnp.hypot(found.rolling + 0.75 * 8.0, found.transverse - 0.75 * sheared.transverse)
    np.testing.assert_allclose(boundary, 0.25 * 500.0 * 0.12, rtol=1e-4)


@pytest.mark.parametrize("film", ["central", "minimum"])
def test_laws_of_a_line_contact_share_the_load_of_the_starved_film(film):
    """The film ratio is that of the film after inlet heating and supply; rolling resistance is not shared."""
    oil = mobil_jet_ii()
    inlet, contact = oil.at(353.15), LineContact(0.0055, 0.0124, MODULUS)
    flooded = ContactLaws(Moes(), Gupta(), MaxwellEyring(), rolling=JoinedRollingResistance())
    thin = dataclasses.replace(flooded, supply=Supply(layer=0.2e-6))
    mixed = MixedFriction(0.3e-6, film=film)
    rough = dataclasses.replace(thin, mixed=mixed, hysteresis=0.005)
    run = jax.jit(lambda laws: laws.evaluate(contact, 2e3, 8.0, 0.05, oil, inlet))
    smooth, found = run(thin), run(rough)
    assert smooth.film < 0.2e-6 < run(flooded).film
    ratio = smooth.film / 0.3e-6 * (1.0 if film == "central" else LINE_SHARE)
    share = ZhouHoeprich().share(ratio, 1e9, MODULUS)
    boundary = share * 2e3 * 0.12 * 0.05 / np.hypot(0.05, 1e-3)
    np.testing.assert_allclose(found.traction, (1.0 - share) * smooth.traction + boundary, rtol=1e-12)
    state = rough.mixed_state(contact, 2e3, found, 8.0, 0.05, inlet)
    np.testing.assert_allclose(state[:4], [ratio, share, boundary, boundary * 0.05], rtol=1e-12)
    lost = 2.0 / (3.0 * np.pi) * 0.005 * 2e3 * contact.half_width(2e3) / 0.0055
    np.testing.assert_allclose(found.rolling_force - smooth.rolling_force, lost, rtol=1e-9)


def test_hysteresis_of_a_point_contact_opposes_its_roll():
    """Johnson's moment, without load and without roll nothing, with finite slopes."""
    run = jax.jit(jax.value_and_grad(point_hysteresis, (1, 2)), static_argnums=())
    (moment, _), (back, _) = run(POINT, 500.0, 300.0, 0.005), run(POINT, 500.0, -300.0, 0.005)
    np.testing.assert_allclose(moment, 3.0 / 16.0 * 0.005 * 500.0 * POINT.ellipse(500.0).rolling, rtol=1e-11)
    assert back == -moment
    for load, roll in ((0.0, 300.0), (500.0, 0.0), (0.0, 0.0)):
        value, slopes = run(POINT, load, roll, 0.005)
        assert value == 0.0
        assert np.all(np.isfinite(slopes))


def test_wrong_numbers_are_refused():
    with pytest.raises(ValueError, match=r"contact\.mixed\.roughness must be > 0"):
        MixedFriction(0.0)
    with pytest.raises(ValueError, match=r"contact\.mixed\.exponent must be > 0"):
        ZhouHoeprich(2.0, -1.0)
    with pytest.raises(ValueError, match=r"contact\.hysteresis must be >= 0"):
        PointLaws(HamrockDowsonCentral(), hysteresis=-1.0)
    with pytest.raises(ValueError, match=r"contact\.mixed: mixed friction is of contacts that slide"):
        PointLaws(HamrockDowsonCentral(), mixed=MixedFriction(0.3e-6))
