"""The end of a command."""

import atexit
import os
import sys
import threading
from typing import NoReturn

from ..numerics.interrupts import is_the_command


def leave(code: int) -> NoReturn:
    """Ends the process with this code.

    A command ends at once, after what was registered for the end has run. Python would take every module and every
    compiled program apart first, which takes a sixth of the time of a warm solve. A program that calls `main`, and a
    process whose threads are still at work, end in Python's way.
    """
    alone = all(thread.daemon for thread in threading.enumerate() if thread is not threading.main_thread())
    if is_the_command() and alone:
        atexit._run_exitfuncs()
        if _flushed():
            os._exit(code)
    sys.exit(code)


def _flushed() -> bool:
    """True if all that was printed has been written; what cannot be written Python complains about at its end."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):
        return False
    return True
