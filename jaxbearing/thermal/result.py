"""Results of a bearing with a thermal network: temperatures and heat flows with their labels."""

import dataclasses
import itertools
from typing import Any, TypeVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ..numerics.checks import label
from ..numerics.status import Status
from .shares import OilTemperatures
from .solve import UNSTABLE

Named = TypeVar("Named", bound=eqx.Module)
_Number = Float[Array, ""]


def _temperature(of: str) -> Any:
    return eqx.field(default=None, metadata=label("K", f"temperature of {of}"))


class NodeTemperatures(eqx.Module):
    """Temperatures of the nodes; `None` for nodes that the network does not have."""

    bearing: _Number | None = _temperature("the whole bearing")
    inner_ring: _Number | None = _temperature("the inner ring")
    outer_ring: _Number | None = _temperature("the outer ring")
    elements: _Number | None = _temperature("the rolling elements")
    oil: _Number | None = _temperature("the oil in the bearing")
    shaft: _Number | None = _temperature("the shaft")
    housing: _Number | None = _temperature("the housing")


def _flow(source: str, sink: str) -> Any:
    return eqx.field(default=None, metadata=label("W", f"heat from {source} to {sink}"))


class HeatPaths(eqx.Module):
    """Heat flow along each conductance; it is negative if heat flows the other way."""

    inner_ring_elements: _Number | None = _flow("inner ring", "elements")
    outer_ring_elements: _Number | None = _flow("outer ring", "elements")
    inner_ring_oil: _Number | None = _flow("inner ring", "oil")
    outer_ring_oil: _Number | None = _flow("outer ring", "oil")
    elements_oil: _Number | None = _flow("elements", "oil")
    inner_ring_shaft: _Number | None = _flow("inner ring", "shaft")
    outer_ring_housing: _Number | None = _flow("outer ring", "housing")
    housing_oil: _Number | None = _flow("housing", "oil")
    bearing_ambient: _Number | None = _flow("the bearing", "ambient")
    inner_ring_ambient: _Number | None = _flow("inner ring", "ambient")
    outer_ring_ambient: _Number | None = _flow("outer ring", "ambient")
    shaft_ambient: _Number | None = _flow("shaft", "ambient")
    housing_ambient: _Number | None = _flow("housing", "ambient")
    shaft_neighbours: _Number | None = _flow("shaft", "the shaft at the neighbouring bearings")
    housing_neighbours: _Number | None = _flow("housing", "the housing at the neighbouring bearings")


class ThermalResult(eqx.Module):
    """Steady temperatures of a bearing, and where its losses go. Results of a search that failed are NaN.

    **Arguments:** the labels of the fields describe them; others are
    - `last`: temperature of each node where the search ended, K, also if it failed.
    - `nodes`: names of the nodes.
    """

    temperatures: NodeTemperatures
    oil: OilTemperatures
    flows: HeatPaths
    ambient: _Number = eqx.field(metadata=label("K", "temperature of the ambient"))
    oil_in: _Number | None = eqx.field(metadata=label("K", "temperature of the oil that enters"))
    oil_out: _Number | None = eqx.field(metadata=label("K", "temperature of the oil that leaves"))
    heat_to_oil: _Number = eqx.field(metadata=label("W", "heat that leaves with the oil"))
    heat_to_ambient: _Number = eqx.field(metadata=label("W", "heat that leaves to the ambient"))
    balance_error: _Number = eqx.field(
        metadata=label("1", "total loss less the heat that leaves, relative to the total loss")
    )
    margin: _Number | None = eqx.field(
        metadata=label("1", "thermal margin: 1 without feedback, 0 at a fold beyond which there is no steady state")
    )
    rate: _Number | None = eqx.field(
        metadata=label("1/s", "largest growth rate of a disturbance of the temperatures; stable if negative")
    )
    solves: Int[Array, ""] = eqx.field(metadata=label("1", "solves of the bearing behind these temperatures"))
    last: Float[Array, " node"]
    nodes: tuple[str, ...] = eqx.field(static=True)

    @property
    def unstable(self) -> Bool[Array, ""] | None:
        """True if the state is unstable: `margin` <= 0 or `rate` > 0; `None` if they are not computed."""
        if self.margin is None:
            return None
        beyond = self.margin <= 0.0
        return beyond if self.rate is None else beyond | (self.rate > 0.0)

    def node_temperatures(self) -> Float[Array, " node"]:
        """Temperatures in the order of the nodes, K."""
        return jnp.stack([getattr(self.temperatures, name) for name in self.nodes])

    def paths(self) -> dict[tuple[str, str], _Number]:
        """Heat flow from the first to the second node of each pair, W, negative if it flows the other way. The second
        node may be `ambient` or `neighbours`."""
        ends = itertools.product(self.nodes, (*self.nodes, "ambient", "neighbours"))
        flows = {(first, second): getattr(self.flows, f"{first}_{second}", None) for first, second in ends}
        return {pair: flow for pair, flow in flows.items() if flow is not None}

    def losses(self) -> dict[str, _Number]:
        """The part of the power loss that heats each node directly, W. In a steady state this is the heat that flows
        away from the node, to other nodes, the ambient and the oil that leaves."""
        made = dict.fromkeys(self.nodes, jnp.zeros(()))
        for (first, second), flow in self.paths().items():
            made[first] = made[first] + flow
            if second in made:
                made[second] = made[second] - flow
        if self.oil_out is not None:
            place = "oil" if "oil" in made else self.nodes[0]
            made[place] = made[place] + self.heat_to_oil
        return made

    def ending(self, status: Status) -> str:
        """One sentence on a search that failed: status, hottest node, its temperature."""
        last = np.asarray(self.last)
        node = int(np.argmax(last))
        name, there = self.nodes[node].replace("_", " "), float(last[node])
        place = f"the hottest node, the {name}, at {there - 273.15:.1f} degC after {int(self.solves)} solves"
        if status == Status.THERMAL_RUNAWAY:
            return f"{status.text}: no steady state below the limit of temperature (thermal.limit); {place}"
        return f"{status.text}: the search for steady temperatures ended with {place}"


def named(kind: type[Named], values: dict[str, Array]) -> Named:
    """An object of class `kind` with the `values` for which it has fields. Other values, the heat along conductances of
    0, are dropped."""
    known = {field.name for field in dataclasses.fields(kind)}
    return kind(**{name: value for name, value in values.items() if name in known})


__all__ = ["UNSTABLE", "HeatPaths", "NodeTemperatures", "ThermalResult", "named"]
