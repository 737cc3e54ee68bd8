"""Tapered roller bearing: check values, closures, energy, refusals, degrees of freedom, no equilibrium, stiffness,
gradients."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tapered_cases import CHECKS, G1, RPM, STEEL, check_values, tapered

import jaxbearing as jb
from jaxbearing.bearings.ring import inner_ring
from jaxbearing.bearings.tapered.build import build_tapered, roller_body
from jaxbearing.bearings.tapered.geometry import TaperedGeometry
from jaxbearing.bearings.tapered.steady import tips_over
from jaxbearing.numerics.arrow import ArrowPoint, evaluate
from jaxbearing.numerics.status import Status
from jaxbearing.shafts.batches import pressure_centre
from jaxbearing.solve import jit_solver

CUP = G1["contact_angle"]
TIGHT = jb.NewtonOptions(residual_tolerance=1e-13, step_tolerance=1e-11)
built = eqx.filter_jit(build_tapered)


@pytest.fixture(scope="module")
def solutions():
    """Whether they converged is for the tests to say."""
    return {name: jb.solve(tapered(*loads, **more), throw=False) for name, (loads, more, _) in CHECKS.items()}


@pytest.mark.parametrize("name", CHECKS)
def test_check_values(name, solutions):
    assert bool(solutions[name].converged)
    # printed to 6 digits
    np.testing.assert_allclose(check_values(solutions[name]), CHECKS[name][2], rtol=3e-6, atol=1e-12)


def test_geometry_check_values():
    geometry = TaperedGeometry(**G1)
    values = {
        "big_end_radius": 23.736355e-3,
        "apex_distance": 0.11389849,
        "flange_radius": 20.634142e-3,
        "mean_roller_diameter": 7.6149648e-3,
        "pitch_diameter": 2 * 22.7360392e-3,  # radius of the row in the sheet of several bearings
        "flange_tilt": np.radians(1.686),
        "cone_angle": np.radians(10.036),
    }
    for name, value in values.items():
        np.testing.assert_allclose(getattr(geometry, name), value, rtol=5e-8)
    contact = geometry.flange_contact(206e9 / 0.91)
    # the ellipse is long in the direction of rolling: the rib closes round the sphere
    np.testing.assert_allclose(1.0 / contact.ellipticity(), 6.2139517, rtol=1e-7)
    np.testing.assert_allclose(contact.stiffness_constant(), 1.1670794e11, rtol=5e-8)
    np.testing.assert_allclose(
        1 / contact.reduced_radius_rolling + 1 / contact.reduced_radius_transverse, 9.8115535, rtol=5e-8
    )
    body = roller_body(geometry, jnp.asarray(7850.0))
    np.testing.assert_allclose(body, (3.4322749e-3, 4.6564623e-3, 2.4958943e-8, 3.8752955e-8), rtol=5e-8)
    fast = built(tapered(1e4, rpm=15000)).inertia
    np.testing.assert_allclose((fast.force, fast.moment), (33.7034, 0.0168145), rtol=3e-6)  # printed to 6 digits


def test_where_the_normals_of_the_cup_meet_the_axis():
    """Through the rollers' middles (sheet); the normal at the middle of the cup's line meets it 2.4 % farther out."""
    scene = jb.load_scene("tapered_example")
    geometry = scene.geometry
    np.testing.assert_allclose(pressure_centre(scene), -0.00568390715, rtol=1e-9)
    middle = geometry.apex_distance - 0.5 * geometry.roller_length
    from_apex = -middle / np.cos(float(geometry.contact_angle))
    np.testing.assert_allclose((from_apex + scene.port_distance) / pressure_centre(scene), 1.0240976, rtol=1e-6)


def test_axial_load_in_closed_form(solutions):
    e, half, theta = solutions["A"].elements, G1["roller_half_angle"], np.radians(1.686)
    outer = 10e3 / 17 / np.sin(CUP)
    ratio = np.cos(theta) / np.sin(half), np.sin(theta) / np.cos(half)
    flange = 2.0 * outer / sum(ratio)
    expected = (0.5 * flange * (ratio[0] - ratio[1]), outer, flange)
    np.testing.assert_allclose((e.load_inner[0], e.load_outer[0], e.load_flange[0]), expected, rtol=1e-11)


@pytest.mark.parametrize("name", CHECKS)
def test_loads_close(name, solutions):
    """Forces of the cup equal the loads on the cone, and the moments about the apex too (F1: 1e-9)."""
    loads, more, _ = CHECKS[name]
    e = jax.tree.map(np.asarray, solutions[name].elements)
    axial, radial = loads[0], (loads[1] or 0.0) if len(loads) > 1 else 0.0
    sine, cosine = np.sin(CUP), np.cos(CUP)
    np.testing.assert_allclose(np.sum(e.load_outer) * sine, axial, rtol=1e-9)
    np.testing.assert_allclose(np.sum(e.load_outer * np.cos(e.azimuth)) * cosine, radial, atol=1e-9 * axial)
    cone, rib = np.radians(10.036), G1["flange_angle"]
    np.testing.assert_allclose(np.sum(e.load_inner * np.sin(cone) + e.load_flange * np.cos(rib)), axial, rtol=1e-9)
    along = (e.load_inner * np.cos(cone) - e.load_flange * np.sin(rib)) * np.cos(e.azimuth)
    np.testing.assert_allclose(np.sum(along), radial, atol=1e-9 * axial)
    # moments: those of the cup, of the inertia and of the ring's holder, or the applied one, about the apex
    scene = tapered(*loads, **more)
    three = inner_ring(scene, scene.geometry.apex_distance, ("axial", "radial", "tilt"))
    system = built(scene, three)
    ring, own = jax.tree.map(np.asarray, solutions[name].ring), e
    units, lever = np.asarray(system.units()), system.form.apex_distance
    place = np.stack([own.roller_shift, own.roller_lift, own.roller_tilt]) / units
    point = ArrowPoint(jnp.asarray(place), jnp.asarray(np.stack([ring.axial, ring.radial, ring.tilt * lever]) / 1e-5))
    on_ring, on_cup = (np.asarray(force) for force in forces_on_rings(system, point))
    inertia, gamma = system.inertia, np.radians(12.036)
    a = -G1["roller_diameter"] / 2 * np.cos(gamma) / np.tan(G1["roller_half_angle"]) + inertia.centre * np.cos(gamma)
    # a force outwards at a, and a couple that turns the small end inwards (from a towards r: negative)
    np.testing.assert_allclose(on_cup[0], on_ring[0], rtol=1e-9)
    np.testing.assert_allclose(on_cup[1], on_ring[1] + inertia.force, rtol=1e-9)
    np.testing.assert_allclose(on_cup[2], on_ring[2] + inertia.force * a - inertia.moment, rtol=1e-9)
    # conjugate to t, which is minus the tilt
    applied = -more.get("moment", 0.0)
    if name != "B":
        arm = lever * np.sum(np.abs(on_ring[0]))
        np.testing.assert_allclose(np.sum(on_ring[2] * np.cos(e.azimuth)), applied, atol=1e-9 * arm)
    if name == "B":
        held = np.sum(on_ring[2] * np.cos(e.azimuth))
        np.testing.assert_allclose(held, -1123.4679, rtol=1e-7)
        np.testing.assert_allclose(
            (e.load_inner[8], e.load_outer[8], e.load_flange[8]), (64.3678, 65.8292, 4.8271), rtol=2e-5
        )


@eqx.filter_jit
def forces_on_rings(system, point):
    state = system.at(point)
    return system.ring_force(state), system.cup_force(state)


@pytest.mark.parametrize("laminae", [False, True])
def test_equations_are_the_gradient_of_the_energy(laminae):
    scene = tapered(5e3, 10e3, 5000, moment=600.0, load_position=-0.02)
    if laminae:
        scene = with_profile(scene)
    system = built(scene)
    rng = np.random.default_rng(1)
    start = eqx.filter_jit(lambda system: system.initial())(system)
    for _ in range(4):
        point = ArrowPoint(
            jnp.asarray(np.asarray(start.elements) + rng.normal(size=start.elements.shape)),
            jnp.asarray(np.asarray(start.globals) + rng.normal(size=start.globals.shape)),
        )
        slope, found = jax.tree.map(np.asarray, slopes_of_the_energy(system, point))
        np.testing.assert_allclose(found.elements, slope.elements, rtol=1e-8, atol=1e-8 * np.max(slope.elements))
        np.testing.assert_allclose(found.globals, slope.globals, rtol=1e-8, atol=1e-8 * np.max(slope.globals))


@eqx.filter_jit
def slopes_of_the_energy(system, point):
    """By differentiation, and from the equations with their scales."""
    found = evaluate(system, point).residual
    elements, globals_ = found.elements * system.roller_scale(), found.globals * system.load_scale()
    return jax.grad(system.potential)(point), ArrowPoint(1e-5 * elements, 1e-5 * globals_)


def with_profile(scene):
    from jaxbearing.bearings.profile import RollerProfile
    from jaxbearing.contacts import LogarithmicProfile

    return scene.replace({"profile": RollerProfile(LogarithmicProfile(4e-6))})


REFUSED = {
    "contact_angle": {"contact_angle": 1.6},
    "roller_half_angle": {"roller_half_angle": np.radians(0.2)},
    "roller_half_angle ": {"roller_half_angle": np.radians(7.5)},
    "roller_length": {"roller_length": 0.2},
    "end_radius": {"end_radius": 3e-3},
    "n_rollers": {"n_rollers": 19},
    "flange_angle": {"flange_angle": np.radians(12.5)},
    "flange_angle ": {"flange_angle": np.radians(9.5)},
    "end_radius ": {"roller_half_angle": np.radians(2.0), "end_radius": 300e-3, "flange_angle": np.radians(11.5)},
}


@pytest.mark.parametrize("name", REFUSED)
def test_impossible_bearings_are_refused(name):
    with pytest.raises(ValueError, match=f"geometry.{name.strip()}"):
        TaperedGeometry(**(G1 | REFUSED[name]))


@pytest.mark.slow
def test_one_roller_stands_for_all():
    whole = jb.solve(tapered(10e3, 0.0, 3000, misalignment=0.0))
    one = jb.solve(tapered(10e3, None, 3000))
    assert (one.unknowns, whole.unknowns) == (4, 53)
    for name in ("load_inner", "load_outer", "load_flange", "roller_tilt"):
        np.testing.assert_allclose(getattr(one.elements, name), getattr(whole.elements, name), rtol=1e-9)
    np.testing.assert_allclose(one.stiffness, whole.stiffness, rtol=1e-7, atol=1e-6 * float(whole.stiffness[3, 3]))


def test_reference_point_and_free_tilt():
    """The reference point changes no load: only which displacement and which moment are meant."""
    at_apex = jb.solve(tapered(8e3, 6e3, 3000, moment=660.0))
    position = -0.11
    elsewhere = jb.solve(tapered(8e3, 6e3, 3000, moment=660.0 + position * 6e3, load_position=position))
    np.testing.assert_allclose(elsewhere.elements.load_inner, at_apex.elements.load_inner, rtol=1e-7)
    np.testing.assert_allclose(elsewhere.ring.tilt, at_apex.ring.tilt, rtol=1e-8)
    moved = at_apex.ring.radial - position * at_apex.ring.tilt
    np.testing.assert_allclose(elsewhere.ring.radial, moved, rtol=1e-6, atol=1e-10)
    # held at that tilt the loads are the same
    held = jb.solve(tapered(8e3, 6e3, 3000, misalignment=float(at_apex.ring.tilt)))
    np.testing.assert_allclose(held.elements.load_inner, at_apex.elements.load_inner, rtol=1e-7)


@pytest.mark.slow
def test_stiffness_is_the_derivative_of_the_load(solutions):
    stiffness = solutions["D"].stiffness
    np.testing.assert_allclose(stiffness, stiffness.T, rtol=1e-8, atol=1e-9 * float(stiffness[3, 3]))
    assert np.all(np.linalg.eigvalsh(stiffness) > 0)
    fast = jit_solver(tapered(8e3, 6e3, 3000, moment=660.0), options=TIGHT)
    steps = {"axial_load": (8e3, 20.0), "radial_load": (6e3, 5.0), "moment": (660.0, 0.5)}
    place = lambda **load: np.array([getattr(fast(**load).ring, name) for name in ("axial", "radial", "tilt")])
    compliance = []
    for name, (value, step) in steps.items():
        near, far = (place(**{name: value + k * step}) - place(**{name: value - k * step}) for k in (1, 2))
        compliance.append((8.0 * near - far) / (12.0 * step))
    # lateral degrees of freedom do not couple: the symmetry about the load line
    product = np.array(compliance) @ np.asarray(stiffness)[np.ix_([0, 1, 3], [0, 1, 3])]
    lengths = np.array([1.0, 1.0, 0.114])  # forces over forces, moments over forces times 114 mm
    np.testing.assert_allclose(product * lengths[:, None] / lengths[None, :], np.eye(3), atol=2e-6)


@pytest.mark.parametrize("ratio", [0.98, 0.5])
def test_no_equilibrium(ratio):
    """Below the static bound no distribution of loads balances; above it, however near, one does."""
    radial = 10e3
    scene = lambda axial: tapered(axial, radial, 3000, misalignment=0.0)
    solve = lambda axial: jb.solve(scene(axial), throw=False)
    short = solve(ratio * radial * np.tan(CUP))
    assert int(short.status) == Status.NO_EQUILIBRIUM
    # the bound, with the little that holds the centrifugal forces
    (needed,) = [float(reason.numbers[1]) for reason in short.failure_causes.values() if bool(reason.applies)]
    assert radial * np.tan(CUP) <= needed < 1.01 * radial * np.tan(CUP)
    assert f"must be at least {needed:.6g} N" in short.failure()
    assert bool(solve(1.01 * needed).converged)
    near = solve(1.02 * radial * np.tan(CUP))
    assert bool(near.converged)
    assert int(np.sum(near.elements.load_inner > 0)) < 17
    with pytest.raises(jb.SolveError, match="no_equilibrium"):
        jb.solve(scene(ratio * radial * np.tan(CUP)))
    assert int(solve(-100.0).status) == Status.NO_EQUILIBRIUM


@pytest.mark.slow
def test_gradients_through_the_solve():
    """Also of a partly loaded bearing at rest, whose other rollers touch nothing."""
    scene = tapered(3e3, 10e3)

    def most(numbers):
        changed = scene.at_operation(axial_load=numbers[0], radial_load=numbers[1])
        changed = changed.replace_geometry(end_radius=numbers[2], roller_diameter=numbers[3])
        solution = jb.solve(changed, throw=False, options=TIGHT)
        results = jnp.stack(
            [solution.ring.axial * 1e9, solution.elements.load_inner[0], solution.elements.pressure_outer[0] * 1e-6]
        )
        return results, results

    point = jnp.asarray([3e3, 10e3, 108e-3, 7.95e-3])
    assert np.any(jb.solve(scene).elements.load_outer == 0.0)
    both = jax.jit(jax.jacrev(most, has_aux=True))
    slope, value = both(point)[0], lambda numbers: both(numbers)[1]
    # the end radius hardly moves anything: its differences need a longer step
    for i, relative in enumerate((1e-4, 1e-4, 3e-4, 1e-4)):
        step = relative * point[i]
        near, far = (value(point.at[i].add(k * step)) - value(point.at[i].add(-k * step)) for k in (1, 2))
        np.testing.assert_allclose(slope[:, i], (8.0 * near - far) / (12.0 * step), rtol=1e-6)


@pytest.mark.slow
def test_partial_contact_and_pressures():
    """Misaligned by 2 mrad some rollers touch over a part of their length, and the pressure peaks at an end."""
    e = jb.solve(tapered(8e3, 6e3, 3000, misalignment=2e-3)).elements
    straight = jb.solve(tapered(8e3, 6e3, 3000)).elements
    assert np.max(e.pressure_inner) > 1.2 * np.max(straight.pressure_inner)
    assert np.all(e.pressure_flange >= 0)


@pytest.mark.slow
def test_laminae_of_straight_rollers_find_the_same():
    from jaxbearing.bearings.profile import RollerProfile

    plain = jb.solve(tapered(5e3, 10e3, 3000))
    cut = jb.solve(tapered(5e3, 10e3, 3000).replace({"profile": RollerProfile()}))
    np.testing.assert_allclose(cut.elements.load_inner, plain.elements.load_inner, rtol=1e-6)
    np.testing.assert_allclose(np.sum(plain.laminae.inner, axis=1), plain.elements.load_inner, rtol=1e-5)


@pytest.mark.slow
def test_a_profile_relieves_the_ends():
    straight = jb.solve(tapered(8e3, 6e3, 3000, misalignment=2e-3)).elements
    relieved = jb.solve(with_profile(tapered(8e3, 6e3, 3000, misalignment=2e-3))).elements
    assert np.max(relieved.pressure_inner) < np.max(straight.pressure_inner)


def test_both_rings_turn():
    """As seen from the cage nothing but the centrifugal force changes when both rings turn on."""
    turning = built(tapered(5e3, rpm=3000, outer_speed=3000 * RPM)).inertia
    alone = built(tapered(5e3, rpm=3000)).inertia
    assert turning.force > 4.0 * alone.force
    assert dataclasses.replace(STEEL).density == 7850.0


def test_what_the_cup_can_hold_of_a_moment():
    """Just inside the static bound the solve is left to try, just outside the loads alone prove that nothing balances;
    the same whatever the reference point."""
    geometry = tapered(1e4, 1e3, moment=0.0).geometry
    cup, length = float(geometry.contact_angle), float(geometry.roller_length)
    middle = (float(geometry.apex_distance) - 0.5 * length) * 1e3 / np.cos(cup)
    most = 0.5 * length * 1e4 / np.sin(cup)
    for side in (-1.0, 1.0):
        for share, proved in ((0.999, False), (1.001, True)):
            for place in (0.0, -0.11):
                scene = tapered(1e4, 1e3, moment=middle + side * share * most + place * 1e3, load_position=place)
                assert bool(tips_over(scene)) is proved


def test_loads_on_an_edge_are_warned_of():
    words = "loaded on an edge"
    assert not any(words in text for text in jb.solve(tapered(5e3, 5e3, misalignment=0.0)).warnings)
    assert any(words in text for text in jb.solve(tapered(5e3, 1e4, misalignment=2e-3)).warnings)


def test_a_dry_bearing_has_no_losses(solutions):
    dry = solutions["B"]
    assert dry.power_loss.total is None
    assert (dry.drive_power, dry.inner_torque, dry.elements.film_inner) == (None, None, None)
