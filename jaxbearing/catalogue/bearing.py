"""A standard bearing: its designation, its estimated internal geometry, and the scene made from both."""

import math
import tomllib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from .designation import Designation, parse
from .duty import Duty
from .geometry import Estimate, Geometry
from .kept import kept_geometry
from .proportions import Normal, proportions_of
from .scene_text import scene_text
from .terms import angle_of, is_usual

if TYPE_CHECKING:
    from .._scene import AbstractScene

FAR = 4.0
"""Difference of a given rating from the usual one, in standard deviations, above which a note doubts it."""
ROLLERS = ("cylindrical", "tapered")


class Bearing(NamedTuple):
    """A bearing of the catalogue of standard dimensions.

    **Arguments:**
    - `designation`: type, boundary dimensions and the meaning of the suffixes.
    - `geometry`: the internal geometry; each number is an `Estimate` with its 90 % interval.
    - `given`: numbers that were given for the estimate, SI.
    - `duty`: operation and oil.
    """

    designation: Designation
    geometry: Geometry
    given: Mapping[str, float]
    duty: Duty = Duty()

    def text(self) -> str:
        """The scene as a commented TOML file; estimated values are marked with their intervals."""
        return scene_text(self.designation, self.geometry, self.given, self.duty)

    def tables(self) -> dict[str, Any]:
        """The tables of the scene file."""
        return tomllib.loads(self.text())

    @property
    def is_usual(self) -> bool:
        """True if it is certain that the scene can be built: no internal dimension is given, operation and oil are
        usual, and the estimate has usual proportions. Building any other scene may fail with an error."""
        ratings = {"dynamic_capacity", "static_capacity"}
        if set(self.given) - ratings or not self.duty.is_usual:
            return False
        if self.duty.axial_load is not None and self.designation.kind == "cylindrical":
            return False
        return is_usual(self.designation, self.geometry, angle_of(self.designation, None), FAR)

    def scene(self) -> "AbstractScene":
        """The scene, with the laws of `laws = "best"` if an oil is given, else dry. Loads and a speed that are not
        given are examples: small parts of the dynamic rating, and a moderate speed.

        **Raises:** `SceneError` if the numbers that were given make an impossible bearing, and for an unknown oil.
        """
        # imported here because only a scene needs it: the text alone is faster without
        from ..scenes.reader import scene_from_tables

        return scene_from_tables(self.tables(), self.designation.text)


def find(
    designation: str,
    *,
    dynamic_capacity: float | None = None,
    static_capacity: float | None = None,
    n_elements: int | None = None,
    element_diameter: float | None = None,
    pitch_diameter: float | None = None,
    roller_length: float | None = None,
    contact_angle: float | None = None,
    radial_load: float | None = None,
    axial_load: float | None = None,
    inner_speed: float | None = None,
    oil: str | None = None,
    base: str | None = None,
    oil_temperature: float | None = None,
    oil_flow: float | None = None,
) -> Bearing:
    """A bearing by its designation, e.g. "6207", "7312-B", "NU 311", "30206" or "7014 C".

    Boundary dimensions are standard. The internal geometry is estimated from usual proportions and from the given
    numbers; each of these narrows the intervals of the rest. With an oil the scene has the laws of `laws = "best"`,
    including rolling resistance, and its losses by location; without an oil it is dry.

    **Arguments:** all SI, all optional but the first:
    - `dynamic_capacity`, `static_capacity`: C and C0 of a maker, N.
    - `n_elements`: number of balls or rollers.
    - `element_diameter`: of balls, or of rollers at mid length, m.
    - `pitch_diameter`: m.
    - `roller_length`: effective length of rollers, m.
    - `contact_angle`: of angular contact ball bearings, and the cup's half angle of tapered roller bearings, rad.
    - `radial_load`, `axial_load`, N, `inner_speed`, rad/s: operation; an example where not given.
    - `oil`: grade of a standard oil, "ISO VG 68", or name of an oil of the catalogue; `base`: base stock of a grade,
      "mineral" where not given; `oil_temperature`, K, 60 degC where not given; `oil_flow`, m^3/s, which drag needs.

    **Raises:** `SceneError` for an unknown designation, with the nearest known ones; `ValueError` for a number that is
    not possible, or that a bearing of this type does not have.
    """
    bearing = parse(designation)
    numbers = {
        "dynamic_capacity": dynamic_capacity,
        "static_capacity": static_capacity,
        "n_elements": n_elements,
        "diameter": element_diameter,
        "pitch_diameter": pitch_diameter,
        "length": roller_length,
        "contact_angle": contact_angle,
    }
    known = {name: value for name, value in numbers.items() if value is not None}
    if known:
        _check(bearing, known)
    duty = Duty(radial_load, axial_load, inner_speed, oil, base, oil_temperature, oil_flow)
    duty.check()
    geometry = _estimated(bearing, known, angle_of(bearing, contact_angle))
    notes = (*bearing.notes, *_doubts(bearing, geometry, known))
    return Bearing(bearing._replace(notes=notes), geometry, known, duty)


def _estimated(bearing: Designation, known: Mapping[str, float], angle: Normal) -> Geometry:
    """The geometry: if nothing is given, from the file of kept estimates if it has one; otherwise computed."""
    kept = None if known else kept_geometry(bearing, angle)
    if kept is not None:
        return kept
    # JAX takes a second to import, which a kept estimate does not need
    from .estimate import estimate

    return estimate(bearing, known, angle)


def _doubts(bearing: Designation, geometry: Geometry, known: Mapping[str, float]) -> Iterator[str]:
    """Notes on given ratings that are far from those of a usual geometry of this size."""
    usual = proportions_of(bearing.kind, bearing.series)
    for name, law in (("dynamic_capacity", usual.dynamic), ("static_capacity", usual.static)):
        ratio = known.get(name, math.nan) / getattr(geometry, name)
        if abs(math.log(ratio) - law.mean) > FAR * law.deviation:
            yield f"the given {name} is {ratio:.2f} times that of a usual geometry of this size: is it this bearing's?"


def _check(bearing: Designation, known: Mapping[str, Any]) -> None:
    """Checks the given numbers against type and boundary dimensions.

    **Raises:** `ValueError`.
    """
    # a command that checks nothing does not wait for the import of NumPy
    from ..numerics.arguments import require_count, require_numbers

    names = {"diameter": "element_diameter", "length": "roller_length"}
    require_numbers("> 0", **{names.get(name, name): value for name, value in known.items()})
    if "n_elements" in known:
        require_count("n_elements", known["n_elements"], 3)
    if "length" in known and bearing.kind not in ROLLERS:
        raise ValueError(f"roller_length: {bearing.text} has balls")
    if "contact_angle" in known and bearing.kind in ("deep_groove", "cylindrical"):
        raise ValueError(f"contact_angle: that of {bearing.text} follows from its clearance")
    if known.get("contact_angle", 0.0) >= 0.5 * math.pi:
        raise ValueError("contact_angle must be below pi/2 rad")
    mean, half = 0.5e-3 * (bearing.bore + bearing.outside), 0.5e-3 * (bearing.outside - bearing.bore)
    if not 1e-3 * bearing.bore < known.get("pitch_diameter", mean) < 1e-3 * bearing.outside:
        raise ValueError(f"pitch_diameter must be between bore and outside diameter of {bearing.text}")
    if known.get("diameter", 0.0) >= half:
        raise ValueError(f"element_diameter must be below the height of the section of {bearing.text}, {half:g} m")
    taken = known.get("n_elements", 0) * known.get("diameter", 0.0)
    if taken >= math.pi * known.get("pitch_diameter", mean):
        raise ValueError("n_elements: so many elements of this diameter do not fit beside each other")
    if known.get("length", 0.0) > 1e-3 * bearing.width:
        raise ValueError(f"roller_length must be at most the width of {bearing.text}, {1e-3 * bearing.width:g} m")


__all__ = ["Bearing", "Estimate", "find"]
