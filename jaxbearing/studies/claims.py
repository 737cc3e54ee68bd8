"""Twelve statements of the source on the power loss of its roller bearing, and what this package computes.

The criteria are ours: the source gives no limits; docs/claims.md discusses them. The ranges are the source's for its
bearing (Tables 13 and 14); for another roller bearing they keep their ratio to the scene's own operating point.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ..bearings.cylindrical.scene import CylindricalRollerBearing
from .panels import (
    ANGLE,
    ANGLES,
    AXIAL,
    AXIALS,
    CLEARANCE,
    CLEARANCES,
    DRAG,
    FLOW,
    FLOWS,
    GUIDING,
    GUIDINGS,
    RADIAL,
    SPEED,
    SPEEDS,
    TEMPERATURE,
    own,
    scaled,
    temperatures,
)
from .power_loss import NotInStudy, PowerLossStudy

LOADED = 100.0
"""Load in N above which a roller counts as loaded: the others carry the few newtons of their films."""

Found = tuple[bool, list[float]]


@dataclass(frozen=True)
class Claim:
    """A statement of the source: `holds` is `None` where the scene lacks what it is about, or a solve failed; `why`
    then says which. `numbers` are ours, as `printed` names them."""

    number: int
    statement: str
    printed: str
    holds: bool | None
    numbers: tuple[int | float, ...]
    why: str = ""


def _falls(values: np.ndarray) -> bool:
    return bool(np.all(np.diff(values) < 0))


def _totals(study: PowerLossStudy, path: str, values: Iterable[float], lands: str = "blend") -> np.ndarray:
    return study.losses("total", path, values, lands)


def _kilonewtons(study: PowerLossStudy, *loads: float) -> np.ndarray:
    return scaled(study.scene, RADIAL, [load / 25.0 for load in loads])


def _windage(study: PowerLossStudy) -> Found:
    losses = study.locations()
    total = losses.pop("total")
    return max(losses, key=losses.__getitem__) == "drag", [100 * losses["drag"] / total]


def _in_front(study: PowerLossStudy) -> Found:
    scene = study.scene
    names = ("load_inner", "pocket_film_front", "pocket_film_rear", "azimuth")
    load, front, rear, azimuth = (study.result(name) for name in names)
    driving, loaded = front < (own(scene, "cage.pocket_clearance") or 0.0) / 2, load > LOADED
    radial, lateral = (
        0.0 if component is None else float(component) for component in map(scene.operation.load, ("radial", "lateral"))
    )
    towards = np.cos(azimuth - np.arctan2(lateral, radial))
    share = float(np.sum((load * towards)[driving])) / float(np.hypot(radial, lateral))
    others = load[loaded & ~driving]
    heaviest = driving.any() and (not others.size or load[driving].min() > others.max())
    most, opposite = int(np.argmax(towards)), int(np.argmin(towards))
    holds = driving[most] and heaviest and not np.any(driving & ~loaded) and share > 0.5
    return bool(holds), [1e6 * front[most], 1e6 * rear[opposite], int(driving.sum()), int(loaded.sum()), 100 * share]


def _load(study: PowerLossStudy) -> Found:
    totals = _totals(study, RADIAL, _kilonewtons(study, 2, 4, 8, 16, 40))
    return bool(np.max(np.abs(totals / totals[-1] - 1)) < 0.05), list(totals)


def _slip(study: PowerLossStudy) -> Found:
    slip = np.array([float(study.result("cage_slip", {RADIAL: v})) for v in _kilonewtons(study, 0.25, 2, 8, 25)])
    return bool(np.all(slip[1:] < 0.01)), list(100 * slip)


def _light_load(study: PowerLossStudy) -> Found:
    loads = _kilonewtons(study, 0.001, 0.25, 0.5, 1, 2, 4)
    largest = [study.losses(location, RADIAL, loads).max() for location in ("flange", "inner_raceway")]
    return bool(largest[0] >= 300.0 and largest[1] >= 150.0), largest


def _trends(study: PowerLossStudy) -> Found:
    flow = _totals(study, FLOW, scaled(study.scene, FLOW, FLOWS))
    speed = _totals(study, SPEED, scaled(study.scene, SPEED, SPEEDS))
    hot = _totals(study, TEMPERATURE, temperatures())
    return _falls(-flow) and _falls(-speed) and _falls(hot), [flow[0], flow[-1], speed[0], speed[-1], hot[0], hot[-1]]


def _flow_by_windage(study: PowerLossStudy) -> Found:
    ends = scaled(study.scene, FLOW, [FLOWS[-1], FLOWS[1]])
    total, drag = (-float(np.diff(study.losses(name, FLOW, ends))[0]) for name in ("total", "drag"))
    return drag > total / 2, [total, drag, 100 * drag / total]


def _order(study: PowerLossStudy) -> Found:
    def factor(path: str, values: np.ndarray) -> float:
        totals = _totals(study, path, values)
        return float(totals.max() / totals.min())

    flows = scaled(study.scene, FLOW, FLOWS)
    speed, hot = factor(SPEED, scaled(study.scene, SPEED, SPEEDS)), factor(TEMPERATURE, temperatures())
    flow, load = factor(FLOW, flows[1:]), factor(RADIAL, _kilonewtons(study, 5, 8, 16, 25, 40))
    return speed > hot > flow > load, [speed, hot, flow, load, factor(FLOW, flows)]


def _lands(study: PowerLossStudy) -> Found:
    fast = {SPEED: SPEEDS[-1] * (own(study.scene, SPEED) or 0.0)}
    changes = (fast, fast | {DRAG: 0.2})
    numbers = [float(study.result(f"power_loss_{n}", c)) for c in changes for n in ("cage_pilot", "drag")]
    return numbers[0] > numbers[1], numbers


def _clearance(study: PowerLossStudy) -> Found:
    totals = _totals(study, CLEARANCE, scaled(study.scene, CLEARANCE, CLEARANCES))
    return bool(np.ptp(totals) < 0.05 * totals[2]), list(totals)


def _guiding(study: PowerLossStudy) -> Found:
    values = scaled(study.scene, GUIDING, GUIDINGS)
    blend, turbulent = (_totals(study, GUIDING, values, lands) for lands in ("blend", "turbulent"))
    return _falls(blend), [*blend, *turbulent]


def _flanges(study: PowerLossStudy) -> Found:
    gaps, angles = scaled(study.scene, AXIAL, AXIALS), scaled(study.scene, ANGLE, ANGLES)
    points = [(AXIAL, gaps[0]), (AXIAL, gaps[-1]), (ANGLE, angles[0]), (ANGLE, angles[-1])]
    flange, total = (
        np.array([study.losses(location, path, [v])[0] for path, v in points]) for location in ("flange", "total")
    )
    nominal = study.locations()
    down = flange[0] > nominal["flange"] > flange[1] and flange[2] > nominal["flange"] > flange[3]
    return bool(down and np.max(np.abs(total / nominal["total"] - 1)) < 0.02), [*flange, *total]


_DATA: tuple[tuple[str, str, tuple[str, ...], Callable[[PowerLossStudy], Found]], ...] = (
    ("The cage's part of the loss is important, mainly by windage", "drag in % of the total", (DRAG,), _windage),
    (
        "Rollers in the loaded zone lie at the front of their pockets and drive the cage",
        "film in front of the most loaded roller, behind the one opposite [µm]; rollers in front, loaded; load share %",
        (GUIDING, RADIAL),
        _in_front,
    ),
    ("The total does not depend on the radial load above 200 daN", "total at 2, 4, 8, 16, 40 kN [W]", (RADIAL,), _load),
    ("A small cage slip occurs below 200 daN", "slip at 0.25, 2, 8, 25 kN [%]", (GUIDING,), _slip),
    (
        "At light load the flanges can dissipate 300 W, sliding at the inner raceway 150 W",
        "largest flange, inner raceway loss [W]",
        (ANGLE,),
        _light_load,
    ),
    (
        "The loss grows with oil flow and speed and falls with oil temperature",
        "total at 0, 300 l/h; 2500, 20 000 rpm; 60, 200 °C [W]",
        (FLOW,),
        _trends,
    ),
    (
        "Less oil flow lowers the loss mainly by less windage",
        "fall of the total, of the drag from 300 to 50 l/h [W]; share %",
        (FLOW, DRAG),
        _flow_by_windage,
    ),
    (
        "Order of influence: speed, oil temperature, oil flow, and least the load",
        "largest over smallest total: speed, temperature, flow, load; flow from none",
        (FLOW,),
        _order,
    ),
    (
        "At very high speed the cage lands can dissipate more than windage",
        "lands, drag at 20 000 rpm; the same with drag coefficient 0.2 [W]",
        (DRAG, GUIDING),
        _lands,
    ),
    (
        "The bearing's diametral clearance is negligible",
        "total at -20, 0, 30, 60, 100 µm [W]",
        (CLEARANCE,),
        _clearance,
    ),
    (
        "A smaller guiding clearance of the cage raises the loss",
        "total at 120, 240, 480, 640 µm; the same with turbulent lands [W]",
        (GUIDING,),
        _guiding,
    ),
    (
        "Smaller axial clearance and angle of the flanges raise the loss there, with little effect on the total",
        "flange at axial clearances of 15, 60 µm, angles of 0.1, 0.75°; the totals [W]",
        (AXIAL, ANGLE),
        _flanges,
    ),
)


def claims_of(study: PowerLossStudy) -> list[Claim]:
    """The twelve statements with our verdicts, in the order of docs/claims.md; none for a bearing that is not of
    cylindrical rollers: the source makes none on it."""
    if not isinstance(study.scene, CylindricalRollerBearing):
        return []
    return [_judged(study, i + 1, *row) for i, row in enumerate(_DATA)]


def _judged(
    study: PowerLossStudy,
    number: int,
    statement: str,
    printed: str,
    needs: Sequence[str],
    judge: Callable[[PowerLossStudy], Found],
) -> Claim:
    lacking = [path for path in needs if not own(study.scene, path)]
    if lacking:
        return Claim(number, statement, printed, None, (), f"the scene has no {lacking[0]}, or zero")
    try:
        holds, numbers = judge(study)
    except NotInStudy as point:
        return Claim(number, statement, printed, None, (), str(point))
    if not np.all(np.isfinite(numbers)):
        return Claim(number, statement, printed, None, (), "a solve did not converge")
    return Claim(number, statement, printed, bool(holds), tuple(v if isinstance(v, int) else float(v) for v in numbers))
