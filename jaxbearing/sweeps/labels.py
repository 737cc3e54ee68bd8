"""Stored results of a sweep: the variables of its data set, as arrays over the cases."""

import functools
from collections.abc import Sequence

import jax
import numpy as np
import xarray as xr

from .._scene import AbstractSolution
from ..numerics.status import Status
from ..report.dataset import solution_to_dataset
from ..report.variables import checks, common

CASE = "case"
FAILURE = "failure"
_EACH = ("element", "node")
"""Endings of the names of dimensions whose results a sweep may leave out."""
MANY = "*"
"""Placeholder in a path for the names of several parts, whose results are side by side in one variable."""


def template(structure: AbstractSolution, elements: bool, paths: Sequence[str] = ()) -> xr.Dataset:
    """The data set of one case, with names, units and dimensions but no results.

    **Arguments:** `structure`: a solution with shapes in place of arrays; `elements`: see `Plan`; `paths`: swept
    fields.

    **Raises:** `ValueError` for a swept field whose name in the data set is that of a result.
    """
    case = jax.tree.map(lambda leaf: np.zeros((1, *leaf.shape), leaf.dtype), structure)
    # derived results such as shares divide by the zeros that stand for results here
    with np.errstate(all="ignore"):
        dataset = solution_to_dataset(case, (CASE,))
    for path in paths:
        result = dataset.variables.get(path.replace(".", "_"))
        if result is not None and result.attrs["path"] != path:
            raise ValueError(f"{path} would have the name of the result {result.attrs['path']} in the data set")
    if "azimuth" in dataset and "geometry.first_element_angle" in paths:
        # it differs from case to case
        dataset = dataset.assign_coords(azimuth=dataset["azimuth"].expand_dims({CASE: 1}))
    if not elements:
        dataset = dataset.drop_dims(sorted(str(name) for name in dataset.dims if str(name).endswith(_EACH)))
    return dataset


def per_case(dataset: xr.Dataset) -> list[str]:
    """Names of the variables with a value for each case."""
    return [str(name) for name, variable in dataset.variables.items() if CASE in variable.dims]


def columns(solution: AbstractSolution, labels: xr.Dataset) -> dict[str, np.ndarray]:
    """Variables of a batch of solutions: those with a value for each case, and those common to all cases that the
    template does not have."""
    if any(MANY in variable.attrs.get("path", "") for variable in labels.variables.values()):
        return _by_name(solution, labels)
    arrays = {}
    for name, variable in labels.variables.items():
        path = variable.attrs.get("path", "")
        if path == "checks":
            arrays[str(name)] = checks(solution, (CASE,)).values
        elif path:
            values = np.asarray(functools.reduce(getattr, path.split("."), solution))
            if CASE in variable.dims:
                # the scene's own number stands for all lanes
                arrays[str(name)] = np.broadcast_to(values, (len(converged(solution)), *values.shape[1:]))
            elif values.ndim > variable.ndim:
                arrays[str(name)] = common(values, variable.ndim, str(name))
    return arrays


def _by_name(solution: AbstractSolution, labels: xr.Dataset) -> dict[str, np.ndarray]:
    """The result of `columns` for a solution whose variables are assembled from many parts."""
    lanes, arrays = len(converged(solution)), {}
    with np.errstate(all="ignore"):
        dataset = solution_to_dataset(solution, (CASE,))
    for name, variable in labels.variables.items():
        if not variable.attrs.get("path", ""):
            continue
        values = dataset[name].values
        if CASE in variable.dims:
            arrays[str(name)] = np.broadcast_to(values, (lanes, *values.shape[1:]))
        elif values.ndim > variable.ndim:
            arrays[str(name)] = common(values, variable.ndim, str(name))
    return arrays


def converged(solution: AbstractSolution) -> np.ndarray:
    """True for each lane that converged, shape (lane,)."""
    status = np.asarray(solution.status)
    return np.all(status == Status.CONVERGED, axis=tuple(range(1, status.ndim)))


def failures(solution: AbstractSolution, reasons: list[str]) -> np.ndarray:
    """The reason why each lane failed, in a sentence; "" if it did not fail."""
    texts = list(reasons)
    for lane in np.flatnonzero(~converged(solution)):
        texts[lane] = texts[lane] or jax.tree.map(lambda leaf, lane=lane: leaf[lane], solution).failure()
    return np.asarray(texts, dtype=np.str_)
