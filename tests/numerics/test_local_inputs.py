"""Block-arrow systems whose elements see a few local inputs instead of all globals."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jaxtyping import Array, Float
from springs import flat

from jaxbearing.numerics.arrow import (
    AbstractArrowSystem,
    ArrowPoint,
    evaluate,
    linearize,
    schur_complement,
    solve_arrow,
)
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.numerics.small_linear import MOST_PIVOTS_UNROLLED, with_positive_pivots
from jaxbearing.numerics.status import Status


class Rim(AbstractArrowSystem):
    """Elements between a hub and a rim of many amplitudes. What an element sees is the closing of its gap, through
    `curved` a nonlinear function of the globals."""

    azimuth: Float[Array, " element"]
    load: Float[Array, ""]
    g: int = eqx.field(static=True)
    local: bool = eqx.field(static=True, default=True)
    curved: float = eqx.field(static=True, default=0.1)
    m: int = eqx.field(static=True, default=2)

    def shapes(self):
        return jnp.cos(jnp.arange(self.g, dtype=float)[:, None] * self.azimuth[None, :])

    def initial(self):
        return ArrowPoint(jnp.full((self.m, self.azimuth.size), 0.2), jnp.full(self.g, 0.05))

    def closing(self, amplitudes):
        """From amplitudes at every element."""
        shift = jnp.sum(amplitudes * self.shapes(), axis=0)
        return shift + self.curved * shift**2

    def forces(self, amplitudes, force):
        """Contributions to the globals, conjugate to `closing`."""
        shift = jnp.sum(amplitudes * self.shapes(), axis=0)
        return ((1.0 + 2.0 * self.curved * shift) * force)[None] * self.shapes()

    def local_inputs(self, globals_):
        return self.closing(globals_[:, None])[None] if self.local else None

    def gathered(self, globals_, acting):
        if not self.local:
            return jnp.sum(acting, axis=1)
        return jnp.concatenate(
            [jnp.sum(self.forces(globals_[:, None], acting[0]), axis=1), jnp.sum(acting[1:], axis=1)]
        )

    @property
    def extra_totals(self):
        return 1

    def element(self, unknowns, shared):
        closing = shared[0] if self.local else self.closing(shared)
        rows = [unknowns[i] + 0.1 * jnp.sin(unknowns[i]) - 0.3 * closing - 0.1 * unknowns[i - 1] for i in range(self.m)]
        pressed = closing - 0.3 * unknowns[0] if self.m else closing
        force = jnp.logaddexp(0.0, 4.0 * pressed) / 4.0 + pressed**3
        acting = force[None] if self.local else self.forces(shared, force)
        return jnp.stack(rows) if rows else unknowns, jnp.concatenate([acting, force[None] ** 2]), jnp.zeros(())

    def global_residual(self, globals_, totals):
        stiffness = 1.0 + jnp.arange(self.g, dtype=float) ** 2
        loads = jnp.zeros(self.g).at[1].set(self.load)
        return stiffness * globals_ + totals[: self.g] / self.azimuth.size - loads + 1e-3 * totals[self.g], jnp.zeros(
            ()
        )

    def step_caps(self):
        return ArrowPoint(jnp.full((self.m, 1), 1.0), jnp.full(self.g, 1.0))

    def bounds(self):
        high = ArrowPoint(jnp.full((self.m, 1), 50.0), jnp.full(self.g, 50.0))
        return ArrowPoint(-high.elements, -high.globals), high

    def equation_names(self):
        return tuple(f"e{i}" for i in range(self.m)) + tuple(f"g{i}" for i in range(self.g))


def rims(g=12, n=16, **more):
    system = Rim(jnp.asarray(0.1 + 2 * np.pi * np.arange(n) / n), jnp.asarray(2.0), g, **more)
    return system, dataclasses.replace(system, local=False)


@jax.jit
def algebra(system):
    point = system.initial()
    equations, jacobian = linearize(system, point)
    residual = evaluate(system, point).residual
    return flat(equations.residual), flat(residual), flat(solve_arrow(jacobian, residual)), schur_complement(jacobian)


@pytest.mark.parametrize("m", [0, 2])
def test_same_numbers_as_with_carried_globals(m):
    through, carried = (algebra(system) for system in rims(m=m))
    for one, other in zip(through, carried, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-13)


def test_same_root_and_derivative():
    @jax.jit
    def root(system):
        def number(load):
            _, result = newton_solve(dataclasses.replace(system, load=load))
            return jnp.sum(jnp.sin(result.point.globals)) + result.point.elements[0, 3], result.status

        return jax.value_and_grad(number, has_aux=True)(system.load)

    (through, status), slope = root(rims()[0])
    (carried, _), other = root(rims()[1])
    assert int(status) == Status.CONVERGED
    np.testing.assert_allclose([through, slope], [carried, other], rtol=1e-11)


def test_programs_do_not_grow_with_the_globals():
    """Tangents that the expensive part of an element is pushed along: m + p instead of m + g."""

    def size(system):
        shapes = jax.eval_shape(lambda s: s.tangents(s.initial().elements, s.local_inputs(s.initial().globals)), system)
        return shapes[1].shape[1]

    assert size(rims(g=5)[0]) == size(rims(g=25)[0]) == 3


@pytest.mark.parametrize("batch", [(), (4,)])
def test_pivots_in_a_loop_are_those_unrolled(batch):
    rng = np.random.default_rng(1)
    m = MOST_PIVOTS_UNROLLED
    matrix = jnp.asarray(rng.normal(size=(m, m, *batch)))
    shifted, changed = jax.jit(with_positive_pivots)(matrix)
    # one more unknown, which the others do not see, takes the loop
    wider = jnp.zeros((m + 1, m + 1, *batch)).at[:m, :m].set(matrix).at[m, m].set(1.0)
    looped, also = jax.jit(with_positive_pivots)(wider)
    np.testing.assert_allclose(looped[:m, :m], shifted, rtol=1e-10)
    np.testing.assert_array_equal(also, changed)
