"""Damaged scene files: what a slip of the hand, a bad merge or a cut transfer makes of a good one."""

import random
import re

VALUES = [
    "nan", "inf", "-inf", "1e400", "-1", "0", "1e-320", "true", "false", '""', '" "', '"nan mm"', '"inf rpm"',
    '"-3 mm"', '"0 mm"', '"1e400 m"', '"3"', '"mm"', '"3 parsec"', '"3 mm/mm"', '"3 degC"', '"-300 degC"',
    '"1e309 N"', '"3 mm 4"', '"١٢ mm"', '"３ mm"', '"1,5 mm"', '"1_000 mm"', '"0x10 mm"', '"3 mm**400"', '"(3 mm"',
    '"__import__"', '"auto"', '"none"', "[]", "[1, 2]", "{}", "{a = 1}", '["3 mm"]', "2026-11-23", "12:30:00",
    "9999999999999999999999", "'''x'''", '"\\u0000"', '"\\U0001F600"', '"M50"', '"mobil_jet_ii"',
    '"dowson_higginson"', '"ball_bearing"', '"two_disk"',
]  # fmt: skip
# ruff: noqa: RUF001
"""Values that a field may hold by accident."""


def mutated(text: str, seed: int) -> str:
    """A scene file with one to four accidents, the same for the same seed."""
    dice = random.Random(seed)
    lines = text.splitlines()
    for _ in range(dice.choice((1, 1, 2, 4))):
        i = dice.randrange(len(lines))
        kind = dice.randrange(10)
        if kind < 5 and "=" in lines[i]:
            lines[i] = f"{lines[i].split('=')[0]}= {dice.choice(VALUES)}"
        elif kind == 5:
            del lines[i]
            lines = lines or [""]
        elif kind == 6:
            lines.insert(dice.randrange(len(lines) + 1), lines[i])
        elif kind == 7:
            at = dice.randrange(len(lines[i]) + 1)
            lines[i] = lines[i][:at] + dice.choice("=[]\"'#.,{}\\\t\0\x7fé漢\u202e") + lines[i][at:]
        elif kind == 8:
            words = re.findall(r"\w+", text)
            here = re.findall(r"\w+", lines[i])
            if here:
                lines[i] = lines[i].replace(dice.choice(here), dice.choice(words), 1)
        else:
            lines = lines[: i + 1]
    return "\n".join(lines)
