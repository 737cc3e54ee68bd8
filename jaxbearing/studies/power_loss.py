"""The power-loss study of one bearing: all cases of its panels in one sweep, each point solved once."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..bearings.bearing import AbstractBearing
from ..bearings.cylindrical.scene import CylindricalRollerBearing
from ..gaps import FullTurbulence
from ..sweep import sweep
from ..sweeps import listed
from .panels import DRAG, GUIDING, GUIDINGS, SPEED, SPEEDS, Panel, own, panels_of, scaled

if TYPE_CHECKING:
    import xarray as xr

Change = Mapping[str, float]
Progress = Callable[[int], None]
Places = dict[tuple[str, tuple[float, ...]], int]
"""Variant of the cage lands and the values of a point -> its place among the cases."""


class NotInStudy(Exception):
    """A point that was asked for was not solved: its figure is left out."""


@dataclass(frozen=True)
class PowerLossStudy:
    """Results of the study.

    - `panels`: name of a figure ("39a") -> data set of a grid over its fields, as `jaxbearing.sweep` gives it.
    - `left_out`: why others are not there.
    - `cases`, `failed`: solves in all, and those without a result: gaps in the panels.
    """

    scene: AbstractBearing
    panels: "dict[str, xr.Dataset]"
    left_out: list[str]
    cases: int
    failed: int
    _found: "dict[str, xr.Dataset]"
    _places: Places
    _fields: tuple[str, ...]

    def result(self, name: str, change: Change | None = None, lands: str = "blend") -> np.ndarray:
        """One result of the point with this change. **Raises:** `NotInStudy` for a point that was not solved."""
        key = (lands, _key(self.scene, change or {}, self._fields))
        if key not in self._places or not set(change or {}) <= set(self._fields):
            raise NotInStudy(f"not solved for: {', '.join(change or {})}")
        place = self._places[key]
        values = self._found[lands][name]
        return np.asarray(values.isel(case=place) if "case" in values.dims else values)

    def losses(self, location: str, path: str, values: Iterable[float], lands: str = "blend") -> np.ndarray:
        """Loss at a location, or "total", in W for each value of a field."""
        return np.array([float(self.result(f"power_loss_{location}", {path: v}, lands)) for v in values])

    def locations(self) -> dict[str, float]:
        """Loss by location at the scene's own point, in W."""
        names = [str(name) for name in self._found["blend"].data_vars if str(name).startswith("power_loss_")]
        return {name.removeprefix("power_loss_"): float(self.result(name)) for name in names}

    def tree(self) -> "xr.DataTree":
        """One group a panel, for a NetCDF file."""
        import xarray as xr

        return xr.DataTree.from_dict({f"figure_{name}": panel for name, panel in self.panels.items()})


def power_loss_study(scene: AbstractBearing, progress: Progress | None = None) -> PowerLossStudy:
    """Solve the power-loss study of a cylindrical roller or ball bearing.

    **Arguments:**
    - `scene`: a bearing with power loss: with `contact.traction`, and a cage if it is of rollers.
    - `progress`: called with the number of cases that were just done.

    **Raises:** `ValueError` for values that the scene refuses.
    """
    panels, left_out = panels_of(scene)
    extra = [{SPEED: SPEEDS[-1] * (own(scene, SPEED) or 0.0), DRAG: c} for c in (0.2, 0.3)]
    points: list[Change] = [{}, *(point for panel in panels for point in _points(panel))]
    if isinstance(scene, CylindricalRollerBearing) and own(scene, DRAG) is not None:
        points += extra
    fields = tuple(dict.fromkeys(path for point in points for path in point))
    datasets: dict[str, xr.Dataset] = {}
    places: Places = {}
    datasets["blend"] = _solved(scene, points, fields, "blend", places, progress)
    if isinstance(scene, CylindricalRollerBearing) and own(scene, GUIDING) is not None:
        turbulent = scene.replace({"cage.turbulence": FullTurbulence()})
        guided = [{GUIDING: v} for v in scaled(scene, GUIDING, GUIDINGS)]
        datasets["turbulent"] = _solved(turbulent, guided, fields, "turbulent", places, progress)
    status = np.concatenate([np.asarray(dataset.status) for dataset in datasets.values()])
    cut = {panel.name: _panel(scene, panel, datasets["blend"], places, fields) for panel in panels}
    return PowerLossStudy(scene, cut, left_out, status.size, int(np.sum(status != 0)), datasets, places, fields)


def _points(panel: Panel) -> list[Change]:
    grids = np.meshgrid(*panel.values.values(), indexing="ij")
    return [
        dict(zip(panel.values, map(float, row), strict=True)) for row in zip(*(g.ravel() for g in grids), strict=True)
    ]


def _key(scene: AbstractBearing, change: Change, fields: tuple[str, ...]) -> tuple[float, ...]:
    """A point by all its values; the same number written in two ways is one point."""
    return tuple(float(f"{change.get(path, own(scene, path)):.10g}") for path in fields)


def _solved(
    scene: AbstractBearing,
    points: Sequence[Change],
    fields: tuple[str, ...],
    lands: str,
    places: Places,
    progress: Progress | None,
) -> "xr.Dataset":
    keys = list(dict.fromkeys(_key(scene, point, fields) for point in points))
    places |= {(lands, key): i for i, key in enumerate(keys)}
    full = {_key(scene, point, fields): point for point in points}
    columns = {path: [full[key].get(path, own(scene, path)) for key in keys] for path in fields}
    return sweep(scene, listed(columns), progress=progress)


def _panel(
    scene: AbstractBearing, panel: Panel, dataset: "xr.Dataset", places: Places, fields: tuple[str, ...]
) -> "xr.Dataset":
    """The cases of a panel as the data set of a sweep over its grid."""
    import xarray as xr

    names = {path: path.replace(".", "_") for path in panel.values}
    shape = [len(values) for values in panel.values.values()]
    at = [places["blend", _key(scene, point, fields)] for point in _points(panel)]
    cases = xr.DataArray(np.reshape(at, shape), dims=list(names.values()))
    attributes = {name: dataset[name].attrs for name in names.values()}
    all_fields = [path.replace(".", "_") for path in fields]
    out = dataset.drop_vars(["case", *all_fields], errors="ignore").isel(case=cases)
    out = out.drop_dims([d for d in ("element", "freedom", "freedom_displaced", "check") if d in out.dims])
    out = out.drop_vars("case", errors="ignore")
    out = out.assign_coords(
        {names[p]: (names[p], np.asarray(v), attributes[names[p]]) for p, v in panel.values.items()}
    )
    out.attrs |= {"sweep_kind": "grid", "sweep_fields": " ".join(panel.values), "title": f"Power loss {panel.title}"}
    return out
