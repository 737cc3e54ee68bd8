"""Which folder makes the outputs of a kind of result: the one list of kinds.

A folder has a module for each output that the kind has, with the function that `_FUNCTIONS` names. They are imported
when they are wanted: a solve on the screen needs no reader of files and no library of charts.
"""

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np

from ..bearings.motion.history import History
from ..bearings.solution import Solution
from ..ehl import LineContactHistory, LineContactSolution
from ..machines import TwoDiskSolution

FOLDERS: dict[type, str] = {
    Solution: "bearing",
    TwoDiskSolution: "two_disk",
    LineContactSolution: "line_contact",
}
"""Kinds of steady results."""
RUNS: dict[type, str] = {
    History: "bearing.run",
    LineContactHistory: "line_contact.run",
}
"""Kinds of runs in time."""
_FUNCTIONS = {
    "summary": "print_summary",
    "json_report": "to_dict",
    "dataset": "to_dataset",
    "plots": "plot",
    "page_content": "page_content",
    "animation": "animate",
}
"""Module of an output -> its function."""


def output(result: Any, module: str, called: str, kinds: dict[type, str] = FOLDERS) -> Callable[..., Any]:
    """The function that makes an output of this kind of result.

    **Arguments:**
    - `module`: name of the output in `_FUNCTIONS`.
    - `called`: the output in words, for the message.

    **Raises:** `TypeError` for a kind that is not listed.
    """
    folder = next((folder for kind, folder in kinds.items() if isinstance(result, kind)), None)
    if folder is None:
        raise TypeError(f"no {called} of a {type(result).__name__}")
    found: Callable[..., Any] = getattr(importlib.import_module(f".{folder}.{module}", __package__), _FUNCTIONS[module])
    return found


def check_converged(solution: Any) -> None:
    """**Raises:** `ValueError` for a solution that did not converge: it has no results."""
    if not bool(np.all(solution.converged)):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
