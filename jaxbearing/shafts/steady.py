"""Steady state of a shaft on bearings: from the scene to the equations, and from their root to the results."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._checks import Checks, about
from .._scene import with_checked_inputs
from ..bearings.bearing import AbstractBearing
from ..bearings.bearing_life import with_life
from ..bearings.solution import RING_FREEDOMS, FailureCause, RingDisplacement, Solution
from ..life.duty import SpectrumLife, damage_rates, miner_rates, revolution_shares, spectrum_life
from ..numerics.known_roots import own_roots
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..numerics.status import Status
from .balance import Axis, Parts, axis_of, build_balance
from .batches import (
    FREEDOM_WORDS,
    AbstractBatch,
    LinearBatch,
    RollingBatch,
    batches_of,
    largest_load,
    pressure_centre,
    solutions,
)
from .lives import system_of
from .mounting import LinearBearing
from .preload import Mounted, groups_of, mount
from .scene import Place, ShaftSystem
from .search import FARTHEST, Problem, Root, equilibrium
from .solution import (
    BearingOnShaft,
    DutyResult,
    SetResult,
    ShaftNodes,
    ShaftSolution,
    SystemLifeResult,
    TorqueBalance,
)
from .warm import solve_warm_shaft

TOO_MUCH_PRELOAD = (
    "set.{0}.preload: its bearings carry no such force: one would close by {{:.4g}} mm, and an equilibrium is sought "
    f"within {1e3 * FARTHEST:g} mm"
)
"""Cause of a failed solve, to be filled with the name of a set and a displacement in mm."""
EMPTY = 0.01
"""Part of the preload below which a bearing of a set counts as unloaded."""
MISSING_SHOULDER = (
    "balls are pressed against the side of the groove where an angular contact bearing has no shoulder; nothing else "
    "carries the axial force in this direction"
)
LIGHT = 1.0
"""Load on a ball, N, above which the ball counts for `MISSING_SHOULDER`."""
STEEP_TILT = 1e-3
"""Tilt of an inner ring relative to its outer ring, rad, above which makers of bearings warn."""


def solve_shaft(system: ShaftSystem, options: NewtonOptions) -> ShaftSolution:
    """Steady state of a shaft. The function is pure, works under `jit` and `vmap`, has first derivatives, and never
    raises for a failed solve."""
    with own_roots():
        return _duty(system, options) if system.states else _solve(system, options)


def _duty(system: ShaftSystem, options: NewtonOptions) -> ShaftSolution:
    """Solves all states of a duty cycle one after the other, with one program."""
    base = dataclasses.replace(system, states=())
    states = [jax.tree.map(as_float, base.replace(state.changes)) for state in system.states]
    structures = {jax.tree.structure(state) for state in states}
    if len(structures) > 1:
        raise ValueError("state.changes must be numbers: all states of a shaft have one structure")
    (structure,) = structures
    stacked = jax.tree.map(lambda *leaves: jnp.stack([jnp.asarray(leaf) for leaf in leaves]), *states)
    leaves = jax.tree.leaves(stacked)
    # the scene of each state has checks of its own
    solve = lambda own: with_checked_inputs(jax.tree.unflatten(structure, own), lambda lane: _solve(lane, options))
    by_state = jax.lax.map(solve, leaves)
    shares = jnp.stack([jnp.asarray(state.share, dtype=float) for state in system.states])
    names = tuple(state.name or str(number + 1) for number, state in enumerate(system.states))
    first = jax.tree.map(lambda leaf: leaf[0], by_state)
    duty = DutyResult(*_duty_lives(system, by_state, shares, stacked.shaft.speed), shares, by_state, names)
    status = jnp.max(by_state.status)
    causes = {
        text: FailureCause(jnp.any(cause.applies), jnp.max(cause.numbers))
        for text, cause in by_state.failure_causes.items()
    }
    return dataclasses.replace(
        first, status=status, duty=duty, checks=_any_state(by_state.checks), failure_causes=causes
    )


def _any_state(checks: Checks) -> Checks:
    """Checks that apply in any state. **Arguments:** `checks`: of all states, stacked along the first axis."""
    ranges = {text: jnp.any(flag) for text, flag in checks.ranges.items()}
    return Checks(ranges, jnp.any(checks.broken, axis=0), tuple(f"{rule} in every state" for rule in checks.rules))


def _duty_lives(
    system: ShaftSystem, by_state: ShaftSolution, shares: Array, speeds: Array
) -> tuple[dict[str, SpectrumLife], SystemLifeResult | None]:
    """Life of each rated bearing under the duty cycle by name, and life of the system (`None` if one has no rating)."""
    rated = {name: bearing.life for name, bearing in by_state.bearings.items() if bearing.life is not None}
    states = lambda life: [jax.tree.map(lambda leaf, at=at: leaf[at], life) for at in range(len(shares))]
    lives = {name: spectrum_life(states(life), shares, speeds) for name, life in rated.items()}
    if len(lives) < len(by_state.bearings):
        return lives, None
    rates = [miner_rates(states(life), revolution_shares(shares, speeds)) for life in rated.values()]
    mean_speed = jnp.sum(shares * jnp.abs(speeds))
    return lives, system_of(list(rated.values()), rates, system.life.weibull, mean_speed)


def _solve(system: ShaftSystem, options: NewtonOptions) -> ShaftSolution:
    if system.thermal is not None:
        return solve_warm_shaft(
            system,
            lambda places, mounted, grown: _at(
                system, places, batches_of(places, jnp.asarray(system.shaft.speed)), mounted, grown, options
            ),
        )
    places = system.places
    batches = batches_of(places, jnp.asarray(system.shaft.speed))
    mounted, grown = mount(system, places, batches), None
    if system.shaft.thermal_strain is not None:
        grown = system.shaft.thermal_strain * (_positions(places) - system.shaft.strain_reference)
    return _at(system, places, batches, mounted, grown, options)


def _positions(places: tuple[Place, ...]) -> Float[Array, " bearing"]:
    return jnp.stack([jnp.asarray(place.position, dtype=float) for place in places])


def _at(
    system: ShaftSystem,
    places: tuple[Place, ...],
    batches: tuple[AbstractBatch, ...],
    mounted: Mounted,
    grown: Float[Array, " bearing"] | None,
    options: NewtonOptions,
) -> ShaftSolution:
    """The equilibrium and its results.

    **Arguments:** `grown`: axial displacement of the shaft relative to the housing by thermal expansion, at each
    bearing, m; `None` for 0.
    """
    position, closure = _positions(places), mounted.closure
    if grown is not None:
        closure = closure + np.asarray([place.sense for place in places]) * grown
    axis = axis_of(system)
    expansion = jnp.stack([jnp.asarray(place.expansion, dtype=float) for place in places])
    balance = build_balance(system, places, axis, position, closure, mounted.springs)
    problem = Problem(balance, batches, expansion)
    root = equilibrium(problem, options=options)
    problem = jax.tree.map(lambda x: jnp.where(root.solved, x, jax.lax.stop_gradient(x)), problem)
    return _results(system, places, axis, problem, root, mounted, (position, closure), options)


def _results(
    system: ShaftSystem,
    places: tuple[Place, ...],
    axis: Axis,
    problem: Problem,
    root: Root,
    mounted: Mounted,
    layout: tuple[Array, Array],
    options: NewtonOptions,
) -> ShaftSolution:
    balance, (position, closure) = problem.balance, layout
    parts = balance.parts(root.unknowns)
    displacement = balance.displacements(root.unknowns)
    bearings, checks, notes, good = _bearings(
        places, problem, displacement, parts, (position, closure), root.solved, options
    )
    good &= root.solved
    sets = {
        matched.name: _set_result(system, places, bearings, number, mounted, parts)
        for number, matched in enumerate(system.sets)
    }
    if mounted.springs or mounted.closures:
        checks |= _preload_checks(system, places, bearings, mounted)
    causes = {
        TOO_MUCH_PRELOAD.format(name): FailureCause(~good & (asked > FARTHEST), 1e3 * asked)
        for name, asked in mounted.asked.items()
    }
    torque = _torques(system, axis, bearings)
    life = _system_life(system, bearings)
    nodes = _nodes(system, axis, parts, position)
    # counts and states stay whole numbers
    unless_failed = lambda leaf: jnp.where(good, leaf, jnp.nan) if jnp.issubdtype(leaf.dtype, jnp.inexact) else leaf
    shown = jax.tree.map(unless_failed, (bearings, nodes, sets, torque, life))
    failed = jnp.where(root.solved, int(Status.NOT_CONVERGED), root.status)
    return ShaftSolution(
        status=jnp.where(good, int(Status.CONVERGED), failed),
        iterations=root.start_steps + root.newton_steps,
        start_steps=root.start_steps,
        newton_steps=root.newton_steps,
        residual_norm=root.residual,
        bearings=shown[0],
        shaft=shown[1],
        sets=shown[2],
        torque=shown[3],
        life=shown[4],
        checks={text: good & flag for text, flag in checks.items()},
        softest=root.softest,
        failure_causes=causes,
        unknowns=len(balance.load),
        freedom_names=tuple(f"{FREEDOM_WORDS[name]} at {place.name}" for place in places for name in RING_FREEDOMS),
        notes=tuple(notes),
    )


def _bearings(
    places: tuple[Place, ...],
    problem: Problem,
    displacement: Float[Array, "bearing 5"],
    parts: Parts,
    layout: tuple[Array, Array],
    solved: Bool[Array, ""],
    options: NewtonOptions,
) -> tuple[dict[str, BearingOnShaft], dict[str, Bool[Array, ""]], list[str], Bool[Array, ""]]:
    """Results of all bearings, their checks and notes, and whether all have a solution."""
    bearings: dict[int, BearingOnShaft] = {}
    checks: dict[str, Bool[Array, ""]] = {}
    notes: list[str] = []
    good = jnp.asarray(True)
    position, closure = layout
    for batch in problem.batches:
        own = displacement[batch.index]
        stack: Solution | None = None
        most = None
        if isinstance(batch, RollingBatch):
            stack = solutions(batch.scene, own, problem.expansion[batch.index], options, when=solved)
            good &= jnp.all(stack.converged)
            force, stiffness = stack.force, stack.stiffness
            most = jax.vmap(largest_load)(stack)
            stack = jax.vmap(with_life)(batch.scene, stack)
        else:
            assert isinstance(batch, LinearBatch)
            force, stiffness = batch.force_at(None, own, None), batch.stiffness
        for number, index in enumerate(batch.places):
            place = places[index]
            pick = lambda tree, number=number: jax.tree.map(lambda leaf: leaf[number], tree)
            solution: Solution | None = None if stack is None else pick(stack)
            mirror = jnp.asarray([place.sense, 1.0, 1.0, place.sense, place.sense])
            ring = own[number].at[0].add(-closure[index])
            centre = jnp.zeros(()) if isinstance(place.scene, LinearBearing) else pressure_centre(place.scene)
            bearings[index] = BearingOnShaft(
                position=position[index],
                ring=RingDisplacement(**dict(zip(RING_FREEDOMS, ring, strict=True))),
                force=force[number],
                stiffness=stiffness[number],
                on_shaft=-mirror * force[number],
                outer=parts.outer[index],
                closure=closure[index],
                expansion=problem.expansion[index],
                largest_load=jnp.asarray(jnp.nan) if most is None else most[number],
                pressure_centre=position[index] + place.sense * centre,
                solution=solution,
                life=None if solution is None else solution.life,
                name=place.name,
                sense=place.sense,
            )
            if solution is not None:
                checks |= {about(place.name, text): flag for text, flag in solution.checks.items()}
                notes += [about(place.name, note) for note in solution.notes]
            if solution is not None and _has_angle(place):
                wrong = (solution.elements.load_inner > LIGHT) & (solution.elements.contact_angle_inner < 0)
                checks[f"{place.name}: {MISSING_SHOULDER}"] = jnp.any(wrong)
            steep = jnp.max(jnp.abs(own[number, 3:])) > STEEP_TILT
            checks[f"{place.name}: the inner ring is tilted by more than 1 mrad against the outer ring"] = steep
    in_order = {places[index].name: bearings[index] for index in range(len(places))}
    return in_order, checks, notes, good


def _has_angle(place: Place) -> bool:
    """True for a ball bearing that is given by its contact angle and has one groove arc on each ring."""
    scene = place.scene
    if not isinstance(scene, AbstractBearing) or scene.line_contacts:
        return False
    return scene.geometry.contact_angle is not None and not scene.geometry.has_arcs


def _set_result(
    system: ShaftSystem,
    places: tuple[Place, ...],
    bearings: dict[str, BearingOnShaft],
    number: int,
    mounted: Mounted,
    parts: Parts,
) -> SetResult:
    matched = system.sets[number]
    centres = [bearings[name].pressure_centre for name in matched.names]
    spring = mounted.spring_numbers.get(matched.name)
    travel = force = None
    if spring is not None:
        pressed, travel = mounted.springs[spring], parts.springs[spring]
        force = pressed.force - pressed.stiffness * travel
    return SetResult(
        preload=mounted.forces.get(matched.name),
        closure=mounted.closures.get(matched.name),
        loss_force=mounted.losses.get(matched.name),
        travel=travel,
        spring_force=force,
        support_distance=jnp.abs(centres[-1] - centres[0]),
    )


def _preload_checks(
    system: ShaftSystem, places: tuple[Place, ...], bearings: dict[str, BearingOnShaft], mounted: Mounted
) -> dict[str, Bool[Array, ""]]:
    """Warnings on sets: a bearing that has lost its preload, pressure centres that are near each other."""
    checks = {}
    for number, matched in enumerate(system.sets):
        preload = mounted.forces.get(matched.name)
        if preload is None:
            continue
        share = preload / jnp.stack([jnp.asarray(float(group.sum())) for group in groups_of(places, number)])
        for name, sense in zip(matched.names, matched.senses, strict=True):
            group = 1 if sense == matched.senses[-1] else 0
            text = f"{name}: its axial force is less than 1 % of the preload"
            checks[text] = bearings[name].force[0] < EMPTY * share[group]
        rows = matched.positions()
        centres = [bearings[name].pressure_centre for name in matched.names]
        near = jnp.abs(centres[-1] - centres[0]) < 0.5 * (rows[-1] - rows[0])
        text = f"{matched.name}: the pressure centres are nearer than half of the rows: it hardly carries moments"
        checks[text] = near
    return checks


def _torques(system: ShaftSystem, axis: Axis, by_name: dict[str, BearingOnShaft]) -> TorqueBalance:
    zero = jnp.zeros(())
    forces = jnp.sum(axis.given.torque) + zero
    bearings, losses = zero, zero
    for bearing in by_name.values():
        solution = bearing.solution
        if solution is not None and solution.inner_torque is not None:
            bearings = bearings + solution.inner_torque
        if solution is not None and solution.power_loss.total is not None:
            losses = losses + solution.power_loss.total
    return TorqueBalance(forces=forces, bearings=bearings, drive=bearings - forces, power_loss=losses)


def _system_life(system: ShaftSystem, bearings: dict[str, BearingOnShaft]) -> SystemLifeResult | None:
    lives = [bearing.life for bearing in bearings.values()]
    rated = [life for life in lives if life is not None]
    if len(rated) < len(lives):
        return None
    return system_of(rated, list(map(damage_rates, rated)), system.life.weibull, system.shaft.speed)


def _nodes(system: ShaftSystem, axis: Axis, parts: Parts, position: Float[Array, " bearing"]) -> ShaftNodes:
    """The shaft at all ends of sections, bearings and forces, in ascending order of their positions."""
    ends = jnp.zeros(0)
    if axis.beam is not None:
        ends = jnp.concatenate([jnp.zeros(1), axis.beam.end])
    at = jnp.concatenate([ends, position, axis.given.position])
    load = jnp.concatenate([jnp.zeros((len(ends) + len(position), 5)), axis.given.load])
    order = jnp.argsort(jax.lax.stop_gradient(at))
    displacement = axis.moved(at, parts.origin, position, parts.forces)
    return ShaftNodes(at[order], displacement[order], load[order])
