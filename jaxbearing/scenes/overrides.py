"""`--set path=value`: changes to the tables of a scene before it is validated."""

import difflib
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from .errors import SceneError, describe_at
from .fields import is_known, names_at

REMOVE = "none"
"""The value that takes an optional table or field out of the scene."""


def split_assignments(assignments: Iterable[str]) -> dict[str, str]:
    """ "path=value" texts as a mapping, the later one prevailing.

    **Raises:** `SceneError` for a text of another form.
    """
    overrides: dict[str, str] = {}
    for text in assignments:
        path, equals, value = text.partition("=")
        path, value = path.strip(), value.strip()
        if not (equals and value and all(path.split("."))):
            expected = "path=value, e.g. operation.inner_speed='12000 rpm'"
            raise SceneError("--set", path, f"'{text}'", expected)
        overrides[path] = value
    return overrides


def parse_value(text: str) -> Any:
    """A value of a `--set`: TOML where it is TOML (numbers, true, "quoted"), otherwise the text itself."""
    if "\n" in text:
        return text
    try:
        return tomllib.loads(f"value = {text}")["value"]
    # ValueError: not TOML, or a number of thousands of digits
    except ValueError:
        return text


def apply(raw: Mapping[str, Any], overrides: Mapping[str, str], model: type[BaseModel], file: str) -> dict[str, Any]:
    """A copy of the tables with the overrides; unknown names too: the validation refuses them with a suggestion.

    **Raises:** `SceneError` where a path goes through something that is not a table.
    """
    changed = _copy(raw)
    for path, text in overrides.items():
        keys = path.split(".")
        table = changed
        for depth, key in enumerate(keys[:-1]):
            table = table.setdefault(key, {})
            if not isinstance(table, dict):
                inside = ".".join(keys[: depth + 1])
                found = f"{describe_at(changed, inside)} at {inside}"
                raise SceneError(file, path, found, "a table, to set a value in it")
        if text != REMOVE:
            table[keys[-1]] = parse_value(text)
        elif keys[-1] in table:
            del table[keys[-1]]
        elif not is_known(model, keys):
            valid = names_at(model, keys[:-1]).names
            near = difflib.get_close_matches(keys[-1], valid, n=1)
            expected = f"a part of the scene to take out: {', '.join(valid) or 'nothing here'}"
            raise SceneError(file, path, f"the unknown name '{keys[-1]}'", expected, "".join(near))
    return changed


def _copy(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _copy(value) if isinstance(value, Mapping) else value for key, value in table.items()}
