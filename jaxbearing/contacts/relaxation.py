"""Stress after an implicit step of Maxwell's equation: the root of an increasing scalar function, elementwise."""

from typing import NamedTuple, Protocol, runtime_checkable

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

EYRING_STEPS = 4
"""Halley steps of `sinh_root`: enough for round-off at relaxation numbers of 1e-30 to 1e30, trial stresses to 1000."""
LARGEST_EYRING_STRESS = 600.0
"""Upper bound of the stress, in units of the Eyring stress; beyond it sinh would overflow."""
LIMITING_STEPS = 3
"""Halley steps of `limiting_root`: enough for round-off over the same range; with an exponent n < 1 the error reaches
2e-10 in the fourth decade of q (see the tests)."""
RELAXATION_FLOOR = 1e-100
"""Smallest relaxation number in `limiting_root`: there the stress is already the trial or the limiting stress."""


@jax.custom_jvp
def sinh_root(trial: Array, relaxation: Array) -> Array:
    """Root s >= 0 of s + relaxation sinh(s) = trial, for trial and relaxation >= 0, elementwise; s at most 600.

    Halley's method, started above the root: the left side is convex and increasing, so the iterates decrease
    monotonically to the root.
    """
    flow = trial / jnp.where(relaxation > 0, relaxation, 1.0)
    # asinh(flow) is an upper bound of s; inaccurate at small flow, where the other bound decides
    bound = jnp.where(relaxation > 0, jnp.log(flow + jnp.sqrt(jnp.square(flow) + 1.0)), jnp.inf)
    s = jnp.minimum(jnp.minimum(trial / (1.0 + relaxation), bound), LARGEST_EYRING_STRESS)
    for _ in range(EYRING_STEPS):
        sinh, cosh = _sinh_and_cosh(s)
        value, slope = s + relaxation * sinh - trial, 1.0 + relaxation * cosh
        step = value * slope / (jnp.square(slope) - 0.5 * value * (relaxation * sinh))
        s = jnp.clip(s - step, 0.0, LARGEST_EYRING_STRESS)
    return s


@sinh_root.defjvp
def _sinh_root_jvp(primals, tangents):
    trial, relaxation = primals
    s = sinh_root(trial, relaxation)
    sinh, cosh = _sinh_and_cosh(s)
    return s, (tangents[0] - sinh * tangents[1]) / (1.0 + relaxation * cosh)


def _sinh_and_cosh(s: Array) -> tuple[Array, Array]:
    """Values of sinh(s) and cosh(s) from one exponential, exact to round-off for small s too."""
    grown = jnp.expm1(s)
    shrunk = grown / (grown + 1.0)
    return 0.5 * (grown + shrunk), 1.0 + 0.5 * (grown - shrunk)


class Slopes(NamedTuple):
    """Stress s at the shear rate q, and its derivatives ds/dq and d2s/dq2."""

    stress: Float[Array, "..."]
    first: Float[Array, "..."]
    second: Float[Array, "..."]


@runtime_checkable
class Limiting(Protocol):
    """A flow law s(q) for q >= 0, concave and increasing from s = 0 with slope 1 to the limit s = 1."""

    def rate_ratio(self, s: Array) -> Array:
        """Rate q(s); it may overflow to infinity at s = 1."""
        ...

    def stress_slopes(self, q: Array) -> Slopes:
        """Stress s(q) and its derivatives."""
        ...

    def stress_ratio(self, q: Array) -> Array:
        """Stress s(q), differentiable with respect to the parameters of the law."""
        ...

    def corner(self, slope: Array) -> tuple[Array, Array]:
        """Rate q and stress s at which ds/dq = `slope`, in (0, 1]."""
        ...


@eqx.filter_custom_jvp
def limiting_root(law: Limiting, trial: Array, relaxation: Array) -> Array:
    r"""Root q >= 0 of s(q) + relaxation q = trial, for trial and relaxation >= 0, elementwise.

    The left side is concave in q, with a corner where ds/dq falls to the relaxation number. For a root beyond the
    corner, the slope of the left side changes by at most a factor of 2 from there on, so that the corner is a good
    start. For a root before the corner, the same holds for the left side as a function of s, and the chord between 0
    and the corner gives a start. Both starts lie below the root, and Halley's method rises from them.
    """
    relaxation = jnp.maximum(relaxation, RELAXATION_FLOOR)
    corner_rate, corner_stress = law.corner(jnp.minimum(relaxation, 1.0))
    elastic = jnp.minimum(relaxation, 1.0) * corner_rate
    chord = corner_stress / jnp.where(relaxation < 1.0, corner_stress + elastic, 1.0)
    low = jnp.minimum(jnp.maximum(trial * chord, trial - elastic), corner_stress)
    before = jnp.minimum(law.rate_ratio(low), corner_rate)
    beyond = jnp.maximum(corner_rate, (trial - 1.0) / relaxation)
    q = jnp.maximum(jnp.where(trial < corner_stress + elastic, before, beyond), trial / (1.0 + relaxation))
    for _ in range(LIMITING_STEPS):
        stress, first, second = law.stress_slopes(q)
        value, slope = stress + relaxation * q - trial, first + relaxation
        q = jnp.maximum(q - value * slope / (jnp.square(slope) - 0.5 * value * second), 0.0)
    return q


@limiting_root.def_jvp
def _limiting_root_jvp(primals, tangents):
    law, trial, relaxation = primals
    law_dot, trial_dot, relaxation_dot = tangents
    q = limiting_root(law, trial, relaxation)
    slope = law.stress_slopes(q).first + jnp.maximum(relaxation, RELAXATION_FLOOR)
    change = jnp.zeros_like(q)
    for dot, factor in ((trial_dot, 1.0), (relaxation_dot, -q)):
        if dot is not None:
            change = change + factor * dot
    if jax.tree.leaves(law_dot):
        change = change - eqx.filter_jvp(lambda numbers: numbers.stress_ratio(q), (law,), (law_dot,))[1]
    return q, change / slope
