"""Stored results of a sweep: the variables of their data set, as arrays over the cases."""

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
"""Dimensions, or ends of their names, of results that a sweep may leave out."""
MANY = "*"
"""Stands in a path for the names of the parts whose results a variable has side by side."""


def template(structure: AbstractSolution, elements: bool, paths: Sequence[str] = ()) -> xr.Dataset:
    """The data set of one case, with names, units and dimensions but no results.

    **Arguments:** `structure`: a solution with shapes for arrays; `elements`: see `Plan`; `paths`: swept fields.

    **Raises:** `ValueError` for a swept field that has the name of a result in the data set.
    """
    one = jax.tree.map(lambda leaf: np.zeros((1, *leaf.shape), leaf.dtype), structure)
    # a share of nothing, among the results that follow from others, is no news here
    with np.errstate(all="ignore"):
        dataset = solution_to_dataset(one, (CASE,))
    for path in paths:
        result = dataset.variables.get(path.replace(".", "_"))
        if result is not None and result.attrs["path"] != path:
            raise ValueError(f"{path} would have the name of the result {result.attrs['path']} in the data set")
    if "azimuth" in dataset and "geometry.first_element_angle" in paths:
        # elsewhere in each case
        dataset = dataset.assign_coords(azimuth=dataset["azimuth"].expand_dims({CASE: 1}))
    if not elements:
        dataset = dataset.drop_dims(sorted(str(name) for name in dataset.dims if str(name).endswith(_EACH)))
    return dataset


def per_case(dataset: xr.Dataset) -> list[str]:
    """Names of the variables with a value for each case."""
    return [str(name) for name, variable in dataset.variables.items() if CASE in variable.dims]


def columns(solution: AbstractSolution, labels: xr.Dataset) -> dict[str, np.ndarray]:
    """Variables of a batch of solutions: those of each case, and those that all cases share but a template lacks."""
    if any(MANY in variable.attrs.get("path", "") for variable in labels.variables.values()):
        return _by_name(solution, labels)
    found = {}
    for name, variable in labels.variables.items():
        path = variable.attrs.get("path", "")
        if path == "checks":
            found[str(name)] = checks(solution, (CASE,)).values
        elif path:
            values = np.asarray(functools.reduce(getattr, path.split("."), solution))
            if CASE in variable.dims:
                # the scene's own number stands for all lanes
                found[str(name)] = np.broadcast_to(values, (len(converged(solution)), *values.shape[1:]))
            elif values.ndim > variable.ndim:
                found[str(name)] = common(values, variable.ndim, str(name))
    return found


def _by_name(solution: AbstractSolution, labels: xr.Dataset) -> dict[str, np.ndarray]:
    """The same as `columns`, of a solution whose variables are put together from many parts."""
    lanes, found = len(converged(solution)), {}
    with np.errstate(all="ignore"):
        dataset = solution_to_dataset(solution, (CASE,))
    for name, variable in labels.variables.items():
        if not variable.attrs.get("path", ""):
            continue
        values = dataset[name].values
        if CASE in variable.dims:
            found[str(name)] = np.broadcast_to(values, (lanes, *values.shape[1:]))
        elif values.ndim > variable.ndim:
            found[str(name)] = common(values, variable.ndim, str(name))
    return found


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
