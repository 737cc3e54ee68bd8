"""The summary of a steady solve on the screen: what an engineer wants to know first. Made for 100 columns; narrower
terminals lose the bars, then get the table of loads in pieces: numbers are never cut."""

import dataclasses
import math
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
from .display import bar, digits, display_unit, displayed, with_unit
from .operation import operating_point

LOADED = 0.02
"""A roller whose inner load is above this part of the largest one counts as loaded: films carry a few newtons
everywhere."""
_LOSS_BAR, _LOAD_BAR, _SHORTEST_BAR = 40, 18, 4
_GAP = 3
"""Columns between two columns of a table."""
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
    counts = f"{_count(int(solution.iterations), 'Newton step')}, {_count(solution.unknowns, 'unknown')}"
    state = f"{counts}, largest scaled residual {float(solution.residual_norm):.1e}"
    _headline(scene_label, "CONVERGED", "bold green", state, console)
    _line("Operating point", operating_point(solution), console)
    _print_losses(solution, console)
    _print_loads(solution, console)
    console.print(Rule("Motion and films", align="left", style="dim"))
    for name, text in _facts(solution):
        _line(name, text, console)
    if solution.warnings:
        console.print(Rule("Warnings", align="left", style="yellow"))
        for text in solution.warnings:
            console.print(Padding(Text(f"- {text}", style="yellow"), (0, 2)))


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _headline(label: str, status: str, style: str, state: str, console: Console) -> None:
    grid = Table.grid(expand=True)
    grid.add_column(overflow="fold")
    grid.add_column(justify="right", no_wrap=True)
    grid.add_row(Text(label, style="bold"), Text(status, style=style))
    console.print(grid)
    console.print(Text(f"  {state}", style="dim"))


def _print_failure(solution: Solution, label: str, console: Console) -> None:
    status = Status(int(solution.status)).text
    _headline(label, "NOT CONVERGED", "bold red", f"status: {status}", console)
    console.print(Padding(Text(solution.failure(), style="red"), (0, 2)))
    console.print(Padding(Text("No results: the point where the iteration stopped is not a solution."), (0, 2)))
    _line("Operating point", operating_point(solution), console)


def _line(name: str, text: str, console: Console) -> None:
    grid = Table.grid(padding=(0, 2, 0, 0))
    grid.add_column(width=18, no_wrap=True)
    grid.add_column(overflow="fold")
    grid.add_row(Text(f"  {name}"), Text(text))
    console.print(grid)


def _print_losses(solution: Solution, console: Console) -> None:
    loss = solution.power_loss
    entries = {
        field.name: float(np.asarray(getattr(loss, field.name)))
        for field in dataclasses.fields(loss)
        if getattr(loss, field.name) is not None
    }
    total = entries.pop("total")
    if not entries:
        return
    largest = max(abs(watts) for watts in entries.values())
    entries = dict(sorted(entries.items(), key=lambda entry: -entry[1]))
    watts = _watts([*entries.values(), total, float(solution.drive_power)])
    columns = {
        "Power loss": [*entries, "total"],
        "W": watts[:-1],
        "%": [f"{100.0 * value / total:.1f}" if total else "-" for value in entries.values()] + ["100.0"],
    }
    fractions = [value / (largest or 1.0) for value in entries.values()]
    console.print(Rule("Power", align="left", style="dim"))
    _print_table(columns, fractions, _LOSS_BAR, "red", console)
    torques = [f"{digits(float(solution.inner_torque))} N m on the inner ring"]
    if float(np.asarray(solution.operation.outer_speed)) != 0.0:
        torques.append(f"{digits(float(solution.outer_torque))} N m on the outer ring")
    _line("Drive power", f"{watts[-1]} W   ({', '.join(torques)})", console)


def _watts(values: list[float]) -> list[str]:
    """Powers of one column: tenths of a watt, or more decimals where the largest has less than four digits then."""
    largest = max(abs(value) for value in values)
    if not 1e-4 <= largest < math.inf:
        return [digits(value) for value in values]
    decimals = max(1, 3 - math.floor(math.log10(largest)))
    return [f"{value:.{decimals}f}" for value in values]


def _print_table(
    columns: dict[str, list[str]], fractions: list[float], longest: int, style: str, console: Console
) -> None:
    """Columns of texts, the first row's title above each; bars at the right where there is room.

    A text more than there are fractions is a total, below a line.
    """
    width = _width(columns)
    room = min(longest, console.width - width - _GAP)
    total = len(next(iter(columns.values()))) > len(fractions)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), show_footer=total, header_style="")
    for title, texts in columns.items():
        named = title == "Power loss"
        footer = texts[-1] if total else ""
        table.add_column(title, justify="left" if named else "right", footer=footer, no_wrap=True)
    if room >= _SHORTEST_BAR:
        table.add_column("", width=room)
    for i, fraction in enumerate(fractions):
        bars = [_bar(fraction, room, style, console)] if room >= _SHORTEST_BAR else []
        table.add_row(*(texts[i] for texts in columns.values()), *bars)
    console.print(Padding(table, (0, 1)))


def _width(columns: dict[str, list[str]]) -> int:
    """Of the table of these columns, margins included."""
    widths = [max(map(len, [*title.split("\n"), *texts])) for title, texts in columns.items()]
    return sum(widths) + _GAP * (len(widths) - 1) + 4


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

    rows = np.array(sorted(np.flatnonzero(loaded), key=lambda j: azimuth[j]), dtype=int)
    first = {"azimuth\ndeg": [f"{azimuth[j]:.1f}" for j in rows]}
    columns = {
        f"{title}\n{display_unit(units[name])}": _column(np.asarray(getattr(elements, name))[rows], units[name])
        for name, title in shown.items()
    }
    fractions = [float(load[j]) / largest for j in rows]
    console.print(Rule("Loads round the bearing", align="left", style="dim"))
    for piece in _pieces(first, columns, console.width):
        _print_table(piece, fractions, _LOAD_BAR, "cyan", console)
    _line("Loaded zone", _loaded_zone(azimuth, loaded), console)
    if not np.all(loaded):
        ranges = [
            f"{title} {_range(np.asarray(getattr(elements, name))[~loaded], units[name])}"
            for name, title in shown.items()
            if name.startswith("load")
        ]
        _line("Other rollers", ", ".join(ranges), console)


def _pieces(first: dict[str, list[str]], columns: dict[str, list[str]], width: int) -> Iterator[dict[str, list[str]]]:
    """The columns, inner and outer race together, in tables that fit the width; each begins with the first column."""
    piece = dict(first)
    items = list(columns.items())
    for i in range(0, len(items), 2):
        pair = items[i : i + 2]
        if len(piece) > 1 and _width(piece | dict(pair)) > width:
            yield piece
            piece = dict(first)
        piece |= dict(pair)
    yield piece


def _column(values: np.ndarray, unit: str) -> list[str]:
    """The numbers of a column, with as many decimals as its largest needs for four digits."""
    shown = [displayed(float(value), unit) for value in values]
    if not shown:
        return []
    _, _, decimals = digits(max(shown, key=abs), 4).partition(".")
    return [f"{value:.{len(decimals)}f}" for value in shown]


def _loaded_zone(azimuth: np.ndarray, loaded: np.ndarray) -> str:
    count = f"{int(np.sum(loaded))} of {loaded.size} rollers above {100.0 * LOADED:.0f} % of the largest load"
    if np.all(loaded) or not np.any(loaded):
        return count
    return f"{count}, {np.min(azimuth[loaded]):.0f} to {np.max(azimuth[loaded]):.0f} deg"


def _range(values: np.ndarray, unit: str) -> str:
    low, high = (digits(displayed(float(value), unit), 3) for value in (np.min(values), np.max(values)))
    return f"{low if low == high else f'{low} to {high}'} {display_unit(unit)}"


def _facts(solution: Solution) -> Iterator[tuple[str, str]]:
    if solution.cage is not None:
        cage = solution.cage
        slip = f"slip {digits(100.0 * float(cage.slip), 3)} %"
        place = f"eccentricity ratio {digits(float(cage.eccentricity_ratio), 3)}"
        angle = f"attitude angle {with_unit(float(cage.attitude_angle), 'rad', 3)}"
        yield "Cage", f"{with_unit(float(cage.speed), 'rad/s')}, {slip}, {place}, {angle}"
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
