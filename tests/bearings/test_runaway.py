"""A bearing whose preload grows with its temperatures until it runs away: tight on its seats, in a cooled housing."""

import io

import numpy as np
import pytest
from rich.console import Console
from warm_cases import CHANGES, NAMES, SEATS

import jaxbearing as jb
from jaxbearing.report import histories
from jaxbearing.time_laws import LinearRamp

RPM = 2.0 * np.pi / 60.0
SLIDING = {
    "contact.traction": "maxwell_eyring",
    "contact.traction_accuracy": "0.01",
    "contact.heathcote": "true",
    "kinematics.attitude": "outer",
}
"""Balls that slide in their grooves: a loss that grows with the load."""
COOLED = {"thermal.conductance.inner_ring_ambient": "0.2 W/K", "thermal.conductance.outer_ring_ambient": "20 W/K"}
"""A housing with water around it, and a shaft that leads little heat away."""
RAMP = jb.WarmUpSimulation(speed=LinearRamp(start=0.3, stop=1.0, duration=600.0), instants=48)


def run_up(clearance):
    """From 6000 to 20 000 rpm in ten minutes. **Arguments:** `clearance`: of the bearing on the table."""
    changes = {"thermal.nodes": "4", "geometry.diametral_clearance": clearance, "operation.inner_speed": "20000 rpm"}
    load = {"operation.axial_load": "200 N"}
    scene = jb.load_scene(NAMES["ball"], CHANGES["ball"] | SEATS | SLIDING | COOLED | changes | load)
    return jb.simulate(scene, 1800.0, simulation=RAMP, throw=False)


@pytest.mark.slow
def test_preload_that_grows_with_its_own_heat():
    """The tight bearing is lost at 15 000 rpm, in less than seven minutes; the loose one runs at 20 000 rpm. What was
    computed is kept, its energies close, and the status says what happened."""
    lost, safe = run_up("0 um"), run_up("30 um")
    assert safe.completed
    assert jb.Status(int(lost.status)) == jb.Status.THERMAL_RUNAWAY
    instants, time = lost.instants, np.asarray(lost.time)
    assert 250.0 < time[-1] < 420.0
    assert 11_000.0 < float(instants.inner_speed[-1]) / RPM < 16_000.0
    np.testing.assert_allclose(np.asarray(lost.node_temperatures())[-1].max(), 523.15, rtol=1e-6)
    # the inner ring is the hottest part, and takes the play away
    np.testing.assert_allclose(instants.temperatures.inner_ring[-1], 523.15, rtol=1e-6)
    clearance, load = np.asarray(instants.fit.clearance), np.asarray(instants.largest_load)
    assert np.all(np.diff(clearance[time > 60.0]) < 0.0)
    assert clearance[-1] < -50e-6
    assert load[-1] > 10.0 * load[0]
    loss = np.asarray(instants.power_loss.total)
    assert loss[-1] > 5.0 * np.asarray(safe.instants.power_loss.total).max()
    assert abs(float(lost.energy.error)) < 1e-4
    assert all(np.all(np.isfinite(np.asarray(one))) for one in (clearance, load, loss))
    np.testing.assert_allclose(lost.peaks.least_play, clearance[-1], rtol=1e-12)
    assert "thermal_runaway: a node passed thermal.limit" in lost.failure()
    assert "the inner ring, at 250.0 degC" in lost.failure()
    screen = io.StringIO()
    histories.print_history(lost, "a title", Console(file=screen, width=200))
    assert "NOT COMPLETED" in screen.getvalue()
    assert "(radial preload)" in screen.getvalue()
