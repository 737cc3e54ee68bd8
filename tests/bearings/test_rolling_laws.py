"""Laws of rolling resistance in bearings: the energy closes, each raceway's part is a result, derivatives, losses of
`turbine_roller` law by law."""

import tomllib
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.report.bearing.facts import facts

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "rolling_resistance.toml").read_text())
ALONE = {"contact.traction": "none", "cage": "none", "drag": "none"}
"""Rolling elements that roll without sliding."""
BALLS = {"contact.traction_accuracy": "none", "contact.thermal": "none", "kinematics.attitude": "outer"}
SCENES = {
    "full_range": ("turbine_roller", {**ALONE, "flange": "none"}),
    "biboulet_houpert": ("turbine_ball", {**ALONE, **BALLS, "contact.rolling_heating": "aihara"}),
    "tapered": ("tapered_example", {"contact.traction": "none", "drag": "none"}),
}
SLIDING = {
    "full_range": ("turbine_roller", {}),
    "biboulet_houpert": ("turbine_ball", {}),
    "tapered": ("tapered_example", {}),
}
"""The same with everything that the scenes model."""


def scene_of(scenes, name):
    file, changes = scenes[name]
    law = "full_range" if name == "tapered" else name
    return jb.load_scene(file, {**changes, "contact.rolling_resistance": law})


def closes(solution):
    """The power of the rings is the sum of the losses, and both raceways make up the rolling resistance."""
    assert bool(solution.converged)
    loss, by_race = solution.power_loss, solution.rolling_by_race
    np.testing.assert_allclose(solution.drive_power, loss.total, rtol=1e-8)
    np.testing.assert_allclose(by_race.inner + by_race.outer, loss.rolling_resistance, rtol=1e-14)
    assert min(float(by_race.inner), float(by_race.outer)) > 0.0


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name == "tapered" else name for name in SCENES]
)
def test_energy_closes_where_nothing_slides(name):
    solution = jb.solve(scene_of(SCENES, name))
    closes(solution)
    assert solution.power_loss.total == solution.power_loss.rolling_resistance
    said = dict(facts(solution))["Rolling by race"]  # on the screen
    assert said.startswith("inner ")
    assert said.endswith(", inlet heating aihara)")


@pytest.mark.slow
@pytest.mark.parametrize("name", SLIDING)
def test_energy_closes_with_all_that_slides(name):
    scene = scene_of(SLIDING, name)
    closes(jb.solve(scene))
    if name == "full_range":
        for changes in ({"operation.outer_speed": -400.0}, {"operation.radial_load": 50.0}):
            closes(jb.solve(scene.replace(changes)))


@pytest.mark.slow
def test_derivatives_of_the_loss():
    """Rollers that roll alone: the slope of the loss with the speed; finite slopes with all numbers of the scene."""
    scene = jax.tree.map(jnp.asarray, scene_of(SCENES, "full_range"))
    loss = lambda scene: jb.solve(scene, throw=False).power_loss.total
    at = lambda speed: compiled(scene.replace({"operation.inner_speed": speed}))
    compiled, speed = eqx.filter_jit(loss), scene.operation.inner_speed
    slopes = eqx.filter_jit(eqx.filter_grad(loss))(scene)
    assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(slopes))
    step = 1e-4 * speed
    by_differences = (at(speed + step) - at(speed - step)) / (2.0 * step)
    np.testing.assert_allclose(slopes.operation.inner_speed, by_differences, rtol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("row", PUBLISHED["turbine_roller"], ids=lambda row: f"{row['law']}-{row['heating']}")
def test_turbine_roller_law_by_law(row):
    """Within 1 % of an independent assembly of the same laws."""
    changes = {"contact.rolling_resistance": row["law"], "contact.rolling_heating": row["heating"]}
    solution = jb.solve(jb.load_scene("turbine_roller", changes))
    closes(solution)
    for name in ("total", "rolling_resistance", "outer_raceway"):
        np.testing.assert_allclose(getattr(solution.power_loss, name), row[name], rtol=0.01)
