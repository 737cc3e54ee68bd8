"""Parts that bearing families share: the operating point, the contact laws, drag; and how a scene is changed."""

import dataclasses
import math
from typing import Any, TypeVar

import equinox as eqx

from .._types import Scalar
from ..contacts.laws import ContactLaws
from ..materials import Material
from ..numerics.checks import known, require
from ..numerics.precision import as_float
from .labels import label

__all__ = ["AbstractScene", "ContactLaws", "Drag", "Materials", "Operation"]

Scene = TypeVar("Scene", bound="AbstractScene")


def number(default: Any = dataclasses.MISSING, **kwargs: Any) -> Any:
    """Field of a scene that holds one number, converted to a float64 leaf."""
    if default is not dataclasses.MISSING:
        kwargs["default"] = default
    return eqx.field(converter=as_float, **kwargs)


def optional_number() -> Any:
    """Like `number`, `None` where the scene does not say."""
    return eqx.field(converter=lambda v: None if v is None else as_float(v), default=None)


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


class AbstractScene(eqx.Module):
    """What every scene can do: give a changed copy of itself, with the attribute names of the scene file."""

    def replace(self: Scene, changes: dict[str, Any]) -> Scene:
        """A copy with other values; keys are dotted paths, values SI numbers (or parts).

        **Raises:** `AttributeError` for a path that the scene does not have.
        """
        return _replaced(self, {tuple(path.split(".")): value for path, value in changes.items()})

    def at_operation(self: Scene, **changes: Any) -> Scene:
        """A copy at another operating point: `scene.at_operation(inner_speed=1100.0)`."""
        return self.replace({f"operation.{name}": value for name, value in changes.items()})

    def replace_geometry(self: Scene, **changes: Any) -> Scene:
        """A copy with other dimensions: `scene.replace_geometry(diametral_clearance=30e-6)`."""
        return self.replace({f"geometry.{name}": value for name, value in changes.items()})


def _replaced(part: Any, changes: dict[tuple[str, ...], Any], above: str = "") -> Any:
    """The part rebuilt once with all changes, so that what is validated is the result and no state in between."""
    names = [field.name for field in dataclasses.fields(part)] if isinstance(part, eqx.Module) else []
    new: dict[str, Any] = {}
    inner: dict[str, dict[tuple[str, ...], Any]] = {}
    for path, value in changes.items():
        if not isinstance(part, eqx.Module) or path[0] not in names:
            whole, there = above + ".".join(path), ", ".join(names) or "no fields"
            raise AttributeError(f"the scene has no {whole!r}: {type(part).__name__} has {there}")
        if len(path) == 1:
            new[path[0]] = value
        else:
            inner.setdefault(path[0], {})[path[1:]] = value
    for name, deeper in inner.items():
        new[name] = _replaced(new.get(name, getattr(part, name)), deeper, f"{above}{name}.")
    return dataclasses.replace(part, **new) if isinstance(part, eqx.Module) else part


def check_row_fits(n_rollers: int, diameter: Any, pitch_diameter: Any) -> None:
    """**Raises:** `ValueError` where the rolling elements do not fit on the pitch circle."""
    if n_rollers < 1:
        raise ValueError(f"geometry.n_rollers must be >= 1, got {n_rollers}")
    sizes = known(diameter, pitch_diameter)
    if sizes is None:
        return
    chord = sizes[1] * math.sin(math.pi / max(n_rollers, 2))
    if sizes[0] >= chord:
        raise ValueError(
            f"geometry.n_rollers: {n_rollers} rollers of diameter {sizes[0]:g} m do not fit on a pitch "
            f"circle of {sizes[1]:g} m: their centres are {chord:g} m apart"
        )
