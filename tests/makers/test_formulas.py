"""Makers' formulas: the check rows of the model sheet, limits and hard cases."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.gaps import parker_oil_fraction
from jaxbearing.makers import palmgren, skf
from jaxbearing.makers.palmgren_constants import INA
from jaxbearing.makers.skf_constants import (
    ANGULAR_CONTACT,
    CYLINDRICAL,
    DEEP_GROOVE,
    GEOMETRY,
    ROLLER_DRAG,
    SEALS,
    TAPERED,
)

RTOL = 1e-6
"""The rows are printed with seven digits."""
RPM = np.pi / 30.0
DEEP_62, NU_2, TAPERED_322 = DEEP_GROOVE["62", "622"], CYLINDRICAL["2", "3"], TAPERED["322",]


def skf_moments(variables, n, nu, dm, film):
    rolling, sliding = variables
    speed, viscosity = n * RPM, nu * 1e-6
    friction = skf.sliding_friction(speed, viscosity, dm, 0.15, film)
    return 1e3 * float(skf.rolling_moment(rolling, speed, viscosity, dm)), 1e3 * float(
        skf.sliding_moment(sliding, friction)
    )


@pytest.mark.parametrize(
    ("variables", "n", "nu", "dm", "film", "rolling", "sliding", "total"),
    [
        *[
            (
                lambda axial=axial: skf.deep_groove_variables(DEEP_62, 38.5e-3, 1000.0, axial, 7800.0),
                *(3000.0, 20.0, 38.5e-3, 0.05, *expected),
            )
            for axial, expected in (
                (0.0, (14.76867, 6.344513, 21.11318)),
                (500.0, (34.68175, 14.62248, 49.30423)),
            )
        ],
        (
            lambda: skf.cylindrical_variables(NU_2, 70e-3, 5000.0, 0.0),
            *(5000.0, 12.0, 70e-3, 0.02, 282.6887, 10.50929, 293.198),
        ),
        (
            lambda: skf.tapered_variables(TAPERED_322, 110e-3, 0.0, 6000.0, 1.4),
            *(2000.0, 60.5913, 110e-3, 0.002, 5402.227, 28.54656, 5430.773),
        ),
    ],
    ids=["6205", "6205 axial", "NU 210", "32216"],
)
def test_skf_rows(variables, n, nu, dm, film, rolling, sliding, total):
    found = skf_moments(variables(), n, nu, dm, film)
    np.testing.assert_allclose(found, (rolling, sliding), rtol=RTOL)
    np.testing.assert_allclose(sum(found), total, rtol=RTOL)


@pytest.mark.parametrize(
    ("n", "load", "f1", "viscous", "loaded", "total"),
    [
        (3000.0, 0.22786635759382498, 1.0, 17.49228, 8.772855, 26.26513),
        (50.0, 0.2, 1.0, 1.826132, 7.7, 9.526132),
    ],
)
def test_palmgren_rows(n, load, f1, viscous, loaded, total):
    found = (
        1e3 * palmgren.viscous_moment(2.0, n * RPM, 20e-6, 38.5e-3),
        1e3 * palmgren.load_moment(f1, load, 38.5e-3),
    )
    np.testing.assert_allclose(found, (viscous, loaded), rtol=RTOL)
    np.testing.assert_allclose(sum(found), total, rtol=RTOL)


def test_drag_rows():
    ball = skf.ball_drag(3000.0 * RPM, 20e-6, 25e-3, 52e-3, 5e-3, GEOMETRY["deep_groove"])
    np.testing.assert_allclose(1e3 * ball, 0.6893624, rtol=RTOL)
    kz, kl = GEOMETRY["cylindrical"], ROLLER_DRAG["cylindrical"]
    roller = skf.roller_drag(3000.0 * RPM, 50e-3, 90e-3, 20e-3, 10e-3, kz, kl)
    np.testing.assert_allclose(1e3 * roller, 96.70568, rtol=RTOL)


def test_seal_row():
    (seal,) = SEALS["deep_groove", "RSH"]
    np.testing.assert_allclose(1e3 * skf.seal_moment(seal, 30e-3), 60.97675, rtol=RTOL)


def test_parker_row():
    """The row of the oil fraction stands beside those of the makers in the sheet."""
    found = parker_oil_fraction(760.0 / 6e7, 72000.0 * RPM, 46.5e-3)
    np.testing.assert_allclose(found, 0.02365367, rtol=RTOL)


def test_constants_are_those_of_the_checks():
    assert DEEP_62 == (3.9e-07, 1.7, 0.00323, 36.5)
    assert NU_2 == (1.09e-06, 0.16, 0.0015)
    assert TAPERED_322 == (2.27e-06, 10.9, 0.018, 2.0)


@pytest.mark.parametrize(
    ("radial", "n", "measured", "skf_full", "skf_low", "grease", "bath"),
    [
        (0.0, 500.0, 1300.0, 2.09, 2.00, 0.87, 1.02),
        (0.0, 2000.0, 2950.0, 1.84, 1.54, 0.58, 0.75),
        (0.0, 4000.0, 3750.0, 1.81, 1.27, 0.61, 0.82),
        (6500.0, 500.0, 1500.0, 1.86, 1.78, 0.75, 0.88),
        (6500.0, 1000.0, 1950.0, 2.07, 1.89, 0.69, 0.85),
        (6500.0, 2000.0, 2500.0, 2.22, 1.86, 0.69, 0.88),
        (6500.0, 4000.0, 3250.0, 2.13, 1.50, 0.71, 0.94),
    ],
)
def test_32216_over_measured_torques(radial, n, measured, skf_full, skf_low, grease, bath):
    """The columns of the sheet at 50 degC and 6 kN axial load, with two decimals: moments over measured ones."""
    speed, nu, dm = n * RPM, 60.5913e-6, 110e-3
    rolling, sliding = skf.tapered_variables(TAPERED_322, dm, radial, 6000.0, 1.4)
    friction = skf.sliding_friction(speed, nu, dm, 0.15, 0.002)
    load = palmgren.ina_load("tapered", radial, 6000.0, 1.4)
    found = []
    for constant in (0.0, 3e-8):
        starvation = skf.starvation_factor(speed, nu, 80e-3, 140e-3, constant, GEOMETRY["tapered"])
        moment = skf.rolling_moment(rolling, speed, nu, dm, starvation) + skf.sliding_moment(sliding, friction)
        found.append(1e3 * float(moment) / measured)
    frictions = next(one for series, one in INA["tapered"].items() if "322" in series)
    for f0 in (frictions.grease, frictions.bath):
        moment = palmgren.viscous_moment(f0, speed, nu, dm) + palmgren.load_moment(frictions.size, load, dm)
        found.append(1e3 * float(moment) / measured)
    np.testing.assert_allclose(found, (skf_full, skf_low, grease, bath), atol=5.1e-3)


# limits


def test_friction_is_boundary_at_rest_and_film_at_speed():
    of = lambda speed: float(skf.sliding_friction(speed, 20e-6, 38.5e-3, 0.15, 0.05))
    assert of(0.0) == 0.15
    np.testing.assert_allclose(of(2000.0), 0.05, rtol=1e-12)


def test_no_starvation_without_its_constant_or_at_rest():
    assert float(skf.starvation_factor(300.0, 6e-5, 0.08, 0.14, 0.0, 6.0)) == 1.0
    assert float(skf.starvation_factor(0.0, 6e-5, 0.08, 0.14, 3e-8, 6.0)) == 1.0
    # of 32216 at 2000 rpm, 50 degC; the sheet prints 0.84
    found = float(skf.starvation_factor(2000.0 * RPM, 60.5913e-6, 0.08, 0.14, 3e-8, 6.0))
    np.testing.assert_allclose(found, 0.84, atol=5e-3)


def test_palmgren_is_constant_below_2000_and_jumps_by_08_per_cent_there():
    of = lambda rolled: float(palmgren.viscous_moment(2.0, rolled * RPM, 1e-6, 38.5e-3))
    assert of(100.0) == of(1999.9)
    np.testing.assert_allclose(of(2000.0 * (1 + 1e-12)) / of(1999.9) - 1.0, -0.0078, atol=1e-4)


def test_axial_load_begins_with_the_jump_that_is_printed():
    dm, radial = 38.5e-3, 1000.0
    alone, some = (skf.deep_groove_variables(DEEP_62, dm, radial, axial, 7800.0)[1] for axial in (0.0, 1e-3))
    np.testing.assert_allclose(some / alone, 38.5**0.115, rtol=1e-6)


def test_ina_load_is_never_below_the_radial_one():
    for family in INA:
        assert float(palmgren.ina_load(family, 1000.0, 0.0, 1.6)) >= 1000.0
    assert float(palmgren.ina_load("deep_groove", 1000.0, 500.0)) == 1550.0
    assert float(palmgren.ina_load("tapered", 1000.0, 1000.0, 1.6)) == 3200.0


def test_timken_tapered():
    """By the printed units: n in rpm, mu in mPa s."""
    found = palmgren.timken_tapered_moment(50.0, 1000.0 * RPM, 0.02, 3000.0)
    np.testing.assert_allclose(found, 2.56e-6 * 50.0 * 20000.0**0.62 * 3000.0**0.3, rtol=1e-12)
    least = palmgren.timken_least_speed(20.0, 0.02, 1.5, 3000.0, 1.4)
    np.testing.assert_allclose(least / RPM, 625.0 / 400.0 * (1.5 * 3000.0 / 1.4) ** (2 / 3), rtol=1e-12)


def test_dry_level_has_no_drag_and_full_bearing_has_the_most():
    of = lambda level: float(skf.ball_drag(300.0, 20e-6, 25e-3, 52e-3, level, 3.1))
    assert of(0.0) == 0.0
    levels = [of(level) for level in np.linspace(0.0, 0.05, 41)]
    assert np.all(np.diff(levels) >= 0.0)


# hard cases: value and gradient


def every_moment(numbers):
    """Moments of all formulas at a speed, loads and an oil level."""
    speed, radial, axial, level = numbers
    found = []
    for variables, film in (
        (skf.deep_groove_variables(DEEP_62, 0.04, radial, axial, 7800.0), 0.05),
        (skf.angular_contact_variables(ANGULAR_CONTACT["72B",], 0.04, radial, axial, speed), 0.05),
        (skf.cylindrical_variables(NU_2, 0.04, radial, axial), 0.02),
        (skf.tapered_variables(TAPERED_322, 0.04, radial, axial, 1.6), 0.002),
    ):
        friction = skf.sliding_friction(speed, 2e-5, 0.04, 0.15, film)
        found += [skf.rolling_moment(variables[0], speed, 2e-5, 0.04), skf.sliding_moment(variables[1], friction)]
    f1 = palmgren.load_factor(0.0009, 0.5, radial, 7800.0)
    found += [palmgren.viscous_moment(2.0, speed, 2e-5, 0.04), palmgren.load_moment(f1, radial, 0.04)]
    found.append(skf.ball_drag(speed, 2e-5, 0.025, 0.052, level, 3.1))
    found.append(skf.roller_drag(speed, 0.05, 0.09, 0.02, level, 5.1, 0.65))
    found.append(palmgren.timken_tapered_moment(50.0, speed, 0.02, radial))
    return jnp.stack(found)


def test_hard_cases():
    """At rest, without load, without oil, and far beyond all of them; one program for all."""
    cases = [
        (speed, *loads, level)
        for speed in (0.0, 1e-9, 1.0, 1e4)
        for loads in ((0.0, 0.0), (0.0, 1.0), (1e5, 0.0), (1e5, 1e5))
        for level in (0.0, 0.005, 1.0)
    ]
    numbers = jnp.array(cases)
    for of in (every_moment, jax.jacfwd(every_moment), jax.jacrev(every_moment)):
        assert np.all(np.isfinite(jax.jit(jax.vmap(of))(numbers)))


def test_gradients_are_those_of_differences():
    def moment(load):
        variables = skf.deep_groove_variables(DEEP_62, 0.0385, load, 300.0, 7800.0)
        return skf.rolling_moment(variables[0], 300.0, 2e-5, 0.0385) + skf.sliding_moment(variables[1], 0.06)

    difference = (moment(1000.1) - moment(999.9)) / 0.2
    np.testing.assert_allclose(jax.grad(moment)(1000.0), difference, rtol=1e-7)
