"""Plan and runner of a sweep from the arguments of a user."""

from collections.abc import Mapping

import jax

from .._scene import AbstractScene
from ..bearings.bearing import AbstractBearing
from ..lanes import default_method
from ..numerics.newton import NewtonOptions
from ..shafts.scene import ShaftSystem
from .cases import Cases, grid
from .cluster import on_workers
from .engine import Runner, in_process
from .fields import label_of
from .plan import CHUNK, HEAVY_CHUNK, HEAVY_LANES, LANES, QUICK_CASES, VMAP_LANES, Plan, compilation_cache
from .recipe import Recipe, in_scene


def _sizes(recipe: Recipe, chunk: int | None) -> tuple[bool, int, int]:
    """Sizes of the work: whether a case is solved in milliseconds, number of cases of a chunk, and largest number of
    cases of a call on a CPU."""
    light = isinstance(recipe.example_scene, AbstractBearing | ShaftSystem)
    size = (CHUNK if light else HEAVY_CHUNK) if chunk is None else chunk
    return light, size, LANES if light else HEAVY_LANES


def calls_at_once(recipe: Recipe, cases: Cases, chunk: int | None = None) -> int:
    """Number of CPU devices that can share a chunk."""
    _, size, most = _sizes(recipe, chunk)
    return -(-min(len(cases), size) // most)


def make_plan(
    recipe: Recipe,
    cases: Cases,
    metadata: dict[str, dict[str, str]],
    label: str,
    *,
    options: NewtonOptions | None = None,
    elements: bool = True,
    chunk: int | None = None,
) -> Plan:
    """Plan of a sweep with its cases divided into chunks. **Raises:** `ValueError` for a chunk size below 1."""
    if chunk is not None and chunk < 1:
        raise ValueError(f"chunk: found {chunk}, expected 1 or more cases")
    method = default_method()
    light, size, most = _sizes(recipe, chunk)
    most = most if method == "map" else VMAP_LANES
    return Plan(
        recipe=recipe,
        cases=cases,
        options=NewtonOptions() if options is None else options,
        chunk=size,
        lanes=min(size, most),
        elements=elements,
        platform=jax.default_backend(),
        method=method,
        quick=light and len(cases) <= QUICK_CASES,
        label=label,
        metadata=metadata,
        cache=compilation_cache(),
    )


def plan_in_scene(
    scene: AbstractScene,
    over: Mapping[str, object] | Cases,
    *,
    options: NewtonOptions | None = None,
    elements: bool = True,
    chunk: int | None = None,
) -> Plan:
    """Plan of a sweep over attributes of a scene, in SI. **Raises:** see `jaxbearing.sweep`."""
    cases = over if isinstance(over, Cases) else grid(over)
    recipe = in_scene(scene, cases)
    metadata = {path: label_of(recipe.base, path) for path in cases.paths}
    label = type(scene).__name__
    return make_plan(recipe, cases, metadata, label, options=options, elements=elements, chunk=chunk)


def runner_of(devices: int | None, workers: int | None, scheduler: str | None) -> Runner:
    """The runner that computes the chunks: in this process, on one or several devices, or on workers.

    **Raises:** `ValueError` for impossible counts.
    """
    for name, count in (("devices", devices), ("workers", workers)):
        if count is not None and count < 1:
            raise ValueError(f"{name}: found {count}, expected 1 or more")
    if workers is not None and scheduler is not None:
        raise ValueError("scheduler: found one beside workers; expected one of the two")
    if workers is None and scheduler is None:
        return in_process(devices)
    return on_workers(workers, scheduler)
