"""Removal of messages without consequences from stderr, which is for messages to the user."""

import logging

from ..numerics.quiet import without_false_alarms as without_false_alarms


def only_news() -> None:
    """Leaves out what libraries log that changes nothing for the user; to be called before they are imported."""
    for name in ("jax._src.xla_bridge", "matplotlib"):
        logging.getLogger(name).addFilter(_is_news)


_NO_NEWS = ("Falling back to cpu", "mkdir -p failed", "MPLCONFIGDIR")


def _is_news(record: logging.LogRecord) -> bool:
    """JAX says on every start that a GPU is there which its build cannot use; the answer is the same without it.
    matplotlib says in two lines that it cannot keep its list of fonts where there is no home; so is the picture."""
    return not any(words in record.getMessage() for words in _NO_NEWS)
