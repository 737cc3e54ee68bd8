"""A run in time on the screen, as numbers, as a data set, as a page of plots and in motion, whatever its kind."""

from typing import TYPE_CHECKING, Any

from ..bearings.motion.history import History
from ..ehl import EHLLineContact, LineContactHistory
from ..ehl.history import SOLVER
from ..numerics.status import SolveError

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.figure
    import xarray as xr
    from rich.console import Console

# what draws, prints and writes files is imported only where it is wanted


def history_to_dict(history: Any) -> dict[str, Any]:
    """The run as plain numbers and texts in SI units; what is not finite is `None`."""
    if isinstance(history, LineContactHistory):
        from .line_contact.json_report import film_history_to_dict

        return film_history_to_dict(history)
    from .history_summary import history_to_dict as bearing

    return bearing(_known(history))


def not_begun_to_dict(scene: Any, duration: float | None, error: SolveError) -> dict[str, Any]:
    """A run whose start was not found, with the keys that `history_to_dict` has and nothing in those of results."""
    from ..bearings.checks import input_excess
    from ..bearings.motion.settings import Simulation
    from .plain import plain

    film, simulation = isinstance(scene, EHLLineContact), scene.simulation
    wanted = duration if duration is not None else getattr(simulation, "duration", None)
    common = {
        "completed": False,
        "status": error.status.text,
        "interrupted": False,
        "warnings": [] if film else [text for text, excess in input_excess(scene).items() if excess > 0],
        "time": {"start": None, "stop": None, "wanted": None if wanted is None else float(wanted)},
        "steps": {"accepted": 0, "rejected": 0},
        "solver": SOLVER if film else (simulation or Simulation()).solver,
        "energy_error": None,
        "operation": plain(scene.operation),
        "summary": {},
        "failure": str(error),
    }
    return common if film else common | {"not_modelled": None, "energy": None}


def print_history(history: Any, label: str, console: "Console") -> None:
    """The run on the screen."""
    if isinstance(history, LineContactHistory):
        from .line_contact.summary import print_film_history

        return print_film_history(history, label, console)
    from .history_summary import print_history as bearing

    return bearing(_known(history), label, console)


def history_to_dataset(history: Any) -> "xr.Dataset":
    """All results of a run with `units`, `long_name` and `path` on every variable."""
    if isinstance(history, LineContactHistory):
        from .line_contact.dataset import film_history_to_dataset

        return film_history_to_dataset(history)
    from .history_dataset import history_to_dataset as bearing

    return bearing(_known(history))


def plot_history(history: Any, title: str) -> "matplotlib.figure.Figure":
    """A page of plots of a run."""
    if isinstance(history, LineContactHistory):
        from .line_contact.plots import plot_film_history

        return plot_film_history(history, title)
    from .history_plots import plot_history as bearing

    return bearing(_known(history), title)


def animate_history(history: Any, scene: Any, title: str) -> "matplotlib.animation.FuncAnimation":
    """A run as moving pictures, for `animations.save_animation`. **Arguments:** `scene`: that of the run."""
    if isinstance(history, LineContactHistory):
        from .line_contact.animation import animate_film_history

        return animate_film_history(history, title)
    from .history_animation import animate_history as bearing

    return bearing(_known(history), scene, title)


def _known(history: Any) -> History:
    if not isinstance(history, History):
        raise TypeError(f"no report of a {type(history).__name__}")
    return history
