"""A small block-arrow system with any number of unknowns an element and globals, for tests of the solver."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from jaxbearing.numerics.arrow import AbstractArrowSystem, ArrowPoint, evaluate


class Springs(AbstractArrowSystem):
    """Cubic springs between a common body (globals) and its supports: m unknowns an element, g globals.

    With `m` = 0 the element has no unknown of its own; `totals` enter the closure nonlinearly.
    """

    stiffness: Float[Array, " element"]
    load: Float[Array, " g"]
    m: int = eqx.field(static=True, default=2)
    flaw: Float[Array, ""] = eqx.field(default_factory=lambda: jnp.zeros(()))

    def initial(self):
        return ArrowPoint(jnp.full((self.m, self.stiffness.shape[0]), 0.3), jnp.full(self.load.shape, 0.4))

    @property
    def extra_totals(self):
        return 2 - self.load.shape[0]

    def element(self, unknowns, shared):
        pull = self.stiffness * jnp.sum(shared, axis=0)
        rows = [unknowns[i] + 0.1 * unknowns[i] ** 3 + 0.2 * unknowns[i - 1] - pull / (i + 1.0) for i in range(self.m)]
        local = jnp.stack(rows) if rows else unknowns
        own = jnp.sum(unknowns, axis=0) if self.m else jnp.zeros_like(pull)
        return local, jnp.stack([pull + own + pull**3, own * pull]), jnp.zeros(())

    def global_residual(self, globals_, totals):
        other = jnp.flip(globals_)
        weights = jnp.arange(1.0, 1.0 + globals_.shape[0])
        residual = globals_ * (weights + totals[1] ** 2) + 0.3 * other + totals[0] - self.load
        return residual + jnp.where(self.flaw > 0, jnp.nan, 0.0), jnp.zeros(())  # a flaw > 0 makes every residual NaN

    def step_caps(self):
        return ArrowPoint(jnp.full((self.m, 1), 0.5), jnp.full(self.load.shape, 0.5))

    def bounds(self):
        high = ArrowPoint(jnp.full((self.m, 1), 50.0), jnp.full(self.load.shape, 50.0))
        return ArrowPoint(-high.elements, -high.globals), high

    def equation_names(self):
        return tuple(f"e{i}" for i in range(self.m)) + tuple(f"g{i}" for i in range(self.load.shape[0]))


def springs(m=2, g=2, n=5, scale=1.0, flaw=0.0):
    stiffness, load = jnp.asarray(np.linspace(0.5, 1.5, n)), jnp.asarray(scale * np.arange(1.0, 1.0 + g))
    return Springs(stiffness=stiffness, load=load, m=m, flaw=jnp.asarray(flaw))


def flat(point):
    return jnp.concatenate([point.elements.ravel(), point.globals])


def dense_jacobian(system, point):
    shape = point.elements.shape

    def function(v):
        size = shape[0] * shape[1]
        return flat(evaluate(system, ArrowPoint(v[:size].reshape(shape), v[size:])).residual)

    return jax.jacfwd(function)(flat(point))
