"""Drawing of a cylindrical roller bearing: a view along the axis, one roller in its pocket, and a section."""

from typing import TYPE_CHECKING, SupportsFloat

import numpy as np

from ....bearings.cylindrical.scene import CylindricalRollerBearing
from ...colours import CAGE, INK, RING, ROLLER
from ...display import displayed, with_unit
from ..azimuth import place_at
from .front import draw_bars, draw_front, draw_rollers, ring_outline
from .marks import dimension, extension, leader, length_text, note
from .sizes import DRAWN_CLEARANCE, FrontSizes, millimetres
from .view import view

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_CAPTION = (
    "Names as in --set and in Python; those without a dot belong to geometry. To scale, except for the clearances (all "
    "drawn at one visible\nsize, true values beside them) and for bore, outside diameter and width of the rings, which "
    "a scene does not have."
)


class _Size(FrontSizes):
    """Dimensions of the drawing, mm."""

    def __init__(self, scene: CylindricalRollerBearing):
        super().__init__(scene)
        geometry, cage, flange = scene.geometry, scene.cage, scene.flange
        self.length = millimetres(geometry.roller_length)
        self.loaded = min(millimetres(geometry.loaded_length), self.length)
        self.gap = DRAWN_CLEARANCE * self.diameter
        self.land = 0.0 if cage is None else millimetres(cage.land_width)
        self.half_width = self.length / 2.0 + max(0.35 * self.length, 2.0 * self.gap + self.land)
        self.rim = 0.0 if flange is None else millimetres(flange.rim_height(geometry))


def draw_cylindrical(scene: CylindricalRollerBearing) -> "matplotlib.figure.Figure":
    """See `report.drawing.draw_bearing`."""
    from ...backends.matplotlib.page import Page

    figure, size = Page(), _Size(scene)
    for draw, title, place in (
        (draw_front, "Seen along the axis", (0.01, 0.09, 0.47, 0.85)),
        (_draw_pocket, "One roller outside the loaded zone", (0.50, 0.54, 0.49, 0.40)),
        (_draw_section, "Section through the axis, upper half", (0.478, 0.07, 0.50, 0.42)),
    ):
        draw(view(figure, title, place), scene, size)
    figure.text(0.02, 0.02, _CAPTION, fontsize=8, color=INK, linespacing=1.4)
    return figure


def _draw_pocket(axes: "matplotlib.axes.Axes", scene: CylindricalRollerBearing, size: _Size) -> None:
    """Draws the roller opposite the load, at the top, as roller 0 of the bearing turned by half a turn."""
    geometry, diameter = scene.geometry, size.diameter
    ring_outline(axes, size.outer, size.outer + diameter, RING)
    ring_outline(axes, size.inner - size.gap - diameter, size.inner - size.gap, RING)
    draw_bars(axes, size, (-2, -1, 0, 1), 0.0)
    draw_rollers(axes, size, (-2, -1, 0, 1, 2), 0.0)
    # turned by half a turn: azimuth 0 is at the top
    axes.set_ylim(-(size.inner - size.gap - 0.55 * diameter), -(size.outer + 0.55 * diameter))
    axes.set_xlim(1.75 * diameter, -1.75 * diameter)
    pitch = -size.pitch
    dimension(axes, (-diameter / 2.0, pitch), (diameter / 2.0, pitch))
    note(axes, (0.0, pitch + 0.17 * diameter), f"roller_diameter\n{length_text(geometry.roller_diameter)}")
    below = -(size.inner - size.gap - 0.3 * diameter)
    clearance = f"diametral_clearance {length_text(geometry.diametral_clearance)}\n(of the bearing; half of it here)"
    leader(axes, (0.0, below), clearance, (0.0, -(size.inner - 0.5 * size.gap)))
    above = -(size.outer + 0.28 * diameter)
    note(axes, (1.45 * diameter, above), "outer ring", color=INK, bbox=None)
    note(axes, (0.85 * diameter, below), "inner ring", color=INK, bbox=None)
    if scene.cage is not None:
        assert size.cage is not None
        gap = diameter / 2.0 + 0.5 * size.pocket
        text = f"cage.pocket_clearance {length_text(scene.cage.pocket_clearance)}\n(front and rear together)"
        place = (-0.75 * diameter, above)
        leader(axes, place, text, (-gap, -0.5 * (size.cage[1] + size.pitch)))
        place, bar = (0.75 * diameter, above), place_at(0.5 * size.step, 0.5 * size.cage[1] + 0.5 * size.pitch)
        leader(axes, place, "cage", bar, color=INK)


def _draw_section(axes: "matplotlib.axes.Axes", scene: CylindricalRollerBearing, size: _Size) -> None:
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
    """Radii of the inner and the outer ring beside the rollers: cage land, flange, or continued raceway."""
    flange, cage = scene.flange, scene.cage
    inner = size.inner + (size.rim if flange is not None and flange.ring in ("inner", "both") else 0.0)
    outer = size.outer - (size.rim if flange is not None and flange.ring in ("outer", "both") else 0.0)
    if cage is not None and size.cage is not None:
        if cage.guidance == "inner_ring":
            inner = size.cage[0] - size.gap
        else:
            outer = size.cage[1] + size.gap
    return inner, outer


def _draw_roller_outline(axes: "matplotlib.axes.Axes", size: _Size) -> None:
    """Draws a roller with its unloaded corners, whose depth is exaggerated to be visible."""
    half, flat, radius = size.length / 2.0, size.loaded / 2.0, size.diameter / 2.0
    corner = min(half - flat, 0.12 * size.diameter)
    x = np.array([-half, -flat, flat, half, half, flat, -flat, -half])
    y = np.array([radius - corner, radius, radius, radius - corner, corner - radius, -radius, -radius, corner - radius])
    axes.fill(x, size.pitch + y, facecolor=ROLLER, edgecolor=INK, linewidth=0.9, zorder=3)


def _label_section(
    axes: "matplotlib.axes.Axes", scene: CylindricalRollerBearing, size: _Size, inner_top: float, outer_top: float
) -> None:
    geometry, cage, flange = scene.geometry, scene.cage, scene.flange
    half, diameter = size.length / 2.0, size.diameter
    low = size.inner - size.ring - 0.25 * diameter
    for x in (-half, half):
        extension(axes, (x, size.pitch - 0.4 * diameter), (x, low - 0.06 * diameter))
    dimension(axes, (-half, low), (half, low))
    note(axes, (0.0, low - 0.2 * diameter), f"roller_length {length_text(geometry.roller_length)}")
    if geometry.contact_length is not None:
        dimension(axes, (-size.loaded / 2.0, size.pitch), (size.loaded / 2.0, size.pitch))
        note(axes, (0.0, size.pitch + 0.19 * diameter), f"contact_length\n{length_text(geometry.contact_length)}")
    left: list[tuple[str, tuple[float, float]]] = []
    right: list[tuple[str, tuple[float, float]]] = []
    if flange is not None:
        race, top = (size.outer, outer_top) if flange.ring == "outer" else (size.inner, inner_top)
        x = -0.5 * (half + size.gap + size.half_width)
        remark = "" if flange.height is not None else " (assumed)"
        left += [
            (
                f"flange.axial_clearance {length_text(flange.axial_clearance)}\n(both ends together)",
                (-half - 0.5 * size.gap, 0.6 * race + 0.4 * top),
            ),
            (f"flange.height {length_text(flange.rim_height(geometry))}{remark}", (x, 0.5 * (race + top))),
        ]
        extension(axes, (x - 0.05 * diameter, race), (-half - size.gap, race))
        dimension(axes, (x, race), (x, top))
        if float(flange.angle) > 0.0:
            angle = f"flange.angle {displayed(float(flange.angle), 'rad'):.4g} deg\n(of its face)"
            left.append((angle, (-half - size.gap, race)))
    if geometry.flange_stiffness is not None:
        text = _thrust_text(scene, geometry.flange_stiffness)
        right.append((text, (half + size.gap, size.inner)))
    if cage is not None and size.cage is not None:
        middle = half + size.gap + 0.5 * size.land
        end = half + size.gap + size.land
        inside = cage.guidance == "inner_ring"
        land = 0.5 * (inner_top + size.cage[0]) if inside else 0.5 * (outer_top + size.cage[1])
        bore, outside = (length_text(2e-3 * radius) for radius in size.cage)
        assumed = lambda value: "" if value is not None else " (assumed)"
        right += [
            (f"cage.guiding_clearance {length_text(cage.guiding_clearance)}\n(on the diameter)", (end, land)),
            (
                f"cage.outer_diameter {outside}{assumed(cage.outer_diameter)}",
                (middle, size.cage[1]),
            ),
            (
                f"cage.inner_diameter {bore}{assumed(cage.inner_diameter)}",
                (middle, size.cage[0]),
            ),
        ]
        if cage.pocket_axial_clearance is not None:
            text = f"cage.pocket_axial_clearance\n{length_text(cage.pocket_axial_clearance)} (both ends together)"
            left.append((text, (-half - 0.5 * size.gap, size.pitch)))
        high = size.outer + size.ring + 0.2 * diameter
        for x in (half + size.gap, end):
            extension(axes, (x, size.cage[1]), (x, high + 0.06 * diameter))
        dimension(axes, (half + size.gap, high), (end, high))
        note(axes, (end + 0.08 * diameter, high), f"cage.land_width {length_text(cage.land_width)}", ha="left")
    for labels, side in ((left, -1.0), (right, 1.0)):
        _stack(axes, size, labels, side)


def _thrust_text(scene: CylindricalRollerBearing, stiffness: SupportsFloat) -> str:
    """Text about the flanges that guide the inner ring axially, and about its axial load."""
    geometry, load = scene.geometry, scene.operation.axial_load
    lines = [
        f"flange_gap {length_text(geometry.flange_gap)}, thrust {geometry.thrust or 'both'}",
        f"flange_stiffness\n{with_unit(float(stiffness), 'N/m^(10/9)')}",
        *([] if load is None else [f"operation.axial_load {1e-3 * float(load):.6g} kN"]),
    ]
    return "\n".join(lines)


def _stack(
    axes: "matplotlib.axes.Axes", size: _Size, labels: list[tuple[str, tuple[float, float]]], side: float
) -> None:
    """Stacks labels beside the section, in the order of the heights of the features they mark."""
    labels = sorted(labels, key=lambda label: label[1][1])
    low, high = size.inner - 0.45 * size.ring, size.outer + 0.45 * size.ring
    places = np.linspace(low, high, len(labels)) if len(labels) > 1 else np.full(len(labels), size.pitch)
    x = side * (size.half_width + 0.12 * size.diameter)
    for (text, target), y in zip(labels, places, strict=True):
        leader(axes, (x, float(y)), text, target, ha="left" if side > 0.0 else "right")
