"""Chunks of a sweep: computed one by one, each in a file that is written completely or not at all."""

import functools
import io
import os
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..lanes import LaneProgram
from ..report.files import write_whole
from ..scenes.input_files import check_regular
from .labels import FAILURE, columns, converged, failures, template
from .plan import Plan, read_plan

KEY, GOOD = "sweep_key", "converged_cases"
"""Names of further entries in the file of a chunk: hash of the sweep, and number of converged cases."""


class DamagedChunkError(OSError):
    """Error for a chunk's file that cannot be used."""


def chunk_path(folder: Path, index: int) -> Path:
    return folder / f"chunk-{index:06d}.npz"


def run_chunk(
    folder: str | os.PathLike[str],
    index: int,
    key: str,
    devices: int | None = None,
    progress: Callable[[int], None] = lambda lanes: None,
) -> tuple[int, int]:
    """Solve the cases of one chunk and write its file; a worker needs no other call.

    The program is compiled at the first chunk of a process and kept.

    **Arguments:**
    - `folder`: folder of the sweep's chunks, which contains its plan.
    - `key`: hash of the plan.
    - `devices`: number of local devices to use; all if not given.
    - `progress`: called with the number of cases that were solved.

    **Returns:** number of converged cases and number of all cases of the chunk.

    **Raises:** `OSError`; `ValueError` if this process has another version than the one that made the plan, and for a
    plan that cannot be read.
    """
    return compute_chunk(Path(folder), index, _plan_in(str(folder), key), devices, progress)


def compute_chunk(
    folder: Path,
    index: int,
    plan: Plan,
    devices: int | None = None,
    progress: Callable[[int], None] = lambda lanes: None,
) -> tuple[int, int]:
    """Does the same as `run_chunk`, with a plan that is given instead of read."""
    program, labels = _program(plan, devices)
    start, stop = plan.range_of(index)
    inputs, reasons = plan.recipe.inputs(plan.cases.part(start, stop))
    active = np.asarray([not reason for reason in reasons])
    solution = program(inputs, active, progress)
    good = converged(solution)
    kept = columns(solution, labels) | {FAILURE: failures(solution, _completed_reasons(plan, reasons, good, start))}
    arrays: dict[str, Any] = {**kept, KEY: np.asarray(plan.key), GOOD: np.asarray(good.sum())}
    made = io.BytesIO()
    np.savez(made, **arrays)
    write_whole(chunk_path(folder, index), made.getbuffer())
    return int(good.sum()), stop - start


@functools.lru_cache(maxsize=1)
def _plan_in(folder: str, key: str) -> Plan:
    _, plan = read_plan(folder)
    require_key(plan, key)
    return plan


def require_key(plan: Plan, key: str) -> None:
    """Checks that a plan has the same hash in this process as where the sweep began.

    **Raises:** `ValueError` if it does not.
    """
    if plan.key != key:
        raise ValueError("this process has another version of jaxbearing or JAX than the one that began the sweep")


_compiled: dict[tuple[str, int | None], tuple[LaneProgram, xr.Dataset]] = {}
"""Compiled program and labels of the sweep at work in this process, at most one."""


def _program(plan: Plan, devices: int | None) -> tuple[LaneProgram, xr.Dataset]:
    if (plan.key, devices) not in _compiled:
        program = plan.program(devices)
        _compiled.clear()
        _compiled[plan.key, devices] = program, template(program.structure, plan.elements, plan.cases.paths)
    return _compiled[plan.key, devices]


def labels_of(plan: Plan) -> xr.Dataset:
    """The data set of one case, without results: from the sweep at work in this process, or newly made."""
    for (key, _), (_, labels) in _compiled.items():
        if key == plan.key:
            return labels
    return template(plan.program().structure, plan.elements, plan.cases.paths)


def _completed_reasons(plan: Plan, reasons: list[str], good: np.ndarray, start: int) -> list[str]:
    """Reasons of failure, completed for failed cases whose values are refused when their scene is built."""
    completed = list(reasons)
    for lane in np.flatnonzero(~good).tolist():
        if not completed[lane]:
            values = plan.cases.part(start + lane, start + lane + 1)
            try:
                plan.recipe.scene({path: float(value[0]) for path, value in values.items()})
            except ValueError as error:
                completed[lane] = str(error)
    return completed


def read_chunk(folder: Path, index: int, key: str, names: list[str] | None = None) -> dict[str, Any]:
    """Variables of a chunk, those in `names` or all. Checksums of the data are verified.

    **Raises:** `FileNotFoundError`; `DamagedChunkError` for a file that is cut off, changed or of another sweep.
    """
    path = chunk_path(folder, index)
    try:
        check_regular(path)
        # opened here: numpy leaves a file open that it cannot read
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            variables = {name: file[name] for name in (file.files if names is None else [KEY, *names])}
    except FileNotFoundError:
        raise
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError) as error:
        raise DamagedChunkError(f"{path}: {error}") from None
    if str(variables.get(KEY)) != key:
        raise DamagedChunkError(f"{path}: it is of another sweep")
    return variables
