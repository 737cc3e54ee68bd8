"""Flanges that hold the inner ring of a cylindrical roller bearing along its axis: force, displacement, stiffness.

Expected values are those of the formula, in numpy; row A4 of the check values stands in `test_reaction`.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr

import jaxbearing as jb
from jaxbearing.bearings.bearing_life import with_life
from jaxbearing.bearings.cylindrical.thrust import ThrustFlanges
from jaxbearing.bearings.rating import Rating
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.report.dataset import solution_to_dataset
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.ross import ross_bearing
from jaxbearing.report.stiffness import stiffness_over_speed

K, GAP = 3e8, 50.0 * 1e-6
"""The gap to the last bit as a file's "50 um"."""
DRY = {"contact": "none", "cage": "none"}
FLANGES = {"geometry.flange_stiffness": "3e8 N/m^(10/9)", "geometry.flange_gap": "50 um"}
PLAIN = {
    "evenly loaded": ("reference_roller", DRY),
    "tilting": ("reference_roller", {**DRY, "operation.misalignment": "0.5 mrad"}),
    "sliding": ("reference_roller", {}),
}
MODELS = [name if name == "evenly loaded" else pytest.param(name, marks=pytest.mark.slow) for name in PLAIN]


def bearing(name="evenly loaded", **more):
    file, changes = PLAIN[name]
    return jb.load_scene(file, {**changes, **FLANGES, **{path.replace("__", "."): text for path, text in more.items()}})


def law(displacement):
    """Force and stiffness of two flanges."""
    pressed = np.maximum(np.abs(displacement) - GAP, 0.0)
    return np.sign(displacement) * K * pressed ** (10 / 9), 10 / 9 * K * pressed ** (1 / 9)


@pytest.mark.parametrize("name", MODELS)
def test_the_axial_freedom_and_nothing_else(name):
    plain, scene = jb.load_scene(*PLAIN[name]), bearing(name)
    without, found = jb.solve(plain), jb.solve(scene.at_operation(axial_load=300.0))
    pressed = (300.0 / K) ** 0.9
    np.testing.assert_allclose(found.ring.axial, GAP + pressed, rtol=1e-14)
    np.testing.assert_allclose(found.force[0], 300.0, rtol=0)
    np.testing.assert_allclose(found.stiffness[0, 0], 10 / 9 * 300.0 / pressed, rtol=1e-13)
    assert np.all(np.asarray(found.stiffness)[0, 1:] == 0.0)
    assert np.all(np.asarray(found.stiffness)[1:, 0] == 0.0)
    for name in ("elements", "power_loss", "cage", "iterations"):
        pair = [jax.tree.leaves(getattr(one, name)) for one in (found, without)]
        for one, other in zip(*pair, strict=True):
            np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(found.force[1:], without.force[1:])
    np.testing.assert_array_equal(found.stiffness[1:, 1:], without.stiffness[1:, 1:])
    assert float(found.ring.radial) == float(without.ring.radial)
    # of a bearing without flanges nothing is said about the axis
    assert np.all(np.asarray(without.stiffness)[0] == 0.0)
    assert np.all(np.asarray(without.stiffness)[:, 0] == 0.0)
    assert "axial" not in (*without.freedoms_of_stiffness, *without.ring_freedom, *plain.modelled_freedoms)
    assert found.freedoms_of_stiffness == ("axial", *without.freedoms_of_stiffness)
    assert found.ring_freedom == ("axial", *without.ring_freedom)
    assert found.unknowns == without.unknowns


@pytest.mark.parametrize("name", MODELS)
def test_load_and_displacement_return_each_other(name):
    scene = bearing(name)
    for load in (-2e4, -30.0, 0.5, 300.0, 1e5):
        loaded = jb.solve(scene.at_operation(axial_load=load))
        held = jb.solve(scene.at_operation(displacement={"axial": loaded.ring.axial}))
        # the place is known to its last bits alone, and the touch is 50 um off
        pressed = abs(float(loaded.ring.axial)) - GAP
        assert abs(float(held.force[0]) / load - 1.0) < 2e-15 + 3e-16 * GAP / pressed
        np.testing.assert_allclose(held.force[0], load, rtol=1e-12)
        np.testing.assert_allclose(held.stiffness[0, 0], loaded.stiffness[0, 0], rtol=1e-12)
        np.testing.assert_allclose(held.ring.axial, loaded.ring.axial, rtol=0)
        assert "axial" in held.held_freedom
        assert "axial" not in loaded.held_freedom


def test_the_law_over_displacements():
    """Those of `reaction`, and its closure: `test_reaction`."""
    scene = bearing()
    for place in (-120e-6, -GAP, -49e-6, 0.0, GAP, 50.01e-6, 53e-6, 90e-6):
        found, (force, stiffness) = jb.solve(scene.at_operation(displacement={"axial": place})), law(place)
        np.testing.assert_allclose(found.force[0], force, rtol=1e-12)
        np.testing.assert_allclose(found.stiffness[0, 0], stiffness, rtol=1e-12)


@pytest.mark.parametrize(("thrust", "side"), [("+x", 1.0), ("-x", -1.0)])
def test_a_flange_on_one_side(thrust, side):
    scene = bearing(geometry__thrust=thrust)
    for place in (-90e-6, 90e-6):
        held = jb.solve(scene.at_operation(displacement={"axial": place}))
        force, stiffness = law(place) if place * side > 0 else (0.0, 0.0)
        np.testing.assert_allclose(held.force[0], force, rtol=1e-12)
        np.testing.assert_allclose(held.stiffness[0, 0], stiffness, rtol=1e-12)
    away = r"operation\.axial_load must be a force [<>]= 0, got -?300 N: the flange carries no load the other way"
    with pytest.raises(ValueError, match=away):
        scene.at_operation(axial_load=-300.0 * side)
    with pytest.raises(
        jb.SceneError, match=r"operation\.axial_load: found the text '-?300 N'; expected a force [<>]= 0"
    ):
        bearing(geometry__thrust=thrust, operation__axial_load=f"{-300 * side:g} N")
    solve = jax.jit(jax.vmap(lambda load: jb.solve(scene.at_operation(axial_load=load), throw=False)))
    batch = solve(jnp.asarray([300.0, -300.0, 0.0]) * side)
    assert batch.status.tolist() == [jb.Status.CONVERGED, jb.Status.INVALID_INPUT, jb.Status.CONVERGED]
    np.testing.assert_allclose(batch.ring.axial[0], side * (GAP + (300.0 / K) ** 0.9), rtol=1e-14)
    for results in (batch.force, batch.stiffness, batch.ring.axial, batch.elements.load_inner):
        assert np.all(np.isnan(results[1]))
    failed = jax.tree.map(lambda leaf: leaf[1], batch)
    assert "operation.axial_load must be a force" in failed.failure()


def test_no_axial_load_leaves_the_ring_in_its_play():
    for scene in (bearing(), bearing().at_operation(axial_load=0.0)):
        found = jb.solve(scene)
        assert (float(found.ring.axial), float(found.force[0]), float(found.stiffness[0, 0])) == (0.0, 0.0, 0.0)
        assert any("inside its play" in text for text in found.warnings)


def test_what_is_refused():
    plain = jb.load_scene(*PLAIN["evenly loaded"])
    for wrong in ({"axial_load": 1.0}, {"axial_load": 0.0}, {"displacement": {"axial": 1e-6}}):
        with pytest.raises(ValueError, match=r"operation\.(axial_load|displacement\.axial): .*no axial freedom"):
            plain.at_operation(**wrong)
    with pytest.raises(ValueError, match=r"operation\.axial_load: .*no axial freedom"):
        jax.jit(lambda load: jb.solve(plain.at_operation(axial_load=load)).status)(1.0)
    with pytest.raises(ValueError, match=r"operation\.displacement\.axial: expected none beside operation\.axial_load"):
        bearing().at_operation(axial_load=1.0, displacement={"axial": 1e-6})
    with pytest.raises(ValueError, match=r"geometry\.flange_gap: found nothing, expected a length, which"):
        plain.replace_geometry(flange_stiffness=K)
    with pytest.raises(ValueError, match=r"geometry\.flange_gap: expected none without geometry\.flange_stiffness"):
        plain.replace_geometry(flange_gap=GAP)
    with pytest.raises(ValueError, match=r"geometry\.thrust: expected none without geometry\.flange_stiffness"):
        plain.replace_geometry(thrust="+x")
    with pytest.raises(ValueError, match=r"geometry\.thrust must be one of 'both', '\+x', '-x', got 'left'"):
        bearing().replace_geometry(thrust="left")
    for name, value in (("flange_stiffness", 0.0), ("flange_gap", -1e-6)):
        with pytest.raises(ValueError, match=rf"geometry\.{name} must be >=? 0"):
            bearing().replace_geometry(**{name: value})
    run = jb.load_scene("turbine_roller_dynamic", FLANGES)
    for name, wrong in (
        ("axial_load", {"axial_load": 1.0}),
        (r"displacement\.axial", {"displacement": {"axial": 0.0}}),
    ):
        with pytest.raises(
            ValueError, match=rf"operation\.{name}: a transient run moves the ring across the axis only"
        ):
            run.at_operation(**wrong)
    given = jb.load_scene("reference_roller", {**DRY, **FLANGES})
    assert given.modelled_freedoms == RING_FREEDOMS


BOTH, ONE = (ThrustFlanges(jnp.asarray(K), jnp.asarray(GAP), sides) for sides in ((1.0, -1.0), (1.0,)))


def central(function, place, step):
    return (function(place + step) - function(place - step)) / (2.0 * step)


@pytest.mark.parametrize("flanges", [BOTH, ONE], ids=["both", "+x"])
def test_derivatives_away_from_the_touch(flanges):
    slope = jax.jit(jax.grad(flanges.force))
    for place in (53e-6, 90e-6):
        np.testing.assert_allclose(slope(place), central(flanges.force, place, 1e-9), rtol=1e-7)
        np.testing.assert_allclose(jax.grad(slope)(place), central(slope, place, 1e-9), rtol=1e-7)
    for number in (0, 1):
        under = jax.jit(lambda load, number=number: flanges.under(load)[number])
        for load in (0.5, 300.0):
            np.testing.assert_allclose(jax.grad(under)(load), central(under, load, 1e-4 * load), rtol=1e-7)


@pytest.mark.parametrize("flanges", [BOTH, ONE], ids=["both", "+x"])
def test_derivatives_at_the_touch_are_finite(flanges):
    """The force has a slope there, 0, that of the stiffness has no bound on one side and is 0 on the other."""
    stiffness = jax.grad(lambda place: flanges.force(place))
    for place in (GAP, -GAP, 0.0):
        assert float(flanges.force(place)) == 0.0
        assert float(stiffness(place)) == 0.0
        assert float(jax.grad(stiffness)(place)) == 0.0
        assert np.all(np.isfinite(jax.jvp(stiffness, (place,), (1.0,))))
        slopes = jax.grad(lambda flanges, place=place: flanges.force(place))(flanges)
        assert [float(slopes.stiffness), float(slopes.gap)] == [0.0, 0.0]
    # C1: the slope of the force leaves 0 as its ninth root
    np.testing.assert_allclose(stiffness(GAP + 1e-12), law(GAP + 1e-12)[1], rtol=1e-12)
    for number in (0, 1):
        under = lambda load, number=number: flanges.under(load)[number]
        assert float(under(0.0)) == 0.0
        assert float(jax.grad(under)(0.0)) == 0.0
        assert np.all(np.isfinite(jax.jvp(under, (0.0,), (1.0,))))
        slopes = jax.grad(lambda flanges, number=number: flanges.under(0.0)[number])(flanges)
        assert [float(slopes.stiffness), float(slopes.gap)] == [0.0, 0.0]
        assert np.isfinite(jax.grad(under)(1e-30))


def test_derivatives_of_a_solution():
    scene = bearing()

    def place(load, stiffness, gap):
        changed = scene.replace_geometry(flange_stiffness=stiffness, flange_gap=gap).at_operation(axial_load=load)
        found = jb.solve(changed, throw=False)
        return found.ring.axial, found.stiffness[0, 0], found.ring.radial

    point, steps = (300.0, K, GAP), (1e-2, 1e4, 1e-9)
    slopes_at = jax.jacrev(place, (0, 1, 2))
    slopes = slopes_at(*point)
    for i, step in enumerate(steps):
        ends = [place(*(x + sign * step * (j == i) for j, x in enumerate(point))) for sign in (1.0, -1.0)]
        for result, (high, low) in enumerate(zip(*ends, strict=True)):
            expected = (high - low) / (2.0 * step)
            scale = abs(float(high)) / abs(point[i])
            np.testing.assert_allclose(slopes[result][i], expected, rtol=1e-6, atol=1e-9 * scale)
    for load in (0.0, 300.0):
        assert np.all(np.isfinite(slopes_at(load, K, GAP)[0]))
    # forward mode, all three numbers together; the slope of `reaction`: `test_reaction`
    along = jax.jvp(place, point, point)[1]
    parts = np.asarray(slopes) * np.asarray(point)
    np.testing.assert_allclose(along, parts.sum(axis=1), rtol=1e-9, atol=1e-9 * np.max(np.abs(parts[2])))


def test_a_failed_lane_spoils_no_derivative():
    """The lane that points away from the flange shares its numbers with the other one."""
    scene = bearing(geometry__thrust="+x")

    def total(stiffness, loads):
        solve = lambda load: jb.solve(
            scene.replace_geometry(flange_stiffness=stiffness).at_operation(axial_load=load), throw=False
        )
        found = jax.vmap(solve)(loads)
        return jnp.sum(jnp.where(found.converged, found.ring.axial, 0.0))

    slope = jax.jit(jax.grad(total))
    mixed, good = (slope(K, jnp.asarray([300.0, other])) for other in (-300.0, 300.0))
    np.testing.assert_allclose(mixed, 0.5 * good, rtol=1e-14)
    np.testing.assert_allclose(mixed, -0.9 * (300.0 / K) ** 0.9 / K, rtol=1e-12)


def test_where_the_axial_freedom_shows():
    scene = bearing(operation__axial_load="300 N")
    found = jb.solve(scene)
    text = str(found)
    for said in ("axial load 0.3 kN", "axial displacement", "axial 83.73 N/um", "not modelled: lateral, tilt"):
        assert said in " ".join(text.split())
    told = solution_to_dict(found)
    np.testing.assert_allclose(told["ring"]["axial"], GAP + (300.0 / K) ** 0.9)
    assert told["force"][0] == 300.0
    assert told["stiffness"][0][0] == float(found.stiffness[0, 0])
    dataset = solution_to_dataset(found)
    assert isinstance(dataset, xr.Dataset)
    assert dataset["freedom_modelled"].values.tolist() == [1, 1, 0, 0, 0]
    np.testing.assert_allclose(dataset["ring_axial"], found.ring.axial)
    held = jb.solve(bearing(operation__displacement__axial="53 um"))
    assert f"Held by axial load {law(53e-6)[0]:.1f} N" in " ".join(str(held).split())
    shown = " ".join(str(scene).split())
    assert "flange_stiffness 64.633 N/um^(10/9)" in shown
    assert "flange_gap 50 um" in shown


def test_stiffness_over_speed_has_the_axial_one():
    table = stiffness_over_speed(bearing(operation__axial_load="300 N"), [100.0, 200.0])
    assert table.modelled == ("axial", "radial", "lateral")
    expected = law(GAP + (300.0 / K) ** 0.9)[1]
    np.testing.assert_allclose(ross_bearing(table)["kzz"], [expected, expected], rtol=1e-12)


def test_a_sweep_over_the_axial_load(tmp_path):
    source = jb.load_scene("reference_roller", {**DRY, **FLANGES, "geometry.thrust": "+x"})
    found = jb.sweep(source, {"operation.axial_load": [100.0, 300.0], "geometry.flange_stiffness": [K, 2.0 * K]})
    file = tmp_path / "sweep.nc"
    found.to_netcdf(file)
    with xr.open_dataset(file) as read:
        load, stiffness = (read[f"{name}"] for name in ("operation_axial_load", "geometry_flange_stiffness"))
        np.testing.assert_allclose(read["ring_axial"], GAP + (load / stiffness) ** 0.9, rtol=1e-13)
        assert stiffness.attrs["units"] == "N/m^(10/9)"


def test_catalogue_life_is_of_a_radial_load_alone():
    rating = Rating(dynamic_capacity=100e3, static_capacity=100e3)
    scenes = [bearing(), bearing().at_operation(axial_load=300.0)]
    lives = eqx.filter_jit(lambda scene, solution: with_life(scene.replace({"rating": rating}), solution).life)
    radial, both = (lives(scene, jb.solve(scene)) for scene in scenes)
    assert radial.L10 is not None
    assert both.L10 is None
    np.testing.assert_allclose(both.L10r, radial.L10r, rtol=0)
