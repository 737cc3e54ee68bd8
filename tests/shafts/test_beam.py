"""The shaft as a beam: check values C1 to C3 of the sheet "several bearings together", and closed forms."""

import jax.numpy as jnp
import numpy as np
from shaft_cases import steel

from jaxbearing.materials import Material
from jaxbearing.shafts import Gravity, Section, Shaft
from jaxbearing.shafts.beam import beam_of, element_stiffness, shear_factor, shifts


def beam(*sections, gravity=None):
    return beam_of(Shaft(0.0, [Section(*one) for one in sections], steel(206e9), gravity))


def test_shear_factor():
    np.testing.assert_allclose(shear_factor(0.3, 0.0), 0.886363636, rtol=1e-9)
    np.testing.assert_allclose(shear_factor(0.3, 0.5), 0.620229008, rtol=1e-9)


def test_shear_number_of_an_element():
    phi = element_stiffness(0.1, 0.04, 0.0, steel(206e9))[1]
    np.testing.assert_allclose(phi, 0.352, rtol=1e-12)
    # as another program of rotor dynamics prints it; Poisson's ratio is rounded to eight digits
    other = Material(211e9, 0.29926108, 7850.0)
    np.testing.assert_allclose(element_stiffness(0.5, 0.1, 0.05, other)[1], 0.15712684729, rtol=1e-8)


def test_compliance_is_the_inverse_of_the_finite_element():
    one = beam((0.13, 0.04, 0.01))
    at = jnp.asarray([0.13])
    matrix = element_stiffness(0.13, 0.04, 0.01, steel(206e9))[0]
    clamped = np.linalg.inv(np.asarray(matrix)[2:, 2:])
    found = np.asarray(one.compliance(at, at))[0, 0]
    signs = np.array([1.0, -1.0])  # the element counts -tilt
    np.testing.assert_allclose(found[np.ix_([1, 3], [1, 3])], signs[:, None] * clamped * signs, rtol=1e-9)


def test_simply_supported_shaft():
    """C1."""
    at = jnp.asarray([0.1, 0.2])
    c = np.asarray(beam((0.2, 0.04)).compliance(at, at))[:, :, 1, 1]
    tilt = (c[1, 0] * 1e3 - c[1, 1] * 500.0) / 0.2
    np.testing.assert_allclose(c[0, 0] * 1e3 - c[0, 1] * 500.0 - 0.1 * tilt, 7.0048778e-6, rtol=1e-7)
    np.testing.assert_allclose(tilt, -9.6574601e-5, rtol=1e-7)


def test_clamped_stepped_shaft():
    """C2."""
    at = jnp.asarray([0.16])
    moved = np.asarray(beam((0.1, 0.04), (0.06, 0.03, 0.012)).compliance(at, at))[0, 0] @ [0.0, 500.0, 0.0, 0.0, 0.0]
    np.testing.assert_allclose(moved[[1, 3]], [3.1006771e-5, -3.2523140e-4], rtol=1e-7)


def test_more_sections_change_nothing():
    at = jnp.asarray([0.03, 0.11, 0.2])
    gravity = Gravity(9.81, 0.3)
    coarse, fine = beam((0.2, 0.04), gravity=gravity), beam(*[(0.02, 0.04)] * 10, gravity=gravity)
    np.testing.assert_allclose(fine.compliance(at, at), coarse.compliance(at, at), rtol=1e-11, atol=1e-25)
    np.testing.assert_allclose(fine.sagging(at), coarse.sagging(at), rtol=1e-11, atol=1e-25)


def test_end_moments_of_a_clamped_shaft_under_its_weight():
    one = beam((0.2, 0.04), gravity=Gravity(9.81, 0.0))
    load, at = float(one.weight[0, 0]), jnp.asarray([0.2])
    held = -np.linalg.solve(np.asarray(one.compliance(at, at))[0, 0], np.asarray(one.sagging(at))[0])
    np.testing.assert_allclose(held[[1, 3]], [-load * 0.1, -load * 0.04 / 12.0], rtol=1e-12)


def test_two_spans_under_uniform_load():
    """C3, rigid supports: reactions at the ends and in the middle."""
    one = beam((0.4, 0.04), gravity=Gravity(9.81, 0.0))
    at = jnp.asarray([0.0, 0.2, 0.4])
    compliance, sag = np.asarray(one.compliance(at, at))[:, :, 1, 1], np.asarray(one.sagging(at))[:, 1]
    rigid = np.asarray(shifts(at))[:, 1][:, [1, 3]]
    matrix = np.block([[compliance, rigid], [rigid.T, np.zeros((2, 2))]])
    weight = np.asarray(one.weight_at(jnp.zeros(())))[[1, 3]]
    reactions = np.linalg.solve(matrix, np.concatenate([-sag, -weight]))[:3]
    unit = float(one.weight[0, 0]) * 0.2
    np.testing.assert_allclose(-reactions / unit, [0.377690885, 1.24461840, 0.377690885], rtol=1e-6)


def test_three_springs_of_equal_stiffness():
    """C3, elastic: 3 kN at the middle support."""
    at = jnp.asarray([0.0, 0.2, 0.4])
    compliance = np.asarray(beam((0.4, 0.04)).compliance(at, at))[:, :, 1, 1] + np.eye(3) / 5e7
    rigid = np.asarray(shifts(at))[:, 1][:, [1, 3]]
    matrix = np.block([[compliance, rigid], [rigid.T, np.zeros((2, 2))]])
    bent = (compliance - np.eye(3) / 5e7)[:, 1] * 3e3
    reactions = np.linalg.solve(matrix, np.concatenate([-bent, -3e3 * rigid[1]]))[:3]
    np.testing.assert_allclose(reactions, [-363.0221, -2273.9558, -363.0221], rtol=1e-6)
