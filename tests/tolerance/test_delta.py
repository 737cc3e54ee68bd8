"""The delta method: closed forms, the check row of the sheet on the operating state, a million samples of the seats."""

import jax
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing import Distribution
from jaxbearing.mounting.rectified import rectified_normal
from jaxbearing.numerics.precision import as_float
from jaxbearing.tolerance.scatter import scatter_of

UM = 1e-6
CLEARANCE = {"geometry.diametral_clearance": Distribution.between(13 * UM, 28 * UM)}


def test_check_row_of_the_sheet(mounted, spread_fits):
    """Clearance 13 to 28 um, k5, J7, smoothing 2 um. The sheet takes the raceways of 12 um, not of 20.5: 1e-4."""
    found, notes = spread_fits(scatter_of(mounted, CLEARANCE))
    spread = found["fit.clearance"]
    np.testing.assert_allclose(spread.mean / UM, 12.7011139, rtol=2e-4)
    np.testing.assert_allclose(spread.deviation / UM, 3.11272706, rtol=2e-4)
    np.testing.assert_allclose([spread.worst_low / UM, spread.worst_high / UM], [-10.3251553, 28.0], rtol=2e-4)
    # without a rectified seat: 20.5 - .8181 (11.5 - 2), and the variances of clearance and shaft alone
    np.testing.assert_allclose(spread.value / UM, 12.7277673, rtol=2e-4)
    deviations = {"geometry.diametral_clearance": 2.5, "fits.shaft_interference": np.hypot(9.0, 10.0) / 6.0}
    plain = np.hypot(*(spread.derivatives[path] * one for path, one in deviations.items()))
    np.testing.assert_allclose(plain, 3.10085055, rtol=2e-4)
    np.testing.assert_allclose(sum(spread.contributions.values()), 1.0, rtol=1e-12)
    assert any("outer ring may be loose in the housing" in text and "98 %" in text for text in notes)
    # 8.5 um below it are the raceways of the sheet
    spread = spread_fits(scatter_of(mounted, {"geometry.diametral_clearance": Distribution(12 * UM, 2.5 * UM)}))[0]
    np.testing.assert_allclose(spread["fit.clearance"].mean / UM, 12.7011139 - 8.5, rtol=1e-8)
    np.testing.assert_allclose(spread["fit.clearance"].deviation / UM, 3.11272706, rtol=3e-4)


def test_seats_alone_against_closed_forms(mounted, spread_fits):
    """Same material and solid shaft: the raceway grows by bore over raceway of what is pressed, exactly."""
    scatter = scatter_of(mounted)
    spread = spread_fits(scatter)[0]["fit.clearance"]
    raceway, _ = (float(one) for one in mounted.raceway_diameters)
    inner = 0.025 / raceway
    pressed = {"fits.housing_interference": 10 * UM, "fits.shaft_interference": 0.0}
    outer = (12 * UM - float(_clearance(scatter.scene.replace(pressed)))) / (8 * UM)
    of_inner = rectified_normal(9.5 * UM, np.hypot(9.0, 10.0) / 6.0 * UM)
    of_outer = rectified_normal(-11.5 * UM, np.hypot(30.0, 13.0) / 6.0 * UM)
    mean = 12 * UM - inner * of_inner[0] - outer * of_outer[0]
    parts = {"fits.shaft_interference": inner**2 * of_inner[1], "fits.housing_interference": outer**2 * of_outer[1]}
    np.testing.assert_allclose(spread.mean, mean, rtol=1e-9)
    np.testing.assert_allclose(spread.deviation, np.sqrt(sum(parts.values())), rtol=1e-7)
    for path, part in parts.items():
        np.testing.assert_allclose(spread.contributions[path], part / sum(parts.values()), rtol=1e-6)


def _clearance(scene):
    from jaxbearing.bearings.mounted import running_scene

    return running_scene(jax.tree.map(as_float, scene))[1].clearance


def test_tight_seats_are_a_sum_of_variances(mounted, spread_fits):
    tight = mounted.replace(
        {"fits.shaft_tolerance": None, "fits.housing_tolerance": None, "fits.smoothing": 0.0}
        | {"fits.shaft_interference": 30 * UM, "fits.housing_interference": 40 * UM}
    )
    fields = {"fits.shaft_interference": Distribution(30 * UM, 1 * UM), **CLEARANCE}
    fields["fits.housing_interference"] = Distribution(40 * UM, 2 * UM, "uniform")
    found, notes = spread_fits(scatter_of(tight, fields))
    spread = found["fit.clearance"]
    variance = sum((spread.derivatives[path] * one.deviation) ** 2 for path, one in fields.items())
    np.testing.assert_allclose(spread.deviation, np.sqrt(variance), rtol=1e-12)
    np.testing.assert_allclose(spread.mean, spread.value, rtol=1e-14)
    assert not notes
    # affine: the worst cases are at the ends of the straight line
    ends = np.hypot(3.0, 0.0) * UM * abs(spread.derivatives["fits.shaft_interference"])
    ends += np.sqrt(3.0) * 2 * UM * abs(spread.derivatives["fits.housing_interference"])
    ends += 7.5 * UM * spread.derivatives["geometry.diametral_clearance"]
    np.testing.assert_allclose(
        [spread.worst_low, spread.worst_high], [spread.value - ends, spread.value + ends], rtol=1e-4
    )


WARM = {
    "temperatures.inner_ring": Distribution(353.15, 3.0),
    "temperatures.outer_ring": Distribution(343.15, 3.0),
    **CLEARANCE,
}


@pytest.mark.parametrize("smoothing", [None, 2 * UM])
def test_temperatures_that_hold_a_seat_against_samples(spread_fits, sample_fits, smoothing):
    """The outer ring is warmer than the housing: its seat is tight in about half of the bearings."""
    scene = jb.load_scene("deep_groove_6205_fitted", {"temperatures.elements": "none"})
    scatter = scatter_of(scene.replace({"fits.smoothing": smoothing}), WARM)
    spread = spread_fits(scatter)[0]["fit.clearance"]
    values = sample_fits(scatter, 400_000, 1)
    error = values.std() / np.sqrt(values.size)
    # the default smoothing is a plateau of the interference, and temperatures scatter beside it: 1 % of the deviation
    np.testing.assert_allclose(spread.mean, values.mean(), atol=4 * error if smoothing else 0.01 * values.std())
    np.testing.assert_allclose(spread.deviation, values.std(), rtol=4e-3 if smoothing else 0.01)


def test_angle_without_clearance_is_said(mounted, spread_fits):
    """The contact angle of a preloaded deep groove bearing is 0 and has no slope; in other bearings it is not 0."""
    small = {"geometry.diametral_clearance": Distribution(5 * UM, 2 * UM)}
    found, notes = spread_fits(scatter_of(mounted, small), ("fit.contact_angle", "fit.clearance"))
    angle = found["fit.contact_angle"]
    assert found["fit.clearance"].value < 0.0
    assert (angle.value, angle.deviation, angle.worst_low) == (0.0, 0.0, 0.0)
    assert angle.worst_high > 0.1
    assert any("not linear" in text and "fit.contact_angle (100 %)" in text for text in notes)
    np.testing.assert_allclose(found["fit.clearance"].below_zero, 0.8, atol=0.15)
