"""Summary of a fit on the screen."""

from collections.abc import Iterable, Sequence

import numpy as np
from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from jaxbearing.report.backends.screen import column, counted, headline, print_failure, print_line, print_rule, width
from jaxbearing.report.display import ZERO_CELSIUS, digits

from ..comparison import ModelRow
from ..result import FitResult
from .words import SYMBOL, held, parameter_text, percent

CURVES = 40
"""Largest number of curves that are shown; the rest are only counted."""
STRONG = 0.95
"""Magnitude of a correlation above which two parameters are named as strongly correlated."""
_SHORTEST_NAME, _GAP = 5, 3
"""Least width of a curve's name, and width of the gap between two columns, in characters."""
WIDE = 110
"""Width of the screen, in characters, from which the table of parameters also shows their full names."""


def print_fit(result: FitResult, data: str, scene: str, notes: Iterable[str], console: Console) -> None:
    """Print one fit or, if it failed, only the reason.

    **Arguments:**
    - `data`, `scene`: names of the file and of the scene.
    - `notes`: notes on the file and the scene, which follow those of the fit.
    """
    if result.status == "not_converged":
        print_failure(data, result.status, result.failure(), console)
        return
    points = counted(len(result.predicted), "point")
    state = f"{points} in {counted(len(result.curves), 'curve')}, rms of the differences {digits(result.rms, 3)}"
    colour = "bold green" if result.converged else "bold yellow"
    headline(data, result.status.upper(), colour, f"{state} in traction coefficient", console)
    if not result.converged:
        print_line("Why", result.reason, console)
    print_line("Scene", scene, console)
    print_line("Viscous function", result.model, console)
    steps = f"{result.method}, {result.options.loss} loss, {counted(result.steps, 'step')}"
    agreeing, total = result.starts
    print_line("Method", f"{steps}; {agreeing} of {counted(total, 'start')} ended here", console)
    print_rule("Parameters of the oil's rheology", console)
    _print_parameters(result, console)
    print_rule("Curves", console)
    _print_curves(result, console)
    if len(result.fitted) > 1:
        print_rule("Correlation of the fitted parameters", console)
        _print_correlation(result, console)
    texts = [*result.notes, *notes]
    if texts:
        print_rule("Notes", console)
    for text in texts:
        console.print(Padding(Text(f"- {text}", style="yellow"), (0, 2)))


def print_comparison(rows: Sequence[ModelRow], console: Console) -> None:
    """Print the fits of several models, the best first; a fit that failed is listed without numbers."""
    print_rule("Models, the lowest BIC first", console)
    table = _table()
    for title, justify in (("Viscous function", "left"), *((name, "right") for name in _COMPARED)):
        table.add_column(title, justify=justify, no_wrap=True)  # pyright: ignore[reportArgumentType]
    for row in rows:
        if not row.converged:
            table.add_row(row.model, *["-"] * (len(_COMPARED) - 1), "not converged")
            continue
        crossed = "-" if row.cross_validated_rms is None else digits(row.cross_validated_rms, 3)
        numbers = (f"{row.bic:.1f}", f"{row.bic - rows[0].bic:.1f}", f"{row.aic:.1f}")
        table.add_row(row.model, str(row.parameters), digits(row.rms, 3), *numbers, crossed)
    console.print(Padding(table, (0, 1)))
    text = "BIC - best: 2 is little, 10 strong evidence against a model. Left out: each curve is predicted from a fit "
    _small(text + "of the others.", console)


_COMPARED = ("Fitted", "rms", "BIC", "BIC - best", "AIC", "rms, left out")


def _print_parameters(result: FitResult, console: Console) -> None:
    wide = console.width >= WIDE
    table = _table()
    table.add_column("Symbol", no_wrap=True)
    if wide:
        table.add_column("Name", no_wrap=True)
    table.add_column("Value", justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    table.add_column("Std. error", justify="right", no_wrap=True)
    table.add_column(f"{percent(result.level)} interval", overflow="fold")
    for name, parameter in result.parameters.items():
        text = parameter_text(name, parameter)
        interval = text.interval or Text(held(parameter), style="dim")
        table.add_row(SYMBOL[name], *([name] if wide else []), text.value, text.unit, text.error, interval)
    console.print(Padding(table, (0, 1)))
    if not wide:
        _small(", ".join(f"{symbol}: {name}" for name, symbol in SYMBOL.items()), console)


def _print_curves(result: FitResult, console: Console) -> None:
    curves = result.curves[:CURVES]
    columns = {
        "Points": [str(curve.points) for curve in curves],
        "p0, GPa": column(np.asarray([curve.pressure for curve in curves]), "Pa"),
        "u, m/s": [f"{curve.entrainment_speed:.4g}" for curve in curves],
        "T, degC": [f"{curve.temperature - ZERO_CELSIUS:.1f}" for curve in curves],
        "Deborah": [f"{curve.deborah_number:.3g}" for curve in curves],
        "rms": [digits(curve.rms, 3) for curve in curves],
    }
    table = _table()
    # names may be cut, numbers may not
    room = max(_SHORTEST_NAME, console.width - width(columns) - _GAP)
    table.add_column("Curve", no_wrap=True, max_width=room, overflow="ellipsis")
    for title in columns:
        table.add_column(title, justify="right", no_wrap=True)
    for number, curve in enumerate(curves):
        table.add_row(Text(curve.name), *(texts[number] for texts in columns.values()))
    console.print(Padding(table, (0, 1)))
    if len(result.curves) > CURVES:
        _small(f"and {counted(len(result.curves) - CURVES, 'curve')} more: see --json", console)


def _print_correlation(result: FitResult, console: Console) -> None:
    symbols = [SYMBOL[name] for name in result.fitted]
    table = _table()
    table.add_column("")
    for symbol in symbols[:-1]:
        table.add_column(symbol, justify="right", no_wrap=True)
    for number, symbol in enumerate(symbols[1:], start=1):
        values = result.correlation[number, :number]
        table.add_row(symbol, *(f"{value:+.2f}" if np.isfinite(value) else "unknown" for value in values))
    console.print(Padding(table, (0, 1)))
    strong = [
        f"{symbols[j]} and {symbols[i]} ({result.correlation[i, j]:+.3f})"
        for i in range(len(symbols))
        for j in range(i)
        if abs(result.correlation[i, j]) > STRONG
    ]
    if strong:
        text = f"Strongly correlated: {', '.join(strong)}. Their combination is known better than each of them: G0 and "
        _small(text + "tau0 are extrapolations to p = 0 and the reference temperature.", console)


def _table() -> Table:
    return Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")


def _small(text: str, console: Console) -> None:
    console.print(Padding(Text(text, style="dim"), (0, 2)))
