"""Parts of a summary on the screen: headline, lines, tables with bars, warnings. If a terminal is too narrow, a table
is split into several: numbers are never cut."""

from collections.abc import Iterable, Iterator

import numpy as np
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from ..._checks import in_groups
from ..display import bar, digits, displayed

_SHORTEST_BAR = 4
_GAP = 3
"""Number of characters between two columns of a table."""


def counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def headline(label: str, status: str, style: str, state: str, console: Console) -> None:
    grid = Table.grid(expand=True)
    grid.add_column(overflow="fold")
    grid.add_column(justify="right", no_wrap=True)
    grid.add_row(Text(label, style="bold"), Text(status, style=style))
    console.print(grid)
    console.print(Text(f"  {state}", style="dim"))


def print_failure(label: str, status: str, reason: str, console: Console) -> None:
    """Prints why a solve failed, instead of results."""
    headline(label, "NOT CONVERGED", "bold red", f"status: {status}", console)
    console.print(Padding(Text(reason, style="red"), (0, 2)))
    console.print(Padding(Text("No results: the point where the iteration stopped is not a solution."), (0, 2)))


def print_warnings(warnings: Iterable[str], console: Console, full: bool = False) -> None:
    """Prints warnings in three groups: warnings that need action, assumptions, and information.

    **Arguments:** `full`: lists all assumptions; otherwise, if there are several, only their number is printed.
    """
    act, assumed, information = in_groups(warnings)
    if act:
        console.print(Rule("Warnings", align="left", style="yellow"))
    for text in act:
        console.print(Padding(Text(f"- {text}", style="yellow"), (0, 2)))
    if assumed or information:
        print_rule("Notes", console)
    if len(assumed) > 1 and not full:
        console.print(Padding(Text(f"- assumed: {len(assumed)} entries, which solve --full lists"), (0, 2)))
        assumed = []
    for text in (*(f"assumed: {text}" for text in assumed), *information):
        console.print(Padding(Text(f"- {text}"), (0, 2)))


def print_rule(title: str, console: Console) -> None:
    console.print(Rule(title, align="left", style="dim"))


def print_line(name: str, text: str, console: Console, columns: int = 18) -> None:
    """Prints a name, padded to `columns` characters, and the text that belongs to it."""
    grid = Table.grid(padding=(0, 2, 0, 0))
    grid.add_column(width=columns, no_wrap=True)
    grid.add_column(overflow="fold")
    grid.add_row(Text(f"  {name}"), Text(text))
    console.print(grid)


def print_table(
    columns: dict[str, list[str]],
    fractions: list[float],
    longest: int,
    style: str,
    console: Console,
    named: str = "Power loss",
) -> None:
    """Prints columns of texts, each below its title, and bars at the right if there is room.

    If the columns have one text more than there are `fractions`, the last row is a total and stands below a line.
    **Arguments:** `named`: title of the column that holds words and is aligned left.
    """
    used = width(columns)
    room = min(longest, console.width - used - _GAP)
    total = len(next(iter(columns.values()))) > len(fractions)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), show_footer=total, header_style="")
    for title, texts in columns.items():
        footer = texts[-1] if total else ""
        table.add_column(title, justify="left" if title == named else "right", footer=footer, no_wrap=True)
    if room >= _SHORTEST_BAR:
        table.add_column("", width=room)
    for i, fraction in enumerate(fractions):
        bars = [_bar(fraction, room, style, console)] if room >= _SHORTEST_BAR else []
        table.add_row(*(Text(texts[i]) for texts in columns.values()), *bars)
    console.print(Padding(table, (0, 1)))


def width(columns: dict[str, list[str]]) -> int:
    """Width of a table of these columns, including margins, in characters."""
    widths = [max(map(len, [*title.split("\n"), *texts])) for title, texts in columns.items()]
    return sum(widths) + _GAP * (len(widths) - 1) + 4


def _bar(fraction: float, width: int, style: str, console: Console) -> Text:
    return Text(bar(fraction, width, console.options.ascii_only), style=style)


def pieces(
    first: dict[str, list[str]], columns: dict[str, list[str]], room: int, together: int = 1
) -> Iterator[dict[str, list[str]]]:
    """Splits columns into tables that fit `room` as far as possible. Each table begins with the columns `first`; groups
    of `together` columns stay together."""
    piece = dict(first)
    items = list(columns.items())
    for i in range(0, len(items), together):
        group = items[i : i + together]
        if len(piece) > len(first) and width(piece | dict(group)) > room:
            yield piece
            piece = dict(first)
        piece |= dict(group)
    yield piece


def shown_pieces(
    first: dict[str, list[str]], columns: dict[str, list[str]], console: Console, full: bool, way: str = "--full"
) -> Iterator[dict[str, list[str]]]:
    """The table of the columns that fit the width of the console; with `full`, several tables with all columns. If
    columns are left out, a line after the table names them. **Arguments:** `way`: option that shows all columns."""
    each = list(pieces(first, columns, console.width))
    yield from each if full else each[:1]
    left = [title.replace("\n", " ") for piece in each[1:] for title in piece if title not in first]
    if left and not full:
        text = f"More columns: {way}, or a wider terminal ({', '.join(left)})"
        console.print(Padding(Text(text, style="dim"), (0, 2)))


def print_columns(
    first: dict[str, list[str]],
    columns: dict[str, list[str]],
    console: Console,
    full: bool,
    named: str,
    way: str = "--full",
) -> None:
    """Prints a table without bars, with the columns that fit the width (`shown_pieces`).

    **Arguments:** `named`: title of the column that holds words and is aligned left."""
    for piece in shown_pieces(first, columns, console, full, way):
        print_table(piece, [0.0] * len(piece[next(iter(first))]), 0, "", console, named)


def column(values: np.ndarray, unit: str) -> list[str]:
    """The numbers of a column as texts, all with as many decimals as the largest needs for four significant digits."""
    shown = [displayed(float(value), unit) for value in values]
    if not shown:
        return []
    _, _, decimals = digits(max(shown, key=abs), 4).partition(".")
    return [f"{value:.{len(decimals)}f}" for value in shown]
