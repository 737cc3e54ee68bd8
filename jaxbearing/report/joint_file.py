"""NetCDF files of joint distributions: written by `calibrate --out`, read by `tolerances --posterior`."""

import os
from collections.abc import Mapping

import numpy as np
import xarray as xr

from .._version import __version__
from ..joint import JointDistribution
from ..scenes.input_files import check_regular
from .dataset import write_netcdf

_NEEDED = ("centre", "positive", "covariance")


def write_joint(joint: JointDistribution, units: Mapping[str, str], path: str | os.PathLike[str], title: str) -> None:
    """Writes a joint distribution. **Arguments:** `units`: SI unit of each field. **Raises:** `OSError`."""
    label = lambda text: {"units": "see field_units", "long_name": text}
    made = xr.Dataset(
        {
            "centre": ("field", joint.centre, label("median of positive numbers, mean of others")),
            "positive": ("field", joint.positive.astype(np.int8), {"units": "1", "long_name": "1: logarithm scatters"}),
            "covariance": (
                ("field", "other_field"),
                joint.covariance,
                {"units": "of the coordinates", "long_name": "covariance of logarithms of positive numbers, of others"},
            ),
        },
        coords={
            "field": ("field", list(joint.fields), {"units": "1", "long_name": "field of the scene"}),
            "other_field": ("other_field", list(joint.fields), {"units": "1", "long_name": "field of the scene"}),
            "field_units": ("field", [units[path_] for path_ in joint.fields], {"units": "1", "long_name": "SI unit"}),
        },
        attrs={"title": title, "source": f"jaxbearing {__version__}", "jaxbearing_version": __version__},
    )
    if joint.samples is not None:
        made["samples"] = (("sample", "field"), joint.samples, label("samples of the posterior"))
    write_netcdf(made, path)


def read_joint(path: str | os.PathLike[str]) -> JointDistribution:
    """Reads a file written by `write_joint`.

    **Raises:** `ValueError`, with the name of the file, if the file does not exist or holds no joint distribution.
    """
    name = os.fspath(path)
    try:
        check_regular(name)
        with xr.open_dataset(name, engine="h5netcdf") as dataset:
            missing = [needed for needed in (*_NEEDED, "field") if needed not in dataset.variables]
            if missing:
                raise ValueError(f"found no {missing[0]}; expected the file that 'jaxbearing calibrate --out' writes")
            samples = np.asarray(dataset["samples"].values) if "samples" in dataset else None
            return JointDistribution(
                tuple(str(field) for field in dataset["field"].values),
                np.asarray(dataset["centre"].values, dtype=np.float64),
                np.asarray(dataset["positive"].values) != 0,
                np.asarray(dataset["covariance"].values, dtype=np.float64),
                samples,
            )
    except OSError as error:
        raise ValueError(f"{name}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
