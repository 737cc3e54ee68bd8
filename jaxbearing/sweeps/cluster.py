"""Chunks computed by the workers of a Dask cluster; a chunk whose worker dies is given to another one.

Workers must see the folder of the chunks under the same path; they write the same files as a single process.
"""

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .chunks import GOOD, compute_chunk, read_chunk, require_key
from .engine import Runner, SweepError
from .labels import FAILURE
from .plan import Plan, compilation_cache

if TYPE_CHECKING:
    from dask.distributed import Client

CONNECT = 15
"""Time within which a scheduler must answer, s."""
LOST_WORKERS = 10
"""Number of workers that may die at one chunk before the chunk is given up."""


def on_workers(count: int | None = None, scheduler: str | None = None) -> Runner:
    """A runner for `engine.run` with several processes on this machine, or on a running cluster.

    **Arguments:** `count`: number of local processes, each with one device; `scheduler`: address of a cluster's
    scheduler, such as "tcp://host:8786".

    **Raises:** `ImportError` without the extra `cluster`.
    """
    import dask.distributed  # noqa: F401  (said before the work begins)

    def runner(
        folder: Path, plan: Plan, missing: list[int], progress: Callable[[int], None]
    ) -> Iterator[tuple[int, int]]:
        from dask.distributed import KilledWorker, as_completed

        with _client(count, scheduler) as client:
            # sent over the cluster: the plan in the folder cannot contain a user's own law
            sent = client.scatter(plan, broadcast=True)
            # `pure=False`: a chunk that was damaged must be computed, whatever the scheduler remembers
            tasks = as_completed(
                client.submit(_run_remotely, str(folder.resolve()), index, sent, plan.key, pure=False, retries=2)
                for index in missing
            )
            for done in tasks:
                try:
                    good, cases = done.result()
                except KilledWorker:
                    raise ChildProcessError(f"{LOST_WORKERS} workers died one after the other of one chunk") from None
                # otherwise the result would be lost if its worker died, and be computed again
                done.release()
                progress(cases)
                yield good, cases

    return runner


def _run_remotely(folder: str, index: int, plan: Plan, key: str) -> tuple[int, int]:
    """Computes a chunk in a worker, with the compilation cache of the plan if the worker has none."""
    import jax

    require_key(plan, key)
    if plan.cache is not None and compilation_cache() is None:
        jax.config.update("jax_compilation_cache_dir", plan.cache)
        jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
        jax.config.update("jax_persistent_cache_min_entry_size_bytes", -1)
    with contextlib.suppress(OSError):
        # the chunk of a worker that died after writing it
        chunk = read_chunk(Path(folder), index, key)
        return int(chunk[GOOD]), len(chunk[FAILURE])
    return compute_chunk(Path(folder), index, plan)


@contextlib.contextmanager
def _client(count: int | None, scheduler: str | None) -> Iterator["Client"]:
    from dask import config
    from dask.distributed import Client, LocalCluster

    settings = {
        "distributed.scheduler.allowed-failures": LOST_WORKERS,
    }
    with config.set(settings):
        if scheduler is not None:
            try:
                client = Client(scheduler, timeout=CONNECT)
            except (OSError, ValueError) as error:
                raise SweepError(f"scheduler: found '{scheduler}', which does not answer ({error})") from None
            with client:
                yield client
            return
        with (
            LocalCluster(
                n_workers=count, threads_per_worker=1, processes=True, dashboard_address="", memory_limit=0
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
