"""The Stribeck curve: it draws torques of the data set, failed cases are gaps, what cannot be drawn is refused."""

import numpy as np
import pytest
import xarray as xr

import jaxbearing as jb

RPM = np.array([1.0, 10.0, 100.0, 1000.0, 10000.0])
SPEED = RPM * np.pi / 30.0
TOTAL, BOUNDARY = np.array([0.5, 0.6, 0.3, 0.4, 0.7]), np.array([0.45, 0.4, 0.1, 0.01, 0.0])


def made_up(failed=None, outer=None, **attributes):
    """Powers at five speeds."""
    failure = np.full(RPM.size, "", dtype=object)
    if failed is not None:
        failure[failed] = "not converged"
    relative = SPEED if outer is None else np.abs(SPEED - outer)
    dim = "operation_inner_speed"
    watts = lambda torque: (dim, torque * relative, {"units": "W", "long_name": "total"})
    found = {"power_loss_total": watts(TOTAL), "boundary_power_total": watts(BOUNDARY), "failure": (dim, failure)}
    coordinate = {dim: ((dim,), SPEED, {"units": "rad s-1", "long_name": "inner ring speed"})}
    if outer is not None:
        coordinate["operation_outer_speed"] = ((), outer)
    kept = {"sweep_kind": "grid", "sweep_fields": "operation.inner_speed"}
    return xr.Dataset(found, coords=coordinate, attrs=kept | attributes)


@pytest.mark.parametrize("outer", [None, -30.0])
def test_torque_is_loss_over_the_speed_of_the_rings_against_each_other(outer):
    figure = jb.plots.stribeck(made_up(outer=outer))
    (line,) = figure.axes[0].lines
    np.testing.assert_allclose(line.get_xdata(), RPM, rtol=1e-12)
    np.testing.assert_allclose(line.get_ydata(), TOTAL, rtol=1e-12)
    names = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert names == ["boundary friction", "films and all else", "total"]
    rubbed = figure.axes[0].collections[0].get_paths()[0].vertices[:, 1]
    assert rubbed.max() == pytest.approx(BOUNDARY.max(), rel=1e-12)
    assert figure.axes[0].get_xscale() == "log"
    caption = " ".join(figure.texts[0].get_text().split())
    assert "Boundary friction is 90 % of it at 1 rpm" in caption
    assert "minimum near 100 rpm" in caption


def test_failed_case_is_a_gap_and_said():
    figure = jb.plots.stribeck(made_up(failed=1))
    assert np.isnan(figure.axes[0].lines[0].get_ydata()).tolist() == [False, True, False, False, False]
    assert "1 of 5 cases failed" in " ".join(figure.texts[0].get_text().split())


def test_scene_without_mixed_friction_has_one_band():
    figure = jb.plots.stribeck(made_up().drop_vars("boundary_power_total"))
    assert "models no mixed friction" in " ".join(figure.texts[0].get_text().split())
    assert len(figure.axes[0].collections) == 1


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (lambda: made_up(sweep_fields="operation.radial_load"), "expected operation.inner_speed alone"),
        (lambda: made_up().drop_vars("power_loss_total"), "models no power loss"),
        (lambda: made_up(outer=float(SPEED[2])), "rings that turn alike"),
    ],
)
def test_what_cannot_be_drawn_is_said(data, words):
    with pytest.raises(ValueError, match=words):
        jb.plots.stribeck(data())


def test_scene_is_solved_at_the_speeds():
    """A dry scene models no loss: the sweep runs, and the curve is refused."""
    with pytest.raises(ValueError, match="models no power loss"):
        jb.plots.stribeck(jb.load_scene("deep_groove_6205"), [100.0, 200.0])


def test_a_scene_without_a_ring_is_refused():
    with pytest.raises(ValueError, match="without operation"):
        jb.plots.stribeck(jb.load_scene("two_disk_etm"))
