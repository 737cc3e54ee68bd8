"""A solution as a labelled xarray data set, whatever its kind, and as a NetCDF file."""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import xarray as xr

from .backends.netcdf import netcdf_image
from .files import write_whole
from .registry import output

if TYPE_CHECKING:
    from .._scene import AbstractSolution


def solution_to_dataset(solution: "AbstractSolution", dims: Sequence[str] = ()) -> xr.Dataset:
    """All results, with the attributes `units`, `long_name` and `path` on every variable; units in UDUNITS notation
    ("rad s-1").

    The function `to_dataset` for each kind of solution documents its dimensions and coordinates. The attributes of the
    data set hold warnings and notes as text, and the version.

    **Arguments:**
    - `solution`: one solution, or a batch of bearing solutions from `jax.vmap` or `jax.lax.map`.
    - `dims`: names of the batch's leading dimensions, `("case",)`.

    **Raises:** `ValueError` if a single solution did not converge, or if `dims` does not match the batch; `TypeError`
    for another kind of solution.
    """
    return output(solution, "dataset", "data set")(solution, dims)


def write_netcdf(dataset: xr.Dataset | xr.DataTree, path: str | os.PathLike[str]) -> None:
    """Writes a NetCDF-4 file, with one group for each node of a tree. The file is built in memory and appears whole or
    not at all; it has checksums, so that reading damaged arrays raises an error.

    **Raises:** `OSError` if the file cannot be written; an earlier file at `path` then stays as it was.
    """
    tree = xr.DataTree(dataset) if isinstance(dataset, xr.Dataset) else dataset
    write_whole(path, netcdf_image({node.path: node.to_dataset(inherit=False) for node in tree.subtree}))
