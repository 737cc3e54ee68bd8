"""Result of a bearing whose outer ring bends: its deformed shape."""

import equinox as eqx
from jaxtyping import Array, Float

from .._scene import label


class RingDeflection(eqx.Module):
    """Deformed shape of a flexible outer ring: deflection of its centroid circle, outwards."""

    azimuth: Float[Array, " ring_place"] = eqx.field(metadata=label("rad", "azimuth from the load line"))
    deflection: Float[Array, " ring_place"] = eqx.field(metadata=label("m", "outward deflection of the outer ring"))
    cosines: Float[Array, " ring_order"] = eqx.field(metadata=label("m", "amplitude of the cosine of each order"))
    sines: Float[Array, " ring_order"] = eqx.field(metadata=label("m", "amplitude of the sine of each order"))
    radius: Float[Array, ""] = eqx.field(metadata=label("m", "radius of the centroid circle of the outer ring"))
    order: Float[Array, " ring_order"] = eqx.field(metadata=label("1", "order of the harmonic of the outer ring"))
    support_forces: Float[Array, " support"] | None = eqx.field(
        default=None, metadata=label("N", "forces of the supports on the outer ring, inwards")
    )
