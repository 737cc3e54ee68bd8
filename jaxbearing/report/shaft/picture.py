"""Pictures of a shaft to scale in a plane through its axis, with bearings, gears, forces and bending line.

A picture is a list of shapes in millimetres, x along the shaft and y across it, which each backend draws in its own
way.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...bearings.bearing import AbstractBearing
from ...shafts.forces import Gear
from ...shafts.mounting import LinearBearing
from ...shafts.scene import Place, ShaftSystem
from ...shafts.solution import ShaftSolution
from ..colours import CENTRE_LINE, CURVES, FAINT, INK, RING, ROLLER
from ..display import digits, with_unit
from .bending import PLANES, bending_line

Point = tuple[float, float]

SHAFT, GEAR = "#E8EBEF", "#F3E6C8"
"""Fill colours of the shaft, and of gears, pulleys and masses."""
LINE, FORCE, REACTION = CURVES[0], CURVES[1], CURVES[2]
"""Colours of the bending line, of forces on the shaft, and of forces of its bearings."""
_LONGEST = 0.3
"""Length of the longest arrow, relative to the largest diameter drawn; the largest deflection is at most half of it."""
_DISK = 0.12
"""Drawn width of a gear, pulley or mass relative to the length of the shaft; a scene does not give the width."""
_LEAST = 0.01
"""Length of an arrow relative to the longest one, up to which it is not drawn."""


@dataclass(frozen=True)
class Area:
    """A closed polygon."""

    points: Sequence[Point]
    fill: str
    edge: str = INK
    width: float = 1.0


@dataclass(frozen=True)
class Stroke:
    """A line through points."""

    points: Sequence[Point]
    colour: str
    width: float = 1.0
    dash: str = "solid"


@dataclass(frozen=True)
class Pointer:
    """An arrow for a force; `value`: the force, N."""

    start: Point
    end: Point
    colour: str
    value: float


@dataclass(frozen=True)
class Words:
    """A text at a given place."""

    place: Point
    text: str
    colour: str = INK
    anchor: str = "middle"


Item = Area | Stroke | Pointer | Words


@dataclass(frozen=True)
class Picture:
    """One view of a shaft. `title`: plane of the view; `caption`: scales of the arrows and the bending line."""

    title: str
    caption: str
    items: Sequence[Item]
    height: float


def pictures(scene: ShaftSystem, solution: ShaftSolution) -> list[Picture]:
    """The view in the plane X-Y, and that in X-Z if bearings carry forces along Z."""
    across = np.abs(np.array([np.asarray(bearing.on_shaft)[1:3] for bearing in solution.bearings.values()]))
    lateral = float(np.max(across[:, 1])) > 1e-6 * max(float(np.max(across)), 1e-300)
    return [_picture(scene, solution, plane) for plane in ((0, 1) if lateral else (0,))]


def _picture(scene: ShaftSystem, solution: ShaftSolution, plane: int) -> Picture:
    name, across, _ = PLANES[plane]
    radius = _outer_radius(scene)
    start, end = _ends(scene)
    loads = list(_loads(scene, solution, across))
    largest = max((abs(value) for *_, value in loads), default=0.0)
    longest = _LONGEST * 2.0 * radius
    items: list[Item] = [*_disks(scene, end - start), *_shaft(scene, start, end)]
    for place in scene.places:
        items += _bearing(place, 1e3 * float(place.position))
    items.append(Stroke([(start - 5.0, 0.0), (end + 5.0, 0.0)], CENTRE_LINE, 0.8, "dashdot"))
    line, factor = _bent(solution, plane, 0.5 * longest)
    items += line
    items += _arrows(loads, largest, longest, radius, 0.16 * (end - start))
    if plane == 0:
        items += _axial_arrows(scene, solution, longest, radius)
    scales = (
        f"Arrows: {with_unit(largest, 'N')} for the longest; axial ones at a scale of their own. " if largest else ""
    )
    if factor:
        scales += f"Bending line {digits(factor, 3)} times as large as it is. "
    disks = "Widths of gears, pulleys and masses are not to scale. " if scene.forces else ""
    rings = "Rings at usual proportions, clearances drawn closed."
    return Picture(f"Plane X-{name}, {name} upwards", f"{scales}{disks}{rings}", items, 2.0 * (radius + longest))


def _ends(scene: ShaftSystem) -> tuple[float, float]:
    """Ends of the shaft, mm; a rigid shaft ends a little beyond its outermost bearing or force."""
    if scene.shaft.sections:
        return 0.0, 1e3 * float(scene.shaft.length)
    at = [1e3 * float(place.position) for place in scene.places] + [
        1e3 * float(force.position) for force in scene.forces
    ]
    room = max(0.15 * (max(at) - min(at)), 0.6 * _outer_radius(scene))
    return min(at) - room, max(at) + room


def _outer_radius(scene: ShaftSystem) -> float:
    """Largest radius of sections, bearings and gears, mm."""
    radii = [500.0 * float(section.outer_diameter) for section in scene.shaft.sections]
    radii += [_outside(place.scene) for place in scene.places]
    radii += [1e3 * float(force.pitch_radius) for force in scene.forces if isinstance(force, Gear)]
    return max(radii)


def _outside(bearing: AbstractBearing | LinearBearing) -> float:
    if not isinstance(bearing, AbstractBearing):
        return 15.0
    pitch = 500.0 * float(bearing.geometry.pitch_diameter)
    return pitch + max(y for ring in bearing.outline().rings for _, y in ring)


def _shaft(scene: ShaftSystem, start: float, end: float) -> Iterator[Item]:
    if not scene.shaft.sections:
        inside = min(_inside(place.scene) for place in scene.places)
        yield Area([(start, -inside), (end, -inside), (end, inside), (start, inside)], SHAFT, FAINT)
        return
    x = 0.0
    for section in scene.shaft.sections:
        right, outer = x + 1e3 * float(section.length), 500.0 * float(section.outer_diameter)
        inner = 500.0 * float(section.inner_diameter)
        yield Area([(x, -outer), (right, -outer), (right, outer), (x, outer)], SHAFT)
        if inner:
            yield Area([(x, -inner), (right, -inner), (right, inner), (x, inner)], "#FFFFFF", FAINT, 0.8)
        x = right


def _inside(bearing: AbstractBearing | LinearBearing) -> float:
    """Drawn radius of the bore of a bearing, mm."""
    if not isinstance(bearing, AbstractBearing):
        return 8.0
    pitch = 500.0 * float(bearing.geometry.pitch_diameter)
    return pitch + min(y for ring in bearing.outline().rings for _, y in ring)


def _bearing(place: Place, x: float) -> Iterator[Item]:
    """Both halves of a bearing in section, mirrored if its axis points along -X."""
    if not isinstance(place.scene, AbstractBearing):
        yield from (Area([(x - 4.0, y), (x + 4.0, y), (x, y * 0.6)], RING) for y in (-15.0, 15.0))
        return
    outline = place.scene.outline()
    pitch = 500.0 * float(place.scene.geometry.pitch_diameter)
    for side in (1.0, -1.0):
        moved = lambda point, side=side: (x + place.sense * point[0], side * (pitch + point[1]))
        for ring in outline.rings:
            yield Area([moved(point) for point in ring], RING, INK, 0.8)
        yield Area([moved(point) for point in outline.element or _circle(outline.diameter)], ROLLER, INK, 0.8)
        yield Stroke([moved(point) for point in outline.line], FAINT, 0.8)


def _circle(diameter: float) -> list[Point]:
    angles = np.linspace(0.0, 2.0 * np.pi, 37)[:-1]
    return [(0.5 * diameter * math.cos(angle), 0.5 * diameter * math.sin(angle)) for angle in angles]


def _disks(scene: ShaftSystem, length: float) -> Iterator[Item]:
    """Gears, pulleys and masses, drawn behind the shaft."""
    for disk in sorted(scene.forces, key=lambda force: force.kind != "gear"):
        if disk.kind == "point":
            continue
        x, half = 1e3 * float(disk.position), 0.5 * _DISK * length
        radius = 1e3 * float(disk.pitch_radius) if isinstance(disk, Gear) else 0.6 * _outer_radius(scene)
        half = min(half, 0.6 * radius) * (0.7 if disk.kind == "mass" else 1.0)
        yield Area([(x - half, -radius), (x + half, -radius), (x + half, radius), (x - half, radius)], GEAR, FAINT)


def _loads(scene: ShaftSystem, solution: ShaftSolution, across: int) -> Iterator[tuple[float, str, str, float]]:
    """Position, mm, name, colour and force, N, of each external force and bearing; `across`: index of the direction."""
    nodes = solution.shaft
    at, loads = np.asarray(nodes.position, dtype=float), np.asarray(nodes.load, dtype=float)
    for position, names in _named_positions(scene).items():
        here = np.isclose(at, position, rtol=0.0, atol=1e-9)
        yield 1e3 * position, names, FORCE, float(np.sum(loads[here, across]))
    for place in scene.places:
        value = np.asarray(solution.bearings[place.name].on_shaft)[across]
        yield 1e3 * float(place.position), place.name, REACTION, float(value)


def _named_positions(scene: ShaftSystem) -> dict[float, str]:
    """Position, m, -> names of the forces that act there."""
    places: dict[float, list[str]] = {}
    for force in scene.forces:
        places.setdefault(round(float(force.position), 12), []).append(force.name)
    return {position: ", ".join(names) for position, names in places.items()}


def _arrows(
    loads: list[tuple[float, str, str, float]], largest: float, longest: float, radius: float, room: float
) -> Iterator[Item]:
    """Transverse arrows that end at the distance `radius` from the axis, with names and forces.

    **Arguments:** `room`: least distance of two texts at the same height, mm; closer ones are staggered.
    """
    line = 0.28 * radius
    levels: dict[float, list[tuple[float, float]]] = {1.0: [], -1.0: []}
    for x, name, colour, value in sorted(loads, key=lambda load: load[0]):
        length = longest * abs(value) / largest if largest else 0.0
        sign = math.copysign(1.0, value)
        if length > _LEAST * longest:
            # an arrow starts outside and points at the shaft
            yield Pointer((x, -sign * (radius + length)), (x, -sign * radius), colour, value)
        height = radius + length + 0.7 * line
        near = [level for place, level in levels[sign] if abs(place - x) < room]
        while any(abs(level - height) < line for level in near):
            height += 0.5 * line
        levels[sign].append((x, height))
        text = f"{name}\n{digits(abs(value))} N" if largest else name
        yield Words((x, -sign * height), text, colour)


def _axial_arrows(scene: ShaftSystem, solution: ShaftSolution, longest: float, radius: float) -> Iterator[Item]:
    """Arrows of the axial forces, close to the axis: external forces above it, forces of the bearings below."""
    loads = [(x, colour, value, name) for x, name, colour, value in _loads(scene, solution, 0)]
    largest = max((abs(value) for _, _, value, _ in loads), default=0.0)
    for x, colour, value, _ in loads:
        length = longest * abs(value) / largest if largest else 0.0
        if length > _LEAST * longest:
            y = 0.12 * radius if colour == FORCE else -0.12 * radius
            reach = math.copysign(length, value)
            yield Pointer((x, y), (x + reach, y), colour, value)


def _bent(solution: ShaftSolution, plane: int, size: float) -> tuple[list[Item], float]:
    """Bending line and its magnification; an empty list and 0 if the shaft does not move in this plane."""
    line = bending_line(solution)
    values = line.across[plane]
    largest = float(np.max(np.abs(values)))
    if not largest > 0.0:
        return [], 0.0
    exact = size / (1e3 * largest)
    step = 10.0 ** math.floor(math.log10(exact))
    factor = next(part * step for part in (5.0, 2.0, 1.0) if part * step <= exact)
    points = [(1e3 * float(x), factor * 1e3 * float(y)) for x, y in zip(line.position, values, strict=True)]
    return [Stroke(points, LINE, 2.2)], factor
