"""The folder of compiled programs: it is in the user's cache folder, and each kind of processor has its own."""

import hashlib
import os
import platform
from pathlib import Path

VARIABLE = "JAXBEARING_CACHE"
"""Environment variable: `off`, `on` (as without it: the user's cache folder), or a folder."""
_OFF = ("off", "0", "no", "false")
_ON = ("", "on", "1", "yes", "true")


def cache_folder() -> Path | None:
    """The folder of compiled programs, or `None` where keeping is switched off or there is no home folder.

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
