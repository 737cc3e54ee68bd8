"""Parts of the search for steady temperatures: the problem, its evaluation at a point, the step to the next point."""

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
"""Largest change of a node temperature in one step, K."""
SHORT_STEP = 1e-6
"""Length of a step, K, below which it is always accepted: rounding may keep the balances from falling."""
RISE = 2.0
"""Factor by which the largest balance, relative to the total loss, may grow in a step of Broyden's iteration. With
skidding rollers, a search that demands a decrease in every step got stuck in 9 of 24 bearings, this search in none."""
HALVINGS = 8
"""Number of halvings of a step after which the iteration has failed."""
SMALLEST_LOSS = 1e-6
"""Part of the heat that leaves which replaces the total loss as the scale of the balances if it is larger, as in a
network without losses."""


class ThermalOptions(eqx.Module):
    """Tolerance and limits of the search. They are fixed in the compiled program.

    **Arguments:**
    - `tolerance`: largest balance of a node in a steady state as a part of the total loss (a number).
    - `jacobian`: `when_needed`: if Broyden's iteration fails, Newton's iteration with the exact Jacobian follows; the
      program contains the derivative of the losses. `never`: there is no Newton's iteration, and the program compiles
      in about half the time; the pseudo-transient run then updates its matrix from differences.
    - `stability`: True to compute the slopes at the root; not with `never`.
    - `quasi_newton_solves`, `newton_steps`, `time_steps`: largest number of evaluations of the losses in Broyden's
      iteration, in Newton's iteration, and in the pseudo-transient run.

    **Raises:** `ValueError` for an invalid option.
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
    """The losses at temperatures. All loops of the search share one trace of this function."""
    heat = losses(temperatures)
    return jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=jnp.result_type(leaf)), heat)


class Problem(NamedTuple):
    """Input of a search: a pytree whose leaves are the parameters.

    `losses(temperatures)`: the losses; `flows(temperatures, heat)`: heat flows of the network, with the conductances
    that the losses add. Both functions close over nothing. `start`: first temperatures, K; `capacity`: heat capacities,
    J/K, or `None`; `limit`: temperature that no node may exceed, K.
    """

    losses: Callable[[Array], NodeHeat]
    flows: Callable[[Array, NodeHeat], HeatFlows]
    start: Float[Array, " node"]
    capacity: Float[Array, " node"] | None
    limit: Float[Array, ""]

    def losses_at(self, temperatures: Array) -> NodeHeat:
        """The losses with all numbers as arrays (a traced function would return constants as plain numbers)."""
        return _evaluated(self.losses, temperatures)


class Point(NamedTuple):
    """Evaluation at temperatures: `losses`, and `residual`, the balances R, W. `norm` is the largest balance of a node
    and `whole` that of the network, both less their rounding errors and in units of the total loss."""

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
    # very large conductances make the balance of a node a matter of rounding; in the sum of the balances they cancel
    whole = jnp.abs(total - flows.to_oil - flows.to_ambient) - LAST_BITS * jnp.abs(total) - flows.rounding_out
    norm = jnp.max(jnp.maximum(jnp.abs(residual) - flows.rounding, 0.0))
    return Point(losses, residual, norm / scale, jnp.maximum(whole, 0.0) / scale)


def square(problem: Problem) -> Float[Array, "node node"]:
    return jnp.zeros((problem.start.size, problem.start.size))


def no_point(problem: Problem) -> Point:
    """Placeholder with the shapes of an evaluation: zeros, and infinite norms."""
    shape = jax.eval_shape(problem.losses_at, problem.start)
    losses = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), shape)
    return Point(losses, jnp.zeros_like(problem.start), jnp.asarray(jnp.inf), jnp.asarray(jnp.inf))


def evaluate(problem: Problem, temperatures: Array) -> tuple[Array, Array, NodeHeat, HeatFlows]:
    """Heat that flows into the nodes and heat of the losses, W, followed by the complete losses and flows."""
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
    """Step of a line search: `trial` is `base` plus 2^-`halvings` times `step`."""

    base: Float[Array, " node"]
    step: Float[Array, " node"]
    halvings: Int[Array, ""]
    trial: Float[Array, " node"]

    @classmethod
    def at(cls, start: Float[Array, " node"]) -> "Line":
        return cls(start, jnp.zeros_like(start), jnp.asarray(0), start)

    def goes_on(self, accepted: Bool[Array, ""], step: Float[Array, " node"]) -> "Line":
        """The next trial: along the new step if this trial was accepted, else half as far along the old step."""
        base = jnp.where(accepted, self.trial, self.base)
        # the direction is kept: with single nodes cut, a search took up to 25 solves instead of 15
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
        """True if the trial is accepted. **Arguments:** `before`: norm at the base; `first`: True if there is no base
        yet; `rise`: factor by which the norm may grow."""
        short = jnp.max(jnp.abs(self.trial - self.base)) < SHORT_STEP
        return ~point.broken & (first | short | (point.norm <= rise * before))


def rank_one(matrix: Array, step: Array, change: Array) -> Array:
    """Broyden's update: the matrix nearest to the last one that maps the step to the change of the balances."""
    square = jnp.sum(jnp.square(step))
    direction = step / jnp.where(square > 0.0, square, 1.0)
    return matrix + (change - matrix @ step)[:, None] * direction[None, :]
