"""Parts of the search for steady temperatures: the problem, an evaluation of it, a step from one to the next."""

from collections.abc import Callable
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ..numerics.status import Status
from ..numerics.structure import choice, constant, count, switch
from .network import LAST_BITS, HeatFlows, NodeHeat, Slopes

GOING = -1
"""Status of a search that has not ended."""
STEP_CAP = 40.0
"""Longest step of one node, K."""
SHORT_STEP = 1e-6
"""A step below this, K, is taken whatever the balances do: rounding may keep them from falling."""
RISE = 2.0
"""Factor by which a step of Broyden's iteration may let the largest balance grow, relative to the total loss, which
changes too. Where rollers skid, a search that asks for a fall at each step got stuck in 9 of 24 bearings, this in
none."""
HALVINGS = 8
"""Times that a step is halved before the iteration has failed."""
SMALLEST_LOSS = 1e-6
"""The balances are compared with the total loss, or with this part of the heat that leaves if that is more: for a
network without losses."""


class ThermalOptions(eqx.Module):
    """Tolerance and limits of the search; they shape the program.

    **Arguments:**
    - `tolerance`: largest balance of a node in a steady state as a part of the total loss (a number).
    - `jacobian`: `when_needed`: Newton's iteration with the exact Jacobian follows where Broyden's has failed, and the
      program holds the derivative of the losses. `never`: it does not, and is compiled in about half the time; the
      pseudo-transient then updates its matrix from differences.
    - `stability`: whether the slopes at the root are wanted; not with `never`.
    - `quasi_newton_solves`, `newton_steps`, `time_steps`: most evaluations of the losses by Broyden's iteration, by
      Newton's, and by the pseudo-transient (a number each).

    **Raises:** `ValueError` for an option that is none of these.
    """

    tolerance: float = constant("tolerance", 1e-11, bound="> 0")
    jacobian: str = choice("jacobian", ("when_needed", "never"), "when_needed")
    stability: bool = switch("stability", False)
    quasi_newton_solves: int = count("quasi_newton_solves", 15, least=1)
    newton_steps: int = count("newton_steps", 30, least=1)
    time_steps: int = count("time_steps", 1500, least=1)

    def __check_init__(self):
        if self.stability and self.jacobian == "never":
            raise ValueError("stability = True needs the Jacobian: only with jacobian = 'when_needed'")


@eqx.filter_jit
def _evaluated(losses: Callable[[Array], NodeHeat], temperatures: Array) -> NodeHeat:
    """All loops of the search share one trace of the losses."""
    found = losses(temperatures)
    return jax.tree.map(lambda one: jnp.asarray(one, dtype=jnp.result_type(one)), found)


class Problem(NamedTuple):
    """Input of a search: a pytree whose leaves are the parameters.

    `losses(temperatures)`, `flows(temperatures, heat)`: the losses, and the flows of the network with the conductances
    that they add; they close over nothing. `start`: temperatures, K; `capacity`: heat capacities, J/K, or `None`;
    `limit`: temperature that no node may pass, K.
    """

    losses: Callable[[Array], NodeHeat]
    flows: Callable[[Array, NodeHeat], HeatFlows]
    start: Float[Array, " node"]
    capacity: Float[Array, " node"] | None
    limit: Float[Array, ""]

    def losses_at(self, temperatures: Array) -> NodeHeat:
        """The losses, all of them arrays: what is constant leaves a traced function as a plain number."""
        return _evaluated(self.losses, temperatures)


class Point(NamedTuple):
    """Evaluation at temperatures: losses, and balances R, W. In units of the total loss: `norm`, the largest balance of
    a node, and `whole`, that of the network; both less what rounding explains."""

    losses: NodeHeat
    residual: Float[Array, " node"]
    norm: Float[Array, ""]
    whole: Float[Array, ""]

    def balanced(self, tolerance: float) -> Bool[Array, ""]:
        """True in a steady state."""
        return jnp.maximum(self.norm, self.whole) <= tolerance

    @property
    def broken(self) -> Bool[Array, ""]:
        """True if the losses could not be computed here."""
        return (self.losses.status != Status.CONVERGED) | ~jnp.isfinite(self.norm)

    @property
    def failure(self) -> Int[Array, ""]:
        """Status of a search that ends here without a root: that of the losses, or `DIVERGED`."""
        return jnp.where(self.losses.status == Status.CONVERGED, int(Status.DIVERGED), self.losses.status)


def point_at(losses: NodeHeat, flows: HeatFlows) -> Point:
    """Losses, balances and their norms."""
    residual = flows.into_nodes + losses.heat
    total, leaving = jnp.sum(losses.heat), jnp.abs(flows.to_oil) + jnp.abs(flows.to_ambient)
    scale = jnp.maximum(total, SMALLEST_LOSS * leaving)
    scale = jnp.where(scale == 0.0, 1.0, scale)
    # conductances far above the others make the balance of a node a matter of last bits; the sum knows none of them
    whole = jnp.abs(total - flows.to_oil - flows.to_ambient) - LAST_BITS * jnp.abs(total) - flows.rounding_out
    norm = jnp.max(jnp.maximum(jnp.abs(residual) - flows.rounding, 0.0))
    return Point(losses, residual, norm / scale, jnp.maximum(whole, 0.0) / scale)


def square(problem: Problem) -> Float[Array, "node node"]:
    return jnp.zeros((problem.start.size, problem.start.size))


def no_point(problem: Problem) -> Point:
    """A point of the shape that an evaluation has."""
    shape = jax.eval_shape(problem.losses_at, problem.start)
    losses = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), shape)
    return Point(losses, jnp.zeros_like(problem.start), jnp.asarray(jnp.inf), jnp.asarray(jnp.inf))


def evaluate(problem: Problem, temperatures: Array) -> tuple[Array, Array, NodeHeat, HeatFlows]:
    """Heat that flows into the nodes, heat of the losses, W; and the losses and flows with all that they say."""
    losses = problem.losses_at(temperatures)
    flows = problem.flows(temperatures, losses)
    return flows.into_nodes, losses.heat, losses, flows


def linearised(problem: Problem, temperatures: Array) -> tuple[Point, Slopes]:
    """Point and exact slopes, from one evaluation and a tangent for each node."""

    def both(trial: Array) -> tuple[tuple[Array, Array], tuple[NodeHeat, HeatFlows]]:
        into, heat, losses, flows = evaluate(problem, trial)
        return (into, heat), (losses, flows)

    _, push, (losses, flows) = jax.linearize(both, temperatures, has_aux=True)
    into, heat = jax.vmap(push, out_axes=-1)(jnp.eye(temperatures.size))
    return point_at(losses, flows), Slopes(-into, heat)


class Line(NamedTuple):
    """A step from a base: the trial stands at the base plus a part of the step, 2^-halvings."""

    base: Float[Array, " node"]
    step: Float[Array, " node"]
    halvings: Int[Array, ""]
    trial: Float[Array, " node"]

    @classmethod
    def at(cls, start: Float[Array, " node"]) -> "Line":
        return cls(start, jnp.zeros_like(start), jnp.asarray(0), start)

    def goes_on(self, accepted: Bool[Array, ""], step: Float[Array, " node"]) -> "Line":
        """The next trial: along a new step where this one was accepted, else half as far along the old one."""
        base = jnp.where(accepted, self.trial, self.base)
        # the direction is kept: steps of which single nodes were cut took up to 25 solves instead of 15
        capped = step / jnp.maximum(jnp.max(jnp.abs(step)) / STEP_CAP, 1.0)
        step = jnp.where(accepted, capped, self.step)
        halvings = jnp.where(accepted, 0, self.halvings + 1)
        return Line(base, step, halvings, base + jnp.exp2(-halvings.astype(float)) * step)

    @property
    def stuck(self) -> Bool[Array, ""]:
        """True if there is no further trial along this step."""
        return ~jnp.all(jnp.isfinite(self.trial)) | (self.halvings > HALVINGS)

    def accepts(
        self, point: Point, before: Float[Array, ""], first: Bool[Array, ""], rise: float = 1.0
    ) -> Bool[Array, ""]:
        """True if a trial is taken. **Arguments:** `before`: norm at the base; `first`: there is no base yet; `rise`:
        factor by which the norm may grow."""
        short = jnp.max(jnp.abs(self.trial - self.base)) < SHORT_STEP
        return ~point.broken & (first | short | (point.norm <= rise * before))


def rank_one(matrix: Array, step: Array, change: Array) -> Array:
    """Broyden's update: the matrix nearest to the last one that maps the step to the change of the balances."""
    square = jnp.sum(jnp.square(step))
    direction = step / jnp.where(square > 0.0, square, 1.0)
    return matrix + (change - matrix @ step)[:, None] * direction[None, :]
