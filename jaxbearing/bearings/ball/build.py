"""From a ball bearing scene to its equations, with everything prepared that does not depend on the unknowns."""

import dataclasses
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...gaps import ReynoldsDrag, RollerDrag, ball_frontal_area
from ...gaps.ball_pocket import BallPocket
from ...materials import reduced_modulus
from ...numerics.arrow import ArrowPoint
from ...numerics.safe import safe_norm
from ..inlet import oil_elsewhere, oil_of_races, oil_temperature
from ..parts import azimuths, drag_density
from ..ring import LENGTH_UNIT, InnerRing, inner_ring
from .core import FORCE_FLOOR, BallCore
from .equations import LubricatedBallSystem
from .gyroscopic import AbstractGyroscopic, ResolvedCouple
from .kinematics import BallKinematics
from .scene import BallBearing
from .start import together
from .state import BallCageParts, BallDrag, BallGuess
from .system import Grooves

SMALLEST_GUESS = 1e-3
"""Load of an inner contact that the frictionless bearing has lost, over a ball's load scale, where the films start."""
CONTROL_AT_EQUAL_LOADS, CONTROL_BY_LOAD = -1.6, 8.0
"""First guess of outer race control: its logit, and by how much that rises with ln(Qo/Qi), from a few solved bearings
(5-50 kN, 5 000-20 000 rpm); a start of the iteration and nothing else."""


class Row(NamedTuple):
    """The balls that are solved for, how the inner ring may move, and how that moves their inner groove centres,
    (axial, radial), m: `directions` for a unit of its unknowns, `held_shift` by what it is held at."""

    azimuth: Float[Array, " ball"]
    ring: InnerRing
    directions: Float[Array, "freedom 2 ball"]
    held_shift: Float[Array, "2 ball"]
    multiplicity: int


def ring_directions(azimuth: Float[Array, " ball"]) -> Float[Array, "5 2 ball"]:
    """Change of the inner groove centre, (axial, radial), for a unit of each of `RING_FREEDOMS`; a unit of tilt is
    R_i."""
    zero, one = jnp.zeros_like(azimuth), jnp.ones_like(azimuth)
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    return jnp.stack(
        [jnp.stack(pair) for pair in ((one, zero), (zero, cosine), (zero, sine), (cosine, zero), (sine, zero))]
    )


def ball_row(scene: BallBearing, ring: InnerRing | None = None) -> Row:
    """All balls, or one for all where they are alike; with the ring of the scene, or with another one."""
    operation, geometry = scene.operation, scene.geometry
    azimuth = azimuths(geometry, geometry.n_balls, operation.symmetric and ring is None)
    if ring is None:
        ring = inner_ring(scene, geometry.groove_circle_radius)
    every = ring_directions(azimuth)
    held_shift = jnp.einsum("f,fcn->cn", ring.held, every)
    return Row(azimuth, ring, ring.of_unknown(every), held_shift, geometry.n_balls // azimuth.size)


def ball_grooves(scene: BallBearing, expansion: Float[Array, ""] | None = None) -> Grooves:
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
        expansion=expansion,
    )


def build_core(scene: BallBearing, exact: bool | None = None, ring: InnerRing | None = None) -> BallCore:
    """The bearing without friction on the raceways and without films.

    **Arguments:** `exact`: whether the grooves move with the exact rotation of the ring; not given: where the ring can
    tilt; `ring`: another one than the scene's, all balls then.
    """
    geometry, operation, row = scene.geometry, scene.operation, ball_row(scene, ring)
    grooves = ball_grooves(scene, row.ring.expansion)
    density = jnp.asarray(scene.materials.balls.density)
    attitude, gyroscopic = scene.kinematics.attitude, scene.kinematics.gyroscopic
    return BallCore(
        kinematics=BallKinematics(
            jnp.asarray(operation.inner_speed),
            jnp.asarray(operation.outer_speed),
            jnp.asarray(geometry.pitch_diameter),
            jnp.asarray(geometry.ball_diameter),
        ),
        grooves=grooves,
        directions=row.directions,
        azimuth=row.azimuth,
        ring=row.ring.asking(_held_load(grooves, row)) if row.ring.asks else row.ring,
        held_shift=row.held_shift,
        mass=geometry.mass(density),
        inertia=geometry.inertia(density),
        gyroscopic=gyroscopic if isinstance(gyroscopic, AbstractGyroscopic) else None,
        couple_share=jnp.ones(()),
        multiplicity=row.multiplicity,
        attitude="inner" if attitude == "inner" else "outer",
        exact=operation.tilts if exact is None else exact,
        common_orbit=scene.kinematics.orbit == "common",
    )


def _held_load(grooves: Grooves, row: Row) -> Float[Array, ""]:
    """Estimates the load that the given displacements of the ring ask for, N."""
    rest = grooves.rest + row.held_shift
    approach = jnp.maximum(safe_norm(rest[0], rest[1]) - jnp.sum(grooves.offset), 0.0)
    load = together(grooves.stiffness) * approach**1.5 + FORCE_FLOOR
    return row.multiplicity * jnp.sum(load)


def build_lubricated(scene: BallBearing, core: BallCore, guess: BallGuess | None = None) -> LubricatedBallSystem:
    """The lubricated bearing of the same balls as `core`, to start from the first guess of that or from a given one."""
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
        inlet=oil_of_races(scene),
        elsewhere=oil_elsewhere(scene),
        **(_guesses(core, scene.slips) if guess is None else {"guess": guess}),
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
    easiest = core.ring.load * core.heavier
    loads, points = jax.tree.map(lambda a, b: jnp.stack([a, b]), (core.ring.load, guess), (easiest, heavy))
    under = lambda load: dataclasses.replace(core, ring=core.ring.under(load))
    both = jax.vmap(lambda load, point: _guess(under(load), point))(loads, points)
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
    # a ball beyond the centre of its inner groove: in a film thicker than the groove's radius, on the near side
    inner = jnp.where(jnp.abs(inner) > 0.5 * jnp.pi, inner - jnp.pi * jnp.sign(inner), inner)
    guess = BallGuess(log_load[0], inner, high + control * (low - high), ring)
    return jax.lax.stop_gradient(jax.tree.map(lambda leaf: jnp.where(jnp.isfinite(leaf), leaf, 0.0), guess))


def _cage_parts(scene: BallBearing) -> BallCageParts:
    cage, geometry = scene.cage, scene.geometry
    assert cage is not None
    pocket = BallPocket(
        clearance=jnp.asarray(cage.pocket_clearance),
        ball_radius=0.5 * jnp.asarray(geometry.ball_diameter),
        superposition=cage.pocket_superposition,
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
    fraction, temperature = drag.through_flow_fraction, oil_temperature(scene, "drag")
    return BallDrag(law, drag_density(oil, scene.operation, geometry.pitch_diameter, fraction, temperature))
