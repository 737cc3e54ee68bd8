"""The makers' formulas for one bearing: moments by part, exceeded ranges, assumed and missing inputs."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from . import palmgren, skf
from .known import Known, Reader
from .palmgren_constants import INA, REINFORCED, TIMKEN, Frictions
from .skf_constants import (
    ANGULAR_CONTACT,
    CYLINDRICAL,
    DEEP_GROOVE,
    FOUR_POINT,
    FULL_COMPLEMENT,
    GEOMETRY,
    ROLLER_DRAG,
    SEALS,
    TAPERED,
)

VG_RANGE = (13.5e-6, 352e-6)
"""Range of the viscosity at 40 degC, m^2/s: from ISO VG 15 minus 10 % to ISO VG 320 plus 10 %."""
LEAST_LOAD = {"ball": 0.01, "roller": 0.02}
"""Minimum load over the dynamic rating, by the rule of thumb of catalogues."""
FASTEST = {"ball": 1.206, "roller": 0.645}
"""Largest product of mean diameter and thermal reference speed, m times 1e3 rpm, among 270 deep groove and NU bearings
of a catalogue (that of 6000 and of NU 1017). Beyond it no maker states a speed, let alone a moment."""
_TABLES = {
    "deep_groove": DEEP_GROOVE,
    "angular_contact": ANGULAR_CONTACT,
    "four_point": FOUR_POINT,
    "cylindrical": CYLINDRICAL,
    "tapered": TAPERED,
}


@dataclass(frozen=True)
class Law:
    """The result of one formula.

    **Arguments:**
    - `law`: its name: "skf", "palmgren_ina", "palmgren_timken" or "timken_tapered".
    - `total`: moment, N m; `None` where the formula does not cover the bearing or lacks an input.
    - `parts`: moments by part, N m; a part that lacks an input is `None` and not in the total.
    - `flags`: texts on ranges of the formula that are exceeded.
    - `assumed`, `missing`: texts on assumed and missing inputs.
    - `power`: total moment times the relative speed of the rings, W.
    - `ratio`: total over that of the physical model; `None` if one of them is missing.
    """

    law: str
    total: float | None
    parts: Mapping[str, float | None]
    flags: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    power: float | None = None
    ratio: float | None = None

    @property
    def inside_range(self) -> bool | None:
        """True if no range of the formula is exceeded; `None` where the formula gives no moment."""
        return None if self.total is None else not self.flags


def laws_of(known: Known) -> tuple[Law, ...]:
    """Results of all formulas; a formula that does not cover the bearing says why."""
    laws = [_skf(known), _palmgren(known, "palmgren_ina"), _palmgren(known, "palmgren_timken")]
    if known.values.get("family") == "tapered":
        laws[-1] = _timken_tapered(known)
    return tuple(laws)


Constants = TypeVar("Constants")
"""Constants of one formula for one series."""


def _constants(table: Mapping[tuple[str, ...], Constants], series: str) -> Constants | None:
    return next((value for keys, value in table.items() if series in keys), None)


def _uncovered(law: str, family: str, series: str, table: Mapping[tuple[str, ...], object]) -> Law:
    known = ", ".join(key for keys in table for key in keys) or "none"
    words = f"no constants of the series '{series}' of {family.replace('_', ' ')} bearings are known; those of: {known}"
    return Law(law, None, {}, missing=(words,))


def _incomplete(law: str, read: Reader) -> Law:
    words = tuple(f"give {text}" for text in dict.fromkeys(read.missing))
    return Law(law, None, {}, missing=words)


def _kind(family: str) -> str:
    return "roller" if family.startswith(("cylindrical", "tapered")) else "ball"


def _common_flags(known: Known, read: Reader, family: str) -> Iterator[str]:
    kind, speed = _kind(family), read("speed") * 30.0 / np.pi
    product = read("mean_diameter") * speed * 1e-3
    if product > FASTEST[kind]:
        yield (
            f"faster than the fastest reference speed of a catalogue: n dm = {product:.3g}e6 mm/min, "
            f"{FASTEST[kind]:g}e6 at most"
        )
    if known.values["moment"] > 0.0:
        yield "a moment acts on the bearing, which the formula does not have"


def _range_flags(known: Known, read: Reader, family: str) -> Iterator[str]:
    """Texts on exceeded ranges of SKF's model."""
    yield from _common_flags(known, read, family)
    kind, capacity = _kind(family), known.values.get("dynamic_capacity")
    load = max(known.values["radial"], known.values["axial"])
    if capacity is not None and load < LEAST_LOAD[kind] * capacity:
        yield f"below the minimum load, {LEAST_LOAD[kind]:g} C = {LEAST_LOAD[kind] * capacity:.4g} N by rule of thumb"
    viscosity = known.values.get("viscosity_vg")
    if viscosity is not None and not VG_RANGE[0] <= viscosity <= VG_RANGE[1]:
        yield f"the oil has {1e6 * viscosity:.3g} mm^2/s at 40 degC, the formula holds from ISO VG 15 to 320"


def _skf(known: Known) -> Law:
    read = Reader(known)
    family, series = read("family"), None
    if family == "cylindrical_full":
        constants = FULL_COMPLEMENT
    else:
        series = read("series")
        constants = None if None in (family, series) else _constants(_TABLES[family], series)
    speed, viscosity, dm = read("speed"), read("viscosity"), read("mean_diameter")
    radial, axial = read("radial"), read("axial")
    further = _further_input(family, axial, read)
    boundary, film, supply = (read(name) for name in ("boundary_friction", "film_friction", "starvation_constant"))
    if family is not None and series is not None and constants is None:
        return _uncovered("skf", family, series, _TABLES[family])
    if read.missing or family is None or constants is None:
        return _incomplete("skf", read)
    size = GEOMETRY["angular_contact_double" if _is_double(family, series) else family]
    starvation, missing, flags = 1.0, [], list(_range_flags(known, read, family))
    if read("lubrication") == "grease":
        read.assumed.append("run-in grease; fresh grease has 2 to 4 times the sliding moment")
    if supply > 0.0:
        bore, outside = read("bore"), read("outside_diameter")
        if bore is None or outside is None:
            return _incomplete("skf", read)
        starvation = skf.starvation_factor(speed, viscosity, bore, outside, supply, size)
    rolling, sliding = _variables(family, constants, dm, radial, axial, speed, further)
    friction = skf.sliding_friction(speed, viscosity, dm, boundary, film)
    parts = {
        "rolling": float(skf.rolling_moment(rolling, speed, viscosity, dm, starvation)),
        "sliding": float(skf.sliding_moment(sliding, friction)),
        "seal": _seal(read, family, missing),
        "drag": _drag(read, family, size, missing, flags, 2.0 if _is_double(family, series) else 1.0),
    }
    total = sum(value for value in parts.values() if value is not None)
    return Law("skf", total, parts, tuple(flags), tuple(dict.fromkeys(read.assumed)), tuple(missing))


def _is_double(family: str | None, series: str | None) -> bool:
    return family == "angular_contact" and series in ("double row", "32A", "33A", "32B", "33B")


def _further_input(family: str | None, axial: float, read: Reader) -> float | None:
    """The further input of a family: C0 of deep groove bearings under axial load, Y of tapered ones, else `None`."""
    if family == "deep_groove" and axial > 0.0:
        return read("static_capacity")
    return read("axial_factor") if family == "tapered" else None


def _variables(
    family: str,
    constants: tuple[float, ...],
    dm: float,
    radial: float,
    axial: float,
    speed: float,
    further: float | None,
) -> skf.Moments:
    match family:
        case "deep_groove":
            return skf.deep_groove_variables(constants, dm, radial, axial, 1.0 if further is None else further)
        case "angular_contact" | "four_point":
            return skf.angular_contact_variables(constants, dm, radial, axial, speed)
        case "tapered":
            assert further is not None
            return skf.tapered_variables(constants, dm, radial, axial, further)
    return skf.cylindrical_variables(constants, dm, radial, axial)


def _seal(read: Reader, family: str, missing: list[str]) -> float | None:
    """Moment of the seals, N m; shields do not rub."""
    seal = read("seal")
    if seal in ("none", "Z"):
        return 0.0
    outside, known = read.known.values.get("outside_diameter"), SEALS.get((family, seal))
    if known is None:
        missing.append(f"seal: no constants of {seal} of {family.replace('_', ' ')} bearings are known")
        return None
    if outside is None:
        missing.append("seal: give catalogue.outside_diameter")
        return None
    # to the nanometre: 52 mm is not above 52 mm
    fitting = [constants for constants in known if constants.over < round(1e3 * outside, 6) <= constants.to]
    if not fitting:
        missing.append(f"seal: no constants of {seal} at D = {1e3 * outside:g} mm are known")
        return None
    if fitting[0].k1 == 0.0:
        return fitting[0].k2 * 1e-3
    diameter = read.known.values.get("seal_diameter")
    if diameter is None:
        missing.append("seal: give catalogue.seal_diameter")
        return None
    return 0.5 * read("n_seals") * float(skf.seal_moment(fitting[0], diameter))


def _drag(read: Reader, family: str, size: float, missing: list[str], flags: list[str], rows: float) -> float | None:
    """Drag of the oil, N m: SKF's newer formula for balls, the older one for rollers."""
    if read("lubrication") in ("grease", "oil_air"):
        return 0.0
    wanted = ("oil_level", "bore", "outside_diameter", *(("width",) if _kind(family) == "roller" else ()))
    lacking = [read.known.missing[name] for name in wanted if name in read.known.missing]
    if lacking:
        missing.append(f"drag: give {', '.join(lacking)}")
        return None
    level, bore, outside = (read(name) for name in wanted[:3])
    if level > 1.2 * 0.5 * (bore + outside):
        flags.append("the oil level is above the range of the drag formula, 1.2 dm")
    times = 2.0 if read("lubrication") == "oil_jet" else 1.0
    if _kind(family) == "roller":
        length = ROLLER_DRAG[family]
        return times * float(skf.roller_drag(read("speed"), bore, outside, read("width"), level, size, length))
    return times * float(skf.ball_drag(read("speed"), read("viscosity"), bore, outside, level, size, rows))


_TABLES_OF_PALMGREN: dict[str, Mapping[str, Mapping[tuple[str, ...], Frictions | tuple[float, float]]]] = {
    "palmgren_ina": INA,
    "palmgren_timken": TIMKEN,
}


def _palmgren(known: Known, law: str) -> Law:
    read = Reader(known)
    family, series, tables = read("family"), read("series"), _TABLES_OF_PALMGREN[law]
    speed, viscosity, dm = read("speed"), read("viscosity"), read("mean_diameter")
    table = {} if family is None else tables.get(family, {})
    constants = None if series is None else _constants(table, series)
    if constants is None and family is not None and series is not None:
        return _uncovered(law, family, series, table)
    if read.missing or family is None or series is None:
        return _incomplete(law, read)
    flags = list(_common_flags(known, read, family))
    moments: Callable[..., tuple[float, float, float]] = _ina if law == "palmgren_ina" else _timken
    f0, f1, load = moments(read, family, series, constants, flags)
    if read.missing:
        return _incomplete(law, read)
    parts = {
        "viscous": float(palmgren.viscous_moment(f0, speed, viscosity, dm)),
        "load": float(palmgren.load_moment(f1, load, dm)),
    }
    return Law(law, sum(parts.values()), parts, tuple(flags), tuple(dict.fromkeys(read.assumed)))


_NONE = (np.nan, np.nan, np.nan)


def _ina(read: Reader, family: str, series: str, constants: Frictions, flags: list[str]) -> tuple[float, float, float]:
    """Factors f0 and f1, and load P1, N, of INA; NaN where an input is missing."""
    radial, axial = read("radial"), read("axial")
    _flag_axial(family, axial, flags)
    if family == "cylindrical" and series in REINFORCED:
        read.assumed.append("constants of the reinforced series (E)")
    f0 = constants.grease if read("lubrication") in ("grease", "oil_air") else constants.bath
    f1 = constants.size
    if constants.exponent:
        double = _is_double(family, series)
        static, capacity = _static_load(read, family, radial, axial, double), read("static_capacity")
        if static is None or capacity is None:
            return _NONE
        f1 = float(palmgren.load_factor(constants.size, constants.exponent, static, capacity))
    factor = read("axial_factor") if family == "tapered" else None
    return f0, f1, float(palmgren.ina_load(family, radial, axial, factor, _is_double(family, series)))


def _timken(
    read: Reader, family: str, series: str, constants: tuple[float, float], flags: list[str]
) -> tuple[float, float, float]:
    """Factors f0 and f1, and load P1, N, of Timken; NaN where an input is missing."""
    radial, axial = read("radial"), read("axial")
    _flag_axial(family, axial, flags)
    if family.startswith("cylindrical") or not axial:
        return (*constants, radial)
    angle = read.known.values.get("contact_angle")
    if not angle:
        read.missing.append("geometry.contact_angle above 0, of whose cotangent the load P1 is made")
        return _NONE
    return (*constants, float(palmgren.timken_load(radial, axial, angle)))


def _flag_axial(family: str, axial: float, flags: list[str]) -> None:
    if family.startswith("cylindrical") and axial > 0.0:
        flags.append("the axial load rubs on the ribs, f2 Fa dm, whose f2 is not known here and which is left out")


_AXIAL_STATIC = {15: 0.46, 20: 0.42, 25: 0.38, 30: 0.33, 35: 0.29, 40: 0.26, 45: 0.22}
"""Axial factor Y0 of single-row angular contact bearings by contact angle, degrees, from ISO 76."""


def _static_load(read: Reader, family: str, radial: float, axial: float, double: bool) -> float | None:
    """Static equivalent load P0 of ISO 76, N, at least the radial load; with two rows the factors are twice as large.
    `None` if the contact angle is needed and not known."""
    if family == "deep_groove":
        return max(0.6 * radial + 0.5 * axial, radial)
    angle = read("contact_angle")
    if angle is None:
        return None
    known = sorted(_AXIAL_STATIC)
    y0 = float(np.interp(np.degrees(angle), known, [_AXIAL_STATIC[degrees] for degrees in known]))
    both = 2.0 if double else 1.0
    return max(both * (0.5 * radial + y0 * axial), radial)


def _timken_tapered(known: Known) -> Law:
    law, read = "timken_tapered", Reader(known)
    g1, factor, speed, viscosity = read("timken_g1"), read("timken_k"), read("speed"), read("dynamic_viscosity")
    radial, axial = read("radial"), read("axial")
    if read.missing:
        return _incomplete(law, read)
    ratio = factor * axial / radial if radial > 0.0 else np.inf
    if ratio > 2.0:
        equivalent = axial
    else:
        f3 = 0.06 if ratio < 0.47 else known.values.get("timken_f3")
        if f3 is None:
            words = "catalogue.timken_f3, by the manual's graph from K Fa/Fr = 0.47 to 2"
            return Law(law, None, {}, missing=(f"give {words}, here {ratio:.3g}",))
        equivalent = f3 * radial / factor
    flags, missing = list(_common_flags(known, read, "tapered")), []
    g2, f2 = known.values.get("timken_g2"), known.values.get("timken_f2")
    if g2 is None or f2 is None:
        missing.append("least speed of the formula: give catalogue.timken_g2 and catalogue.timken_f2")
    else:
        least = float(palmgren.timken_least_speed(g2, viscosity, f2, radial, factor))
        if speed < least:
            flags.append(f"below the least speed of the formula, {least * 30.0 / np.pi:.4g} rpm")
    moment = float(palmgren.timken_tapered_moment(g1, speed, viscosity, equivalent))
    return Law(law, moment, {"total": moment}, tuple(flags), tuple(dict.fromkeys(read.assumed)), tuple(missing))
