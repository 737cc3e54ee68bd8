"""Traction curves as a labelled xarray data set."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...machines import TwoDiskSolution
from ...numerics.status import Status
from ..labels import labelled
from ..registry import check_converged
from ..variables import CHECK, attributes, checks, common, flags, variable, without_fill


def to_dataset(solution: TwoDiskSolution, dims: Sequence[str] = ()) -> xr.Dataset:
    """Data set of traction curves; see `report.dataset.solution_to_dataset`.

    The dimensions are those of a batch, `dims`, then `temperature`, `entrainment_speed`, `pressure` or `load` and
    `slide_to_roll`. Of pressure and load, the one given in the operation is a dimension, and the other a coordinate
    along it. `out_of_range` shows which range checks of the laws failed.
    """
    dims = tuple(dims)
    if np.ndim(solution.traction_coefficient) != 4 + len(dims):
        batch = np.ndim(solution.traction_coefficient) - 4
        raise ValueError(f"dims: got {len(dims)} names {dims}; the curves are a batch of {batch} dimensions")
    if not dims:
        check_converged(solution)
    loaded = "load" if solution.operation.pressure is None else "pressure"
    axes = ("temperature", "entrainment_speed", loaded, "slide_to_roll")
    names = {"speed": "entrainment_speed", "load": loaded, "slide": "slide_to_roll"}
    dataset = xr.Dataset(attrs=attributes(solution, "Traction curves of a two-disk machine"))
    for path, value, metadata in labelled(solution):
        name = path.removeprefix("operation.")
        if name in dataset:
            # pressure and load are both an input and a result, by Hertz's law
            continue
        # all lanes of a batch must have the same axes
        values = common(np.asarray(value), 1, path) if path != name and dims else value
        dataset[name] = variable(values, metadata, path, dims, names)
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    if solution.range_checks:
        dataset["out_of_range"] = checks(solution, dims)
        words = {"units": "1", "long_name": "what is checked"}
        dataset = dataset.assign_coords({CHECK: xr.Variable((CHECK,), list(solution.range_checks), words)})
    return without_fill(dataset.set_coords([name for name in (*axes, "pressure", "load") if name in dataset]))
