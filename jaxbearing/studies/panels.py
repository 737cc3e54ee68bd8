"""Variations of the power-loss study: panels of one or two fields round the scene's own operating point.

The values are those of the source's section 4.2 for its roller bearing (its Figures 36 to 40). For another bearing
speed, load, flow and clearances keep their ratio to the scene's own values; temperatures stay as they are.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._scene import AbstractScene
from ..bearings.ball.scene import BallBearing
from ..bearings.bearing import AbstractBearing

SPEED, FLOW, TEMPERATURE = "operation.inner_speed", "operation.oil_flow", "operation.oil_temperature"
RADIAL, AXIAL_LOAD = "operation.radial_load", "operation.axial_load"
DRAG, CLEARANCE, GUIDING = "drag.coefficient", "geometry.diametral_clearance", "cage.guiding_clearance"
AXIAL, ANGLE = "flange.axial_clearance", "flange.angle"
CONTACT_ANGLE, CONFORMITY = "geometry.contact_angle", "geometry.conformity_inner"

SPEEDS = tuple(rpm / 10500.0 for rpm in (2500.0, 5000.0, 10500.0, 14000.0, 20000.0))
FLOWS = tuple(litres / 150.0 for litres in (0.0, 50.0, 100.0, 150.0, 200.0, 300.0))
LOADS = tuple(kn / 25.0 for kn in (0.001, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 25.0, 40.0))
HEAVY = tuple(kn / 25.0 for kn in (5.0, 8.0, 16.0, 25.0, 40.0))
CELSIUS = (60.0, 80.0, 100.0, 140.0, 200.0)
CLEARANCES = tuple(um / 30.0 for um in (-20.0, 0.0, 30.0, 60.0, 100.0))
GUIDINGS = tuple(um / 480.0 for um in (120.0, 240.0, 480.0, 640.0))
AXIALS = (0.5, 1.0, 2.0)
ANGLES = tuple(degrees / 0.375 for degrees in (0.1, 0.375, 0.75))

GAPS = 10
"""Least number of gaps between the points of a curve: none is wider than this part of the axis, so that no curve has a
kink for want of points."""


@dataclass(frozen=True)
class Panel:
    """Cases of one figure. `values`: dotted path -> SI values along its axis; the first field is the horizontal axis, a
    second one has a curve for each value."""

    name: str
    title: str
    values: dict[str, np.ndarray]


def own(scene: AbstractScene, path: str) -> float | None:
    """The scene's own value of a field; `None` where it or its part is not there."""
    value: Any = scene
    for name in path.split("."):
        value = getattr(value, name, None)
    return None if value is None or np.ndim(value) != 0 else float(value)


def scaled(scene: AbstractBearing, path: str, factors: Sequence[float] | np.ndarray) -> np.ndarray:
    nominal = own(scene, path)
    return np.asarray(factors) * (math.nan if nominal is None else nominal)


def temperatures() -> np.ndarray:
    return np.asarray(CELSIUS) + 273.15


def panels_of(scene: AbstractBearing) -> tuple[list[Panel], list[str]]:
    """The panels that a scene can have, and a sentence for each that is left out."""
    wanted = _ball(scene) if isinstance(scene, BallBearing) else _roller(scene)
    kept, left_out = [], []
    for panel in wanted:
        lacking = [path for path, values in panel.values.items() if not np.all(np.isfinite(values))]
        flat = [path for path, values in panel.values.items() if path not in lacking and np.ptp(values) == 0.0]
        if lacking:
            left_out.append(f"{panel.name} ({panel.title}): the scene has no {lacking[0]}")
        elif flat:
            left_out.append(f"{panel.name} ({panel.title}): {flat[0]} is zero in the scene")
        else:
            (along, values), *curves = panel.values.items()
            kept.append(Panel(panel.name, panel.title, {along: refined(values), **dict(curves)}))
    return kept, left_out


def refined(values: np.ndarray) -> np.ndarray:
    """The values, which are not all the same, and as many evenly between two neighbours as `GAPS` asks for; nearer to a
    first value of 0, where losses may begin with a vertical slope, two more."""
    distinct = np.unique(values)
    widest = np.ptp(distinct) / GAPS
    counts = [max(1, math.ceil((1.0 - 1e-9) * gap / widest)) for gap in np.diff(distinct)]
    between = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(distinct, distinct[1:], counts, strict=False)]
    finer = np.concatenate([*between, distinct[-1:]])
    return finer if finer[0] != 0.0 else np.concatenate([finer[:1], finer[1] * np.array([1.0 / 16.0, 0.25]), finer[1:]])


def _operating(scene: AbstractBearing, load: str) -> list[Panel]:
    panel = lambda name, title, values: Panel(
        name, title, {p: v if isinstance(v, np.ndarray) else scaled(scene, p, v) for p, v in values.items()}
    )
    return [
        panel("36", "total against oil flow and speed", {FLOW: FLOWS, SPEED: SPEEDS}),
        panel("37", "total against speed and load", {SPEED: SPEEDS, load: HEAVY}),
        panel("38", "total against oil temperature and speed", {TEMPERATURE: temperatures(), SPEED: SPEEDS[:4]}),
        panel("39a", "by location against oil flow", {FLOW: FLOWS}),
        panel("39b", "by location against speed", {SPEED: SPEEDS}),
    ]


def _panel(scene: AbstractBearing, name: str, title: str, path: str, factors: Sequence[float]) -> Panel:
    return Panel(name, title, {path: scaled(scene, path, factors)})


def _roller(scene: AbstractBearing) -> list[Panel]:
    return [
        *_operating(scene, RADIAL),
        _panel(scene, "39c", "by location against radial load", RADIAL, LOADS),
        _panel(scene, "40a", "by location against diametral clearance", CLEARANCE, CLEARANCES),
        _panel(scene, "40b", "by location against guiding clearance of the cage", GUIDING, GUIDINGS),
        _panel(scene, "40c", "by location against axial clearance of the flanges", AXIAL, AXIALS),
        _panel(scene, "40d", "by location against flange angle", ANGLE, ANGLES),
    ]


def _ball(scene: AbstractBearing) -> list[Panel]:
    axial, radial = own(scene, AXIAL_LOAD), own(scene, RADIAL)
    load, other = (AXIAL_LOAD, RADIAL) if (axial or 0.0) >= (radial or 0.0) else (RADIAL, AXIAL_LOAD)
    # a load that the scene does not name is no unknown's business: with it the bearing would be another program
    beside = np.linspace(0.0, 0.3, 4) * (math.nan if own(scene, other) is None else own(scene, load) or 0.0)
    conformity = own(scene, CONFORMITY)
    conformities = np.array([0.51, 0.515, 0.52, 0.53, 0.54]) if conformity is not None else np.array([math.nan])
    angle = own(scene, CONTACT_ANGLE)
    return [
        *_operating(scene, load),
        _panel(scene, "39c", f"by location against {load.split('.')[1].replace('_', ' ')}", load, HEAVY),
        Panel("39d", f"by location against {other.split('.')[1].replace('_', ' ')}", {other: beside}),
        Panel(
            "40a",
            "by location against contact angle",
            {CONTACT_ANGLE: scaled(scene, CONTACT_ANGLE, (0.8, 0.9, 1.0, 1.1, 1.2))},
        )
        if angle is not None
        else Panel(
            "40a", "by location against diametral clearance", {CLEARANCE: scaled(scene, CLEARANCE, (0.5, 1.0, 2.0))}
        ),
        Panel("40b", "by location against conformity of the inner race", {CONFORMITY: conformities}),
        _panel(scene, "40c", "by location against guiding clearance of the cage", GUIDING, GUIDINGS),
    ]
