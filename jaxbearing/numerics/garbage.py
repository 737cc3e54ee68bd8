"""Python's collector of garbage, which looks again and again through what imports and traces make."""

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

RARELY = (100_000, 20, 10)
"""New objects that Python's collector of garbage waits for, and collections of the young before one of the older."""


class _Depth:
    """Holds how many are inside `rare_garbage_collection`, of all threads, and the thresholds of before."""

    lock = threading.Lock()
    inside = 0
    before = gc.get_threshold()


@contextmanager
def rare_garbage_collection() -> Iterator[None]:
    """Traces programs in 0.65 of the time: a trace makes millions of objects that live until it ends, and Python's
    collector of garbage would look through them again and again. The thresholds are those of the process: the first
    thread in sets them, the last one out sets them back."""
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
            # of later Pythons the third number is always 0
            if _Depth.inside == 0 and gc.get_threshold()[:2] == RARELY[:2]:
                gc.set_threshold(*_Depth.before)
