"""Stiffness of a bearing over the speed of its shaft: solved speed by speed, and as JSON."""

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
    """Tangent stiffness of the inner ring at each shaft speed, everything inside the bearing in equilibrium.

    - `speed`: of the inner ring, rad/s.
    - `stiffness`: d load / d displacement of all five degrees of freedom, N/m, N/rad, N m/m and N m/rad; axes: speed,
      row, column. Entries of a freedom that the model does not have are 0.
    - `freedom`: names of its rows and columns.
    - `modelled`: those that the model has.
    - `warnings`: what left the range of a law at some speed, and what the model assumed.
    """

    speed: np.ndarray
    stiffness: np.ndarray
    freedom: tuple[str, ...]
    modelled: tuple[str, ...]
    warnings: tuple[str, ...]


def at_speeds(scene: AbstractScene, speeds: "npt.ArrayLike") -> list[AbstractBearing]:
    """The scene at each speed of the inner ring, rad/s, with the degrees of freedom of the ring that its stiffness
    needs: where the ring of a roller bearing moves along the load line only, it is given the lateral freedom too.

    **Raises:** `TypeError` for a scene of something else than a bearing; `ValueError` for speeds that are not finite,
    >= 0 and increasing, or that the scene refuses.
    """
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"a {type(scene).__name__} has no stiffness; expected a bearing")
    values = np.asarray(speeds, dtype=np.float64)
    if values.ndim != 1 or not np.all(np.isfinite(values)) or np.any(values < 0.0) or np.any(np.diff(values) <= 0.0):
        raise ValueError("speeds must be a list of finite numbers >= 0, each larger than the one before")
    supporting = scene.with_lateral_freedom()
    return [_at_speed(supporting, float(value)) for value in values]


def _at_speed(scene: AbstractBearing, speed: float) -> AbstractBearing:
    """**Raises:** `ValueError` that names the speed for which the scene has no meaning."""
    try:
        return scene.at_operation(inner_speed=speed)
    except ValueError as error:
        raise ValueError(f"at {with_unit(speed, 'rad/s')}: {error}") from None


def stiffness_over_speed(
    scene: AbstractScene, speeds: "npt.ArrayLike", *, solver: Callable[[AbstractBearing], Solution] | None = None
) -> StiffnessTable:
    """Solves at each speed; the loads on the bearing are the scene's at all of them.

    **Arguments:**
    - `speeds`: of the shaft, which carries the inner ring; rad/s, increasing.
    - `solver`: from a scene to a solution, without raising; that of `jit_solver` if not given.

    **Raises:** as `at_speeds`; `SolveError` for the first speed that fails: there is no table with a gap.
    """
    scenes = at_speeds(scene, speeds)
    if not scenes:
        raise ValueError("speeds must hold at least one speed")
    solve = jit_solver(scenes[0]) if solver is None else solver
    solutions = []
    for one in scenes:
        solution = solve(one)
        if not bool(solution.converged):
            speed = float(one.operation.inner_speed)
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
    """The table as JSON has it: SI units and radians; numbers that are not finite, and entries of degrees of freedom
    that are not modelled, are `None`."""
    found = {name: plain(value) for name, value in table._asdict().items()}
    return found | {"stiffness": modelled_only(table.stiffness, table.modelled)}
