"""The equations of rollers in a flexible ring with all globals carried to every roller: the plain form, to compare with
`local_inputs`."""

import jax.numpy as jnp

from jaxbearing.bearings.cylindrical.equations import LubricatedRollerSystem
from jaxbearing.bearings.ring import LENGTH_UNIT
from jaxbearing.numerics.arrow import AbstractArrowSystem


class CarriedRollers(AbstractArrowSystem):
    """The same unknowns and residuals as `inner`."""

    inner: LubricatedRollerSystem

    def initial(self):
        return self.inner.initial()

    def step_caps(self):
        return self.inner.step_caps()

    def bounds(self):
        return self.inner.bounds()

    def equation_names(self):
        return self.inner.equation_names()

    @property
    def extra_totals(self):
        return self.inner.extra_totals

    def element(self, unknowns, shared):
        system, outer = self.inner, self.inner.outer
        d = system.directions.shape[0]
        shift = system.inward(shared[:d]) - LENGTH_UNIT * jnp.sum(shared[d : d + outer.modes] * outer.shapes, axis=0)
        seen = [shift] if system.cage is None else [shift, shared[-1]]
        local, acting, inner = system.element(unknowns, jnp.stack(seen))
        on_rings = [acting[0][None] * system.directions, acting[1][None] * outer.shapes]
        return local, jnp.concatenate([*on_rings, acting[2:]]), inner

    def global_residual(self, globals_, totals):
        return self.inner.global_residual(globals_, totals)
