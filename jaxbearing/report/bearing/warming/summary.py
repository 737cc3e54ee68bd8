"""Summary of a transient run of bearing temperatures on the screen."""

from collections.abc import Callable, Iterator
from typing import Any, SupportsFloat

from rich.console import Console

from ....bearings.warming.history import WarmUpHistory
from ...backends.screen import headline, print_line, print_table, print_warnings
from ...display import ZERO_CELSIUS, digits, displayed, with_unit
from .clock import clock
from .json_report import statistics

PLAYS = {"clearance": ("the clearance", True), "axial_shift": ("the axial play", False)}
"""Name of the play -> its words, and whether its value is shown (a value below 0 is a preload)."""
LEAST_DEPTH = 1e-8
"""Smallest difference of the play that is reported as a peak, m."""
LEAST_RISE = 1e-3
"""Smallest relative difference of the load that is reported as a peak."""
LEAST_WARMING = 0.05
"""Smallest difference of the highest temperature that is reported as a peak, K."""
_COLUMNS = {"start": "at the start", "min": "least", "max": "largest", "end": "at the end"}


def print_summary(history: WarmUpHistory, label: str, console: Console) -> None:
    """See `report.histories.print_history`."""
    numbers = statistics(history)
    steps = f"{int(history.accepted)} steps ({int(history.rejected)} more tried), {history.solver}"
    reached, good = f"{clock(float(history.time[-1]))} in {steps}", history.completed
    headline(label, "COMPLETED" if good else "NOT COMPLETED", "bold green" if good else "bold red", reached, console)
    if float(history.time[0]) > 0.0:
        console.print(f"goes on from {clock(float(history.time[0]))}")
    if not good:
        console.print(history.failure(), style="bold red")
    rows = list(_rows(history, numbers))
    columns = {"": [name for name, _, _ in rows]}
    for key, title in _COLUMNS.items():
        columns[title] = [text(spread[key]) for _, spread, text in rows]
    columns["largest after"] = [clock(spread["max_time"]) for _, spread, _ in rows]
    print_table(columns, [0.0] * len(rows), 0, "", console)
    energy = history.energy
    balance = (
        f"{_kilo(energy.losses)} kJ of losses: {_kilo(energy.to_oil)} to the oil, {_kilo(energy.to_ambient)} to the "
        f"ambient, {_kilo(energy.stored)} stored; {float(energy.error):.1e} of it left open"
    )
    print_line("Energy", balance, console)
    print_line("Start-up peak", peak_sentence(history, numbers), console)
    if history.not_modelled:
        print_line("Not modelled", ", ".join(history.not_modelled).replace("_", " "), console)
    print_warnings(history.warnings, console)


def peak_sentence(history: WarmUpHistory, numbers: dict[str, Any]) -> str:
    """Sentence that says when the play is smallest, the contact load largest and, if not at the start or the end, a
    node hottest, and by how much these values differ from those at the end of the run.

    **Arguments:** `numbers`: result of `statistics` for the run.
    """
    texts, name = [], next((play for play in PLAYS if play in numbers), None)
    if name is not None:
        spread, (words, preload) = numbers[name], PLAYS[name]
        least, depth = spread["min"], spread["end"] - spread["min"]
        value = f", {_um(least)} um{' (radial preload)' if preload and least < 0.0 else ''}" if preload else ""
        if min(depth, spread["start"] - least) < LEAST_DEPTH:
            texts.append(f"{words} is least at the {'end' if depth < LEAST_DEPTH else 'start'}{value}")
        else:
            texts.append(
                f"{words} is least after {clock(spread['min_time'])}{value}: {_um(depth)} um less than at the end"
            )
    load = numbers["largest_load"]
    most, rise = load["max"], load["max"] / load["end"] - 1.0
    newton = with_unit(most, "N")
    if min(most - load["start"], most - load["end"]) > LEAST_RISE * most:
        more = f"{100.0 * rise:.2g} % more than at the end"
        texts.append(f"the contact load is largest after {clock(load['max_time'])}, {newton}: {more}")
    elif most - load["end"] > LEAST_RISE * most:
        texts.append(f"the contact load is largest at the start, {newton}")
    elif most - load["start"] > LEAST_RISE * most:
        texts.append(f"the contact load is largest at the end, {newton}")
    else:
        texts.append(f"the largest contact load stays at {newton}")
    name, heat = max(numbers["temperatures"].items(), key=lambda item: item[1]["max"])
    more = heat["max"] - max(node["end"] for node in numbers["temperatures"].values())
    if min(heat["max"] - heat["start"], more) > LEAST_WARMING:
        place = f"the {name.replace('_', ' ')} is hottest after {clock(heat['max_time'])}"
        texts.append(f"{place}, {heat['max'] - ZERO_CELSIUS:.1f} degC: {more:.1f} K above the highest at the end")
    return "; ".join(texts)


def _um(value: float) -> str:
    return f"{1e6 * value:.2f}"


def _rows(
    history: WarmUpHistory, numbers: dict[str, Any]
) -> Iterator[tuple[str, dict[str, float], Callable[[float], str]]]:
    """Rows of the table: name with unit, statistics, and the function that turns a value into text."""
    degrees = lambda value: f"{value - ZERO_CELSIUS:.1f}"
    plain = lambda unit, significant=4: lambda value: digits(displayed(value, unit), significant)
    for name in history.nodes:
        yield f"{name.replace('_', ' ')}, degC", numbers["temperatures"][name], degrees
    if "oil_out" in numbers:
        yield "oil that leaves, degC", numbers["oil_out"], degrees
    yield "power loss, W", numbers["power_loss"]["total"], plain("W")
    yield "heat to the oil, W", numbers["heat_to_oil"], plain("W")
    yield "heat to the ambient, W", numbers["heat_to_ambient"], plain("W")
    yield "heat stored, W", numbers["heat_stored"], plain("W")
    for name, words in (("clearance", "clearance, um"), ("axial_shift", "first contact, um")):
        if name in numbers:
            yield words, numbers[name], _um
    yield "largest contact load, N", numbers["largest_load"], plain("N")
    if "smallest_film" in numbers:
        yield "smallest film, um", numbers["smallest_film"], _um
    if numbers["inner_speed"]["min"] != numbers["inner_speed"]["max"]:
        yield "inner ring, rpm", numbers["inner_speed"], plain("rad/s")


def _kilo(value: SupportsFloat) -> str:
    return digits(1e-3 * float(value))
