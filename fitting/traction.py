"""The traction model as a function of the rheology's parameters: the problem that `estimation` solves to fit an oil."""

import equinox as eqx
import jax
from jaxtyping import Array, Float

from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.machines import DiskState, TwoDisk
from jaxbearing.programs import KeptProgram

from .estimation import AbstractProblem
from .parameters import with_natural


class Problem(AbstractProblem):
    """Differences of a two-disk machine's traction coefficients from measured ones.

    **Arguments:** besides those of `AbstractProblem`:
    - `scene`: the machine; `state`: patch, film and temperature of each point.
    - `rheology`: gives the reference temperature and everything else that is not fitted.
    """

    scene: TwoDisk
    state: DiskState
    rheology: ExponentialRheology
    measured: Float[Array, " point"]
    deviation: Float[Array, " point"]
    weight: Float[Array, " point"]
    base: Float[Array, " parameter"]
    directions: Float[Array, "parameter parameter"]
    scales: Float[Array, " parameter"]
    loss: str = eqx.field(static=True)

    def predicted(self, u: Float[Array, " parameter"]) -> Float[Array, " point"]:
        """Traction coefficients."""
        return predicted_coefficients(self.scene, self.state, self.rheology, self.natural(u))


def predicted_coefficients(
    scene: TwoDisk, state: DiskState, rheology: ExponentialRheology, natural: Float[Array, " parameter"]
) -> Float[Array, " point"]:
    """Traction coefficients of the points with the rheology that has these natural coordinates."""
    oil = eqx.tree_at(lambda o: o.rheology, scene.oil, with_natural(rheology, natural))
    return scene.traction(state, oil).rolling / state.load


coefficients = KeptProgram(predicted_coefficients, quick=True)
"""Compiled `predicted_coefficients`."""


def _slope_over_slide(problem: Problem, u: Float[Array, " parameter"]) -> Float[Array, " point"]:
    """Derivative of the model's traction coefficient by the slide-to-roll ratio at each point."""

    def predicted(sliding):
        moved = eqx.tree_at(lambda p: p.state, problem, problem.state._replace(sliding_speed=sliding))
        return moved.predicted(u)

    sliding = problem.state.sliding_speed
    speed = problem.state.entrainment_speed
    return jax.jvp(predicted, (sliding,), (speed,))[1]


slope_over_slide = KeptProgram(_slope_over_slide, quick=True)
"""Compiled `_slope_over_slide`."""
