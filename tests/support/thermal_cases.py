"""Networks and losses whose temperatures are known: the losses are those of no bearing, in N mm, rpm and mm^2/s."""

import jax.numpy as jnp

from jaxbearing.lubricants import LinearDensity, WaltherRoelands
from jaxbearing.thermal.network import NODES, NodeHeat, OilFlow, network_of

# with a density of 1 kg/m^3 its dynamic viscosity is the kinematic one
OIL = WaltherRoelands(68e-6, 313.15, 8.7e-6, 373.15, LinearDensity(1.0, 0.0, 300.0))
AMBIENT, INLET = 293.15, 313.15
INNER, OUTER, ELEMENTS, FILM, SHAFT, HOUSING = NODES[6]
INSIDE = {
    (INNER, ELEMENTS): 1.2,
    (OUTER, ELEMENTS): 1.5,
    (INNER, FILM): 8.0,
    (OUTER, FILM): 9.0,
    (ELEMENTS, FILM): 12.0,
}
OUTSIDE = {(INNER, SHAFT): 6.0, (OUTER, HOUSING): 10.0, (HOUSING, FILM): 1.0}
CAPACITY = jnp.asarray([120.0, 180.0, 60.0, 40.0, 900.0, 4000.0])
FEEDBACK = {"preload": 6000.0, "f1": 6e-4, "feedback": 0.12}


def viscosity(temperature):
    """Kinematic viscosity, mm^2/s."""
    return 1e6 * jnp.exp(OIL.log_viscosity(0.0, temperature))


def one_node(conductance=2.0, mixing=1.0):
    return network_of(1, {}, {"bearing": conductance}, AMBIENT, OilFlow(20.0, INLET, mixing))


def four_nodes():
    return network_of(4, INSIDE, {OUTER: 1.5, INNER: 0.6}, AMBIENT, OilFlow(20.0, INLET))


def six_nodes(factor=1.0, capacity_rate=20.0, inlet=INLET, seat=6.0):
    inside = {**INSIDE, **OUTSIDE, (INNER, SHAFT): seat}
    stretched = {pair: factor * value for pair, value in inside.items()}
    return network_of(6, stretched, {SHAFT: 0.8, HOUSING: 3.0}, AMBIENT, OilFlow(capacity_rate, inlet))


def losses_of(size, speed=6000.0, f1=3e-4, preload=2000.0, feedback=0.0, drag=30.0, thickness=1.0):
    """Two races of which each heats its ring and the elements by half, and a drag that heats the oil.

    `feedback`: growth of the preload with the rings' difference of temperatures, 1/K; `thickness`: factor of the
    viscosity.
    """

    def losses(temperatures):
        inner, outer, elements = temperatures[jnp.asarray([0, 0, 0] if size == 1 else [0, 1, 2])]
        load = f1 * preload * 70.0 * jnp.power(jnp.maximum(1.0 + feedback * (inner - outer), 1e-9), 4.0 / 3.0)
        heat = jnp.zeros(size)
        for node, (part, ring) in enumerate(((0.55, inner), (0.45, outer))):
            thick = thickness * viscosity(0.5 * (ring + elements)) * speed
            moment = part * (2e-7 * jnp.power(thick, 2.0 / 3.0) * 70.0**3 + load)
            power = 1e-3 * moment * 2.0 * jnp.pi * speed / 60.0
            heat = heat.at[0 if size == 1 else node].add(0.5 * power).at[0 if size == 1 else 2].add(0.5 * power)
        return NodeHeat(heat.at[0 if size == 1 else 3].add(drag))

    return losses


def rings(conductance=5.0, to_ambient=10.0):
    """The least model of a fold: two rings, heat into the inner one that grows with the difference of temperatures."""
    return network_of((INNER, OUTER), {(INNER, OUTER): conductance}, {OUTER: to_ambient}, AMBIENT)


def ring_losses(size, feedback=0.02):
    def losses(temperatures):
        heat = size * jnp.square(1.0 + feedback * (temperatures[0] - temperatures[1]))
        return NodeHeat(jnp.stack([heat, jnp.zeros(())]))

    return losses
