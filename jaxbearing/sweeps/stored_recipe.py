"""The recipe of a sweep from the data in its plan's file."""

from collections.abc import Mapping
from typing import Any

from .._scene import AbstractScene
from .cases import Cases
from .fields import SceneSource
from .recipe import Direct, Recipe

_WHERE = "plan of a sweep"


def recipe_of_data(data: Mapping[str, Any], cases: Cases) -> Recipe:
    """The recipe from the data of `Recipe.as_data`.

    **Raises:** `ValueError` for other data, `KeyError` for incomplete data, `SceneError` for texts that are not a
    scene.
    """
    if data["kind"] == "direct":
        base, checked = data["base"], data["checked"]
        if not isinstance(base, AbstractScene) or not isinstance(checked, bool):
            raise ValueError("its scene is none")
        return Direct(base, checked)
    if data["kind"] == "read":
        source = SceneSource(data["label"], data["tables"], data["overrides"])
        return source.recipe(cases, {path: source.field(path, _WHERE) for path in data["paths"]})
    raise ValueError(f"its scenes are made by {data['kind']!r}")
