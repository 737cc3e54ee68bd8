"""A sweep's data set as figures need it: its axes, its failed cases, what stands still."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.display import digits
from .frame import Axis, axis_for, label_unit

if TYPE_CHECKING:
    import xarray as xr

CASE = "case"
_LOSS = "power_loss_"
TOTAL = "power_loss_total"


def variable_name(field: str) -> str:
    """Of a field in a data set: dots become underscores."""
    return field.replace(".", "_")


def swept(dataset: "xr.Dataset") -> list[str]:
    """Names of the coordinates of the fields that still vary.

    **Raises:** `ValueError` for a data set that is not of a sweep.
    """
    if "sweep_fields" not in dataset.attrs:
        raise ValueError("the data set is not of a sweep: expected that of jb.sweep or jaxbearing sweep --out")
    names = [variable_name(path) for path in dataset.attrs["sweep_fields"].split()]
    return [name for name in names if name in dataset.coords and dataset[name].ndim > 0]


def over_fields(dataset: "xr.Dataset", fields: list[str]) -> "tuple[xr.Dataset, list[str]]":
    """A data set that varies over these fields only, sorted, and the names of their dimensions.

    **Arguments:** `fields`: dotted paths, one or several of a grid, or the only one of a list or of samples.

    **Raises:** `ValueError` for a field that was not swept, and where another one varies too.
    """
    names, varied = [variable_name(field) for field in fields], swept(dataset)
    paths = {name: dataset[name].attrs.get("path", name) for name in varied}
    for name, field in zip(names, fields, strict=True):
        if name not in varied:
            found = ", ".join(paths.values()) or "no field"
            raise ValueError(f"field {field}: the data set varies {found}")
        if names.count(name) > 1:
            raise ValueError(f"field {field}: given twice, expected two fields")
    others = [name for name in varied if name not in names]
    if CASE in dataset.dims:
        if others or len(names) > 1:
            raise ValueError(
                f"the cases are a list or samples, in which {', '.join(paths.values())} vary together: expected a grid"
            )
        dataset = dataset.swap_dims({CASE: names[0]})
    elif others:
        choices = ", ".join(f"{name}={_example(dataset, name)}" for name in others)
        raise ValueError(
            f"the data set varies {', '.join(paths[name] for name in others)} too: select one value, e.g. "
            f'dataset.sel({choices}, method="nearest")'
        )
    return dataset.sortby(names), names


def _example(dataset: "xr.Dataset", name: str) -> str:
    return f"{float(dataset[name].values.flat[0]):.6g}"


def axis_of(variable: "xr.DataArray") -> Axis:
    """Engineer's unit of a variable or coordinate."""
    if "slip" in str(variable.name) and variable.attrs.get("units") == "1":
        return Axis("%", lambda part: 100.0 * np.asarray(part))
    return axis_for(label_unit(str(variable.attrs.get("units", "1"))), variable.values)


def words_of(variable: "xr.DataArray") -> str:
    """What a variable is: its description, or its name."""
    return str(variable.attrs.get("long_name", variable.name))


def losses_of(dataset: "xr.Dataset") -> dict[str, "xr.DataArray"]:
    """Power losses by location, W, without the total, the largest mean first; without those that are 0 everywhere.

    **Raises:** `ValueError` where the scene has none.
    """
    if TOTAL not in dataset:
        raise ValueError("power_loss_total: the scene of the sweep has no power loss")
    found = {
        str(name).removeprefix(_LOSS): dataset[name]
        for name in dataset.data_vars
        if str(name).startswith(_LOSS) and name != TOTAL
    }
    mean = {name: float(np.nansum(values)) for name, values in found.items()}
    return {
        name: found[name] for name in sorted(found, key=lambda one: -mean[one]) if np.any(np.nan_to_num(found[name]))
    }


def held(dataset: "xr.Dataset") -> str:
    """Operating point as far as it stands still: "radial load 10 kN, oil temperature 100 °C"."""
    return ", ".join(_held(dataset))


def _held(dataset: "xr.Dataset") -> Iterator[str]:
    fields = {variable_name(path) for path in dataset.attrs.get("sweep_fields", "").split()}
    for name, coordinate in dataset.coords.items():
        operating = str(coordinate.attrs.get("path", "")).startswith("operation.")
        if coordinate.ndim == 0 and (operating or name in fields) and _is_number(coordinate.values):
            axis = axis_of(coordinate)
            yield f"{words_of(coordinate)} {digits(float(axis.of(coordinate.values)))} {axis.unit}".rstrip()


def _is_number(value: Any) -> bool:
    return np.asarray(value).dtype.kind in "if" and bool(np.isfinite(value)) and float(value) != 0.0


def count_failed(dataset: "xr.Dataset") -> tuple[int, int]:
    """Cases without results, and all cases."""
    failed = np.asarray(dataset["status"].values != 0)
    if failed.ndim > len([name for name in swept(dataset) if name in dataset.dims]):
        failed = failed.reshape(*[dataset.sizes[name] for name in swept(dataset)], -1).any(axis=-1)
    return int(failed.sum()), failed.size


def is_logarithmic(values: np.ndarray) -> bool:
    """Whether values stand at equal ratios rather than at equal distances."""
    if values.size < 3 or values.min() <= 0.0:
        return False
    ratios = values[1:] / values[:-1]
    return bool(np.allclose(ratios, ratios[0], rtol=1e-6)) and not np.isclose(ratios[0], 1.0)
