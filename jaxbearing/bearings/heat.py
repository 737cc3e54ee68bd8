"""The thermal network of a solved bearing: conductances, heat capacities, and the nodes that its losses heat.

Boundary dimensions are those of the drawing; their changes by temperatures and fits are too small to matter for heat.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..gaps import saturated_oil_fraction
from ..lubricants import InletOil
from ..materials import Material
from ..numerics.safe import safe_norm
from ..thermal.conductances import (
    ContactHeat,
    CylindricalHousing,
    Solid,
    elements_surface,
    ellipse_contact_heat,
    line_contact_heat,
    oil_capacity,
    oil_filling_conductance,
    oil_heat_transfer,
    ring_capacity,
    ring_surface,
    seat_conductance,
)
from ..thermal.network import NODES, Network, NodeHeat, OilFlow, conductances_between, network_of
from ..thermal.reference_speed import radial_seat_area, reference_conductance
from ..thermal.settings import Thermal
from ..thermal.shares import loss_shares, node_heat
from .flanks import by_flank
from .parts import AbstractMaterials
from .solution import Solution

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

OUTSIDE = {1: ("bearing",), 4: ("inner_ring", "outer_ring"), 6: ("shaft", "housing")}
"""Number of nodes -> nodes from which heat flows to the ambient."""
GUIDED = {"inner": "inner_ring", "outer": "outer_ring", "both": "both"}


def thermal_of(scene: AbstractBearing) -> Thermal:
    """Thermal settings of a scene that has a thermal network."""
    thermal: Thermal | None = scene.thermal
    assert thermal is not None
    return thermal


def inlet_temperature(scene: AbstractBearing) -> Values:
    """Temperature at which oil enters the network, K."""
    own = thermal_of(scene).oil_inlet
    return scene.operation.oil_temperature if own is None else own


def rings_of(scene: AbstractBearing) -> dict[str, str]:
    """The ring that guides the cage and the ring with the flanges, as arguments of `loss_shares`."""
    cage, flange = getattr(scene, "cage", None), getattr(scene, "flange", None)
    return {
        "guiding_ring": "inner_ring" if cage is None else cage.guidance,
        "flange_ring": "inner_ring" if flange is None else GUIDED[flange.ring],
    }


def has_flow(scene: AbstractBearing) -> bool:
    """True if the scene gives the heat capacity and the density of the oil, so that an oil flow can carry heat."""
    return scene.oil.heat_capacity is not None and scene.oil.density is not None


def bearing_network(scene: AbstractBearing) -> Network:
    """Network of a scene with its nodes, oil flow and ambient, without the conductances that depend on the solution
    (see `bearing_heat`)."""
    thermal = thermal_of(scene)
    ways: dict[str, Scalar | CylindricalHousing] = dict.fromkeys(OUTSIDE[thermal.nodes], 0.0)
    if thermal.housing_diameter is not None:
        size = (thermal.housing_diameter, thermal.factor.ambient * thermal.housing_area)
        housing = {1: "bearing", 4: "outer_ring", 6: "housing"}[thermal.nodes]
        if getattr(thermal.conductance, f"{housing}_ambient") is None:
            ways[housing] = CylindricalHousing(*size, thermal.ambient, thermal.emissivity)
    oil = None
    if has_flow(scene):
        inlet = inlet_temperature(scene)
        mass = scene.oil.density.density(inlet) * scene.operation.oil_flow
        oil = OilFlow(mass * scene.oil.heat_capacity.heat_capacity(inlet), inlet, thermal.mixing)
    return network_of(thermal.node_names, {}, ways, thermal.ambient, oil)


def bearing_heat(
    scene: AbstractBearing, thermal: Thermal, solution: Solution, temperatures: Float[Array, " node"]
) -> NodeHeat:
    """Heat into the nodes and conductances of a bearing that was solved at given node temperatures.

    **Arguments:** `scene`: scene with the temperatures of its oil and without the network; `temperatures`: node
    temperatures, K.
    """
    nodes = thermal.node_names
    loss, by_race = solution.power_loss, solution.rolling_by_race
    losses = {name: value for name, value in vars(loss).items() if name not in ("total", "rolling_resistance")}
    if by_race is not None:
        losses |= {"inner_rolling_resistance": by_race.inner, "outer_rolling_resistance": by_race.outer}
    between: dict[tuple[str, str], Scalar] = {}
    to_rings = {"inner_ring": 0.5, "outer_ring": 0.5}
    if len(nodes) > 1:
        flanks = by_flank(solution.elements)
        contacts = ContactHeat(*map(_joined, zip(*(_contacts(scene, flank) for flank in flanks), strict=True)))
        between = _between(scene, thermal, solution, contacts, dict(zip(nodes, temperatures, strict=True)))
        load = _joined([jnp.stack([flank.load_inner, flank.load_outer]) for flank in flanks])
        carried = jnp.sum(load, axis=1)
        # losses are generated where the load is: the contacts are weighted by their loads
        parts = jnp.sum(load * contacts.share, axis=1) / jnp.where(carried > 0.0, carried, 1.0)
        to_rings = dict(zip(to_rings, jnp.where(carried > 0.0, parts, 0.5), strict=True))
    shares = loss_shares(
        nodes,
        **to_rings,
        rolling_to_oil=thermal.rolling_to_oil,
        **rings_of(scene),
        given=_given_shares(scene, thermal),
    )
    own, outside = _to_ambient(scene, thermal), [jnp.zeros(())] * len(nodes)
    for node, conductance in own.items():
        outside[nodes.index(node)] = jnp.asarray(conductance, dtype=float)
    return NodeHeat(
        node_heat(losses, shares),
        solution.status,
        jnp.asarray(conductances_between(nodes, between), dtype=float),
        jnp.stack(outside),
        solution,
    )


def _given_shares(scene: AbstractBearing, thermal: Thermal) -> dict[str, dict[str, Scalar | None]]:
    """Shares of the losses that the scene gives, as the argument `given` of `loss_shares`."""
    rings, shares = rings_of(scene), {}
    second = {
        "inner_raceway": ("inner_ring", "elements"),
        "outer_raceway": ("outer_ring", "elements"),
        "flange": (rings["flange_ring"], "elements"),
        "element_ends": ("elements", "oil"),
        "pocket": ("elements", "oil"),
        "cage_pilot": (rings["guiding_ring"], "oil"),
        "drag": ("elements", "oil"),
    }
    for name, (first, last) in second.items():
        part = getattr(thermal.share, name)
        if part is None:
            continue
        if first == "both":
            shares[name] = {"inner_ring": 0.5 * part, "outer_ring": 0.5 * part, last: None}
        else:
            shares[name] = {first: part, last: None}
    return shares


def _solid(material: Material) -> Solid:
    assert material.conductivity is not None
    assert material.heat_capacity is not None
    return Solid(material.conductivity, material.density, material.heat_capacity)


def _solid_of_rings(materials: AbstractMaterials) -> Solid:
    """Thermal properties of the rings. If their materials differ, each field has the shape (2, 1), inner ring first."""
    if materials.inner_ring is None:
        return _solid(materials.rings)
    solids = (_solid(material) for material in materials.of_rings)
    return Solid(*(jnp.asarray(pair, dtype=float)[:, None] for pair in zip(*solids, strict=True)))


def _joined(flanks: Sequence[Array]) -> Array:
    """Joins the values of the contacts of all flanks; the first axis is the race."""
    return flanks[0] if len(flanks) == 1 else jnp.concatenate(flanks, axis=1)


def _contacts(scene: AbstractBearing, elements: Any) -> ContactHeat:
    """Heat transfer of the raceway contacts from the ring to the element; the first axis is the race."""
    operation = scene.operation
    both = lambda name: jnp.stack([getattr(elements, f"{name}_inner"), getattr(elements, f"{name}_outer")])
    load, film = both("load"), both("film")
    angle = both("contact_angle") if hasattr(elements, "contact_angle_inner") else jnp.zeros((2, 1))
    tilt = getattr(elements, "attitude_angle", None)
    rolling = 1.0 if tilt is None else jnp.cos(angle - tilt[None])
    diameter = scene.element_diameter
    radius = 0.5 * (scene.geometry.pitch_diameter + jnp.asarray([[-1.0], [1.0]]) * diameter * jnp.cos(angle))
    ring_speed = jnp.stack([jnp.asarray(operation.inner_speed), jnp.asarray(operation.outer_speed)])[:, None]
    speeds = (
        (ring_speed - elements.orbital_speed[None]) * radius,
        0.5 * elements.spin_speed[None] * diameter * rolling,
    )
    oil = scene.oil.conductivity
    own = scene.oil_temperatures
    assert own is not None
    conductivity = oil.conductivity(jnp.stack([jnp.asarray(own.inner_raceway), jnp.asarray(own.outer_raceway)]))
    bodies = (_solid_of_rings(scene.materials), _solid(scene.materials.elements))
    points, lines = scene.point_contacts(elements), scene.race_lines(elements)
    # an unloaded contact has the size 0
    some = load > 0.0
    pressing = jnp.where(some, load, 1.0)
    if points is not None:
        ellipse = points.ellipse(pressing)
        sizes = (jnp.where(some, ellipse.rolling, 0.0), jnp.where(some, ellipse.transverse, 0.0))
        return ellipse_contact_heat(*sizes, film, conductivity[:, None], bodies, speeds)
    assert lines is not None
    width = jnp.where(some, lines.half_width(pressing), 0.0)
    return line_contact_heat(width, lines.length, film, conductivity[:, None], bodies, speeds)


def _between(
    scene: AbstractBearing,
    thermal: Thermal,
    solution: Solution,
    contacts: ContactHeat,
    temperatures: Mapping[str, Array],
) -> dict[tuple[str, str], Scalar]:
    """Conductances between the nodes, W/K."""
    geometry, conductance = scene.geometry, thermal.conductance
    through = jnp.sum(contacts.conductance, axis=1) + oil_filling_conductance(
        scene.materials.elements.conductivity, scene.element_diameter, scene.n_elements
    )
    inner, outer = scene.raceway_diameters
    transfer, fit = _oil_transfer(scene, solution, temperatures["oil"]), solution.fit
    gap = lambda name: 0.0 if fit is None or getattr(fit, name) is None else -getattr(fit, name)
    width = geometry.width
    computed = {
        ("inner_ring", "elements"): lambda: through[0],
        ("outer_ring", "elements"): lambda: through[1],
        ("inner_ring", "oil"): lambda: transfer() * ring_surface(inner, width),
        ("outer_ring", "oil"): lambda: transfer() * ring_surface(outer, width),
        ("elements", "oil"): lambda: transfer() * _surface(scene),
        ("housing", "oil"): lambda: 0.0,
        ("inner_ring", "shaft"): lambda: seat_conductance(geometry.bore, width, gap("interference_inner")),
        ("outer_ring", "housing"): lambda: seat_conductance(
            geometry.outside_diameter, width, gap("interference_outer")
        ),
    }
    conductances = {}
    for pair, compute in computed.items():
        if not set(pair) <= set(temperatures):
            continue
        own = getattr(conductance, "_".join(pair))
        group = "contacts" if pair[1] == "elements" else "oil" if pair[1] == "oil" else "seats"
        conductances[pair] = getattr(thermal.factor, group) * (compute() if own is None else own)
    return conductances


def _surface(scene: AbstractBearing) -> Array:
    length = None if not scene.line_contacts else scene.geometry.roller_length
    return elements_surface(scene.element_diameter, scene.n_elements, length)


def _oil_transfer(scene: AbstractBearing, solution: Solution, temperature: Array) -> Callable[[], Array]:
    """Function that computes the heat transfer coefficient from the oil to rings and elements, W/(m^2 K). It is called
    only if a conductance is needed, because the scene may lack its inputs otherwise."""

    def transfer() -> Array:
        oil: InletOil = scene.oil.at(temperature)
        capacity = scene.oil.heat_capacity.heat_capacity(temperature)
        pitch = scene.geometry.pitch_diameter
        orbit = jnp.mean(solution.elements.orbital_speed) if solution.cage is None else solution.cage.speed
        prandtl = oil.viscosity * capacity / oil.conductivity
        return oil_heat_transfer(0.5 * pitch * orbit, pitch, oil.conductivity, prandtl, oil.viscosity / oil.density)

    return transfer


def _to_ambient(scene: AbstractBearing, thermal: Thermal) -> dict[str, Scalar]:
    """Conductances of the nodes to the ambient, without the law of a housing in air, W/K."""
    conductances = {}
    for node in OUTSIDE[thermal.nodes]:
        own = getattr(thermal.conductance, f"{node}_ambient")
        conductances[node] = thermal.factor.ambient * (_seat_to_ambient(scene, thermal, node) if own is None else own)
    return conductances


def _seat_to_ambient(scene: AbstractBearing, thermal: Thermal, node: str) -> Scalar:
    """Conductance from a node to the ambient through its seats, W/K, from the reference heat flow of ISO 15312, split
    between the seats by their areas. The outer seat counts as 0 if a housing in air is given, which has its own law."""
    geometry = scene.geometry
    area = radial_seat_area(geometry.bore, geometry.outside_diameter, geometry.width)
    whole = reference_conductance(area)
    inside = whole * geometry.bore / (geometry.bore + geometry.outside_diameter)
    outside = 0.0 if thermal.housing_diameter is not None else whole - inside
    if node == "bearing":
        return inside + outside
    return inside if node in ("inner_ring", "shaft") else outside


def heat_capacities(scene: AbstractBearing) -> Float[Array, " node"] | None:
    """Heat capacities of the nodes, J/K; `None` if one of them is not known."""
    capacities = [value for _, value in _capacities(scene)]
    if any(capacity is None for capacity in capacities):
        return None
    return jnp.stack([jnp.asarray(capacity, dtype=float) for capacity in capacities])


def unknown_capacities(scene: AbstractBearing) -> tuple[str, ...]:
    """Names of the nodes whose heat capacity is not known."""
    return tuple(name for name, value in _capacities(scene) if value is None)


def _capacities(scene: AbstractBearing) -> list[tuple[str, Scalar | None]]:
    """Name and heat capacity, J/K, of each node; `None` for an unknown heat capacity."""
    thermal = thermal_of(scene)
    parts: dict[str, Scalar] = _own_capacities(scene)
    parts |= {name: value for name, value in vars(thermal.capacity).items() if value is not None}
    inside = [parts.get(name) for name in NODES[4]]
    if "bearing" not in parts and all(capacity is not None for capacity in inside):
        parts["bearing"] = jnp.sum(jnp.stack([jnp.asarray(capacity, dtype=float) for capacity in inside]))
    return [(name, parts.get(name)) for name in thermal.node_names]


def _own_capacities(scene: AbstractBearing) -> dict[str, Scalar]:
    """Heat capacities of rings, elements and oil, J/K, as far as they follow from the scene."""
    geometry, rings, balls, oil = scene.geometry, scene.materials.of_rings, scene.materials.elements, scene.oil
    sizes = (geometry.bore, geometry.outside_diameter, geometry.width)
    if any(size is None for size in sizes) or any(material.heat_capacity is None for material in (*rings, balls)):
        return {}
    inner, outer = scene.raceway_diameters
    of_ring = [(geometry.width, ring.density, ring.heat_capacity) for ring in rings]
    element_volume = math.pi / 6.0 * jnp.power(scene.element_diameter, 3.0)
    if scene.line_contacts:
        element_volume = 0.25 * math.pi * jnp.square(scene.element_diameter) * geometry.roller_length
    volume = scene.n_elements * element_volume
    capacities = {
        "inner_ring": ring_capacity(geometry.bore, inner, *of_ring[0]),
        "outer_ring": ring_capacity(outer, geometry.outside_diameter, *of_ring[1]),
        "elements": volume * balls.density * balls.heat_capacity,
    }
    if has_flow(scene):
        operation, inlet = scene.operation, inlet_temperature(scene)
        speed = safe_norm(operation.inner_speed, operation.outer_speed)
        fraction = saturated_oil_fraction(operation.oil_flow, speed, geometry.pitch_diameter)
        free = 0.25 * math.pi * (jnp.square(outer) - jnp.square(inner)) * geometry.width - volume
        capacities["oil"] = oil_capacity(
            fraction, jnp.maximum(free, 0.0), oil.density.density(inlet), oil.heat_capacity.heat_capacity(inlet)
        )
    return capacities
