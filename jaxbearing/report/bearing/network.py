"""The thermal network of a bearing as a diagram: temperatures in boxes, heat along arrows."""

import math
from collections.abc import Iterator
from typing import Any

from ...thermal.result import ThermalResult
from ..colours import CAGE, CURVES, LOSS, ROLLER
from ..diagrams import LETTER, TEXT, Arrow, Box, Diagram, Place
from ..display import ZERO_CELSIUS, with_unit

HEAT, OIL = CURVES[1], CURVES[0]
"""Colours of the heat flows between nodes and of the oil flow."""
PLACES: dict[str, Place] = {
    "shaft": (0.0, 0.0),
    "inner_ring": (160.0, 0.0),
    "elements": (320.0, 0.0),
    "bearing": (320.0, 0.0),
    "outer_ring": (480.0, 0.0),
    "housing": (640.0, 0.0),
    "oil": (320.0, 125.0),
}
"""Centre of the box of each node, points: a row from shaft to housing, with the oil above it."""
MIDDLE = PLACES["elements"][0]
WIDE, HIGH = 90.0, 44.0
"""Width and height of the box of a node, points."""
AMBIENT = -115.0
"""Vertical position of the ambient relative to the row of nodes, points."""
BESIDE = 26.0
"""Horizontal distance between a vertical arrow and the middle of its text, points."""
THICKEST, THINNEST = 9.0, 0.75
"""Width of the arrow with the largest heat, and smallest width of an arrow, points."""
WITHOUT_LOSSES = ("shaft", "housing")
ROUND_OFF = 1e-9
"""Fraction of the largest heat below which the loss of a node is only round-off, and gets no arrow."""
_UPRIGHT = 32.0
"""Horizontal distance from the middle of a box to the vertical arrows on either side, points."""


def network_diagram(thermal: ThermalResult) -> Diagram:
    """Draws the nodes with their temperatures and, as arrows, the losses and all heat flows.

    **Arguments:** `thermal`: thermal result of one converged solution.
    """
    watts = {pair: float(flow) for pair, flow in thermal.paths().items()}
    losses = {node: float(heat) for node, heat in thermal.losses().items() if node not in WITHOUT_LOSSES}
    flows_oil = thermal.oil_out is not None
    to_oil = float(thermal.heat_to_oil)
    largest = max(map(abs, (*watts.values(), *losses.values(), *([to_oil] if flows_oil else []))))
    scale = THICKEST / largest if largest > 0.0 else 0.0
    boxes = [*_nodes(thermal), _ambient(thermal, watts)]
    arrows = [
        *(_between(pair, heat, scale) for pair, heat in watts.items()),
        *(_loss(node, heat, scale) for node, heat in losses.items() if abs(heat) > ROUND_OFF * largest),
    ]
    if flows_oil:
        more, inlet_outlet = _oil(thermal, to_oil, scale)
        boxes, arrows = [*boxes, *more], [*arrows, *inlet_outlet]
    across = [box.centre[0] + side * box.width / 2.0 for box in boxes for side in (-1.0, 1.0)]
    top = max(box.centre[1] for box in boxes) + HIGH / 2.0 + 56.0
    return Diagram(
        name="network",
        title="Temperatures and heat flows",
        caption=_caption(thermal, sum(losses.values())),
        boxes=boxes,
        arrows=arrows,
        low=(min(across) - 6.0, AMBIENT - 18.0),
        high=(max(across) + 6.0, top),
    )


def _caption(thermal: ThermalResult, total: float) -> str:
    heat = float(thermal.heat_to_oil)
    flows_oil = thermal.oil_out is not None
    oil = "" if not flows_oil else f"the oil that flows through {_carries(heat)}, and "
    blue = "Blue: the oil that flows through, with the heat that it takes away or brings. " if flows_oil else ""
    return (
        f"{_watts(total)} of losses heat the nodes; {oil}{_watts(float(thermal.heat_to_ambient))} go to the ambient. "
        "Blue-grey: the part of the losses that heats each node. Orange: heat that flows to the colder end. "
        f"{blue}Arrow widths are proportional to the heat, down to a smallest width that still can be seen."
    )


def _carries(heat: float) -> str:
    """Text that says how much heat, W, the oil takes away or, below 0, brings."""
    return f"{'takes' if heat >= 0.0 else 'brings'} {_watts(abs(heat))}"


def _nodes(thermal: ThermalResult) -> Iterator[Box]:
    for node in thermal.nodes:
        text = f"{node.replace('_', ' ')}\n{_degrees(getattr(thermal.temperatures, node))}"
        yield Box(PLACES[node], WIDE, HIGH, text, **({"fill": CAGE} if node == "oil" else {}))


def _ambient(thermal: ThermalResult, watts: dict[tuple[str, str], float]) -> Box:
    """Bar of the ambient, below all nodes from which heat flows to it."""
    above = [PLACES[first][0] for first, second in watts if second == "ambient"] or [MIDDLE]
    width = max(above) - min(above) + WIDE + 60.0
    centre = 0.5 * (max(above) + min(above)), AMBIENT
    return Box(centre, width, 24.0, f"ambient {_degrees(thermal.ambient)}", ROLLER)


def _between(pair: tuple[str, str], heat: float, scale: float) -> Arrow:
    """Arrow of the heat along a path, from the warmer to the colder end."""
    first, second = pair
    x, y = PLACES[first]
    text, width = _watts(abs(heat)), _width(heat, scale)
    if second == "ambient":
        # the arrow for the loss of a ring comes from below too
        x += 0.0 if first == "bearing" else _UPRIGHT
        start, end, at = (x, y - HIGH / 2.0), (x, AMBIENT + 12.0), (x + BESIDE, 0.5 * (AMBIENT - 5.0))
    elif second == "neighbours":
        start, end, at = (x, y + HIGH / 2.0), (x, y + 2.0 * HIGH), (x, y + 2.0 * HIGH + 12.0)
        text = f"{text}, neighbours"
    elif second == "oil":
        start, end = (x, y + HIGH / 2.0), _oil_side(x)
        at = (x + BESIDE, 0.5 * (start[1] + end[1])) if x == MIDDLE else _beside(start, end, text, width)
    else:
        other = PLACES[second][0]
        side = 1.0 if other > x else -1.0
        start, end = (x + side * WIDE / 2.0, y), (other - side * WIDE / 2.0, y)
        at = (0.5 * (x + other), y + 15.0)
    if heat < 0.0:
        start, end = end, start
    return Arrow(start, end, text, at, width, HEAT)


def _beside(start: Place, end: Place, text: str, width: float) -> Place:
    """Centre of the text beside the middle of a slanting arrow: above arrows from shaft and housing, below the others,
    so that nothing else is covered."""
    x, y = end[0] - start[0], end[1] - start[1]
    length = math.hypot(x, y)
    across, along = abs(y) / length, abs(x) / length
    away = 0.5 * (LETTER * TEXT * len(text) * across + TEXT * along + width) + 3.0
    above = abs(start[0] - MIDDLE) > abs(PLACES["outer_ring"][0] - MIDDLE)
    outwards = 1.0 if (start[0] > MIDDLE) == above else -1.0
    middle = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
    return middle[0] + outwards * across * away, middle[1] + (1.0 if above else -1.0) * along * away


def _oil_side(x: float) -> Place:
    """The point where the arrow from a node at `x` meets the box of the oil: farther out for more distant nodes."""
    oil_x, oil_y = PLACES["oil"]
    away = (x - oil_x) / (PLACES["outer_ring"][0] - oil_x)
    if abs(away) > 1.0:
        return oil_x + (1.0 if away > 0.0 else -1.0) * WIDE / 2.0, oil_y - 8.0
    return oil_x + away * 0.4 * WIDE, oil_y - HIGH / 2.0


def _loss(node: str, heat: float, scale: float) -> Arrow:
    """Arrow of the losses that heat a node: from above for the oil and a single-node bearing, from below for the
    others."""
    x, y = PLACES[node]
    side = 1.0 if node in ("oil", "bearing") else -1.0
    x -= 0.0 if side > 0.0 else _UPRIGHT * 0.7
    near, far = y + side * HIGH / 2.0, y + side * (HIGH / 2.0 + 34.0)
    start, end = ((x, far), (x, near)) if heat >= 0.0 else ((x, near), (x, far))
    return Arrow(start, end, f"loss {_watts(heat)}", (x, far + side * 9.0), _width(heat, scale), LOSS)


def _oil(thermal: ThermalResult, heat: float, scale: float) -> tuple[list[Box], list[Arrow]]:
    """Boxes and arrows of the oil, which enters on the left of the node that contains it and leaves on the right, with
    the heat that it takes."""
    x, y = PLACES["oil" if "oil" in thermal.nodes else thermal.nodes[0]]
    y += 10.0
    away, edge, beside = 170.0, WIDE / 2.0, 32.0
    boxes = [
        Box((x - away, y), 2.0 * beside, HIGH, f"oil in\n{_degrees(thermal.oil_in)}", "none"),
        Box((x + away, y), 2.0 * beside, HIGH, f"oil out\n{_degrees(thermal.oil_out)}", "none"),
    ]
    start, end = x + edge, x + away - beside
    inlet = Arrow((x - away + beside, y), (x - edge, y), "", (x, y), THINNEST, OIL)
    taken = Arrow((start, y), (end, y), _carries(heat), (0.5 * (start + end), y + 18.0), _width(heat, scale), OIL)
    return boxes, [inlet, taken]


def _width(heat: float, scale: float) -> float:
    return max(THINNEST, scale * abs(heat))


def _degrees(value: Any) -> str:
    return f"{float(value) - ZERO_CELSIUS:.1f} °C"


def _watts(heat: float) -> str:
    return with_unit(heat, "W", 3)
