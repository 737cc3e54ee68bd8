"""Shares of the losses, conductances, heat capacities, reference speed."""

import re
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import quad

from jaxbearing.lubricants import ESTER_HEAT_CAPACITY, MINERAL_HEAT_CAPACITY
from jaxbearing.thermal import conductances, reference_speed, shares
from jaxbearing.thermal.conductances import Solid
from jaxbearing.thermal.network import NODES, network_of

STEEL, CERAMIC = Solid(46.0, 7830.0, 460.0), Solid(25.0, 3200.0, 700.0)
CONTACT = (60e-6, 500e-6)
RPM = np.pi / 30.0


def resistances(found):
    """R_1 and R_2 from the conductance and the share of body 1, K/W."""
    both = 1.0 / found.conductance
    return [float(both * (1.0 - found.share)), float(both * found.share)]


def test_factors_of_moving_sources():
    np.testing.assert_allclose(conductances.ELLIPSE, 0.6885458, rtol=1e-7)
    # an ellipse in strips along the motion: of the half length sqrt(1 - y^2), with the strip's own mean
    strips = quad(lambda y: (1.0 - y * y) ** 0.75, 0.0, 1.0)[0] * 4.0 / np.pi
    np.testing.assert_allclose(conductances.ELLIPSE, conductances.BAND * strips, rtol=1e-10)


def test_contact_check_values():
    """Printed with the factor rounded to seven digits, 0.6885458: 4e-9 of a resistance."""
    found = conductances.ellipse_contact_heat(*CONTACT, 0.3e-6, 0.13, (STEEL, STEEL), (40.0, 40.0))
    np.testing.assert_allclose(resistances(found), [13.22527395] * 2, rtol=4e-9)
    np.testing.assert_allclose(found.conductance, 0.03780640024, rtol=4e-9)
    found = conductances.ellipse_contact_heat(*CONTACT, 0.3e-6, 0.13, (STEEL, CERAMIC), (41.0, 39.0))
    np.testing.assert_allclose(resistances(found), [13.21322883, 13.95441711], rtol=4e-9)
    np.testing.assert_allclose(found.share, 0.5136410105, rtol=1e-9)
    found = conductances.ellipse_contact_heat(*CONTACT, 0.05e-6, 0.13, (STEEL, STEEL), (0.0, 0.0))
    np.testing.assert_allclose(resistances(found), [33.41818001] * 2, rtol=1e-9)


@pytest.mark.parametrize("law", [conductances.ellipse_contact_heat, conductances.line_contact_heat])
def test_contact_reversed_unloaded_and_its_derivatives(law):
    second = 500e-6 if law is conductances.ellipse_contact_heat else 10e-3
    heat = lambda *given: law(given[0], given[1], given[2], 0.13, (STEEL, CERAMIC), given[3:])
    forth, back = (heat(60e-6, second, 0.3e-6, sign * 20.0, sign * 5.0) for sign in (1.0, -1.0))
    assert forth == back
    for size in (60e-6, 1e-9, 0.0):
        given = (size, second if size or law is conductances.line_contact_heat else 0.0, 0.3e-6, 0.0, 20.0)
        value = heat(*given)
        slopes = jax.grad(lambda *at: heat(*at).conductance + heat(*at).share, argnums=range(5))(*given)
        assert np.all(np.isfinite([*value, *slopes]))
        if size == 0.0:
            assert (value.conductance, value.share) == (0.0, 0.5)
    # an unloaded contact may have no film
    assert np.isfinite(jax.grad(lambda film: heat(0.0, second, film, 1.0, 2.0).conductance)(jnp.nan))
    width = 1e-6
    moved = [heat(60e-6 * (1.0 + sign * width), second, 0.3e-6, 20.0, 5.0).conductance for sign in (1.0, -1.0)]
    slope = jax.grad(lambda a: heat(a, second, 0.3e-6, 20.0, 5.0).conductance)(60e-6)
    np.testing.assert_allclose(slope, (moved[0] - moved[1]) / (2.0 * width * 60e-6), rtol=1e-7)


def test_line_contact_by_hand():
    """Limits: a moving band, and a source at rest."""
    a, length, film, speed = 60e-6, 10e-3, 0.3e-6, 1e4
    thin = conductances.line_contact_heat(a, length, 0.0, 0.13, (STEEL, STEEL), (speed, speed))
    effusivity = np.sqrt(np.prod(STEEL))
    fast = 2.0 * a * length * effusivity * np.sqrt(speed / (2.0 * a)) / conductances.BAND
    np.testing.assert_allclose(2.0 * thin.conductance, fast, rtol=1e-4)
    still = conductances.line_contact_heat(a, length, 0.0, 0.13, (STEEL, STEEL), (0.0, 0.0))
    np.testing.assert_allclose(2.0 * still.conductance, np.pi * 46.0 * length / np.log(4.0 * length / a), rtol=1e-12)
    only_film = conductances.line_contact_heat(a, length, film, 1e-9, (STEEL, STEEL), (0.0, 0.0))
    np.testing.assert_allclose(only_film.conductance, 1e-9 * 2.0 * a * length / film, rtol=1e-6)


def test_oil_plate_and_filling():
    found = conductances.oil_heat_transfer(90.0, 0.0465, 0.13, 70.0, 4e-6)
    np.testing.assert_allclose(found, 2259.010613, rtol=1e-9)
    assert np.isfinite(jax.grad(conductances.oil_heat_transfer)(0.0, 0.0465, 0.13, 70.0, 4e-6))
    # the 35-mm bearing of NASA TP-2275
    np.testing.assert_allclose(conductances.oil_filling_conductance(46.0, 7.14e-3, 16), 0.13, atol=0.005)
    np.testing.assert_allclose(conductances.elements_surface(7e-3, 16), 16 * np.pi * 49e-6)
    np.testing.assert_allclose(conductances.elements_surface(7e-3, 16, 9e-3), 16 * np.pi * (63e-6 + 24.5e-6))
    np.testing.assert_allclose(conductances.ring_surface(0.03, 0.015), np.pi * 0.03 * 0.015)


def test_seat_is_smooth_where_it_becomes_loose():
    tight = conductances.seat_conductance(0.025, 0.015)
    np.testing.assert_allclose(tight, 5000.0 * np.pi * 0.025 * 0.015, rtol=1e-12)
    assert float(conductances.seat_conductance(0.025, 0.015, -5e-6)) == float(tight)
    loose = conductances.seat_conductance(0.025, 0.015, 1e-3)
    np.testing.assert_allclose(loose, np.pi * 0.025 * 0.015 * 0.13 / 0.5e-3, rtol=0.06)
    near = conductances.seat_conductance(0.025, 0.015, 1e-12)
    np.testing.assert_allclose(near, tight, rtol=1e-7)


def test_cylinder_in_air():
    convection = conductances.air_convection(353.15, 293.15, 0.15)
    radiation = conductances.radiation(353.15, 293.15)
    np.testing.assert_allclose((convection, radiation), (5.733922744, 6.947901762), rtol=1e-9)
    housing = conductances.CylindricalHousing(0.15, 0.2, 293.15)
    np.testing.assert_allclose(housing(353.15), 0.2 * (convection + radiation), rtol=1e-14)
    # its derivative is in the network's, and finite in the cold
    network = network_of(1, {}, {"bearing": housing}, 293.15)
    flow = lambda temperature: network.flows(jnp.full(1, temperature)).to_ambient
    assert np.isfinite(jax.grad(flow)(293.15))
    difference = (flow(353.16) - flow(353.14)) / 0.02
    np.testing.assert_allclose(jax.grad(flow)(353.15), difference, rtol=1e-8)


def test_heat_capacities():
    found = conductances.ring_capacity(0.025, 0.0305575, 0.015, 7830.0, 460.0)
    np.testing.assert_allclose(found, 7830.0 * 460.0 * 0.25 * np.pi * (0.0305575**2 - 0.025**2) * 0.015, rtol=1e-12)
    assert float(conductances.oil_capacity(0.01, 1e-5, 900.0, 2000.0)) == 5.0
    np.testing.assert_allclose(conductances.oil_capacity(0.5, 1e-5, 900.0, 2000.0), 9.0)
    np.testing.assert_allclose(MINERAL_HEAT_CAPACITY.heat_capacity(jnp.asarray([273.0, 373.0])), [1670.0, 2100.0])
    np.testing.assert_allclose(ESTER_HEAT_CAPACITY.heat_capacity(300.0), 2150.0)


@pytest.mark.parametrize("size", [1, 4, 6])
@pytest.mark.parametrize("ring", ["inner_ring", "outer_ring"])
def test_no_heat_is_lost_between_bearing_and_network(size, ring):
    nodes = NODES[size]
    own = {"pocket": {"elements": 0.2, "oil": 0.3, "inner_ring": 0.5}}
    parts = shares.loss_shares(
        nodes,
        inner_ring=0.51,
        outer_ring=0.47,
        rolling_to_oil=0.3,
        guiding_ring=ring,
        flange_ring=ring if size == 4 else "both",
        given=own,
    )
    assert set(parts) == set(shares.LOSSES)
    losses = {name: 10.0 * (1 + number) / 7.0 for number, name in enumerate(shares.LOSSES)}
    heat = shares.node_heat({**losses, "flange": None}, parts)
    np.testing.assert_allclose(jnp.sum(heat), sum(losses.values()) - losses["flange"], rtol=1e-15)
    if size == 1:
        return
    node = {name: np.asarray(row) for name, row in parts.items()}
    at = {name: index for index, name in enumerate(nodes)}
    np.testing.assert_allclose(node["inner_raceway"][[at["inner_ring"], at["elements"]]], [0.51, 0.49])
    rolling = node["outer_rolling_resistance"][[at["outer_ring"], at["elements"], at["oil"]]]
    np.testing.assert_allclose(rolling, [0.7 * 0.47, 0.7 * 0.53, 0.3])
    np.testing.assert_allclose(node["cage_pilot"][[at[ring], at["oil"]]], [0.5, 0.5])
    np.testing.assert_allclose(node["drag"][at["oil"]], 1.0)
    np.testing.assert_allclose(node["pocket"][[at["elements"], at["oil"], at["inner_ring"]]], [0.2, 0.3, 0.5])
    if size == 6:
        assert all(row[4] == row[5] == 0.0 for row in node.values())


def test_wrong_shares_are_refused():
    nodes = NODES[4]
    with pytest.raises(ValueError, match="did you mean 'pocket'"):
        shares.loss_shares(nodes, given={"pockets": {"oil": 1.0}})
    with pytest.raises(ValueError, match="names of nodes among"):
        shares.loss_shares(nodes, given={"pocket": {"housing": 1.0}})
    with pytest.raises(ValueError, match="add up to 1"):
        shares.loss_shares(nodes, given={"pocket": {"elements": 0.5, "oil": 0.6}})
    with pytest.raises(ValueError, match="between 0 and 1"):
        shares.loss_shares(nodes, inner_ring=1.5)
    with pytest.raises(ValueError, match="must be one of 'inner_ring', 'outer_ring'"):
        shares.loss_shares(nodes, guiding_ring="elements")


def test_oil_temperatures_of_the_interactions():
    temperatures = jnp.asarray([360.0, 340.0, 350.0, 330.0, 320.0, 310.0])
    found = shares.oil_temperatures(NODES[6], temperatures, guiding_ring="outer_ring", flange_ring="both")
    assert jax.tree.leaves(found) == [355.0, 345.0, 350.0, 340.0, 335.0, 330.0]
    assert float(found.element_ends) == 340.0
    assert jax.tree.leaves(shares.oil_temperatures(NODES[1], temperatures[:1])) == [360.0] * 6


def test_reference_speed_of_6205():
    area = reference_speed.radial_seat_area(0.025, 0.052, 0.015)
    np.testing.assert_allclose(area, 3628.539515e-6, rtol=1e-9)
    heat = reference_speed.reference_heat_flow(area) * area
    np.testing.assert_allclose(heat, 58.05663224, rtol=1e-9)
    np.testing.assert_allclose(reference_speed.reference_conductance(area), 1.16, atol=0.005)
    law = (0.05 * 7.8e3, 0.0385, 2.0, 2e-4)
    found = reference_speed.reference_speed(heat, 12e-6, *law)
    np.testing.assert_allclose(found / RPM, 14_420.53075, rtol=1e-9)
    # in the reference conditions the safe speed is the reference speed
    np.testing.assert_allclose(reference_speed.safe_speed(found, heat, 12e-6, *law), found, rtol=1e-12)
    friction = 0.1 * 2.0 * (12.0 * found / RPM) ** (2.0 / 3.0) * 0.0385**3 * found / heat
    np.testing.assert_allclose(friction, 0.9218887918, rtol=1e-9)
    np.testing.assert_allclose(2e-4 * 390.0 * 0.0385 * found / heat, 0.0781112082, rtol=1e-8)
    # its own losses by the general way
    own = lambda speed, given: reference_speed.palmgren_torque(speed, *given) * speed
    args = tuple(map(jnp.asarray, (12e-6, *law)))
    root = reference_speed.speed_of_heat(own, args, heat, 10.0, 1e5)
    np.testing.assert_allclose(root.value, found, rtol=1e-12)
    assert float(root.residual) < 1e-10
    slope = jax.grad(lambda load: reference_speed.reference_speed(heat, 12e-6, load, *law[1:]))(390.0)
    width = 0.1
    moved = [reference_speed.reference_speed(heat, 12e-6, 390.0 + sign * width, *law[1:]) for sign in (1.0, -1.0)]
    np.testing.assert_allclose(slope, (moved[0] - moved[1]) / (2.0 * width), rtol=1e-7)


def test_reference_heat_flow():
    np.testing.assert_allclose(reference_speed.reference_heat_flow(0.1), 0.01264066099e6, rtol=1e-9)
    np.testing.assert_allclose(reference_speed.reference_heat_flow(0.1, thrust=True), 0.01790050142e6, rtol=1e-9)
    np.testing.assert_allclose(reference_speed.reference_heat_flow(0.05), 16e3, rtol=1e-14)
    np.testing.assert_allclose(reference_speed.thrust_seat_area(0.1, 0.2), np.pi / 2.0 * 0.03, rtol=1e-12)
    found = reference_speed.spherical_thrust_seat_area(0.1, 0.2, 0.19, 0.12)
    np.testing.assert_allclose(found, np.pi / 4.0 * (0.04 + 0.0361 - 0.0144 - 0.01), rtol=1e-12)


@pytest.mark.parametrize(
    ("viscous", "load", "ratio"), [(1, 1, 0.5876798029), (0.5, 2, 0.4370699291), (2, 0.1, 0.6343160515)]
)
def test_safe_speed_ratio(viscous, load, ratio):
    found = reference_speed.safe_speed_ratio(float(viscous), float(load))
    np.testing.assert_allclose(found, ratio, rtol=1e-9)
    assert np.all(np.isfinite(jax.grad(reference_speed.safe_speed_ratio, argnums=(0, 1))(float(viscous), float(load))))


def test_safe_speed_of_one_part_alone():
    np.testing.assert_allclose(reference_speed.safe_speed_ratio(2.0, 0.0), 2.0**-0.6, rtol=1e-12)
    np.testing.assert_allclose(reference_speed.safe_speed_ratio(0.0, 4.0), 0.25, rtol=1e-12)


def test_friction_moment_is_continuous_where_the_oil_is_thin():
    torque = lambda product: reference_speed.palmgren_torque(product * RPM, 1e-6, 0.0, 0.05, 2.0, 1e-4)
    speeds = jnp.linspace(1900.0, 2100.0, 2001)
    assert float(jnp.max(jnp.abs(jnp.diff(torque(speeds))))) < 1e-4 * float(torque(2000.0))
    np.testing.assert_allclose(torque(1.0), 0.1 * 2.0 * 160.0 * 0.05**3, rtol=1e-12)


def test_python_of_the_page_runs(capsys):
    page = (Path(__file__).parents[2] / "docs" / "thermal.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    (block,) = [one for one in blocks if "solve_network" in one]
    exec(compile(block, "thermal.md", "exec"), {})
    assert capsys.readouterr().out.startswith("steady temperatures found in ")
