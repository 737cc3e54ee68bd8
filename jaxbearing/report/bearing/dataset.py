"""A bearing's solution as a labelled xarray data set.

Every field that carries a label in the result classes becomes one variable, with the dimensions that its annotation
says: a new result appears here without a change. Names are the paths of the Python result with `_` for the dot
(`power_loss_total`, `ring_radial`), also kept in the attribute `path`; results of the rolling elements go without the
prefix `elements_` (`load_inner`).

The stiffness has all five degrees of freedom of the ring in each kind of bearing. Its entries have four units, of
which a variable can name one only: they stand in the coordinate `stiffness_units`. Degrees of freedom that the model
does not have are 0 there, and `freedom_modelled` says which they are.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from ...bearings.solution import RING_FREEDOMS, Solution, force_units, stiffness_units
from ...numerics.status import Status
from ..labels import labelled, udunits, variable_name
from ..registry import check_converged
from ..variables import CHECK, attributes, checks, common, flags, variable, without_fill
from .operation import unused_operation

_ELEMENT = "element"
_FREEDOMS = ("freedom", "freedom_displaced")
"""Rows and columns of the stiffness: the load along the first by a displacement along the second."""


def to_dataset(solution: Solution, dims: Sequence[str] = ()) -> xr.Dataset:
    """See `report.dataset.solution_to_dataset`.

    The operating point and the azimuths are coordinates. `status` has its meanings in the attributes `flag_values`
    and `flag_meanings`; `out_of_range` says which checks of the laws' ranges were left. The attributes of the data
    set hold the same warnings and notes in words, the losses that are not modelled, and the version. What the scene
    does not model, or does not use, is left out.

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
    if not dims:
        check_converged(solution)
    words = attributes(solution, "Steady state of a rolling bearing")
    words |= {"not_modelled": ", ".join(solution.not_modelled)}
    words |= {} if solution.supply is None else {"oil_supply": solution.supply.stated}
    dataset = xr.Dataset(attrs=words)
    unused = {f"operation.{name}" for name in unused_operation(solution)}
    for path, value, metadata in labelled(solution):
        if path not in unused:
            dataset[variable_name(path)] = variable(value, metadata, path, dims)
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    dataset["worst_equation"].attrs |= flags(dataset["worst_equation"].dtype, solution.equation_names)
    if solution.range_checks:
        dataset["out_of_range"] = checks(solution, dims)
    return _with_coordinates(dataset, solution, dims)


def _with_coordinates(dataset: xr.Dataset, solution: Solution, dims: tuple[str, ...]) -> xr.Dataset:
    """Operating point, azimuths and names as coordinates."""
    azimuth = dataset["azimuth"]
    if dims:
        try:
            values = common(azimuth.values, 1, "azimuth")
        except ValueError:  # a batch over the place of the first element
            pass
        else:
            azimuth = xr.DataArray(values, dims=(_ELEMENT,), attrs=azimuth.attrs)
    numbers = np.arange(azimuth.sizes[_ELEMENT])
    names = {
        _ELEMENT: (numbers, "number of the rolling element; azimuth says where it is"),
        _FREEDOMS[0]: (list(RING_FREEDOMS), "freedom of the inner ring along which the load acts"),
        _FREEDOMS[1]: (list(RING_FREEDOMS), "freedom of the inner ring that is displaced"),
    }
    if solution.range_checks:
        names[CHECK] = (list(solution.range_checks), "what is checked")
    coordinates = {
        name: xr.Variable((name,), values, {"units": "1", "long_name": long_name})
        for name, (values, long_name) in names.items()
    }
    coordinates |= _of_stiffness(solution)
    dataset = dataset.drop_vars("azimuth").assign_coords(coordinates | {"azimuth": azimuth})
    return without_fill(dataset.set_coords([n for n in dataset.data_vars if str(n).startswith("operation_")]))


def _of_stiffness(solution: Solution) -> dict[str, xr.Variable]:
    """Units of the entries of the stiffness, and which degrees of freedom the model has."""
    units = [[udunits(unit) for unit in row] for row in stiffness_units()]
    modelled = np.asarray([name in solution.freedoms_of_stiffness for name in RING_FREEDOMS], dtype=np.int8)
    words = {
        "units": "1",
        "long_name": "whether the model has this freedom; entries of force and stiffness are 0 where not",
    }
    meanings = flags(modelled.dtype, ("not modelled", "modelled"))
    return {
        "force_units": xr.Variable(
            _FREEDOMS[:1],
            [udunits(unit) for unit in force_units()],
            {"units": "1", "long_name": "unit of an entry of force"},
        ),
        "stiffness_units": xr.Variable(_FREEDOMS, units, {"units": "1", "long_name": "unit of an entry of stiffness"}),
        "freedom_modelled": xr.Variable(_FREEDOMS[:1], modelled, words | meanings),
    }
