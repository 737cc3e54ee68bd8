"""Descents of a convex potential: beads between two plates, held by contacts that only push."""

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jaxtyping import Array, Float

from jaxbearing.numerics.arrow import ArrowPoint, evaluate
from jaxbearing.numerics.convex import AbstractConvexArrow, anchored, descend, descend_settled, find_minimum, settle


class Beads(AbstractConvexArrow):
    """Beads (x along the way, y across it, which nothing but a spring holds) between a wall and a plate at q that the
    load presses on them: energies $\\frac25k\\delta^{5/2}$ of $\\delta_1 = -x$ and $\\delta_2 = x - q + gap$."""

    stiffness: Float[Array, " bead"]
    gap: Float[Array, " bead"]
    load: Float[Array, ""]
    across: float = 1e-6
    start: float = 0.0

    def initial(self):
        return ArrowPoint(jnp.zeros((2, self.gap.size)), jnp.asarray([self.start]))

    def acting(self, unknowns, shared):
        x, y = unknowns
        depths = jnp.stack([-x, x - shared[0] + self.gap])
        closed = depths > 0
        depth = jnp.where(closed, depths, 0.0)
        force = self.stiffness[None] * depth * jnp.sqrt(jnp.where(closed, depths, 1.0))
        local = jnp.stack([force[1] - force[0], self.across * (y - 3.0)]) + anchored(unknowns, 1e-9)
        energy = 0.4 * jnp.sum(force * depth, axis=0) + 0.5 * self.across * jnp.square(y - 3.0)
        return local, -force[1:], energy

    def global_residual(self, globals_, totals):
        return totals + self.load + anchored(globals_, 1e-9), jnp.zeros(())

    def work(self, globals_):
        return -self.load * globals_[0]

    def step_caps(self):
        return ArrowPoint(jnp.ones((2, 1)), jnp.ones(1))

    def bounds(self):
        high = ArrowPoint(jnp.full((2, 1), 1e3), jnp.full(1, 50.0))
        return ArrowPoint(-high.elements, -high.globals), high

    def equation_names(self):
        return ("along", "across", "plate")


def beads(**changes):
    fields: dict[str, Any] = {
        "stiffness": jnp.asarray([1.0, 1e4, 30.0]),
        "gap": jnp.asarray([0.0, 2.0, 5.0]),
        "load": jnp.asarray(7.0),
    }
    return Beads(**(fields | changes))


def depth_of_both(load, system):
    """How far the plate goes under a load that all beads share: both contacts of each alike."""
    low, high = -100.0, 10.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        each = np.maximum(np.asarray(system.gap) - middle, 0.0) / 2.0
        low, high = (low, middle) if np.sum(np.asarray(system.stiffness) * each**1.5) < load else (middle, high)
    return low


WAYS = {
    "together": lambda system, guess: descend(system, guess, tolerance=1e-9, trials=200),
    "settled": lambda system, guess: descend_settled(system, guess, tolerance=1e-9, trials=200),
}


PROGRAMS = {way: eqx.filter_jit(search) for way, search in WAYS.items()}


@pytest.mark.parametrize("start", [0.0, 40.0, -60.0])
@pytest.mark.parametrize("way", WAYS)
def test_the_minimum_is_found_from_anywhere(way, start):
    system = beads()
    end = PROGRAMS[way](system, beads(start=start).initial())
    assert float(end.residual) < 1e-9
    assert float(end.point.globals[0]) == pytest.approx(depth_of_both(7.0, system), rel=1e-8)
    assert 0 < int(end.steps) < 60


def test_equations_are_the_gradient_of_the_potential():
    system = beads()
    point = ArrowPoint(jnp.asarray([[-0.3, 0.4, 1.0], [2.0, 5.0, 3.5]]), jnp.asarray([0.7]))
    slope, found = jax.jit(lambda at: (jax.grad(system.potential)(at), evaluate(system, at).residual))(point)
    np.testing.assert_allclose(found.elements, slope.elements, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(found.globals, slope.globals, rtol=1e-12)


def test_elements_settle_each_by_itself():
    """A bead that the plate does not reach stays; one far away, on a spring of 1e-6, comes to its place."""
    system = beads()
    guess = ArrowPoint(jnp.asarray([[0.0, -80.0, 3.0], [-900.0, 3.0, 70.0]]), jnp.asarray([1.0]))
    found = eqx.filter_jit(settle)(system, guess)
    assert np.max(np.abs(evaluate(system, found).residual.elements)) < 1e-8
    assert float(found.elements[0, 0]) >= 0.0
    np.testing.assert_allclose(found.elements[0, 1:], [-0.5, -2.0], rtol=1e-3)


def test_a_plate_that_is_pulled_off_has_no_minimum():
    search = eqx.filter_jit(lambda system: find_minimum(system, tolerance=1e-9).outside)
    assert bool(search(beads(load=jnp.asarray(-2.0))))
    assert not bool(search(beads()))


@pytest.mark.parametrize("way", WAYS)
def test_a_start_without_numbers_is_given_up_at_once(way):
    """Where lanes are searched at once, all wait for the slowest."""
    calls = []

    class Counted(Beads):
        def acting(self, unknowns, shared):
            jax.debug.callback(lambda _: calls.append(None), shared)
            return super().acting(unknowns, shared)

    system = Counted(**vars(beads(load=jnp.asarray(np.nan))))
    end = eqx.filter_jit(WAYS[way])(system, system.initial())
    jax.effects_barrier()
    assert int(end.steps) == 0
    assert 0 < len(calls) < 20
