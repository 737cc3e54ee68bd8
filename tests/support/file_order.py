"""Order of the files of a run of the tests."""

import hashlib
from collections.abc import Sequence
from typing import Any


def begun_at(text: str, items: Sequence[Any]) -> list[Any]:
    """The tests in an order that begins at another file for each text and goes on from the first one after the last.

    The tests of a file stay together, in their order. **Arguments:** `items`: tests with their `path`, by files.
    """
    files = {path: place for place, path in enumerate(dict.fromkeys(item.path for item in items))}
    first = int(hashlib.sha256(text.encode()).hexdigest(), 16) % max(len(files), 1)
    return sorted(items, key=lambda item: (files[item.path] - first) % len(files))
