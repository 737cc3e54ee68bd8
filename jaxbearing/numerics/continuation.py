"""Continuation: if the first try fails, the solver starts from an easier system and changes it in stages to the given
one.

A system defines one or more homotopies, `homotopy(parameter, path)`: an easy system at parameter 1, the given system at
0. Each further try follows one homotopy in stages; each stage starts from the root of the previous one.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import AbstractArrowSystem, ArrowPoint, System
from .newton_steps import choose

LONGEST_STAGE = 0.25
"""Largest change of the homotopy parameter from one stage to the next."""
SHORTEST_STAGE = 0.02
"""Smallest change of the homotopy parameter from one stage to the next; a try that needs a smaller one has failed."""
NOTHING_SOLVED = 2.0
"""Value of `solved_parameter` before any stage has been solved."""
STAGES_PER_TRY = 3
"""Ratio of the step limit before the first solved stage of a try to that of later stages, which start near a root."""
MOST_STEPS = 4
"""Limit of the Newton steps of all continuations together, divided by `max_steps` and the number of homotopies."""


class Continuation(NamedTuple):
    """State of the tries: the first one solves the system itself, each of the others follows one homotopy."""

    parameter: Float[Array, ""]
    """Homotopy parameter of the stage being solved; 0 in the first try."""
    solved_parameter: Float[Array, ""]
    """Parameter of the last stage that was solved; above 1 if there is none."""
    solved: ArrowPoint
    length: Float[Array, ""]
    """Change of the homotopy parameter from stage to stage."""
    steps: Int[Array, ""]
    """Newton steps of this stage."""
    tries: Int[Array, ""]
    """Number of tries begun, including the first one, of the system itself."""

    @classmethod
    def begun(cls, start: ArrowPoint) -> "Continuation":
        zero, none_solved, longest = (jnp.asarray(number) for number in (0.0, NOTHING_SOLVED, LONGEST_STAGE))
        return cls(zero, none_solved, start, longest, jnp.asarray(0), jnp.asarray(1))

    def system_of_stage(self, system: System) -> System:
        """The system of this stage."""
        return system.homotopy(self.parameter, jnp.maximum(self.tries - 2, 0))

    @property
    def at_system(self) -> Bool[Array, ""]:
        """True if the stage is the system itself."""
        return self.parameter == 0.0

    def step_limit(self, max_steps: int) -> Int[Array, ""]:
        """Newton steps that the stage may take."""
        return jnp.where(self.solved_parameter <= 1.0, max(max_steps // STAGES_PER_TRY, 1), max_steps)


def first_guesses(system: AbstractArrowSystem) -> tuple[ArrowPoint, ArrowPoint]:
    """Initial guess of the system, and initial guesses of its homotopies at parameter 1, stacked on a leading axis."""
    homotopies = system.homotopies
    parameter, path = jnp.asarray([0.0] + [1.0] * homotopies), jnp.asarray([0, *range(homotopies)])
    guesses = jax.vmap(lambda e, w: system.homotopy(e, w).initial())(parameter, path)
    start, easiest = (jax.tree.map(lambda leaf, i=i: leaf[i], guesses) for i in (0, slice(1, None)))
    return start, easiest


class StageEnd(NamedTuple):
    """Result of a Newton step for its stage.

    - `converged`: the root was found.
    - `failed`: the stage has failed.
    - `hopeless`: a nested solve fails at the root. This try ends; another one may find another root.
    - `spent`: no Newton steps are left for further stages.
    """

    converged: Bool[Array, ""]
    failed: Bool[Array, ""]
    hopeless: Bool[Array, ""]
    spent: Bool[Array, ""]


def advance(
    state: Continuation, steps: Int[Array, ""], end: StageEnd, trial: ArrowPoint, easiest: ArrowPoint, most_tries: int
) -> tuple[Continuation, Bool[Array, ""], ArrowPoint, Bool[Array, ""]]:
    """The continuation after a Newton step.

    A stage that fails is replaced by one at half the distance from the last solved stage; later stages keep the shorter
    distance.

    **Arguments:** `steps`: Newton steps of this stage; `end`: result of the step; `trial`: the point that was judged;
    `easiest`: initial guesses of the homotopies (`first_guesses`); `most_tries`: largest number of tries.

    **Returns:** the new state; True if a stage starts; its starting point; True if no try is left.
    """
    reached = end.converged & (state.parameter > 0.0)
    solved_parameter = jnp.where(reached, state.parameter, state.solved_parameter)
    shorter = 0.5 * state.length
    lost = (state.tries == 1) | (solved_parameter > 1.0) | (shorter < SHORTEST_STAGE) | end.hopeless
    broken = end.failed & lost
    begin = broken & (state.tries < most_tries) & ~end.spent
    again = end.failed & ~broken
    ended = end.spent | (broken & ~begin)
    restart = begin | again | reached
    tries = jnp.where(begin, state.tries + 1, state.tries)
    solved_parameter = jnp.where(begin, NOTHING_SOLVED, solved_parameter)
    length = jnp.where(begin, LONGEST_STAGE, jnp.where(again, shorter, state.length))
    next_parameter = jnp.where(begin, 1.0, jnp.maximum(solved_parameter - length, 0.0))
    solved = choose(reached, trial, state.solved)
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
