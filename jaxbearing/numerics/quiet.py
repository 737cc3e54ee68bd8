"""Removal of the compiler's false alarms from stderr."""

import os
import sys
import tempfile
import threading
from collections.abc import Hashable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

_FALSE_ALARMS = (
    b"cpu_aot_loader",
    b"Algebraic simplifier is likely stuck",
    b"slow_operation_alarm",
    b"Very slow compile",
    b"*" * 32,
)
"""Texts in lines that are false alarms.

The loader of cached programs complains about the tuning flags prefer-no-gather and prefer-no-scatter, which no
processor lists (jax issue 38445, openxla/xla issue 44565). The program is correct, because each kind of processor has
its own cache. The simplifier reports that it stopped rewriting one form into another and back; both are correct. The
alarm of a slow compilation is framed by lines of stars."""


_HOLDING = threading.Lock()
_LEVEL = "TF_CPP_MIN_LOG_LEVEL"


def silence_compiler() -> None:
    """Makes the compiler print fatal errors only, unless the user has set its level.

    It has no effect once JAX has been imported, which reads the level only then."""
    if "jax" not in sys.modules:
        # other programs set 1 and 2, and so does JAX in a process that starts this one: false alarms pass them
        _State.silent = os.environ.setdefault(_LEVEL, "3") not in ("1", "2")


class _State:
    silent = False
    """True if the level of the compiler's messages suppresses false alarms, or the user asks for all messages."""


def compiler_is_loud() -> bool:
    """True if JAX was imported before its level could be set, and the user does not ask for all messages."""
    return not _State.silent and os.environ.get(_LEVEL) != "0"


def compiling_quietly() -> AbstractContextManager[None]:
    """Context of a block that compiles or loads a program: it suppresses false alarms if the compiler prints any."""
    return without_false_alarms() if compiler_is_loud() else nullcontext()


_SEEN: set[Hashable] = set()


@contextmanager
def quiet_first_time(key: Hashable) -> Iterator[None]:
    """Context of a block that compiles a program at the first call with a key; it suppresses false alarms only then."""
    if not compiler_is_loud() or key in _SEEN:
        yield
        return
    with without_false_alarms():
        yield
    _SEEN.add(key)


@contextmanager
def without_false_alarms() -> Iterator[None]:
    """Context that holds back all output to stderr, also of compiled libraries, and prints it at the end without the
    false alarms. It has no effect if another thread is inside it."""
    if not _HOLDING.acquire(blocking=False):
        yield
        return
    try:
        with _held_back():
            yield
    finally:
        _HOLDING.release()


@contextmanager
def _held_back() -> Iterator[None]:
    try:
        sys.stderr.flush()
        held = tempfile.TemporaryFile()  # noqa: SIM115 (closed below, where the body's own errors pass)
        real = os.dup(2)
    except (OSError, ValueError, AttributeError):
        # no stderr, so that nothing is to be kept clean; or no place to hold anything back
        yield
        return
    with held:
        os.dup2(held.fileno(), 2)
        try:
            yield
        finally:
            sys.stderr.flush()
            os.dup2(real, 2)
            os.close(real)
            held.seek(0)
            for line in held:
                if not any(alarm in line for alarm in _FALSE_ALARMS):
                    sys.stderr.write(line.decode(errors="replace"))
            sys.stderr.flush()
