"""Figures of one solution or run: what is drawn is the solution, in engineer's units."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from pictures import hidden_by_legends, overlapping

import jaxbearing as jb
from jaxbearing import plots
from jaxbearing.report.backends.matplotlib.legends import clear_legend


@pytest.fixture(scope="module")
def solution():
    return jb.solve(jb.load_scene("reference_roller"))


def drawn(figure):
    return {line.get_label(): np.asarray(line.get_ydata()) for line in figure.axes[0].lines}


@pytest.mark.parametrize(
    ("name", "field", "factor"), [("films", "film", 1e6), ("pressures", "pressure", 1e-9), ("sliding", "sliding", 1.0)]
)
def test_round_the_bearing(name, field, factor, solution):
    lines = drawn(getattr(plots, name)(solution))
    for side in ("inner", "outer"):
        expected = factor * np.sort(np.asarray(getattr(solution.elements, f"{field}_{side}")))
        got = np.sort(lines[f"{side} race"])
        np.testing.assert_allclose(got[np.isin(got, got[: expected.size])][: expected.size], expected, rtol=1e-9)


@pytest.mark.parametrize("name", ["films", "pressures", "sliding", "load_distribution", "power_loss"])
def test_legends_hide_no_curve(name, solution):
    figure = getattr(plots, name)(solution)
    assert hidden_by_legends(figure) == []
    assert overlapping(figure) == []


def test_a_legend_gets_room_where_there_is_none():
    """Curves that fill their axes: these become higher, and what is drawn stays."""
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    x = np.linspace(0.0, 1.0, 200)
    for n in range(9):
        axes.plot(x, np.sin(40.0 * x + n), label=f"curve {n}")
    top = axes.get_ylim()[1]
    clear_legend(axes)
    assert hidden_by_legends(axes.figure) == []
    assert axes.get_ylim()[1] > top


def test_power_loss(solution):
    figure = plots.power_loss(solution)
    widths = sorted(bar.get_width() for bar in figure.axes[0].patches)
    np.testing.assert_allclose(sum(widths), solution.power_loss.total, rtol=1e-9)
    np.testing.assert_allclose(widths[-1], solution.power_loss.drag, rtol=1e-9)


def test_load_distribution_into_axes_of_the_caller(solution):
    from matplotlib.figure import Figure

    axes = Figure().add_subplot(projection="polar")
    assert plots.load_distribution(solution, axes=axes) is axes.figure
    assert not axes.figure.texts
    largest = max(float(np.max(line.get_ydata())) for line in axes.lines)
    np.testing.assert_allclose(largest, 1e-3 * np.max(solution.elements.load_outer), rtol=1e-9)


def test_refusals(solution):
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    with pytest.raises(ValueError, match="film"):
        plots.films(jb.solve(scene))
    failed = eqx.tree_at(lambda one: one.status, solution, jnp.asarray(int(jb.Status.DIVERGED)))
    with pytest.raises(ValueError, match="no results"):
        plots.load_distribution(failed)


@pytest.mark.slow
def test_orbit_and_its_circle():
    """The circle has the radial guiding clearance round the centre of the ring that guides."""
    scene = jb.load_scene("turbine_roller_dynamic")
    history = jb.simulate(scene, 2e-3)
    figure = plots.cage_orbit(history)
    path, circle = figure.axes[0].lines[0], figure.axes[0].lines[-1]
    np.testing.assert_allclose(path.get_xdata(), 1e6 * np.asarray(history.instants.cage.x), rtol=1e-12)
    x, y = circle.get_xdata(), circle.get_ydata()
    np.testing.assert_allclose(np.ptp(x) / 2.0, 1e6 * scene.cage.guiding_clearance / 2.0, rtol=1e-3)
    np.testing.assert_allclose((y.max() + y.min()) / 2.0, 1e6 * np.mean(history.instants.ring.radial), rtol=1e-3)


def test_traction_curves():
    found = jb.solve(jb.load_scene("two_disk_mobil_jet_ii", {"contact.traction_accuracy": "1e-2"}))
    lines = drawn(plots.traction_curves(found))
    ends = sorted(values[-1] for label, values in lines.items() if "GPa" in label)
    np.testing.assert_allclose(ends, np.sort(np.asarray(found.traction_coefficient)[0, 0, :, -1]), rtol=1e-9)
