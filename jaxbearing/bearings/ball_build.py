"""From a ball bearing scene to its equations, with everything prepared that does not depend on the unknowns."""

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..gaps import (
    ReynoldsDrag,
    RollerDrag,
    ShortJournal,
    air_density,
    ball_frontal_area,
    mixture_density,
    saturated_oil_fraction,
)
from ..gaps.ball_pocket import BallPocket
from ..materials import reduced_modulus
from ..numerics.newton import NewtonResult
from ..numerics.safe import safe_norm
from .ball_bearing import BallBearing
from .ball_core import LENGTH_UNIT, BallCore, Grooves
from .ball_equations import BallCageParts, BallDrag, BallGuess, LubricatedBallSystem
from .ball_kinematics import BallKinematics
from .gyroscopic import AbstractGyroscopic, ResolvedCouple

SMALLEST_GUESS = 1e-3
"""Load of an inner contact that the frictionless bearing has lost, over a ball's load scale, where the films start."""


class Row(NamedTuple):
    """The balls that are solved for, and how the ring's freedoms move their inner groove centres."""

    azimuth: Float[Array, " ball"]
    directions: Float[Array, "freedom 2 ball"]
    held: Float[Array, "2 ball"]
    load: Float[Array, " freedom"]
    freedoms: tuple[str, ...]
    multiplicity: int


def ring_directions(azimuth: Array) -> dict[str, Array]:
    """Change of the inner groove centre, (axial, radial), for a unit of each freedom; a unit of tilt is R_i."""
    zero, one = jnp.zeros_like(azimuth), jnp.ones_like(azimuth)
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    return {
        "axial": jnp.stack([one, zero]),
        "radial": jnp.stack([zero, cosine]),
        "lateral": jnp.stack([zero, sine]),
        "tilt": jnp.stack([cosine, zero]),
        "tilt_lateral": jnp.stack([sine, zero]),
    }


def ball_row(scene: BallBearing) -> Row:
    """All balls, or one for all where they are alike."""
    operation, geometry = scene.operation, scene.geometry
    count = 1 if operation.symmetric else geometry.n_balls
    azimuth = jnp.asarray(2.0 * np.pi * np.arange(count) / count)
    directions = ring_directions(azimuth)
    number = lambda value: jnp.asarray(0.0 if value is None else value)
    lever = geometry.groove_circle_radius
    loads = {"axial": number(operation.axial_load), "radial": number(operation.radial_load)}
    loads["tilt"] = number(operation.moment) / lever
    freedoms = scene.ring_freedom
    tilt = number(operation.misalignment) if operation.moment is None else jnp.zeros(())
    return Row(
        azimuth=azimuth,
        directions=jnp.stack([directions[name] for name in freedoms]),
        held=tilt * lever * directions["tilt"],
        load=jnp.stack([loads[name] for name in freedoms]),
        freedoms=freedoms,
        multiplicity=geometry.n_balls // count,
    )


def ball_grooves(scene: BallBearing) -> Grooves:
    geometry = scene.geometry
    modulus = reduced_modulus(scene.materials.rings, scene.materials.balls)
    return Grooves(
        offset=jnp.stack([geometry.inner_offset, geometry.outer_offset]),
        stiffness=geometry.free_contacts(modulus).stiffness_constant(),
        centre_distance=jnp.asarray(geometry.centre_distance),
        free_cosine=jnp.asarray(geometry.free_cosine),
        free_sine=jnp.asarray(geometry.free_sine),
        lever=jnp.asarray(geometry.groove_circle_radius),
        groove_arm=jnp.asarray(geometry.conformity_inner * geometry.ball_diameter),
    )


def _common(scene: BallBearing) -> dict[str, Any]:
    geometry, operation, row = scene.geometry, scene.operation, ball_row(scene)
    density = jnp.asarray(scene.materials.balls.density)
    return {
        "kinematics": BallKinematics(
            jnp.asarray(operation.inner_speed),
            jnp.asarray(operation.outer_speed),
            jnp.asarray(geometry.pitch_diameter),
            jnp.asarray(geometry.ball_diameter),
        ),
        "grooves": ball_grooves(scene),
        "directions": row.directions,
        "held": row.held,
        "ring_load": row.load,
        "mass": geometry.mass(density),
        "inertia": geometry.inertia(density),
        "freedoms": row.freedoms,
        "multiplicity": row.multiplicity,
    }


def build_core(scene: BallBearing) -> BallCore:
    """The bearing without friction on the raceways and without films."""
    attitude, gyroscopic = scene.kinematics.attitude, scene.kinematics.gyroscopic
    return BallCore(
        **_common(scene),
        attitude="inner" if attitude == "inner" else "outer",
        gyroscopic=gyroscopic if isinstance(gyroscopic, AbstractGyroscopic) else None,
    )


def build_lubricated(scene: BallBearing, core: BallCore, found: NewtonResult) -> LubricatedBallSystem:
    """The lubricated bearing, to start from what was found without friction."""
    assert scene.contact is not None
    assert scene.oil is not None
    gyroscopic = scene.kinematics.gyroscopic
    return LubricatedBallSystem(
        **_common(scene),
        geometry=scene.geometry,
        reduced_modulus=reduced_modulus(scene.materials.rings, scene.materials.balls),
        laws=scene.contact,
        oil=scene.oil,
        inlet=scene.oil.at(scene.operation.oil_temperature),
        azimuth=ball_row(scene).azimuth,
        guess=_guess(core, found),
        couple_share=jnp.ones(()),
        attitude=scene.kinematics.attitude,
        resolved=isinstance(gyroscopic, ResolvedCouple),
        gyroscopic=gyroscopic if isinstance(gyroscopic, AbstractGyroscopic) else None,
        cage=_cage_parts(scene) if scene.slips and scene.cage is not None else None,
        drag=_drag(scene) if scene.slips and scene.drag is not None else None,
    )


def _guess(core: BallCore, found: NewtonResult) -> BallGuess:
    count = core.held.shape[1]
    shared = jnp.broadcast_to(found.point.globals[:, None], (len(core.freedoms), count))
    state = core.balls(found.point.elements, shared)
    inner, outer = state.angle
    least = SMALLEST_GUESS * core.ball_scale()
    between = 0.5 * (core.kinematics.inner_control(inner) + core.kinematics.outer_control(outer))
    guess = BallGuess(jnp.log(jnp.maximum(state.load[0], least)), inner, between, found.point.globals * LENGTH_UNIT)
    return jax.lax.stop_gradient(jax.tree.map(lambda leaf: jnp.where(jnp.isfinite(leaf), leaf, 0.0), guess))


def _cage_parts(scene: BallBearing) -> BallCageParts:
    cage, geometry = scene.cage, scene.geometry
    assert cage is not None
    diameter = cage.bore(geometry) if cage.guidance == "inner_ring" else cage.outside(geometry)
    return BallCageParts(
        pocket=BallPocket(
            clearance=jnp.asarray(cage.pocket_clearance), ball_radius=0.5 * jnp.asarray(geometry.ball_diameter)
        ),
        land=ShortJournal(
            radius=0.5 * jnp.asarray(diameter),
            width=jnp.asarray(cage.land_width),
            clearance=jnp.asarray(cage.guiding_clearance) / 2.0,
            turbulence=cage.turbulence,
            n_lands=cage.lands,
        ),
        guidance=cage.guidance,
    )


def _drag(scene: BallBearing) -> BallDrag:
    operation, geometry, drag, oil = scene.operation, scene.geometry, scene.drag, scene.oil
    assert drag is not None
    assert oil is not None
    assert oil.density is not None
    fraction = saturated_oil_fraction(
        operation.oil_flow,
        safe_norm(operation.inner_speed, operation.outer_speed),
        geometry.pitch_diameter,
        drag.through_flow_fraction,
    )
    temperature = jnp.asarray(operation.oil_temperature)
    thickness = 0.0
    if scene.cage is not None:
        thickness = (scene.cage.outside(geometry) - scene.cage.bore(geometry)) / 2.0
    area = jnp.asarray(ball_frontal_area(geometry.ball_diameter, thickness))
    diameter = jnp.asarray(geometry.ball_diameter)
    law: ReynoldsDrag | RollerDrag = ReynoldsDrag(diameter=diameter, area=area, shape="sphere")
    if drag.coefficient is not None:
        law = RollerDrag(coefficient=jnp.asarray(drag.coefficient), area=area)
    return BallDrag(law, mixture_density(fraction, oil.density.density(temperature), air_density(temperature)))
