"""`jaxbearing fields`: every field of a kind of scene file."""

import dataclasses
import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .completion import kinds as completed_kinds
from .messages import bad_input
from .terminal import console

if TYPE_CHECKING:
    from ..scenes.field_list import Field

_PATHS = 30
"""Columns of the dotted paths of a preset."""


def fields(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="[KIND]", help="Kind of scene, such as ball_bearing.", autocompletion=completed_kinds),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print machine-readable JSON only.")] = False,
) -> None:
    """Every field of a kind of scene file: default, what it takes, what it is. Without a kind: the kinds."""
    with bad_input():
        from ..scenes.errors import SceneError, one_of
        from ..scenes.kinds import kind_named, kind_refused
        from ..scenes.reader import KINDS

        kind = kind_named(kind)
        if kind is not None and kind not in KINDS:
            actual, near = kind_refused(kind, KINDS)
            raise SceneError("fields", "", actual, f"a kind of scene: {one_of(KINDS)}", near)
    if kind is None:
        typer.echo(json.dumps(KINDS) if as_json else "\n".join(KINDS))
        return
    tables = _tables(kind)
    if as_json:
        rows = [_row(path, field) for path, table_fields in tables for field in table_fields]
        typer.echo(json.dumps(rows))
        return
    _print(kind, tables)


def _tables(kind: str) -> "list[tuple[str, list[Field]]]":
    """Path of each table, with the name of the law that it is for, and its fields."""
    from ..scenes.field_list import fields, tables_of_kind

    tables = []
    for path, model, owner in tables_of_kind(kind):
        law = getattr(model, "tag", "").strip("<>")
        tables.append((f"{path} ({law})" if law else path, list(fields(model, owner))))
    return tables


def _row(path: str, field: "Field") -> dict[str, Any]:
    table, _, law = path.partition(" (")
    row = {"path": f"{table}.{field.name}", "law": law.rstrip(")") or None}
    row |= {name: value for name, value in dataclasses.asdict(field).items() if name not in ("name", "tables")}
    return row


def _print(kind: str, tables: "list[tuple[str, list[Field]]]") -> None:
    from rich.table import Table

    from ..report.backends.screen import print_line, print_rule
    from ..scenes.presets import listing

    out = console()
    out.print(f'kind = "{kind}"')
    stands_for = list(listing(kind))
    if stands_for:
        print_rule('laws = "best" stands for', out)
        for path, value in stands_for:
            print_line(path, value, out, _PATHS)
    for path, table_fields in tables:
        print_rule(path, out)
        grid = Table.grid(padding=(0, 2, 0, 2))
        for ratio in (None, None, 1, 1):
            grid.add_column(overflow="fold", ratio=ratio, no_wrap=ratio is None)
        for field in table_fields:
            grid.add_row(field.name, field.default, field.expected or "a table", field.description)
        out.print(grid)
