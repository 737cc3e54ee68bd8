"""Integration of one piece of a transient run, and the check of the state from which a run continues."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._checks import Information
from ..._identity import Identity, identity_of, require_same
from ...numerics.arrow import ArrowPoint
from ...numerics.integrator import IntegratorOptions, NestedField, Segment
from ..parts import azimuths
from .family import AbstractDynamics, AbstractMovingBearing
from .history import Instant, LastState

PARTS = 16
"""Number of times in each interval at which pocket loads are evaluated, because a shock is shorter than an interval."""


class Advanced(NamedTuple):
    """A segment of a run, with the instants at its start, at the requested times and at its last state.

    If the segment stopped early, the remaining instants repeat its last state."""

    segment: Segment
    times: Float[Array, " time"]
    instants: Instant


FIELD = NestedField(
    rates=lambda time, state, dynamics, guess, tolerance: dynamics.nested_rates(time, state, guess, tolerance),
    guess=lambda time, state, dynamics: dynamics.first_guess(time, state),
)
"""Vector field for the integrator, the same for all families."""


def advance(
    dynamics: AbstractDynamics,
    state: ArrowPoint,
    start: Float[Array, ""],
    times: Float[Array, " time"],
    options: IntegratorOptions,
    step: Float[Array, ""],
    parts: int = PARTS,
) -> Advanced:
    """Integrates from `start` to the last of `times`; pure.

    **Arguments:**
    - `start`, `times`: start and requested times, s.
    - `step`: first step that is tried, s.
    - `parts`: number of times in each interval at which pocket loads are evaluated.
    """
    from ...numerics.integrate import integrate_segment  # diffrax, which nothing else needs, takes a second to import

    begin = jnp.concatenate([start[None], times[:-1]])
    share = jnp.arange(1, parts) / parts
    fine = jnp.concatenate([begin[:, None] + (times - begin)[:, None] * share[None, :], times[:, None]], axis=1)
    segment = integrate_segment(
        FIELD, state, start, fine.reshape(-1), dynamics, options, first_step=step, idle=len(dynamics.works)
    )
    fine = jnp.minimum(fine, segment.last_time)
    reached = fine.reshape(-1) < segment.last_time
    # a run has no states beyond the time at which it stopped
    safe = jax.tree.map(
        lambda ys, end: jnp.where(jnp.reshape(reached, (-1, *(1 for _ in end.shape))), ys, end[None]),
        segment.states,
        segment.last,
    )
    coarse = jax.tree.map(lambda leaf: leaf[parts - 1 :: parts], safe)
    states = jax.tree.map(lambda a, ys, b: jnp.concatenate([a[None], ys, b[None]]), state, coarse, segment.last)
    at = jnp.concatenate([start[None], fine[:, -1], segment.last_time[None]])
    instants = jax.lax.map(lambda pair: dynamics.observe(*pair), (at, states))
    between = dynamics.peaks(fine, safe)
    if between is not None:
        # the last state lies in the first interval that was not reached
        last = jnp.minimum(jnp.sum(times <= segment.last_time), times.shape[0] - 1)
        whole = lambda now, most: jnp.concatenate([now[:1], most, most[last][None]])
        peaks = jax.tree.map(whole, instants.pocket_peaks, between)
        instants = eqx.tree_at(lambda i: i.pocket_peaks, instants, peaks)
    return Advanced(segment, at, instants)


MOST_GROWTH = 1e-2
"""Largest relative growth of the pitch circle at which a bearing with fits still counts as the same bearing: 1 %, the
expansion of steel by 800 K."""
MAY_CHANGE = ("operation", "oil", "contact", "drag", "simulation", "ring_freedom", "rating", "temperatures")
"""Parts of a scene that may differ from those of the earlier run that is continued."""
UNKNOWN = Information(
    "restart: the state does not say of which bearing it is (an earlier version wrote it); only the number of rollers, "
    "the pitch circle and whether there is a cage have been compared"
)
"""Note of a run that continues from a state without identity."""


def identity(scene: AbstractMovingBearing) -> Identity:
    """The identity of the bearing: geometry, materials, cage, flanges, profile, seats."""
    return identity_of(scene, MAY_CHANGE)


def check_fits(scene: AbstractMovingBearing, last: object) -> None:
    """Checks that a state belongs to this bearing.

    **Raises:** `ValueError` that names the difference.
    """
    if not isinstance(last, LastState):
        raise ValueError(f"restart: a state of a {getattr(last, 'of', type(last).__name__)}, for a scene of a bearing")
    wanted = scene.motion.instant
    if np.shape(last.elements)[0] != len(wanted.element_state) or np.shape(last.cage) != (len(wanted.cage_state),):
        raise ValueError(f"restart: a state of another kind of bearing, for a scene of a {type(scene).__name__}")
    count, stored = scene.n_elements, np.shape(last.elements)[-1]
    if stored != count:
        raise ValueError(f"restart: a state of {stored} {scene.element}s, for a scene with {count}")
    if last.has_cage != (scene.cage is not None):
        has = lambda cage: "with a cage" if cage else "without a cage"
        raise ValueError(f"restart: a state {has(last.has_cage)}, for a scene {has(scene.cage is not None)}")
    values = (last.time, last.elements, last.cage, last.frame_angle, last.frame_speed, last.reference_speed)
    if not all(np.all(np.isfinite(value)) for value in values):
        raise ValueError("restart: a state with numbers that are not finite")
    if last.identity is not None:
        require_same(last.identity, identity(scene), "bearing")
    pitch = 0.5 * float(scene.geometry.pitch_diameter)
    places = np.asarray(azimuths(scene.geometry, count)) + np.asarray(last.elements)[0] / pitch
    apart = np.abs(np.asarray(last.azimuth) - places - float(last.frame_angle))
    # with fits the pitch circle depends on temperatures and speeds
    grown = 0.0 if scene.fits is None else MOST_GROWTH * np.abs(np.asarray(last.elements)[0]) / pitch
    if np.any(apart > 1e-7 + grown):
        raise ValueError(f"restart: a state of another bearing: its {scene.element}s do not stand on this pitch circle")
