"""`jb.solve` says nothing on stderr, whatever the compiler of JAX finds remarkable."""

import os
import re
import subprocess
import sys

import pytest

SOLVE = """
import jax
import jaxbearing as jb
from jaxbearing.numerics import quiet


def heard(event, *_, **__):
    # on any processor: not every one is complained about
    if "backend_compile" in event and quiet.compiler_is_loud() and not quiet._HOLDING.locked():
        print("compiled aloud", file=sys.stderr)


jax.monitoring.register_event_duration_secs_listener(heard)

scene = jb.load_scene("reference_roller", {"contact": "none"})
assert bool(jb.solve(scene).converged)
"""
ALL = """
assert bool(jb.solve(scene.at_operation(radial_load=1e3), optimised=True).converged)
assert bool((jb.sweep(scene, {"operation.radial_load": [1e3, 2e3]}).failure == "").all())
"""


def stderr_of(order, cache, program=SOLVE, **environment):
    """Standard error of a process that imports these modules in this order and loads compiled programs from a cache:
    then jaxlib complains on each of them about the processor (jax issue 38445)."""
    settings = {"JAX_COMPILATION_CACHE_DIR": str(cache), "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0"}
    inherited = {name: value for name, value in os.environ.items() if name != "TF_CPP_MIN_LOG_LEVEL"}
    paths = {"PYTHONPATH": os.pathsep.join(sys.path), "JAX_ENABLE_COMPILATION_CACHE": "true"}
    code = f"import sys\nimport {order}\n{program}\nprint('done', file=sys.stderr)"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**inherited, **paths, **settings, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stderr


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """Compiled programs of a first process, of all ways to solve: each is quiet where JAX was imported before."""
    folder = tmp_path_factory.mktemp("cache")
    assert stderr_of("jax, jaxbearing", folder, SOLVE + ALL) == "done\n"
    return folder


@pytest.mark.parametrize(("order", "program"), [("jaxbearing", SOLVE), ("jax, jaxbearing", SOLVE + ALL)])
def test_nothing_but_what_the_program_itself_says(order, program, cache):
    """Where JAX was imported before, each way to solve is quiet by itself; else a level of the compiler does it."""
    assert stderr_of(order, cache, program) == "done\n"


@pytest.mark.slow
@pytest.mark.parametrize("order", ["jaxbearing", "jax, jaxbearing"])
def test_started_by_a_program_that_uses_jax(order, cache):
    """JAX sets the level of its compiler to 1 for itself and for what it starts."""
    assert stderr_of(order, cache, SOLVE + ALL, TF_CPP_MIN_LOG_LEVEL="1") == "done\n"


def test_the_level_of_the_user_stands(cache):
    """XLA says what it does, whatever the processor; the loader complains on those only whose gathers LLVM tunes (the
    complaint did not come on an older EPYC, with the package as it was either)."""
    said = stderr_of("jaxbearing", cache, TF_CPP_MIN_LOG_LEVEL="0")
    assert re.search(r"^I\d{4} .*\b(pjrt_client|cpu_aot_loader)\.cc:\d+\]", said, flags=re.MULTILINE), said
    assert said.endswith("done\n")
