"""Writes tables as TOML text with the layout of the built-in files; `tomli_w` writes the values."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import tomli_w

from .errors import printable

WIDEST = 120
"""Longest line for a list, in letters; longer lists have one value per line."""


def toml_text(tables: Mapping[str, object], aligned: bool = True) -> str:
    """The text of a file with these tables, in their order.

    **Arguments:** `aligned`: True to align the values of a table.
    """
    return "\n".join(_table(tables, (), aligned)).lstrip("\n") + "\n"


def comments(lines: Iterable[str]) -> str:
    """Lines of comment at the top of a file."""
    return "".join(f"# {one_line(text)}".rstrip() + "\n" for text in lines)


def one_line(text: str) -> str:
    """A text on one line, with unprintable characters escaped."""
    return printable(" ".join(text.split()))


def _table(table: Mapping[str, Any], path: tuple[str, ...], aligned: bool, listed: bool = False) -> Iterator[str]:
    """The lines of a table. **Arguments:** `listed`: True for a table of a list, whose heading is written already."""
    inner = {name: value for name, value in table.items() if isinstance(value, Mapping) or _are_tables(value)}
    plain = {name: value for name, value in table.items() if name not in inner}
    if path and (plain or not inner) and not listed:
        yield from ("", f"[{'.'.join(path)}]")
    width = max(map(len, plain), default=0) if aligned else 0
    yield from (f"{name:<{width}} = {_value(value, width)}" for name, value in plain.items())
    for name, value in inner.items():
        if isinstance(value, Mapping):
            yield from _table(value, (*path, name), aligned)
            continue
        for entry in value:
            yield from ("", f"[[{'.'.join((*path, name))}]]")
            yield from _table(entry, (*path, name), aligned, listed=True)


def _are_tables(value: object) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(entry, Mapping) for entry in value)


def _value(value: object, width: int) -> str:
    if isinstance(value, list):
        line = f"[{', '.join(_value(entry, 0) for entry in value)}]"
        if width + len(line) + 3 <= WIDEST:
            return line
    return tomli_w.dumps({"value": value}).removeprefix("value = ").rstrip("\n")
