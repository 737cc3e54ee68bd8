"""Bearings with a thermal network. The programs of `BALLS`, `ROLLERS` and `TAPERED` are small, because nothing
slides in them; in those of `SLIDING` the elements slide on the raceways or on the rib."""

import jaxbearing as jb

OIL = {
    "oil.name": "mobil_jet_ii",
    "oil.heat_capacity": "2150 J/(kg*K)",
    "operation.oil_temperature": "60 degC",
    "operation.oil_flow": "2 l/h",
}
BALLS = OIL | {
    "geometry.bore": "25 mm",
    "geometry.outside_diameter": "52 mm",
    "geometry.width": "15 mm",
    "contact.film": "nijenbanning",
    "contact.rolling_resistance": "source_86",
    "operation.radial_load": "none",
    "operation.moment": "none",
}
SEATS = {"fits.shaft_interference": "10 um", "fits.housing_interference": "4 um", "fits.housing_outside": "80 mm"}
ROLLING = dict.fromkeys(("contact.traction", "contact.thermal", "cage", "flange", "drag"), "none")
ROLLERS = OIL | {
    **ROLLING,
    "contact.traction_model": "none",
    "contact.traction_accuracy": "none",
    "contact.rolling_resistance": "ertel_grubin",
    "geometry.bore": "118 mm",
    "geometry.outside_diameter": "166 mm",
    "geometry.width": "22 mm",
    "operation.oil_flow": "60 l/h",
}
TAPERED = OIL | {
    **dict.fromkeys(("contact.traction", "contact.traction_accuracy", "drag", "operation.radial_load"), "none"),
    "contact.rolling_resistance": "ertel_grubin",
    "materials.rings": "52100",
    "materials.rollers": "52100",
    "geometry.bore": "30 mm",
    "geometry.outside_diameter": "62 mm",
    "geometry.width": "17 mm",
}
SLIDING = {
    "sliding ball": OIL | {"temperatures": "none", "operation.oil_flow": "150 l/h", "geometry.width": "34 mm"},
    "sliding roller": {path: value for path, value in ROLLERS.items() if value != "none"}
    | {"operation.oil_flow": "150 l/h"},
    "sliding rib": {path: value for path, value in TAPERED.items() if value != "none"},
}
NAMES = {
    "ball": "deep_groove_6205",
    "roller": "turbine_roller",
    "tapered": "tapered_example",
    "sliding ball": "turbine_ball_mounted",
    "sliding roller": "turbine_roller",
    "sliding rib": "tapered_example",
}
CHANGES = {"ball": BALLS, "roller": ROLLERS, "tapered": TAPERED} | SLIDING


OTHERS = ("operation", "fits", "rating", "geometry", "oil.")
"""Tables whose fields `warm` takes by their paths."""


def warm(kind, nodes=4, **changes):
    """A scene with a network. **Arguments:** `changes`: fields of `[thermal]` and of `OTHERS`, with `__` for dots."""
    own = {name.replace("__", "."): value for name, value in changes.items()}
    own = {(path if path.startswith(OTHERS) else f"thermal.{path}"): value for path, value in own.items()}
    return jb.load_scene(NAMES[kind], CHANGES[kind] | {"thermal.nodes": str(nodes)} | own)
