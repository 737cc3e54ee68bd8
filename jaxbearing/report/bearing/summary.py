"""The summary of a bearing's steady solve on the screen: what an engineer wants to know first. Made for 100 columns; on
narrower terminals the bars are left out, then the table of loads is split."""

import dataclasses
import math
from collections.abc import Iterable

import equinox as eqx
import numpy as np
from rich.console import Console

from ...bearings.flanks import on_heavier_flanks
from ...bearings.solution import Solution
from ...numerics.status import Status
from ..backends.screen import (
    column,
    counted,
    headline,
    pieces,
    print_failure,
    print_line,
    print_rule,
    print_table,
    print_warnings,
)
from ..display import digits, display_unit, displayed
from ..tables import derived_facts
from .azimuth import signed_degrees
from .facts import OVERLOAD, extremes, facts, not_modelled
from .life_facts import SAID
from .operation import operating_point

LOADED = 0.02
"""Fraction of the largest inner load above which a rolling element counts as loaded: films carry a few newtons
everywhere."""
OPEN_BALANCE = 1e-6
"""Relative difference of drive power and losses above which it is reported."""
_LOSS_BAR, _LOAD_BAR = 40, 18
_COLUMNS = {
    "load_inner": "Q inner",
    "load_outer": "Q outer",
    "load_inner_second": "Q inner, second",
    "load_outer_second": "Q outer, second",
    "pressure_inner": "p inner",
    "pressure_outer": "p outer",
    "film_inner": "h inner",
    "film_outer": "h outer",
}


FIRST = (
    *(OVERLOAD, "Life", "Static safety", "Lubrication", "Load", "Rating", "Least load"),
    *("Temperatures", "Thermal margin", "Clearance", "First contact"),
)
"""Names of the facts that are shown first, in this order, as far as the scene models them."""
IN_FULL = (
    *("Rolling by race", "Ball's spin", "Spin to roll", "Raceways", "Heat", "Seats", "Oil supply"),
    *("Frequencies", "Textbook's"),
)
"""Names of the facts that only the full summary shows."""


def print_summary(solution: Solution, scene_label: str, console: Console, full: bool = False) -> None:
    """See `report.summary.print_summary`. Life, safety, lubrication, temperatures and power come first, then the
    warnings, then the details."""
    if not bool(solution.converged):
        print_failure(scene_label, Status(int(solution.status)).text, solution.failure(), console)
        print_line("Operating point", operating_point(solution), console)
        print_warnings(solution.warnings, console, full)
        return
    counts = f"{counted(int(solution.iterations), 'Newton step')}, {counted(solution.unknowns, 'unknown')}"
    state = f"{counts}, largest scaled residual {float(solution.residual_norm):.1e}"
    headline(scene_label, "CONVERGED", "bold green", state, console)
    print_line("Operating point", operating_point(solution), console)
    by_name = _by_name(facts(solution))
    _print_first(solution, {name: by_name[name] for name in FIRST if name in by_name}, console)
    print_warnings(solution.warnings, console, full)
    _print_losses(solution, console)
    _print_loads(solution, console, full)
    print_rule("Motion and films", console)
    for name, texts in by_name.items():
        if name not in FIRST and (full or name not in IN_FULL):
            _print_fact(name, texts, console)
    for name, text in derived_facts(solution, SAID):
        print_line(name, text, console)


def _by_name(pairs: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    """Name of each fact -> its texts; an empty name continues the previous fact."""
    texts: dict[str, list[str]] = {}
    last = ""
    for name, text in pairs:
        last = name or last
        texts.setdefault(last, []).append(text)
    return texts


def _print_fact(name: str, texts: list[str], console: Console) -> None:
    for title, text in zip([name, *[""] * len(texts)], texts, strict=False):
        print_line(title, text, console)


def _print_first(solution: Solution, by_name: dict[str, list[str]], console: Console) -> None:
    """Prints life and safety, as far as modelled, power loss, torque and drive power."""
    print_rule("Results", console)
    for name, texts in by_name.items():
        _print_fact(name, texts, console)
    if solution.life is None:
        print_line("Life", "not computed: give a table [rating]", console)
    if not _losses(solution):
        print_line("Not modelled:", not_modelled(solution), console)
        return
    total, drive = (float(np.asarray(power)) for power in (solution.power_loss.total, solution.drive_power))
    watts = _watts([total, drive])
    torque = lambda ring: f"{digits(float(np.asarray(getattr(solution, f'{ring}_torque'))))} N m on the {ring} ring"
    torques = [torque("inner")]
    if float(np.asarray(solution.operation.outer_speed)) != 0.0:
        torques.append(torque("outer"))
    print_line("Power loss", f"{watts[0]} W", console)
    print_line("Torque", ", ".join(torques), console)
    print_line("Drive power", f"{watts[1]} W", console)
    if abs(drive - total) > OPEN_BALANCE * abs(total):
        says = f"the drive power is {100.0 * (drive / total - 1.0):+.3g} % off the sum of the losses"
        print_line("Not balanced", f"{says}: the attitude of the balls is a hypothesis", console)


def _losses(solution: Solution) -> dict[str, float]:
    """The power losses by location, W, largest first; empty if the scene models none."""
    loss = solution.power_loss
    if loss.total is None or solution.drive_power is None:
        return {}
    values = ((field.name, getattr(loss, field.name)) for field in dataclasses.fields(loss) if field.name != "total")
    entries = {name: float(np.asarray(value)) for name, value in values if value is not None}
    return dict(sorted(entries.items(), key=lambda entry: -entry[1]))


def _print_losses(solution: Solution, console: Console) -> None:
    """Prints the power loss by location."""
    entries = _losses(solution)
    if not entries:
        return
    total = float(np.asarray(solution.power_loss.total))
    largest = max(abs(watts) for watts in entries.values())
    columns = {
        "Power loss": [*entries, "total"],
        "W": _watts([*entries.values(), total]),
        "%": [f"{100.0 * value / total:.1f}" if total else "-" for value in entries.values()] + ["100.0"],
    }
    fractions = [value / (largest or 1.0) for value in entries.values()]
    print_rule("Power", console)
    print_table(columns, fractions, _LOSS_BAR, "red", console)
    if not_modelled(solution):
        print_line("Not modelled:", not_modelled(solution), console)


def _watts(values: list[float]) -> list[str]:
    """Powers of one column as texts: to a tenth of a watt, or with more decimals if the largest has fewer than four
    digits."""
    largest = max(abs(value) for value in values)
    if not 1e-4 <= largest < math.inf:
        return [digits(value) for value in values]
    decimals = max(1, 3 - math.floor(math.log10(largest)))
    return [f"{value:.{decimals}f}" for value in values]


def _print_loads(solution: Solution, console: Console, full: bool) -> None:
    """Prints the largest loads and the loaded zone; with `full`, a row for each loaded element."""
    elements = solution.elements
    load = np.asarray(on_heavier_flanks(elements).load_inner)
    largest = float(np.max(load))
    loaded = load > LOADED * largest if largest > 0.0 else np.zeros(load.shape, dtype=bool)
    azimuth = signed_degrees(elements.azimuth)
    shown = {name: title for name, title in _COLUMNS.items() if getattr(elements, name, None) is not None}
    print_rule("Loads round the bearing", console)
    if full:
        _print_load_table(solution, np.flatnonzero(loaded), list(shown.items()), console)
    else:
        print_line("Largest load", ", ".join(extremes(elements, "load", np.argmax)), console)
    print_line("Loaded zone", _loaded_zone(azimuth, loaded, solution.element_name), console)
    if full and not np.all(loaded):
        ranges = [
            f"{title} {_range(np.asarray(getattr(elements, name))[~loaded], _unit(elements, name))}"
            for name, title in shown.items()
            if name.startswith("load")
        ]
        print_line(f"Other {solution.element_name}s", ", ".join(ranges), console)


def _print_load_table(solution: Solution, loaded: np.ndarray, shown: list[tuple[str, str]], console: Console) -> None:
    """Prints loads, pressures and films of the loaded elements, whose indices are given."""
    elements = solution.elements
    load, azimuth = np.asarray(on_heavier_flanks(elements).load_inner), signed_degrees(elements.azimuth)
    rows = np.array(sorted(loaded, key=lambda j: azimuth[j]), dtype=int)
    first = {"azimuth\ndeg": [f"{azimuth[j]:.1f}" for j in rows]}
    if load.size > 1 and np.all(load == load[0]):  # one element was solved for all
        rows, first = np.array([0]), {"azimuth\ndeg": ["all"]}
    columns = {
        f"{title}\n{display_unit(_unit(elements, name))}": column(
            np.asarray(getattr(elements, name))[rows], _unit(elements, name)
        )
        for name, title in shown
    }
    fractions = [float(load[j]) / float(np.max(load)) for j in rows]
    for piece in pieces(first, columns, console.width, together=2):
        print_table(piece, fractions, _LOAD_BAR, "cyan", console)


def _unit(elements: eqx.Module, name: str) -> str:
    """Unit of a result of the elements."""
    return type(elements).__dataclass_fields__[name].metadata["unit"]


def _loaded_zone(azimuth: np.ndarray, loaded: np.ndarray, element: str) -> str:
    count = f"{int(np.sum(loaded))} of {loaded.size} {element}s above {100.0 * LOADED:.0f} % of the largest load"
    if np.all(loaded) or not np.any(loaded):
        return count
    # the zone extends from the end of the widest gap to its beginning
    around = np.sort(azimuth[loaded])
    gaps = np.diff(around, append=around[0] + 360.0)
    begin = around[(np.argmax(gaps) + 1) % around.size]
    return f"{count}, {begin:.0f} to {begin + 360.0 - np.max(gaps):.0f} deg"


def _range(values: np.ndarray, unit: str) -> str:
    low, high = (digits(displayed(float(value), unit), 3) for value in (np.min(values), np.max(values)))
    return f"{low if low == high else f'{low} to {high}'} {display_unit(unit)}"
