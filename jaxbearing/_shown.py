"""Scenes and solutions as `print` and a notebook show them.

What draws them lies above them, in `report`, and is imported at the first look: the package names it when it is
imported (`shown_by`).
"""

import importlib
from typing import Any

import jax
from jax.core import Tracer

from .numerics.structure import Hinting

_RENDERER: list[str] = []


def shown_by(module: str) -> None:
    """Names the module with `text(shown)` and `html(shown)`."""
    _RENDERER[:] = [module]


class Shown(Hinting):
    """Base of what `print` and notebooks show in a reader's units; `repr` remains the structure.

    Inside `jax.jit` and of batches, which have no one set of numbers, the structure is shown as well.
    """

    def __str__(self) -> str:
        rendered = self._rendered("text")
        return repr(self) if rendered is None else rendered

    def _repr_html_(self) -> str | None:
        return self._rendered("html")

    def _rendered(self, form: str) -> str | None:
        if not _RENDERER or any(not _is_one_number(leaf) for leaf in jax.tree.leaves(self)):
            return None
        drawn: Any = getattr(importlib.import_module(_RENDERER[0]), form)(self)
        return drawn


def _is_one_number(leaf: object) -> bool:
    """False for what has no value yet, and for what stands for a number (`jax.ShapeDtypeStruct`)."""
    return not isinstance(leaf, Tracer | jax.ShapeDtypeStruct)
