"""Bearings with little oil: energy, limits, gradients, batches, results, warnings, scene files."""

import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.supplied import FLOODED

CHEAP = {
    "roller": ("reference_roller", {"contact.traction": "none", "contact.rolling_resistance": "full_range"}),
    "tapered": (
        "tapered_example",
        {
            "contact.traction": "none",
            "contact.rolling_resistance": "full_range",
            "contact.thermal": "none",
            "operation.radial_load": "none",
            "operation.moment": "none",
        },
    ),
    "ball": (
        "deep_groove_6205",
        {
            "oil.name": "mobil_jet_ii",
            "contact.film": "nijenbanning",
            "contact.rolling_resistance": "biboulet_houpert",
            "operation.oil_temperature": "40 degC",
            "operation.moment": "none",
            "operation.radial_load": "none",
            "operation.axial_load": "500 N",
        },
    ),
}
"""Scenes whose rolling elements do not slide: all loss is rolling resistance (and drag)."""
SLIDING = ("reference_roller", {"contact.rolling_resistance": "full_range"})


def scene_of(case, **supply):
    name, changes = case
    own = {f"contact.supply.{field}": value for field, value in supply.items()}
    return jb.load_scene(name, changes | own)


@functools.cache
def flooded(family):
    return jb.solve(scene_of(CHEAP[family]))


def with_layer(scene, layer):
    return scene.replace({"contact.supply.layer": layer})


def closes(solution):
    assert float(solution.drive_power) == pytest.approx(float(solution.power_loss.total), rel=1e-10)


@pytest.mark.parametrize(
    "family", ["roller", *(pytest.param(name, marks=pytest.mark.slow) for name in ("ball", "tapered"))]
)
def test_layers_from_none_to_plenty(family):
    """The energy closes at every layer; one of 1 m is the flooded bearing; none leaves no rolling resistance."""
    scene, full = scene_of(CHEAP[family], layer="1 m"), flooded(family)
    plenty, some, nothing = (jb.solve(with_layer(scene, layer)) for layer in (1.0, 1e-7, 0.0))
    for one in (full, plenty, some, nothing):
        closes(one)
    np.testing.assert_allclose(plenty.elements.film_inner, full.elements.film_inner, rtol=1e-12)
    np.testing.assert_allclose(plenty.elements.load_inner, full.elements.load_inner, rtol=1e-11, atol=1e-11)
    # of an ellipse a layer counts as a gap that does not grow as fast: 1e-8 of the resistance at 1 m
    rtol = 1e-7 if family == "ball" else 1e-12
    rolling = lambda one: float(one.power_loss.rolling_resistance)
    np.testing.assert_allclose(rolling(plenty), rolling(full), rtol=rtol)
    assert 0.0 < rolling(some) < 0.9 * rolling(full)
    assert rolling(nothing) < 1e-12 * rolling(full)
    assert float(np.nanmax(some.elements.film_inner)) <= 1e-7 * (1 + 1e-6)
    assert any("strongly starved" in text for text in nothing.warnings)
    assert not any("strongly starved" in text for text in plenty.warnings)
    # results of each race
    most = int(np.argmax(full.elements.load_inner))
    thinner = float(some.elements.film_inner[most] / full.elements.film_inner[most])
    # what little the load changes with the films changes the flooded film less
    assert float(some.supply.film_factor_inner) == pytest.approx(thinner, rel=1e-2)
    assert 0.0 < float(some.supply.rolling_factor_outer) < 1.0
    assert float(some.supply.gap_over_central_outer) > 0.0
    assert full.supply.stated == FLOODED
    assert full.supply.film_factor_inner is None
    assert some.supply.stated == "given by contact.supply.layer"


@pytest.mark.slow
def test_a_wide_gap_is_flooded_but_for_the_far_inlet():
    full, wide = flooded("ball"), jb.solve(scene_of(CHEAP["ball"], meniscus_gap="1 m"))
    np.testing.assert_allclose(wide.elements.film_inner, full.elements.film_inner, rtol=1e-7)
    ratio = float(wide.power_loss.rolling_resistance / full.power_loss.rolling_resistance)
    assert 1 - 2e-3 < ratio < 1


def test_gradient_and_lanes():
    """The derivative by a layer is that of differences; lanes with other layers are the single solves."""
    scene = scene_of(CHEAP["roller"], layer="1 m")
    loss = lambda layer: jb.solve(with_layer(scene, layer), throw=False).power_loss.total
    both = jax.jit(jax.vmap(lambda layer: jax.jvp(loss, (layer,), (jnp.ones_like(layer),))))
    step = 1e-10
    values, slopes = both(jnp.asarray([4e-7 - step, 4e-7, 4e-7 + step, 1.0, 0.0]))
    assert np.all(np.isfinite(slopes))
    np.testing.assert_allclose(slopes[1], (values[2] - values[0]) / (2 * step), rtol=1e-6)
    np.testing.assert_allclose(values[3], float(flooded("roller").power_loss.total), rtol=1e-11)
    np.testing.assert_allclose(values[1], float(jb.solve(with_layer(scene, 4e-7)).power_loss.total), rtol=1e-11)


def test_absent_supply_adds_nothing():
    """A scene without the table has no leaf of it, and its results only the words."""
    scene, solution = scene_of(CHEAP["roller"]), flooded("roller")
    assert scene.contact.supply is None
    assert not jax.tree.leaves(solution.supply)


def test_files_hold_a_supply(tmp_path):
    scene = scene_of(CHEAP["tapered"], meniscus_distance="0.5 mm", rolling_law="biboulet_houpert")
    file = tmp_path / "scene.toml"
    jb.save_scene(scene, file)
    again = jb.load_scene(file)
    assert again.contact.supply.rolling_law == "biboulet_houpert"
    assert float(again.contact.supply.meniscus_distance) == 0.5e-3
    # another way to give it takes the first one's place
    changed = jb.load_scene(file, {"contact.supply.layer": "2 um"})
    assert changed.contact.supply.meniscus_distance is None
    assert float(changed.contact.supply.layer) == 2e-6


def test_what_a_supply_needs():
    with pytest.raises(ValueError, match=r"contact\.supply"):
        scene_of(CHEAP["tapered"], rolling_law="biboulet_houpert")
    with pytest.raises(ValueError, match=r"operation\.oil_flow: .*contact\.supply\.from_flow needs a volume flow"):
        jb.load_scene(CHEAP["ball"][0], CHEAP["ball"][1] | {"contact.supply.from_flow": 0.1})


@pytest.mark.slow
@pytest.mark.parametrize("supply", [{"layer": "1 um"}, {"layer": "0 m"}, {"level": "grease"}, {"from_flow": 0.01}])
def test_sliding_rollers(supply):
    """Rollers outside the loaded zone, which no film can fill, keep a place and the energy closes."""
    solution = jb.solve(scene_of(SLIDING, **supply))
    closes(solution)
    assert np.all(np.isfinite(solution.elements.load_inner))
    assert np.all(np.asarray(solution.elements.load_inner) > 0)


@pytest.mark.slow
def test_sliding_balls():
    full = jb.solve(jb.load_scene("turbine_ball"))
    solution = jb.solve(jb.load_scene("turbine_ball", {"contact.supply.level": "bath"}))
    closes(solution)
    assert float(solution.power_loss.rolling_resistance) < 0.75 * float(full.power_loss.rolling_resistance)
    assert any("level = 'bath'" in text for text in [solution.supply.stated])
