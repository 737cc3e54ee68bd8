"""Stresses of a turning cage: a ring by its harmonics and by an independent bending line, printed values."""

import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.scene import BallCage
from jaxbearing.bearings.cage_stress import cage_section, radial_bending, tangential_bending
from jaxbearing.bearings.cylindrical.geometry import RollerCage, RollerGeometry

ANGLES = np.linspace(0.0, 2.0 * np.pi, 41)[:-1]
TABLE_15 = BallGeometry(20, 153e-3, 20.638e-3, 0.5225, 0.51125, contact_angle=np.radians(30.0))
CAGE = BallCage("inner_ring", 480e-6, 300e-6, 3.98e-3, inner_diameter=145e-3, outer_diameter=161e-3)


@pytest.mark.parametrize(
    ("closed", "term"),
    [
        (radial_bending, lambda n, angle: np.cos(n * angle) / (n**2 - 1.0)),
        (tangential_bending, lambda n, angle: np.sin(n * angle) / (n * (n**2 - 1.0))),
    ],
)
def test_closed_forms_are_the_sums(closed, term):
    n = np.arange(2.0, 20001.0)[:, None]
    # the radial sum leaves 1/n
    np.testing.assert_allclose(
        closed(ANGLES), np.sum(term(n, ANGLES), axis=0), atol=1e-4 if closed is radial_bending else 1e-8
    )


@pytest.mark.parametrize("closed", [radial_bending, tangential_bending])
def test_bending_balances_on_a_free_ring(closed):
    """A cut ring: equilibrium of a part of it under the force at 0 and the inertia of the ring that carries it; and no
    gap opens, which the three redundants at the cut are for. Forces and moments by quadrature, without harmonics."""
    angle = (np.arange(4000) + 0.5) * 2.0 * np.pi / 4000
    step = angle[1] - angle[0]
    out, along = np.stack([np.cos(angle), np.sin(angle)]), np.stack([-np.sin(angle), np.cos(angle)])
    force = np.asarray([1.0, 0.0]) if closed is radial_bending else np.asarray([0.0, 1.0])
    # a thin ring of radius and mass 1: rigid acceleration, and for a tangential force rotation
    spin = 0.0 if closed is radial_bending else 1.0
    body = -(force[:, None] + spin * along) / (2.0 * np.pi)
    # moment at an angle of all that acts between 0 and there, the force at 0 included
    pull, turn = np.cumsum(body * step, axis=1), np.cumsum((out[0] * body[1] - out[1] * body[0]) * step)
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    origin = np.asarray([1.0, 0.0])
    own = turn + cross(origin, force) - (cross(out, pull) + cross(out, force[:, None]))
    # redundants: constant, and a force at the cut
    shapes = np.stack([np.ones_like(angle), out[0], out[1]])
    free = own - shapes.T @ np.linalg.solve(shapes @ shapes.T, shapes @ own)
    sign = np.sign(np.sum(free * closed(angle)))
    np.testing.assert_allclose(sign * free, np.asarray(closed(angle)) / np.pi, atol=1e-3)


def test_two_opposite_forces():
    opposite = lambda angle: (radial_bending(angle) + radial_bending(np.mod(angle + np.pi, 2.0 * np.pi))) / np.pi
    np.testing.assert_allclose(opposite(0.0), 1.0 / np.pi, rtol=1e-12)
    np.testing.assert_allclose(opposite(0.5 * np.pi), 1.0 / np.pi - 0.5, rtol=1e-12)


def test_printed_stresses():
    """Cage of Table 15 in bronze: 575 rad/s, 100 N."""
    section = cage_section(CAGE, TABLE_15, 8800.0)
    np.testing.assert_allclose(section.hoop(575.0), 17.03e6, rtol=3e-4)
    np.testing.assert_allclose(section.bar(100.0), 20.5e6, rtol=2e-3)
    moment = 100.0 * 76.5e-3 / np.pi
    np.testing.assert_allclose(moment, 2.435, rtol=2e-4)
    np.testing.assert_allclose(moment / section.rail_modulus, 28.68e6, rtol=2e-4)


def test_rails_add_up_with_their_signs():
    """Like forces on all pockets only turn the cage; one force more is that force alone."""
    section = cage_section(CAGE, TABLE_15, 8800.0)
    pockets = jnp.asarray(2.0 * np.pi * np.arange(20) / 20)
    places = jnp.asarray(ANGLES)
    alone = section.rails(places, pockets, jnp.zeros(20).at[3].set(50.0))
    together = section.rails(places, pockets, jnp.full(20, 10.0).at[3].add(50.0))
    largest = np.abs(alone).max()
    # twenty forces leave the harmonics 20, 40, ... of a sum that falls with the third power
    np.testing.assert_allclose(together, alone, atol=1e-2 * largest)
    over_time = section.rails(places, pockets, jnp.stack([jnp.zeros(20), jnp.zeros(20).at[3].set(50.0)]))
    np.testing.assert_allclose(over_time, np.stack([np.zeros(40), alone]), atol=1e-9 * largest)


def test_cage_of_rollers():
    geometry = RollerGeometry(30, 142e-3, 12e-3, 12e-3, 50e-6)
    cage = RollerCage("outer_ring", 300e-6, 150e-6, 3e-3, inner_diameter=136e-3, outer_diameter=148e-3)
    section = cage_section(cage, geometry, 8800.0)
    width = np.pi * 142e-3 / 30 - 12.15e-3
    np.testing.assert_allclose(section.bar(100.0), 100.0 * 12e-3 / 8.0 / (width**2 * 6e-3 / 6.0), rtol=1e-12)
