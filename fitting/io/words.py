"""Parameters and conditions of a fit as texts: in engineering units, with as many digits as are significant."""

import math
from typing import NamedTuple

import numpy as np

from jaxbearing.report.display import ZERO_CELSIUS, digits

from ..parameters import NAMES, SYMBOLS, UNITS
from ..result import FitResult, Parameter

SYMBOL: dict[str, str] = dict(zip(NAMES, SYMBOLS, strict=True))
_SI: dict[str, str] = dict(zip(NAMES, UNITS, strict=True))
_PRESSURES = ((1e8, "GPa", 1e-9), (1e5, "MPa", 1e-6), (1e2, "kPa", 1e-3), (0.0, "Pa", 1.0))
"""Units of a pressure: smallest value, Pa, that is shown in the unit, its name, and the factor from SI."""
_MOST_DIGITS = 7
_ERROR_DIGITS = 2


class ParameterText(NamedTuple):
    """Texts of one parameter, in `unit`; `error` and `interval` are empty if it has none."""

    value: str
    unit: str
    error: str
    interval: str

    def __str__(self) -> str:
        error = f" ± {self.error}" if self.error else ""
        return f"{self.value}{error} {self.unit}"


def parameter_text(name: str, parameter: Parameter) -> ParameterText:
    """Texts of one parameter."""
    unit, factor = _unit(name, parameter.value)
    value, error = factor * parameter.value, parameter.standard_error
    if error is None or parameter.lower is None or parameter.upper is None:
        return ParameterText(digits(value), unit, "", "")
    error, lower, upper = factor * error, factor * parameter.lower, factor * parameter.upper
    # the ends of the interval have as many decimals as the value
    decimals = _decimals(value, error)
    shown = lambda number: digits(number) if decimals is None else f"{number:.{decimals}f}"
    return ParameterText(shown(value), unit, digits(error, _ERROR_DIGITS), f"{shown(lower)} to {shown(upper)}")


def _unit(name: str, value: float) -> tuple[str, float]:
    if _SI[name] == "1/Pa":
        return "1/GPa", 1e9
    if _SI[name] != "Pa":
        return _SI[name], 1.0
    return next((unit, factor) for limit, unit, factor in _PRESSURES if abs(value) >= limit)


def _decimals(value: float, error: float) -> int | None:
    """Decimals that show two digits of the error; `None` for numbers that need an exponent."""
    size = abs(value)
    if not (math.isfinite(error) and 1e-4 <= size < 1e7):
        return None
    most = _MOST_DIGITS - 1 - math.floor(math.log10(size))
    wanted = _ERROR_DIGITS - 1 - math.floor(math.log10(error)) if error > 0 else most
    return max(0, min(wanted, most))


def percent(level: float) -> str:
    """A confidence level in per cent, as text."""
    return f"{100.0 * level:.6g} %"


def conditions(result: FitResult) -> dict[str, str]:
    """Test conditions of the curves: ranges with their units, by name."""
    curves = result.curves
    return {
        "Hertz pressure": _range([1e-9 * curve.pressure for curve in curves], "GPa", 3),
        "speed": _range([curve.entrainment_speed for curve in curves], "m/s", 4),
        "temperature": _range([curve.temperature - ZERO_CELSIUS for curve in curves], "degC", 3),
    }


def _range(values: list[float], unit: str, significant: int) -> str:
    texts = [f"{float(value):.{significant}g}" for value in (np.min(values), np.max(values))]
    return f"{' to '.join(dict.fromkeys(texts))} {unit}"


def held(parameter: Parameter, scene: str = "") -> str:
    """A text that says why a parameter has no interval and, if it is held, names the scene its value comes from."""
    if not parameter.fixed:
        return f"no interval: {parameter.reason}"
    where = f" at the value of {scene}" if scene and not parameter.reason.startswith("at its bound") else ""
    reason = parameter.reason if parameter.reason != "held at the scene's value" else "as asked"
    return f"held{where}: {reason}" if not reason.startswith("at its bound") else f"held {reason}"
