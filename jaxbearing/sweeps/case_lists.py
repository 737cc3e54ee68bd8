"""A list of cases from a CSV file: one row for each case, one column for each field, its unit in the header."""

from pathlib import Path

import numpy as np

from ..scenes.csv_files import CsvTable, name_and_unit
from ..scenes.errors import SceneError
from ..scenes.units import registry
from .cases import Cases, listed
from .fields import Field, SceneSource

_EXPECTED = "a CSV file with columns such as 'operation.inner_speed [rpm]'"


def list_of(file: Path, source: SceneSource) -> tuple[dict[str, Field], Cases]:
    """Cases of a CSV file whose columns are headed as `operation.inner_speed [rpm]`.

    Columns are separated by commas, semicolons or tabs; decimal commas need one of the latter two. Blank lines and
    lines that begin with `#` are skipped.

    **Raises:** `SceneError` that names file, line and column.
    """
    table = CsvTable.of(file, _EXPECTED)
    parted = [name_and_unit(cell) for cell in table.header.cells]
    fields = [_field(name, unit, source, table) for name, unit in parted]
    paths = [field.path for field in fields]
    for path in paths:
        if paths.count(path) > 1 or path in source.overrides:
            raise SceneError(_header(table), path, "this field twice", "each field once, here or in --set")
    if not table.rows:
        raise SceneError(table.file, "", "no rows", _EXPECTED)
    numbers = np.asarray(table.numbers(paths)).T
    columns = {
        field.path: in_si(field, unit, values, table)
        for field, (_, unit), values in zip(fields, parted, numbers, strict=True)
    }
    return dict(zip(paths, fields, strict=True)), listed(columns)


def _header(table: CsvTable) -> str:
    return table.at(table.header.number)


def _field(name: str, unit: str | None, source: SceneSource, table: CsvTable) -> Field:
    if not name:
        raise SceneError(_header(table), "", "a column without a name", _EXPECTED)
    field = source.field(name, _header(table))
    if field.dimension is None and unit:
        raise SceneError(_header(table), name, f"the unit '{unit}'", "a number without a unit")
    return field


def in_si(field: Field, unit: str | None, values: np.ndarray, table: CsvTable) -> np.ndarray:
    """The values of a column in SI, each within the bounds of its field. **Raises:** `SceneError`."""
    if field.dimension is not None:
        # the first value is read like one of a scene file, whose error explains a wrong unit
        field.read(f"{float(values[0])!r} {unit or ''}", table.at(table.rows[0].number))
        units = registry()
        with np.errstate(over="ignore"):
            values = np.asarray(units.Quantity(values, units.Unit(unit)).to(field.dimension.si).magnitude)
    for place in (int(np.argmin(values)), int(np.argmax(values))):
        field.read(field.text(values[place]), table.at(table.rows[place].number))
    return values
