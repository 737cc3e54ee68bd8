"""The command in a process of its own, with other surroundings."""

import os
import subprocess
import sys

import jax

DRY = ("--set", "contact=none")


def environment(**more):
    """Of a process of its own; None takes a variable out."""
    # the package that is tested, wherever another one may be installed
    here = {"PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "JAXBEARING_CACHE": "off"}
    if "JAXBEARING_CACHE" not in more:
        # JAX's own cache, that of the tests: the same scene is not compiled for each of them
        here |= {"JAX_COMPILATION_CACHE_DIR": jax.config.jax_compilation_cache_dir or ""}
    variables = os.environ | here | more
    return {name: value for name, value in variables.items() if value is not None}


def start(folder, *arguments, before=None, **variables):
    """The command in a process of its own. **Arguments:** `before`: Python that is run before it."""
    command = [sys.executable, "-m", "jaxbearing", *arguments]
    if before is not None:
        program = f"import runpy\n{before}\nrunpy.run_module('jaxbearing', run_name='__main__')"
        command = [sys.executable, "-c", program, *arguments]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "encoding": "utf-8", "errors": "surrogateescape"}
    return subprocess.Popen(command, cwd=folder, env=environment(**variables), **streams)


def run(folder, *arguments, before=None, **variables):
    process = start(folder, *arguments, before=before, **variables)
    out, err = process.communicate(timeout=300)
    return process.returncode, out, err
