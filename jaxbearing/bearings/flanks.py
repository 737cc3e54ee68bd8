"""Results of rings with two groove arcs, flank by flank: `load_inner` is of the flank for thrust along +e_x, and
`load_inner_second` of the other one. Elements of other bearings pass unchanged."""

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
"""End of the names of results of the second flanks."""


def _second(elements: object) -> dict[str, Array]:
    """Results of the second flanks by the names of those of the first ones."""
    if not dataclasses.is_dataclass(elements):
        return {}
    names = [field.name for field in dataclasses.fields(elements) if field.name.endswith(SECOND)]
    values = {name.removesuffix(SECOND): getattr(elements, name) for name in names}
    return {name: value for name, value in values.items() if value is not None}


def by_flank(elements: Elements) -> list[Elements]:
    """The elements with the results of their first flanks, and with those of the second ones in the same fields if a
    ring has them. A ring with one arc has no load on the second."""
    found = _second(elements)
    if not found:
        return [elements]
    empty = {name: jnp.zeros_like(getattr(elements, name)) for name in ("load_inner", "load_outer")}
    return [elements, dataclasses.replace(elements, **(empty | found))]


def on_heavier_flanks(elements: Elements) -> Elements:
    """The elements with the results of the more loaded flank of each race, at every element."""
    found = _second(elements)
    if not found:
        return elements
    heavier = {}
    for race in ("inner", "outer"):
        if f"load_{race}" in found:
            heavier[race] = found[f"load_{race}"] > getattr(elements, f"load_{race}")
    chosen = {
        name: jnp.where(heavier[name.rsplit("_", 1)[1]], value, getattr(elements, name))
        for name, value in found.items()
        if getattr(elements, name) is not None
    }
    return dataclasses.replace(elements, **chosen)
