"""Animation of a transient run: rolling elements, cage and rings to scale except for clearances, with the loads between
them.

It serves every family with a motion model: it uses only sizes that all bearings have, and leaves out results that a
family does not have, such as loads or a cage."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ....bearings.motion.family import AbstractMovingBearing
from ....bearings.motion.history import CAGE_ANGLE, History
from ....bearings.parts import azimuths
from ...backends.matplotlib.animations import instants, moving, moving_head
from ...colours import INK, INNER, OUTER
from ...panels import round_up
from ..azimuth import place_at
from ..operation import load_angle
from .json_report import by_side

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.artist
    import matplotlib.figure

_CLEARANCE_SHOWN = 0.3
"""Half the pocket clearance as drawn, as a fraction of the gap between neighbouring rolling elements."""
_LEAST_POCKET_LOAD = 1.0
"""Pocket load above which the colour scale is logarithmic, N."""


class _Picture(NamedTuple):
    """Data of the picture of one instant: positions in mm, with the load line pointing down."""

    elements: np.ndarray
    bars: np.ndarray | None
    inner_ring: np.ndarray
    cage: np.ndarray
    loads: dict[str, np.ndarray]
    pocket: np.ndarray | None


def exaggeration(scene: AbstractMovingBearing) -> float:
    """Factor by which clearances, offsets of elements in their pockets, and offsets of cage and inner ring are
    enlarged."""
    if scene.cage is None:
        return 1.0
    gap = float(scene.geometry.pitch_diameter) * math.pi / scene.n_elements - float(scene.element_diameter)
    factor = _CLEARANCE_SHOWN * gap / (0.5 * float(scene.cage.pocket_clearance))
    return max(1.0, math.floor(factor) if factor < 10.0 else 5.0 * math.floor(factor / 5.0))


def animate(history: History, scene: AbstractMovingBearing, title: str) -> "matplotlib.animation.FuncAnimation":
    """Animation of evenly spaced instants of a run; pocket loads are the largest since the previous picture."""
    from matplotlib.figure import Figure

    chosen = np.unique(instants(0, history.time.shape[0] - 1, history.time.shape[0]).round().astype(int))
    factor = exaggeration(scene)
    pictures = [_picture(history, scene, at, since, factor) for since, at in zip([0, *chosen], chosen, strict=False)]
    figure = Figure(figsize=(7.4, 7.05), facecolor="white")
    update = _draw(figure, scene, history, pictures, chosen, title, factor)
    return moving(figure, update, len(pictures))


def _on_page(radius: object, azimuth: object) -> np.ndarray:
    """Positions at a radius and azimuths: azimuth 0 points down, positive counter-clockwise."""
    return np.stack(place_at(azimuth, radius), axis=-1)


def _picture(history: History, scene: AbstractMovingBearing, at: int, since: int, factor: float) -> _Picture:
    instants, count = history.instants, scene.n_elements
    pitch = 500.0 * float(scene.geometry.pitch_diameter)
    elements = instants.elements
    places = np.asarray(azimuths(scene.geometry, count))
    azimuth, bars, cage = np.asarray(elements.azimuth)[at], None, np.zeros(2)
    if instants.cage is not None and CAGE_ANGLE in instants.cage_state:
        # the middle of each pocket; X lies a quarter turn behind the load line
        angle = float(instants.state_cage[at, instants.cage_state.index(CAGE_ANGLE)])
        turned = float(instants.frame_angle[at]) + angle * 1e3 / pitch
        azimuth = places + turned + factor * (azimuth - places - turned)
        # half way between two elements
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
        elements=_on_page(pitch, azimuth),
        bars=bars,
        inner_ring=shift,
        cage=cage,
        loads={side: values[at] for side, values in by_side(elements, "load").items()},
        pocket=pocket,
    )


def _draw(
    figure: Any,
    scene: AbstractMovingBearing,
    history: History,
    pictures: list[_Picture],
    chosen: np.ndarray,
    title: str,
    factor: float,
) -> "Callable[[int], list[matplotlib.artist.Artist]]":
    """Draws everything that stands still, and returns the function that updates the rest."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import EllipseCollection, LineCollection
    from matplotlib.colors import SymLogNorm
    from matplotlib.patches import Circle

    diameter = 1e3 * float(scene.element_diameter)
    inner, outer = (500.0 * float(race) for race in scene.raceway_diameters)
    most = max((float(load.max()) for p in pictures for load in p.loads.values()), default=0.0)
    bar = 0.3 * inner
    size = outer + 3.0 + bar
    axes = figure.add_axes((0.01, 0.01, 0.85, 0.84))
    axes.set_aspect("equal")
    axes.set_xlim(-size, size)
    axes.set_ylim(-size, size)
    axes.axis("off")
    axes.add_patch(Circle((0.0, 0.0), outer, fill=False, edgecolor=INK, linewidth=1.4))
    ring = axes.add_patch(Circle((0.0, 0.0), inner, fill=False, edgecolor=INK, linewidth=1.4))
    along = _on_page(inner, load_angle(scene.operation) or 0.0)
    style: dict[str, Any] = {
        "ha": "center",
        "fontsize": 10,
        "color": INK,
        "arrowprops": {"arrowstyle": "-|>", "linewidth": 1.8},
    }
    axes.annotate("load", tuple(0.25 * along), tuple(-0.1 * along), **style)
    scale = bar / round_up(most) if most > 0.0 else 0.0
    peak = max((float(np.abs(p.pocket).max()) for p in pictures if p.pocket is not None), default=0.0)
    norm = SymLogNorm(_LEAST_POCKET_LOAD, vmin=-round_up(peak), vmax=round_up(peak))
    drawn = EllipseCollection(
        diameter,
        diameter,
        0.0,
        units="xy",
        offsets=pictures[0].elements,
        offset_transform=axes.transData,
        edgecolors=INK,
        linewidths=0.5,
        facecolors="#DDDDDD",
        cmap="RdBu_r",
        norm=norm,
    )
    axes.add_collection(drawn)
    bars = LineCollection([], colors="#B8860B", linewidths=2.4)
    raceways = {"inner": (inner, -1, INNER), "outer": (outer, 1, OUTER)}
    loads = {side: LineCollection([], colors=raceways[side][2], linewidths=3.0) for side in pictures[0].loads}
    for lines in (bars, *loads.values()):
        axes.add_collection(lines)
    if peak > 0.0:
        place = figure.add_axes((0.875, 0.2, 0.022, 0.48))
        powers = [10.0**power for power in range(1 + math.floor(math.log10(max(round_up(peak), 1.0))))]
        ticks = [*(-power for power in reversed(powers)), 0.0, *powers]
        figure.colorbar(ScalarMappable(norm, "RdBu_r"), cax=place, ticks=ticks, format="%g")
        place.minorticks_off()
        place.tick_params(labelsize=9)
        place.set_title("pocket\nload, N\n+ front\n\N{MINUS SIGN} rear", fontsize=9, loc="left")
    words = "all to scale" if factor == 1.0 else f"to scale, but clearances and offsets x {factor:g}"
    if most > 0.0:
        words += f"; longest bar {round_up(most):.4g} N: blue on the inner race, red on the outer"
    clock = moving_head(figure, title, words)
    time, cage = 1e3 * np.asarray(history.time), history.instants.cage
    first_bar, last_bar = 1e3 * _cage_radii(scene)

    def update(number: int) -> "list[matplotlib.artist.Artist]":
        now, at = pictures[number], chosen[number]
        drawn.set_offsets(now.elements)
        if now.pocket is not None:
            drawn.set_array(now.pocket)
        ring.center = tuple(now.inner_ring)
        if now.bars is not None:
            bars.set_segments([*np.stack([_on_page(r, now.bars) + now.cage for r in (first_bar, last_bar)], axis=1)])
        azimuth = np.arctan2(now.elements[:, 0], -now.elements[:, 1])
        for side, values in now.loads.items():
            base, sign, _ = raceways[side]
            ends = [_on_page(base + sign * (1.5 + scale * part * values), azimuth) for part in (0.0, 1.0)]
            loads[side].set_segments([*np.stack(ends, axis=1)])
        text = f"{time[at]:8.3f} ms"
        if cage is not None:
            text += f"     cage slip {100.0 * float(cage.slip[at]):.3g} %"
        clock.set_text(text)
        return [drawn, bars, ring, *loads.values(), clock]

    return update


def _cage_radii(scene: AbstractMovingBearing) -> np.ndarray:
    """Inner and outer radius of the cage, m."""
    if scene.cage is None:
        return np.zeros(2)
    return 0.5 * np.array([float(scene.cage.bore(scene.geometry)), float(scene.cage.outside(scene.geometry))])
