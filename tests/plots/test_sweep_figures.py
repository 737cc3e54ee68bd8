"""Figures of a sweep: what is drawn are the numbers of the data set, and failed cases are gaps."""

import re

import numpy as np
import pytest
import xarray as xr
from pictures import overlapping

import jaxbearing as jb
from jaxbearing.plots import map_of, power_loss_against, result_against

RPM = np.array([1000.0, 2000.0, 3000.0, 4000.0])
LOADS = np.array([1e3, 2e3, 3e3])


def made_up(dims=("operation_inner_speed",), failed=None):
    """Two losses that add up; the stored numbers of a failed case are there, and must not be drawn."""
    axes = {"operation_inner_speed": RPM * np.pi / 30.0, "operation_radial_load": LOADS}
    units = {"operation_inner_speed": "rad s-1", "operation_radial_load": "N"}
    shape = tuple(axes[name].size for name in dims)
    drag = 100.0 + np.arange(np.prod(shape), dtype=float).reshape(shape)
    failure = np.full(shape, "", dtype=object)
    if failed is not None:
        failure[failed] = "not converged"
    watts = lambda values, name: (dims, values, {"units": "W", "long_name": name})
    return xr.Dataset(
        {
            "power_loss_total": watts(1.5 * drag, "total"),
            "power_loss_drag": watts(drag, "drag"),
            "power_loss_pocket": watts(0.5 * drag, "pocket"),
            "failure": (dims, failure),
        },
        coords={name: ((name,), axes[name], {"units": units[name], "long_name": name}) for name in dims},
        attrs={"sweep_kind": "grid", "sweep_fields": " ".join(name.replace("_", ".", 1) for name in dims)},
    )


def test_stack_adds_up_to_the_total_in_engineers_units():
    axes = power_loss_against(made_up(), "operation.inner_speed").axes[0]
    (total,) = axes.lines
    np.testing.assert_allclose(total.get_xdata(), RPM, rtol=1e-12)
    np.testing.assert_allclose(total.get_ydata(), 1.5 * (100.0 + np.arange(4)), rtol=1e-12)
    top = max(band.get_paths()[0].vertices[:, 1].max() for band in axes.collections)
    assert top == pytest.approx(total.get_ydata().max(), rel=1e-12)
    assert "W" in axes.get_ylabel()
    assert "rpm" in axes.get_xlabel()


def test_failed_case_is_a_gap_and_said():
    figure = power_loss_against(made_up(failed=2))
    assert np.isnan(figure.axes[0].lines[0].get_ydata()).tolist() == [False, False, True, False]
    assert "1 of 4 cases failed" in " ".join(figure.texts[0].get_text().split())


def test_second_field_is_a_line_each():
    data = made_up(("operation_inner_speed", "operation_radial_load"))
    axes = power_loss_against(data, "operation.inner_speed").axes[0]
    drawn = np.array([line.get_ydata() for line in axes.lines])
    np.testing.assert_allclose(drawn, data.power_loss_total.values.T, rtol=1e-12)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["1 kN", "2 kN", "3 kN"]


def test_operating_point_is_marked_where_it_is_within():
    within, beyond = ({"operation.inner_speed": rpm * np.pi / 30.0} for rpm in (2500.0, 9000.0))
    marked = power_loss_against(made_up(), operating_point=within)
    lines = {line.get_label(): line for line in marked.axes[0].lines}
    np.testing.assert_allclose(lines["operating point"].get_xdata(), 2500.0, rtol=1e-12)
    assert "operating point" in marked.texts[0].get_text()
    without = power_loss_against(made_up(), operating_point=beyond)
    assert "operating point" not in {line.get_label() for line in without.axes[0].lines}
    both = within | {"operation.radial_load": 1.5e3}
    figure = map_of(
        made_up(("operation_inner_speed", "operation_radial_load")), "power_loss_drag", operating_point=both
    )
    ring = figure.axes[0].lines[-1]
    np.testing.assert_allclose([ring.get_xdata()[0], ring.get_ydata()[0]], [2500.0, 1.5], rtol=1e-12)
    assert "operating point" in {text.get_text() for text in figure.axes[0].texts}


def decades():
    """A sweep of both fields over decades, with a life over as many."""
    axes = {"operation_inner_speed": np.geomspace(10.0, 1e3, 9), "operation_radial_load": np.geomspace(1e2, 1e4, 7)}
    units = {"operation_inner_speed": "rad s-1", "operation_radial_load": "N"}
    hours = 1e12 / (axes["operation_inner_speed"][:, None] * axes["operation_radial_load"] ** 2)
    coordinates = {name: ((name,), values, {"units": units[name], "long_name": name}) for name, values in axes.items()}
    life = {"life": (tuple(axes), hours, {"units": "h", "long_name": "life"})}
    attributes = {"sweep_kind": "grid", "sweep_fields": "operation.inner_speed operation.radial_load"}
    return xr.Dataset(life, coordinates, attributes)


def test_ticks_of_logarithms_and_labels_of_contours_are_numbers():
    figure = map_of(decades(), "life")
    figure.draw_without_rendering()
    axes, bar = figure.axes
    for axis in (axes.xaxis, axes.yaxis, bar.yaxis):
        words = [label.get_text() for label in axis.get_ticklabels() if label.get_text()]
        assert len(words) >= 3
        assert all(re.fullmatch(r"[\d.\N{THIN SPACE}]+", word) for word in words), words
    values = [float(text.get_text().replace("\N{THIN SPACE}", "")) for text in axes.texts]
    assert len(values) >= 5
    # 1, 2 and 5 times powers of ten, or the powers
    assert all(f"{value:e}"[0] in "125" for value in values)
    assert overlapping(figure) == []
    line = result_against(decades().isel(operation_radial_load=0), "life").axes[0]
    assert line.get_yscale() == "log"
    assert [label.get_text() for label in line.get_xticklabels()][:3] == ["100", "200", "500"]


def test_map_masks_the_failed_case_and_says_so():
    data = made_up(("operation_inner_speed", "operation_radial_load"), failed=(1, 1))
    figure = map_of(data, "power_loss_total", "operation.radial_load", "operation.inner_speed")
    assert "1 of 12 cases failed" in " ".join(figure.texts[0].get_text().split())
    assert figure.axes[0].get_xlim() == pytest.approx((1.0, 3.0))
    assert figure.axes[0].get_ylim() == pytest.approx((1000.0, 4000.0))


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda: power_loss_against(made_up(), "operation.oil_flow"), "expected a swept field: operation_inner_speed"),
        (lambda: power_loss_against(made_up().drop_vars("power_loss_total")), "models no power loss"),
        (lambda: power_loss_against(made_up().assign_attrs(sweep_kind="list")), "cases of a list sweep"),
        (lambda: map_of(made_up(), "power_loss_total"), "expected 2"),
        (lambda: result_against(made_up(), "cage_slip"), "no 'cage_slip'"),
    ],
)
def test_what_cannot_be_drawn_is_said(draw, words):
    with pytest.raises(ValueError, match=words):
        draw()


def test_results_that_are_not_one_number_a_case_are_refused():
    found = jb.sweep(jb.load_scene("reference_roller", {"contact": "none"}), {"operation.radial_load": [5e3, 1e4]})
    for name, words in (("load_inner", "for each element"), ("failure", "text")):
        with pytest.raises(ValueError, match=words):
            result_against(found, name)
    with pytest.raises(ValueError, match="no swept field"):
        result_against(found.isel(operation_radial_load=0), "ring_radial")
