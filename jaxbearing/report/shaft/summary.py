"""Summary of a shaft on the screen: a row for each bearing, then life, sets, warnings and the shaft itself."""

from rich.console import Console

from ...numerics.status import Status
from ...shafts.solution import DutyResult, ShaftSolution
from ..backends.screen import (
    counted,
    headline,
    print_failure,
    print_line,
    print_rule,
    print_table,
    print_warnings,
    shown_pieces,
)
from .facts import (
    NAMES,
    bearing_columns,
    duty_lives,
    left_out,
    life_columns,
    life_facts,
    overloads,
    set_facts,
    shaft_facts,
    shaft_warnings,
)


def print_summary(solution: ShaftSolution, scene_label: str, console: Console, full: bool = False) -> None:
    """Prints the summary of a shaft; see `report.summary.print_summary`.

    **Arguments:** `full`: print all columns of the tables, and the summary of each bearing below.
    """
    if not bool(solution.converged):
        print_failure(scene_label, Status(int(solution.status)).text, solution.failure(), console)
        print_warnings(solution.warnings, console, full)
        return
    steps = f"{int(solution.start_steps)} + {int(solution.newton_steps)} Newton steps"
    counts = f"{counted(solution.unknowns, 'unknown')} of the shaft, {counted(len(solution.bearings), 'bearing')}"
    state = f"{steps}, {counts}, largest scaled residual {float(solution.residual_norm):.1e}"
    headline(scene_label, "CONVERGED", "bold green", state, console)
    _print_bearings(solution, console, full)
    print_warnings(shaft_warnings(solution), console, full)
    print_rule("Shaft", console)
    for name, text in shaft_facts(solution):
        print_line(name, text, console)
    if solution.duty is not None:
        _print_duty(solution.duty, console)
    if full:
        from ..bearing.summary import print_summary as print_bearing

        for name, bearing in solution.bearings.items():
            if bearing.solution is not None:
                print_bearing(bearing.solution, name, console, full)


def _print_bearings(solution: ShaftSolution, console: Console, full: bool) -> None:
    print_rule("Bearings", console)
    for name, text in overloads(solution):
        print_line(name, text, console)
    _print_columns(bearing_columns(solution), console, full)
    print_line("", "Forces of the bearings on the shaft; azimuths from Y in the sense of rotation.", console, 0)
    columns = life_columns(solution, wide=False)
    if columns:
        _print_columns(columns, console, full)
    for name, text in (*life_facts(solution), *set_facts(solution)):
        print_line(name, text, console)
    if left_out(solution):
        print_line("Not modelled:", left_out(solution), console)


def _print_columns(columns: dict[str, list[str]], console: Console, full: bool) -> None:
    first = {NAMES: columns[NAMES]}
    rest = {heading: texts for heading, texts in columns.items() if heading != NAMES}
    for piece in shown_pieces(first, rest, console, full):
        print_table(piece, [0.0] * len(first[NAMES]), 0, "", console, named=NAMES)


def _print_duty(duty: DutyResult, console: Console) -> None:
    print_rule("Duty cycle", console)
    shares = ", ".join(
        f"{name} {100.0 * float(share):.4g} %" for name, share in zip(duty.names, duty.shares, strict=True)
    )
    print_line("States", shares, console)
    for name, text in duty_lives(duty):
        print_line(name, text, console)
