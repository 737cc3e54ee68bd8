"""Least squares for any model that JAX can trace: Levenberg-Marquardt, BFGS or gradient descent, from several starts.

The fit of an oil (`traction`) uses it.
"""

import abc
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import optimistix as optx
from jaxtyping import Array, Bool, Float, Int

from jaxbearing.programs import KeptProgram

from .levenberg import minimised
from .loss import robust

METHODS = ("levenberg_marquardt", "bfgs", "gradient_descent")
MAX_STEPS = {"levenberg_marquardt": 200, "bfgs": 500, "gradient_descent": 20_000}
TOLERANCE = {"bfgs": 1e-9, "gradient_descent": 1e-9}
"""Absolute and relative tolerance of the scaled unknowns and of the loss, at which a method ends. Levenberg-Marquardt
uses `levenberg.OFFSET` instead."""


STATIONARY = 1e-7
"""Cosine between the residual and a column of the Jacobian, up to which the loss counts as stationary."""


class AbstractProblem(eqx.Module):
    """A least-squares problem: measured values, and those of a model as a function of scaled unknowns u.

    The natural coordinates of the model's parameters are `natural = base + directions @ (u / scales)`.

    **Arguments:**
    - `measured`, `deviation`: measured values, and their standard deviations times the tuning constant of the loss
      (`loss.TUNING`; 1 for the linear one).
    - `weight`: 1, or 0 for points that are left out.
    - `base`, `directions`, `scales`: natural coordinates at u = 0, matrix, scale of each u.
    - `loss`: one of `loss.LOSSES`.
    """

    measured: eqx.AbstractVar[Float[Array, " point"]]
    deviation: eqx.AbstractVar[Float[Array, " point"]]
    weight: eqx.AbstractVar[Float[Array, " point"]]
    base: eqx.AbstractVar[Float[Array, " parameter"]]
    directions: eqx.AbstractVar[Float[Array, "parameter parameter"]]
    scales: eqx.AbstractVar[Float[Array, " parameter"]]
    loss: eqx.AbstractVar[str]

    @abc.abstractmethod
    def predicted(self, u: Float[Array, " parameter"]) -> Float[Array, " point"]:
        """Values of the model at the measured points."""

    def natural(self, u: Float[Array, " parameter"]) -> Float[Array, " parameter"]:
        """Natural coordinates that belong to scaled unknowns."""
        return self.base + self.directions @ (u / self.scales)

    def plain_residual(self, u: Float[Array, " parameter"]) -> Float[Array, " point"]:
        """Model minus measurement, over the deviation; 0 for points that are left out."""
        return self.weight * (self.predicted(u) - self.measured) / self.deviation

    def residual(self, u: Float[Array, " parameter"]) -> Float[Array, " point"]:
        """Residual whose sum of squares is minimised: `plain_residual` transformed by the robust loss."""
        return robust(self.plain_residual(u), self.loss)


class Estimate(NamedTuple):
    """Result of an optimisation: unknowns, half the sum of squares, whether it converged, number of steps."""

    u: Float[Array, "*start parameter"]
    loss: Float[Array, "*start"]
    converged: Bool[Array, "*start"]
    steps: Int[Array, "*start"]


class _Descent(optx.AbstractGradientDescent):
    """Steepest descent with a backtracking line search: the step is halved until the loss falls enough."""

    rtol: float
    atol: float
    norm: Callable[[Any], Any]
    descent: Any
    search: Any

    def __init__(self, learning_rate: Any, tolerance: float):
        self.rtol, self.atol, self.norm = tolerance, tolerance, optx.max_norm
        self.descent = optx.SteepestDescent()
        self.search = optx.BacktrackingArmijo(step_init=learning_rate)


def jacobian(problem: AbstractProblem, u: Float[Array, " parameter"]) -> Float[Array, "point parameter"]:
    """Derivative d residual / d u by forward-mode differentiation."""
    return jax.jacfwd(problem.residual)(u)


def residual_and_jacobian(
    problem: AbstractProblem, u: Float[Array, " parameter"]
) -> tuple[Float[Array, " point"], Float[Array, "point parameter"]]:
    """Residual and its Jacobian from one pass of forward-mode differentiation."""
    along = lambda direction: jax.jvp(problem.residual, (u,), (direction,))
    return jax.vmap(along, out_axes=(None, 1))(jnp.eye(u.size))


def column_scales(problem: AbstractProblem, u: Float[Array, " parameter"]) -> Float[Array, " parameter"]:
    """Scales of u that make the columns of the Jacobian unit vectors. A column that is 0 or not finite keeps its
    present scale."""
    norms = jnp.linalg.norm(jacobian(problem, u), axis=0)
    return jnp.where((norms > 0) & jnp.isfinite(norms), norms, 1.0) * problem.scales


def estimate(problem: AbstractProblem, u: Float[Array, " parameter"], method: str) -> Estimate:
    """One optimisation. **Arguments:** `u`: start; `method`: one of `METHODS`."""
    half_square = lambda v, p: 0.5 * jnp.sum(jnp.square(p.residual(v)))
    if method == "levenberg_marquardt":
        end = minimised(lambda v: residual_and_jacobian(problem, v), u, MAX_STEPS[method])
        converged = (end.converged | _stationary(problem, end.u)) & jnp.isfinite(end.loss)
        return Estimate(end.u, end.loss, converged, end.steps)
    tolerance = TOLERANCE[method]
    if method == "bfgs":
        solver: Any = optx.BFGS(rtol=tolerance, atol=tolerance)
    else:
        columns = jacobian(problem, u)
        steepest = jnp.linalg.eigvalsh(columns.T @ columns)[-1]
        solver = _Descent(1.0 / jnp.where(steepest > 0, steepest, 1.0), tolerance)
    minimum = optx.minimise(half_square, solver, u, problem, max_steps=MAX_STEPS[method], throw=False)
    value = half_square(minimum.value, problem)
    # at a minimum exact to round-off no step is accepted any more, and the solver goes on to `MAX_STEPS`
    converged = (minimum.result == optx.RESULTS.successful) | _stationary(problem, minimum.value)
    converged = converged & jnp.isfinite(value)
    return Estimate(minimum.value, value, converged, jnp.asarray(minimum.stats["num_steps"]))


def _stationary(problem: AbstractProblem, u: Float[Array, " parameter"]) -> Bool[Array, ""]:
    """True if the residual is perpendicular to every column of its Jacobian, within `STATIONARY`."""
    residual, columns = problem.residual(u), jacobian(problem, u)
    size = jnp.linalg.norm(residual) * jnp.linalg.norm(columns, axis=0)
    return jnp.all(jnp.abs(columns.T @ residual) <= STATIONARY * size)


def estimates(problem: AbstractProblem, starts: Float[Array, "start parameter"], method: str) -> Estimate:
    """Optimisations from several starts in one batch; each uses the `column_scales` at its own start."""

    def optimised(u):
        scales = column_scales(problem, u)
        scaled = eqx.tree_at(lambda p: p.scales, problem, scales)
        end = estimate(scaled, u * scales / problem.scales, method)
        return end._replace(u=end.u * problem.scales / scales)

    return jax.vmap(optimised)(starts)


estimate_from = KeptProgram(estimates, quick=False)
"""Compiled `estimates`, with all of XLA's optimisations because it runs for seconds."""


def _held_out(
    problem: AbstractProblem, weights: Float[Array, "case point"], method: str
) -> tuple[Float[Array, "case point"], Bool[Array, " case"]]:
    """Predictions at all points by one optimisation for each row of weights, from u = 0, and whether each converged."""

    def prediction(weight):
        weighted = eqx.tree_at(lambda p: p.weight, problem, weight)
        u = jnp.zeros_like(problem.base)
        scaled = eqx.tree_at(lambda p: p.scales, weighted, column_scales(weighted, u))
        end = estimate(scaled, u, method)
        return scaled.predicted(end.u), end.converged

    return jax.vmap(prediction)(weights)


held_out = KeptProgram(_held_out, quick=False)
"""Compiled `_held_out`, with all of XLA's optimisations."""


def linearize(problem: AbstractProblem, u: Float[Array, " parameter"]) -> tuple[Array, Array, Array]:
    """Predicted values, plain residuals and their Jacobian with respect to the natural coordinates."""
    unit = eqx.tree_at(
        lambda p: (p.base, p.directions, p.scales),
        problem,
        (problem.natural(u), jnp.eye(len(problem.base)), jnp.ones_like(problem.scales)),
    )
    zero = jnp.zeros_like(u)
    return unit.predicted(zero), unit.plain_residual(zero), jax.jacfwd(unit.plain_residual)(zero)


linearized = KeptProgram(linearize, quick=True)
"""Quickly compiled `linearize`."""
