"""The recipe of a sweep from the data that its plan keeps."""

from collections.abc import Mapping
from typing import Any

from .._scene import AbstractScene
from .cases import Cases
from .fields import SceneSource
from .recipe import Direct, Recipe

_WHERE = "plan of a sweep"


def recipe_of_data(data: Mapping[str, Any], cases: Cases) -> Recipe:
    """The recipe that `Recipe.as_data` wrote.

    **Raises:** `ValueError` for something else, `KeyError` for data that lack a part, `SceneError` for texts that are
    no scene.
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
