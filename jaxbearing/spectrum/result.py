"""Result of a load spectrum: the solution of each state, and the life under all of them."""

from typing import Any

import equinox as eqx
import jax
import numpy as np
from jaxtyping import Array, Bool, Float

from .._checks import about, as_note, in_groups
from ..bearings.solution import Solution
from ..life.duty import SpectrumLife, governing
from ..numerics.status import SolveError, Status


class Spectrum(eqx.Module):
    """Solutions of all states, and the life of the spectrum, which is NaN where a state failed.

    **Arguments:**
    - `names`, `shares`: of the states; the shares of the time add up to 1.
    - `solutions`: one for each state, as `jb.solve` gives it.
    - `life`: see `life.duty.SpectrumLife`.
    - `notes`: on the scene of all states.
    """

    names: tuple[str, ...] = eqx.field(static=True)
    shares: Float[Array, " state"]
    solutions: tuple[Any, ...]
    life: SpectrumLife
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    def __getitem__(self, name: str) -> Solution:
        """The solution of a state. **Raises:** `KeyError` for an unknown name."""
        if name not in self.names:
            raise KeyError(f"no state {name!r}; there are {', '.join(self.names)}")
        return self.solutions[self.names.index(name)]

    @property
    def converged(self) -> Bool[Array, ""]:
        """True if all states converged."""
        converged = self.solutions[0].converged
        for solution in self.solutions[1:]:
            converged = converged & solution.converged
        return converged

    @property
    def governing(self) -> str | None:
        """Name of the state with the largest share in the damage; `None` where nothing is damaged or a state failed."""
        damage = np.asarray(self.life.damage)
        return self.names[governing(self.life)] if np.all(np.isfinite(damage)) and damage.any() else None

    @property
    def failures(self) -> dict[str, str]:
        """Name of each state that failed -> why, in a sentence."""
        states = zip(self.names, self.solutions, strict=True)
        return {name: solution.failure() for name, solution in states if not bool(solution.converged)}

    @property
    def warnings(self) -> list[str]:
        """The warnings of the states, where what only some of them have names these, and the notes on the scene, in the
        groups of `AbstractSolution.warnings`."""
        by_text: dict[str, list[str]] = {}
        for name, solution in zip(self.names, self.solutions, strict=True):
            for text in solution.warnings:
                by_text.setdefault(text, []).append(name)
        every = len(self.names)
        texts = [text if len(names) == every else about(", ".join(names), text) for text, names in by_text.items()]
        act, assumed, information = in_groups([*texts, *map(as_note, self.notes)])
        return [*act, *assumed, *information]

    def raise_if_failed(self) -> None:
        """Does nothing while JAX traces.

        **Raises:** `SolveError` that names the states that failed.
        """
        try:
            failed = not bool(self.converged)
        except jax.errors.ConcretizationTypeError:
            return
        if failed:
            failures = jax.lax.stop_gradient(self).failures
            status = max(int(solution.status) for solution in self.solutions)
            reasons = "; ".join(f"state '{name}': {text}" for name, text in failures.items())
            raise SolveError(reasons, Status(status))
