"""Summary of a transient run of a bearing on the screen."""

import math
from typing import TYPE_CHECKING, Any

from ....bearings.motion.history import History
from ...display import with_unit
from ...history_shocks import FACES, SHOCK
from .json_report import statistics

if TYPE_CHECKING:
    from rich.console import Console


def print_summary(history: History, label: str, console: "Console") -> None:
    """See `report.histories.print_history`."""
    from rich.table import Table
    from rich.text import Text

    from ...backends.screen import print_warnings

    numbers = statistics(history)
    console.print(Text(label, style="bold"))
    steps = f"{int(history.accepted)} steps ({int(history.rejected)} more tried)"
    console.print(f"{1e3 * float(history.time[-1]):.6g} ms in {steps}, {history.solver}")
    if float(history.time[0]) > 0.0:
        console.print(f"goes on from {1e3 * float(history.time[0]):.6g} ms")
    if not history.completed:
        console.print(Text(history.failure(), style="bold red"))
    table = Table("", "mean", "least", "largest", "at the end", box=None, pad_edge=False)
    rows = [("inner ring speed", numbers["inner_speed"], "rad/s")]
    if "axial" in numbers["ring"]:
        rows += [(f"{name} ring displacement", numbers["ring"][name], "m") for name in ("axial", "radial")]
    else:
        rows.append(("ring displacement", numbers["ring"]["radial"], "m"))
    if "cage" in numbers:
        cage = numbers["cage"]
        rows += [("cage speed", cage["speed"], "rad/s"), ("cage slip", cage["slip"], "1")]
        rows += [("cage eccentricity ratio", cage["eccentricity_ratio"], "1")]
    rows += [("power loss", numbers["power"]["loss"], "W"), ("drive power", numbers["power"]["drive"], "W")]
    for name, spread, unit in rows:
        table.add_row(name, *(with_unit(spread[key], unit) for key in ("mean", "min", "max", "end")))
    console.print(table)
    if "excursion" in numbers:
        away = with_unit(numbers["excursion"], "m")
        console.print(f"Largest excursion of a {history.element_name} along the orbit from equal spacing: {away}")
    if "pocket_load" in numbers:
        element = history.element_name
        heading = f"Largest pocket load of a {element} in a turn of the cage, N (mean over the {element}s, largest)"
        console.print(f"\n{heading}")
        table = Table("turn", "front", "", "rear", "", box=None, pad_edge=False)
        front, rear = (numbers["pocket_load"][face]["turns"] for face in FACES)
        for number, (a, b) in enumerate(zip(front, rear, strict=True), 1):
            name = f"{number}" if a["part"] > 0.95 else f"{number} ({100 * a['part']:.0f} % of it)"
            table.add_row(name, *(with_unit(v, "N") for v in (a["mean"], a["max"], b["mean"], b["max"])))
        console.print(table)
    if "cage" in numbers and numbers["cage"]["whirl_ratio"] is not None:
        console.print(f"The cage's centre whirls with {numbers['cage']['whirl_ratio']:.3g} of the cage speed.")
    if "shocks" in numbers:
        _print_sectors(numbers["shocks"], console)
    _print_motion(numbers, history.element_name, console)
    console.print("\nMean power")
    table = Table("", "", box=None, pad_edge=False, show_header=False)
    for name, watts in sorted(numbers["power_loss"].items(), key=lambda item: (item[0] != "total", -item[1])):
        table.add_row(name.replace("_", " "), with_unit(watts, "W"))
    stored = {"pocket_films": "pocket films, squeezed", "damping": "contact and ring damping"}
    for key, name in (stored | {"kinetic": "into kinetic energy"}).items():
        if key in numbers["power"]:
            table.add_row(name, with_unit(numbers["power"][key], "W"))
    table.add_row("drive power", with_unit(numbers["drive_power"], "W"))
    console.print(table)
    if history.not_modelled:
        console.print("Not modelled: " + ", ".join(history.not_modelled).replace("_", " "))
    console.print(
        f"\nThe energy balance leaves {float(history.energy.error):.1e} of the drive work open. Shocks are not "
        "repeatable turn by turn: compare statistics, to 10-20 %."
    )
    print_warnings(history.warnings, console)


def _print_motion(numbers: dict[str, Any], element: str, console: "Console") -> None:
    """Prints orbit and stresses of the cage, variation of the speeds, sliding and skidding, as far as available."""
    orbit = numbers.get("cage", {}).get("orbit")
    if orbit is not None:
        radius = " and ".join(with_unit(orbit[f"{name}_radius"], "m") for name in ("mean", "max"))
        console.print(f"The cage's centre is {radius} (mean, largest) from its mean place.")
    if "land_load" in numbers:
        loads = ", ".join(with_unit(numbers["land_load"][name], "N") for name in ("mean", "p99", "max"))
        console.print(f"Load of the cage on a guiding land (mean, 99 %, largest): {loads}")
    if "cage_stress" in numbers:
        stress = {name: with_unit(value, "Pa") for name, value in numbers["cage_stress"].items()}
        console.print(
            f"Largest stresses of the cage: {stress['hoop']} by rotation, {stress['rail_bending']} by bending of the "
            f"rails, {stress['bar_bending']} by bending of the bars"
        )
    if "speed_variation" in numbers:
        share = 100.0 * numbers["speed_variation"]["between_elements"]
        console.print(f"Orbital speeds of the {element}s differ by up to {share:.3g} % at one time.")
    if "sliding_energy" in numbers:
        parts = [f"{with_unit(own['total'], 'J')} {place}" for place, own in numbers["sliding_energy"].items()]
        console.print(f"Sliding takes {', '.join(parts)}.")
    if "groove_energy" in numbers:
        parts = [
            f"{own['largest_at_deg']:.3g} deg {side} ({with_unit(own['largest'], 'J')} in one degree)"
            for side, own in numbers["groove_energy"].items()
        ]
        console.print(f"Contact angle at which sliding takes the most energy: {', '.join(parts)}")
    if "skidding" in numbers:
        shares = [f"{100 * numbers['skidding'][side]['share']:.3g} % {side}" for side in ("inner", "outer")]
        limit = f"{100 * numbers['skidding']['threshold']:g} %"
        console.print(f"Share of {element}s that slide by more than {limit} of rolling: {', '.join(shares)}")


def _print_sectors(shocks: dict[str, Any], console: "Console") -> None:
    """Prints the shocks by azimuth: two lines for each pocket wall, or one line in all if there are none."""
    from rich.table import Table

    threshold = with_unit(shocks["threshold"], "N")
    if not any(sum(shocks[face]["count"]) for face in FACES):
        console.print(f"\nNo shock: no pocket load above {threshold}, {SHOCK}.")
        return
    console.print(f"\nShocks (above {threshold}: {SHOCK}) by azimuth from the load line, deg")
    edges = [round(math.degrees(edge)) for edge in shocks["sector_edges"][:-1]]
    table = Table("from", *(f"{edge}" for edge in edges), box=None, pad_edge=False)
    for face in FACES:
        table.add_row(f"{face}: number", *(f"{count}" for count in shocks[face]["count"]))
        peaks = ("" if peak is None else f"{peak:.3g}" for peak in shocks[face]["mean_peak"])
        table.add_row("  mean peak, N", *peaks)
    console.print(table)
