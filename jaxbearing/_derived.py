"""Results that follow from other results: a labelled property of a result class instead of a field that a solver fills.

Outputs treat such a property as they treat a labelled field.
"""

from collections.abc import Callable
from typing import Any

from .numerics.checks import label


class DerivedResult(property):
    """A property with the label of a result. `annotation`: what it returns, which names its dimensions."""

    def __init__(self, function: Callable[[Any], Any], metadata: dict[str, str]):
        super().__init__(function)
        self.__doc__ = function.__doc__ or f"{metadata['description']}, {metadata['unit']}."
        self.metadata = metadata
        self.annotation = function.__annotations__["return"]


def derived(unit: str, description: str) -> Callable[[Callable[[Any], Any]], DerivedResult]:
    """Decorator that makes a method of a result class a result, a property. The method also meets batches of
    solutions: it takes an element's axis as the last one, and its annotation begins with `*batch`. It returns `None`
    where the scene does not model what it needs.

    **Arguments:** as those of `label`.
    """
    return lambda function: DerivedResult(function, label(unit, description))


def derived_results(kind: type) -> dict[str, DerivedResult]:
    """The derived results of a class by name, those of its bases first."""
    return {
        name: one
        for owner in reversed(kind.__mro__)
        for name, one in vars(owner).items()
        if isinstance(one, DerivedResult)
    }
