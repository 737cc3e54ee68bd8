"""Public names that packages import on first use, and public names that have moved.

A name is public if `__all__`, the `__init__` of a public package or the documentation has it (`docs/names.md`). One
that moves keeps an entry here for one release: it works, and warns.
"""

import importlib
import sys
import warnings
from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any

ROOT = __name__.partition(".")[0]
MODULES = {
    "bearings.ball_equations": "bearings.ball.equations",
    "bearings.ball_geometry": "bearings.ball.geometry",
    "bearings.ball_start": "bearings.ball.start",
    "bearings.groove_motion": "bearings.ball.groove_motion",
    "bearings.gyroscopic": "bearings.ball.gyroscopic",
    "bearings.motion.rates": "bearings.cylindrical.motion.rates",
    "bearings.roller_dynamics": "bearings.cylindrical.motion.rates",
    "bearings.roller_equations": "bearings.cylindrical.equations",
    "bearings.roller_forces": "bearings.cylindrical.forces",
    "bearings.roller_profile": "bearings.profile",
    "bearings.tapered_friction": "bearings.tapered.friction",
    "bearings.tapered_system": "bearings.tapered.system",
    "bearings.tilting_steady": "bearings.cylindrical.tilting_steady",
    "scenes.oils": "scenes.oil.catalogue",
    "thermal.warm_up": "thermal.warming_up",
}
"""Module of the package that has moved -> where it is now."""
NAMES = {
    "contacts.point_rolling_moment": "contacts.point_rolling.point_rolling_moment",
    "contacts.warm_film": "contacts.heated_film.heated_film",
    "simulate.trajectory": "bearings.motion.runs.trajectory",
}
"""Name in a module that has stayed -> where it is now."""


def _forwarded(old: str, new: str) -> Any:
    module, _, name = new.rpartition(".")
    message = f"{ROOT}.{old} has moved to {ROOT}.{new}; the old name goes with the next release"
    warnings.warn(message, DeprecationWarning, stacklevel=3)
    return getattr(importlib.import_module(f"{ROOT}.{module}"), name)


class _MovedModule(ModuleType):
    """Stands at the old place of a module."""

    def __init__(self, old: str, new: str):
        super().__init__(f"{ROOT}.{old}", f"It has moved to `{ROOT}.{new}`.")
        self._places = old, new

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        old, new = self._places
        return _forwarded(f"{old}.{name}", f"{new}.{name}")


def keep_old_modules() -> None:
    """Lets modules be imported from where they were."""
    for old, new in MODULES.items():
        sys.modules[f"{ROOT}.{old}"] = _MovedModule(old, new)


def attributes_of(module: str, lazy: Mapping[str, str] | None = None) -> Callable[[str], Any]:
    """The function `__getattr__` of a module: names that are imported on first use, then those that have moved.

    **Arguments:** `module`: its `__name__`; `lazy`: name -> module below it.
    """
    own = {} if lazy is None else lazy

    def attribute(name: str) -> Any:
        if name in own:
            return getattr(importlib.import_module(f".{own[name]}", module), name)
        old = f"{module}.{name}".removeprefix(f"{ROOT}.")
        if old in MODULES:
            return sys.modules[f"{ROOT}.{old}"]
        if old in NAMES:
            return _forwarded(old, NAMES[old])
        raise AttributeError(f"module {module!r} has no attribute {name!r}")

    return attribute
