"""From the tables that all bearings have to the parts of the library."""

from collections.abc import Callable
from typing import Any, TypeVar

import jax

from ..bearings.cage import AbstractCage
from ..numerics.refusals import refusals_of, refuse_all
from .drafts import STAND_IN, Unreadable
from .laws import TURBULENCE
from .table import Table

Cage = TypeVar("Cage", bound=AbstractCage)
Part = TypeVar("Part")


def built(kind: type[Part], **parts: Callable[[], Any]) -> Part:
    """The scene of these parts, each made by its function; all are tried before one is refused.

    **Raises:** `ValueError` with everything that the classes refuse; `Unreadable` for a part of a table that is refused
    already.
    """
    made: dict[str, Any] = {}
    problems: list[ValueError] = []
    unreadable: Unreadable | None = None
    for name, make in parts.items():
        try:
            problems += refusals_of(lambda name=name, make=make: made.update({name: make()}))
        except Unreadable as error:
            unreadable = error
    refuse_all(problems)
    if unreadable is not None or any(leaf is STAND_IN for leaf in jax.tree.leaves(made)):
        raise unreadable or Unreadable(kind.__name__)
    return kind(**made)


def part(kind: type[Part], table: Table | None) -> Part | None:
    """The part whose attributes are the fields of the table, where there is one."""
    return None if table is None else kind(**table.model_dump())


def cage(kind: type[Cage], table: Any) -> Cage | None:
    """The cage that a table describes, where there is one."""
    return None if table is None else kind(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
