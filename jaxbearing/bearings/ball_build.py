"""From a ball bearing scene to its equations, with everything prepared that does not depend on the unknowns."""

import dataclasses
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..gaps import ReynoldsDrag, RollerDrag, ball_frontal_area
from ..gaps.ball_pocket import BallPocket
from ..materials import reduced_modulus
from ..numerics.arrow import ArrowPoint
from .ball_bearing import BallBearing
from .ball_core import BallCore
from .ball_equations import BallCageParts, BallDrag, BallGuess, LubricatedBallSystem
from .ball_kinematics import BallKinematics
from .ball_system import LENGTH_UNIT, Grooves
from .gyroscopic import AbstractGyroscopic, ResolvedCouple
from .parts import drag_density

SMALLEST_GUESS = 1e-3
"""Load of an inner contact that the frictionless bearing has lost, over a ball's load scale, where the films start."""
CONTROL_AT_EQUAL_LOADS, CONTROL_BY_LOAD = -1.6, 8.0
"""First guess of outer race control: its logit, and by how much that rises with ln(Qo/Qi), from a few solved bearings
(5-50 kN, 5 000-20 000 rpm); a start of the iteration and nothing else."""


class Row(NamedTuple):
    """The balls that are solved for, and how the ring's freedoms move their inner groove centres."""

    azimuth: Float[Array, " ball"]
    directions: Float[Array, "freedom 2 ball"]
    held_tilt: Float[Array, ""]
    """Misalignment of a ring that does not tilt freely, times R_i, m."""
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
        held_tilt=tilt * lever,
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
        aligned=jnp.asarray(geometry.aligned),
        lever=jnp.asarray(geometry.groove_circle_radius),
        groove_arm=jnp.asarray(geometry.conformity_inner * geometry.ball_diameter),
    )


def build_core(scene: BallBearing, exact: bool | None = None) -> BallCore:
    """The bearing without friction on the raceways and without films; `exact`: whether the grooves move with the exact
    rotation of the ring; not given: where the ring can tilt."""
    geometry, operation, row = scene.geometry, scene.operation, ball_row(scene)
    density = jnp.asarray(scene.materials.balls.density)
    attitude, gyroscopic = scene.kinematics.attitude, scene.kinematics.gyroscopic
    return BallCore(
        kinematics=BallKinematics(
            jnp.asarray(operation.inner_speed),
            jnp.asarray(operation.outer_speed),
            jnp.asarray(geometry.pitch_diameter),
            jnp.asarray(geometry.ball_diameter),
        ),
        grooves=ball_grooves(scene),
        directions=row.directions,
        azimuth=row.azimuth,
        held_tilt=row.held_tilt,
        ring_load=row.load,
        mass=geometry.mass(density),
        inertia=geometry.inertia(density),
        gyroscopic=gyroscopic if isinstance(gyroscopic, AbstractGyroscopic) else None,
        couple_share=jnp.ones(()),
        freedoms=row.freedoms,
        multiplicity=row.multiplicity,
        attitude="inner" if attitude == "inner" else "outer",
        exact=scene.operation.tilts if exact is None else exact,
        common_orbit=scene.kinematics.orbit == "common",
    )


def build_lubricated(scene: BallBearing, core: BallCore) -> LubricatedBallSystem:
    """The lubricated bearing of the same balls as `core`, to start from the first guess of that."""
    assert scene.contact is not None
    assert scene.oil is not None
    motion, angle = core.kinematics, core.grooves.free_angle
    reference = motion.rolling(angle, angle, 0.5 * (motion.outer_control(angle) + motion.inner_control(angle)))
    return LubricatedBallSystem(
        **{**core.shared_fields(), "attitude": scene.kinematics.attitude},
        geometry=scene.geometry,
        reduced_modulus=reduced_modulus(scene.materials.rings, scene.materials.balls),
        laws=scene.contact,
        oil=scene.oil,
        inlet=scene.oil.at(scene.operation.oil_temperature),
        **_guesses(core, scene.slips),
        reference=reference,
        orbit_unit=motion.orbit_scale(reference.orbital_speed),
        resolved=isinstance(scene.kinematics.gyroscopic, ResolvedCouple),
        cage=_cage_parts(scene) if scene.slips and scene.cage is not None else None,
        drag=_drag(scene) if scene.slips and scene.drag is not None else None,
        common_orbit=core.common_orbit,
    )


def _guesses(core: BallCore, slips: bool) -> dict[str, Any]:
    """Makes the fields that say where the iteration starts.

    Balls that do not slide also get how much heavier the easiest load is, and the start under that."""
    guess, heavy = core.guesses()
    if slips:
        return {"guess": _guess(core, guess)}
    easiest = core.ring_load * core.heavier
    loads, points = jax.tree.map(lambda a, b: jnp.stack([a, b]), (core.ring_load, guess), (easiest, heavy))
    both = jax.vmap(lambda load, point: _guess(dataclasses.replace(core, ring_load=load), point))(loads, points)
    own, easy = (jax.tree.map(lambda leaf, i=i: leaf[i], both) for i in (0, 1))
    return {"guess": own, "heavy_guess": easy, "heavier": core.heavier}


def _guess(core: BallCore, point: ArrowPoint) -> BallGuess:
    state = core.at(point)
    inner, outer = state.direction
    least = SMALLEST_GUESS * core.ball_scale()
    log_load = jnp.log(jnp.maximum(state.load, least))
    control = jax.nn.sigmoid(CONTROL_AT_EQUAL_LOADS + CONTROL_BY_LOAD * (log_load[1] - log_load[0]))
    low, high = core.kinematics.outer_control(outer), core.kinematics.inner_control(inner)
    ring = point.globals[: len(core.freedoms)] * LENGTH_UNIT
    guess = BallGuess(log_load[0], inner, high + control * (low - high), ring)
    return jax.lax.stop_gradient(jax.tree.map(lambda leaf: jnp.where(jnp.isfinite(leaf), leaf, 0.0), guess))


def _cage_parts(scene: BallBearing) -> BallCageParts:
    cage, geometry = scene.cage, scene.geometry
    assert cage is not None
    pocket = BallPocket(
        clearance=jnp.asarray(cage.pocket_clearance), ball_radius=0.5 * jnp.asarray(geometry.ball_diameter)
    )
    return BallCageParts(pocket=pocket, land=cage.land(geometry), guidance=cage.guidance)


def _drag(scene: BallBearing) -> BallDrag:
    geometry, drag, oil = scene.geometry, scene.drag, scene.oil
    assert drag is not None
    assert oil is not None
    thickness = 0.0
    if scene.cage is not None:
        thickness = (scene.cage.outside(geometry) - scene.cage.bore(geometry)) / 2.0
    area = jnp.asarray(ball_frontal_area(geometry.ball_diameter, thickness))
    diameter = jnp.asarray(geometry.ball_diameter)
    law: ReynoldsDrag | RollerDrag = ReynoldsDrag(diameter=diameter, area=area, shape="sphere")
    if drag.coefficient is not None:
        law = RollerDrag(coefficient=jnp.asarray(drag.coefficient), area=area)
    return BallDrag(law, drag_density(oil, scene.operation, geometry.pitch_diameter, drag.through_flow_fraction))
