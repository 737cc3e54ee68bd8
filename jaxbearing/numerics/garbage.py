"""Fewer runs of Python's garbage collector, which would search the objects of imports and traces again and again."""

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

RARELY = (100_000, 20, 10)
"""Thresholds of Python's garbage collector: new objects before a collection, and collections before one of older
objects."""


class _Depth:
    """Number of blocks of all threads inside `rare_garbage_collection`, and the thresholds before the first one."""

    lock = threading.Lock()
    inside = 0
    before = gc.get_threshold()


@contextmanager
def rare_garbage_collection() -> Iterator[None]:
    """Context in which programs are traced in 0.65 of the time.

    A trace makes millions of objects that live until it ends, and the garbage collector would search them again and
    again. Its thresholds belong to the process: the first thread that enters sets them, and the last one that leaves
    restores them."""
    with _Depth.lock:
        if _Depth.inside == 0:
            _Depth.before = gc.get_threshold()
            if 0 < _Depth.before[0] < RARELY[0]:
                gc.set_threshold(*RARELY)
        _Depth.inside += 1
    try:
        yield
    finally:
        with _Depth.lock:
            _Depth.inside -= 1
            # in later versions of Python the third number is always 0
            if _Depth.inside == 0 and gc.get_threshold()[:2] == RARELY[:2]:
                gc.set_threshold(*_Depth.before)
