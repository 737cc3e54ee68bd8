"""The operating point of a solution as text, without the inputs that the scene does not use."""

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..._types import Scalar
from ...bearings.operation import AbstractOperation
from ...bearings.solution import Solution
from ...numerics.checks import Checked
from ..display import ZERO_CELSIUS, display_unit, displayed


def unused_operation(solution: Solution) -> set[str]:
    """Names of inputs of the operating point on which no modelled part depends; a scene need not give them."""
    unused = set()
    if solution.elements.film_inner is None:
        unused.add("oil_temperature")
    flows = solution.supply is not None and solution.supply.uses_flow
    if solution.power_loss.drag is None and solution.thermal is None and not flows:
        unused.add("oil_flow")
    return unused


def load_angle(operation: AbstractOperation) -> float | None:
    """Azimuth of the given radial load (radial and lateral components together), rad; `None` if there is none."""
    radial, lateral = (0.0 if load is None else float(load) for load in map(operation.load, ("radial", "lateral")))
    return math.atan2(lateral, radial) if radial or lateral else None


def operating_point(solution: Solution) -> str:
    """The operating point in words: "inner ring speed 10500 rpm, radial load 25 kN". The speed of a stationary outer
    ring is left out."""
    hidden, operation = unused_operation(solution), solution.operation
    texts = []
    for part, field, number in _numbers(operation):
        value = float(np.asarray(number))
        words, own = field.metadata["description"], getattr(solution.ring, field.name, None)
        moved = np.nan if own is None else float(np.asarray(own))
        if part is operation.displacement and np.isfinite(moved) and not math.isclose(moved, value, rel_tol=1e-9):
            # on a shaft the displacement is a result
            value, words = moved, words.removeprefix("given ")
        if field.name in hidden or (field.name in ("outer_speed", "load_position") and value == 0.0):
            continue
        texts.append(f"{words} {_with_unit(value, field.metadata['unit'])}")
    return ", ".join(texts)


def _numbers(part: Checked) -> Iterator[tuple[Checked, dataclasses.Field[Any], Scalar]]:
    """All numbers of an operating point, including those of its parts: the part, the field and the number."""
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if isinstance(value, Checked):
            yield from _numbers(value)
        elif value is not None:
            yield part, field, value


def field_text(operation: AbstractOperation, name: str, significant: int = 6) -> str:
    """A given number of the operating point with its unit, as text."""
    unit = type(operation).__dataclass_fields__[name].metadata["unit"]
    return _with_unit(float(np.asarray(getattr(operation, name))), unit, significant)


def _with_unit(value: float, unit: str, significant: int = 6) -> str:
    """A number with its unit, as text; forces in kN, and K converted to degC as an absolute temperature."""
    if unit == "K":
        return f"{value - ZERO_CELSIUS:.{significant}g} degC"
    if unit == "N":
        return f"{value * 1e-3:.{significant}g} kN"
    return f"{displayed(value, unit, value):.{significant}g} {display_unit(unit, value)}"
