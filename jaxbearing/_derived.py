"""Results that follow from other results: a labelled property of a result class instead of a field that a solver fills.

Outputs treat such a property as they treat a labelled field.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import jax
import numpy as np
from jax.core import Tracer

from .numerics.checks import label

Numbers = TypeVar("Numbers")


class DerivedResult(property):
    """A property with the label of a result. `annotation`: what it returns, which names its dimensions."""

    def __init__(self, function: Callable[[Any], Any], metadata: dict[str, str]):
        super().__init__(function)
        self.__doc__ = function.__doc__ or f"{metadata['description']}, {metadata['unit']}."
        self.metadata = metadata
        self.annotation = function.__annotations__["return"]


class DerivedPart(property):
    """A property that returns several results, the fields of a class with labels. `kind`: that class."""

    def __init__(self, function: Callable[[Any], Any], kind: type):
        super().__init__(function)
        self.__doc__ = function.__doc__
        self.kind = kind


def derived(unit: str, description: str) -> Callable[[Callable[[Any], Any]], DerivedResult]:
    """Decorator that makes a method of a result class a property with a label, so that outputs show it like a field.
    The method must serve batches of solutions too: the axis of the rolling elements is the last one, and the
    annotation begins with `*batch`. It returns `None` if the scene does not model what it needs.

    **Arguments:** as those of `label`.
    """
    return lambda function: DerivedResult(function, label(unit, description))


def derived_part(kind: type) -> Callable[[Callable[[Any], Any]], DerivedPart]:
    """Decorator like `derived`, of a method that returns several results. **Arguments:** `kind`: their class."""
    return lambda function: DerivedPart(function, kind)


def derived_results(kind: type) -> dict[str, DerivedResult]:
    """The derived results of a class by name, those of its bases first."""
    return _properties(kind, DerivedResult)


def derived_parts(kind: type) -> dict[str, DerivedPart]:
    """The derived parts of a class by name, those of its bases first."""
    return _properties(kind, DerivedPart)


Property = TypeVar("Property", DerivedResult, DerivedPart)


def _properties(kind: type, wanted: type[Property]) -> dict[str, Property]:
    owners = reversed(kind.__mro__)
    return {name: member for owner in owners for name, member in vars(owner).items() if isinstance(member, wanted)}


def known_numbers(tree: Numbers) -> Numbers:
    """The tree with numpy arrays in place of JAX arrays, unless a number is traced. Numpy computes at once, where JAX
    would compile each operation first."""
    traced = any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(tree))
    return tree if traced else jax.tree.map(np.asarray, tree)
