r"""Block-arrow systems whose equations are the gradient of one convex potential: its minimum is the first guess of
Newton's iteration.

All searches use the same step and the same rule of acceptance. The step is Newton's with a regularisation in proportion
to the residual (Li, Fukushima, Qi and Yamashita, Comput. Optim. Appl. 28 (2004) 131): $(H + \frac{|r|}{\rho}C^{-1})s =
r$, with the Hessian H, the residual r (|r| is its largest entry), the step s and the diagonal matrix C of the caps of
the unknowns. In units of the caps the step is hardly longer than the radius $\rho$. Near the minimum, where the
residual vanishes, it is Newton's. The rule (`_descent`): a trial is accepted if it lowers the potential. The radius
grows after an accepted trial and shrinks after a rejected one.

The unknowns descend all together (`descend`), each element descends by itself (`settle`), or the globals descend with
all elements at their minima (`descend_settled`). Contacts that open have no stiffness: the systems add an
artificial stiffness to each block (`anchored`), which stabilises the step and exerts no force. No derivative goes
through this module, because the minimum is only a first guess.
"""

import abc
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .._types import Tree
from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    assembled,
    element_tangents,
    eliminated,
    evaluate,
    seen_by_elements,
    solve_arrow,
)
from .small_linear import solve_blocks, solve_dense

FARTHEST = 256.0
"""First and largest radius, in caps. It is large because an element without contact may have far to go."""
LONGER, SHORTER = 8.0, 0.5
"""Factors of the radius after an accepted and after a rejected trial. The number of random tapered bearings that
converge is the same with 3 and 0.5, 8 and 0.25, 30 and 0.5."""
SHORTEST = 1e-13
"""Shortest step, in caps: a shorter one is rounding, and ends the search."""
FALLS, ROUNDING = 0.9, 1e-11
"""A trial is also accepted if it lowers the residual to the fraction `FALLS` and raises the potential by at most the
fraction `ROUNDING`: near the minimum the fall of the potential is lost in rounding."""
TOGETHER_TRIALS, SETTLED_TRIALS, ELEMENT_TRIALS = 80, 80, 300
"""Largest numbers of trials of `descend`, `descend_settled` and `settle`."""
ELEMENT_TOLERANCE = 1e-12
"""Largest scaled residual of an element that is settled."""
OUTSIDE = 1e-3
"""The minimum counts as outside the bounds if the other residuals are below this fraction of the one that pushes a
global over its bound."""


class AbstractConvexArrow(AbstractArrowSystem):
    """A system whose residuals are, block by block and up to positive factors, the gradient of `potential`."""

    @abc.abstractmethod
    def acting(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> tuple[Float[Array, "m element"], Float[Array, "k element"], Float[Array, " element"]]:
        """Local residuals and contributions to the totals, as those of `element`, and the energy of each element."""

    @abc.abstractmethod
    def work(self, globals_: Float[Array, " g"]) -> Float[Array, ""]:
        """Work of the loads on the globals, in the unit of the energies."""

    def without_guess(self) -> "AbstractConvexArrow":
        """The same equations without the data of a first guess, on which they do not depend."""
        return self

    def element(self, unknowns, shared):
        local, contributions, _ = self.acting(unknowns, shared)
        return local, contributions, jnp.zeros(())

    def tangents(self, unknowns, shared):
        values, tangents, _ = _tangents(self.without_guess(), unknowns, shared)
        return values, tangents, jnp.zeros(())

    def potential(self, point: ArrowPoint) -> Float[Array, ""]:
        """The potential, which is convex. It is unbounded below if there is no equilibrium."""
        energies = self.acting(point.elements, seen_by_elements(self, point))[2]
        return jnp.sum(energies) - self.work(point.globals)


def anchored(value: Array, stiffness: float) -> Array:
    """0, with the derivative `stiffness`: an artificial spring that exerts no force."""
    return stiffness * (value - jax.lax.stop_gradient(value))


@jax.jit
def _tangents(system: AbstractConvexArrow, unknowns: Array, shared: Array) -> tuple[Array, Array, Array]:
    """Values of `acting`, their derivatives by unknowns and globals, and the energies. A program contains this function
    once, however often the search for a first guess and Newton's iteration call it: `system` is `without_guess`."""
    return element_tangents(system.acting, unknowns, shared)


class _View(NamedTuple):
    """A point that was evaluated: potential, largest scaled residual, and the blocks that give the step."""

    energy: Float[Array, "*lane"]
    size: Float[Array, "*lane"]
    blocks: Any


class _Search(NamedTuple):
    """State of a search: the best point so far and its `view`; the next trial and its distance from that point, in
    caps; the radius of the step. In `settle` every element has a search of its own, along the last axis; otherwise all
    but the points are scalars."""

    trial: Any
    length: Float[Array, "*lane"]
    point: Any
    view: _View
    radius: Float[Array, "*lane"]
    going: Bool[Array, "*lane"]
    trials: Int[Array, ""]
    steps: Int[Array, ""]


def _descent(
    look: Callable[[Tree], tuple[Tree, _View]],
    step: Callable[[_View, Array], tuple[Tree, Array]],
    start: Tree,
    tolerance: float,
    most: int,
) -> _Search:
    """Descends until the largest residual is below `tolerance`, until only rounding is left, or for `most` trials.

    **Arguments:**
    - `look`: trial -> the point that it leads to (itself, or with its elements settled), and the view of that point.
    - `step`: (view, |r|/rho) -> step to be subtracted from the point, and its length in caps.
    - `start`: a tree of arrays; if there are several lanes, they are the last axis of each array.
    """

    def advance(state: _Search) -> _Search:
        point, view = look(state.trial)
        old = state.view
        rounded = (view.size <= FALLS * old.size) & (view.energy <= old.energy + ROUNDING * jnp.abs(old.energy))
        taken = ((view.energy < old.energy) | rounded) & state.going
        choose = lambda new, last: jax.lax.select(jnp.broadcast_to(taken, new.shape), new, last)
        point, view = jax.tree.map(choose, (point, view), (state.point, old))
        longer = jnp.minimum(LONGER * state.radius, FARTHEST)
        radius = choose(longer, SHORTER * jnp.minimum(state.radius, state.length))
        move, length = step(view, view.size / radius)
        trial = jax.tree.map(jnp.subtract, point, move)
        # if the start is NaN, the length is NaN too, and the search ends
        going = state.going & (view.size > tolerance) & (length > SHORTEST)
        # the first trial is the start itself
        stepped = (state.trials > 0) & jnp.any(taken)
        return _Search(trial, length, point, view, radius, going, state.trials + 1, state.steps + stepped.astype(int))

    blank = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), jax.eval_shape(look, start)[1])
    nowhere = blank.energy + jnp.inf
    view = blank._replace(energy=nowhere, size=nowhere)
    none = jnp.asarray(0)
    begin = _Search(start, nowhere, start, view, blank.energy + FARTHEST, nowhere > 0.0, none, none)
    return jax.lax.while_loop(lambda state: jnp.any(state.going) & (state.trials < most), advance, begin)


class Descent(NamedTuple):
    """The end of a descent: the point, the largest scaled residual there (with settled elements: of the globals), and
    the steps taken."""

    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


def descend(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, trials: int) -> Descent:
    """Descends towards the minimum of the potential with all unknowns together, without regard to `bounds`."""
    system, guess = jax.lax.stop_gradient((system, guess))
    caps = system.step_caps()

    def look(point: ArrowPoint) -> tuple[ArrowPoint, _View]:
        values, tangents, energies = _tangents(system.without_guess(), point.elements, seen_by_elements(system, point))
        equations, jacobian = assembled(system, point, values, tangents, jnp.zeros(()))
        energy = jnp.sum(energies) - system.work(point.globals)
        return point, _View(energy, _largest(equations.residual), (equations.residual, jacobian))

    def step(view: _View, stiffening: Array) -> tuple[ArrowPoint, Array]:
        residual, jacobian = view.blocks
        move = solve_arrow(_stiffened(jacobian, caps, stiffening), residual)
        over = [jnp.max(jnp.abs(part) / cap, initial=0.0) for part, cap in zip(move, caps, strict=True)]
        return move, jnp.maximum(*over)

    end = _descent(look, step, guess, tolerance, trials)
    return Descent(end.point, end.view.size, end.steps)


def settle(system: AbstractConvexArrow, point: ArrowPoint) -> ArrowPoint:
    """The point with every element at the minimum of its own energy, for the given globals. Each element takes its own
    steps."""
    system, point = jax.lax.stop_gradient((system, point))
    m = point.elements.shape[0]
    shared, caps = seen_by_elements(system, point), system.step_caps().elements

    def look(elements: Array) -> tuple[Array, _View]:
        values, tangents, energies = _tangents(system.without_guess(), elements, shared)
        blocks = jnp.concatenate([values[:m, None], tangents[:m, :m]], axis=1)
        return elements, _View(energies, jnp.max(jnp.abs(values[:m]), axis=0), blocks)

    def step(view: _View, stiffening: Array) -> tuple[Array, Array]:
        residual, local = view.blocks[:, :1], view.blocks[:, 1:]
        move = solve_blocks(local + jnp.eye(m)[:, :, None] * (stiffening[None] / caps)[None], residual)[:, 0]
        return move, jnp.max(jnp.abs(move) / caps, axis=0)

    end = _descent(look, step, point.elements, ELEMENT_TOLERANCE, ELEMENT_TRIALS)
    return ArrowPoint(end.point, point.globals)


class Settled(NamedTuple):
    """All elements at their minima for given globals: sum of the energies, residuals of the globals, and their
    derivatives (the Schur complement)."""

    energy: Float[Array, ""]
    residual: Float[Array, " g"]
    stiffness: Float[Array, "g g"]


def settled(system: AbstractConvexArrow, point: ArrowPoint) -> Settled:
    """The system at a point with all elements at their minima, as `settle` or `descend_settled` leaves them."""
    system, point = jax.lax.stop_gradient((system, point))
    values, tangents, energies = _tangents(system, point.elements, seen_by_elements(system, point))
    equations, jacobian = assembled(system, point, values, tangents, jnp.zeros(()))
    return Settled(jnp.sum(energies), equations.residual.globals, eliminated(jacobian)[1])


def descend_settled(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, trials: int) -> Descent:
    """Descends with the globals alone, all elements at their minima at every trial. A step costs more than
    one of `descend`, but elements with little load do not slow the search down. The globals stay within `bounds`:
    if one ends at its bound and its residual points outwards, the minimum is outside, as the potential is convex."""
    system, guess = jax.lax.stop_gradient((system, guess))
    caps = system.step_caps().globals
    low, high = (bound.globals for bound in system.bounds())

    def look(point: ArrowPoint) -> tuple[ArrowPoint, _View]:
        inside = ArrowPoint(point.elements, jnp.clip(point.globals, low, high))
        point = settle(system, inside)
        values, tangents, energies = _tangents(system.without_guess(), point.elements, seen_by_elements(system, point))
        equations, jacobian = assembled(system, point, values, tangents, jnp.zeros(()))
        held = pushed_out(system, point, equations.residual).astype(float)
        coupled, schur = eliminated(jacobian)
        right = equations.residual.globals * (1.0 - held)
        matrix = schur * (1.0 - held)[:, None] * (1.0 - held)[None, :] + jnp.diag(held)
        energy = jnp.sum(energies) - system.work(point.globals)
        # the elements are in equilibrium: only the residuals of the globals count
        return point, _View(energy, jnp.max(jnp.abs(right)), (right, matrix, coupled))

    def step(view: _View, stiffening: Array) -> tuple[ArrowPoint, Array]:
        right, matrix, coupled = view.blocks
        move = solve_dense(matrix + jnp.diag(stiffening / caps), right)
        return ArrowPoint(-jnp.einsum("mgn,g->mn", coupled, move), move), jnp.max(jnp.abs(move) / caps)

    end = _descent(look, step, guess, tolerance, trials)
    return Descent(end.point, end.view.size, end.steps)


class Minimum(NamedTuple):
    """End of the search for the minimum, its steps, and whether it was found to lie outside the bounds."""

    point: ArrowPoint
    steps: Int[Array, ""]
    outside: Bool[Array, ""]


def find_minimum(system: AbstractConvexArrow, *, tolerance: float, hopeless: Bool[Array, ""] | bool = False) -> Minimum:
    """The minimum of the potential to `tolerance`, if there is one inside the bounds, as a first guess of Newton's
    iteration. All unknowns descend together; if that does not converge, the globals descend alone with every element at
    its minimum. A system without globals needs `settle` only.

    The minimum is outside if a global is at its bound, all other equations are nearly satisfied (`OUTSIDE`) and the
    potential still falls outwards: a convex potential then has its minimum beyond the bound.

    **Arguments:** `hopeless`: True if it is known that there is no minimum; the second search is then left out.
    """
    system = jax.lax.stop_gradient(system)
    first = system.initial()
    if not first.globals.size:
        return Minimum(settle(system, first), jnp.asarray(0), jnp.asarray(False))
    quick = descend(system, first, tolerance=tolerance, trials=TOGETHER_TRIALS)
    slowly = lambda _: descend_settled(system, quick.point, tolerance=tolerance, trials=SETTLED_TRIALS)
    low, high = (bound.globals for bound in system.bounds())
    inside = jnp.all((quick.point.globals >= low) & (quick.point.globals <= high))
    done = ((quick.residual <= tolerance) & inside) | hopeless
    minimum = jax.lax.cond(done, lambda _: quick._replace(steps=jnp.zeros_like(quick.steps)), slowly, None)
    residual = evaluate(system, minimum.point).residual
    held = pushed_out(system, minimum.point, residual)
    push = jnp.max(jnp.where(held, jnp.abs(residual.globals), 0.0))
    rest = _largest(residual._replace(globals=jnp.where(held, 0.0, residual.globals)))
    finite = ArrowPoint(*(jnp.where(jnp.isfinite(leaf), leaf, 0.0) for leaf in minimum.point))
    return Minimum(finite, quick.steps + minimum.steps, jnp.any(held) & (rest <= OUTSIDE * push))


def pushed_out(system: AbstractConvexArrow, point: ArrowPoint, residual: ArrowPoint) -> Bool[Array, " g"]:
    """True for each global that is at a bound and whose residual points outwards."""
    low, high = (bound.globals for bound in system.bounds())
    ring, push = point.globals, residual.globals
    return ((ring >= high) & (push < 0)) | ((ring <= low) & (push > 0))


def _stiffened(jacobian: ArrowJacobian, caps: ArrowPoint, stiffening: Array) -> ArrowJacobian:
    local, corner = jnp.diag(stiffening / caps.elements[:, 0]), jnp.diag(stiffening / caps.globals)
    return jacobian._replace(local=jacobian.local + local[:, :, None], corner=jacobian.corner + corner)


def _largest(residual: ArrowPoint) -> Array:
    elements = jnp.max(jnp.abs(residual.elements), initial=0.0)
    return jnp.maximum(elements, jnp.max(jnp.abs(residual.globals), initial=0.0))
