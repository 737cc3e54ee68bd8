"""Results as rows and columns of tables, from the labels of the result classes."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from .._scene import AbstractSolution
from .backends.screen import column
from .display import display_unit, number, with_unit
from .labels import labelled


@dataclass(frozen=True)
class Row:
    """A scalar result: dotted path in Python, value as text, its unit, and description."""

    path: str
    value: str
    unit: str
    description: str


@dataclass(frozen=True)
class Column:
    """A result with one value for each element: name, unit, description, and values as texts."""

    name: str
    unit: str
    description: str
    values: list[str]


def result_rows(solution: AbstractSolution, left_out: Collection[str] = ()) -> list[Row]:
    """Rows of all scalar results except those at the paths `left_out`."""
    return [
        row_of(path, np.asarray(value), metadata)
        for path, value, metadata in labelled(solution)
        if np.ndim(value) == 0 and path not in left_out
    ]


def row_of(path: str, value: np.ndarray, metadata: Mapping[str, str]) -> Row:
    unit = metadata["unit"]
    whole = np.issubdtype(value.dtype, np.integer)
    size = float(value)
    shown = str(int(value)) if whole else number(size, unit, largest=size)
    return Row(path, shown, display_unit(unit, size), metadata["description"])


def element_columns(solution: AbstractSolution) -> list[Column]:
    """Columns of all results with one value for each rolling element, in any part of the solution."""
    return list(_columns(solution))


def _columns(solution: AbstractSolution) -> Iterator[Column]:
    for path, value, metadata in labelled(solution):
        if metadata["dims"] != ("element",):
            continue
        array, unit = np.asarray(value), metadata["unit"]
        texts = column(np.where(np.isfinite(array), array, 0.0), unit)
        # a roller that touches nothing has no film
        shown = [text if np.isfinite(entry) else "-" for text, entry in zip(texts, array, strict=True)]
        yield Column(path.removeprefix("elements."), display_unit(unit), metadata["description"], shown)


def derived_facts(solution: AbstractSolution, left_out: Collection[str] = ()) -> Iterator[tuple[str, str]]:
    """Heading and text of each derived result except those at the paths `left_out`: value and description; of an array
    the smallest and the largest value."""
    head = "Derived"
    for path, value, metadata in labelled(solution):
        if metadata["derived"] and path not in left_out:
            numbers, unit = np.asarray(value, dtype=float), metadata["unit"]
            finite = numbers[np.isfinite(numbers)]
            ends = [with_unit(float(end), unit) for end in (finite.min(), finite.max())] if finite.size else ["-"]
            yield head, f"{path} {' to '.join(dict.fromkeys(ends))}: {metadata['description']}"
            head = ""
