"""Sensitivities on the screen: the inputs with the largest influence on each result."""

import math
from collections.abc import Mapping
from typing import Any

from jaxtyping import Array
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from .._scene import AbstractScene
from ..loss_interval import PowerInterval, not_counted
from ..sensitivity import ABSOLUTE, Sensitivities, UsualTolerance, largest
from .display import digits, with_unit

SHOWN = 5
"""Number of inputs that are shown for each result."""
SMALL = 0.01
"""Width of an input's interval relative to the widest one, below which the interval is not printed."""
UNCERTAIN = ("drag.coefficient",)
"""Poorly known inputs, which are always shown."""
LAW_CONSTANTS = ("oil.", "contact.")
"""Beginnings of the paths of law constants, which are not listed: an engineer does not choose them one by one; the
temperature of the oil represents them."""


NAMES = {
    "power_loss": "power loss",
    "slip": "cage slip",
    "life": "life L10r",
    "modified_life": "life Lnmr",
    "stiffness": "radial stiffness",
    "axial_stiffness": "axial stiffness",
    "temperature": "hottest node",
    "film": "central film",
    "traction": "traction",
}
TITLES = {
    "power_loss": "d ln(power) / d ln(input)",
    "slip": "d(slip) / d ln(input)",
    "life": "d ln(L10r) / d ln(input)",
    "modified_life": "d ln(Lnmr) / d ln(input)",
    "stiffness": "d ln(radial stiffness) / d ln(input)",
    "axial_stiffness": "d ln(axial stiffness) / d ln(input)",
    "temperature": "d(hottest node, K) / d ln(input)",
    "film": "d ln(central film) / d ln(input)",
    "traction": "d ln(traction coefficient) / d ln(input)",
}
ABREAST = 2
"""Number of results side by side, as many as fit into the width of a terminal."""


def print_sensitivities(sensitivities: Sensitivities, console: Console, interval: PowerInterval | None = None) -> None:
    """Prints the `SHOWN` largest sensitivities of each result, always those of `UNCERTAIN` inputs, and the interval of
    the power loss if it is given."""
    console.print(Rule("Sensitivities", align="left", style="dim"))
    modelled = list(sensitivities.modelled().items())
    for first in range(0, len(modelled), ABREAST):
        console.print(Padding(_table(modelled[first : first + ABREAST]), (0, 1)))
    text = "Per cent for one per cent of the input (slip, temperature: absolute). Temperatures in K. More: --json."
    console.print(Padding(Text(text, style="dim"), (0, 2)))
    _print_interval(interval, console)


def print_effects(
    scene: AbstractScene,
    effects: Mapping[str, Mapping[str, float]],
    tolerances: Mapping[str, UsualTolerance],
    console: Console,
    interval: PowerInterval | None = None,
) -> None:
    """Prints the inputs whose usual tolerances change each result most. **Arguments:** `effects`: result of
    `sensitivity.effects`."""
    units = {path: _unit_of(scene, path) for path in tolerances}
    console.print(Rule("Sensitivities, by usual tolerances", align="left", style="dim"))
    for name, changes in effects.items():
        console.print(Padding(_effects_table(name, changes, tolerances, units), (0, 1)))
    text = (
        "Change of the result for one tolerance of the input, to first order. Inputs without a usual tolerance are "
        "left out: --sensitivities-by percent has them all."
    )
    console.print(Padding(Text(text, style="dim"), (0, 2)))
    _print_interval(interval, console)


def _effects_table(
    name: str, changes: Mapping[str, float], tolerances: Mapping[str, UsualTolerance], units: Mapping[str, str]
) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column("input", no_wrap=True)
    table.add_column(NAMES[name], justify="right", no_wrap=True)
    table.add_column("for", justify="right", no_wrap=True)
    table.add_column("", overflow="fold")
    for path in ranked(changes)[:SHOWN]:
        tolerance = tolerances[path]
        size = with_unit(tolerance.size, units.get(path, "1"), 3)
        table.add_row(path, _effect(name, changes[path]), f"+{size}", tolerance.reason)
    return table


def _unit_of(scene: AbstractScene, path: str) -> str:
    """SI unit of the field of a scene at `path`; "1" if its class gives no unit."""
    above, _, last = path.rpartition(".")
    part: Any = scene.part_at(above) if above else scene
    return type(part).__dataclass_fields__[last].metadata.get("unit", "1")


def ranked(changes: Mapping[str, float]) -> list[str]:
    """Paths in descending order of the modulus of their effects, without those of zero or non-finite effect."""
    there = [path for path, value in changes.items() if value and math.isfinite(value)]
    return sorted(there, key=lambda path: -abs(changes[path]))


def _effect(name: str, value: float) -> str:
    """Text of a change: in K for a temperature, in percentage points for `ABSOLUTE` results, else in per cent."""
    sign = "+" if value > 0.0 else ""
    if name == "temperature":
        return f"{sign}{digits(value, 3)} K"
    points = " points" if name in ABSOLUTE else " %"
    return f"{sign}{digits(100.0 * value, 3)}{points}"


def _print_interval(interval: PowerInterval | None, console: Console) -> None:
    if interval is None:
        return
    limits = " and ".join(with_unit(limit, "W") for limit in (interval.low, interval.high))
    text = f"Power loss {with_unit(interval.value, 'W')}, 90 % between {limits}"
    left_out = not_counted(part.path for part in interval.parts)
    if len(interval.parts) == 1:
        console.print(Padding(Text(f"{text}, by {interval.by} alone ({interval.assumed}); {left_out}."), (0, 2)))
        return
    sentence = f"{text} (counted: only the inputs below; {left_out}), mostly by {interval.by}. By each input alone:"
    console.print(Padding(Text(sentence), (0, 2)))
    width = lambda part: part.high - part.low
    small = [part.path for part in interval.parts if width(part) < SMALL * width(interval.parts[0])]
    for part in interval.parts[: len(interval.parts) - len(small)]:
        ends = " and ".join(with_unit(limit, "W") for limit in (part.low, part.high))
        console.print(Padding(Text(f"{part.path}: between {ends} ({part.assumed})", style="dim"), (0, 4)))
    if small:
        text = f"{', '.join(small)}: less than {digits(100.0 * SMALL)} % of the first of these"
        console.print(Padding(Text(text, style="dim"), (0, 4)))


def _table(results: list[tuple[str, dict[str, Array]]]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    rows = [_rows(values) for _, values in results]
    for name, _ in results:
        table.add_column(TITLES[name], no_wrap=True)
        table.add_column("", justify="right", no_wrap=True)
    for i in range(max(map(len, rows))):
        cells = (row[i] if i < len(row) else ("", "") for row in rows)
        table.add_row(*(text for cell in cells for text in cell))
    return table


def _rows(values: Mapping[str, Array]) -> list[tuple[str, str]]:
    paths = largest(values, SHOWN, LAW_CONSTANTS)
    paths += [path for path in UNCERTAIN if path in values and path not in paths]
    return [
        (path, f"{float(values[path]):+.3f}" if abs(float(values[path])) >= 1e-3 else _small(values[path]))
        for path in paths
    ]


def _small(value: Array) -> str:
    sign = "+" if float(value) > 0.0 else ""
    return sign + digits(float(value), 3)
