"""Identity of a scene: the parts that it has and the numbers that describe them, by the
dotted paths of scene files, in SI units. A state of a transient run carries it, so that no other bearing goes on from
there."""

import dataclasses
from collections.abc import Collection, Iterator
from typing import Any

import equinox as eqx
import numpy as np

ALIKE = 1e-9
"""Relative difference up to which two numbers are the same: the same length written in other units."""
_SHOWN = 3
"""Differences that a message names."""
NOTHING = "none"
"""The word for a part or a number that a scene does not have."""


class Identity(eqx.Module):
    """**Arguments:** `numbers`: path -> value or values; `words`: path, and kind of a part, setting, or `NOTHING`."""

    numbers: dict[str, Any]
    words: tuple[tuple[str, str], ...] = eqx.field(static=True)

    def told(self) -> dict[str, Any]:
        """The identity as plain numbers, lists and texts, for files."""
        return dict(self.words) | {path: np.asarray(value).tolist() for path, value in self.numbers.items()}


def identity_of(scene: object, free: Collection[str]) -> Identity:
    """The identity of a scene. **Arguments:** `free`: paths that are no part of it."""
    numbers: dict[str, object] = {}
    words: list[tuple[str, str]] = []
    for path, value in _fields(scene, "", free):
        if value is None:
            words.append((path, NOTHING))
        elif isinstance(value, eqx.Module):
            words.append((path, type(value).__name__))
        elif eqx.is_array_like(value) and not isinstance(value, bool):
            numbers[path] = np.asarray(value, dtype=float) if isinstance(value, int | float) else value
        else:
            words.append((path, str(value)))
    return Identity(numbers, tuple(words))


def identity_from(facts: dict[str, object]) -> Identity:
    """The way back from `Identity.told`. **Raises:** `ValueError` for something else."""
    words = tuple((path, value) for path, value in facts.items() if isinstance(value, str))
    numbers = {path: np.asarray(value, dtype=float) for path, value in facts.items() if not isinstance(value, str)}
    if not numbers or not words:
        raise ValueError("it says nothing of what the run is of")
    return Identity(numbers, words)


def _fields(part: Any, above: str, free: Collection[str]) -> Iterator[tuple[str, Any]]:
    for field in dataclasses.fields(part):
        path, value = f"{above}{field.name}", getattr(part, field.name)
        if path in free:
            continue
        yield path, value
        if isinstance(value, eqx.Module):
            yield from _fields(value, f"{path}.", free)


def differences(there: Identity, here: Identity) -> list[str]:
    """Differences in words: "geometry.roller_diameter is 0.012 there and 0.0125 here". A path that only one of the two
    knows is not compared: another version may have written it."""
    there_facts, here_facts = there.told(), here.told()
    return [
        f"{path} is {_shown(there_facts[path])} there and {_shown(here_facts[path])} here"
        for path in there_facts
        if path in here_facts and not _same(there_facts[path], here_facts[path])
    ]


def require_same(there: Identity, here: Identity, kind: str) -> None:
    """Requires that a state belongs to this scene. **Arguments:** `kind`: name of the thing in messages, "bearing".

    **Raises:** `ValueError` that names the fields, with both values.
    """
    texts = differences(there, here)
    if texts:
        more = f", and {len(texts) - _SHOWN} more" if len(texts) > _SHOWN else ""
        raise ValueError(f"restart: a state of another {kind}: {', '.join(texts[:_SHOWN])}{more} (in SI units)")


def _same(value: Any, other: Any) -> bool:
    if isinstance(value, str) or isinstance(other, str):
        return value == other
    return np.shape(value) == np.shape(other) and bool(np.allclose(value, other, rtol=ALIKE, atol=0.0, equal_nan=True))


def _shown(value: Any) -> str:
    if isinstance(value, str):
        return value
    return f"{value:.10g}" if np.ndim(value) == 0 else "a table of numbers"
