"""Parts that bearing families share: the operating point, the contact laws, drag."""

import math
from typing import Any

import equinox as eqx

from .._scene import AbstractScene, label, number, optional_number
from .._types import Scalar
from ..contacts.laws import ContactLaws
from ..materials import Material
from ..numerics.checks import known, require

__all__ = ["AbstractScene", "ContactLaws", "Drag", "Materials", "Operation", "number", "optional_number"]


class Operation(eqx.Module):
    """Operating point of a roller bearing: the batched part of a sweep.

    **Arguments:**
    - `inner_speed`, `outer_speed`: absolute speeds of the rings, rad/s, counter-clockwise positive.
    - `radial_load`: on the inner ring, along azimuth 0, N, > 0.
    - `oil_temperature`: inlet temperature, K; every interaction uses it unless it computes its own.
    - `oil_flow`: supplied to the bearing, m^3/s.
    """

    inner_speed: Scalar = number(metadata=label("rad/s", "inner ring speed"))
    radial_load: Scalar = number(metadata=label("N", "radial load"))
    oil_temperature: Scalar = number(373.15, metadata=label("K", "oil temperature"))
    oil_flow: Scalar = number(0.0, metadata=label("m^3/s", "oil flow"))
    outer_speed: Scalar = number(0.0, metadata=label("rad/s", "outer ring speed"))

    def __check_init__(self):
        require(
            "operation",
            inner_speed=(self.inner_speed, "finite"),
            outer_speed=(self.outer_speed, "finite"),
            radial_load=(self.radial_load, "> 0"),
            oil_temperature=(self.oil_temperature, "> 0"),
            oil_flow=(self.oil_flow, ">= 0"),
        )


class Materials(eqx.Module):
    """Solids of a roller bearing: `rings` and `rollers`."""

    rings: Material
    rollers: Material


class Drag(eqx.Module):
    """Oil drag on the orbiting rolling elements (windage and churning).

    **Arguments:**
    - `coefficient`: drag coefficient Cd of one rolling element in its row, >= 0; the most influential free
      number of a fast bearing's power loss.
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1 = under-race supply.
    """

    coefficient: Scalar = number()
    through_flow_fraction: Scalar = number(1.0)

    def __check_init__(self):
        require(
            "drag",
            coefficient=(self.coefficient, ">= 0"),
            through_flow_fraction=(self.through_flow_fraction, "between 0 and 1"),
        )


def check_row_fits(count: int, diameter: Any, pitch_diameter: Any, element: str = "roller") -> None:
    """**Raises:** `ValueError` where the rolling elements do not fit on the pitch circle."""
    name = f"geometry.n_{element}s"
    if count < 1:
        raise ValueError(f"{name} must be >= 1, got {count}")
    sizes = known(diameter, pitch_diameter)
    if sizes is None:
        return
    chord = sizes[1] * math.sin(math.pi / max(count, 2))
    if sizes[0] >= chord:
        raise ValueError(
            f"{name}: {count} {element}s of diameter {sizes[0]:g} m do not fit on a pitch "
            f"circle of {sizes[1]:g} m: their centres are {chord:g} m apart"
        )
