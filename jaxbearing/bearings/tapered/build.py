"""Builds the equations of a tapered roller bearing from its scene."""

import dataclasses
from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..elastic_ring import BentRings, elastic_ring
from ..parts import azimuths
from ..profile import pressed_load, roller_line
from ..ring import InnerRing, inner_ring
from ..ring_shape import shaped_parts
from .geometry import TaperedGeometry
from .scene import TaperedOperation, TaperedRollerBearing
from .system import Inertia, TaperedForm, TaperedSystem


class TaperedMotion(NamedTuple):
    """Orbital speed of the rollers and their spin relative to the orbiting frame, rad/s. Both are positive in normal
    running."""

    orbital_speed: Array
    spin_speed: Array


class RollerBody(NamedTuple):
    """Mass of a roller, kg, distance of its centre of mass from the big end, m, and its moments of inertia about and
    across its axis, through the centre of mass, kg m^2."""

    mass: Array
    centre: Array
    axial: Array
    transverse: Array


def rolling_motion(geometry: TaperedGeometry, operation: TaperedOperation) -> TaperedMotion:
    r"""Orbital speed $\omega_m = (\omega_i\sin\alpha_i + \omega_o\sin\alpha_o)/(\sin\alpha_i + \sin\alpha_o)$ and spin
    $\omega_s = (\omega_m - \omega_o)\sin\alpha_o/\sin\epsilon$ of the rollers."""
    inner, outer = jnp.sin(geometry.cone_angle), jnp.sin(jnp.asarray(geometry.contact_angle))
    orbit = (operation.inner_speed * inner + operation.outer_speed * outer) / (inner + outer)
    return TaperedMotion(orbit, (orbit - operation.outer_speed) * outer / jnp.sin(geometry.roller_half_angle))


def roller_body(geometry: TaperedGeometry, density: Array) -> RollerBody:
    """Mass and inertia of a roller. It is a frustum from the big end to the end of the contact, without the spherical
    cap."""
    big = 0.5 * jnp.asarray(geometry.roller_diameter)
    length = geometry.roller_length * jnp.cos(geometry.roller_half_angle)
    small = big - geometry.roller_length * jnp.sin(geometry.roller_half_angle)
    squares = big**2 + big * small + small**2
    mass = jnp.pi * density * length * squares / 3.0
    centre = length * (big**2 + 2.0 * big * small + 3.0 * small**2) / (4.0 * squares)
    fourth = sum(big ** (4 - k) * small**k for k in range(5)) / 5.0
    axial = 0.5 * jnp.pi * density * length * fourth
    second = jnp.pi * density * length**3 * (big**2 + 3.0 * big * small + 6.0 * small**2) / 30.0
    return RollerBody(mass, centre, axial, 0.5 * axial + second - mass * centre**2)


def roller_inertia(geometry: TaperedGeometry, body: RollerBody, motion: TaperedMotion) -> Inertia:
    r"""Centrifugal force $F_c = m\omega_m^2(Y_b - l_c\sin\gamma)$ and gyroscopic moment $M_g =
    \omega_m\sin\gamma[I_a(\omega_s - \omega_m\cos\gamma) + I_t\omega_m\cos\gamma]$ of a roller. The moment pushes the
    small end inwards."""
    orbit, sine, cosine = motion.orbital_speed, jnp.sin(geometry.axis_angle), jnp.cos(geometry.axis_angle)
    force = body.mass * jnp.square(orbit) * (geometry.big_end_radius - body.centre * sine)
    spinning = body.axial * (motion.spin_speed - orbit * cosine)
    return Inertia(force, body.centre, orbit * sine * (spinning + body.transverse * orbit * cosine))


def tapered_form(geometry: TaperedGeometry) -> TaperedForm:
    half, flange = jnp.asarray(geometry.roller_half_angle), jnp.asarray(geometry.rib_angle)
    a_s, r_s = geometry.sphere_centre
    return TaperedForm(
        sine=jnp.sin(half),
        cosine=jnp.cos(half),
        cone_angle=geometry.cone_angle,
        cup_angle=jnp.asarray(geometry.contact_angle),
        axis_angle=geometry.axis_angle,
        flange_angle=flange,
        flange_tilt=geometry.flange_tilt,
        offset=0.5 * geometry.roller_diameter * jnp.sin(half),
        apex_distance=geometry.apex_distance,
        end_height=geometry.end_height,
        flange_arm=-r_s * jnp.cos(flange) - a_s * jnp.sin(flange),
    )


def ring_columns(azimuth: Float[Array, " roller"], lever: Array, load_position: Array) -> Float[Array, "5 3 roller"]:
    """Motion (Da, Dr, t) of the cone at every roller, as in `system`, for a unit of each degree of freedom in
    `RING_FREEDOMS` at the reference point. The unit of a tilt is a length: the tilt times `lever`, m."""
    zero, one = jnp.zeros_like(azimuth), jnp.ones_like(azimuth)
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    # a tilt that moves azimuth 0 along +a is -t; it turns about the reference point and moves the apex radially
    tilt = jnp.stack([zero, load_position * cosine, -cosine]) / lever
    tilt_lateral = jnp.stack([zero, load_position * sine, -sine]) / lever
    shifts = [jnp.stack(motion) for motion in ((one, zero, zero), (zero, cosine, zero), (zero, sine, zero))]
    return jnp.stack([*shifts, tilt, tilt_lateral])


def build_tapered(scene: TaperedRollerBearing, ring: InnerRing | None = None) -> TaperedSystem:
    """Equations of a scene.

    **Arguments:** `ring`: inner ring to use instead of the one at the operating point. The equations then have all
    rollers, also under a purely axial load.
    """
    geometry, operation = scene.geometry, scene.operation
    # rollers that are all alike are one; the forces of a cage are sums over all of them
    alike = operation.symmetric and not shaped_parts(scene) and ring is None and not scene.slips
    azimuth = azimuths(geometry, geometry.n_rollers, alike)
    lever = geometry.apex_distance
    columns = ring_columns(azimuth, lever, jnp.asarray(operation.load_position))
    if ring is None:
        ring = inner_ring(scene, lever)
    modulus = scene.materials.race_modulus
    length = jnp.asarray(geometry.roller_length)
    body = roller_body(geometry, jnp.asarray(scene.materials.rollers.density))
    held = jnp.einsum("f,fcn->cn", ring.held, columns)
    bent = _bending_rings(scene, azimuth)
    system = TaperedSystem(
        form=tapered_form(geometry),
        line=roller_line(scene.profile, modulus, length),
        flange_stiffness=geometry.flange_contact(modulus).stiffness_constant(),
        inertia=roller_inertia(geometry, body, rolling_motion(geometry, operation)),
        columns=ring.of_unknown(columns),
        held=held if ring.expansion is None else held.at[1].add(ring.expansion),
        ring=ring,
        outer=bent.outer,
        inner=bent.inner,
        out_of_round=_out_of_round(scene, azimuth),
        closing=scene.closing,
        guess=None,
        seated=None,
        multiplicity=geometry.n_rollers // azimuth.size,
    )
    if not ring.needs_held_load:
        return system
    return dataclasses.replace(system, ring=ring.with_held_load(_held_load(system)))


def _bending_rings(scene: TaperedRollerBearing, azimuth: Float[Array, " roller"]) -> BentRings:
    """The flexible rings of a scene, of cup and cone."""
    rings, (inner, outer) = scene.materials.of_rings, scene.raceway_diameters
    return BentRings(
        elastic_ring(scene.outer_ring, rings[1], outer, scene.ring_width, azimuth),
        elastic_ring(scene.inner_ring, rings[0], inner, scene.ring_width, azimuth),
    )


def _out_of_round(scene: TaperedRollerBearing, azimuth: Float[Array, " roller"]) -> Float[Array, "2 roller"] | None:
    """Change of the approaches of inner and outer race by raceways that are not round, m; `None` if both are round."""
    inner, outer = scene.inner_roundness, scene.outer_roundness
    if inner is None and outer is None:
        return None
    nothing = jnp.zeros_like(azimuth)
    closing = nothing if inner is None else inner.deviation(azimuth) * jnp.cos(scene.geometry.cone_angle)
    opening = (
        nothing if outer is None else outer.deviation(azimuth) * jnp.cos(jnp.asarray(scene.geometry.contact_angle))
    )
    return jnp.stack([closing, -opening])


def _held_load(system: TaperedSystem) -> Float[Array, ""]:
    """Estimates the load that the given displacements of the ring cause, N."""
    pressed = system.pressed(system.held)
    if system.out_of_round is not None:
        pressed = pressed + jnp.sum(system.out_of_round, axis=0)
    load = system.multiplicity * jnp.sum(
        pressed_load(jnp.asarray(system.line.stiffness), jnp.asarray(system.line.length), pressed, system.held[2])
    )
    return load if system.outer is None else load + system.outer.given_load()
