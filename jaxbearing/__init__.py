"""jaxbearing: lubricated rolling bearings in JAX, exact, fast, differentiable.

Importing the package switches JAX to 64-bit floats: the tolerances of its solves mean nothing in 32-bit. The command
imports JAX only if its verb needs it.

    import jaxbearing as jb

    scene = jb.load_scene("turbine_roller")
    solution = jb.solve(scene)
    solution.power_loss.total
"""

import importlib
import os
import sys
from typing import TYPE_CHECKING, Any

from ._forwarding import attributes_of, keep_old_modules
from ._version import __version__ as __version__
from .numerics.garbage import rare_garbage_collection
from .numerics.interrupts import end_command_at_interrupt, is_the_command
from .numerics.quiet import silence_compiler

end_command_at_interrupt()  # before anything large is imported
silence_compiler()
keep_old_modules()
if is_the_command():
    # statuses say what went wrong: a program that calls Python to raise an error of its own could not be kept
    os.environ.setdefault("EQX_ON_ERROR", "nan")
    # 64-bit floats for a command that imports JAX later, if at all
    os.environ["JAX_ENABLE_X64"] = "1"
if not is_the_command() or "jax" in sys.modules:
    with rare_garbage_collection():
        import jax

        jax.config.update("jax_enable_x64", True)


def load_verbs() -> None:
    """Imports the verbs that the package offers under the names of their modules.

    This happens at once, but in the command only when its verb is known: `jaxbearing new` needs none of them, and no
    bearing.
    """
    with rare_garbage_collection():
        from ._shown import shown_by
        from .simulate import simulate, simulate_batch
        from .solve import jit_solver, solve
        from .sweep import sweep

        shown_by(f"{__name__}.report.shown")
    # a module that is imported takes its name in the package
    verbs = (jit_solver, simulate, simulate_batch, solve, sweep)
    globals().update(zip(_AT_ONCE, verbs, strict=True))


if TYPE_CHECKING:
    from . import bearings as bearings
    from . import calibration as calibration
    from . import catalogue as catalogue
    from . import contacts as contacts
    from . import ehl as ehl
    from . import gaps as gaps
    from . import life as life
    from . import lubricants as lubricants
    from . import machines as machines
    from . import makers as makers
    from . import mounting as mounting
    from . import plots as plots
    from . import shafts as shafts
    from . import sweeps as sweeps
    from . import thermal as thermal
    from .bearings.ball.geometry import BallGeometry as BallGeometry
    from .bearings.ball.scene import BallAttitude as BallAttitude
    from .bearings.ball.scene import BallBearing as BallBearing
    from .bearings.ball.scene import BallCage as BallCage
    from .bearings.ball.scene import BallDragSettings as BallDragSettings
    from .bearings.ball.scene import BallMaterials as BallMaterials
    from .bearings.ball.scene import BallOperation as BallOperation
    from .bearings.cylindrical.geometry import RollerCage as RollerCage
    from .bearings.cylindrical.geometry import RollerFlange as RollerFlange
    from .bearings.cylindrical.geometry import RollerGeometry as RollerGeometry
    from .bearings.cylindrical.motion.instants import pocket_loads as pocket_loads
    from .bearings.cylindrical.scene import CylindricalRollerBearing as CylindricalRollerBearing
    from .bearings.motion.history import History as History
    from .bearings.motion.runs import trajectory as trajectory
    from .bearings.motion.settings import Simulation as Simulation
    from .bearings.motion.start import quasi_static_start as quasi_static_start
    from .bearings.operation import HeldDisplacement as HeldDisplacement
    from .bearings.operation import Operation as Operation
    from .bearings.parts import Drag as Drag
    from .bearings.parts import Materials as Materials
    from .bearings.profile import RollerProfile as RollerProfile
    from .bearings.rating import Rating as Rating
    from .bearings.solution import Solution as Solution
    from .bearings.tapered.geometry import TaperedCage as TaperedCage
    from .bearings.tapered.geometry import TaperedGeometry as TaperedGeometry
    from .bearings.tapered.scene import TaperedOperation as TaperedOperation
    from .bearings.tapered.scene import TaperedRollerBearing as TaperedRollerBearing
    from .bearings.warming.history import WarmUpHistory as WarmUpHistory
    from .bearings.warming.settings import WarmUpSimulation as WarmUpSimulation
    from .calibration.verb import calibrate as calibrate
    from .comparison import compare as compare
    from .distribution import Distribution as Distribution
    from .ehl import EHLLineContact as EHLLineContact
    from .joint import JointDistribution as JointDistribution
    from .machines import TwoDisk as TwoDisk
    from .makers import Catalogue as Catalogue
    from .materials import Material as Material
    from .mounting import Fits as Fits
    from .mounting import PartTemperatures as PartTemperatures
    from .numerics.newton import NewtonOptions as NewtonOptions
    from .numerics.status import SolveError as SolveError
    from .numerics.status import Status as Status
    from .port import reaction as reaction
    from .program_size import compile_report as compile_report
    from .program_size import quick_compile_options as quick_compile_options
    from .report.last_state import read_last_state as read_last_state
    from .scenes.errors import MeanUsedWarning as MeanUsedWarning
    from .scenes.errors import PresetUsedWarning as PresetUsedWarning
    from .scenes.errors import SceneError as SceneError
    from .scenes.errors import StatesUnusedWarning as StatesUnusedWarning
    from .scenes.from_python import load_oil as load_oil
    from .scenes.from_python import scene_from_mapping as scene_from_mapping
    from .scenes.reader import builtin_names as builtin_names
    from .scenes.reader import load_distributions as load_distributions
    from .scenes.reader import load_scene as load_scene
    from .scenes.save import save_scene as save_scene
    from .sensitivity import sensitivities as sensitivities
    from .simulate import simulate as simulate
    from .simulate import simulate_batch as simulate_batch
    from .solve import jit_solver as jit_solver
    from .solve import solve as solve
    from .spectrum.result import Spectrum as Spectrum
    from .spectrum.states import State as State
    from .spectrum.verb import solve_spectrum as solve_spectrum
    from .sweep import sweep as sweep
    from .tolerance.verb import tolerances as tolerances


_LAZY = {
    "BallAttitude": ".bearings.ball.scene",
    "BallBearing": ".bearings.ball.scene",
    "BallCage": ".bearings.ball.scene",
    "BallDragSettings": ".bearings.ball.scene",
    "BallGeometry": ".bearings.ball.geometry",
    "BallMaterials": ".bearings.ball.scene",
    "BallOperation": ".bearings.ball.scene",
    "Catalogue": ".makers",
    "CylindricalRollerBearing": ".bearings.cylindrical.scene",
    "Drag": ".bearings.parts",
    "Distribution": ".distribution",
    "EHLLineContact": ".ehl",
    "Fits": ".mounting",
    "HeldDisplacement": ".bearings.operation",
    "History": ".bearings.motion.history",
    "JointDistribution": ".joint",
    "Material": ".materials",
    "Materials": ".bearings.parts",
    "MeanUsedWarning": ".scenes.errors",
    "NewtonOptions": ".numerics.newton",
    "Operation": ".bearings.operation",
    "PartTemperatures": ".mounting",
    "PresetUsedWarning": ".scenes.errors",
    "Rating": ".bearings.rating",
    "RollerCage": ".bearings.cylindrical.geometry",
    "RollerFlange": ".bearings.cylindrical.geometry",
    "RollerGeometry": ".bearings.cylindrical.geometry",
    "RollerProfile": ".bearings.profile",
    "SceneError": ".scenes.errors",
    "Simulation": ".bearings.motion.settings",
    "Solution": ".bearings.solution",
    "SolveError": ".numerics.status",
    "Spectrum": ".spectrum.result",
    "State": ".spectrum.states",
    "StatesUnusedWarning": ".scenes.errors",
    "Status": ".numerics.status",
    "TaperedCage": ".bearings.tapered.geometry",
    "TaperedGeometry": ".bearings.tapered.geometry",
    "TaperedOperation": ".bearings.tapered.scene",
    "TaperedRollerBearing": ".bearings.tapered.scene",
    "TwoDisk": ".machines",
    "WarmUpHistory": ".bearings.warming.history",
    "WarmUpSimulation": ".bearings.warming.settings",
    "builtin_names": ".scenes.reader",
    "calibrate": ".calibration.verb",
    "compare": ".comparison",
    "compile_report": ".program_size",
    "load_distributions": ".scenes.reader",
    "load_oil": ".scenes.from_python",
    "load_scene": ".scenes.reader",
    "pocket_loads": ".bearings.cylindrical.motion.instants",
    "quasi_static_start": ".bearings.motion.start",
    "quick_compile_options": ".program_size",
    "reaction": ".port",
    "read_last_state": ".report.last_state",
    "scene_from_mapping": ".scenes.from_python",
    "save_scene": ".scenes.save",
    "sensitivities": ".sensitivity",
    "solve_spectrum": ".spectrum.verb",
    "tolerances": ".tolerance.verb",
    "trajectory": ".bearings.motion.runs",
}
"""Public names that pull in the edge (units, validation) or are only needed by some; imported on first use."""
_MODULES = (
    "bearings",
    "calibration",
    "catalogue",
    "contacts",
    "ehl",
    "fitting",
    "gaps",
    "life",
    "lubricants",
    "machines",
    "makers",
    "mounting",
    "plots",
    "shafts",
    "sweeps",
    "thermal",
)
"""Modules that are public as such: families of bearings, calibration, standard bearings, the laws, the fit of an oil,
shafts, makers' formulas, machines, sweeps, figures."""
_AT_ONCE = ("jit_solver", "simulate", "simulate_batch", "solve", "sweep")

_forwarded = attributes_of(__name__, {name: place[1:] for name, place in _LAZY.items()})

__all__ = [*_AT_ONCE, *_LAZY, *_MODULES]  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(f".{name}", __name__)
    if name in _AT_ONCE:
        load_verbs()
        return globals()[name]
    return _forwarded(name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__doc__", "__version__"])


if not is_the_command():
    load_verbs()
