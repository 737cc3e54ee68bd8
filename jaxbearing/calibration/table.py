"""Measurements from a CSV file: a row for each operating point, a column for each scene field or result, with units."""

from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import numpy as np
import pint

from .._scene import AbstractScene
from ..numerics.newton import NewtonOptions
from ..scenes.csv_files import CsvTable, NumberReader, name_and_unit
from ..scenes.errors import SceneError, nearest
from ..scenes.fields import is_known
from ..scenes.units import registry
from ..scenes.words import describe
from ..sweeps.cases import listed
from ..sweeps.fields import Field, SceneSource
from ..sweeps.recipe import Direct
from .data import Data
from .labels import is_left_out, labels_in, result_names, results_among

EXPECTED = "a CSV file with columns such as 'operation.inner_speed [rpm]' and 'power_loss.total [W]'"
DEVIATION, WEIGHT, HELD_BACK = ".deviation", ".weight", "held_back"
"""Endings of columns with the standard deviation or weight of a result, and name of the column that marks points to
hold back from the fit."""
NO_UNIT = ("", "1", "-")


def read_data(
    file: str | Path, source: SceneSource, scene: AbstractScene, newton: NewtonOptions | None = None
) -> tuple[Data, list[str]]:
    """Measurements of a rig, and notes on columns that are not used.

    Columns are headed `name [unit]`. The columns of scene fields, e.g. `operation.radial_load [N]`, give the operating
    points. Those of results, e.g. `power_loss.total [W]`, give measured values; an empty cell was not measured.
    `power_loss.total.deviation [W]` is the standard deviation, or `power_loss.total.weight` a weight, the inverse
    square of one; weight 0 leaves the value out. Points with 1 in `held_back` are not fitted but predicted. Columns
    without a dot in their name that are neither fields nor results are ignored.

    **Raises:** `SceneError` that names file, line and column.
    """
    table = CsvTable.of(file, EXPECTED)
    header = table.at(table.header.number)
    if not table.rows:
        raise SceneError(table.file, "", "no rows", EXPECTED)
    columns = [name_and_unit(cell) for cell in table.header.cells]
    names = [name for name, _ in columns]
    twice = next((name for name in names if name and names.count(name) > 1), None)
    if twice is not None:
        raise SceneError(header, twice, "this column twice", "each column once")
    is_field = lambda name: is_known(source.model, name.split(".")) if all(name.split(".")) else False
    plain = [name for name in names if name and "." not in name and name != HELD_BACK and not is_field(name)]
    known = results_among(scene, plain, newton)
    ignored = [name for name in names if not name or (name in plain and name not in known)]
    fields = {name: source.field(name, header) for name in names if name not in ignored and is_field(name)}
    results = [name for name in names if name not in ignored and name not in fields and name != HELD_BACK]
    measured = [name for name in results if not name.endswith((DEVIATION, WEIGHT))]
    labels = _labels(scene, measured, header, source, newton)
    read = lambda name, empty: _numbers(table, names.index(name), name, empty)
    unit_of = dict(columns)
    values, deviations = {}, {}
    for name in measured:
        values[name] = _in_si(read(name, True), unit_of[name], labels[name], name, header)
    for name in results:
        base = name.removesuffix(DEVIATION)
        if name in measured:
            continue
        if name.endswith(DEVIATION) and base in values:
            deviations[base] = _in_si(read(name, True), unit_of[name], labels[base], name, header, difference=True)
        elif name.endswith(WEIGHT) and name.removesuffix(WEIGHT) in values:
            _weigh(values, deviations, name.removesuffix(WEIGHT), read(name, False), header)
        else:
            raise SceneError(
                header, name, "no measured column to which it belongs", "one that is named without its end"
            )
    if not values:
        raise SceneError(header, "", "no column with a measured result", EXPECTED)
    conditions = {name: _condition(table, field, unit_of[name], read(name, False)) for name, field in fields.items()}
    require_plain(source, conditions, header)
    held = read(HELD_BACK, False) != 0.0 if HELD_BACK in names else None
    for name in conditions:
        if name in source.overrides:
            raise SceneError(header, name, "a field that --set gives too", "one of the two")
    try:
        data = Data(conditions, values, deviations, held, table.file)
    except ValueError as error:
        where, _, rest = str(error).partition(": found ")
        value, _, expected = rest.partition("; expected ")
        raise SceneError(table.file, where, value, expected or EXPECTED) from None
    return data, [f"column '{name}' of {table.file} is ignored" for name in ignored if name]


def require_plain(source: SceneSource, columns: dict[str, np.ndarray], where: str, in_file: bool = True) -> None:
    """Checks that the scene takes over these fields unchanged from its file. **Raises:** `SceneError`.

    **Arguments:** `in_file`: whether the file must be able to contain the field. It cannot where a name, such as that
    of a material, replaces the table of the field, although the scene has the number.
    """
    for path, values in columns.items():
        field = source.field(path, where)
        try:
            plain = isinstance(source.recipe(listed({path: values}), {path: field}), Direct)
        except SceneError:
            if in_file:
                raise
            continue
        except ValueError as error:
            raise SceneError(where, path, "a field that cannot vary", str(error)) from None
        if not plain:
            expected = "a number that the scene holds itself: from this setting others are computed"
            raise SceneError(where, path, "a setting", expected)


def read_candidates(file: str | Path, source: SceneSource) -> dict[str, np.ndarray]:
    """Operating points from a CSV file, by dotted path, in SI. **Raises:** `SceneError`."""
    from ..sweeps.case_lists import list_of

    _, cases = list_of(Path(file), source)
    columns = dict(zip(cases.paths, cases.values, strict=True))
    require_plain(source, columns, str(file))
    return columns


def _labels(
    scene: AbstractScene, measured: Sequence[str], header: str, source: SceneSource, newton: NewtonOptions | None
) -> dict[str, str]:
    """SI unit of each measured result. **Raises:** `SceneError`."""
    try:
        return {name: label.unit for name, (_, label) in labels_in(scene, measured, newton).items()}
    except ValueError:
        for name in measured:
            try:
                labels_in(scene, [name], newton)
            except ValueError as error:
                if is_left_out(scene, name, newton):
                    found, expected = "a result that this scene does not model", "a result of a part that it has"
                    raise SceneError(header, name, found, expected) from None
                near = nearest(name, [*result_names(scene, newton), *source.model.model_fields])
                found, _, expected = str(error).partition("; expected ")
                found, expected = found.partition("', ")[2], expected.partition(";")[0]
                if found.endswith("does not have"):
                    found, expected = "neither a field of the scene nor one of its results", "one of the two"
                raise SceneError(header, name, found or "places that it does not have", expected, near) from None
        raise


def _numbers(table: CsvTable, place: int, name: str, empty_allowed: bool) -> np.ndarray:
    """Numbers of a column; NaN for empty cells, if these are allowed."""

    def refuse(line: int, column: str, found: str, expected: str) -> NoReturn:
        raise SceneError(table.at(line), column, found, expected)

    reader = NumberReader(refuse, comma_allowed=table.separator != ",")
    cells = [(row.cells[place], row.number) for row in table.rows]
    value = lambda cell, line: np.nan if empty_allowed and not cell else reader.number(cell, line, name)
    return np.array([value(cell, line) for cell, line in cells])


def _in_si(
    values: np.ndarray, unit: str | None, si: str, name: str, where: str, difference: bool = False
) -> np.ndarray:
    """Values of a result converted to the SI unit of its label. **Raises:** `SceneError`."""
    written, wanted = (unit or "").strip(), si
    plain = wanted in NO_UNIT
    expected = "no unit" if plain else f"a unit of the kind '{wanted}', e.g. '{name} [{wanted}]'"
    if plain and written == "%":
        return values / 100.0
    if plain or not written:
        if plain and written in NO_UNIT:
            return values
        raise SceneError(where, name, f"the unit {describe(written)}" if written else "no unit", expected)
    units = registry()
    try:
        quantity = units.Quantity(values, units.Unit(written)).to(wanted).magnitude
        zero = units.Quantity(0.0, units.Unit(written)).to(wanted).magnitude if difference else 0.0
        return np.asarray(quantity - zero, dtype=float)
    except (pint.errors.PintError, AttributeError, ValueError, TypeError):
        raise SceneError(where, name, f"the unit {describe(written)}", expected) from None


def _condition(table: CsvTable, field: Field, unit: str | None, values: np.ndarray) -> np.ndarray:
    """The values of an operating-point column in SI, each within the bounds of its field."""
    from ..sweeps.case_lists import in_si

    if field.dimension is None and unit:
        raise SceneError(table.at(table.header.number), field.path, f"the unit '{unit}'", "a number without a unit")
    return in_si(field, unit, values, table)


def _weigh(
    values: dict[str, np.ndarray], deviations: dict[str, np.ndarray], name: str, weight: np.ndarray, where: str
) -> None:
    """Turns weights into standard deviations: that of weight 1 is the root mean square of the column. A weight of 0
    leaves a value out."""
    if np.any(weight < 0.0):
        raise SceneError(where, f"{name}{WEIGHT}", "a weight below 0", "numbers >= 0")
    if name in deviations:
        raise SceneError(where, f"{name}{WEIGHT}", "a weight beside a deviation", "one of the two")
    values[name] = np.where(weight > 0.0, values[name], np.nan)
    if not np.any(np.isfinite(values[name])):
        raise SceneError(where, f"{name}{WEIGHT}", "no value with a weight above 0", "a weight > 0, or no such column")
    size = float(np.sqrt(np.nanmean(np.square(values[name])))) or 1.0
    deviations[name] = size / np.sqrt(np.where(weight > 0.0, weight, 1.0))
