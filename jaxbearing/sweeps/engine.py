"""Computes the missing chunks of a sweep, in this process or in others, and gathers all chunks."""

import contextlib
import os
import shutil
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from ..report.stores import opened
from .chunks import GOOD, KEY, DamagedChunkError, chunk_path, compute_chunk, read_chunk
from .gather import STORES, store
from .plan import PLAN, Plan, read_key, write_plan

Runner = Callable[[Path, Plan, list[int], Callable[[int], None]], Iterator[tuple[int, int]]]
"""Function that computes chunks: from folder, plan, numbers of the chunks and progress function to an iterator over the
numbers of converged cases and of all cases of each chunk."""


class SweepError(ValueError):
    """Error for a sweep that cannot be started, e.g. because another file has its name."""


class StoppedError(OSError):
    """Error for a sweep that could not write a chunk or the store. **Attributes:** `cases`: number of all cases;
    `computed`: those computed, now or earlier; `converged`: those converged; `kept`: text on what is kept."""

    def __init__(self, cause: OSError, cases: int, computed: int, converged: int, kept: str):
        super().__init__(cause.errno, cause.strerror or str(cause), cause.filename)
        self.cases, self.computed, self.converged, self.kept = cases, computed, converged, kept


@dataclass
class _Tally:
    """Numbers of computed and converged cases so far; `kept`: cases of chunks from an earlier run."""

    computed: int = 0
    converged: int = 0
    kept: int = 0


@dataclass(frozen=True)
class Outcome:
    """Result of a sweep: numbers of cases, of converged ones, and of those `kept` from an earlier run."""

    cases: int
    converged: int
    kept: int

    @property
    def failed(self) -> int:
        return self.cases - self.converged


@dataclass(frozen=True)
class Watcher:
    """Functions that a sweep calls: `cases` with the number of cases just done, `stage` with the name of the current
    stage, `note` with a sentence."""

    cases: Callable[[int], None] = lambda count: None
    stage: Callable[[str], None] = lambda text: None
    note: Callable[[str], None] = lambda text: None


def chunk_folder(target: Path) -> Path:
    """Folder of a sweep's chunks until the store is written."""
    return target.with_name(f"{target.name}.chunks")


def check_target(target: Path) -> None:
    """Checks the suffix of the store's name.

    **Raises:** `SweepError` for a suffix that is not in `STORES`.
    """
    if target.suffix.lower() not in STORES:
        raise SweepError(f"found '{target}'; expected a file name that ends in {' or '.join(STORES)}")


def run(
    plan: Plan, target: Path, *, runner: Runner | None = None, overwrite: bool = False, watcher: Watcher | None = None
) -> Outcome:
    """Compute the missing chunks and write the store.

    A run that was interrupted at any moment and in any way continues when it is started again: existing chunks are not
    computed again, and the store is written completely or not at all. Afterwards the chunks are removed.

    **Raises:** `SweepError` if another sweep or another file is in the way (`overwrite` removes it), or if another
    process is computing this sweep; `StoppedError` if a file cannot be written; the chunks are kept.
    """
    check_target(target)
    watcher = watcher or Watcher()
    there = _there_already(plan, target, overwrite, watcher)
    if there is not None:
        return there
    folder = chunk_folder(target)
    fresh = not os.path.lexists(folder)
    with _locked(folder):
        # another process may have finished the sweep before this one got the lock
        there = _there_already(plan, target, overwrite, watcher)
        if there is not None:
            return there
        tally, ours = _Tally(), fresh
        try:
            _claim(plan, folder, target, overwrite)
            ours = True
            _compute(plan, folder, runner or in_process(), watcher, tally)
            watcher.stage("writing")
            store(plan, folder, target)
        except OSError as error:
            kept = kept_words(plan, target)
            # files of another run or another program are not removed
            if ours and not tally.computed:
                shutil.rmtree(folder, ignore_errors=True)
            raise StoppedError(error, len(plan.cases), tally.computed, tally.converged, kept) from error
        shutil.rmtree(folder, ignore_errors=True)
    return Outcome(len(plan.cases), tally.converged, tally.kept)


def kept_words(plan: Plan, target: Path) -> str:
    """Text that says how many cases of a stopped sweep need not be computed again."""
    folder = chunk_folder(target)
    ranges = [plan.range_of(index) for index in range(plan.chunks) if chunk_path(folder, index).exists()]
    kept = sum(stop - start for start, stop in ranges)
    if not kept:
        return "no case is kept"
    return f"{kept} of {len(plan.cases)} cases are kept in '{folder}': the same command goes on there"


def _there_already(plan: Plan, target: Path, overwrite: bool, watcher: Watcher) -> Outcome | None:
    """Result of the sweep if its store already exists, else `None`. **Raises:** `SweepError` if something else is at
    its place."""
    if target.exists() and not (target.is_file() or target.is_dir()):
        raise SweepError(f"found '{target}', no ordinary file; expected a new name")
    finished = _finished(target)
    if finished is not None and finished[0] == plan.key:
        shutil.rmtree(chunk_folder(target), ignore_errors=True)
        watcher.note(f"{target} has this sweep already: nothing is computed")
        watcher.cases(len(plan.cases))
        return Outcome(len(plan.cases), finished[1], len(plan.cases))
    if os.path.lexists(target) and not overwrite:
        problem = "another sweep" if finished is not None else "which is there already and is not this sweep's"
        raise SweepError(f"found '{target}', {problem}; expected a new name, or --overwrite")
    if overwrite and os.path.lexists(target) and finished is None and target.is_dir():
        raise SweepError(f"found '{target}', a folder that is no sweep; expected a new name")
    return None


def _claim(plan: Plan, folder: Path, target: Path, overwrite: bool) -> None:
    """Takes the folder for this plan: writes the plan to it, unless it is already there.

    **Raises:** `SweepError` if the folder has chunks of another sweep and `overwrite` is False.
    """
    there = [path for path in folder.iterdir() if path.name != _LOCK]
    try:
        known = read_key(folder) if (folder / PLAN).exists() else None
    except ValueError:
        known = None
    if known == plan.key:
        return
    others = [path for path in there if path.suffix != ".part" and path.name != PLAN]
    if others and not overwrite:
        raise SweepError(
            f"found the chunks of another sweep in '{folder}' (another scene, other cases or options, or another "
            f"version); expected those of this one: choose another name than '{target}', or --overwrite to drop them"
        )
    for path in there:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    write_plan(plan, folder)


def _compute(plan: Plan, folder: Path, runner: Runner, watcher: Watcher, tally: _Tally) -> None:
    missing = []
    for index in range(plan.chunks):
        start, stop = plan.range_of(index)
        try:
            tally.converged += int(read_chunk(folder, index, plan.key)[GOOD])
        except FileNotFoundError:
            missing.append(index)
        except DamagedChunkError as error:
            watcher.note(f"a damaged chunk is computed again: {error}")
            missing.append(index)
        else:
            tally.kept += stop - start
    tally.computed = tally.kept
    if tally.kept:
        watcher.note(f"{tally.kept} of {len(plan.cases)} cases are there from an earlier run")
        watcher.cases(tally.kept)
    if missing:
        for good, cases in runner(folder, plan, missing, watcher.cases):
            tally.converged += good
            tally.computed += cases


def in_process(devices: int | None = None) -> Runner:
    """A runner that computes chunk after chunk in this process, on the local devices."""

    def runner(
        folder: Path, plan: Plan, missing: list[int], progress: Callable[[int], None]
    ) -> Iterator[tuple[int, int]]:
        for index in missing:
            yield compute_chunk(folder, index, plan, devices, progress)

    return runner


def _finished(target: Path) -> tuple[str, int] | None:
    """Key and number of converged cases of the sweep stored at `target`; `None` if no sweep is there."""
    if not target.exists():
        return None
    try:
        # xarray warns if a foreign store has no consolidated metadata
        with (
            warnings.catch_warnings(action="ignore"),
            opened(target) as dataset,
        ):
            key = dataset.attrs.get(KEY)
            return None if key is None else (str(key), int((dataset["failure"] == "").sum()))
    except Exception:
        # a file that cannot be read is not a sweep
        return None


_LOCK = "lock"


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Lock that lets one process at a time use the folder; the system releases it when the process ends in any way."""
    with _lock_file(folder):
        yield


def _lock_file(folder: Path) -> IO[str]:
    """The lock file, open and locked. A process that finishes the sweep removes the folder and the lock file, perhaps
    at this moment; then both are made again."""
    import fcntl

    path = folder / _LOCK
    while True:
        folder.mkdir(exist_ok=True)
        try:
            file = path.open("a")
        except FileNotFoundError:
            continue
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(file.fileno()), os.stat(path)):
                return file
        except BlockingIOError:
            file.close()
            raise SweepError(f"another process is computing this sweep in '{folder}'; wait or stop it") from None
        except FileNotFoundError:
            pass
        file.close()
