"""The states of a shaft's duty cycle: tables [[state]], each with a share of the time and changes of the scene."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...bearings.parts import names_another_bearing
from ...shafts.paths import part_at
from ...shafts.scene import ShaftState, ShaftSystem
from ..errors import SceneError
from ..states import EXAMPLE, numbered, require_names_and_shares, state_of
from ..words import describe

SET = "set"
"""Field of a state with its changes, by dotted paths in quotes."""


def with_states(scene: ShaftSystem, entries: object, raw: Mapping[str, object], file: str) -> ShaftSystem:
    """The scene of a shaft with the states of its duty cycle.

    **Arguments:** `entries`: the tables [[state]]; `raw`: tables of the scene without them.

    **Raises:** `SceneError` for invalid states, and for scenes that cannot be built.
    """
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, Mapping) for entry in entries):
        raise SceneError(file, "state", describe(entries), EXAMPLE)
    tables = [_plain(entry) for entry in numbered(entries)]
    require_names_and_shares(tables, file)
    states, problems = [], []
    for table in tables:
        try:
            state = state_of(table, raw, {}, file)
        except SceneError as error:
            problems += error.problems
            continue
        changes = {
            path: _number(part_at(state.scene, path), path, f"{file}, state '{state.name}'") for path in state.changes
        }
        states.append(ShaftState(share=state.share, changes=changes, name=state.name))
    if problems:
        raise SceneError.of_all(problems)
    return dataclasses.replace(scene, states=tuple(states))


def _plain(table: Mapping[str, Any]) -> dict[str, Any]:
    """A state whose changes are moved from the table `set` into the state itself."""
    state = dict(table)
    changes = state.get(SET)
    if isinstance(changes, Mapping):
        by_path = {path: value for path, value in changes.items() if "." in path}
        rest = {name: value for name, value in changes.items() if name not in by_path}
        state = {name: value for name, value in state.items() if name != SET} | by_path | ({SET: rest} if rest else {})
    return state


def _number(value: Any, path: str, where: str) -> float:
    """The changed number. **Raises:** `SceneError` for a value that is no number, and for a field whose change makes
    another bearing."""
    if names_another_bearing(path):
        raise SceneError(where, path, "a field that makes another bearing", "states of the same bearings")
    if value is None or isinstance(value, str | bool) or np.ndim(value) or dataclasses.is_dataclass(value):
        expected = "a number of the scene: the states of a shaft differ in numbers alone"
        raise SceneError(where, path, "a field that shapes the equations", expected)
    return float(np.asarray(value))
