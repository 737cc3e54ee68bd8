"""Starved contacts: published check values, limits, hard cases, gradients, the laws of a contact with a supply."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii
from scipy.optimize import brentq

from jaxbearing.contacts import (
    FullRangeRollingResistance,
    LineContact,
    Moes,
    NijenbanningVennerMoes,
    PointContact,
    PointLaws,
    SourceRollingResistance,
    Supply,
    supply,
)
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.contacts.oil_supply import LEVELS

G = supply.GAP_EXPONENT
OVER_MINIMUM = np.log(0.75)


@pytest.mark.parametrize(
    ("gap", "film", "roll", "roll_bh"),
    [
        (2.0, 0.7368051, 0.2909987, 0.2480233),
        (20.0, 0.9768223, 0.7483286, 0.7098678),
        (500.0, 0.9994843, 0.9460303, 0.9626468),
    ],
)
def test_factors_at_a_gap(gap, film, roll, roll_bh):
    s = np.log(gap) - OVER_MINIMUM
    np.testing.assert_allclose(np.exp(supply.log_film_factor_of_gap(np.log(gap))), film, rtol=1e-6)
    np.testing.assert_allclose(supply.starved_rolling_factor(s), roll, rtol=1e-6)
    np.testing.assert_allclose(supply.biboulet_houpert_rolling_factor(s), roll_bh, rtol=1e-6)


@pytest.mark.parametrize(
    ("layer", "gamma", "film", "gap", "roll"),
    [
        (0.5, 8.0, 0.4997564, 0.8111397, 0.1106851),
        (1.0, 8.0, 0.917004, 6.459493, 0.5690543),
        (0.5, 3.0, 0.4807499, 0.757964, 0.101333),
    ],
)
def test_factors_of_a_layer(layer, gamma, film, gap, roll):
    s = supply.log_gap_of_layer(np.log(layer), gamma)
    np.testing.assert_allclose(np.exp(supply.log_film_factor_of_layer(np.log(layer), gamma)), film, rtol=1e-6)
    np.testing.assert_allclose(np.exp(s), gap, rtol=1e-6)
    np.testing.assert_allclose(supply.starved_rolling_factor(s - OVER_MINIMUM), roll, rtol=1e-6)


def test_other_printed_rows():
    np.testing.assert_allclose(np.exp(supply.hamrock_dowson_log_film_factor(1.3, 0.0817)), 0.777088, rtol=1e-6)
    np.testing.assert_allclose(supply.layer_of_flow(1.0, 4.1667e-5, 0.0124, 38.8), 8.660417e-5, rtol=1e-6)
    np.testing.assert_allclose(supply.levelling_time(0.01, 0.0005, 0.03, 1e-5), 62.5, rtol=1e-12)
    np.testing.assert_allclose(supply.hertz_gap(0.0002, 0.0055, 0.0003), 2.598645e-6, rtol=1e-6)


@pytest.mark.parametrize(
    ("gap_over_minimum", "fitted", "published"),
    [
        (1, 0.100, 0.113),
        (5, 0.447, 0.373),
        (10, 0.598, 0.526),
        (50, 0.813, 0.793),
        (300, 0.921, 0.931),
        (1000, 0.956, 0.974),
    ],
)
def test_rolling_factors_as_tabulated(gap_over_minimum, fitted, published):
    s = np.log(gap_over_minimum)
    np.testing.assert_allclose(supply.starved_rolling_factor(s), fitted, atol=5e-4)  # three printed digits
    np.testing.assert_allclose(supply.biboulet_houpert_rolling_factor(s), published, atol=5e-4)


MENISCUS = jax.jit(jax.value_and_grad(lambda log_gap: supply.log_gap_at_meniscus(log_gap).value))


@pytest.mark.parametrize("log_hertz_gap", [-25.0, -3.0, 0.0, 2.0, 30.0])
def test_gap_at_a_meniscus(log_hertz_gap):
    """The root of S = phi(S) + G, by another solver; its derivative by the implicit function."""
    hertz = np.exp(log_hertz_gap)
    # 1 - phi/S as expm1, for S - phi cancels at a narrow gap
    missing = lambda s: s - np.log(hertz) + np.log(-np.expm1(-np.log1p(np.exp(G * s)) / G))
    expected = brentq(missing, -60, 60, xtol=1e-13)
    found, slope = MENISCUS(log_hertz_gap)
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10)
    step = 1e-4
    difference = (missing(expected + step) - missing(expected - step)) / (2 * step)
    np.testing.assert_allclose(slope, 1 / difference, rtol=1e-6)


def test_limits():
    # a wide gap: 1 - S^-g/g; a narrow one: the gap itself, and no resistance
    np.testing.assert_allclose(-np.expm1(supply.log_film_factor_of_gap(20.0)), np.exp(-20.0 * G) / G, rtol=1e-9)
    np.testing.assert_allclose(supply.log_film_factor_of_gap(-20.0), -20.0, rtol=1e-10)
    assert supply.starved_rolling_factor(-60.0) < 1e-20
    # a thick layer hides the gap: nothing is left of the factors
    assert abs(float(supply.log_film_factor_of_layer(np.log(1e6), 8.0))) < 1e-40
    assert float(supply.starved_rolling_factor(supply.log_gap_of_layer(np.log(1e6), 8.0))) == pytest.approx(
        1, abs=1e-15
    )
    # the logarithm is continuous where its form changes
    around = [supply.log_deficit(supply.FAR + d, 0.4) for d in (-1e-9, 1e-9)]
    np.testing.assert_allclose(around[0], around[1], rtol=1e-9)
    # a rolling factor by Biboulet and Houpert, or by the fit, rises with the gap, from 0 to 1
    s = np.linspace(-40, 40, 801)
    for law in (supply.starved_rolling_factor, supply.biboulet_houpert_rolling_factor, supply.log_film_factor_of_gap):
        assert np.all(np.diff(np.asarray(law(s))) >= -1e-15)  # round-off next to 1


@pytest.mark.parametrize(
    "law",
    [
        supply.log_film_factor_of_gap,
        lambda x: supply.log_film_factor_of_layer(x, 8.0),
        lambda x: supply.log_gap_of_layer(x, 8.0),
        lambda x: supply.log_gap_of_layer(x, 64.0),
        supply.starved_rolling_factor,
        supply.biboulet_houpert_rolling_factor,
        lambda x: supply.log_gap_at_meniscus(x).value,
        lambda x: supply.hamrock_dowson_log_film_factor(jnp.exp(x), 0.08),
        lambda x: jnp.log(supply.hertz_gap(2e-4, 5e-3, 2e-4 * jnp.exp(x))),
    ],
)
def test_hard_cases(law):
    x = jnp.asarray([-60.0, -30.0, -1.0, 0.0, 1e-9, 1.0, 30.0, 60.0])
    value, slope = jax.jit(jax.vmap(jax.value_and_grad(law)))(x)
    assert np.all(np.isfinite(value))
    assert np.all(np.isfinite(slope))


def test_a_meniscus_inside_the_contact_is_refused():
    with pytest.raises(ValueError, match="meniscus must lie outside the contact"):
        supply.hertz_gap(2e-4, 5e-3, 2e-4)


OIL = mobil_jet_ii()
LINE, POINT = LineContact(0.0055, 0.0124, 2.3e11), PointContact(0.005, 0.08, 2.3e11)
WAYS = {
    "gap": ({"meniscus_gap": [3e-6, 0.0]}, {}),
    "layer": ({"layer": [1e-6, 0.0, 1.0], "layer_exponent": [8.0, 8.0, 64.0]}, {}),
    # the second lies inside of loaded contacts
    "distance": ({"meniscus_distance": [3e-4, 1e-6]}, {}),
    "hamrock_dowson": ({"meniscus_distance": [3e-4]}, {"film_law": "hamrock_dowson"}),
    "flow": ({"from_flow": [0.1]}, {}),
    "over_central": ({"gap_over_central": [3.45]}, {"rolling_law": "biboulet_houpert"}),
}
"""Numbers of a supply, each a way to give it, and its words."""
CASES = np.asarray(
    [[0.0, 30.0], [1e-12, 30.0], [2000.0, 0.0], [2000.0, 1e-9], [2000.0, -30.0], [2e5, 80.0], [-1e-3, 1.0]]
)
"""Load, N, and mean speed, m/s."""


def inlet(flow):
    oil = OIL.at(373.15)
    return type(oil)(**{name: getattr(oil, name) for name in oil.__dataclass_fields__} | {"flow": flow})


def line(given, load, speed, flow=1e-5):
    laws = ContactLaws(Moes(), rolling=FullRangeRollingResistance(), supply=given)
    return laws.evaluate(LINE, load, speed, 0.0, OIL, inlet(flow))


def point(given, load, speed, flow=1e-5):
    laws = PointLaws(NijenbanningVennerMoes(), rolling=SourceRollingResistance(), supply=given)
    film = laws.film_state(POINT, load, speed, 0.0, OIL, inlet(flow))
    return film, laws.rolling_moment(POINT, load, film, speed, speed / 0.005, inlet(flow))


CONTACTS = {"layer": LINE, "distance": POINT, "hamrock_dowson": LINE, "flow": POINT, "over_central": LINE}
"""Kind of contact in which each way but the first, which is followed through both, has its hard cases."""


def at_hard_cases(numbers, way, *columns):
    """Of each supply, at each row of the columns."""
    lists, words = WAYS[way]
    given = {name: jnp.asarray(values) for name, values in lists.items()}

    def run(given, *row):
        of_numbers = lambda given, *row: numbers(Supply(**given, **words), *row)
        places = tuple(range(1 + len(row)))
        return of_numbers(given, *row), jax.jacfwd(of_numbers, places)(given, *row)

    rows = (None, *(0 for _ in columns))
    of_all = jax.vmap(jax.vmap(run, rows), (0, *(None for _ in columns)))
    values, slopes = jax.jit(of_all)(given, *columns)
    assert np.all(np.isfinite(values))
    assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(slopes))
    return values


def test_contacts_at_hard_cases():
    """Values and gradients are finite; film and resistance are the flooded ones times the factors."""

    def numbers(part, load, speed):
        state = line(part, load, speed)
        film, moment = point(part, load, speed)
        found = [state.film, state.separation, state.rolling_force, film.film, film.separation, moment]
        factors = [state.supply.film_factor, state.supply.rolling_factor, film.flooded]
        return jnp.stack([*found, state.supply.gap_over_central, film.supply.rolling_factor, *factors])

    usual = [2000.0, 30.0]
    values = at_hard_cases(numbers, "gap", *np.asarray([*CASES, usual]).T)
    flooded, (film, _) = line(None, *usual), point(None, *usual)
    for row in values[:, -1]:
        np.testing.assert_allclose(row[0], row[8] * flooded.film, rtol=1e-13)
        np.testing.assert_allclose(row[2], row[9] * flooded.rolling_force, rtol=1e-13)
        np.testing.assert_allclose(row[10], film.film, rtol=1e-13)


@pytest.mark.parametrize("way", CONTACTS)
def test_starved_films_at_hard_cases(way):
    """Values and gradients are finite, for flooded films of any thickness."""

    def numbers(part, load, speed, log_flooded):
        end = part.starvation(CONTACTS[way], load, log_flooded, speed, inlet(1e-5))
        return jnp.stack([value for value in end if value is not None])

    thickness = np.log([1e-15, 1e-9, 5e-7, 1e-3])
    load, speed = np.repeat(CASES, len(thickness), axis=0).T
    # a contact asks with the size of its speed, and with one that is not 0
    values = at_hard_cases(numbers, way, load, np.hypot(speed, 1e-12), np.tile(thickness, len(CASES)))
    flooded, film, _, factor = np.moveaxis(values, -1, 0)[:4]
    np.testing.assert_allclose(film, factor * flooded, rtol=1e-13)
    assert np.all((factor > 0.0) & (factor <= 1.0 + 1e-12))


def test_a_level_is_its_number():
    """The words for usual supplies: a gap over the central film."""
    for level, gap in LEVELS.items():
        of_level, of_gap = (line(Supply(**way), 2000.0, 30.0) for way in ({"level": level}, {"gap_over_central": gap}))
        assert of_level.film == of_gap.film


def test_no_oil_leaves_the_layer():
    """h -> h_l with slope 1 as the layer goes to 0, and no resistance."""

    @jax.jit
    @jax.value_and_grad
    def film(layer):
        return line(Supply(layer=layer), 2000.0, 30.0).film

    np.testing.assert_allclose(film(0.0)[1], 1.0, rtol=1e-12)
    np.testing.assert_allclose(film(1e-9)[0], 1e-9, rtol=2e-6)  # the floor, 1e-15 m
    assert line(Supply(layer=1e-12), 2000.0, 30.0).rolling_force < 1e-6


def test_a_layer_limits_the_film_as_the_speed_rises():
    layer, speeds = 3e-7, np.geomspace(0.1, 300, 40)
    state = line(Supply(layer=layer), 2000.0, speeds)
    films = np.asarray(state.film)
    assert np.all(np.diff(films) > 0)
    assert films[-1] == pytest.approx(layer, rel=1e-4)
    assert films[-1] < layer + 1e-14
    assert np.all(np.diff(np.asarray(state.supply.film_factor)) < 0)
    # at a low speed the same layer is plenty
    np.testing.assert_allclose(films[0], line(None, 2000.0, speeds[0]).film, rtol=1e-6)


def test_rest_is_flooded():
    for way in ({"meniscus_gap": 3e-6}, {"layer": 1e-6}, {"meniscus_distance": 3e-4}):
        np.testing.assert_allclose(line(Supply(**way), 2000.0, 0.0).supply.film_factor, 1.0, atol=1e-4)


def test_layer_from_the_flow():
    found = line(Supply(from_flow=0.5), 2000.0, 30.0, flow=2e-7)
    layer = 0.5 * 2e-7 / (0.0124 * 30.0)
    np.testing.assert_allclose(found.film, line(Supply(layer=layer), 2000.0, 30.0).film, rtol=1e-12)
    width = 2 * float(POINT.semi_axis_transverse(2000.0))
    found = point(Supply(from_flow=0.5), 2000.0, 30.0, flow=2e-8)[0]
    layer = 0.5 * 2e-8 / (width * 30.0)
    np.testing.assert_allclose(found.film, point(Supply(layer=layer), 2000.0, 30.0)[0].film, rtol=1e-9)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({}, "exactly one of meniscus_gap, .* found none"),
        ({"layer": 1e-6, "level": "jet"}, "found layer and level"),
        ({"layer": -1e-6}, "contact.supply.layer must be >= 0"),
        ({"from_flow": 2.0}, "contact.supply.from_flow must be above 0 and at most 1"),
        ({"level": "much"}, "contact.supply.level"),
        ({"layer": 1e-6, "film_law": "hamrock_dowson"}, "needs meniscus_distance"),
        ({"meniscus_gap": 1e-6, "layer_exponent": 5.0}, "only a layer"),
    ],
)
def test_refused(given, says):
    with pytest.raises(ValueError, match=says):
        Supply(**given)
