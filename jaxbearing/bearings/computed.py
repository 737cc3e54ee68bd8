"""Results that name the function which computes them from what a solve found.

A family's `steady` hands over the results that several kinds of its equations have, and what else it found as one
record. A field of the family's results made by `computed` takes its result from there: nothing else names it.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, TypeVar

import equinox as eqx
from jaxtyping import Array

from .solution import label

Found = TypeVar("Found")


def computed(unit: str, description: str, of: Callable[[Found], Array | None], **default: Any) -> Any:
    """Field of a class of results that `computed_results` fills.

    **Arguments:** `unit`, `description`: those of `label`; `of`: from the family's record to the result, `None` where
    the scene does not model it; `default`: of `equinox.field`.
    """
    return eqx.field(metadata={**label(unit, description), "of": of}, **default)


def computed_results(kind: type[eqx.Module], found: object) -> dict[str, Any]:
    """The results of a class that name their function, by name. **Arguments:** `kind`: the class; `found`: the record
    that the functions take."""
    return {field.name: field.metadata["of"](found) for field in dataclasses.fields(kind) if "of" in field.metadata}
