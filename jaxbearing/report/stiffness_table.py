"""Stiffness of a bearing over shaft speed, on the screen."""

from collections.abc import Iterable

from rich.console import Console

from ..bearings.solution import stiffness_units
from .backends.screen import column, counted, headline, print_line, print_table, print_warnings, shown_pieces
from .display import display_unit
from .stiffness import StiffnessTable


def print_stiffness(table: StiffnessTable, scene_label: str, console: Console, full: bool = False) -> None:
    """Prints the diagonal of the stiffness matrix over speed. **Arguments:** `full`: print all columns."""
    state = f"{counted(len(table.speed), 'speed')} solved; entries off the diagonal: --json"
    headline(scene_label, "CONVERGED", "bold green", state, console)
    units = stiffness_units()
    columns = {
        f"{name}\n{display_unit(units[i][i])}": column(table.stiffness[:, i, i], units[i][i])
        for i, name in enumerate(table.freedom)
        if name in table.modelled
    }
    first = {f"speed\n{display_unit('rad/s')}": column(table.speed, "rad/s")}
    for piece in shown_pieces(first, columns, console, full):
        print_table(piece, [0.0] * len(table.speed), 0, "", console)
    for name, text in _meanings(table):
        print_line(name, text, console)
    print_warnings(table.warnings, console, full)


def _meanings(table: StiffnessTable) -> Iterable[tuple[str, str]]:
    yield "Stiffness", "d load / d displacement of the inner ring, its other degrees of freedom held"
    yield "Radial, lateral", "along the load line (azimuth 0), and 90 deg on in the sense of rotation"
    if "tilt" in table.modelled:
        yield "Tilt", "moves azimuth 0 along the axis; tilt_lateral turns about the load line"
    others = [name for name in table.freedom if name not in table.modelled]
    if others:
        yield "Not modelled", ", ".join(others)
