"""Calibration: known fields come back, intervals are those of linear theory and hold, what cannot be told is said."""

import dataclasses
import io

import numpy as np
import pytest
from rich.console import Console
from scipy import stats

import jaxbearing as jb
from fitting.uncertainty import spread
from jaxbearing.calibration import Data, Options, next_points, repeated
from jaxbearing.calibration.labels import look_at
from jaxbearing.calibration.parameters import FreeField
from jaxbearing.calibration.report import print_calibration
from jaxbearing.calibration.table import read_data
from jaxbearing.calibration.words import why_undetermined
from jaxbearing.sweeps.fields import SceneSource
from jaxbearing.tolerance.results import _at, labels_of, paths_of

CLEARANCE, MODULUS = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
FREE = [CLEARANCE, MODULUS]
TRUTH = {CLEARANCE: 14e-6, MODULUS: 190e9}
LOADS = np.linspace(5e3, 40e3, 10)
NOISE = 0.003
ROLLERS, DENSITY = "materials.rollers.youngs_modulus", "materials.rings.density"
pytestmark = pytest.mark.usefixtures("one_program")


@pytest.fixture(scope="module")
def fields_of_the_module():
    return (*FREE, ROLLERS, DENSITY)


def measured(values, **more):
    return {"conditions": {"operation.radial_load": LOADS}, "measured": {"ring.radial": values}, **more}


def displacement(scene):
    return float(jb.solve(scene).ring.radial)


@pytest.fixture(scope="module")
def bearing():
    """Dry cylindrical rollers: the smallest program."""
    return jb.load_scene("reference_roller", {"contact": "none"}).replace({CLEARANCE: 12e-6})


@pytest.fixture(scope="module")
def displacements(bearing):
    """Radial displacements of the true bearing without errors."""
    return np.array([displacement(bearing.replace(TRUTH).at_operation(radial_load=load)) for load in LOADS])


@pytest.fixture(scope="module")
def noisy(displacements):
    return displacements * (1.0 + NOISE * np.random.default_rng(1).normal(size=len(LOADS)))


@pytest.fixture(scope="module")
def calibrated(bearing, noisy):
    return jb.calibrate(bearing, measured(noisy), FREE)


def test_exact_measurements_give_the_fields_back(bearing, displacements):
    found = jb.calibrate(bearing, measured(displacements), FREE)
    assert found.converged
    assert found.fitted == tuple(FREE)
    for path, value in TRUTH.items():
        np.testing.assert_allclose(found[path].value, value, rtol=1e-7)
    np.testing.assert_allclose(found.predicted, displacements, rtol=1e-9)
    for path, value in TRUTH.items():
        at = found.scenes[0]
        for name in path.split("."):
            at = getattr(at, name)
        np.testing.assert_allclose(float(at), value, rtol=1e-7)


def test_values_that_are_met_exactly_leave_an_interval_of_round_off(bearing):
    """By the first values of the search already: the variance was 0, and was divided by."""
    exact = [displacement(bearing.at_operation(radial_load=load)) for load in LOADS[:2]]
    data = {"conditions": {"operation.radial_load": LOADS[:2]}, "measured": {"ring.radial": exact}}
    found = jb.calibrate(bearing, data, [MODULUS])[MODULUS]
    ends = [found.value, found.lower, found.upper]
    np.testing.assert_allclose(ends, bearing.materials.rings.youngs_modulus, rtol=1e-9)


def of_coordinates(coordinates):
    """A clearance of either sign is searched as it is, over its start; a modulus as its logarithm."""
    return {CLEARANCE: 12e-6 * coordinates[0], MODULUS: np.exp(coordinates[1])}


def coordinates_of(found):
    return np.array([found[CLEARANCE].value / 12e-6, np.log(found[MODULUS].value)])


def test_intervals_are_those_of_linear_theory(bearing, calibrated, noisy):
    """Against central differences of solves, with numpy alone."""
    deviation = calibrated.deviation

    def residual(coordinates):
        scene = bearing.replace(of_coordinates(coordinates))
        at = [displacement(scene.at_operation(radial_load=load)) for load in LOADS]
        return (np.array(at) - noisy) / deviation

    end = coordinates_of(calibrated)
    columns = [(residual(end + step) - residual(end - step)) / 2e-4 for step in 1e-4 * np.eye(2)]
    jacobian = np.stack(columns, axis=1)
    left = residual(end)
    # the gradient vanishes: residual and columns are at right angles
    cosines = jacobian.T @ left / np.linalg.norm(jacobian, axis=0) / np.linalg.norm(left)
    np.testing.assert_allclose(cosines, 0.0, atol=1e-5)
    covariance = left @ left / (len(LOADS) - 2) * np.linalg.inv(jacobian.T @ jacobian)
    np.testing.assert_allclose(calibrated.covariance, covariance, rtol=1e-4)
    half = stats.t.ppf(0.975, len(LOADS) - 2) * np.sqrt(np.diag(covariance))
    low, high = of_coordinates(end - half), of_coordinates(end + half)
    for path in FREE:
        ends = [calibrated[path].lower, calibrated[path].upper]
        np.testing.assert_allclose(ends, [low[path], high[path]], rtol=1e-5)


@pytest.mark.slow
def test_intervals_hold_the_truth(calibrated, displacements):
    """200 repetitions at once; asked: 91 to 99 % of the 95 % intervals."""
    errors = np.random.default_rng(20261127).normal(size=(200, len(LOADS)))
    found = repeated(calibrated, displacements * (1.0 + NOISE * errors))
    assert np.all(found.converged)
    covered = found.covered(np.array([TRUTH[path] for path in FREE]))
    assert np.all((covered >= 0.91) & (covered <= 0.99)), covered


def test_the_order_of_the_fields_does_not_matter(bearing, calibrated, noisy):
    other = jb.calibrate(bearing, measured(noisy), FREE[::-1])
    for path in FREE:
        np.testing.assert_allclose(other[path][:4], calibrated[path][:4], rtol=1e-7)


def test_what_is_told_together_only_is_said(bearing, calibrated, noisy):
    found = jb.calibrate(bearing, measured(noisy), [*FREE, ROLLERS])
    assert found.fitted == tuple(FREE)
    held = found[ROLLERS]
    assert held.fixed
    assert "only the product materials.rings.youngs_modulus" in held.reason
    assert held.lower is None
    # the rest is as without it
    for path in FREE:
        np.testing.assert_allclose(found[path][:4], calibrated[path][:4], rtol=1e-6)


@pytest.mark.slow
def test_what_no_value_shows_is_said(bearing, noisy):
    found = jb.calibrate(bearing, measured(noisy), [MODULUS, DENSITY])
    assert found.fitted == (MODULUS,)
    assert found[DENSITY].reason == "no measured value changes with it"
    nothing = jb.calibrate(bearing, measured(noisy), [DENSITY])
    assert not nothing.converged
    assert "cannot tell any field" in nothing.failure()


def test_a_prior_counts_as_a_measurement_of_the_field(bearing, calibrated, noisy):
    """In logarithms: precisions add up, and the mean is the weighted one, to first order of a nearly linear problem."""
    width = 0.004
    prior = jb.Distribution.lognormal(191e9, width)
    options = Options(relative_error=calibrated.scale * 0.02, known_errors=True)
    alone = jb.calibrate(bearing, measured(noisy), FREE, options=options)
    found = jb.calibrate(bearing, measured(noisy), FREE, options=options, priors={MODULUS: prior})
    variance = alone.covariance[1, 1]
    precision = 1.0 / variance + 1.0 / width**2
    expected = (np.log(alone[MODULUS].value) / variance + np.log(191e9) / width**2) / precision
    np.testing.assert_allclose(found.covariance[1, 1], 1.0 / precision, rtol=1e-2)
    np.testing.assert_allclose(np.log(found[MODULUS].value), expected, atol=0.02 * width)


def test_a_prior_tells_what_the_values_do_not(bearing, noisy, calibrated):
    priors = {ROLLERS: jb.Distribution.lognormal(208e9, 0.01)}
    found = jb.calibrate(bearing, measured(noisy), [*FREE, ROLLERS], priors=priors)
    assert found.fitted == (*FREE, ROLLERS)
    assert any("comes from its prior" in note for note in found.notes)
    assert found[MODULUS].standard_error > 1.5 * calibrated[MODULUS].standard_error


def test_bounds_hold_and_let_go(bearing, noisy, calibrated):
    found = jb.calibrate(bearing, measured(noisy), FREE, bounds={MODULUS: (None, 185e9)})
    np.testing.assert_allclose(found[MODULUS].value, 185e9, rtol=1e-12)
    assert found[MODULUS].reason.startswith("at its bound 185")
    wide = jb.calibrate(bearing, measured(noisy), FREE, bounds={MODULUS: (150e9, 300e9)})
    np.testing.assert_allclose(wide[MODULUS].value, calibrated[MODULUS].value, rtol=1e-7)


def test_a_robust_loss_shrugs_off_an_outlier(bearing, noisy):
    spoilt = noisy.copy()
    spoilt[0] *= 1.1
    plain = jb.calibrate(bearing, measured(spoilt), FREE)
    robust = jb.calibrate(bearing, measured(spoilt), FREE, options=Options(loss="cauchy"))
    error = lambda found: abs(found[CLEARANCE].value / TRUTH[CLEARANCE] - 1.0)
    assert robust.converged
    assert error(robust) < 0.1 * error(plain)


def test_two_rigs_share_a_field(bearing, noisy):
    """What one rig tells hardly, two of different size tell together: the values of both are met by one clearance."""
    more = bearing.replace({"geometry.roller_diameter": 0.9 * bearing.geometry.roller_diameter})
    others = [displacement(more.replace(TRUTH).at_operation(radial_load=load)) for load in LOADS]
    rigs = [measured(noisy), measured(np.array(others))]
    both = jb.calibrate([bearing, more], rigs, FREE)
    assert {one.rig for one in both.misfits} == {0, 1}
    assert len(both.measured) == 2 * len(LOADS)
    for path in FREE:
        assert both[path].lower < TRUTH[path] < both[path].upper


def test_values_that_are_held_back_are_predicted(bearing, noisy):
    held = np.arange(len(LOADS)) % 3 == 0
    found = jb.calibrate(bearing, measured(noisy, held_back=held), FREE)
    np.testing.assert_array_equal(np.flatnonzero(held), found.held_back.place)
    assert found.misfits[0].points == np.sum(~held)
    assert found.held_back.relative < 3.0 * NOISE
    assert np.all(found.held_back.deviation > found.scale * found.deviation[held])
    fewer = jb.calibrate(
        bearing,
        {"conditions": {"operation.radial_load": LOADS[~held]}, "measured": {"ring.radial": noisy[~held]}},
        FREE,
        options=Options(),
    )
    for path in FREE:
        np.testing.assert_allclose(found[path].value, fewer[path].value, rtol=2e-4)


def test_folds_predict_each_part_from_the_others(bearing, noisy, calibrated):
    found = jb.calibrate(bearing, measured(noisy), FREE, folds=5)
    assert found.held_back.converged
    assert len(found.held_back.place) == len(LOADS)
    # the points were not in the fit that predicts them
    rms = np.sqrt(np.mean(np.square(found.held_back.predicted - found.held_back.measured)))
    assert rms > calibrated.misfits[0].rms


def test_the_next_point_tells_what_is_promised(bearing, noisy, calibrated):
    """Information and standard errors against the inverse of the normal matrix with one more row."""
    candidates = {"operation.radial_load": [1e3, 10e3, 80e3]}
    ranked = next_points(calibrated, candidates)
    assert [one.information for one in ranked] == sorted((one.information for one in ranked), reverse=True)
    end = coordinates_of(calibrated)
    for one in ranked:
        at = lambda where, one=one: displacement(bearing.replace({**of_coordinates(where), **one.conditions}))
        row = np.array([(at(end + step) - at(end - step)) / 2e-4 for step in 1e-4 * np.eye(2)])
        size = calibrated.scale * 0.02 * np.hypot(at(end), 0.2 * np.max(noisy))
        before = np.linalg.inv(calibrated.covariance)
        after = before + np.outer(row, row) / size**2
        told = np.linalg.slogdet(after)[1] - np.linalg.slogdet(before)[1]
        np.testing.assert_allclose(one.information, told, rtol=1e-4)
        errors = np.sqrt(np.diag(np.linalg.inv(after))) * [12e-6, calibrated[MODULUS].value]
        np.testing.assert_allclose([one.standard_errors[path] for path in FREE], errors, rtol=1e-4)


def test_weights_and_known_deviations(bearing, noisy):
    """Deviations that are given and known give intervals without a look at the differences."""
    deviations = {"ring.radial": np.full(len(LOADS), 1e-7)}
    known = jb.calibrate(bearing, measured(noisy, deviations=deviations), FREE, options=Options(known_errors=True))
    twice = jb.calibrate(
        bearing,
        measured(noisy, deviations={"ring.radial": np.full(len(LOADS), 2e-7)}),
        FREE,
        options=Options(known_errors=True),
    )
    np.testing.assert_allclose(twice.covariance, 4.0 * known.covariance, rtol=1e-4)
    assert not any("not in the data" in note for note in known.notes)
    half = np.log(known[MODULUS].upper / known[MODULUS].value)
    np.testing.assert_allclose(half, stats.norm.ppf(0.975) * np.sqrt(known.covariance[1, 1]), rtol=1e-9)


@pytest.mark.parametrize(
    ("free", "more", "said"),
    [
        ([], {}, "free: found no field"),
        ([MODULUS, MODULUS], {}, "twice"),
        (["geometry.n_rollers"], {}, "shapes the equations"),
        ([MODULUS], {"priors": {CLEARANCE: jb.Distribution(1e-5, 1e-6)}}, "prior: found 'geometry"),
        ([MODULUS], {"bounds": {MODULUS: (2e11, 1e11)}}, "expected the lower one first"),
        ([CLEARANCE], {"priors": {CLEARANCE: jb.Distribution(1e-5, 0.0)}}, "prior: found the deviation 0 for geometry"),
        ([MODULUS], {"priors": {MODULUS: jb.Distribution.lognormal(2e11, 1e-200)}}, "which is known then"),
        (["operation.radial_load"], {}, "an operating point of data"),
        ([MODULUS], {"folds": 1}, "folds: found 1"),
        ([MODULUS], {"options": Options(loss="huber")}, "loss: found 'huber'"),
    ],
)
def test_what_makes_no_sense_is_refused(bearing, noisy, free, more, said):
    with pytest.raises(ValueError, match=said):
        jb.calibrate(bearing, measured(noisy), free, **more)


def test_fields_that_no_value_tells_have_the_right_reason(bearing, noisy):
    """Six values of which none changes are not fewer than one field; one value tells one field, without an interval
    unless its error is known."""
    few = {"conditions": {"operation.radial_load": LOADS[:6]}, "measured": {"ring.radial": noisy[:6]}}
    found = jb.calibrate(bearing, few, [DENSITY])
    assert (found.status, found.converged) == ("undetermined", False)
    assert found[DENSITY].reason == "no measured value changes with it"
    one = {"conditions": {"operation.radial_load": LOADS[:1]}, "measured": {"ring.radial": noisy[:1]}}
    found = jb.calibrate(bearing, one, [CLEARANCE])
    assert found.converged
    assert (found[CLEARANCE].fixed, found[CLEARANCE].lower) == (False, None)
    shown = Console(width=120, file=io.StringIO())
    print_calibration(found, "a bearing", [], (), None, {}, shown)
    assert "no interval: as many fields as measured values" in " ".join(shown.file.getvalue().split())
    assert "held" not in shown.file.getvalue()
    found = jb.calibrate(bearing, one, [CLEARANCE], options=Options(known_errors=True))
    assert found[CLEARANCE].lower < found[CLEARANCE].value < found[CLEARANCE].upper
    assert not any("No intervals" in note for note in found.notes)
    assert "The errors of ring.radial are not in the data; as known ones 2 % of the value are taken." in found.notes
    found = jb.calibrate(bearing, one, FREE)
    assert "a combination of" in found[MODULUS].reason
    with pytest.raises(ValueError, match="held_back: found every measured value"):
        jb.calibrate(bearing, measured(noisy, held_back=np.ones(len(LOADS), dtype=bool)), FREE)


def test_an_interval_that_says_nothing_is_none():
    """Of a speed of either sign, 9099 +- 454 294 rpm. A field with a prior does not hide it, a start of 0 is no
    measure, and what is uncertain by its own size is told."""
    speed = FreeField("operation.inner_speed", "rad/s", 9000.0, False, 9000.0)
    known = FreeField("drag.coefficient", "1", 0.3, True, 0.3, prior=jb.Distribution.lognormal(0.3, 1.5))
    clearance = FreeField(CLEARANCE, "m", 1e-6, False, 1e-6)
    fields, free = [speed, known, clearance], np.ones(3, dtype=bool)
    jacobian = np.random.default_rng(0).normal(size=(12, 3)) / [50.0, 30.0, 1.5]
    found = spread(jacobian, free, 1.0, 0.95)
    coordinates = np.array([0.011, 0.0, 14.0])
    index, why = why_undetermined(found, jacobian, free, fields, coordinates)
    assert index == 0
    times = found.quantile * np.sqrt(found.covariance[0, 0])
    assert why == f"it is uncertain by {times:.3g} times its start to either side"
    for start in (0.0, 9000.0 * times):
        fields[0] = dataclasses.replace(speed, start=start)
        assert why_undetermined(found, jacobian, free, fields, coordinates) is None
    # rows that the other fields alone would leave out: fewer than fields, and the counts are those of the values
    jacobian[2:] = 0.0
    jacobian[:2, 2] = 0.0
    found = spread(jacobian, free, 1.0, 0.95)
    assert why_undetermined(found, jacobian, free, fields, coordinates) == (2, "no measured value changes with it")


@pytest.mark.parametrize(
    "name",
    ["deep_groove_6205", *(pytest.param(one, marks=pytest.mark.slow) for one in ("turbine_roller", "gear_shaft"))],
)
def test_every_result_is_a_column(name, tmp_path):
    """Of a list or a matrix each entry; with the unit of the label, and with or without a dot in the name."""
    scene, units = jb.load_scene(name), {}

    def look(solution):
        for path in paths_of(solution):
            value = _at(solution, path)
            if hasattr(value, "dtype") and np.issubdtype(value.dtype, np.inexact) and value.size:
                entry = path + "[0]" * value.ndim
                units[entry] = labels_of(solution, [entry])[entry].unit

    look_at(scene, look, None)
    heads = (entry if unit in ("1", "") else f"{entry} [{unit}]" for entry, unit in units.items())
    file = tmp_path / "all.csv"
    file.write_text(f"{';'.join(heads)};remark\n{';'.join('1' for _ in units)};7\n", encoding="utf-8")
    data, notes = read_data(file, SceneSource.of(name), scene)
    # the operating point stands among the results, too
    assert [*data.measured] == [entry for entry in units if entry not in data.conditions]
    assert len(data.conditions) < 0.2 * len(units)
    assert notes == [f"column 'remark' of {file} is ignored"]
    plain = {"gear_shaft": set(), "deep_groove_6205": {"force[0]", "stiffness[0][0]"}}
    assert plain.get(name, {"drive_power", "inner_torque", "outer_torque"}) <= {one for one in units if "." not in one}


def test_data_that_do_not_fit(bearing, noisy):
    with pytest.raises(ValueError, match=r"ring\.radiel"):
        jb.calibrate(bearing, {"measured": {"ring.radiel": noisy}}, [MODULUS])
    with pytest.raises(ValueError, match="found the shape"):
        Data({"operation.radial_load": LOADS[:3]}, {"ring.radial": noisy})
    with pytest.raises(ValueError, match="not positive"):
        Data({}, {"ring.radial": noisy}, {"ring.radial": 0.0 * noisy})
    with pytest.raises(AttributeError):
        jb.calibrate(bearing, measured(noisy), ["geometry.pitch"])


def test_a_point_without_a_solution_is_a_failure(bearing, noisy):
    crushed = dataclasses.replace(Data.of(measured(noisy)), conditions={"operation.radial_load": 1e196 * LOADS})
    with pytest.raises(jb.SolveError):
        jb.calibrate(bearing, crushed, [MODULUS])
