"""Mesh and kernel against closed forms."""

import mpmath
import numpy as np
import pytest
from numpy.testing import assert_allclose

from jaxbearing.ehl.mesh import MeshKey, hat_kernel, levels, mesh


def test_row_of_the_kernel():
    """The spec's row, independent numpy."""
    row = hat_kernel(np.array([-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0]))[1]
    assert_allclose(
        row, [-1.29828679514, -0.40342640972, -0.03846319728, 0.16862768435, 1.17357898171], rtol=0, atol=1e-11
    )


def test_kernel_by_quadrature():
    from scipy.integrate import quad

    x = np.array([-1.0, -0.3, 0.1, 0.9, 1.4])
    for j in range(1, 4):
        hat = lambda s, j=j: np.interp(s, x[j - 1 : j + 2], [0.0, 1.0, 0.0])
        for i, place in enumerate(x):
            points = sorted({x[j], *([place] if x[j - 1] < place < x[j + 1] else [])})
            integrand = lambda s, hat=hat, place=place: hat(s) * np.log(abs(s - place))
            exact = quad(integrand, x[j - 1], x[j + 1], points=points)[0]
            assert_allclose(hat_kernel(x)[i, j - 1], exact, atol=1e-8)


def test_kernel_on_random_graded_nodes():
    """30 digits by mpmath, each interval parted where the logarithm is singular; steps from 1e-3 to 1."""
    rng = np.random.default_rng(7)
    x = np.cumsum(10.0 ** rng.uniform(-3.0, 0.0, 11)) - 2.0
    kernel = hat_kernel(x)
    for j in (1, 4, 9):
        for i in (0, j - 1, j, j + 1, 7):
            assert_allclose(kernel[i, j - 1], hat_integral(x[j - 1 : j + 2], x[i]), rtol=1e-10, atol=1e-12)


def hat_integral(nodes, place):
    """Of the hat function on three nodes with ln|x - place|, `place` one of them or outside."""
    with mpmath.workdps(30):
        left, middle, right, place = (mpmath.mpf(float(value)) for value in (*nodes, place))
        up = lambda s: (s - left) / (middle - left) * mpmath.log(abs(s - place))
        down = lambda s: (right - s) / (right - middle) * mpmath.log(abs(s - place))
        return float(mpmath.quad(up, [left, middle]) + mpmath.quad(down, [middle, right]))


@pytest.mark.parametrize(("nodes", "error"), [(101, 5.7e-4), (201, 1.16e-4), (401, 2.9e-5)])
def test_dry_limit(nodes, error):
    """Hertz' pressure gives a flat gap inside and the closed form outside; errors as the spec prints them."""
    grid = mesh(MeshKey(nodes))
    x = grid.x
    pressure = np.sqrt(np.maximum(1.0 - x**2, 0.0))[1:-1]
    shape = 0.5 * x**2 + grid.kernel @ pressure
    out = np.maximum(np.abs(x), 1.0)
    exact = 0.25 + 0.5 * np.log(2.0) + 0.5 * out * np.sqrt(out**2 - 1) - 0.5 * np.log(out + np.sqrt(out**2 - 1))
    assert_allclose(np.max(np.abs(shape - exact)), error, rtol=0.03)


@pytest.mark.parametrize(
    "key", [MeshKey(101), MeshKey(201, 8.0), MeshKey(201, 4.0, 2.5, True), MeshKey(201, 4.0, 4.0, True)]
)
def test_meshes_increase_and_are_fine_at_both_edges(key):
    grid = mesh(key)
    assert (grid.x[0], grid.x[-1], grid.size) == (-key.inlet, key.outlet, key.nodes)
    assert np.all(grid.step > 0)
    middles = 0.5 * (grid.x[1:] + grid.x[:-1])
    for edge in (-1.0, 1.0):
        assert grid.step[np.argmin(np.abs(middles - edge))] < 0.4 * grid.step[np.argmin(np.abs(middles))]
    if key.outlet == key.inlet:
        assert_allclose(grid.x, -grid.x[::-1], atol=1e-6)


def test_levels():
    assert [key.nodes for key in levels(MeshKey(801), 100)] == [101, 201, 401, 801]
    assert [key.nodes for key in levels(MeshKey(51), 100)] == [51]
