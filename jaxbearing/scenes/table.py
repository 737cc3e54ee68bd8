"""Base of all tables of a scene file."""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

Problems = Iterator[PydanticCustomError]
"""Problems that the checks of a table find, as made by `refusal_at`."""
_IS_CHECK = "is_check"


def check(method: Callable[[Any], Problems]) -> Callable[[Any], Problems]:
    """Marks a method of a table that yields problems of several fields together.

    A check should read only fields that it needs, because it ends at the first field that is refused already
    (`drafts.Draft`). Rules about other fields belong in another check.
    """
    setattr(method, _IS_CHECK, True)
    return method


class Table(BaseModel):
    """A table: unknown names are refused, and nothing is converted silently.

    - `tag`: name of the table as one of several alternatives of a field.
    - `not_yet`, `elsewhere`: names of later versions and of other tables -> what is expected instead, in words.
    - `instead`: field -> fields that it replaces: a `--set` of it removes them.
    - `about`: field -> fields that have a meaning only with it: a `--set` that removes it removes them too.
    - `needs`: optional fields whose absence a check refuses, unless another field replaces them.
    - `builds`: class that the table describes.
    - `made_from`: field -> class and field from which it was made.
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
        """The schema for these tables of a file. It differs from the class if files define names, as for shafts."""
        return cls

    @classmethod
    def example(cls) -> "type[Table]":
        """The schema for lists of fields, which belongs to no file."""
        return cls

    @classmethod
    def completed(
        cls, tables: dict[str, Any], overrides: Mapping[str, str], file: str
    ) -> tuple[dict[str, Any], Mapping[str, str]]:
        """The tables, with other scene files that they name replaced by their tables, and the remaining overrides."""
        return tables, overrides

    @classmethod
    def checks(cls) -> Iterator[Callable[[Any], Problems]]:
        """The methods marked with `check`, those of the parents first."""
        for owner in reversed(cls.__mro__):
            yield from (method for method in tuple(vars(owner).values()) if getattr(method, _IS_CHECK, False))

    @model_validator(mode="after")
    def _checked(self) -> Self:
        """Runs the checks. **Raises:** the first problem; `drafts` finds all of them."""
        for method in self.checks():
            for problem in method(self):
                raise problem
        return self


def refusal_at(field: str, expected: str, found: str, suggestion: str = "") -> PydanticCustomError:
    """The error of a check. **Arguments:** `field`: dotted path of the field inside the table; `suggestion`: nearest
    valid name."""
    context = {"field": field, "found": found, "expected": expected, "suggestion": suggestion}
    return PydanticCustomError("scene", "{field}: found {found}, expected {expected}", context)
