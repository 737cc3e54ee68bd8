"""`jaxbearing scenes`: the scenes that come with the package."""

import errno
from pathlib import Path
from typing import Annotated

import typer

from .completion import scene_names
from .messages import bad_input, refuse
from .options import SetOption, labelled
from .output_files import ForceOption, check_kept, unwritten
from .terminal import console

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Error numbers of a full disk, which is not the fault of the file name."""


def scenes(
    copy: Annotated[
        str | None,
        typer.Option(
            "--copy",
            metavar="SCENE",
            autocompletion=scene_names,
            help="Write a built-in scene, as it stands in the package, as a file. With --set: a built-in scene or a "
            "scene file with these changes, every number to the last digit, without the comments.",
        ),
    ] = None,
    changes: SetOption = None,
    to: Annotated[
        Path | None, typer.Option("--to", metavar="FILE", help="File to write; SCENE.toml in this folder if not given.")
    ] = None,
    force: ForceOption = False,
) -> None:
    """List the built-in scenes, or write a scene out as a file to edit."""
    with bad_input():
        if copy is not None:
            _copy(copy, changes or [], to, force)
        elif to is not None or force or changes:
            refuse("--to, --set and --force belong to --copy: found no --copy; expected the name of a built-in scene.")
        else:
            _list()


def _list() -> None:
    from rich.table import Table

    from ..scenes.data_files import builtin_names, builtin_summary

    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(no_wrap=True, style="bold")
    table.add_column()
    for name in builtin_names():
        table.add_row(name, builtin_summary(name))
    console().print(table)


def _text(scene: str, changes: list[str]) -> str:
    """The text of the file. **Raises:** `SceneError`."""
    from ..scenes.data_files import builtin_names, builtin_text

    if changes:
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene, preset_note, read_tables
        from ..scenes.save import scene_text

        label, assignments = labelled(scene, changes), split_assignments(changes)
        model = load_scene(scene, assignments)
        # estimates stay marked in the file
        note = preset_note(read_tables(scene)[1], label, assignments)
        return scene_text(model, label, [f"{label}.", *([f"{note}."] if note else [])])
    if scene not in builtin_names():
        from ..scenes.errors import SceneError, nearest, one_of

        expected = f"a built-in scene: {one_of(builtin_names())}"
        raise SceneError("--copy", "", f"'{scene}'", expected, nearest(scene, builtin_names()))
    return builtin_text(scene)


def _copy(scene: str, changes: list[str], to: Path | None, force: bool) -> None:
    from ..report.files import write_whole
    from ..scenes.errors import SceneError

    text = _text(scene, changes)
    file = f"{Path(scene).name.removesuffix('.toml')}.toml"
    target = Path(file) if to is None else to
    try:
        if target.is_dir():
            target = target / file
        check_kept("--to", target, force)
        write_whole(target, text)
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno in _FULL:
            raise typer.Exit(unwritten(target, error)) from None
        # ValueError: a path with a null byte
        actual = f"a place that cannot be written: {getattr(error, 'strerror', None) or error}"
        raise SceneError(str(target), "", actual, "a file in an existing folder") from None
    typer.echo(f"wrote {target}")
