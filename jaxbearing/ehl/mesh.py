"""The mesh of a line contact and its elastic kernel: numpy, static, built once for each kind of mesh."""

import functools
from typing import NamedTuple

import numpy as np

INLET = 4.0
"""Length of the inlet from the centre, half widths; lowers the central film of `satellite_contact_1` by 0.1 %."""
OUTLET = 1.5
"""Length of the outlet from the centre in steady running, half widths."""
STOP_OUTLET = 2.5
"""The same for transient runs: after a stop the pressure becomes symmetric, and the outlet must not cut it off."""
FINE = 2_000
"""Number of intervals per half width in the cumulative integral of the node density."""


class Mesh(NamedTuple):
    """Nodes X_1 < ... < X_n, in half widths, and constants that follow from them. `mesh` keeps one for each key."""

    x: np.ndarray
    """Nodes, shape (n,)."""
    step: np.ndarray
    """Distances between neighbours, shape (n - 1,)."""
    cell: np.ndarray
    """Widths of the cells of the inner nodes, shape (n - 2,)."""
    kernel: np.ndarray
    """Deflection at each node by a unit of pressure at each inner node, shape (n, n - 2): -1/pi times the integral of
    the hat function with ln|X - X'|."""
    weight: np.ndarray
    """Integral of the hat function of each inner node, shape (n - 2,)."""

    @property
    def size(self) -> int:
        return self.x.size


class MeshKey(NamedTuple):
    """Static description of a mesh.

    `nodes`: n; `inlet`, `outlet`: length of the domain to both sides, half widths; `stop`: graded for a transient run
    (wider bumps, the left one at the Hertz edge), or for steady running.
    """

    nodes: int
    inlet: float = INLET
    outlet: float = OUTLET
    stop: bool = False


@functools.lru_cache(maxsize=64)
def mesh(key: MeshKey) -> Mesh:
    """The graded mesh of a key."""
    return mesh_of(graded_nodes(key))


def mesh_of(x: np.ndarray) -> Mesh:
    """The mesh on the given nodes, at least four, in increasing order."""
    step = np.diff(x)
    return Mesh(x, step, 0.5 * (x[2:] - x[:-2]), -hat_kernel(x) / np.pi, 0.5 * (step[1:] + step[:-1]))


def graded_nodes(key: MeshKey) -> np.ndarray:
    r"""Nodes at equal increments of the cumulative integral of the density

    $w(X) = \frac{1 + 6e^{-((X - X_l)/s)^2} + 6e^{-((X - 1)/s)^2}}{1 + \max(-1.2 - X, 0)}$,

    $X_l = -1.05$, s = 0.15 for steady running; $X_l = -1$, s = 0.2 for transient runs. The divisor is mirrored where
    the outlet is long (the inlet after a reversal), so that it is coarsened like the inlet.
    """
    left, width = (-1.0, 0.2) if key.stop else (-1.05, 0.15)
    fine = np.linspace(-key.inlet, key.outlet, int(FINE * (key.inlet + key.outlet)) + 1)
    bumps = 6.0 * np.exp(-(((fine - left) / width) ** 2)) + 6.0 * np.exp(-(((fine - 1.0) / width) ** 2))
    far = np.maximum(-1.2 - fine, 0.0)
    if key.outlet > STOP_OUTLET:
        far = np.maximum(far, np.abs(fine) - 1.2)
    density = (1.0 + bumps) / (1.0 + far)
    total = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    x = np.interp(np.linspace(0.0, total[-1], key.nodes), total, fine)
    x[0], x[-1] = -key.inlet, key.outlet
    return x


def hat_kernel(x: np.ndarray) -> np.ndarray:
    r"""$K_{ij} = \int \phi_j(X')\ln|X_i - X'|\,dX'$ of the hat functions of the inner nodes, exact; shape (n, n - 2).

    $K_{ij} = [G(s_{j-1}) - G(s_j)]/h_{j-1} - [G(s_j) - G(s_{j+1})]/h_j$ with $s_k = X_i - X_k$ and
    $G(s) = \frac12 s^2\ln|s| - \frac34 s^2$, G(0) = 0.
    """
    step = np.diff(x)
    s = x[:, None] - x[None, :]
    square = s * s
    g = 0.5 * square * np.log(np.where(s == 0.0, 1.0, np.abs(s))) - 0.75 * square
    slope = (g[:, :-1] - g[:, 1:]) / step
    return slope[:, :-1] - slope[:, 1:]


def levels(key: MeshKey, coarsest: int) -> tuple[MeshKey, ...]:
    """Meshes of a nested start, coarsest first: the intervals are halved while there are at least `coarsest` nodes."""
    keys = [key]
    while (keys[0].nodes - 1) // 2 + 1 >= coarsest:
        keys.insert(0, key._replace(nodes=(keys[0].nodes - 1) // 2 + 1))
    return tuple(keys)
