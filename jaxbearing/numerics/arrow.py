r"""Block-arrow systems: many small elements that meet only through a few global unknowns.

A rolling bearing is such a system: each rolling element has its own few unknowns, and elements
couple only through the ring and the cage. The Jacobian

$$J = \begin{pmatrix} A_1 & & & B_1 \\ & \ddots & & \vdots \\ & & A_N & B_N \\ C_1 & \cdots & C_N & D \end{pmatrix}$$

is an arrow. Its blocks come from one forward pass over the element function with m + g tangents, each
element is eliminated, and the g x g Schur complement $D - \sum_j C_j A_j^{-1} B_j$ is solved: O(N).
"""

import abc
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .small_linear import UNROLLED_LIMIT, solve_blocks, solve_dense, with_positive_pivots

System = TypeVar("System", bound="AbstractArrowSystem")


class ArrowPoint(NamedTuple):
    """Unknowns or residuals: component axis first, so that every operation is a vector operation."""

    elements: Float[Array, "m element"]
    globals: Float[Array, " g"]


class AbstractArrowSystem(eqx.Module):
    """Equations of many elements and a few globals. A pytree: its array leaves are the parameters.

    Unknowns and residuals must be scaled to order 1. Where each equation grows with its own unknown at the root, those
    before it in equilibrium (elements first, then globals, each in its order; the sign of a row is yours to choose),
    say so by `increasing`. Subclasses are final and hold every number that the equations depend on as a leaf, because
    derivatives of the solution are taken with respect to the leaves.
    """

    @abc.abstractmethod
    def initial(self) -> ArrowPoint:
        """First guess."""

    def homotopy(self: System, parameter: Float[Array, ""], path: Int[Array, ""]) -> System:
        """The system along one of its `homotopies` (0, 1 ...), from parameter 0 (itself) to 1 (easy). The solver
        walks along them, one after the other, where it fails at once."""
        raise NotImplementedError

    @property
    def increasing(self) -> bool:
        """True if each equation grows with its own unknown at every root: Newton's steps are then turned uphill where
        one falls."""
        return True

    @property
    def lanes_together(self) -> bool:
        """True if the lanes of a batch are better solved all at once on a CPU: small programs without branches are."""
        return False

    @property
    def rounding(self) -> float:
        """Factor by which rounding may keep the scaled residual above its tolerance at a root."""
        return 1.0

    @property
    def homotopies(self) -> int:
        """Number of homotopies from an easier system to this one; 0: a solve that fails at once has failed."""
        return 0

    @property
    def extra_totals(self) -> int:
        """Says how many sums over the elements `global_residual` takes beyond one for each global."""
        return 0

    @abc.abstractmethod
    def element(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> tuple[Float[Array, "m element"], Float[Array, "k element"], Float[Array, ""]]:
        """Local residuals, contributions to the totals, and the largest residual of nested solves (0: none).

        Column j depends on column j only. `shared` holds the globals, copied along the element axis: that copy is
        what lets one forward pass yield every block of the arrow.
        """

    @abc.abstractmethod
    def global_residual(
        self, globals_: Float[Array, " g"], totals: Float[Array, " k"]
    ) -> tuple[Float[Array, " g"], Float[Array, ""]]:
        """Global residuals from the globals and the contributions summed over the elements; and, as in `element`,
        the largest residual of nested solves."""

    @abc.abstractmethod
    def step_caps(self) -> ArrowPoint:
        """Largest step of each unknown in one Newton step: shapes (m, 1) and (g,), in scaled units."""

    @abc.abstractmethod
    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Lowest and highest value of each unknown that an iterate may take: shapes (m, 1) and (g,)."""

    @abc.abstractmethod
    def equation_names(self) -> tuple[str, ...]:
        """Names of the m local and then the g global equations, for messages."""


class ArrowJacobian(NamedTuple):
    """Blocks of the arrow, and the factor that chains totals into global equations."""

    local: Float[Array, "m m element"]
    to_globals: Float[Array, "m g element"]
    contributions: Float[Array, "k m element"]
    corner: Float[Array, "g g"]
    chain: Float[Array, "g k"]


class Equations(NamedTuple):
    """All residuals at a point, and the largest residual of the solves nested inside them."""

    residual: ArrowPoint
    inner: Float[Array, ""]


def evaluate(system: AbstractArrowSystem, point: ArrowPoint) -> Equations:
    """All equations at a point."""
    n = point.elements.shape[1]
    shared = jnp.broadcast_to(point.globals[:, None], (point.globals.shape[0], n))
    local, contribution, inner = system.element(point.elements, shared)
    global_part, global_inner = system.global_residual(point.globals, jnp.sum(contribution, axis=1))
    return Equations(ArrowPoint(local, global_part), jnp.maximum(inner, global_inner))


def linearize(system: AbstractArrowSystem, point: ArrowPoint) -> tuple[Equations, ArrowJacobian]:
    """Equations and Jacobian blocks, by forward autodiff with m + g tangents."""
    values, tangents, inner = element_tangents(system.element, point.elements, shared_by_elements(point))
    return assembled(system, point, values, tangents, inner)


def shared_by_elements(point: ArrowPoint) -> Float[Array, "g element"]:
    """The globals, copied along the element axis."""
    return jnp.broadcast_to(point.globals[:, None], (point.globals.shape[0], point.elements.shape[1]))


def element_tangents(
    element: Callable[[Array, Array], tuple[Array, Array, Array]],
    unknowns: Float[Array, "m element"],
    shared: Float[Array, "g element"],
) -> tuple[Float[Array, "m+k element"], Float[Array, "m+k m+g element"], Array]:
    """Local residuals and contributions to totals of `element`, their derivatives by the element's unknowns and the
    globals, and its third result."""
    m, n = unknowns.shape
    width = m + shared.shape[0]

    def columns(v):
        local, contribution, more = element(v[:m], v[m:])
        return jnp.concatenate([local, contribution]), more

    v = jnp.concatenate([unknowns, shared])
    seeds = jnp.broadcast_to(jnp.eye(width)[:, :, None], (width, width, n))
    push = lambda seed: jax.jvp(columns, (v,), (seed,), has_aux=True)
    values, tangents, more = jax.vmap(push, out_axes=(None, 0, None))(seeds)
    return values, jnp.swapaxes(tangents, 0, 1), more


def assembled(
    system: AbstractArrowSystem, point: ArrowPoint, values: Array, tangents: Array, inner: Array
) -> tuple[Equations, ArrowJacobian]:
    """Equations and Jacobian blocks from those of the elements (`element_tangents`)."""
    m, g = point.elements.shape[0], point.globals.shape[0]
    totals = jnp.sum(values[m:], axis=1)
    global_part, pullback, global_inner = jax.vjp(system.global_residual, point.globals, totals, has_aux=True)
    direct, chain = jax.vmap(pullback)(jnp.eye(g)) if g else (jnp.zeros((0, 0)), jnp.zeros((0, len(totals))))
    jacobian = ArrowJacobian(
        local=tangents[:m, :m],
        to_globals=tangents[:m, m:],
        contributions=tangents[m:, :m],
        corner=direct + chain @ jnp.sum(tangents[m:, m:], axis=-1),
        chain=chain,
    )
    return Equations(ArrowPoint(values[:m], global_part), jnp.maximum(inner, global_inner)), jacobian


def empty_jacobian(system: AbstractArrowSystem, point: ArrowPoint) -> ArrowJacobian:
    """Blocks of zeros of the right shapes, to start a loop with."""
    m, n = point.elements.shape
    g = point.globals.shape[0]
    k = g + system.extra_totals
    return ArrowJacobian(
        jnp.zeros((m, m, n)), jnp.zeros((m, g, n)), jnp.zeros((k, m, n)), jnp.zeros((g, g)), jnp.zeros((g, k))
    )


def eliminated(jacobian: ArrowJacobian) -> tuple[Float[Array, "m g element"], Float[Array, "g g"]]:
    """A^-1 B of every element, and the Schur complement."""
    coupled = solve_blocks(jacobian.local, jacobian.to_globals)
    carried = jnp.sum(jnp.einsum("kmn,mgn->kgn", jacobian.contributions, coupled), axis=-1)
    return coupled, jacobian.corner - jacobian.chain @ carried


def schur_complement(jacobian: ArrowJacobian) -> Float[Array, "g g"]:
    """D - sum_j C_j A_j^-1 B_j: stiffness of the globals with every element in equilibrium."""
    return eliminated(jacobian)[1]


def condensed(matrix: Float[Array, "g g"], count: int) -> Float[Array, "k k"]:
    """The Schur complement on the first `count` unknowns of a matrix, those behind them in equilibrium."""
    others = matrix[count:, count:]
    if not others.size:
        return matrix
    follow = matrix[count:, :count]
    follow = follow / others[0, 0] if len(others) == 1 else jnp.linalg.solve(others, follow)
    return matrix[:count, :count] - matrix[:count, count:] @ follow


def uphill_step(
    jacobian: ArrowJacobian, right: ArrowPoint
) -> tuple[ArrowPoint, Bool[Array, " element"], Bool[Array, ""]]:
    """The solution of J x = right with J changed where a pivot is negative, in which elements one was, and whether one
    of the globals was.

    Each equation is meant to grow with its own unknown when those before it are in equilibrium. Where it falls, the
    Newton step points away from the root behind the hump; with the pivot's sign turned it points across it. Elements
    of more than 4 unknowns, which LAPACK eliminates, are left as they are.
    """
    local, changed = jacobian.local, jnp.zeros(jacobian.local.shape[2:], dtype=bool)
    if local.shape[0] <= UNROLLED_LIMIT:
        local, changed = with_positive_pivots(local)
    jacobian = jacobian._replace(local=local)
    coupled, schur = eliminated(jacobian)
    shifted, schur_changed = with_positive_pivots(schur)
    return _solved(jacobian, coupled, shifted, right), changed, schur_changed


def solve_arrow(jacobian: ArrowJacobian, right: ArrowPoint) -> ArrowPoint:
    """J x = right, by elimination of the elements and the Schur complement of the globals.

    Matrix and right side are eliminated apart: in one array, autodiff could not see that x is linear in `right`.
    """
    coupled, schur = eliminated(jacobian)
    return _solved(jacobian, coupled, schur, right)


def _solved(jacobian: ArrowJacobian, coupled: Array, schur: Array, right: ArrowPoint) -> ArrowPoint:
    own = solve_blocks(jacobian.local, right.elements[:, None, :])[:, 0]
    carried = jnp.sum(jnp.einsum("kmn,mn->kn", jacobian.contributions, own), axis=-1)
    globals_ = solve_dense(schur, right.globals - jacobian.chain @ carried)
    return ArrowPoint(own - jnp.sum(coupled * globals_[None, :, None], axis=1), globals_)
