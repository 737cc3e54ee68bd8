"""Construction of the scene of a case from its values, which are set in a scene or read like a scene file."""

import dataclasses
import itertools
from collections.abc import Callable, Mapping
from typing import Any, Protocol

import equinox as eqx
import jax
import numpy as np

from .._scene import AbstractScene
from ..numerics.precision import as_float
from .cases import Cases

TRIED = 64
"""Number of cases, besides the corners, that are tried in search of one whose scene can be built."""
Inputs = tuple[Any, list[str]]
"""Inputs of the program, with the lane as the first axis, and for each case the reason why its scene cannot be built
("" if it can)."""


class Recipe(Protocol):
    """A recipe makes the scenes of the cases of a sweep, and can be sent to workers."""

    @property
    def base(self) -> Any:
        """Numbers that all cases share."""
        ...

    @property
    def example_scene(self) -> AbstractScene:
        """The scene of one of the cases."""
        ...

    @staticmethod
    def make(base: Any, inputs: Any) -> AbstractScene:
        """Scene of one lane; a pure function."""
        ...

    def inputs(self, values: dict[str, np.ndarray]) -> Inputs:
        """The `inputs` of `make` for many cases."""
        ...

    def example(self, paths: tuple[str, ...]) -> object:
        """The `inputs` of `make` for one case whose scene can be built. **Arguments:** `paths`: of the fields."""
        ...

    def scene(self, values: dict[str, float]) -> AbstractScene:
        """Scene of one case. **Raises:** `ValueError` where its values do not fit together."""
        ...

    def as_data(self) -> dict[str, Any]:
        """The data from which `stored_recipe.recipe_of_data` makes the same recipe."""
        ...


@dataclasses.dataclass(frozen=True)
class Direct:
    """Recipe for values that are numbers of the scene: a case is a copy of the scene with other numbers.

    `checked`: whether each case is also built outside the program, where incompatible dimensions are refused; this
    takes twice the time of the quickest solves. It is not needed for operating points, whose bounds are enough.
    """

    base: AbstractScene
    checked: bool

    @property
    def example_scene(self) -> AbstractScene:
        return self.base

    @staticmethod
    def make(base: AbstractScene, inputs: Mapping[str, object]) -> AbstractScene:
        return base.replace(inputs)

    def example(self, paths: tuple[str, ...]) -> object:
        return {path: as_float(self.base.part_at(path)) for path in paths}

    def scene(self, values: dict[str, float]) -> AbstractScene:
        return self.base.replace(values)

    def inputs(self, values: dict[str, np.ndarray]) -> Inputs:
        count = len(next(iter(values.values())))
        if not self.checked:
            return values, [""] * count
        return values, [self._refusal({path: float(v[i]) for path, v in values.items()}) for i in range(count)]

    def as_data(self) -> dict[str, Any]:
        return {"kind": "direct", "base": self.base, "checked": self.checked}

    def _refusal(self, values: dict[str, float]) -> str:
        try:
            self.scene(values)
        except ValueError as error:
            return str(error)
        return ""


class Reader(Protocol):
    """Function that makes a scene from values of fields, in SI."""

    def __call__(self, values: dict[str, float], /) -> AbstractScene: ...

    def as_data(self) -> dict[str, Any]:
        """The data from which the reader can be made again."""
        ...


@dataclasses.dataclass(frozen=True)
class Read:
    """Recipe for values that are not numbers of the scene itself: each case is read like a scene file (5 to 10 ms)."""

    read: Reader
    example_scene: AbstractScene
    base: None = None

    @staticmethod
    def make(base: None, inputs: AbstractScene) -> AbstractScene:
        return inputs

    def example(self, paths: tuple[str, ...]) -> object:
        del paths
        return self.example_scene

    def scene(self, values: dict[str, float]) -> AbstractScene:
        scene = jax.tree.map(as_float, self.read(values))
        if jax.tree.structure(scene) != jax.tree.structure(self.example_scene):
            raise ValueError("these values give a scene of another structure")
        return scene

    def inputs(self, values: dict[str, np.ndarray]) -> Inputs:
        rows, reasons = [], []
        for i in range(len(next(iter(values.values())))):
            try:
                rows.append(jax.tree.leaves(self.scene({path: float(v[i]) for path, v in values.items()})))
                reasons.append("")
            except ValueError as error:
                rows.append(jax.tree.leaves(self.example_scene))
                reasons.append(str(error))
        stacked = [np.stack([np.asarray(leaf) for leaf in leaves]) for leaves in zip(*rows, strict=True)]
        return jax.tree.unflatten(jax.tree.structure(self.example_scene), stacked), reasons

    def as_data(self) -> dict[str, Any]:
        return {"kind": "read", **self.read.as_data()}


def in_scene(scene: AbstractScene, cases: Cases) -> Direct:
    """The recipe of a scene object; paths of fields are those of its attributes.

    **Raises:** `ValueError` for a field that is not a number of the scene, and for values that it refuses;
    `AttributeError` for a field that does not exist.
    """
    for path in cases.paths:
        _require_number(scene, path)
    scene = jax.tree.map(as_float, scene)
    base = _possible(scene.replace, cases)
    # an operating point has no dimensions to fit together: its bounds are enough
    checked = not all(path.startswith("operation.") for path in cases.paths)
    if not checked:
        for path, values in zip(cases.paths, cases.values, strict=True):
            for value in (values.min(), values.max()):
                base.replace({path: float(value)})
    return Direct(base, checked)


def _possible(make: Callable[[dict[str, float]], AbstractScene], cases: Cases) -> AbstractScene:
    """Scene of the first case found whose values fit together.

    **Raises:** `ValueError` of the first case, if the scene of no corner and of none of `TRIED` cases can be built.
    """
    refused: list[ValueError] = []
    for values in itertools.chain(cases.corners(), cases.spread(TRIED)):
        try:
            return jax.tree.map(as_float, make(values))
        except ValueError as error:
            refused.append(error)
    raise refused[0]


def _require_number(scene: AbstractScene, path: str) -> None:
    """Checks that a field is a single number and not part of the structure.

    **Raises:** `ValueError` if it is not a number; `AttributeError` if it does not exist.
    """
    above, _, last = path.rpartition(".")
    part: object = scene.part_at(above) if above else scene
    fields = {field.name: field for field in dataclasses.fields(part)} if isinstance(part, eqx.Module) else {}
    if last not in fields:
        # raises an error that says what is there
        scene.replace({path: 0.0})
        return
    value = getattr(part, last)
    if fields[last].metadata.get("static", False) or isinstance(value, str | bool | eqx.Module | tuple):
        raise ValueError(structural(path))
    if np.ndim(value):
        raise ValueError(f"{path}: found a field that is a list of its own; expected one that is a number")


def structural(path: str, what: str = "a field that shapes the equations") -> str:
    """The reason why a field cannot be swept."""
    return (
        f"{path}: found {what}; expected a number that varies from case to case (another structure is another "
        "program: run a sweep for each)"
    )


def from_reader(read: Reader, cases: Cases) -> Direct | Read:
    """The recipe of a scene file: `Direct` if the values are numbers of the scene itself, else `Read`.

    **Arguments:** `read`: function from values of the fields, in SI, to a scene.

    **Raises:** `ValueError` for a field that changes the structure of the scene, and if the scene of no case that is
    tried can be built.
    """
    corners = cases.corners()
    first = _possible(read, cases)
    for path, values in zip(cases.paths, cases.values, strict=True):
        for value in (values[0], values[-1], values.min(), values.max()):
            for other in _quietly(read, corners[0] | {path: float(value)}):
                if jax.tree.structure(other) != jax.tree.structure(first):
                    raise ValueError(structural(path))
    try:
        direct = in_scene(first, cases)
    except (AttributeError, ValueError, TypeError):
        return Read(read, first)
    same = all(_same(scene, direct.scene(values)) for values in corners for scene in _quietly(read, values))
    return direct if same else Read(read, first)


def _quietly(read: Callable[[dict[str, float]], AbstractScene], values: dict[str, float]) -> list[AbstractScene]:
    """A list with the scene of these values, empty if it cannot be built."""
    try:
        return [jax.tree.map(as_float, read(values))]
    except ValueError:
        return []


def _same(first: AbstractScene, other: AbstractScene) -> bool:
    return jax.tree.structure(first) == jax.tree.structure(other) and all(
        np.array_equal(a, b) for a, b in zip(jax.tree.leaves(first), jax.tree.leaves(other), strict=True)
    )
