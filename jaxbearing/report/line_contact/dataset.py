"""A line contact as a labelled xarray data set."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from ...ehl import LineContactHistory, LineContactSolution
from ...numerics.status import Status
from ..labelled import CHECK, attributes, checks, described, flags, identity_text, labelled, without_fill


def line_contact_to_dataset(solution: LineContactSolution, dims: Sequence[str] = ()) -> xr.Dataset:
    """See `report.dataset.solution_to_dataset`. The profile has the dimension `x`; in a batch it is `node`, and `x` a
    coordinate along it that differs from lane to lane."""
    dims = tuple(dims)
    if np.ndim(solution.status) != len(dims):
        batch = np.ndim(solution.status)
        raise ValueError(f"dims: got {len(dims)} names {dims}; the solution is a batch of {batch} dimensions")
    if not dims and not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    dataset = _variables(solution, "Film and pressure of a line contact", dims, "node" if dims else "x")
    if dims:
        dataset = dataset.set_coords("x")
        dataset["out_of_range"] = checks(solution, dims)
        words = {"units": "1", "long_name": "what is checked"}
        dataset = dataset.assign_coords({CHECK: xr.Variable((CHECK,), list(solution.range_checks), words)})
    return without_fill(dataset)


def film_history_to_dataset(history: LineContactHistory) -> xr.Dataset:
    """All results of a run: dimensions `time` (every step) and `x`."""
    dataset = _variables(history, "Film and pressure of a line contact over time", ("time",))
    dataset.attrs |= {"solver": history.solver, "completed": int(history.completed)}
    dataset.attrs |= identity_text(history.last_state.identity)
    return without_fill(dataset)


def _variables(result: Any, title: str, along: tuple[str, ...], node: str = "x") -> xr.Dataset:
    dataset = xr.Dataset(attrs=attributes(result, title))
    for path, value, metadata in labelled(result):
        name, values = path.removeprefix("profile.").replace(".", "_"), np.asarray(value)
        if path.startswith("profile."):
            dims = (node,) if values.ndim == 1 else (*along, node)
            name = "x" if name == "x" else f"profile_{name}"
        elif path.startswith("last_state."):
            # values of the last three times, and the two steps between them
            dims = (("last_step",) if name.endswith("steps") else ("last_time", "x"))[: values.ndim]
        else:
            dims = along if values.ndim else ()
        dataset[name] = xr.Variable(dims, values, described(metadata, path))
    for name, unit, text in (
        ("entrainment_speed", "m s-1", "mean surface speed"),
        ("oil_temperature", "K", "oil temperature"),
    ):
        value = np.asarray(getattr(result.operation, name))
        words = {"units": unit, "long_name": text, "path": f"operation.{name}"}
        dataset[f"operation_{name}"] = xr.Variable(along[: value.ndim], value, words)
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    return dataset.set_coords([name for name in dataset if str(name).startswith("operation_")])
