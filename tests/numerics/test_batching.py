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


def size(scale, stiffness=1.0, flaw=0.0):
    """Of the root of a system: a sum of squares; beside it the status of the search."""
    plain = springs(m=1, g=2, n=3)
    system = Springs(stiffness * plain.stiffness, scale * plain.load, m=1, flaw=jnp.asarray(flaw))
    _, result = newton_solve(system)
    return jnp.sum(jnp.square(flat(result.point))), result.status


value = lambda *numbers: size(*numbers)[0]
with_slopes = jax.value_and_grad(size, (0, 1), has_aux=True)
alone = jax.jit(with_slopes)


@pytest.fixture(scope="module")
def lanes():
    """Sizes of the lanes, and their slopes by scale and stiffness, one by one."""
    found = [alone(scale, 1.2) for scale in SCALES]
    return tuple(np.array(part) for part in zip(*((size, *slopes) for (size, _), slopes in found), strict=True))


def values_and_slopes(scales):
    (sizes, _), (slopes, _) = jax.vmap(with_slopes, (0, None))(scales, 1.2)
    return jnp.stack([sizes, slopes])


CASES = {
    "vmap(grad)": (lambda: values_and_slopes(SCALES), lambda lanes: np.stack(lanes[:2])),
    "grad(vmap), shared": (
        lambda: jax.grad(lambda k: jnp.sum(jax.vmap(value, (0, None))(SCALES, k)))(1.2),
        lambda lanes: np.sum(lanes[2]),
    ),
    "jacfwd(vmap)": (
        lambda: jnp.diagonal(jax.jacfwd(lambda s: jax.vmap(value, (0, None))(s, 1.2))(SCALES)),
        lambda lanes: lanes[1],
    ),
    "nested": (
        lambda: jax.vmap(lambda k: jax.vmap(lambda s: value(s, k))(SCALES))(STIFFNESS),
        lambda _: np.stack([[alone(s, k)[0][0] for s in SCALES] for k in STIFFNESS]),
    ),
    "vmap(jit(grad))": (
        lambda: jax.vmap(jax.jit(jax.grad(value, 1)))(SCALES, STIFFNESS),
        lambda _: np.array([alone(*lane)[1][1] for lane in zip(SCALES, STIFFNESS, strict=True)]),
    ),
    "vmap(hessian)": (
        lambda: jax.vmap(jax.hessian(value))(SCALES),
        lambda _: np.stack([jax.jit(jax.hessian(value))(scale) for scale in SCALES]),
    ),
}


SLOW = ("nested", "vmap(jit(grad))", "vmap(hessian)")


@pytest.mark.parametrize("case", [pytest.param(n, marks=pytest.mark.slow) if n in SLOW else n for n in CASES])
def test_combinations(case, lanes):
    batched, expected = CASES[case]
    np.testing.assert_allclose(jax.jit(batched)(), expected(lanes), rtol=1e-10)


def test_slopes_are_those_of_differences(lanes):
    step = 1e-5
    difference = lambda low, high: (alone(*high)[0][0] - alone(*low)[0][0]) / (2.0 * step)
    for scale, by_scale, by_stiffness in zip(np.asarray(SCALES), *lanes[1:], strict=True):
        found = [
            difference((scale - step, 1.2), (scale + step, 1.2)),
            difference((scale, 1.2 - step), (scale, 1.2 + step)),
        ]
        np.testing.assert_allclose([by_scale, by_stiffness], found, rtol=1e-7)


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
    text = jax.make_jaxpr(jax.vmap(value))(SCALES)
    monkeypatch.undo()
    mapped = jax.make_jaxpr(jax.vmap(value))(SCALES)
    loops = lambda program: str(program).count("scan[")
    assert loops(text) == 0
    assert loops(mapped) > 0  # the search, and what LAPACK solves after it


def test_a_lane_that_fails_harms_no_other():
    (sizes, status), slopes = jax.jit(jax.vmap(with_slopes))(SCALES, STIFFNESS, jnp.array([0.0, 1.0, 0.0]))
    assert list(status == 0) == [True, False, True]
    (expected, _), expected_slopes = alone(SCALES[2], STIFFNESS[2])
    np.testing.assert_allclose(sizes[2], expected, rtol=1e-12)
    np.testing.assert_allclose([slope[2] for slope in slopes], expected_slopes, rtol=1e-10)
    assert np.all(np.isfinite(slopes))
