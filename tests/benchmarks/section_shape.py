"""What a section of the report is made of: words, tables of numbers, and the facts that README quotes."""

from typing import NamedTuple


class Table(NamedTuple):
    """Rows of texts and numbers under their headings; a number that is not there is `None`."""

    caption: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str | float | int | None, ...], ...]


class Section(NamedTuple):
    """One part of the report. `facts`: single numbers, by names that say what they are, for README and tests."""

    title: str
    text: str
    tables: tuple[Table, ...]
    facts: dict[str, float]
