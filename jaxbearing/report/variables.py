"""Variables of a data set, with dimensions and attributes, from the labels of result fields."""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from .._identity import Identity
from .._scene import AbstractSolution
from .._version import __version__
from .labels import udunits

CHECK = "check"
"""Name of the dimension of the range checks of the laws."""


def variable(
    value: object,
    metadata: Mapping[str, Any],
    path: str,
    leading: Sequence[str] = (),
    names: Mapping[str, str] | None = None,
) -> xr.Variable:
    """A result as a variable, with the dimensions of its label.

    **Arguments:**
    - `leading`: dimensions of a batch; a value that the whole batch shares, such as the number of unknowns, has none of
      them.
    - `names`: dimension of the label -> its name in the data set, where they differ.
    """
    values, renamed = np.asarray(value), names or {}
    own = [renamed.get(name, name) for name in metadata["dims"]]
    return xr.Variable((*(leading if values.ndim > len(own) else ()), *own), values, described(metadata, path))


def described(metadata: Mapping[str, str], path: str) -> dict[str, str]:
    """Attributes of a variable from the label of its field."""
    return {"units": udunits(metadata["unit"]), "long_name": metadata["description"], "path": path}


def flags(dtype: np.dtype, meanings: Sequence[str]) -> dict[str, Any]:
    """Attributes of an enumeration: its values and their meanings."""
    words = " ".join(re.sub(r"[^\w-]+", "_", meaning) for meaning in meanings)
    return {"flag_values": np.arange(len(meanings), dtype=dtype), "flag_meanings": words}


def checks(solution: AbstractSolution, dims: tuple[str, ...]) -> xr.Variable:
    """The range checks of the laws as a variable: 1 if a law is used beyond its range."""
    broken = np.stack([np.asarray(value) for value in solution.range_checks.values()], axis=-1).astype(np.int8)
    attributes = {"units": "1", "long_name": "whether a law is used beyond its range", "path": "checks"}
    return xr.Variable((*dims, CHECK), broken, attributes | flags(broken.dtype, ("within", "beyond")))


def common(values: np.ndarray, own: int, name: str) -> np.ndarray:
    """The value that all lanes of a batch share; NaN of failed lanes is ignored.

    **Arguments:** `own`: number of dimensions of the value, after those of the batch.

    **Raises:** `ValueError` if the lanes differ.
    """
    lanes = values.reshape(-1, *values.shape[values.ndim - own :])
    # fmax and fmin pass over NaN
    shared = np.fmax.reduce(lanes, axis=0)
    if not np.array_equal(shared, np.fmin.reduce(lanes, axis=0), equal_nan=True):
        raise ValueError(f"{name}: the lanes of the batch have different ones")
    return shared


def without_fill(dataset: xr.Dataset) -> xr.Dataset:
    """Removes `_FillValue` from coordinates, which have no missing values; the CF conventions forbid it there."""
    for coordinate in dataset.coords.values():
        coordinate.encoding["_FillValue"] = None
    return dataset


def attributes(solution: AbstractSolution, title: str) -> dict[str, str]:
    """Attributes of the data set: title, version, warnings and notes."""
    return {
        "Conventions": "CF-1.11",
        "title": title,
        "source": f"jaxbearing {__version__}",
        "jaxbearing_version": __version__,
        "warnings": "\n".join(_broken_checks(solution)),
        "notes": "\n".join(solution.notes),
    }


NODES = "nodes"
"""Attribute in the file of a transient run of temperatures: names of the nodes, separated by commas."""
IDENTITY = "scene_identity"
"""Attribute in the file of a transient run: identity of the bearing or contact, as JSON."""


def identity_text(identity: Identity | None) -> dict[str, str]:
    """The identity of a scene as an attribute of a data set; empty without one."""
    return {} if identity is None else {IDENTITY: json.dumps(identity.told())}


def _broken_checks(solution: AbstractSolution) -> Iterator[str]:
    for text, broken in solution.range_checks.items():
        lanes = np.asarray(broken)
        if lanes.any():
            yield text if lanes.ndim == 0 else f"{text} ({int(lanes.sum())} of {lanes.size} cases)"
