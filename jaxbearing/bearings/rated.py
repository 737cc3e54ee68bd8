"""Facts that a bearing states for its life: sizes of its raceway contacts, and what they carry."""

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
    - `n_elements`, `diameter`, `pitch_diameter`: of the rolling elements; m.
    - `contact_angle`: nominal one, for which ratings are made, rad.
    - `rings`, `elements`: their materials; `inner_ring`: where it is of another material than `rings`.
    - `inner`, `outer`: loads on the raceways, N, one an element; of line contacts in laminae one a lamina as well.
    - `second`: loads on the second flanks of the inner and the outer raceway, N, one an element, of rings with two
      groove arcs; `None` of rings with one.
    - `conformities`: of point contacts, groove radius over ball diameter of the inner and the outer race.
    - `length`: of line contacts, along which a roller carries, m.
    - `profiled`: whether rollers have a profile, which spreads the load near their ends.
    - `radial_load`, `axial_load`: sizes of the loads on the bearing, N, where the catalogue's formulas for equivalent
      loads hold; a `None` radial load means that they do not. A `None` axial load is that of a bearing with purely
      radial formulas.
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
    """Sizes of the radial and of the axial load on the inner ring, N, for the formulas of catalogues.

    These formulas have no moment: where one is given that is not 0 the sizes are NaN. Both are `None` for a ring that
    is held without a known force.

    **Arguments:** `force`: `Solution.force`; it is the load where a displacement is given instead of one.
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
    """True if a tilt is given, at which rollers do not carry evenly along their length, as catalogues assume."""
    return any(operation.held_at(name) is not None for name in TILTS)


_NO_MOMENT = 1e-100
"""Size of two moments of 0, N m, of which the safe norm makes a little more."""
