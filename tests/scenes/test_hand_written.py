"""The bearing of Table 13 as a new user writes it, whole and with each optional table or field left out in turn."""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.contacts import NoThermalReduction
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.reader import scene_from_tables

FILE = Path(__file__).parent / "hand_written.toml"
LOSSES = {"inner_raceway", "outer_raceway", "pocket", "cage_pilot", "flange", "drag", "rolling_resistance"}

# what is left out: the losses that go with it
LUBRICATED = {
    "nothing": set(),
    "flange": {"flange"},
    "drag": {"drag"},
    "contact.thermal": set(),
    "contact.rolling_resistance": {"rolling_resistance"},
    "flange.angle": set(),
    # the whole flow is then 0: it is [drag] alone that needs it
    "drag operation.oil_flow": {"drag"},
    "flange drag contact.thermal contact.rolling_resistance": {"flange", "drag", "rolling_resistance"},
}
# no friction on the raceways: no power loss at all, and words about the tables that have no effect
WITHOUT_LOSSES = {
    "contact.traction contact.rolling_resistance": "cage, flange, drag",
    "contact.traction cage flange drag contact.rolling_resistance": "",
    "contact": "cage, flange, drag, oil",
    "contact oil": "cage, flange, drag",
    "contact oil cage flange drag operation.oil_temperature operation.oil_flow": "",
}
# what is left out: path and words of the message
REFUSED = {
    "cage": ("cage", ["[cage]", "contact.traction", "use simulate"]),
    "oil": ("oil", ["[contact] needs", "'name'"]),
    "oil.name": ("oil.viscosity", ["an oil: its 'name' in the catalogue"]),
    "operation.oil_temperature": ("operation.oil_temperature", ["[contact] needs", "100 degC"]),
    "operation.oil_flow": ("operation.oil_flow", ["[drag] needs", "150 l/h"]),
    "operation": ("operation", ["a table with 'inner_speed', 'radial_load'"]),
    "contact.film": ("contact.film", ["required", "'moes', 'dowson_higginson'"]),
    "cage.guidance": ("cage.guidance", ["required", "'inner_ring', 'outer_ring'"]),
    "cage.land_width": ("cage.land_width", ["required", "a length", "'12 mm'"]),
    "flange.ring": ("flange.ring", ["required", "'inner', 'outer', 'both'"]),
    "drag.coefficient": ("drag.coefficient", ["required", "a number"]),
    "geometry.n_rollers": ("geometry.n_rollers", ["required", "a whole number"]),
    "materials.rollers": ("materials.rollers", ["required", "'M50'", "youngs_modulus"]),
    "materials": ("materials", ["required", "a table with 'rings', 'rollers'"]),
    "kind": ("kind", ["cylindrical_roller_bearing"]),
}


def tables(left_out):
    """The tables of the file as they are where some lines are not there."""
    raw = tomllib.loads(FILE.read_text(encoding="utf-8"))
    for path in left_out.replace("nothing", "").split():
        *above, name = path.split(".")
        table = raw
        for part in above:
            table = table[part]
        del table[name]
    return raw


@pytest.mark.parametrize("left_out", [*LUBRICATED, *WITHOUT_LOSSES])
def test_loads(left_out):
    raw = tables(left_out)
    scene = scene_from_tables(raw, "bearing.toml")
    for name in ("oil", "contact", "cage", "flange", "drag"):
        assert (getattr(scene, name) is None) == (name not in raw)
    if "contact" in raw:
        assert isinstance(scene.contact.thermal, NoThermalReduction) == ("thermal" not in raw["contact"])
        assert (scene.contact.traction is None) == ("traction" not in raw["contact"])
        assert (scene.contact.rolling is None) == ("rolling_resistance" not in raw["contact"])


@pytest.mark.parametrize("left_out", REFUSED)
def test_what_is_needed_is_asked_for(left_out):
    path, words = REFUSED[left_out]
    with pytest.raises(SceneError) as caught:
        scene_from_tables(tables(left_out), "bearing.toml")
    message = str(caught.value)
    assert message.startswith(f"bearing.toml: {path}: found nothing; expected ")
    assert message.count("(") == message.count(")") <= 2
    for word in words:
        assert word in message


def losses(solution):
    """Power by location."""
    named = vars(solution.power_loss).items()
    return {name: float(value) for name, value in named if value is not None and name != "total"}


def check_loads(solution):
    elements = solution.elements
    along = float(np.sum(np.asarray(elements.load_inner) * np.cos(np.asarray(elements.azimuth))))
    # round-off of a converged solve
    np.testing.assert_allclose(along, 25e3, rtol=1e-9)
    assert 1e9 < float(np.max(np.asarray(elements.pressure_inner))) < 1.5e9


def slow_where_lubricated(names):
    """With films a scene takes seconds to compile, dry a tenth of one."""
    return [pytest.param(n, marks=pytest.mark.slow) if n.startswith("contact.traction") else n for n in names]


@pytest.mark.parametrize("left_out", slow_where_lubricated(WITHOUT_LOSSES))
def test_solves_without_losses(left_out):
    solution = jb.solve(scene_from_tables(tables(left_out)))
    check_loads(solution)
    assert losses(solution) == {}
    assert solution.power_loss.total is solution.drive_power is None
    assert set(solution.not_modelled) == LOSSES | {"element_ends"}
    assert solution.cage is None
    idle = [text for text in solution.warnings if "no effect" in text]
    expected = WITHOUT_LOSSES[left_out]
    assert len(idle) == bool(expected)
    assert all(text.endswith(f": {expected}") for text in idle)


@pytest.mark.slow
@pytest.mark.parametrize("left_out", LUBRICATED)
def test_solves_with_losses(left_out):
    solution = jb.solve(scene_from_tables(tables(left_out)))
    check_loads(solution)
    power = losses(solution)
    assert set(power) == LOSSES - LUBRICATED[left_out]
    assert all(value > 0.0 for value in power.values())
    total = float(solution.power_loss.total)
    assert 200.0 < total < 10e3
    np.testing.assert_allclose(math.fsum(power.values()), total, rtol=1e-12)
    # assembled from torques: the two agree as far as the solve has converged
    np.testing.assert_allclose(float(solution.drive_power), total, rtol=1e-7)
    slip = float(solution.cage.slip)
    assert abs(slip) < 0.05
    # drag and rolling resistance hold the rollers back; without both, the land on the inner ring hurries the cage
    assert (slip > 0.0) == bool({"drag", "rolling_resistance"} & set(power))
    assert any("contact_length is not given" in text for text in solution.warnings)
