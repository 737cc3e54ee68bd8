"""A bearing seen along its axis, with its dimensions."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from ....bearings.bearing import AbstractBearing
from ....bearings.operation import LOAD_FIELDS
from ...colours import CAGE, CENTRE_LINE, INK, RING, ROLLER
from ..azimuth import place_at
from ..operation import field_text
from .marks import LOAD, arc, dimension, length_text, note
from .sizes import FrontSizes

if TYPE_CHECKING:
    import matplotlib.axes


def draw_front(axes: "matplotlib.axes.Axes", scene: AbstractBearing, size: FrontSizes) -> None:
    from matplotlib.patches import Circle

    outside = size.outside
    bore = size.bore
    everyone = range(size.count)
    ring_outline(axes, size.outer, outside, RING)
    ring_outline(axes, bore, size.inner, RING)
    draw_bars(axes, size, everyone, size.first)
    draw_rollers(axes, size, everyone, size.first)
    centre_line = {"edgecolor": CENTRE_LINE, "linestyle": (0, (6, 3, 1, 3)), "linewidth": 0.8}
    axes.add_patch(Circle((0.0, 0.0), size.pitch, fill=False, zorder=4, **centre_line))
    left, right = place_at(-0.5 * math.pi, size.pitch), place_at(0.5 * math.pi, size.pitch)
    dimension(axes, left, right)
    note(axes, (0.0, 0.0), f"pitch_diameter {length_text(scene.geometry.pitch_diameter)}")
    note(axes, (0.0, 0.33 * bore), f"{size.counted} {size.count}")

    style = {"color": LOAD, "linewidth": 2.4, "arrowstyle": "-|>,head_width=0.4,head_length=0.8"}
    loads = {name: scene.operation.load(name) for name in ("radial", "lateral")}
    values = {name: float(load) for name, load in loads.items() if load is not None}
    fields = [LOAD_FIELDS[name] for name in values]
    texts = [f"operation.{field}\n{field_text(scene.operation, field)}" for field in fields]
    if texts:
        radial, lateral = (values.get(name, 0.0) for name in loads)
        along = bore * np.array([lateral, -radial]) / (math.hypot(radial, lateral) or 1.0)
        axes.annotate("", xy=tuple(0.97 * along), xytext=tuple(0.5 * along), arrowprops=style, zorder=6)
        note(axes, (0.0, -0.33 * bore), "\n".join(texts) + ", on the inner ring", color=LOAD)
    speed = f"operation.inner_speed\n{field_text(scene.operation, 'inner_speed')}"
    note(axes, (0.0, 0.68 * bore), speed)
    arc(axes, size.inner - 0.5 * size.ring, math.radians(135.0), math.radians(225.0))

    arc(axes, 1.05 * outside, 0.0, math.radians(42.0))
    x, y = place_at(math.radians(45.0), 1.07 * outside)
    note(axes, (x, y), "azimuth", ha="left", va="center")
    note(axes, place_at(size.first, 1.10 * outside), "element 0", color=INK)
    axes.set_xlim(-1.12 * outside, 1.22 * outside)
    axes.set_ylim(-1.16 * outside, 1.06 * outside)


def ring_outline(axes: "matplotlib.axes.Axes", inside: float, outside: float, colour: str) -> None:
    from matplotlib.patches import Annulus

    axes.add_patch(Annulus((0.0, 0.0), outside, outside - inside, facecolor=colour, edgecolor=INK, linewidth=0.9))


def draw_bars(axes: "matplotlib.axes.Axes", size: FrontSizes, indices: Iterable[int], first: float) -> None:
    """Draws the cage bar that follows each roller in `indices`. **Arguments:** `first`: azimuth of roller 0, rad."""
    if size.cage is None:
        return
    radius = np.linspace(*size.cage, 30)
    wall = np.arcsin(np.minimum((size.diameter / 2.0 + size.pocket) / radius, 1.0))
    angles = np.concatenate([wall, (size.step - wall)[::-1]])
    for i in indices:
        x, y = place_at(first + i * size.step + angles, np.concatenate([radius, radius[::-1]]))
        axes.fill(x, y, facecolor=CAGE, edgecolor=INK, linewidth=0.6, zorder=2)


def draw_rollers(axes: "matplotlib.axes.Axes", size: FrontSizes, indices: Iterable[int], first: float) -> None:
    from matplotlib.patches import Circle

    for i in indices:
        centre = place_at(first + i * size.step, size.pitch)
        axes.add_patch(Circle(centre, size.diameter / 2.0, facecolor=ROLLER, edgecolor=INK, linewidth=0.9, zorder=3))
