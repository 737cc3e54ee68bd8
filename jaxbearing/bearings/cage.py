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
"""Number of cage lands if the scene does not give it."""
ASSUMED_MATERIAL = "bronze"
"""Material of a moving cage if the scene does not give one."""


Geometry = TypeVar("Geometry", bound=AbstractGeometry)
"""Geometry class of a bearing family."""


class AbstractCage(Checked, Generic[Geometry]):
    """One-piece cage, guided by one ring on `n_lands` lands. Unlike other base classes of this package, this one holds
    the fields, because they and their checks are the same for all cages.

    **Arguments:**
    - `guidance`: ring that guides the cage, "inner_ring" or "outer_ring".
    - `guiding_clearance`: DIAMETRAL clearance of the lands, m, > 0.
    - `pocket_clearance`: clearance of a rolling element in its pocket, DIAMETRAL for balls and TOTAL circumferential
      for rollers, m, > 0.
    - `land_width`: width of ONE land, m.
    - `inner_diameter`: inner diameter of the cage, assumed from the pitch and element diameters if not given, m.
    - `outer_diameter`: outer diameter of the cage, assumed from the pitch and element diameters if not given, m.
    - `n_lands`: number of lands; 2 if not given.
    - `turbulence`: flow regime of the land films.
    """

    part: ClassVar[str] = "cage"
    element: ClassVar[str]
    """Name of the rolling elements in the pockets."""
    assumed_inner: ClassVar[float]
    """Factor in the assumed bore: pitch diameter minus this factor times the element diameter."""
    assumed_outer: ClassVar[float]
    """Factor in the assumed outside diameter: pitch diameter plus this factor times the element diameter."""

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

    def raceways(self, geometry: Geometry) -> tuple[Scalar, Scalar]:
        """Diameters of both raceways between which the cage turns, m."""
        pitch = geometry.pitch_diameter
        return pitch - geometry.element_diameter, pitch + geometry.element_diameter

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

    def land_diameter(self, geometry: Geometry) -> Scalar:
        """Diameter of the guiding lands of the cage, m: its bore or its outside."""
        return self.bore(geometry) if self.guidance == "inner_ring" else self.outside(geometry)

    def land(self, geometry: Geometry) -> ShortJournal:
        """The film of the guiding lands in a bearing of this geometry."""
        return ShortJournal(
            radius=jnp.asarray(self.land_diameter(geometry)) / 2.0,
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
        """Checks that the cage fits between the rings, as far as the numbers are known.

        **Raises:** `ValueError` if it does not fit."""
        problems: dict[str, list[ValueError]] = {}
        land = "inner_diameter" if self.guidance == "inner_ring" else "outer_diameter"
        for name, *limit in self._limits(geometry):
            # the limit of the guiding clearance follows from the land, so it is checked only if the land is accepted
            if name != "guiding_clearance" or not problems[land]:
                problems[name] = list(refusals_of(_check_limit, name, *limit))
        refuse_all(error for errors in problems.values() for error in errors)

    def _limits(self, geometry: Geometry) -> Iterator[tuple[str, Scalar, Ends, str, str]]:
        """Yields for each limited field its name, its value, a function that returns the limits, and the limits in
        words. As the limits are functions, a field can be checked even if an input of other limits was refused."""
        pitch, bore, outside = geometry.pitch_diameter, self.bore(geometry), self.outside(geometry)

        def neighbours() -> tuple[Scalar, Scalar]:
            gap = pitch * math.sin(math.pi / max(geometry.n_elements, 2)) - geometry.element_diameter
            return 0.0, gap

        inside = lambda: (self.raceways(geometry)[0], outside)
        beyond = lambda: (bore, self.raceways(geometry)[1])
        yield "inner_diameter", bore, inside, "inner raceway", "cage outside diameter"
        yield "outer_diameter", outside, beyond, "cage bore", "outer raceway"
        gap = f"gap between neighbouring {self.element}s"
        yield "pocket_clearance", self.pocket_clearance, neighbours, "nothing", gap
        yield (
            "guiding_clearance",
            self.guiding_clearance,
            lambda: (0.0, 0.05 * self.land_diameter(geometry)),
            "nothing",
            "5 % of the land diameter",
        )


def _check_limit(name: str, value: Scalar, ends: Ends, below: str, above: str) -> None:
    limits = ends()
    if numbers_or_none(value, *limits) is not None:
        check_between(f"cage.{name}", value, *limits, below, above)
