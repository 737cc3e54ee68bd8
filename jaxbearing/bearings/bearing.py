"""Base of the bearings as scenes: which freedoms of the inner ring are unknown."""

from typing import Any, ClassVar

import equinox as eqx

from .._scene import AbstractScene
from .operation import AbstractOperation
from .solution import RING_FREEDOMS, TILTS


class AbstractBearing(AbstractScene):
    """Base of all bearings, whose inner ring has the freedoms of `solution.RING_FREEDOMS`, or some of them."""

    modelled_freedoms: ClassVar[tuple[str, ...]] = RING_FREEDOMS
    """Freedoms of the inner ring that its rolling elements feel."""

    geometry: eqx.AbstractVar[Any]
    operation: eqx.AbstractVar[Any]

    @property
    def skewed(self) -> bool:
        """True if the ring may move across the load line: by loads, displacements or the places of the elements."""
        operation: AbstractOperation = self.operation
        return operation.skewed or self.geometry.first_element_angle is not None

    @property
    def unknown_freedoms(self) -> tuple[str, ...]:
        """Freedoms of the inner ring that are unknowns of a solve, under given loads.

        Those that only symmetry keeps at 0 are not among them: all but the axial one where all rolling elements are
        alike, the lateral one where the load line is a line of symmetry.
        """
        operation: AbstractOperation = self.operation
        forces = ["axial"]
        if not operation.symmetric:
            forces += ["radial", "lateral"] if self.skewed else ["radial"]
        free = [name for name in forces if operation.held_at(name) is None]
        free += [name for name in TILTS if operation.load(name) is not None]
        return tuple(name for name in free if name in self.modelled_freedoms)

    @property
    def shown_freedoms(self) -> tuple[str, ...]:
        """Freedoms whose displacement is a result or was given."""
        operation: AbstractOperation = self.operation
        free = self.unknown_freedoms
        return tuple(name for name in RING_FREEDOMS if name in free or operation.held_at(name) is not None)
