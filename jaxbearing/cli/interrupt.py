"""Ctrl-C in a command: it ends at once with code 130, at any moment, and says what is kept.

"At once" is without unwinding: Python's own handler would wait until the compiler returns, up to half a minute, and
its exception would leave threads of XLA at work in a process that ends, which crashes it (`numerics.interrupts`). What
is written is written whole or not at all, so nothing is lost by it. A transient run that has results, and the writing
of results, are not ended but told: see `deferred_interrupts`.
"""

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import typer

from ..numerics.interrupts import end_now, listening, note_interrupt, say_at_end

NOTHING = "nothing was computed"
ALL = "all results are there"
_SHOW_CURSOR = b"\r\x1b[2K\x1b[?25h"
"""Escape sequence that shows the cursor again, which a progress bar hides."""
_WAIT = b"\r\ninterrupted: what is under way is finished first; Ctrl-C again ends it at once\r\n"


_words: list[Callable[[], str]] = [lambda: NOTHING]
"""Function of the text that Ctrl-C would print now; the list has one entry."""
_told: list[bool] = []
"""This list has an entry once the user has been told that the command was interrupted."""


def if_interrupted(words: str | Callable[[], str]) -> None:
    """Sets the text that follows "interrupted: " when Ctrl-C ends the command. **Arguments:** `words`, or a function
    that makes them, which is called in another thread."""
    _words[0] = (lambda: words) if isinstance(words, str) else words


def tell(elsewhere: bool = False) -> None:
    """Say on stderr that the command was interrupted, in the words of `if_interrupted`; once. **Arguments:**
    `elsewhere`: whether the results themselves say so."""
    if not _told and not elsewhere:
        typer.echo(f"interrupted: {_words[0]()}", err=True)
    _told.append(True)


@contextmanager
def prompt_interrupt() -> Iterator[None]:
    """Ctrl-C works at once inside the block, also while a program is being compiled or runs: the signal wakes a thread
    that ends the process there and then, less its temporary files. Output that is being printed may stop anywhere. In
    another thread than the main one it changes nothing; where Ctrl-C is ignored it stays ignored."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    if_interrupted(NOTHING)
    _told.clear()
    if not callable(signal.getsignal(signal.SIGINT)):
        yield
        return
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    # stderr may be held back
    stream = _duplicate(2)
    wakeup = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    watcher = threading.Thread(target=_watch, args=(reader, stream), daemon=True)
    watcher.start()
    try:
        with listening():
            yield
    finally:
        say_at_end(_words[0]())
        signal.set_wakeup_fd(wakeup)
        os.close(writer)
        watcher.join()
        os.close(reader)
        if stream is not None:
            os.close(stream)


def _duplicate(descriptor: int) -> int | None:
    try:
        return os.dup(descriptor)
    except OSError:
        return None


def _watch(reader: int, stream: int | None) -> None:
    while signals := os.read(reader, 16):
        for _ in range(signals.count(signal.SIGINT)):
            if not note_interrupt():
                _end(stream)
            if stream is not None and os.isatty(stream):
                with contextlib.suppress(OSError):
                    os.write(stream, _WAIT)


def _end(stream: int | None) -> None:
    message = b"interrupted\n"
    # whatever happens, the process ends
    with contextlib.suppress(Exception):
        files = sys.modules.get("jaxbearing.report.files")
        if files is not None:
            files.remove_unfinished()
        if os.isatty(1):
            os.write(1, _SHOW_CURSOR)
        message = f"interrupted: {_words[0]()}\n".encode(errors="replace")
    end_now(message, 2 if stream is None else stream)
