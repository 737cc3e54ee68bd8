"""Registry of the kinds of results, with the folder whose modules make the outputs of each kind.

A folder has one module for each output of its kind, with the function that `_FUNCTIONS` names. Modules are imported
only when they are needed: printing a solution needs neither file formats nor plotting libraries.
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
"""Class name of a steady result -> folder. Names, not classes, so that unused classes need not be imported."""
RUNS = {
    "jaxbearing.bearings.motion.history.History": "bearing.run",
    "jaxbearing.bearings.warming.history.WarmUpHistory": "bearing.warming",
    "jaxbearing.ehl.history.LineContactHistory": "line_contact.run",
}
"""Class name of a transient run -> folder."""
_FUNCTIONS = {
    "summary": "print_summary",
    "json_report": "to_dict",
    "dataset": "to_dataset",
    "plots": "plot",
    "page_content": "page_content",
    "animation": "animate",
}
"""Module of an output -> name of the function in it."""


def output(result: object, module: str, called: str, kinds: dict[str, str] = FOLDERS) -> Callable[..., Any]:
    """The function that makes an output of a result.

    **Arguments:**
    - `module`: name of the output in `_FUNCTIONS`.
    - `called`: the output in words, for the error message.

    **Raises:** `TypeError` for a result whose class is not in `kinds`.
    """
    names = (f"{kind.__module__}.{kind.__qualname__}" for kind in type(result).__mro__)
    folder = next((kinds[name] for name in names if name in kinds), None)
    if folder is None:
        raise TypeError(f"no {called} of a {type(result).__name__}")
    function: Callable[..., Any] = getattr(
        importlib.import_module(f".{folder}.{module}", __package__), _FUNCTIONS[module]
    )
    return function


def check_converged(solution: "AbstractSolution") -> None:
    """Checks that a solution converged.

    **Raises:** `ValueError` if it, or any lane of a batch, did not.
    """
    if not bool(np.all(solution.converged)):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
