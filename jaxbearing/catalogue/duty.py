"""Operation and oil of a standard bearing: given values, and examples for the rest."""

import json
from collections.abc import Iterator
from typing import NamedTuple

from ..scenes.oil.grades import DEFAULT_BASE, grade_named, grade_of
from ..scenes.quantity_texts import text_in
from ..scenes.toml_writer import one_line
from ..scenes.units import FLOW, FORCE, SPEED, TEMPERATURE, Dimension

LOAD_SHARE = {"deep_groove": (0.1, 0.0), "cylindrical": (0.1, None), "tapered": (0.1, 0.1)}
"""Radial and axial load of the example over the dynamic rating; `None`: the kind has no axial load."""
OTHER_SHARE = 0.05, 0.05
SPEED_FACTOR = 150_000.0
"""Speed times mean diameter of the example, mm/min; a moderate value."""
OIL_TEMPERATURE = 60.0
"""Temperature of the oil in the example, degrees Celsius."""
USUAL_TEMPERATURES = 233.15, 453.15
"""Range of temperatures of standard oils, K, in which it is certain that scenes can be built."""
EXAMPLE = "an example"


class Duty(NamedTuple):
    """Operation and oil of a standard bearing; values that are not given are examples, and without `oil` the scene is
    dry.

    **Arguments:** all optional, SI.
    - `radial_load`, `axial_load`: N.
    - `inner_speed`: rad/s.
    - `oil`: grade of a standard oil, "ISO VG 68", or name of an oil of the catalogue, "fva3".
    - `base`: base stock of a grade, "mineral", "PAO", "ester" or "polyglycol".
    - `oil_temperature`: K.
    - `oil_flow`: m^3/s, for the drag of the rolling elements.
    """

    radial_load: float | None = None
    axial_load: float | None = None
    inner_speed: float | None = None
    oil: str | None = None
    base: str | None = None
    oil_temperature: float | None = None
    oil_flow: float | None = None

    @property
    def is_usual(self) -> bool:
        """True if given loads and speed are positive and the oil, if any, is a standard one at a usual temperature.
        Other oils may lack laws that `laws = "best"` needs."""
        operation = (self.radial_load, self.axial_load, self.inner_speed)
        if any(value is not None and value <= 0.0 for value in operation):
            return False
        if self.oil is None:
            return True
        table = {"grade": self.oil} if self.base is None else {"grade": self.oil, "base": self.base}
        low, high = USUAL_TEMPERATURES
        usual = self.oil_temperature is None or low <= self.oil_temperature <= high
        return usual and grade_of(table) is not None

    def check(self) -> None:
        """Checks all values.

        **Raises:** `ValueError` for numbers out of their ranges, and for properties of an oil without an oil.
        """
        bounds = {
            "radial_load": "finite",
            "axial_load": "finite",
            "inner_speed": "finite",
            "oil_temperature": "> 0",
            "oil_flow": ">= 0",
        }
        for name, bound in bounds.items():
            value = getattr(self, name)
            if value is not None:
                # a command that checks nothing does not wait for the import of NumPy
                from ..numerics.arguments import require_numbers

                require_numbers(bound, **{name: value})
        for name in ("base", "oil_temperature", "oil_flow"):
            if self.oil is None and getattr(self, name) is not None:
                raise ValueError(f"{name} is only allowed with an oil, such as 'ISO VG 68'")
        if self.base is not None and self.oil is not None and grade_named(self.oil) is None:
            raise ValueError(f"base is only allowed with the grade of a standard oil (here oil = '{self.oil}')")


class Line(NamedTuple):
    """A field of a scene file: its value as it is written, and the comment."""

    name: str
    value: str
    comment: str


def oil_lines(duty: Duty) -> Iterator[Line]:
    """The fields of `[oil]`; a dry scene has none."""
    if duty.oil is None:
        return
    grade = grade_named(duty.oil)
    if grade is None:
        yield Line("name", quoted(duty.oil), "given")
        return
    yield Line("grade", quoted(grade), "given")
    if duty.base is None:
        yield Line("base", quoted(DEFAULT_BASE), "assumed; or PAO, ester, polyglycol")
    else:
        yield Line("base", quoted(duty.base), "given")


def operation_lines(duty: Duty, kind: str, mean_diameter: float, capacity: float) -> Iterator[Line]:
    """The fields of `[operation]`.

    If only one of the loads is given, the other one keeps the ratio of the example to it.

    **Arguments:** `kind`: of `Designation`; `mean_diameter`: of bore and outside diameter, mm; `capacity`: dynamic
    rating, N.
    """
    yield _line("inner_speed", duty.inner_speed, SPEED_FACTOR / mean_diameter, "rpm", SPEED)
    of_radial, of_axial = LOAD_SHARE.get(kind, OTHER_SHARE)
    radial, axial = of_radial * capacity, None if of_axial is None else of_axial * capacity
    if of_axial and duty.axial_load and duty.radial_load is None:
        radial = of_radial / of_axial * abs(duty.axial_load)
    if of_axial and duty.radial_load and duty.axial_load is None:
        axial = of_axial / of_radial * abs(duty.radial_load)
    yield _line("radial_load", duty.radial_load, radial, "N", FORCE)
    if axial is not None or duty.axial_load is not None:
        yield _line("axial_load", duty.axial_load, axial or 0.0, "N", FORCE)
    if duty.oil is not None:
        yield _line("oil_temperature", duty.oil_temperature, OIL_TEMPERATURE, "degC", TEMPERATURE)
    if duty.oil_flow is not None:
        yield _line("oil_flow", duty.oil_flow, 0.0, "l/h", FLOW)


def _line(name: str, value: float | None, example: float, unit: str, dimension: Dimension) -> Line:
    """The line of a field: the value that is given, in SI, or else that of the example, in `unit`, with two digits."""
    if value is None:
        return Line(name, f'"{two_digits(example):g} {unit}"', EXAMPLE)
    return Line(name, f'"{text_in(unit, float(value), dimension)}"', "given")


def two_digits(value: float) -> float:
    """A number rounded to two significant digits."""
    return float(f"{value:.2g}")


def quoted(text: str) -> str:
    """A text as a string of a scene file."""
    return json.dumps(one_line(text), ensure_ascii=False)
