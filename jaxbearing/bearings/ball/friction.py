r"""Friction on lubricated balls: traction, rolling resistance, drag and pockets, and the equations of a ball's motion.

On the ball act, at race k, the force $F_{tk}$ along $e_t$, the moment $M_{sk}$ about $n_k$ and the moment $M_{rk}$
against the relative roll. The traction law gives $F_{tk} = -sF_x(s\,u_t, s\,u_b, \omega_s)$ with s = 1 at the inner and
-1 at the outer race. The equations are source eqs. (16)-(17) and the moment about the radius, which the source replaces
by a hypothesis on beta:

- moment about the axis: $F_{to}\cos\alpha_o - F_{ti}\cos\alpha_i + \frac2D(M_{so}\sin\alpha_o - M_{si}\sin\alpha_i
  + M_{ro}\cos\alpha_o + M_{ri}\cos\alpha_i) + F_{C1} + F_{C2} = 0$;
- moment about the radius: $-F_{to}\sin\alpha_o + F_{ti}\sin\alpha_i + \frac2D(M_{so}\cos\alpha_o - M_{si}\cos\alpha_i
  - M_{ro}\sin\alpha_o - M_{ri}\sin\alpha_i) - F_{C1x} - F_{C2x} + \frac2DJ\omega_m\omega_t = 0$;
- moment about the tangent (resolved couple): $F_{bo} + F_{bi} + \frac2DsJ\omega_m\omega_R\sin\beta = 0$;
- force along the tangent: $F_{to} + F_{ti} - F_{ol} = Q_{C1} - Q_{C2}$. With a cage the pocket films solve it in closed
  form; without a cage it is the equation for the orbital speed.

Heathcote slip (`PointLaws.heathcote`). Ball and race meet in a surface that is curved across rolling, around the ball:
it deviates from the plane by $z = -y^2/(2R_k)$ along $n_k$, where $1/R_k$ is the mean of the curvatures $2/D$ and
$1/(f_kD)$. The relative roll $\omega_{rk}$ about $b_k$ therefore adds
$\omega_{rk}z\,b_k\times n_k = \omega_{rk}z\,e_t$ to the sliding, which along $e_t$ becomes
$u_t - \omega_sy - \omega_ry^2/(2R_k)$. The axes of the traction law are x = $s\,e_t$ and y = $s\,b_k$. In these axes
the curvature reduces the sliding along x by $c\,y^2$, with $c = s\,\omega_{rk}/(2R_k)$ at both races; c > 0 in normal
running, where $s\,\omega_{rk} > 0$. The stress $\tau_x$ on the race acts on the ball as $-s\tau_xe_t$, at the distance
$z\,n_k$ from the centre of the contact, and gives the moment
$z(-s\tau_x)\,n_k\times e_t = s\tau_xy^2/(2R_k)\,b_k$ on the ball. A rolling resistance $M_{rk}$ acts on the ball as
$-sM_{rk}b_k$. Heathcote slip is therefore a further rolling resistance, $M_{ck} = -\int\tau_xy^2dA/(2R_k)$, which
enters the same equations: the moments about axis and radius, the torques on the rings, and the power
$sM_{ck}\omega_{rk} = -c\int\tau_xy^2dA$. This power is the part of $\int\tau\cdot\Delta u\,dA$ that belongs neither to
the sliding at the centre nor to the spin. The spin power that `"min_power"` minimises is that of flat contacts, as in
the source.
"""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts.distributed import Traction
from ...contacts.mixed import MixedState
from ...contacts.shear import Sliding
from ...gaps.ball_pocket import BallPocketFilm
from ...numerics.roots import monotone_root
from ...numerics.safe import smooth_abs
from .arcs import added
from .lubricated import AbstractLubricatedBallSystem
from .state import BallsState, RaceState

FADING_LOAD = 1e-3
"""Load below which the traction of a contact fades out, N, for balls with more than two contacts."""
PART_TOLERANCE = 1e-12
"""Tolerance of the attitude of least spin power, over the difference between outer and inner control."""


def with_traction(system: AbstractLubricatedBallSystem, state: BallsState) -> BallsState:
    """The state with all friction on the balls and with the residuals of their equations of motion."""
    motion = state.motion
    shear, rolling, curvature = race_friction(system, state)
    forward, about = jnp.asarray(-system.arcs.senses * shear.rolling), -shear.moment
    axis, radius = _moments(system, state.angle, forward, about, (rolling, curvature))
    tangential, drag_force, pocket = added(system.arcs.by_race(forward)), None, None
    if system.drag is not None:
        speed = 0.5 * system.kinematics.pitch_diameter * motion.orbital_speed
        drag_force = system.drag.force(speed, system.oil_of("drag").viscosity)
        tangential = tangential - drag_force
    if system.cage is not None:
        viscosity = system.oil_of("pocket").viscosity
        pocket = system.cage.pocket.balance(tangential, motion.axial_spin, motion.radial_spin, viscosity)
        axis, radius = axis + pocket.friction, radius - pocket.transverse
    if system.resolved:
        couple = 2.0 / system.kinematics.ball_diameter * system.inertia * motion.orbital_speed
        radius = radius + couple * motion.transverse
    cage_moment, cage_force = (None, None) if pocket is None else _on_cage(system, pocket)
    state = state._replace(
        traction=shear,
        rolling=rolling,
        curvature=curvature,
        pocket=pocket,
        drag_force=drag_force,
        cage_moment=cage_moment,
        cage_force=cage_force,
    )
    return state._replace(rows=_rows(system, state, axis, radius, tangential))


def race_friction(
    system: AbstractLubricatedBallSystem, state: BallsState | RaceState
) -> tuple[Traction, Array | None, Array | None]:
    """Traction of all contacts, and the moments against the roll by the pressure in the film and by Heathcote slip,
    N m (`None`: not modelled)."""
    races = state.races
    bend = 0.5 / _patch_radius(system) if system.laws.heathcote else None
    sliding = _sliding(system, state, bend)
    shear = system.laws.shear(state.contact, state.load, state.film, races.mean_speed, sliding, system.oil)
    if not system.arcs.single:
        shear = _fading(shear, state.load)
    turn = system.arcs.senses * races.roll
    rolling = system.laws.rolling_moment(state.contact, state.load, state.film, races.mean_speed, turn, system.inlet)
    curvature = None if bend is None or shear.curvature is None else -bend * shear.curvature
    return shear, rolling, curvature


def _fading(shear: Traction, load: Float[Array, "contact ball"]) -> Traction:
    r"""Traction times $Q/\sqrt{Q^2 + Q_\epsilon^2}$.

    The size of the contact ellipse is smoothed near load 0, so that without this factor an open contact would have
    traction."""
    share = load / smooth_abs(load, FADING_LOAD)
    more = {} if shear.curvature is None else {"curvature": share * shear.curvature}
    names = ("rolling", "transverse", "moment", "power")
    return shear._replace(by_strip=None, **{name: share * getattr(shear, name) for name in names}, **more)


def _sliding(system: AbstractLubricatedBallSystem, state: BallsState | RaceState, bend: Array | None = None) -> Sliding:
    """Sliding speeds of the ball on both races, in the axes of the traction law. **Arguments:** `bend`: half the
    curvature of the contact surface, 1/m; `None`: flat contacts."""
    races, slide = state.races, system.slide_share * system.arcs.senses
    transverse = slide * races.transverse if system.resolved else None
    curved = None if bend is None else bend * slide * races.roll
    return Sliding(slide * races.rolling, transverse, system.slide_share * races.spin, curved)


def mixed_state(system: AbstractLubricatedBallSystem, state: BallsState) -> MixedState | None:
    """Mixed friction of all contacts; its forces are those of the races on the balls along the orbit. `None`: not
    modelled."""
    shear = state.traction
    assert shear is not None
    sliding, speed = _sliding(system, state), state.races.mean_speed
    mixed = system.laws.mixed_state(state.contact, state.load, state.film, speed, sliding, shear, system.oil)
    return None if mixed is None else mixed._replace(boundary=jnp.asarray(-system.arcs.senses * mixed.boundary))


def _moments(
    system: AbstractLubricatedBallSystem,
    angle: Array,
    forward: Array,
    about: Array,
    resistances: tuple[Array | None, ...],
) -> tuple[Array, Array]:
    """Moments on each ball about the bearing axis and about the radius, divided by the ball radius, N.

    **Arguments:** loads on the ball at each contact: `forward`: force along the orbit, N; `about`: moment about the
    normal, N m; `resistances`: moments against the roll, N m.
    """
    sine, cosine, arm = jnp.sin(angle), jnp.cos(angle), 2.0 / system.kinematics.ball_diameter
    by_race = system.arcs.by_race
    (pushed, held), (turned, braked) = by_race(forward * cosine), by_race(about * sine)
    axis = held - pushed + arm * (braked - turned)
    (pushed, held), (turned, braked) = by_race(forward * sine), by_race(about * cosine)
    radius = pushed - held + arm * (braked - turned)
    for resistance in resistances:
        if resistance is not None:
            inner, outer = by_race(resistance * cosine)
            axis = axis + arm * (outer + inner)
            inner, outer = by_race(resistance * sine)
            radius = radius - arm * (outer + inner)
    return axis, radius


def _on_cage(system: AbstractLubricatedBallSystem, pocket: BallPocketFilm) -> tuple[Array, Array]:
    """Moment, N m, and force, N, of each ball on the cage; components of the force: along and across the load line."""
    forward, outward = pocket.load_front - pocket.load_rear, pocket.friction_front - pocket.friction_rear
    moment = 0.5 * (system.kinematics.pitch_diameter * forward - system.kinematics.ball_diameter * pocket.friction)
    cosine, sine = jnp.cos(system.azimuth), jnp.sin(system.azimuth)
    # t = (-sin, cos), n = (cos, sin) in the plane of the bearing, the load along x
    force = jnp.stack([-forward * sine + outward * cosine, forward * cosine + outward * sine])
    if system.multiplicity > 1:  # all balls alike: the pocket forces balance each other
        force = jnp.zeros_like(force)
    return moment, force


def _rows(
    system: AbstractLubricatedBallSystem,
    state: BallsState,
    axis: Array,
    radius: Array,
    tangential: Array,
) -> tuple[Array, ...]:
    """Scaled residuals of the equations of motion of each ball, in the order of its unknowns.

    **Arguments:** `axis`, `radius`: moments about axis and radius over the ball radius, N; `tangential`: sum of the
    forces along the orbit, N."""
    scale, shear, pocket = system.friction_scale(), state.traction, state.pocket
    assert shear is not None
    rows = {
        "spin": axis / scale,
        "axial spin": axis / scale,
        "radial spin": -radius / scale,
        "orbit": -tangential / scale,
    }
    if state.pocket_force is not None and pocket is not None:
        rows["outward"] = (state.pocket_force + (pocket.friction_front - pocket.friction_rear)) / scale
    if system.resolved:
        assert state.friction is not None
        sideways = state.friction - system.arcs.senses * shear.transverse
        rows["transverse"], rows["carried"] = added(system.arcs.by_race(sideways)) / scale, sideways[0] / scale
    if system.attitude == "min_power":
        rows["attitude"] = state.motion.attitude - _least_power(system, state)
    return tuple(rows[name] for name in system.own_unknowns)


def _patch_radius(system: AbstractLubricatedBallSystem) -> Float[Array, "contact 1"]:
    """Radius of curvature of each contact surface across rolling, R_k = 2 f_k D/(2 f_k + 1), m."""
    conformities = jnp.stack([jnp.asarray(system.geometry.conformity_inner), system.geometry.conformity_outer])
    radii = 2.0 * conformities * system.geometry.ball_diameter / (2.0 * conformities + 1.0)
    return system.arcs.of_contacts(radii)[:, None]


def _least_power(system: AbstractLubricatedBallSystem, state: BallsState) -> Array:
    """Attitude between outer and inner control that gives the least spin power, rad.

    The power is that of rolling without sliding at the current loads, angles and films. If the minimum is at outer or
    inner control, the attitude is that of this control, with its derivatives.
    """
    inner, outer = state.angle

    def slope(part: Array, args):
        balls, angle, load, film, contact = args
        motion = balls.kinematics
        low, high = motion.outer_control(angle[1]), motion.inner_control(angle[0])

        def power(part: Array) -> Array:
            rolling = motion.rolling(angle[0], angle[1], low + part * (high - low))
            races = motion.races(rolling, angle)
            sliding = Sliding(jnp.zeros_like(races.spin), None, races.spin)
            shear = balls.laws.shear(contact, load, film, races.mean_speed, sliding, balls.oil)
            return jnp.sum(shear.moment * races.spin, axis=0)

        rise = jax.jvp(power, (part,), (jnp.ones_like(part),))[1]
        return rise / (balls.friction_scale() * balls.spin_unit() * motion.ball_diameter)

    args = (system, state.angle, state.load, state.film, state.contact)
    half = jnp.full_like(inner, 0.5)
    part = monotone_root(slope, args, 0.0, 1.0, half, tolerance=PART_TOLERANCE).value
    low, high = system.kinematics.outer_control(outer), system.kinematics.inner_control(inner)
    return low + part * (high - low)
