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


def print_comparison(found: Comparison, label: str, console: Console, full: bool = False) -> None:
    """Prints moments and losses of the physical model and of each formula, then assumptions and warnings.

    **Arguments:** `full`: all columns, even if they do not fit into the width of the terminal.
    """
    covered = [one for one in found.laws if one.total is not None]
    headline(label, "CONVERGED", "bold green", _duty(found), console)
    print_rule("Moments in N mm, power in W, ratio of the totals to the physical one", console)
    rows = comparison_rows(found)
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
    for one in covered:
        if one.assumed:
            print_line(NAMES[one.law], f"assumed: {'; '.join(one.assumed)}", console, 20)
    print_warnings(comparison_notes(found), console, full)


def comparison_rows(found: Comparison) -> list[tuple[str, ...]]:
    """Rows of texts for the columns `HEADINGS`: the physical model, then each formula; "-" for a missing value."""
    return [_row("physical model", found.physical), *(_row(NAMES[one.law], one) for one in found.laws)]


def comparison_notes(found: Comparison) -> list[str]:
    """Notes in words: formulas used outside their range, missing inputs, and the notes of the comparison itself."""
    return [*_of_laws(found), *found.notes]


def comparison_listing(found: Comparison) -> Listing:
    """The comparison as a table of the report page."""
    assumed = [f"{NAMES[one.law]}: assumed: {'; '.join(one.assumed)}" for one in found.laws if one.assumed]
    units = {"power": ", W", "ratio": " to the physical model", "": ""}
    headings = [f"{name}{units.get(name, ', N mm')}" for name in HEADINGS]
    remarks = [NOTE, *comparison_notes(found), *assumed]
    return Listing("Beside the makers' formulas", headings, comparison_rows(found), remarks)


def comparison_to_dict(found: Comparison) -> dict[str, Any]:
    """The comparison for JSON: numbers in SI units, `None` where they are not finite."""
    physical = found.physical
    return {
        "converged": True,
        "status": "converged",
        "physical": {
            "total": _finite(physical.total),
            "power": _finite(physical.power),
            "parts": _moments(physical.parts),
            "power_loss": _moments(physical.locations),
        },
        "laws": [_law(one) for one in found.laws],
        "spread": _finite(found.spread),
        "duty": {name: value if isinstance(value, str) else _finite(value) for name, value in found.duty.items()},
        "warnings": comparison_notes(found),
    }


def _law(one: Law) -> dict[str, Any]:
    numbers = {name: _finite(getattr(one, name)) for name in ("total", "power", "ratio")}
    words = {name: list(getattr(one, name)) for name in ("flags", "assumed", "missing")}
    return {"law": one.law, **numbers, "parts": _moments(one.parts), "inside_range": one.inside_range, **words}


def _moments(values: Mapping[str, float | None]) -> dict[str, float | None]:
    return {name: _finite(value) for name, value in values.items()}


def _finite(value: float | None) -> float | None:
    return None if value is None else finite(value)


def _row(name: str, one: Law | Physical) -> tuple[str, ...]:
    ratio = "1" if isinstance(one, Physical) and one.total else _text(getattr(one, "ratio", None), 1.0, 3)
    parts = (_text(one.parts.get(part), 1e3) for part in PARTS)
    return (name, _text(one.total, 1e3), _text(one.power, 1.0), ratio, *parts)


def _text(value: float | None, factor: float, significant: int = 4) -> str:
    return "-" if value is None else digits(factor * value, significant)


def _of_laws(found: Comparison) -> Iterator[str]:
    for one in found.laws:
        if one.total is None:
            yield f"{NAMES[one.law]}: no moment; {'; '.join(one.missing)}"
            continue
        yield from (f"{NAMES[one.law]}: outside its range: {text}" for text in one.flags)
        yield from (f"{NAMES[one.law]}: left out: {text}" for text in one.missing)


def _duty(found: Comparison) -> str:
    duty, said = found.duty, []
    if duty["family"]:
        said.append(f"{duty['family'].replace('_', ' ')}, series {duty['series'] or 'not given'}")
    said.append(f"{digits(duty['speed'] * 30.0 / np.pi)} rpm")
    said.append(f"Fr {digits(duty['radial'])} N, Fa {digits(duty['axial'])} N")
    if duty["viscosity"] is not None:
        said.append(f"{digits(1e6 * duty['viscosity'])} mm^2/s")
    said.append(f"dm {digits(1e3 * duty['mean_diameter'])} mm")
    return ", ".join(said)
