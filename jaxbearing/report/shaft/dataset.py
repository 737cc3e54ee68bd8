"""Solution of a shaft as a labelled xarray data set.

Results that all bearings have get the dimension `bearing`. Results of a bearing's own family are separate variables,
prefixed with the name of the bearing (`rear_load_inner` over `rear_element`). The dimension `node` runs along the
shaft, `set` over the sets. A dot in the name of a bearing becomes `_`, unless two results would then have the same
name: see `fronts`.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import jax
import numpy as np
import xarray as xr

from ...bearings.solution import RING_FREEDOMS, Solution, force_units, stiffness_units
from ...numerics.status import Status
from ...shafts.solution import ShaftSolution
from ..bearing.dataset import to_dataset as bearing_dataset
from ..labels import labelled, udunits, variable_name
from ..registry import check_converged
from ..variables import CHECK, attributes, checks, flags, variable, without_fill

_VECTORS = {
    "force": ("freedom",),
    "on_shaft": ("freedom",),
    "outer": ("freedom",),
    "stiffness": ("freedom", "freedom_displaced"),
}
"""Results of a bearing that are vectors or matrices -> their dimensions."""
_OWN = ("ring_", "force", "stiffness", "operation_", "life_", "freedom")
"""Beginnings of variable names in the data set of a single bearing that are not taken over: on a shaft these results
have another meaning."""


def to_dataset(solution: ShaftSolution, dims: Sequence[str] = ()) -> xr.Dataset:
    """Data set of a shaft's solution; see `report.dataset.solution_to_dataset`.

    **Raises:** `ValueError` for a single solution that did not converge, and if `dims` does not fit the batch.
    """
    dims = tuple(dims)
    batch = np.shape(solution.status)
    if len(dims) != len(batch):
        raise ValueError(
            f"dims: got {len(dims)} names {dims}; the solution has {len(batch)} leading dimensions {batch}"
        )
    if not dims:
        check_converged(solution)
    dataset = xr.Dataset(attrs=attributes(solution, "Steady state of a shaft on bearings"))
    for name, array in _variables(solution, dims):
        assert name not in dataset.variables, name
        dataset[name] = array
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    if solution.range_checks:
        dataset["out_of_range"] = checks(solution, dims)
    return without_fill(dataset.assign_coords(_coordinates(solution)))


def fronts(solution: ShaftSolution, dims: tuple[str, ...] = ()) -> dict[str, str]:
    """Name of each bearing -> prefix of the names of its own results: `front_1_` for bearing `front.1`.

    Where two results would get the same name, as with a bearing `front_1` beside the set `front`, the prefix is the
    unchanged name with a dot: `front.1.load_inner` and `front_1.load_inner`. The solution may be traced, because only
    names and shapes are used.
    """
    families = {name: bearing.solution for name, bearing in solution.bearings.items() if bearing.solution is not None}
    flat = {name: f"{name.replace('.', '_')}_" for name in families}
    inner_names = lambda family: ("element", *(variable_name(path) for path, *_ in labelled(family)))
    names = {
        name: [flat[name] + inner for inner in inner_names(family) if not inner.startswith(_OWN)]
        for name, family in families.items()
    }
    with jax.ensure_compile_time_eval():
        anything = jax.tree.map(lambda leaf: np.ones(np.shape(leaf), leaf.dtype), solution)
        count = Counter([*_coordinates(anything), *(name for name, _ in _shaft_variables(anything, dims))])
    count += Counter(name for several in names.values() for name in several)
    return {
        name: f"{name}." if any(count[result] > 1 for result in several) else flat[name]
        for name, several in names.items()
    }


def _variables(solution: ShaftSolution, dims: tuple[str, ...]) -> Iterator[tuple[str, xr.Variable]]:
    yield from _shaft_variables(solution, dims)
    for name, front in fronts(solution, dims).items():
        family = solution.bearings[name].solution
        if family is not None and (dims or bool(family.converged)):
            yield from _family_variables(name, front, family, dims)


def _shaft_variables(solution: ShaftSolution, dims: tuple[str, ...]) -> Iterator[tuple[str, xr.Variable]]:
    for path, value, metadata in labelled(solution):
        if "." not in path and metadata["unit"] != "mixed":
            yield path, variable(value, metadata, path, dims)
    yield from _node_variables(solution, dims)
    for part in ("torque", "life"):
        inner = getattr(solution, part)
        for path, value, metadata in labelled(inner) if inner is not None else ():
            name = f"system_{path}" if part == "life" else f"torque_{path}"
            yield name, variable(value, metadata, f"{part}.{path}", dims)
    if solution.thermal is not None:
        for path, value, metadata in labelled(solution.thermal):
            own = ("gap",) * (np.ndim(value) - len(dims))
            yield (
                f"thermal_{path}",
                xr.Variable((*dims, *own), np.asarray(value), _attributes(metadata, f"thermal.{path}")),
            )
    yield from _stacked(list(solution.bearings.values()), "bearing", "bearings", dims)
    yield from _stacked(list(solution.sets.values()), "set", "sets", dims)


def _node_variables(solution: ShaftSolution, dims: tuple[str, ...]) -> Iterator[tuple[str, xr.Variable]]:
    for name in ("position", "displacement", "load"):
        values = np.asarray(getattr(solution.shaft, name))
        metadata = type(solution.shaft).__dataclass_fields__[name].metadata
        own = ("node",) if name == "position" else ("node", "freedom")
        yield f"node_{name}", xr.Variable((*dims, *own), values, _attributes(metadata, f"shaft.{name}"))


def _stacked(
    parts: Sequence[object], along: str, path: str, dims: tuple[str, ...]
) -> Iterator[tuple[str, xr.Variable]]:
    """Results of all bearings or sets, stacked along the dimension `along`; NaN for a part without the result."""
    results: dict[str, tuple[dict[int, np.ndarray], Mapping[str, object]]] = {}
    for place, part in enumerate(parts):
        for name, value, metadata in labelled(part):
            if not name.startswith("solution.") and (np.ndim(value) == len(dims) or name in _VECTORS):
                results.setdefault(name, ({}, metadata))[0][place] = np.asarray(value)
    for name, (values, metadata) in results.items():
        shape = next(iter(values.values())).shape
        filled = [np.asarray(values.get(place, np.full(shape, np.nan))) for place in range(len(parts))]
        own = _VECTORS.get(name, ())
        attrs = _attributes(metadata, f"{path}.*.{name}")
        title = f"{along}_{name.replace('.', '_')}"
        yield title, xr.Variable((*dims, along, *own), np.stack(filled, axis=len(dims)), attrs)


def _attributes(metadata: Mapping[str, Any], path: str) -> dict[str, str]:
    unit = metadata["unit"]
    return {"units": "1" if unit == "mixed" else udunits(unit), "long_name": metadata["description"], "path": path}


def _family_variables(
    name: str, front: str, solution: Solution, dims: tuple[str, ...]
) -> Iterator[tuple[str, xr.Variable]]:
    """Results of a bearing's own family, with the prefix `front` before their names and dimensions."""
    own = bearing_dataset(solution, dims)
    for inner, array in own.variables.items():
        if str(inner).startswith(_OWN) or str(inner) in dims or CHECK in array.dims or {"freedom"} & set(array.dims):
            continue
        renamed = [f"{front}{dim}" if dim not in dims else dim for dim in array.dims]
        attrs = dict(array.attrs)
        if attrs.get("path"):
            attrs["path"] = f"bearings.{name}.solution.{attrs['path']}"
        yield f"{front}{inner}", xr.Variable(renamed, array.values, attrs)


def _coordinates(solution: ShaftSolution) -> dict[str, xr.Variable]:
    names: dict[str, tuple[list[str], str]] = {
        "bearing": (list(solution.bearings), "name of the bearing"),
        "freedom": (list(RING_FREEDOMS), "axial (X), radial (Y), lateral (Z), tilt, lateral tilt"),
        "freedom_displaced": (list(RING_FREEDOMS), "freedom of the inner ring that is displaced"),
    }
    if solution.sets:
        names["set"] = (list(solution.sets), "name of the set")
    if solution.range_checks:
        names[CHECK] = (list(solution.range_checks), "what is checked")
    coordinates = {
        name: xr.Variable((name,), values, {"units": "1", "long_name": words})
        for name, (values, words) in names.items()
    }
    coordinates["force_units"] = xr.Variable(
        ("freedom",),
        [udunits(unit) for unit in force_units()],
        {"units": "1", "long_name": "unit of an entry of force"},
    )
    units = [[udunits(unit) for unit in row] for row in stiffness_units()]
    attrs = {"units": "1", "long_name": "unit of an entry of stiffness"}
    coordinates["stiffness_units"] = xr.Variable(("freedom", "freedom_displaced"), units, attrs)
    return coordinates
