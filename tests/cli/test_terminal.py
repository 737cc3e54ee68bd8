"""Width of the screen: `COLUMNS`, and tables that are too wide."""

import io
import sys

from rich.console import Console

from jaxbearing.cli.terminal import PIPE_WIDTH, console
from jaxbearing.report.backends.screen import print_table, shown_pieces


def test_piped_output_is_as_wide_as_columns_says(monkeypatch):
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    for columns, width in (("72", 72), ("", PIPE_WIDTH), ("wide", PIPE_WIDTH), ("0", PIPE_WIDTH)):
        monkeypatch.setenv("COLUMNS", columns)
        assert console().width == width


def test_a_table_that_does_not_fit_drops_columns_to_full():
    """One table with what fits, and a line that names the others; in full all of them."""
    first, columns = {"name": ["a"]}, {f"column {i}\nmm": ["1.0"] for i in range(9)}

    def shown(width, full):
        screen = Console(file=io.StringIO(), width=width)
        tables = []
        for table in shown_pieces(first, columns, screen, full):
            tables.append(table)
            print_table(table, [0.0], 0, "", screen, named="name")
        return tables, screen.file.getvalue()

    tables, text = shown(80, False)
    assert len(tables) == 1
    assert max(map(len, text.splitlines())) <= 80
    left = [title.replace("\n", " ") for title in columns if title not in tables[0]]
    assert left
    assert all(title in " ".join(text.partition("--full")[2].split()) for title in left)
    assert set(columns) <= {title for table in shown(80, True)[0] for title in table}
    assert shown(200, False) == shown(200, True)
