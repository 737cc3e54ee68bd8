"""Solves bearings with a thermal network. An outer iteration finds the node temperatures, and each of its steps solves
the complete bearing.

The node temperatures set the temperature of the oil in each contact and, if the bearing has seats, the temperatures of
its parts and with them its clearance. Each solve starts from its own first guess, so its success does not depend on
earlier trials. Its losses and the conductances of its contacts enter the heat balances of the nodes. Derivatives follow
from the implicit function theorem at the temperatures found. The stiffness of the ring is that at constant
temperatures, because temperatures cannot follow a load that changes quickly.
"""

import dataclasses
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from .._checks import Information, about
from ..mounting import PartTemperatures
from ..numerics.checks import known, nan_unless
from ..numerics.refusals import refusals_of
from ..numerics.status import Status
from ..thermal.network import Network, NodeHeat
from ..thermal.point import ThermalOptions
from ..thermal.result import HeatPaths, NodeTemperatures, ThermalResult, named
from ..thermal.settings import Thermal
from ..thermal.shares import oil_temperatures
from ..thermal.solve import START_NOTE, UNSTABLE, ThermalState, solve_network
from .checks import input_excess
from .heat import OUTSIDE, bearing_heat, bearing_network, has_flow, heat_capacities, rings_of, thermal_of
from .mounted import check_walls
from .solution import Solution

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

Bearing = TypeVar("Bearing", bound="AbstractBearing")
MOST_BROYDEN = {"when_needed": 15, "never": 60}
"""Largest number of solves in Broyden's iteration. After these Newton's iteration follows, or time steps if an exact
Jacobian is not allowed (`never`)."""


def thermal_problems(scene: AbstractBearing) -> Iterator[str | ValueError]:
    """Yields a sentence for each missing or conflicting input of a scene with a thermal network."""
    thermal: Thermal | None = scene.thermal
    if thermal is None:
        return
    if scene.temperatures is not None:
        yield "temperatures: expected none beside [thermal], which computes them"
    if not scene.dissipates:
        yield (
            "thermal: the scene has no losses; expected an oil and a [contact] table with traction or rolling "
            "resistance"
        )
        return
    if scene.oil is None:
        return
    yield from _lacking_of_oil(scene, thermal)
    yield from _lacking_sizes(scene, thermal)
    if scene.fits is None:
        yield from refusals_of(check_walls, scene)
    yield from _lacking_of_materials(scene, thermal)


def _computed(thermal: Thermal, *names: str) -> bool:
    """True if at least one of these conductances is not given, so that it must be computed."""
    return any(getattr(thermal.conductance, name) is None for name in names)


def _of_oil(thermal: Thermal) -> bool:
    """True if at least one conductance from the oil to the rings or the rolling elements must be computed."""
    return thermal.nodes > 1 and _computed(thermal, "inner_ring_oil", "outer_ring_oil", "elements_oil")


def _lacking_of_oil(scene: AbstractBearing, thermal: Thermal) -> Iterator[str]:
    """Yields a message for each property of the oil that is needed but missing."""
    flow = known(scene.operation.oil_flow)
    flows = flow is None or flow[0] > 0.0
    needs = {
        "heat_capacity": ("2150 J/(kg*K)", flows or _of_oil(thermal)),
        "density": ("950 kg/m^3", flows or _of_oil(thermal)),
        "conductivity": ("0.147 W/(m*K)", thermal.nodes > 1),
    }
    for name, (example, needed) in needs.items():
        if needed and getattr(scene.oil, name) is None:
            yield f"oil.{name}: found nothing, expected a number or a law, which [thermal] needs, e.g. '{example}'"


def _lacking_sizes(scene: AbstractBearing, thermal: Thermal) -> Iterator[str]:
    outside = [f"{node}_ambient" for node in OUTSIDE[thermal.nodes]]
    needed = {"width"} if _of_oil(thermal) and _computed(thermal, "inner_ring_oil", "outer_ring_oil") else set()
    if _computed(thermal, *outside):
        needed |= {"width", "bore", "outside_diameter"}
    if thermal.nodes == 6 and _computed(thermal, "inner_ring_shaft", "outer_ring_housing"):
        needed |= {"width", "bore", "outside_diameter"}
    for name in ("bore", "outside_diameter", "width"):
        if name in needed and getattr(scene.geometry, name) is None:
            yield (
                f"geometry.{name}: found nothing, expected a length, needed for conductances that [thermal] does not "
                "give, e.g. '25 mm'"
            )


def _lacking_of_materials(scene: AbstractBearing, thermal: Thermal) -> Iterator[str]:
    if thermal.nodes == 1:
        return
    names = (*scene.materials.named_rings, f"{scene.element}s")
    for name in names:
        for field, example in (("conductivity", "46 W/(m*K)"), ("heat_capacity", "460 J/(kg*K)")):
            if getattr(getattr(scene.materials, name), field) is None:
                path, needed = f"materials.{name}.{field}", "expected a number, which [thermal] needs"
                yield f"{path}: found nothing, {needed}, e.g. '{example}'"


def at_temperatures(scene: Bearing, temperatures: Float[Array, " node"]) -> Bearing:
    """The scene without its thermal network, with oil and parts at the node temperatures, K."""
    nodes = thermal_of(scene).node_names
    oil = oil_temperatures(nodes, temperatures, **rings_of(scene))
    parts = None
    if scene.fits is not None:
        by_name: dict[str, Array] = dict(zip(nodes, temperatures, strict=True))
        if len(nodes) == 1:
            by_name |= dict.fromkeys(("inner_ring", "outer_ring", "elements"), temperatures[0])
        part_names = ("inner_ring", "outer_ring", "elements", "shaft", "housing")
        parts = PartTemperatures(**{name: by_name[name] for name in part_names if name in by_name})
    return dataclasses.replace(scene, thermal=None, temperatures=parts, oil_temperatures=oil)


def heat_at(
    scene: AbstractBearing, temperatures: Float[Array, " node"], solve: Callable[[AbstractBearing], Solution]
) -> NodeHeat:
    """Heat into the nodes, for the bearing solved at these node temperatures, K. Its field `other` is the solution.

    **Arguments:** `solve`: function that solves a scene that has neither a thermal network nor fits.
    """
    lane = at_temperatures(scene, temperatures)
    return bearing_heat(lane, thermal_of(scene), lane.solved_running(solve), temperatures)


def solve_warm(scene: AbstractBearing, solve: Callable[[AbstractBearing], Solution]) -> Solution:
    """The solution at the temperatures at which every node is in heat balance.

    **Arguments:** `solve`: function that solves a scene that has neither a thermal network nor fits.
    """
    thermal = thermal_of(scene)
    network, nodes = bearing_network(scene), len(thermal.node_names)

    def losses(temperatures: Array) -> NodeHeat:
        return heat_at(scene, temperatures, solve)

    start = None if thermal.start is None else jnp.full(nodes, jnp.asarray(thermal.start, dtype=float))
    state = solve_network(
        network,
        losses,
        start=start,
        capacity=heat_capacities(scene),
        limit=thermal.limit,
        options=ThermalOptions(
            jacobian=thermal.exact_jacobian,
            stability=thermal.stability,
            quasi_newton_solves=MOST_BROYDEN[thermal.exact_jacobian],
        ),
    )
    return _answer(scene, network, state)


def _answer(scene: AbstractBearing, network: Network, state: ThermalState) -> Solution:
    """The solution of the bearing at the temperatures found, with the thermal result. If the solve of a lane (a member
    of a batch) failed, its results are NaN."""
    solution: Solution = state.losses.other
    ended: Solution = state.ended.other
    good = state.status == Status.CONVERGED
    result, inputs = _result(scene, network, state), input_excess(scene)
    checks = {text: broken & (good | (text in inputs)) for text, broken in solution.checks.items()}
    if result.unstable is not None:
        checks[UNSTABLE] = good & result.unstable
    checks[NO_FLOW] = good & without_flow(scene)
    return dataclasses.replace(
        solution,
        status=state.status,
        residual_norm=ended.residual_norm,
        inner_residual=ended.inner_residual,
        failure_causes=ended.failure_causes,
        operation=scene.operation,
        checks=checks,
        notes=(*solution.notes, *thermal_notes(scene)),
        thermal=result,
    )


def _result(scene: AbstractBearing, network: Network, state: ThermalState) -> ThermalResult:
    nodes = network.nodes
    by_name = dict(zip(nodes, state.temperatures, strict=True))
    masked = lambda value: nan_unless(value, state.status == Status.CONVERGED)
    return ThermalResult(
        temperatures=named(NodeTemperatures, by_name),
        oil=oil_temperatures(nodes, state.temperatures, **rings_of(scene)),
        flows=heat_paths(network, state.temperatures, state.losses),
        ambient=masked(network.ambient),
        oil_in=None if network.oil is None else masked(network.oil.inlet),
        oil_out=state.oil_out,
        heat_to_oil=state.heat_to_oil,
        heat_to_ambient=state.heat_to_ambient,
        balance_error=state.balance_error,
        margin=state.margin,
        rate=state.rate,
        solves=state.solves,
        last=state.last,
        nodes=nodes,
    )


def heat_paths(network: Network, temperatures: Float[Array, " node"], losses: NodeHeat) -> HeatPaths:
    """Heat along each conductance, W. **Arguments:** `losses`: losses of the bearing at these temperatures, K."""
    nodes, between, outside = network.nodes, losses.between, losses.to_ambient
    assert between is not None
    assert outside is not None
    flows = {}
    for i, first in enumerate(nodes):
        for j, second in enumerate(nodes):
            flows[f"{first}_{second}"] = between[i, j] * (temperatures[i] - temperatures[j])
        law = network.to_ambient[i]
        way: Any = law(temperatures[i]) if callable(law) else law
        flows[f"{first}_ambient"] = (outside[i] + way) * (temperatures[i] - network.ambient)
    closed = {f"{name}_ambient" for name in nodes if name not in OUTSIDE[len(nodes)]}
    return named(HeatPaths, {name: flow for name, flow in flows.items() if name not in closed})


def thermal_notes(scene: AbstractBearing) -> tuple[str, ...]:
    """Notes for the user on the assumptions of the network and the limits of a steady state."""
    return about("thermal", START_NOTE), *network_notes(scene)


NO_FLOW = Information(
    "operation.oil_temperature has no effect: no oil flows through the bearing (operation.oil_flow), and [thermal] "
    "computes the temperature of the oil in it"
)


def without_flow(scene: AbstractBearing) -> Bool[Array, ""]:
    """True if no oil flow enters the network, so that the inlet temperature has no effect."""
    return ~jnp.asarray(has_flow(scene)) | (jnp.asarray(scene.operation.oil_flow) == 0.0)


def network_notes(scene: AbstractBearing) -> tuple[str, ...]:
    """Notes for the user on the assumptions of the network."""
    thermal = thermal_of(scene)
    notes: list[str] = []
    outside = [f"{node}_ambient" for node in OUTSIDE[thermal.nodes]]
    if thermal.housing_diameter is None and _computed(thermal, *outside):
        notes.append(
            "thermal: conductances to the ambient that are not given follow from the reference heat flow of ISO "
            "15312; they are uncertain by a factor of 2"
        )
    if _of_oil(thermal):
        notes.append(
            "thermal: the heat transfer from the oil is that of a flat plate; it is uncertain by a factor of 3"
        )
    return tuple(notes)


def settled(scene: Bearing, solution: Solution) -> Bearing:
    """The scene at the temperatures of its solution; unchanged without a network. If the solution failed, the
    temperatures are finite but meaningless."""
    if scene.thermal is None or solution.thermal is None:
        return scene
    temperatures = solution.thermal.node_temperatures()
    return at_temperatures(scene, jnp.where(solution.converged, temperatures, scene.thermal.ambient))
