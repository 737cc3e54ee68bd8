"""An independent ring: straight beams in the plane, with springs at their nodes."""

import numpy as np


def beam_stiffness(length, bending, axial, shear):
    """6 x 6 stiffness of a straight beam along x: displacements u, v and rotation of both ends. `shear` may be
    infinite."""
    phi = 12.0 * bending / (shear * length**2)
    a, b = axial / length, bending / (length**3 * (1.0 + phi))
    k = np.zeros((6, 6))
    k[np.ix_([0, 3], [0, 3])] = a * np.array([[1.0, -1.0], [-1.0, 1.0]])
    of_bending = b * np.array(
        [
            [12.0, 6.0 * length, -12.0, 6.0 * length],
            [6.0 * length, (4.0 + phi) * length**2, -6.0 * length, (2.0 - phi) * length**2],
            [-12.0, -6.0 * length, 12.0, -6.0 * length],
            [6.0 * length, (2.0 - phi) * length**2, -6.0 * length, (4.0 + phi) * length**2],
        ]
    )
    k[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = of_bending
    return k


class BeamRing:
    """A ring of `count` beams whose nodes lie on the centroid circle at even angles, the first at 0."""

    def __init__(self, bending, axial, radius, shear=np.inf, count=360, foundation=0.0):
        self.count, self.radius = count, radius
        self.angle = 2.0 * np.pi * np.arange(count) / count
        self.matrix = np.zeros((3 * count, 3 * count))
        length = 2.0 * radius * np.sin(np.pi / count)
        own = beam_stiffness(length, bending, axial, shear)
        for j in range(count):
            turned = self.angle[j] + np.pi / count + np.pi / 2.0
            c, s = np.cos(turned), np.sin(turned)
            one = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
            to = np.kron(np.eye(2), one)
            places = np.r_[3 * j : 3 * j + 3, 3 * ((j + 1) % count) : 3 * ((j + 1) % count) + 3]
            self.matrix[np.ix_(places, places)] += to.T @ own @ to
        for j in range(count):
            self.spring(j, foundation * 2.0 * np.pi * radius / count)
        # springs too weak to matter, which hold a free ring in place
        self.matrix += 1e-3 * np.eye(3 * count)

    def outward(self, node):
        """Vector that picks the outward displacement of a node."""
        pick = np.zeros(3 * self.count)
        pick[3 * node : 3 * node + 2] = np.cos(self.angle[node]), np.sin(self.angle[node])
        return pick

    def spring(self, node, stiffness):
        """A radial spring between a node and the ground."""
        pick = self.outward(node)[3 * node : 3 * node + 3]
        self.matrix[3 * node : 3 * node + 3, 3 * node : 3 * node + 3] += stiffness * np.outer(pick, pick)

    def deflections(self, loads):
        """Outward displacements of all nodes. `loads`: node -> (radial, tangential, moment)."""
        right = np.zeros(3 * self.count)
        for node, (radial, tangential, moment) in loads.items():
            c, s = np.cos(self.angle[node]), np.sin(self.angle[node])
            right[3 * node : 3 * node + 3] += radial * c - tangential * s, radial * s + tangential * c, moment
        found = np.linalg.solve(self.matrix, right).reshape(self.count, 3)
        return found[:, 0] * np.cos(self.angle) + found[:, 1] * np.sin(self.angle)
