"""Ball and tapered roller bearings in a drawing: seen along the axis, and one element in a section through the axis."""

import dataclasses
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import equinox as eqx
import numpy as np

from ..bearings.ball.scene import BallBearing
from ..bearings.operation import LOAD_FIELDS
from ..bearings.solution import TILTS
from ..bearings.tapered.scene import TaperedRollerBearing
from .bearing.section import draw_element
from .drawing import DIMENSION, INK, RING_THICKNESS, dimension, draw_front, first_angle, leader, length_text

if TYPE_CHECKING:
    import matplotlib.figure

_CAPTION = (
    "Names as in --set and in Python; those without a dot belong to geometry. To scale, except for bore, outside "
    "diameter and width\nof the rings, which a scene does not have. The section shows the unloaded bearing, its axis "
    "below."
)
Label = tuple[str, tuple[float, float]]


class _Patches:
    """Draws on axes of matplotlib what `bearing.section` draws."""

    def __init__(self, axes: Any):
        self.axes = axes
        self.points: list[tuple[float, float]] = []

    def polygon(self, points: Any, fill: str, stroke: str, stroke_width: float) -> None:
        x, y = zip(*points, strict=True)
        self.points += points
        self.axes.fill(x, y, facecolor=fill, edgecolor=stroke, linewidth=0.9 * stroke_width)

    def circle(self, centre: Any, radius: float, fill: str, stroke: str, stroke_width: float) -> None:
        from matplotlib.patches import Circle

        style = {"facecolor": fill, "edgecolor": stroke, "linewidth": 0.9 * stroke_width, "zorder": 3}
        self.axes.add_patch(Circle(centre, radius, **style))

    def line(self, points: Any, stroke: str, stroke_width: float, stroke_dasharray: str) -> None:
        dashes = (0, tuple(map(float, stroke_dasharray.split())))
        self.axes.plot(*zip(*points, strict=True), color=stroke, linewidth=stroke_width, linestyle=dashes, zorder=4)


class _Front:
    """See `drawing.FrontSize`."""

    def __init__(self, scene: Any):
        geometry = scene.geometry
        ball = isinstance(scene, BallBearing)
        mm = lambda value: 1e3 * float(value)
        self.counted = "n_balls" if ball else "n_rollers"
        self.count = getattr(geometry, self.counted)
        self.diameter = mm(geometry.ball_diameter if ball else geometry.mean_roller_diameter)
        self.pitch = mm(geometry.pitch_diameter) / 2.0
        self.inner, self.outer = self.pitch - self.diameter / 2.0, self.pitch + self.diameter / 2.0
        self.ring = RING_THICKNESS * self.diameter
        self.step = 2.0 * math.pi / self.count
        self.first = first_angle(geometry)
        between = 2.0 * self.pitch * math.sin(math.pi / max(self.count, 2)) - self.diameter
        self.pocket = min(0.07 * self.diameter, 0.3 * between)
        cage = getattr(scene, "cage", None)
        self.cage = None if cage is None else (mm(cage.bore(geometry)) / 2.0, mm(cage.outside(geometry)) / 2.0)


def draw_in_section(scene: BallBearing | TaperedRollerBearing) -> "matplotlib.figure.Figure":
    """See `drawing.draw_bearing`."""
    from .page import Page

    figure = Page()
    front, section = (figure.add_axes(place) for place in ((0.01, 0.09, 0.47, 0.85), (0.50, 0.34, 0.48, 0.60)))
    for axes, title in ((front, "Seen along the axis"), (section, "One element in a section through the axis")):
        axes.set_aspect("equal", adjustable="box")
        axes.axis("off")
        axes.set_title(title, fontsize=10.5, fontweight="bold", color=INK, pad=4)
    draw_front(front, scene, _Front(scene))
    patches = _Patches(section)
    draw_element(scene, patches, lambda name: _unloaded_angle(scene.geometry))
    labels, said = _ball_labels(section, scene) if isinstance(scene, BallBearing) else _tapered_labels(section, scene)
    _beside(section, np.asarray(patches.points), labels)
    rest = [text for path, text in _dimensions(scene) if path.removeprefix("geometry.") not in said]
    figure.text(0.52, 0.30, "\n".join(rest), fontsize=8.5, color=DIMENSION, va="top", linespacing=1.5)
    figure.text(0.02, 0.02, _CAPTION, fontsize=8, color=INK, linespacing=1.4)
    return figure


def _beside(axes: Any, points: np.ndarray, labels: list[Label]) -> None:
    """Labels on both sides of the section, each as high as what it points at, less crowded."""
    (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
    width, height, middle = right - left, high - low, 0.5 * (left + right)
    for side in (-1.0, 1.0):
        own = sorted((one for one in labels if (one[1][0] >= middle) == (side > 0.0)), key=lambda one: one[1][1])
        places = np.linspace(low + 0.1 * height, high - 0.1 * height, len(own)) if len(own) > 1 else [low]
        x = right + 0.1 * width if side > 0.0 else left - 0.1 * width
        for (text, target), y in zip(own, places, strict=True):
            leader(axes, (x, float(y)), text, target, ha="left" if side > 0.0 else "right")
    axes.set_xlim(left - 0.95 * width, right + 0.95 * width)
    axes.set_ylim(low - 0.08 * height, high + 0.08 * height)


def _unloaded_angle(geometry: Any) -> float:
    """Angle of the unloaded contacts, rad; 0 for a bearing with clearance, in the middle of its play."""
    return 0.0 if geometry.contact_angle is None else float(geometry.contact_angle)


def _ball_labels(axes: Any, scene: BallBearing) -> tuple[list[Label], set[str]]:
    """Labels of the section, and the fields that it and the view along the axis name."""
    geometry = scene.geometry
    half, angle = 500.0 * float(geometry.ball_diameter), _unloaded_angle(geometry)
    dimension(axes, (-half, 0.0), (half, 0.0))
    given = dict(_dimensions(scene))
    point = lambda sign, at: (sign * half * math.sin(at), sign * half * math.cos(at))
    labels = [
        (given["geometry.ball_diameter"], (-0.6 * half, 0.0)),
        (given["geometry.conformity_outer"], point(1.0, angle - 0.5)),
        (given["geometry.conformity_inner"], point(-1.0, angle - 0.5)),
    ]
    said = {"n_balls", "pitch_diameter", "ball_diameter", "conformity_inner", "conformity_outer"}
    if "geometry.contact_angle" in given:
        labels.append((given["geometry.contact_angle"], (0.5 * point(1.0, angle)[0], 0.5 * point(1.0, angle)[1])))
        said.add("contact_angle")
    return labels, said


def _tapered_labels(axes: Any, scene: TaperedRollerBearing) -> tuple[list[Label], set[str]]:
    geometry = scene.geometry
    mm = lambda value: 1e3 * float(np.asarray(value))
    cup, cone = float(geometry.contact_angle), float(np.asarray(geometry.cone_angle))
    big, small = mm(geometry.apex_distance), mm(geometry.apex_distance) - mm(geometry.roller_length)
    on = lambda angle, reach: (-reach * math.cos(angle), reach * math.sin(angle))
    between = lambda a, b, part: (a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]))
    dimension(axes, on(cone, big), on(cup, big))
    dimension(axes, on(cup, big), on(cup, small))
    ends = on(cone, big), on(cup, big)
    places = {
        "roller_diameter": between(*ends, 0.7),
        "roller_length": on(cup, big - 0.4 * (big - small)),
        "contact_angle": on(cup, big - 0.75 * (big - small)),
        "roller_half_angle": on(0.5 * (cup + cone), small),
        "flange_angle": between(*ends, 0.06),
        "end_radius": between(*ends, 0.4),
    }
    given = dict(_dimensions(scene))
    return [(given[f"geometry.{name}"], place) for name, place in places.items()], {"n_rollers", *places}


_ANGLES = ("angle",)
_PLAIN = ("conformity", "fraction")


def _dimensions(scene: Any) -> Iterator[tuple[str, str]]:
    """Path of each number of geometry and cage, and of the loads that the view does not show, and the text for it."""
    for table in ("geometry", "cage"):
        part = getattr(scene, table, None)
        for field in () if part is None else dataclasses.fields(part):
            value = getattr(part, field.name)
            if value is None or isinstance(value, str | eqx.Module):
                continue
            name = field.name if table == "geometry" else f"{table}.{field.name}"
            note = " (on the diameter)" if field.name == "guiding_clearance" else ""
            yield f"{table}.{field.name}", f"{name} {_value(field.name, value)}{note}"
    for freedom, name in LOAD_FIELDS.items():
        load, tilts = scene.operation.load(freedom), freedom in TILTS
        unit, scale = ("N m", 1.0) if tilts else ("kN", 1e-3)
        if freedom not in ("radial", "lateral") and load is not None:
            yield f"operation.{name}", f"operation.{name} {scale * float(load):.6g} {unit}, on the inner ring"


def _value(name: str, value: Any) -> str:
    if isinstance(value, int):
        return str(value)
    if any(word in name for word in _ANGLES):
        return f"{math.degrees(float(value)):.4g} deg"
    if any(word in name for word in _PLAIN):
        return f"{float(value):.5g}"
    return length_text(value)
