"""Ctrl-C that works at once."""

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

INTERRUPTED = 130


@contextmanager
def prompt_interrupt() -> Iterator[None]:
    """Ends the process with code 130 as soon as Ctrl-C is pressed, also while a program is being compiled.

    Python's own handler waits until the compiler returns, up to half a minute, and then unwinds through it (seen once:
    a crash). So the signal wakes a thread that ends the process there and then: nothing is flushed or cleaned up, and
    output that is being printed may stop anywhere. In another thread than the main one it changes nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    previous = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    watcher = threading.Thread(target=_end_at_interrupt, args=(reader,), daemon=True)
    watcher.start()
    try:
        yield
    finally:
        signal.set_wakeup_fd(previous)
        os.close(writer)
        watcher.join()
        os.close(reader)


def _end_at_interrupt(reader: int) -> None:
    while signals := os.read(reader, 16):
        if signal.SIGINT in signals:
            os._exit(INTERRUPTED)
