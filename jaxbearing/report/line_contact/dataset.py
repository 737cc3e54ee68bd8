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
"""Name of the dimension of profiles that all have the same nodes: their places."""


def to_dataset(solution: LineContactSolution, dims: Sequence[str] = ()) -> xr.Dataset:
    """See `report.dataset.solution_to_dataset`. The profile has the dimension `x`; in a batch it is `node`, and `x` a
    coordinate along it that differs from lane to lane."""
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
    """The results of a solve or a run, and its operating point.

    **Arguments:** `along`: dimensions of a batch; `names`: other names for dimensions of the labels.
    """
    dataset = xr.Dataset(attrs=attributes(result, title))
    for path, value, metadata in labelled(result):
        name = "x" if path == "profile.x" else path.replace(".", "_")
        dataset[name] = variable(value, metadata, path, along, names)
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    return dataset.set_coords([name for name in dataset if str(name).startswith("operation_")])
