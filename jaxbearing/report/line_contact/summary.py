"""Summary of a line contact on the screen."""

from rich.console import Console

from ...ehl import LineContactSolution
from ...numerics.status import Status
from ..backends.screen import headline, print_failure, print_line, print_rule, print_table, print_warnings
from ..display import with_unit
from ..tables import derived_facts
from .operation import operating_text


def print_summary(solution: LineContactSolution, scene_label: str, console: Console, full: bool = False) -> None:
    """See `report.summary.print_summary`. `full` only lengthens the list of assumptions."""
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
    for name, text in derived_facts(solution):
        print_line(name, text, console)
    print_warnings(solution.warnings, console, full)
