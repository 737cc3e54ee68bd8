"""Lubricated rollers that tilt: the plane model without tilt, the dry tilting rollers without films, power, moments,
gradients, parts of a scene."""

import dataclasses
import functools

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import lobes
from roller_cases import reference_roller

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.steady import build_lubricated_tilt, build_system
from jaxbearing.bearings.cylindrical.tilting_steady import build_tilting
from jaxbearing.bearings.profile import RollerProfile
from jaxbearing.bearings.rating import Rating
from jaxbearing.bearings.ring_shape import FlexibleRing, OuterRoundness
from jaxbearing.contacts import LogarithmicProfile
from jaxbearing.contacts.mixed import MixedFriction
from jaxbearing.contacts.oil_supply import Supply
from jaxbearing.numerics.arrow import ArrowPoint, evaluate
from jaxbearing.shafts import MountedBearing, PointLoad, Section, Shaft, ShaftSystem

DRY = dict.fromkeys(("contact", "oil", "cage", "flange", "drag"))
FRICTIONLESS = dict.fromkeys(("contact.traction", "cage", "flange", "drag"))


@pytest.fixture(scope="module")
def scene():
    """Under a moment, with cage, flanges, drag and rating."""
    rating = Rating(contamination_factor=0.5)
    return dataclasses.replace(reference_roller(), rating=rating).replace({"operation.moment": 0.0})


@pytest.fixture(scope="module")
def under(scene):
    """Solutions of the scene by its moment, N m."""
    return functools.cache(lambda moment: jb.solve(scene.replace({"operation.moment": moment})))


def losses(solution):
    return {name: float(value) for name, value in vars(solution.power_loss).items() if value is not None}


def test_without_tilt_all_results_are_those_of_rollers_that_carry_evenly(scene, under):
    even, tilting = jb.solve(scene.replace({"operation.moment": None})), under(0.0)
    for field in dataclasses.fields(even.elements):
        expected, value = getattr(even.elements, field.name), getattr(tilting.elements, field.name)
        if expected is not None:
            # sliding is a difference of speeds of 100 m/s
            np.testing.assert_allclose(
                value, expected, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected)), err_msg=field.name
            )
    assert losses(tilting) == pytest.approx(losses(even), rel=1e-9)
    for name in ("speed", "slip", "eccentricity_ratio", "attitude_angle"):
        np.testing.assert_allclose(getattr(tilting.cage, name), getattr(even.cage, name), rtol=1e-9)
    np.testing.assert_allclose(tilting.ring.radial, even.ring.radial, rtol=1e-11)
    np.testing.assert_allclose(tilting.ring.tilt, 0.0, atol=1e-12)
    np.testing.assert_allclose(tilting.stiffness[1, 1], even.stiffness[1, 1], rtol=1e-8)
    np.testing.assert_allclose(tilting.life.Lnmr, even.life.Lnmr, rtol=1e-9)


def test_under_a_moment_power_and_loads_are_in_balance(scene, under):
    for moment in (20.0, -60.0, 120.0):
        solution = under(moment)
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-11)
        np.testing.assert_allclose(solution.force[3], moment, rtol=1e-9)
        np.testing.assert_allclose(solution.force[1], scene.operation.radial_load, rtol=1e-9)
        elements, laminae = solution.elements, solution.laminae
        for load, along in ((elements.load_inner, laminae.inner), (elements.load_outer, laminae.outer)):
            # two points in each lamina: less exact where the contact ends within a lamina
            np.testing.assert_allclose(np.sum(along, axis=1), load, atol=3e-4 * np.max(load))
        # both races press the roller with one moment: laminae of 30, two points in each
        place = np.arange(30) - 14.5
        inner, outer = (np.asarray(along) @ place for along in (laminae.inner, laminae.outer))
        np.testing.assert_allclose(inner, outer, atol=2e-3 * np.max(np.abs(inner)))
        assert np.max(np.abs(inner)) > 1e3
        assert solution.life.Lnmr < under(0.0).life.Lnmr
        assert solution.life.viscosity_ratio > 0.1


def test_a_mirrored_moment_mirrors_the_laminae(under):
    one, other = under(60.0), under(-60.0)
    np.testing.assert_allclose(one.ring.tilt, -other.ring.tilt, rtol=1e-9)
    np.testing.assert_allclose(one.laminae.inner, other.laminae.inner[:, ::-1], rtol=1e-8, atol=1e-6)
    assert losses(one) == pytest.approx(losses(other), rel=1e-9)


def test_stiffness_is_the_derivative_of_the_moment(under):
    """The tilt under a slightly larger moment."""
    step = 1e-3
    softer = (under(60.0 + step).ring.tilt - under(60.0 - step).ring.tilt) / (2.0 * step)
    stiffness = np.asarray(under(60.0).stiffness)[np.ix_([1, 3], [1, 3])]
    np.testing.assert_allclose(np.linalg.inv(stiffness)[1, 1], softer, rtol=1e-6)


def test_derivatives_of_the_loss_and_the_slip(scene, under):
    def loss(moment):
        solution = jb.solve(scene.replace({"operation.moment": moment}))
        return jnp.stack([solution.power_loss.total, solution.cage.slip])

    slope, step = jax.jacfwd(loss)(jnp.asarray(60.0)), 1e-2
    values = [np.stack([under(60.0 + k * step).power_loss.total, under(60.0 + k * step).cage.slip]) for k in (-1, 1)]
    np.testing.assert_allclose(slope, (values[1] - values[0]) / (2.0 * step), rtol=1e-5)


def test_with_thinner_films_the_loads_become_those_of_dry_rollers(scene):
    dry = jb.solve(scene.replace({**DRY, "operation.moment": 60.0})).elements.load_inner
    frictionless = scene.replace({**FRICTIONLESS, "operation.moment": 60.0})

    def apart(speed):
        # slower rings carry thinner films; both bearings feel the centrifugal force
        at = {"operation.inner_speed": speed}
        thick = jb.solve(frictionless.replace(at)).elements.load_inner
        thin = jb.solve(scene.replace({**DRY, "operation.moment": 60.0, **at})).elements.load_inner
        return np.max(np.abs(thick - thin)) / np.max(dry)

    differences = [apart(speed) for speed in (100.0, 10.0, 1.0)]
    # the film grows with the speed to the power of 0.6 to 0.7
    assert differences[0] > 3.0 * differences[1] > 9.0 * differences[2] > 0.0
    assert differences[2] < 1e-3


def test_without_traction_too_the_films_are_those_of_the_plane_model(scene):
    frictionless = scene.replace(FRICTIONLESS)
    even, tilting = jb.solve(frictionless.replace({"operation.moment": None})), jb.solve(frictionless)
    np.testing.assert_allclose(tilting.ring.radial, even.ring.radial, rtol=1e-11)
    np.testing.assert_allclose(tilting.elements.film_outer, even.elements.film_outer, rtol=1e-9)
    assert tilting.cage is None


def tilted_and_even(scene):
    """The systems of both models, and the state of each at the same place without tilt: no solve."""
    scene = scene.replace({"operation.moment": None})
    even, tilting = build_system(scene), build_lubricated_tilt(scene, build_tilting(scene))
    place = even.initial()
    spin = place.elements[1] + 1e-3 * jnp.cos(even.azimuth)
    slower = place.globals.at[-1].set(-2e-3)
    level = ArrowPoint(jnp.stack([place.elements[0], jnp.zeros_like(spin), spin]), slower)
    return even, even.at(ArrowPoint(jnp.stack([place.elements[0], spin]), slower)), tilting, tilting.at(level)


@pytest.mark.parametrize(
    "parts",
    [
        {"contact.supply": Supply(meniscus_distance=2e-4), "contact.hysteresis": 0.01},
        {"contact.mixed": MixedFriction(roughness=3e-7), "contact.hysteresis": 0.01},
    ],
    ids=["starved", "mixed"],
)
def test_laminae_side_by_side_are_the_whole_contact(scene, parts):
    """Starvation, hysteresis and mixed friction: traction, rolling resistance, forces on roller and cage."""
    even, plane, tilting, cut = tilted_and_even(scene.replace(parts))
    for name in ("film", "traction", "rolling_force"):
        np.testing.assert_allclose(getattr(cut.contact, name), getattr(plane.contact, name), rtol=1e-11, err_msg=name)
    for name in ("moment_error", "cage_moment", "cage_force"):
        expected = np.asarray(getattr(plane, name))
        np.testing.assert_allclose(getattr(cut, name), expected, rtol=1e-9, atol=1e-11 * np.max(np.abs(expected)))
    if "contact.mixed" in parts:
        speeds = (plane.mean_speed, plane.sliding_speed)
        whole = even.laws.mixed_state(even.contact, plane.load, plane.contact, *speeds, even.inlet)
        for name, value in tilting.mixed(cut)._asdict().items():
            np.testing.assert_allclose(value, getattr(whole, name), rtol=1e-10, err_msg=name)


def test_the_oil_flow_is_shared_by_the_laminae(scene):
    """A flow past all contacts starves whole contact and laminae alike."""
    fed = scene.replace({"contact.supply": Supply(from_flow=1.0), "operation.oil_flow": 1e-7})
    _, plane, _, cut = tilted_and_even(fed)
    assert np.all(plane.contact.supply.film_factor < 0.999)
    np.testing.assert_allclose(cut.contact.supply.film_factor, plane.contact.supply.film_factor, rtol=1e-12)
    np.testing.assert_allclose(cut.laminae.supply.film_factor[..., 3], plane.contact.supply.film_factor, rtol=1e-9)


def test_where_only_ends_touch_residuals_and_derivatives_are_finite(scene):
    """Hard places of the iteration: heavy tilts of ring and rollers, empty contacts, a ring far off."""
    tilting = build_lubricated_tilt(scene, build_tilting(scene))
    rng = np.random.default_rng(3)
    n = tilting.azimuth.size
    places = []
    for size in (1.0, 30.0, 1e3):
        for load in (-38.0, 0.0, 8.0, 17.0):
            elements = np.stack([np.full(n, load), rng.normal(size=n) * size, rng.normal(size=n)])
            places.append(ArrowPoint(elements, np.array([size, -3.0 * size, 0.5])))
    stacked = jax.tree.map(lambda *leaves: jnp.stack([jnp.asarray(leaf) for leaf in leaves]), *places)

    def total(point):
        equations = evaluate(tilting, point)
        return jnp.sum(equations.residual.elements) + jnp.sum(equations.residual.globals)

    values, slopes = eqx.filter_jit(jax.vmap(jax.value_and_grad(total)))(stacked)
    assert np.all(np.isfinite(values))
    assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(slopes))


def test_a_moment_beyond_all_tilts_has_no_equilibrium(scene):
    """As of dry rollers: 0.1 rad is the largest tilt that is sought. A batch says so of its lane alone."""
    solve = eqx.filter_jit(lambda moment: jb.solve(scene.replace({"operation.moment": moment}), throw=False))
    solution = eqx.filter_vmap(solve)(jnp.asarray([20.0, 5e3, jnp.nan]))
    expected = [jb.Status.CONVERGED, jb.Status.NO_EQUILIBRIUM, jb.Status.INVALID_INPUT]
    np.testing.assert_array_equal(solution.status, [int(status) for status in expected])
    np.testing.assert_array_equal(np.isfinite(solution.power_loss.total), [True, False, False])


def test_rollers_between_films_are_not_squeezed(scene):
    """Films carry some load opposite a light load, and take up no clearance."""
    light = scene.replace({**FRICTIONLESS, "operation.radial_load": 100.0})
    said = lambda scene: " ".join(text for text, on in jb.solve(scene).range_checks.items() if on)
    assert "whole clearance" not in said(light)
    assert "whole clearance" in said(light.replace({"operation.moment": 150.0, "operation.radial_load": 1e3}))


def test_a_run_in_time_has_no_tilt(scene):
    simulation = jb.load_scene("reference_roller", {"simulation.duration": "1 ms"}).simulation
    with pytest.raises(ValueError, match=r"operation\.moment: expected none in a transient run"):
        dataclasses.replace(scene, simulation=simulation)
    with pytest.raises(ValueError, match="profile: expected none in a transient run"):
        dataclasses.replace(scene.replace({"operation.moment": None}), simulation=simulation, profile=RollerProfile())


@pytest.mark.slow
def test_profiled_rollers_of_a_tilted_and_flexible_ring(scene):
    """Profile, misalignment, flexible outer ring and oval race together, with cage and traction."""
    profile = RollerProfile(LogarithmicProfile(5e-6))
    tilted = scene.replace({"operation.moment": None, "operation.misalignment": 1e-3, "profile": profile})
    oval = lobes(OuterRoundness, 2, 5e-6, 0.3)
    for changes in (
        {"outer_roundness": oval},
        {"outer_ring": FlexibleRing(thickness=0.012, width=0.02, harmonics=8, housing_stiffness=1e10)},
    ):
        solution = jb.solve(tilted.replace(changes))
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-11)
        assert solution.force[3] > 1.0
        assert float(np.max(solution.elements.pressure_inner)) < 4e9


@pytest.mark.slow
def test_a_bearing_on_a_shaft_is_the_bearing_alone():
    """Forces of the shaft are those of the contact results, and the bearing alone at the same displacement and at the
    same loads has the same losses and life."""
    scene = dataclasses.replace(reference_roller(), rating=Rating(contamination_factor=0.5))
    shaft = Shaft(float(scene.operation.inner_speed), [Section(0.2, 0.06)], scene.materials.rings)
    mounted = [MountedBearing("A", scene, 0.02), MountedBearing("B", scene, 0.18)]
    solved = jb.solve(ShaftSystem(shaft, bearings=mounted, forces=[PointLoad("gear", 0.08, radial=8e3)]))
    on_shaft = solved.bearings["A"]
    np.testing.assert_allclose(on_shaft.solution.force, on_shaft.force, rtol=1e-12)
    assert abs(float(on_shaft.force[3])) > 1.0
    held = jb.reaction(scene, on_shaft.ring)
    np.testing.assert_allclose(held.force, on_shaft.force, rtol=1e-9, atol=1e-9)
    loads = dict(
        zip(("radial_load", "radial_load_lateral", "moment", "moment_lateral"), on_shaft.force[1:], strict=True)
    )
    alone = jb.solve(scene.replace({f"operation.{name}": float(value) for name, value in loads.items()}))
    for solution in (held, alone):
        np.testing.assert_allclose(solution.power_loss.total, on_shaft.solution.power_loss.total, rtol=1e-8)
        np.testing.assert_allclose(solution.cage.speed, on_shaft.solution.cage.speed, rtol=1e-10)
    np.testing.assert_allclose(alone.ring.tilt, on_shaft.ring.tilt, rtol=1e-7)
    np.testing.assert_allclose(alone.life.Lnmr, on_shaft.life.Lnmr, rtol=1e-7)
