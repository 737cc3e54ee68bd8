"""Solves of shafts beyond the check values: balances, derivatives, lanes, loads without an equilibrium, wrong input."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from shaft_cases import DEEP_GROOVE, NU, RPM, P, gear_shaft, pair, rollers, steel, two_deep_grooves

import jaxbearing as jb
from jaxbearing.bearings.rating import Rating
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.numerics.status import Status
from jaxbearing.shafts import (
    Gravity,
    LinearBearing,
    MatchedSet,
    MountedBearing,
    PointLoad,
    Preload,
    Section,
    Shaft,
    ShaftState,
    ShaftSystem,
    Support,
    scene,
)
from jaxbearing.shafts.batches import batches_of
from jaxbearing.shafts.beam import element_stiffness
from jaxbearing.shafts.scene import Place

PRELOAD = Preload(force=180.0)


def on_springs(sections, stiffness=1e8, places=(0.02, 0.18), shares=(1.0, 1.0), held=1.0, gravity=9.81, strain=0.0):
    """A shaft that is cheap to solve: its bearings are linear. One program for all of two sections.

    **Arguments:** `shares`: of the stiffness, for each bearing; `held`: share of the stiffness along the axis.
    """
    matrix = jnp.diag(jnp.asarray([1e8, 1e8, 1e8, 1e4, 1e4])).at[0, 0].multiply(held) * (stiffness / 1e8)
    return ShaftSystem(
        Shaft(100.0, sections, steel(206e9), Gravity(gravity), thermal_strain=strain),
        bearings=[
            MountedBearing("A", LinearBearing(shares[0] * matrix), places[0]),
            MountedBearing("B", LinearBearing(shares[1] * matrix), places[1], "-x"),
        ],
        forces=[PointLoad("load", 0.1, axial=0.0, radial=300.0, azimuth=0.4, radius=0.05)],
    )


STEPPED = (Section(0.1, 0.03), Section(0.1, 0.04, 0.01))
PLAIN = (Section(0.1, 0.03), Section(0.1, 0.03))


def linear_shaft(axial=20.0, **changes):
    return on_springs(STEPPED, **changes).replace({"force.load.axial": axial})


def totals(solved):
    """Force and moment about x = 0 of bearings and given loads without the weight of the shaft."""
    about = lambda at, load: np.asarray(shift_matrix(jnp.asarray(at))).T @ np.asarray(load)
    bearings = sum(about(one.position, one.on_shaft) for one in solved.bearings.values())
    return bearings + sum(about(*both) for both in zip(solved.shaft.position, solved.shaft.load, strict=True))


def test_forces_balance_with_the_weight():
    """Test 7 of section 12, on linear bearings."""
    system = linear_shaft()
    solved = jb.solve(system)
    areas = np.pi / 4.0 * np.array([0.03**2, 0.04**2 - 0.01**2])
    weights = 7850.0 * areas * 0.1 * 9.81
    expected = [0.0, np.sum(weights), 0.0, -np.sum(weights * [0.05, 0.15]), 0.0]
    np.testing.assert_allclose(totals(solved), expected, atol=2e-7)
    assert int(solved.newton_steps) <= 1


def test_a_linear_shaft_agrees_with_the_finite_element():
    """Sections of one diameter between two linear bearings, by the stiffness matrix of one element."""
    system = on_springs(PLAIN, places=(0.0, 0.2), gravity=0.0)
    at_end = {"position": 0.2, "azimuth": 0.0, "radius": 0.0}
    solved = jb.solve(system.replace({f"force.load.{name}": value for name, value in at_end.items()}))
    beam = np.asarray(element_stiffness(0.2, 0.03, 0.0, steel(206e9))[0])
    total = beam + np.diag([1e8, 1e4, 1e8, 1e4])
    moved = np.linalg.solve(total, [0.0, 0.0, 300.0, 0.0])
    found = np.asarray(solved.shaft.displacement)
    np.testing.assert_allclose(found[[0, -1], 1], moved[[0, 2]], rtol=1e-9)
    np.testing.assert_allclose(-found[[0, -1], 3], moved[[1, 3]], rtol=1e-9)


def test_a_load_that_bends_the_clamped_shaft_far():
    """The search knows the shaft as clamped at x = 0, where 200 kN bend it by 18 mm at the second bearing, beyond the
    bound of displacements. Between its bearings the shaft bends by 1 mm. Linear bearings answer in proportion."""
    solve = lambda load: jb.solve(linear_shaft().replace({"force.load.radial": load}), throw=False)
    none, light, heavy = (solve(load) for load in (0.0, 300.0, 2e5))
    assert int(heavy.status) == jb.Status.CONVERGED
    moved = np.asarray(heavy.shaft.displacement - none.shaft.displacement)
    expected = 2e5 / 300.0 * np.asarray(light.shaft.displacement - none.shaft.displacement)
    np.testing.assert_allclose(moved, expected, rtol=1e-7, atol=1e-12)


@pytest.mark.parametrize("place", [0.02, 0.0])
def test_bearings_at_one_place(place):
    """Two bearings at one place, also at x = 0, are no special cases: they are one of twice the stiffness."""
    split = jb.solve(linear_shaft(places=(place, place), shares=(0.5, 0.5)))
    whole = jb.solve(linear_shaft(places=(place, 0.18), shares=(1.0, 0.0)))
    np.testing.assert_allclose(split.shaft.displacement[-1], whole.shaft.displacement[-1], rtol=1e-9, atol=1e-18)
    for one in split.bearings.values():
        np.testing.assert_allclose(2.0 * one.on_shaft, whole.bearings["A"].on_shaft, rtol=1e-8, atol=1e-8)


def test_derivatives_on_linear_bearings():
    """By stiffness, position, load and diameter, in reverse mode, against differences; forward mode has the same rules
    (`test_derivatives_of_a_preloaded_pair`)."""

    def results(x):
        sections = (Section(0.1, x[3]), STEPPED[1])
        system = on_springs(sections, stiffness=x[0], places=(x[1], 0.18)).replace({"force.load.axial": x[2]})
        solved = jb.solve(system, throw=False)
        return jnp.concatenate([solved.bearings["A"].on_shaft[:2], solved.shaft.displacement[-1, :2] * 1e8])

    x = jnp.asarray([1e8, 0.02, 20.0, 0.03])
    backward, step = jax.jit(jax.jacrev(results))(x), 1e-4 * np.asarray(x)
    for place, one in enumerate(np.diag(step)):
        difference = (results(x + one) - results(x - one)) / (2.0 * step[place])
        np.testing.assert_allclose(backward[:, place], difference, rtol=1e-5, atol=1e-6 * np.max(np.abs(difference)))


@pytest.mark.slow
def test_derivatives_of_a_preloaded_pair():
    """Test 8 of section 12 too: by the speed, with each ball's own centrifugal force."""

    def results(x):
        one = MatchedSet("set", "<>", P, 0.0, 16e-3, Preload(force=x[1]))
        system = ShaftSystem(Shaft(x[0]), sets=[one], forces=[PointLoad("load", 0.01, axial=x[2], radial=300.0)])
        solved = jb.solve(system, throw=False)
        return jnp.stack([
            solved.bearings["set.1"].force[1],
            solved.bearings["set.2"].largest_load,
            solved.sets["set"].loss_force,
            1e8 * solved.shaft.displacement[0, 1],
        ])  # fmt: skip

    x = jnp.asarray([1000.0, 180.0, 100.0])
    derived, compiled = jax.jit(jax.jacfwd(results)), jax.jit(results)
    forward = derived(x)
    for place, one in enumerate(np.diag(1e-4 * np.asarray(x))):
        difference = (compiled(x + one) - compiled(x - one)) / (2.0 * one[place])
        np.testing.assert_allclose(forward[:, place], difference, rtol=1e-5, atol=1e-6 * np.max(np.abs(difference)))
    without = derived(x * jnp.asarray([1.0, 0.0, 1.0]))
    assert np.all(np.isfinite(without))
    assert np.all(without[:2, 2] != 0.0)


LANES = {
    "floating": {"held": 0.0, "axial": 0.0},
    "floating, pushed": {"held": 0.0, "axial": 50.0},
    "as it is": {},
    "bearing beyond": {"bearing.B.position": 0.25},
    "load beyond": {"force.load.position": -0.01},
}


@pytest.fixture(scope="module")
def lanes():
    """Solutions of a batch by their names."""

    def solved(lane):
        system = linear_shaft(axial=lane["axial"], held=lane["held"])
        return jb.solve(system.replace({path: lane[path] for path in lane if "." in path}), throw=False)

    usual = {"held": 1.0, "axial": 20.0, "bearing.B.position": 0.18, "force.load.position": 0.1}
    values = {name: jnp.asarray([(usual | lane)[name] for lane in LANES.values()]) for name in usual}
    found = jax.jit(jax.vmap(solved))(values)
    return {name: jax.tree.map(lambda leaf, number=number: leaf[number], found) for number, name in enumerate(LANES)}


def test_a_lane_without_equilibrium_says_so(lanes):
    """Nothing holds this shaft along X; the lane beside it is not touched by that."""
    still, pushed = lanes["floating"], lanes["floating, pushed"]
    assert [still.status, pushed.status] == [jb.Status.CONVERGED, jb.Status.NO_EQUILIBRIUM]
    assert np.all(np.isnan(pushed.shaft.displacement))
    assert np.all(np.isfinite(still.shaft.displacement))
    with pytest.raises(jb.SolveError, match="no_equilibrium: nothing holds the shaft along X at"):
        jb.solve(linear_shaft(axial=50.0, held=0.0))


@pytest.mark.slow
@pytest.mark.parametrize("axial", [0.0, 1e-6, -2e-4])
def test_an_empty_bearing_has_derivatives(axial):
    """The mounted set is found with all bearings at rest, and those beside it carry nothing there."""

    def force(clearance):
        scene = DEEP_GROOVE.replace_geometry(diametral_clearance=clearance)
        (batch,) = batches_of([Place("b", scene, 0.0, 1.0, 0.0, 0.0, None, None)], jnp.asarray(0.0))
        rows, at = batch.rows(jnp.zeros(1), at_rest=True), jnp.zeros((1, 5)).at[0, 0].set(axial)
        held = batch.hold(rows, at, batch.initial(rows, at))
        return batch.force_at(rows, at, held.state)[0, 0]

    step = 1e-9
    difference = (force(4e-5 + step) - force(4e-5 - step)) / (2.0 * step)
    np.testing.assert_allclose(jax.grad(force)(4e-5), difference, rtol=1e-5, atol=1e-3)


@pytest.mark.slow
def test_two_bearings_that_float():
    """Two NU bearings and 50 N axially."""
    system = ShaftSystem(
        Shaft(100.0, [Section(0.2, 0.03)]),
        bearings=[MountedBearing("A", NU, 0.02), MountedBearing("B", NU, 0.18)],
        forces=[PointLoad("load", 0.1, axial=50.0, radial=1e3)],
    )
    solved = jb.solve(system, throw=False)
    assert int(solved.status) == jb.Status.NO_EQUILIBRIUM
    assert "along X" in solved.failure()


@pytest.mark.slow
def test_hard_cases_of_the_sheet():
    """20 N across 60 um; a shaft a million times as stiff; preload that is lost under 5 kN; supports that give way by
    millimetres; an X pair whose pressure centres meet, under a moment."""
    solve = jax.jit(lambda clearance, radial, modulus: jb.solve(hard(clearance, radial, modulus), throw=False))
    for numbers in ((60e-6, 20.0, 206e9), (12e-6, 2e3, 206e15)):
        assert bool(solve(*numbers).converged), numbers
    assert bool(jb.solve(pair(preload=PRELOAD, axial=5e3)).converged)
    soft = Support(axial=1e4, radial=1e5, tilt=1e3)
    far = dataclasses.replace(hard(12e-6, 500.0, 206e9), bearings=hard(12e-6, 500.0, 206e9, soft).bearings)
    assert bool(jb.solve(far).converged)
    meeting = 65e-3 * np.tan(np.radians(17.0))
    crossed = jb.solve(pair("><", preload=PRELOAD, distance=meeting, moment=5.0))
    assert bool(crossed.converged)
    np.testing.assert_allclose(crossed.sets["set"].support_distance, 0.0, atol=1e-12)


def hard(clearance, radial, modulus, support=None):
    """C4a with other numbers."""
    system = two_deep_grooves(clearance=clearance, modulus=modulus).replace({"force.load.radial": radial})
    if support is None:
        return system
    bearings = tuple(dataclasses.replace(one, support=support) for one in system.bearings)
    return dataclasses.replace(system, bearings=bearings)


@pytest.mark.slow
def test_a_cylindrical_bearing_with_interference_between_two_ball_bearings():
    """C4b of the sheet with -15 um: all forces balance."""
    ends = [MountedBearing(name, DEEP_GROOVE, at) for name, at in (("A", 0.02), ("B", 0.28))]
    middle = MountedBearing("M", rollers(13, 46e-3, 7.5e-3, 7.5e-3, -15e-6), 0.15)
    forces = [PointLoad("load", 0.11, axial=50.0, radial=3e3)]
    shaft = Shaft(3000 * RPM, [Section(0.3, 0.03)], steel(206e9))
    solved = jb.solve(ShaftSystem(shaft, bearings=[*ends, middle], forces=forces))
    np.testing.assert_allclose(totals(solved), 0.0, atol=1e-6)
    assert float(solved.bearings["M"].on_shaft[1]) < -2537.691  # more than without clearance


@pytest.mark.slow
def test_the_drive_gives_what_the_bearings_lose():
    """Two lubricated roller bearings with sliding, cage and drag, a gear and a drive: torques times speed are the sum
    of all losses, as exactly as each bearing closes its own balance. The results of the rollers that slide are those of
    the load on the shaft, and the life is modified by the oil that they have."""
    system = sliding_pair([Section(0.2, 0.06)])
    speed = float(system.shaft.speed)
    solved = jb.solve(system)
    torque = solved.torque
    np.testing.assert_allclose(float(torque.forces), 50.0, rtol=1e-14)
    np.testing.assert_allclose((torque.forces + torque.drive) * speed, torque.power_loss, rtol=1e-9)
    for one in solved.bearings.values():
        closed = one.solution.inner_torque * speed
        np.testing.assert_allclose(closed, one.solution.power_loss.total, rtol=1e-9)
        np.testing.assert_allclose(one.solution.force, one.force, rtol=1e-12)
        assert np.isfinite(one.life.Lnmr)
        assert float(one.life.viscosity_ratio) > 0.0


def sliding_pair(sections=(), at=0.08, tangential=1e3):
    """Two cylindrical roller bearings with films, traction, cage and rating on a shaft."""
    scene = dataclasses.replace(jb.load_scene("reference_roller"), rating=Rating(contamination_factor=0.5))
    return ShaftSystem(
        Shaft(float(scene.operation.inner_speed), sections, steel(206e9)),
        bearings=[MountedBearing("A", scene, 0.02), MountedBearing("B", scene, 0.18)],
        forces=[PointLoad("load", at, radial=8e3, tangential=tangential, radius=0.05)],
    )


@pytest.mark.slow
def test_rollers_that_slide_without_tilt_are_their_own_model():
    """In the middle of a rigid shaft the load does not tilt the rings: force, films, loss, kappa and all lives are
    those of the bearing alone under half of the load."""
    system = sliding_pair(at=0.1, tangential=0.0)
    alone = jb.solve(system.bearings[0].scene.replace({"operation.radial_load": 4e3}))
    same = lambda found, value: np.testing.assert_allclose(found, value, rtol=1e-8, atol=1e-12)
    for one in jb.solve(system).bearings.values():
        np.testing.assert_allclose(one.force[1:3], [4e3, 0.0], rtol=1e-9, atol=1e-6)
        same(one.ring.radial, alone.ring.radial)
        same(one.largest_load, jnp.max(alone.elements.load_inner))
        same(one.solution.power_loss.total, alone.power_loss.total)
        same(one.solution.elements.film_inner, alone.elements.film_inner)
        for name in ("viscosity_ratio", "modification_factor", "L10", "L10r", "Lnmr", "contact_static_safety"):
            same(getattr(one.life, name), getattr(alone.life, name))


def test_changes_by_names():
    system = gear_shaft()
    changed = system.replace({"force.pinion.torque": 50.0, "bearing.rear.geometry.diametral_clearance": 4e-5})
    assert float(changed.forces[0].torque) == 50.0
    assert float(changed.bearings[0].scene.geometry.diametral_clearance) == 4e-5
    assert float(changed.at_operation(speed=3.0).shaft.speed) == 3.0


def test_what_a_shaft_does_not_take():
    with pytest.raises(ValueError, match="found none, expected at least one bearing"):
        ShaftSystem(Shaft(0.0))
    with pytest.raises(ValueError, match=r"rear\.position: 250 mm lies beyond the shaft"):
        gear_shaft().replace({"bearing.rear.position": 0.25})
    with pytest.raises(ValueError, match=r"set\.picture must be two or more signs"):
        MatchedSet("set", "<o>", P, 0.0, 1e-2)
    with pytest.raises(ValueError, match="expected none of a tandem '<<'"):
        MatchedSet("set", "<<", P, 0.0, 1e-2, PRELOAD)
    with pytest.raises(ValueError, match="preload must have one of force"):
        Preload(force=1.0, offset=1e-6)
    with pytest.raises(ValueError, match=r"bearing\.A: this name is given 2 times"):
        ShaftSystem(Shaft(0.0), bearings=[MountedBearing("A", DEEP_GROOVE, 0.0)] * 2)
    with pytest.raises(ValueError, match=r"inner_diameter .* must be smaller"):
        Section(0.1, 0.03, 0.04)
    assert RPM > 0


@pytest.mark.slow
def test_random_shafts():
    """Three bearings, one of them of another family, with clearance, closure, light and heavy loads: all are solved."""
    draw = np.random.default_rng(5)

    def solved(x):
        groove = DEEP_GROOVE.replace_geometry(diametral_clearance=x[0])
        system = ShaftSystem(
            Shaft(x[1], [Section(0.14, 0.025), Section(0.16, 0.03)], steel(206e9)),
            bearings=[
                MountedBearing("A", groove, 0.02, closure=x[2]),
                MountedBearing("M", NU.replace_geometry(diametral_clearance=x[3]), 0.15),
                MountedBearing("B", groove, 0.28, "-x"),
            ],
            forces=[PointLoad("load", x[4], axial=x[5], radial=x[6], tangential=x[7], radius=0.03)],
        )
        one = jb.solve(system, throw=False)
        return one.status, one.start_steps, one.newton_steps, one.residual_norm

    count = 60
    signed = lambda: draw.choice([-1.0, 1.0], count) * 10.0 ** draw.uniform(0.0, 3.7, count)
    numbers = np.stack([
        draw.uniform(-3e-6, 60e-6, count),
        draw.uniform(0.0, 1500.0, count),
        draw.uniform(-30e-6, 60e-6, count),
        draw.uniform(-15e-6, 60e-6, count),
        draw.uniform(0.0, 0.3, count),
        0.3 * signed(),
        signed(),
        signed(),
    ], axis=1)  # fmt: skip
    compiled = jax.jit(solved)
    found = [[float(one) for one in compiled(row)] for row in numbers]
    status, start, newton, residual = np.asarray(found).T
    print("steps", start.mean(), start.max(), newton.mean(), newton.max(), "failed", np.flatnonzero(status))
    assert np.sum(status == jb.Status.CONVERGED) == count
    assert np.max(residual) < 1e-8


def test_traced_positions_beyond_the_shaft_are_invalid(lanes):
    """The rules between two parts of a scene, which eager copies raise, are flagged in the lanes that break them."""
    assert int(lanes["as it is"].status) == Status.CONVERGED
    assert np.isfinite(lanes["as it is"].shaft.displacement).all()
    for name in ("bearing beyond", "load beyond"):
        ((path, place),) = LANES[name].items()
        assert int(lanes[name].status) == Status.INVALID_INPUT
        assert np.isnan(lanes[name].shaft.displacement).all()
        assert lanes[name].failure() == f"invalid_input: {path} must lie within the length of the shaft"
        with pytest.raises(ValueError, match=rf"{path}: .* mm lies beyond the shaft \(200 mm\)"):
            linear_shaft().replace({path: place})


def test_states_are_judged_as_the_scenes_that_they_make():
    """By themselves where their numbers are known, each in its own solve where they are traced."""
    system = linear_shaft()
    beyond, apart = {"bearing.B.position": 0.25}, "state '2': bearing.B.position: 250 mm lies beyond the shaft"
    for changes, message in ((beyond, apart), ({"force.load.radius": -1.0}, "state '2': force.radius must be >= 0")):
        with pytest.raises(ValueError, match=message):
            dataclasses.replace(system, states=(ShaftState(0.5), ShaftState(0.5, changes)))
    with pytest.raises(AttributeError, match=r"'force\.none'"):
        dataclasses.replace(system, states=(ShaftState(1.0, {"force.none.torque": 1.0}),))

    @jax.jit
    def solve(share, place):
        states = (ShaftState(0.5), ShaftState(share, {"bearing.B.position": place}))
        return jb.solve(dataclasses.replace(system, states=states), throw=False)

    assert int(solve(0.5, 0.17).status) == Status.CONVERGED
    found = solve(0.5, 0.25)
    assert found.duty.states.status.tolist() == [Status.CONVERGED, Status.INVALID_INPUT]
    assert found.failure() == "invalid_input: bearing.B.position must lie within the length of the shaft in every state"
    assert solve(0.6, 0.17).failure() == "invalid_input: state.share must add up to 1 over the states"


def test_more_bearings_or_states_than_can_be_solved_are_refused(monkeypatch):
    """10 000 bearings, or 100 000 states, would compile for hours."""
    system = linear_shaft()
    monkeypatch.setattr(scene, "MOST_STATES", 2)
    with pytest.raises(ValueError, match="state: found 3, expected at most 2"):
        dataclasses.replace(system, states=[ShaftState(1.0 / 3.0)] * 3)
    monkeypatch.setattr(scene, "MOST_BEARINGS", 1)
    with pytest.raises(ValueError, match="bearing: found 2, expected at most 1"):
        dataclasses.replace(system)


def test_growth_between_two_fixed_bearings():
    r"""A shaft that grows by $\epsilon L$ between bearings of axial stiffness k is pressed by
    $F = \epsilon L/(2/k + L/(EA))$, with equal and opposite forces on both ends."""
    stiffness, strain, distance, area = 1e8, 2e-4, 0.16, np.pi / 4.0 * 0.03**2
    solved = jb.solve(on_springs(PLAIN, stiffness, strain=strain))
    expected = strain * distance / (2.0 / stiffness + distance / (206e9 * area))
    found = [float(one.on_shaft[0]) for one in solved.bearings.values()]
    np.testing.assert_allclose(found, [expected, -expected], rtol=1e-9)
