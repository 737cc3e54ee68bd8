"""Results of scenes at many operating points, and their derivatives by the calibrated fields; one compiled program
serves all points of scenes of the same structure."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._scene import AbstractScene
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..programs import KeptProgram
from ..solve import solution_at, solve_with_roots
from ..tolerance.results import Label, values_of

LANES = 16
"""Number of operating points that one call of the program solves; more points need more calls of the same program."""


def at_point(
    base: AbstractScene,
    condition: Mapping[str, Array],
    fields: Mapping[str, Array],
    wanted: Sequence[str],
    options: NewtonOptions,
) -> tuple[Float[Array, " result"], Float[Array, "field result"], Bool[Array, ""]]:
    """Results at one operating point, their derivatives by the fields, sorted by name, and whether the solve converged.

    To be traced. Derivatives are taken at the roots of the solve, in forward mode and one field after the other, which
    makes the smallest program (`programs.differentiated`).
    """
    solution, roots = solve_with_roots(base.replace({**condition, **fields}), options)
    stiffness = any(name.startswith("stiffness") for name in wanted)

    def results(own: Mapping[str, Array]) -> Array:
        solved = solution_at(roots, base.replace({**condition, **own}), options, stiffness=stiffness)
        return jnp.stack(list(values_of(solved, wanted).values()))

    def along(place: Array) -> Array:
        direction = {path: jnp.where(place == i, 1.0, 0.0) for i, path in enumerate(sorted(fields))}
        return jax.jvp(results, (dict(fields),), (direction,))[1]

    values = jnp.stack(list(values_of(solution, wanted).values()))
    slopes = jax.lax.map(along, jnp.arange(len(fields))) if fields else jnp.zeros((0, len(wanted)))
    return values, slopes, solution.converged


def at_points(
    base: AbstractScene,
    conditions: Mapping[str, Float[Array, " lane"]],
    fields: Mapping[str, Float[Array, " lane"]],
    active: Bool[Array, " lane"],
    wanted: Sequence[str],
    options: NewtonOptions,
) -> tuple[Float[Array, "lane result"], Float[Array, "lane field result"], Bool[Array, " lane"]]:
    """Results of `at_point` for many points, one after the other; NaN for inactive points. To be traced."""
    nothing = jnp.full(len(wanted), jnp.nan), jnp.full((len(fields), len(wanted)), jnp.nan), jnp.asarray(False)

    def lane(inputs: Any) -> Any:
        condition, own, wants = inputs
        return jax.lax.cond(wants, lambda: at_point(base, condition, own, wanted, options), lambda: nothing)

    return jax.lax.map(lane, (dict(conditions), dict(fields), active))


_kept_points = KeptProgram(at_points, quick=True)


class Evaluator:
    """Results of one rig at operating points and their derivatives, by the compiled program.

    **Arguments:**
    - `scene`: gives all fields that do not vary.
    - `paths`: of the calibrated fields that this scene has.
    - `labels`: of the results, by their paths.
    - `progress`: called with the number of operating points that were just solved.
    """

    def __init__(
        self,
        scene: AbstractScene,
        paths: Sequence[str],
        labels: Mapping[str, Label],
        options: NewtonOptions,
        progress: Callable[[int], None] | None = None,
    ):
        self.base = jax.tree.map(as_float, scene)
        # JAX sorts the entries of a mapping
        self.paths, self.labels, self.options, self.progress = tuple(sorted(paths)), dict(labels), options, progress
        self.wanted = tuple(labels)

    @rare_garbage_collection()
    def __call__(
        self, conditions: Mapping[str, np.ndarray], values: np.ndarray, active: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Results, (lane, result), and their derivatives, (lane, field, result); NaN where a solve failed.

        **Arguments:** `conditions`: operating point of each lane, by path; `values`: of the fields, (lane, field);
        `active`: mask of the lanes to solve.
        """
        count = len(active)
        gathered = np.full((count, len(self.wanted)), np.nan)
        slopes = np.full((count, len(self.paths), len(self.wanted)), np.nan)
        places = np.flatnonzero(active)
        for start in range(0, len(places), LANES):
            own = places[start : start + LANES]
            # the last call is filled up with copies that are not solved
            padded = np.pad(own, (0, LANES - len(own)), mode="edge")
            wanted = np.arange(LANES) < len(own)
            points = {path: jnp.asarray(column[padded]) for path, column in conditions.items()}
            fields = {path: jnp.asarray(values[padded, i]) for i, path in enumerate(self.paths)}
            parts = _kept_points(self.base, points, fields, jnp.asarray(wanted), self.wanted, self.options)
            results, own_slopes, converged = (np.asarray(part)[: len(own)] for part in parts)
            gathered[own] = np.where(converged[:, None], results, np.nan)
            slopes[own] = np.where(converged[:, None, None], own_slopes, np.nan)
            if self.progress is not None:
                self.progress(len(own))
        return gathered, slopes
