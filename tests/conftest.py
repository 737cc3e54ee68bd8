"""Test settings: float64, strict shapes and dtypes, run-time checked annotations, warnings are errors.

On the CPU, unless JAX_PLATFORMS says otherwise: `JAX_PLATFORMS=cuda python -m pytest`.
"""

import ctypes
import gc
import os
import time
from pathlib import Path

os.environ.pop("COLUMNS", None)  # parallel tests set it: the width of the screen would depend on their number
os.environ.setdefault("JAX_PLATFORMS", "cpu")
# programs of the package are compiled from what is here, and not loaded
os.environ.setdefault("JAXBEARING_CACHE", "off")
# where in the source an operation stands is looked at by nobody, and takes a quarter of the time of lowering
os.environ.setdefault("JAX_TRACEBACK_IN_LOCATIONS_LIMIT", "0")
# the commands that tests start share a GPU with them
os.environ.setdefault("XLA_PYTHON_CLIENT_PREALLOCATE", "false")

from jaxtyping import install_import_hook

with install_import_hook(["jaxbearing", "fitting"], "beartype.beartype"):
    import jaxbearing  # noqa: F401  (switches float64 on)

import jax
import jaxlib
import pytest

from jaxbearing.numerics.compiling import IDLE_PASSES
from jaxbearing.numerics.garbage import RARELY

jax.config.update("jax_numpy_rank_promotion", "raise")
jax.config.update("jax_numpy_dtype_promotion", "strict")

# Compiled programs are shared by the workers of a run and kept for the next one; they are keyed by the program itself.
_CACHE = Path(__file__).parent.parent / ".pytest_cache" / "compiled"
_CACHE.mkdir(parents=True, exist_ok=True)
jax.config.update("jax_compilation_cache_dir", str(_CACHE))
jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.5)


def pytest_addoption(parser):
    """Options of the long campaign and of the benchmarks; here because options of folders below are read too late."""
    parser.addoption("--report-to", default="benchmark_report", help="folder of the report of all benchmarks")
    parser.addoption(
        "--campaign", type=int, default=0, metavar="N", help="random scenes of tests/campaign, all together"
    )
    parser.addoption("--campaign-seed", type=int, default=0, help="of the random scenes")
    parser.addoption("--campaign-file", type=Path, default=Path("campaign.json"), help="for the cases that fail")
    parser.addoption(
        "--within",
        type=float,
        metavar="SECONDS",
        help="tests that have not begun so long after the start are skipped, and the summary says how many",
    )
    parser.addoption(
        "--begin-at",
        default="",
        metavar="TEXT",
        help="the files begin at another one for each text, such as the name of a commit: runs that end before the "
        "last file (--within) see all of them in turn",
    )


_BEGIN = time.monotonic()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item):
    """Machines differ by a factor of two and more: a run that must end in time leaves out what comes last."""
    within = item.config.getoption("within")
    if within is not None and time.monotonic() - _BEGIN > within:
        pytest.skip(f"not begun within {within:g} s of the start (--within)")


_FLAGS = (
    "--xla_cpu_parallel_codegen_split_count=1",
    f"--xla_disable_hlo_passes={','.join(IDLE_PASSES)}",
)
"""For quick compilation: of the largest programs 38 instead of 62 s, with the older loop emitters of jaxlib 0.10."""


def pytest_configure():
    """Most of the time of the tests is spent in XLA: on a CPU they compile quickly, but for those that ask for
    `optimized`. Tracing comes next, a third of it Python's collector of garbage (`rare_garbage_collection`)."""
    gc.freeze()
    gc.set_threshold(*RARELY)
    if os.environ["JAX_PLATFORMS"] != "cpu":
        return
    jax.config.update("jax_disable_most_optimizations", True)
    os.environ.setdefault("JAX_DISABLE_MOST_OPTIMIZATIONS", "1")  # of the commands that tests start
    # a flag that is not known ends the process
    release = ".".join(jaxlib.__version__.split(".")[:2])
    if release in ("0.10", "0.12"):
        older = ["--xla_cpu_use_fusion_emitters=false"] if release == "0.10" else []
        os.environ.setdefault("XLA_FLAGS", " ".join([*older, *_FLAGS]))


def pytest_collection_modifyitems(config, items):
    """Tests of the whole package, long ones, come first: near the end a worker that has nothing left to do would wait
    for them. With `--begin-at` the files begin at another one, and go on from the first after the last."""
    here = Path(__file__).parent
    items.sort(key=lambda item: item.path.parent != here)
    text = config.getoption("begin_at")
    if text:
        from file_order import begun_at

        items[:] = begun_at(text, items)


# Each compiled program takes memory maps, of which Linux grants a process 65 530: a worker that has no more crashes.
_MAPS, _MANY_MAPS = Path("/proc/self/maps"), 15_000
# Traces, garbage once they have ended, are seldom collected by themselves; those that JAX keeps go with its caches.
_PAGES, _MUCH, _TOO_MUCH = Path("/proc/self/statm"), 2**30, 3 * 2**30
_resident_before = _resident_cleared = 0


def pytest_runtest_teardown(item, nextitem):
    """Compiled programs are let go of between modules and slow tests, where there are many or where the process has
    grown by 3 GiB; garbage, where it has grown by 1 GiB."""
    global _resident_before, _resident_cleared
    if nextitem is not None and nextitem.path == item.path and "slow" not in item.keywords:
        return
    if not _MAPS.exists():
        return
    grown = _resident() > _resident_cleared + _TOO_MUCH
    if grown or _MAPS.read_bytes().count(b"\n") > _MANY_MAPS:
        jax.clear_caches()
    if grown or _resident() > _resident_before + _MUCH:
        gc.collect()
        _return_free_memory()
        _resident_before = _resident()
    if grown:
        _resident_cleared = _resident_before


def _return_free_memory():
    """The compiler's threads leave gigabytes to the C library, which keeps them: a slow part of 600 tests ended with 10
    GiB in a process. This gives them back."""
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:
        trim(0)


def _resident():
    """Memory of this process, bytes."""
    return int(_PAGES.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.fixture
def optimized():
    """Programs as users run them."""
    before = jax.config.read("jax_disable_most_optimizations")
    jax.config.update("jax_disable_most_optimizations", False)
    yield
    jax.config.update("jax_disable_most_optimizations", before)
