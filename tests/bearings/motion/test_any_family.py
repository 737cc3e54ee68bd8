"""The motion layer serves a family that it has never heard of: rollers that coast, whose motion is a closed form."""

import dataclasses
import io
from typing import ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jaxtyping import Array, Float
from rich.console import Console

import jaxbearing as jb
from jaxbearing.bearings.motion.family import AbstractDynamics, AbstractMotion, Resumed, Start
from jaxbearing.bearings.motion.history import Energy, Instant
from jaxbearing.bearings.parts import azimuths
from jaxbearing.bearings.solution import RING_FREEDOMS, RingDisplacement, label
from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.status import Status
from jaxbearing.report.backends.matplotlib.animations import save_animation
from jaxbearing.report.histories import (
    animate_history,
    history_to_dataset,
    history_to_dict,
    plot_history,
    print_history,
)
from jaxbearing.report.history_shocks import angle_of
from jaxbearing.report.plots import save_plot

MASS, TIME = 0.1, 2e-3
"""Mass of a roller, kg, and time in which its speed falls to 1/e, s."""
FIRST_SPEED = 3e-3
"""Speed of a roller in the frame of the run at time 0 over its speed in space."""


class CoastingRollers(eqx.Module):
    azimuth: Float[Array, " element"] = eqx.field(metadata=label("rad", "azimuth from the load line"))


class CoastingLoss(eqx.Module):
    total: Float[Array, ""] = eqx.field(metadata=label("W", "total"))


class CoastingInstant(Instant):
    element_state: ClassVar[tuple[str, ...]] = ("q", "v")
    cage_state: ClassVar[tuple[str, ...]] = ()


class CoastingDynamics(AbstractDynamics):
    """Rollers that are braked in proportion to their speed: m q'' = -m q'/tau; nothing else moves."""

    works: ClassVar[tuple[str, ...]] = ("dissipation",)

    reference_speed: Float[Array, ""]
    places: Float[Array, " element"]
    pitch: Float[Array, ""]

    def nested_rates(self, time, state, guess, tolerance):
        v = state.elements[1]
        power = jnp.sum(MASS * jnp.square(v)) / TIME
        return ArrowPoint(jnp.stack([v, -v / TIME]), power[None]), guess

    def first_guess(self, time, state):
        return ArrowPoint(jnp.zeros((0, state.elements.shape[1])), jnp.zeros(0))

    def observe(self, time, state):
        zero, angle = jnp.zeros(()), self.reference_speed * time
        q, v = state.elements
        return CoastingInstant(
            inner_speed=self.reference_speed,
            radial_load=zero,
            lateral_load=zero,
            ring=RingDisplacement(**dict.fromkeys(RING_FREEDOMS, zero)),
            cage=None,
            elements=CoastingRollers(self.places + q / self.pitch + angle),
            pocket_peaks=None,
            power_loss=CoastingLoss(jnp.sum(MASS * jnp.square(v)) / TIME),
            drive_power=zero,
            kinetic_energy=0.5 * MASS * jnp.sum(jnp.square(v)),
            pocket_energy=zero,
            raceway_energy=zero,
            state_elements=state.elements,
            state_cage=jnp.zeros(0),
            frame_angle=angle,
            frame_speed=self.reference_speed,
        )

    def energy(self, state, first, last):
        zero, kinetic = jnp.zeros(()), last.kinetic_energy - first.kinetic_energy
        lost = state.globals[0]
        return Energy(zero, lost, zero, kinetic, zero, error=(lost + kinetic) / lost)


class Begun(NamedTuple):
    speed: Array
    status: Array


class CoastingMotion(AbstractMotion):
    instant: ClassVar[type[Instant]] = CoastingInstant

    def require_moving(self, scene):
        if scene.cage is not None:
            raise ValueError("cage: coasting rollers have none")

    def quasi_static(self, scene, options=None):
        speed = FIRST_SPEED * jnp.asarray(scene.operation.inner_speed) * scene.geometry.pitch_radius
        return Begun(speed, jnp.asarray(int(Status.CONVERGED)))

    def _dynamics(self, scene):
        n, geometry = scene.n_elements, scene.geometry
        speed = jnp.asarray(scene.operation.inner_speed)
        return CoastingDynamics(speed, jnp.asarray(azimuths(geometry, n)), jnp.asarray(geometry.pitch_radius))

    def begin(self, scene, simulation, found):
        n = scene.n_elements
        return Start(
            self._dynamics(scene),
            ArrowPoint(jnp.stack([jnp.zeros(n), jnp.full(n, found.speed)]), jnp.zeros(1)),
            found.status,
            jnp.zeros(()),
        )

    def resume(self, scene, simulation, last):
        return Resumed(self._dynamics(scene), ArrowPoint(jnp.asarray(last.elements), jnp.zeros(1)))

    def range_excess(self, scene, instants):
        return {"rollers faster than 1 km/s": jnp.max(jnp.abs(instants.state_elements[:, 1])) - 1e3}


class CoastingBearing(jb.CylindricalRollerBearing):
    @property
    def motion(self):
        return CoastingMotion()


def coasting():
    scene = jb.load_scene("reference_roller", {"cage": "none", "contact.traction": "none"})
    made = CoastingBearing(**{field.name: getattr(scene, field.name) for field in dataclasses.fields(scene)})
    return made.replace({"simulation": jb.Simulation(tolerance=1e-9)})


def closed_form(scene, time):
    """Position and speed of a roller in the frame of the run, m and m/s."""
    speed = FIRST_SPEED * float(scene.operation.inner_speed) * float(scene.geometry.pitch_radius)
    fall = np.exp(-np.asarray(time) / TIME)
    return speed * TIME * (1.0 - fall), speed * fall


@pytest.fixture(scope="module")
def run():
    return jb.simulate(coasting(), 2e-3)


def test_run_follows_the_closed_form(run):
    scene = coasting()
    for ours, exact in zip(np.moveaxis(run.instants.state_elements, 1, 0), closed_form(scene, run.time), strict=True):
        np.testing.assert_allclose(ours, np.broadcast_to(exact[:, None], ours.shape), rtol=1e-7)
    assert run.completed
    assert abs(float(run.energy.error)) < 1e-7
    assert not any("km/s" in text for text in run.warnings)


def test_run_goes_on(run):
    scene = coasting()
    rest = jb.simulate(scene, 1e-3, restart=run)
    np.testing.assert_allclose(rest.instants.state_elements[-1, 1], closed_form(scene, 3e-3)[1], rtol=1e-7)
    with pytest.raises(ValueError, match="a state of another kind of bearing"):
        jb.load_scene("turbine_roller_dynamic", {"cage": "none"}).check_restart(
            dataclasses.replace(run.last_state(), identity=None)
        )


def test_batch_and_file(run):
    scene = coasting()
    speeds = jnp.asarray([100.0, 200.0])
    runs = jb.simulate_batch(scene, 1e-3, {"operation.inner_speed": speeds}, interval=0.5e-3)
    exact = [closed_form(scene.at_operation(inner_speed=float(speed)), 1e-3)[1] for speed in speeds]
    np.testing.assert_allclose(runs.instants.state_elements[:, -1, 1, 0], exact, rtol=1e-7)
    found = history_to_dataset(run)
    assert list(found["element_state"].values) == ["q", "v"]
    np.testing.assert_allclose(found["state_elements"][-1, 1], closed_form(scene, 2e-3)[1], rtol=1e-7)


def test_reports(run, tmp_path, monkeypatch):
    """Statistics, screen, page and moving pictures show what this family has: no load, no cage, no sliding speed."""
    monkeypatch.setattr("jaxbearing.report.backends.matplotlib.animations.PICTURES", 3)
    scene = coasting()
    summary = history_to_dict(run)["summary"]
    np.testing.assert_allclose(summary["power_loss"]["total"], np.mean(run.instants.power_loss.total), rtol=1e-12)
    assert not {"pressure_max", "sliding_max", "cage", "pocket_load"} & set(summary)
    screen = Console(file=io.StringIO(), width=100)
    print_history(run, "coasting", screen)
    assert "Mean power" in screen.file.getvalue()
    save_plot(plot_history(run, "coasting"), tmp_path / "run.png")
    save_animation(animate_history(run, scene, "coasting"), tmp_path / "run.gif")
    assert (tmp_path / "run.gif").stat().st_size > 3_000
    turned = np.asarray(run.instants.elements.azimuth)[:, 0]
    np.testing.assert_allclose(angle_of(run), turned - turned[0], rtol=1e-12)


def test_pure_trajectory_has_derivatives():
    scene = coasting()

    @jax.jit
    def last_speed(inner_speed):
        start = jb.quasi_static_start(scene.at_operation(inner_speed=inner_speed), scene.simulation)
        return jb.trajectory(start, jnp.asarray([1e-3]), scene.simulation).states.elements[-1, 1, 0]

    slope = jax.jit(jax.grad(last_speed))(300.0)
    np.testing.assert_allclose(slope, FIRST_SPEED * float(scene.geometry.pitch_radius) * np.exp(-0.5), rtol=1e-7)


def test_kinds_that_do_not_move_say_so():
    with pytest.raises(TypeError, match="cannot simulate a TaperedRollerBearing"):
        jb.simulate(jb.load_scene("tapered_example"), 1e-3)
