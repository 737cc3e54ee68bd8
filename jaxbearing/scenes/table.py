"""What all tables of a scene file have in common."""

from collections.abc import Mapping
from typing import ClassVar

from pydantic import BaseModel, ConfigDict
from pydantic_core import PydanticCustomError


class Table(BaseModel):
    """A table: unknown names are refused, and nothing is converted silently.

    `tag` names a table that is one of several alternatives of a field; `not_yet` are names of later versions with what
    to expect instead; `instead`: field -> those that it stands for: a `--set` of it takes them out; `about`: field ->
    those that say more about it: they go when a `--set` takes it out.
    """

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    tag: ClassVar[str] = ""
    not_yet: ClassVar[Mapping[str, str]] = {}
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    about: ClassVar[Mapping[str, tuple[str, ...]]] = {}


def refusal_at(field: str, expected: str, found: str) -> PydanticCustomError:
    """The error of a check that sees a whole table; `field` is the dotted path, inside the table, to look at."""
    context = {"field": field, "found": found, "expected": expected, "suggestion": ""}
    return PydanticCustomError("scene", "{field}: found {found}, expected {expected}", context)
