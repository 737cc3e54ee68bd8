"""Removal of round-off from results on screen, page, figures, in JSON and in notebooks.

A number whose modulus is below the resolution of the solve for its quantity is shown as 0. The resolution of lengths,
angles and ratios is absolute, given by the scales of the equations. That of forces, powers, speeds and pressures is
relative to the largest value of the same unit in the result. Results in Python and NetCDF, which further computation
reads, stay unchanged.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, TypeVar

import jax.numpy as jnp
import numpy as np

from ..numerics.checks import Checked
from .labels import labelled

Result = TypeVar("Result")


class Resolution(NamedTuple):
    """Resolution of a quantity: the larger of `absolute`, in its SI unit, and `relative` times the largest value."""

    absolute: float
    relative: float = 0.0


RESOLUTIONS = {
    "m": Resolution(1e-12),
    "rad": Resolution(1e-12),
    "1": Resolution(1e-14),
    "N": Resolution(1e-9, 1e-9),
    "N m": Resolution(1e-12, 1e-9),
    "W": Resolution(1e-12, 1e-9),
    "m/s": Resolution(1e-12, 1e-9),
    "rad/s": Resolution(1e-12, 1e-9),
    "Pa": Resolution(1e-3, 1e-9),
}
"""SI unit -> resolution; numbers of other units are shown as they are. 1 pm is about a hundredth of an atom."""
RELATIVE = 1e-9
"""Resolution of entries of a force vector relative to its largest force (moments with a lever of 1 m), and of entries
of a stiffness matrix relative to the geometric mean of the diagonal entries of their row and column."""
_FORCES = ("force", "on_shaft", "load")
_INPUTS = ("scene", "operation")
"""Fields with inputs, which are shown as given."""
_DISPLACEMENTS = ("displacement", "outer")
"""Fields whose numbers are lengths and angles, m and rad."""
_OVERFLOWN = 1e30
"""Larger numbers belong to failed cases of a batch and do not count as the largest value of a unit."""
_DIAGNOSTICS = ("residual_norm", "inner_residual")
"""Residuals of the solve, which are shown although they are of the size of round-off."""


def without_round_off(result: Result) -> Result:
    """A copy of a solution or transient run in which numbers below their resolution are 0."""
    largest: dict[str, float] = {}
    for part in _parts(result):
        for _, value, metadata in labelled(part):
            largest[metadata["unit"]] = max(_largest(np.asarray(value)), largest.get(metadata["unit"], 0.0))
    floors = {
        unit: max(resolution.absolute, resolution.relative * largest.get(unit, 0.0))
        for unit, resolution in RESOLUTIONS.items()
    }
    return _cleaned(result, floors)


def _largest(numbers: np.ndarray) -> float:
    """Largest modulus of the numbers that have not overflowed (`_OVERFLOWN`)."""
    return float(np.max(np.abs(numbers), initial=0.0, where=np.abs(numbers) < _OVERFLOWN))


def _parts(result: Any) -> Iterator[Any]:
    """The result itself, then the results of its bearings and sets, which it holds in dictionaries."""
    yield result
    for field in dataclasses.fields(result):
        inner = getattr(result, field.name)
        if isinstance(inner, Mapping):
            yield from (
                part for member in inner.values() if dataclasses.is_dataclass(member) for part in _parts(member)
            )


def _cleaned(part: Any, floors: Mapping[str, float]) -> Any:
    """A copy of the part without round-off; the part itself if it has none."""
    changes: dict[str, Any] = {}
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if isinstance(value, Checked) or field.name in _INPUTS:
            new = value
        elif dataclasses.is_dataclass(value) and not isinstance(value, type):
            new = _cleaned(value, floors)
        elif isinstance(value, Mapping):
            new = {
                name: _cleaned(member, floors) if dataclasses.is_dataclass(member) else member
                for name, member in value.items()
            }
            new = value if all(new[name] is member for name, member in value.items()) else new
        elif field.name in _DIAGNOSTICS:
            new = value
        elif field.name in _DISPLACEMENTS and field.metadata.get("unit") == "mixed":
            new = _zeroed(value, RESOLUTIONS["m"].absolute)
        elif field.name in _FORCES and field.metadata.get("unit") == "mixed":
            new = _zeroed(value, RELATIVE * _largest(np.asarray(value)[..., :3]))
        elif field.name == "stiffness":
            # of a failed solve it may not be finite
            diagonal = np.abs(np.diagonal(np.asarray(value), axis1=-2, axis2=-1))
            diagonal = np.sqrt(np.where(np.isfinite(diagonal), diagonal, 0.0))
            new = _zeroed(value, RELATIVE * diagonal[..., :, None] * diagonal[..., None, :])
        else:
            new = _zeroed(value, floors.get(field.metadata.get("unit", "")))
        if new is not value:
            changes[field.name] = new
    return _with(part, changes) if changes else part


def _with(part: Any, changes: Mapping[str, Any]) -> Any:
    """A copy with these fields. Its class is not called: of a transient run a part has the shapes of many instants."""
    copied = object.__new__(type(part))
    for field in dataclasses.fields(part):
        object.__setattr__(copied, field.name, changes.get(field.name, getattr(part, field.name)))
    return copied


def _zeroed(value: Any, floor: float | np.ndarray | None) -> Any:
    if floor is None or value is None:
        return value
    numbers = np.asarray(value)
    nothing = (np.abs(numbers) < floor) & (numbers != 0.0)
    if not np.issubdtype(numbers.dtype, np.floating) or not np.any(nothing):
        return value
    return jnp.asarray(np.where(nothing, 0.0, numbers))
