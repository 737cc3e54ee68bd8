"""Range checks of a transient run of a ball bearing: the checks of `bearings.checks`, over all instants together."""

from collections.abc import Callable

import jax
import jax.numpy as jnp
from jaxtyping import Array

from ...checks import result_excess
from ...facts import MEAN_OF_POINT, RACEWAYS, Contacts, Excess, Facts
from ...motion.checks import AT_SOME_TIME
from ...solution import RING_FREEDOMS, CageState, RingDisplacement
from ..kinematics import BallKinematics, BallMotion
from ..scene import BallBearing
from .results import BallInstant


def run_excess(scene: BallBearing, instants: BallInstant) -> Excess:
    """Excess of the results of a run over the validity ranges of laws and bearings: a dictionary from the text of each
    check to the largest excess of all instants, positive if the check fails. Pure.

    **Arguments:** `instants`: instants of a run or of a part of it, with the time as first axis of every array. The
    contacts of a raceway at all these times are checked together: a contact counts if it carries a certain part of the
    largest load among them. Instants with a load that is not finite, at which a run breaks off, do not count.
    """
    oil, elements = scene.oil, instants.elements
    assert oil is not None
    mean_speed = jax.vmap(lambda *moving: _mean_speeds(scene, *moving), out_axes=1)(
        jnp.asarray(instants.inner_speed),
        BallMotion(
            *(
                jnp.asarray(getattr(elements, name))
                for name in ("orbital_speed", "spin_speed", "attitude_angle", "transverse_spin")
            )
        ),
        jnp.asarray(elements.contact_angle_inner),
        jnp.asarray(elements.contact_angle_outer),
    )
    inlet = oil.at(jnp.asarray(scene.operation.oil_temperature))
    together: Callable[..., Array] = lambda *races: jnp.stack([jnp.reshape(jnp.asarray(race), -1) for race in races])
    rise = (elements.temperature_rise_inner, elements.temperature_rise_outer)
    load = together(elements.load_inner, elements.load_outer)
    contacts = Contacts(
        RACEWAYS,
        jnp.where(jnp.isfinite(load), load, 0.0),
        together(elements.pressure_inner, elements.pressure_outer),
        MEAN_OF_POINT,
        laws=scene.contact,
        inlet=inlet,
        mean_speed=together(*mean_speed),
        sliding=together(elements.sliding_inner, elements.sliding_outer),
        temperature=None if rise[0] is None else inlet.temperature + together(*rise),
        angle=together(elements.contact_angle_inner, elements.contact_angle_outer),
    )
    largest = {name: jnp.nanmax(jnp.abs(jnp.asarray(getattr(instants.ring, name)))) for name in RING_FREEDOMS}
    own, zero = instants.cage, jnp.zeros(())
    cage = None if own is None else CageState(zero, zero, jnp.nanmax(jnp.asarray(own.eccentricity_ratio)), zero)
    excess = result_excess(scene, Facts((contacts,)), RingDisplacement(**largest), cage)
    return {type(text)(AT_SOME_TIME + text): value for text, value in excess.items()}


def _mean_speeds(
    scene: BallBearing, inner_speed: Array, motion: BallMotion, inner_angle: Array, outer_angle: Array
) -> Array:
    """Entrainment speeds of all balls on both races at one time, m/s."""
    geometry, operation = scene.geometry, scene.operation
    sizes = (operation.outer_speed, geometry.pitch_diameter, geometry.ball_diameter)
    kinematics = BallKinematics(inner_speed, *(jnp.asarray(size) for size in sizes))
    return kinematics.races(motion, jnp.stack([inner_angle, outer_angle])).mean_speed
