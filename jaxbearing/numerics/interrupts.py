"""Ctrl-C while compiled programs run, and while files are written.

Python raises an exception at any place, which does not suit a process that runs XLA. The exception leaves the call, but
a thread goes on compiling or computing; if the interpreter then ends, this thread crashes (signal 11). An extension
module that is being loaded crashes in the same way. A command therefore ends at once, without unwinding
(`end_command_at_interrupt`). Code that has results to keep is notified, and stops between two computations
(`deferred_interrupts`).
"""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

INTERRUPTED = 130
_end_words = ["nothing was computed"]
"""Text for the message when Ctrl-C ends a command before or after its work; the list has one entry."""


class Deferral:
    """Record of a block of `deferred_interrupts`.

    **Attribute:** `seen`: True if Ctrl-C was pressed since the block began. Code that has dealt with it calls `taken`.
    """

    def __init__(self):
        self.seen, self._dealt_with = False, False

    def taken(self) -> None:
        """Says that the interrupt has been dealt with: no `KeyboardInterrupt` is raised at the end of the block."""
        self._dealt_with = True

    @property
    def pending(self) -> bool:
        return self.seen and not self._dealt_with


_blocks: list[Deferral] = []
"""Records of the blocks that are open, the innermost last."""
_listening: list[bool] = []
"""This list has an entry while another thread receives Ctrl-C."""


@contextmanager
def deferred_interrupts() -> Iterator[Deferral]:
    """Context that delays Ctrl-C to the end of the block.

    The first Ctrl-C is recorded. At the end of the block `KeyboardInterrupt` is raised, unless `Deferral.taken` was
    called. The second Ctrl-C has its usual effect at once. The context has no effect outside of the main thread, or if
    Ctrl-C is ignored."""
    deferral = Deferral()
    previous = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(previous):
        yield deferral
        return

    def note(number: int, frame: object) -> None:
        if _listening:
            return
        if deferral.seen:
            previous(number, frame)  # pyright: ignore[reportCallIssue, reportArgumentType]
        deferral.seen = True

    _blocks.append(deferral)
    signal.signal(signal.SIGINT, note)
    try:
        yield deferral
    finally:
        signal.signal(signal.SIGINT, previous)
        _blocks.remove(deferral)
    if deferral.pending:
        raise KeyboardInterrupt


@contextmanager
def listening() -> Iterator[None]:
    """Context in which another thread receives Ctrl-C before Python's handlers and calls `note_interrupt`. Python's
    handlers do nothing."""
    previous = signal.signal(signal.SIGINT, lambda number, frame: None)
    _listening.append(True)
    try:
        yield
    finally:
        _listening.pop()
        signal.signal(signal.SIGINT, previous)


def note_interrupt() -> bool:
    """Records a Ctrl-C in the innermost block; True if there is a block and this is the first one in it."""
    if not _blocks or _blocks[-1].seen:
        return False
    _blocks[-1].seen = True
    return True


def end_command_at_interrupt() -> None:
    """Makes Ctrl-C end the process with code 130 from now on, if the process is the command `jaxbearing`.

    It must be called before anything large is imported. A program that imports the package keeps its own handler."""
    main_thread = threading.current_thread() is threading.main_thread()
    if main_thread and is_the_command() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, lambda number, frame: end_now(f"interrupted: {_end_words[0]}\n".encode()))


def say_at_end(words: str) -> None:
    """Sets the text that follows "interrupted: " when Ctrl-C ends a command whose work is done."""
    _end_words[0] = words


def is_the_command() -> bool:
    """True if this process was started as `jaxbearing ...` or `python -m jaxbearing ...`."""
    words = iter(sys.orig_argv[1:])
    for word in words:
        if word in ("-X", "-W"):
            next(words, None)
        elif word == "-m":
            return next(words, "") == "jaxbearing"
        elif word == "-c" or not word.startswith("-"):
            return word != "-c" and Path(word).stem == "jaxbearing"
    return False


def end_now(message: bytes, stream: int = 2) -> NoReturn:
    """Ends the process with code 130, without unwinding.

    **Arguments:** `stream`: file descriptor that gets the message.
    """
    try:
        os.write(stream, message)
    except OSError:
        pass
    finally:
        os._exit(INTERRUPTED)
