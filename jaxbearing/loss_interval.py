"""Interval of a power loss by all inputs that are known by a distribution only."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ._scene import AbstractScene
from .bearings import priors
from .distribution import Distribution
from .solve import solve_once

LIKELY = 0.05, 0.95
"""Shares of all losses below the limits of an interval of 90 %."""
SHARES = np.array([0.01, LIKELY[0], 0.25, 0.75, LIKELY[1], 0.99])
"""Shares of an input at which the loss is solved."""
VALUES = 200_001
"""Number of equally likely values of each input in a sum."""


class PowerPart(NamedTuple):
    """Power loss over the distribution of one input alone: limits of 90 %, W.

    **Arguments:** `path`: dotted path of the input; `assumed`: its distribution in words.
    """

    path: str
    low: float
    high: float
    assumed: str


class PowerInterval(NamedTuple):
    """Power loss, and the limits between which it is with a probability of 90 %, W, by all uncertain inputs together.

    **Arguments:** `by`: dotted path of the input whose own interval is the widest; `assumed`: its distribution in
    words; `parts`: the interval by each input alone, the widest first.
    """

    value: float
    low: float
    high: float
    by: str
    assumed: str
    parts: tuple[PowerPart, ...]

    def as_dict(self) -> dict[str, object]:
        """Numbers and words by name."""
        parts = [part._asdict() for part in self.parts]
        return self._asdict() | {"parts": parts, "not_counted": not_counted(part.path for part in self.parts)}


TABLES = ("geometry", "operation", "oil")
"""Tables of a scene of which it is said whether an interval counts any of their numbers."""


def not_counted(paths: Iterable[str]) -> str:
    """Says what an interval leaves out: the tables of which no number scatters, and the laws.

    **Arguments:** `paths`: dotted paths of the inputs that it counts.
    """
    counted = {name for path in paths for name in path.split(".")}
    left_out = [name for name in TABLES if name not in counted]
    return f"not counted: {', '.join([*left_out, 'errors of the laws'])}"


class _Uncertain(NamedTuple):
    """An input, its distribution, and that in words."""

    path: str
    values: Distribution
    words: str


def power_interval(
    scene: AbstractScene,
    solution: Any,
    solver: Callable[[AbstractScene], Any] = solve_once,
    given: Mapping[str, Distribution] | None = None,
    drag_prior: bool = True,
) -> PowerInterval | None:
    r"""The power loss over the distributions of all inputs that have one.

    These are the assumed distributions of the drag coefficient and of a supply that is given as a level
    (`bearings.priors`), and those that are given: priors of the oil, distributions of the scene. All are independent.
    The loss is solved at six values of each input, from 1 to 99 % of its distribution, all others as they are, with a
    monotone cubic between them. Together it is $P + \sum_k[P_k(x_k) - P]$: exact where each input moves losses of its
    own, a first estimate otherwise. The limits by one input alone are exact if the loss rises or falls with it all the
    way.

    Returns `None` for a scene without such an input or without a loss, and where a solve fails.

    **Arguments:** `solution`: of the scene; `solver`: from a scene to its solution, never raising; `given`: dotted path
    -> distribution, which prevails over an assumed one; `drag_prior`: whether the drag coefficient has its assumed one.
    """
    power = getattr(solution, "power_loss", None)
    if power is None or power.total is None or not bool(solution.converged):
        return None
    inputs, plain = _uncertain(scene, given or {}, drag_prior), _without_words(scene)
    value, losses = float(power.total), {}
    for uncertain in inputs:
        solved = [solver(plain.replace({uncertain.path: float(x)})) for x in uncertain.values.quantiles(SHARES)]
        if not all(bool(again.converged) for again in solved):
            return None
        losses[uncertain.path] = np.array([float(again.power_loss.total) for again in solved])
    if not inputs:
        return None
    parts = sorted(
        (_part(uncertain, losses[uncertain.path]) for uncertain in inputs), key=lambda part: part.low - part.high
    )
    widest = parts[0]
    low, high = (widest.low, widest.high) if len(parts) == 1 else _together(value, inputs, losses)
    return PowerInterval(value, low, high, widest.path, widest.assumed, tuple(parts))


def numbers_among(scene: AbstractScene, distributions: Mapping[str, Distribution]) -> dict[str, Distribution]:
    """The distributions whose path leads to one number of the scene."""
    return {path: distribution for path, distribution in distributions.items() if _is_number(_value_at(scene, path))}


def _value_at(scene: object, path: str) -> object:
    for name in path.split("."):
        scene = getattr(scene, name, None)
    return scene


def _is_number(value: Any) -> bool:
    number = isinstance(value, int | float) or hasattr(value, "dtype")
    return number and not isinstance(value, bool) and np.ndim(value) == 0


def _uncertain(scene: AbstractScene, distributions: Mapping[str, Distribution], drag_prior: bool) -> list[_Uncertain]:
    """The inputs that have a distribution."""
    assumed = {
        priors.DRAG_FIELD: priors.drag_prior(scene) if drag_prior else None,
        priors.SUPPLY_FIELD: priors.supply_prior(scene),
    }
    inputs = [
        _Uncertain(path, distribution, priors.prior_in_words(distribution))
        for path, distribution in assumed.items()
        if distribution is not None and path not in distributions
    ]
    for path, distribution in distributions.items():
        if distribution.deviation > 0.0:
            meaning = priors.meaning(scene, path)
            inputs.append(
                _Uncertain(
                    path, distribution, f"{_in_words(distribution)}; {meaning}" if meaning else _in_words(distribution)
                )
            )
    return inputs


def _without_words(scene: AbstractScene) -> AbstractScene:
    """The scene with a number in the place of a level of its supply."""
    supply = priors.supply_prior(scene)
    if supply is None:
        return scene
    return scene.replace({priors.LEVEL_FIELD: None, priors.SUPPLY_FIELD: supply.nominal})


def _part(uncertain: _Uncertain, losses: np.ndarray) -> PowerPart:
    low, high = sorted(float(losses[np.flatnonzero(share == SHARES)[0]]) for share in LIKELY)
    return PowerPart(uncertain.path, low, high, uncertain.words)


def _together(value: float, inputs: list[_Uncertain], losses: Mapping[str, np.ndarray]) -> tuple[float, float]:
    """Limits of the loss by all inputs; each takes its values in an order of its own."""
    order, total = np.random.default_rng(0), np.full(VALUES, value)
    shares = (np.arange(VALUES) + 0.5) / VALUES
    for uncertain in inputs:
        total += order.permutation(at_shares(uncertain.values, losses[uncertain.path], shares) - value)
    low, high = np.quantile(total, LIKELY)
    return float(low), float(high)


def at_shares(values: Distribution, solved: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """A result over the distribution of one input, by a monotone cubic and constant beyond 1 and 99 %.

    **Arguments:** `solved`: the result at the input's `SHARES`; `shares`: of the input, at which it is wanted.
    """
    from scipy.interpolate import PchipInterpolator

    at = values.quantiles(SHARES)
    return PchipInterpolator(at, solved)(np.clip(values.quantiles(shares), at[0], at[-1]))


def _in_words(distribution: Distribution) -> str:
    """A distribution of the scene or of its oil, SI."""
    if distribution.median is not None:
        return f"lognormal, median {distribution.median:.4g}, log deviation {distribution.log_deviation:.3g}"
    if distribution.shape == "uniform":
        half = math.sqrt(3.0) * distribution.deviation
        return f"uniform, {distribution.mean - half:.4g} to {distribution.mean + half:.4g}"
    return f"normal, mean {distribution.mean:.4g}, deviation {distribution.deviation:.3g}"
