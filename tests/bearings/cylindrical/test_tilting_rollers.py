"""Cylindrical rollers that tilt, with profiles: the plane model as limit, closures, degrees of freedom, life and
gradients."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing, RollerGeometry
from jaxbearing.bearings.cylindrical.tilting_steady import build_tilting
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.parts import Materials
from jaxbearing.bearings.profile import RollerProfile
from jaxbearing.bearings.rating import Rating
from jaxbearing.contacts import CrownedProfile, LogarithmicProfile, SlicedLine, StraightLine
from jaxbearing.contacts.minimum_film import LINE_SHARE
from jaxbearing.materials import Material
from jaxbearing.numerics.arrow import ArrowPoint, evaluate
from jaxbearing.numerics.precision import as_float
from jaxbearing.solve import jit_solver

DRY = dict.fromkeys(("contact", "oil", "cage", "flange", "drag"))
TIGHT = jb.NewtonOptions(residual_tolerance=1e-13, step_tolerance=1e-11)


def roller(profile=None, **operation):
    """The dry bearing of `turbine_roller`."""
    scene = jb.load_scene("turbine_roller").replace({**DRY, "rating": Rating(), "profile": profile})
    return scene.replace({f"operation.{name}": value for name, value in operation.items()})


LOGARITHMIC = RollerProfile(LogarithmicProfile(5e-6))


@pytest.fixture(scope="module")
def tilted():
    return jit_solver(roller(LOGARITHMIC, misalignment=1e-3), options=TIGHT)


def test_straight_aligned_rollers_are_the_plane_model():
    plain, cut = jb.solve(roller()), jb.solve(roller(RollerProfile()))
    np.testing.assert_allclose(cut.elements.load_inner, plain.elements.load_inner, atol=1e-9 * 4200.0)
    np.testing.assert_allclose(cut.elements.load_outer, plain.elements.load_outer, rtol=1e-10)
    np.testing.assert_allclose(cut.elements.pressure_inner, plain.elements.pressure_inner, rtol=1e-9, atol=1.0)
    np.testing.assert_allclose(cut.ring.radial, plain.ring.radial, rtol=1e-11)
    np.testing.assert_allclose(cut.life.damage_rate, plain.life.damage_rate, rtol=1e-10)
    np.testing.assert_allclose(cut.stiffness[1, 1], plain.stiffness[1, 1], rtol=1e-8)
    assert plain.laminae is None
    assert (plain.unknowns, cut.unknowns) == (1, 61)


def test_laminae_only_where_a_profile_asks_for_them():
    assert isinstance(build_tilting(roller(misalignment=1e-3)).line, StraightLine)
    assert isinstance(build_tilting(roller(RollerProfile(), misalignment=1e-3)).line, SlicedLine)


@pytest.mark.slow
def test_straight_rollers_that_tilt_are_integrated_exactly():
    """14 straight rollers, some of which touch over a part of their length: `stiffness[1, 3]` of a solution with 40
    digits (30 laminae gave 73 991.77), and the tangent is the derivative of the force. The life has laminae."""
    steel = Material(206e9, 0.3, 7850.0)
    bearing = CylindricalRollerBearing(
        RollerGeometry(14, 65e-3, 12e-3, 12e-3, 30e-6),
        Materials(steel, steel),
        Operation(5000.0 * np.pi / 30.0, radial_load=1e3),
    )
    react = jax.jit(lambda q: jb.reaction(bearing, q, throw=False))
    place = np.array([0.0, -35e-6, 10e-6, -4e-4, 0.0])
    held = react(place)
    np.testing.assert_allclose(held.stiffness[1, 3], 75300.346, rtol=1e-8)
    np.testing.assert_allclose(np.sum(held.laminae.inner, axis=1), held.elements.load_inner, rtol=2e-4, atol=1e-6)
    assert held.laminae.inner.shape == (14, 30)
    # the pressure is that of the end which carries most, 0.17 % above that of its lamina
    np.testing.assert_allclose(np.max(held.elements.pressure_inner), 1.7754576e9, rtol=1e-6)
    unit = np.array([1.0, 1.0, 1.0, 5e-3, 5e-3])  # a tilt as a length
    for q in (place, place * [0.0, 1.0, 1.0, 1.3, 1.0], place + np.array([0.0, 0.0, 0.0, 0.0, 7e-4])):
        tangent = np.asarray(react(q).stiffness) / np.outer(unit, unit)
        for i in range(1, 5):
            step = 1e-10 / unit * (np.arange(5) == i)
            slope = (react(q + step).force - react(q - step).force) / unit / 2e-10
            np.testing.assert_allclose(slope, tangent[:, i], rtol=0, atol=1e-7 * np.max(tangent))


def test_balances_close(tilted):
    found = tilted(misalignment=2e-3)
    e, load = found.elements, 25e3
    np.testing.assert_allclose(np.sum(e.load_inner * np.cos(e.azimuth)), load, rtol=1e-11)
    centrifugal = e.load_outer - e.load_inner
    np.testing.assert_allclose(centrifugal, centrifugal[0], rtol=1e-8)
    np.testing.assert_allclose(np.sum(found.laminae.inner, axis=1), e.load_inner, rtol=1e-12, atol=1e-12 * load)
    # moments of both races about the roller's middle are equal, lamina by lamina to their own error
    lever = (np.arange(30) + 0.5) / 30 - 0.5
    both = [np.asarray(side) @ lever for side in (found.laminae.inner, found.laminae.outer)]
    np.testing.assert_allclose(both[0], both[1], atol=2e-3 * np.max(np.abs(both[0])))


def test_equations_are_the_gradient_of_the_energy():
    rng = np.random.default_rng(2)

    @eqx.filter_jit
    def both(scene):
        system = build_tilting(scene)
        start = system.initial()
        point = ArrowPoint(
            start.elements + jnp.asarray(rng.normal(size=start.elements.shape)),
            start.globals + jnp.asarray(rng.normal(size=start.globals.shape)),
        )
        found = evaluate(system, point).residual
        elements, globals_ = found.elements * system.roller_scale(), found.globals * system.load_scale()
        return jax.grad(system.potential)(point), 1e-5 * elements, 1e-5 * globals_

    slope, elements, globals_ = both(jax.tree.map(as_float, roller(LOGARITHMIC, moment=20.0)))
    np.testing.assert_allclose(elements, slope.elements, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(globals_, slope.globals, rtol=1e-8, atol=1e-9)


@pytest.mark.slow
def test_moment_and_misalignment_are_two_sides_of_one_state(tilted):
    held = tilted(misalignment=8e-4)
    lever = 12.4e-3 * ((np.arange(30) + 0.5) / 30 - 0.5)
    free = jb.solve(roller(LOGARITHMIC, moment=15.0), options=TIGHT)
    again = tilted(misalignment=free.ring.tilt)
    np.testing.assert_allclose(again.elements.load_inner, free.elements.load_inner, rtol=1e-8, atol=1e-6)
    # the reaction: a tilt that moves azimuth 0 axially lifts the rollers' far ends there
    reaction = -np.sum((np.asarray(free.laminae.inner) @ lever) * np.cos(free.elements.azimuth))
    np.testing.assert_allclose(reaction, 15.0, rtol=2e-3)
    assert held.ring.tilt == 8e-4
    np.testing.assert_allclose(free.stiffness, free.stiffness.T, atol=1e-8 * float(free.stiffness[1, 1]))


def test_misalignment_shortens_life_and_its_sign_does_not_matter(tilted):
    lives = [float(tilted(misalignment=tilt).life.L10r) for tilt in (0.0, 1e-3, 2e-3, -2e-3)]
    assert lives[0] > lives[1] > lives[2]
    np.testing.assert_allclose(lives[3], lives[2], rtol=1e-9)


@pytest.mark.slow
def test_large_tilt_of_a_preloaded_bearing_converges(tilted):
    scene = roller(RollerProfile(CrownedProfile(8e-6, 0.5)), misalignment=5e-3)
    found = jb.solve(scene.replace({"geometry.diametral_clearance": -20e-6, "operation.inner_speed": 0.0}))
    assert bool(found.converged)
    assert np.all(np.isfinite(found.stiffness))
    assert bool(tilted(misalignment=0.02, radial_load=100.0).converged)


@pytest.mark.slow
def test_gradients_of_life(tilted):
    """F5: profile drop, clearance and tilt against central differences, to 1e-6."""

    def life(drop, clearance, tilt):
        changed = roller(LOGARITHMIC, misalignment=tilt).replace(
            {"geometry.diametral_clearance": clearance, "profile.shape.drop": drop}
        )
        return jb.solve(changed, throw=False, options=TIGHT).life.L10r

    point = (5e-6, 30e-6, 1e-3)
    value = jax.jit(life)
    slopes = jax.jit(jax.grad(life, argnums=(0, 1, 2)))(*point)
    assert np.isfinite(value(*point))
    for i in range(3):
        step = 2e-4 * point[i]
        at = lambda k, i=i, step=step: value(*(x + (k * step if j == i else 0.0) for j, x in enumerate(point)))
        difference = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * step)
        np.testing.assert_allclose(slopes[i], difference, rtol=1e-6)


def test_refusals():
    with pytest.raises(ValueError, match="sets the tilt free"):
        roller(misalignment=1e-3, moment=0.0)


@pytest.fixture(scope="module")
def lubricated():
    scene = jb.load_scene("turbine_roller", {"contact.rolling_resistance": "ertel_grubin"})
    rating = Rating(roughness_rings=1e-7, roughness_elements=1e-7)
    scene = scene.replace(dict.fromkeys(("contact.traction", "cage", "flange", "drag")) | {"rating": rating})
    return scene.replace({"operation.misalignment": 1e-3, "profile": LOGARITHMIC})


@pytest.mark.slow
@pytest.mark.parametrize("speeds", [(1100.0, 0.0), (1100.0, -400.0)])
def test_rolling_takes_the_power_that_the_rings_bring(lubricated, speeds):
    """Ring torques are assembled from forces times levers, the loss from resistances times speeds."""
    found = jb.solve(lubricated.at_operation(inner_speed=speeds[0], outer_speed=speeds[1]))
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-12)
    np.testing.assert_allclose(found.inner_torque * speeds[0] + found.outer_torque * speeds[1], found.drive_power)
    assert found.power_loss.rolling_resistance > 0
    assert found.power_loss.inner_raceway is None
    dry = jb.solve(lubricated.replace({"contact.rolling": None}))
    assert dry.power_loss.rolling_resistance is None


@pytest.mark.slow
def test_films_of_laminae(lubricated):
    tilted_ = jb.solve(lubricated)
    e = tilted_.elements
    # rollers outside the loaded zone float on their films
    assert np.min(e.load_inner) > 0.0
    assert np.min(e.load_inner) < 1e-2 * np.max(e.load_inner)
    loaded = np.asarray(e.load_inner) > 10.0
    assert np.all(e.film_least_inner[loaded] < e.film_inner[loaded])
    thinnest = LINE_SHARE * e.film_least_inner  # of the lamina: minimum over central film
    np.testing.assert_allclose(tilted_.life.film_ratio_inner, thinnest / np.hypot(1e-7, 1e-7))
    assert tilted_.life.viscosity_ratio > 0.1
    # aligned straight rollers: all laminae alike, and the films of the plane model
    even = jb.solve(lubricated.replace({"operation.misalignment": 0.0, "profile": RollerProfile()})).elements
    np.testing.assert_allclose(even.film_least_inner, even.film_inner, rtol=1e-9)
    plane = jb.solve(lubricated.replace({"operation.misalignment": None, "profile": None})).elements
    np.testing.assert_allclose(even.film_inner, plane.film_inner, rtol=1e-9)


def test_absurd_tilts_are_said(tilted):
    said = lambda **point: " ".join(text for text, on in tilted(**point).range_checks.items() if on)
    assert said(misalignment=5e-4) == ""
    absurd = said(misalignment=0.03)
    for words in ("4 GPa", "more than 10 mrad", "on an edge", "whole clearance"):
        assert words in absurd
