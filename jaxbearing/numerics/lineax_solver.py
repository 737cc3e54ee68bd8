"""Block-arrow systems in lineax and optimistix: their root finders solve our equations in O(N).

    import optimistix as optx

    solver = optx.Newton(rtol=1e-10, atol=1e-10, linear_solver=BlockArrow())
    solution = optx.root_find(
        arrow_residual, solver, system.initial(), args=system, adjoint=optx.ImplicitAdjoint(linear_solver=BlockArrow())
    )

The library itself uses `newton_solve`, which adds caps, bounds, backtracking, continuation and a status for each lane.
"""

from typing import Any

import jax
import jax.numpy as jnp
import lineax as lx

from .arrow import AbstractArrowSystem, ArrowJacobian, ArrowPoint, evaluate, solve_arrow


def arrow_residual(point: ArrowPoint, system: AbstractArrowSystem) -> ArrowPoint:
    """Residuals of a system at a point, with the arguments of a function of optimistix, `fn(y, args)`."""
    return evaluate(system, point).residual


class BlockArrow(lx.AbstractLinearSolver):
    """Direct solve with a linear operator from `ArrowPoint` to `ArrowPoint` whose matrix is a block arrow.

    m + 2g products with the operator give all blocks, for any number of elements. The rows of element j must depend on
    element j and the globals only; this is not checked.

    **Arguments:** `idle`: number of globals at the end on which no other row depends (integrals along the way). Only
    the diagonal of their rows is used: an iteration finds them one step after the others, and a derivative through
    this solver leaves them out.
    """

    idle: int = 0

    def init(self, operator: lx.AbstractLinearOperator, options: dict[str, Any]) -> ArrowJacobian:
        del options
        shape = operator.in_structure()
        m, n = shape.elements.shape
        (g,) = shape.globals.shape
        active = g - self.idle
        last = jnp.zeros(g).at[active:].set(1.0)
        # forward: the components of all elements, each active global, and all idle ones together
        forward = ArrowPoint(
            jnp.zeros((m + active + 1, m, n)).at[:m].set(jnp.broadcast_to(jnp.eye(m)[:, :, None], (m, m, n))),
            jnp.concatenate([jnp.zeros((m, g)), jnp.eye(active, g), last[None, :]]),
        )
        backward = ArrowPoint(jnp.zeros((active, m, n)), jnp.eye(active, g))
        if not self.idle:
            forward = jax.tree.map(lambda seeds: seeds[:-1], forward)
        products = jax.vmap(operator.mv)(forward)
        rows = jax.vmap(operator.transpose().mv)(backward)
        corner = jnp.diag(products.globals[-1] * last)
        corner = corner.at[:active, :active].set(products.globals[m : m + active, :active].T)
        # products come with the seed first; blocks have it second
        return ArrowJacobian(
            local=jnp.swapaxes(products.elements[:m], 0, 1),
            right_border=jnp.zeros((m, g, n)).at[:, :active].set(jnp.swapaxes(products.elements[m : m + active], 0, 1)),
            contributions=jnp.zeros((g, m, n)).at[:active].set(rows.elements),
            corner=corner,
            chain=jnp.eye(g),
        )

    def compute(
        self, state: ArrowJacobian, vector: ArrowPoint, options: dict[str, Any]
    ) -> tuple[ArrowPoint, lx.RESULTS, dict[str, Any]]:
        del options
        return solve_arrow(state, vector), lx.RESULTS.successful, {}

    def transpose(self, state: ArrowJacobian, options: dict[str, Any]) -> tuple[ArrowJacobian, dict[str, Any]]:
        swap = lambda block: jnp.swapaxes(block, 0, 1)
        transposed = ArrowJacobian(
            swap(state.local), swap(state.contributions), swap(state.right_border), state.corner.T, state.chain
        )
        return transposed, options

    def conj(self, state: ArrowJacobian, options: dict[str, Any]) -> tuple[ArrowJacobian, dict[str, Any]]:
        return jax.tree.map(jnp.conj, state), options

    def assume_full_rank(self) -> bool:
        return True
