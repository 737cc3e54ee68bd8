"""Bending line of a shaft between its nodes, and internal forces and moments in its cross sections."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...shafts.shaft import Shaft
from ...shafts.solution import ShaftSolution

PLANES = (("Y", 1, 3), ("Z", 2, 4))
"""Planes through the axis: name of the transverse direction, indices of displacement and tilt in the plane."""
POINTS = 40
"""Number of intervals into which the bending line between two nodes is divided."""


class BendingLine(NamedTuple):
    """Displacements of the shaft axis, m, over the position, m; `across`: along Y and Z, shape (2, point)."""

    position: np.ndarray
    axial: np.ndarray
    across: np.ndarray

    @property
    def size(self) -> np.ndarray:
        """Magnitude of the transverse displacement, m."""
        return np.hypot(*self.across)

    def largest(self) -> tuple[float, float]:
        """Largest transverse displacement, m, and its position, m."""
        place = int(np.argmax(self.size))
        return float(self.size[place]), float(self.position[place])


def bending_line(solution: ShaftSolution) -> BendingLine:
    """Bending line by the shape functions of the model's beam with shear, from the displacements of the nodes.

    The additional deflection by the shaft's own weight between two nodes is left out.
    """
    nodes = solution.shaft
    x, u = np.asarray(nodes.position, dtype=float), np.asarray(nodes.displacement, dtype=float)
    if x.size < 2:
        return BendingLine(x, u[:, 0], u[:, 1:3].T)
    shear = _shear_numbers(solution.operation, x)
    xi = np.linspace(0.0, 1.0, POINTS + 1)
    places, axial, across = [], [], []
    for i, length in enumerate(np.diff(x)):
        if length <= 0.0:
            continue
        left, right = u[i], u[i + 1]
        places.append(x[i] + xi * length)
        axial.append(left[0] + xi * (right[0] - left[0]))
        # slopes of the cross sections are the tilts with opposite sign
        across.append([_beam(left[w], -left[t], right[w], -right[t], length, shear[i], xi) for _, w, t in PLANES])
    return BendingLine(np.concatenate(places), np.concatenate(axial), np.concatenate(across, axis=1))


def _beam(w1: float, s1: float, w2: float, s2: float, length: float, shear: float, xi: np.ndarray) -> np.ndarray:
    """Deflection of a beam with shear between two nodes, from deflection and cross-section slope at both nodes."""
    scale = 1.0 / (1.0 + shear)
    a = scale * (1.0 - 3.0 * xi**2 + 2.0 * xi**3 + shear * (1.0 - xi))
    b = scale * length * (xi - 2.0 * xi**2 + xi**3 + 0.5 * shear * (xi - xi**2))
    c = scale * (3.0 * xi**2 - 2.0 * xi**3 + shear * xi)
    d = scale * length * (xi**3 - xi**2 + 0.5 * shear * (xi**2 - xi))
    return a * w1 + b * s1 + c * w2 + d * s2


def _shear_numbers(shaft: Shaft, x: np.ndarray) -> np.ndarray:
    r"""$\varphi = 12EI/(G\kappa AL^2)$ between neighbouring nodes; 0 for a rigid shaft."""
    sections = shaft.sections
    if not sections:
        return np.zeros(x.size - 1)
    ends = np.cumsum([float(section.length) for section in sections])
    numbers = []
    for left, right in pairwise(x):
        own = sections[min(int(np.searchsorted(ends, 0.5 * (left + right))), len(sections) - 1)]
        poisson = float((shaft.material if own.material is None else own.material).poisson_ratio)
        outer, inner = float(own.outer_diameter), float(own.inner_diameter)
        radius2 = (outer**2 + inner**2) / 16.0
        numbers.append(
            24.0 * (1.0 + poisson) * radius2 / (cowper(poisson, inner / outer) * max(right - left, 1e-12) ** 2)
        )
    return np.array(numbers)


def cowper(poisson: float, ratio: float) -> float:
    """Cowper's shear factor of a hollow cylinder. **Arguments:** `ratio`: inner over outer diameter."""
    m2 = ratio**2
    top = 6.0 * (1.0 + poisson) * (1.0 + m2) ** 2
    return top / ((7.0 + 6.0 * poisson) * (1.0 + m2) ** 2 + (20.0 + 12.0 * poisson) * m2)


class CutLoads(NamedTuple):
    """Internal forces and moments: loads of the shaft to the left of a cross section on the shaft to its right.

    A position with an external load has two points, one on each side of it.

    - `position`: of the cross section, m.
    - `axial`: axial force, N, positive in tension.
    - `shear`: along Y and Z, shape (2, point), N.
    - `moment`: in the planes X-Y and X-Z, shape (2, point), N m; positive where the bending line is concave towards +Y
      and +Z.
    """

    position: np.ndarray
    axial: np.ndarray
    shear: np.ndarray
    moment: np.ndarray


def cut_loads(solution: ShaftSolution) -> CutLoads:
    """Internal forces and moments by statics, from the external loads, the weight and the forces of the bearings."""
    nodes = solution.shaft
    at = np.concatenate(
        [np.asarray(nodes.position), [float(bearing.position) for bearing in solution.bearings.values()]]
    )
    forces = [np.asarray(bearing.on_shaft) for bearing in solution.bearings.values()]
    loads = np.concatenate([np.asarray(nodes.load), np.reshape(forces, (-1, 5))])
    ends, weight = _weights(solution.operation)
    marks = np.unique(np.concatenate([at, ends]))
    x = np.concatenate([np.linspace(a, b, POINTS + 1) for a, b in pairwise(marks)])
    # the points of an interval lie to the right of the load at its left end, and to the left of that at its right end
    interval = np.repeat(np.arange(marks.size - 1), POINTS + 1)
    acts = at[:, None] <= marks[interval][None, :]
    arm = np.where(acts, x[None, :] - at[:, None], 0.0)
    shear = loads[:, 1:3].T @ acts
    moment = loads[:, 3:5].T @ acts + loads[:, 1:3].T @ arm
    for left, right, q in zip(ends[:-1], ends[1:], weight, strict=True):
        covered = np.clip(x - left, 0.0, right - left)
        shear += q[:, None] * covered
        moment += q[:, None] * covered * (x - left - 0.5 * covered)
    return CutLoads(x, -(loads[:, 0] @ acts), shear, moment)


def _weights(shaft: Shaft) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the sections, m, and their weight per unit length along Y and Z, N/m, shape (section, 2)."""
    ends, weights = [0.0] if shaft.sections else [], []
    for section in shaft.sections:
        ends.append(ends[-1] + float(section.length))
        density = float((shaft.material if section.material is None else section.material).density)
        area = 0.25 * np.pi * (float(section.outer_diameter) ** 2 - float(section.inner_diameter) ** 2)
        pull = 0.0 if shaft.gravity is None else density * area * float(shaft.gravity.acceleration)
        azimuth = 0.0 if shaft.gravity is None else float(shaft.gravity.azimuth)
        weights.append([pull * np.cos(azimuth), pull * np.sin(azimuth)])
    return np.array(ends), np.array(weights).reshape(-1, 2)
