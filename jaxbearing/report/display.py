"""Numbers for readers: engineering units for screens and axes, significant digits, bars made of text."""

import math
import re

_RPM = 60.0 / (2.0 * math.pi)
_ENGINEERS: dict[str, tuple[str, float]] = {
    "rad/s": ("rpm", _RPM),
    "rad": ("deg", 180.0 / math.pi),
    "m": ("um", 1e6),
    "Pa": ("GPa", 1e-9),
    "N/m": ("N/um", 1e-6),
    "N/m^(10/9)": ("N/um^(10/9)", 1e-6 ** (10.0 / 9.0)),
    "m^3/s": ("l/h", 3.6e6),
    "m^2/s": ("mm^2/s", 1e6),
    "m^2": ("mm^2", 1e6),
    "1/Pa": ("1/GPa", 1e9),
    "N/rad": ("kN/mrad", 1e-6),
    "N m/rad": ("N m/mrad", 1e-3),
    "N m/m": ("N m/um", 1e-6),
    "1": ("", 1.0),
}
"""SI unit of a result -> (unit on the screen, factor from SI). Other units are shown unchanged."""

MILLIMETRE = 1e-3
"""Length, m, from which lengths are shown in mm."""

_SCALES = {
    "N": ((1e3, "kN", 1e-3), (0.0, "N", 1.0)),
    "m": ((1e-3, "mm", 1e3), (1e-7, "µm", 1e6), (0.0, "nm", 1e9)),
    "Pa": ((1e8, "GPa", 1e-9), (0.0, "MPa", 1e-6)),
    "m/s": ((0.1, "m/s", 1.0), (0.0, "mm/s", 1e3)),
    "W": ((1e4, "kW", 1e-3), (0.0, "W", 1.0)),
    "rad": ((0.0, "deg", 180.0 / math.pi),),
}
"""SI unit -> choices (limit in SI, unit on the axis, factor from SI). The first choice whose limit is reached by the
largest value of the axis applies."""

ZERO_CELSIUS = 273.15
"""Temperature of 0 degC in K."""
_NIL = 1e-9
"""Numbers smaller than this in the unit of the screen are round-off and are shown as 0: a length in micrometres would
be smaller than an atomic nucleus."""
_BLOCKS = " ▏▎▍▌▋▊▉█"


def _shown(unit: str, largest: float) -> tuple[str, float]:
    """Unit on the screen and factor from SI."""
    if unit == "m" and math.isfinite(largest) and abs(largest) >= MILLIMETRE:
        return "mm", 1e3
    return _ENGINEERS.get(unit, (unit, 1.0))


def display_unit(unit: str, largest: float = 0.0) -> str:
    """The unit in which a result with this SI unit is shown.

    **Arguments:** `largest`: largest of the numbers that share the unit, in SI: lengths from 1 mm on are shown in mm.
    """
    return _shown(unit, largest)[0]


def displayed(value: float, unit: str, largest: float = 0.0) -> float:
    """A result in the unit in which it is shown. **Arguments:** `largest`: as in `display_unit`."""
    return value * _shown(unit, largest)[1]


def axis_unit(unit: str, largest: float) -> tuple[str, float]:
    """Unit of an axis and factor from SI. `largest` is the largest value of the axis in SI units."""
    for limit, name, factor in _SCALES.get(unit, ((0.0, unit, 1.0),)):
        if largest >= limit:
            return name, factor
    # `largest` is NaN
    return unit, 1.0


def digits(value: float, significant: int = 4) -> str:
    """A number rounded to `significant` digits as text; digits before the decimal point are never rounded. Numbers
    below 1e-4 and from 1e8 on have an exponent. NaN and infinity give "-"."""
    if not math.isfinite(value):
        return "-"
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if not -4 <= exponent <= 7:
        return f"{value:.{significant - 1}e}"
    return f"{value:.{max(0, significant - 1 - exponent)}f}"


def tick(value: float) -> str:
    """A number at an axis or a contour as text, to 10 digits. From 10 000 on thin spaces separate the thousands.
    Numbers below 1e-4 and from 1e10 on have an exponent."""
    return f"{value:.10g}" if abs(value) < 1e4 else f"{value:,.10g}".replace(",", "\N{THIN SPACE}")


def number(value: float, unit: str, significant: int = 4, largest: float = 0.0) -> str:
    """The digits of a result in the unit of the screen, without the name of the unit. `value` is in the SI unit `unit`;
    `largest` is as in `display_unit`. Numbers with a unit have no exponent, and round-off is shown as 0."""
    shown = displayed(value, unit, largest)
    text = digits(shown, significant)
    if "e" not in text or not display_unit(unit, largest):
        return text
    if abs(shown) < _NIL:
        return "0"
    return f"{shown:.{max(0, significant - 1 - math.floor(math.log10(abs(shown))))}f}"


def with_unit(value: float, unit: str, significant: int = 4) -> str:
    """A result in the unit of the screen, such as "33.57 um" or "150.0 mm". `value` is in the SI unit `unit`."""
    return f"{number(value, unit, significant, value)} {display_unit(unit, value)}".rstrip()


def span(low: float, high: float, unit: str) -> str:
    """An interval in the unit of the screen, such as "5.000 to 20.00 um". `low` and `high` are in the SI unit."""
    largest = max(abs(low), abs(high))
    return f"{digits(displayed(low, unit, largest))} to {digits(displayed(high, unit, largest))} " + display_unit(
        unit, largest
    )


def bar(fraction: float, width: int, ascii_only: bool = False) -> str:
    """A horizontal bar of text, in steps of an eighth of a character, or of a whole character with `ascii_only`.

    **Arguments:** `fraction`: filled part, 0 to 1; `width`: characters of a full bar.
    """
    fraction = min(max(fraction, 0.0), 1.0) if math.isfinite(fraction) else 0.0
    if ascii_only:
        return "#" * round(fraction * width)
    eighths = round(8 * fraction * width)
    if eighths == 0 and fraction > 0.0:
        eighths = 1
    return ("█" * (eighths // 8) + _BLOCKS[eighths % 8]).rstrip()


def typeset(text: str) -> str:
    """Replaces ASCII units by typeset ones, such as um by µm and m^2 by m². A terminal may lack these characters."""
    signs = re.sub(r"(?<=[ /])u(?=m\b)", "µ", re.sub(r" degC\b", " °C", text))
    return re.sub(r"(?<=[a-zA-Z])\^([23])\b", lambda match: "²³"[int(match[1]) - 2], signs)


def pretty(text: str) -> str:
    """A list with commas, as text for the head of a figure or page: units are typeset and commas become centred
    dots."""
    return typeset(text).replace(", ", "   ·   ")
