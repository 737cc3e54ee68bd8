"""Base of the one-piece cages of all bearings: size, guiding lands, pocket clearance."""

import abc
import math
from collections.abc import Callable, Iterator
from typing import ClassVar, Generic, Literal, TypeVar

import jax.numpy as jnp

from .._scene import number, optional_number
from .._types import Scalar
from ..gaps import AbstractTurbulence, BlendedTurbulence, ShortJournal
from ..numerics.checks import Checked, numbers_or_none
from ..numerics.refusals import refusals_of, refuse_all
from ..numerics.structure import choice, count
from .parts import AbstractGeometry, check_between

Ends = Callable[[], tuple[Scalar, Scalar]]
ASSUMED_LANDS = 2
"""Number of cage lands, where a scene does not give it."""
ASSUMED_MATERIAL = "bronze"
"""Material of a moving cage for which the scene gives none."""


Geometry = TypeVar("Geometry", bound=AbstractGeometry)
"""Class of the dimensions of a bearing family."""


class AbstractCage(Checked, Generic[Geometry]):
    """One-piece cage, guided by one ring on `n_lands` lands. It has the fields too, against the habit of this
    package: they are the same in every cage, and so are their checks.

    **Arguments:**
    - `guidance`: "inner_ring" or "outer_ring".
    - `guiding_clearance`: DIAMETRAL clearance of the lands, m, > 0.
    - `pocket_clearance`: of a rolling element in its pocket, m, > 0: of balls DIAMETRAL, of rollers TOTAL
      circumferential.
    - `land_width`: of ONE land, m.
    - `inner_diameter`, `outer_diameter`: of the cage, m; assumed from the size of the elements where not given.
    - `n_lands`: number of lands; 2 where not given.
    - `turbulence`: flow regime of the lands.
    """

    part: ClassVar[str] = "cage"
    element: ClassVar[str]
    """Name of the rolling elements in the pockets."""
    assumed_inner: ClassVar[float]
    """Bore = pitch diameter minus this times the element's diameter, where a scene does not give it."""
    assumed_outer: ClassVar[float]
    """Outside diameter = pitch diameter plus this times the element's diameter, where a scene does not give it."""

    guidance: Literal["inner_ring", "outer_ring"] = choice("cage.guidance", ("inner_ring", "outer_ring"))
    guiding_clearance: Scalar = number(bound="> 0", unit="m")
    pocket_clearance: Scalar = number(bound="> 0", unit="m")
    land_width: Scalar = number(bound="> 0", unit="m")
    inner_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    outer_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    n_lands: int | None = count("cage.n_lands", None, least=1)
    turbulence: AbstractTurbulence = BlendedTurbulence()

    @abc.abstractmethod
    def pocket_opening(self, geometry: Geometry) -> tuple[Scalar, Scalar]:
        """Size of a pocket along the axis and along the circumference, m."""

    @property
    def lands(self) -> int:
        return ASSUMED_LANDS if self.n_lands is None else self.n_lands

    def bore(self, geometry: Geometry) -> Scalar:
        """Inner diameter, m."""
        if self.inner_diameter is not None:
            return self.inner_diameter
        return geometry.pitch_diameter - self.assumed_inner * geometry.element_diameter

    def outside(self, geometry: Geometry) -> Scalar:
        """Outer diameter, m."""
        if self.outer_diameter is not None:
            return self.outer_diameter
        return geometry.pitch_diameter + self.assumed_outer * geometry.element_diameter

    def land(self, geometry: Geometry) -> ShortJournal:
        """The film of the guiding lands in a bearing of this geometry."""
        diameter = self.bore(geometry) if self.guidance == "inner_ring" else self.outside(geometry)
        return ShortJournal(
            radius=jnp.asarray(diameter) / 2.0,
            width=jnp.asarray(self.land_width),
            clearance=jnp.asarray(self.guiding_clearance) / 2.0,
            turbulence=self.turbulence,
            n_lands=self.lands,
        )

    def assumptions(self) -> list[str]:
        """Notes for the user on dimensions of the cage that the model assumed."""
        assumed = {
            "inner_diameter": f"pitch diameter - {self.assumed_inner:.3g} {self.element} diameters",
            "outer_diameter": f"pitch diameter + {self.assumed_outer:.3g} {self.element} diameters",
            "n_lands": f"{ASSUMED_LANDS}",
        }
        return [
            f"cage.{name} is not given: assumed {value}"
            for name, value in assumed.items()
            if getattr(self, name) is None
        ]

    def check_fits(self, geometry: Geometry) -> None:
        """**Raises:** `ValueError` where the cage cannot exist between the rings (where the numbers are known)."""
        problems: dict[str, list[ValueError]] = {}
        for name, *limit in self._limits(geometry):
            # the lands are as large as the bore says, where that is sound
            if name != "guiding_clearance" or not problems["inner_diameter"]:
                problems[name] = list(refusals_of(_check_limit, name, *limit))
        refuse_all(error for found in problems.values() for error in found)

    def _limits(self, geometry: Geometry) -> Iterator[tuple[str, Scalar, Ends, str, str]]:
        """Field, its value, what it must lie between, and these limits in words. Each limit is found by itself, so that
        one is checked also where what another one needs is refused."""
        pitch, bore, outside = geometry.pitch_diameter, self.bore(geometry), self.outside(geometry)

        def neighbours() -> tuple[Scalar, Scalar]:
            gap = pitch * math.sin(math.pi / max(geometry.n_elements, 2)) - geometry.element_diameter
            return 0.0, gap

        inside = lambda: (pitch - geometry.element_diameter, outside)
        beyond = lambda: (bore, pitch + geometry.element_diameter)
        yield "inner_diameter", bore, inside, "inner raceway", "cage outside diameter"
        yield "outer_diameter", outside, beyond, "cage bore", "outer raceway"
        gap = f"gap between neighbouring {self.element}s"
        yield "pocket_clearance", self.pocket_clearance, neighbours, "nothing", gap
        yield (
            "guiding_clearance",
            self.guiding_clearance,
            lambda: (0.0, 0.05 * bore),
            "nothing",
            "5 % of the land diameter",
        )


def _check_limit(name: str, value: Scalar, ends: Ends, below: str, above: str) -> None:
    limits = ends()
    if numbers_or_none(value, *limits) is not None:
        check_between(f"cage.{name}", value, *limits, below, above)
