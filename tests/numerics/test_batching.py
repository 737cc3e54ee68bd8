"""Lanes of a search one after the other under every combination of `vmap` and derivatives, with right values."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from springs import Springs, flat, springs

from jaxbearing.numerics.batching import in_turn
from jaxbearing.numerics.newton import newton_solve

SCALES = jnp.array([0.5, 1.0, 2.0])
STIFFNESS = jnp.array([1.0, 1.2, 1.5])


def size(scale, stiffness=1.0):
    """Of the root of a system: a sum of squares."""
    plain = springs(m=2, g=2, n=4)
    system = Springs(stiffness * plain.stiffness, scale * plain.load, m=2)
    return jnp.sum(jnp.square(flat(newton_solve(system)[1].point)))


def one_by_one(function, *batches):
    return np.stack([function(*lane) for lane in zip(*batches, strict=True)])


single = jax.jit(size)
slope = jax.jit(jax.grad(size))
slope_by_stiffness = jax.jit(jax.grad(size, 1))


CASES = {
    "vmap": (lambda: jax.vmap(size)(SCALES), lambda: one_by_one(single, SCALES)),
    "jit(vmap)": (lambda: jax.jit(jax.vmap(size))(SCALES), lambda: one_by_one(single, SCALES)),
    "nested": (
        lambda: jax.vmap(lambda k: jax.vmap(lambda s: size(s, k))(SCALES))(STIFFNESS),
        lambda: np.stack([one_by_one(lambda s, k=k: single(s, k), SCALES) for k in STIFFNESS]),
    ),
    "vmap(grad)": (lambda: jax.vmap(jax.grad(size))(SCALES), lambda: one_by_one(slope, SCALES)),
    "grad(vmap)": (
        lambda: jax.grad(lambda s: jnp.sum(jax.vmap(size)(s)))(SCALES),
        lambda: one_by_one(slope, SCALES),
    ),
    "grad(vmap), shared": (
        lambda: jax.jit(jax.grad(lambda k: jnp.sum(jax.vmap(size, (0, None))(SCALES, k))))(1.2),
        lambda: np.sum(one_by_one(lambda s: slope_by_stiffness(s, 1.2), SCALES)),
    ),
    "vmap(jit(grad))": (
        lambda: jax.vmap(jax.jit(jax.grad(size, 1)))(SCALES, STIFFNESS),
        lambda: one_by_one(slope_by_stiffness, SCALES, STIFFNESS),
    ),
    "jacfwd(vmap)": (
        lambda: np.diagonal(jax.jit(jax.jacfwd(jax.vmap(size)))(SCALES)),
        lambda: one_by_one(slope, SCALES),
    ),
    "vmap(hessian)": (
        lambda: jax.vmap(jax.hessian(size))(SCALES),
        lambda: one_by_one(jax.jit(jax.hessian(size)), SCALES),
    ),
}


SLOW = ("nested", "vmap(jit(grad))", "vmap(hessian)")


@pytest.mark.parametrize("case", [pytest.param(n, marks=pytest.mark.slow) if n in SLOW else n for n in CASES])
def test_combinations(case):
    batched, alone = CASES[case]
    np.testing.assert_allclose(batched(), alone(), rtol=1e-10)


def test_slopes_are_those_of_differences():
    step = 1e-5
    scales, sizes = np.asarray(SCALES), jax.jit(jax.vmap(size))
    slopes = np.subtract(sizes(scales + step), sizes(scales - step)) / (2.0 * step)
    np.testing.assert_allclose(jax.jit(jax.vmap(jax.grad(size)))(SCALES), slopes, rtol=1e-7)


def test_lanes_take_turns():
    """A lane that needs many steps keeps no other waiting: each body of the loop runs as often as its lane asks."""
    counted = []

    def search(limit):
        def step(state):
            jax.debug.callback(lambda _: counted.append(1), state)
            return state + 1.0

        return jax.lax.while_loop(lambda state: state < limit, step, 0.0)

    limits = jnp.array([1.0, 2.0, 30.0])
    np.testing.assert_array_equal(jax.vmap(lambda limit: in_turn(search, limit))(limits), limits)
    jax.effects_barrier()
    assert len(counted) == 33
    counted.clear()
    jax.vmap(search)(limits)
    jax.effects_barrier()
    assert len(counted) > 33


def test_on_other_devices_lanes_go_side_by_side(monkeypatch):
    monkeypatch.setattr(jax, "default_backend", lambda: "gpu")
    text = jax.make_jaxpr(jax.vmap(size))(SCALES)
    monkeypatch.undo()
    mapped = jax.make_jaxpr(jax.vmap(size))(SCALES)
    loops = lambda program: str(program).count("scan[")
    assert loops(text) == 0
    assert loops(mapped) > 0  # the search, and what LAPACK solves after it


def test_a_lane_that_fails_harms_no_other():
    def solved(flaw, scale):
        _, result = newton_solve(springs(m=2, g=2, n=4, scale=scale, flaw=flaw))
        return result.status, flat(result.point)

    status, points = jax.jit(jax.vmap(solved))(jnp.array([0.0, 1.0, 0.0]), SCALES)
    assert list(status == 0) == [True, False, True]
    np.testing.assert_allclose(points[2], jax.jit(solved)(0.0, 2.0)[1], rtol=1e-12)
    slopes = jax.jit(jax.vmap(jax.grad(lambda scale, flaw: jnp.sum(solved(flaw, scale)[1]))))
    assert np.all(np.isfinite(slopes(SCALES, jnp.array([0.0, 1.0, 0.0]))))
