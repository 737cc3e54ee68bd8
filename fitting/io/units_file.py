"""The side file `NAME.units.toml` beside `NAME.csv`: units of columns whose headers have none."""

import os
import re
import tomllib
from pathlib import Path
from typing import Any

from jaxbearing.scenes.errors import nearest
from jaxbearing.scenes.words import describe, shortened

from .errors import CurveError
from .text import decode, read_bytes

_EXPECTED = 'a table [units] with lines such as pressure = "GPa"'


def units_path(path: Path) -> Path:
    """Path of the side file of a curve file, whether or not it exists."""
    return path.with_name(f"{path.stem}.units.toml")


def side_units(path: Path, columns: list[str]) -> dict[str, str]:
    """Units by name of column, from the side file of the curve file `path`; empty where there is no side file.

    **Raises:** `CurveError` that names the side file, if that is not TOML, has no table `[units]`, or names a column
    that is not among `columns`.
    """
    side = units_path(path)
    if not os.path.exists(side):  # unlike Path.exists, no error for a name too long to exist
        return {}
    table = _table(decode(read_bytes(side), side), side)
    for name, unit in table.items():
        if name not in columns:
            known = f"a column of '{path.name}': {', '.join(columns)}"
            raise CurveError(str(side), None, name, "an unknown column", known, nearest(name, columns))
        if not isinstance(unit, str):
            raise CurveError(str(side), None, name, describe(unit), 'a unit in quotes, e.g. "GPa"')
    return table


def _table(text: str, side: Path) -> dict[str, Any]:
    try:
        whole = tomllib.loads(text)
    # ValueError: also a number of thousands of digits
    except ValueError as error:
        line = re.search(r"at line (\d+)", str(error))
        actual = f"a TOML syntax error, {error}"
        raise CurveError(str(side), int(line[1]) if line else None, "", actual, _EXPECTED) from None
    except RecursionError:
        raise CurveError(str(side), None, "", "tables nested too deeply", _EXPECTED) from None
    others = [name for name in whole if name != "units"]
    if others:
        raise CurveError(str(side), None, "", f"the unknown name {shortened(repr(others[0]))}", _EXPECTED)
    if not isinstance(whole.get("units"), dict):
        raise CurveError(str(side), None, "", "no table [units]", _EXPECTED)
    return whole["units"]
