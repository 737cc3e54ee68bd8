"""First iterates of the stages of an implicit Runge-Kutta method, extrapolated from earlier stages.

The first iterate is the value of the Lagrange polynomial through the rates of up to `MOST_NODES` earlier stages, of
this step and then of the previous one. A stage at the same place as an earlier one takes its rates. Without a previous
step, or after a much shorter one, the weights are those of diffrax's tableau.
"""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar

if TYPE_CHECKING:
    import diffrax as dfx

MOST_NODES = 4
"""Largest number of stages from which a first iterate is extrapolated."""
MOST_GROWTH = 2.0
"""Growth of the step above which the stages of the previous step are not used."""
APART = 0.05
"""Distance of two stages, over the step, below which only one of them is a node."""
INSIDE = 0.95
"""Place in the previous step below which a stage can be a node; the end of that step is the start of this one."""


def stage_places(tableau: "dfx.ButcherTableau") -> np.ndarray:
    """Places of the stages in the step, from 0."""
    return np.concatenate([[0.0], tableau.c])


def stage_predictors(tableau: Any, length: Scalar, before: Scalar) -> Float[Array, "stage both"]:
    """Weights of the stages of the previous step, then of those of this step, in the first iterate of each stage.

    **Arguments:** `tableau`: of diffrax; `length`, `before`: lengths of this step and of the previous one, s; `before`
    is 0 if there is none.
    """
    places = stage_places(tableau)
    count = len(places)
    near = (before > 0) & (length < MOST_GROWTH * before)
    rows = [jnp.zeros(2 * count)]
    for stage in range(1, count):
        plain = np.zeros(2 * count)
        plain[count : count + stage] = tableau.a_predictor[stage - 1]
        chosen = predictor_nodes(places, stage)
        nodes = [places[j] if j >= 0 else (places[~j] - 1.0) * before / length for j in chosen]
        row = jnp.zeros(2 * count)
        for a, j in enumerate(chosen):
            weight = jnp.ones(())
            for b, node in enumerate(nodes):
                if b != a:
                    # the nodes of a step of length 0 coincide; `near` then leaves them out
                    apart = jnp.where(near, nodes[a] - node, 1.0)
                    weight = weight * (places[stage] - node) / apart
            row = row.at[count + j if j >= 0 else ~j].set(weight)
        rows.append(jnp.where(near, row, jnp.asarray(plain)))
    return jnp.stack(rows)


def predictor_nodes(places: np.ndarray, stage: int) -> list[int]:
    """Stages that the first iterate of a stage is extrapolated from: j of this step, ~j of the one before."""
    same = [j for j in range(stage) if places[j] == places[stage]]
    if same:
        return same[-1:]
    own = _apart(places, list(reversed(range(stage))))
    inside = [j for j in range(len(places)) if 0.0 < places[j] < INSIDE]
    before = _apart(places, sorted(inside, key=lambda j: -places[j]))
    return (own + [~j for j in before])[:MOST_NODES]


def _apart(places: np.ndarray, candidates: list[int]) -> list[int]:
    """The candidates that are further than `APART` from all those chosen before them."""
    chosen: list[int] = []
    for j in candidates:
        if all(abs(places[j] - places[k]) > APART for k in chosen):
            chosen.append(j)
    return chosen
