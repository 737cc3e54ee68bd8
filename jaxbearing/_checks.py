"""Validity of a result: the ranges of laws that it left, and the inputs that were invalid; the groups of warnings.

The texts of checks are keys, and those of notes static fields. The group of a text is its class: a plain text is one
to act on if it is a check, and an assumption if it is a note.
"""

from collections.abc import Iterable, Iterator, Mapping

import equinox as eqx
from jaxtyping import Array, Bool


class Assumed(str):
    """A warning about what nobody gave: a number that was estimated, or an assumption of the model."""


class Information(str):
    """A warning, or a note, that nobody need act on: a law beyond its range, an input without effect."""

    def format(self, *args: object, **kwargs: object) -> "Information":
        return Information(super().format(*args, **kwargs))


def as_note(text: str) -> str:
    """A note with its group: it is an assumption unless it is information."""
    return text if isinstance(text, Information) else Assumed(text)


def about(name: str, text: str) -> str:
    """The text with the name of what it is about in front, in the group that it has."""
    return type(text)(f"{name}: {text}")


def in_groups(texts: Iterable[str]) -> tuple[list[str], list[Assumed], list[Information]]:
    """The texts in the order in which people are told them: what to act on, what was assumed, information."""
    messages = list(texts)
    assumed = [text for text in messages if isinstance(text, Assumed)]
    information = [text for text in messages if isinstance(text, Information)]
    return [text for text in messages if not isinstance(text, Assumed | Information)], assumed, information


class Checks(eqx.Module, Mapping[str, Bool[Array, "*batch"]]):
    """A mapping from a text to whether it applies: the rules that inputs break, then the ranges that laws leave.

    The rules of all inputs are one array: they cost a program one output, however many there are.

    **Arguments:**
    - `ranges`: text of a warning -> flag, shape (*batch).
    - `broken`: whether an input breaks a rule, shape (*batch, rule).
    - `rules`: each rule in words, beginning with the dotted path of a field.
    """

    ranges: dict[str, Bool[Array, "*batch"]]
    broken: Bool[Array, "*batch rule"]
    rules: tuple[str, ...] = eqx.field(static=True)

    def __getitem__(self, text: str) -> Bool[Array, "*batch"]:
        if text in self.ranges:
            return self.ranges[text]
        try:
            return self.broken[..., self.rules.index(text)]
        except ValueError:
            raise KeyError(text) from None

    def __iter__(self) -> Iterator[str]:
        yield from self.rules
        yield from self.ranges

    def __len__(self) -> int:
        return len(self.rules) + len(self.ranges)
