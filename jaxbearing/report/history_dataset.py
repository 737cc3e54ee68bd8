"""A run in time as a labelled xarray data set.

Every field that carries a label in the result classes becomes one variable, as in `bearing.dataset`; those of an
instant have the dimension `time`, arrays over the rolling elements (`load_inner`) `time` and `element`. `state_rollers`
and `state_cage` are the state itself, in SI units and in the frame of the run.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from ..bearings.history import History
from ..numerics.status import Status
from .labelled import attributes, described, flags, labelled, without_fill

_STATES = {
    "state_rollers": ("roller_state", ("q", "v", "u")),
    "state_cage": ("cage_state", ("x", "y", "q", "v_x", "v_y", "v")),
}


def history_to_dataset(history: History) -> xr.Dataset:
    """All results of a run with `units`, `long_name` and `path` on every variable."""
    dataset = xr.Dataset(attrs=attributes(history, "Motion of a rolling bearing"))
    dataset.attrs |= {"solver": history.solver, "completed": int(history.completed)}
    for path, value, metadata in _labels(history):
        values = np.asarray(value)
        name, dims = path.removeprefix("elements.").replace(".", "_"), ("time",)
        if path in _STATES:
            dims = ("time", "roller_state", "element") if path == "state_rollers" else ("time", "cage_state")
        elif path.startswith("elements."):
            dims = ("time", "element")
        elif values.ndim == 0:
            dims = ()
        dataset[name] = xr.Variable(dims, values, described(metadata, path))
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    count = dataset.sizes["element"]
    names = {"element": (np.arange(count), "number of the rolling element, 0 on the load line at the start")}
    names |= {dim: (list(parts), "component of the state") for dim, parts in _STATES.values()}
    coordinates = {
        dim: xr.Variable((dim,), values, {"units": "1", "long_name": text}) for dim, (values, text) in names.items()
    }
    dataset = dataset.assign_coords(coordinates).set_coords([n for n in dataset if str(n).startswith("operation_")])
    return without_fill(dataset)


def _labels(history: History) -> Iterator[tuple[str, Any, Any]]:
    for path, value, metadata in labelled(history):
        yield path.removeprefix("instants."), value, metadata
