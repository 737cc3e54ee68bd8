"""Reads the last state of a transient run from its NetCDF file, to continue the run."""

import json
import os
from collections.abc import Sequence

import numpy as np
import xarray as xr

from .._identity import Identity, identity_from
from ..bearings.motion.history import LastState
from ..bearings.warming.history import WarmState
from ..ehl import FilmState
from ..scenes.input_files import check_regular
from .variables import IDENTITY, NODES

_NEEDED = ("time", "state_elements", "state_cage", "frame_angle", "frame_speed", "reference_speed", "azimuth")
_OLD_NAME = "state_rollers"
"""Name of `state_elements` in files of earlier versions."""
_OF_A_FILM = ("time", "pressure", "offset", "mass", "steps", "known", "proposal")
"""Variables of a line contact's last state, without their prefix."""
_PREFIX = "last_state_"


def read_last_state(path: object) -> LastState | FilmState | WarmState:
    """Reads the end of a run from the file of `jaxbearing simulate --out`, for `jaxbearing.simulate(..., restart=...)`.

    The run may be that of a bearing, of bearing temperatures or of a line contact; it may have been interrupted or have
    stopped early.

    **Raises:** `OSError` for a file that cannot be read, `ValueError` for a file that holds no transient run.
    """
    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"read_last_state takes the path of a file, got {path!r}")
    name = os.fspath(path)
    # xarray's own message for a missing file only suggests other engines
    check_regular(path)
    with open(path, "rb"):
        pass
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as dataset:
            if any(str(field).startswith(_PREFIX) for field in dataset.variables):
                return _film_state(dataset)
            if NODES in dataset.attrs:
                return _warm_state(dataset)
            return _bearing_state(dataset)
    except _Other as error:
        raise ValueError(f"{name} is not a transient run that can be continued: {error}") from None
    # a truncated file, or one that is not NetCDF, fails in many ways
    except Exception as error:
        raise ValueError(f"{name} is not a NetCDF file that can be read: {_first_line(error)}") from None


def _bearing_state(dataset: xr.Dataset) -> LastState:
    if _OLD_NAME in dataset.variables:
        dataset = dataset.rename({_OLD_NAME: "state_elements"})
    _require(dataset, _NEEDED)
    if dataset.sizes["time"] == 0:
        raise _Other("it has no instants")
    last = dataset[list(_NEEDED)].isel(time=-1)
    values = {field: np.asarray(last[field].values, dtype=float) for field in _NEEDED}
    if (values["state_elements"].ndim, values["state_cage"].ndim) != (2, 1):
        raise _Other("its states have another shape")
    return LastState(
        time=values["time"],
        elements=values["state_elements"],
        cage=values["state_cage"],
        frame_angle=values["frame_angle"],
        frame_speed=values["frame_speed"],
        reference_speed=values["reference_speed"],
        azimuth=values["azimuth"],
        has_cage="cage_speed" in dataset.variables,
        identity=_identity(dataset),
    )


def _warm_state(dataset: xr.Dataset) -> WarmState:
    nodes = tuple(str(dataset.attrs[NODES]).split(","))
    names = [f"temperatures_{name}" for name in nodes]
    _require(dataset, ["time", *names])
    if dataset.sizes.get("time", 0) == 0:
        raise _Other("it has no instants")
    values = [np.asarray(dataset[name].values, dtype=float) for name in ("time", *names)]
    if any(value.ndim != 1 for value in values):
        raise _Other("its temperatures have another shape")
    last = [value[-1] for value in values]
    return WarmState(np.asarray(last[0]), np.asarray(last[1:]), nodes, _identity(dataset))


def _film_state(dataset: xr.Dataset) -> FilmState:
    names = [_PREFIX + field for field in _OF_A_FILM]
    _require(dataset, ["x", *names])
    x = np.asarray(dataset["x"].values, dtype=float)
    values = {field: np.asarray(dataset[_PREFIX + field].values) for field in _OF_A_FILM}
    n = x.shape[0] if x.ndim == 1 else -1
    shapes = {"pressure": (3, n), "offset": (3,), "mass": (3, n), "steps": (2,)}
    if any(values[field].shape != shapes.get(field, ()) for field in _OF_A_FILM):
        raise _Other("its state has another shape")
    known = values.pop("known").astype(int)
    numbers = {field: value.astype(float) for field, value in values.items()}
    return FilmState(x=x, known=known, identity=_identity(dataset), **numbers)


def _identity(dataset: xr.Dataset) -> Identity | None:
    """Identity of the bearing or contact; `None` in files of earlier versions."""
    text = dataset.attrs.get(IDENTITY)
    if text is None:
        return None
    try:
        return identity_from(dict(json.loads(text)))
    except (TypeError, ValueError) as error:
        raise _Other(f"its attribute {IDENTITY} cannot be read ({error})") from None


_MOST = 1_000_000
"""Largest allowed number of rolling elements or nodes of a state."""


def _require(dataset: xr.Dataset, fields: Sequence[str]) -> None:
    missing = [field for field in fields if field not in dataset.variables]
    if missing:
        raise _Other(f"it has no {', '.join(missing)}")
    # of a damaged or malicious file; the number of instants may be larger, because only one is read
    if any(size > _MOST for name, size in dataset.sizes.items() if name != "time"):
        raise _Other("its dimensions are too large")


class _Other(Exception):
    """Error for a file that holds no transient run."""


def _first_line(error: Exception) -> str:
    return (str(error).strip() or type(error).__name__).splitlines()[0]
