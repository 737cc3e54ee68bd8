"""Completion of the shell: names of scenes, kinds, paths of fields. Nothing here needs JAX."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydantic import BaseModel


def _beginning(names: list[str], incomplete: str) -> list[str]:
    return [name for name in names if name.startswith(incomplete)]


def scene_names(incomplete: str) -> list[str]:
    """Built-in scenes; scene files and folders of the path that is typed."""
    from ..scenes.data_files import builtin_names

    folder, _, name = incomplete.rpartition("/")
    start = f"{folder}/" if folder or incomplete.startswith("/") else ""
    try:
        inside = sorted(path for path in Path(start or ".").iterdir() if path.name.startswith(name))
    except OSError:
        inside = []
    files = [f"{start}{path.name}" for path in inside if path.suffix == ".toml"]
    folders = [f"{start}{path.name}/" for path in inside if path.is_dir() and not path.name.startswith(".")]
    return [*_beginning(list(builtin_names()), incomplete), *files, *folders]


def kinds(incomplete: str) -> list[str]:
    """Kinds of scene."""
    from ..scenes.reader import KINDS

    return _beginning(list(KINDS), incomplete)


def assignments(incomplete: str) -> list[str]:
    """Names that may follow in the path of a field of the scene that is typed. A field ends with `=`, a table with a
    dot; where no scene is typed there is nothing to complete."""
    from ..scenes.fields import names_at, tables_at

    model = None if "=" in incomplete else _model_typed()
    if model is None:
        return []
    *above, last = incomplete.split(".")
    before = "".join(f"{name}." for name in above)
    names = [name for name in names_at(model, above).names if name.startswith(last)]
    return [f"{before}{name}{'.' if tables_at(model, [*above, name]) else '='}" for name in names]


def _model_typed() -> "type[BaseModel] | None":
    """Schema of the scene on the command line. The words are those that the shell hands over: the parser gives up at an
    option whose value is not typed yet."""
    from ..scenes.errors import SceneError
    from ..scenes.reader import read_base, scene_model

    line = os.environ.get("_TYPER_COMPLETE_ARGS") or os.environ.get("COMP_WORDS", "")
    for word in line.split()[2:]:
        if not word.startswith("-"):
            try:
                label, tables = read_base(word)
                return scene_model(tables, {}, label)
            except SceneError:
                continue
    return None
