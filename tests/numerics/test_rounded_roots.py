"""Equations so steep that rounding of the unknown keeps the residual above any tolerance."""

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
import pytest

from jaxbearing.numerics.arrow import AbstractArrowSystem, ArrowPoint
from jaxbearing.numerics.newton import NewtonOptions, newton_solve
from jaxbearing.numerics.status import Status

STEEP = 1e9


class Steep(AbstractArrowSystem):
    """`STEEP` times a function of the one unknown of the one element; the global unknown is its copy."""

    function: Callable = eqx.field(static=True)
    low: float = eqx.field(static=True, default=-9.0)

    def initial(self):
        return ArrowPoint(jnp.full((1, 1), 0.5), jnp.zeros(1))

    def element(self, unknowns, shared):
        return STEEP * self.function(unknowns), unknowns, jnp.zeros(())

    def global_residual(self, globals_, totals):
        return globals_ - totals, jnp.zeros(())

    def step_caps(self):
        return ArrowPoint(jnp.ones((1, 1)), jnp.ones(1))

    def bounds(self):
        low, high = jnp.asarray(self.low), jnp.asarray(9.0)
        return ArrowPoint(low[None, None], low[None]), ArrowPoint(high[None, None], high[None])

    def equation_names(self):
        return "steep", "copy"


@pytest.mark.parametrize("square", [2.0, 3.0, 7.0])
def test_a_root_that_rounding_hides_is_found(square):
    """u^2 of the floats next to the root is above and below `square`, by 1e-16 of it; times 1e9 that is 1e-7."""
    _, result = jax.jit(newton_solve)(Steep(lambda u: u * u - square))
    assert result.status == Status.CONVERGED
    assert result.residual_norm > NewtonOptions().residual_tolerance
    assert abs(float(result.point.elements[0, 0]) / square**0.5 - 1.0) < 1e-15
    assert abs(float(result.point.globals[0]) / square**0.5 - 1.0) < 1e-15


def test_a_step_of_many_last_bits_is_no_root():
    """The function jumps from -1e-13 to 1e-13, some 500 last bits of the unknown."""
    _, result = jax.jit(newton_solve)(Steep(lambda u: u + jnp.where(u > 1.1, 1e-13, -1e-13) - 1.1))
    assert result.status == Status.NOT_CONVERGED


@pytest.mark.parametrize("gap", [1.0 / STEEP, 1e-3 / STEEP])
def test_a_steep_end_is_no_root(gap):
    """At the lower bound the slope is 5e19 times `STEEP`: the last bits of 1 would make any residual of it."""
    _, result = jax.jit(newton_solve)(Steep(lambda u: jnp.sqrt(u + 1e-40) + gap, 0.0))
    assert result.status != Status.CONVERGED
