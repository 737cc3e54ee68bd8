"""From the chunks of a sweep to one labelled store, variable by variable: memory holds one of them at a time."""

import math
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import xarray as xr

from ..numerics.status import Status
from ..report.labelled import CHECK, flags
from .chunks import KEY, read_chunk
from .labels import CASE, FAILURE, per_case, template
from .plan import Plan

STORES = (".nc", ".zarr")
NONE_COUNTED = (lambda done, total: None)


def store(plan: Plan, folder: Path, target: Path, progress: Callable[[int, int], None] = NONE_COUNTED) -> None:
    """Write the whole sweep, as NetCDF or Zarr by the suffix, into the folder of the chunks, and move it to its place.

    A grid has one dimension a field, named like its coordinate (`operation_inner_speed`); other sweeps have `case`.

    **Raises:** `OSError`: nothing is at the place then, or what was there before; `DamagedChunkError`.
    """
    labels = _labels(plan)
    _require_space(plan, labels, folder)
    temporary = folder / f"gathered{target.suffix.lower()}"
    _remove(temporary)
    write = _to_zarr if target.suffix.lower() == ".zarr" else _to_netcdf
    for done, (dataset, total) in enumerate(_pieces(plan, folder, labels)):
        write(dataset, temporary, "w" if done == 0 else "a")
        progress(done + 1, total)
    _replace(temporary, target)


def _labels(plan: Plan) -> xr.Dataset:
    labels = template(plan.program().structure, plan.elements)
    labels.attrs |= {"title": f"{labels.attrs['title']}, sweep of {plan.label}", KEY: plan.key}
    labels.attrs |= {"sweep_kind": plan.cases.kind, "sweep_fields": " ".join(plan.cases.paths)}
    return labels


def _pieces(plan: Plan, folder: Path, labels: xr.Dataset) -> Iterator[tuple[xr.Dataset, int]]:
    """Data sets that together are the whole, each small: coordinates and what all cases share, then each variable."""
    names = [name for name in per_case(labels) if name not in map(_name_of, plan.cases.paths)]
    axes = _axes(plan)
    dims = tuple(axes) if plan.cases.kind == "grid" else (CASE,)
    whole = lambda name: _shaped(_column(plan, folder, name), plan.cases.shape)
    shared = labels.drop_vars([*per_case(labels)]).assign_coords(axes)
    for name, variable in list(shared.variables.items()):
        if variable.dtype.kind == "f" and name not in axes and _is_kept(plan, folder, str(name)):
            # what a template lacks, such as the azimuths: NaN where all cases of a chunk failed
            parts = [read_chunk(folder, i, plan.key, [str(name)])[str(name)] for i in range(plan.chunks)]
            shared[name] = variable.copy(data=np.fmax.reduce(parts))
    broken = whole("out_of_range") if "out_of_range" in names else None
    if broken is not None:
        shared.attrs["warnings"] = "\n".join(_warnings(broken, [str(text) for text in labels[CHECK].values]))
    for name in [name for name in names if name in labels.coords]:
        values = whole(name)
        variable = labels[name].variable
        finite = values[np.isfinite(values)]
        constant = values.shape == plan.cases.shape and finite.size > 0 and np.all(finite == finite[0])
        there = ((), finite[0]) if constant else ((*dims, *variable.dims[1:]), values)
        shared = shared.assign_coords({name: xr.Variable(*there, variable.attrs)})
    failure = {"units": "1", "long_name": "why a case has no results; empty where it has"}
    total = len(names) + 2
    yield _tidy(shared), total
    yield _tidy(xr.Dataset({FAILURE: xr.Variable(dims, whole(FAILURE).astype(object), failure)})), total
    for name in names:
        if name not in labels.coords:
            variable = labels[name].variable
            values = broken if name == "out_of_range" and broken is not None else whole(name)
            yield _tidy(xr.Dataset({name: xr.Variable((*dims, *variable.dims[1:]), values, variable.attrs)})), total


def _tidy(dataset: xr.Dataset) -> xr.Dataset:
    """Texts of any length, and no mark for what is missing where nothing is."""
    for name, variable in dataset.variables.items():
        if variable.dtype.kind == "U":
            dataset[name] = variable.copy(data=variable.values.astype(object))
    for name in dataset.coords:
        dataset[name].encoding["_FillValue"] = None
    return dataset


def _name_of(path: str) -> str:
    return path.replace(".", "_")


def _axes(plan: Plan) -> dict[str, xr.Variable]:
    """The swept fields as coordinates: the axes of a grid, or along the cases."""
    grid = plan.cases.kind == "grid"
    names = [_name_of(path) for path in plan.cases.paths]
    axes = {
        name: xr.Variable((name if grid else CASE,), values, {**plan.metadata[path], "path": path})
        for name, path, values in zip(names, plan.cases.paths, plan.cases.values, strict=True)
    }
    if not grid:
        axes[CASE] = xr.Variable((CASE,), np.arange(len(plan.cases)), {"units": "1", "long_name": "number of the case"})
    return axes


def _column(plan: Plan, folder: Path, name: str) -> np.ndarray:
    return np.concatenate([read_chunk(folder, i, plan.key, [name])[name] for i in range(plan.chunks)])


def _is_kept(plan: Plan, folder: Path, name: str) -> bool:
    return name in read_chunk(folder, 0, plan.key)


def _shaped(values: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    return values.reshape(*shape, *values.shape[1:])


def _warnings(broken: np.ndarray, texts: list[str]) -> Iterator[str]:
    lanes = broken.reshape(-1, broken.shape[-1])
    for text, count in zip(texts, lanes.sum(axis=0), strict=True):
        if count:
            yield f"{text} ({int(count)} of {len(lanes)} cases)"


def _require_space(plan: Plan, labels: xr.Dataset, folder: Path) -> None:
    """A NetCDF library that runs out of space may bring the process down, so it is not let.

    **Raises:** `OSError`.
    """
    each = sum(v.dtype.itemsize * math.prod(v.shape) for v in labels.variables.values() if CASE in v.dims)
    needed = int(1.02 * each * len(plan.cases)) + 2_000_000
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise OSError(28, f"No space left on device (the whole sweep needs {needed >> 20} MiB, {free >> 20} are free)")


def _to_netcdf(dataset: xr.Dataset, path: Path, mode: Any) -> None:
    try:
        dataset.to_netcdf(path, mode=mode, engine="h5netcdf")
    except RuntimeError as error:
        # so does HDF5 say some of what it cannot write
        raise OSError(5, f"the NetCDF library: {str(error).splitlines()[0]}") from None


def _to_zarr(dataset: xr.Dataset, path: Path, mode: Any) -> None:
    # format 3 has no settled way to write texts
    dataset.to_zarr(path, mode=mode, consolidated=True, zarr_format=2)


def _replace(temporary: Path, target: Path) -> None:
    """Into its place at once; of a folder that is already there, as near to that as folders allow."""
    if target.is_dir():
        _remove(target)
    temporary.replace(target)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
