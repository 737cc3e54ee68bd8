"""Rollers cut into laminae along their length: the same part for cylindrical and tapered rollers."""

import equinox as eqx

from .._types import Scalar
from ..contacts import AbstractTiltedLine, SlicedLine
from ..contacts.profile import AbstractProfile
from ..numerics.structure import count
from .rating import LAMINAE


class RollerProfile(eqx.Module):
    """Laminae of the rollers, with or without a profile; without this part contacts are straight and integrated in
    closed form.

    **Arguments:**
    - `shape`: `None`: straight.
    - `n_laminae`: number of laminae of a roller; structure.
    """

    shape: AbstractProfile | None = None
    n_laminae: int = count("profile.n_laminae", LAMINAE)

    def __check_init__(self):
        if self.n_laminae < 1:
            raise ValueError(f"profile.n_laminae must be >= 1, got {self.n_laminae}")

    def line(self, stiffness: Scalar, length: Scalar) -> AbstractTiltedLine:
        """The contact of such a roller over its length. **Arguments:** K, N/m^(19/9); m."""
        return SlicedLine(stiffness, length, self.shape, self.n_laminae)
