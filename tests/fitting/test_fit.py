"""The fit: known parameters come back, methods agree, what the data cannot tell is said, bounds hold."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from traction_curves import mobil_curves, wrong_start
from traction_curves import mobil_scene as plain_scene

import fitting
import fitting.comparison
from fitting.io.oil_file import fitted_oil_text
from fitting.parameters import NAMES
from fitting.start import exponential_about
from fitting.viscous import held_misfit, with_viscous_function
from jaxbearing.lubricants import ProportionalRheology

ERRORS = fitting.Errors(relative=0.02, floor=2e-5)
SLOPES = [name for name in NAMES if "_" in name.removeprefix("shear_")]


def with_arrays(scene):
    """Every number an array: one structure of all scenes."""
    return jax.tree.map(lambda number: jnp.asarray(number, dtype=float), scene)


def mobil_scene():
    return with_arrays(plain_scene())


def wrong_scene():
    return with_arrays(wrong_start(plain_scene()))


def noisy(table, seed=0, noise=0.02):
    rng = np.random.default_rng(seed)
    factor = 1.0 + noise * rng.normal(size=len(table.slide_to_roll))
    return dataclasses.replace(table, traction_coefficient=table.traction_coefficient * factor)


def fitted(table, scene, **options):
    return fitting.fit(fitting.Measurements.of(table, scene), scene, fitting.FitOptions(errors=ERRORS, **options))


@pytest.fixture(scope="module", autouse=True)
def one_size():
    """Parts of the curves are padded to the size of all of them: the same programs."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fitting.search.SMALLEST_BATCH", 64)
        yield


@pytest.fixture(scope="module")
def curves():
    return mobil_curves()


def test_noise_free_curves_give_all_parameters_back(curves):
    """From a start that is 3 times wrong; asked: 1e-6."""
    true = mobil_scene().oil.rheology
    result = fitted(curves, wrong_scene())
    assert result.converged
    assert result.unidentifiable == ()
    for name in NAMES:
        np.testing.assert_allclose(result.parameters[name].value, float(getattr(true, name)), rtol=1e-8)
        np.testing.assert_allclose(float(getattr(result.oil.rheology, name)), result.parameters[name].value, rtol=1e-15)
        assert result.parameters[name].standard_error is None  # nothing tells the errors of exact curves
    assert result.notes == ()


@pytest.fixture(scope="module")
def noisy_fit(curves):
    return fitted(noisy(curves), wrong_scene())


def test_intervals_are_those_of_linear_theory(noisy_fit):
    """Against differences of the residual, with numpy alone: covariance, correlation, condition."""
    from scipy import stats

    data = noisy_fit.measurements
    state = data.state(noisy_fit.scene)
    deviation = noisy_fit.deviation

    @eqx.filter_jit
    def model(values):
        rheology = dataclasses.replace(noisy_fit.oil.rheology, **dict(zip(NAMES, values, strict=True)))
        oil = dataclasses.replace(noisy_fit.oil, rheology=rheology)
        return noisy_fit.scene.traction(state, oil).rolling / state.load

    values = np.array([noisy_fit.parameters[name].value for name in NAMES])
    columns = []
    for i, value in enumerate(values):
        step = np.eye(6)[i] * 1e-5 * value
        columns.append(np.asarray(model(values + step) - model(values - step)) / (2e-5 * value) / deviation)
    jacobian = np.stack(columns, axis=1)
    residual = (np.asarray(model(values)) - np.asarray(data.traction_coefficient)) / deviation
    scale = np.abs(values)
    inverse = np.linalg.inv((jacobian * scale).T @ (jacobian * scale)) * np.outer(scale, scale)
    covariance = np.sum(residual**2) / (len(residual) - 6) * inverse
    quantile = stats.t.ppf(0.975, len(residual) - 6)
    for i, name in enumerate(NAMES):
        parameter = noisy_fit.parameters[name]
        np.testing.assert_allclose(parameter.standard_error, np.sqrt(covariance[i, i]), rtol=1e-4)
        if name in ("shear_modulus", "stress"):
            half = quantile * parameter.standard_error / parameter.value
            np.testing.assert_allclose(np.log(parameter.upper / parameter.value), half, rtol=1e-10)
            np.testing.assert_allclose(np.log(parameter.value / parameter.lower), half, rtol=1e-10)
        else:
            np.testing.assert_allclose(
                parameter.upper - parameter.value, quantile * parameter.standard_error, rtol=1e-10
            )
    size = np.sqrt(np.diag(covariance))
    np.testing.assert_allclose(noisy_fit.correlation, covariance / np.outer(size, size), atol=1e-4)


def test_gradient_is_zero_at_the_fit(noisy_fit):
    """Steepest descent of the sum of squares by central differences in ln of each value."""
    data, state = noisy_fit.measurements, noisy_fit.measurements.state(noisy_fit.scene)

    @eqx.filter_jit
    def loss(factors):
        values = {n: noisy_fit.parameters[n].value * f for n, f in zip(NAMES, factors, strict=True)}
        oil = dataclasses.replace(noisy_fit.oil, rheology=dataclasses.replace(noisy_fit.oil.rheology, **values))
        predicted = noisy_fit.scene.traction(state, oil).rolling / state.load
        return 0.5 * (((predicted - data.traction_coefficient) / noisy_fit.deviation) ** 2).sum()

    at = float(loss(np.ones(6)))
    np.testing.assert_allclose(at, noisy_fit.loss, rtol=1e-10)
    for i in range(6):
        step = 1e-4 * np.eye(6)[i]
        up, down = float(loss(1 + step)), float(loss(1 - step))
        assert up > at < down
        # parabola through three points: its minimum is here
        assert abs(0.5 * (up - down) / (up + down - 2 * at)) < 2e-2


@pytest.mark.parametrize("method", ["bfgs", "gradient_descent"])
@pytest.mark.slow
def test_methods_reach_the_same_loss(curves, noisy_fit, method):
    """Asked: to 1e-6."""
    other = fitted(noisy(curves), wrong_scene(), method=method, starts=1)
    assert other.converged
    np.testing.assert_allclose(other.loss, noisy_fit.loss, rtol=1e-6)


def part(table, mask):
    """The points of a mask, curves numbered anew."""
    columns = ("slide_to_roll", "traction_coefficient", "pressure", "entrainment_speed", "temperature")
    numbers, curve = np.unique(table.curve[mask], return_inverse=True)
    names = tuple(table.curve_names[i] for i in numbers)
    shorter = {name: getattr(table, name)[mask] for name in columns}
    return dataclasses.replace(table, **shorter, curve=curve, curve_names=names)


@pytest.mark.parametrize(
    ("mask", "lost"),
    [
        (lambda t: t.temperature == 340.0, {"shear_modulus_temperature", "stress_temperature"}),
        (lambda t: t.pressure == 1.05e9, {"shear_modulus_pressure", "stress_pressure"}),
        (lambda t: t.temperature == 378.0, {*NAMES[:3], "stress_temperature"}),
    ],
    ids=["one temperature", "one pressure", "viscous"],
)
def test_what_the_data_cannot_tell_is_held_and_said(curves, mask, lost):
    scene = mobil_scene()
    result = fitted(part(noisy(curves), mask(curves)), scene)
    assert result.converged
    assert lost <= set(result.unidentifiable)
    for name in lost:
        parameter = result.parameters[name]
        assert parameter.fixed
        assert parameter.value == pytest.approx(float(getattr(scene.oil.rheology, name)), rel=1e-12)
        assert parameter.standard_error is parameter.lower is parameter.upper is None
    assert sum("cannot be determined" in note for note in result.notes) == len(result.unidentifiable)
    free = [name for name in NAMES if name not in result.unidentifiable]
    assert result.fitted == tuple(free)
    assert all(result.parameters[name].standard_error > 0 for name in free)


def test_insisting_fits_but_gives_no_interval(curves):
    only = curves.temperature == 340.0
    result = fitted(part(noisy(curves), only), mobil_scene(), free=("stress_temperature",))
    assert not result.parameters["stress_temperature"].fixed
    assert result.parameters["stress_temperature"].standard_error is None
    assert "stress_temperature" in result.unidentifiable


def test_fixed_and_bounded_parameters(curves):
    scene = wrong_scene()
    held = fitted(noisy(curves), scene, fixed=("stress_pressure",))
    assert held.parameters["stress_pressure"].value == pytest.approx(
        float(scene.oil.rheology.stress_pressure), rel=1e-12
    )
    assert held.parameters["stress_pressure"].fixed
    assert "stress_pressure" not in held.unidentifiable
    bounded = fitted(noisy(curves), scene, bounds={"shear_modulus_pressure": (None, 5e-9)})
    assert bounded.parameters["shear_modulus_pressure"].value == pytest.approx(5e-9, rel=1e-12)
    assert "at its bound" in bounded.parameters["shear_modulus_pressure"].reason
    assert bounded.loss > fitted(noisy(curves), scene).loss


@pytest.mark.slow
def test_robust_loss_shrugs_off_outliers(curves):
    true = mobil_scene().oil.rheology
    spoilt = noisy(curves)
    wrong = spoilt.traction_coefficient.copy()
    wrong[[3, 17, 31, 44]] *= (3.0, 0.2, 2.5, 3.0)
    spoilt = dataclasses.replace(spoilt, traction_coefficient=wrong)
    error = lambda r: abs(np.log(r.parameters["stress"].value / float(true.stress)))
    robust, plain = (fitted(spoilt, mobil_scene(), loss=loss) for loss in ("cauchy", "linear"))
    assert set(np.flatnonzero(robust.outlier)) >= {3, 17, 31, 44}
    assert error(robust) < 0.1
    assert error(plain) > 2.0 * error(robust)
    inside = robust.parameters["stress"]
    assert inside.lower < float(true.stress) < inside.upper
    # what is left out by the loss is no lack of fit either
    assert not any(note.startswith("Lack of fit") for note in robust.notes)


@pytest.mark.slow
def test_errors_of_the_slide_ratio_lower_the_weight_of_steep_points(curves):
    scene = mobil_scene()
    errors = fitting.Errors(relative=0.02, floor=2e-5, slide_to_roll=1e-3)
    data = fitting.Measurements.of(noisy(curves), scene)
    result = fitting.fit(data, scene, fitting.FitOptions(errors=errors))
    steep = np.asarray(data.slide_to_roll) < 3e-3
    plain = errors.deviation(np.asarray(data.traction_coefficient), np.asarray(data.curve))
    assert np.all(result.deviation[steep] > 1.5 * plain[steep])
    assert result.converged


@pytest.mark.slow
def test_lack_of_fit_is_said(curves):
    """Curves of an Eyring oil fitted with a limiting stress."""
    scene = mobil_scene()
    result = fitted(noisy(curves, noise=2e-3), scene, model="gecim_winer")
    assert any(note.startswith("Lack of fit") for note in result.notes)
    assert not any(note.startswith("Lack of fit") for note in fitted(noisy(curves), scene).notes)


def test_stress_held_at_the_numbers_of_another_viscous_function_is_said():
    scene, model = with_viscous_function(mobil_scene(), "gecim_winer")
    assert model == "gecim_winer"
    assert held_misfit(scene, NAMES) == ()
    (note,) = held_misfit(scene, NAMES[:4])
    assert note.startswith("alpha_tau, beta_tau held at the oil's own: contact.traction is gecim_winer")
    own, model = with_viscous_function(eqx.tree_at(lambda s: s.contact.traction.viscous, scene, None), None)
    assert model == own.contact.traction.viscous.name == "ree_eyring"
    assert held_misfit(own, ()) == ()


@pytest.mark.slow
def test_comparison_finds_the_model_that_made_the_curves(curves):
    scene = mobil_scene()
    data = fitting.Measurements.of(noisy(curves), scene)
    results = fitting.fit_models(data, scene, ("gecim_winer", "ree_eyring"), fitting.FitOptions(errors=ERRORS))
    best, other = fitting.compare(results)
    assert best.model == "ree_eyring"
    assert best.bic < other.bic - 10
    assert best.cross_validated_rms < 0.5 * other.cross_validated_rms
    # the points were not in the fit that predicts them
    assert best.cross_validated_rms > best.rms


@pytest.mark.parametrize(
    "options",
    [
        {"method": "newton"},
        {"loss": "huber"},
        {"model": "eyring"},
        {"fixed": ("G0",)},
        {"free": ("tau",)},
        {"bounds": {"beta": (0, 1)}},
        {"level": 1.0},
        {"starts": 0},
    ],
    ids=lambda o: next(iter(o)),
)
def test_options_that_make_no_sense(curves, options):
    scene = mobil_scene()
    with pytest.raises(ValueError, match=rf"^{next(iter(options))}: found"):
        fitting.fit(fitting.Measurements.of(curves, scene), scene, fitting.FitOptions(**options))


def test_scene_fills_what_the_file_does_not_hold(curves):
    scene = mobil_scene()
    with pytest.raises(fitting.MeasurementError, match=r"operation\.temperature"):
        fitting.Measurements.of(dataclasses.replace(curves, temperature=None), scene)
    with pytest.raises(fitting.MeasurementError, match=r"operation\.pressure"):
        fitting.Measurements.of(dataclasses.replace(curves, pressure=None), scene)
    one = scene.at_operation(temperature=[297.0], pressure=[1.5e9])
    data = fitting.Measurements.of(dataclasses.replace(curves, temperature=None, pressure=None), one)
    assert np.all(np.asarray(data.temperature) == 297.0)
    np.testing.assert_allclose(scene.hertz.hertz_pressure(data.load), 1.5e9, rtol=1e-9)


@pytest.mark.slow
def test_a_bound_that_does_not_bind_lets_go(curves):
    """The upper bound of alpha_G drives G0 up, far inside its own lower bound, below which the free fit lies."""
    scene, upper = mobil_scene(), {"shear_modulus_pressure": (None, 5.5e-9)}
    both = fitted(noisy(curves), scene, bounds={"shear_modulus": (5.5e4, None), **upper})
    one = fitted(noisy(curves), scene, bounds=upper)
    assert "at its bound" in both.parameters["shear_modulus_pressure"].reason
    np.testing.assert_allclose(both.loss, one.loss, rtol=1e-9)
    np.testing.assert_allclose(both.parameters["shear_modulus"].value, one.parameters["shear_modulus"].value, rtol=1e-5)
    assert both.parameters["shear_modulus"].lower > 5.5e4


def test_held_parameters_keep_within_their_bounds(curves):
    one = part(noisy(curves), (curves.temperature == 297.0) & (curves.pressure == 1.5e9))
    result = fitted(one, mobil_scene(), bounds={"shear_modulus_pressure": (7e-9, 9e-9)})
    assert result.parameters["shear_modulus_pressure"].value == pytest.approx(7e-9, rel=1e-12)


def test_as_many_points_as_parameters_give_no_interval(curves):
    few = np.flatnonzero((curves.temperature == 297.0) & (curves.pressure == 1.5e9))[[1, 8]]
    result = fitted(part(noisy(curves), np.isin(np.arange(60), few)), mobil_scene())
    assert result.fitted == ("shear_modulus", "stress")
    assert all(p.standard_error is p.lower is p.upper is None for p in result.parameters.values())
    assert not np.any(result.outlier)


def test_modulus_of_the_scene_far_off(curves):
    """With a modulus 100 times too high the data look viscous; they are not."""
    scene = mobil_scene()
    stiff = eqx.tree_at(lambda s: s.oil.rheology.shear_modulus, scene, 100.0 * scene.oil.rheology.shear_modulus)
    one = part(noisy(curves), (curves.temperature == 340.0) & (curves.pressure == 1.5e9))
    result = fitted(one, stiff)
    assert not result.parameters["shear_modulus"].fixed
    inside = result.parameters["stress"]
    assert inside.lower < float(scene.oil.rheology.stress) < inside.upper


def test_nothing_to_fit(curves):
    scene = mobil_scene()
    with pytest.raises(fitting.MeasurementError, match="found 0 at every point"):
        fitted(dataclasses.replace(curves, traction_coefficient=0.0 * curves.traction_coefficient), scene)
    with pytest.raises(fitting.MeasurementError, match="sign opposite"):
        fitted(dataclasses.replace(curves, traction_coefficient=-curves.traction_coefficient), scene)
    with pytest.raises(fitting.MeasurementError, match=r"traction_coefficient \[%\]"):
        fitted(dataclasses.replace(curves, traction_coefficient=100.0 * curves.traction_coefficient), scene)
    nothing = fitted(noisy(curves), scene, fixed=NAMES)
    assert not nothing.converged
    assert "cannot tell any parameter" in nothing.failure()
    assert nothing.status == "undetermined"
    assert "cannot tell its rheology" in fitted_oil_text(nothing, "oil", "curves.csv", "a scene")


def test_the_exponential_law_that_touches_another_one():
    """Of a modulus and a stress proportional to pressure alpha = 1/p, and they do not vary with temperature."""
    law = ProportionalRheology(stress_ratio=0.04, shear_modulus_ratio=0.3)
    touching = exponential_about(law, 0.9e9, 330.0)
    assert float(touching.stress_pressure) == pytest.approx(1.0 / 0.9e9, rel=2e-4)
    assert float(touching.stress_temperature) == 0.0
    for name in ("log_stress", "log_shear_modulus"):
        np.testing.assert_allclose(getattr(touching, name)(0.9e9, 300.0), getattr(law, name)(0.9e9, 300.0), rtol=1e-12)


@pytest.mark.slow
def test_another_law_of_the_oil_gives_first_values(noisy_fit, curves):
    """The curves tell the same law from them as from the true one, at every point."""
    law = ProportionalRheology(stress_ratio=0.04, shear_modulus_ratio=0.3)
    found = fitted(noisy(curves), eqx.tree_at(lambda s: s.oil.rheology, mobil_scene(), law))
    assert found.converged
    assert found.fitted == noisy_fit.fitted
    np.testing.assert_allclose(found.predicted, noisy_fit.predicted, rtol=1e-4)
    assert any("touches the law of the scene's oil" in note for note in found.notes)
    text = fitted_oil_text(found, "oil", "curves.csv", "a scene")
    assert 'reference_temperature = "the middle of curves.csv"' in text


def test_modulus_shows_at_one_temperature_only(curves):
    """At 378 K the curves are viscous: they say nothing of the modulus, and 297 K alone says nothing of beta_G."""
    two = (curves.pressure == 1.5e9) & (curves.temperature != 340.0)
    result = fitted(part(noisy(curves), two), mobil_scene())
    assert {"shear_modulus_pressure", "shear_modulus_temperature", "stress_pressure"} == set(result.unidentifiable)
    assert "where the shear modulus shows" in result.parameters["shear_modulus_temperature"].reason
    assert result.parameters["stress_temperature"].standard_error > 0


@pytest.mark.slow
def test_a_bound_far_from_the_curves_gives_no_result_or_a_good_one(curves):
    """A stress of at least 6 times the true one: the search must not end on the plateau where nothing is sheared."""
    result = fitted(noisy(curves), mobil_scene(), bounds={"stress": (1e6, 2e7)})
    if result.converged:
        assert result.rms < 0.3 * np.sqrt(np.mean(np.square(curves.traction_coefficient)))
    scene = eqx.tree_at(lambda s: s.oil.rheology.stress, mobil_scene(), np.float64(1e6))
    held = fitted(noisy(curves), scene, fixed=("stress", "stress_temperature"))
    assert held.converged
    assert any("is not that of an oil" in note for note in held.notes)


def test_what_the_others_cannot_predict_is_not_cross_validated(curves):
    """Two curves at two temperatures: without one of them the temperature coefficients are unknown."""
    two = part(noisy(curves), (curves.pressure == 1.5e9) & (curves.temperature < 350.0))
    assert fitting.comparison.cross_validated_rms(fitted(two, mobil_scene())) is None
