"""Validity of a result: the ranges of laws that it left, and the inputs that were invalid."""

from collections.abc import Iterator, Mapping

import equinox as eqx
from jaxtyping import Array, Bool


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
