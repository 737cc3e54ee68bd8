"""Gathers the chunks of a sweep in one labelled store, variable by variable, with one of them in memory at a time."""

import contextlib
import math
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import xarray as xr

from ..numerics.interrupts import deferred_interrupts
from ..report.backends.netcdf import NetcdfStream
from ..report.variables import CHECK, without_fill
from .chunks import KEY, labels_of, read_chunk
from .labels import CASE, FAILURE, per_case
from .plan import Plan

Progress = Callable[[int, int], None]
STORES = (".nc", ".zarr")


def store(
    plan: Plan, folder: Path, target: Path, progress: Callable[[int, int], None] = lambda done, total: None
) -> None:
    """Write the whole sweep, as NetCDF or Zarr by the suffix, into the folder of the chunks, and move it to `target`.

    A grid has one dimension for each field, named like its coordinate (`operation_inner_speed`); other sweeps have the
    dimension `case`.

    **Raises:** `OSError`, which leaves `target` as it was or removed, but never incomplete; `DamagedChunkError`.
    """
    labels = _labels(plan)
    _require_space(plan, labels, folder)
    temporary = folder / f"gathered{target.suffix.lower()}"
    _remove(temporary)
    try:
        with deferred_interrupts(), (_Zarr if target.suffix.lower() == ".zarr" else _Netcdf)(temporary) as made:
            for done, (dataset, total) in enumerate(_pieces(plan, folder, labels)):
                made.add(dataset)
                progress(done + 1, total)
        _replace(temporary, target)
    except BaseException:
        _remove(temporary)
        raise


def _labels(plan: Plan) -> xr.Dataset:
    labels = labels_of(plan).copy()
    labels.attrs |= {"title": f"{labels.attrs['title']}, sweep of {plan.label}", KEY: plan.key}
    labels.attrs |= {"sweep_kind": plan.cases.kind, "sweep_fields": " ".join(plan.cases.paths)}
    return labels


def _pieces(plan: Plan, folder: Path, labels: xr.Dataset) -> Iterator[tuple[xr.Dataset, int]]:
    """Yields small data sets that together make the whole one, each with their total number: first coordinates and
    values common to all cases, then each variable. All have the same attributes, because Zarr keeps those of the last.
    """
    axes = _axes(plan)
    dims = tuple(axes) if plan.cases.kind == "grid" else (CASE,)
    names = [name for name in per_case(labels) if name not in axes]
    whole = lambda name: _column(plan, folder, name).reshape(*plan.cases.shape, *labels[name].shape[1:])
    shared = labels.drop_vars(per_case(labels))
    for name in _lacking(plan, folder, shared):
        parts = [read_chunk(folder, i, plan.key, [name])[name] for i in range(plan.chunks)]
        shared[name] = shared[name].copy(data=np.fmax.reduce(parts))
    shared = shared.assign_coords(axes)
    for name in [name for name in names if name in labels.coords]:
        values, variable = whole(name), labels[name].variable
        alike = _one_value(values) if variable.ndim == 1 else None
        there = ((*dims, *variable.dims[1:]), values) if alike is None else ((), alike)
        shared = shared.assign_coords({name: xr.Variable(*there, variable.attrs)})
    if "out_of_range" in names:
        texts = [str(text) for text in labels[CHECK].values]
        shared.attrs["warnings"] = "\n".join(_warnings(whole("out_of_range"), texts))
    results = [name for name in names if name not in labels.coords]
    total = len(results) + 2
    yield _tidy(shared), total
    words = {"units": "1", "long_name": "why a case has no results; empty where it has"}
    failure = _column(plan, folder, FAILURE).astype(object).reshape(plan.cases.shape)
    yield xr.Dataset({FAILURE: xr.Variable(dims, failure, words)}, attrs=shared.attrs), total
    for name in results:
        variable = labels[name].variable
        full = xr.Variable((*dims, *variable.dims[1:]), whole(name), variable.attrs)
        yield xr.Dataset({name: full}, attrs=shared.attrs), total


def _lacking(plan: Plan, folder: Path, shared: xr.Dataset) -> list[str]:
    """Names of variables common to all cases whose values only a solve gives, such as the azimuths; the values are NaN
    in a chunk without a solved case."""
    kept = read_chunk(folder, 0, plan.key)
    return [str(name) for name in shared.variables if str(name) in kept]


def _one_value(values: np.ndarray) -> np.ndarray | None:
    """The common value of all cases with a finite value; `None` if they differ or none is finite."""
    finite = values[np.isfinite(values)]
    return finite[0] if finite.size and np.all(finite == finite[0]) else None


def _tidy(dataset: xr.Dataset) -> xr.Dataset:
    """The data set with its texts as objects, so that they may have any length."""
    for name, variable in dataset.variables.items():
        if variable.dtype.kind == "U":
            dataset[name] = variable.copy(data=variable.values.astype(object))
    return dataset


def _name_of(path: str) -> str:
    return path.replace(".", "_")


def _axes(plan: Plan) -> dict[str, xr.Variable]:
    """The swept fields as coordinates: along the axes of a grid, or along the cases."""
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


def _warnings(broken: np.ndarray, texts: list[str]) -> Iterator[str]:
    lanes = broken.reshape(-1, broken.shape[-1])
    for text, count in zip(texts, lanes.sum(axis=0), strict=True):
        if count:
            yield f"{text} ({int(count)} of {len(lanes)} cases)"


def _require_space(plan: Plan, labels: xr.Dataset, folder: Path) -> None:
    """Checks that there is room on the disk before anything is written.

    **Raises:** `OSError` if there is not.
    """
    each = sum(v.dtype.itemsize * math.prod(v.shape) for v in labels.variables.values() if CASE in v.dims)
    needed = int(1.02 * each * len(plan.cases)) + 2_000_000
    free = shutil.disk_usage(folder).free
    if free < needed:
        raise OSError(28, f"No space left on device (the whole sweep needs {needed >> 20} MiB, {free >> 20} are free)")


class _Netcdf(NetcdfStream):
    def add(self, dataset: xr.Dataset) -> None:
        # Zarr's coordinates keep their mark: without one their zeros would be taken for it
        super().add(without_fill(dataset))


class _Zarr(contextlib.AbstractContextManager["_Zarr", None]):
    def __init__(self, path: Path):
        self._path = path

    def __exit__(self, *error: object) -> None:
        pass

    def add(self, dataset: xr.Dataset) -> None:
        mode = "a" if self._path.exists() else "w"
        # format 3 has no settled way to write texts
        dataset.drop_encoding().to_zarr(self._path, mode=mode, consolidated=True, zarr_format=2)


def _replace(temporary: Path, target: Path) -> None:
    """Moves the result to its place in one step, or in two if a folder is already there."""
    if target.is_dir():
        _remove(target)
    temporary.replace(target)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
