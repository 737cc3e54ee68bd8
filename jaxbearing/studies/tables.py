"""The power-loss study on the screen and as JSON."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich import box
from rich.console import Console
from rich.table import Table

from ..bearings.bearing import AbstractBearing
from ..report.backends.json import finite
from ..report.backends.screen import counted, headline, print_line, print_rule
from ..report.display import digits
from .claims import Claim
from .panels import RADIAL, SPEED, own
from .power_loss import PowerLossStudy

if TYPE_CHECKING:
    import xarray as xr

NO_CLAIMS = "The source prints no study of this kind of bearing: there are no statements to compare."
SCALED = (
    "The source speaks of its own bearing at 10 500 rpm and 25 kN. Speeds, loads, flows and clearances named here "
    "stand for the same multiples of this scene's."
)


def verdict(claim: Claim) -> str:
    return "left out" if claim.holds is None else "yes" if claim.holds else "no"


def _is_source_point(scene: AbstractBearing) -> bool:
    speed, load = own(scene, SPEED) or 0.0, own(scene, RADIAL) or 0.0
    return math.isclose(speed, 10500 * math.pi / 30, rel_tol=1e-6) and math.isclose(load, 25e3, rel_tol=1e-6)


def print_study(study: PowerLossStudy, claims: Sequence[Claim], label: str, seconds: float, console: Console) -> None:
    """Extent of each panel, what is left out, and the statements of the source with yes or no and our numbers."""
    solved = f"{study.cases - study.failed} of {counted(study.cases, 'case')} solved"
    headline(label, solved, "bold green" if study.failed == 0 else "bold yellow", f"{seconds:.1f} s", console)
    if study.failed:
        print_line("gaps", f"{counted(study.failed, 'case')} did not converge", console)
    print_rule("Total power loss in each figure", console)
    for name, panel in study.panels.items():
        total = panel.power_loss_total
        title = str(panel.attrs["title"]).removeprefix("Power loss ")
        print_line(name, f"{digits(float(total.min()), 4)} to {digits(float(total.max()), 4)} W, {title}", console)
    for text in study.left_out:
        print_line("left out", text, console)
    print_rule("What the source says", console)
    if not claims:
        print_line("", NO_CLAIMS, console)
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="")
    for title in ("", "statement", "holds", "our numbers"):
        table.add_column(title, overflow="fold")
    for claim in claims:
        numbers = ", ".join(str(value) if isinstance(value, int) else digits(value, 4) for value in claim.numbers)
        text = f"{claim.printed}: {numbers}" if claim.holds is not None else claim.why
        table.add_row(str(claim.number), claim.statement, verdict(claim), text)
    console.print(table)
    if not _is_source_point(study.scene):
        print_line("note", SCALED, console)


def study_to_dict(study: PowerLossStudy, claims: Sequence[Claim]) -> dict[str, Any]:
    """Claims, and of each panel its fields and losses as nested lists in SI; a gap is null."""
    return {
        "cases": study.cases,
        "failed": study.failed,
        "left_out": study.left_out,
        "claims": [vars(claim) | {"numbers": list(claim.numbers)} for claim in claims],
        "figures": {name: _panel(panel) for name, panel in study.panels.items()},
    }


def _panel(panel: "xr.Dataset") -> dict[str, Any]:
    losses = [str(name) for name in panel.data_vars if str(name).startswith("power_loss_")]
    fields = str(panel.attrs["sweep_fields"]).split()
    axes = {path: panel[path.replace(".", "_")].values.tolist() for path in fields}
    return {"fields": axes} | {name: finite(panel[name].values.tolist()) for name in losses}
