"""Solve of a shaft whose bearings share one thermal network: an outer iteration on the temperatures of all nodes, with
a complete solve of the shaft in each step.

Temperatures set the oil and the parts of each bearing as they do for a bearing alone (`bearings.warm`). In addition
shaft and housing grow along the axis, which closes or opens every bearing. The preload is that of the mounted set, cold
and at rest. Derivatives follow from the implicit function theorem at the temperatures found.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._checks import about
from ..bearings.bearing import AbstractBearing
from ..bearings.heat import bearing_heat, bearing_network, heat_capacities, inlet_temperature, rings_of
from ..bearings.warm import MOST_BROYDEN, NO_FLOW, at_temperatures, heat_paths, network_notes, without_flow
from ..numerics.checks import nan_unless
from ..numerics.status import Status
from ..thermal.network import HeatFlows, Network, NodeHeat
from ..thermal.point import ThermalOptions
from ..thermal.result import NodeTemperatures, ThermalResult, named
from ..thermal.shares import oil_temperatures
from ..thermal.solve import START_NOTE, ThermalState, solve_network
from .batches import batches_of, on_shaft
from .heat import HOUSING_NODE, NODES, SHAFT_NODE, ShaftThermalResult, between_neighbours, flows_along, growth_along
from .mounting import LinearBearing
from .preload import Mounted, mount
from .scene import Place, ShaftSystem
from .solution import ShaftSolution

SolveAt = Callable[[tuple[Place, ...], Mounted, Array], ShaftSolution]
"""Function of the bearings without networks, the mounted preload and the axial displacement of the shaft relative to
the housing at each bearing, m, that returns the solution of the shaft."""


class _Way(eqx.Module):
    """Conductance of a node to the ambient plus that of the oil flow, W/K, as a function of its temperature."""

    own: Any
    oil: Float[Array, ""]

    def __call__(self, temperature: Array) -> Array:
        own = self.own(temperature) if callable(self.own) else self.own
        return jnp.asarray(own, dtype=float) + self.oil


class _Warm:
    """The bearings of a system that have a network, in the order of its places."""

    def __init__(self, system: ShaftSystem):
        places = system.places
        self.index = [i for i, place in enumerate(places) if getattr(place.scene, "thermal", None) is not None]
        own: list[Any] = [places[i].scene for i in self.index]
        self.scenes: list[Any] = [on_shaft(scene, jnp.asarray(system.shaft.speed)) for scene in own]
        self.names = [places[i].name for i in self.index]
        self.networks = [bearing_network(scene) for scene in self.scenes]
        self.position = jnp.stack([jnp.asarray(places[i].position, dtype=float) for i in self.index])
        inlets = [
            inlet_temperature(scene) for scene, network in zip(self.scenes, self.networks, strict=True) if network.oil
        ]
        coldest = [jnp.asarray(network.ambient, dtype=float) for network in self.networks]
        self.coldest = jnp.min(jnp.stack([*coldest, *(jnp.asarray(inlet, dtype=float) for inlet in inlets)]))
        """Lowest temperature of all ambients and oil inlets, K, the ambient of the network. Warmer ambients and inlets
        bring in heat, which is therefore never negative."""
        assert system.thermal is not None
        self.joined = between_neighbours(system.thermal, system.shaft, self.position)
        """Conductances between the nodes of neighbouring bearings, W/K."""

    def network(self) -> Network:
        """Network of the nodes of all bearings. The conductances between them come with the losses."""
        nodes: list[str] = []
        ways: list[_Way] = []
        for name, network in zip(self.names, self.networks, strict=True):
            for place, node in enumerate(network.nodes):
                oil = network.oil if place == network.oil_node else None
                nodes.append(f"{node} of {name}")
                flow = jnp.zeros(()) if oil is None else jnp.asarray(oil.capacity_rate / oil.mixing)
                ways.append(_Way(network.to_ambient[place], flow))
        return Network(tuple(nodes), jnp.zeros((len(nodes), len(nodes))), tuple(ways), self.coldest)

    def each(self, temperatures: Float[Array, " node"]) -> Float[Array, "bearing 6"]:
        return temperatures.reshape(len(self.index), NODES)

    def to_neighbours(self, temperatures: Float[Array, " node"]) -> Float[Array, "bearing 6"]:
        """Heat flow from each node to the nodes of neighbouring bearings, W."""
        flows = self.joined * (temperatures[:, None] - temperatures[None, :])
        return self.each(jnp.sum(flows, axis=1))

    def start(self) -> Float[Array, " node"]:
        """Temperatures at which the search begins: `thermal.start` of a bearing if it is given, else a cold start."""
        starts = [
            network.start() if scene.thermal.start is None else jnp.full(NODES, scene.thermal.start)
            for scene, network in zip(self.scenes, self.networks, strict=True)
        ]
        return jnp.concatenate(starts)

    def capacity(self) -> Float[Array, " node"] | None:
        capacities = [heat_capacities(scene) for scene in self.scenes]
        known = [capacity for capacity in capacities if capacity is not None]
        return jnp.concatenate(known) if len(known) == len(capacities) else None

    def from_outside(self, number: int, heat: NodeHeat, temperatures: Float[Array, "6"]) -> Float[Array, "6"]:
        """Heat that ambient and oil of a bearing bring in because they are warmer than `coldest`, W."""
        network, outside = self.networks[number], heat.to_ambient
        assert outside is not None
        laws = zip(network.to_ambient, temperatures, strict=True)
        ways = jnp.stack([jnp.asarray(law(t) if callable(law) else law, dtype=float) for law, t in laws]) + outside
        brought = ways * (network.ambient - self.coldest)
        if network.oil is None or network.oil_node is None:
            return brought
        return brought.at[network.oil_node].add(
            network.oil.capacity_rate / network.oil.mixing * (network.oil.inlet - self.coldest)
        )


def solve_warm_shaft(system: ShaftSystem, solve: SolveAt) -> ShaftSolution:
    """The solution of a shaft at its steady temperatures, at which all heat of the losses leaves."""
    thermal, shaft, places, warm = system.thermal, system.shaft, system.places, _Warm(system)
    assert thermal is not None
    cold = tuple(place._replace(scene=_without_network(place.scene)) for place in places)
    mounted = mount(system, cold, batches_of(cold, jnp.asarray(shaft.speed)))
    position = jnp.stack([jnp.asarray(place.position, dtype=float) for place in places])

    def losses(temperatures: Array) -> NodeHeat:
        each = warm.each(temperatures)
        lanes = [at_temperatures(scene, own) for scene, own in zip(warm.scenes, each, strict=True)]
        there = list(cold)
        for index, lane in zip(warm.index, lanes, strict=True):
            there[index] = there[index]._replace(scene=lane)
        grown = growth_along(thermal, shaft, warm.position, each, position)
        solution = solve(tuple(there), mounted, grown)
        heats: list[NodeHeat] = []
        for lane, scene, name, own in zip(lanes, warm.scenes, warm.names, each, strict=True):
            solved = solution.bearings[name].solution
            assert solved is not None
            heats.append(bearing_heat(lane, scene.thermal, solved, own))
        brought = [warm.from_outside(i, heat, own) for i, (heat, own) in enumerate(zip(heats, each, strict=True))]
        outside: list[Any] = [heat.to_ambient for heat in heats]
        between = jax.scipy.linalg.block_diag(*(heat.between for heat in heats)) + warm.joined
        made = jnp.concatenate([heat.heat for heat in heats])
        other = (solution, tuple(heats))
        return NodeHeat(made + jnp.concatenate(brought), solution.status, between, jnp.concatenate(outside), other)

    exact = "never" if all(scene.thermal.exact_jacobian == "never" for scene in warm.scenes) else "when_needed"
    state = solve_network(
        warm.network(),
        losses,
        start=warm.start(),
        capacity=warm.capacity(),
        limit=jnp.min(jnp.stack([jnp.asarray(scene.thermal.limit, dtype=float) for scene in warm.scenes])),
        options=ThermalOptions(jacobian=exact, quasi_newton_solves=MOST_BROYDEN[exact]),
    )
    return _answer(system, warm, state)


def _without_network(scene: AbstractBearing | LinearBearing) -> AbstractBearing | LinearBearing:
    return scene if getattr(scene, "thermal", None) is None else dataclasses.replace(scene, thermal=None)


def _answer(system: ShaftSystem, warm: _Warm, state: ThermalState) -> ShaftSolution:
    """The solution of the shaft at the temperatures found, with the thermal results added; all of it is NaN if the
    search failed."""
    solution, heats = state.losses.other
    ended: ShaftSolution = state.ended.other[0]
    good = state.status == Status.CONVERGED
    bearings, notes = dict(solution.bearings), [about("thermal", START_NOTE)]
    checks = {text: broken & good for text, broken in solution.checks.items()}
    results = []
    for number, name in enumerate(warm.names):
        result = _of_bearing(warm, number, state, heats[number])
        results.append(result)
        own = dataclasses.replace(bearings[name].solution, thermal=result)
        bearings[name] = dataclasses.replace(bearings[name], solution=own)
        notes += [f"{name}: {note}" for note in network_notes(warm.scenes[number])]
        checks[about(name, NO_FLOW)] = good & without_flow(warm.scenes[number])
    masked = lambda value: nan_unless(value, good)
    loss = sum(jnp.sum(heat.heat) for heat in heats)
    to_oil = sum(result.heat_to_oil for result in results)
    to_ambient = sum(result.heat_to_ambient for result in results)
    thermal = system.thermal
    assert thermal is not None
    along = flows_along(thermal, system.shaft, warm.position, warm.each(state.temperatures))
    return dataclasses.replace(
        solution,
        status=state.status,
        residual_norm=ended.residual_norm,
        softest=ended.softest,
        failure_causes=ended.failure_causes,
        bearings=bearings,
        checks=checks,
        notes=(*solution.notes, *notes),
        thermal=ShaftThermalResult(
            shaft_flow=masked(along[0]),
            housing_flow=masked(along[1]),
            heat_to_oil=masked(to_oil),
            heat_to_ambient=masked(to_ambient),
            balance_error=masked((loss - to_oil - to_ambient) / loss),
            solves=state.solves,
        ),
    )


def _of_bearing(warm: _Warm, number: int, state: ThermalState, heat: NodeHeat) -> ThermalResult:
    """Temperatures and heat flows of one bearing."""
    scene, network = warm.scenes[number], warm.networks[number]
    temperatures = warm.each(state.temperatures)[number]
    flows: HeatFlows = network.flows(temperatures, heat)
    away = warm.to_neighbours(state.temperatures)[number]
    paths = {"shaft_neighbours": away[SHAFT_NODE], "housing_neighbours": away[HOUSING_NODE]}
    masked = lambda value: nan_unless(value, state.status == Status.CONVERGED)
    return ThermalResult(
        temperatures=named(NodeTemperatures, dict(zip(network.nodes, temperatures, strict=True))),
        oil=oil_temperatures(network.nodes, temperatures, **rings_of(scene)),
        flows=dataclasses.replace(heat_paths(network, temperatures, heat), **paths),
        ambient=masked(network.ambient),
        oil_in=None if network.oil is None else masked(network.oil.inlet),
        oil_out=network.oil_out(temperatures),
        heat_to_oil=flows.to_oil,
        heat_to_ambient=flows.to_ambient,
        balance_error=masked(jnp.sum(flows.into_nodes + heat.heat - away) / jnp.sum(heat.heat)),
        margin=None,
        rate=None,
        solves=state.solves,
        last=warm.each(state.last)[number],
        nodes=network.nodes,
    )
