"""Range checks of ball bearings, in addition to those of all bearings."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..facts import LOADED, Contacts, Excess, RangeChecks, SolvedBearing

if TYPE_CHECKING:
    from .scene import BallBearing
else:
    BallBearing = Any


def _angles(result: SolvedBearing) -> Excess:
    scene = result.scene

    def leaning(contacts: Contacts) -> Excess:
        if contacts.angle is None:
            return {}
        # in the model the cross-section of each arc is a full circle
        text = "a loaded ball touches the groove of {place} beyond 90°, where no groove is: it cannot run so"
        excess = contacts.said(text, contacts.most(jnp.abs(contacts.angle)) - 0.5 * np.pi)
        if scene.geometry.has_arcs:
            return excess | _cusps(scene, contacts)
        if scene.geometry.contact_angle is not None:
            text = "a loaded ball leans on the other shoulder of {place}: an angular-contact bearing has none there"
            excess |= contacts.said(text, contacts.most(-contacts.angle) - 1e-9)
        return excess

    return result.each(leaning)


def _cusps(scene: BallBearing, contacts: Contacts) -> Excess:
    """Range checks of rings with two arcs: contacts beyond the end of their arc, balls with more than two contacts."""
    geometry, arcs = scene.geometry, scene.geometry.arcs
    assert contacts.angle is not None
    radii = (geometry.conformity_inner * geometry.ball_diameter, geometry.conformity_outer * geometry.ball_diameter)
    excess: Excess = {}
    text = "a loaded ball touches {place} beyond the cusp between both arcs: the model is wrong there"
    for k, (race, side) in enumerate(zip(arcs.races, arcs.sides, strict=True)):
        apart = arcs[race]
        if apart is not None:
            past = contacts.most(jnp.arcsin(apart / radii[race]) - side * contacts.angle)
            excess[text.format(place=contacts.places[k])] = past[k]
    carrying = jnp.sum(contacts.load > LOADED * jnp.max(contacts.load), axis=0, dtype=float)
    text = "balls with more than two contacts under load slide: friction and wear rise, as with mainly radial load"
    return excess | {text: jnp.max(carrying) - 2.5}


def missing_thrust(scene: BallBearing) -> Float[Array, ""]:
    r"""Axial load that an angular contact bearing lacks to have half of its balls loaded, $1.22F_r\tan\alpha - |F_a|$,
    N; negative if it has more (Harris, *Rolling Bearing Analysis*)."""
    operation, geometry = scene.operation, scene.geometry
    axial = jnp.asarray(0.0 if operation.axial_load is None else operation.axial_load)
    return 1.22 * operation.radial_size * geometry.free_sine / geometry.free_cosine - jnp.abs(axial)


def _thrust(scene: BallBearing) -> Excess:
    operation = scene.operation
    across = operation.radial_load is not None or operation.radial_load_lateral is not None
    no_side = scene.geometry.contact_angle is None or scene.geometry.has_arcs
    if no_side or operation.displaced or not across:
        return {}
    text = (
        "axial load below 1.22 F_r tan(contact angle): fewer than half of the balls of this angular contact bearing "
        "carry load; it needs an axial load or a second bearing that preloads it"
    )
    return {text: missing_thrust(scene)}


CHECKS = RangeChecks(results=(_angles,), loads=(_thrust,))
