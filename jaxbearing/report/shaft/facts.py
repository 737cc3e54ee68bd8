"""Results of a shaft as texts and tables, for the screen and the report page."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..._checks import about, as_note, in_groups
from ...bearings.solution import RING_FREEDOMS
from ...life.duty import IN_HOURS
from ...life.result import AtReliability, Life
from ...shafts.solution import BearingOnShaft, DutyResult, SetResult, ShaftSolution
from ..backends.json import finite
from ..bearing.facts import OVERLOAD, bending, left_out_couple, overload
from ..bearing.life_facts import AT_RELIABILITY, lives_in_words, percent
from ..display import ZERO_CELSIUS, digits, with_unit
from .bending import bending_line

NAMES = "bearing\n"
"""Heading of the column with the names of the bearings."""
_MANY_HOURS = 1e7
"""Life in hours from which on it is written with an exponent."""
_LEAST_MOVE = 1e-13
"""Smallest displacement, m, or tilt, rad, that is shown; smaller ones are round-off and shown as 0."""
CARRIES = 1e-3
"""Axial force relative to the largest one in its set, up to which a bearing counts as axially unloaded."""
_LEAST = 1e-9
"""Load relative to the largest one, below which it is round-off and shown as 0."""


def number(value: object) -> float | None:
    """A result as a plain number; `None` if it is not modelled or not finite."""
    if value is None:
        return None
    plain = float(np.asarray(value))
    return plain if np.isfinite(plain) else None


def text(value: object, significant: int = 4) -> str:
    known = number(value)
    return "-" if known is None else digits(known, significant)


def bearing_columns(solution: ShaftSolution) -> dict[str, list[str]]:
    """Columns of the table of bearings: heading, with the unit on a second line -> one text for each bearing."""
    bearings = list(solution.bearings.values())
    on_shaft = np.array([np.asarray(bearing.on_shaft) for bearing in bearings])
    forces, moments = np.abs(on_shaft[:, :3]), np.abs(on_shaft[:, 3:])
    force, moment = (max(float(np.max(values)), 1e-300) for values in (forces, moments))
    axial = [_above(float(bearing.on_shaft[0]), force) for bearing in bearings]
    radial = [_above(float(bearing.radial_force), force) for bearing in bearings]
    return {
        NAMES: [bearing.name for bearing in bearings],
        "x\nmm": _column([1e3 * float(bearing.position) for bearing in bearings], 1),
        "axial\nN": [f"{value:+{_width(force)}}" if value else "0" for value in axial],
        "radial\nN": [f"{value:{_width(force)}}" for value in radial],
        "at\ndeg": [_azimuth(bearing) if radial[i] else "-" for i, bearing in enumerate(bearings)],
        "moment\nN m": [f"{_above(float(bearing.moment), moment):{_width(moment, 2)}}" for bearing in bearings],
        "Q max\nN": [text(bearing.largest_load) for bearing in bearings],
    }


def life_columns(solution: ShaftSolution, wide: bool = True) -> dict[str, list[str]]:
    """Columns of the table of lives, safeties, lubrication, clearances, temperatures and losses.

    Each is a heading, with the unit on a second line -> one text for each bearing, "-" for a missing result. Columns
    without any result are left out.

    **Arguments:** `wide`: False leaves out columns for which a screen of 80 characters has no room.
    """
    bearings = list(solution.bearings.values())
    lives = [bearing.life for bearing in bearings]
    shares = {life.reliability for life in lives if life is not None}
    rated_for = f"h, {percent(shares.pop())}" if len(shares) == 1 else "h, n"
    of = lambda name, significant=3: [_life_text(life, name, significant) for life in lives]
    lasting = [None if _yielding(bearing) else bearing.life for bearing in bearings]
    hours = lambda name: ["-" if life is None else _hours(getattr(life, name)) for life in lasting]
    columns = {f"{name}\nh, 90 %": hours(IN_HOURS[name]) for name in ("L10", "L10r")}
    if wide:
        columns["L10m\nh, 90 %"] = hours("L10mh")
    if rated_for != "h, 90 %":
        columns |= {f"{name}\n{rated_for}": hours(AT_RELIABILITY[name][0]) for name in ("Ln", "Lnr")}
    columns |= {f"Lnmr\n{rated_for}": hours("Lnmr_hours"), "kappa": of("viscosity_ratio")}
    which = "safety" if solution.duty is None else "least"
    columns[f"{which}\nC0/P0"] = _safeties(solution, "static_safety")
    if wide:
        columns[f"{which}\ncontact"] = _safeties(solution, "contact_static_safety")
    columns["clearance\num"] = [_clearance(bearing) for bearing in bearings]
    if wide:
        columns["rings\ndegC"] = [_temperatures(bearing) for bearing in bearings]
    columns["loss\nW"] = [text(loss_of(bearing)) for bearing in bearings]
    kept = {heading: texts for heading, texts in columns.items() if set(texts) != {"-"}}
    return {NAMES: [bearing.name for bearing in bearings]} | kept if kept else {}


def _safeties(solution: ShaftSolution, name: str) -> list[str]:
    """Texts of a static safety of each bearing; under a duty cycle, the least one of all states."""
    bearings = (solution if solution.duty is None else solution.duty.states).bearings.values()
    values = [None if bearing.life is None else getattr(bearing.life, name) for bearing in bearings]
    return ["-" if value is None else text(np.min(np.asarray(value)), 3) for value in values]


def _life_text(life: Life | None, name: str, significant: int) -> str:
    return "-" if life is None else text(getattr(life, name), significant)


def _hours(value: object) -> str:
    """Text of a life in hours; "-" if it is not finite, as for a bearing without load."""
    hours = number(value)
    return "-" if hours is None else _power_of_ten(hours) if hours >= _MANY_HOURS else digits(hours)


def _clearance(bearing: BearingOnShaft) -> str:
    """Text of the diametral operating clearance, um; "-" if the scene has no fits from which it follows."""
    fit = getattr(bearing.solution, "fit", None)
    clearance = None if fit is None else number(fit.clearance)
    return "-" if clearance is None else f"{1e6 * clearance:.1f}"


def _temperatures(bearing: BearingOnShaft) -> str:
    """Text of the temperatures of inner and outer ring, degC; "-" if they are not modelled."""
    thermal = getattr(bearing.solution, "thermal", None)
    if thermal is None:
        return "-"
    rings = (getattr(thermal.temperatures, f"{side}_ring") for side in ("inner", "outer"))
    return "/".join(f"{float(ring) - ZERO_CELSIUS:.1f}" for ring in rings)


def _azimuth(bearing: BearingOnShaft) -> str:
    """Text of the azimuth of the radial force, deg; -180.0 is shown as 180.0, since only round-off tells them apart."""
    degrees = f"{np.degrees(float(bearing.azimuth)):.1f}"
    return "180.0" if degrees == "-180.0" else degrees


def _above(value: float, largest: float) -> float:
    return value if abs(value) > _LEAST * largest else 0.0


def _width(largest: float, most: int = 1) -> str:
    """Format of a column: the decimals that give its largest number five digits, at most `most`; 6 below 1e-3."""
    decimals = min(max(4 - int(np.floor(np.log10(largest))), 0), most) if largest >= 1e-3 else 6
    return f".{decimals}f"


def _column(values: Sequence[float], decimals: int) -> list[str]:
    return [f"{value:.{decimals}f}" for value in values]


def _power_of_ten(value: float) -> str:
    return f"{value:.2e}".replace("e+0", "e").replace("e+", "e")


def life_facts(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Name and text of the life of the system, and of results that `life_columns` leaves out without `wide`."""
    yield from system_facts(solution)
    safeties = dict(zip(solution.bearings, _safeties(solution, "contact_static_safety"), strict=True))
    degrees = {name: _temperatures(bearing) for name, bearing in solution.bearings.items()}
    static = "Static, contact" if solution.duty is None else "Least, contact"
    for title, texts in ((static, safeties), ("Rings, degC", degrees)):
        line = ", ".join(f"{name} {own}" for name, own in texts.items() if own != "-")
        if line:
            yield title, line


def system_facts(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Name and text of the life of the system, and of the reliabilities n if they differ between bearings."""
    if solution.life is not None and not any(overloads(solution)):
        for lives in lives_in_words(solution.life):
            yield "System life", lives
    shares = {name: bearing.life.reliability for name, bearing in solution.bearings.items() if bearing.life is not None}
    if len(set(shares.values())) > 1:
        each = ", ".join(f"{name} {percent(share)}" for name, share in shares.items())
        yield "Reliability n", f"{each}; lives at different reliabilities make no life of the system"


def overloads(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Heading and text of the bearings that yield, in any state of a duty cycle; they and the system have no life."""
    states, worst = (solution, "") if solution.duty is None else (solution.duty.states, " in its worst state")
    texts = [f"{name}{worst} {_yielding(bearing)}" for name, bearing in states.bearings.items() if _yielding(bearing)]
    if texts:
        yield OVERLOAD, f"yield, so that neither these bearings nor the system has a life: {'; '.join(texts)}"


def duty_lives(duty: DutyResult) -> Iterator[tuple[str, str]]:
    """Name and text of the lives under a duty cycle: of bearings that do not yield in any state, and of the system if
    no bearing yields."""
    yielding = {name for name, bearing in duty.states.bearings.items() if _yielding(bearing)}
    lives: dict[str, AtReliability] = {name: life for name, life in duty.lives.items() if name not in yielding}
    if duty.system is not None and not yielding:
        lives["System life"] = duty.system
    for name, life in lives.items():
        yield from ((name, text) for text in lives_in_words(life))


def _yielding(bearing: BearingOnShaft) -> str:
    """Text of the contacts of a bearing that yield; "" if none does."""
    return "" if bearing.solution is None else overload(bearing.solution)


def loss_of(bearing: BearingOnShaft) -> float | None:
    """Power loss of a bearing, W; `None` if it is not modelled."""
    loss = getattr(bearing.solution, "power_loss", None)
    return None if loss is None or loss.total is None else number(loss.total)


def left_out(solution: ShaftSolution) -> str:
    """Text of the gyroscopic couples of balls that the bearings' scenes leave out; "" where friction easily carries
    them. Losses that are left out are named with each bearing."""
    couples = {
        name: left_out_couple(bearing.solution) for name, bearing in solution.bearings.items() if bearing.solution
    }
    return "; ".join(f"{name}: {text}" for name, text in couples.items() if text)


def set_facts(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Name of each set, and its results as text."""
    for name, result in solution.sets.items():
        own = [bearing for bearing in solution.bearings.values() if bearing.name.startswith(f"{name}.")]
        yield name, ", ".join(_set_parts(result, own))


def _set_parts(result: SetResult, bearings: Sequence[BearingOnShaft]) -> Iterator[str]:
    """Results of a set as texts. **Arguments:** `bearings`: bearings of the set."""
    preload, closure = number(result.preload), number(result.closure)
    if preload is not None:
        yield f"preload {with_unit(preload, 'N')} mounted"
    if closure is not None:
        yield f"closure {with_unit(closure, 'm')} a bearing"
    springs, loss = number(result.spring_force), number(result.loss_force)
    if springs is not None:
        yield f"springs {with_unit(springs, 'N')}"
    if loss is not None:
        yield f"lost at {with_unit(loss, 'N')} axial load at rest without radial load ({_carry(bearings)})"
    yield f"support distance {1e3 * float(result.support_distance):.1f} mm"


def _carry(bearings: Sequence[BearingOnShaft]) -> str:
    """Text that names the bearings of a set that carry no axial force under the present load."""
    forces = {bearing.name: abs(float(bearing.on_shaft[0])) for bearing in bearings}
    free = [name for name, force in forces.items() if force <= CARRIES * max(forces.values())]
    return f"here {', '.join(free)} is unloaded" if free else "here all bearings carry"


def shaft_facts(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Name and text of the results of the shaft: deflection, tilts of the rings, torques, losses, temperatures."""
    line = bending_line(solution)
    size, place = line.largest()
    # a shaft that moves parallel to itself has no place of largest displacement
    where = f" at {1e3 * place:.1f} mm" if np.ptp(line.size) > max(_LEAST_MOVE, _LEAST * size) else ""
    yield "Deflection", f"largest {with_unit(_moved(size), 'm')} across the axis{where}"
    tilts = [
        np.asarray([bearing.ring.tilt, bearing.ring.tilt_lateral], dtype=float)
        for bearing in solution.bearings.values()
    ]
    named = zip(solution.bearings, (_moved(float(np.hypot(*tilt))) for tilt in tilts), strict=True)
    yield "Tilt of rings", ", ".join(f"{name} {1e3 * tilt:.3g} mrad" for name, tilt in named)
    axial = ", ".join(
        f"{name} {with_unit(float(bearing.ring.axial), 'm', 3)}" for name, bearing in solution.bearings.items()
    )
    yield "Axial", f"inner ring against outer ring: {axial}"
    solved = {name: bearing.solution for name, bearing in solution.bearings.items() if bearing.solution is not None}
    for side in ("inner", "outer"):
        rings = {name: getattr(family, f"{side}_ring") for name, family in solved.items()}
        bent = ", ".join(f"{name} {bending(ring)}" for name, ring in rings.items() if ring is not None)
        if bent:
            yield f"{side.capitalize()} rings", bent
    torque = solution.torque
    parts = [f"forces {with_unit(float(torque.forces), 'N m')}", f"drive {with_unit(float(torque.drive), 'N m')}"]
    if number(torque.bearings):
        parts.insert(1, f"bearings {with_unit(float(torque.bearings), 'N m')}")
    yield "Torques", ", ".join(parts)
    if number(torque.power_loss):
        yield "Power loss", with_unit(float(torque.power_loss), "W")
    if solution.thermal is not None:
        yield from _thermal_facts(solution)


def _thermal_facts(solution: ShaftSolution) -> Iterator[tuple[str, str]]:
    """Name and text of the temperatures along shaft and housing, and of the heat flows."""
    thermal = solution.thermal
    assert thermal is not None
    for part in ("shaft", "housing"):
        networks = {
            name: bearing.solution.thermal
            for name, bearing in solution.bearings.items()
            if bearing.solution is not None
        }
        own = {name: getattr(network.temperatures, part) for name, network in networks.items() if network is not None}
        degrees = ", ".join(f"{name} {float(value) - ZERO_CELSIUS:.1f}" for name, value in own.items())
        flows = ", ".join(digits(float(flow)) for flow in np.asarray(getattr(thermal, f"{part}_flow")))
        yield f"{part.capitalize()}, degC", f"{degrees}; heat towards +X between neighbours {flows} W"
    away = f"{with_unit(float(thermal.heat_to_oil), 'W')} to the oil, {with_unit(float(thermal.heat_to_ambient), 'W')}"
    yield "Heat", f"{away} to the ambient; balanced in {int(thermal.solves)} solves of the shaft"


def shaft_warnings(solution: ShaftSolution) -> list[str]:
    """Warnings of the shaft, where one that several bearings have appears once, with all their names.

    Under a duty cycle a warning names the states in which it holds, if it does not hold in all.
    """
    return _merged(solution, [with_states(solution, warning) for warning in solution.warnings])


def shaft_notes(solution: ShaftSolution) -> list[str]:
    """Broken rules and notes, merged as in `shaft_warnings`: all warnings except those on ranges of laws."""
    act, assumed, information = in_groups([*solution.broken_rules, *map(as_note, solution.notes)])
    return _merged(solution, [*act, *assumed, *information])


def _merged(solution: ShaftSolution, texts: Sequence[str]) -> list[str]:
    names: dict[str, list[str]] = {}
    for text in texts:
        name, _, rest = text.partition(": ")
        own = name in solution.bearings and rest
        names.setdefault(type(text)(rest) if own else text, []).extend([name] if own else [])
    return [about(", ".join(bearings), text) if bearings else text for text, bearings in names.items()]


def with_states(solution: ShaftSolution, text: str) -> str:
    """A warning, with the names of the states of a duty cycle in which it holds unless it holds in all."""
    duty = solution.duty
    if duty is None or text not in duty.states.range_checks:
        return text
    holds = np.asarray(duty.states.range_checks[text])
    states = [name for name, own in zip(duty.names, holds, strict=True) if own]
    return text if np.all(holds) else type(text)(f"{text} (in {', '.join(states)})")


def _moved(value: float) -> float:
    """The displacement, or 0 if it is only round-off."""
    return value if abs(value) > _LEAST_MOVE else 0.0


def stiffness_rows(bearing: BearingOnShaft) -> tuple[list[str], list[list[str]]]:
    """Names of the degrees of freedom, and the rows of a bearing's stiffness matrix as texts."""
    rows = [[digits(float(value), 5) for value in row] for row in np.asarray(bearing.stiffness)]
    return [name.replace("_", " ") for name in RING_FREEDOMS], rows


def plain_array(value: object) -> Any:
    return finite(np.asarray(value).tolist())
