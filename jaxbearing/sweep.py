"""The verb for many steady states: a scene and the cases in, one labelled data set out."""

import os
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._scene import AbstractScene
from .numerics.compiling import require_outside
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import require_x64

if TYPE_CHECKING:
    import xarray as xr

    from .sweeps import Cases


@rare_garbage_collection()
def sweep(
    scene: AbstractScene,
    over: "Mapping[str, Any] | Cases",
    *,
    out: str | os.PathLike[str] | None = None,
    options: NewtonOptions | None = None,
    elements: bool = True,
    chunk: int | None = None,
    devices: int | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Callable[[int], None] | None = None,
) -> "xr.Dataset":
    """Steady states of many cases, labelled: names, units and descriptions on every variable.

        speeds, loads = jnp.linspace(500.0, 1500.0, 11), jnp.linspace(5e3, 40e3, 8)
        found = jb.sweep(scene, {"operation.inner_speed": speeds, "operation.radial_load": loads})
        found.power_loss_total.sel(operation_radial_load=5e3)
        found.to_dataframe()

    A grid has one dimension a field, other sweeps the dimension `case`; the swept fields are coordinates. A case that
    failed has NaN for results, its `status`, and says why in `failure`; it does not touch the others. The cases are
    computed in chunks, with a compiled program whose lanes do not depend on each other.

    **Arguments:**
    - `scene`: from `load_scene`, or built from parts: of any kind that `solve` takes.
    - `over`: dotted path of a field -> SI values, for a grid of all combinations; or `sweeps.listed`,
      `sweeps.random`, `sweeps.latin_hypercube`. Fields that shape the equations (numbers of rollers) are refused.
    - `out`: file to write, `.nc` or `.zarr`. A run that is stopped, at any moment, goes on where it was when it is
      called again; chunks lie in the folder `out` + ".chunks" until then. Without it everything stays in memory.
    - `elements`: whether results of each rolling element are kept.
    - `chunk`: cases that are computed and written at a time; about a thousand if not given.
    - `devices`: how many of JAX's devices share the work; all if not given.
    - `workers`, `scheduler`: so many processes of this machine, or the address of a running Dask cluster, which sees
      the folder of `out` under the same path (extra `cluster`).
    - `overwrite`: whether another file at `out` may be replaced.
    - `progress`: called with the number of cases that were just done.

    **Raises:** `ValueError` for values that the scene refuses, inside of `jax.jit` (`solve` is for it), or where
    something else is at `out`; `AttributeError` for a field that is not there; `OSError` where `out` cannot be written.
    """
    import xarray as xr

    from .report.stores import opened
    from .sweeps.engine import Watcher, run
    from .sweeps.verb import plan_in_scene, runner_of

    require_x64()
    instead = "it writes files and looks at the numbers; solve can, under vmap or lax.map too"
    require_outside("sweep", instead, scene, over if isinstance(over, Mapping) else None)
    plan = plan_in_scene(scene, over, options=options, elements=elements, chunk=chunk)
    runner = runner_of(devices, workers, scheduler)
    watcher = Watcher() if progress is None else Watcher(cases=progress)
    if out is not None:
        run(plan, Path(out), runner=runner, overwrite=overwrite, watcher=watcher)
        return opened(out)
    with tempfile.TemporaryDirectory(prefix="jaxbearing-sweep-") as folder:
        target = Path(folder) / "sweep.nc"
        run(plan, target, runner=runner, watcher=watcher)
        return xr.load_dataset(target, engine="h5netcdf")
