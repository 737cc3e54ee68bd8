"""Traces and compiles a program once, stores it in a file, and loads it in later processes.

JAX's own cache stores compiled programs too. To find a program there, JAX must first trace and lower it, which takes
longer than all the rest of a solve. Here a program is found by the inputs of its compilation: the structure of the
arguments with all static values, shapes and types, the files of this package, the versions of the libraries, the
processor, and the settings of the compiler. A loaded program is identical to the stored one. Settings of JAX are
changed only while a program for the cache is compiled (`_compiled_for_keeps`).

If a file is damaged, belongs to another user or has another format, the program is compiled again and the file is
overwritten (`programs.files`). Files hold code and pickled data. Therefore a file is read only if it belongs to the
user and nobody else may write it.
"""

import dataclasses
import functools
import hashlib
import importlib.metadata
import os
import pickle
import threading
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeAlias, TypeGuard, TypeVar

import equinox as eqx
import jax
import numpy as np
from jax.experimental.compilation_cache.compilation_cache import reset_cache
from jax.extend.core import Jaxpr
from jax.stages import Compiled

from ..numerics.compiling import quick_options, quickly_compiled
from ..numerics.garbage import rare_garbage_collection
from ..numerics.quiet import compiling_quietly, quiet_first_time
from . import files
from .describe import OWN, ROOT, NotKept, Structure, description, static_description
from .folder import VARIABLE, cache_folder

_LIBRARIES = ("jaxbearing", "jax", "jaxlib", "equinox", "optimistix", "lineax", "diffrax", "numpy")
_SETTINGS = ("jax_enable_x64", "jax_default_matmul_precision", "jax_disable_most_optimizations")
_FOR_DEBUGGING = ("jax_disable_jit", "jax_debug_nans", "jax_debug_infs")
"""No program is cached while one of these settings is on."""
_ENVIRONMENT = ("XLA_FLAGS", "EQX_ON_ERROR", "JAX_DISABLE_MOST_OPTIMIZATIONS")
ArrayLeaf: TypeAlias = jax.Array | np.ndarray | np.generic
"""A leaf of the arguments that is an array; programs take only these."""
Result = TypeVar("Result")
"""Result of the function of a program."""


class _Slot(NamedTuple):
    """Placeholder for an array of the result. `place`: index of the array among the outputs of the compiled program."""

    place: int


@dataclasses.dataclass
class _Ready:
    """A program and the structure of its result.

    - `others`: leaves of the result that are not arrays, with a `_Slot` in place of each array.
    - `instead`: function that compiles the program again; only for a loaded program that has not run yet.
    """

    compiled: Compiled
    structure: Structure
    others: list[object]
    instead: Callable[[], "_Ready"] | None = None

    @property
    def result(self) -> Any:
        """The result, with shapes for arrays."""
        shapes = self.compiled.out_info
        filled = [shapes[leaf.place] if isinstance(leaf, _Slot) else leaf for leaf in self.others]
        return jax.tree.unflatten(self.structure, filled)

    def __call__(self, leaves: list[object]) -> Any:
        arrays = self._run(_arrays(leaves)) if self.instead is None else self._first_run(_arrays(leaves))
        filled = [arrays[leaf.place] if isinstance(leaf, _Slot) else leaf for leaf in self.others]
        return jax.tree.unflatten(self.structure, filled)

    def _run(self, arrays: list[ArrayLeaf]) -> list[jax.Array]:
        return self.compiled(arrays)

    def _first_run(self, arrays: list[ArrayLeaf]) -> list[jax.Array]:
        """Runs a loaded program for the first time. If it fails although its file was intact, it is compiled again."""
        instead = self.instead
        try:
            results = jax.block_until_ready(self._run(arrays))
        except (jax.errors.JaxRuntimeError, TypeError):
            if instead is not None:
                made = instead()
                self.compiled, self.structure, self.others = made.compiled, made.structure, made.others
            results = self._run(arrays)
        self.instead = None
        return results


def _is_array(leaf: object) -> TypeGuard[ArrayLeaf]:
    return isinstance(leaf, ArrayLeaf)


def _arrays(leaves: list[object]) -> list[ArrayLeaf]:
    return [leaf for leaf in leaves if _is_array(leaf)]


class KeptProgram(Generic[Result]):
    """Works as `equinox.filter_jit(function)`, but stores its compiled programs for other processes.

    It must not be called where `numerics.compiling.inside_a_program` is true. A program is cached if it runs on one
    CPU, if its arguments are arrays and objects of this package, and if it does not call back to the host. Other
    programs are compiled again in each process, as with `filter_jit`.

    **Arguments:** `function`: a pure function, defined at the top level of a module; `quick`: True to compile quickly
    (see `numerics.compiling`).
    """

    def __init__(self, function: Callable[..., Result], quick: bool):
        self._function, self._quick = function, quick
        self._plain = quickly_compiled(function) if quick else eqx.filter_jit(function)
        self._ready: dict[Hashable, _Ready] = {}
        self._never: set[Hashable] = set()

    def __call__(self, *args: object) -> Result:
        leaves, structure = jax.tree.flatten(args)
        ready = self.ready(structure, leaves)
        if ready is not None:
            return ready(leaves)
        with quiet_first_time((self._function, self._quick, structure)):
            return self._plain(*args)

    def ready(self, structure: Structure, leaves: list[object]) -> Callable[[list[object]], Result] | None:
        """The program for arguments of this structure, as a function of their leaves. Arrays among the leaves must have
        the same shapes, and other leaves must be equal. The program is loaded, or compiled and stored. `None` if such
        programs are not cached."""
        return self._found(structure, leaves, make=True)

    def result(self, structure: Structure, leaves: list[object]) -> Result | None:
        """Result of the program for such arguments, with shapes instead of arrays; `None` if there is none yet."""
        program = self._found(structure, leaves, make=False)
        return None if program is None else program.result

    def _found(self, structure: Structure, leaves: list[object], make: bool) -> _Ready | None:
        folder = _folder()
        if folder is None:
            return None
        key = _key(structure, leaves)
        program = self._ready.get(key)
        if program is None and key not in self._never:
            try:
                program = self._prepared(structure, leaves, folder, make)
            except NotKept:
                self._never.add(key)
            if program is not None:
                self._ready[key] = program
        return program

    @rare_garbage_collection()
    def _prepared(self, structure: Structure, leaves: list[object], folder: Path, make: bool) -> _Ready | None:
        """Loads the program. If there is no file and `make` is True, compiles and stores it. **Raises:** `NotKept`."""
        path = folder / self._name(structure, leaves)
        with compiling_quietly():
            ready = _loaded(path)
            if ready is None:
                return self._made(structure, leaves, path) if make else None
        ready.instead = lambda: self._made(structure, leaves, path)
        return ready

    def _name(self, structure: Structure, leaves: list[object]) -> str:
        """The name of the file is a hash of all that the program depends on."""
        function = f"{self._function.__module__}.{self._function.__qualname__}"
        shapes = [(leaf.shape, str(leaf.dtype)) if _is_array(leaf) else static_description(leaf) for leaf in leaves]
        parts = (function, self._quick, description(structure), shapes, _versions(), _settings(), _files())
        return hashlib.sha256(repr(parts).encode()).hexdigest()[:40] + files.SUFFIX

    def _made(self, structure: Structure, leaves: list[object], path: Path) -> _Ready:
        outputs: list[tuple[Structure, list[object]]] = []

        def flat(inputs: list[jax.Array]) -> list[jax.Array]:
            arrays = iter(inputs)
            filled = [next(arrays) if _is_array(leaf) else leaf for leaf in leaves]
            others, whole = jax.tree.flatten(self._function(*jax.tree.unflatten(structure, filled)))
            arrays = [leaf for leaf in others if eqx.is_array(leaf)]
            places = iter(range(len(arrays)))
            outputs.append((whole, [_Slot(next(places)) if eqx.is_array(leaf) else leaf for leaf in others]))
            return arrays

        options = quick_options() if self._quick else None
        traced = jax.jit(flat, compiler_options=options).trace(_arrays(leaves))
        with _compiled_for_keeps():
            compiled = traced.lower().compile()
        ready = _Ready(compiled, *outputs[-1])
        if not _calls_host(traced.jaxpr.jaxpr):
            _keep(path, ready)
        return ready


def _key(structure: Structure, leaves: list[object]) -> Hashable:
    """The key of a program in the memory of this process. The hash in `_name` is the key of its file."""
    about = tuple((leaf.shape, leaf.dtype) if _is_array(leaf) else (type(leaf), leaf) for leaf in leaves)
    return structure, about, _settings()


def _setting(name: str) -> object:
    return getattr(jax.config, name, None)


_COMPILING = threading.Lock()
"""Held while settings of JAX are changed: another thread must not change them back."""


@contextmanager
def _compiled_for_keeps() -> Iterator[None]:
    """Changes settings of JAX while a program for the cache is lowered and compiled, and restores them afterwards.

    JAX's own cache is neither read nor written. A program that was loaded from it cannot be serialised again, because
    its functions are then not found, and a program that is written to it would be stored twice. The source locations of
    the operations are not recorded either, because that takes a quarter of the lowering time.
    """
    others = {"jax_traceback_in_locations_limit": 0}
    if _setting("jax_compilation_cache_dir"):
        others["jax_enable_compilation_cache"] = False
    with _COMPILING:
        before = {name: _setting(name) for name in others if _setting(name) is not None}
        for name in before:
            jax.config.update(name, others[name])
        reset_cache()
        try:
            yield
        finally:
            for name, value in before.items():
                jax.config.update(name, value)
            reset_cache()


def _calls_host(jaxpr: Jaxpr) -> bool:
    """True if a program contains a host callback. Such a program calls a Python function of the process that compiled
    it, which does not exist in other processes."""
    for equation in jaxpr.eqns:
        if "callback" in equation.primitive.name:
            return True
        parts = jax.tree.leaves(list(equation.params.values()), is_leaf=lambda part: hasattr(part, "eqns"))
        if any(_calls_host(getattr(part, "jaxpr", part)) for part in parts if hasattr(part, "eqns")):
            return True
    return False


def _folder() -> Path | None:
    """The folder of the programs. `None` if caching is switched off, if the folder cannot be used, if JAX does not run
    on exactly one CPU device, or if a debugging setting is on (`_FOR_DEBUGGING`)."""
    setting = os.environ.get(VARIABLE, "")
    try:
        folder = _known_folder(setting)
    except ValueError:
        return None
    alone = jax.default_backend() == "cpu" and len(jax.devices()) == 1
    return folder if alone and not any(_setting(name) for name in _FOR_DEBUGGING) else None


@functools.cache
def _known_folder(setting: str) -> Path | None:
    folder = cache_folder()
    return folder if folder is not None and files.own_folder(folder) else None


def _times() -> str | None:
    """Names, sizes and times of the files of the packages; `None` where there are none, as in an archive."""
    digest = hashlib.sha256()
    try:
        paths = _paths()
        for path in paths:
            about = path.stat()
            digest.update(f"{path} {about.st_size} {about.st_mtime_ns}\n".encode())
    except OSError:
        return None
    return digest.hexdigest() if any(path.suffix == ".py" for path in paths) else None


@functools.cache
def _files() -> str:
    """Hash of the contents of all package files: a changed file leads to new programs.

    **Raises:** `NotKept` if the files cannot be read or have changed since they were imported.
    """
    digest = hashlib.sha256()
    try:
        for path in _paths():
            digest.update(f"{path.relative_to(ROOT)}\n".encode() + hashlib.sha256(path.read_bytes()).digest())
    except OSError:
        raise NotKept("files of the package") from None
    if _TIMES is None or _times() != _TIMES:
        raise NotKept("files that were changed after they were imported")
    return digest.hexdigest()


def _paths() -> list[Path]:
    """All files of the packages except compiled and hidden ones. Editors create hidden files."""
    paths: list[Path] = []
    for package in OWN:
        for root, folders, names in os.walk(ROOT / package):
            folders[:] = [name for name in folders if name != "__pycache__" and not name.startswith(".")]
            paths += (Path(root) / name for name in names if not name.startswith("."))
    return sorted(paths)


_TIMES = _times()
"""State of the files when this package was imported. Files that change later may differ from the running code."""


def _settings() -> tuple[str | None, ...]:
    """Values of the JAX settings and environment variables that change compiled programs; a part of the key."""
    settings = (str(_setting(name)) for name in _SETTINGS)
    return (*settings, *(os.environ.get(name) for name in _ENVIRONMENT))


@functools.cache
def _versions() -> list[str | None]:
    versions: list[str | None] = []
    for name in _LIBRARIES:
        try:
            versions.append(importlib.metadata.version(name))
        except importlib.metadata.PackageNotFoundError:
            versions.append(None)
    return versions


def _keep(path: Path, ready: _Ready) -> None:
    """Writes a program. A failure, as on a full disk, is ignored: the cache only saves time."""
    from jax.experimental.serialize_executable import serialize

    if _times() != _TIMES:
        return
    with suppress(Exception):
        program, _, _ = serialize(ready.compiled)
        skeleton = jax.tree.unflatten(ready.structure, ready.others)
        text = ready.compiled.as_text()
        calls_lapack = text is None or "lapack" in text
        files.write(path, pickle.dumps((program, ready.compiled.in_tree.num_leaves, skeleton, calls_lapack)))


def _loaded(path: Path) -> _Ready | None:
    """The program of a file, or `None` where there is none that can be used."""
    from jax.experimental.serialize_executable import deserialize_and_load

    content = files.read(path)
    if content is None:
        return None
    with suppress(Exception):
        program, count, skeleton, calls_lapack = pickle.loads(content)
        others, structure = jax.tree.flatten(skeleton, is_leaf=lambda leaf: isinstance(leaf, _Slot))
        arrays = sum(isinstance(leaf, _Slot) for leaf in others)
        inputs, result = jax.tree.structure((([0] * count,), {})), jax.tree.structure([0] * arrays)
        with ThreadPoolExecutor(1) as beside:  # neither of the two tasks holds the GIL for long
            lapack = beside.submit(_initialise_lapack) if calls_lapack else None
            loaded = deserialize_and_load(program, inputs, result)
            if lapack is not None:
                lapack.result()
        return _Ready(loaded, structure, others)
    return None


@functools.cache
def _initialise_lapack() -> None:
    """Makes JAX look up the functions of LAPACK. JAX does this only when it lowers a program that calls one of them.
    Without the look-up, a loaded program that calls LAPACK would crash the process."""
    jax.jit(jax.lax.linalg.cholesky).lower(jax.ShapeDtypeStruct((2, 2), np.float64))
