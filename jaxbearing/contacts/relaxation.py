"""Stress at the end of an implicit step of Maxwell's equation: one increasing scalar equation, solved elementwise."""

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, PyTree

EYRING_STEPS = 7
"""Newton steps of `sinh_root`: round-off for every relaxation number from 1e-30 to 1e30 and trial stress up to 100."""
LIMITING_STEPS = 7
"""Newton steps of `limiting_root`; over the same range six reach round-off."""
STARTS = (0.5, 1e-1, 1e-2, 1e-4)
"""Distances, relative, of the starting stresses from the trial stress or the limiting stress."""
LARGEST_EYRING_STRESS = 600.0
"""Stress in units of the Eyring stress beyond which sinh would overflow."""


@jax.custom_jvp
def sinh_root(trial: Array, relaxation: Array) -> Array:
    """s >= 0 with s + relaxation sinh(s) = trial, for trial and relaxation >= 0, elementwise.

    Newton from above: the left side is convex and increasing, so the iteration falls monotonically on the root.
    """
    bound = jnp.arcsinh(trial / jnp.where(relaxation > 0, relaxation, 1.0))
    s = jnp.minimum(jnp.where(relaxation > 0, jnp.minimum(trial, bound), trial), LARGEST_EYRING_STRESS)
    for _ in range(EYRING_STEPS):
        sinh, cosh = _sinh_and_cosh(s)
        s = jnp.maximum(s - (s + relaxation * sinh - trial) / (1.0 + relaxation * cosh), 0.0)
    return s


@sinh_root.defjvp
def _sinh_root_jvp(primals, tangents):
    trial, relaxation = primals
    s = sinh_root(trial, relaxation)
    sinh, cosh = _sinh_and_cosh(s)
    return s, (tangents[0] - sinh * tangents[1]) / (1.0 + relaxation * cosh)


def _sinh_and_cosh(s: Array) -> tuple[Array, Array]:
    """With one exponential, to round-off also where s is small."""
    grown = jnp.expm1(s)
    shrunk = grown / (grown + 1.0)
    return 0.5 * (grown + shrunk), 1.0 + 0.5 * (grown - shrunk)


@eqx.filter_custom_jvp
def limiting_root(law: PyTree, trial: Array, relaxation: Array, *, functions: tuple[Callable, Callable]) -> Array:
    """q >= 0 with f(q, law) + relaxation q = trial, for trial and relaxation >= 0, elementwise.

    **Arguments:**
    - `law`: pytree of the numbers that f depends on.
    - `functions`: f, concave and increasing from 0 with slope 1 to 1, and its inverse on [0, 1).

    The left side is concave: Newton rises monotonically to the root from any q below it. Every stress s below the
    trial stress and the limit gives such a q, the smaller one of `inverse(s)` and (trial - s)/relaxation.
    """
    function, inverse = functions
    divisor = jnp.where(relaxation > 0, relaxation, 1.0)
    q = jnp.maximum(trial / (1.0 + relaxation), jnp.where(relaxation > 0, (trial - 1.0) / divisor, 0.0))
    for distance in STARTS:
        s = (1.0 - distance) * jnp.minimum(trial, 1.0)
        flow = inverse(s, law)
        q = jnp.maximum(q, jnp.where(relaxation > 0, jnp.minimum(flow, (trial - s) / divisor), flow))
    for _ in range(LIMITING_STEPS):
        value, slope = jax.jvp(lambda x: function(x, law), (q,), (jnp.ones_like(q),))
        total = slope + relaxation
        q = q + jnp.where(total > 0, trial - value - relaxation * q, 0.0) / jnp.where(total > 0, total, 1.0)
    return q


@limiting_root.def_jvp
def _limiting_root_jvp(primals, tangents, *, functions):
    law, trial, relaxation = primals
    law_dot, trial_dot, relaxation_dot = tangents
    q = limiting_root(law, trial, relaxation, functions=functions)
    function, _ = functions
    slope = jax.jvp(lambda x: function(x, law), (q,), (jnp.ones_like(q),))[1]
    value_dot = None
    if jax.tree.leaves(law_dot):
        _, value_dot = eqx.filter_jvp(lambda numbers: function(q, numbers), (law,), (law_dot,))
    change = jnp.zeros_like(q)
    for dot, factor in ((trial_dot, 1.0), (relaxation_dot, -q), (value_dot, -1.0)):
        if dot is not None:
            change = change + factor * dot
    total = slope + relaxation
    return q, jnp.where(total > 0, change, 0.0) / jnp.where(total > 0, total, 1.0)
