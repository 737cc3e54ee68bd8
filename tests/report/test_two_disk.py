"""Traction curves on the screen, as JSON, as a picture and as a file."""

import dataclasses
import io
import json

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from rich.console import Console
from two_disk_cases import small

import jaxbearing as jb
from jaxbearing.contacts import FilmHeating, Gupta
from jaxbearing.numerics.status import Status
from jaxbearing.report.dataset import solution_to_dataset, write_netcdf
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.plots import plot_solution, save_plot
from jaxbearing.report.summary import print_summary
from jaxbearing.report.two_disk import summary

SLIDE = [-0.2, -0.002, 0.0, 0.002, 0.01, 0.05, 0.2]


@pytest.fixture(scope="module")
def solution():
    """Everything switched on: 2 temperatures, 2 speeds, 3 pressures."""
    scene = small(
        slide_to_roll=SLIDE, temperature=[300.0, 370.0], entrainment_speed=[2.0, 20.0], pressure=[0.6e9, 0.9e9, 1.2e9]
    )
    return jb.solve(scene.replace({"contact.thermal": Gupta(), "contact.traction.heating": FilmHeating()}))


@pytest.fixture(scope="module")
def loaded():
    """One isothermal curve at a given load."""
    return jb.solve(small(load=100.0, entrainment_speed=0.025))


def text_of(result, width=100, full=False):
    stream = io.StringIO()
    print_summary(result, "a scene", Console(file=stream, width=width, highlight=False), full)
    return stream.getvalue()


def failed(result, where=(0, 0, 0, 0)):
    """The same solution, one point of which has failed."""
    status = jnp.asarray(result.status).at[where].set(int(Status.NOT_CONVERGED))
    result = eqx.tree_at(lambda s: s.status, result, status)
    return eqx.tree_at(lambda s: s.traction_coefficient, result, result.traction_coefficient.at[where].set(jnp.nan))


def test_full_lists_what_was_assumed(loaded):
    noted = dataclasses.replace(loaded, notes=("one thing is assumed", "another is"))
    assert "assumed: 2 entries, which solve --full lists" in text_of(noted)
    assert "one thing" not in text_of(noted)
    for text in noted.notes:
        assert f"assumed: {text}" in text_of(noted, full=True)


def test_json(solution):
    result = json.loads(json.dumps(solution_to_dict(solution), allow_nan=False))
    assert (result["converged"], result["status"], result["warnings"]) == (True, "converged", [])
    assert len(result["curves"]) == 2 * 2 * 3
    keys = {"slide_to_roll", "traction_coefficient", "pressure", "entrainment_speed", "temperature", "deborah_number"}
    for curve in result["curves"]:
        assert set(curve) >= keys
        assert curve["slide_to_roll"] == SLIDE
        for name in ("traction_coefficient", "film", "inlet_temperature", "power", "film_rise", "surface_rise"):
            assert len(curve[name]) == len(SLIDE)
        for name in ("pressure", "load", "entrainment_speed", "temperature", "deborah_number"):
            assert isinstance(curve[name], float)
    last = result["curves"][-1]
    assert (last["temperature"], last["entrainment_speed"]) == (370.0, 20.0)
    np.testing.assert_allclose(last["pressure"], 1.2e9, rtol=1e-9)
    assert last["traction_coefficient"] == np.asarray(solution.traction_coefficient)[1, 1, 2].tolist()
    # at the smallest slide
    assert last["deborah_number"] == float(solution.deborah_number[1, 1, 2, 2])
    assert result["operation"]["slide_to_roll"] == SLIDE
    assert "load" not in result["operation"]


def test_json_of_a_load(loaded):
    result = solution_to_dict(loaded)
    assert result["operation"]["load"] == [100.0]
    assert result["curves"][0]["load"] == 100.0
    assert "film_rise" not in result["curves"][0]


def test_json_of_a_failure(solution):
    result = json.loads(json.dumps(solution_to_dict(failed(solution)), allow_nan=False))
    assert (result["converged"], result["status"]) == (False, "not_converged")
    assert result["curves"][0]["traction_coefficient"][0] is None
    assert None not in result["curves"][1]["traction_coefficient"]


def test_summary(solution):
    text = text_of(solution)
    for word in ("CONVERGED", "12 curves of 7 points", "-20 % to 20 % of the mean speed", "degC", "26.85", "96.85"):
        assert word in text
    for column in ("p0", "GPa", "h", "um", "D", "inlet", "film", "rise K", "0.2 %", "20 %"):
        assert column in text
    assert f"{float(solution.traction_coefficient[1, 1, 2, 6]):.4f}" in text
    assert f"{float(np.max(np.asarray(solution.film_rise)[1, 1, 2])):.1f}" in text
    assert max(map(len, text.splitlines())) <= 100


def test_summary_leaves_out_what_is_not_modelled(loaded):
    text = text_of(loaded)
    assert "rise" not in text
    assert "mm/s" in text
    assert "Hertz pressure" in text


@pytest.mark.parametrize("width", [40, 60, 80, 100, 200])
def test_summary_at_any_width(solution, width):
    """No number is cut, and in full friction is shown at the smallest and the largest slide at least."""
    text = text_of(solution, width, full=True)
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text
    for slide in (3, 6):
        assert f"{float(solution.traction_coefficient[1, 1, 2, slide]):.4f}" in text


def test_many_curves_are_counted(solution, monkeypatch):
    monkeypatch.setattr(summary, "ROWS", 10)
    assert "and 2 curves more: see --json or --out" in text_of(solution)


def test_summary_of_a_failure_prints_no_result(solution):
    text = text_of(failed(solution))
    assert "NOT CONVERGED" in text
    assert "1 of 84 points, worst at temperature 300 K" in " ".join(text.split())
    assert "Traction curves" not in text


def written(dataset, path):
    write_netcdf(dataset, path)
    with xr.open_dataset(path) as file:
        return file.load()


def test_netcdf(solution, tmp_path):
    dataset = solution_to_dataset(solution)
    back = written(dataset, tmp_path / "curves.nc")
    assert set(back.variables) == set(dataset.variables)
    for name, variable in back.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert back.attrs["title"] == "Traction curves of a two-disk machine"
    assert back["traction_coefficient"].dims == ("temperature", "entrainment_speed", "pressure", "slide_to_roll")
    assert set(back.coords) == {"temperature", "entrainment_speed", "pressure", "load", "slide_to_roll", "check"}
    one = back["traction_coefficient"].sel(temperature=370.0, entrainment_speed=2.0, slide_to_roll=0.05)
    np.testing.assert_array_equal(
        one.sel(pressure=1.2e9, method="nearest"), np.asarray(solution.traction_coefficient)[1, 0, 2, 5]
    )
    assert back["load"].dims == ("pressure",)
    units = {name: back[name].attrs["units"] for name in back.variables}
    assert (units["film"], units["power"], units["entrainment_speed"], units["pressure"]) == ("m", "W", "m s-1", "Pa")
    assert back["status"].attrs["flag_meanings"].split() == [status.text for status in Status]
    assert int(back["status"].sum()) == int(back["out_of_range"].sum()) == 0
    assert "film_rise" in back


def test_netcdf_of_loads(loaded, tmp_path):
    back = written(solution_to_dataset(loaded), tmp_path / "curves.nc")
    assert back["film"].dims == ("temperature", "entrainment_speed", "load", "slide_to_roll")
    assert back["pressure"].dims == ("load",)
    assert "film_rise" not in back


def lines(axes):
    return {line.get_label(): line for line in axes.lines if not line.get_label().startswith("_")}


def test_plot(solution, tmp_path):
    figure = plot_solution(solution, "a scene")
    assert [axes.get_title() for axes in figure.axes] == [
        "26.85 °C, 2 m/s",
        "26.85 °C, 20 m/s",
        "96.85 °C, 2 m/s",
        "96.85 °C, 20 m/s",
    ]
    curve = lines(figure.axes[3])["0.9 GPa"]
    np.testing.assert_allclose(curve.get_xdata(), 100.0 * np.asarray(SLIDE), rtol=1e-14)
    np.testing.assert_array_equal(curve.get_ydata(), np.asarray(solution.traction_coefficient)[1, 1, 1])
    assert list(lines(figure.axes[0])) == ["0.6 GPa", "0.9 GPa", "1.2 GPa"]
    save_plot(figure, tmp_path / "page.png")
    assert (tmp_path / "page.png").read_bytes().startswith(b"\x89PNG")


def test_plot_of_one_curve_at_a_load(loaded, tmp_path):
    figure = plot_solution(loaded, "a $scene_^{")
    (axes,) = figure.axes
    (name,) = lines(axes)
    assert name.startswith("100 N (")
    assert axes.get_title() == "66.85 °C, 25 mm/s"
    save_plot(figure, tmp_path / "page.svg")


def test_failures_are_refused(solution):
    for show in (lambda s: plot_solution(s, "a scene"), solution_to_dataset):
        with pytest.raises(ValueError, match="not_converged: 1 of 84 points"):
            show(failed(solution))


def test_batches_are_refused(solution):
    numbers, rest = eqx.partition(solution, eqx.is_array)
    batch = eqx.combine(jax.tree.map(lambda leaf: jnp.stack([jnp.asarray(leaf)] * 2), numbers), rest)
    for show in (lambda s: plot_solution(s, "a scene"), solution_to_dataset, solution_to_dict):
        with pytest.raises(ValueError, match="batch"):
            show(batch)


@pytest.mark.parametrize(
    "show", [solution_to_dict, solution_to_dataset, lambda s: plot_solution(s, ""), text_of], ids=range(4)
)
def test_what_is_no_solution_is_refused(show):
    with pytest.raises(TypeError, match="of a int"):
        show(3)
