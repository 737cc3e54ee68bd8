"""A bearing's solution as a labelled xarray data set.

Every labelled field of the result classes becomes one variable, with the dimensions given in its annotation: new
results appear here automatically. Names are the paths of the Python results with `_` for the dot (`power_loss_total`,
`ring_radial`), without the prefix `elements_` for results of the rolling elements (`load_inner`); the attribute `path`
keeps the path.

The stiffness has all five degrees of freedom of the ring for every kind of bearing. Its entries have four different
units, listed in the coordinate `stiffness_units`. Entries of degrees of freedom that are not modelled are 0;
`freedom_modelled` marks them.
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
"""Dimensions of the stiffness: derivative of the load along the first with respect to the displacement along the
second."""


def to_dataset(solution: Solution, dims: Sequence[str] = ()) -> xr.Dataset:
    """See `report.dataset.solution_to_dataset`.

    The operating point and the azimuths are coordinates. The attributes `flag_values` and `flag_meanings` of `status`
    explain its values; `out_of_range` marks the laws whose range of validity was left. The attributes of the data set
    hold the warnings and notes as text, the losses that are not modelled, and the version. Results that the scene does
    not model, and inputs that it does not use, are left out.

    **Arguments:**
    - `solution`: one solution, or a batch of them from `jax.vmap` or `jax.lax.map`; the failed lanes of a batch are
      NaN and say why in `status`.
    - `dims`: names of the batch's leading dimensions, `("case",)`. To use the load of a sweep as axis:
      `solution_to_dataset(batch, ("case",)).swap_dims(case="operation_radial_load")`.

    **Raises:** `ValueError` if a single solution did not converge, or if `dims` does not match the batch.
    """
    dims = tuple(dims)
    batch = np.shape(solution.status)
    if len(dims) != len(batch):
        leading = f"{len(batch)} leading dimensions {batch}"
        raise ValueError(f"dims: got {len(dims)} names {dims}; the solution has {leading}")
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
    """Adds operating point, azimuths and names as coordinates."""
    azimuth = dataset["azimuth"]
    if dims:
        try:
            values = common(azimuth.values, 1, "azimuth")
        except ValueError:  # a batch over the azimuth of the first element
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
    coordinates |= _stiffness_coordinates(solution)
    dataset = dataset.drop_vars("azimuth").assign_coords(coordinates | {"azimuth": azimuth})
    return without_fill(dataset.set_coords([n for n in dataset.data_vars if str(n).startswith("operation_")]))


def _stiffness_coordinates(solution: Solution) -> dict[str, xr.Variable]:
    """Coordinates with the units of force and stiffness and the degrees of freedom that are modelled."""
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
