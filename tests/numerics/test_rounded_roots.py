"""Equations so steep that rounding of the unknown keeps the residual above any tolerance."""

import jax
import jax.numpy as jnp
import pytest

from jaxbearing._types import Scalar
from jaxbearing.numerics.arrow import AbstractArrowSystem, ArrowPoint
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.numerics.status import Status

STEEP = 1e9


class Steep(AbstractArrowSystem):
    r"""$10^9\,((1 + x) - c) = 0$, whose $1 + x$ has steps of 2e-16; with a `gap` $10^9\,(x^2 + gap) = 0$, no root."""

    target: Scalar
    gap: Scalar | None = None

    def initial(self):
        return ArrowPoint(jnp.full((1, 1), 0.5), jnp.zeros(1))

    def element(self, unknowns, shared):
        value = (1.0 + unknowns) - self.target if self.gap is None else jnp.square(unknowns) + self.gap
        return STEEP * value, unknowns, jnp.zeros(())

    def closure(self, globals_, totals):
        return globals_ - totals, jnp.zeros(())

    def step_caps(self):
        return ArrowPoint(jnp.ones((1, 1)), jnp.ones(1))

    def bounds(self):
        return ArrowPoint(jnp.full((1, 1), -9.0), jnp.full(1, -9.0)), ArrowPoint(
            jnp.full((1, 1), 9.0), jnp.full(1, 9.0)
        )

    def equation_names(self):
        return "steep", "copy"


@pytest.mark.parametrize("target", [1.1, 1.7001, 2.0 / 0.7])
def test_a_root_that_rounding_hides_is_found(target):
    _, result = jax.jit(newton_solve)(Steep(jnp.asarray(target)))
    assert result.status == Status.CONVERGED
    assert abs(float(result.point.elements[0, 0]) - (target - 1.0)) < 1e-15
    assert abs(float(result.point.globals[0]) - (target - 1.0)) < 1e-15


@pytest.mark.parametrize("gap", [1e-6, 1e-12, 1e-18])
def test_a_minimum_is_no_root(gap):
    _, result = jax.jit(newton_solve)(Steep(jnp.asarray(0.0), jnp.asarray(gap)))
    assert result.status == Status.NOT_CONVERGED
