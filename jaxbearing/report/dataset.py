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
    """All results with `units`, `long_name` and `path` on every variable; units as UDUNITS writes them ("rad s-1").

    What a kind of solution has as dimensions and coordinates is said by `to_dataset` of its folder.
    The attributes of the data set hold warnings and notes in words, and the version.

    **Arguments:**
    - `solution`: one solution, or a batch of bearings' from `jax.vmap` or `jax.lax.map`.
    - `dims`: names of the batch's leading dimensions, `("case",)`.

    **Raises:** `ValueError` for a single solution that did not converge, and where `dims` does not fit; `TypeError`
    for another kind of solution.
    """
    return output(solution, "dataset", "data set")(solution, dims)


def write_netcdf(dataset: xr.Dataset | xr.DataTree, path: str | os.PathLike[str]) -> None:
    """Write a NetCDF-4 file, of a tree one group a node, that appears whole or not at all, with checksums: damage to
    its arrays is an error for who reads them. The file is built in memory.

    **Raises:** `OSError` where the place cannot be written; nothing is there then, or what was there before.
    """
    tree = xr.DataTree(dataset) if isinstance(dataset, xr.Dataset) else dataset
    write_whole(path, netcdf_image({node.path: node.to_dataset(inherit=False) for node in tree.subtree}))
