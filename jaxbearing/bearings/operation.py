"""Operating point of a bearing: speeds, oil, and a load or a displacement for each degree of freedom of the inner
ring."""

import functools
import operator
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

from .._scene import label, number, optional_number
from .._types import Scalar
from ..numerics.checks import Checked, demand, numbers_or_none
from ..numerics.refusals import refusals_of, refuse_all
from ..numerics.safe import safe_norm


class HeldDisplacement(Checked):
    """Prescribed displacements of the inner ring, m. A load acts on each degree of freedom that is not prescribed.

    They have the same zero as the displacements in `ring` of the solution. `radial` is along azimuth 0, `lateral` along
    azimuth 90 degrees.
    """

    part: ClassVar[str] = "operation.displacement"

    axial: Scalar | None = optional_number(metadata=label("m", "given axial displacement"))
    radial: Scalar | None = optional_number(metadata=label("m", "given radial displacement"))
    lateral: Scalar | None = optional_number(metadata=label("m", "given lateral displacement"))


LOAD_FIELDS = {
    "axial": "axial_load",
    "radial": "radial_load",
    "lateral": "radial_load_lateral",
    "tilt": "moment",
    "tilt_lateral": "moment_lateral",
}
"""Degree of freedom of the inner ring -> field with its load."""
HELD_FIELDS = {
    "axial": "displacement.axial",
    "radial": "displacement.radial",
    "lateral": "displacement.lateral",
    "tilt": "misalignment",
    "tilt_lateral": "misalignment_lateral",
}
"""Degree of freedom of the inner ring -> field with its prescribed displacement."""


def _as_displacement(value: object) -> HeldDisplacement | None:
    """Converts a mapping to a `HeldDisplacement`, and returns a `HeldDisplacement` or `None` unchanged.

    **Raises:** `ValueError` for unknown names and for any other value."""
    if isinstance(value, Mapping):
        unknown = set(value) - {"axial", "radial", "lateral"}
        if unknown:
            raise ValueError(
                f"operation.displacement has axial, radial and lateral, got {', '.join(sorted(map(str, unknown)))}"
            )
        return HeldDisplacement(**value)
    if not isinstance(value, HeldDisplacement | None):
        raise ValueError(f"operation.displacement must be a HeldDisplacement or a mapping, got {value!r}")
    return value


SETS_FREE = {
    "axial": "which sets the axial displacement free",
    "radial": "which sets the radial displacement free",
    "lateral": "which sets the lateral displacement free",
    "tilt": "which sets the tilt free",
    "tilt_lateral": "which sets the tilt about the load line free",
}
"""Degree of freedom of the inner ring -> effect of a load on it, in words."""


class AbstractOperation(Checked):
    """Operating point of a bearing: the part of a scene that a sweep varies.

    Each of the five degrees of freedom of the inner ring has a load or a prescribed displacement, not both. A force
    that is not given is 0, and the ring moves until it is in equilibrium. A tilt without a moment is held at its
    misalignment, by default 0.

    **Arguments:**
    - `inner_speed`, `outer_speed`: absolute speeds of the rings, rad/s, counter-clockwise positive.
    - `axial_load`, `radial_load`, `radial_load_lateral`: forces on the inner ring along the axis, along azimuth 0 and
      along azimuth 90 degrees, N.
    - `moment`, `moment_lateral`: moments on the inner ring, N m. A given moment, also 0, frees the tilt. A positive
      moment moves the ring at azimuth 0, or at azimuth 90 degrees, in the positive axial direction.
    - `misalignment`, `misalignment_lateral`: prescribed tilts of the inner ring, rad, with the signs of the moments.
    - `displacement`: prescribed displacements of the inner ring, instead of loads.
    - `oil_temperature`: inlet temperature of the oil, K; it holds for all interactions unless a thermal network
      computes their temperatures.
    - `oil_flow`: volume flow of oil that is supplied to the bearing, m^3/s.
    """

    part: ClassVar[str] = "operation"

    inner_speed: Scalar = number(metadata=label("rad/s", "inner ring speed"))
    axial_load: Scalar | None = optional_number(kw_only=True, metadata=label("N", "axial load"))
    radial_load: Scalar | None = optional_number(kw_only=True, metadata=label("N", "radial load"))
    radial_load_lateral: Scalar | None = optional_number(kw_only=True, metadata=label("N", "lateral load"))
    moment: Scalar | None = optional_number(kw_only=True, metadata=label("N m", "moment"))
    moment_lateral: Scalar | None = optional_number(kw_only=True, metadata=label("N m", "moment about the load line"))
    misalignment: Scalar | None = optional_number(kw_only=True, metadata=label("rad", "misalignment"))
    misalignment_lateral: Scalar | None = optional_number(
        kw_only=True, metadata=label("rad", "misalignment about the load line")
    )
    displacement: HeldDisplacement | None = eqx.field(
        kw_only=True, default=None, converter=_as_displacement, metadata={"part": "displacement"}
    )
    oil_temperature: Scalar = number(373.15, bound="> 0", kw_only=True, metadata=label("K", "oil temperature"))
    oil_flow: Scalar = number(0.0, bound=">= 0", kw_only=True, metadata=label("m^3/s", "oil flow"))
    outer_speed: Scalar = number(0.0, kw_only=True, metadata=label("rad/s", "outer ring speed"))

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._conflicts())

    def _conflicts(self) -> Iterator[str | ValueError]:
        for freedom, load in LOAD_FIELDS.items():
            held = HELD_FIELDS[freedom]
            if self._field(load) is not None and self._field(held) is not None:
                yield f"operation.{held}: expected none beside operation.{load}, {SETS_FREE[freedom]}"

    def _field(self, path: str) -> Scalar | None:
        part: Any = self
        for name in path.split("."):
            part = None if part is None else getattr(part, name)
        return part

    def load(self, freedom: str) -> Scalar | None:
        """Load on a degree of freedom of the inner ring, N or N m; `None` if none is given."""
        return self._field(LOAD_FIELDS[freedom])

    def held_at(self, freedom: str) -> Scalar | None:
        """Prescribed displacement of a degree of freedom of the inner ring, m or rad; `None` if none is given."""
        return self._field(HELD_FIELDS[freedom])

    def _given(self, *freedoms: str) -> bool:
        return any(self.load(name) is not None or self.held_at(name) is not None for name in freedoms)

    @property
    def symmetric(self) -> bool:
        """True if all rolling elements are loaded alike: the ring moves only along its axis."""
        return not self._given("radial", "lateral", "tilt", "tilt_lateral")

    @property
    def tilts(self) -> bool:
        """True if the inner ring can tilt."""
        return self._given("tilt", "tilt_lateral")

    @property
    def skewed(self) -> bool:
        """True if a load or displacement acts across the load line, which is then no line of symmetry."""
        return self._given("lateral", "tilt_lateral")

    @property
    def displaced(self) -> bool:
        """True if a displacement is prescribed, so that its load is a result."""
        return any(self.held_at(name) is not None for name in ("axial", "radial", "lateral"))

    @property
    def radial_size(self) -> Array:
        """Magnitude of the given load perpendicular to the axis, N; 0 if none is given."""
        return self._size("radial", "lateral")

    @property
    def moment_size(self) -> Array:
        """Magnitude of the given moment about an axis perpendicular to that of the bearing, N m; 0 if none is given."""
        return self._size("tilt", "tilt_lateral")

    def _size(self, *freedoms: str) -> Array:
        loads = [jnp.asarray(load) for load in map(self.load, freedoms) if load is not None]
        return safe_norm(loads[0], loads[1]) if len(loads) == 2 else jnp.abs(loads[0] if loads else jnp.zeros(()))

    def check_rings_turn(self) -> None:
        """Checks that the rings turn relative to each other, as far as the speeds are known.

        **Raises:** `ValueError` if they do not, so that no film can form."""
        speeds = numbers_or_none(self.inner_speed, self.outer_speed)
        if speeds is not None:
            demand(
                "operation.inner_speed of a lubricated bearing must differ from operation.outer_speed",
                abs(speeds[0] - speeds[1]) > 0,
                lambda: (
                    f"operation.inner_speed: it is {float(speeds[0]):.6g} rad/s, the same as operation.outer_speed; a "
                    "lubricated bearing needs rings that turn against each other; leave out [contact] for a dry one"
                ),
            )


class Operation(AbstractOperation):
    """Operating point of a cylindrical roller bearing: the part of a scene that a sweep varies.

    It needs a radial load, along either azimuth, or a displacement of the ring perpendicular to the axis. An
    axial load or displacement needs flanges (`geometry.flange_stiffness`).

    **Arguments:** those of `AbstractOperation`; `radial_load` must be > 0.
    """

    radial_load: Scalar | None = optional_number(bound="> 0", kw_only=True, metadata=label("N", "radial load"))

    def _conflicts(self) -> Iterator[str | ValueError]:
        yield from super()._conflicts()
        if not self._given("radial", "lateral"):
            yield (
                "operation.radial_load: found nothing, expected a force, e.g. '10 kN', which is required without "
                "radial_load_lateral and operation.displacement"
            )
        loads = [load for load in map(self.load, ("radial", "lateral")) if load is not None]
        if loads and not self.displaced and numbers_or_none(*loads) is not None:
            yield from refusals_of(
                demand,
                "operation.radial_load or radial_load_lateral must differ from 0",
                functools.reduce(operator.or_, (abs(load) > 0 for load in loads)),
                lambda: "operation.radial_load_lateral: it is 0, and nothing else loads the bearing",
            )

    @property
    def displaced(self) -> bool:
        """True if a displacement perpendicular to the axis is prescribed. An axial one does not count, because nothing
        else depends on it."""
        return any(self.held_at(name) is not None for name in ("radial", "lateral"))

    @property
    def axial_given(self) -> bool:
        """True if an axial load or an axial displacement is given."""
        return self._given("axial")
