"""Preload of matched sets: closures and springs of the mounted set at rest and without load.

The bearings of a set form two opposed groups. The unknown of each group is the axial displacement of its bearings, at
which their forces add up to the preload. The closure is half the sum of both displacements.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ..bearings.row import AbstractRow, RowState
from ..numerics.once import once
from ..numerics.safe import largest
from .balance import Spring
from .batches import AbstractBatch, spread
from .mounting import Preload
from .scene import Place, ShaftSystem

FIRST_TRIAL = 5e-5
"""Axial displacement of the first trial, m."""
TRIALS = 100
"""Largest number of trials of a search."""
BALANCED = 1e-16
"""Step at which the search for the axial position of the mounted set ends, m."""
TOLERANCE = 1e-13
"""Relative error of the preload, and of the displacement, at which the search ends."""
SMALL_FORCE = 1e-9
"""Force, N, from whose displacement that at first contact is extrapolated. For balls they differ by less than 1 pm."""
EXPONENT = 2.0 / 3.0
"""Exponent n for which force^n of balls is nearly proportional to their displacement."""


class Rest(NamedTuple):
    """Batches with the bearings of preloaded sets at rest, without expansion and with axial displacements only."""

    batches: tuple[AbstractBatch, ...]
    rows: list[AbstractRow | None]


def at_rest(batches: tuple[AbstractBatch, ...], preloaded: np.ndarray) -> Rest:
    """The batches with a bearing of a preloaded set. **Arguments:** `preloaded`: True for each such bearing."""
    own = tuple(batch for batch in batches if np.any(preloaded[batch.index]))
    return Rest(own, [batch.rows(jnp.zeros(len(preloaded)), at_rest=True) for batch in own])


def _displacements(axial: Float[Array, " bearing"]) -> Float[Array, "bearing 5"]:
    return axial[:, None] * jnp.asarray([[1.0, 0.0, 0.0, 0.0, 0.0]])


class _Held(NamedTuple):
    """Axial force, N, and axial stiffness, N/m, of each bearing, 0 for those outside `Rest`; row states by batch."""

    force: Float[Array, " bearing"]
    slope: Float[Array, " bearing"]
    states: list[RowState]


@once
def _held(rest: Rest, axial: Float[Array, " bearing"]) -> _Held:
    """Forces, stiffness and states of the rows at given axial displacements; not differentiated."""
    displacement = _displacements(axial)
    held = []
    for batch, rows in zip(rest.batches, rest.rows, strict=True):
        own = displacement[batch.index]
        held.append(batch.hold(rows, own, batch.initial(rows, own)))
    of = lambda get: spread(rest.batches, [get(part) for part in held], len(axial))
    states = [part.state for part in held]
    return _Held(of(lambda part: part.force[:, 0]), of(lambda part: part.stiffness[:, 0, 0]), states)


@once
def axial_forces(rest: Rest, axial: Float[Array, " bearing"], states: list[RowState]) -> Float[Array, " bearing"]:
    """Axial forces, N, with first derivatives.

    **Arguments:** `axial`: axial displacements, closures included, m; `states`: states of the rows at them.
    """
    displacement = _displacements(axial)
    parts = [
        batch.force_at(rows, displacement[batch.index], own)[:, 0]
        for batch, rows, own in zip(rest.batches, rest.rows, states, strict=True)
    ]
    return spread(rest.batches, parts, len(axial))


class _Search(NamedTuple):
    place: Float[Array, " group"]
    low: Float[Array, " group"]
    high: Float[Array, " group"]
    trials: Int[Array, ""]
    done: Bool[Array, " group"]
    held: _Held


class Group(NamedTuple):
    """Bearings that carry a force together. **Arguments:** `members`: mask over all bearings; `force`: N."""

    members: np.ndarray
    force: Array


def displaced(rest: Rest, groups: list[Group], additional: Float[Array, " bearing"]) -> Float[Array, " group"]:
    """Axial displacement at which each group carries its force, m, with first derivatives. For a force of 0 it is the
    displacement at first contact: it is extrapolated from `SMALL_FORCE`, with force^`EXPONENT` linear in the
    displacement. The derivative with respect to the force is infinite there and is taken as 0.

    **Arguments:** `additional`: closure of each bearing beyond that of its group, m.
    """
    members = np.stack([group.members for group in groups]).astype(float)
    forces = jnp.stack([jnp.asarray(group.force, dtype=float) for group in groups])
    target = jnp.where(forces > 0, forces, SMALL_FORCE)
    fixed = jax.lax.stop_gradient((rest, target, additional))

    def look(state: _Search) -> _Search:
        held = _held(fixed[0], members.T @ state.place + fixed[2])
        force, slope = members @ held.force, members @ held.slope
        wanted = fixed[1]
        above = force >= wanted
        low, high = jnp.where(above, state.low, state.place), jnp.where(above, state.place, state.high)
        loaded = (force > 0) & (slope > 0)
        safe = jnp.where(loaded, force, 1.0)
        step = (safe - wanted**EXPONENT * safe ** (1.0 - EXPONENT)) / (EXPONENT * jnp.where(loaded, slope, 1.0))
        newton = state.place - step
        enclosed = jnp.isfinite(low) & jnp.isfinite(high)
        farther = FIRST_TRIAL + jnp.abs(state.place)
        one_side = jnp.where(above, state.place - farther, state.place + farther)
        middle = jnp.where(enclosed, 0.5 * (low + high), one_side)
        inside = loaded & (newton > low) & (newton < high)
        small = (jnp.abs(force - wanted) <= TOLERANCE * wanted) | (enclosed & (high - low <= TOLERANCE * jnp.abs(high)))
        following = jnp.where(small | state.done, state.place, jnp.where(inside, newton, middle))
        return _Search(following, low, high, state.trials + 1, state.done | small, held)

    none = jnp.zeros(len(groups))
    first = _Search(
        none + FIRST_TRIAL, none - jnp.inf, none + jnp.inf, jnp.asarray(0), none > 0, _nothing(fixed[0], additional)
    )
    going = lambda state: (state.trials < TRIALS) & ~jnp.all(state.done)
    end = jax.lax.while_loop(going, look, first)
    place, held = end.place, end.held
    slope = jnp.maximum(members @ held.slope, 1.0)
    force = members @ axial_forces(rest, members.T @ place + additional, held.states)
    # one Newton step gives the derivatives of the root
    carried = place - (force - target) / slope
    return jnp.where(forces > 0, carried, carried - target / (EXPONENT * slope))


class Mounted(NamedTuple):
    """The mounted sets. Dictionaries have the names of the sets as keys.

    - `closure`: closure of each bearing, m.
    - `springs`: springs that press outer rings.
    - `closures`: closure of each bearing of a set by its preload, m.
    - `forces`: force between the groups, N.
    - `losses`: axial load that unloads a group, N.
    - `spring_numbers`: index of the spring of a set.
    - `asked`: largest displacement of a group under the given force, m.
    """

    closure: Float[Array, " bearing"]
    springs: tuple[Spring, ...]
    closures: dict[str, Array]
    forces: dict[str, Array]
    losses: dict[str, Array]
    spring_numbers: dict[str, int]
    asked: dict[str, Array]


def groups_of(places: tuple[Place, ...], number: int) -> tuple[np.ndarray, np.ndarray]:
    """Masks over all bearings of the two groups of a set; the second group is that of its last bearing."""
    own = np.asarray([place.set_index == number for place in places])
    last = next(place.sense for place in reversed(places) if place.set_index == number)
    second = own & np.asarray([place.sense == last for place in places])
    return own & ~second, second


def mount(system: ShaftSystem, places: tuple[Place, ...], batches: tuple[AbstractBatch, ...]) -> Mounted:
    """Finds the preload of all sets of a system."""
    closure = jnp.stack([jnp.asarray(place.closure, dtype=float) for place in places])
    sets = [
        (number, matched.name, matched.preload)
        for number, matched in enumerate(system.sets)
        if matched.preload is not None
    ]
    if not sets:
        return Mounted(closure, (), {}, {}, {}, {}, {})
    preloaded = np.asarray([place.set_index in {number for number, _, _ in sets} for place in places])
    rest = at_rest(batches, preloaded)
    travel, asked = _travels(rest, places, sets, closure)
    springs: list[Spring] = []
    closures: dict[str, Array] = {}
    forces: dict[str, Array] = {}
    numbers: dict[str, int] = {}
    for number, name, preload in sets:
        if preload.spring_force is not None:
            force = jnp.asarray(preload.spring_force)
            stiffness = jnp.asarray(0.0 if preload.spring_stiffness is None else preload.spring_stiffness)
            pressed = np.flatnonzero(groups_of(places, number)[1]).tolist()
            numbers[name], forces[name] = len(springs), force
            springs.append(Spring(stiffness, force + stiffness * travel[name], tuple(pressed)))
            continue
        if preload.offset is not None:
            closures[name] = jnp.asarray(preload.offset)
        else:
            closures[name] = travel[name] if preload.class_force is not None else 0.5 * travel[name]
        mine = np.asarray([float(place.set_index == number) for place in places])
        closure = closure + closures[name] * mine
    rigid = {name: groups_of(places, number) for number, name, _ in sets if name in closures}
    mounted, losses = _mounted(rest, rigid, closure)
    return Mounted(closure, tuple(springs), closures, forces | mounted, losses, numbers, asked)


def _travels(
    rest: Rest, places: tuple[Place, ...], sets: list[tuple[int, str, Preload]], closure: Float[Array, " bearing"]
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Sum and maximum of the axial displacements of the two groups of each set under its preload, m. For a class force
    both are the displacement of the first bearing alone."""
    groups: list[Group] = []
    owner: list[str] = []
    additional = closure
    for number, name, preload in sets:
        force = preload.force if preload.force is not None else preload.spring_force
        if force is not None:
            groups += [Group(members, jnp.asarray(force)) for members in groups_of(places, number)]
            owner += [name, name]
        elif preload.class_force is not None:
            first = np.arange(len(places)) == next(i for i, place in enumerate(places) if place.set_index == number)
            groups.append(Group(first, jnp.asarray(preload.class_force)))
            owner.append(name)
            additional = jnp.where(first, 0.0, additional)
    if not groups:
        return {}, {}
    displacements = displaced(rest, groups, additional)
    own = {name: jnp.stack([displacements[i] for i, other in enumerate(owner) if other == name]) for name in owner}
    return {name: jnp.sum(each) for name, each in own.items()}, {name: largest(each) for name, each in own.items()}


def _mounted(
    rest: Rest, sets: dict[str, tuple[np.ndarray, np.ndarray]], closure: Float[Array, " bearing"]
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Force between the groups of each set at rest without load, and the axial load on the group with more bearings
    that unloads the other one, N. **Arguments:** `sets`: masks of the two groups by the name of the set."""
    if not sets:
        return {}, {}
    first = np.stack([max(both, key=np.sum) for both in sets.values()]).astype(float)
    second = np.stack([(both[0] | both[1]).astype(float) for both in sets.values()]) - first
    signs = first - second
    fixed = jax.lax.stop_gradient((rest, closure))

    def look(state: tuple[Array, Array, Array, _Held]) -> tuple[Array, Array, Array, _Held]:
        place, _, trials, _ = state
        held = _held(fixed[0], fixed[1] + signs.T @ place)
        step = (signs @ held.force) / jnp.maximum((first + second) @ held.slope, 1.0)
        return place - step, jnp.max(jnp.abs(step)), trials + 1, held

    going = lambda state: (state[1] > BALANCED) & (state[2] < TRIALS)
    none = jnp.zeros(len(sets))
    begin = (none, jnp.asarray(jnp.inf), jnp.asarray(0), _nothing(fixed[0], closure))
    place, _, _, held = jax.lax.while_loop(going, look, begin)
    slope = jnp.maximum((first + second) @ held.slope, 1.0)
    place = place - signs @ axial_forces(rest, closure + signs.T @ place, held.states) / slope
    mounted = first @ axial_forces(rest, closure + signs.T @ place, held.states)
    # the other group is unloaded where the closure of its last loaded bearing is used up
    lost = closure + signs.T @ largest(jnp.where(second > 0, closure[None], -jnp.inf), axis=1)
    held = _held(fixed[0], jax.lax.stop_gradient(lost), when=jnp.all(jnp.isfinite(lost)))
    loss = first @ axial_forces(rest, lost, held.states)
    return dict(zip(sets, mounted, strict=True)), dict(zip(sets, loss, strict=True))


def _nothing(rest: Rest, axial: Float[Array, " bearing"]) -> _Held:
    """Zeros with which a loop starts. **Arguments:** `axial`: displacements, of which only the shape matters."""
    return _held(rest, jnp.zeros_like(axial), when=jnp.asarray(False))
