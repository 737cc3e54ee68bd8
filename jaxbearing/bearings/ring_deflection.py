"""Deformed shapes of flexible rings, as results of a bearing."""

import equinox as eqx
from jaxtyping import Array, Float

from .._scene import label


class AbstractRingDeflection(eqx.Module):
    """Deformed shape of a flexible ring: outward deflection of its centroid circle."""

    azimuth: eqx.AbstractVar[Float[Array, " place"]]
    deflection: eqx.AbstractVar[Float[Array, " place"]]
    cosines: eqx.AbstractVar[Float[Array, " order"]]
    sines: eqx.AbstractVar[Float[Array, " order"]]
    radius: eqx.AbstractVar[Float[Array, ""]]
    order: eqx.AbstractVar[Float[Array, " order"]]


class RingDeflection(AbstractRingDeflection):
    """Deformed shape of a flexible outer ring: outward deflection of its centroid circle."""

    azimuth: Float[Array, " ring_place"] = eqx.field(metadata=label("rad", "azimuth from the load line"))
    deflection: Float[Array, " ring_place"] = eqx.field(metadata=label("m", "outward deflection of the outer ring"))
    cosines: Float[Array, " ring_order"] = eqx.field(metadata=label("m", "amplitude of the cosine of each order"))
    sines: Float[Array, " ring_order"] = eqx.field(metadata=label("m", "amplitude of the sine of each order"))
    radius: Float[Array, ""] = eqx.field(metadata=label("m", "radius of the centroid circle of the outer ring"))
    order: Float[Array, " ring_order"] = eqx.field(metadata=label("1", "order of the harmonic of the outer ring"))
    support_forces: Float[Array, " support"] | None = eqx.field(
        default=None, metadata=label("N", "forces of the supports on the outer ring, inwards")
    )


class InnerRingDeflection(AbstractRingDeflection):
    """Deformed shape of a flexible inner ring: outward deflection of its centroid circle relative to its seat on the
    shaft. The order 1 is a displacement of the ring relative to this seat."""

    azimuth: Float[Array, " inner_ring_place"] = eqx.field(metadata=label("rad", "azimuth from the load line"))
    deflection: Float[Array, " inner_ring_place"] = eqx.field(
        metadata=label("m", "outward deflection of the inner ring against the shaft")
    )
    cosines: Float[Array, " inner_ring_order"] = eqx.field(metadata=label("m", "amplitude of the cosine of each order"))
    sines: Float[Array, " inner_ring_order"] = eqx.field(metadata=label("m", "amplitude of the sine of each order"))
    radius: Float[Array, ""] = eqx.field(metadata=label("m", "radius of the centroid circle of the inner ring"))
    order: Float[Array, " inner_ring_order"] = eqx.field(metadata=label("1", "order of the harmonic of the inner ring"))
