"""From the tables that all bearings have to the parts of the library."""

from typing import TypeVar

from ..bearings.cage import AbstractCage
from .bearing_schema import BearingCageTable
from .table import Table
from .turbulence import TURBULENCE

Cage = TypeVar("Cage", bound=AbstractCage)
Part = TypeVar("Part")


def part(kind: type[Part], table: Table | None) -> Part | None:
    """The part whose attributes are the fields of the table, where there is one."""
    return None if table is None else kind(**table.model_dump())


def cage(kind: type[Cage], table: BearingCageTable | None) -> Cage | None:
    """The cage that a table describes, where there is one."""
    return None if table is None else kind(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
