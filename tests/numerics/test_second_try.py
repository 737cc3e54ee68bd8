"""The walk from an easier system where Newton's iteration fails at once."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jaxtyping import Array, Float

from jaxbearing.numerics.arrow import AbstractArrowSystem, ArrowPoint
from jaxbearing.numerics.continuation import LONGEST_STAGE, MOST_STEPS
from jaxbearing.numerics.newton import NewtonOptions, newton_solve
from jaxbearing.numerics.status import Status


class Plateau(AbstractArrowSystem):
    """tanh(k (x - a)) = 0 for every element and the global: far from the root it is flat, and Newton overshoots to
    where it is flatter still."""

    root: Float[Array, ""]
    steepness: Float[Array, ""]
    reachable: bool = eqx.field(static=True, default=True)
    lost: bool = eqx.field(static=True, default=False)

    def plateau(self, x):
        return jnp.tanh(self.steepness * (x - self.root))

    def initial(self):
        return ArrowPoint(jnp.zeros((1, 2)), jnp.zeros(1))

    def element(self, unknowns, shared):
        return self.plateau(unknowns), 0.0 * shared, jnp.zeros(())

    def global_residual(self, globals_, totals):
        return self.plateau(globals_) + totals, jnp.zeros(())

    def step_caps(self):
        return ArrowPoint(jnp.full((1, 1), 1e9), jnp.full(1, 1e9))

    def bounds(self):
        return ArrowPoint(jnp.full((1, 1), -1e12), jnp.full(1, -1e12)), ArrowPoint(
            jnp.full((1, 1), 1e12), jnp.full(1, 1e12)
        )

    def equation_names(self):
        return ("local", "global")


class Eased(Plateau):
    """At parameter 1 of the homotopy the root is the first guess."""

    homotopies = 2

    def homotopy(self, parameter, path):
        """Way 0 breaks off half way where the root is not `reachable`; way 1 breaks off where `lost`."""
        breaks = (path == 0) & (not self.reachable) | self.lost
        target = self.root + jnp.where(breaks & (parameter < 0.5), 1e6, 0.0)
        return eqx.tree_at(lambda system: system.root, self, (1.0 - parameter) * target)


class Capped(Eased):
    """Steps may cross the flank, onto the plateau behind it."""

    def step_caps(self):
        return ArrowPoint(jnp.full((1, 1), 5.0), jnp.full(1, 5.0))


class Far(Eased):
    """x - a = 0 by steps of 0.15 at most, from -1e6; with any parameter above 0 from 0."""

    start: Array | float = -1e6

    def plateau(self, x):
        return x - self.root

    def initial(self):
        return ArrowPoint(jnp.full((1, 2), self.start), jnp.full(1, self.start))

    def step_caps(self):
        return ArrowPoint(jnp.full((1, 1), 0.15), jnp.full(1, 0.15))

    def homotopy(self, parameter, path):
        return Far(self.root, self.steepness, start=jnp.where(parameter > 0.0, 0.0, self.start))


class TwoRoots(Eased):
    """x^2 = a^2, and a nested solve that fails at the root -a; the last way alone begins beside the other one."""

    start: Array | float = -2.0
    increasing = False

    def plateau(self, x):
        return jnp.square(x) - jnp.square(self.root)

    def initial(self):
        return ArrowPoint(jnp.full((1, 2), self.start), jnp.full(1, self.start))

    def element(self, unknowns, shared):
        return self.plateau(unknowns), 0.0 * shared, jnp.where(jnp.min(unknowns) < 0.0, 1.0, 0.0)

    def homotopy(self, parameter, path):
        other = (path == self.homotopies - 1) & (parameter > 0.0) & self.reachable
        return TwoRoots(self.root, self.steepness, self.reachable, start=jnp.where(other, 2.0, self.start))


def parameters(root, steepness=1.0):
    return jnp.asarray(root), jnp.asarray(steepness)


@eqx.filter_jit
def solved(system, options=None):
    return newton_solve(system, options or NewtonOptions())[1]


def test_without_a_path_newton_fails_and_says_so():
    _, result = newton_solve(Plateau(*parameters(6.0)))
    assert int(result.status) != Status.CONVERGED


@pytest.mark.parametrize("root", [0.5, 1.5, 6.0, 7.5, 40.0])
@pytest.mark.parametrize("kind", [Eased, Capped])
def test_second_try_finds_the_root(kind, root):
    result = solved(kind(*parameters(root)))
    assert int(result.status) == Status.CONVERGED
    np.testing.assert_allclose(result.point.elements, root, rtol=1e-14)
    np.testing.assert_allclose(result.point.globals, root, rtol=1e-14)


def test_stages_shorten_where_one_fails():
    """A quarter of the way is more than Newton can take from where it stands."""
    root = 40.0
    quarter = solved(Plateau(*parameters(LONGEST_STAGE * root)))
    assert int(quarter.status) != Status.CONVERGED
    whole = solved(Eased(*parameters(root)))
    assert int(whole.status) == Status.CONVERGED


@pytest.mark.parametrize("root", [6.0, 25.0])
def test_a_further_try_walks_far_by_capped_steps(root):
    """A capped step is a small part of Newton's, and the residual falls by as small a part: that must do."""
    result = solved(Far(*parameters(root)))
    assert int(result.status) == Status.CONVERGED
    assert int(result.iterations) <= NewtonOptions().max_steps + root / 0.15 + 12
    np.testing.assert_allclose(result.point.elements, root, rtol=1e-14)


@pytest.mark.parametrize("root", [0.5, 6.0])
def test_derivative_of_a_second_try_is_that_of_the_root(root):
    """x = a: dx/da = 1, dx/dk = 0, in both modes."""
    for jacobian in SLOPES:
        np.testing.assert_allclose(jacobian(*parameters(root)), (1.0, 0.0), atol=1e-13)


def place(root, steepness):
    return newton_solve(Eased(root, steepness))[1].point.globals[0]


SLOPES = [jax.jit(mode(place, argnums=(0, 1))) for mode in (jax.jacfwd, jax.jacrev)]


def test_a_path_that_breaks_ends_with_a_status_and_not_in_a_loop():
    options = NewtonOptions(max_steps=20)
    result = solved(Eased(*parameters(6.0), lost=True), options)
    assert int(result.status) in (Status.NOT_CONVERGED, Status.DIVERGED)
    assert options.max_steps < int(result.iterations) <= (1 + 2 * MOST_STEPS) * options.max_steps


def test_continuation_can_be_left_out():
    result = solved(Eased(*parameters(6.0)), NewtonOptions(continuation=False))
    assert int(result.status) != Status.CONVERGED
    assert int(result.iterations) <= 60


def test_where_one_way_breaks_off_the_next_is_taken():
    result = solved(Eased(*parameters(6.0), reachable=False))
    assert int(result.status) == Status.CONVERGED
    np.testing.assert_allclose(result.point.globals, 6.0, rtol=1e-14)


def test_lanes_take_the_second_try_apart():
    """In one batch: a lane that needs no second try keeps its result and its count of steps."""
    roots = jnp.asarray([0.3, 6.0, 0.5, 40.0])
    solve = lambda root: newton_solve(Eased(root, jnp.asarray(1.0)))[1]
    batch = jax.jit(jax.vmap(solve))(roots)
    assert np.all(np.asarray(batch.status) == Status.CONVERGED)
    for i, root in enumerate(roots):
        alone = solved(Eased(*parameters(root)))
        assert int(alone.iterations) == int(batch.iterations[i])
        np.testing.assert_allclose(batch.point.globals[i], alone.point.globals, rtol=1e-14)


def test_where_a_nested_solve_fails_every_way_is_tried():
    """The root of the first ways is none, whatever the steps; the last way ends at another one."""
    result = solved(TwoRoots(*parameters(1.0)))
    assert int(result.status) == Status.CONVERGED
    np.testing.assert_allclose(result.point.elements, 1.0, rtol=1e-14)


def test_where_a_nested_solve_fails_on_every_way_the_solve_fails_soon():
    result = solved(TwoRoots(*parameters(1.0), reachable=False))
    assert int(result.status) == Status.NOT_CONVERGED
    assert float(result.inner_residual) == 1.0
    assert int(result.iterations) < 60
