"""Which function computes what with a scene of which kind: the only way from a scene to its solver.

Modules of scenes import no solver, so that a scene is read, checked, changed and written without one. The module of a
solver is imported when it is first asked for. A new kind of scene has its lines in `_FUNCTIONS`.
"""

import functools
from collections.abc import Callable
from importlib import import_module
from typing import Any

BEARING, MOVING_BEARING = "a bearing", "a moving bearing"
"""In the place of a kind: what all kinds of bearings have in common, and those whose elements can be simulated."""
_FUNCTIONS = {
    "ball_bearing": {
        "solve_ring": "bearings.ball.steady:solve_ball",
        "row": "bearings.ball.row:ball_row_of",
        "motion": "bearings.ball.motion.family:BallBearingMotion",
    },
    "cylindrical_roller_bearing": {
        "solve_ring": "bearings.cylindrical.steady:solve_rollers",
        "row": "bearings.cylindrical.row:TiltingRow",
        "motion": "bearings.cylindrical.motion.family:RollerMotion",
    },
    "tapered_roller_bearing": {
        "solve_ring": "bearings.tapered.steady:solve_tapered",
        "row": "bearings.tapered.row:TaperedRow",
    },
    BEARING: {
        "simulated": "bearings.warming.runs:simulate_warm_up",
        "check_restart": "bearings.warming.runs:check_restart",
    },
    MOVING_BEARING: {
        "simulated": "bearings.motion.runs:simulate_bearing",
        "simulated_batch": "bearings.motion.batch:simulate_bearing_batch",
        "check_restart": "bearings.motion.run:check_fits",
    },
    "shaft": {"steady_solution": "shafts.steady:solve_shaft"},
    "line_contact": {
        "steady_solution": "ehl.solution:solve_line_contact",
        "simulated": "ehl.run:run_film",
        "check_restart": "ehl.run:check_state",
    },
}
"""Kind of the scene -> name of the method of the scene -> "module:function" that computes it."""


@functools.cache
def solver(kind: str, method: str) -> Callable[..., Any]:
    """The function or class behind a method of a scene; the scene is its first argument, if it has any."""
    module, _, name = _FUNCTIONS[kind][method].partition(":")
    return getattr(import_module(f"{__package__}.{module}"), name)
