"""Fits of rings on shafts and in housings: the check tables of part A9 of the sheet on the operating state."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.bearings.mounted import running_scene
from jaxbearing.materials import Material
from jaxbearing.mounting import Annulus, Fit, Fits
from jaxbearing.mounting.rectified import rectified_normal
from jaxbearing.scenes.reader import load_scene

STEEL = Material(208e9, 0.3, 7830.0, 12.5e-6)
M50 = Material(203e9, 0.29, 7870.0, 12.3e-6)
ALUMINIUM = Material(72e9, 0.33, 2750.0, 23.5e-6)
UM, RPM = 1e-6, np.pi / 30.0
DEEP_GROOVE = {"bore": 0.025, "inner": 0.0305575, "shaft": 0.0, "outside": 0.052, "outer": 0.0464455, "wall": 0.080}
TURBINE = {
    "bore": 0.12,
    "inner": 0.132237576,
    "shaft": 0.09,
    "outside": 0.19,
    "outer": 0.173700212,
    "wall": 0.22,
}
ROLLERS = {"bore": 0.118, "inner": 0.130, "shaft": 0.095, "outside": 0.166, "outer": 0.154, "wall": 0.19}


def seated(sizes, interference, rings=STEEL, housing=STEEL, rpm=0.0, warming=(0.0, 0.0, 0.0, 0.0)):
    """Growth of both raceways, um, and the states of both fits. `warming`: inner, outer ring, shaft, housing."""
    inner = Annulus(rings, sizes["bore"], sizes["inner"], rpm * RPM, warming[0])
    outer = Annulus(rings, sizes["outer"], sizes["outside"], 0.0, warming[1])
    shaft = Annulus(STEEL, sizes["shaft"], sizes["bore"], rpm * RPM, warming[2])
    wall = Annulus(housing, sizes["outside"], sizes["wall"], 0.0, warming[3])
    on_shaft, in_housing = (
        Fit(shaft, inner, interference[0] * UM).state(),
        Fit(outer, wall, interference[1] * UM).state(),
    )
    growth_inner = inner.free(sizes["inner"]) + inner.pressed(sizes["inner"], on_shaft.pressure, 0.0)
    growth_outer = outer.free(sizes["outer"]) + outer.pressed(sizes["outer"], 0.0, in_housing.pressure)
    return growth_inner / UM, growth_outer / UM, on_shaft, in_housing


# growth of inner and outer raceway, um, pressures, MPa, interferences in operation, um
CASES = {
    "A1": ((DEEP_GROOVE, (10, -1)), {}, (8.18129755, 0.0, 13.7556101, 0.0, 10.0, -1.0)),
    "A2 hollow shaft": (
        ({**DEEP_GROOVE, "shaft": 0.015}, (10, -1)),
        {},
        (6.89823697, 0.0, 11.5983384, 0.0, 10.0, -1.0),
    ),
    "A3": ((DEEP_GROOVE, (-1, 8)), {}, (0.0, -6.22455199, 0.0, 2.81859027, -1.0, 8.0)),
    "A4 aluminium housing": (
        (DEEP_GROOVE, (-1, 8)),
        {"housing": ALUMINIUM},
        (0.0, -4.24200165, 0.0, 1.92085545, -1.0, 8.0),
    ),
    "A5 warm, aluminium housing": (
        (DEEP_GROOVE, (10, 8)),
        {"housing": ALUMINIUM, "warming": (60.0, 50.0, 55.0, 40.0)},
        (29.8210948, 29.0284375, 11.606296, 0.0, 8.4375, -8.38),
    ),
    "A5b warm, steel housing": (
        (DEEP_GROOVE, (12, 0)),
        {"warming": (60.0, 50.0, 55.0, 48.0)},
        (31.4573543, 28.0169478, 14.357418, 0.458020919, 10.4375, 1.3),
    ),
    "A6 at rest": ((TURBINE, (60, -10)), {"rings": M50}, (44.6608515, 0.0, 7.34819836, 0.0, 60.0, -10.0)),
    "A6 12 500 rpm": (
        (TURBINE, (60, -10)),
        {"rings": M50, "rpm": 12500.0},
        (65.6159904, 0.0, 5.39488261, 0.0, 44.0506558, -10.0),
    ),
    "A6 20 000 rpm": (
        (TURBINE, (60, -10)),
        {"rings": M50, "rpm": 20000.0},
        (98.3060071, 0.0, 2.34771004, 0.0, 19.1696788, -10.0),
    ),
    "A7": (
        (TURBINE, (60, -10)),
        {"rings": M50, "rpm": 12500.0, "warming": (110.0, 90.0, 100.0, 80.0)},
        (235.333296, 185.855826, 3.88115375, 0.617043499, 31.6906558, 10.33),
    ),
    "A8": (
        (ROLLERS, (45, 5)),
        {"rings": M50, "rpm": 10500.0, "warming": (85.0, 75.0, 80.0, 70.0)},
        (178.831148, 133.747481, 3.4877601, 0.763931089, 30.261624, 12.885),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_check_table(case):
    arguments, more, expected = CASES[case]
    inner, outer, on_shaft, in_housing = seated(*arguments, **more)
    found = [inner, outer, on_shaft.pressure / 1e6, in_housing.pressure / 1e6]
    found += [on_shaft.interference / UM, in_housing.interference / UM]
    # the sheet has up to 9 digits
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-12)


def test_same_material_and_solid_shaft():
    """The ring takes the whole interference, as bore over raceway."""
    inner, _, _, _ = seated(DEEP_GROOVE, (10, -1))
    np.testing.assert_allclose(inner, 10.0 * 0.025 / 0.0305575, rtol=1e-14)


@pytest.mark.parametrize(
    ("shaft", "interference", "expected"),
    [(0.09, 60, 24244.5553), (0.09, 30, 17143.4895), (0.0, 60, 18017.0467)],
)
def test_speed_at_which_the_ring_comes_loose(shaft, interference, expected):
    sizes = {**TURBINE, "shaft": shaft}
    _, _, fit, _ = seated(sizes, (interference, -10), rings=M50)
    np.testing.assert_allclose(fit.loose_speed / RPM, expected, rtol=1e-8)
    # there the pressure has gone, and just below it has not
    at = lambda rpm: seated(sizes, (interference, -10), rings=M50, rpm=rpm)[2]
    assert float(at(fit.loose_speed / RPM).interference) == pytest.approx(0.0, abs=1e-18)
    assert float(at(0.999 * fit.loose_speed / RPM).pressure) > 0.0
    assert float(at(1.001 * fit.loose_speed / RPM).pressure) == 0.0


def test_speed_at_which_the_outer_ring_comes_loose():
    """Outer ring and housing turn together (planets, wheel hubs): a light housing grows more than the ring in it."""
    seat = lambda rpm: Fit(Annulus(M50, 0.04, 0.05, speed=rpm * RPM), Annulus(M50, 0.05, 0.09, speed=rpm * RPM), 30e-6)
    loose = float(seat(0.0).state().loose_speed) / RPM
    assert np.isfinite(loose)
    assert float(seat(loose).state().interference) == pytest.approx(0.0, abs=1e-18)
    fits = {"fits.housing_tolerance": "none", "fits.housing_interference": "30 um", "thermal": "none"}
    scene = load_scene("deep_groove_6205_mounted", fits)
    turning = lambda speed: running_scene(scene.at_operation(outer_speed=speed))[1]
    speed = float(turning(0.0).loose_speed_outer)
    assert float(turning(0.999 * speed).pressure_outer) > 0.0
    assert float(turning(1.001 * speed).pressure_outer) == 0.0


def test_loose_at_rest_and_never_loose():
    assert float(seated(DEEP_GROOVE, (-5, -1))[2].loose_speed) == 0.0
    # a stiff ring on a heavy soft shaft stays tight at any speed
    soft, stiff = Material(72e9, 0.33, 8000.0), Material(310e9, 0.26, 3200.0)
    fit = Fit(Annulus(soft, 0.0, 0.025), Annulus(stiff, 0.025, 0.03), 1e-6).state()
    assert np.isinf(float(fit.loose_speed))


def test_free_ring_turning():
    found = Annulus(M50, 0.12, 0.132237576, 12500.0 * RPM).spun(0.12)
    np.testing.assert_allclose(found / UM, 33.7568367, rtol=1e-8)


def test_turning_disc_and_pressed_ring_against_closed_forms():
    """A solid disc grows by u = rho w^2 r (1 - nu)/(8 E) ((3 + nu) b^2 - (1 + nu) r^2). A thin ring has the hoop stress
    p r/t."""
    body, nu = Annulus(STEEL, 0.0, 0.1, 1000.0), 0.3
    for radius in (0.01, 0.03, 0.05):
        exact = 7830.0 * 1e6 * radius * (1 - nu) / (8 * 208e9) * ((3 + nu) * 0.05**2 - (1 + nu) * radius**2)
        np.testing.assert_allclose(body.spun(2 * radius), 2 * exact, rtol=1e-13)
    thin = Annulus(STEEL, 0.1, 0.1002)
    np.testing.assert_allclose(thin.pressed(0.1, 1e6, 0.0), 1e6 * 0.05 / 1e-4 / 208e9 * 0.1, rtol=3e-3)
    np.testing.assert_allclose(thin.hoop_stress_at_bore(1e6), 1e6 * 0.05 / 1e-4, rtol=3e-3)


def test_thin_shaft_presses_nothing():
    """A shell as shaft: the ring grows as if it were free."""
    growth = lambda bore: seated({**TURBINE, "shaft": bore}, (60, -10), rings=M50)[0]
    np.testing.assert_allclose(growth(0.12 * (1 - 1e-9)), 0.0, atol=1e-5)
    assert growth(0.119) < growth(0.11) < growth(0.0)


def test_one_material_and_one_temperature_only_scale():
    inner, outer, on_shaft, in_housing = seated(DEEP_GROOVE, (-1, -2), warming=(70.0,) * 4)
    np.testing.assert_allclose(
        [inner * UM, outer * UM], [12.5e-6 * 70.0 * 0.0305575, 12.5e-6 * 70.0 * 0.0464455], rtol=1e-12
    )
    # a gap scales with the seat
    np.testing.assert_allclose([on_shaft.interference / UM, in_housing.interference / UM], [-1.0, -2.0], rtol=1e-9)


@pytest.mark.parametrize("interference", [10.0, 0.0, -3.0])
def test_derivatives_at_the_limit_are_those_of_the_tight_fit(interference):
    growth = lambda size: seated(DEEP_GROOVE, (size, -1))[0]
    forward, reverse = jax.jacfwd(growth)(interference), jax.grad(growth)(interference)
    expected = 0.818129755 if interference >= 0.0 else 0.0
    np.testing.assert_allclose([forward, reverse], expected, rtol=1e-8)


@pytest.mark.parametrize(("interference", "loss", "slope"), [(-1, 0, 0), (0, 0, 0), (1, 1, 1), (2, 2, 0), (30, 2, 0)])
def test_smoothing_of_tight_seats(interference, loss, slope):
    """What a seat loses where the scene does not say; at both ends its slope is one of them, no mean."""
    lost = Fits(shaft_interference=0.0).smoothed
    np.testing.assert_allclose(lost(jnp.asarray(interference * UM)), loss * UM, rtol=1e-14, atol=0.0)
    assert float(jax.grad(lost)(interference * UM)) == slope


def test_rectified_normal_against_sums():
    z = np.linspace(-9.0, 9.0, 400001)
    weight = np.exp(-0.5 * z * z) / np.sqrt(2 * np.pi) * (z[1] - z[0])
    for mean, deviation in ((10.0, 2.0), (-1.0, 3.0), (0.0, 1.0)):
        positive = np.maximum(mean + deviation * z, 0.0)
        expected = np.sum(weight * positive)
        found = rectified_normal(mean, deviation)
        np.testing.assert_allclose(found, [expected, np.sum(weight * positive**2) - expected**2], rtol=1e-8)


def test_clearance_of_a_fitted_bearing_is_a_random_number():
    """6205, clearance 13 to 28 um, k5 and J7 with 2 um of smoothing: mean and scatter of the mounted clearance."""
    inner = 0.818129755
    outer = -seated(DEEP_GROOVE, (-1, 8))[1] / 8.0
    np.testing.assert_allclose(outer, 0.778068999, rtol=1e-8)
    # sd: a sixth of each tolerance: seat and ring
    of_inner = rectified_normal(11.5 - 2.0, jnp.sqrt((9.0**2 + 10.0**2) / 36.0))
    of_outer = rectified_normal(-9.5 - 2.0, jnp.sqrt((30.0**2 + 13.0**2) / 36.0))
    mean = 20.5 - inner * of_inner[0] - outer * of_outer[0]
    variance = (15.0 / 6.0) ** 2 + inner**2 * of_inner[1] + outer**2 * of_outer[1]
    np.testing.assert_allclose([mean, jnp.sqrt(variance)], [12.7011139, 3.11272706], rtol=1e-8)
