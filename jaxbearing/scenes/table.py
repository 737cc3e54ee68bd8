"""Base of all tables of a scene file."""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

Problems = Iterator[PydanticCustomError]
"""Problems that the checks of a table find, in the words of `refusal_at`."""
_IS_CHECK = "is_check"


def check(method: Callable[[Any], Problems]) -> Callable[[Any], Problems]:
    """Marks a method of a table that yields what is wrong with several of its fields together.

    A check reads only what it needs: it ends where it meets a field that is refused already (`drafts.Draft`), and what
    depends on other fields belongs into a check of its own.
    """
    setattr(method, _IS_CHECK, True)
    return method


class Table(BaseModel):
    """A table: unknown names are refused, and nothing is converted silently.

    `tag` names a table that is one of several alternatives of a field; `not_yet` are names of later versions, and
    `elsewhere` names that belong to other tables, both with what to expect instead; `instead`: field -> those that it
    stands for: a `--set` of it takes them out; `about`: field -> those that say more about it: they go when a `--set`
    takes it out; `needs`: fields without which, or something in their place, a check refuses the table; `builds`: the
    class that the table describes; `made_from`: field -> the class, and its field, that it was made from.
    """

    # a table is compiled when the first file with it is read
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)
    tag: ClassVar[str] = ""
    not_yet: ClassVar[Mapping[str, str]] = {}
    elsewhere: ClassVar[Mapping[str, str]] = {}
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    about: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    needs: ClassVar[tuple[str, ...]] = ()
    builds: ClassVar[type | None] = None
    made_from: ClassVar[Mapping[str, tuple[type, str]]] = {}

    if TYPE_CHECKING:  # a table has the fields of the class that it describes, see `table_of`

        def __getattr__(self, name: str) -> Any: ...

    @classmethod
    def of_file(cls, tables: Mapping[str, object], overrides: Mapping[str, str], file: str) -> "type[Table]":
        """The schema of these tables of a file, of a kind whose files have names of their own in it."""
        return cls

    @classmethod
    def example(cls) -> "type[Table]":
        """The schema of no file in particular, for lists of fields."""
        return cls

    @classmethod
    def completed(
        cls, tables: dict[str, Any], overrides: Mapping[str, str], file: str
    ) -> tuple[dict[str, Any], Mapping[str, str]]:
        """The tables with those of other files that they name, and the overrides that are left to be applied."""
        return tables, overrides

    @classmethod
    def checks(cls) -> Iterator[Callable[[Any], Problems]]:
        """The methods marked with `check`, those of the parents first."""
        for owner in reversed(cls.__mro__):
            yield from (method for method in tuple(vars(owner).values()) if getattr(method, _IS_CHECK, False))

    @model_validator(mode="after")
    def _checked(self) -> Self:
        """**Raises:** the first problem; `drafts` finds all of them."""
        for method in self.checks():
            for problem in method(self):
                raise problem
        return self


def refusal_at(field: str, expected: str, found: str, suggestion: str = "") -> PydanticCustomError:
    """The error of a check that sees a whole table; `field` is the dotted path, inside the table, to look at;
    `suggestion`: the nearest valid name."""
    context = {"field": field, "found": found, "expected": expected, "suggestion": suggestion}
    return PydanticCustomError("scene", "{field}: found {found}, expected {expected}", context)
