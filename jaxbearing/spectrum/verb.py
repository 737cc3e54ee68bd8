"""The verb for load spectra: a scene and its states in, the life under all of them out."""

import os
from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from .._scene import AbstractScene
from .._types import Scalar
from ..bearings.solution import Solution
from ..lanes import LaneProgram, default_method
from ..life.duty import SUM_TOLERANCE, spectrum_life
from ..life.result import Life
from ..numerics.compiling import inside_a_program, is_tracing
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float, require_x64
from ..solve import chosen_options, solve
from ..sweeps.recipe import Read
from .result import Spectrum
from .states import State, require_rated, require_states

LANES = 16
"""States that one call of the program solves: a fixed number, so that another number of states is the same program."""


@rare_garbage_collection()
def solve_spectrum(
    scene: AbstractScene | str | os.PathLike[str],
    states: Sequence[State] | None = None,
    *,
    throw: bool = True,
    options: NewtonOptions | None = None,
) -> Spectrum:
    """Life of a bearing under a load spectrum: all states solved with one program, their damages added (Miner).

        scene = jb.load_scene("deep_groove_6205").replace({"rating": jb.Rating()})
        found = jb.solve_spectrum(
            scene,
            [
                jb.State("cruise", 0.9, {"operation.radial_load": 1000.0}),
                jb.State("start", 0.1, {"operation.radial_load": 4000.0, "operation.inner_speed": 50.0}),
            ],
        )
        found.life.L10r_hours, found.life.damage, found.governing, found["start"].life.L10r

    States of one structure are solved with one program, as the cases of a sweep are; a change of the structure, such as
    another film law, takes a program of its own. It may be called inside `jax.jit` and `jax.grad`; derivatives go
    through all solves, with respect to numbers of the scene, changes and shares. Where traced shares do not add up to 1
    the life is NaN.

    **Arguments:**
    - `scene`: a bearing with a rating; or a scene file, whose `[[state]]` tables are the states if `states` is left
      out.
    - `states`: see `State`.
    - `throw`: raise where a state fails. Without it the life is NaN then, and `failures` names the states.
    - `options`: of the solver.

    **Raises:** `SolveError` that names the states that failed; `ValueError` for a scene without a rating, for names
    that are not different and shares that do not add up to 1; `AttributeError` for a field that is not there;
    `TypeError` for what is no bearing; `SceneError` for a file that cannot be read.
    """
    require_x64()
    if isinstance(scene, AbstractScene):
        if states is None:
            raise ValueError("states must be given beside a scene; a scene file has them in its [[state]] tables")
        require_states(states)
        scenes = {state.name: scene.replace(state.changes) for state in states}
        shares = [state.share for state in states]
    else:
        shares, scenes = _shares_and_scenes(os.fspath(scene), states)
    spectrum = solve_states(scenes, shares, options)
    if throw:
        spectrum.raise_if_failed()
    return spectrum


def _shares_and_scenes(source: str, states: Sequence[State] | None) -> tuple[list[Scalar], dict[str, AbstractScene]]:
    """Shares and scenes of the states: those of the file, or the given ones of its scene."""
    from ..scenes.states import base_scene, load_states

    if states is None:
        read = load_states(source)
        return [state.share for state in read], {state.name: state.scene for state in read}
    require_states(states)
    scene = base_scene(source)
    return [state.share for state in states], {state.name: scene.replace(state.changes) for state in states}


def solve_states(
    scenes: Mapping[str, AbstractScene], shares: Sequence[Scalar], options: NewtonOptions | None = None
) -> Spectrum:
    """The spectrum of these scenes; a state that fails raises nothing.

    **Arguments:** name of a state -> its scene; shares of the time.

    **Raises:** `ValueError` for scenes without a rating and for different reliabilities; `TypeError` for what is no
    bearing.
    """
    return solve_cases([scenes], shares, options)[0]


def solve_cases(
    cases: Sequence[Mapping[str, AbstractScene]], shares: Sequence[Scalar], options: NewtonOptions | None = None
) -> list[Spectrum]:
    """The spectrum of each case, all of them solved together; arguments and errors as those of `solve_states`, whose
    scenes each case has."""
    for scenes in cases:
        require_rated(scenes)
    every = [jax.tree.map(as_float, scene) for scenes in cases for scene in scenes.values()]
    solutions = iter(_solved(every, chosen_options(options)))
    parts = jnp.stack([jnp.asarray(as_float(share)) for share in shares])
    return [_spectrum(tuple(scenes), parts, tuple(islice(solutions, len(scenes)))) for scenes in cases]


def _spectrum(names: tuple[str, ...], shares: Array, solutions: tuple[Solution, ...]) -> Spectrum:
    speeds = jnp.stack([_speed(solution) for solution in solutions])
    lives = [_life(solution) for solution in solutions]
    # shares that are traced are judged here
    fine = jnp.all((shares > 0) & (shares <= 1)) & (jnp.abs(jnp.sum(shares) - 1.0) <= SUM_TOLERANCE)
    return Spectrum(names, shares, solutions, spectrum_life(lives, jnp.where(fine, shares, jnp.nan), speeds))


def _life(solution: Solution) -> Life:
    assert solution.life is not None, "scenes without a rating are refused"
    return solution.life


def _speed(solution: Solution) -> Array:
    """Speed of the rings against each other, rad/s; NaN where the solve failed."""
    operation = solution.operation
    speed = jnp.asarray(operation.inner_speed) - operation.outer_speed
    return jnp.where(solution.converged, speed, jnp.nan)


def _solved(scenes: list[AbstractScene], options: NewtonOptions) -> list[Solution]:
    """Solutions in the order of the scenes, each structure with one program."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for place, scene in enumerate(scenes):
        shapes = tuple(np.shape(leaf) for leaf in jax.tree.leaves(scene))
        groups.setdefault((jax.tree.structure(scene), shapes), []).append(place)
    solutions: dict[int, Solution] = {}
    for places in groups.values():
        solutions |= dict(zip(places, _alike([scenes[place] for place in places], options), strict=True))
    return [solutions[place] for place in range(len(scenes))]


def _alike(scenes: list[AbstractScene], options: NewtonOptions) -> list[Solution]:
    """Solutions of scenes with the same structure."""
    if len(scenes) == 1 or (inside_a_program(scenes) and not is_tracing()):
        # what is differentiated outside of a program has kept programs of its own
        return [solve(scene, throw=False, options=options) for scene in scenes]
    if is_tracing():
        batch = jax.tree.map(lambda *leaves: jnp.stack(leaves), *scenes)
        solutions = jax.lax.map(lambda scene: solve(scene, throw=False, options=options), batch)
    else:
        batch = jax.tree.map(lambda *leaves: np.stack(leaves), *scenes)
        program = LaneProgram(
            Read.make,
            None,
            scenes[0],
            method=default_method(),
            lanes=LANES,
            devices=1,
            options=options,
            quick=True,
        )
        solutions = program(batch, np.ones(len(scenes), dtype=bool))
    return [jax.tree.map(lambda leaf, lane=lane: jnp.asarray(leaf[lane]), solutions) for lane in range(len(scenes))]
