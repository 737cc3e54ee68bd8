"""Transient runs of small ball bearings through the public functions."""

import dataclasses
import json
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.gyroscopic import ResolvedCouple
from jaxbearing.bearings.ball.scene import BallAttitude
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.contacts import DistributedTraction, HamrockDowsonCentral, PointLaws, ReeEyring, Resolution
from jaxbearing.report.histories import history_to_dataset, history_to_dict
from jaxbearing.time_laws import Ramp

LAWS = PointLaws(
    film=HamrockDowsonCentral(), traction=DistributedTraction(ReeEyring(), Resolution(8, 6), elastic=False)
)
"""Isothermal film and viscous traction of few points, for short programs."""
RAMP = {"simulation.load_ramp.start": 0.5, "simulation.load_ramp.duration": "1 ms"}
MOVING = Simulation(ring_mass=5.0, ring_damping=1e3)


def small(balls=5, **operation):
    """The ball bearing of Table 15 with some of its balls, each under 2 kN along the axis."""
    changes = {"contact": LAWS, "geometry.n_balls": balls, "operation.axial_load": 2e3 * balls}
    changes |= {f"operation.{name}": value for name, value in operation.items()}
    scene = jb.load_scene("turbine_ball").replace(changes)
    attitude = BallAttitude("equilibrium", ResolvedCouple())
    return dataclasses.replace(scene, kinematics=attitude, simulation=MOVING)


def without_cage(scene, **settings):
    return dataclasses.replace(scene, cage=None, simulation=dataclasses.replace(MOVING, **settings))


def test_scene_of_a_file():
    scene: Any = jb.load_scene("turbine_ball_dynamic")
    assert isinstance(scene.simulation, Simulation)
    np.testing.assert_allclose(float(scene.simulation.ring_mass), 5.0)
    np.testing.assert_allclose(float(scene.simulation.ring_damping), 1e4)
    np.testing.assert_allclose(float(scene.simulation.contact_damping), 0.05)
    assert scene.materials.cage is not None


def test_scene_is_written_and_read_again(tmp_path):
    scene = jb.load_scene("turbine_ball_dynamic", RAMP)
    path = tmp_path / "moving.toml"
    jb.save_scene(scene, path)
    again = jb.load_scene(str(path))
    assert jax.tree.all(jax.tree.map(lambda a, b: bool(np.all(np.asarray(a) == np.asarray(b))), scene, again))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda scene: dataclasses.replace(scene, simulation=Simulation()), "simulation.ring_mass"),
        (lambda scene: without_cage(scene, solver="kvaerno5"), r"simulation\.solver: an implicit solver"),
        (lambda scene: scene.replace({"contact.traction": None, "kinematics": BallAttitude("outer")}), "contact.trac"),
    ],
)
def test_refusals(change, message):
    with pytest.raises(ValueError, match=message):
        jb.simulate(change(small()), 1e-4)


def test_rollers_have_no_mass_of_the_ring():
    scene: Any = jb.load_scene("turbine_roller_dynamic")
    with pytest.raises(ValueError, match=r"simulation\.ring_mass: expected none"):
        jb.simulate(scene, 1e-4, simulation=Simulation(ring_mass=5.0))


@pytest.fixture(scope="module")
def run():
    scene = small()
    return scene, jb.simulate(scene, 0.4e-3, interval=20e-6)


@pytest.mark.slow
def test_begins_at_rest_in_its_frame(run):
    """The steady bearing with the resolved couple moves on as it is, but for what it neglects (`motion.start`)."""
    scene, history = run
    steady = jb.solve(scene)
    first = jax.tree.map(lambda leaf: np.asarray(leaf)[0], history.instants)
    # in a run the lever of the surface speeds is the ball's distance from the axis and not the pitch radius: films and
    # with them loads differ by some 1e-6 at the same places
    np.testing.assert_allclose(first.elements.load_inner, steady.elements.load_inner, rtol=1e-5)
    np.testing.assert_allclose(first.elements.load_outer, steady.elements.load_outer, rtol=1e-5)
    np.testing.assert_allclose(first.elements.orbital_speed, steady.elements.orbital_speed, rtol=1e-9)
    np.testing.assert_allclose(first.elements.attitude_angle, steady.elements.attitude_angle, rtol=1e-9)
    last = jax.tree.map(lambda leaf: np.asarray(leaf)[-1], history.instants)
    np.testing.assert_allclose(last.elements.load_inner, steady.elements.load_inner, rtol=1e-3)
    np.testing.assert_allclose(last.elements.orbital_speed, steady.elements.orbital_speed, rtol=1e-3)


@pytest.mark.slow
def test_energy_of_a_run_balances(run):
    _, history = run
    energy = history.energy
    assert abs(energy.error) < 1e-5
    assert energy.drive > 0
    assert energy.dissipation > 0


@pytest.mark.slow
def test_results_have_their_places_in_files(run):
    _, history = run
    data = history_to_dataset(history)
    for name in ("load_inner", "axial_place", "pocket_offset", "cage_tilt"):
        assert any(name in str(variable) for variable in data.data_vars), name
    assert data.groove_loss_inner.dims == ("time", "groove_angle")
    np.testing.assert_allclose(data.groove_energy_inner.groove_angle[[0, -1]], np.radians([-119.5, 119.5]))


@pytest.mark.slow
def test_losses_by_ball_and_stresses_of_the_cage(run):
    """Losses of the balls add up to those by place, and the energy of sliding over the run to their integral."""
    scene, history = run
    instants, loss = history.instants, history.instants.power_loss
    for own, whole in (
        (instants.sliding_power_inner, loss.inner_raceway),
        (instants.sliding_power_outer, loss.outer_raceway),
        (instants.pocket_power, loss.pocket),
    ):
        np.testing.assert_allclose(np.sum(own, axis=1), whole, rtol=1e-12)
    found = history_to_dict(history)
    summary = found["summary"]
    assert json.dumps(found, allow_nan=False)
    total = sum(own["total"] for own in summary["sliding_energy"].values())
    for side in ("inner", "outer"):
        across = np.asarray(getattr(instants, f"groove_loss_{side}"))
        np.testing.assert_allclose(np.sum(across, axis=1), getattr(loss, f"{side}_raceway"), rtol=1e-10)
        assert np.all(across >= 0)
        own = summary["groove_energy"][side]
        np.testing.assert_allclose(sum(own["energy"]), summary["sliding_energy"][side]["total"], rtol=1e-10)
        angle = np.degrees(getattr(instants.elements, f"contact_angle_{side}"))
        assert own["angle_deg"][0] < angle.min() < angle.max() < own["angle_deg"][-1]
    others = [np.trapezoid(getattr(loss, name), history.time) for name in ("cage_pilot", "drag")]
    # the run is almost steady, so that the trapezoidal rule over its instants is good
    np.testing.assert_allclose(total + sum(others), history.energy.dissipation, rtol=1e-4)
    peaks = np.asarray(instants.pocket_peaks.land)
    assert peaks.shape == (len(history.time), 2)
    assert np.all(peaks >= np.asarray(instants.land_load) * (1 - 1e-9))
    stress, section = summary["cage_stress"], history.cage_section
    radius = 0.25 * (float(scene.cage.inner_diameter) + float(scene.cage.outer_diameter))
    np.testing.assert_allclose(section.mean_radius, radius, rtol=1e-12)
    fastest = np.max(instants.cage.speed)
    np.testing.assert_allclose(stress["hoop"], section.density * (radius * fastest) ** 2, rtol=1e-12)
    assert 0 < stress["bar_bending"] < 1e8
    assert 0 <= summary["skidding"]["inner"]["share"] <= 1
    assert np.max(np.abs(instants.slide_to_roll_inner)) < 0.05


@pytest.mark.slow
def test_batch_of_operating_points():
    """Lanes of a batch are the runs alone, in files too."""
    scene = small(3)
    loads = jnp.asarray([5e3, 7e3])
    runs = jb.simulate_batch(scene, 40e-6, {"operation.axial_load": loads}, interval=20e-6)
    np.testing.assert_array_equal(runs.status, 0)
    alone = jb.simulate(scene.at_operation(axial_load=7e3), 40e-6, interval=20e-6)
    lane = runs.lane(1)
    for name in ("load_inner", "orbital_speed", "attitude_angle", "pocket_load_front"):
        ours, theirs = (np.asarray(getattr(one.instants.elements, name))[-1] for one in (lane, alone))
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, err_msg=name)
    data = history_to_dataset(lane)
    np.testing.assert_allclose(data["load_inner"][-1], lane.instants.elements.load_inner[-1])
    assert json.dumps(history_to_dict(lane), allow_nan=False)


@pytest.mark.slow
def test_goes_on_from_another_run(run):
    scene, whole = run
    half = jb.simulate(scene, 0.2e-3, interval=20e-6)
    more = jb.simulate(scene, 0.2e-3, interval=20e-6, restart=half)
    np.testing.assert_allclose(more.time[-1], 0.4e-3)
    found, expected = (
        jax.tree.map(lambda leaf: np.asarray(leaf)[-1], h.instants.state_elements) for h in (more, whole)
    )
    scale = np.asarray([1e-5, 0.1, 1.0, 1.0, 1.0, 1e-5, 1e-5, 0.1, 0.1])[:, None]
    np.testing.assert_allclose(found / scale, expected / scale, rtol=1e-3, atol=1e-3)


@pytest.mark.slow
def test_combined_load_that_rises():
    """Balls are loaded unevenly, the ring follows the load, and the energy balances."""
    scene = small(radial_load=1e3)
    simulation = dataclasses.replace(MOVING, load=Ramp(start=0.5, stop=1.0, duration=0.2e-3))
    history = jb.simulate(scene, 0.3e-3, interval=20e-6, simulation=simulation)
    assert abs(history.energy.error) < 1e-5
    assert np.ptp(np.asarray(history.instants.elements.load_inner)[-1]) > 100.0
    np.testing.assert_allclose(np.asarray(history.instants.axial_load)[[0, -1]], [5e3, 10e3])


@pytest.mark.slow
def test_begins_and_stays_in_the_steady_state():
    """Constant speed and axial load, no cage: the run with a quasi-static meridian stays in the state of the solve."""
    scene = dataclasses.replace(small(), cage=None)
    steady = jb.solve(scene)
    history = jb.simulate(scene, 1e-3, interval=20e-6, simulation=Simulation(meridian="quasi_static"))
    assert abs(history.energy.error) < 1e-5
    for at in (0, -1):
        found = jax.tree.map(lambda leaf, at=at: np.asarray(leaf)[at], history.instants)
        for name in ("load_inner", "load_outer", "orbital_speed", "spin_speed", "attitude_angle", "transverse_spin"):
            expected = np.broadcast_to(np.asarray(getattr(steady.elements, name)), (5,))
            np.testing.assert_allclose(getattr(found.elements, name), expected, rtol=1e-6, err_msg=name)
        np.testing.assert_allclose(found.ring.axial, steady.ring.axial, rtol=1e-6)
    assert history.instants.gap_ahead.shape == (len(history.time), 5)
