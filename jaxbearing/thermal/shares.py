"""Shares of each loss of a bearing that heat the nodes of a thermal network, and the oil temperature of each loss.

| loss | to | temperature of its oil |
|---|---|---|
| `inner_raceway`, `outer_raceway` | ring and elements, by their resistances | mean of ring and elements |
| `inner_rolling_resistance`, `outer_rolling_resistance` | oil (inlet backflow), the rest as the raceway | the same |
| `flange` | half the ring that has it, half the elements | mean of the two |
| `element_ends`, `pocket` | half the elements, half the oil (the cage has no node) | mean of elements and oil |
| `cage_pilot` | half the guiding ring, half the oil | mean of the two |
| `drag` | oil | oil |

In a network of one node all losses heat this node, and all oil has its temperature. The last share of each loss is 1
less the others, so no heat is lost between a bearing and its network.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arguments import require_choice, require_numbers
from ..numerics.checks import known, label
from .network import NODES

LOSSES = (
    "inner_raceway",
    "outer_raceway",
    "inner_rolling_resistance",
    "outer_rolling_resistance",
    "flange",
    "element_ends",
    "pocket",
    "cage_pilot",
    "drag",
)
"""Names of the losses."""
RINGS = ("inner_ring", "outer_ring")
FLANGE_RINGS = (*RINGS, "both")
SUM_ERROR = 1e-9
"""Largest error of the sum of given shares, which must be 1."""


def loss_shares(
    nodes: tuple[str, ...],
    *,
    inner_ring: Scalar = 0.5,
    outer_ring: Scalar = 0.5,
    rolling_to_oil: Scalar = 0.5,
    guiding_ring: str = "inner_ring",
    flange_ring: str = "inner_ring",
    given: Mapping[str, Mapping[str, Scalar | None]] | None = None,
) -> dict[str, Float[Array, " node"]]:
    """The part of each loss that goes to each node, shape (node,), by the name of the loss.

    **Arguments:**
    - `nodes`: names of the nodes: one node, or the rings, elements and oil; further nodes get nothing.
    - `inner_ring`, `outer_ring`: part of the heat of a raceway that goes into its ring (`conductances`); 1/2 for two
      equal bodies.
    - `rolling_to_oil`: part of the rolling resistance that stays in the oil, from 0 to 1; an assumption.
    - `guiding_ring`: ring that guides the cage, `inner_ring` or `outer_ring`; `flange_ring`: ring with the flanges, or
      `both`.
    - `given`: given parts in place of these, by the names of loss and node. The last node that is named gets 1 less the
      others.

    **Raises:** `ValueError` for an unknown name, a known part outside of 0 to 1, and parts whose sum is not 1.
    """
    require_choice("guiding_ring", guiding_ring, RINGS)
    require_choice("flange_ring", flange_ring, FLANGE_RINGS)
    parts: dict[str, dict[str, Scalar | None]] = {
        "inner_raceway": {"inner_ring": inner_ring, "elements": None},
        "outer_raceway": {"outer_ring": outer_ring, "elements": None},
        "inner_rolling_resistance": _rolling("inner_ring", inner_ring, rolling_to_oil),
        "outer_rolling_resistance": _rolling("outer_ring", outer_ring, rolling_to_oil),
        "flange": {"inner_ring": 0.25, "outer_ring": 0.25, "elements": None}
        if flange_ring == "both"
        else {flange_ring: 0.5, "elements": None},
        "element_ends": {"elements": 0.5, "oil": None},
        "pocket": {"elements": 0.5, "oil": None},
        "cage_pilot": {guiding_ring: 0.5, "oil": None},
        "drag": {"oil": None},
    }
    for name, own in (given or {}).items():
        require_choice("the name of a loss", name, LOSSES)
        parts[name] = dict(own)
    return {name: _row(name, nodes, own) for name, own in parts.items()}


def _rolling(ring: str, to_ring: Scalar, to_oil: Scalar) -> dict[str, Scalar | None]:
    return {"oil": to_oil, ring: (1.0 - to_oil) * to_ring, "elements": None}


def _row(name: str, nodes: tuple[str, ...], parts: Mapping[str, Scalar | None]) -> Float[Array, " node"]:
    """Parts of one loss by node. The last part that is named is 1 less the others."""
    names = NODES[4] if len(nodes) == 1 else nodes
    wrong = [node for node in parts if node not in names]
    if wrong or not parts:
        raise ValueError(f"the shares of {name} need names of nodes among {', '.join(names)}, got {', '.join(parts)}")
    *others, last = parts
    for node in others:
        require_numbers("between 0 and 1", **{f"the share of {name} to {node}": parts[node]})
    values: list[Scalar] = [parts[node] for node in others]
    rest = 1.0 - sum(values)
    numbers = known(parts[last], *values)
    if numbers is not None and abs(sum(numbers) - 1.0) > SUM_ERROR:
        raise ValueError(f"the shares of {name} must add up to 1, got {sum(numbers):g}")
    require_numbers("between 0 and 1", **{f"the share of {name} to {last}": rest})
    if len(nodes) == 1:
        return jnp.ones(1)
    row = {**{node: parts[node] for node in others}, last: rest}
    return jnp.stack([jnp.asarray(row.get(node, 0.0), dtype=float) for node in nodes])


def node_heat(
    losses: Mapping[str, Scalar | None], shares: Mapping[str, Float[Array, " node"]]
) -> Float[Array, " node"]:
    """Heat into each node, W, shape (node,).

    **Arguments:** `losses`: W, by name, `None` for a loss that is not modelled; `shares`: result of `loss_shares`.

    **Raises:** `ValueError` for a loss without shares, and if there is no loss.
    """
    there = {name: loss for name, loss in losses.items() if loss is not None}
    for name in there:
        require_choice("the name of a loss", name, shares)
    if not there:
        raise ValueError("a network needs one loss at least, got none")
    return jnp.sum(jnp.stack([loss * shares[name] for name, loss in there.items()]), axis=0)


def _of_oil(place: str) -> Any:
    return eqx.field(metadata=label("K", f"temperature of the oil {place}"))


class OilTemperatures(eqx.Module):
    """Temperature of the oil that enters each interaction, K."""

    inner_raceway: Scalar = _of_oil("at the inner raceway")
    outer_raceway: Scalar = _of_oil("at the outer raceway")
    flange: Scalar = _of_oil("at the flanges or the rib")
    pocket: Scalar = _of_oil("in the cage pockets and at the element ends")
    cage_pilot: Scalar = _of_oil("in the cage lands")
    drag: Scalar = _of_oil("that drags on the elements")

    @property
    def element_ends(self) -> Scalar:
        """Temperature of the oil between element ends and cage: that of the pockets."""
        return self.pocket


def oil_temperatures(
    nodes: tuple[str, ...],
    temperatures: Float[Array, " node"],
    *,
    guiding_ring: str = "inner_ring",
    flange_ring: str = "inner_ring",
) -> OilTemperatures:
    """Oil temperature of each interaction: the mean temperature of the two parts that it is between.

    **Arguments:** `nodes`: names; `temperatures`: K; `guiding_ring`, `flange_ring`: as for `loss_shares`.

    **Raises:** `ValueError` for an unknown name of a ring.
    """
    require_choice("guiding_ring", guiding_ring, RINGS)
    require_choice("flange_ring", flange_ring, FLANGE_RINGS)
    if len(nodes) == 1:
        return OilTemperatures(*(temperatures[0] for _ in dataclasses.fields(OilTemperatures)))
    part = dict(zip(nodes, temperatures, strict=True))
    elements, oil = part["elements"], part["oil"]
    flanged = 0.5 * (part["inner_ring"] + part["outer_ring"]) if flange_ring == "both" else part[flange_ring]
    return OilTemperatures(
        inner_raceway=0.5 * (part["inner_ring"] + elements),
        outer_raceway=0.5 * (part["outer_ring"] + elements),
        flange=0.5 * (flanged + elements),
        pocket=0.5 * (elements + oil),
        cage_pilot=0.5 * (part[guiding_ring] + oil),
        drag=oil,
    )
