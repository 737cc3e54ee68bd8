"""Flexible rings in their plane: closed forms, check values of part B of the sheet, and a ring of straight beams."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from beam_ring import BeamRing

from jaxbearing.mounting.bending import (
    Foundation,
    RingSection,
    aliased_compliance,
    compliance_of_orders,
    rectangular_section,
)
from jaxbearing.mounting.bent_ring import BentRing, RimLoads, Supports, point_load

THIN = RingSection(1000.0, 1e12, 0.1)
"""A ring without axial strain (1e-7 of the rest) and shear."""
SHEET = rectangular_section(210e9, 0.020, 0.008, 0.081, 0.3)
WITHOUT_SHEAR = rectangular_section(210e9, 0.020, 0.008, 0.081)


@eqx.filter_jit
def bends(ring, places, force, angles):
    """Deflections of a ring at angles by a force at each of several places, and by its own loads."""
    pressed = sum(point_load(ring, place, force) for place in places)
    return ring.deflection(ring.amplitudes(pressed), jnp.asarray(angles))


def test_two_opposite_loads_on_a_free_ring():
    unit = 0.1**3 / 1000.0
    at = lambda angle: float(THIN.deflection_of_point_load(jnp.asarray(angle)))
    along, across = 2.0 * (at(0.0) + at(np.pi)), 4.0 * at(0.5 * np.pi)
    np.testing.assert_allclose(along / unit, np.pi / 4 - 2 / np.pi, rtol=1e-6)
    np.testing.assert_allclose(-across / unit, 2 / np.pi - 0.5, rtol=1e-6)
    np.testing.assert_allclose([np.pi / 4 - 2 / np.pi, 2 / np.pi - 0.5], [0.1487783910, 0.1366197724], rtol=1e-9)


def test_uniform_pressure_stretches_the_ring():
    ring = BentRing(SHEET, (0, 2))
    # q = 1 N/m: the generalised load of order 0 is the whole of it
    amplitudes = ring.amplitudes(jnp.asarray([2 * np.pi * 0.081, 0.0, 0.0]))
    np.testing.assert_allclose(amplitudes[0], 0.081**2 / (210e9 * 0.020 * 0.008), rtol=1e-12)


def test_kernels_of_the_sheet():
    angles = jnp.asarray([0.0, 0.5, 1.0, 0.5 * np.pi, np.pi])
    k2 = [0.13496703, 0.05664633, -0.06321848, -0.10730092, 0.09873352]
    k1 = [0.75, 0.08617215, -0.26596846, -0.28539816, 0.25]
    # EI = pi, R = 1 and a huge EA: only bending; with kappa G A = EI the shear kernel comes on top
    found = RingSection(np.pi, 1e30, 1.0).deflection_of_point_load(angles)
    np.testing.assert_allclose(np.pi**2 * found, k2, atol=1e-8)
    shear = RingSection(np.pi, 1e30, 1.0, np.pi).deflection_of_point_load(angles)
    np.testing.assert_allclose(np.pi**2 * (shear - 2.0 * found), k1, atol=1e-8)


def test_compliances_of_the_sheet():
    np.testing.assert_allclose([SHEET.axial_share, SHEET.shear_share], [8.128842148e-4, 2.53619875e-3], rtol=1e-9)
    found = 1.0 / SHEET.stiffness(np.asarray([0, 2, 3, 6, 12]))
    sheet = [1.952678571e-10, 2.698314308e-8, 3.842101036e-9, 2.141582290e-10, 1.604681342e-11]
    np.testing.assert_allclose(found, sheet, rtol=1e-9)


@pytest.mark.parametrize("section", [SHEET, WITHOUT_SHEAR], ids=["shear", "bending"])
def test_closed_form_is_the_sum_of_harmonics(section):
    ring = BentRing(section, tuple(range(2, 2001)))
    angles = jnp.asarray([0.0, 0.3, 2.0, 5.5])
    found = bends(ring, [0.4], 1.0, angles + 0.4)
    # with shear the rest of the sum falls with the order alone
    scale = float(jnp.max(jnp.abs(found)))
    np.testing.assert_allclose(found, section.deflection_of_point_load(angles), atol=2e-5 * scale)


def test_free_ring_of_the_sheet():
    growth = 1000.0 / (np.pi * 0.081) * (1.952678571e-10)
    at = lambda angle: 1000.0 * float(SHEET.deflection_of_point_load(jnp.asarray(angle)))
    np.testing.assert_allclose(at(0.0) + at(np.pi) + growth, 2.2451122e-4, rtol=1e-7)
    np.testing.assert_allclose(2 * at(0.5 * np.pi) + growth, -2.0385957e-4, rtol=1e-7)


def beams(section=WITHOUT_SHEAR, **more):
    shear = np.inf if section.shear_stiffness is None else section.shear_stiffness
    return BeamRing(section.bending_stiffness, section.axial_stiffness, section.radius, shear, **more)


def test_free_ring_against_beams():
    found = beams(SHEET).deflections({0: (1000.0, 0.0, 0.0), 180: (1000.0, 0.0, 0.0)})
    # the weak springs of a free ring leave its rigid motion to round-off (10 nm here), which differs between machines;
    # it falls out of the mean of opposite nodes
    opposite = 0.5 * (found + np.roll(found, 180))
    # straight beams: error of the second power of their angle
    np.testing.assert_allclose(opposite[[0, 90]], [2.2451122e-4, -2.0385957e-4], rtol=1e-4)


def test_elastic_foundation_against_beams_and_sheet():
    section, order = RingSection(179.2, 1e15, 0.081), tuple(range(1, 1501))
    ring = BentRing(section, order, Foundation(1e10))
    found = bends(ring, [0.0], 1000.0, jnp.zeros(1))
    np.testing.assert_allclose(found[0], 2.89005e-6, rtol=2e-6)
    whole = BentRing(WITHOUT_SHEAR, tuple(range(0, 121)), Foundation(1e10))
    angles = np.asarray([0.0, 0.2, 1.0])
    nodes = beams(count=720, foundation=1e10).deflections({0: (1000.0, 0.0, 0.0)})
    there = np.interp(angles, 2 * np.pi * np.arange(720) / 720, nodes)
    np.testing.assert_allclose(bends(whole, [0.0], 1000.0, angles), there, atol=2e-4 * nodes[0])


def test_teeth_against_beams():
    """A planet gear's rim: forces along and across the radius beside the centroid circle."""
    force, angle = 5e3, np.asarray([0.5 * np.pi, 1.5 * np.pi])
    radial = -force * np.tan(np.radians(20.0)) * np.ones(2)
    loads = RimLoads(*map(jnp.asarray, (angle, radial, np.asarray([force, -force]), np.full(2, 0.089))))
    ring = BentRing(SHEET, (0, *range(2, 60)), loads=loads)
    np.testing.assert_allclose(loads.resultant(), [-2.0 * force, 0.0], atol=1e-9)
    pins = np.radians([-30.0, 0.0, 30.0])
    pushed = 2.0 * force / (1.0 + 2.0 * np.cos(np.pi / 6))
    angles = 2 * np.pi * np.arange(360) / 360
    found = np.asarray(bends(ring, list(pins), pushed, angles))
    at_teeth = {90: (radial[0], force, force * 0.008), 270: (radial[0], -force, -force * 0.008)}
    nodes = beams(SHEET).deflections(at_teeth | dict.fromkeys((330, 0, 30), (pushed, 0.0, 0.0)))
    # a free ring has no place: compare without the displacement as a whole
    shift = 2.0 * np.mean(nodes * np.cos(angles)) * np.cos(angles) + 2.0 * np.mean(nodes * np.sin(angles)) * np.sin(
        angles
    )
    np.testing.assert_allclose(found, nodes - shift, atol=2e-3 * np.max(np.abs(found)))


def test_supports_against_beams():
    """The ring leans on two supports and lifts off from the third, towards which it does not move."""
    supports = Supports(*map(jnp.asarray, (np.radians([-30.0, 30.0, 90.0]), np.full(3, 2e8), np.zeros(3))))
    ring = BentRing(WITHOUT_SHEAR, tuple(range(61)), supports=supports)
    pressed = point_load(ring, 0.0, 10e3)
    balance = jax.jit(lambda x: (ring.balance(x, pressed), jax.jacfwd(lambda y: ring.balance(y, pressed))(x)))
    x = np.zeros(ring.modes)
    x[1] = 1e-4
    for _ in range(20):
        rows, matrix = balance(jnp.asarray(x))
        # the loads are symmetric: without the odd family, whose order 1 is held by the supports only
        x = x - np.linalg.lstsq(np.asarray(matrix), np.asarray(rows), rcond=1e-13)[0]
    np.testing.assert_allclose(balance(jnp.asarray(x))[0], 0.0, atol=1e-6)
    forces = eqx.filter_jit(ring.reactions)(jnp.asarray(x))
    np.testing.assert_allclose(forces, [10e3 / (2 * np.cos(np.pi / 6))] * 2 + [0.0], rtol=1e-9, atol=1e-6)
    lean = beams()
    for node in (30, 330):
        lean.spring(node, 2e8)
    nodes = lean.deflections({0: (10e3, 0.0, 0.0)})
    found = np.asarray(eqx.filter_jit(ring.deflection)(jnp.asarray(x), jnp.asarray(lean.angle)))
    np.testing.assert_allclose(found, nodes, atol=2e-3 * np.max(np.abs(nodes)))


def test_aliased_compliances_are_the_whole_sum():
    count, foundation = 30, Foundation(1e10)
    aliased = np.asarray(jax.jit(lambda: aliased_compliance(WITHOUT_SHEAR, foundation, count))())
    angles = 2 * np.pi * np.arange(count) / count
    found = sum(c * np.cos(m * angles) for m, c in enumerate(aliased))
    orders = np.arange(15001)
    whole = np.cos(orders * angles[:, None]) @ np.asarray(compliance_of_orders(WITHOUT_SHEAR, foundation, orders))
    np.testing.assert_allclose(found, whole, atol=1e-10 * np.max(whole))
    with pytest.raises(ValueError, match="even"):
        aliased_compliance(WITHOUT_SHEAR, foundation, 7)


def test_balance_is_the_gradient_of_the_energy():
    loads = RimLoads(*map(jnp.asarray, ([0.3], [50.0], [70.0], [0.09])))
    supports = Supports(*map(jnp.asarray, ([0.1, 3.0], [1e7, 1e8], [0.0, -1e-5])))
    ring = BentRing(SHEET, (0, 1, 2, 5), Foundation(1e9, 2e8), supports, loads)
    amplitudes = 1e-5 * jnp.asarray(np.random.default_rng(0).normal(size=ring.modes))
    both = jax.jit(lambda x: (ring.balance(x, jnp.zeros(ring.modes)), jax.grad(ring.energy)(x)))
    np.testing.assert_allclose(*both(amplitudes), rtol=1e-12)


def test_shapes_at_numpy_angles_are_constants():
    """No sine of a fixed place is computed in a program; both kinds of angles give the same shapes."""
    ring = BentRing(SHEET, (0, 2, 5))
    angles = np.linspace(0.0, 2.0 * np.pi, 7)
    found = ring.shapes(angles)
    assert isinstance(found, np.ndarray)
    expected = [np.ones(7), *(f(n * angles) for f in (np.cos, np.sin) for n in (2, 5))]
    np.testing.assert_allclose(found, expected, atol=1e-15)
    np.testing.assert_allclose(ring.shapes(jnp.asarray(angles)), found, atol=1e-15)
    program = jax.make_jaxpr(lambda amplitudes: ring.deflection(amplitudes, angles))(jnp.ones(5))
    assert not {"sin", "cos"} & {equation.primitive.name for equation in program.eqns}


@pytest.mark.parametrize("orders", [(0, 1, 2), (2, 2), (3, 2), (-1, 2), ()])
def test_refused_orders(orders):
    with pytest.raises(ValueError, match="orders"):
        BentRing(SHEET, orders)


@pytest.mark.parametrize(
    ("supports", "load", "sideways", "none"),
    [
        ([150.0, 210.0], (1.0, 0.0), True, True),
        ([-30.0, 30.0], (1.0, 0.0), True, False),
        ([-30.0, 30.0], (1.0, 1.0), True, True),
        ([0.0], (1.0, 0.0), True, False),
        ([0.0], (1.0, 1e-3), True, True),
        ([0.0, 180.0], (0.0, 1.0), True, True),
        ([0.0, 120.0, 240.0], (-0.3, -0.8), True, False),
        ([0.0, 180.0, 90.0], (0.5, -1e-3), True, True),
        ([60.0], (1.0, 0.0), False, False),
        ([120.0], (1.0, 0.0), False, True),
        ([120.0], (0.0, 0.0), True, False),
    ],
)
def test_what_supports_can_bear(supports, load, sideways, none):
    count = len(supports)
    found = Supports(jnp.radians(jnp.asarray(supports)), jnp.full(count, 1e8), jnp.zeros(count))
    assert bool(eqx.filter_jit(found.cannot_bear)(jnp.asarray(load), sideways)) == none


def test_tangent_is_the_derivative_of_the_balance():
    supports = Supports(jnp.asarray([0.1, 2.0, 4.0]), jnp.asarray([1e8, 2e8, 3e8]), jnp.asarray([0.0, 1e-6, -1e-6]))
    ring = BentRing(rectangular_section(210e9, 0.02, 8e-3, 0.081), (0, 1, 2, 3), None, supports)
    at = 1e-6 * jnp.asarray([0.3, 1.0, -0.5, 0.2, 0.7, -0.4, 0.1])
    balance = lambda x: ring.balance(x, jnp.zeros(ring.modes))
    both = jax.jit(lambda x: (ring.tangent(x), jax.jacfwd(balance)(x)))
    np.testing.assert_allclose(*both(at), rtol=1e-12, atol=1e-6)
