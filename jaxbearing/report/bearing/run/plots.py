"""One page of plots of a transient run: orbit of the cage, speeds, power, pocket loads over time and azimuth,
sliding."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ....bearings.motion.history import CageMotion, History, Instant, PocketPeaks
from ...backends.matplotlib.legends import clear_legend
from ...backends.matplotlib.sheet import foot, grid_lines, head, title_of
from ...colours import FAINT, INK, INNER, LOSS, OUTER
from ...display import axis_unit, displayed
from ...run_statistics import groove_energy
from ..operation import load_angle
from .json_report import by_side

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_RPM = displayed(1.0, "rad/s")
FOLLOWED = 7
"""Index of the rolling element whose loads are drawn over its azimuth: the eighth element, as in the source's
figures."""


def plot(history: History, title: str) -> "matplotlib.figure.Figure":
    """See `report.histories.plot_history`. Results that the scene does not model are left out."""
    from ...backends.matplotlib.page import Page

    figure, instants, element = Page(), history.instants, history.element_name
    time = 1e3 * np.asarray(history.time)
    head(figure, title, f"{time[-1]:.6g} ms, {int(history.accepted)} steps, {history.solver}")
    bottom = 0.08 + 0.019 * foot(figure, history.warnings if history.completed else [history.failure()])
    across = groove_energy(history)
    size, gaps = {"left": 0.06, "right": 0.98, "top": 0.85, "bottom": bottom}, {"wspace": 0.26, "hspace": 0.38}
    grid = figure.add_gridspec(2, 4 if across else 3, **size, **gaps)
    cage = instants.cage
    if cage is not None:
        draw_orbit(figure.add_subplot(grid[0, 0]), cage, load_angle(history.operation) is not None)
    _speeds(figure.add_subplot(grid[0, 1]), time, instants, element)
    _power(figure.add_subplot(grid[0, 2]), time, instants)
    if instants.pocket_peaks is not None:
        _pocket_over_time(figure.add_subplot(grid[1, 0]), time, instants.pocket_peaks, element)
        _pocket_over_azimuth(figure.add_subplot(grid[1, 1]), instants, element)
    sliding = by_side(instants.elements, "sliding")
    if sliding:
        _sliding(figure.add_subplot(grid[1, 2]), instants.elements, sliding, element)
    if across:
        _over_grooves(figure.add_subplot(grid[:, 3]), np.degrees(instants.groove_angles), across)
    return figure


def _over_grooves(axes: "matplotlib.axes.Axes", angle: np.ndarray, energy: dict[str, np.ndarray]) -> None:
    unit, factor = axis_unit("J", float(max(joules.max() for joules in energy.values())))
    for side, own in energy.items():
        touched = np.flatnonzero(own)
        colour = {"inner": INNER, "outer": OUTER}[side]
        if touched.size:
            part = slice(max(touched[0] - 1, 0), touched[-1] + 2)
            axes.step(factor * own[part], angle[part], where="mid", color=colour, linewidth=1.0, label=f"{side} race")
    axes.set_xlim(left=0.0)
    axes.set_xlabel("energy of sliding in each degree", fontsize=9)
    axes.set_ylabel("contact angle, deg", fontsize=9)
    title_of(axes, f"Sliding by groove angle, {unit}")
    grid_lines(axes)
    if axes.lines:
        clear_legend(axes)


def draw_orbit(axes: "matplotlib.axes.Axes", cage: CageMotion, loaded: bool) -> None:
    """Draws the orbit of the cage centre. **Arguments:** `loaded`: whether a radial load acts, for which an arrow is
    drawn."""
    x, y = 1e6 * np.asarray(cage.x), 1e6 * np.asarray(cage.y)
    axes.plot(x, y, color=INNER, linewidth=0.8)
    axes.plot(x[0], y[0], "o", color=FAINT, markersize=4)
    axes.plot(x[-1], y[-1], "o", color=OUTER, markersize=4)
    axes.set_aspect("equal", adjustable="datalim")
    # as in the drawings: the load points down, and X lies a quarter turn behind it, to the left
    axes.invert_xaxis()
    axes.invert_yaxis()
    if loaded:
        style = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.8}
        place = {"xycoords": "axes fraction", "textcoords": "axes fraction", "ha": "center", "fontsize": 9}
        axes.annotate("load", (0.07, 0.76), (0.07, 0.92), arrowprops=style, color=INK, **place)
    axes.set_xlabel("X (across the load), µm", fontsize=9)
    axes.set_ylabel("Y (along the load), µm", fontsize=9)
    title_of(axes, "Cage centre: grey start, red end")
    grid_lines(axes)


def _speeds(axes: "matplotlib.axes.Axes", time: np.ndarray, instants: Instant, element: str) -> None:
    orbital = getattr(instants.elements, "orbital_speed", None)
    if orbital is not None:
        speeds = _RPM * np.asarray(orbital)
        axes.fill_between(time, speeds.min(axis=1), speeds.max(axis=1), color=INNER, alpha=0.2, linewidth=0)
        followed = speeds[:, FOLLOWED % speeds.shape[1]]
        axes.plot(time, followed, color=INNER, linewidth=0.7, label=f"a {element} (band: all)")
    if instants.cage is not None:
        axes.plot(time, _RPM * np.asarray(instants.cage.speed), color=OUTER, linewidth=1.2, label="cage")
    axes.set_xlabel("time, ms", fontsize=9)
    axes.ticklabel_format(axis="y", useOffset=False)
    title_of(axes, "Orbital speeds, rpm")
    grid_lines(axes)
    if axes.lines:
        clear_legend(axes)


def _power(axes: "matplotlib.axes.Axes", time: np.ndarray, instants: Instant) -> None:
    loss, drive = np.asarray(instants.power_loss.total), np.asarray(instants.drive_power)
    unit, factor = axis_unit("W", float(np.abs(drive).max()))
    axes.plot(time, factor * drive, color=FAINT, linewidth=0.7, label="drive")
    axes.plot(time, factor * loss, color=LOSS, linewidth=1.0, label="dissipated")
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, f"Power, {unit}")
    grid_lines(axes)
    clear_legend(axes)


def _pocket_over_time(axes: "matplotlib.axes.Axes", time: np.ndarray, peaks: PocketPeaks, element: str) -> None:
    front, rear = np.asarray(peaks.front).max(axis=1), np.asarray(peaks.rear).max(axis=1)
    axes.plot(time, front, color=OUTER, linewidth=0.8, label=f"front, of all {element}s")
    axes.plot(time, -rear, color=INNER, linewidth=0.8, label="rear, downwards")
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, "Largest pocket load, N")
    grid_lines(axes)
    clear_legend(axes)


def _pocket_over_azimuth(axes: "matplotlib.axes.Axes", instants: Any, element: str) -> None:
    """Draws the peak pocket loads between instants over the azimuth, always those of the more heavily loaded wall."""
    turned = lambda values: np.degrees(np.mod(np.asarray(values) + np.pi, 2.0 * np.pi) - np.pi)
    azimuth, elements = turned(instants.elements.azimuth), instants.elements
    front, rear = np.asarray(instants.pocket_peaks.front), np.asarray(instants.pocket_peaks.rear)
    net = np.where(front > rear, front, -rear)
    axes.plot(azimuth.ravel(), net.ravel(), ".", color=FAINT, markersize=1.0)
    followed = FOLLOWED % azimuth.shape[1]
    axes.plot(
        azimuth[:, followed],
        net[:, followed],
        ".",
        color=OUTER,
        markersize=2.0,
        label=f"{element} {followed + 1}, grey: all",
    )
    loads = by_side(elements, "load")
    if "inner" in loads:
        load = loads["inner"][:, followed]
        scale = float(np.abs(net).max()) / max(float(load.max()), 1e-300)
        axes.plot(azimuth[:, followed], scale * load, ".", color=LOSS, markersize=0.7, label="its race load, scaled")
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks([-180, -90, 0, 90, 180])
    axes.set_xlabel("azimuth from the load line, deg", fontsize=9)
    title_of(axes, "Pocket load, N (rear down)")
    grid_lines(axes)
    clear_legend(axes, markerscale=5)


def _sliding(axes: "matplotlib.axes.Axes", elements: Any, sliding: dict[str, np.ndarray], element: str) -> None:
    azimuth = np.degrees(np.mod(np.asarray(elements.azimuth) + np.pi, 2.0 * np.pi) - np.pi)
    followed = FOLLOWED % azimuth.shape[1]
    both = {side: values[:, followed] for side, values in sliding.items()}
    unit, factor = axis_unit("m/s", float(max(np.abs(values).max() for values in both.values())))
    for side, values in both.items():
        colour = {"inner": INNER, "outer": OUTER}[side]
        axes.plot(azimuth[:, followed], factor * values, ".", color=colour, markersize=1.5, label=f"{side} race")
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks([-180, -90, 0, 90, 180])
    axes.set_xlabel("azimuth from the load line, deg", fontsize=9)
    title_of(axes, f"Sliding speed of {element} {followed + 1}, {unit}")
    grid_lines(axes)
    clear_legend(axes, markerscale=5)
