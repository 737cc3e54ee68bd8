"""Stores of data sets on disk: NetCDF files and Zarr folders."""

import os
from pathlib import Path

import xarray as xr


def opened(store: str | os.PathLike[str]) -> xr.Dataset:
    """The data set of a store, NetCDF or Zarr, without reading its values.

    **Raises:** `OSError`, `ValueError` for what is no such store.
    """
    return xr.open_dataset(store, engine="zarr" if Path(store).is_dir() else "h5netcdf")
