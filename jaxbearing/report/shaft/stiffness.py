"""Stiffness of the bearings and sets of a shaft over the shaft speed."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from rich.console import Console

from ..._scene import AbstractScene
from ...bearings.ring import shift_matrix
from ...bearings.solution import RING_FREEDOMS, stiffness_units
from ...numerics.status import SolveError
from ...shafts.mounting import MatchedSet, Support
from ...shafts.scene import ShaftSystem
from ...shafts.solution import ShaftSolution
from ...solve import jit_solver
from ..backends.json import plain
from ..backends.screen import (
    column,
    counted,
    headline,
    print_line,
    print_rule,
    print_table,
    print_warnings,
    shown_pieces,
)
from ..display import digits, display_unit, with_unit
from .facts import shaft_warnings
from .modes import natural_frequencies

if TYPE_CHECKING:
    import numpy.typing as npt

MODES = 4
"""Number of natural frequencies in a table."""


class ShaftStiffness(NamedTuple):
    """Tangent stiffness at the equilibria of a shaft at several speeds, in the frame of the shaft.

    - `speed`: of the shaft, rad/s.
    - `bearings`: name -> d (load on the inner ring) / d (its displacement), with the elastic support of the outer ring
      in series; N/m, N/rad, N m/m and N m/rad; axes: speed, row, column.
    - `sets`: name -> the same for a whole set at its middle, with its bearings on a rigid piece of shaft.
    - `position`: name -> position of a bearing, or of the middle of a set, m.
    - `freedom`: names of the rows and columns of each matrix.
    - `natural_frequencies`: lowest natural frequencies of bending, rad/s, without damping and gyroscopic effect
      (`modes`); axes: speed, mode. `None` for a rigid shaft.
    - `warnings`: warnings at any of the speeds.
    """

    speed: np.ndarray
    bearings: dict[str, np.ndarray]
    sets: dict[str, np.ndarray]
    position: dict[str, float]
    freedom: tuple[str, ...]
    warnings: tuple[str, ...]
    natural_frequencies: np.ndarray | None = None


def shaft_at_speeds(scene: AbstractScene, speeds: "npt.ArrayLike") -> list[ShaftSystem]:
    """The scene of the shaft at each speed, rad/s.

    **Raises:** `TypeError` for a scene that is not a shaft; `ValueError` for speeds that are not finite and increasing.
    """
    if not isinstance(scene, ShaftSystem):
        raise TypeError(f"a {type(scene).__name__} is no shaft")
    values = np.asarray(speeds, dtype=np.float64)
    if values.ndim != 1 or values.size == 0 or not np.all(np.isfinite(values)) or np.any(np.diff(values) <= 0.0):
        raise ValueError("speeds must be a list of finite numbers, each larger than the one before")
    return [scene.replace({"shaft.speed": float(value)}) for value in values]


def shaft_stiffness_over_speed(
    scene: AbstractScene, speeds: "npt.ArrayLike", *, solver: Callable[[ShaftSystem], ShaftSolution] | None = None
) -> ShaftStiffness:
    """Table of the stiffness over speed: solves the shaft at each speed, under the forces of the scene.

    **Arguments:** `speeds`: rad/s, increasing; `solver`: function from a scene to a solution that does not raise; that
    of `jit_solver` if not given.

    **Raises:** as `shaft_at_speeds`; `SolveError` for the first speed that fails.
    """
    scenes = shaft_at_speeds(scene, speeds)
    solve = jit_solver(scenes[0]) if solver is None else solver
    solutions = []
    for variant in scenes:
        solution = solve(variant)
        if not bool(solution.converged):
            speed = float(variant.shaft.speed)
            raise SolveError(f"at {speed:.6g} rad/s ({with_unit(speed, 'rad/s', 5)}): {solution.failure()}")
        solutions.append(solution)
    system = scenes[0]
    own = [tangents(system, solution) for solution in solutions]
    sets = [
        {matched.name: set_tangent(system, solution, matched.name) for matched in system.sets} for solution in solutions
    ]
    names = {place.name: float(place.position) for place in system.places}
    table = ShaftStiffness(
        speed=np.asarray(speeds, dtype=np.float64),
        bearings={name: np.stack([matrices[name] for matrices in own]) for name in own[0]},
        sets={name: np.stack([matrices[name] for matrices in sets]) for name in sets[0]},
        position=names | {matched.name: float(matched.position) for matched in system.sets},
        freedom=RING_FREEDOMS,
        warnings=tuple(dict.fromkeys(text for solution in solutions for text in shaft_warnings(solution))),
    )
    if not system.shaft.sections:
        return table
    modes = [natural_frequencies(table, system, place)[:MODES] for place in range(len(scenes))]
    return table._replace(natural_frequencies=np.stack(modes))


def tangents(system: ShaftSystem, solution: ShaftSolution) -> dict[str, np.ndarray]:
    """Stiffness of each bearing in series with the support of its outer ring, in the frame of the shaft.

    **Raises:** `ValueError` for a shaft with a housing: it couples the outer rings, so that bearings are not separate
    springs.
    """
    if system.housing is not None:
        raise ValueError("a housing couples the outer rings: the bearings have no stiffness of their own")
    matrices = {}
    for place in system.places:
        solved = solution.bearings[place.name]
        mirror = np.array([solved.sense, 1.0, 1.0, solved.sense, solved.sense])
        bearing = mirror[:, None] * np.asarray(solved.stiffness, dtype=float) * mirror
        matrices[place.name] = _in_series(bearing, place.support)
    return matrices


def _in_series(bearing: np.ndarray, support: Support | None) -> np.ndarray:
    """Stiffness of a bearing in series with the elastic support of its outer ring, whose degrees of freedom without a
    stiffness are rigid."""
    if support is None:
        return bearing
    if support.matrix is not None:
        outer, free = np.asarray(support.matrix, dtype=float), np.ones(5, dtype=bool)
    else:
        springs = (support.axial, support.radial, support.radial, support.tilt, support.tilt)
        free = np.array([spring is not None for spring in springs])
        outer = np.diag([0.0 if spring is None else float(spring) for spring in springs])
    if not np.any(free):
        return bearing
    inner = bearing[:, free]
    return bearing - inner @ np.linalg.solve(bearing[np.ix_(free, free)] + outer[np.ix_(free, free)], bearing[free])


def set_tangent(system: ShaftSystem, solution: ShaftSolution, name: str) -> np.ndarray:
    """Stiffness of a set at its middle; outer rings that springs preload are free to move axially against these."""
    number = [listed.name for listed in system.sets].index(name)
    matched = system.sets[number]
    own, names = tangents(system, solution), matched.names
    total, across, along = np.zeros((5, 5)), np.zeros((5, 0)), np.zeros((0, 5))
    pressed = _pressed(matched)
    spring = np.zeros((0, 0))
    if pressed:
        stiffness = (
            0.0
            if matched.preload is None or matched.preload.spring_stiffness is None
            else matched.preload.spring_stiffness
        )
        spring, across, along = np.array([[float(stiffness)]]), np.zeros((5, 1)), np.zeros((1, 5))
    for bearing in names:
        distance = solution.bearings[bearing].position - matched.position
        shift = np.asarray(shift_matrix(jnp.asarray(distance)))
        matrix = own[bearing]
        total += shift.T @ matrix @ shift
        if bearing in pressed:
            # the rings that springs press move along the axis of their bearings
            axis = np.array([[solution.bearings[bearing].sense, 0.0, 0.0, 0.0, 0.0]]).T
            across += shift.T @ matrix @ axis
            along += axis.T @ matrix @ shift
            spring += axis.T @ matrix @ axis
    return total - across @ np.linalg.solve(spring, along) if pressed else total


def _pressed(matched: MatchedSet) -> tuple[str, ...]:
    """Names of the bearings whose outer rings are preloaded by springs: the last group in the picture of the set."""
    if matched.preload is None or matched.preload.spring_force is None:
        return ()
    return tuple(name for name, sign in zip(matched.names, matched.picture, strict=True) if sign == matched.picture[-1])


def shaft_stiffness_to_dict(table: ShaftStiffness) -> dict[str, Any]:
    """The table for JSON, in SI units and radians."""
    return {name: plain(value) for name, value in table._asdict().items()}


def print_shaft_stiffness(table: ShaftStiffness, label: str, console: Console, full: bool = False) -> None:
    """Prints the diagonal stiffnesses of each set and bearing over speed. **Arguments:** `full`: print all columns."""
    state = f"{counted(len(table.speed), 'speed')} solved; entries off the diagonal: --json"
    headline(label, "CONVERGED", "bold green", state, console)
    units = stiffness_units()
    first = {f"speed\n{display_unit('rad/s')}": column(table.speed, "rad/s")}
    for kind, matrices in (("Set", table.sets), ("Bearing", table.bearings)):
        for name, values in matrices.items():
            print_rule(f"{kind} {name}, at {1e3 * table.position[name]:.6g} mm", console)
            columns = {
                f"{freedom}\n{display_unit(units[i][i])}": column(values[:, i, i], units[i][i])
                for i, freedom in enumerate(table.freedom)
            }
            for piece in shown_pieces(first, columns, console, full):
                print_table(piece, [0.0] * len(table.speed), 0, "", console)
    if table.natural_frequencies is not None:
        print_rule("Natural frequencies of bending, without damping and gyroscopic effect", console)
        modes = table.natural_frequencies.T / (2.0 * np.pi)
        columns = {
            f"mode {place + 1}\nHz": [digits(float(frequency), 5) for frequency in mode]
            for place, mode in enumerate(modes)
        }
        print_table(first | columns, [0.0] * len(table.speed), 0, "", console)
    print_line("Stiffness", "d load / d displacement of the inner ring, its other degrees of freedom held", console)
    print_line("Axes", "axial X, radial Y, lateral Z of the shaft; tilts move azimuth 0 and 90 deg along X", console)
    print_warnings(table.warnings, console, full)
