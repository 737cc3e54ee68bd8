"""Summary of a transient run of a line contact on the screen."""

from rich.console import Console

from ....ehl import LineContactHistory
from ...backends.screen import headline, print_line, print_table, print_warnings
from ...display import with_unit
from .json_report import statistics


def print_summary(history: LineContactHistory, label: str, console: Console) -> None:
    """See `report.histories.print_history`."""
    numbers = statistics(history)
    steps = (
        f"{int(history.accepted)} steps ({int(history.rejected)} more tried), {int(history.newton_steps)} Newton steps"
    )
    reached = f"{1e3 * float(history.time[-1]):.6g} ms in {steps}"
    good = history.completed
    headline(label, "COMPLETED" if good else "NOT COMPLETED", "bold green" if good else "bold red", reached, console)
    if float(history.time[0]) > 0:
        console.print(f"goes on from {1e3 * float(history.time[0]):.6g} ms")
    if not good:
        console.print(history.failure(), style="bold red")
    rows = [("central film", numbers["central"], 1e6), ("smallest film", numbers["minimum"], 1e6)]
    rows += [("speed, mm/s", numbers["entrainment_speed"], 1e3)]
    columns = {"Film, um": [name for name, *_ in rows]}
    for key, title in (("start", "at the start"), ("min", "least"), ("max", "largest"), ("end", "at the end")):
        columns[title] = [f"{factor * values[key]:.5g}" for _, values, factor in rows]
    print_table(columns, [0.0] * len(rows), 0, "", console)
    place, width = numbers["minimum_position"], float(history.hertz.half_width)
    until = numbers["central_constant_until"]
    constant = "to the end" if until is None else f"until {1e3 * until:.4g} ms"
    print_line("Central film", f"within 1 % of its start {constant}", console)
    moved = f"at {place['start'] / width:+.3f} half widths at the start, {place['end'] / width:+.3f} at the end"
    print_line("Smallest film", moved, console)
    print_line("Largest pressure", with_unit(numbers["pressure_max"], "Pa"), console)
    print_line("Balance of mass", f"{numbers['mass_balance_error']:.1e}, the zone under pressure, worst step", console)
    print_warnings(history.warnings, console)
