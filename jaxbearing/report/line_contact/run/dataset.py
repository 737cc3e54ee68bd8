"""A line contact in time as a labelled xarray data set."""

import xarray as xr

from ....ehl import LineContactHistory
from ...variables import identity_text, without_fill
from ..dataset import ALONG_X, variables_of


def to_dataset(history: LineContactHistory) -> xr.Dataset:
    """All results of a run: dimensions `time` (every step) and `x`."""
    dataset = variables_of(history, "Film and pressure of a line contact over time", (), ALONG_X)
    dataset.attrs |= {"solver": history.solver, "completed": int(history.completed)}
    dataset.attrs |= identity_text(history.last_state.identity)
    return without_fill(dataset)
