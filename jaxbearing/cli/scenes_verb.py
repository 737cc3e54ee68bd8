"""`jaxbearing scenes`: what comes with the package."""

import errno
from pathlib import Path
from typing import Annotated

import typer

from .messages import bad_input, refuse
from .output_files import unwritten
from .terminal import console

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Error numbers of a full disk, which is not the fault of the file name."""


def scenes(
    copy: Annotated[
        str | None, typer.Option("--copy", metavar="NAME", help="Write a built-in scene as a file.")
    ] = None,
    to: Annotated[
        Path | None, typer.Option("--to", metavar="FILE", help="File to write; NAME.toml in this folder if not given.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """List the built-in scenes, or write one out as a file to edit."""
    with bad_input():
        if copy is not None:
            _copy(copy, to, force)
        elif to is not None or force:
            refuse("--to and --force belong to --copy NAME: found no --copy; expected the name of a built-in scene.")
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


def _copy(name: str, to: Path | None, force: bool) -> None:
    from ..report.files import write_whole
    from ..scenes.data_files import builtin_names, builtin_text
    from ..scenes.errors import SceneError, nearest, one_of

    if name not in builtin_names():
        near = nearest(name, builtin_names())
        raise SceneError("--copy", "", f"'{name}'", f"a built-in scene: {one_of(builtin_names())}", near)
    target = Path(f"{name}.toml") if to is None else to
    try:
        if target.is_dir():
            target = target / f"{name}.toml"
        if target.exists() and not force:
            found, expected = "a file that exists already", "a new file (--to FILE), or --force to overwrite it"
            raise SceneError(str(target), "", found, expected)
        write_whole(target, builtin_text(name))
    except SceneError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno in _FULL:
            raise typer.Exit(unwritten(target, error)) from None
        # ValueError: a path with a null byte
        found = f"a place that cannot be written: {getattr(error, 'strerror', None) or error}"
        raise SceneError(str(target), "", found, "a file in an existing folder") from None
    typer.echo(f"wrote {target}")
