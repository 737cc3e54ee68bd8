"""Stiffness of a bearing over shaft speed, and its form for JSON."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .._scene import AbstractScene
from ..bearings.bearing import AbstractBearing
from ..bearings.solution import RING_FREEDOMS, Solution
from ..numerics.status import SolveError
from ..solve import jit_solver
from .backends.json import plain
from .bearing.json_report import modelled_only
from .display import with_unit

if TYPE_CHECKING:
    import numpy.typing as npt


class StiffnessTable(NamedTuple):
    """Tangent stiffness of the inner ring at each shaft speed, with everything inside the bearing in equilibrium.

    - `speed`: of the inner ring, rad/s.
    - `stiffness`: d load / d displacement of all five degrees of freedom, N/m, N/rad, N m/m and N m/rad; axes: speed,
      row, column. Entries of a degree of freedom that is not modelled are 0.
    - `freedom`: names of the rows and columns.
    - `modelled`: names of the degrees of freedom that are modelled.
    - `warnings`: laws used outside their ranges at any speed, and assumptions of the model.
    """

    speed: np.ndarray
    stiffness: np.ndarray
    freedom: tuple[str, ...]
    modelled: tuple[str, ...]
    warnings: tuple[str, ...]


def at_speeds(scene: AbstractScene, speeds: "npt.ArrayLike") -> list[AbstractBearing]:
    """The scene at each speed of the inner ring, rad/s, with the degrees of freedom that the stiffness needs.

    A roller bearing whose ring moves only along the load line gets the lateral degree of freedom as well.

    **Raises:** `TypeError` for a scene that is not a bearing; `ValueError` for speeds that are not finite, >= 0 and
    increasing, or that the scene refuses.
    """
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"a {type(scene).__name__} has no stiffness; expected a bearing")
    values = np.asarray(speeds, dtype=np.float64)
    if values.ndim != 1 or not np.all(np.isfinite(values)) or np.any(values < 0.0) or np.any(np.diff(values) <= 0.0):
        raise ValueError("speeds must be a list of finite numbers >= 0, each larger than the one before")
    supporting = scene.with_lateral_freedom()
    return [_at_speed(supporting, float(value)) for value in values]


def _at_speed(scene: AbstractBearing, speed: float) -> AbstractBearing:
    """The scene at one speed. **Raises:** `ValueError` that names the speed, if the scene refuses it."""
    try:
        return scene.at_operation(inner_speed=speed)
    except ValueError as error:
        raise ValueError(f"at {with_unit(speed, 'rad/s')}: {error}") from None


def stiffness_over_speed(
    scene: AbstractScene, speeds: "npt.ArrayLike", *, solver: Callable[[AbstractBearing], Solution] | None = None
) -> StiffnessTable:
    """Table of the stiffness over speed: solves the bearing at each speed, under the loads of the scene.

    **Arguments:**
    - `speeds`: of the shaft and inner ring, rad/s, increasing.
    - `solver`: function from a scene to a solution that does not raise; that of `jit_solver` if not given.

    **Raises:** as `at_speeds`; `SolveError` for the first speed at which the solve fails.
    """
    scenes = at_speeds(scene, speeds)
    if not scenes:
        raise ValueError("speeds must hold at least one speed")
    solve = jit_solver(scenes[0]) if solver is None else solver
    solutions = []
    for bearing in scenes:
        solution = solve(bearing)
        if not bool(solution.converged):
            speed = float(bearing.operation.inner_speed)
            raise SolveError(f"at {speed:.6g} rad/s ({with_unit(speed, 'rad/s', 5)}): {solution.failure()}")
        solutions.append(solution)
    return StiffnessTable(
        speed=np.asarray(speeds, dtype=np.float64),
        stiffness=np.stack([np.asarray(solution.stiffness) for solution in solutions]),
        freedom=RING_FREEDOMS,
        modelled=solutions[0].freedoms_of_stiffness,
        warnings=tuple(dict.fromkeys(text for solution in solutions for text in solution.warnings)),
    )


def stiffness_to_dict(table: StiffnessTable) -> dict[str, Any]:
    """The table for JSON, in SI units and radians; `None` for numbers that are not finite and for entries of degrees of
    freedom that are not modelled."""
    entries = {name: plain(value) for name, value in table._asdict().items()}
    return entries | {"stiffness": modelled_only(table.stiffness, table.modelled)}
