"""From a scene file, or the name of a built-in scene, to a scene."""

import re
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from .._scene import AbstractScene
from .data_files import builtin_names, builtin_summary, builtin_text
from .errors import SceneError, from_class, from_validation, nearest, one_of
from .oils import with_catalogue
from .overrides import REMOVE, apply, parse_value
from .roller_build import cylindrical_roller_bearing
from .roller_schema import CylindricalRollerTable
from .two_disk_build import two_disk
from .two_disk_schema import TwoDiskTable
from .units import describe, shortened

__all__ = ["builtin_names", "builtin_summary", "builtin_text", "load_scene", "scene_from_mapping"]

_KIND_EXAMPLE = 'kind = "cylindrical_roller_bearing"'
_SCHEMAS: dict[str, tuple[type[BaseModel], Callable[[Any], AbstractScene]]] = {
    "cylindrical_roller_bearing": (CylindricalRollerTable, cylindrical_roller_bearing),
    "two_disk": (TwoDiskTable, two_disk),
}
AVAILABLE_KINDS = tuple(_SCHEMAS)
KINDS = (*AVAILABLE_KINDS, "ball_bearing", "tapered_roller_bearing", "line_contact")


def load_scene(source: str | Path, overrides: Mapping[str, str] | None = None) -> AbstractScene:
    """A scene from a file or by the name of a built-in scene.

    **Arguments:**
    - `source`: path of a TOML file, or one of `builtin_names()`.
    - `overrides`: dotted path of a field -> value as it would be typed, {"operation.inner_speed": "12000 rpm"}; the
      value "none" takes an optional table or field out.

    **Raises:** `SceneError` with file, field, what was found and what is expected.
    """
    label, text = _read(source)
    return scene_from_mapping(_parse(text, label), label, overrides)


def scene_from_mapping(
    mapping: Mapping[str, Any], origin: str = "scene", overrides: Mapping[str, str] | None = None
) -> AbstractScene:
    """A scene from the tables of a scene file, {"kind": ..., "geometry": {...}, ...}; `origin` names it in messages.

    **Raises:** `SceneError`.
    """
    overrides = overrides or {}
    try:
        kind = mapping.get("kind")
        if "kind" in overrides:
            kind = None if overrides["kind"] == REMOVE else parse_value(overrides["kind"])
        model, build = _SCHEMAS[_known_kind(kind, mapping, origin)]
        return _build(apply(mapping, overrides, model, origin), model, build, origin)
    except SceneError as error:
        culprit = next((path for path in overrides if _related(path, error.path)), None)
        if culprit is None or error.file != origin:
            raise
        raise error.of(f"{origin} with --set {culprit}={shortened(overrides[culprit])}") from None


def _build(
    raw: Mapping[str, Any], model: type[BaseModel], build: Callable[[Any], AbstractScene], origin: str
) -> AbstractScene:
    complete = {**raw, "oil": with_catalogue(raw["oil"])} if isinstance(raw.get("oil"), Mapping) else raw
    try:
        table = model.model_validate(complete)
    except ValidationError as error:
        raise from_validation(error, model, origin) from None
    try:
        return build(table)
    except ValueError as error:
        raise from_class(error, raw, origin) from None


def _related(a: str, b: str) -> bool:
    """Whether one dotted path is the other or leads to it."""
    return f"{a}.".startswith(f"{b}.") or f"{b}.".startswith(f"{a}.")


def _read(source: str | Path) -> tuple[str, str]:
    """Name for messages, and text."""
    if isinstance(source, str) and source in builtin_names():
        return source, builtin_text(source)
    path, label = Path(source), str(source)
    expected = f"a scene file, or a built-in scene ({', '.join(builtin_names())})"
    try:
        return label, path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        near = nearest(path.name.removesuffix(".toml"), builtin_names())
        raise SceneError(label, "", "no such file", expected, near) from None
    except IsADirectoryError:
        raise SceneError(label, "", "a folder", expected) from None
    except UnicodeDecodeError as error:
        found = f"bytes that are not UTF-8 text (at byte {error.start})"
        raise SceneError(label, "", found, "a TOML file in UTF-8") from None
    except (OSError, ValueError) as error:
        # ValueError: a path with a null byte
        reason = getattr(error, "strerror", None) or str(error)
        raise SceneError(label, "", f"a file that cannot be read: {reason}", expected) from None


def _parse(text: str, label: str) -> dict[str, Any]:
    if not text.strip():
        raise SceneError(label, "", "an empty file", f"a scene that begins with {_KIND_EXAMPLE}")
    try:
        return tomllib.loads(text)
    # ValueError: also a number of thousands of digits
    except ValueError as error:
        path = _path_near(text, str(error))
        raise SceneError(label, path, f"a TOML syntax error, {error}", "a valid TOML file") from None
    except RecursionError:
        raise SceneError(label, "", "tables nested too deeply", "a valid TOML file") from None


def _path_near(text: str, message: str) -> str:
    """Dotted path of the field on the line that a syntax error names, as far as it can be read."""
    match = re.search(r"at line (\d+)", message)
    if match is None and "end of document" not in message:
        return ""
    lines = text.splitlines()[: int(match[1]) if match else None]
    headers = [found[1] for line in lines if (found := re.match(r"\s*\[\s*([\w.]+)\s*\]", line))]
    key = re.match(r"\s*([\w.]+)\s*=", lines[-1]) if lines else None
    return ".".join(headers[-1:] + ([key[1]] if key else []))


def _known_kind(kind: Any, mapping: Mapping[str, Any], origin: str) -> str:
    if kind is None:
        # an unknown name close to "kind" is a likelier culprit than a forgotten line
        near = next((key for key in mapping if key != "kind" and nearest(key, ("kind",))), "")
        found = f"the unknown name {near!r}" if near else "nothing"
        raise SceneError(origin, "kind", found, f"the kind of scene, e.g. {_KIND_EXAMPLE}", "kind" if near else "")
    if kind in AVAILABLE_KINDS:
        return kind
    if isinstance(kind, str) and kind in KINDS:
        found = f"kind '{kind}', which is not available in this version"
        raise SceneError(origin, "kind", found, one_of(AVAILABLE_KINDS))
    near = nearest(kind, KINDS) if isinstance(kind, str) else ""
    raise SceneError(origin, "kind", describe(kind), one_of(KINDS), near)
