"""Damaged CSV files: what spreadsheets, slips of the hand and cut transfers make of a good one."""

import random
import re

# ruff: noqa: RUF001
CELLS = [
    "nan", "NaN", "inf", "-inf", "1e999", "1e308", "-1e308", "1e-320", "-1", "0", "", " ", "abc", "NA", "N/A", "None",
    "true", "1,5", "1.5", "1.000,5", "1.2.3", "--3", "1e", "e5", "0x10", "1_000", "1 000", "1\u00a0000", "5 %", "−5",
    "١٢", "３", "½", "=1+2", "#REF!", "#", '"3"', '"3', '3"', '"1,5"', "'3'", "\0", "\ufeff3", "9" * 400, "0" * 5000,
    "3 N", "1;5", "2026-11-23", "12:30", "$3", "3\u2028", "\u202e3",
]  # fmt: skip
"""What a cell may hold by accident."""
HEADERS = [
    "time", "time [s]", "time [h]", "speed [N]", "speed [rpm", "speed rpm]", "factor", "factor [%]", "load", "[N]", "",
    "load [N] [N]", "load [kN]", "load [parsec]", "load [N**400]", "load [degC]", "slide_to_roll", "slide_to_roll [N]",
    "operation.inner_speed [rpm]", "operation.inner_speed [Hz]", "operation.inner_speed", "operation.radial_load [mm]",
    "operation.n", "geometry.n_rollers", "cage.guidance", "cage", "drag.coefficient", "drag.coefficient [N]", "x" * 300,
    "temperature [delta_degC]", "temperature [degF]", "pressure [GPa]", "curve [N]", "__class__", "operation..x",
]  # fmt: skip
"""What the head of a column may be by accident."""


def mutated(text: str, seed: int) -> bytes:
    """A CSV file with one to three accidents, the same for the same seed."""
    dice = random.Random(seed)
    lines = text.splitlines()
    for _ in range(dice.choice((1, 1, 2, 3))):
        lines = _ROWS[dice.randrange(len(_ROWS))](lines, dice) or [""]
    content = _written(lines, dice)
    for _ in range(dice.choice((0, 0, 0, 1, 3))):
        place = dice.randrange(len(content) + 1)
        noise = bytes([dice.randrange(256)])
        content = content[:place] + noise + content[place + dice.randrange(2) :]
    return content[: dice.randrange(len(content) + 1)] if dice.random() < 0.05 else content


def _written(lines: list[str], dice: random.Random) -> bytes:
    """As one or another program writes files."""
    text = dice.choice(("\n", "\n", "\r\n", "\r")).join(lines) + dice.choice(("", "\n"))
    kind = dice.randrange(20)
    if kind == 0:
        return text.encode("utf-16")
    return (b"\xef\xbb\xbf" if kind < 4 else b"") + text.encode()


def _cell(lines: list[str], dice: random.Random) -> list[str]:
    i = dice.randrange(len(lines))
    cells = lines[i].split(",")
    cells[dice.randrange(len(cells))] = dice.choice(HEADERS if i == 0 else CELLS)
    return [*lines[:i], ",".join(cells), *lines[i + 1 :]]


def _column(lines: list[str], dice: random.Random) -> list[str]:
    """Taken out, doubled, or moved."""
    rows = [line.split(",") for line in lines]
    at, to, kind = dice.randrange(len(rows[0])), dice.randrange(len(rows[0]) + 1), dice.randrange(3)
    for row in rows:
        if at < len(row):
            cell = row[at] if kind == 0 else row.pop(at)
            if kind < 2:
                row.insert(to, cell)
    return [",".join(row) for row in rows]


def _row(lines: list[str], dice: random.Random) -> list[str]:
    """Taken out, doubled, emptied, or cut short."""
    i = dice.randrange(len(lines))
    cells = lines[i].split(",")
    made = ([], [lines[i]] * 2, ["," * (len(cells) - 1)], [",".join(cells[:-1])], [lines[i] + ","], ["# " + lines[i]])
    return [*lines[:i], *dice.choice(made), *lines[i + 1 :]]


def _separators(lines: list[str], dice: random.Random) -> list[str]:
    """Semicolons or tabs, with decimal points or commas; or in one line only."""
    to, comma = dice.choice((";", "\t", " ", ", ")), dice.random() < 0.5
    change = lambda line: (line.replace(",", "\0").replace(".", ",") if comma else line.replace(",", "\0")).replace(
        "\0", to
    )
    if dice.random() < 0.3:
        i = dice.randrange(len(lines))
        return [*lines[:i], change(lines[i]), *lines[i + 1 :]]
    # the head of a column may have points that are no decimal ones
    return [lines[0].replace(",", to), *map(change, lines[1:])]


def _quotes(lines: list[str], dice: random.Random) -> list[str]:
    quoted = lambda line: ",".join(f'"{cell}"' for cell in line.split(","))
    return [quoted(line) if dice.random() < 0.7 else line for line in lines]


_ROWS = (_cell, _cell, _cell, _column, _row, _separators, _quotes)


def cells_as_they_stand(content: bytes) -> list[list[str]]:
    """Head and rows of a file that was read, parted in the plainest way: what a reader made of them can be checked."""
    lines = [line for line in re.split("\r\n|\n|\r", content.decode("utf-8-sig")) if line.strip()]
    lines = [line for line in lines if not line.lstrip().startswith("#")]
    separator = max(",;\t", key=lines[0].count)
    rows = [[cell.strip(' "\t').strip() for cell in _parts(line, separator)] for line in lines]
    rows = [row for row in rows if any(row)]
    used = [i for i in range(len(rows[0])) if any(row[i] for row in rows)]
    return [[row[i] for i in used] for row in rows]


def _parts(line: str, separator: str) -> list[str]:
    """Quotation marks keep a separator within a cell."""
    pieces = line.split('"')
    for i in range(1, len(pieces), 2):
        pieces[i] = pieces[i].replace(separator, "\0")
    return [part.replace("\0", separator) for part in "".join(pieces).split(separator)]


def number(cell: str) -> float:
    """A cell that was read as a number."""
    return float(cell.replace(",", ".").replace("−", "-"))
