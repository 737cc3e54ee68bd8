"""Compiled programs kept between runs: a solve of a known kind of scene then starts without compiling."""

import hashlib
import os
import platform
import re
import sys
import warnings
from pathlib import Path
from typing import Any

VARIABLE = "JAXBEARING_CACHE"
"""Environment variable: `off`, `on` (as without it: the user's cache folder), or a folder."""
_OFF = ("off", "0", "no", "false")
_ON = ("", "on", "1", "yes", "true")
_UNWRITTEN = re.compile(r"Error writing persistent compilation cache entry for '\w+': (?:\w+: )?(.*)")
_DAMAGED = re.compile(r"Error reading persistent compilation cache entry for '(\w+)'")


def cache_folder() -> Path | None:
    """Where compiled programs are kept, or `None`: switched off, or there is no home folder to keep them in.

    **Raises:** `ValueError` where the variable names a home folder that does not exist.
    """
    wanted = os.environ.get(VARIABLE, "").strip()
    if wanted.lower() in _OFF:
        return None
    if wanted.lower() not in _ON:
        try:
            return Path(wanted).expanduser() / _processor()
        except RuntimeError:
            raise ValueError(f"{VARIABLE}: found '{wanted}', a home folder that is not known") from None
    import platformdirs

    folder = Path(platformdirs.user_cache_dir("jaxbearing", appauthor=False))
    # where the home folder cannot be found out, "~" stays in front
    return folder / "compilation" / _processor() if folder.is_absolute() else None


def _processor() -> str:
    """A name of the processor's instruction set: on a home folder that machines share, a program compiled for a newer
    one would crash an older one."""
    features = f"{platform.machine()} {platform.processor()}"
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
            features += next((line for line in file if line.lower().startswith(("flags", "features"))), "")
    except OSError:
        pass
    return f"{platform.machine() or 'cpu'}-{hashlib.sha256(features.encode()).hexdigest()[:12]}"


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


def _in_words(folder: Path, show: Any) -> Any:
    """Instead of JAX's warning of an entry that it cannot read, as one that a killed run was writing: the entry goes.
    JAX never writes over one, and would compile and warn in every run that follows. Of entries that cannot be written,
    as on a full disk, one sentence is said."""
    said: set[str] = set()

    def showwarning(message: Any, *where: Any, **options: Any) -> None:
        unwritten = _UNWRITTEN.match(str(message))
        if unwritten is not None:
            if not said:
                print(f"warning: compiled programs are not kept in {folder}: {unwritten[1]}", file=sys.stderr)
            said.add(unwritten[1])
            return None
        found = _DAMAGED.match(str(message))
        if found is None:
            return show(message, *where, **options)
        for path in folder.glob(f"{found[1]}-*"):
            path.unlink(missing_ok=True)

    return showwarning
