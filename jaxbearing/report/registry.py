"""The one list of kinds of results, with the folder that makes the outputs of each.

A folder has a module for each output that the kind has, with the function that `_FUNCTIONS` names. They are imported
when they are wanted: a solve on the screen needs no reader of files and no library of charts.
"""

import importlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .._scene import AbstractSolution


FOLDERS = {
    "jaxbearing.bearings.solution.Solution": "bearing",
    "jaxbearing.machines.two_disk.TwoDiskSolution": "two_disk",
    "jaxbearing.ehl.solution.LineContactSolution": "line_contact",
    "jaxbearing.shafts.solution.ShaftSolution": "shaft",
}
"""Kinds of steady results, by their names: the classes of kinds that are not shown need not be imported."""
RUNS = {
    "jaxbearing.bearings.motion.history.History": "bearing.run",
    "jaxbearing.bearings.warming.history.WarmUpHistory": "bearing.warming",
    "jaxbearing.ehl.history.LineContactHistory": "line_contact.run",
}
"""Kinds of transient runs."""
_FUNCTIONS = {
    "summary": "print_summary",
    "json_report": "to_dict",
    "dataset": "to_dataset",
    "plots": "plot",
    "page_content": "page_content",
    "animation": "animate",
}
"""Module of an output -> its function."""


def output(result: object, module: str, called: str, kinds: dict[str, str] = FOLDERS) -> Callable[..., Any]:
    """The function that makes an output of this kind of result.

    **Arguments:**
    - `module`: name of the output in `_FUNCTIONS`.
    - `called`: the output in words, for the message.

    **Raises:** `TypeError` for a kind that is not listed.
    """
    names = (f"{kind.__module__}.{kind.__qualname__}" for kind in type(result).__mro__)
    folder = next((kinds[name] for name in names if name in kinds), None)
    if folder is None:
        raise TypeError(f"no {called} of a {type(result).__name__}")
    found: Callable[..., Any] = getattr(importlib.import_module(f".{folder}.{module}", __package__), _FUNCTIONS[module])
    return found


def check_converged(solution: "AbstractSolution") -> None:
    """Checks that a solution has results.

    **Raises:** `ValueError` for a solution that did not converge.
    """
    if not bool(np.all(solution.converged)):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
