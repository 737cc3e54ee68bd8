"""Keeps false alarms of the compiler off stderr, which belongs to messages for the user."""

import logging
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

_FALSE_ALARMS = (b"cpu_aot_loader", b"Algebraic simplifier is likely stuck")
"""Loading a cached program complains about the tuning flags prefer-no-gather and prefer-no-scatter, which no processor
lists (jax issue 38445, openxla/xla issue 44565). The program is sound: the cache is kept apart by processor. The
simplifier says that it stopped rewriting one form into another and back; both are right."""


@contextmanager
def without_false_alarms() -> Iterator[None]:
    """Holds back what anyone writes to stderr, compiled libraries too; passes it on at the end, less the alarms."""
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


def only_news() -> None:
    """Leaves out what libraries log that changes nothing for the user; to be called before they are imported."""
    for name in ("jax._src.xla_bridge", "matplotlib"):
        logging.getLogger(name).addFilter(_is_news)


_NO_NEWS = ("Falling back to cpu", "mkdir -p failed", "MPLCONFIGDIR")


def _is_news(record: logging.LogRecord) -> bool:
    """JAX says on every start that a GPU is there which its build cannot use; the answer is the same without it.
    matplotlib says in two lines that it cannot keep its list of fonts where there is no home; so is the picture."""
    return not any(words in record.getMessage() for words in _NO_NEWS)
