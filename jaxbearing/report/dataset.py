"""A solution as a labelled xarray data set, and as a NetCDF file.

Every field that carries a label in the result classes becomes one variable: a new result appears here without a
change. Names are the paths of the Python result with `_` for the dot (`power_loss_total`, `ring_radial`), also kept in
the attribute `path`; arrays over the rolling elements have their own name (`load_inner`) and the dimension `element`.
"""

import dataclasses
import os
import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import xarray as xr

from .. import __version__
from ..bearings.solution import Solution
from ..numerics.status import Status
from .files import appearing_whole
from .operation import unused_operation

_ELEMENT = "element"
_FREEDOMS = ("freedom", "freedom_displaced")
"""Rows and columns of the stiffness: the load along the first by a displacement along the second."""
_OWN = {"elements": (_ELEMENT,), "stiffness": _FREEDOMS}
"""Dimensions of a field of the solution, or of all that is in it, besides those of a batch."""
_CHECK = "check"
_FACTOR = re.compile(r"([A-Za-z]+)(?:\^([2-9]))?")


def solution_to_dataset(solution: Solution, dims: Sequence[str] = ()) -> xr.Dataset:
    """All results with `units`, `long_name` and `path` on every variable; units as UDUNITS writes them ("rad s-1").

    The operating point and the azimuths are coordinates. `status` has its meanings in the attributes `flag_values`
    and `flag_meanings`; `out_of_range` says which checks of the laws' ranges were left. The attributes of the data
    set hold the same warnings and notes in words, and the version. What the scene does not model, or does not use,
    is left out.

    **Arguments:**
    - `solution`: one solution, or a batch of them from `jax.vmap` or `jax.lax.map`; the failed lanes of a batch are
      NaN and say why in `status`.
    - `dims`: names of the batch's leading dimensions, `("case",)`. To have the load of a sweep as its axis:
      `solution_to_dataset(batch, ("case",)).swap_dims(case="operation_radial_load")`.

    **Raises:** `ValueError` for a single solution that did not converge, and where `dims` does not fit the batch.
    """
    dims = tuple(dims)
    batch = np.shape(solution.status)
    if len(dims) != len(batch):
        found = f"{len(batch)} leading dimensions {batch}"
        raise ValueError(f"dims: got {len(dims)} names {dims}; the solution has {found}")
    if not dims and not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    dataset = xr.Dataset(attrs=_attributes(solution))
    unused = {f"operation.{name}" for name in unused_operation(solution)}
    for path, value, metadata in _labelled(solution):
        if path not in unused:
            name, variable = _variable(path, np.asarray(value), metadata, dims)
            dataset[name] = variable
    dataset["status"].attrs |= _flags(dataset["status"].dtype, [status.text for status in Status])
    dataset["worst_equation"].attrs |= _flags(dataset["worst_equation"].dtype, solution.equation_names)
    if solution.checks:
        dataset["out_of_range"] = _checks(solution, dims)
    return _with_coordinates(dataset, solution, dims)


def write_netcdf(dataset: xr.Dataset, path: str | os.PathLike[str]) -> None:
    """Write a NetCDF-4 file that appears whole or not at all.

    **Raises:** `OSError` where the place cannot be written; nothing is there then, or what was there before.
    """
    with appearing_whole(path) as temporary:
        dataset.to_netcdf(temporary, engine="h5netcdf")


def udunits(unit: str) -> str:
    """A unit of the labels as UDUNITS and the CF conventions write it: "m^3/s" is "m3 s-1".

    **Raises:** `ValueError` for what is not a product of powers over further units.
    """
    over, *under = unit.split("/")
    factors = [(factor, "") for factor in over.split(" ") if over != "1"] + [(factor, "-") for factor in under]
    powers = []
    for factor, sign in factors:
        parted = _FACTOR.fullmatch(factor)
        if parted is None:
            raise ValueError(f"unit {unit!r}: {factor!r} is not a unit with a power, as in 'm^3'")
        powers.append(f"{parted[1]}{sign}{parted[2] or ('1' if sign else '')}")
    return " ".join(powers) or "1"


def _labelled(part: Any, above: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Path, value and label of every field that has a label, at any depth."""
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value):
            yield from _labelled(value, f"{above}{field.name}.")
        elif value is not None and "unit" in field.metadata:
            yield above + field.name, value, field.metadata


def _variable(path: str, value: np.ndarray, metadata: Any, dims: tuple[str, ...]) -> tuple[str, xr.Variable]:
    top, _, rest = path.partition(".")
    own = _OWN.get(top, ())
    # one number for the whole batch, such as the number of unknowns
    leading = dims if value.ndim > len(own) else ()
    attributes = {"units": udunits(metadata["unit"]), "long_name": metadata["description"], "path": path}
    name = rest if own and rest else path.replace(".", "_")
    return name, xr.Variable((*leading, *own), value, attributes)


def _flags(dtype: np.dtype, meanings: Sequence[str]) -> dict[str, Any]:
    words = " ".join(re.sub(r"[^\w-]+", "_", meaning) for meaning in meanings)
    return {"flag_values": np.arange(len(meanings), dtype=dtype), "flag_meanings": words}


def _checks(solution: Solution, dims: tuple[str, ...]) -> xr.Variable:
    broken = np.stack([np.asarray(value) for value in solution.checks.values()], axis=-1).astype(np.int8)
    attributes = {"units": "1", "long_name": "whether a law is used beyond its range", "path": "checks"}
    return xr.Variable((*dims, _CHECK), broken, attributes | _flags(broken.dtype, ("within", "beyond")))


def _with_coordinates(dataset: xr.Dataset, solution: Solution, dims: tuple[str, ...]) -> xr.Dataset:
    """Operating point, azimuths and names as coordinates."""
    azimuth = dataset["azimuth"]
    if dims:
        # the same in all lanes; fmax passes over the NaN of those that failed
        values = np.fmax.reduce(azimuth.values.reshape(-1, azimuth.shape[-1]), axis=0)
        azimuth = xr.DataArray(values, dims=(_ELEMENT,), attrs=azimuth.attrs)
    names = {
        _ELEMENT: (np.arange(azimuth.size), "number of the rolling element, 0 on the load line"),
        _FREEDOMS[0]: (list(solution.ring_freedom), "freedom of the inner ring along which the load acts"),
        _FREEDOMS[1]: (list(solution.ring_freedom), "freedom of the inner ring that is displaced"),
    }
    if solution.checks:
        names[_CHECK] = (list(solution.checks), "what is checked")
    coordinates = {
        name: xr.Variable((name,), values, {"units": "1", "long_name": long_name})
        for name, (values, long_name) in names.items()
    }
    dataset = dataset.drop_vars("azimuth").assign_coords(coordinates | {"azimuth": azimuth})
    dataset = dataset.set_coords([name for name in dataset.data_vars if str(name).startswith("operation_")])
    for coordinate in dataset.coords.values():
        # nothing is missing in a coordinate, and the conventions allow no mark for it
        coordinate.encoding["_FillValue"] = None
    return dataset


def _attributes(solution: Solution) -> dict[str, str]:
    return {
        "Conventions": "CF-1.11",
        "title": "Steady state of a rolling bearing",
        "source": f"jaxbearing {__version__}",
        "jaxbearing_version": __version__,
        "warnings": "\n".join(_broken_checks(solution)),
        "notes": "\n".join(solution.notes),
    }


def _broken_checks(solution: Solution) -> Iterator[str]:
    for text, broken in solution.checks.items():
        lanes = np.asarray(broken)
        if lanes.any():
            yield text if lanes.ndim == 0 else f"{text} ({int(lanes.sum())} of {lanes.size} cases)"
