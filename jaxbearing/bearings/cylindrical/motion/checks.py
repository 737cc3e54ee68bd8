"""Range checks of a transient run of cylindrical rollers: the checks of `bearings.checks`, for all instants
together."""

import dataclasses
from collections.abc import Callable

import jax
import jax.numpy as jnp
from jaxtyping import Array

from ...checks import result_excess
from ...facts import MEAN_OF_LINE, RACEWAYS, Contacts, Excess, Facts
from ...motion.checks import AT_SOME_TIME
from ...solution import RING_FREEDOMS, CageState, RingDisplacement
from ..kinematics import roller_kinematics
from ..scene import CylindricalRollerBearing
from .results import RollerInstant


def run_excess(scene: CylindricalRollerBearing, instants: RollerInstant) -> Excess:
    """Excess of the results of a run over the ranges of the laws and of the bearing, largest over all instants: text ->
    number, positive where the check applies. Pure.

    All contacts on a raceway at all times are compared together. Only contacts that carry a certain fraction of the
    largest load count. Instants with a load that is not finite, at which a run breaks off, do not count.

    **Arguments:** `instants`: of a run or of a part of it, with time as the first axis of every array.
    """
    oil, elements = scene.oil, instants.elements
    assert oil is not None

    def at_once(inner_speed: Array, orbital_speed: Array, spin_speed: Array) -> tuple[Array, Array]:
        motion = roller_kinematics(scene.geometry, dataclasses.replace(scene.operation, inner_speed=inner_speed))
        return motion.surface_speeds(orbital_speed - motion.free_orbit, spin_speed - motion.free_spin)

    moving = (instants.inner_speed, elements.orbital_speed, elements.spin_speed)
    mean_speed, sliding = jax.vmap(at_once, out_axes=1)(*(jnp.asarray(speed) for speed in moving))
    inlet = oil.at(jnp.asarray(scene.operation.oil_temperature))
    together: Callable[..., Array] = lambda *races: jnp.stack([jnp.reshape(jnp.asarray(race), -1) for race in races])
    rise = (elements.temperature_rise_inner, elements.temperature_rise_outer)
    load = together(elements.load_inner, elements.load_outer)
    contacts = Contacts(
        RACEWAYS,
        jnp.where(jnp.isfinite(load), load, 0.0),
        together(elements.pressure_inner, elements.pressure_outer),
        MEAN_OF_LINE,
        laws=scene.contact,
        inlet=inlet,
        mean_speed=together(*mean_speed),
        sliding=together(*sliding),
        temperature=None if rise[0] is None else inlet.temperature + together(*rise),
    )
    zero, own = jnp.zeros(()), instants.cage
    ring = RingDisplacement(**dict.fromkeys(RING_FREEDOMS, zero))  # the ring does not tilt in a run
    cage = None if own is None else CageState(zero, zero, jnp.nanmax(jnp.asarray(own.eccentricity_ratio)), zero)
    excess = result_excess(scene, Facts((contacts,)), ring, cage)
    return {type(text)(AT_SOME_TIME + text): value for text, value in excess.items()}
