"""A run in motion: rolling elements, cage and rings to scale but for their clearances, with the loads between them."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ....bearings.cylindrical.scene import CylindricalRollerBearing
from ....bearings.motion.history import History
from ....bearings.parts import azimuths
from ...backends.matplotlib.animations import instants, moving, moving_head
from ...colours import INK, INNER, OUTER
from ...panels import round_up
from ..azimuth import place_at
from ..operation import load_angle

if TYPE_CHECKING:
    import matplotlib.animation

_CLEARANCE_SHOWN = 0.3
"""Half the pocket clearance as drawn, over the gap between neighbouring rollers."""
_LEAST_POCKET_LOAD = 1.0
"""N: from here on the colours of pocket loads go by the logarithm."""


class _Picture(NamedTuple):
    """Drawing of one instant: places in mm on a page with the load line downwards."""

    rollers: np.ndarray
    bars: np.ndarray | None
    inner_ring: np.ndarray
    cage: np.ndarray
    load_inner: np.ndarray
    load_outer: np.ndarray
    pocket: np.ndarray | None


def exaggeration(scene: CylindricalRollerBearing) -> float:
    """Factor on clearances, positions of rollers in their pockets and offsets of cage and inner ring."""
    geometry = scene.geometry
    if scene.cage is None:
        return 1.0
    gap = float(geometry.pitch_diameter) * math.pi / geometry.n_rollers - float(geometry.roller_diameter)
    factor = _CLEARANCE_SHOWN * gap / (0.5 * float(scene.cage.pocket_clearance))
    return max(1.0, math.floor(factor) if factor < 10.0 else 5.0 * math.floor(factor / 5.0))


def animate(history: History, scene: CylindricalRollerBearing, title: str) -> "matplotlib.animation.FuncAnimation":
    """Evenly spaced instants of a run as moving pictures; pocket loads are the largest since the picture before."""
    from matplotlib.figure import Figure

    chosen = np.unique(instants(0, history.time.shape[0] - 1, history.time.shape[0]).round().astype(int))
    factor = exaggeration(scene)
    pictures = [_picture(history, scene, at, since, factor) for since, at in zip([0, *chosen], chosen, strict=False)]
    figure = Figure(figsize=(8.4, 8.0), facecolor="white")
    update = _draw(figure, scene, history, pictures, chosen, title, factor)
    return moving(figure, update, len(pictures))


def _on_page(radius: Any, azimuth: Any) -> np.ndarray:
    """Azimuth 0 downwards, counter-clockwise."""
    return np.stack(place_at(azimuth, radius), axis=-1)


def _picture(history: History, scene: CylindricalRollerBearing, at: int, since: int, factor: float) -> _Picture:
    instants, geometry = history.instants, scene.geometry
    pitch = 1e3 * float(geometry.pitch_radius)
    elements, count = instants.elements, geometry.n_rollers
    places = np.asarray(azimuths(geometry, count))
    azimuth, bars, cage = np.asarray(elements.azimuth)[at], None, np.zeros(2)
    if instants.cage is not None:
        # the middle of each pocket; X lies a quarter turn behind the load line
        turned = float(instants.frame_angle[at]) + float(instants.state_cage[at, 2]) * 1e3 / pitch
        azimuth = places + turned + factor * (azimuth - places - turned)
        # half way between two rollers
        bars = places + math.pi / count + turned
        cage = 1e3 * factor * np.array([-float(instants.cage.x[at]), -float(instants.cage.y[at])])
    ring = instants.ring
    shift = 1e3 * factor * np.array([float(ring.lateral[at]), -float(ring.radial[at])])
    pocket = None
    if instants.pocket_peaks is not None:
        window = slice(min(since + 1, at), at + 1)
        front, rear = (np.asarray(getattr(instants.pocket_peaks, f))[window].max(axis=0) for f in ("front", "rear"))
        pocket = np.where(front > rear, front, -rear)
    return _Picture(
        rollers=_on_page(pitch, azimuth),
        bars=bars,
        inner_ring=shift,
        cage=cage,
        load_inner=np.asarray(elements.load_inner)[at],
        load_outer=np.asarray(elements.load_outer)[at],
        pocket=pocket,
    )


def _draw(
    figure: Any,
    scene: CylindricalRollerBearing,
    history: History,
    pictures: list[_Picture],
    chosen: np.ndarray,
    title: str,
    factor: float,
) -> Callable[[int], Any]:
    """Draws all that stands still, and returns the function that moves the rest."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import EllipseCollection, LineCollection
    from matplotlib.colors import SymLogNorm
    from matplotlib.patches import Circle

    geometry = scene.geometry
    diameter = 1e3 * float(geometry.roller_diameter)
    inner, outer = 1e3 * float(geometry.inner_radius), 1e3 * float(geometry.outer_radius)
    most = max(max(float(p.load_inner.max()), float(p.load_outer.max())) for p in pictures)
    bar = 0.3 * inner
    size = outer + 3.0 + bar
    axes = figure.add_axes((0.01, 0.01, 0.86, 0.89))
    axes.set_aspect("equal")
    axes.set_xlim(-size, size)
    axes.set_ylim(-size, size)
    axes.axis("off")
    axes.add_patch(Circle((0.0, 0.0), outer, fill=False, edgecolor=INK, linewidth=1.4))
    ring = axes.add_patch(Circle((0.0, 0.0), inner, fill=False, edgecolor=INK, linewidth=1.4))
    along = _on_page(inner, load_angle(scene.operation) or 0.0)
    style: dict[str, Any] = {"ha": "center", "fontsize": 9, "arrowprops": {"arrowstyle": "->"}}
    axes.annotate("load", tuple(0.25 * along), tuple(-0.1 * along), **style)
    scale = bar / round_up(most)
    peak = max((float(np.abs(p.pocket).max()) for p in pictures if p.pocket is not None), default=0.0)
    norm = SymLogNorm(_LEAST_POCKET_LOAD, vmin=-round_up(peak), vmax=round_up(peak))
    rollers = EllipseCollection(
        diameter,
        diameter,
        0.0,
        units="xy",
        offsets=pictures[0].rollers,
        offset_transform=axes.transData,
        edgecolors=INK,
        linewidths=0.5,
        facecolors="#DDDDDD",
        cmap="RdBu_r",
        norm=norm,
    )
    axes.add_collection(rollers)
    bars = LineCollection([], colors="#B8860B", linewidths=2.4)
    loads = [LineCollection([], colors=colour, linewidths=3.0) for colour in (INNER, OUTER)]
    for lines in (bars, *loads):
        axes.add_collection(lines)
    if peak > 0.0:
        place = figure.add_axes((0.88, 0.2, 0.02, 0.5))
        figure.colorbar(ScalarMappable(norm, "RdBu_r"), cax=place)
        place.tick_params(labelsize=8)
        place.set_title("pocket, N\n+ front\n- rear", fontsize=8, loc="left")
    words = "all to scale" if factor == 1.0 else f"to scale, but clearances and offsets x {factor:g}"
    words += f"; longest bar {round_up(most):.4g} N: blue on the inner race, red on the outer"
    clock = moving_head(figure, title, words)
    time, cage = 1e3 * np.asarray(history.time), history.instants.cage
    first_bar, last_bar = 1e3 * _cage_radii(scene)

    def update(number: int) -> list[Any]:
        now, at = pictures[number], chosen[number]
        rollers.set_offsets(now.rollers)
        if now.pocket is not None:
            rollers.set_array(now.pocket)
        ring.center = tuple(now.inner_ring)
        if now.bars is not None:
            bars.set_segments([*np.stack([_on_page(r, now.bars) + now.cage for r in (first_bar, last_bar)], axis=1)])
        azimuth = np.arctan2(now.rollers[:, 0], -now.rollers[:, 1])
        for lines, values, base, sign in ((loads[0], now.load_inner, inner, -1), (loads[1], now.load_outer, outer, 1)):
            ends = [_on_page(base + sign * (1.5 + scale * part * values), azimuth) for part in (0.0, 1.0)]
            lines.set_segments([*np.stack(ends, axis=1)])
        text = f"{time[at]:8.3f} ms"
        if cage is not None:
            text += f"     cage slip {100.0 * float(cage.slip[at]):.3g} %"
        clock.set_text(text)
        return [rollers, bars, ring, *loads, clock]

    return update


def _cage_radii(scene: CylindricalRollerBearing) -> np.ndarray:
    """Bore and outside radius of the cage, m."""
    if scene.cage is None:
        return np.zeros(2)
    return 0.5 * np.array([float(scene.cage.bore(scene.geometry)), float(scene.cage.outside(scene.geometry))])
