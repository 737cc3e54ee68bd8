"""Sizes and loads of the raceway contacts, as inputs of the life calculation."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import Material
from ..numerics.safe import safe_norm
from .operation import AbstractOperation
from .solution import RING_FREEDOMS, TILTS


class RatedContacts(NamedTuple):
    """Sizes and loads of the raceway contacts of one row.

    **Arguments:**
    - `n_elements`, `diameter`, `pitch_diameter`: number and diameter of the rolling elements, and pitch diameter, m.
    - `contact_angle`: nominal contact angle, for which ratings are computed, rad.
    - `rings`, `elements`: materials; `inner_ring`: material of the inner ring if it differs from `rings`.
    - `inner`, `outer`: loads on the raceways, N, one per element; for line contacts in laminae one per element and
      lamina.
    - `second`: for rings with two groove arcs, loads on the second flanks of the inner and the outer raceway, N, one
      per element; `None` for rings with one arc.
    - `conformities`: for point contacts, groove radius over ball diameter of the inner and the outer race.
    - `length`: for line contacts, loaded length of a roller, m.
    - `profiled`: True if the rollers have a profile, which relieves their ends.
    - `radial_load`, `axial_load`: magnitudes of the loads on the bearing, N, for the formulas of catalogues for
      equivalent loads. A radial load of `None` means that these formulas do not apply, an axial load of `None` that
      they contain the radial load only.
    """

    n_elements: int
    diameter: Scalar
    pitch_diameter: Scalar
    contact_angle: Scalar
    rings: Material
    elements: Material
    inner: Float[Array, "element ..."]
    outer: Float[Array, "element ..."]
    conformities: tuple[Scalar, Scalar] | None = None
    second: tuple[Array | None, Array | None] = (None, None)
    length: Scalar | None = None
    profiled: bool = False
    radial_load: Array | None = None
    axial_load: Array | None = None
    inner_ring: Material | None = None


def sizes_of_loads(
    operation: AbstractOperation, force: Float[Array, " freedom"] | None = None
) -> tuple[Array, Array] | tuple[None, None]:
    """Magnitudes of the radial and of the axial load on the inner ring, N, for the formulas of catalogues.

    These formulas do not cover moments: if a moment other than 0 is given, the magnitudes are NaN. Both are `None` if a
    displacement is prescribed and its force is not known.

    **Arguments:** `force`: `Solution.force`, used for prescribed displacements.
    """
    held = {name for name in RING_FREEDOMS[:3] if operation.held_at(name) is not None}
    if held and force is None:
        return None, None
    radial, axial = operation.radial_size, operation.load("axial")
    if force is not None and held & {"radial", "lateral"}:
        radial = safe_norm(force[1], force[2])
    if force is not None and "axial" in held:
        axial = force[0]
    axial = jnp.abs(jnp.asarray(0.0 if axial is None else axial))
    if any(operation.load(name) is not None for name in TILTS):
        alone = operation.moment_size <= _NO_MOMENT
        radial, axial = jnp.where(alone, radial, jnp.nan), jnp.where(alone, axial, jnp.nan)
    return radial, axial


def is_misaligned(operation: AbstractOperation) -> bool:
    """True if a tilt is prescribed. Rollers are then loaded unevenly, whereas catalogues assume a uniform load."""
    return any(operation.held_at(name) is not None for name in TILTS)


_NO_MOMENT = 1e-100
"""Magnitude up to which a moment counts as 0, N m: the safe norm of two moments of 0 is slightly larger than 0."""
