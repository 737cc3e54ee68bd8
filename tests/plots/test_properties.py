"""The source's property figures: what is drawn is the laws' numbers in display units, with their limits."""

import importlib.util
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from reference_oils import mobil_jet_ii

from jaxbearing.lubricants import IntegratedPressureViscosity
from jaxbearing.plots import properties
from jaxbearing.plots.properties import coefficients, spin, thermal, traction
from jaxbearing.plots.properties.curves import matched_barus, matched_roelands

DOCS = Path(__file__).parents[2] / "docs"


def gallery():
    spec = importlib.util.spec_from_file_location("make_gallery", DOCS / "make_gallery.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def lines(figure):
    return {line.get_label(): line.get_xydata() for line in figure.axes[0].get_lines()}


def test_thermal_factor_is_one_at_rest_and_the_formula_beyond():
    assert thermal.factor_at(1e-9, 1.0, 1e9) == pytest.approx(1.0, abs=1e-4)
    # by hand: gupta at p0 = 1 GPa, E' = 225.275 GPa, L = 1, S = 0
    expected = (1.0 - 13.2 / 225.275) / 1.213
    np.testing.assert_allclose(thermal.factor_at(1.0, 0.0, 1e9), expected, rtol=1e-6)
    drawn = lines(properties.thermal_factor())
    assert np.all(drawn["2"][:, 1] < drawn["0"][:, 1]), "sliding thins the film"
    assert np.all(np.diff(drawn["0"][:, 1]) < 0.0)


def test_viscosity_is_drawn_in_megapascal_and_pascal_seconds():
    drawn = lines(properties.viscosity_pressure("mobil_jet_ii", (40, 100), 1e9))
    assert drawn["40 °C"][-1, 0] == pytest.approx(1000.0)
    assert drawn["100 °C"][0, 1] == pytest.approx(0.004867549, rel=1e-6)
    expected = mobil_jet_ii().viscosity.viscosity(5e8, 313.15)
    halfway = drawn["40 °C"][70]
    assert halfway == pytest.approx([500.0, float(expected)])


def test_a_second_oil_is_dashed():
    figure = properties.viscosity_pressure("nye_186a", (25,), beside="pennzane_x2000")
    assert [line.get_linestyle() for line in figure.axes[0].get_lines()] == ["-", "--"]


def test_printed_viscosities_lie_on_the_curve():
    drawn = lines(properties.viscosity_temperature(range_celsius=(0.0, 200.0)))
    curve = drawn["Mobil Jet II"]
    for celsius, value in drawn["Mobil Jet II, measured"]:
        found = np.interp(celsius, curve[:, 0], curve[:, 1])
        assert found == pytest.approx(value, rel=0.06 if celsius == 0.0 else 0.04)


@pytest.mark.parametrize("match", [matched_barus, matched_roelands])
def test_matched_laws_go_through_their_three_points(match):
    own = mobil_jet_ii().viscosity
    law = match(own)
    for pressure, temperature in ((0.0, 313.15), (50e6, 313.15), (0.0, 437.15)):
        np.testing.assert_allclose(
            law.log_viscosity(pressure, temperature), own.log_viscosity(pressure, temperature), rtol=1e-9
        )


def test_laws_part_at_high_pressure_as_the_caption_says():
    drawn = lines(properties.viscosity_models())
    own = drawn["own law, 40 °C"][-1, 1]
    assert 500.0 < drawn["Barus, 40 °C"][-1, 1] / own < 1000.0
    assert 1.0 < drawn["Roelands, 40 °C"][-1, 1] / own < 3.16


def test_alpha_meets_table_6_and_barus_is_constant():
    laws = coefficients.mobil_laws()
    printed = coefficients.PRINTED
    np.testing.assert_allclose(coefficients.alpha_at(laws["modified WLF"], [*printed]), [*printed.values()], rtol=9e-3)
    np.testing.assert_allclose(
        coefficients.alpha_at(laws["Barus"], [0.0, 150.0]), 1e9 * float(laws["Barus"].pressure_viscosity), rtol=1e-6
    )


def test_alpha_of_oils_draws_integral_and_closed_form():
    figure = properties.alpha_of_oils(("pennzane_x2000",))
    integral, closed = (line.get_xydata() for line in figure.axes[0].get_lines())
    np.testing.assert_allclose(integral[::10], closed, rtol=5e-4)
    law = properties.viscosities.oil_named("pennzane_x2000")[0].viscosity
    at_end = 1e9 * float(IntegratedPressureViscosity(law).coefficient(273.15 + 120.0))
    assert integral[-1] == pytest.approx([120.0, at_end])


def test_film_of_figure_28():
    found = [coefficients.film_at(law, 100.0, 1.05e9) for law in coefficients.mobil_laws().values()]
    assert found[0] == pytest.approx(0.624, abs=5e-4)
    assert found[1] / found[0] == pytest.approx(1.50, abs=0.01)
    assert found[2] / found[0] == pytest.approx(1.05, abs=0.01)


def test_shear_modulus_sets_the_slope_and_stress_the_level():
    oil, slides = traction.oil_named("mobil_jet_ii")[0], [0.0, 0.002, 10.0]
    base = traction.traction_at(oil, slides)
    stiff = traction.traction_at(traction.scaled(oil, "shear_modulus", 4.0), slides)
    strong = traction.traction_at(traction.scaled(oil, "stress", 2.0), slides)
    assert base[0] == 0.0
    assert stiff[1] / base[1] > 2.0
    assert abs(stiff[2] / base[2] - 1.0) < 0.01
    assert abs(strong[1] / base[1] - 1.0) < 0.1
    assert strong[2] / base[2] > 1.8
    weak = traction.traction_at(traction.scaled(oil, "shear_modulus", 0.25), slides)
    assert 0.97 < weak[2] / base[2] < 1.0, "less than 3 % at 10 % sliding, as the caption says"


@pytest.mark.slow
def test_coarse_mesh_is_as_wrong_as_the_caption_says():
    drawn = lines(properties.traction_models())
    fine = drawn["point contact (2D), 128 steps, 24 strips"][-1, 1]
    assert drawn["point contact (2D), 8 steps, 4 strips"][-1, 1] / fine == pytest.approx(0.84, abs=0.01)
    assert drawn["line contact (1D), 128 steps"][-1, 1] > fine


@pytest.mark.parametrize("make", [properties.traction_shear_modulus, properties.traction_stress])
def test_no_curve_leaves_the_axes(make):
    axes = make().axes[0]
    top = axes.get_ylim()[1]
    assert all(np.max(line.get_ydata()) <= top for line in axes.get_lines())


def test_spin_starts_as_a_newtonian_film():
    """Viscous limit at small spin: Mz = (spin/h) * integral of mu(p) r^2, by an independent midpoint quadrature."""
    pressure, ratio = spin.PRESSURES[0], 1e-7
    patch, law = spin.patch_at(pressure), mobil_jet_ii().viscosity
    radius = (np.arange(400) + 0.5) / 400
    viscosity = np.asarray(law.viscosity(pressure * np.sqrt(1.0 - radius**2), spin.TEMPERATURE))
    a, c = float(patch.half_width), float(patch.half_length)
    moment = np.sum(viscosity * radius**3) / 400 * np.pi * a * c * (a**2 + c**2)
    moment *= ratio * spin.ROLL_RATE / spin.film_thickness(pressure)
    expected = moment / (float(patch.load) * np.sqrt(a * c))
    np.testing.assert_allclose(spin.spin_coefficient([ratio], pressure, elastic=False), expected, rtol=2e-3)


def test_spin_film_is_that_of_the_printed_groups():
    # h/Rx = 1.1109e-4 at the third W*, 1.8136e-4, read for the misprint 1.1814e-4
    assert spin.film_thickness(1.89e9) / spin.RADIUS == pytest.approx(1.1109e-4, rel=2e-3)


@pytest.mark.slow
def test_spin_friction_grows_with_pressure_and_spin():
    drawn = lines(properties.spin_friction(pressures=(1.19e9, 2.38e9)))
    low, high = drawn["1.19 GPa"][:, 1], drawn["2.38 GPa"][:, 1]
    assert low[0] == high[0] == 0.0
    assert np.all(np.diff(high) > 0.0)
    assert np.all(high[1:] > low[1:])
    assert high[-1] < 0.20, "the end of the source's axis"


def test_draws_into_given_axes_without_a_caption():
    figure = Figure()
    axes = figure.add_subplot()
    assert properties.film_of_models(axes=axes) is figure
    assert axes.get_xlabel() == "temperature, °C"
    assert axes.get_ylabel() == "central film, µm"
    assert not figure.texts


def test_page_lists_every_picture_and_no_other():
    module = gallery()
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    names = {entry.name for entry in module.ENTRIES}
    measured = set(re.findall(r"\]\(pictures/(\w+)\.png\)", (DOCS / "measurements.md").read_text(encoding="utf-8")))
    assert {path.stem for path in (DOCS / "pictures").iterdir()} == names | measured
    assert names.isdisjoint(measured)
    assert all(f"](pictures/{name}.png)" in page for name in names)
    assert page.count("![") == len(names) == len(module.ENTRIES)
    assert all(entry.code in page for entry in module.ENTRIES), "run docs/make_gallery.py"


ELSEWHERE = {"cage_orbit", "map_of", "raceway_control_map", "result_against"}
"""Minutes of compiling; what they draw is tested with other sweeps and runs."""


@pytest.mark.slow
def test_the_gallery_is_made_anew(tmp_path):
    module = gallery()
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    for entry in module.ENTRIES:
        if entry.name in ELSEWHERE:
            continue
        figure = module.drawn(entry)
        picture = tmp_path / f"{entry.name}.png"
        figure.savefig(picture, dpi=module.RESOLUTION)
        assert picture.stat().st_size > 5000
        assert figure.texts[0].get_text(), "the picture has its caption, the page has not"
        assert module.section(entry) in page, "run docs/make_gallery.py"
    assert sum(path.stat().st_size for path in (DOCS / "pictures").iterdir()) < 2.5e6
