"""Block-arrow systems through lineax and optimistix: their root finders on our equations, in O(N).

    import optimistix as optx

    solver = optx.Newton(rtol=1e-10, atol=1e-10, linear_solver=BlockArrow())
    solution = optx.root_find(
        arrow_residual, solver, system.initial(), args=system, adjoint=optx.ImplicitAdjoint(linear_solver=BlockArrow())
    )

`newton_solve` is what the library uses: it adds caps, bounds, backtracking, continuation and a status a lane.
"""

from typing import Any

import jax
import jax.numpy as jnp
import lineax as lx

from .arrow import AbstractArrowSystem, ArrowJacobian, ArrowPoint, evaluate, solve_arrow


def arrow_residual(point: ArrowPoint, system: AbstractArrowSystem) -> ArrowPoint:
    """Residuals of a system at a point, as optimistix wants its functions: `fn(y, args)`."""
    return evaluate(system, point).residual


class BlockArrow(lx.AbstractLinearSolver):
    """Direct solve with a linear operator from `ArrowPoint` to `ArrowPoint` whose matrix is a block arrow.

    The blocks are read off the operator with m + 2g products, whatever the number of elements; that rows of element j
    depend on element j and the globals only is taken for granted, not checked.

    **Arguments:** `idle`: number of globals, the last ones, on which no other row depends (integrals along the way).
    Nothing is asked about their rows but the diagonal: an iteration finds them one step after the others, and a
    derivative through this solver misses them.
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
