"""Outputs of a transient run of any kind: screen, numbers and texts, data set, page of plots, animation."""

from typing import TYPE_CHECKING, Any

from ..ehl import EHLLineContact
from ..ehl.history import SOLVER
from ..numerics.status import SolveError
from .registry import RUNS, output
from .round_off import without_round_off

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.figure
    import xarray as xr
    from rich.console import Console

    from .._scene import AbstractHistory, AbstractScene

_CALLED = "report"


def history_to_dict(history: "AbstractHistory") -> dict[str, Any]:
    """The run as plain numbers and texts in SI units; numbers that are not finite are `None`.

    Numbers below the resolution of the solve are 0, as on the screen (`report.round_off`).
    """
    return output(history, "json_report", _CALLED, RUNS)(without_round_off(history))


def not_begun_to_dict(scene: Any, duration: float | None, error: SolveError) -> dict[str, Any]:
    """The output of a run whose initial state was not found: it has the keys of `history_to_dict`, without results."""
    from ..bearings.checks import input_excess
    from ..bearings.motion.settings import Simulation
    from ..bearings.warming.runs import settings_of
    from .backends.json import plain

    film, simulation = isinstance(scene, EHLLineContact), getattr(scene, "simulation", None)
    if film:
        solver = SOLVER
    else:
        solver = (simulation or Simulation()).solver if scene.thermal is None else settings_of(scene, None).solver
    wanted = duration if duration is not None else getattr(simulation, "duration", None)
    common = {
        "completed": False,
        "status": error.status.text,
        "interrupted": False,
        "warnings": [] if film else [text for text, excess in input_excess(scene).items() if excess > 0],
        "time": {"start": None, "stop": None, "wanted": None if wanted is None else float(wanted)},
        "steps": {"accepted": 0, "rejected": 0},
        "solver": solver,
        "energy_error": None,
        "operation": plain(scene.operation),
        "summary": {},
        "failure": str(error),
    }
    return common if film else common | {"not_modelled": None, "energy": None}


def print_history(history: "AbstractHistory", label: str, console: "Console") -> None:
    """Prints a summary of the run on the screen."""
    output(history, "summary", _CALLED, RUNS)(without_round_off(history), label, console)


def history_to_dataset(history: "AbstractHistory") -> "xr.Dataset":
    """All results of a run with `units`, `long_name` and `path` on every variable."""
    return output(history, "dataset", _CALLED, RUNS)(history)


def plot_history(history: "AbstractHistory", title: str) -> "matplotlib.figure.Figure":
    """A page of plots of a run."""
    return output(history, "plots", _CALLED, RUNS)(without_round_off(history), title)


def animate_history(
    history: "AbstractHistory", scene: "AbstractScene", title: str
) -> "matplotlib.animation.FuncAnimation":
    """An animation of a run, for `save_animation`. **Arguments:** `scene`: scene of the run."""
    return output(history, "animation", _CALLED, RUNS)(without_round_off(history), scene, title)
