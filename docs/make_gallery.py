"""Writes the gallery page and its pictures: `python docs/make_gallery.py`.

One list: name of the picture, heading, the lines of code, which end with `figure = ...` and are shown as they run.
"""

from pathlib import Path
from typing import Any, NamedTuple

import jaxbearing as jb

DOCS = Path(__file__).parent
RESOLUTION = 130
"""Dots per inch of a picture."""
START = """# Gallery

Every figure is one function that returns a matplotlib `Figure` with a caption; `axes=` draws into axes that are there.
Captions say what agrees with the source and what cannot be compared. The code under each heading, after
`import jaxbearing as jb`, made the picture; `python docs/make_gallery.py` writes this page.
"""


class Entry(NamedTuple):
    """A figure of the gallery."""

    name: str
    heading: str
    code: str


def _property(name: str, heading: str, call: str) -> Entry:
    return Entry(name, heading, f"figure = jb.plots.properties.{call}")


_PRESSURE = "viscosity_pressure("
PROPERTIES = [
    _property("thermal_factor", "Thermal factor of the film (Figure 20)", "thermal_factor()"),
    _property("traction_models", "Traction by contact model and mesh (Figure 21)", "traction_models()"),
    _property("traction_shear_modulus", "Traction against G (Figure 22)", "traction_shear_modulus()"),
    _property("traction_stress", "Traction against τ0 (Figure 23)", "traction_stress()"),
    _property(
        "viscosity_mobil",
        "Viscosity of Mobil Jet II (Figure 25)",
        _PRESSURE + '"mobil_jet_ii", (0, 40, 82, 124, 164), 1e9)',
    ),
    _property("viscosity_models", "Viscosity laws compared (Figure 26)", "viscosity_models()"),
    _property("alpha_models", "Pressure-viscosity coefficient by law (Figure 27)", "alpha_of_models()"),
    _property("film_models", "Film by viscosity law (Figure 28)", "film_of_models()"),
    _property("viscosity_temperature", "Viscosity against temperature (Figure 30)", "viscosity_temperature()"),
    _property(
        "viscosity_fomblin",
        "Viscosity of Fomblin Z25 (Figure 31)",
        _PRESSURE + '"fomblin_z25", (-24, -9, 13, 40, 63))',
    ),
    _property(
        "viscosity_pennzane",
        "Viscosity of Pennzane SHF X2000 (Figure 32)",
        _PRESSURE + '"pennzane_x2000", (-24, -9, 13, 40, 63))',
    ),
    _property(
        "viscosity_nye",
        "Viscosity of Nye 186A (Figure 33)",
        _PRESSURE + '"nye_186a", (25, 49.7, 75.4, 100.2), beside="pennzane_x2000")',
    ),
    _property("alpha_oils", "Pressure-viscosity coefficient of three oils (Figure 34)", "alpha_of_oils()"),
    _property("spin_friction", "Friction by spinning (Figure 41)", "spin_friction()"),
]
_ROLLER = 'solution = jb.solve(jb.load_scene("turbine_roller"))\n'
_SWEEP = 'scene = jb.load_scene("turbine_roller")\n'


def _of_solution(name: str, heading: str, start: str = _ROLLER, name_of: str = "solution") -> Entry:
    return Entry(name, heading, f"{start}figure = jb.plots.{name}({name_of})")


FIGURES = [
    _of_solution("load_distribution", "Load distribution"),
    _of_solution("films", "Film round the bearing"),
    _of_solution("pressures", "Hertz pressure round the bearing"),
    _of_solution("sliding", "Sliding speed round the bearing"),
    _of_solution("power_loss", "Power loss by location"),
    Entry(
        "power_loss_against",
        "Power loss by location against a swept field (as Figures 36 to 40)",
        "import numpy as np\n\n"
        + _SWEEP
        + 'found = jb.sweep(scene, {"operation.inner_speed": np.linspace(200.0, 2000.0, 19)})\n'
        'figure = jb.plots.power_loss_against(found, "operation.inner_speed")',
    ),
    Entry(
        "stribeck",
        "Stribeck curve of a bearing with rough surfaces",
        'rough = {"contact.mixed.roughness": "0.3 um", "contact.mixed.flange_roughness": "0.24 um"}\n'
        'scene = jb.load_scene("tapered_example", rough | {"contact.mixed.slide_width": "0.1 mm/s"})\n'
        "figure = jb.plots.stribeck(scene)",
    ),
    Entry(
        "result_against",
        "Any result against a swept field: cage slip",
        "import numpy as np\n\n"
        + _SWEEP
        + 'grid = {"operation.radial_load": np.geomspace(250.0, 25e3, 13), "drag.coefficient": [0.1, 0.3, 1.2]}\n'
        'figure = jb.plots.result_against(jb.sweep(scene, grid), "cage_slip", "operation.radial_load")',
    ),
    Entry(
        "map_of",
        "A result over two fields: film of the most loaded roller",
        "import numpy as np\n\n"
        + _SWEEP
        + "speeds, temperatures = np.linspace(200.0, 2000.0, 16), np.linspace(320.0, 470.0, 16)\n"
        'found = jb.sweep(scene, {"operation.inner_speed": speeds, "operation.oil_temperature": temperatures})\n'
        'found["film"] = found.film_inner.min("element", keep_attrs=True)\n'
        'figure = jb.plots.map_of(found, "film", x="operation.oil_temperature")',
    ),
    Entry(
        "raceway_control_map",
        "Which race controls the spin (as Figure 43)",
        "import numpy as np\n\n"
        'bare = {"cage": "none", "drag": "none", "contact.rolling_resistance": "none"}\n'
        'scene = jb.load_scene("turbine_ball", bare)\n'
        'grid = {"operation.axial_load": np.linspace(5e3, 50e3, 16), "operation.inner_speed": '
        "np.linspace(500.0, 2000.0, 13)}\n"
        "figure = jb.plots.raceway_control_map(jb.sweep(scene, grid))",
    ),
    _of_solution(
        "traction_curves",
        "Traction curves of a two-disk machine",
        'solution = jb.solve(jb.load_scene("two_disk_mobil_jet_ii"))\n',
    ),
    _of_solution(
        "cage_orbit",
        "Orbit of the cage",
        'history = jb.simulate(jb.load_scene("turbine_roller_dynamic"), 0.02)\n',
        "history",
    ),
]
ENTRIES = [*FIGURES, *PROPERTIES]


def drawn(entry: Entry) -> Any:
    """The figure that the code of an entry makes."""
    names: dict[str, Any] = {"jb": jb}
    exec(entry.code, names)
    return names["figure"]


def section(entry: Entry) -> str:
    """The part of the page about one figure, whose caption is in the picture."""
    picture = f"![{entry.name}](pictures/{entry.name}.png)"
    return f"\n## {entry.heading}\n\n{picture}\n\n```python\n{entry.code}\n```\n"


def write(folder: Path, entries: list[Entry]) -> None:
    """The page and the pictures. **Arguments:** `folder`: that gets `gallery.md` and `pictures/`."""
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    page = START
    for entry in entries:
        figure = drawn(entry)
        figure.savefig(folder / "pictures" / f"{entry.name}.png", dpi=RESOLUTION)
        page += section(entry)
    (folder / "gallery.md").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    write(DOCS, ENTRIES)
