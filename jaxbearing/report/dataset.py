"""A solution as a labelled xarray data set, whatever its kind, and as a NetCDF file."""

import functools
import os
from collections.abc import Sequence
from typing import Any

import xarray as xr

from ..bearings.solution import Solution
from ..ehl import LineContactSolution
from ..machines import TwoDiskSolution
from .bearing.dataset import bearing_to_dataset
from .files import appearing_whole
from .labelled import udunits as udunits
from .line_contact.dataset import line_contact_to_dataset
from .two_disk.dataset import two_disk_to_dataset


@functools.singledispatch
def solution_to_dataset(solution: Any, dims: Sequence[str] = ()) -> xr.Dataset:
    """All results with `units`, `long_name` and `path` on every variable; units as UDUNITS writes them ("rad s-1").

    What a kind of solution has as dimensions and coordinates is said by `bearing_to_dataset` and `two_disk_to_dataset`.
    The attributes of the data set hold warnings and notes in words, and the version.

    **Arguments:**
    - `solution`: one solution, or a batch of bearings' from `jax.vmap` or `jax.lax.map`.
    - `dims`: names of the batch's leading dimensions, `("case",)`.

    **Raises:** `ValueError` for a single solution that did not converge, and where `dims` does not fit; `TypeError`
    for another kind of solution.
    """
    raise TypeError(f"no data set of a {type(solution).__name__}")


solution_to_dataset.register(Solution, bearing_to_dataset)
solution_to_dataset.register(TwoDiskSolution, two_disk_to_dataset)
solution_to_dataset.register(LineContactSolution, line_contact_to_dataset)


def write_netcdf(dataset: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a NetCDF-4 file that appears whole or not at all, with checksums: damage to its arrays is an error for who
    reads them.

    **Raises:** `OSError` where the place cannot be written; nothing is there then, or what was there before.
    """
    checked = dataset.copy()
    for variable in checked.variables.values():
        if variable.ndim and variable.size and variable.dtype.kind in "fiu":
            variable.encoding["fletcher32"] = True
    with appearing_whole(path) as temporary:
        checked.to_netcdf(temporary, engine="h5netcdf")
