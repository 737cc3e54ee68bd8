"""A fit on the screen, as JSON and as a picture; options as they are typed."""

import dataclasses
import io
import json
import re

import numpy as np
import pytest
from fit_results import HELD, SWEEPS, made_up
from matplotlib.colors import to_hex
from pictures import outside, overlapping
from rich.console import Console

import jaxbearing as jb
from fitting import Measurements, Parameter
from fitting.comparison import ModelRow
from fitting.io import typed
from fitting.io.json_report import fit_to_dict
from fitting.io.plots import plot_fit
from fitting.io.smooth import POINTS, SmoothCurve, _abscissae, smooth_curves
from fitting.io.summary import print_comparison, print_fit
from fitting.io.words import parameter_text
from fitting.parameters import NAMES
from fitting.result import CurveFit
from jaxbearing.report.backends.matplotlib.page import Page
from jaxbearing.scenes.errors import SceneError

ROWS = [
    ModelRow("ree_eyring", True, 0.005, 2, 70.0, 71.5, 0.006),
    ModelRow("bair_winer", True, 0.006, 2, 80.0, 81.5, None),
    ModelRow("gecim_winer", False, 0.123, 2, 60.0, 61.5, None),
]


def replaced(result, **changes):
    """A result with other fields, whose arrays need not fit together."""
    return dataclasses.replace(result, **changes)


def printed(result, width=80, notes=("Column 'count' is ignored.",)):
    buffer = io.StringIO()
    print_fit(result, "curves.csv", "two_disk_etm", notes, Console(file=buffer, width=width))
    return buffer.getvalue()


def test_parameters_on_the_screen():
    text = printed(made_up())
    row = lambda symbol: next(line.split() for line in text.splitlines() if line.split()[:1] == [symbol])
    assert row("G0") == ["G0", "33.3", "kPa", "3.7", "26.7", "to", "41.7"]
    assert row("alpha_G") == ["alpha_G", "6.110", "1/GPa", "held:", "one", "pressure", "only"]
    assert row("beta_tau") == ["beta_tau", "-786.0", "K", "held:", "as", "asked"]
    assert row("alpha_tau")[:5] == ["alpha_tau", "0.6667", "1/GPa", "no", "interval:"]
    assert "95 % interval" in text


def test_no_interval_for_what_the_data_cannot_tell():
    assert re.findall(r"[\d.]+ to [\d.]+", printed(made_up())) == ["26.7 to 41.7", "4.29 to 6.70"]


@pytest.mark.parametrize("width", [60, 80, 100, 140])
def test_lines_fit_the_terminal_and_numbers_are_whole(width):
    result = made_up(file=SWEEPS)
    text = printed(result, width)
    assert max(map(len, text.splitlines())) <= width
    if width >= 80:
        assert text.count("0.00660") == len(result.curves)
        assert text.count("5e+07") == len(result.curves)
    for name in NAMES:
        assert name in text


def test_long_names_of_curves_are_cut_and_numbers_are_not():
    curves = tuple(CurveFit("n" * 90, 1234, 3.6e9, 0.025, 313.15, 5e7, 0.0066) for _ in range(50))
    text = printed(replaced(made_up(), curves=curves))
    assert max(map(len, text.splitlines())) <= 80
    assert text.count("0.00660") == 40
    assert "and 10 curves more" in text


def test_correlation_and_notes_on_the_screen():
    text = printed(made_up())
    assert "tau0 and G0" not in text
    assert "G0 and tau0 (-0.970)" in text
    assert "- Lack of fit: neighbouring residuals are alike." in text
    assert "- Column 'count' is ignored." in text
    assert text.index("Lack of fit") < text.index("'count'")
    unknown = replaced(made_up(), correlation=np.full((3, 3), np.nan))
    assert "unknown" in printed(unknown)
    assert "nan" not in printed(unknown)
    one = replaced(made_up(), fitted=("stress",), correlation=np.ones((1, 1)))
    assert "Correlation" not in printed(one)


def test_no_result_of_a_fit_that_failed():
    text = printed(made_up(converged=False))
    assert "NOT CONVERGED" in text
    assert "36 steps" in text
    for words in ("kPa", "Parameters", "0.00662", "interval"):
        assert words not in text


def test_comparison_on_the_screen():
    buffer = io.StringIO()
    print_comparison(ROWS, Console(file=buffer, width=100))
    lines = [line.split() for line in buffer.getvalue().splitlines()]
    assert ["ree_eyring", "2", "0.00500", "71.5", "0.0", "70.0", "0.00600"] in lines
    assert ["bair_winer", "2", "0.00600", "81.5", "10.0", "80.0", "-"] in lines
    assert "0.123" not in buffer.getvalue()


TEXTS = [
    # value, error, lower, upper; texts of value, error, interval; unit
    ("stress", (5.0e6, 0.123e6, 4.8e6, 5.2e6), ("5.00", "0.12", "4.80 to 5.20", "MPa")),
    ("stress", (5.0e6, 1e-12, 5.0e6, 5.0e6), ("5.000000", "1.0e-18", "5.000000 to 5.000000", "MPa")),
    ("stress", (5.0e6, 0.0, 5.0e6, 5.0e6), ("5.000000", "0", "5.000000 to 5.000000", "MPa")),
    ("shear_modulus", (1e-9, 1e-10, 0.8e-9, 1.2e-9), ("1.000e-09", "1.0e-10", "8.000e-10 to 1.200e-09", "Pa")),
    ("shear_modulus", (3e10, 1e10, 1e10, 8e10), ("30", "10", "10 to 80", "GPa")),
    ("stress_pressure", (2.4e-9, 3e-11, 2.3e-9, 2.5e-9), ("2.400", "0.030", "2.300 to 2.500", "1/GPa")),
    ("stress_temperature", (-786.0, 12.3, -810.0, -762.0), ("-786", "12", "-810 to -762", "K")),
    ("stress_temperature", (0.0, 12.3, -24.0, 24.0), ("0", "12", "-24.00 to 24.00", "K")),
    ("stress_temperature", (-786.0, None, None, None), ("-786.0", "", "", "K")),
]


@pytest.mark.parametrize(("name", "numbers", "texts"), TEXTS)
def test_digits_follow_the_error(name, numbers, texts):
    found = parameter_text(name, Parameter(*numbers, False))
    assert (found.value, found.error, found.interval, found.unit) == texts


def test_json_has_the_agreed_keys_and_no_infinite_number():
    found = json.loads(json.dumps(fit_to_dict(made_up(), "a.csv", "s", ["n"], "oil.toml", ROWS), allow_nan=False))
    assert found["converged"] is True
    assert found["rms"] == 0.00662
    assert set(found["parameters"]) == set(NAMES)
    for name, parameter in found["parameters"].items():
        assert {"value", "standard_error", "lower", "upper", "fixed"} <= set(parameter)
        known = name in ("shear_modulus", "stress")
        for key in ("standard_error", "lower", "upper"):
            assert (parameter[key] is not None) == known
        assert parameter["fixed"] == (name in HELD)
    assert found["unidentifiable"] == ["shear_modulus_pressure", "shear_modulus_temperature", "stress_pressure"]
    assert found["correlation"][1][2] is None
    assert found["condition"] is None
    assert found["curves"][0]["deborah_number"] == 5e7
    assert found["notes"][-1] == "n"
    assert found["oil"] == "oil.toml"
    assert [row["model"] for row in found["comparison"]] == ["ree_eyring", "bair_winer", "gecim_winer"]
    assert (found["points"], found["outliers"], found["model"], found["level"]) == (18, 1, "ree_eyring", 0.95)


def test_json_of_a_fit_that_failed_has_no_result():
    found = fit_to_dict(made_up(converged=False))
    assert (found["converged"], found["status"], found["rms"]) == (False, "not_converged", None)
    for name, parameter in found["parameters"].items():
        # what was held is the user's own
        assert (parameter["value"] is None) == (name not in HELD)
        assert parameter["lower"] is None
    for key in ("correlation", "condition", "aic", "bic", "outliers"):
        assert found[key] is None
    assert all(curve["rms"] is None for curve in found["curves"])
    assert "not converged" in found["notes"][0]


# pictures


@pytest.fixture
def no_model(monkeypatch):
    """Straight lines in place of the model."""

    def straight(result, numbers, logarithmic):
        slides = [np.asarray(result.measurements.slide_to_roll)[result.measurements.in_curve(n)] for n in numbers]
        return [SmoothCurve(x, 0.5 * x) for x in (_abscissae(slide, logarithmic) for slide in slides)]

    monkeypatch.setattr("fitting.io.plots.smooth_curves", straight)


def of(slide, curve, pressure=1e9, temperature=300.0):
    """A result with these points; pressure and temperature by curve."""
    slide, number = np.asarray(slide, dtype=float), np.asarray(curve)
    count = int(number.max()) + 1
    base = made_up()
    curves = tuple(
        CurveFit(
            f"{i}",
            1,
            float(np.broadcast_to(pressure, count)[i]),
            2.0,
            float(np.broadcast_to(temperature, count)[i]),
            1.0,
            1e-3,
        )
        for i in range(count)
    )
    full = lambda value: np.full(slide.shape, value)
    measurements = Measurements(
        slide, 0.5 * slide, full(100.0), full(2.0), full(300.0), tuple(number.tolist()), tuple(c.name for c in curves)
    )
    rest = {"predicted": 0.49 * slide, "deviation": full(0.01), "outlier": np.zeros(slide.shape, dtype=bool)}
    return replaced(base, curves=curves, measurements=measurements, **rest)


SLIDES = {
    "linear": (np.linspace(0.0, 0.2, 12), "linear"),
    "both_sides": (np.linspace(-0.2, 0.2, 12), "linear"),
    "negative": (np.linspace(-0.2, -0.01, 12), "linear"),
    "one_slide": (np.full(12, 0.1), "linear"),
    "logarithmic": (np.geomspace(1e-4, 0.2, 12), "log"),
    "logarithmic_from_0": (np.append(np.geomspace(1e-4, 0.2, 11), 0.0), "symlog"),
    "logarithmic_both_sides": (np.append(np.geomspace(1e-4, 0.2, 6), -np.geomspace(1e-4, 0.2, 6)), "symlog"),
    "logarithmic_negative": (-np.geomspace(1e-4, 0.2, 12), "symlog"),
}


@pytest.mark.usefixtures("no_model")
@pytest.mark.parametrize("name", SLIDES)
def test_axis_of_the_slides(name, tmp_path):
    slide, scale = SLIDES[name]
    figure = plot_fit(of(slide, np.repeat([0, 1, 2], 4)), "a.csv", "scene")
    upper, lower = figure.axes
    assert upper.get_xscale() == scale
    low, high = upper.get_xlim()
    assert low < 100.0 * slide.min()
    assert high > 100.0 * slide.max()
    for line in upper.get_lines():
        x = np.asarray(line.get_xdata(), dtype=float)
        assert np.all(np.isfinite(x))
    figure.savefig(tmp_path / "a.png")
    assert lower.get_ylabel() == "fitted - measured"


@pytest.mark.parametrize("name", SLIDES)
def test_abscissae_stay_in_the_measured_range(name):
    slide, scale = SLIDES[name]
    x = _abscissae(slide, scale != "linear")
    assert x.shape == (POINTS,)
    assert x.min() >= min(0.0, slide.min()) * (1 + 1e-12)
    assert x.max() <= max(0.0, slide.max()) * (1 + 1e-12)
    np.testing.assert_allclose(np.max(np.abs(x)), np.max(np.abs(slide)), rtol=1e-12)


@pytest.mark.usefixtures("no_model")
def test_few_curves_have_a_name_each_and_many_share_colours():
    slide, numbers = np.tile(np.linspace(0.01, 0.2, 3), 12), np.repeat(np.arange(12), 3)
    few = plot_fit(of(slide, numbers, pressure=1e9 * np.arange(1, 13)), "a.csv", "scene")
    names = [text.get_text() for text in few.legends[0].get_texts()]
    assert names == [f"{p}.00 GPa" if p < 10 else f"{p}.0 GPa" for p in range(1, 13)]
    assert few.legends[0].get_title().get_text() == "26.9 °C, 2.00 m/s"

    slide, numbers = np.tile(np.linspace(0.01, 0.2, 3), 60), np.repeat(np.arange(60), 3)
    many = of(slide, numbers, np.tile([1e9, 2e9, 3e9], 20), np.repeat(np.linspace(290.0, 380.0, 20), 3))
    figure = plot_fit(many, "a.csv", "scene")
    assert len(figure.legends[0].get_texts()) == 6 + 3
    assert len({to_hex(line.get_color()) for line in figure.axes[1].get_lines()[1:]}) == 20
    same = plot_fit(of(slide, numbers), "a.csv", "scene")
    assert [text.get_text() for text in same.legends[0].get_texts()] == ["60 curves"]


@pytest.mark.usefixtures("no_model")
def test_legend_shows_the_point_and_the_line_of_each_curve():
    slide, numbers = np.tile(np.linspace(0.01, 0.2, 3), 4), np.repeat(np.arange(4), 3)
    figure = plot_fit(of(slide, numbers, pressure=1e9 * np.arange(1, 5)), "a.csv", "scene")
    for handle in figure.legends[0].legend_handles:
        assert handle.get_marker() not in ("None", "")
        assert handle.get_linestyle() == "-"
    assert "Points: measured. Lines: fitted." in [text.get_text() for text in figure.texts]
    assert overlapping(figure) == []
    assert outside(figure) == []


@pytest.mark.usefixtures("no_model")
def test_outliers_are_marked_and_notes_are_there():
    result = made_up()
    figure = plot_fit(result, "a.csv", "scene", ["Column 'x' is ignored."])
    marked = [line for line in figure.axes[0].get_lines() if "outlier" in str(line.get_label())]
    np.testing.assert_allclose(marked[0].get_xdata(), [100.0 * float(result.measurements.slide_to_roll[2])])
    texts = " ".join(text.get_text() for text in figure.texts)
    for words in ("a.csv", "Lack of fit", "Column 'x'", "held", "no interval", "26.7 to 41.7"):
        assert words in texts
    assert isinstance(figure, Page)


def test_no_picture_of_a_fit_that_failed():
    with pytest.raises(ValueError, match="not converged"):
        plot_fit(made_up(converged=False), "a.csv", "scene")


def test_smooth_curves_are_the_model():
    """Through the measured points' conditions: the scene's own solution, at its accuracy."""
    scene = jb.load_scene("two_disk_etm", {"contact.traction_accuracy": "1e-2"})
    result = made_up(scene, file=SWEEPS)
    curves = smooth_curves(result, [0, 3, 4], False)
    assert len(curves) == 3
    of_curve = result.measurements.in_curve(3)
    mean = {
        name: float(np.mean(np.asarray(getattr(result.measurements, name))[of_curve]))
        for name in ("load", "temperature", "entrainment_speed")
    }
    solution = jb.solve(result.scene.at_operation(slide_to_roll=curves[1].slide_to_roll, **mean))
    np.testing.assert_allclose(
        curves[1].traction_coefficient, solution.traction_coefficient.ravel(), rtol=1e-12, atol=1e-15
    )


# typed options


def test_bounds_are_typed_with_units():
    given = ["stress=1 MPa:20 MPa", "beta_tau=-1000 K:", "G0=:1 GPa", "stress_pressure=-1 1/GPa:2e-9 1/Pa"]
    found = typed.bounds("--bound", given)
    assert found["stress"] == (1e6, 2e7)
    assert found["stress_temperature"] == (-1000.0, None)
    assert found["shear_modulus"] == (None, 1e9)
    np.testing.assert_allclose(found["stress_pressure"], (-1e-9, 2e-9))


BAD_BOUNDS = {
    "stress": ["NAME=LOW:HIGH"],
    "stress=1 MPa": ["NAME=LOW:HIGH"],
    "stress=:": ["NAME=LOW:HIGH"],
    "strss=1 MPa:2 MPa": ["Did you mean 'stress'"],
    "stress=1:2": ["a number without a unit", "pressure"],
    "stress=-1 MPa:2 MPa": ["> 0"],
    "stress=1 K:2 MPa": ["another kind"],
    "stress=2 MPa:1 MPa": ["below the upper one"],
    "stress=nan MPa:1 MPa": ["not finite"],
}


@pytest.mark.parametrize("text", BAD_BOUNDS)
def test_wrong_bounds_are_refused(text):
    with pytest.raises(SceneError) as error:
        typed.bounds("--bound", [text])
    for words in ("--bound", "found", "expected", *BAD_BOUNDS[text]):
        assert words in str(error.value)


def test_names_and_ratios():
    assert typed.parameter_names("--fix", ["G0", "shear_modulus", "beta_tau"]) == (
        "shear_modulus",
        "stress_temperature",
    )
    assert typed.ratio("--x", "2 %", "1") == 0.02
    assert typed.ratio("--x", "0.02", "1") == 0.02
    for text in ("", "-1", "nan", "inf", "2 % 3", "a", "%"):
        with pytest.raises(SceneError, match="--x: found"):
            typed.ratio("--x", text, "1")
    with pytest.raises(SceneError, match="< 1"):
        typed.ratio("--level", "100 %", "0.95", largest=1.0)
