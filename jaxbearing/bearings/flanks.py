"""Results of the single flanks of rings with two groove arcs: `load_inner` belongs to the flank that carries thrust
along +e_x, `load_inner_second` to the other flank. Elements of other bearings are returned unchanged."""

import dataclasses
from typing import TYPE_CHECKING, Any, TypeVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

if TYPE_CHECKING:
    Elements = TypeVar("Elements", bound=eqx.Module)
else:
    Elements = Any

SECOND = "_second"
"""Suffix of the names of results of the second flanks."""


def _second(elements: object) -> dict[str, Array]:
    """Results of the second flanks under the names of the first flanks, that is without the suffix."""
    if not dataclasses.is_dataclass(elements):
        return {}
    names = [field.name for field in dataclasses.fields(elements) if field.name.endswith(SECOND)]
    values = {name.removesuffix(SECOND): getattr(elements, name) for name in names}
    return {name: value for name, value in values.items() if value is not None}


def by_flank(elements: Elements) -> list[Elements]:
    """Returns the elements with the results of the first flanks and, if a ring has two arcs, the elements with the
    results of the second flanks in the same fields. The second flank of a ring with one arc has the load 0."""
    second = _second(elements)
    if not second:
        return [elements]
    empty = {name: jnp.zeros_like(getattr(elements, name)) for name in ("load_inner", "load_outer")}
    return [elements, dataclasses.replace(elements, **(empty | second))]


def on_heavier_flanks(elements: Elements) -> Elements:
    """Returns the elements with the results of the more heavily loaded flank, for each race and element."""
    second = _second(elements)
    if not second:
        return elements
    heavier = {}
    for race in ("inner", "outer"):
        if f"load_{race}" in second:
            heavier[race] = second[f"load_{race}"] > getattr(elements, f"load_{race}")
    chosen = {
        name: jnp.where(heavier[name.rsplit("_", 1)[1]], value, getattr(elements, name))
        for name, value in second.items()
        if getattr(elements, name) is not None
    }
    return dataclasses.replace(elements, **chosen)
