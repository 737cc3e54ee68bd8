"""Figures of one solution or run: the panels of the pages, each as a figure of its own."""

from typing import TYPE_CHECKING

import numpy as np

from ..bearings.motion.history import History
from ..bearings.solution import Solution
from ..machines import TwoDiskSolution
from ..report.backends.matplotlib.legends import clear_legend
from ..report.backends.matplotlib.panels import draw
from ..report.bearing.operation import load_angle
from ..report.bearing.panels import ROUND, load_panel, loss_panel, round_panel
from ..report.bearing.run.plots import draw_orbit
from ..report.colours import INK
from ..report.registry import check_converged
from ..report.round_off import without_round_off
from ..report.two_disk.curves import curves_of
from ..report.two_disk.panels import traction_panel
from ..report.two_disk.plots import draw_curves
from .style import finish, prepare

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure


def load_distribution(solution: Solution, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Load on each rolling element at both races and the rib, polar; the load line points down.

    **Arguments:** `solution`: one solution of a bearing that converged; `axes`: polar matplotlib axes, a new figure if
    not given.

    **Raises:** `ValueError` for a batch, or a solution that did not converge.
    """
    solution = _checked(solution)
    own, axes = axes is None, prepare(axes, polar=True)
    draw(axes, load_panel(solution))
    axes.legend(fontsize=8.5, frameon=False, loc="upper left", bbox_to_anchor=(1.08, 1.0))
    return finish(axes, "Normal load on each rolling element; azimuth 0 is the load line.", own)


def films(solution: Solution, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Central film at each rolling element over its azimuth. Arguments and errors as `load_distribution`, and
    `ValueError` where the scene models no film."""
    return _round(solution, "film", "Central film at each rolling element, by the film law of the scene.", axes)


def pressures(solution: Solution, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Hertz (peak) pressure at each rolling element over its azimuth. Arguments and errors as `load_distribution`."""
    return _round(solution, "pressure", "Hertz (peak) pressure at each rolling element.", axes)


def sliding(solution: Solution, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Sliding speed at each rolling element over its azimuth. Arguments and errors as `films`."""
    return _round(solution, "sliding", "Sliding speed at each rolling element, signed.", axes)


def power_loss(solution: Solution, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Power loss by location, largest first, with its share of the total. Arguments and errors as `load_distribution`,
    and `ValueError` where the scene models no loss."""
    solution = _checked(solution)
    losses = loss_panel(solution)
    if losses is None:
        raise ValueError("power_loss: the scene models no power loss")
    own, axes = axes is None, prepare(axes)
    draw(axes, losses)
    return finish(axes, "Power loss by location; the shares add up to the total.", own)


def traction_curves(
    solution: TwoDiskSolution, *, temperature: int = 0, speed: int = 0, axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Traction coefficient over slide-to-roll ratio, one curve for each pressure or load.

    **Arguments:** `solution`: of a two-disk machine; `temperature`, `speed`: which of those computed, by number;
    `axes`: to draw into.

    **Raises:** `ValueError` for a solution that did not converge; `IndexError` for a number that is not there.
    """
    check_converged(solution)
    curves = [curve for curve in curves_of(solution) if curve.place[:2] == (temperature, speed)]
    if not curves:
        raise IndexError(f"found temperature {temperature} and speed {speed}, expected numbers of those computed")
    own, axes = axes is None, prepare(axes)
    draw_curves(axes, traction_panel(solution, curves))
    caption = "Traction coefficient; the slide-to-roll ratio is the speed difference over the mean."
    figure = finish(axes, caption, own)
    clear_legend(axes)
    return figure


def cage_orbit(history: History, *, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Path of the cage's centre, and the circle of its guiding clearance.

    **Arguments:** `history`: a run of a bearing with a cage that completed; `axes`: to draw into.

    **Raises:** `ValueError` for a scene without a cage, or a run that stopped early.
    """
    cage = history.instants.cage
    if cage is None:
        raise ValueError("cage_orbit: the scene has no cage")
    if not bool(history.completed):
        raise ValueError(f"cage_orbit: the run did not complete: {history.failure()}")
    own, axes = axes is None, prepare(axes)
    shown = without_round_off(history)
    assert shown.instants.cage is not None
    draw_orbit(axes, shown.instants.cage, load_angle(history.operation) is not None)
    caption = "Path of the cage's centre; grey: start, red: end."
    x, y, radius = _guide(history)
    if radius > 0.0:
        angle = np.linspace(0.0, 2.0 * np.pi, 181)
        circle = 1e6 * (x + radius * np.sin(angle)), 1e6 * (y + radius * np.cos(angle))
        axes.plot(*circle, color=INK, linestyle="--", linewidth=1.0)
        caption += (
            f" Dashed: where the cage touches the ring that guides it, {1e6 * radius:.4g} µm round its mean centre."
        )
    return finish(axes, caption, own)


def _guide(history: History) -> tuple[float, float, float]:
    """Mean centre of the guiding ring and radial guiding clearance, m; no clearance where the cage stays concentric.

    A history does not say which ring guides; it is the one from whose centre offset over eccentricity ratio is one
    length, the clearance.
    """
    cage, ring = history.instants.cage, history.instants.ring
    assert cage is not None
    ratio, zero = np.asarray(cage.eccentricity_ratio), np.zeros_like(np.asarray(cage.x))
    if not np.any(ratio > 0.0):
        return 0.0, 0.0, 0.0
    guides = []
    for x, y in ((zero, zero), (-np.asarray(ring.lateral) + zero, np.asarray(ring.radial) + zero)):
        radius = np.hypot(np.asarray(cage.x) - x, np.asarray(cage.y) - y)[ratio > 0.0] / ratio[ratio > 0.0]
        guides.append((float(np.ptp(radius)), float(np.mean(x)), float(np.mean(y)), float(np.median(radius))))
    return min(guides)[1:]


def _round(
    solution: Solution, name: str, caption: str, axes: "matplotlib.axes.Axes | None"
) -> "matplotlib.figure.Figure":
    solution = _checked(solution)
    panel = round_panel(solution, name)
    if panel is None:
        raise ValueError(f"{ROUND[name][0].lower()}: the scene does not model it")
    own, axes = axes is None, prepare(axes)
    draw(axes, panel)
    figure = finish(axes, caption, own)
    clear_legend(axes)
    return figure


def _checked(solution: Solution) -> Solution:
    """The solution as it is drawn. **Raises:** `ValueError` for a batch, or a solution that did not converge."""
    if np.ndim(solution.status) != 0:
        raise ValueError("found a batch of solutions, expected one: take one lane of it")
    check_converged(solution)
    return without_round_off(solution)
