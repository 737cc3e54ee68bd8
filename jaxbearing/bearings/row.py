r"""Model of a bearing without friction whose ring is held. The gradient of its convex energy is the force on the ring.

Centrifugal forces are evaluated at the contact angle of the unloaded bearing, so that force and stiffness derive from
an energy. The solve of a shaft starts its search with this model, and uses it to find the preload of bearings at rest,
for which it is exact.

Flexible rings are in equilibrium too: the energy is also the minimum over their amplitudes $a$. Near the minimum one
Newton step leads there. With the derivatives $r$ of the energy with respect to the amplitudes, and its second
derivatives $K$, the force is $F_q - K_{qa}K_{aa}^{-1}r$, the energy lower by $\frac12r^TK_{aa}^{-1}r$ and the
stiffness $K_{qq} - K_{qa}K_{aa}^{-1}K_{aq}$. The effect of an error of the amplitudes is therefore of second order.
"""

import abc
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import ArrowJacobian, ArrowPoint, condensed, linearize, schur_complement, seen_by_elements
from ..numerics.convex import AbstractConvexArrow, descend_settled, settle, settled
from ..numerics.small_linear import solve_blocks, solve_dense
from .ring import LENGTH_UNIT, InnerRing, levers, shift_matrix
from .rings import AbstractBetweenRings
from .solution import RING_FREEDOMS

BENDING_TOLERANCE = 1e-8
"""Scaled residual at which the search for the amplitudes of flexible rings ends. The force is then exact to round-off
(see the module)."""
BENDING_TRIALS = 80
"""Largest number of trials in the search for the amplitudes."""


class RowState(NamedTuple):
    """State of a row in units of the family, from which the next search starts.

    - `elements`: unknowns of the rolling elements.
    - `amplitudes`: amplitudes of flexible rings; `None` if both rings are rigid.
    """

    elements: Float[Array, "m element"]
    amplitudes: Float[Array, " mode"] | None = None


class HeldRow(NamedTuple):
    """A row whose ring is held at its port.

    - `energy`: energy, J, up to a constant.
    - `force`, `stiffness`: see `ring.Port`; the stiffness is symmetric.
    - `state`: state of the rolling elements and of flexible rings.
    """

    energy: Float[Array, ""]
    force: Float[Array, "5"]
    stiffness: Float[Array, "5 5"]
    state: RowState


class AbstractRow(eqx.Module):
    """A row of rolling elements between two rings that turn at given speeds."""

    @abc.abstractmethod
    def initial(self, displacement: Float[Array, "5"]) -> RowState:
        """First guess of the state for `hold`."""

    @abc.abstractmethod
    def hold(self, displacement: Float[Array, "5"], state: RowState) -> HeldRow:
        """The row in equilibrium with its ring held. No derivatives pass through the result.

        **Arguments:** `displacement`: displacement of the port including the closure, m and rad; `state`: state at a
        displacement nearby, or that of `initial`.
        """

    @abc.abstractmethod
    def force_at(self, displacement: Float[Array, "5"], state: RowState) -> Float[Array, "5"]:
        """The force of `hold`, with first derivatives with respect to all numbers. **Arguments:** `state`: the state
        that `hold` found at this displacement."""


class AbstractRowSystem(AbstractBetweenRings, AbstractConvexArrow):
    """Equations of a row of rollers. They are the gradient of a potential.

    The globals are the degrees of freedom of the inner ring and the amplitudes of flexible rings only.
    """

    @abc.abstractmethod
    def load_scale(self) -> Array:
        """Force by which the residuals of the rings are divided, N."""

    def work(self, globals_):
        """Work of the loads on the rings less the energy of flexible rings, J."""
        work = LENGTH_UNIT * jnp.sum(self.ring.load * self.of_freedoms(globals_))
        return work - self.bent.energy(LENGTH_UNIT * self.amplitudes(globals_)) if self.bent else work


def free_ring(lever: Array, distance: Array, expansion: Array | None) -> InnerRing:
    """A ring with five unknown degrees of freedom and no load. **Arguments:** see `InnerRing`."""
    return InnerRing(jnp.zeros(5), jnp.zeros(5), jnp.asarray(lever), RING_FREEDOMS, expansion, distance)


def initial_state(held: AbstractRowSystem) -> RowState:
    """First guess of the state for `settled_row`. **Arguments:** `held`: equations with the ring held."""
    first = held.initial()
    return RowState(first.elements, first.globals if held.bent else None)


def settled_row(held: AbstractRowSystem, full: AbstractRowSystem, state: RowState) -> HeldRow:
    """A row of rollers in equilibrium with the ring held.

    **Arguments:**
    - `held`: equations with the ring held at the displacement.
    - `full`: equations with all five degrees of freedom of the ring as the first globals.
    - `state`: first guess of the state.
    """
    # the search uses the equations with the ring held, which need fewer derivatives
    if state.amplitudes is None:
        state = RowState(settle(held, ArrowPoint(state.elements, jnp.zeros(0))).elements)
    else:
        guess = ArrowPoint(state.elements, state.amplitudes)
        bent = descend_settled(held, guess, tolerance=BENDING_TOLERANCE, trials=BENDING_TRIALS).point
        state = RowState(bent.elements, bent.globals)
    ring = held.ring
    potential = settled(full, ArrowPoint(state.elements, _coordinates(ring, state)))
    scale, arm = full.load_scale(), levers(ring.lever)
    energy, residual, stiffness = potential.energy, potential.residual, potential.stiffness
    if state.amplitudes is not None:
        follow = solve_dense(stiffness[5:, 5:], residual[5:])
        energy = energy + full.bent.energy(LENGTH_UNIT * state.amplitudes)
        energy = energy - 0.5 * LENGTH_UNIT * scale * jnp.sum(residual[5:] * follow)
        residual, stiffness = residual[:5] - stiffness[:5, 5:] @ follow, condensed(stiffness, 5)
    stiffness = stiffness * (scale / LENGTH_UNIT) * arm[:, None] * arm[None, :]
    shift = jnp.eye(5) if ring.distance is None else shift_matrix(ring.distance)
    force = _at_port(full, ring, residual)
    return HeldRow(energy, force, shift.T @ stiffness @ shift, state)


def settled_force(ring: InnerRing, full: AbstractRowSystem, state: RowState) -> Float[Array, "5"]:
    """The force of `settled_row` with its first derivatives, which follow from one Newton step of the elements and of
    the amplitudes of flexible rings. The step leaves their values unchanged, as they are in equilibrium.

    **Arguments:** `ring`: ring held at the displacement; `full`: see `settled_row`; `state`: state that `settled_row`
    found.
    """
    state = jax.lax.stop_gradient(state)
    globals_ = _coordinates(ring, state)
    residual, jacobian = _in_equilibrium(full, state.elements, globals_)
    if state.amplitudes is not None:
        stiffness = jax.lax.stop_gradient(schur_complement(jacobian))[5:, 5:]
        globals_ = globals_.at[5:].add(-solve_dense(stiffness, residual[5:]))
        residual, _ = _in_equilibrium(full, state.elements, globals_)
    return _at_port(full, ring, residual[:5])


def _coordinates(ring: InnerRing, state: RowState) -> Float[Array, " g"]:
    """Globals of the equations with five degrees of freedom at the displacements of a held ring."""
    at = ring.held / LENGTH_UNIT
    return at if state.amplitudes is None else jnp.concatenate([at, state.amplitudes])


def _in_equilibrium(
    full: AbstractRowSystem, elements: Float[Array, "m element"], globals_: Float[Array, " g"]
) -> tuple[Float[Array, " g"], ArrowJacobian]:
    """Residuals of the globals after one Newton step of the elements, and the Jacobian before it."""
    point = ArrowPoint(elements, globals_)
    equations, jacobian = linearize(full, point)
    local = jax.lax.stop_gradient(jacobian.local)
    step = solve_blocks(local, equations.residual.elements[:, None, :])[:, 0]
    acting = full.element(elements - step, seen_by_elements(full, point))[1]
    return full.global_residual(globals_, full.gathered(globals_, acting))[0], jacobian


def _at_port(full: AbstractRowSystem, ring: InnerRing, residual: Float[Array, "5"]) -> Float[Array, "5"]:
    force = (residual * full.load_scale() + full.ring.load) * levers(ring.lever)
    return force if ring.distance is None else shift_matrix(ring.distance).T @ force
