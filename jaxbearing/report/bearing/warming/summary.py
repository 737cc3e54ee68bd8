"""A run of the temperatures of a bearing on the screen."""

from typing import Any

from rich.console import Console

from ....bearings.warming.history import WarmUpHistory
from ...backends.screen import headline, print_line, print_table, print_warnings
from ...display import ZERO_CELSIUS, digits, displayed
from .clock import clock
from .json_report import statistics

_COLUMNS = {"start": "at the start", "min": "least", "max": "largest", "end": "at the end"}


def print_summary(history: WarmUpHistory, label: str, console: Console) -> None:
    """See `report.histories.print_history`."""
    found = statistics(history)
    steps = f"{int(history.accepted)} steps ({int(history.rejected)} more tried), {history.solver}"
    reached, good = f"{clock(float(history.time[-1]))} in {steps}", history.completed
    headline(label, "COMPLETED" if good else "NOT COMPLETED", "bold green" if good else "bold red", reached, console)
    if float(history.time[0]) > 0.0:
        console.print(f"goes on from {clock(float(history.time[0]))}")
    if not good:
        console.print(history.failure(), style="bold red")
    rows = list(_rows(history, found))
    columns = {"": [name for name, _, _ in rows]}
    for key, title in _COLUMNS.items():
        columns[title] = [text(spread[key]) for _, spread, text in rows]
    columns["largest after"] = [clock(spread["max_time"]) for _, spread, _ in rows]
    print_table(columns, [0.0] * len(rows), 0, "", console)
    energy = history.energy
    said = (
        f"{_kilo(energy.losses)} kJ of losses: {_kilo(energy.to_oil)} to the oil, {_kilo(energy.to_ambient)} to the "
        f"ambient, {_kilo(energy.stored)} stored; {float(energy.error):.1e} of it left open"
    )
    print_line("Energy", said, console)
    if history.not_modelled:
        print_line("Not modelled", ", ".join(history.not_modelled).replace("_", " "), console)
    print_warnings(history.warnings, console)


def _rows(history: WarmUpHistory, found: dict[str, Any]) -> Any:
    """Name with its unit, spread, and the function from a value to its text."""
    degrees = lambda value: f"{value - ZERO_CELSIUS:.1f}"
    plain = lambda unit, significant=4: lambda value: digits(displayed(value, unit), significant)
    um = lambda value: f"{1e6 * value:.2f}"
    for name in history.nodes:
        yield f"{name.replace('_', ' ')}, degC", found["temperatures"][name], degrees
    if "oil_out" in found:
        yield "oil that leaves, degC", found["oil_out"], degrees
    yield "power loss, W", found["power_loss"]["total"], plain("W")
    yield "heat to the oil, W", found["heat_to_oil"], plain("W")
    yield "heat to the ambient, W", found["heat_to_ambient"], plain("W")
    yield "heat stored, W", found["heat_stored"], plain("W")
    for name, words in (("clearance", "clearance, um"), ("axial_shift", "first contact, um")):
        if name in found:
            yield words, found[name], um
    yield "largest contact load, N", found["largest_load"], plain("N")
    if "smallest_film" in found:
        yield "smallest film, um", found["smallest_film"], um
    if found["inner_speed"]["min"] != found["inner_speed"]["max"]:
        yield "inner ring, rpm", found["inner_speed"], plain("rad/s")


def _kilo(value: Any) -> str:
    return digits(1e-3 * float(value))
