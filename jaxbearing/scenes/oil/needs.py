"""Requirements of a scene on its oil: refused by name of the law that is missing or does not fit."""

from collections.abc import Mapping
from typing import Any

from ...lubricants import ISOVISCOUS
from ..errors import one_of
from ..laws import Laws
from ..table import Problems, Table, refusal_at
from .schema import OilTable, builds


def require_laws(oil: OilTable, needs: Mapping[str, str]) -> Problems:
    """Refusals of a scene whose oil lacks a law.

    **Arguments:** `needs`: name of a law of the oil -> the field that needs it, in words; "" where none does.
    """
    if oil.viscosity is None:
        # it is refused as a whole, and whatever is meant may have these laws
        return
    for law, user in needs.items():
        if user and getattr(oil, law) is None:
            yield refusal_at(f"oil.{law}", f"the law of {law}, which {user} needs", "nothing")


def require_piezoviscous(oil: OilTable, contact: Table, laws: Mapping[str, Laws[Any]]) -> Problems:
    """Refusals of a scene that names a law that does not hold for an oil of the same viscosity at every pressure.

    **Arguments:** `laws`: fields of `contact` -> the laws that they may name.
    """
    if not builds(oil.viscosity, *ISOVISCOUS) or oil.pressure_viscosity is not None:
        return
    for name, known in laws.items():
        given = getattr(contact, name)
        if given is not None and known.piezoviscous_only(given):
            expected = f"{one_of(known.isoviscous)}: the other laws are for oils whose viscosity rises with pressure"
            yield refusal_at(f"contact.{name}", expected, f"'{given}'")
