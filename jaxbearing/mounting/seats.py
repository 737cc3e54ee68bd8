"""The seats of a bearing as tables of a scene: fits on shaft and housing, temperatures of the parts."""

from collections.abc import Iterator
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._scene import label, number, optional_number
from .._types import Scalar
from ..materials import Material, catalogue_material, check_interference
from ..numerics.checks import Checked, demand, numbers_or_none
from ..numerics.refusals import refuse_all
from ..numerics.structure import choice
from . import iso286
from .iso286 import HOLE_CLASSES, SHAFT_CLASSES, Limits

Seat = Literal["shaft", "housing"]
"""Name of a seat."""
SMOOTHING = 2e-6
"""Loss of interference of a ground seat by smoothing, m, if the scene gives none. ISO 286 has no value; makers'
catalogues state 1 to 2.5 um for ground and 5 to 7 um for turned seats."""
ASSUMED_HOUSING = 1.5
"""Outside diameter of the housing over that of the bearing, assumed if the scene gives none."""


def _seat_material(value: Any) -> Material:
    return catalogue_material("steel", thermal=True) if value is None else value


class Fits(Checked):
    """Seats of the bearing's rings. A ring with neither an interference nor a tolerance class has no seat and grows
    freely.

    **Arguments:**
    - `shaft_interference`, `housing_interference`: diametral, as machined, m; positive: tight.
    - `shaft_tolerance`, `housing_tolerance`: tolerance class of ISO 286, such as "k5" or "J7", in place of an
      interference; the bearing has the normal class of ISO 492.
    - `at`: interference that is used within the tolerance classes: the mean, the tightest or the loosest.
    - `shaft_bore`: bore of a hollow shaft, m; 0: solid.
    - `housing_outside`: outside diameter of the housing, m; not given: 1.5 times that of the bearing.
    - `shaft_material`, `housing_material`: material; not given: steel.
    - `smoothing`: loss of interference of each seat by flattened asperities, m; not given: 2 um for a tight seat, at
      most its interference.
    """

    part: ClassVar[str] = "fits"

    shaft_interference: Scalar | None = optional_number(metadata=label("m", "interference of the inner ring"))
    housing_interference: Scalar | None = optional_number(metadata=label("m", "interference of the outer ring"))
    shaft_tolerance: str | None = choice("fits.shaft_tolerance", SHAFT_CLASSES, None)
    housing_tolerance: str | None = choice("fits.housing_tolerance", HOLE_CLASSES, None)
    at: Literal["mean", "tightest", "loosest"] = choice("fits.at", ("mean", "tightest", "loosest"), "mean")
    shaft_bore: Scalar = number(0.0, bound=">= 0", metadata=label("m", "bore of the shaft"))
    housing_outside: Scalar | None = optional_number(bound="> 0", metadata=label("m", "outside of the housing"))
    shaft_material: Material = eqx.field(converter=_seat_material, default=None)
    housing_material: Material = eqx.field(converter=_seat_material, default=None)
    smoothing: Scalar | None = optional_number(bound=">= 0", metadata=label("m", "smoothing of the seats"))

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        for seat in ("shaft", "housing"):
            if getattr(self, f"{seat}_interference") is not None and getattr(self, f"{seat}_tolerance") is not None:
                yield f"fits.{seat}_tolerance: expected none beside fits.{seat}_interference, which says the same"

    @property
    def on_shaft(self) -> bool:
        """True if the inner ring has a seat."""
        return self.shaft_interference is not None or self.shaft_tolerance is not None

    @property
    def in_housing(self) -> bool:
        """True if the outer ring has a seat."""
        return self.housing_interference is not None or self.housing_tolerance is not None

    def limits(self, seat: Seat, diameter: Scalar) -> Limits:
        """Smallest and largest interference of a seat, m. **Arguments:** `diameter`: of the seat, m."""
        interference = getattr(self, f"{seat}_interference")
        if interference is not None:
            return Limits(jnp.asarray(interference), jnp.asarray(interference))
        return getattr(iso286, f"{seat}_interference")(getattr(self, f"{seat}_tolerance"), diameter)

    def interference(self, seat: Seat, diameter: Scalar) -> Float[Array, ""]:
        """Interference of a seat, selected by `at`, before smoothing, m. **Arguments:** `diameter`: of the seat, m."""
        low, high = self.limits(seat, diameter)
        match self.at:
            case "tightest":
                return high
            case "loosest":
                return low
        return 0.5 * (low + high)

    def smoothed(self, interference: Float[Array, "*seat"]) -> Float[Array, "..."]:
        """Loss of an interference by smoothing, m."""
        if self.smoothing is not None:
            return jnp.asarray(self.smoothing)
        # `where` instead of `clip`: at both ends the derivative of the loss is 0
        flattened = jnp.where(interference > 0.0, interference, 0.0)
        return jnp.where(interference >= SMOOTHING, SMOOTHING, flattened)

    def housing_diameter(self, outside_diameter: Scalar) -> Scalar:
        """Outside diameter of the housing, m. **Arguments:** `outside_diameter`: of the bearing, m."""
        return ASSUMED_HOUSING * outside_diameter if self.housing_outside is None else self.housing_outside

    def check_room(self, bore: Scalar | None, outside_diameter: Scalar | None) -> None:
        """Checks the walls of shaft and housing, the interferences and the tolerance classes.

        **Arguments:** `bore`, `outside_diameter`: of the bearing, m.

        **Raises:** `ValueError` if shaft or housing has no wall, if an interference would make steel yield, or if the
        table of a tolerance class does not have the diameter.
        """
        shaft = numbers_or_none(bore, self.shaft_bore)
        if shaft is not None and self.on_shaft:
            demand(
                "fits.shaft_bore must be less than geometry.bore",
                shaft[1] < shaft[0],
                lambda: f"fits.shaft_bore must be less than geometry.bore, {shaft[0]:.6g} m, got {shaft[1]:.6g} m",
            )
        wall = numbers_or_none(outside_diameter, self.housing_outside)
        if wall is not None and self.in_housing:
            demand(
                "fits.housing_outside must be more than geometry.outside_diameter",
                wall[1] > wall[0],
                lambda: (
                    f"fits.housing_outside must be more than geometry.outside_diameter, {wall[0]:.6g} m, got "
                    f"{wall[1]:.6g} m"
                ),
            )
        check_interference("fits.shaft_interference", self.shaft_interference, bore)
        check_interference("fits.housing_interference", self.housing_interference, outside_diameter)
        _check_covered("shaft_tolerance", self.shaft_tolerance, bore)
        _check_covered("housing_tolerance", self.housing_tolerance, outside_diameter)

    def assumptions(self, warm: bool = True) -> tuple[str, ...]:
        """Notes for the user on what is assumed. **Arguments:** `warm`: True if temperatures of the parts are given."""
        notes = [] if warm else ["fits: no [temperatures] are given, all parts are at 20 degC"]
        if self.smoothing is None and (self.on_shaft or self.in_housing):
            notes.append("fits.smoothing is not given: each tight seat loses 2 um, as ground ones do")
        if self.in_housing and self.housing_outside is None:
            notes.append(f"fits.housing_outside is not given: assumed {ASSUMED_HOUSING:g} times the outside diameter")
        return tuple(notes)


def _check_covered(name: str, tolerance: object, diameter: Scalar | None) -> None:
    """Checks that the table of a tolerance class has the diameter of the seat, m.

    **Raises:** `ValueError` if it does not have it.
    """
    size = numbers_or_none(diameter)
    # nothing to check: a value is not given, or has been refused already
    if not isinstance(tolerance, str) or size is None:
        return
    least, most = iso286.covered(tolerance)
    demand(
        f"fits.{name}: the tables of ISO 286 must hold the diameter of the seat",
        (size[0] > least) & (size[0] <= most),
        lambda: (
            f"fits.{name}: the tables have {tolerance} above {1e3 * least:g} and up to {1e3 * most:g} mm, the seat has "
            f"{1e3 * float(size[0]):g} mm; give an interference instead"
        ),
    )


class PartTemperatures(Checked):
    """Temperatures of the parts of a mounted bearing, K, each uniform. Dimensions on the drawing hold at 20 degC.

    **Arguments:**
    - `inner_ring`, `outer_ring`: must be given.
    - `elements`: of the rolling elements; not given: the mean of both rings.
    - `shaft`, `housing`: not given: the temperature of the ring that is fitted to it.
    """

    part: ClassVar[str] = "temperatures"

    inner_ring: Scalar = number(bound="> 0", metadata=label("K", "temperature of the inner ring"))
    outer_ring: Scalar = number(bound="> 0", metadata=label("K", "temperature of the outer ring"))
    elements: Scalar | None = optional_number(bound="> 0", metadata=label("K", "temperature of the rolling elements"))
    shaft: Scalar | None = optional_number(bound="> 0", metadata=label("K", "temperature of the shaft"))
    housing: Scalar | None = optional_number(bound="> 0", metadata=label("K", "temperature of the housing"))

    @property
    def of_elements(self) -> Scalar:
        """Temperature of the rolling elements, K."""
        return 0.5 * (self.inner_ring + self.outer_ring) if self.elements is None else self.elements

    @property
    def of_shaft(self) -> Scalar:
        """Temperature of the shaft, K."""
        return self.inner_ring if self.shaft is None else self.shaft

    @property
    def of_housing(self) -> Scalar:
        """Temperature of the housing, K."""
        return self.outer_ring if self.housing is None else self.housing
