"""A run of the temperatures of a bearing as a labelled xarray data set.

Every field that carries a label in the result classes becomes one variable; those of an instant have the dimension
`time`. The temperatures at the last instant are the state from which another run can go on.
"""

import xarray as xr

from ....bearings.warming.history import WarmUpHistory
from ....numerics.status import Status
from ...labels import labelled
from ...variables import NODES, attributes, flags, identity_text, variable, without_fill


def to_dataset(history: WarmUpHistory) -> xr.Dataset:
    """All results of a run with `units`, `long_name` and `path` on every variable."""
    dataset = xr.Dataset(attrs=attributes(history, "Temperatures of a rolling bearing over time"))
    dataset.attrs |= {"solver": history.solver, "completed": int(history.completed)} | identity_text(history.identity)
    dataset.attrs |= {"not_modelled": ", ".join(history.not_modelled), NODES: ",".join(history.nodes)}
    for path, value, metadata in labelled(history):
        short = path.removeprefix("instants.")
        dataset[short.replace(".", "_")] = variable(value, metadata, short, () if short == path else ("time",))
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    return without_fill(dataset.set_coords([name for name in dataset if str(name).startswith("operation_")]))
