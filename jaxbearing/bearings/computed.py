"""Result fields that carry the function which computes them from a record of the solve.

The module `steady` of a family collects the quantities of its solve in one record. A result field that is declared with
`computed` is filled by applying its function to that record, so that its name is written only once, at the declaration.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, TypeVar

import equinox as eqx
from jaxtyping import Array

from .solution import label

Found = TypeVar("Found")


def computed(unit: str, description: str, of: Callable[[Found], Array | None], **default: Any) -> Any:
    """Field of a result class that `computed_results` fills.

    **Arguments:** `unit`, `description`: see `label`; `of`: function that takes the record of the family and returns
    the result, or `None` if the scene does not model it; `default`: further arguments of `equinox.field`.
    """
    return eqx.field(metadata={**label(unit, description), "of": of}, **default)


def computed_results(kind: type[eqx.Module], record: object) -> dict[str, Any]:
    """Computes the fields of a result class that were declared with `computed`: name -> result.

    **Arguments:** `kind`: the result class; `record`: the record that the functions take."""
    return {field.name: field.metadata["of"](record) for field in dataclasses.fields(kind) if "of" in field.metadata}
