"""Writes a scene as a scene file, from which `load_scene` makes an equal scene: every number to the last bit."""

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from .._scene import AbstractScene
from .._version import __version__
from .errors import SceneError, one_of
from .input_files import LARGEST_TEXT
from .part_writer import SCENE, differences, shown, unwritable
from .reader import KINDS, plain_scene, scene_from_tables, schema_of_kind, tables_of
from .toml_files import parse_toml
from .toml_writer import comments, toml_text

_ONE = "one number; of a batch, take one scene: jax.tree.map(lambda leaf: leaf[0], scenes)"
_MOST = 3
"""Numbers that a message names: in a batch all of them are refused."""
MIXED = "mixed"
"""Unit, in labels, of matrices whose entries have units of their own."""
_KNOWN = "a known number; save the scene outside of jax.jit, jax.vmap and jax.grad"


def save_scene(scene: AbstractScene, path: str | Path) -> None:
    """Write a scene as a scene file (TOML), from which `jb.load_scene` makes an equal scene: the same parts, laws,
    words and counts, and every number to the last bit.

    The file holds the values of the scene, also those that were defaults when it was made. Each number has a usual
    unit in which it comes back exactly. Oils and materials of the catalogue are written by their names; an oil that
    differs in some values is written as its name and these values. The text is read back before the file is written.
    A file of the same name is replaced; the new one appears whole or not at all.

    **Arguments:**
    - `scene`: of any kind that files know; its numbers must be known, finite and single.
    - `path`: of the file, usually ending in ".toml".

    **Raises:** `SceneError` (a `ValueError`) that names a field which a file cannot hold: a law without a name in files
    (see `docs/contributing.md` for laws of other packages), a setting that only Python has, a number that is traced, of
    a batch, or not finite. `TypeError` for an object that is no scene. `OSError` if the file cannot be written.
    """
    from ..report.files import write_whole

    write_whole(path, scene_text(scene, str(path), [f"A scene of the kind {_kind(scene)}."]))


def scene_text(scene: AbstractScene, label: str, header: Iterable[str]) -> str:
    """The text of the file of a scene.

    **Arguments:** `label`: name of the file, for messages; `header`: lines of comment.

    **Raises:** as `save_scene`, but for `OSError`.
    """
    try:
        kind = _kind(scene)
        problems = list(_problems(scene, "", {}))
        if problems:
            raise SceneError.of_all(problems[:_MOST])
        scene = plain_scene(scene)
        text = _header(header) + toml_text(tables_of(scene))
        _require_readable(text)
        read = scene_from_tables(parse_toml(text, label, "a scene"), label)
        path, value, other = next(differences(scene, read), ("", None, None))
    except SceneError as error:
        raise SceneError.of_all([problem.of(label) for problem in error.problems]) from None
    if path:
        expected = f"{shown(other)}, which is what a scene file of the kind {kind} has here"
        raise SceneError(label, path, shown(value), expected)
    return text


def _header(lines: Iterable[str]) -> str:
    note = f"Written by jaxbearing {__version__}. Parts that are not here are not modelled, or follow from the others."
    return comments([*lines, note]) + "\n"


def _kind(scene: object) -> str:
    """Kind of a scene, checked.

    **Raises:** `TypeError` for an object that is no scene; `SceneError` for a kind that files do not know.
    """
    if not isinstance(scene, AbstractScene):
        raise TypeError(f"save_scene takes a scene, got a {type(scene).__name__}")
    if scene.kind not in KINDS or type(scene) is not schema_of_kind(scene.kind)[1]:
        known = one_of(schema_of_kind(kind)[1].__name__ for kind in KINDS)
        raise unwritable("kind", f"a {type(scene).__name__}", f"a scene of a class that files know: {known}")
    return scene.kind


def _problems(node: object, path: str, metadata: Mapping[str, object]) -> Iterator[SceneError]:
    """Yields an error for each number of a scene that no file can hold.

    **Arguments:** `metadata`: of the field.
    """
    if isinstance(node, eqx.Module):
        for field in dataclasses.fields(node):
            yield from _problems(getattr(node, field.name), f"{path}.{field.name}".lstrip("."), field.metadata)
        return
    if isinstance(node, tuple):
        for place, entry in enumerate(node):
            yield from _problems(entry, f"{path}.{place}", metadata)
        return
    if isinstance(node, Tracer | jax.ShapeDtypeStruct):
        yield unwritable(path, "a traced number", _KNOWN)
    elif eqx.is_array_like(node):
        values, most = np.asarray(node), 0 if "bound" in metadata else 2 if metadata.get("unit") == MIXED else 1
        if values.ndim > most:
            yield unwritable(path, f"an array of shape {values.shape}", _ONE)
        elif values.dtype not in (np.float64, np.int64, np.bool_):
            yield unwritable(path, f"a number of type {values.dtype}", "one with 64 bits")
        elif not np.all(np.isfinite(values)):
            yield unwritable(path, f"{values[~np.isfinite(values)].flat[0]:g}, which is not finite", "a finite number")


def _require_readable(text: str) -> None:
    """Checks the size and the characters of the text.

    **Raises:** `SceneError` for a text that `load_scene` would refuse.
    """
    try:
        size = len(text.encode("utf-8"))
    except UnicodeEncodeError:
        raise unwritable("oil.notes", "characters that UTF-8 does not have", "a text in UTF-8") from None
    if size > LARGEST_TEXT:
        expected = f"a scene of at most {LARGEST_TEXT >> 20} MiB; tables of a transient run are shorter as CSV files"
        raise SceneError(SCENE, "", f"{size >> 20} MiB of text", expected)
