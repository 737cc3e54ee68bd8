"""The steady film of a line contact: nested start, Newton, implicit derivative."""

from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from ..numerics.dense import solve_dense
from ..numerics.known_roots import at_known_root
from ..numerics.status import Status
from .equations import Equations, Fluid, Point, film_shape, steady_equations
from .linear import Equilibrium, as_point, linearize
from .mesh import Mesh, MeshKey, levels, mesh
from .newton import newton

TOLERANCE = 1e-9
"""Largest change of an unknown by the last Newton step; the error left is about its square."""
MAX_STEPS = 60
"""Largest number of Newton steps on one mesh."""
COARSEST = 100
"""Least number of nodes of the first mesh of a nested start."""
SMALLEST_WEDGE = 1e-8
"""Smallest speed number lambda |u| of a steady solve. At rest there is no film: H is 0 in the whole contact and the
Jacobian singular."""
LOW_PRESSURE_SIDE = 1.2
"""Distance from the centre within which the first guess has its smallest film, half widths."""


class Steady(eqx.Module):
    """Steady problem of a line contact. **Arguments:** `fluid`; `wedge`: lambda at the reference speed; `speed`: over
    the reference speed, any sign; `start`: smallest film of the first guess, dimensionless; `wanted`: whether to solve
    at all."""

    fluid: Fluid
    wedge: Scalar
    speed: Scalar
    start: Scalar
    wanted: Bool[Array, ""]

    def equations(self, nodes: int) -> Equations:
        return steady_equations(self.fluid, self.wedge, self.speed, nodes)


class SteadyRoot(NamedTuple):
    """Result on the finest mesh, as in `newton.Root`; `iterations`: sum over all meshes."""

    point: Point
    solved: Bool[Array, ""]
    status: Int[Array, ""]
    iterations: Int[Array, ""]
    step: Float[Array, ""]
    residual: Float[Array, ""]


def hertz_guess(start: Scalar, grid: Mesh) -> Point:
    """Hertz pressure, and the offset that makes `start` the smallest film in |X| <= 1.2."""
    pressure = np.sqrt(np.maximum(1.0 - grid.x**2, 0.0))
    pressure[0] = pressure[-1] = 0.0
    dry = 0.5 * grid.x**2 + grid.kernel @ pressure[1:-1]
    return Point(jnp.asarray(pressure), start - jnp.asarray(dry[np.abs(grid.x) <= LOW_PRESSURE_SIDE].min()))


def _prolonged(point: Point, coarse: Mesh, fine: Mesh) -> Point:
    """Point on a finer mesh, its pressure interpolated linearly."""
    return Point(jnp.interp(jnp.asarray(fine.x), jnp.asarray(coarse.x), point.pressure), point.offset)


def _solve(problem: Steady, key: MeshKey) -> SteadyRoot:
    """Solves on meshes of growing size. Each starts from the one before it, or from Hertz if that one failed."""
    iterations, root, before = jnp.asarray(0), None, None
    for level in levels(key, COARSEST):
        grid = mesh(level)
        guess = hertz_guess(problem.start, grid)
        if root is not None and before is not None:
            nested = _prolonged(root.point, before, grid)
            good = root.converged & (jnp.min(film_shape(nested, grid)) > 0)
            guess = jax.tree.map(lambda a, b, good=good: jnp.where(good, a, b), nested, guess)
        root = newton(
            problem.equations(level.nodes),
            guess,
            grid,
            tolerance=TOLERANCE,
            max_steps=MAX_STEPS,
            wanted=problem.wanted,
        )
        iterations += root.iterations
        before = grid
    assert root is not None
    return SteadyRoot(root.point, root.converged, root.status, iterations, root.step, root.residual)


@eqx.filter_custom_jvp
def _root(problem: Steady, *, key: MeshKey) -> SteadyRoot:
    """Solves the problem; its derivative, in both modes, follows from the implicit function theorem with the set of
    cavitated nodes fixed.

    Where a node changes between film and cavitation the true derivative jumps (a mesh effect of second order). The
    iteration is not differentiated, and a failed lane has derivative 0.
    """
    return _solve(jax.lax.stop_gradient(problem), key)


@_root.def_jvp
def _steady_root_jvp(primals, tangents, *, key: MeshKey):
    (problem,), (problem_dot,) = primals, tangents
    return _implicit(problem, problem_dot, _root(problem, key=key), key)


@eqx.filter_custom_jvp
def _known_root(problem: Steady, *, root: SteadyRoot, key: MeshKey) -> SteadyRoot:
    """A root found before, with the derivatives that `_root` would give it."""
    return root


@_known_root.def_jvp
def _known_root_jvp(primals, tangents, *, root: SteadyRoot, key: MeshKey):
    (problem,), (problem_dot,) = primals, tangents
    return _implicit(problem, problem_dot, _known_root(problem, root=root, key=key), key)


def _implicit(problem: Any, problem_dot: Any, root: SteadyRoot, key: MeshKey) -> tuple[SteadyRoot, SteadyRoot]:
    """A root and its directional derivative, by the implicit function theorem."""
    grid = mesh(key)
    # mask the incoming tangent, so that NaN of a failed lane reaches no parameter that lanes share
    problem_dot = jax.tree.map(lambda t: jnp.where(root.solved, t, 0.0), problem_dot)
    linear = linearize(problem.equations(key.nodes), root.point, grid)
    held = Equilibrium(linear.cavitated, linear.scale)
    rows = lambda p: held.rows(p.equations(key.nodes), root.point, grid)
    rows_dot = _directional(rows, (problem,), (problem_dot,))
    safe = jnp.where(root.solved, linear.matrix, jnp.eye(linear.rows.size))
    point_dot = as_point(-solve_dense(safe, rows_dot))
    point_dot = jax.tree.map(lambda t: jnp.where(root.solved, t, 0.0), point_dot)
    return root, SteadyRoot(point_dot, *(None for _ in root[1:]))  # pyright: ignore[reportArgumentType]


def _directional(function: Callable, primals: tuple, tangents: tuple) -> Any:
    value, dot = eqx.filter_jvp(function, primals, tangents)
    return jnp.zeros_like(value) if dot is None else dot


def steady_root(problem: Steady, *, key: MeshKey) -> SteadyRoot:
    """Root of the problem: a known one if there is one, else that of `_root`."""
    return at_known_root(lambda: _root(problem, key=key), lambda root, _: _known_root(problem, root=root, key=key))


def existing(wedge: Scalar, speed: Scalar) -> Bool[Array, ""]:
    """True if the entrainment is large enough for a steady film."""
    return jnp.asarray(wedge * jnp.abs(speed) >= SMALLEST_WEDGE)


def judged(status: Int[Array, ""], exists: Bool[Array, ""], described: Bool[Array, ""]) -> Int[Array, ""]:
    """The status of a solve; `NO_EQUILIBRIUM` where there is no film, `OUTSIDE_VALIDITY` where the model does not
    apply."""
    status = jnp.where(described, status, int(Status.OUTSIDE_VALIDITY))
    return jnp.where(exists, status, int(Status.NO_EQUILIBRIUM))
