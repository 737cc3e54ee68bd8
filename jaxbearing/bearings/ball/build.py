"""Equations of a ball bearing scene, with all quantities prepared that do not depend on the unknowns."""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...gaps import ReynoldsDrag, RollerDrag, ball_frontal_area
from ...gaps.ball_pocket import BallPocket
from ...numerics.arrow import ArrowPoint
from ...numerics.safe import safe_norm
from ..elastic_ring import BentRings, ElasticRing, elastic_ring
from ..inlet import oil_elsewhere, oil_of_races, oil_temperature
from ..parts import azimuths, drag_density
from ..ring import LENGTH_UNIT, InnerRing, inner_ring
from ..ring_shape import out_of_round, shaped_parts
from ..solution import RING_FREEDOMS
from .arched import ArchedBallSystem
from .core import FORCE_FLOOR, BallCore
from .groove_motion import RingMotion, ring_motion
from .gyroscopic import AbstractGyroscopic, ResolvedCouple
from .kinematics import BallKinematics
from .pairs import LubricatedBallSystem
from .scene import BallBearing
from .springs import together
from .state import BallCageParts, BallDrag, BallGuess, BallPlaces
from .system import Grooves

SPREAD_LOAD = 1e6
"""Load, N, at which the size of the contact ellipse is taken. It is large, as Hertz's formula is smoothed near 0."""
SMALLEST_GUESS = 1e-3
"""Least load of a contact in the first guess of the lubricated bearing, over the load scale of a ball."""
LEAST_PRESSED, MOST_PRESSED, HALVINGS = 1e-9, 1e7, 30
"""Range of the load by which films press a ball between its rings, N, and number of bisections in its logarithm."""
CONTROL_AT_EQUAL_LOADS, CONTROL_BY_LOAD = -1.6, 8.0
"""First guess of the degree of outer race control (0 to 1): its logit at equal loads, and the slope of the logit with
ln(Qo/Qi). Fitted to a few solved bearings (5-50 kN, 5 000-20 000 rpm), and used for the initial guess only."""


class Row(NamedTuple):
    """Balls of the equations, inner ring, and motion of the inner grooves with the ring. The fields are those of the
    same names in `AbstractBallSystem`."""

    azimuth: Float[Array, " ball"]
    ring: InnerRing
    directions: Float[Array, "freedom p ball"]
    held_shift: Float[Array, "p ball"]
    ring_motion: RingMotion | None
    multiplicity: int


def ring_directions(azimuth: Float[Array, " ball"], turning: Array | None = None) -> Float[Array, "5 p ball"]:
    """Derivatives of the coordinates of the inner groove (`arcs`) by each of `RING_FREEDOMS`, a tilt counted as its
    angle times R_i. **Arguments:** `turning`: e_i/R_i of an inner ring with two arcs."""
    zero, one = jnp.zeros_like(azimuth), jnp.ones_like(azimuth)
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    changes = [(one, zero), (zero, cosine), (zero, sine), (cosine, zero), (sine, zero)]
    if turning is None:
        return jnp.stack([jnp.stack(pair) for pair in changes])
    last = (zero, zero, zero, turning * cosine, turning * sine)
    return jnp.stack([jnp.stack([*pair, third]) for pair, third in zip(changes, last, strict=True)])


def row_of(
    azimuth: Float[Array, " ball"], ring: InnerRing, turning: Array | None, exact: bool, multiplicity: int
) -> Row:
    """The `Row` of balls at given azimuths, rad.

    **Arguments:** `turning`: see `ring_directions`; `exact`: whether the grooves move with the exact rotation of the
    ring, not to first order; `multiplicity`: number of balls of the bearing for each ball of the row."""
    every = ring_directions(azimuth, turning)
    free = ring.freedoms == RING_FREEDOMS
    held_shift = jnp.zeros(every.shape[1:]) if free else jnp.einsum("f,fcn->cn", ring.held, every)
    motion = ring_motion(ring, azimuth) if exact else None
    return Row(azimuth, ring, ring.of_unknown(every), held_shift, motion, multiplicity)


def ball_row(scene: BallBearing, exact: bool, ring: InnerRing | None = None) -> Row:
    """The `Row` of a scene: all balls, or one ball that stands for all if they are alike.

    **Arguments:** `exact`: see `row_of`; `ring`: a ring instead of the scene's, for which all balls are taken."""
    operation, geometry = scene.operation, scene.geometry
    azimuth = azimuths(geometry, geometry.n_balls, operation.symmetric and not shaped_parts(scene) and ring is None)
    if ring is None:
        ring = inner_ring(scene, scene.ring_lever)
    apart = geometry.arcs.inner
    turning = None if apart is None else apart / scene.ring_lever
    return row_of(azimuth, ring, turning, exact, geometry.n_balls // azimuth.size)


def ball_grooves(scene: BallBearing, expansion: Float[Array, ""] | None = None) -> Grooves:
    geometry = scene.geometry
    modulus = scene.materials.race_modulus
    contacts = geometry.free_contacts(modulus)
    if scene.tilts_by_standard:
        cosine = jnp.cos(jnp.asarray(geometry.nominal_angle))
        contacts = geometry.contacts(cosine, cosine, modulus)
    return Grooves(
        offset=jnp.stack([geometry.inner_offset, geometry.outer_offset]),
        stiffness=contacts.stiffness_constant(),
        centre_distance=jnp.asarray(geometry.centre_distance),
        free_cosine=jnp.asarray(geometry.free_cosine),
        free_sine=jnp.asarray(geometry.free_sine),
        aligned=jnp.asarray(geometry.aligned),
        lever=jnp.asarray(scene.ring_lever),
        groove_arm=jnp.asarray(geometry.conformity_inner * geometry.ball_diameter),
        expansion=expansion,
        arcs=geometry.arcs,
    )


def build_core(scene: BallBearing, exact: bool | None = None, ring: InnerRing | None = None) -> BallCore:
    """The equations of the bearing without friction on the raceways and without films.

    **Arguments:** `exact`: whether the grooves move with the exact rotation of the ring; not given: true if the ring
    can tilt and the tilt is not that of the standard; `ring`: a ring instead of the scene's, for which all balls are
    solved.
    """
    geometry, operation = scene.geometry, scene.operation
    if exact is None:
        exact = operation.tilts and not scene.tilts_by_standard
    row = ball_row(scene, exact, ring)
    grooves = ball_grooves(scene, row.ring.expansion)
    bent = _bending_rings(scene, row.azimuth)
    form = out_of_round(scene.inner_roundness, scene.outer_roundness, row.azimuth)
    density = jnp.asarray(scene.materials.balls.density)
    attitude, gyroscopic = scene.kinematics.attitude, scene.kinematics.gyroscopic
    slipping = attitude == "linear_slip" or geometry.has_arcs
    core = BallCore(
        kinematics=BallKinematics(
            jnp.asarray(operation.inner_speed),
            jnp.asarray(operation.outer_speed),
            jnp.asarray(geometry.pitch_diameter),
            jnp.asarray(geometry.ball_diameter),
        ),
        grooves=grooves,
        directions=row.directions,
        azimuth=row.azimuth,
        ring=row.ring.with_held_load(_held_load(grooves, row, form, bent.outer))
        if row.ring.needs_held_load
        else row.ring,
        held_shift=row.held_shift,
        ring_motion=row.ring_motion,
        out_of_round=form,
        outer=bent.outer,
        inner=bent.inner,
        mass=geometry.mass(density),
        inertia=geometry.inertia(density),
        gyroscopic=gyroscopic if isinstance(gyroscopic, AbstractGyroscopic) else None,
        couple_share=jnp.ones(()),
        multiplicity=row.multiplicity,
        attitude="linear_slip" if slipping else "inner" if attitude == "inner" else "outer",
        common_orbit=scene.kinematics.orbit == "common",
        spread=_spread(scene) if slipping else None,
    )
    return core.with_floor()


def _bending_rings(scene: BallBearing, azimuth: Float[Array, " ball"]) -> BentRings:
    """The flexible rings of a scene."""
    rings, width, (inner, outer) = scene.materials.of_rings, scene.geometry.width, scene.raceway_diameters
    return BentRings(
        elastic_ring(scene.outer_ring, rings[1], outer, width, azimuth),
        elastic_ring(scene.inner_ring, rings[0], inner, width, azimuth),
    )


def _spread(scene: BallBearing) -> Float[Array, "2"]:
    """Size of the contact ellipses, $(a^2 + c^2)/Q^{2/3}$, on the inner and the outer race at the contact angle of the
    unloaded bearing, m^2/N^(2/3)."""
    contacts = scene.geometry.free_contacts(scene.materials.race_modulus)
    ellipse = contacts.ellipse(SPREAD_LOAD)
    return (jnp.square(ellipse.rolling) + jnp.square(ellipse.transverse)) / SPREAD_LOAD ** (2.0 / 3.0)


def _held_load(
    grooves: Grooves, row: Row, form: Float[Array, " ball"] | None, outer: ElasticRing | None
) -> Float[Array, ""]:
    """Estimate of the load that belongs to the prescribed displacements of the ring, N.

    **Arguments:** `form`: see `out_of_round`; `outer`: the outer ring if it is flexible.
    """
    places = grooves.of_ring + row.held_shift
    rest, _ = grooves.arcs.facing(places if form is None else places.at[1].add(form))
    approach = jnp.maximum(safe_norm(rest[0], rest[1]) - jnp.sum(grooves.offset), 0.0)
    load = together(grooves.stiffness) * approach**1.5 + FORCE_FLOOR
    load = row.multiplicity * jnp.sum(load)
    return load if outer is None else load + outer.given_load()


def with_films(scene: BallBearing, core: BallCore) -> BallCore:
    """The bearing without friction, with balls enlarged by the film thicknesses: a better first guess if the unknowns
    are the positions of the balls.

    The film thicknesses are those at the mean load of a ball. If the films are thicker than the clearance, the load by
    which they press a ball between its rings (`_pressed_load`) is added to the mean load.
    """
    whole = core
    stop = lambda leaf: jax.lax.stop_gradient(leaf) if eqx.is_inexact_array(leaf) else leaf
    scene, core = jax.tree.map(stop, (scene, core))
    assert scene.contact is not None
    assert scene.oil is not None
    laws, oil = scene.contact, scene.oil
    geometry, motion, angle = scene.geometry, core.kinematics, core.grooves.free_angle
    contacts = geometry.free_contacts(scene.materials.race_modulus).shaped()
    rolling = motion.rolling(angle, angle, motion.outer_control(angle))
    speed = motion.races(jax.tree.map(jnp.atleast_1d, rolling), jnp.full((2, 1), angle)).mean_speed[:, 0]
    inlet = jax.tree.map(lambda leaf: leaf[:, 0] if jnp.ndim(leaf) == 2 else leaf, oil_of_races(scene))
    film = lambda load: laws.film_state(contacts, load * jnp.ones(2), speed, jnp.zeros(2), oil, inlet).separation
    load = core.ball_scale() + _pressed_load(core.grooves, film)
    grooves = whole.grooves._replace(offset=whole.grooves.offset - film(load))
    return dataclasses.replace(whole, grooves=grooves)


def _pressed_load(grooves: Grooves, film: Callable[[Array], Array]) -> Float[Array, ""]:
    r"""Load of the contacts of a ball that is pressed between the centred rings by its films alone, N.

    It is the root of $\sum_k[(Q/K_k)^{2/3} - h_k(Q)]/\cos a_k + P_d/2 = 0$ with the shim angles $a_k$ (0 for a ring
    with one arc) and the diametral clearance $P_d$; `LEAST_PRESSED` if the films do not fill the clearance.

    **Arguments:** `film`: function from a load, N, to the films of both races, m.
    """
    ratios = [0.0 if apart is None else apart / grooves.offset[k] for k, apart in enumerate(grooves.arcs)]
    cosine = jnp.stack([jnp.sqrt(1.0 - jnp.square(jnp.asarray(ratio))) for ratio in ratios])
    play = jnp.sum(grooves.offset * cosine) - grooves.rest[1, 0]

    def halved(_, ends: tuple[Array, Array]) -> tuple[Array, Array]:
        low, high = ends
        middle = 0.5 * (low + high)
        load = jnp.exp(middle)
        above = jnp.sum(((load / grooves.stiffness) ** (2.0 / 3.0) - film(load)) / cosine) + play > 0.0
        return jnp.where(above, low, middle), jnp.where(above, middle, high)

    ends = (jnp.asarray(np.log(LEAST_PRESSED)), jnp.asarray(np.log(MOST_PRESSED)))
    return jnp.exp(jax.lax.fori_loop(0, HALVINGS, halved, ends)[0])


def build_lubricated(
    scene: BallBearing, core: BallCore, guess: BallGuess | None = None
) -> LubricatedBallSystem | ArchedBallSystem:
    """The equations of the lubricated bearing with the balls of `core`.

    **Arguments:** `guess`: first guess; `None`: that of `core`.
    """
    assert scene.contact is not None
    assert scene.oil is not None
    motion, angle, arcs = core.kinematics, core.grooves.free_angle, core.arcs
    reference = motion.rolling(angle, angle, 0.5 * (motion.outer_control(angle) + motion.inner_control(angle)))
    inlet = oil_of_races(scene)
    parts: dict[str, Any] = {
        **core.shared_fields(),
        **(_guesses(core, scene.slips, _guess if arcs.single else _places) if guess is None else {"guess": guess}),
        "attitude": scene.kinematics.attitude,
        "geometry": scene.geometry,
        "reduced_modulus": scene.materials.race_modulus,
        "laws": scene.contact,
        "oil": scene.oil,
        "inlet": inlet,
        "elsewhere": oil_elsewhere(scene),
        "reference": reference,
        "orbit_unit": motion.orbit_scale(reference.orbital_speed),
        "resolved": isinstance(scene.kinematics.gyroscopic, ResolvedCouple),
        "cage": _cage_parts(scene) if scene.slips and scene.cage is not None else None,
        "drag": _drag(scene) if scene.slips and scene.drag is not None else None,
        "common_orbit": core.common_orbit,
    }
    if arcs.single:
        return LubricatedBallSystem(**parts)
    # the balls of the core may be enlarged (`with_films`); the oil of the races gets a row for each contact
    of_rows = lambda leaf: leaf[np.asarray(arcs.races)] if jnp.ndim(leaf) == 2 else leaf
    parts |= {"grooves": ball_grooves(scene, core.grooves.expansion), "inlet": jax.tree.map(of_rows, inlet)}
    return ArchedBallSystem(**parts, spread=_spread(scene))


def _guesses(
    core: BallCore, slips: bool, guess_at: Callable[[BallCore, ArrowPoint], BallGuess | BallPlaces]
) -> dict[str, BallGuess | BallPlaces | Array]:
    """Fields of the first guess: `guess` and, for balls that do not slide, `heavy_guess` under the easiest load and
    `heavier`, the ratio of this load to the load on the ring.

    **Arguments:** `slips`: whether the balls slide; `guess_at`: function from the core and its unknowns to a guess."""
    guess, heavy = core.guesses()
    if slips:
        return {"guess": guess_at(core, guess)}
    rings, points = core.own_and_easiest(), jax.tree.map(lambda a, b: jnp.stack([a, b]), guess, heavy)

    def under(rings: tuple[Array, ElasticRing | None]) -> BallCore:
        return dataclasses.replace(core, ring=core.ring.under(rings[0]), outer=rings[1])

    both = jax.vmap(lambda rings, point: guess_at(under(rings), point))(rings, points)
    own, easy = (jax.tree.map(lambda leaf, i=i: leaf[i], both) for i in (0, 1))
    return {"guess": own, "heavy_guess": easy, "heavier": core.heavier}


def _places(core: BallCore, point: ArrowPoint) -> BallPlaces:
    state = core.at(point)
    ring = point.globals[: core.ring_unknowns] * LENGTH_UNIT
    return jax.lax.stop_gradient(BallPlaces(state.centre, ring, state.load, state.angle))


def _guess(core: BallCore, point: ArrowPoint) -> BallGuess:
    state = core.at(point)
    inner, outer = state.direction
    least = SMALLEST_GUESS * core.ball_scale()
    log_load = jnp.log(jnp.maximum(state.load, least))
    control = jax.nn.sigmoid(CONTROL_AT_EQUAL_LOADS + CONTROL_BY_LOAD * (log_load[1] - log_load[0]))
    low, high = core.kinematics.outer_control(outer), core.kinematics.inner_control(inner)
    ring = point.globals[: core.ring_unknowns] * LENGTH_UNIT
    # a ball beyond the centre of its inner groove, in a film thicker than the groove's radius, is put on the near side
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
