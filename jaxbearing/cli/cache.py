"""Compiled programs kept between runs: a solve of a known kind of scene then starts without compiling."""

import os
import re
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..programs import cache_folder

_UNWRITTEN = re.compile(r"Error writing persistent compilation cache entry for '\w+': (?:\w+: )?(.*)")
_DAMAGED = re.compile(r"Error reading persistent compilation cache entry for '(\w+)'")


def enable_compilation_cache() -> Path | None:
    """Switch JAX's persistent cache on; returns its folder.

    `None` where it stays off: wanted so, chosen already by JAX's own `JAX_COMPILATION_CACHE_DIR`, or a folder that
    cannot be made or used, which is no error: a cache is a convenience. A folder that cannot even be named is said on
    stderr.
    """
    try:
        folder = cache_folder()
    except ValueError as error:
        print(f"warning: {error}; compiled programs are not kept.", file=sys.stderr)
        return None
    if folder is None or os.environ.get("JAX_COMPILATION_CACHE_DIR"):
        return None
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not os.access(folder, os.R_OK | os.W_OK | os.X_OK):
            return None
    except (OSError, ValueError):
        # ValueError: a null byte
        return None
    import jax

    jax.config.update("jax_compilation_cache_dir", str(folder))
    # the default keeps only programs that compiled for a second
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
    jax.config.update("jax_persistent_cache_min_entry_size_bytes", -1)
    warnings.showwarning = _in_words(folder, warnings.showwarning)
    return folder


def _in_words(folder: Path, show: Callable[..., None]) -> Callable[..., None]:
    """Instead of JAX's warning of an entry that it cannot read, as one that a killed run was writing: the entry goes.
    JAX never writes over one, and would compile and warn in every run that follows. Of entries that cannot be written,
    as on a full disk, one sentence is said."""
    reasons: set[str] = set()

    def showwarning(message: Warning | str, *where: object, **options: Any) -> None:
        unwritten = _UNWRITTEN.match(str(message))
        if unwritten is not None:
            if not reasons:
                print(f"warning: compiled programs are not kept in {folder}: {unwritten[1]}", file=sys.stderr)
            reasons.add(unwritten[1])
            return None
        damaged = _DAMAGED.match(str(message))
        if damaged is None:
            return show(message, *where, **options)
        for path in folder.glob(f"{damaged[1]}-*"):
            path.unlink(missing_ok=True)

    return showwarning
