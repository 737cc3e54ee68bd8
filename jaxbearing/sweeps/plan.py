"""Plan of a sweep: its cases, its chunks, and the hash by which its files know each other."""

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

from .. import __version__
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
"""Version of the format of that file."""
CHUNK, LANES = 1000, 125
"""Cases of a chunk, and those of them that a device solves in one call: eight devices can share one."""
VMAP_LANES = 1000
QUICK_CASES = LANES
"""A sweep of no more cases is compiled quickly, if one of them is solved in milliseconds: its program runs 2 to 6 times
slower, seconds in all, and is compiled in a quarter of the time, tens of seconds."""
HEAVY_CHUNK, HEAVY_LANES = 32, 4
"""Cases of a chunk, and lanes at a time, of scenes whose solve takes a large part of a second."""


@dataclass(frozen=True)
class Plan:
    """A plan holds all that decides the numbers of a sweep.

    **Arguments:**
    - `recipe`, `cases`: the scenes.
    - `options`: of the solver.
    - `chunk`: cases in a file; `lanes`: cases in a call on one device.
    - `elements`: whether results of each rolling element (of each point of a profile) are kept, or only numbers.
    - `platform`: "cpu", "gpu"; `method`: how a device goes through its lanes; `quick`: whether the program is compiled
      quickly.
    - `label`: the scene as it was named, for messages and titles.
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
        """First case of a chunk and the one after its last."""
        return index * self.chunk, min((index + 1) * self.chunk, len(self.cases))

    @functools.cached_property
    def key(self) -> str:
        """Hash of scene, cases, options and versions: two sweeps with the same key have the same numbers."""
        digest = hashlib.sha256()
        scene = self.recipe.example_scene
        told = [__version__, _source(), jax.__version__, self.platform, self.method, self.quick]
        told += [
            self.chunk,
            self.lanes,
            self.elements,
            _structure(self.options),
            self.cases.kind,
            self.cases.paths,
            self.cases.shape,
        ]
        told += [type(self.recipe).__name__, _structure(scene)]
        digest.update(repr(told).encode())
        for array in (*jax.tree.leaves((scene, self.options)), *self.cases.values):
            digest.update(np.asarray(array, dtype=np.float64).tobytes())
        return digest.hexdigest()[:32]

    def __getstate__(self) -> dict[str, object]:
        # another process finds its own hash: it may run another version
        return {name: value for name, value in vars(self).items() if name != "key"}

    def program(self, devices: int | None = None) -> LaneProgram:
        """Solver of the lanes; compiled at its first call."""
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
    """Description of all in a scene but its numbers; it contains no addresses in memory."""
    shapes = [np.shape(leaf) for leaf in jax.tree.leaves(tree)]
    return re.sub(r" at 0x[0-9a-f]+", "", f"{jax.tree.structure(tree)} {shapes}")


@functools.cache
def _source() -> str:
    """Hash of the package's source: in a clone that is being worked on the version says too little."""
    digest = hashlib.sha256()
    folder = Path(__file__).parents[1]
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()


def compilation_cache() -> str | None:
    """Folder where JAX keeps compiled programs in this process."""
    return getattr(jax.config, "jax_compilation_cache_dir", None)


def write_plan(plan: Plan, folder: Path) -> None:
    """The plan as data for other processes. **Raises:** `OSError`."""
    said: dict[str, Any] = {"format": FORMAT, "key": plan.key, "version": __version__, "plan": None, "lacking": None}
    arrays: dict[str, np.ndarray] = {}
    try:
        said["plan"], arrays = encoded(_as_fields(plan))
    except ForeignPartError as error:
        said["lacking"] = str(error)
    with atomic_file(folder / PLAN) as temporary, temporary.open("wb") as file:
        kept: dict[str, Any] = {"said": np.asarray(json.dumps(said)), **arrays}
        np.savez(file, **kept)


def read_key(folder: str | os.PathLike[str]) -> str:
    """The hash of the sweep whose plan is in a folder. **Raises:** as `read_plan`."""
    return str(_read(folder)[0]["key"])


def read_plan(folder: str | os.PathLike[str]) -> tuple[str, Plan]:
    """The plan of a sweep, which other processes read, and the hash that it had where it was made: `plan.key` is that
    of this process, which may have another version. The file is data: reading it runs nothing that is in it.

    **Raises:** `OSError`; `ValueError` for a damaged file, that of another version, or the plan of a scene that has
    parts of the user's own, which data cannot hold.
    """
    said, arrays = _read(folder)
    path = Path(folder) / PLAN
    if said["plan"] is None:
        raise ValueError(
            f"{path} holds no scene, because the scene has {said['lacking']}, no part of this package; expected "
            "workers of the same sweep (--workers, --scheduler), which are sent the scene"
        )
    try:
        return str(said["key"]), _of_fields(decoded(said["plan"], arrays))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{path} is no plan of this version: {error}") from None


def _read(folder: str | os.PathLike[str]) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    path = Path(folder) / PLAN
    check_regular(path)
    try:
        # opened here: numpy leaves a file open that it cannot read
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        said = json.loads(str(arrays.pop("said")))
    except OSError:
        raise
    except Exception as error:
        raise ValueError(f"{path} cannot be read: {error}") from None
    if not isinstance(said, dict) or said.get("format") != FORMAT or not isinstance(said.get("key"), str):
        raise ValueError(f"{path} is no plan of this version")
    return said, arrays


_PLAIN = ("chunk", "lanes", "elements", "platform", "method", "quick", "label", "metadata", "options")
"""Fields of a plan that are written as they are. The compilation cache is not among them: JAX runs what lies there."""


def _as_fields(plan: Plan) -> dict[str, Any]:
    cases = {"kind": plan.cases.kind, "paths": plan.cases.paths, "values": plan.cases.values}
    return {name: getattr(plan, name) for name in _PLAIN} | {"cases": cases, "recipe": plan.recipe.as_data()}


def _of_fields(fields: dict[str, Any]) -> Plan:
    """The plan from its data.

    **Raises:** `ValueError`, `KeyError` or `TypeError` for data that are no plan.
    """
    cases = Cases(**fields["cases"])
    chunk, lanes = fields["chunk"], fields["lanes"]
    if not all(isinstance(count, int) and count >= 1 for count in (chunk, lanes)):
        raise ValueError(f"chunks of {chunk!r} cases, {lanes!r} lanes")
    if not isinstance(fields["options"], NewtonOptions):
        raise ValueError("no options of the solver")
    recipe = recipe_of_data(fields["recipe"], cases)
    return Plan(recipe=recipe, cases=cases, **{name: fields[name] for name in _PLAIN})
