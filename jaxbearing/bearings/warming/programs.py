"""The two compiled programs of a run of temperatures: integration of one piece, and the bearing at given instants."""

from typing import NamedTuple

import diffrax as dfx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ..._types import Scalar
from ...numerics.newton import NewtonOptions
from ...numerics.safe import largest
from ...programs import KeptProgram
from ...thermal.network import Network, NodeHeat
from ...thermal.result import NodeTemperatures, named
from ...thermal.warming_up import Balance, Reached, integrate
from ..bearing import AbstractBearing
from ..heat import bearing_network, heat_capacities, inlet_temperature, thermal_of
from ..solution import Solution
from ..warm import heat_at, heat_paths
from .history import WarmInstant
from .settings import WarmUpSimulation, at_instant


class Seen(NamedTuple):
    """The bearing solved at an instant.

    - `instant`: results; `status`: status of the solve.
    - `rates`: rates of the node temperatures, K/s.
    - `checks`: text of a warning -> whether it applies.
    """

    instant: WarmInstant
    status: Int[Array, ""]
    rates: Float[Array, " node"]
    checks: dict[str, Bool[Array, ""]]


def _heat(scene: AbstractBearing, temperatures: Array) -> NodeHeat:
    options = NewtonOptions()
    return heat_at(scene, temperatures, lambda running: running.solve_ring(options))


def _capacity(scene: AbstractBearing) -> Array:
    capacity = heat_capacities(scene)
    assert capacity is not None
    return capacity


def _balance(scene: AbstractBearing, settings: WarmUpSimulation, begin: Scalar) -> Balance:
    """Equations of a piece of a run. Their time starts at 0, which is the time `begin` of the run, s."""

    def network(time: Array) -> Network:
        return bearing_network(at_instant(scene, settings, begin + time))

    def losses(temperatures: Array, time: Array) -> NodeHeat:
        heat = _heat(at_instant(scene, settings, begin + time), temperatures)
        # the steps need the heat and the conductances, but not the whole solution
        return NodeHeat(heat.heat, heat.status, heat.between, heat.to_ambient)

    return Balance(network, losses, _capacity(scene))


def _advance(
    scene: AbstractBearing,
    settings: WarmUpSimulation,
    temperatures: Float[Array, " node"],
    begin: Float[Array, ""],
    lengths: Float[Array, " time"],
    step: Float[Array, ""],
) -> Reached:
    """Integrates a piece of a run.

    **Arguments:** `temperatures`: node temperatures at the start, K; `begin`: start, s; `lengths`: times after the
    start, s; `step`: first step that is tried, s."""
    return integrate(
        _balance(scene, settings, begin),
        temperatures,
        lengths,
        thermal_of(scene).limit,
        settings.options,
        adjoint=dfx.ForwardMode(),
        first_step=jnp.minimum(step, lengths[-1]),
        differences=True,
        steps=True,
    )


def instants_at(
    scene: AbstractBearing,
    settings: WarmUpSimulation,
    times: Float[Array, " time"],
    temperatures: Float[Array, "time node"],
) -> Seen:
    """The bearing solved at each of the times, s, with the node temperatures at these times, K."""
    capacity = _capacity(scene)

    def seen_at(pair: tuple[Array, Array]) -> Seen:
        time, nodes = pair
        lane = at_instant(scene, settings, time)
        network, heat = bearing_network(lane), _heat(lane, nodes)
        flows, solution = network.flows(nodes, heat), heat.other
        into = flows.into_nodes + heat.heat
        return Seen(_instant(lane, network, nodes, heat, into), heat.status, into / capacity, dict(solution.checks))

    return jax.lax.map(seen_at, (times, temperatures))


def _instant(lane: AbstractBearing, network: Network, nodes: Array, heat: NodeHeat, into: Array) -> WarmInstant:
    solution: Solution = heat.other
    elements, flows = solution.elements, network.flows(nodes, heat)
    both = lambda name: jnp.stack([getattr(elements, f"{name}_inner"), getattr(elements, f"{name}_outer")])
    filmless = getattr(elements, "film_inner", None) is None
    return WarmInstant(
        inner_speed=jnp.asarray(lane.operation.inner_speed, dtype=float),
        oil_inlet=jnp.asarray(inlet_temperature(lane), dtype=float),
        temperatures=named(NodeTemperatures, dict(zip(network.nodes, nodes, strict=True))),
        flows=heat_paths(network, nodes, heat),
        oil_out=network.oil_out(nodes),
        heat_to_oil=flows.to_oil,
        heat_to_ambient=flows.to_ambient,
        heat_stored=jnp.sum(into),
        power_loss=solution.power_loss,
        drive_power=solution.drive_power,
        ring=solution.ring,
        cage=solution.cage,
        fit=solution.fit,
        largest_load=largest(both("load")),
        largest_pressure=largest(both("pressure")),
        # elements without contact have no film (NaN)
        smallest_film=None if filmless else jnp.nanmin(both("film")),
    )


ADVANCE = KeptProgram(_advance, quick=True)
LOOK = KeptProgram(instants_at, quick=True)
