"""Friction by makers' formulas compared with the physical model: on the screen, as JSON, as a table of a page."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table

from ..makers import Comparison, Law, Physical
from .backends.json import finite
from .backends.screen import headline, print_line, print_rule, print_warnings, shown_pieces
from .display import digits
from .page_content import Listing

NAMES = {
    "skf": "SKF",
    "palmgren_ina": "Palmgren, INA",
    "palmgren_timken": "Palmgren, Timken",
    "timken_tapered": "Timken",
}
"""Name of a formula in the code -> its name in tables."""
PARTS = ("rolling", "sliding", "seal", "drag", "viscous", "load")
HEADINGS = ("", "total", "power", "ratio", *PARTS)
"""Columns of the table: total moment, power loss, ratio of the total to that of the physical model, partial moments."""
NOTE = (
    "The formulas of makers are fits to catalogue bearings and differ among themselves by two to three; no result of "
    "the package contains them."
)


def print_comparison(comparison: Comparison, label: str, console: Console, full: bool = False) -> None:
    """Prints moments and losses of the physical model and of each formula, then assumptions and warnings.

    **Arguments:** `full`: all columns, even if they do not fit into the width of the terminal.
    """
    covered = [law for law in comparison.laws if law.total is not None]
    headline(label, "CONVERGED", "bold green", _duty(comparison), console)
    print_rule("Moments in N mm, power in W, ratio of the totals to the physical one", console)
    rows = comparison_rows(comparison)
    texts = {heading: [row[i] for row in rows] for i, heading in enumerate(HEADINGS)}
    names = {"": texts.pop("")}
    shown = {name: column for name, column in texts.items() if name not in PARTS or set(column) != {"-"}}
    for piece in shown_pieces(names, shown, console, full):
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
        for name in piece:
            table.add_column(name, justify="right" if name else "left", no_wrap=True)
        for row in zip(*piece.values(), strict=True):
            table.add_row(*row)
        console.print(Padding(table, (0, 1)))
    for law in covered:
        if law.assumed:
            print_line(NAMES[law.law], f"assumed: {'; '.join(law.assumed)}", console, 20)
    print_warnings(comparison_notes(comparison), console, full)


def comparison_rows(comparison: Comparison) -> list[tuple[str, ...]]:
    """Rows of texts for the columns `HEADINGS`: the physical model, then each formula; "-" for a missing value."""
    return [_row("physical model", comparison.physical), *(_row(NAMES[law.law], law) for law in comparison.laws)]


def comparison_notes(comparison: Comparison) -> list[str]:
    """Notes in words: formulas used outside their range, missing inputs, and the notes of the comparison itself."""
    return [*_law_notes(comparison), *comparison.notes]


def comparison_listing(comparison: Comparison) -> Listing:
    """The comparison as a table of the report page."""
    assumed = [f"{NAMES[law.law]}: assumed: {'; '.join(law.assumed)}" for law in comparison.laws if law.assumed]
    units = {"power": ", W", "ratio": " to the physical model", "": ""}
    headings = [f"{name}{units.get(name, ', N mm')}" for name in HEADINGS]
    remarks = [NOTE, *comparison_notes(comparison), *assumed]
    return Listing("Beside the makers' formulas", headings, comparison_rows(comparison), remarks)


def comparison_to_dict(comparison: Comparison) -> dict[str, Any]:
    """The comparison for JSON: numbers in SI units, `None` where they are not finite."""
    physical = comparison.physical
    return {
        "converged": True,
        "status": "converged",
        "physical": {
            "total": _finite(physical.total),
            "power": _finite(physical.power),
            "parts": _moments(physical.parts),
            "power_loss": _moments(physical.locations),
        },
        "laws": [_law(law) for law in comparison.laws],
        "spread": _finite(comparison.spread),
        "duty": {name: value if isinstance(value, str) else _finite(value) for name, value in comparison.duty.items()},
        "warnings": comparison_notes(comparison),
    }


def _law(law: Law) -> dict[str, Any]:
    numbers = {name: _finite(getattr(law, name)) for name in ("total", "power", "ratio")}
    words = {name: list(getattr(law, name)) for name in ("flags", "assumed", "missing")}
    return {"law": law.law, **numbers, "parts": _moments(law.parts), "inside_range": law.inside_range, **words}


def _moments(values: Mapping[str, float | None]) -> dict[str, float | None]:
    return {name: _finite(value) for name, value in values.items()}


def _finite(value: float | None) -> float | None:
    return None if value is None else finite(value)


def _row(name: str, model: Law | Physical) -> tuple[str, ...]:
    ratio = "1" if isinstance(model, Physical) and model.total else _text(getattr(model, "ratio", None), 1.0, 3)
    parts = (_text(model.parts.get(part), 1e3) for part in PARTS)
    return (name, _text(model.total, 1e3), _text(model.power, 1.0), ratio, *parts)


def _text(value: float | None, factor: float, significant: int = 4) -> str:
    return "-" if value is None else digits(factor * value, significant)


def _law_notes(comparison: Comparison) -> Iterator[str]:
    for law in comparison.laws:
        if law.total is None:
            yield f"{NAMES[law.law]}: no moment; {'; '.join(law.missing)}"
            continue
        yield from (f"{NAMES[law.law]}: outside its range: {text}" for text in law.flags)
        yield from (f"{NAMES[law.law]}: left out: {text}" for text in law.missing)


def _duty(comparison: Comparison) -> str:
    duty, texts = comparison.duty, []
    if duty["family"]:
        texts.append(f"{duty['family'].replace('_', ' ')}, series {duty['series'] or 'not given'}")
    texts.append(f"{digits(duty['speed'] * 30.0 / np.pi)} rpm")
    texts.append(f"Fr {digits(duty['radial'])} N, Fa {digits(duty['axial'])} N")
    if duty["viscosity"] is not None:
        texts.append(f"{digits(1e6 * duty['viscosity'])} mm^2/s")
    texts.append(f"dm {digits(1e3 * duty['mean_diameter'])} mm")
    return ", ".join(texts)
