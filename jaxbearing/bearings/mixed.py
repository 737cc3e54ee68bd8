"""Mixed friction in the results of bearings: fields of the rolling elements, and sums over them."""

import functools
import operator
from collections.abc import Sequence

import jax.numpy as jnp
from jaxtyping import Array

from ..contacts.mixed import MixedState
from .solution import BoundaryPower

SIDES = ("inner", "outer")
"""Names of the rows of contacts with the raceways."""


def mixed_results(state: MixedState | None, sides: Sequence[str] = SIDES) -> dict[str, Array]:
    """Results of mixed friction as fields of the rolling elements: name -> values; empty if it is not modelled.

    **Arguments:** `state`: state of the contacts, with one row for each side; `sides`: names of the sides."""
    if state is None:
        return {}
    results: dict[str, Array] = {}
    for i, side in enumerate(sides):
        results |= {
            f"film_ratio_{side}": state.film_ratio[i],
            f"load_share_{side}": state.share[i],
            f"boundary_{side}": state.boundary[i],
            f"flash_{side}": state.flash[i],
        }
    return results


def boundary_power(
    raceways: MixedState | None,
    multiplicity: int = 1,
    rib: MixedState | None = None,
    races: Sequence[int] = (0, 1),
) -> BoundaryPower | None:
    """The part of the losses that is due to boundary friction, W; `None` if mixed friction is not modelled.

    **Arguments:** `raceways`: state of the raceway contacts, one row each, `None` if they do not slide; `multiplicity`:
    number of rolling elements that each modelled element represents; `rib`: state of the roller ends on the rib;
    `races`: race of each row of `raceways`, 0 for the inner and 1 for the outer race.
    """
    powers: dict[str, Array] = {}
    if raceways is not None:
        each = multiplicity * jnp.sum(raceways.boundary_power, axis=1)
        inner, outer = (
            functools.reduce(operator.add, [each[k] for k, race in enumerate(races) if race == side]) for side in (0, 1)
        )
        powers |= {"inner_raceway": inner, "outer_raceway": outer}
    if rib is not None:
        powers["flange"] = multiplicity * jnp.sum(rib.boundary_power)
    if not powers:
        return None
    return BoundaryPower(total=jnp.asarray(sum(powers.values())), **powers)
