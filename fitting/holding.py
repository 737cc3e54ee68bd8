"""Choice of the parameters that are fitted and of those that are held, at a bound or because the data do not determine
them. The fit of an oil and the calibration of scenes use the same loop."""

import abc
from typing import Any, Generic, NamedTuple, Protocol, TypeVar, runtime_checkable

import numpy as np
from jaxtyping import Array

from .loss import influence

MOST_TURNS = 12
"""Largest number of rounds, each of which holds or releases one parameter."""
SLACK = 1e-6
"""Correlation of the residual with a column of the Jacobian above which a parameter at its bound is released, because
the loss falls towards the inside."""


@runtime_checkable
class HasNaturalCoordinates(Protocol):
    """The part of an estimation problem that the loop uses."""

    def natural(self, u: Any) -> Array | np.ndarray:
        """Natural coordinates that belong to the unknowns `u`."""
        ...


Problem = TypeVar("Problem", bound=HasNaturalCoordinates)
Estimate = TypeVar("Estimate")
"""Results of all optimisations of a problem, one for each start."""
Unknowns = TypeVar("Unknowns", Array, np.ndarray)


class Held(NamedTuple):
    """State of the parameters: `free` flags the fitted ones; `reasons` says why others are held; `pinned` has the
    natural coordinates of those held at a bound."""

    free: np.ndarray
    reasons: dict[int, str]
    pinned: dict[int, float]

    def without(self, index: int, reason: str, at: float | None = None) -> "Held":
        """A copy with one more parameter held, at the bound `at` if that is given."""
        free = self.free.copy()
        free[index] = False
        pinned = self.pinned if at is None else {**self.pinned, index: at}
        return Held(free, {**self.reasons, index: reason}, pinned)

    def released(self, index: int) -> "Held":
        """A copy with one parameter fitted again."""
        free = self.free.copy()
        free[index] = True
        drop = lambda mapping: {i: value for i, value in mapping.items() if i != index}
        return Held(free, drop(self.reasons), drop(self.pinned))


class AbstractSearch(abc.ABC, Generic[Problem, Estimate, Unknowns]):
    """Methods of an estimation that the loop calls. `problem` makes the problems that the other methods take; `u` are
    the unknowns of a problem."""

    limits: tuple[np.ndarray, np.ndarray]
    """Bounds in natural coordinates, infinite where there is none."""
    loss: str
    """One of `loss.LOSSES`."""

    @abc.abstractmethod
    def problem(self, free: np.ndarray, pinned: dict[int, float], base: np.ndarray | None = None) -> Problem:
        """The problem with these parameters free and those pinned, about the natural coordinates `base` (None: the
        search's own first values)."""

    @abc.abstractmethod
    def starts(self, problem: Problem, free: np.ndarray) -> np.ndarray:
        """Unknowns to start from, (start, parameter)."""

    @abc.abstractmethod
    def optimised(self, problem: Problem, starts: np.ndarray) -> tuple[Problem, Estimate, Unknowns]:
        """The problem, all estimates, and the unknowns of the best."""

    @abc.abstractmethod
    def slopes(self, problem: Problem, u: Unknowns) -> tuple[np.ndarray, np.ndarray]:
        """Plain residuals, and their Jacobian by the natural coordinates, (point, parameter)."""

    @abc.abstractmethod
    def undetermined(self, problem: Problem, u: Unknowns, held: Held) -> tuple[int, str] | None:
        """The next parameter to hold because the data do not determine it, and why; `None` if there is none."""

    @abc.abstractmethod
    def value_in_words(self, index: int, coordinate: float) -> str:
        """A natural coordinate of a parameter as a person writes its value."""

    def within_bounds(self, coordinates: np.ndarray) -> np.ndarray:
        """Natural coordinates moved to the nearest bound where they are beyond it."""
        low, high = self.limits
        return np.clip(coordinates, low, high)


class Settled(NamedTuple, Generic[Problem, Estimate, Unknowns]):
    """Result of the loop: last problem, all estimates, unknowns of the best one, and the held parameters; `ended` is
    False where the loop stopped at `MOST_TURNS`."""

    problem: Problem
    estimate: Estimate
    u: Unknowns
    held: Held
    ended: bool


def settled(search: AbstractSearch[Problem, Estimate, Unknowns], held: Held) -> Settled[Problem, Estimate, Unknowns]:
    """Fits, and holds or releases one parameter after another until nothing is left to change."""
    problem = search.problem(held.free, held.pinned)
    starts = search.starts(problem, held.free)
    turns = 0
    while True:
        problem, estimate, u = search.optimised(problem, starts)
        # each turn holds one more parameter, or lets one go from a bound that does not bind
        revised, turns = _revised(search, problem, u, held), turns + 1
        if revised is None or turns >= MOST_TURNS:
            return Settled(problem, estimate, u, held, revised is None)
        moved = revised.pinned != held.pinned
        held = revised
        problem = search.problem(held.free, held.pinned, search.within_bounds(np.asarray(problem.natural(u))))
        # a parameter moved to its bound may have changed much, so the others get new starting points
        starts = search.starts(problem, held.free) if moved else np.zeros_like(starts)
        if len(starts) > 1:
            starts[-1] = 0.0


def _revised(
    search: AbstractSearch[Problem, Estimate, Unknowns], problem: Problem, u: Unknowns, held: Held
) -> Held | None:
    """Chooses the parameter to hold or release next: bounds first (an active set), then those that the data do not
    determine; `None` if nothing is left."""
    coordinates = np.asarray(problem.natural(u))
    low, high = search.limits
    beyond = np.where(held.free, np.maximum(low - coordinates, coordinates - high), -np.inf)
    index = int(np.argmax(beyond))
    if beyond[index] > 0.0:
        limit = float(low[index] if coordinates[index] < low[index] else high[index])
        return held.without(index, f"at its bound {search.value_in_words(index, limit)}", limit)
    residual, slopes = search.slopes(problem, u)
    downhill = -slopes.T @ influence(residual, search.loss)
    for index, at in held.pinned.items():
        inward = 1.0 if at == low[index] else -1.0
        if inward * downhill[index] > SLACK * np.linalg.norm(slopes[:, index]) * np.linalg.norm(residual):
            return held.released(index)
    undetermined = search.undetermined(problem, u, held)
    return None if undetermined is None else held.without(*undetermined)
