"""The summary of a steady solve on the screen: what an engineer wants to know first, at 100 columns."""

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from ..bearings.solution import Solution
from ..numerics.status import Status
from .display import ZERO_CELSIUS, bar, digits, display_unit, displayed, with_unit

LOADED = 0.01
"""A roller whose inner load is above this part of the largest one counts as loaded: films carry a few newtons
everywhere."""
_LOSS_BAR, _LOAD_BAR = 40, 18
_OPERATION = {
    "inner_speed": ("inner ring", "rad/s"),
    "outer_speed": ("outer ring", "rad/s"),
    "radial_load": ("radial load", "N"),
    "oil_flow": ("oil flow", "m^3/s"),
}
_COLUMNS = {
    "load_inner": "Q inner",
    "load_outer": "Q outer",
    "pressure_inner": "p inner",
    "pressure_outer": "p outer",
    "film_inner": "h inner",
    "film_outer": "h outer",
}


def print_summary(solution: Solution, scene_label: str, console: Console) -> None:
    """Print one solution; where the solve failed, status, residual and worst equation and no result.

    **Arguments:**
    - `scene_label`: name or file of the scene.
    - `console`: where to; it decides on colours, width and characters.
    """
    if not bool(solution.converged):
        _print_failure(solution, scene_label, console)
        return
    steps = f"{int(solution.iterations)} Newton steps"
    state = f"{steps}, largest scaled residual {float(solution.residual_norm):.1e}, {solution.unknowns} unknowns"
    _headline(scene_label, "CONVERGED", "bold green", state, console)
    _line("Operating point", "   ".join(_operation(solution.operation)), console)
    _print_losses(solution, console)
    _print_loads(solution, console)
    console.print(Rule("Motion and films", align="left", style="dim"))
    for name, text in _facts(solution):
        _line(name, text, console)
    if solution.warnings:
        console.print(Rule("Warnings", align="left", style="yellow"))
        for text in solution.warnings:
            console.print(Padding(Text(f"- {text}", style="yellow"), (0, 2)))


def _headline(label: str, status: str, style: str, state: str, console: Console) -> None:
    grid = Table.grid(expand=True)
    grid.add_column()
    grid.add_column(justify="right")
    grid.add_row(Text(label, style="bold"), Text(status, style=style))
    console.print(grid)
    console.print(Text(f"  {state}", style="dim"))


def _print_failure(solution: Solution, label: str, console: Console) -> None:
    status = Status(int(solution.status)).text
    _headline(label, "NOT CONVERGED", "bold red", f"status: {status}", console)
    console.print(Padding(Text(solution.failure(), style="red"), (0, 2)))
    console.print(Padding(Text("No results: the point where the iteration stopped is not a solution."), (0, 2)))
    _line("Operating point", "   ".join(_operation(solution.operation)), console)


def _line(name: str, text: str, console: Console) -> None:
    grid = Table.grid(padding=(0, 2, 0, 0))
    grid.add_column(width=18, no_wrap=True)
    grid.add_column()
    grid.add_row(Text(f"  {name}"), Text(text))
    console.print(grid)


def _operation(operation: Any) -> Iterator[str]:
    for field in dataclasses.fields(operation):
        value = float(getattr(operation, field.name))
        if field.name == "oil_temperature":
            yield f"oil {digits(value - ZERO_CELSIUS)} degC"
        elif field.name in _OPERATION:
            label, unit = _OPERATION[field.name]
            if value != 0.0 or field.name != "outer_speed":
                yield f"{label} {with_unit(value, unit, 5)}"
        else:
            yield f"{field.name} {digits(value)}"


def _print_losses(solution: Solution, console: Console) -> None:
    loss = solution.power_loss
    entries = {
        field.name: (float(getattr(loss, field.name)), field.metadata["description"])
        for field in dataclasses.fields(loss)
        if getattr(loss, field.name) is not None
    }
    total, _ = entries.pop("total")
    if not entries:
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), show_footer=True, header_style="")
    table.add_column("Power loss", footer="total")
    table.add_column("W", justify="right", footer=_watts(total))
    table.add_column("%", justify="right", footer="100.0")
    table.add_column("", width=_LOSS_BAR)
    largest = max((abs(watts) for watts, _ in entries.values()), default=0.0) or 1.0
    for name, (watts, _) in sorted(entries.items(), key=lambda entry: -entry[1][0]):
        share = f"{100.0 * watts / total:.1f}" if total else "-"
        table.add_row(name, _watts(watts), share, _bar(watts / largest, _LOSS_BAR, "red", console))
    console.print(Rule("Power", align="left", style="dim"))
    console.print(Padding(table, (0, 2)))
    torques = [f"{digits(float(solution.inner_torque))} N m on the inner ring"]
    if float(solution.operation.outer_speed) != 0.0:
        torques.append(f"{digits(float(solution.outer_torque))} N m on the outer ring")
    _line("Drive power", f"{_watts(float(solution.drive_power))} W   ({', '.join(torques)})", console)


def _watts(value: float) -> str:
    return digits(value, 4) if abs(value) < 1000.0 else f"{value:.0f}"


def _bar(fraction: float, width: int, style: str, console: Console) -> Text:
    return Text(bar(fraction, width, console.options.ascii_only), style=style)


def _print_loads(solution: Solution, console: Console) -> None:
    elements = solution.elements
    load = np.asarray(elements.load_inner)
    largest = float(np.max(load))
    loaded = load > LOADED * largest if largest > 0.0 else np.zeros(load.shape, dtype=bool)
    azimuth = np.degrees(np.asarray(elements.azimuth))
    azimuth = np.where(azimuth > 180.0 + 1e-9, azimuth - 360.0, azimuth)
    units = {field.name: field.metadata["unit"] for field in dataclasses.fields(elements)}
    shown = {name: title for name, title in _COLUMNS.items() if getattr(elements, name) is not None}

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column("azimuth\ndeg", justify="right")
    for name, title in shown.items():
        table.add_column(f"{title}\n{display_unit(units[name])}", justify="right")
    table.add_column("", width=_LOAD_BAR)
    for j in sorted(np.flatnonzero(loaded), key=lambda j: azimuth[j]):
        row = [digits(float(displayed(float(np.asarray(getattr(elements, name))[j]), units[name]))) for name in shown]
        table.add_row(f"{azimuth[j]:.1f}", *row, _bar(load[j] / largest, _LOAD_BAR, "cyan", console))
    console.print(Rule("Loads round the bearing", align="left", style="dim"))
    console.print(Padding(table, (0, 2)))
    _line("Loaded zone", _loaded_zone(azimuth, loaded), console)
    if not np.all(loaded):
        ranges = [
            f"{title} {_range(np.asarray(getattr(elements, n))[~loaded], units[n])}" for n, title in shown.items()
        ]
        _line("Other rollers", ", ".join(text for text in ranges if text.startswith("Q")), console)


def _loaded_zone(azimuth: np.ndarray, loaded: np.ndarray) -> str:
    count = f"{int(np.sum(loaded))} of {loaded.size} rollers"
    if np.all(loaded) or not np.any(loaded):
        return count
    return f"{count}, {np.min(azimuth[loaded]):.0f} to {np.max(azimuth[loaded]):.0f} deg from the load line"


def _range(values: np.ndarray, unit: str) -> str:
    low, high = (digits(displayed(float(value), unit), 3) for value in (np.min(values), np.max(values)))
    return f"{low if low == high else f'{low} to {high}'} {display_unit(unit)}"


def _facts(solution: Solution) -> Iterator[tuple[str, str]]:
    if solution.cage is not None:
        cage = solution.cage
        place = f"{digits(float(cage.eccentricity_ratio), 3)} of its clearance off centre"
        angle = with_unit(float(cage.attitude_angle), "rad", 3)
        slip = f"slip {digits(100.0 * float(cage.slip), 3)} %"
        yield "Cage", f"{with_unit(float(cage.speed), 'rad/s')}, {slip}, {place} (attitude angle {angle})"
    yield "Inner ring", ", ".join(_ring(solution))
    stiffness = np.diagonal(np.asarray(solution.stiffness))
    entries = [
        f"{freedom} {with_unit(float(value), 'N/m')}"
        for freedom, value in zip(solution.ring_freedom, stiffness, strict=True)
        if not freedom.startswith("tilt")
    ]
    if entries:
        yield "Stiffness", ", ".join(entries)
    for title, name, pick in (("Thinnest film", "film", np.argmin), ("Highest pressure", "pressure", np.argmax)):
        text = ", ".join(_extremes(solution.elements, name, pick))
        if text:
            yield title, text


def _ring(solution: Solution) -> Iterator[str]:
    for field in dataclasses.fields(solution.ring):
        if field.name in solution.ring_freedom:
            value = float(getattr(solution.ring, field.name))
            yield f"{field.metadata['description']} {with_unit(value, field.metadata['unit'])}"


def _extremes(elements: Any, name: str, pick: Any) -> Iterator[str]:
    for field in dataclasses.fields(elements):
        values = getattr(elements, field.name)
        if values is not None and field.name in (f"{name}_inner", f"{name}_outer"):
            j = int(pick(np.asarray(values)))
            side = field.name.removeprefix(f"{name}_")
            at = f"{np.degrees(float(np.asarray(elements.azimuth)[j])):.0f} deg"
            yield f"{side} race {with_unit(float(np.asarray(values)[j]), field.metadata['unit'])} (at {at})"
