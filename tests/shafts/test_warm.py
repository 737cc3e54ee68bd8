"""One thermal network along shaft and housing."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from shaft_cases import DEEP_GROOVE, RPM

import jaxbearing as jb
from jaxbearing.materials import Material
from jaxbearing.shafts import DutyResult, MountedBearing, PointLoad, Section, Shaft, ShaftSystem, ShaftThermal
from jaxbearing.shafts.heat import between_neighbours, flows_along, gap_conductances, growth_along

STEEL = Material(206e9, 0.3, 7850.0, thermal_expansion=12e-6, conductivity=46.0)
SHAFT = Shaft(100.0, [Section(0.1, 0.03), Section(0.1, 0.04, 0.02)], STEEL, strain_reference=0.05)
JOINED = ShaftThermal(housing_expansion=20e-6, housing_conductance=3.0)
AT = jnp.asarray([0.18, 0.02, 0.12])
"""Positions in another order than along the shaft."""


def test_conductance_of_a_stepped_shaft():
    area = 0.25 * np.pi * np.asarray([0.03**2, 0.04**2 - 0.02**2])
    first = 1.0 / (0.08 / (46.0 * area[0]) + 0.02 / (46.0 * area[1]))
    second = 46.0 * area[1] / 0.06
    np.testing.assert_allclose(gap_conductances(JOINED, SHAFT, jnp.sort(AT)), [first, second], rtol=1e-12)
    matrix = np.asarray(between_neighbours(JOINED, SHAFT, AT)).reshape(3, 6, 3, 6)
    np.testing.assert_allclose(matrix[1, 4, 2, 4], first, rtol=1e-12)
    np.testing.assert_allclose(matrix[0, 4, 2, 4], second, rtol=1e-12)
    assert matrix[0, 4, 1, 4] == 0.0
    assert matrix[2, 5, 0, 5] == matrix[1, 5, 2, 5] == 3.0
    np.testing.assert_array_equal(matrix, matrix.transpose(2, 3, 0, 1))
    given = dataclasses.replace(JOINED, shaft_conductance=0.5)
    np.testing.assert_array_equal(gap_conductances(given, SHAFT, jnp.sort(AT)), 0.5)


def test_growth_along_the_shaft():
    """Temperatures that change linearly between the bearings and are constant beyond them."""
    temperatures = jnp.full((3, 6), 293.15)
    temperatures = temperatures.at[:, 4].set(jnp.asarray([333.15, 313.15, 323.15])).at[1:, 5].set(303.15)
    fine = np.linspace(0.0, 0.2, 200_001)
    x, order = np.asarray(AT), np.argsort(AT)
    shaft = np.interp(fine, x[order], np.asarray(temperatures)[order, 4]) - 293.15
    housing = np.interp(fine, x[order], np.asarray(temperatures)[order, 5]) - 293.15
    strain = 12e-6 * shaft - 20e-6 * housing
    grown = np.concatenate([[0.0], np.cumsum(0.5 * (strain[1:] + strain[:-1]) * np.diff(fine))])
    expected = np.interp(x, fine, grown) - np.interp(0.05, fine, grown)
    found = growth_along(JOINED, SHAFT, AT, temperatures, AT)
    np.testing.assert_allclose(found, expected, rtol=1e-8)
    along, inside = flows_along(JOINED, SHAFT, AT, temperatures)
    np.testing.assert_allclose(along, -10.0 * gap_conductances(JOINED, SHAFT, jnp.sort(AT)), rtol=1e-12)
    np.testing.assert_allclose(inside, [0.0, 30.0], atol=1e-12)


def test_what_one_network_needs():
    warm = bearing()
    bearings = [MountedBearing("A", warm, 0.02), MountedBearing("B", warm, 0.18, "-x")]
    plain = Shaft(100.0, [Section(0.2, 0.03)])
    with pytest.raises(ValueError, match=r"shaft\.material\.thermal_expansion: found nothing"):
        ShaftSystem(plain, bearings, thermal=JOINED)
    with pytest.raises(ValueError, match="two or more bearings"):
        ShaftSystem(SHAFT, [bearings[0], MountedBearing("B", DEEP_GROOVE, 0.18)], thermal=JOINED)
    four = jb.load_scene("deep_groove_6205_mounted")
    with pytest.raises(ValueError, match=r"bearing\.B\.thermal\.nodes must be 6"):
        ShaftSystem(SHAFT, [bearings[0], MountedBearing("B", four, 0.18)], thermal=JOINED)
    with pytest.raises(ValueError, match=r"shaft\.thermal_strain: expected none"):
        ShaftSystem(dataclasses.replace(SHAFT, thermal_strain=1e-5), bearings, thermal=JOINED)
    with pytest.raises(ValueError, match=r"thermal\.shaft_conductance: found nothing"):
        ShaftSystem(Shaft(100.0, material=STEEL), bearings, thermal=JOINED)


def bearing():
    ways = {"shaft_ambient": "0.5 W/K", "housing_ambient": "1 W/K"}
    changes = {f"thermal.conductance.{name}": value for name, value in ways.items()}
    return jb.load_scene("deep_groove_6205_mounted", changes | {"thermal.nodes": "6"})


def system(conductance, radial=1500.0, housing=2.0):
    """Two bearings, the first of which carries most of the load."""
    warm = bearing()
    joined = ShaftThermal(12e-6, housing_conductance=housing, shaft_conductance=conductance)
    return ShaftSystem(
        Shaft(6000.0 * RPM, [Section(0.2, 0.03)], STEEL),
        [MountedBearing("A", warm, 0.02), MountedBearing("B", warm, 0.18, "-x")],
        forces=[PointLoad("load", 0.06, radial=radial, axial=100.0)],
        thermal=joined,
    )


@pytest.mark.slow
def test_a_network_along_the_shaft():
    """Heat balances in every bearing and as a whole; a better conductor evens out the temperatures; derivatives equal
    differences."""

    def results(conductance, radial):
        solved = jb.solve(system(conductance, radial), throw=False)
        each = [one.solution.thermal for one in solved.bearings.values()]
        shaft = jnp.stack([one.temperatures.shaft for one in each])
        kept = (solved.thermal.shaft_flow[0], solved.thermal.balance_error, solved.torque.power_loss)
        own = jnp.stack([one.balance_error for one in each])
        away = jnp.stack([one.flows.shaft_neighbours for one in each])
        closure = jnp.stack([one.closure for one in solved.bearings.values()])
        return shaft, {"kept": jnp.stack(kept), "own": own, "away": away, "closure": closure, "status": solved.status}

    tangents = lambda *x: jax.jvp(results, x, (1.0, 0.0), has_aux=True)
    compiled = jax.jit(tangents)
    shaft, slope, more = compiled(0.2, 1500.0)
    flow, error, _ = more["kept"]
    assert int(more["status"]) == jb.Status.CONVERGED
    assert abs(float(error)) < 1e-8
    np.testing.assert_allclose(more["own"], 0.0, atol=1e-7)
    np.testing.assert_allclose(more["away"], [flow, -flow], rtol=1e-9)
    np.testing.assert_allclose(flow, 0.2 * (shaft[0] - shaft[1]), rtol=1e-9)
    step = 1e-4
    difference = (compiled(0.2 + step, 1500.0)[0] - compiled(0.2 - step, 1500.0)[0]) / (2.0 * step)
    np.testing.assert_allclose(slope, difference, rtol=1e-5)
    apart = [float(compiled(one, 1500.0)[0] @ jnp.asarray([1.0, -1.0])) for one in (1e-3, 0.2, 20.0)]
    assert apart[0] > apart[1] > apart[2] > 0.0
    assert apart[2] < 0.1 * apart[0]


@pytest.mark.slow
def test_a_runaway_has_its_status_and_names_the_place():
    """Above the limit of temperature there is no result, and the message says where and at which speed."""

    @jax.jit
    def solved(rpm):
        cool = system(0.2)
        bearings = [
            dataclasses.replace(one, scene=one.scene.replace({"thermal.limit": 273.15 + 60.0})) for one in cool.bearings
        ]
        shaft = dataclasses.replace(cool.shaft, speed=rpm * RPM)
        return jb.solve(dataclasses.replace(cool, bearings=bearings, shaft=shaft), throw=False)

    slow, fast = solved(6000.0), solved(20000.0)
    assert int(slow.status) == jb.Status.CONVERGED
    assert float(slow.bearings["A"].solution.thermal.temperatures.inner_ring) < 273.15 + 60.0
    assert int(fast.status) == jb.Status.THERMAL_RUNAWAY
    for word in (
        "thermal_runaway: no steady state",
        "thermal.limit",
        "hottest node, the ",
        "in bearing A",
    ):
        assert word in fast.failure()
    thermal = [one.solution.thermal for one in fast.bearings.values()]
    results = [fast.thermal, fast.torque, *([one.flows, one.heat_to_oil, one.temperatures] for one in thermal)]
    assert all(np.all(np.isnan(leaf)) for leaf in jax.tree.leaves(results) if jnp.issubdtype(leaf.dtype, jnp.floating))
    states = jax.tree.map(lambda *leaves: jnp.stack(leaves), slow, fast)
    duty = DutyResult({}, None, jnp.asarray([0.5, 0.5]), states, ("slow", "fast"))
    told = dataclasses.replace(slow, status=fast.status, duty=duty).failure()
    assert told == f"{fast.failure()}, in state fast"
