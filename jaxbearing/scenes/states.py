"""The load spectrum of a scene file: its tables [[state]], each with a share of the time and changes of the scene."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic_core import PydanticCustomError

from .._scene import AbstractScene
from ..life.duty import SUM_TOLERANCE
from .errors import SceneError
from .overrides import Overrides, applied, as_texts
from .reader import (
    STATES,
    is_shaft,
    read_all,
    scene_from_tables,
    scene_model,
    warn_of_means,
    warn_of_preset,
    without_states,
)
from .units import number
from .words import describe

MOST_STATES = 10_000
"""Largest number of states, as on a shaft. Each state is first made as a scene of its own, in about 5 ms."""
NAME, SHARE = "name", "share"
EXAMPLE = '[[state]] tables, each with share = 0.6 and changes such as operation.radial_load = "3 kN"'


@dataclass(frozen=True)
class FileState:
    """One state of a load spectrum. `changes`: dotted path -> value as a user would type it."""

    name: str
    share: float
    changes: dict[str, str]
    scene: AbstractScene


def has_states(source: str | Path) -> bool:
    """True if the file of a bearing has a load spectrum; False for a shaft, whose states are a part of its scene.

    **Raises:** `SceneError` for a file that cannot be read.
    """
    mapping = read_all(source)[1]
    return STATES in mapping and not is_shaft(mapping)


def base_scene(source: str | Path, overrides: Overrides | None = None) -> AbstractScene:
    """The scene without its states, as from `load_scene`, but without the warning that they are left out."""
    label, mapping = read_all(source)
    mapping = without_states(mapping)
    warn_of_means(mapping, label, overrides)
    scene = scene_from_tables(mapping, label, overrides)
    warn_of_preset(mapping, label, overrides)
    return scene


def load_states(source: str | Path, overrides: Overrides | None = None) -> tuple[FileState, ...]:
    """The states of a load spectrum, each with its scene: that of the file with `overrides` and the state's changes.

    **Arguments:** as for `load_scene`.

    **Raises:** `SceneError` for a file without states, for states with missing shares, repeated names or shares that do
    not add up to 1, for changes of unknown fields and for scenes that cannot be built.
    """
    label, mapping = read_all(source)
    if is_shaft(mapping):
        expected = "the scene of a bearing; the states of a shaft are a part of it, 'jaxbearing solve' solves them"
        raise SceneError(label, "kind", "a shaft", expected)
    tables = mapping.pop(STATES, None)
    if tables is None:
        raise SceneError(label, STATES, "nothing", f"a load spectrum: {EXAMPLE}")
    if not isinstance(tables, list) or not tables or not all(isinstance(entry, Mapping) for entry in tables):
        raise SceneError(label, STATES, describe(tables), EXAMPLE)
    if len(tables) > MOST_STATES:
        raise SceneError(label, STATES, f"{len(tables)} states", f"at most {MOST_STATES}; join those that are alike")
    texts = as_texts(overrides)
    # an error of the scene itself is reported once, not for every state
    scene_from_tables(mapping, label, texts)
    tables = numbered(tables)
    require_names_and_shares(tables, label)
    states: list[FileState] = []
    problems: list[SceneError] = []
    for table in tables:
        try:
            states.append(state_of(table, mapping, texts, label))
        except SceneError as error:
            problems += error.problems
    if problems:
        raise SceneError.of_all(problems)
    warn_of_preset(mapping, label, texts)
    return tuple(states)


def numbered(tables: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The states; a state without a name is named by its number."""
    return [{NAME: str(place + 1), **table} for place, table in enumerate(tables)]


def require_names_and_shares(tables: Sequence[Mapping[str, object]], label: str) -> None:
    """Checks names and shares of states. **Raises:** `SceneError` for missing shares, invalid or repeated names, and
    shares that do not add up to 1."""
    problems = list(_problems(tables, label))
    if problems:
        raise SceneError.of_all(problems)


def _problems(tables: Sequence[Mapping[str, Any]], label: str) -> Iterator[SceneError]:
    """All errors in names and shares."""
    names: list[str] = []
    shares: list[float] = []
    for place, table in enumerate(tables):
        at, name = f"{STATES}[{place}]", table.get(NAME)
        if not isinstance(name, str) or not name.strip():
            yield SceneError(label, f"{at}.{NAME}", describe(name), "a name of the state, in quotes")
        elif name in names:
            yield SceneError(label, f"{at}.{NAME}", f"'{name}' twice", "a name of its own for each state")
        else:
            names.append(name)
        try:
            if SHARE not in table:
                raise SceneError(label, f"{at}.{SHARE}", "nothing", "the share of the state in the time, e.g. 0.6")
            shares.append(number(table[SHARE], "above 0 and at most 1"))
        except SceneError as error:
            yield error
        except PydanticCustomError as error:
            context = error.context or {}
            yield SceneError(label, f"{at}.{SHARE}", context["found"], context["expected"])
    total = sum(shares)
    if len(shares) == len(tables) and abs(total - 1.0) > SUM_TOLERANCE:
        yield SceneError(label, f"{STATES}.{SHARE}", f"shares that add up to {total:.7g}", "shares that add up to 1")


def state_of(table: Mapping[str, Any], mapping: Mapping[str, object], texts: dict[str, str], label: str) -> FileState:
    """One state with its scene. **Raises:** `SceneError` that names the state and the field."""
    name = table[NAME]
    origin = f"{label}, state '{name}'"
    changes = dict(_flat({key: value for key, value in table.items() if key not in (NAME, SHARE)}))
    for path in changes:
        if path in texts:
            raise SceneError(origin, path, "a field that --set or --over gives too", "one of the two")
        if path == "kind":
            raise SceneError(origin, path, "another kind of scene", "changes of one bearing")
    base, problems = applied(mapping, texts, scene_model(mapping, texts, label), label)
    changed, more = applied(base, changes, scene_model(base, {}, label), origin)
    try:
        scene = scene_from_tables(changed, origin)
    except SceneError as error:
        more = [*more, *error.problems]
    else:
        if not [*problems, *more]:
            return FileState(name, float(table[SHARE]), changes, scene)
    raise SceneError.of_all([*problems, *more])


def _flat(table: Mapping[str, Any], inside: str = "") -> Iterator[tuple[str, str]]:
    """Dotted path and text of each value, also of those in nested tables."""
    for key, value in table.items():
        path = f"{inside}{key}"
        if isinstance(value, Mapping):
            yield from _flat(value, f"{path}.")
        else:
            yield path, str(value).lower() if isinstance(value, bool) else str(value)
