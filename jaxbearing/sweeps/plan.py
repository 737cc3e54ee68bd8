"""Plan of a sweep: its cases, its chunks, and the hash that identifies its files."""

import functools
import hashlib
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jax
import numpy as np

from .._version import __version__
from ..lanes import LaneProgram, Method
from ..numerics.newton import NewtonOptions
from ..report.files import atomic_file
from ..scenes.input_files import check_regular
from .as_data import ForeignPartError, decoded, encoded
from .cases import Cases
from .recipe import Recipe
from .stored_recipe import recipe_of_data

PLAN = "plan.data"
FORMAT = 2
"""Version of the format of a plan's file."""
CHUNK, LANES = 1000, 125
"""Number of cases of a chunk, and number that a device solves in one call, so that eight devices can share a chunk."""
VMAP_LANES = 1000
QUICK_CASES = LANES
"""Largest number of cases for which a program is compiled quickly, if a case is solved in milliseconds. The program
then runs 2 to 6 times slower, which costs seconds, but compiles in a quarter of the time, which saves tens of
seconds."""
HEAVY_CHUNK, HEAVY_LANES = 32, 4
"""Number of cases of a chunk, and of lanes solved in one call, for scenes with a solve of a large part of a second."""


@dataclass(frozen=True)
class Plan:
    """Everything that determines the results of a sweep.

    **Arguments:**
    - `recipe`, `cases`: they define the scenes.
    - `options`: of the solver.
    - `chunk`: number of cases in a file; `lanes`: number of cases in a call on one device.
    - `elements`: whether results for each rolling element (or point of a profile) are kept, besides single numbers.
    - `platform`: "cpu", "gpu"; `method`: how a device processes its lanes; `quick`: whether the program is compiled
      quickly.
    - `label`: name of the scene as the user gave it, for messages and titles.
    - `metadata`: unit and description of each swept field.
    - `cache`: folder of JAX's compilation cache, for workers of the sweep; not part of the hash, nor of the file.
    """

    recipe: Recipe
    cases: Cases
    options: NewtonOptions
    chunk: int
    lanes: int
    elements: bool
    platform: str
    method: Method
    quick: bool
    label: str
    metadata: dict[str, dict[str, str]]
    cache: str | None = None

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-len(self.cases) // self.chunk)

    def range_of(self, index: int) -> tuple[int, int]:
        """Index of the first case of a chunk, and of the case after its last."""
        return index * self.chunk, min((index + 1) * self.chunk, len(self.cases))

    @functools.cached_property
    def key(self) -> str:
        """Hash of scene, cases, options and versions: two sweeps with the same key have the same numbers."""
        digest = hashlib.sha256()
        scene = self.recipe.example_scene
        parts = [__version__, _source(), jax.__version__, self.platform, self.method, self.quick]
        parts += [
            self.chunk,
            self.lanes,
            self.elements,
            _structure(self.options),
            self.cases.kind,
            self.cases.paths,
            self.cases.shape,
        ]
        parts += [type(self.recipe).__name__, _structure(scene)]
        digest.update(repr(parts).encode())
        for array in (*jax.tree.leaves((scene, self.options)), *self.cases.values):
            digest.update(np.asarray(array, dtype=np.float64).tobytes())
        return digest.hexdigest()[:32]

    def __getstate__(self) -> dict[str, object]:
        # another process finds its own hash: it may run another version
        return {name: value for name, value in vars(self).items() if name != "key"}

    def program(self, devices: int | None = None) -> LaneProgram:
        """Program that solves the lanes; it is compiled at its first call."""
        return LaneProgram(
            self.recipe.make,
            self.recipe.base,
            self.recipe.example(self.cases.paths),
            method=self.method,
            lanes=self.lanes,
            devices=devices,
            options=self.options,
            quick=self.quick,
        )


def _structure(tree: object) -> str:
    """Description of a scene without its numbers and without memory addresses."""
    shapes = [np.shape(leaf) for leaf in jax.tree.leaves(tree)]
    return re.sub(r" at 0x[0-9a-f]+", "", f"{jax.tree.structure(tree)} {shapes}")


@functools.cache
def _source() -> str:
    """Hash of the package's source, because in a clone under development the version number is not enough."""
    digest = hashlib.sha256()
    folder = Path(__file__).parents[1]
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()


def compilation_cache() -> str | None:
    """Folder where JAX keeps compiled programs in this process."""
    return getattr(jax.config, "jax_compilation_cache_dir", None)


def write_plan(plan: Plan, folder: Path) -> None:
    """Writes the plan as data for other processes. **Raises:** `OSError`."""
    content: dict[str, Any] = {"format": FORMAT, "key": plan.key, "version": __version__, "plan": None, "lacking": None}
    arrays: dict[str, np.ndarray] = {}
    try:
        content["plan"], arrays = encoded(_plan_fields(plan))
    except ForeignPartError as error:
        content["lacking"] = str(error)
    with atomic_file(folder / PLAN) as temporary, temporary.open("wb") as file:
        kept: dict[str, Any] = {"said": np.asarray(json.dumps(content)), **arrays}
        np.savez(file, **kept)


def read_key(folder: str | os.PathLike[str]) -> str:
    """The hash of the sweep whose plan is in a folder. **Raises:** as `read_plan`."""
    return str(_read(folder)[0]["key"])


def read_plan(folder: str | os.PathLike[str]) -> tuple[str, Plan]:
    """The hash of a sweep in the process that wrote its plan, and the plan. `plan.key` is the hash in this process,
    which may have another version. The file contains only data, and reading it runs no code from it.

    **Raises:** `OSError`; `ValueError` for a damaged file, a file of another version, or the plan of a scene with
    classes of the user's own, which cannot be written as data.
    """
    content, arrays = _read(folder)
    path = Path(folder) / PLAN
    if content["plan"] is None:
        raise ValueError(
            f"{path} holds no scene, because the scene has {content['lacking']}, no part of this package; expected "
            "workers of the same sweep (--workers, --scheduler), which are sent the scene"
        )
    try:
        return str(content["key"]), _plan_from_fields(decoded(content["plan"], arrays))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{path} is no plan of this version: {error}") from None


def _read(folder: str | os.PathLike[str]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    path = Path(folder) / PLAN
    check_regular(path)
    try:
        # opened here: numpy leaves a file open that it cannot read
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        content = json.loads(str(arrays.pop("said")))
    except OSError:
        raise
    except Exception as error:
        raise ValueError(f"{path} cannot be read: {error}") from None
    if not isinstance(content, dict) or content.get("format") != FORMAT or not isinstance(content.get("key"), str):
        raise ValueError(f"{path} is no plan of this version")
    return content, arrays


_PLAIN = ("chunk", "lanes", "elements", "platform", "method", "quick", "label", "metadata", "options")
"""Fields of a plan that are written unchanged. The compilation cache is not one of them, because JAX runs the programs
in that folder."""


def _plan_fields(plan: Plan) -> dict[str, Any]:
    cases = {"kind": plan.cases.kind, "paths": plan.cases.paths, "values": plan.cases.values}
    return {name: getattr(plan, name) for name in _PLAIN} | {"cases": cases, "recipe": plan.recipe.as_data()}


def _plan_from_fields(fields: dict[str, Any]) -> Plan:
    """The plan from its data.

    **Raises:** `ValueError`, `KeyError` or `TypeError` for data that are not a plan.
    """
    cases = Cases(**fields["cases"])
    chunk, lanes = fields["chunk"], fields["lanes"]
    if not all(isinstance(count, int) and count >= 1 for count in (chunk, lanes)):
        raise ValueError(f"chunks of {chunk!r} cases, {lanes!r} lanes")
    if not isinstance(fields["options"], NewtonOptions):
        raise ValueError("no options of the solver")
    recipe = recipe_of_data(fields["recipe"], cases)
    return Plan(recipe=recipe, cases=cases, **{name: fields[name] for name in _PLAIN})
