"""Continuation: a solve that fails at once begins with an easier system and walks from there to the one asked for.

A system states one or more homotopies, `homotopy(parameter, path)`: at parameter 1 it is easy, at 0 it is itself. Each
try walks along one of them in stages, every stage from where the last one ended.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import AbstractArrowSystem, ArrowPoint, System
from .newton_steps import choose

LONGEST_STAGE = 0.25
"""First length of a stage, in the homotopy's parameter."""
SHORTEST_STAGE = 0.02
"""A try in which stages would have to be shorter than this has failed."""
NOTHING_SOLVED = 2.0
"""In the place of the parameter of the last stage solved."""
STAGES_PER_TRY = 3
"""A stage starts near its end, and gets this part of the Newton steps of a first try."""
MOST_STEPS = 4
"""Newton steps of all continuations together, in units of `max_steps` a homotopy."""


class Continuation(NamedTuple):
    """State of the tries: the first is at the system itself, each of the others walks along a homotopy."""

    parameter: Float[Array, ""]
    """Homotopy parameter of the stage being solved; 0 in the first try."""
    solved_parameter: Float[Array, ""]
    """Parameter of the last stage solved; above 1: none."""
    solved: ArrowPoint
    length: Float[Array, ""]
    """Length of this stage."""
    steps: Int[Array, ""]
    """Newton steps of this stage."""
    tries: Int[Array, ""]
    """Begun; 1: at the system itself."""

    @classmethod
    def begun(cls, start: ArrowPoint) -> "Continuation":
        zero, none_solved, longest = (jnp.asarray(number) for number in (0.0, NOTHING_SOLVED, LONGEST_STAGE))
        return cls(zero, none_solved, start, longest, jnp.asarray(0), jnp.asarray(1))

    def system_of_stage(self, system: System) -> System:
        """The system of this stage."""
        return system.homotopy(self.parameter, jnp.maximum(self.tries - 2, 0))

    @property
    def at_system(self) -> Bool[Array, ""]:
        """True where the stage is the system itself."""
        return self.parameter == 0.0

    def step_limit(self, max_steps: int) -> Int[Array, ""]:
        """Newton steps that the stage may take."""
        return jnp.where(self.solved_parameter <= 1.0, max(max_steps // STAGES_PER_TRY, 1), max_steps)


def first_guesses(system: AbstractArrowSystem) -> tuple[ArrowPoint, ArrowPoint]:
    """First guess of the system, and those at parameter 1 of its homotopies, a leading axis over them."""
    homotopies = system.homotopies
    parameter, path = jnp.asarray([0.0] + [1.0] * homotopies), jnp.asarray([0, *range(homotopies)])
    guesses = jax.vmap(lambda e, w: system.homotopy(e, w).initial())(parameter, path)
    start, easiest = (jax.tree.map(lambda leaf, i=i: leaf[i], guesses) for i in (0, slice(1, None)))
    return start, easiest


class StageEnd(NamedTuple):
    """End of a Newton step for its stage.

    The root was found (`converged`); it `failed`; its root is one at which a nested solve fails (`hopeless`: this try
    has come to its end, and another one may end elsewhere); no Newton steps are left for further stages (`spent`).
    """

    converged: Bool[Array, ""]
    failed: Bool[Array, ""]
    hopeless: Bool[Array, ""]
    spent: Bool[Array, ""]


def advance(
    state: Continuation, steps: Int[Array, ""], end: StageEnd, trial: ArrowPoint, easiest: ArrowPoint, most_tries: int
) -> tuple[Continuation, Bool[Array, ""], ArrowPoint, Bool[Array, ""]]:
    """The continuation after a Newton step, whether a stage begins anew, from which point, and whether all is lost.

    A stage that fails is tried again half as far from the last one that was solved, and so are those after it.
    `easiest`: of `first_guesses`.
    """
    found = end.converged & (state.parameter > 0.0)
    solved_parameter = jnp.where(found, state.parameter, state.solved_parameter)
    shorter = 0.5 * state.length
    lost = (state.tries == 1) | (solved_parameter > 1.0) | (shorter < SHORTEST_STAGE) | end.hopeless
    broken = end.failed & lost
    begin = broken & (state.tries < most_tries) & ~end.spent
    again = end.failed & ~broken
    ended = end.spent | (broken & ~begin)
    restart = begin | again | found
    tries = jnp.where(begin, state.tries + 1, state.tries)
    solved_parameter = jnp.where(begin, NOTHING_SOLVED, solved_parameter)
    length = jnp.where(begin, LONGEST_STAGE, jnp.where(again, shorter, state.length))
    next_parameter = jnp.where(begin, 1.0, jnp.maximum(solved_parameter - length, 0.0))
    solved = choose(found, trial, state.solved)
    first = jax.tree.map(lambda leaf: leaf[jnp.maximum(tries - 2, 0)], easiest)
    new = Continuation(
        parameter=jnp.where(restart, next_parameter, state.parameter),
        solved_parameter=solved_parameter,
        solved=solved,
        length=length,
        steps=jnp.where(restart, 0, steps),
        tries=tries,
    )
    return new, restart, choose(begin, first, solved), ended
