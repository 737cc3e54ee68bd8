"""A run of a moving cylindrical roller bearing, piece by piece: states, instants, the shocks between them, energy."""

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._identity import Identity, identity_of, require_same
from ...numerics.arrow import ArrowPoint
from ...numerics.integrator import IntegratorOptions, NestedField, Segment
from ..cylindrical.scene import CylindricalRollerBearing
from ..parts import azimuths
from .history import Energy, Instant, LastState
from .instants import observe, pocket_peaks
from .rates import WORKS, RollerDynamics
from .settings import Simulation
from .start import build_dynamics

PARTS = 16
"""Places in each interval at which pocket loads are looked up: a shock is shorter than an interval."""


class Advanced(NamedTuple):
    """A segment of a run; its times and instants: of its begin, of the times asked for, and of its last state. Beyond
    the place where it stopped they repeat the last state."""

    segment: Segment
    times: Float[Array, " time"]
    instants: Instant


class Resumed(NamedTuple):
    """Equations of motion, and the state that an earlier run ended with."""

    dynamics: RollerDynamics
    state: ArrowPoint


FIELD = NestedField(
    rates=lambda time, state, dynamics, guess, tolerance: dynamics.rates_and_loads(time, state, guess, tolerance),
    guess=lambda time, state, dynamics: dynamics.first_closing(time, state),
)
"""The vector field as the integrator wants it."""


def advance(
    dynamics: RollerDynamics,
    state: ArrowPoint,
    start: Float[Array, ""],
    times: Float[Array, " time"],
    options: IntegratorOptions,
    step: Float[Array, ""],
    parts: int = PARTS,
) -> Advanced:
    """From `start` to the last of `times`; pure. **Arguments:** `step`: the first that is tried, s."""
    from ...numerics.integrate import integrate_segment  # diffrax, which nothing else needs, takes a second to import

    begin = jnp.concatenate([start[None], times[:-1]])
    share = jnp.arange(1, parts) / parts
    fine = jnp.concatenate([begin[:, None] + (times - begin)[:, None] * share[None, :], times[:, None]], axis=1)
    segment = integrate_segment(
        FIELD, state, start, fine.reshape(-1), dynamics, options, first_step=step, idle=len(WORKS)
    )
    fine = jnp.minimum(fine, segment.last_time)
    reached = fine.reshape(-1) < segment.last_time
    # beyond the place where a run stopped there are no states
    safe = jax.tree.map(
        lambda ys, end: jnp.where(jnp.reshape(reached, (-1, *(1 for _ in end.shape))), ys, end[None]),
        segment.states,
        segment.last,
    )
    coarse = jax.tree.map(lambda leaf: leaf[parts - 1 :: parts], safe)
    states = jax.tree.map(lambda a, ys, b: jnp.concatenate([a[None], ys, b[None]]), state, coarse, segment.last)
    at = jnp.concatenate([start[None], fine[:, -1], segment.last_time[None]])
    instants = jax.lax.map(lambda given: observe(dynamics, *given), (at, states))
    if dynamics.pocket is not None:
        between = pocket_peaks(dynamics, fine, safe)
        # the last state lies in the first interval that was not reached
        last = jnp.minimum(jnp.sum(times <= segment.last_time), times.shape[0] - 1)
        faces = lambda i: (i.pocket_peaks.front, i.pocket_peaks.rear)
        whole = [
            jnp.concatenate([now[:1], most, most[last][None]])
            for now, most in zip(faces(instants), between, strict=True)
        ]
        instants = eqx.tree_at(faces, instants, tuple(whole))
    return Advanced(segment, at, instants)


def resume(scene: CylindricalRollerBearing, simulation: Simulation, last: LastState) -> Resumed:
    """Go on from the end of an earlier run, also with other speeds or loads over time: nothing jumps; pure."""
    dynamics = build_dynamics(scene, simulation, jnp.asarray(last.reference_speed))
    turned, turning, _ = dynamics.frame(jnp.asarray(last.time))
    pitch = dynamics.system.kinematics.pitch_radius
    ahead, faster = pitch * (last.frame_angle - turned), pitch * (last.frame_speed - turning)
    zero = jnp.zeros(())
    rollers = jnp.asarray(last.rollers) + jnp.stack([ahead, faster, zero])[:, None]
    cage = jnp.asarray(last.cage)
    if last.has_cage:
        cage = cage + jnp.stack([zero, zero, ahead, zero, zero, faster])
    return Resumed(dynamics, dynamics.scaled(rollers, cage))


MOST_GROWTH = 1e-2
"""Growth of the pitch circle on seats, relative, that is taken for the same bearing: 1 % is 800 K of steel."""
MAY_CHANGE = ("operation", "oil", "contact", "drag", "simulation", "ring_freedom", "rating", "temperatures")
"""Parts of a scene that may be others than those of the run from whose end another one goes on."""
UNKNOWN = (
    "restart: the state does not say of which bearing it is (an earlier version wrote it); only the number of rollers, "
    "the pitch circle and whether there is a cage have been compared"
)
"""The note of such a run."""


def identity(scene: CylindricalRollerBearing) -> Identity:
    """The identity of the bearing: geometry, materials, cage, flanges, profile, seats."""
    return identity_of(scene, MAY_CHANGE)


def check_fits(scene: CylindricalRollerBearing, last: Any) -> None:
    """**Raises:** `ValueError` where a state is not one of this bearing."""
    if not isinstance(last, LastState):
        raise ValueError(f"restart: a state of a {getattr(last, 'of', type(last).__name__)}, for a scene of a bearing")
    count, found = scene.geometry.n_rollers, np.shape(last.rollers)[-1]
    if found != count:
        raise ValueError(f"restart: a state of {found} rollers, for a scene with {count}")
    if last.has_cage != (scene.cage is not None):
        has = lambda cage: "with a cage" if cage else "without a cage"
        raise ValueError(f"restart: a state {has(last.has_cage)}, for a scene {has(scene.cage is not None)}")
    values = (last.time, last.rollers, last.cage, last.frame_angle, last.frame_speed, last.reference_speed)
    if not all(np.all(np.isfinite(value)) for value in values):
        raise ValueError("restart: a state with numbers that are not finite")
    if last.identity is not None:
        require_same(last.identity, identity(scene), "bearing")
    pitch = float(scene.geometry.pitch_radius)
    places = np.asarray(azimuths(scene.geometry, count)) + np.asarray(last.rollers)[0] / pitch
    apart = np.abs(np.asarray(last.azimuth) - places - float(last.frame_angle))
    # the pitch circle of a bearing on seats is that of its temperatures and speeds
    grown = 0.0 if scene.fits is None else MOST_GROWTH * np.abs(np.asarray(last.rollers)[0]) / pitch
    if np.any(apart > 1e-7 + grown):
        raise ValueError("restart: a state of another bearing: its rollers do not stand on this pitch circle")


def energy_of(dynamics: RollerDynamics, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
    """The works of the run up to a state, and how well they balance."""
    works = dict(zip(WORKS, jnp.asarray(dynamics.unscaled(state)[2]), strict=True))
    gain = lambda name: jnp.asarray(getattr(last, name)) - jnp.asarray(getattr(first, name))
    kinetic = gain("kinetic_energy")
    left = works["drive"] - works["dissipation"] - works["pocket_films"] - works["lever_arm"] - kinetic
    stored = [i.radial_load * i.ring.radial + i.lateral_load * i.ring.lateral for i in (first, last)]
    return Energy(
        drive=works["drive"],
        dissipation=works["dissipation"],
        pocket_films=works["pocket_films"],
        lever_arm=works["lever_arm"],
        kinetic=kinetic,
        pocket_elastic=gain("pocket_energy"),
        raceway_elastic=gain("raceway_energy"),
        load_on_ring=jnp.asarray(stored[1] - stored[0]) + works["load"],
        error=left / jnp.maximum(jnp.abs(works["drive"]), 1e-300),
    )
