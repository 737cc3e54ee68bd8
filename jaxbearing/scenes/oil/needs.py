"""Checks that the oil of a scene has the laws that the scene needs; errors name the law."""

from collections.abc import Mapping
from typing import Any

from ...lubricants import ISOVISCOUS
from ..errors import one_of
from ..laws import Laws
from ..table import Problems, Table, refusal_at
from .schema import OilTable, builds


def require_laws(oil: OilTable, needs: Mapping[str, str]) -> Problems:
    """Refuses a scene whose oil lacks a law.

    **Arguments:** `needs`: name of a law of the oil -> field that needs it, in words; "" if none does.
    """
    if oil.viscosity is None:
        # the oil is refused as a whole; the intended oil may have these laws
        return
    for law, user in needs.items():
        if user and getattr(oil, law) is None:
            yield refusal_at(f"oil.{law}", f"the law of {law}, which {user} needs", "nothing")


def require_piezoviscous(oil: OilTable, contact: Table, laws: Mapping[str, Laws[Any]]) -> Problems:
    """Refuses a scene whose oil has a viscosity independent of pressure, if a law holds only for piezoviscous oils.

    **Arguments:** `laws`: field of `contact` -> laws that it may name.
    """
    if not builds(oil.viscosity, *ISOVISCOUS) or oil.pressure_viscosity is not None:
        return
    for name, known in laws.items():
        law = getattr(contact, name)
        if law is not None and known.piezoviscous_only(law):
            expected = f"{one_of(known.isoviscous)}: the other laws are for oils whose viscosity rises with pressure"
            yield refusal_at(f"contact.{name}", expected, f"'{law}'")
