"""Facts that a bearing states for its life: sizes of its raceway contacts, and what they carry."""

from typing import NamedTuple

from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import Material


class RatedContacts(NamedTuple):
    """Sizes and loads of the raceway contacts of one row.

    **Arguments:**
    - `n_elements`, `diameter`, `pitch_diameter`: of the rolling elements; m.
    - `contact_angle`: nominal one, for which ratings are made, rad.
    - `rings`, `elements`: their materials.
    - `inner`, `outer`: loads on the raceways, N, one an element; of line contacts in laminae one a lamina as well.
    - `conformities`: of point contacts, groove radius over ball diameter of the inner and the outer race.
    - `length`: of line contacts, along which a roller carries, m.
    - `profiled`: whether rollers have a profile, which spreads the load near their ends.
    - `radial_load`, `axial_load`: on the bearing, N, where the catalogue's formula for the equivalent load holds; a
      `None` radial load means that it does not.
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
    length: Scalar | None = None
    profiled: bool = False
    radial_load: Array | None = None
    axial_load: Array | None = None
