"""Sensitivities on the screen: the inputs that decide each result."""

from collections.abc import Mapping

from jaxtyping import Array
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from ..sensitivity import PowerInterval, Sensitivities, largest
from .display import digits, with_unit

SHOWN = 5
"""Number of inputs that are shown for each result."""
UNCERTAIN = ("drag.coefficient",)
"""Poorly known inputs, which are always shown."""
LAW_CONSTANTS = ("oil.", "contact.")
"""Constants of laws: an engineer does not choose them one by one; the oil's temperature stands for them here."""


TITLES = {
    "power_loss": "d ln(power) / d ln(input)",
    "slip": "d(slip) / d ln(input)",
    "life": "d ln(L10r) / d ln(input)",
    "modified_life": "d ln(Lnmr) / d ln(input)",
    "film": "d ln(central film) / d ln(input)",
    "traction": "d ln(traction coefficient) / d ln(input)",
}
ABREAST = 2
"""Results side by side: more do not fit into the width of a terminal."""


def print_sensitivities(sensitivities: Sensitivities, console: Console, interval: PowerInterval | None = None) -> None:
    """The five largest of each result, and always the inputs that nobody knows well; limits of the power loss by the
    drag coefficient, where they are given."""
    console.print(Rule("Sensitivities", align="left", style="dim"))
    modelled = list(sensitivities.modelled().items())
    for first in range(0, len(modelled), ABREAST):
        console.print(Padding(_table(modelled[first : first + ABREAST]), (0, 1)))
    text = "Per cent for one per cent of the input (slip: absolute). Temperatures in K. More: --json."
    console.print(Padding(Text(text, style="dim"), (0, 2)))
    if interval is not None:
        limits = " and ".join(with_unit(one, "W") for one in (interval.low, interval.high))
        text = f"Power loss {with_unit(interval.value, 'W')}, 90 % between {limits}, by {interval.by} alone"
        console.print(Padding(Text(f"{text} ({interval.assumed})."), (0, 2)))


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
