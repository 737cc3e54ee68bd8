"""Transient runs where they are hard: each reaches its end with finite results and a closed energy balance."""

import jax
import numpy as np
import pytest
from roller_cases import RPM

import jaxbearing as jb
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.time_laws import Ramp, RotatingLoad

pytestmark = pytest.mark.slow

TURN = 9.4e-3
"""Of the cage at 14 000 rpm, s."""
RUNS = {
    "nominal": {},
    "oil at 0 degC": {"operation.oil_temperature": 273.15},
    "thin films": {"operation.oil_temperature": 473.15},
    "300 N": {"operation.radial_load": 300.0},
    "300 N in cold oil": {"operation.oil_temperature": 273.15, "operation.radial_load": 300.0},
    "preload": {"geometry.diametral_clearance": -20e-6},
    "20 000 rpm": {"operation.inner_speed": 20000 * RPM},
    "no drag": {"drag.coefficient": 0.0},
    "strong drag": {"drag.coefficient": 1.2},
}


def moving(**changes):
    return jb.load_scene("turbine_roller_dynamic").replace(changes)


def check(history):
    assert history.completed
    for path, leaf in jax.tree_util.tree_leaves_with_path(history.instants):
        assert np.all(np.isfinite(leaf)), jax.tree_util.keystr(path)
    assert abs(float(history.energy.error)) < 2e-5
    cage = history.instants.cage
    # the films of the lands hold the cage off the ring
    assert np.max(cage.eccentricity_ratio) < 1.0
    assert float(history.energy.drive) > 0
    losses = history.instants.power_loss
    for name, loss in vars(losses).items():
        assert loss is None or np.all(np.asarray(loss) >= 0), name


@pytest.mark.parametrize("name", RUNS)
def test_hard_operating_points(name):
    # of 160 runs with shocks at 1e-4, loads from 20 to 30 kN, one leaves more than 2e-5 of the energy open
    tolerance = 3e-5 if name == "strong drag" else 1e-4
    history = jb.simulate(moving(**RUNS[name]), TURN, simulation=Simulation(tolerance=tolerance), interval=1e-4)
    check(history)
    if "cold" in name or "0 degC" in name:
        # stiff oil drags the cage along faster than the rollers roll
        assert np.asarray(history.instants.cage.slip)[-1] < 0


@pytest.mark.parametrize(
    ("simulation", "duration"),
    [
        (Simulation(speed=Ramp(0.01, 1.0, 4e-3), tolerance=1e-4), 5e-3),
        (Simulation(load=Ramp(1.0, 2.0, 1e-5, 1e-3), tolerance=1e-4), 3e-3),
        (Simulation(rotating_load=RotatingLoad(5e3, 14000 * RPM), tolerance=1e-4), 3e-3),
    ],
    ids=["from 1 % of the speed", "sudden step of the load", "unbalance"],
)
def test_driven(simulation, duration):
    history = jb.simulate(moving(), duration, simulation=simulation, interval=1e-4)
    check(history)
    speed, load = np.asarray(history.instants.inner_speed), np.asarray(history.instants.radial_load)
    np.testing.assert_allclose(
        speed / (14000 * RPM), [simulation.speed.factor(t) for t in np.asarray(history.time)], rtol=1e-12
    )
    if simulation.rotating_load is None:
        np.testing.assert_allclose(
            load / 25e3, [simulation.load.factor(t) for t in np.asarray(history.time)], rtol=1e-12
        )


def test_sixty_rollers():
    many = {"geometry.n_rollers": 60, "geometry.roller_diameter": 6e-3, "cage.inner_diameter": 139e-3}
    history = jb.simulate(moving(**many), 3e-3, simulation=Simulation(tolerance=1e-4), interval=1e-4)
    check(history)
    assert history.instants.elements.azimuth.shape[1] == 60


def test_a_run_that_cannot_go_on_says_so_and_keeps_its_state():
    """A load that turns to 1e300 N: the steps shrink to nothing before it."""
    simulation = Simulation(load=Ramp(1.0, 1e300, 1e-3, 1e-3), tolerance=1e-4)
    history = jb.simulate(moving(), 3e-3, simulation=simulation, interval=1e-4, throw=False)
    assert not history.completed
    assert 0.999e-3 < float(history.time[-1]) < 2e-3
    assert np.all(np.isfinite(history.instants.state_elements))
    assert "what was computed until then is kept" in history.failure()


def test_slow_bearings_say_what_is_amiss():
    """Absolute tolerances are those of fast bearings: a slow one warns that its balance is open, and closes with a
    smaller tolerance; below 100 rpm a run says that films vanish."""
    balance = lambda history: any("energy balance" in text for text in history.warnings)
    slow = moving(**{"operation.inner_speed": 120 * RPM})
    loose, tight = (
        jb.simulate(slow, 2e-3, simulation=Simulation(tolerance=tolerance), interval=1e-4) for tolerance in (1e-5, 1e-8)
    )
    assert abs(float(loose.energy.error)) > 1e-3
    assert balance(loose)
    assert abs(float(tight.energy.error)) < 1e-4
    assert not balance(tight)
    assert not any("100 rpm" in text for text in tight.warnings)
    slower = moving(**{"operation.inner_speed": 10 * RPM})
    assert any("100 rpm" in text for text in jb.simulate(slower, 2e-3, interval=1e-4, throw=False).warnings)
