r"""Natural frequencies of bending of a shaft on the tangent stiffness of its bearings.

The elements are those of the ROSS rotor (`ross`): Timoshenko beams with Cowper's shear factor, consistent mass and
rotary inertia (Friswell et al., Dynamics of Rotating Machines, 2010). Without damping and gyroscopic effect, these are
the frequencies of a shaft at rest on bearings with the stiffness at a speed of the table. The bearings act across the
axis and against tilting; the shaft is held axially. Rotors of ROSS have no tilting stiffness of bearings: without it
the frequencies are those of ROSS.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from ...shafts.forces import Mass
from ...shafts.scene import ShaftSystem
from .bending import cowper
from .ross import rotor_nodes, section_between

if TYPE_CHECKING:
    from .stiffness import ShaftStiffness
else:
    ShaftStiffness = Any

_FREEDOMS = (1, 3, 2, 4)
"""Indices of the degrees of freedom of a node in a stiffness matrix: radial, tilt, lateral, lateral tilt."""
_SIGNS = np.array([1.0, -1.0, 1.0, -1.0])
"""Signs of a node's degrees of freedom: a slope is the tilt with opposite sign (`bearings.ring.shift_matrix`)."""


def natural_frequencies(table: ShaftStiffness, scene: ShaftSystem, place: int = 0, tilting: bool = True) -> np.ndarray:
    """Natural frequencies, rad/s, in ascending order.

    **Arguments:** `place`: index of the speed in the table whose stiffness is used; `tilting`: False leaves out the
    tilting stiffness of the bearings and its coupling with the other degrees of freedom, as ROSS does.

    **Raises:** `ValueError` as `ross.require_rotor`.
    """
    nodes = rotor_nodes(scene)
    size = 4 * nodes.size
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    for number in range(nodes.size - 1):
        own = _element(scene, nodes[number], nodes[number + 1])
        for plane in (0, 1):
            # displacement and slope of both ends in one plane
            at = [4 * (number + end) + 2 * plane + part for end in (0, 1) for part in (0, 1)]
            stiffness[np.ix_(at, at)] += own[0]
            mass[np.ix_(at, at)] += own[1]
    for name, values in table.bearings.items():
        node = int(np.argmin(np.abs(nodes - table.position[name])))
        own = _SIGNS[:, None] * values[place][np.ix_(_FREEDOMS, _FREEDOMS)] * _SIGNS
        if not tilting:
            own[[1, 3]] = own[:, [1, 3]] = 0.0
        at = np.arange(4 * node, 4 * node + 4)
        stiffness[np.ix_(at, at)] += own
    for force in scene.forces:
        if isinstance(force, Mass):
            node = int(np.argmin(np.abs(nodes - float(force.position))))
            for freedom in (4 * node, 4 * node + 2):
                mass[freedom, freedom] += float(force.mass)
    squares = np.linalg.eigvals(np.linalg.solve(mass, stiffness))
    return np.sort(np.sqrt(np.maximum(squares.real, 0.0)))


def _element(scene: ShaftSystem, left: float, right: float) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and mass matrix of a beam in one plane, for displacement and slope at its left, then its right end."""
    section, material = section_between(scene, left, right)
    length = right - left
    young, poisson, density = (
        float(getattr(material, name)) for name in ("youngs_modulus", "poisson_ratio", "density")
    )
    outer, inner = float(section.outer_diameter), float(section.inner_diameter)
    area = 0.25 * np.pi * (outer**2 - inner**2)
    inertia = np.pi * (outer**4 - inner**4) / 64.0
    shear_modulus = young / (2.0 * (1.0 + poisson))
    phi = 12.0 * young * inertia / (shear_modulus * cowper(poisson, inner / outer) * area * length**2)
    bend = young * inertia / (length**3 * (1.0 + phi))
    a, b, c = 6.0 * length, (4.0 + phi) * length**2, (2.0 - phi) * length**2
    stiffness = bend * np.array([[12.0, a, -12.0, a], [a, b, -a, c], [-12.0, -a, 12.0, -a], [a, c, -a, b]])
    return stiffness, _mass(density * area * length, density * inertia / length, length, phi)


def _mass(mass: float, rotary: float, length: float, phi: float) -> np.ndarray:
    m1, m3 = 312.0 + 588.0 * phi + 280.0 * phi**2, 108.0 + 252.0 * phi + 140.0 * phi**2
    m2, m4 = (44.0 + 77.0 * phi + 35.0 * phi**2) * length, -(26.0 + 63.0 * phi + 35.0 * phi**2) * length
    m5, m6 = (8.0 + 14.0 * phi + 7.0 * phi**2) * length**2, -(6.0 + 14.0 * phi + 7.0 * phi**2) * length**2
    moved = np.array([[m1, m2, m3, m4], [m2, m5, -m4, m6], [m3, -m4, m1, -m2], [m4, m6, -m2, m5]])
    m7, m8 = 36.0, (3.0 - 15.0 * phi) * length
    m9, m10 = (4.0 + 5.0 * phi + 10.0 * phi**2) * length**2, (-1.0 - 5.0 * phi + 5.0 * phi**2) * length**2
    turned = np.array([[m7, m8, -m7, m8], [m8, m9, -m8, m10], [-m7, -m8, m7, -m8], [m8, m10, -m8, m9]])
    return mass / (840.0 * (1.0 + phi) ** 2) * moved + rotary / (30.0 * (1.0 + phi) ** 2) * turned
