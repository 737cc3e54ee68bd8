"""Biboulet and Houpert's rolling moment of a point contact: check rows, limits, hard cases, gradients."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii

from jaxbearing.contacts import (
    BibouletHoupertPointRollingResistance,
    BibouletHoupertRollingResistance,
    Gupta,
    LineContact,
    NijenbanningVennerMoes,
    PointContact,
    PointLaws,
    RollingInlet,
    SourceRollingResistance,
    aihara_factor,
)

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "rolling_resistance.toml").read_text())["point"]
LAW = BibouletHoupertPointRollingResistance()
STEEL = 206e9 / 0.91
BALL = PointContact(0.005, 0.08, STEEL)
moment = jax.jit(lambda law, contact, inlet: law.moment(contact, inlet))
slopes = jax.jit(jax.grad(lambda law, contact, inlet: law.moment(contact, inlet), (0, 1, 2)))


def inlet(load, speed=30.0, viscosity=0.005):
    return RollingInlet(*(jnp.asarray(v, dtype=float) for v in (load, speed, viscosity, 2e-8, 1e-6)))


def law_of(width):
    return BibouletHoupertPointRollingResistance(None if width is None else jnp.asarray(width))


@pytest.mark.parametrize("row", PUBLISHED, ids=lambda row: f"{row['force']}")
def test_check_rows(row):
    radius = row["radius_along"]
    contact = PointContact(radius, radius * row["radius_ratio"], row["reduced_modulus"])
    ellipse = contact.ellipse(row["load"])
    np.testing.assert_allclose(ellipse.rolling, row["along"], rtol=row["rtol"])
    np.testing.assert_allclose(ellipse.transverse, row["across"], rtol=row["rtol"])
    beta = 4.0 / np.pi * np.exp(contact.log_second_kind()) / (1.0 + 1.0 / row["radius_ratio"])
    np.testing.assert_allclose(beta, row["beta"], rtol=row["rtol"])
    found = moment(law_of(row.get("race_width")), contact, inlet(row["load"], row["speed"], row["viscosity"]))
    np.testing.assert_allclose(found / radius, row["force"], rtol=row["rtol"])


def test_a_wide_ellipse_under_load_is_a_line_contact():
    """1.15 times the plateau of the line law of the width 2c."""
    contact = PointContact(0.005, 500.0, STEEL)
    given = inlet(2e5, 3.0)
    line = LineContact(0.005, 2.0 * contact.ellipse(2e5).transverse, STEEL)
    ratio = moment(LAW, contact, given) / 0.005 / BibouletHoupertRollingResistance().force(line, given)
    np.testing.assert_allclose(ratio, 1.15, atol=0.03)


def test_beside_the_source():
    """At 40 m/s and c/a = 5 the source's law is 0.66 of it at 1 GPa, and alike at 2.2 GPa."""
    contact = PointContact(0.01, 0.12, STEEL)
    ratios = []
    for pressure in (1e9, 2.2e9):
        given = inlet(contact.load_at_pressure(pressure), 40.0)._replace(pressure_viscosity=jnp.asarray(1.1e-8))
        ratios.append(float(moment(SourceRollingResistance(), contact, given) / moment(LAW, contact, given)))
    np.testing.assert_allclose(ratios, [0.66, 1.0], atol=0.03)


def test_a_circle_and_what_is_longer_along_rolling():
    """Continuous at kappa = 1, with finite slopes there; beyond, kappa = beta = 1 with the ellipse's own width."""
    at = lambda ratio: PointContact(0.005, 0.005 * ratio, STEEL)
    below, circle, above = (float(moment(LAW, at(ratio), inlet(100.0))) for ratio in (1 - 1e-9, 1.0, 1 + 1e-9))
    np.testing.assert_allclose([below, above], circle, rtol=1e-8)
    assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(slopes(LAW, at(1.0), inlet(100.0))))
    narrow, alike = at(0.25), at(1.0)
    width = lambda contact: contact.ellipse(100.0).transverse
    # M_p differs by what kappa and beta no longer change: nothing
    np.testing.assert_allclose(
        moment(LAW, narrow, inlet(100.0)) / width(narrow), moment(LAW, alike, inlet(100.0)) / width(alike), rtol=1e-12
    )


def test_without_load_and_at_rest():
    assert float(moment(LAW, BALL, inlet(0.0))) == 0.0
    # linear in the load below 0.01 N
    small = [float(moment(LAW, BALL, inlet(load))) / load for load in (1e-5, 1e-7)]
    np.testing.assert_allclose(*small, rtol=1e-5)
    assert float(moment(LAW, BALL, inlet(500.0, 0.0))) == 0.0
    assert float(moment(LAW, BALL, inlet(500.0, -3.0))) == -float(moment(LAW, BALL, inlet(500.0, 3.0)))


@pytest.mark.parametrize("width", [None, 1e-4, 1e-2])
def test_hard_cases_and_gradients(width):
    """A race narrower than the ellipse, and one much wider, too."""
    law = law_of(width)
    for load in (0.0, 1e-9, 1.0, 1e6):
        for speed in (0.0, 1e-9, -40.0):
            given = inlet(load, speed)
            assert np.isfinite(moment(law, BALL, given))
            assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(slopes(law, BALL, given)))
    given = inlet(500.0)
    gradient = slopes(law, BALL, given)[2]
    for name in ("load", "speed", "viscosity"):
        value = float(getattr(given, name))
        at = lambda part, name=name, value=value: moment(law, BALL, given._replace(**{name: value * (1.0 + part)}))
        slope = (8.0 * (at(1e-3) - at(-1e-3)) - (at(2e-3) - at(-2e-3))) / 12e-3
        np.testing.assert_allclose(getattr(gradient, name) * value, slope, rtol=1e-7)


def test_a_race_cuts_off_what_lies_beside_it():
    """Nothing where it is wide; less the narrower it is; smooth where the ellipse fills it."""
    whole = float(moment(LAW, BALL, inlet(500.0)))
    width = 2.0 * float(BALL.ellipse(500.0).transverse)
    shares = [float(moment(law_of(factor * width), BALL, inlet(500.0))) / whole for factor in (1e3, 4.0, 1.4, 1.0)]
    assert np.all(np.diff(shares) < 0.0)
    np.testing.assert_allclose(shares[0], 1.0, atol=1e-4)
    at = [float(moment(law_of(part * width), BALL, inlet(500.0))) for part in (0.5, 0.6)]
    np.testing.assert_allclose(*at, rtol=1e-7)  # 2c > L_r counts as 2c = L_r


@pytest.mark.parametrize("named", ["aihara", "film_temperature", None])
def test_inlet_heating(named):
    oil = mobil_jet_ii()
    entering, load, speed = oil.at(373.15), jnp.asarray(500.0), jnp.asarray(30.0)
    laws = PointLaws(NijenbanningVennerMoes(), Gupta(), rolling=LAW, rolling_heating=named)
    film = laws.film_state(BALL, load, speed, 0.0 * speed, oil, entering)
    found = laws.rolling_moment(BALL, load, film, speed, speed / 0.005, entering)
    viscosity, factor = (film.viscosity, 1.0) if named == "film_temperature" else (entering.viscosity, None)
    factor = aihara_factor(speed, entering) if factor is None else factor
    np.testing.assert_allclose(found, factor * moment(LAW, BALL, inlet(500.0, 30.0, viscosity)), rtol=1e-12)
