"""Fields of a scene file that are given as a distribution, of which the scene takes the mean or the median.

The forms are `{mean = "12 um", deviation = "2 um"}` and `{low = "5 um", high = "20 um"}`, with `shape = "normal"` (the
default), `"uniform"` or `"lognormal"`, and `{median = 0.3, log_deviation = 0.9, high = 1.2}`, which is lognormal and
truncated at the given limits. Any field with a single number can be given as a distribution.
"""

import typing
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from ..distribution import SHAPES, Distribution
from ..report.display import with_unit
from .errors import SceneError, nearest, one_of
from .fields import dimension_of, is_known, parts_of, tables_at, type_at
from .quantity_texts import quantity_text
from .units import Dimension, dimension_of_unit, number, quantity
from .words import describe

_NAMES = ("mean", "deviation", "median", "log_deviation", "low", "high", "shape")
_FORMS = "'mean' and 'deviation', or 'low' and 'high', or 'median' and 'log_deviation'"


def means_of(
    raw: Mapping[str, object], model: type[BaseModel], file: str
) -> tuple[dict[str, Any], dict[str, Distribution]]:
    """The tables with the mean or median in place of each distribution, and the distributions by dotted path, in SI.

    **Raises:** `SceneError` with all errors in the distributions.
    """
    distributions: dict[str, Distribution] = {}
    problems: list[SceneError] = []
    plain = _plain(raw, (), model, file, distributions, problems)
    if problems:
        raise SceneError.of_all(problems)
    return plain, distributions


def _plain(
    table: Mapping[str, Any],
    inside: tuple[str, ...],
    model: type[BaseModel],
    file: str,
    distributions: dict[str, Distribution],
    problems: list[SceneError],
) -> dict[str, Any]:
    plain = dict(table)
    for name, value in table.items():
        path = (*inside, str(name))
        if not isinstance(value, Mapping):
            continue
        if tables_at(model, path):
            plain[name] = _plain(value, path, model, file, distributions, problems)
        elif is_known(model, path) and any(key in _NAMES for key in value):
            try:
                plain[name], distributions[".".join(path)] = _read(value, path, model, file)
            except SceneError as error:
                problems.append(error)
    return plain


def _read(
    table: Mapping[str, object], path: tuple[str, ...], model: type[BaseModel], file: str
) -> tuple[Any, Distribution]:
    """The number that replaces a distribution in the tables, and the distribution. **Raises:** `SceneError`."""
    kind = type_at(model, path)
    description = no_number(kind)
    where = ".".join(path)
    if description:
        raise SceneError(
            file, where, f"a distribution of {description}", "one value: only a field that is one number scatters"
        )
    unknown = next((str(key) for key in table if key not in _NAMES), None)
    if unknown is not None:
        expected = f"a distribution: {_FORMS}, and 'shape'"
        raise SceneError(
            file, f"{where}.{unknown}", f"the unknown name '{unknown}'", expected, nearest(unknown, _NAMES)
        )
    names = [name for name in _NAMES[:-1] if name in table]
    if names[:2] == ["median", "log_deviation"] and table.get("shape", "lognormal") == "lognormal":
        return _lognormal(table, names, path, model, file)
    if names not in (["mean", "deviation"], ["low", "high"]):
        quoted = " and ".join(f"'{name}'" for name in names) or "neither"
        raise SceneError(file, where, f"a distribution with {quoted}", f"either {_FORMS}")
    shape = table.get("shape", SHAPES[0])
    if shape not in SHAPES:
        near = nearest(shape, SHAPES) if isinstance(shape, str) else ""
        raise SceneError(file, f"{where}.shape", describe(shape), one_of(SHAPES), near)
    first, second = (_value(table[name], name, path, model, file) for name in names)
    if names == ["mean", "deviation"]:
        if shape == "lognormal" and first <= 0.0:
            raise SceneError(file, f"{where}.mean", describe(table["mean"]), "a number above 0: it is lognormal")
        distribution = Distribution(first, second, shape)
        mean = table["mean"] if shape != "lognormal" else text_of(distribution.nominal, dimension_of(kind))
        return mean, distribution
    if first > second:
        expected = f"at most the high limit, {table['high']!r}"
        raise SceneError(file, f"{where}.low", describe(table["low"]), expected)
    if shape == "lognormal" and first <= 0.0:
        raise SceneError(file, f"{where}.low", describe(table["low"]), "a number above 0: it is lognormal")
    distribution = Distribution.between(first, second, shape)
    return text_of(distribution.nominal, dimension_of(kind)), distribution


def _lognormal(
    table: Mapping[str, object], names: list[str], path: tuple[str, ...], model: type[BaseModel], file: str
) -> tuple[object, Distribution]:
    """The median, which replaces it in the tables, and the lognormal distribution. **Raises:** `SceneError`."""
    where = ".".join(path)
    values = {name: _value(table[name], name, path, model, file) for name in names if name != "log_deviation"}
    try:
        return table["median"], Distribution.lognormal(log_deviation=number(table["log_deviation"], ">= 0"), **values)
    except PydanticCustomError as error:
        context = error.context or {}
        raise SceneError(file, f"{where}.log_deviation", context["found"], context["expected"]) from None
    except ValueError as error:
        raise SceneError(file, where, "a distribution", f"another one: {error}") from None


def _value(value: object, name: str, path: tuple[str, ...], model: type[BaseModel], file: str) -> float:
    """SI value of a number of a distribution, within the bounds of its field. **Raises:** `SceneError`."""
    kind = type_at(model, path)
    where = f"{'.'.join(path)}.{name}"
    try:
        if name == "deviation":
            return _deviation(value, dimension_of(kind))
        return float(TypeAdapter(kind).validate_python(value))
    except ValidationError as error:
        context = error.errors(include_url=False)[0].get("ctx", {})
    except PydanticCustomError as error:
        context = error.context or {}
    raise SceneError(
        file,
        where,
        context.get("found", describe(value)),
        context.get("expected", "a number"),
        context.get("suggestion", ""),
    )


def _deviation(value: object, dimension: Dimension | None) -> float:
    if dimension is None:
        return number(value, ">= 0")
    # a deviation of a temperature is a difference
    return quantity(value, dimension_of_unit("K", difference=True) if dimension.offset_allowed else dimension, ">= 0")


def no_number(kind: object) -> str:
    """Description of a field that is not a single number; "" for a single number."""
    base = parts_of(kind)[0]
    if base is float:
        return ""
    if base is int:
        return "a whole number, which shapes the equations"
    if base is bool:
        return "a switch, which shapes the equations"
    if typing.get_origin(base) is tuple:
        return "a field that takes a list of its own"
    if isinstance(base, type) and issubclass(base, BaseModel):
        return "a table"
    return "a choice of words"


def text_of(value: float, dimension: Dimension | None) -> float | str:
    """A value in SI as written in a file: a text with a unit, or a number for a field without a unit."""
    return float(value) if dimension is None else quantity_text(float(value), dimension)


def said_of(path: str, distribution: Distribution, model: type[BaseModel]) -> str:
    """Text which says that a scene uses the mean or median of a field."""
    dimension = dimension_of(type_at(model, path.split(".")))
    value = with_unit(distribution.nominal, "1" if dimension is None else dimension.si)
    word = "mean" if distribution.median is None else "median"
    return f"{path} is given as a distribution: its {word}, {value}, is used; 'jaxbearing tolerances' uses all of it"
