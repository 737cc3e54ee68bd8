"""Parts of the ball bearing that a scene may name: radial pocket friction and land on the inner ring, Heathcote slip,
one orbital speed for all balls, numbers of the gyroscopic couple."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from ball_losses import SIMPLE, check_losses

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core, build_lubricated
from jaxbearing.bearings.ball.gyroscopic import CappedCouple, ResolvedCouple, SharedCouple
from jaxbearing.bearings.ball.kinematics import BallKinematics, BallMotion
from jaxbearing.bearings.ball.steady import _lubricated
from jaxbearing.contacts import (
    BairWiner,
    ContactPatch,
    DistributedTraction,
    FilmHeating,
    NijenbanningVennerMoes,
    PointLaws,
    ReeEyring,
    Resolution,
    Sliding,
)
from jaxbearing.lubricants import Barus, ConstantPressureViscosity, ExponentialRheology, Lubricant
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.report.bearing.facts import not_modelled
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.scenes.errors import SceneError

RPM = 2.0 * np.pi / 60.0
COARSE = {"contact.traction.resolution": Resolution(12, 8, True)}
COMBINED = {"geometry.n_balls": 8, "operation.radial_load": 3e3, "operation.axial_load": 16e3}
DRAGGED = {"drag.coefficient": 20.0}
"""Films in the pockets below a twentieth of the clearance: only there the friction of front and rear differs."""


def turbine(**changes):
    return jb.load_scene("turbine_ball").replace(changes)


# -- radial pocket friction, land on the inner ring


FORCES = {
    "inner guidance": SIMPLE,
    "outer guidance": SIMPLE | {"cage.guidance": "outer_ring"},
    "capped couple": SIMPLE | {"kinematics.gyroscopic": CappedCouple()},
    "turning back": SIMPLE | {"operation.inner_speed": -12500 * RPM},
    "laws of the preset": COARSE,
}


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow if i else ()) for i, n in enumerate(FORCES)])
def test_forces_on_balls_cage_and_ring_balance(name):
    """Every body by itself and all together, to 1e-9 of the load, from the forces of the interactions; and the torques
    that drive the rings take the power that all interactions dissipate."""
    scene = turbine(**COMBINED, **DRAGGED, **FORCES[name])
    status, state, azimuth, centrifugal, totals, pieces = jax.tree.map(np.asarray, forces_of(scene))
    assert int(status) == 0
    check_losses(totals.power_loss, totals.drive_power, pieces)
    load, pocket = float(scene.operation.radial_load), state.pocket
    close = lambda left, right: np.testing.assert_allclose(left, right, rtol=0, atol=1e-9 * load)
    cosine, sine, across = np.cos(azimuth), np.sin(azimuth), np.cos(state.angle)
    # source eq. (14): of the pocket the ball gets -F_C1 e_r in front and +F_C2 e_r behind
    front, rear = pocket.friction_front, pocket.friction_rear
    assert float(np.max(np.abs(rear - front))) > 0.3
    friction = np.zeros((2, 8)) if state.friction is None else state.friction
    radial = state.load * across - friction * np.sin(state.angle)
    axial = state.load * np.sin(state.angle) + friction * across
    close(axial[0] - axial[1], 0.0)
    close(radial[0] - radial[1] + centrifugal - front + rear, 0.0)
    # along the tangent, source eq. (16)
    tangential = -np.asarray([[1.0], [-1.0]]) * state.traction.rolling
    pushed = pocket.load_rear - pocket.load_front
    close(tangential[0] + tangential[1] + pushed - state.drag_force, 0.0)
    # cage: the lands carry what the balls do to it; along the load line and across it
    on_cage = np.stack([-pushed * -sine + (front - rear) * cosine, -pushed * cosine + (front - rear) * sine])
    close(np.sum(on_cage, axis=1), np.sum(state.cage_force, axis=1))
    land_on_cage = -float(np.sum(on_cage[0]))
    assert abs(land_on_cage) > 0.05
    # inner ring, source eq. (22), which gets the opposite of what its land does to the cage
    inner_land = land_on_cage if name != "outer guidance" else 0.0
    close(np.sum(radial[0] * cosine) + inner_land, load)
    # ring, cage and balls: the outer ring's forces on balls and cage, inertia and drag; tangential ones included
    outer_land = land_on_cage - inner_land
    from_outer = np.sum(-radial[1] * cosine - tangential[1] * sine)
    body = np.sum(centrifugal * cosine + state.drag_force * sine)
    close(load + from_outer + body + outer_land + np.sum(-tangential[0] * sine), 0.0)


@eqx.filter_jit
def forces_of(scene):
    """Status of the solve, the balls in equilibrium, their places, the centrifugal forces, and the losses."""
    system, found = newton_solve(build_lubricated(scene, build_core(scene).started()[0]))
    state = system.at(found.point)
    results = _lubricated(scene, system, found, state)
    forces = system.centrifugal(state.motion.orbital_speed)
    return found.status, state, system.azimuth, forces, results.totals, results.raceway_power


def test_no_cage_no_pocket_friction():
    core = eqx.filter_eval_shape(build_core, turbine(cage=None))  # structure alone
    shaped = lambda **changes: eqx.filter_eval_shape(build_lubricated, turbine(**changes), core)
    assert shaped(cage=None).own_unknowns == ("axial spin", "radial spin", "orbit")
    assert shaped().own_unknowns == ("axial spin", "radial spin", "outward")
    assert shaped(**{"contact.traction": None, "kinematics.attitude": "outer"}).cage is None


@pytest.mark.slow
def test_stiffness_does_not_depend_on_how_many_balls_are_solved_for():
    one = jb.solve(turbine(**COARSE, **DRAGGED))
    all_ = jb.solve(turbine(**COARSE, **DRAGGED, **{"operation.radial_load": 0.0}))
    scale = float(one.stiffness[0, 0])
    np.testing.assert_allclose(one.stiffness, all_.stiffness, rtol=1e-6, atol=1e-6 * scale)
    np.testing.assert_allclose(one.power_loss.total, all_.power_loss.total, rtol=1e-9)


# -- Heathcote slip in one contact

traction = jax.jit(lambda law, *arguments: law.traction(*arguments))
PATCH = ContactPatch(jnp.asarray(1e9), jnp.asarray(3e-4), jnp.asarray(2.4e-3))
LINE = ContactPatch(jnp.asarray(1e9), jnp.asarray(3e-4), jnp.asarray(2.4e-3), line=True)


def numbers(*values):
    return [jnp.asarray(value, dtype=float) for value in values]


def oil_of(viscosity, stress, exponent=0.0):
    rheology = ExponentialRheology(300.0, 1e8, exponent, 0.0, stress, exponent, 0.0)
    oil = Lubricant(Barus(viscosity, 300.0, exponent, 0.0), ConstantPressureViscosity(exponent), rheology)
    return jax.tree.map(jnp.asarray, oil)


@pytest.mark.parametrize("patch", [PATCH, LINE], ids=["ellipse", "line"])
def test_curvature_of_a_newtonian_film(patch):
    """Force, moment and power of a uniform film from the integrals of 1, y^2 and y^4 over the patch."""
    law = DistributedTraction(ReeEyring(), Resolution(400, 24, True), elastic=False)
    sliding, curvature, film, viscosity = 0.2, 3e5, 5e-7, 2.0
    a, c = 3e-4, 2.4e-3
    area, second, fourth = np.pi * a * c, np.pi * a * c**3 / 4.0, np.pi * a * c**5 / 8.0
    if patch.line:
        area, second, fourth = 4.0 * a * c, 4.0 * a * c**3 / 3.0, 4.0 * a * c**5 / 5.0
    arguments = (patch, *numbers(film, 8.0), Sliding(*numbers(sliding), None, None, jnp.asarray(curvature)))
    found = traction(law, *arguments, jnp.asarray(300.0), oil_of(viscosity, 1e15))
    scale = viscosity / film
    # midpoint rule, extrapolated: (pi/400)^4 of the integral over x
    np.testing.assert_allclose(found.rolling, scale * (sliding * area - curvature * second), rtol=1e-8)
    np.testing.assert_allclose(found.curvature, scale * (sliding * second - curvature * fourth), rtol=1e-8)
    power = scale * (sliding**2 * area - 2.0 * sliding * curvature * second + curvature**2 * fourth)
    np.testing.assert_allclose(found.power, power, rtol=1e-8)


CURVED = {
    "alone": Sliding(jnp.zeros(()), None, None, jnp.asarray(2e5)),
    "rolling": Sliding(*numbers(0.3), None, None, jnp.asarray(2e5)),
    "all": Sliding(*numbers(0.3, 0.2, 400.0, 2e5)),
}


@pytest.mark.parametrize("sliding", list(CURVED.values()), ids=list(CURVED))
@pytest.mark.parametrize(
    ("patch", "heating"),
    [(PATCH, None), (LINE, None), pytest.param(PATCH, FilmHeating(jnp.asarray(0.14)), marks=pytest.mark.slow)],
    ids=["ellipse", "line", "thermal"],
)
def test_power_of_curvature(patch, heating, sliding):
    """h int(stress . rate) dA = F . dU + M dOmega - c int(tau_x y^2) dA, to round-off at any resolution; turned by 180
    degrees about the normal all forces change sign."""
    law = DistributedTraction(BairWiner(), Resolution(8, 6, heating is None), heating=heating)
    oil = oil_of(10.0, 1e6, 3e-9)
    run = lambda speed, sliding: traction(law, patch, *numbers(5e-7, speed), sliding, jnp.asarray(330.0), oil)
    found = run(8.0, sliding)
    speeds = [0.0 if speed is None else speed for speed in sliding]
    work = found.rolling * speeds[0] + found.transverse * speeds[1] + found.moment * speeds[2]
    np.testing.assert_allclose(work - found.curvature * speeds[3], found.power, rtol=1e-12)
    assert float(found.power) > 0.0
    turned = run(-8.0, Sliding(*(None if v is None else s * v for v, s in zip(sliding, (-1, -1, 1, -1), strict=True))))
    for field, sign in (("rolling", -1), ("transverse", -1), ("moment", 1), ("power", 1), ("curvature", -1)):
        np.testing.assert_allclose(getattr(turned, field), sign * getattr(found, field), rtol=1e-12, atol=1e-18)


def test_curvature_is_computed_where_it_is_given_only():
    law, oil = DistributedTraction(ReeEyring(), Resolution(8, 6)), oil_of(10.0, 1e6, 3e-9)
    film, speed, temperature = numbers(5e-7, 8.0, 330.0)
    run = lambda sliding: law.traction(PATCH, film, speed, sliding, temperature, oil)

    @jax.jit
    def together(slow, spin, nothing, much, step):
        flat = [(run(s), run(s._replace(curvature=nothing))) for s in (Sliding(slow), Sliding(slow, None, spin))]
        curved = Sliding(slow, curvature=much)
        error = law.error_estimate(PATCH, film, speed, curved, temperature, oil).curvature
        alone = lambda c: run(Sliding(nothing, curvature=c)).curvature
        slope = jax.jvp(alone, (nothing,), (jnp.ones(()),))[1]
        return flat, run(curved).curvature, error, slope, alone(step)

    step = 1.0  # odd in c; 1 of some 1e5 at which the stress bends
    both, curved, error, slope, found = together(*numbers(0.3, 400.0, 0.0, 1e5, step))
    for flat, none in both:
        assert flat.curvature is None
        np.testing.assert_allclose(none.power, flat.power, rtol=1e-12)
    of = lambda sliding: len(jax.make_jaxpr(lambda s: run(s).power)(sliding).eqns)
    assert of(Sliding(*numbers(0.3))) < of(Sliding(*numbers(0.3), curvature=jnp.asarray(1e5)))
    assert 0.0 < float(error) < 0.5 * abs(float(curved))
    np.testing.assert_allclose(slope * step, found, rtol=1e-7)


def test_sliding_of_a_curved_patch_is_that_of_rigid_bodies():
    """Velocities of ball and races by vectors at the points of the curved patch, against the formula with R_k; and the
    moment of a stress there about the ball's centre."""
    diameter, pitch, conformity = 20.638e-3, 153e-3, 0.5225
    kinematics = BallKinematics(*numbers(12500 * RPM, -3000 * RPM, pitch, diameter))
    motion = BallMotion(*numbers(560.0, 4800.0, 0.6, 0.0))
    e_x, e_r, e_t = np.eye(3)
    ball = -4800.0 * (np.cos(0.6) * e_x - np.sin(0.6) * e_r)
    radius = 2.0 * conformity * diameter / (2.0 * conformity + 1.0)
    for side, angle, race, speed in (
        (1.0, 0.65, kinematics.inner_race(motion, 0.65), 12500 * RPM),
        (-1.0, 0.51, kinematics.outer_race(motion, 0.51), -3000 * RPM),
    ):
        normal = -side * (np.cos(angle) * e_r + np.sin(angle) * e_x)
        across = np.cross(normal, e_t)
        np.testing.assert_allclose(across, -side * (np.cos(angle) * e_x - np.sin(angle) * e_r), atol=1e-15)
        for y in (-1.5e-3, 0.0, 2e-3):
            bend = -(y**2) / (2.0 * radius)
            place = (0.5 * diameter + bend) * normal + y * across
            of_race = np.cross((speed - 560.0) * e_x, 0.5 * pitch * e_r + place)
            sliding = np.dot(np.cross(ball, place) - of_race, e_t)
            c = side * race.roll / (2.0 * radius)
            np.testing.assert_allclose(side * (sliding - race.rolling + race.spin * y), -c * y**2, rtol=1e-9, atol=1e-9)
            # tau_x = 1 of the ball on the race, along s e_t: beyond force times D/2 and spin there is + s y^2/(2R) b
            moment = np.cross(place - 0.5 * diameter * normal, -side * e_t)
            np.testing.assert_allclose(np.dot(moment, across), side * y**2 / (2.0 * radius), rtol=1e-12, atol=1e-18)
        assert side * float(race.roll) > 0.0


# -- Heathcote slip in the bearing

HEATHCOTE = {"contact.heathcote": True}
BOTH = {"operation.outer_speed": -400.0}
ENERGY = {
    "combined, both rings": COMBINED | BOTH,
    "resolved, no cage": {"kinematics.gyroscopic": ResolvedCouple(), "cage": None, "drag": None},
    "backwards": {"operation.inner_speed": -12500 * RPM},
    "outer faster": {
        "operation.inner_speed": 500.0,
        "operation.outer_speed": 850.0,
        "contact.rolling": None,
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ENERGY)
def test_energy_closes_with_heathcote_slip(name):
    """The power of the rings' torques is all that is dissipated, to 1e-10, and its parts add up."""
    solution = jb.solve(turbine(**COARSE, **HEATHCOTE, **ENERGY[name]))
    loss, pieces = solution.power_loss, solution.raceway_power
    np.testing.assert_allclose(solution.drive_power, loss.total, rtol=1e-10)
    for side in ("inner", "outer"):
        own = [float(getattr(pieces, f"{side}_{kind}")) for kind in ("spin", "rolling", "transverse", "curvature")]
        np.testing.assert_allclose(sum(own), getattr(loss, f"{side}_raceway"), rtol=1e-10)
        assert own[3] > 0.0
    assert any("Heathcote" in note for note in solution.notes)


def test_heathcote_needs_traction_and_is_said():
    with pytest.raises(ValueError, match=r"contact\.heathcote"):
        PointLaws(NijenbanningVennerMoes(), heathcote=True)
    without = {"contact.traction": "none", "contact.rolling_resistance": "none"}
    with pytest.raises(SceneError, match=r"contact\.traction: found nothing; expected a law, without which heathcote"):
        jb.load_scene("turbine_ball", {**without, "contact.heathcote": "true"})
    with pytest.raises(SceneError, match=r"contact\.heathcote: found the text 'yes'; expected true or false"):
        jb.load_scene("turbine_ball", {"contact.heathcote": "yes"})
    curved = jb.load_scene("turbine_ball", {"contact.heathcote": "true"})
    assert curved.contact.heathcote
    assert any("Heathcote" in note for note in curved.assumptions())
    flat = jb.load_scene("turbine_ball", {"contact.heathcote": "false"})
    assert flat.contact.heathcote is False
    assert not any("Heathcote" in note for note in flat.assumptions())


# -- one orbital speed for all; `test_ball_core` has its results

DRY = {"oil": None, "contact": None, "cage": None, "drag": None, "kinematics.attitude": "outer"}
FILMS = {"contact.traction": None, "cage": None, "drag": None, "kinematics.attitude": "outer"}
COMMON = {"kinematics.orbit": "common"}
STRONG = {"operation.axial_load": 5e3, "operation.radial_load": 6e3}


@pytest.mark.slow
def test_common_orbit_gradients_against_differences():
    """Asked: 1e-6; also of a bearing at rest, where all speeds are 0."""
    scene = turbine(**DRY, **STRONG, **COMMON)

    def results(x):
        solution = jb.solve(scene.at_operation(inner_speed=1300.0 * x[0], radial_load=6e3 * x[1]), throw=False)
        e = solution.elements
        return jnp.stack([e.load_outer[0], e.load_outer[10], e.orbital_speed[0], 1e8 * solution.ring.radial])

    one, run, forward = jnp.ones(2), jax.jit(results), jax.jit(jax.jacfwd(results))
    slopes = np.asarray(forward(one))
    backward = np.asarray(jax.jit(jax.jacrev(results))(one))
    for i in range(2):
        at = lambda k, i=i: np.asarray(run(one.at[i].add(1e-3 * k)))
        difference = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12e-3
        np.testing.assert_allclose(slopes[:, i], difference, rtol=1e-6, atol=1e-4)
    np.testing.assert_allclose(backward, slopes, rtol=1e-9, atol=1e-7)
    assert np.all(np.isfinite(forward(jnp.asarray([0.0, 1.0]))))
    assert float(run(jnp.asarray([0.0, 1.0]))[2]) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("model", [DRY, FILMS], ids=["dry", "films"])
def test_common_orbit_stiffness_is_that_of_the_solve(model):
    scene = turbine(**model, **COMMON, **{"operation.axial_load": 20e3, "operation.radial_load": 8e3})
    fast = jb.jit_solver(scene)
    stiffness = np.asarray(fast().stiffness)[:2, :2]
    base, compliance = {"axial_load": 20e3, "radial_load": 8e3}, []
    for name in base:
        ends = [fast(**(base | {name: base[name] + sign * 2.0})).ring for sign in (1.0, -1.0)]
        compliance.append([float(getattr(ends[0], f) - getattr(ends[1], f)) / 4.0 for f in ("axial", "radial")])
    np.testing.assert_allclose(np.linalg.inv(np.array(compliance).T), stiffness, rtol=1e-5, atol=1e-6 * stiffness[0, 0])


@pytest.mark.parametrize("cage", [{}, {"cage": "none"}], ids=["cage", "no cage"])
def test_common_orbit_is_refused_with_traction(cage):
    with pytest.raises(SceneError, match=r"kinematics\.orbit: .* roll without sliding"):
        jb.load_scene("turbine_ball", {"kinematics.orbit": "common", **cage})
    assert jb.load_scene("angular_contact_218", {"kinematics.orbit": "common"}).kinematics.orbit == "common"
    assert jb.load_scene("angular_contact_218").kinematics.orbit == "own"


# -- numbers of the gyroscopic couple in the file

COUPLES = {
    "shared": ({"attitude": "inner"}, SharedCouple()),
    "shared, outer control": ({"gyroscopic": "shared"}, SharedCouple(0.0, 2.0)),
    "printed sign": ({"attitude": "inner", "gyroscopic_sign": "-1"}, SharedCouple(sign=-1.0)),
    "inner share": ({"inner_share": "0.5"}, SharedCouple(0.5, 1.5)),
    "outer share": ({"outer_share": "0.25"}, SharedCouple(1.75, 0.25)),
    "both": ({"inner_share": "0.8", "outer_share": "1.2", "gyroscopic_sign": "1"}, SharedCouple(0.8, 1.2)),
    "capped": ({"gyroscopic": "capped"}, CappedCouple()),
    "friction": ({"gyroscopic": "capped", "gyroscopic_friction": "0.08"}, CappedCouple(0.08)),
    "all of capped": (
        {"gyroscopic": "capped", "gyroscopic_friction": "0.02", "gyroscopic_sign": "-1"},
        CappedCouple(0.02, -1.0),
    ),
}


@pytest.mark.parametrize("name", COUPLES)
def test_couple_of_the_file(name):
    changes, law = COUPLES[name]
    overrides = {f"kinematics.{key}": value for key, value in ({"gyroscopic": "shared"} | changes).items()}
    found = jb.load_scene("angular_contact_218", overrides).kinematics.gyroscopic
    assert type(found) is type(law)
    assert {key: float(value) for key, value in vars(found).items()} == pytest.approx(
        {key: float(value) for key, value in vars(law).items()}, abs=1e-15
    )


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"gyroscopic_sign": "-1"}, "gyroscopic_sign", "none with gyroscopic = 'off'"),
        ({"gyroscopic": "shared", "gyroscopic_friction": "0.1"}, "gyroscopic_friction", "it is about 'capped'"),
        ({"gyroscopic": "capped", "inner_share": "1"}, "inner_share", "it is about 'shared'"),
        ({"gyroscopic": "resolved", "outer_share": "1"}, "outer_share", "none with gyroscopic = 'resolved'"),
        ({"gyroscopic": "capped", "gyroscopic_sign": "0.5"}, "gyroscopic_sign", "-1 (as the source prints it)"),
        ({"gyroscopic": "capped", "gyroscopic_sign": "true"}, "gyroscopic_sign", "without quotes"),
        ({"gyroscopic": "capped", "gyroscopic_friction": "0"}, "gyroscopic_friction", "a number > 0"),
        ({"gyroscopic": "shared", "inner_share": "2.5"}, "inner_share", "between 0 and 2"),
        ({"gyroscopic": "shared", "inner_share": "1", "outer_share": "0.5"}, "outer_share", "add up to 2"),
    ],
)
def test_couple_without_meaning_is_refused(changes, field, words):
    with pytest.raises(SceneError) as refused:
        jb.load_scene("angular_contact_218", {f"kinematics.{key}": value for key, value in changes.items()})
    assert f"kinematics.{field}: found" in str(refused.value)
    assert words in str(refused.value)


def test_taking_the_couple_out_takes_its_numbers_along():
    scene = {"kinematics.gyroscopic": "none"}
    assert jb.load_scene("turbine_ball", scene).kinematics.gyroscopic is None


def test_gyroscopic_couple_is_euler_s():
    """By cross products: the ball's moment about the radius, and the couple that friction has to carry."""
    scene = turbine(**{"kinematics.gyroscopic": ResolvedCouple(), "cage": None, "drag": None})
    system, start = built(scene)
    # none of it for friction to carry: loads and slides do not depend on the inertia then
    system = dataclasses.replace(system, couple_share=jnp.zeros(()))
    unknowns = start.elements.at[system.own_unknowns.index("transverse") + 2].set(0.03)
    shared = jnp.broadcast_to(start.globals[:, None], (start.globals.size, unknowns.shape[1]))

    @jax.jit
    def radial_row(inertia):
        state = dataclasses.replace(system, inertia=inertia).balls(unknowns, shared)
        return state.rows[system.own_unknowns.index("radial spin")][0], jax.tree.map(lambda x: x[0], state.motion)

    (without, _), (row, motion) = radial_row(jnp.zeros(())), radial_row(system.inertia)
    # along e_x, e_r, e_t: right-handed
    spin = np.array([-motion.spin_speed * np.cos(motion.attitude), motion.radial_spin, motion.transverse])
    orbit = np.array([motion.orbital_speed, 0.0, 0.0])
    inertia_moment = -np.cross(orbit, system.inertia * spin)
    assert abs(spin[2]) > 0.01 * abs(spin[0])
    # the rows are forces, moments times 2/D, and this one counts the other way
    expected = -2.0 / scene.geometry.ball_diameter * inertia_moment[1] / system.friction_scale()
    np.testing.assert_allclose(row - without, expected, rtol=1e-9)
    whole = dataclasses.replace(system, couple_share=jnp.ones(()))
    np.testing.assert_allclose(whole.couple(motion), -inertia_moment[2], rtol=1e-12)


def test_a_couple_that_is_left_out_is_named_with_its_size():
    """Of balls at 50 000 rpm, and not of slow ones."""
    scene = jb.load_scene("angular_contact_218")
    fast = {"operation.inner_speed": 50e3 * np.pi / 30.0}
    geometry, thrust = scene.geometry, float(scene.operation.axial_load)
    axial = lambda found: float(jnp.sum(found.elements.load_inner * jnp.sin(found.elements.contact_angle_inner)))
    left_out = jb.solve(scene.replace(fast))
    couple, balls = left_out.elements.gyroscopic_couple[0], left_out.elements
    inertia = geometry.ball_diameter**5 * np.pi * float(scene.materials.balls.density) / 60.0
    expected = inertia * balls.spin_speed * balls.orbital_speed * np.sin(balls.attitude_angle)
    np.testing.assert_allclose(balls.gyroscopic_couple, expected, rtol=1e-9)
    limit = 0.05 * geometry.ball_diameter / 2.0 * (balls.load_inner + balls.load_outer)
    np.testing.assert_allclose(balls.gyroscopic_limit, limit, rtol=1e-12)
    share = 100.0 * float(couple / limit[0])
    assert share > 1.0
    said = f"gyroscopic couple (up to {float(couple):.3g} N m a ball, {share:.3g} % of what"
    assert said in not_modelled(left_out), not_modelled(left_out)
    assert solution_to_dict(left_out)["not_modelled"][-1] == "gyroscopic_couple"
    assert "gyroscopic" not in not_modelled(jb.solve(scene.replace({"operation.inner_speed": 10.0})))
    np.testing.assert_allclose(axial(left_out), thrust, rtol=1e-9)
    # with a law for the friction there is no limit, and nothing is said
    carried = scene.replace(fast | {"kinematics.gyroscopic": SharedCouple()})
    elements = eqx.filter_eval_shape(lambda scene: jb.solve(scene, throw=False).elements, carried)
    assert elements.gyroscopic_limit is None
    carried = eqx.tree_at(lambda found: found.elements.gyroscopic_limit, left_out, None)
    assert "gyroscopic" not in not_modelled(carried)
    assert "gyroscopic_couple" not in solution_to_dict(carried)["not_modelled"]


@eqx.filter_jit
def built(scene):
    """The system, and where Newton's iteration starts."""
    system = build_lubricated(scene, build_core(scene))
    return system, system.initial()


def test_bad_couples_are_refused():
    with pytest.raises(ValueError, match=r"kinematics\.gyroscopic_sign must be 1 or -1, got 0\.5"):
        CappedCouple(sign=0.5)
    with pytest.raises(ValueError, match=r"kinematics\.gyroscopic_friction must be > 0"):
        CappedCouple(0.0)
    with pytest.raises(ValueError, match=r"kinematics\.inner_share must be between 0 and 2"):
        SharedCouple(float("nan"), 2.0)
