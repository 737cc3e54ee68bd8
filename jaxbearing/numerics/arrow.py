r"""Block-arrow systems: many small elements that are coupled only through a few global unknowns.

A rolling bearing is such a system: each rolling element has its own few unknowns, and elements
couple only through the ring and the cage. The Jacobian

$$J = \begin{pmatrix} A_1 & & & B_1 \\ & \ddots & & \vdots \\ & & A_N & B_N \\ C_1 & \cdots & C_N & D \end{pmatrix}$$

has the shape of an arrow. One forward pass through the element function, with m + g tangents, gives the blocks of all
elements; the derivatives of the few global equations come from a reverse pass.
Each element is eliminated, and the g x g Schur complement $D - \sum_j C_j A_j^{-1} B_j$ is solved, so the work is O(N).

Axes of arrays: m unknowns of one element, g globals, k totals (sums of contributions over the elements), p local inputs
(`local_inputs`), q rows of the second result of an element with local inputs.
"""

import abc
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from . import lapack
from .small_linear import UNROLLED_LIMIT, solve_blocks, solve_dense, with_positive_pivots

System = TypeVar("System", bound="AbstractArrowSystem")
Seen = TypeVar("Seen")


class ArrowPoint(NamedTuple):
    """Unknowns or residuals. The component axis comes first, so that every operation is vectorised over the
    elements."""

    elements: Float[Array, "m element"]
    globals: Float[Array, " g"]


class AbstractArrowSystem(eqx.Module):
    """Equations of many elements and a few globals. The system is a pytree whose array leaves are its parameters.

    Unknowns and residuals must be scaled to order 1. `increasing` says whether every pivot of the elimination is
    positive at a root. Each equation then increases with its own unknown while all earlier unknowns are in equilibrium.
    The unknowns of the elements come first, then the globals. A subclass may choose the sign of each equation for this.

    Subclasses are final. They hold every number that the equations depend on as a leaf, because derivatives of the
    solution are taken with respect to the leaves.
    """

    @abc.abstractmethod
    def initial(self) -> ArrowPoint:
        """Initial guess, scaled."""

    def homotopy(self: System, parameter: Float[Array, ""], path: Int[Array, ""]) -> System:
        """An easier system. If the first attempt fails, the solver follows the homotopies one after the other.

        **Arguments:** `parameter`: 0 gives this system, 1 the easiest one; `path`: number of the homotopy, from 0 on.
        """
        raise NotImplementedError

    def local_inputs(self, globals_: Float[Array, " g"]) -> Float[Array, "p element"] | None:
        """Local inputs: what each element gets in place of the globals. With `None` each element gets all globals.

        A few numbers for each element, such as the opening between the rings there, follow from the globals cheaply.
        `element` then takes them as `shared` and is differentiated with m + p tangents instead of m + g, so that many
        globals cost hardly more than few. Its second result then goes through `gathered`.
        """
        del globals_
        return None

    def gathered(self, globals_: Float[Array, " g"], acting: Float[Array, "q element"]) -> Float[Array, " k"]:
        """For a system with `local_inputs`: computes the totals from the second result of `element`; by default their
        sums over the elements."""
        del globals_
        return jnp.sum(acting, axis=1)

    @property
    def increasing(self) -> bool:
        """True if each equation grows with its own unknown at every root, see the class. Where an equation falls, the
        solver then uses `uphill_step`."""
        return True

    @property
    def lanes_together(self) -> bool:
        """True if a CPU is faster when it solves all members of a batch (lanes) together than one after the other. This
        is so for small programs without branches."""
        return False

    @property
    def rounding(self) -> float:
        """Factor by which round-off may keep the scaled residual above its tolerance at a root."""
        return 1.0

    @property
    def homotopies(self) -> int:
        """Number of homotopies from an easier system to this one. With 0 there is only the first attempt."""
        return 0

    @property
    def extra_totals(self) -> int:
        """Number k - g of additional totals: `global_residual` takes k totals, and there are g globals."""
        return 0

    @abc.abstractmethod
    def element(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> tuple[Float[Array, "m element"], Float[Array, "k element"], Float[Array, ""]]:
        """Local residuals, contributions to the totals, and the largest residual of nested solves (0: there are none).

        Column j of a result depends on column j of the arguments only. `shared` holds the globals, copied along the
        element axis: this copy allows one forward pass to yield every block of the arrow. With `local_inputs` it holds
        these, and the second result has q rows, which `gathered` turns into the totals.
        """

    def tangents(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> tuple[Float[Array, "row element"], Float[Array, "row m+g element"], Float[Array, ""]]:
        """Results of `element`, and their derivatives, as `element_tangents` returns them."""
        return element_tangents(self.element, unknowns, shared)

    @abc.abstractmethod
    def global_residual(
        self, globals_: Float[Array, " g"], totals: Float[Array, " k"]
    ) -> tuple[Float[Array, " g"], Float[Array, ""]]:
        """Global residuals, and the largest residual of nested solves (0: there are none).

        **Arguments:** `globals_`: global unknowns; `totals`: result of `gathered`, by default the contributions of
        `element`, summed over the elements.
        """

    @abc.abstractmethod
    def step_caps(self) -> ArrowPoint:
        """Largest step of each unknown in one Newton step: shapes (m, 1) and (g,), in scaled units."""

    @abc.abstractmethod
    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Lowest and highest allowed value of each unknown: shapes (m, 1) and (g,), in scaled units."""

    @abc.abstractmethod
    def equation_names(self) -> tuple[str, ...]:
        """Names of the m local equations, then of the g global ones, for messages."""


class ArrowJacobian(NamedTuple):
    """Blocks of the arrow. $A$ is `local`, $B$ `right_border`, $C$ the product of `chain` and `contributions`, $D$
    `corner`.

    - `local`: derivatives of the local residuals with respect to the element's unknowns.
    - `right_border`: derivatives of the local residuals with respect to the globals: the right border of the matrix.
    - `contributions`: derivatives of the contributions with respect to the element's unknowns; of a system with local
      inputs, those of the global residuals.
    - `corner`: derivatives of the global residuals with respect to the globals, with the unknowns of the elements held;
      the totals follow the globals.
    - `chain`: derivatives of the global residuals with respect to the totals; of a system with local inputs, the unit
      matrix.
    """

    local: Float[Array, "m m element"]
    right_border: Float[Array, "m g element"]
    contributions: Float[Array, "k m element"]
    corner: Float[Array, "g g"]
    chain: Float[Array, "g k"]


class Equations(NamedTuple):
    """All residuals at a point; `inner` is the largest residual of the solves nested inside them."""

    residual: ArrowPoint
    inner: Float[Array, ""]


def evaluate(system: AbstractArrowSystem, point: ArrowPoint) -> Equations:
    """All residuals at a point."""
    local, acting, inner = system.element(point.elements, seen_by_elements(system, point))
    global_part, global_inner = system.global_residual(point.globals, system.gathered(point.globals, acting))
    return Equations(ArrowPoint(local, global_part), jnp.maximum(inner, global_inner))


def linearize(system: AbstractArrowSystem, point: ArrowPoint) -> tuple[Equations, ArrowJacobian]:
    """Equations and Jacobian blocks, by one forward pass through the elements with m + g tangents (m + p with
    `local_inputs`) and a reverse pass through the global equations."""
    values, tangents, inner = system.tangents(point.elements, seen_by_elements(system, point))
    return assembled(system, point, values, tangents, inner)


def shared_by_elements(point: ArrowPoint) -> Float[Array, "g element"]:
    """The globals, copied along the element axis."""
    return jnp.broadcast_to(point.globals[:, None], (point.globals.shape[0], point.elements.shape[1]))


def seen_by_elements(system: AbstractArrowSystem, point: ArrowPoint) -> Float[Array, "p element"]:
    """The argument `shared` of `element`: the local inputs if there are any, otherwise the globals."""
    inputs = system.local_inputs(point.globals)
    return shared_by_elements(point) if inputs is None else inputs


def element_tangents(
    element: Callable[[Array, Array], tuple[Array, Array, Seen]],
    unknowns: Float[Array, "m element"],
    shared: Float[Array, "g element"],
) -> tuple[Float[Array, "row element"], Float[Array, "row m+g element"], Seen]:
    """Local residuals and contributions of `element`, their derivatives with respect to the element's unknowns and the
    globals, and the third result of `element`. The third result is a pytree of arrays and is not differentiated."""
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
    """Equations and Jacobian blocks, from the values and derivatives of the elements that `element_tangents` gives."""
    if system.local_inputs(point.globals) is not None:
        return _assembled_through_inputs(system, point, values, tangents, inner)
    m, g = point.elements.shape[0], point.globals.shape[0]
    totals = jnp.sum(values[m:], axis=1)
    global_part, pullback, global_inner = jax.vjp(system.global_residual, point.globals, totals, has_aux=True)
    direct, chain = jax.vmap(pullback)(jnp.eye(g)) if g else (jnp.zeros((0, 0)), jnp.zeros((0, len(totals))))
    jacobian = ArrowJacobian(
        local=tangents[:m, :m],
        right_border=tangents[:m, m:],
        contributions=tangents[m:, :m],
        corner=direct + chain @ jnp.sum(tangents[m:, m:], axis=-1),
        chain=chain,
    )
    return Equations(ArrowPoint(values[:m], global_part), jnp.maximum(inner, global_inner)), jacobian


def _assembled_through_inputs(
    system: AbstractArrowSystem, point: ArrowPoint, values: Array, tangents: Array, inner: Array
) -> tuple[Equations, ArrowJacobian]:
    """Does what `assembled` does, for a system with local inputs. The derivatives with respect to the local inputs are
    multiplied by the derivatives of the inputs with respect to the globals (chain rule).

    The block `contributions` then holds the derivatives of the global residuals, so `chain` is the unit matrix.
    """
    m, g = point.elements.shape[0], point.globals.shape[0]
    p, n = tangents.shape[1] - m, values.shape[1]
    moved = jax.jacfwd(system.local_inputs)(point.globals) if g else jnp.zeros((p, n, 0))
    closed = lambda globals_, acting: system.global_residual(globals_, system.gathered(globals_, acting))
    global_part, pullback, global_inner = jax.vjp(closed, point.globals, values[m:], has_aux=True)
    nothing = jnp.zeros((0, 0)), jnp.zeros((0, *values[m:].shape))
    direct, chain = jax.vmap(pullback)(jnp.eye(g)) if g else nothing
    acting = jnp.einsum("qpn,png->qng", tangents[m:, m:], moved)
    jacobian = ArrowJacobian(
        local=tangents[:m, :m],
        right_border=jnp.einsum("mpn,png->mgn", tangents[:m, m:], moved),
        contributions=jnp.einsum("gqn,qmn->gmn", chain, tangents[m:, :m]),
        corner=direct + jnp.einsum("gqn,qnh->gh", chain, acting),
        chain=jnp.eye(g),
    )
    return Equations(ArrowPoint(values[:m], global_part), jnp.maximum(inner, global_inner)), jacobian


def empty_jacobian(system: AbstractArrowSystem, point: ArrowPoint) -> ArrowJacobian:
    """A Jacobian of zeros with the right shapes, the initial value of a loop."""
    m, n = point.elements.shape
    g = point.globals.shape[0]
    k = g + system.extra_totals if system.local_inputs(point.globals) is None else g
    return ArrowJacobian(
        jnp.zeros((m, m, n)), jnp.zeros((m, g, n)), jnp.zeros((k, m, n)), jnp.zeros((g, g)), jnp.zeros((g, k))
    )


def eliminated(jacobian: ArrowJacobian) -> tuple[Float[Array, "m g element"], Float[Array, "g g"]]:
    """A^-1 B of every element, and the Schur complement."""
    coupled = solve_blocks(jacobian.local, jacobian.right_border)
    carried = jnp.sum(jnp.einsum("kmn,mgn->kgn", jacobian.contributions, coupled), axis=-1)
    return coupled, jacobian.corner - jacobian.chain @ carried


def schur_complement(jacobian: ArrowJacobian) -> Float[Array, "g g"]:
    """D - sum_j C_j A_j^-1 B_j: stiffness of the globals with every element in equilibrium."""
    return eliminated(jacobian)[1]


def condensed(matrix: Float[Array, "g g"], count: int) -> Float[Array, "count count"]:
    """Schur complement of a matrix on its first `count` unknowns: the other unknowns stay in equilibrium."""
    others = matrix[count:, count:]
    if not others.size:
        return matrix
    follow = matrix[count:, :count]
    follow = follow / others[0, 0] if len(others) == 1 else lapack.solve(others, follow)
    return matrix[:count, :count] - matrix[:count, count:] @ follow


def uphill_step(
    jacobian: ArrowJacobian, right: ArrowPoint
) -> tuple[ArrowPoint, Bool[Array, " element"], Bool[Array, ""]]:
    """Newton step J x = right with the sign of every negative pivot of J changed.

    Each equation is expected to grow with its own unknown while the unknowns before it are in equilibrium. Where it
    falls, the Newton step points away from a root that lies beyond a maximum of the residual; with the sign of the
    pivot changed, it points towards that root. Elements with more than `UNROLLED_LIMIT` unknowns are eliminated by
    LAPACK, and their pivots are not changed.

    **Returns:** the step x; True for each element that has a negative pivot; True if one of the globals has one.
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

    The matrix and the right-hand side are eliminated separately. If they shared one array, autodiff could not see that
    x is linear in `right`.
    """
    coupled, schur = eliminated(jacobian)
    return _solved(jacobian, coupled, schur, right)


def _solved(jacobian: ArrowJacobian, coupled: Array, schur: Array, right: ArrowPoint) -> ArrowPoint:
    own = solve_blocks(jacobian.local, right.elements[:, None, :])[:, 0]
    carried = jnp.sum(jnp.einsum("kmn,mn->kn", jacobian.contributions, own), axis=-1)
    globals_ = solve_dense(schur, right.globals - jacobian.chain @ carried)
    return ArrowPoint(own - jnp.sum(coupled * globals_[None, :, None], axis=1), globals_)
