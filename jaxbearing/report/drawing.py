"""A drawing of a bearing that shows what each dimension of its scene is.

To scale, but for the clearances: they are micrometres beside millimetres, so each is drawn at one visible size and its
true value stands beside it. Bore, outside diameter and width of the rings are no part of a scene and are drawn at
usual proportions.
"""

import math
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ..bearings.bearing import AbstractBearing
from ..bearings.cylindrical.scene import CylindricalRollerBearing
from ..bearings.operation import LOAD_FIELDS
from ..bearings.outline import RING_THICKNESS
from .bearing.operation import field_text
from .display import displayed

if TYPE_CHECKING:
    import matplotlib.figure

INK, DIMENSION, LOAD, FAINT = "#222222", "#0072B2", "#D55E00", "#8A8A8A"
RING, ROLLER, CAGE = "#CDD3DB", "#F6F7F9", "#E6CB8B"
_FONT = 8.5
_DRAWN_CLEARANCE = 0.07
"""A clearance in the drawing, in roller diameters."""
_CAPTION = (
    "Names as in --set and in Python; those without a dot belong to geometry. To scale, except for the clearances (all "
    "drawn at one visible\nsize, true values beside them) and for bore, outside diameter and width of the rings, which "
    "a scene does not have."
)


def draw_bearing(scene: Any) -> "matplotlib.figure.Figure":
    """A bearing seen along its axis and in a section through the axis; of a cylindrical roller bearing one roller and
    its pocket too.

    Every dimension that the scene has is marked, or listed beside the drawing, with its field name and value.

    **Raises:** `TypeError` for something else than a bearing.
    """
    from .page import Page

    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"draw_bearing draws a bearing, got a {type(scene).__name__}")
    if not isinstance(scene, CylindricalRollerBearing):
        from .section_drawing import draw_in_section

        return draw_in_section(scene)
    figure = Page()
    size = _Size(scene)
    for draw, title, place in (
        (draw_front, "Seen along the axis", (0.01, 0.09, 0.47, 0.85)),
        (_draw_pocket, "One roller outside the loaded zone", (0.50, 0.54, 0.49, 0.40)),
        (_draw_section, "Section through the axis, upper half", (0.478, 0.07, 0.50, 0.42)),
    ):
        axes = figure.add_axes(place)
        axes.set_aspect("equal", adjustable="box")
        axes.axis("off")
        axes.set_title(title, fontsize=10.5, fontweight="bold", color=INK, pad=4)
        draw(axes, scene, size)
    figure.text(0.02, 0.02, _CAPTION, fontsize=8, color=INK, linespacing=1.4)
    return figure


class FrontSize(Protocol):
    """Dimensions of a bearing seen along its axis, mm, and how many elements it has."""

    pitch: float
    diameter: float
    inner: float
    outer: float
    ring: float
    step: float
    first: float
    pocket: float
    cage: tuple[float, float] | None
    count: int
    counted: str


class _Size:
    """Dimensions of the drawing, mm."""

    def __init__(self, scene: CylindricalRollerBearing):
        geometry, cage = scene.geometry, scene.cage
        mm = lambda value: 1e3 * float(value)
        self.pitch, self.diameter, self.length = (
            mm(geometry.pitch_radius),
            mm(geometry.roller_diameter),
            mm(geometry.roller_length),
        )
        self.inner, self.outer = mm(geometry.inner_radius), mm(geometry.outer_radius)
        self.loaded = min(mm(geometry.loaded_length), self.length)
        self.gap = _DRAWN_CLEARANCE * self.diameter
        self.ring = RING_THICKNESS * self.diameter
        self.step = 2.0 * math.pi / geometry.n_rollers
        self.first = first_angle(geometry)
        between = 2.0 * self.pitch * math.sin(math.pi / max(geometry.n_rollers, 2)) - self.diameter
        self.pocket = min(self.gap, 0.3 * between)
        self.cage = None if cage is None else (mm(cage.bore(geometry)) / 2.0, mm(cage.outside(geometry)) / 2.0)
        self.land = 0.0 if cage is None else mm(cage.land_width)
        self.half_width = self.length / 2.0 + max(0.35 * self.length, 2.0 * self.gap + self.land)
        flange = scene.flange
        self.rim = 0.0 if flange is None else mm(flange.rim_height(geometry))
        self.count, self.counted = geometry.n_rollers, "n_rollers"


def first_angle(geometry: Any) -> float:
    """Azimuth of the first rolling element, rad."""
    return 0.0 if geometry.first_element_angle is None else float(geometry.first_element_angle)


def length_text(value: Any) -> str:
    metres = float(value)
    return f"{1e3 * metres:.6g} mm" if abs(metres) >= 1e-3 else f"{1e6 * metres:.4g} µm"


def _point(azimuth: Any, radius: Any) -> tuple[Any, Any]:
    """Azimuth 0 is below, counter-clockwise."""
    return radius * np.sin(azimuth), -radius * np.cos(azimuth)


def _ring_outline(axes: Any, inside: float, outside: float, colour: str) -> None:
    from matplotlib.patches import Annulus

    axes.add_patch(Annulus((0.0, 0.0), outside, outside - inside, facecolor=colour, edgecolor=INK, linewidth=0.9))


def _draw_bars(axes: Any, size: FrontSize, indices: Any, first: float) -> None:
    """Cage bars between the pockets, after rollers of these numbers; `first`: azimuth of number 0."""
    if size.cage is None:
        return
    radius = np.linspace(*size.cage, 30)
    wall = np.arcsin(np.minimum((size.diameter / 2.0 + size.pocket) / radius, 1.0))
    angles = np.concatenate([wall, (size.step - wall)[::-1]])
    for i in indices:
        x, y = _point(first + i * size.step + angles, np.concatenate([radius, radius[::-1]]))
        axes.fill(x, y, facecolor=CAGE, edgecolor=INK, linewidth=0.6, zorder=2)


def _draw_rollers(axes: Any, size: FrontSize, indices: Any, first: float) -> None:
    from matplotlib.patches import Circle

    for i in indices:
        centre = _point(first + i * size.step, size.pitch)
        axes.add_patch(Circle(centre, size.diameter / 2.0, facecolor=ROLLER, edgecolor=INK, linewidth=0.9, zorder=3))


def dimension(axes: Any, start: Any, end: Any) -> None:
    style = {"arrowstyle": "<|-|>,head_width=0.18,head_length=0.42", "color": DIMENSION, "linewidth": 1.0}
    axes.annotate("", xy=end, xytext=start, arrowprops=style | {"shrinkA": 0, "shrinkB": 0}, zorder=6)


def _extension(axes: Any, *points: Any) -> None:
    axes.plot(*zip(*points, strict=True), color=DIMENSION, linewidth=0.6, zorder=5)


def _text(axes: Any, place: Any, text: str, **style: Any) -> None:
    halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.0}
    style = {"ha": "center", "va": "center", "color": DIMENSION, "fontsize": _FONT, "bbox": halo, "zorder": 7} | style
    axes.text(*place, text, linespacing=1.25, **style)


def leader(axes: Any, place: Any, text: str, target: Any, **style: Any) -> None:
    _text(axes, place, text, **style)
    arrow = {"arrowstyle": "-|>,head_width=0.16,head_length=0.38", "color": DIMENSION, "linewidth": 0.9, "shrinkB": 0}
    axes.annotate("", xy=target, xytext=place, arrowprops=arrow | {"shrinkA": 3}, zorder=6)


def draw_front(axes: Any, scene: Any, size: FrontSize) -> None:
    from matplotlib.patches import Circle

    outside = size.outer + size.ring
    bore = size.inner - size.ring
    everyone = range(size.count)
    _ring_outline(axes, size.outer, outside, RING)
    _ring_outline(axes, bore, size.inner, RING)
    _draw_bars(axes, size, everyone, size.first)
    _draw_rollers(axes, size, everyone, size.first)
    centre_line = {"edgecolor": FAINT, "linestyle": (0, (6, 3, 1, 3)), "linewidth": 0.8}
    axes.add_patch(Circle((0.0, 0.0), size.pitch, fill=False, zorder=4, **centre_line))
    left, right = _point(-0.5 * math.pi, size.pitch), _point(0.5 * math.pi, size.pitch)
    dimension(axes, left, right)
    _text(axes, (0.0, 0.0), f"pitch_diameter {length_text(scene.geometry.pitch_diameter)}")
    _text(axes, (0.0, 0.33 * bore), f"{size.counted} {size.count}")

    style = {"color": LOAD, "linewidth": 2.4, "arrowstyle": "-|>,head_width=0.4,head_length=0.8"}
    loads = {name: scene.operation.load(name) for name in ("radial", "lateral")}
    given = {name: float(load) for name, load in loads.items() if load is not None}
    fields = [LOAD_FIELDS[name] for name in given]
    said = [f"operation.{field}\n{field_text(scene.operation, field)}" for field in fields]
    if said:
        radial, lateral = (given.get(name, 0.0) for name in loads)
        along = bore * np.array([lateral, -radial]) / (math.hypot(radial, lateral) or 1.0)
        axes.annotate("", xy=tuple(0.97 * along), xytext=tuple(0.5 * along), arrowprops=style, zorder=6)
        _text(axes, (0.0, -0.33 * bore), "\n".join(said) + ", on the inner ring", color=LOAD)
    speed = f"operation.inner_speed\n{field_text(scene.operation, 'inner_speed')}"
    _text(axes, (0.0, 0.68 * bore), speed)
    _arc(axes, size.inner - 0.5 * size.ring, math.radians(135.0), math.radians(225.0))

    _arc(axes, 1.05 * outside, 0.0, math.radians(42.0))
    x, y = _point(math.radians(45.0), 1.07 * outside)
    _text(axes, (x, y), "azimuth", ha="left", va="center")
    _text(axes, _point(size.first, 1.10 * outside), "element 0", color=INK)
    axes.set_xlim(-1.12 * outside, 1.22 * outside)
    axes.set_ylim(-1.16 * outside, 1.06 * outside)


def _arc(axes: Any, radius: float, start: float, end: float) -> None:
    angles = np.linspace(start, end, 60)
    x, y = _point(angles, radius)
    axes.plot(x[:-2], y[:-2], color=DIMENSION, linewidth=1.2, zorder=6)
    arrow = {"arrowstyle": "-|>,head_width=0.22,head_length=0.5", "color": DIMENSION, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=(x[-1], y[-1]), xytext=(x[-4], y[-4]), arrowprops=arrow, zorder=6)


def _draw_pocket(axes: Any, scene: CylindricalRollerBearing, size: _Size) -> None:
    """The roller that is farthest from the load, above, drawn as number 0 of a bearing turned round."""
    geometry, diameter = scene.geometry, size.diameter
    _ring_outline(axes, size.outer, size.outer + diameter, RING)
    _ring_outline(axes, size.inner - size.gap - diameter, size.inner - size.gap, RING)
    _draw_bars(axes, size, (-2, -1, 0, 1), 0.0)
    _draw_rollers(axes, size, (-2, -1, 0, 1, 2), 0.0)
    # turned: what is at azimuth 0 is above
    axes.set_ylim(-(size.inner - size.gap - 0.55 * diameter), -(size.outer + 0.55 * diameter))
    axes.set_xlim(1.75 * diameter, -1.75 * diameter)
    pitch = -size.pitch
    dimension(axes, (-diameter / 2.0, pitch), (diameter / 2.0, pitch))
    _text(axes, (0.0, pitch + 0.17 * diameter), f"roller_diameter\n{length_text(geometry.roller_diameter)}")
    below = -(size.inner - size.gap - 0.3 * diameter)
    clearance = f"diametral_clearance {length_text(geometry.diametral_clearance)}\n(of the bearing; half of it here)"
    leader(axes, (0.0, below), clearance, (0.0, -(size.inner - 0.5 * size.gap)))
    above = -(size.outer + 0.28 * diameter)
    _text(axes, (1.45 * diameter, above), "outer ring", color=INK, bbox=None)
    _text(axes, (0.85 * diameter, below), "inner ring", color=INK, bbox=None)
    if scene.cage is not None:
        assert size.cage is not None
        gap = diameter / 2.0 + 0.5 * size.pocket
        text = f"cage.pocket_clearance {length_text(scene.cage.pocket_clearance)}\n(front and rear together)"
        place = (-0.75 * diameter, above)
        leader(axes, place, text, (-gap, -0.5 * (size.cage[1] + size.pitch)))
        place, bar = (0.75 * diameter, above), _point(0.5 * size.step, 0.5 * size.cage[1] + 0.5 * size.pitch)
        leader(axes, place, "cage", bar, color=INK)


def _draw_section(axes: Any, scene: CylindricalRollerBearing, size: _Size) -> None:
    diameter, half = size.diameter, size.length / 2.0
    inner_top, outer_top = _shoulders(scene, size)
    for sign, race, top in ((1.0, size.outer, outer_top), (-1.0, size.inner, inner_top)):
        back = race + sign * size.ring
        x = [-size.half_width, -half - size.gap, -half - size.gap]
        y = [top, top, race]
        x, y = [*x, *(-v for v in x[::-1])], [*y, *y[::-1]]
        axes.fill([*x, size.half_width, -size.half_width], [*y, back, back], facecolor=RING, edgecolor=INK, lw=0.9)
    _draw_roller_outline(axes, size)
    if size.cage is not None:
        for side in (-1.0, 1.0):
            rail = side * (half + size.gap), side * (half + size.gap + size.land)
            x = [rail[0], rail[1], rail[1], rail[0]]
            axes.fill(x, np.repeat(size.cage, 2), facecolor=CAGE, edgecolor=INK, linewidth=0.9, zorder=3)
    _label_section(axes, scene, size, inner_top, outer_top)
    axes.set_xlim(-size.half_width - 1.6 * diameter, size.half_width + 1.75 * diameter)
    axes.set_ylim(size.inner - size.ring - 0.55 * diameter, size.outer + size.ring + 0.4 * diameter)


def _shoulders(scene: CylindricalRollerBearing, size: _Size) -> tuple[float, float]:
    """Radii of inner and outer ring beside the rollers: land of the cage, flange, or the raceway going on."""
    flange, cage = scene.flange, scene.cage
    inner = size.inner + (size.rim if flange is not None and flange.ring in ("inner", "both") else 0.0)
    outer = size.outer - (size.rim if flange is not None and flange.ring in ("outer", "both") else 0.0)
    if cage is not None and size.cage is not None:
        if cage.guidance == "inner_ring":
            inner = size.cage[0] - size.gap
        else:
            outer = size.cage[1] + size.gap
    return inner, outer


def _draw_roller_outline(axes: Any, size: _Size) -> None:
    """With the corners that carry no load; their depth is drawn visible."""
    half, flat, radius = size.length / 2.0, size.loaded / 2.0, size.diameter / 2.0
    corner = min(half - flat, 0.12 * size.diameter)
    x = np.array([-half, -flat, flat, half, half, flat, -flat, -half])
    y = np.array([radius - corner, radius, radius, radius - corner, corner - radius, -radius, -radius, corner - radius])
    axes.fill(x, size.pitch + y, facecolor=ROLLER, edgecolor=INK, linewidth=0.9, zorder=3)


def _label_section(axes: Any, scene: CylindricalRollerBearing, size: _Size, inner_top: float, outer_top: float) -> None:
    geometry, cage, flange = scene.geometry, scene.cage, scene.flange
    half, diameter = size.length / 2.0, size.diameter
    low = size.inner - size.ring - 0.25 * diameter
    for x in (-half, half):
        _extension(axes, (x, size.pitch - 0.4 * diameter), (x, low - 0.06 * diameter))
    dimension(axes, (-half, low), (half, low))
    _text(axes, (0.0, low - 0.2 * diameter), f"roller_length {length_text(geometry.roller_length)}")
    if geometry.contact_length is not None:
        dimension(axes, (-size.loaded / 2.0, size.pitch), (size.loaded / 2.0, size.pitch))
        _text(axes, (0.0, size.pitch + 0.19 * diameter), f"contact_length\n{length_text(geometry.contact_length)}")
    left: list[tuple[str, tuple[float, float]]] = []
    right: list[tuple[str, tuple[float, float]]] = []
    if flange is not None:
        race, top = (size.outer, outer_top) if flange.ring == "outer" else (size.inner, inner_top)
        x = -0.5 * (half + size.gap + size.half_width)
        said = "" if flange.height is not None else " (assumed)"
        left += [
            (
                f"flange.axial_clearance {length_text(flange.axial_clearance)}\n(both ends together)",
                (-half - 0.5 * size.gap, 0.6 * race + 0.4 * top),
            ),
            (f"flange.height {length_text(flange.rim_height(geometry))}{said}", (x, 0.5 * (race + top))),
        ]
        _extension(axes, (x - 0.05 * diameter, race), (-half - size.gap, race))
        dimension(axes, (x, race), (x, top))
        if float(flange.angle) > 0.0:
            angle = f"flange.angle {displayed(float(flange.angle), 'rad'):.4g} deg\n(of its face)"
            left.append((angle, (-half - size.gap, race)))
    if cage is not None and size.cage is not None:
        middle = half + size.gap + 0.5 * size.land
        end = half + size.gap + size.land
        inside = cage.guidance == "inner_ring"
        land = 0.5 * (inner_top + size.cage[0]) if inside else 0.5 * (outer_top + size.cage[1])
        bore, outside = (length_text(2e-3 * radius) for radius in size.cage)
        given = lambda value: "" if value is not None else " (assumed)"
        right += [
            (f"cage.guiding_clearance {length_text(cage.guiding_clearance)}\n(on the diameter)", (end, land)),
            (
                f"cage.outer_diameter {outside}{given(cage.outer_diameter)}",
                (middle, size.cage[1]),
            ),
            (
                f"cage.inner_diameter {bore}{given(cage.inner_diameter)}",
                (middle, size.cage[0]),
            ),
        ]
        if cage.pocket_axial_clearance is not None:
            text = f"cage.pocket_axial_clearance\n{length_text(cage.pocket_axial_clearance)} (both ends together)"
            left.append((text, (-half - 0.5 * size.gap, size.pitch)))
        high = size.outer + size.ring + 0.2 * diameter
        for x in (half + size.gap, end):
            _extension(axes, (x, size.cage[1]), (x, high + 0.06 * diameter))
        dimension(axes, (half + size.gap, high), (end, high))
        _text(axes, (end + 0.08 * diameter, high), f"cage.land_width {length_text(cage.land_width)}", ha="left")
    for labels, side in ((left, -1.0), (right, 1.0)):
        _stack(axes, size, labels, side)


def _stack(axes: Any, size: _Size, labels: list[tuple[str, tuple[float, float]]], side: float) -> None:
    """Labels beside the section, one above the other in the order of what they point at."""
    labels = sorted(labels, key=lambda label: label[1][1])
    low, high = size.inner - 0.45 * size.ring, size.outer + 0.45 * size.ring
    places = np.linspace(low, high, len(labels)) if len(labels) > 1 else np.full(len(labels), size.pitch)
    x = side * (size.half_width + 0.12 * size.diameter)
    for (text, target), y in zip(labels, places, strict=True):
        leader(axes, (x, float(y)), text, target, ha="left" if side > 0.0 else "right")
