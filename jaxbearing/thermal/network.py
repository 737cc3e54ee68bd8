r"""A thermal network: a few nodes of one temperature each, conductances between them, ambient air and an oil flow.

The balance of node k, with heat counted positive into the node, is

$$R_k(T) = \sum_j G_{kj}(T_j - T_k) - G_{k}^a(T_k - T_a) - [k = oil]\,\frac{\dot m c_p}{\xi}(T_k - T_{in}) + P_k(T) .$$

The network does not depend on the kind of bearing. A function of the node temperatures (`losses`) gives the heat $P_k$;
it may solve a whole bearing. G is symmetric, so the sum of all balances is the total loss less the heat that leaves
with the oil and to the ambient.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from .._types import Scalar
from ..numerics import lapack
from ..numerics.checks import Checked, array_module, bounded, demand, known, numbers_or_none
from ..numerics.precision import as_float
from ..numerics.status import Status

NODES: dict[int, tuple[str, ...]] = {
    1: ("bearing",),
    4: ("inner_ring", "outer_ring", "elements", "oil"),
    6: ("inner_ring", "outer_ring", "elements", "oil", "shaft", "housing"),
}
"""Names of the nodes of the usual networks, by their number."""
LAST_BITS = 4.0 * 2.0**-52
"""Relative rounding error of a temperature. It limits the accuracy of heat flows."""

AmbientConductance: TypeAlias = Scalar | Callable[[Array], Array]
"""Conductance to the ambient, W/K, >= 0: a number, or a function of the temperature of its node, K."""


class OilFlow(Checked):
    r"""An oil flow through the node that holds the oil.

    It takes the heat $(\dot m c_p/\xi)(T_{oil} - T_{in})$ and leaves with $T_{in} + (T_{oil} - T_{in})/\xi$.
    """

    capacity_rate: Scalar = bounded(">= 0", unit="W/K", converter=as_float)
    inlet: Scalar = bounded("> 0", unit="K", converter=as_float)
    mixing: Scalar = bounded("above 0 and at most 1", unit="1", converter=as_float, default=1.0)

    def heat(self, temperature: Scalar) -> Float[Array, ""]:
        """Heat that leaves with the oil, W. **Arguments:** `temperature` of the oil in the bearing, K."""
        return jnp.asarray(self.capacity_rate / self.mixing * (temperature - self.inlet))

    def outlet(self, temperature: Scalar) -> Float[Array, ""]:
        """Temperature of the oil that leaves, K. **Arguments:** `temperature` of the oil in the bearing, K."""
        return jnp.asarray(self.inlet + (temperature - self.inlet) / self.mixing)


OilFlow.__init__.__doc__ = """**Arguments:**
- `capacity_rate`: mass flow times specific heat capacity, W/K, >= 0.
- `inlet`: temperature of the oil that enters, K, > 0.
- `mixing`: xi, a number: 1 (default) if the oil in the bearing is well mixed and leaves with its temperature, 1/2 if
  its temperature rises linearly between inlet and outlet.
"""


class NodeHeat(eqx.Module):
    """Heat into the nodes at given temperatures, and other results of the same evaluation."""

    heat: Float[Array, " node"]
    status: Int[Array, ""] = eqx.field(default_factory=lambda: jnp.asarray(int(Status.CONVERGED)))
    between: Float[Array, "node node"] | None = None
    to_ambient: Float[Array, " node"] | None = None
    other: Any = None
    roots: tuple[Any, ...] = ()


NodeHeat.__init__.__doc__ = """**Arguments:**
- `heat`: into each node, W; shape (node,).
- `status`: of the solve behind it, index of `Status`. Anything but `CONVERGED` is a failure, and ends the search with
  this status where nothing else can be tried.
- `between`: further conductances between the nodes, W/K, symmetric, shape (node, node): those that follow from the
  solution behind the losses, such as those of its contacts. `None`: none.
- `to_ambient`: further conductances to the ambient, W/K, shape (node,). `None`: none.
- `other`: a pytree of arrays for the caller, such as the whole solution.
- `roots`: of the searches behind it; filled by `solve_network` where they are recorded (`numerics.known_roots`).
"""

Losses: TypeAlias = Callable[[Array], NodeHeat]
"""Function of the node temperatures, K, shape (node,), that returns the heat into the nodes."""


class HeatFlows(NamedTuple):
    """Heat flows of a network at given temperatures.

    `into_nodes`: heat into each node from other nodes, ambient and oil, W, shape (node,); `to_oil`, `to_ambient`: heat
    that leaves the network, W; `rounding`, `rounding_out`: rounding errors of `into_nodes` and of the heat that leaves,
    W.
    """

    into_nodes: Float[Array, " node"]
    to_oil: Float[Array, ""]
    to_ambient: Float[Array, ""]
    rounding: Float[Array, " node"]
    rounding_out: Float[Array, ""]


class Network(Checked):
    """Nodes, conductances between them and to the ambient, and an oil flow; `network_of` makes one from names."""

    nodes: tuple[str, ...] = eqx.field(static=True)
    between: Float[Array, "node node"] | Float[np.ndarray, "node node"]
    to_ambient: tuple[Any, ...]
    ambient: Scalar = bounded("> 0", unit="K", converter=as_float)
    oil: OilFlow | None = None

    def __check_init__(self):
        super().__check_init__()
        size = len(self.nodes)
        if size == 0 or len(set(self.nodes)) != size:
            raise ValueError(f"the nodes of a network need different names, got {self.nodes}")
        if np.shape(self.between) != (size, size) or len(self.to_ambient) != size:
            shapes = f"{np.shape(self.between)} and {len(self.to_ambient)}"
            raise ValueError(f"a network of {size} nodes needs {size} x {size} and {size} conductances, got {shapes}")
        if self.oil is not None and self.oil_node is None:
            raise ValueError(f"an oil flow needs a node named 'oil', got {self.nodes}")
        if numbers_or_none(self.between) is not None:
            xp = array_module(self.between)
            fine = xp.all(self.between == xp.swapaxes(self.between, -1, -2)) & xp.all(self.between >= 0)
            demand(
                "{path}.between must be symmetric, and no conductance negative",
                fine,
                lambda: "the conductances between nodes must be symmetric and >= 0",
            )
        cooling = known(*self.to_ambient, 0.0 if self.oil is None else self.oil.capacity_rate)
        if cooling is not None and not (min(cooling) >= 0.0 and max(cooling) > 0.0):
            raise ValueError(
                "a network needs an oil flow or a conductance to the ambient > 0, and none below 0: "
                f"got {cooling[:-1]} W/K to the ambient and {cooling[-1]:g} W/K of oil"
            )

    @property
    def oil_node(self) -> int | None:
        """Index of the node that holds the oil: the node `oil` or the only node; `None` if there is neither."""
        if len(self.nodes) == 1:
            return 0
        return self.nodes.index("oil") if "oil" in self.nodes else None

    def start(self) -> Float[Array, " node"]:
        """All nodes at the temperature of ambient or oil inlet, whichever is higher, K: a cold start."""
        coldest = jnp.asarray(self.ambient, dtype=float)
        if self.oil is not None:
            coldest = jnp.maximum(coldest, self.oil.inlet)
        return jnp.full(len(self.nodes), coldest)

    def flows(self, temperatures: Float[Array, " node"], losses: NodeHeat | None = None) -> HeatFlows:
        """Heat flows at node temperatures.

        **Arguments:** `temperatures`: K; `losses`: the conductances that they contain are added; `None` for none.
        """
        between = jnp.asarray(self.between, dtype=float)
        ambient = jnp.stack(
            [
                jnp.asarray(law(temperature) if callable(law) else law, dtype=float)
                for law, temperature in zip(self.to_ambient, temperatures, strict=True)
            ]
        )
        if losses is not None and losses.between is not None:
            between = between + losses.between
        if losses is not None and losses.to_ambient is not None:
            ambient = ambient + losses.to_ambient
        # flows from node to node, so that the two flows of a pair differ only in their sign
        conduction = jnp.sum(between * (temperatures[None, :] - temperatures[:, None]), axis=1)
        lost = ambient * (temperatures - self.ambient)
        size = jnp.abs(temperatures)
        inside, outwards = jnp.sum(jnp.abs(between) * (size[None, :] + size[:, None]), axis=1), jnp.abs(ambient) * size
        to_oil, into = jnp.zeros(()), conduction - lost
        if self.oil is not None and self.oil_node is not None:
            node = self.oil_node
            to_oil = self.oil.heat(temperatures[node])
            into = into.at[node].add(-to_oil)
            outwards = outwards.at[node].add(jnp.abs(self.oil.capacity_rate / self.oil.mixing) * size[node])
        rounding = jax.lax.stop_gradient((LAST_BITS * (inside + outwards), LAST_BITS * jnp.sum(outwards)))
        return HeatFlows(into, to_oil, jnp.sum(lost), *rounding)

    def residual(self, temperatures: Float[Array, " node"], losses: NodeHeat) -> Float[Array, " node"]:
        """Balance R of each node, W: heat that it takes in less heat that it gives off; 0 in a steady state."""
        return self.flows(temperatures, losses).into_nodes + losses.heat

    def oil_out(self, temperatures: Float[Array, " node"]) -> Float[Array, ""] | None:
        """Temperature of the oil that leaves, K; `None` without an oil flow."""
        if self.oil is None or self.oil_node is None:
            return None
        return self.oil.outlet(temperatures[self.oil_node])


Network.__init__.__doc__ = """**Arguments:**
- `nodes`: names.
- `between`: conductances between nodes, W/K, >= 0, symmetric, shape (node, node).
- `to_ambient`: conductance of each node to the ambient, W/K, >= 0: a number, or a function of the node's temperature.
- `ambient`: temperature of the ambient, K, > 0.
- `oil`: flow through the node `oil`, or the only one; `None` for grease or a bath.

**Raises:** `ValueError` for names, shapes or known conductances that make no network, and where nothing cools.
"""


def network_of(
    nodes: int | tuple[str, ...],
    between: Mapping[tuple[str, str], Scalar],
    to_ambient: Mapping[str, AmbientConductance],
    ambient: Scalar,
    oil: OilFlow | None = None,
) -> Network:
    """A network from named conductances; those that are not named are 0.

    **Arguments:**
    - `nodes`: names, or the number of nodes of a usual network (`NODES`).
    - `between`: W/K, >= 0, by the names of two nodes in any order.
    - `to_ambient`: W/K, >= 0, or functions of the node's temperature, by the name of the node.
    - `ambient`: temperature, K, > 0; `oil`: as for `Network`.

    **Raises:** `ValueError` for a name that is not among the nodes, a pair that is given twice, and as `Network`.
    """
    names = NODES[nodes] if isinstance(nodes, int) and nodes in NODES else nodes
    if not isinstance(names, tuple):
        raise ValueError(f"the number of nodes must be one of {', '.join(map(str, NODES))}, got {nodes!r}")
    unknown = [name for name in to_ambient if name not in names]
    if unknown:
        raise ValueError(f"{unknown[0]!r} is not a node: the nodes are {', '.join(names)}")
    ways = tuple(to_ambient.get(name, 0.0) for name in names)
    return Network(names, conductances_between(names, between), ways, ambient, oil)


def conductances_between(
    nodes: tuple[str, ...], between: Mapping[tuple[str, str], Scalar]
) -> Float[Array | np.ndarray, "node node"]:
    """The symmetric matrix of named conductances, W/K, shape (node, node).

    **Arguments:** `nodes`: names; `between`: W/K by the names of two nodes in any order.

    **Raises:** `ValueError` for names that are no two nodes, and for a pair that is given twice.
    """
    places: dict[tuple[int, int], Scalar] = {}
    for pair, value in between.items():
        if len(set(pair)) != 2 or not set(pair) <= set(nodes):
            raise ValueError(f"{pair} is no pair of nodes: the nodes are {', '.join(nodes)}")
        first, second = sorted(map(nodes.index, pair))
        if (first, second) in places:
            raise ValueError(f"the conductance between {pair[0]} and {pair[1]} is given twice")
        places[first, second] = value
    plain = all(known(value) is not None for value in places.values())
    rows = [[places.get((min(i, j), max(i, j)), 0.0) for j in range(len(nodes))] for i in range(len(nodes))]
    if plain:
        # known numbers stay known, so that they can be checked
        return np.asarray(rows, dtype=float)
    return jnp.stack([jnp.stack([jnp.asarray(conductance, dtype=float) for conductance in row]) for row in rows])


class Slopes(NamedTuple):
    """Derivatives with respect to the node temperatures, W/K, shape (node, node).

    `conduction`: K, the derivative of -(R - P), with the derivatives of the conductances; `losses`: the derivative of
    the losses P. The Jacobian of the balances is `losses` less `conduction`.
    """

    conduction: Float[Array, "node node"]
    losses: Float[Array, "node node"]

    @property
    def jacobian(self) -> Float[Array, "node node"]:
        """Jacobian dR/dT of the balances, W/K."""
        return self.losses - self.conduction


def thermal_margin(slopes: Slopes) -> Float[Array, ""]:
    r"""Thermal margin $1 - \max\operatorname{Re}\,\mathrm{eig}(K^{-1}\,\partial P/\partial T)$, a number.

    It is 1 if the temperature does not affect the losses, above 1 if warmer nodes make less heat everywhere, and 0
    exactly at a fold, beyond which there is no steady state. It needs no heat capacities. A positive margin guarantees
    neither that a cold start at speed reaches the state (`warm_up` shows this), nor that oscillations die out
    (`thermal_rate` shows this).
    """
    return 1.0 - jnp.max(jnp.linalg.eigvals(lapack.solve(slopes.conduction, slopes.losses)).real)


def thermal_rate(slopes: Slopes, capacity: Float[Array, " node"]) -> Float[Array, ""]:
    r"""Growth rate of disturbances, $\max\operatorname{Re}\,\mathrm{eig}(C^{-1}J)$, 1/s; a steady state is stable if it
    is negative.

    **Arguments:** `capacity`: heat capacity of each node, J/K, > 0.
    """
    return jnp.max(jnp.linalg.eigvals(slopes.jacobian / capacity[:, None]).real)


def slopes_at(network: Network, losses: Losses, temperatures: Float[Array, " node"]) -> Slopes:
    """Slopes K and dP/dT by forward differentiation of the losses and conductances; they can be differentiated again.

    **Arguments:** `losses`: function of the node temperatures; `temperatures`: K, shape (node,).
    """

    def both(trial: Array) -> tuple[Array, Array]:
        heat = losses(trial)
        return network.flows(trial, heat).into_nodes, heat.heat

    flows, heat = jax.jacfwd(both)(temperatures)
    return Slopes(-flows, heat)
