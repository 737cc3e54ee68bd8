"""A line contact on the screen."""

from rich.console import Console

from ...ehl import LineContactHistory, LineContactSolution
from ...numerics.status import Status
from ..display import ZERO_CELSIUS, with_unit
from ..screen import headline, print_failure, print_line, print_rule, print_table, print_warnings
from .json_report import film_statistics


def operating_text(solution: LineContactSolution) -> str:
    """The operating point in words."""
    operation = solution.operation
    speed, temperature = 1e3 * float(operation.entrainment_speed), float(operation.oil_temperature) - ZERO_CELSIUS
    return f"{1e-3 * float(solution.load_per_length):.5g} N/mm, {speed:.5g} mm/s, {temperature:.5g} degC"


def print_line_contact(solution: LineContactSolution, scene_label: str, console: Console) -> None:
    """See `report.summary.print_summary`."""
    if not bool(solution.converged):
        print_failure(scene_label, Status(int(solution.status)).text, solution.failure(), console)
        return
    state = f"{int(solution.iterations)} Newton steps on all meshes, last step {float(solution.last_step):.1e}, "
    nodes = f"{solution.unknowns} unknowns"
    headline(scene_label, "CONVERGED", "bold green", state + nodes, console)
    print_line("Operation", operating_text(solution), console)
    hertz = solution.hertz
    text = f"half width {1e3 * float(hertz.half_width):.4f} mm, pressure {with_unit(float(hertz.pressure), 'Pa')}"
    print_line("Hertz", text, console)
    numbers = f"M = {float(solution.moes_load):.4g}, L = {float(solution.moes_material):.4g}"
    print_line("Moes numbers", f"{numbers}, speed number {float(solution.speed_number):.3e}", console)
    kind = "compressible (Dowson and Higginson)" if solution.compressible else "incompressible"
    print_line("Oil", kind, console)
    print_rule("Film", console)
    film, formulas = solution.film, solution.formulas
    compared = [
        ("central", film.central, film.central),
        ("minimum", film.minimum, film.minimum),
        ("central, Moes", formulas.moes_central, film.central),
        ("central, Dowson and Toyoda", formulas.dowson_toyoda_central, film.central),
        ("minimum, Dowson and Higginson", formulas.dowson_higginson_minimum, film.minimum),
    ]
    columns = {
        "Film thickness": [name for name, _, _ in compared],
        "um": [f"{1e6 * float(value):.4f}" for _, value, _ in compared],
        "to this solution": ["" if v is o else f"{100 * (float(v) / float(o) - 1):+.1f} %" for _, v, o in compared],
    }
    print_table(columns, [0.0] * len(compared), 0, "", console)
    place = float(film.minimum_position) / float(hertz.half_width)
    print_line("Smallest at", f"{place:+.4f} half widths from the centre", console)
    print_line("Central pressure", with_unit(float(solution.central_pressure), "Pa"), console)
    print_warnings(solution.warnings, console)


def print_film_history(history: LineContactHistory, label: str, console: Console) -> None:
    """See `report.histories.print_history`."""
    found = film_statistics(history)
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
    rows = [("central film", found["central"], 1e6), ("smallest film", found["minimum"], 1e6)]
    rows += [("speed, mm/s", found["entrainment_speed"], 1e3)]
    columns = {"Film, um": [name for name, *_ in rows]}
    for key, title in (("start", "at the start"), ("min", "least"), ("max", "largest"), ("end", "at the end")):
        columns[title] = [f"{factor * values[key]:.5g}" for _, values, factor in rows]
    print_table(columns, [0.0] * len(rows), 0, "", console)
    place, width = found["minimum_position"], float(history.hertz.half_width)
    until = found["central_constant_until"]
    constant = "to the end" if until is None else f"until {1e3 * until:.4g} ms"
    print_line("Central film", f"within 1 % of its start {constant}", console)
    moved = f"at {place['start'] / width:+.3f} half widths at the start, {place['end'] / width:+.3f} at the end"
    print_line("Smallest film", moved, console)
    print_line("Largest pressure", with_unit(found["pressure_max"], "Pa"), console)
    print_line("Balance of mass", f"{found['mass_balance_error']:.1e}, the zone under pressure, worst step", console)
    print_warnings(history.warnings, console)
