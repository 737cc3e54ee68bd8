"""Inputs of the formulas from a solved scene and its catalogue data, with texts on assumed and missing ones."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..bearings.bearing import AbstractBearing
from ..bearings.operation import AbstractOperation
from ..bearings.solution import RING_FREEDOMS, TILTS, Solution
from .catalogue import Catalogue
from .designation import FAMILIES, Said, read_designation
from .skf_constants import BALL_FILM_FRICTION, BOUNDARY_FRICTION, FILM_FRICTION

VG_TEMPERATURE = 313.15
"""Temperature at which ISO VG classes state the viscosity, K."""
ROUND_BORE = 1e-6
"""Difference up to which two bores count as equal, m."""


@dataclass(frozen=True)
class Known:
    """Inputs of the formulas by name.

    **Arguments:**
    - `values`: known values, given or assumed, in SI units.
    - `assumed`: texts that describe the assumptions among `values`.
    - `missing`: for inputs without a value, texts that say what the user must give.
    """

    values: dict[str, Any] = field(default_factory=dict)
    assumed: dict[str, str] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)

    def put(self, name: str, value: object, otherwise: str) -> None:
        """Stores a value; if it is `None`, stores `otherwise` as the text on the missing input."""
        if value is None:
            self.missing[name] = otherwise
        else:
            self.values[name] = value if isinstance(value, str) else float(np.asarray(value))

    def assume(self, name: str, value: object, words: str) -> None:
        """Stores a value as assumed if the input is still missing; `words` say where it comes from."""
        if name not in self.values and value is not None:
            self.put(name, value, "")
            self.missing.pop(name, None)
            self.assumed[name] = words


class Reader:
    """Reader of the inputs of one formula; it collects the texts on assumed and missing ones."""

    def __init__(self, known: Known):
        self.known = known
        self.assumed: list[str] = []
        self.missing: list[str] = []

    def __call__(self, name: str) -> Any:
        """The value; `None` where it is missing."""
        if name in self.known.missing:
            self.missing.append(self.known.missing[name])
        elif name in self.known.assumed:
            self.assumed.append(self.known.assumed[name])
        return self.known.values.get(name)


def known_of(scene: AbstractBearing, solution: Solution, catalogue: Catalogue) -> Known:
    """All inputs that the formulas may need."""
    known, parsed = Known(), read_designation(catalogue.designation or "")
    _names(known, scene, catalogue, parsed)
    _sizes(known, scene, catalogue, parsed)
    _oil(known, scene, catalogue)
    _ratings(known, scene, solution, catalogue)
    _seals(known, catalogue, parsed)
    _frictions(known, catalogue)
    _loads(known, solution)
    for name in ("g1", "g2", "k", "f2", "f3"):
        known.put(f"timken_{name}", getattr(catalogue, f"timken_{name}"), f"catalogue.timken_{name}")
    return known


def contradictions(known: Known, catalogue: Catalogue, kind: str) -> Iterator[str]:
    """Notes on a designation that contradicts other fields or is of an unknown form."""
    parsed = read_designation(catalogue.designation or "")
    if catalogue.designation is not None and not parsed.family:
        yield f"catalogue.designation: '{catalogue.designation}' has no form that is known here; it says nothing"
    elif parsed.family and parsed.family not in FAMILIES[kind]:
        yield f"catalogue.designation: '{catalogue.designation}' is no bearing of the kind {kind}"
    bore = known.values.get("bore")
    if parsed.bore is not None and bore is not None and abs(bore - parsed.bore) > ROUND_BORE:
        yield (
            f"catalogue.designation: '{catalogue.designation}' has a bore of {1e3 * parsed.bore:g} mm, the scene "
            f"{1e3 * bore:g} mm; the scene's is used"
        )


def _names(known: Known, scene: AbstractBearing, catalogue: Catalogue, parsed: Said) -> None:
    own = FAMILIES[scene.kind]
    family = catalogue.family or parsed.family or (own[0] if len(own) == 1 else "")
    expected = "catalogue.designation, or catalogue.family"
    known.put("family", family if family in own else None, f"{expected} ({', '.join(own)})")
    if scene.kind == "cylindrical_roller_bearing":
        known.assume("family", "cylindrical", "bearing with a cage (catalogue.family)")
    series = _series(catalogue.series or parsed.series)
    known.put("series", series or None, "catalogue.designation, or catalogue.series")


def _series(text: str) -> str:
    """The name of a series in the tables of constants: "72B" for "72 B", "2" for "NU 2"."""
    if text in ("single row", "double row", "other"):
        return text
    return re.sub(r"^(NUP|NU|NJ|N)(?=[0-9])", "", re.sub(r"\s", "", text.upper()))


def _sizes(known: Known, scene: AbstractBearing, catalogue: Catalogue, parsed: Said) -> None:
    geometry = scene.geometry
    for name in ("bore", "outside_diameter", "width"):
        stated = getattr(catalogue, name)
        value = getattr(geometry, name, None) if stated is None else stated
        known.put(name, value, f"catalogue.{name}")
    known.assume("bore", parsed.bore, "bore by the designation")
    if "bore" in known.values and "outside_diameter" in known.values:
        known.put("mean_diameter", 0.5 * (known.values["bore"] + known.values["outside_diameter"]), "")
        if "bore" in known.assumed:
            known.assumed["mean_diameter"] = known.assumed["bore"]
    else:
        words = "mean diameter (d + D)/2 is the pitch diameter of the scene (catalogue.bore, outside_diameter)"
        known.assume("mean_diameter", geometry.pitch_diameter, words)
    known.put("element_diameter", scene.element_diameter, "")
    angle = getattr(geometry, "contact_angle", None)
    known.put("contact_angle", angle, "geometry.contact_angle")
    if scene.kind == "tapered_roller_bearing":
        known.put("axial_factor", catalogue.axial_factor, "catalogue.axial_factor")
        known.assume("axial_factor", 0.4 / math.tan(known.values["contact_angle"]), "Y = 0.4 cot(contact angle)")


def _oil(known: Known, scene: AbstractBearing, catalogue: Catalogue) -> None:
    known.put("viscosity", catalogue.kinematic_viscosity, "catalogue.kinematic_viscosity, or an oil with a density")
    known.missing["dynamic_viscosity"] = "an oil of the scene"
    known.missing["viscosity_vg"] = "an oil with a density"
    oil = scene.oil
    if oil is not None:
        temperature = scene.operation.oil_temperature
        inlet = oil.at(temperature)
        known.assume("dynamic_viscosity", inlet.viscosity, "oil at the inlet temperature")
        if oil.density is not None:
            kinematic = inlet.viscosity / inlet.density
            known.assume("viscosity", kinematic, "oil at the inlet temperature (catalogue.kinematic_viscosity)")
            at_40 = oil.at(VG_TEMPERATURE)
            known.assume("viscosity_vg", at_40.viscosity / at_40.density, "oil at 40 degC")
    known.put("lubrication", catalogue.lubrication, "")
    known.assume("lubrication", "oil_bath", "oil bath (catalogue.lubrication)")
    known.put("oil_level", catalogue.oil_level, "catalogue.oil_level")
    if known.values["lubrication"] == "oil_jet":
        words = "drag of a jet: twice that of a bath to half a rolling element"
        known.assume("oil_level", 0.5 * known.values["element_diameter"], words)


def _ratings(known: Known, scene: AbstractBearing, solution: Solution, catalogue: Catalogue) -> None:
    life, rating = solution.life, scene.rating
    of_rating = lambda name: getattr(rating, name, None)
    static = of_rating("static_capacity") if catalogue.static_capacity is None else catalogue.static_capacity
    known.put("static_capacity", static, "catalogue.static_capacity")
    known.put("dynamic_capacity", of_rating("dynamic_capacity"), "rating.dynamic_capacity")
    for name in ("static_capacity", "dynamic_capacity"):
        known.assume(name, getattr(life, name, None), f"{name.replace('_', ' ')} computed from the geometry")


def _seals(known: Known, catalogue: Catalogue, parsed: Said) -> None:
    known.put("seal", catalogue.seal or parsed.seal or None, "")
    words = "no seals" if not catalogue.designation else "no seals, by the designation"
    known.assume("seal", "none", f"{words} (catalogue.seal)")
    known.put("n_seals", catalogue.n_seals or parsed.n_seals or 2, "")
    known.put("seal_diameter", catalogue.seal_diameter, "catalogue.seal_diameter")


def _frictions(known: Known, catalogue: Catalogue) -> None:
    known.put("starvation_constant", catalogue.starvation_constant, "")
    known.assume("starvation_constant", 0.0, "K_rs = 0, full inlets (catalogue.starvation_constant)")
    known.put("boundary_friction", catalogue.boundary_friction, "")
    known.assume("boundary_friction", BOUNDARY_FRICTION, f"mu_bl = {BOUNDARY_FRICTION} (catalogue.boundary_friction)")
    known.put("film_friction", catalogue.film_friction, "")
    film = FILM_FRICTION.get(known.values.get("family", ""), BALL_FILM_FRICTION)
    known.assume("film_friction", film, f"mu_EHL = {film:g} (catalogue.film_friction)")


def _loads(known: Known, solution: Solution) -> None:
    operation: AbstractOperation = solution.operation
    force = np.asarray(solution.force, dtype=float)
    loads = {}
    for place, name in enumerate(RING_FREEDOMS):
        load = operation.load(name)
        held = operation.held_at(name) is not None and name not in TILTS
        loads[name] = float(force[place]) if held else 0.0 if load is None else float(np.asarray(load))
    known.put("axial", abs(loads["axial"]), "")
    known.put("radial", math.hypot(loads["radial"], loads["lateral"]), "")
    known.put("moment", math.hypot(loads["tilt"], loads["tilt_lateral"]), "")
    known.put("speed", abs(float(operation.inner_speed) - float(operation.outer_speed)), "")
