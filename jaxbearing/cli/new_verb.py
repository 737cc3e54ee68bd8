"""`jaxbearing new`: a scene file from the designation of a bearing."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .messages import bad_input, refuse
from .options import JsonOption, option_quantity
from .output_files import ForceOption, check_kept, unwritten
from .terminal import console

if TYPE_CHECKING:
    from ..catalogue import Bearing


def _quantity(name: str, text: str) -> Any:
    return typer.Option(f"--{name}", metavar="VALUE", help=text)


def _known(incomplete: str) -> list[str]:
    """Designations that begin like this, for the completion of the shell; those of two words are written in one."""
    from ..catalogue.designation import known_designations

    lower = incomplete != incomplete.upper()
    names = (name.replace(" ", "") for name in known_designations())
    return [name for name in (name.lower() if lower else name for name in names) if name.startswith(incomplete)]


def new(
    designation: Annotated[
        list[str],
        typer.Argument(
            metavar="DESIGNATION",
            help="Such as 6207, 7312-B or NU 311; several make a file each.",
            autocompletion=_known,
        ),
    ],
    dynamic_capacity: Annotated[str | None, _quantity("dynamic-capacity", "C of a maker, e.g. '25.5 kN'.")] = None,
    static_capacity: Annotated[str | None, _quantity("static-capacity", "C0 of a maker, e.g. '15.3 kN'.")] = None,
    balls: Annotated[int | None, typer.Option("--balls", "--rollers", metavar="COUNT", help="Their number.")] = None,
    diameter: Annotated[
        str | None,
        typer.Option(
            "--ball-diameter", "--roller-diameter", metavar="VALUE", help="Of tapered rollers, that at mid length."
        ),
    ] = None,
    pitch_diameter: Annotated[str | None, _quantity("pitch-diameter", "E.g. '53.5 mm'.")] = None,
    roller_length: Annotated[str | None, _quantity("roller-length", "Effective length of the rollers.")] = None,
    contact_angle: Annotated[
        str | None, _quantity("contact-angle", "Of angular contact and tapered roller bearings, e.g. '40 deg'.")
    ] = None,
    radial_load: Annotated[str | None, _quantity("radial-load", "E.g. '3 kN'; an example if not given.")] = None,
    axial_load: Annotated[str | None, _quantity("axial-load", "E.g. '500 N'; an example if not given.")] = None,
    speed: Annotated[str | None, _quantity("speed", "Of the inner ring, e.g. '1500 rpm'.")] = None,
    oil: Annotated[
        str | None,
        _quantity(
            "oil",
            "Grade of a standard oil, e.g. 'ISO VG 68', or an oil of the catalogue: the scene then has the best laws, "
            "and its losses. Without an oil it is dry.",
        ),
    ] = None,
    base: Annotated[str | None, _quantity("base", "Base stock of a grade: mineral, PAO, ester, polyglycol.")] = None,
    oil_temperature: Annotated[str | None, _quantity("oil-temperature", "E.g. '60 degC'.")] = None,
    oil_flow: Annotated[str | None, _quantity("oil-flow", "E.g. '10 l/h', which adds drag.")] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            metavar="FILE",
            help="File to write, or the folder for it; the designation with .toml in this folder if not given.",
        ),
    ] = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
) -> None:
    """Write a scene file for a standard bearing: boundary dimensions by its designation, an estimated internal geometry
    with intervals. What is known of the bearing makes the estimates sharper. With an oil it has the best laws."""
    name = " ".join(designation)
    with bad_input():
        from ..catalogue.designation import parse_several
        from ..scenes.units import ANGLE, FLOW, FORCE, LENGTH, SPEED, TEMPERATURE

        names = [parsed.text for parsed in parse_several(name)]
        of_one = {
            "dynamic_capacity": ("--dynamic-capacity", dynamic_capacity, FORCE, "> 0"),
            "static_capacity": ("--static-capacity", static_capacity, FORCE, "> 0"),
            "element_diameter": ("--ball-diameter or --roller-diameter", diameter, LENGTH, "> 0"),
            "pitch_diameter": ("--pitch-diameter", pitch_diameter, LENGTH, "> 0"),
            "roller_length": ("--roller-length", roller_length, LENGTH, "> 0"),
            "contact_angle": ("--contact-angle", contact_angle, ANGLE, "> 0"),
        }
        texts = of_one | {
            "radial_load": ("--radial-load", radial_load, FORCE, "finite"),
            "axial_load": ("--axial-load", axial_load, FORCE, "finite"),
            "inner_speed": ("--speed", speed, SPEED, "finite"),
            "oil_temperature": ("--oil-temperature", oil_temperature, TEMPERATURE, "> 0"),
            "oil_flow": ("--oil-flow", oil_flow, FLOW, ">= 0"),
        }
        quantities: dict[str, Any] = {
            field: option_quantity(option, text, dimension, bound)
            for field, (option, text, dimension, bound) in texts.items()
            if text is not None
        }
        if len(names) > 1 and (balls is not None or quantities.keys() & of_one):
            refuse(f"new {name}: found {len(names)} designations with facts about the inside of one; expected one")
        if len(names) > 1 and output is not None and not output.is_dir():
            refuse(f"--output: found '{output}' for {len(names)} designations; expected a folder that exists")
        bearings = {}
        for label in names:
            bearing = _bearing(label, n_elements=balls, oil=oil, base=base, **quantities)
            bearings[_target(output, f"{bearing.designation.name}.toml", force)] = bearing
        if len(bearings) < len(names):
            refuse(f"new {name}: found a designation twice; expected each once")
    for target, bearing in bearings.items():
        _write(target, bearing.text())
    if as_json:
        objects = [_as_json(made, target) for target, made in bearings.items()]
        typer.echo(json.dumps(objects[0] if len(objects) == 1 else {"bearings": objects}))
        return
    for target, bearing in bearings.items():
        _show(bearing)
        typer.echo(f"wrote {target}: jaxbearing solve {target}")


def _bearing(name: str, **facts: Any) -> "Bearing":
    """The bearing with a scene that can be built. **Raises:** `SceneError` if it cannot."""
    from ..catalogue import find

    try:
        bearing = find(name, **facts)
    except ValueError as error:
        if type(error) is not ValueError:
            raise
        refuse(f"new {name}: {error}")
    if not bearing.is_usual:
        # a scene that cannot be built is said before anything is written
        bearing.scene()
    return bearing


def _target(output: Path | None, file: str, force: bool) -> Path:
    """The file to write. **Raises:** `SceneError` if it is there already."""
    from ..scenes.errors import SceneError

    target = Path(file) if output is None else output
    if target.is_dir():
        target = target / file
    check_kept("--output", target, force)
    if not target.parent.is_dir():
        raise SceneError(str(target), "", "no such folder", "a file in an existing folder")
    return target


def _write(target: Path, text: str) -> None:
    from ..report.files import write_whole

    try:
        write_whole(target, text)
    except OSError as error:
        raise typer.Exit(unwritten(target, error)) from None


_SHOWN = {
    "n_elements": ("number of {}", 1.0, ""),
    "diameter": ("{} diameter", 1e3, "mm"),
    "pitch_diameter": ("pitch diameter", 1e3, "mm"),
    "length": ("effective roller length", 1e3, "mm"),
    "contact_angle": ("contact angle", 180.0 / math.pi, "deg"),
}
"""Field of the geometry -> words, factor to the unit of the screen, unit."""


def _fields(bearing: "Bearing") -> list[str]:
    """Fields of the geometry that the type of bearing has."""
    kind = bearing.designation.kind
    left_out = {"length"} if kind not in ("cylindrical", "tapered") else set()
    if kind in ("deep_groove", "cylindrical"):
        left_out.add("contact_angle")
    return [name for name in _SHOWN if name not in left_out]


def _show(bearing: "Bearing") -> None:
    from rich.table import Table

    from ..catalogue.scene_text import best_in_words, kilonewtons, sharper
    from ..scenes.quantity_texts import text_in
    from ..scenes.units import ANGLE, LENGTH

    designation, geometry = bearing.designation, bearing.geometry
    element = "roller" if designation.kind in ("cylindrical", "tapered") else "ball"
    out = console()
    sizes = f"{designation.bore:g} x {designation.outside:g} x {designation.width:g} mm"
    out.print(f"{designation.text}: {designation.in_words}, {sizes}", style="bold", markup=False)
    table = Table.grid(padding=(0, 2, 0, 0))
    for wrapped in (False, False, True):
        table.add_column(no_wrap=not wrapped, overflow="fold")
    for name in _fields(bearing):
        label, scale, unit = _SHOWN[name]
        estimate = getattr(geometry, name)
        value = f"{scale * estimate.value:.5g} {unit}".strip()
        if estimate.given and unit:
            value = text_in(unit, estimate.value, ANGLE if unit == "deg" else LENGTH)
        least, greatest = f"{scale * estimate.least:.4g}", f"{scale * estimate.greatest:.4g}"
        source = "known" if estimate.given else f"estimated, {least} to {greatest}"
        table.add_row(label.format(f"{element}s" if name == "n_elements" else element), value, source)
    ratings = (("C", "dynamic_capacity", "ISO 281"), ("C0", "static_capacity", "limits of ISO 76"))
    for symbol, field, source in ratings:
        printed = f"; given {kilonewtons(bearing.given[field])}" if field in bearing.given else ""
        table.add_row(symbol, f"{1e-3 * getattr(geometry, field):.4g} kN", f"of this geometry, {source}{printed}")
    out.print(table)
    if bearing.duty.oil is None:
        out.print("dry: no films and no losses; --oil 'ISO VG 68' adds both", markup=False)
    else:
        words = f"{best_in_words(designation)} by laws = 'best', which solve lists"
        out.print(f"oil {bearing.duty.oil}: {words}", markup=False)
    options = sharper(designation, bearing.given)
    if options:
        out.print(f"sharper with {options}", markup=False)
    for note in designation.notes:
        out.print(f"note: {note}", markup=False)


def _as_json(bearing: "Bearing", target: Path) -> dict[str, Any]:
    designation, geometry = bearing.designation, bearing.geometry
    return {
        "designation": designation.text,
        "kind": designation.kind,
        "bore": 1e-3 * designation.bore,
        "outside_diameter": 1e-3 * designation.outside,
        "width": 1e-3 * designation.width,
        "clearance_class": designation.clearance_class,
        "geometry": {name: getattr(geometry, name)._asdict() for name in _fields(bearing)},
        "dynamic_capacity": geometry.dynamic_capacity,
        "static_capacity": geometry.static_capacity,
        "oil": bearing.duty.oil,
        "notes": list(designation.notes),
        "file": str(target),
    }
