"""Mixed friction and hysteresis in bearings: energy, parts of the loss, limits, gradients, batches, files, curve."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.contacts import GreenwoodTrippPressure, ZhouHoeprich
from jaxbearing.numerics.precision import as_float
from jaxbearing.scenes.errors import SceneError
from jaxbearing.solve import jit_solver

ROUGH = {"contact.mixed.roughness": "0.3 um"}
TAPERED = ROUGH | {"contact.mixed.flange_roughness": "0.24 um", "drag": "none", "rating": "none"}
ROLLERS = ROUGH | {"contact.hysteresis": "0.005", "operation.inner_speed": "1000 rpm"}
BALLS = ROUGH | {
    "contact.film": "nijenbanning",
    "contact.traction": "maxwell_eyring",
    "contact.traction_accuracy": "1e-2",
    "contact.hysteresis": "0.005",
    "oil.name": "mobil_jet_ii",
    "operation.oil_temperature": "80 degC",
    "operation.inner_speed": "300 rpm",
    "operation.axial_load": "1 kN",
    "operation.radial_load": "none",
    "kinematics": "none",
}


@pytest.fixture(scope="module")
def tapered():
    """A compiled solver of the tapered bearing of roughness and speed, rad/s."""
    scene = jb.load_scene("tapered_example", TAPERED)
    arrays = jax.tree.map(as_float, scene)
    where = lambda one: (one.contact.mixed.roughness, one.rib.mixed.roughness, one.operation.inner_speed)
    fast = jit_solver(scene)
    return lambda roughness, speed: fast(eqx.tree_at(where, arrays, (roughness, roughness, speed)))


def add_up(solution, places):
    """The loss is what the rings bring, and boundary friction is a part of it, place by place."""
    assert bool(solution.converged)
    np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)
    boundary = solution.boundary_power
    np.testing.assert_allclose(boundary.total, sum(getattr(boundary, place) for place in places), rtol=1e-14)
    for place in places:
        assert 0.0 < float(getattr(boundary, place)) <= float(getattr(solution.power_loss, place))


@pytest.mark.slow
def test_tapered_bearing_rubs_on_its_rib(tapered):
    found = tapered(0.24e-6, 20.0)
    add_up(found, ["flange"])
    e = found.elements
    np.testing.assert_allclose(e.film_ratio_flange, e.film_flange / 0.24e-6, rtol=1e-14)
    np.testing.assert_allclose(e.load_share_flange, ZhouHoeprich(1.90, 0.99).share(e.film_ratio_flange, 1.0, 1.0))
    np.testing.assert_allclose(e.load_share_inner, ZhouHoeprich().share(e.film_ratio_inner, 1.0, 1.0))
    slide = e.sliding_flange
    force = 0.12 * e.load_share_flange * e.load_flange * slide / np.sqrt(slide**2 + 1e-6)
    np.testing.assert_allclose(e.boundary_flange, force, rtol=1e-12)
    np.testing.assert_allclose(found.boundary_power.flange, jnp.sum(force * slide), rtol=1e-12)
    assert np.all(np.asarray(e.flash_flange) > 0.0)
    assert any("known to a factor of 10" in text for text, broken in found.checks.items() if bool(broken))


@pytest.mark.slow
def test_smooth_surfaces_are_those_without_mixed_friction(tapered):
    """Absent, and with a roughness of nothing: the same to round-off."""
    without = jb.solve(jb.load_scene("tapered_example", {"drag": "none", "rating": "none"}))
    found = tapered(1e-12, float(without.operation.inner_speed))
    assert without.boundary_power is None
    assert float(found.boundary_power.total) == 0.0
    same = lambda solution: jax.tree.leaves((solution.power_loss, solution.inner_torque, solution.ring))
    for one, other in zip(same(found), same(without), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-20)


@pytest.mark.slow
def test_gradients_are_those_of_differences_and_lanes_do_not_mix(tapered):
    loss = lambda roughness, speed: tapered(roughness, speed).power_loss.total
    for argument, step in ((0, 1e-11), (1, 1e-3)):
        point = [0.24e-6, 20.0]
        moved = lambda sign, i=argument, d=step, p=point: [x + sign * d * (i == j) for j, x in enumerate(p)]
        slope = (loss(*moved(1.0)) - loss(*moved(-1.0))) / (2.0 * step)
        np.testing.assert_allclose(jax.grad(loss, argument)(*point), slope, rtol=1e-6)
    both = jax.vmap(lambda roughness: tapered(roughness, 20.0))(jnp.asarray([1e-12, 0.24e-6]))
    for lane, roughness in enumerate((1e-12, 0.24e-6)):
        alone = tapered(roughness, 20.0)
        np.testing.assert_allclose(both.power_loss.total[lane], alone.power_loss.total, rtol=1e-12)
        np.testing.assert_allclose(both.boundary_power.total[lane], alone.boundary_power.total, rtol=1e-11)


@pytest.mark.slow
def test_the_curve_is_continuous_and_has_a_minimum(tapered):
    """Torque over speed: every step of 5 % changes it by less than 5 %; it rises to a peak and falls to a minimum."""
    speeds = np.geomspace(0.01, 600.0, 226)
    loss = np.asarray(jax.lax.map(lambda speed: tapered(0.24e-6, speed).power_loss.total, jnp.asarray(speeds)))
    torque = loss / speeds
    assert np.all(np.isfinite(torque))
    assert np.all(np.abs(np.diff(np.log(torque))) < 0.05)
    peak = int(np.argmax(torque[:150]))
    least = peak + int(np.argmin(torque[peak:]))
    assert 0 < peak < least < speeds.size - 1


def test_rollers_rub_on_both_raceways():
    found = jb.solve(jb.load_scene("reference_roller", ROLLERS))
    add_up(found, ["inner_raceway", "outer_raceway"])
    e = found.elements
    # the scene's film law is that of the minimum film, 0.75 of the central one
    np.testing.assert_allclose(e.film_ratio_outer, e.film_outer / 0.75 / 0.3e-6, rtol=1e-14)
    power = jnp.sum(e.boundary_inner * e.sliding_inner)
    np.testing.assert_allclose(found.boundary_power.inner_raceway, power, rtol=1e-12)
    assert float(found.power_loss.rolling_resistance) > 0.0


def test_hysteresis_costs_the_moment_of_each_roller():
    """Johnson's moment times the rate of the relative roll, without any other friction."""
    changes = {"contact.traction": "none", "cage": "none", "flange": "none", "drag": "none"}
    scene = jb.load_scene("reference_roller", changes | {"contact.hysteresis": "0.005"})
    found = jb.solve(scene)
    e = found.elements
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-12)
    np.testing.assert_allclose(found.power_loss.rolling_resistance, found.power_loss.total, rtol=1e-15)
    contact = scene.race_lines(e)
    load = jnp.stack([e.load_inner, e.load_outer])
    moment = 2.0 / (3.0 * jnp.pi) * 0.005 * load * contact.half_width(load)
    speed = 0.5 * scene.geometry.roller_diameter * jnp.abs(e.spin_speed)
    np.testing.assert_allclose(
        found.power_loss.total, jnp.sum(moment / contact.reduced_radius * speed[None]), rtol=1e-9
    )
    double = jb.solve(scene.replace({"contact.hysteresis": 0.01}))
    np.testing.assert_allclose(double.power_loss.total, 2.0 * found.power_loss.total, rtol=1e-9)


@pytest.mark.slow
def test_balls_rub_and_lose_by_hysteresis():
    found = jb.solve(jb.load_scene("deep_groove_6205", BALLS))
    add_up(found, ["inner_raceway", "outer_raceway"])
    e, parts = found.elements, found.raceway_power
    np.testing.assert_allclose(e.film_ratio_inner, e.film_inner / 0.3e-6, rtol=1e-14)
    assert float(found.boundary_power.inner_raceway) <= float(parts.inner_rolling) * (1.0 + 1e-12)
    assert np.all(np.abs(e.boundary_inner) <= np.abs(e.traction_inner) * (1.0 + 1e-9))
    scene = jb.load_scene("deep_groove_6205", BALLS)
    ellipse = scene.point_contacts(e).ellipse(jnp.stack([e.load_inner, e.load_outer]))
    moment = 3.0 / 16.0 * 0.005 * jnp.stack([e.load_inner, e.load_outer]) * ellipse.rolling
    turns = float(found.power_loss.rolling_resistance / jnp.sum(moment))
    inner = float(jnp.abs(e.spin_speed[0]))
    assert 0.5 * inner < turns < 2.0 * inner


GRADIENTS = {
    "rollers": ("reference_roller", ROLLERS, "0.1 mm/s"),
    "balls": ("deep_groove_6205", BALLS, "5 mm/s"),
}
"""Scene, its changes, and a slide width at which asperities carry a part of the friction."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", GRADIENTS)
def test_gradients_of_rough_raceways_are_those_of_differences(kind):
    """Loss and its boundary part, by factors on roughness, coefficient, slide width, speed and load."""
    name, changes, width = GRADIENTS[kind]
    scene = jb.load_scene(name, changes | {"contact.mixed.slide_width": width})
    arrays, solver = jax.tree.map(as_float, scene), jit_solver(scene)
    load = "radial_load" if kind == "rollers" else "axial_load"

    def where(one):
        mixed, operation = one.contact.mixed, one.operation
        return mixed.roughness, mixed.mu_boundary, mixed.slide_width, operation.inner_speed, getattr(operation, load)

    def losses(factors):
        scaled = tuple(value * factor for value, factor in zip(where(arrays), factors, strict=True))
        found = solver(eqx.tree_at(where, arrays, scaled))
        return jnp.stack([found.power_loss.total, found.boundary_power.total])

    one, step = jnp.ones(5), 1e-3
    value, slopes = losses(one), np.asarray(jax.jit(jax.jacrev(losses))(one))
    assert np.all(np.isfinite(slopes))
    assert np.all(slopes != 0.0)
    # measured: 1e-12 of the loss; 1e-7 of its boundary part, a millionth of it, which rounding of the balance moves
    limit = np.array([1e-10, 1e-6]) * np.asarray(value)
    for place in range(one.size):
        moved = [losses(one.at[place].add(sign * step)) for sign in (-2.0, -1.0, 1.0, 2.0)]
        differences = (moved[0] - 8.0 * moved[1] + 8.0 * moved[2] - moved[3]) / (12.0 * step)
        assert np.all(np.abs(slopes[:, place] - differences) < limit)


# -- files ----------------------------------------------------------------------------------------------------------


def test_files_say_the_law_and_its_constants(tmp_path):
    changes = TAPERED | {
        "contact.mixed.coefficient": "2.1",
        "contact.mixed.exponent": "0.85",
        "contact.mixed.mu_boundary": "0.1",
        "contact.mixed.film": "minimum",
        "contact.hysteresis": "0.007",
    }
    scene = jb.load_scene("tapered_example", changes)
    races, rib = scene.contact.mixed, scene.rib.mixed
    assert (float(races.share.coefficient), float(races.share.exponent)) == (2.1, 0.85)
    assert (float(rib.share.coefficient), float(rib.share.exponent)) == (1.90, 0.99)
    assert (float(races.roughness), float(rib.roughness)) == (pytest.approx(0.3e-6), pytest.approx(0.24e-6))
    assert races.film == rib.film == "minimum"
    assert float(scene.contact.hysteresis) == 0.007
    for one in (scene, jb.load_scene("reference_roller", ROLLERS), jb.load_scene("deep_groove_6205", BALLS)):
        file = tmp_path / f"{one.kind}.toml"
        jb.save_scene(one, file)
        assert eqx.tree_equal(jb.load_scene(file), one)


def test_what_is_left_out_of_balls_is_said():
    noted = any(
        "against the spin of the balls" in note for note in jb.load_scene("deep_groove_6205", BALLS).assumptions()
    )
    assert noted


def test_asperity_pressure_has_its_own_constants():
    changes = {"contact.mixed.share": "greenwood_tripp_pressure", "contact.mixed.asperity_product": "0.03"}
    scene = jb.load_scene("tapered_example", TAPERED | changes)
    for mixed in (scene.contact.mixed, scene.rib.mixed):
        assert isinstance(mixed.share, GreenwoodTrippPressure)
        assert float(mixed.share.asperity_product) == 0.03


@pytest.mark.parametrize(
    ("name", "changes", "words"),
    [
        ("reference_roller", {"contact.traction": "none"}, "a law, without which mixed has no meaning"),
        ("reference_roller", {"contact.mixed.share": "greenwood"}, "'greenwood_tripp'"),
        ("reference_roller", {"contact.mixed.asperity_slope": "0.01"}, "a constant of 'greenwood_tripp_pressure'"),
        ("reference_roller", {"contact.mixed.roughness": "0 um"}, "> 0"),
        (
            "tapered_example",
            {"contact.mixed.share": "greenwood_tripp", "contact.mixed.flange_exponent": "1"},
            "a constant of 'zhou_hoeprich'",
        ),
    ],
)
def test_what_does_not_fit_is_refused(name, changes, words):
    with pytest.raises(SceneError, match=words):
        jb.load_scene(name, ROUGH | changes)


def test_parts_refuse_mixed_friction_without_sliding():
    contact = jb.load_scene("reference_roller", ROUGH).contact
    with pytest.raises(ValueError, match=r"contact\.mixed: mixed friction is of contacts that slide"):
        dataclasses.replace(contact, traction=None)
