"""A line contact as a labelled xarray data set."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ..._scene import AbstractSolution
from ...ehl import LineContactSolution
from ...numerics.status import Status
from ..labels import labelled
from ..registry import check_converged
from ..variables import CHECK, attributes, checks, flags, variable, without_fill

ALONG_X = {"node": "x"}
"""Renames the dimension `node` to `x` if all profiles have the same nodes, with `x` as coordinate."""


def to_dataset(solution: LineContactSolution, dims: Sequence[str] = ()) -> xr.Dataset:
    """Data set of one solution or of a batch; see `report.dataset.solution_to_dataset`.

    The dimension of the profile is `x`. In a batch it is `node`, and `x` is a coordinate along it, with other values in
    each lane.
    """
    dims = tuple(dims)
    if np.ndim(solution.status) != len(dims):
        batch = np.ndim(solution.status)
        raise ValueError(f"dims: got {len(dims)} names {dims}; the solution is a batch of {batch} dimensions")
    if not dims:
        check_converged(solution)
    dataset = variables_of(solution, "Film and pressure of a line contact", dims, {} if dims else ALONG_X)
    if dims:
        dataset = dataset.set_coords("x")
        dataset["out_of_range"] = checks(solution, dims)
        words = {"units": "1", "long_name": "what is checked"}
        dataset = dataset.assign_coords({CHECK: xr.Variable((CHECK,), list(solution.range_checks), words)})
    return without_fill(dataset)


def variables_of(result: AbstractSolution, title: str, along: tuple[str, ...], names: dict[str, str]) -> xr.Dataset:
    """Data set of the results of a solve or a transient run; the operating point becomes coordinates.

    **Arguments:** `title`: of the data set; `along`: dimensions of a batch; `names`: dimension of a label -> its name
    in the data set.
    """
    dataset = xr.Dataset(attrs=attributes(result, title))
    for path, value, metadata in labelled(result):
        name = "x" if path == "profile.x" else path.replace(".", "_")
        dataset[name] = variable(value, metadata, path, along, names)
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    return dataset.set_coords([name for name in dataset if str(name).startswith("operation_")])
