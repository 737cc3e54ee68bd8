"""The operating point of a bearing: speeds, oil, and for each freedom of the inner ring a load or a displacement."""

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
    """Prescribed displacements of the inner ring, m; along a degree of freedom without one a load acts.

    They count from where `ring` of the solution counts. `radial` is along azimuth 0, `lateral` along 90 degrees.
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
"""Freedom of the inner ring -> the field that holds its load."""
HELD_FIELDS = {
    "axial": "displacement.axial",
    "radial": "displacement.radial",
    "lateral": "displacement.lateral",
    "tilt": "misalignment",
    "tilt_lateral": "misalignment_lateral",
}
"""Freedom of the inner ring -> the field that holds its given displacement."""


def _as_displacement(value: object) -> HeldDisplacement | None:
    """**Raises:** `ValueError` for something that holds no displacements."""
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
"""Freedom of the inner ring -> what a load on it does, in words."""


class AbstractOperation(Checked):
    """Operating point of a bearing: the batched part of a sweep.

    Each of the ring's five degrees of freedom has a load or a given displacement, not both. A force that is not given
    is 0, and the ring goes where it balances; a tilt without a moment is held at its misalignment, 0 where that is not
    given.

    **Arguments:**
    - `inner_speed`, `outer_speed`: absolute speeds of the rings, rad/s, counter-clockwise positive.
    - `axial_load`, `radial_load`, `radial_load_lateral`: on the inner ring, along the axis, along azimuth 0 and along
      azimuth 90 degrees, N.
    - `moment`, `moment_lateral`: on the inner ring, N m (also 0): its tilt is free. A positive one moves azimuth 0, or
      azimuth 90 degrees, along the axis.
    - `misalignment`, `misalignment_lateral`: prescribed tilt of the inner ring, rad, of the same signs.
    - `displacement`: prescribed displacements of the inner ring, instead of loads.
    - `oil_temperature`: inlet temperature, K; every interaction uses it unless it computes its own.
    - `oil_flow`: supplied to the bearing, m^3/s.
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
        """The load on a degree of freedom of the inner ring, N or N m, where one is given."""
        return self._field(LOAD_FIELDS[freedom])

    def held_at(self, freedom: str) -> Scalar | None:
        """The prescribed displacement of a degree of freedom of the inner ring, m or rad, where there is one."""
        return self._field(HELD_FIELDS[freedom])

    def _given(self, *freedoms: str) -> bool:
        return any(self.load(name) is not None or self.held_at(name) is not None for name in freedoms)

    @property
    def symmetric(self) -> bool:
        """True if all rolling elements are alike: the ring moves along its axis alone."""
        return not self._given("radial", "lateral", "tilt", "tilt_lateral")

    @property
    def tilts(self) -> bool:
        """True if the inner ring can tilt."""
        return self._given("tilt", "tilt_lateral")

    @property
    def skewed(self) -> bool:
        """True if something acts across the load line: azimuths of both signs are not alike then."""
        return self._given("lateral", "tilt_lateral")

    @property
    def displaced(self) -> bool:
        """True if a displacement is given, and with it a load that is not known beforehand."""
        return any(self.held_at(name) is not None for name in ("axial", "radial", "lateral"))

    @property
    def radial_size(self) -> Array:
        """Size of the given load across the axis, N; 0 where none is given."""
        return self._size("radial", "lateral")

    @property
    def moment_size(self) -> Array:
        """Size of the given moment about an axis across the bearing's, N m; 0 where none is given."""
        return self._size("tilt", "tilt_lateral")

    def _size(self, *freedoms: str) -> Array:
        given = [jnp.asarray(load) for load in map(self.load, freedoms) if load is not None]
        return safe_norm(given[0], given[1]) if len(given) == 2 else jnp.abs(given[0] if given else jnp.zeros(()))

    def check_rings_turn(self) -> None:
        """**Raises:** `ValueError` where the rings turn alike and no film can form (where the numbers are known)."""
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
    """Operating point of a cylindrical roller bearing: the batched part of a sweep.

    It needs a radial load, along either azimuth, or a displacement of the ring across the axis. Moments and
    misalignments need rollers that may tilt, which are dry or roll without sliding; an axial load or displacement needs
    flanges (`geometry.flange_stiffness`).

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
        """True if a displacement across the axis is given: along the axis nothing else depends on it."""
        return any(self.held_at(name) is not None for name in ("radial", "lateral"))

    @property
    def axial_given(self) -> bool:
        """True if something is given along the axis, a load or a displacement."""
        return self._given("axial")
