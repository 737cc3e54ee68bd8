"""Kept estimates: stored geometries of standard bearings, for use where only the designation is known.

They follow from the dimensions and the usual proportions, so `docs/generate/kept_estimates.py` computes them once.
With a kept estimate JAX, whose import takes a second, is not needed. Tests compare `data/estimates.csv` with computed
estimates.
"""

import functools
import math
from collections.abc import Iterator
from importlib import resources
from importlib.resources.abc import Traversable

from .designation import Designation, known_designations, parse
from .geometry import Estimate, Geometry
from .proportions import Normal

_KEY = ("kind", "series", "bore", "outside", "width", "angle", "deviation")
"""Key of a row: type, series, boundary dimensions, mm, contact angle and its standard deviation, degrees. After a
change of dimensions no row is found, and the estimate is computed."""
_INTERVALS, _RATINGS = Geometry._fields[:7], Geometry._fields[7:9]
"""Fields of `Geometry` with an interval, three columns each, and fields with one column."""
_COLUMNS = (*(f"{name}{end}" for name in _INTERVALS for end in ("", "_least", "_greatest")), *_RATINGS)
HEADING = ",".join((*_KEY, *_COLUMNS, "standard_size"))
_ANGLES = {"angular_contact": ("B", "AC", "C"), "spindle": ("B", "AC", "C"), "tapered": ("B",)}
"""Suffixes that state a contact angle, by kind of bearing."""


def kept_file() -> Traversable:
    """The file with the kept estimates."""
    return resources.files("jaxbearing.catalogue") / "data" / "estimates.csv"


def kept_designations() -> Iterator[str]:
    """All designations with kept estimates: the known ones, alone and with each suffix that states a contact angle."""
    for text in known_designations():
        yield text
        yield from (f"{text} {suffix}" for suffix in _ANGLES.get(parse(text).kind, ()))


def kept_geometry(bearing: Designation, angle: Normal) -> Geometry | None:
    """The kept estimate, or `None` if there is none; arguments as those of `estimate.estimate`."""
    row = _rows().get(key_of(bearing, angle))
    if row is None:
        return None
    *numbers, standard = row.split(",")
    values = [*map(int, numbers[:3]), *map(float, numbers[3:])]
    starts = range(0, 3 * len(_INTERVALS), 3)
    intervals = [Estimate(values[i], values[i + 1], values[i + 2]) for i in starts]
    geometry = Geometry._make((*intervals, *values[starts.stop :], standard == "True"))
    return geometry._replace(contact_angle=geometry.contact_angle._replace(given=angle.is_known))


def row_of(bearing: Designation, angle: Normal, geometry: Geometry) -> str:
    """The row of the file for an estimate, with all digits; arguments as for `estimate.estimate`, and its result."""
    numbers = [repr(number) for name in _INTERVALS for number in getattr(geometry, name)[:3]]
    numbers += [repr(getattr(geometry, name)) for name in _RATINGS]
    return ",".join((key_of(bearing, angle), *numbers, str(geometry.standard_size)))


def key_of(bearing: Designation, angle: Normal) -> str:
    """The key with which the row of an estimate begins; arguments as for `estimate.estimate`."""
    sizes = (bearing.bore, bearing.outside, bearing.race_width)
    numbers = (*sizes, math.degrees(angle.mean), math.degrees(angle.deviation))
    return ",".join((bearing.kind, bearing.series, *(f"{number:.9g}" for number in numbers)))


@functools.cache
def _rows() -> dict[str, str]:
    """Estimates of the file by their keys."""
    lines = kept_file().read_text(encoding="utf-8").splitlines()[1:]
    cells = (line.split(",", len(_KEY)) for line in lines)
    return {",".join(key): row for *key, row in cells}
