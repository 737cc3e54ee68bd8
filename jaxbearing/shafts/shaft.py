"""The shaft: a row of cylinders, its speed and its weight.

Frame of a shaft: X along it, Y at azimuth 0, Z at azimuth 90 degrees. The speed is positive from Y to Z. A point of the
shaft has the five degrees of freedom of a bearing's ring (`bearings.ring`) in this frame: axial, radial (Y), lateral
(Z), and two tilts. Positive tilts move azimuth 0 and azimuth 90 degrees along +X.
"""

from typing import ClassVar

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from .._scene import label, number, optional_number
from .._types import Scalar
from ..materials import Material
from ..numerics.checks import Checked, demand, numbers_or_none

STEEL = Material(np.float64(206e9), np.float64(0.3), np.float64(7850.0))
"""Default material of a shaft."""


class Section(Checked):
    """A cylindrical part of a shaft, solid or hollow. A cone is approximated by several sections.

    **Arguments:**
    - `length`: m, > 0.
    - `outer_diameter`: m, > 0.
    - `inner_diameter`: diameter of the bore, m, below the outer one; 0 for a solid section.
    - `material`: material of the section; `None` for that of the shaft.
    """

    part: ClassVar[str] = "shaft.sections"

    length: Scalar = number(bound="> 0", metadata=label("m", "length of a section"))
    outer_diameter: Scalar = number(bound="> 0", metadata=label("m", "outer diameter of a section"))
    inner_diameter: Scalar = number(0.0, bound=">= 0", metadata=label("m", "bore of a section"))
    material: Material | None = None

    def __check_init__(self):
        super().__check_init__()
        if numbers_or_none(self.inner_diameter, self.outer_diameter) is not None:
            demand(
                "{path}.inner_diameter must be smaller than outer_diameter",
                self.inner_diameter < self.outer_diameter,
                lambda: (
                    f"shaft.sections: inner_diameter {float(self.inner_diameter):g} m must be smaller than "
                    f"outer_diameter {float(self.outer_diameter):g} m"
                ),
            )


class Gravity(Checked):
    """Gravity across the shaft. It acts on the shaft and on the masses on it.

    **Arguments:**
    - `acceleration`: m/s^2, >= 0.
    - `azimuth`: direction of gravity, rad, from Y towards Z; pi is downwards if Y points up.
    """

    part: ClassVar[str] = "shaft.gravity"

    acceleration: Scalar = number(9.81, bound=">= 0", metadata=label("m/s^2", "acceleration of gravity"))
    azimuth: Scalar = number(np.pi, metadata=label("rad", "azimuth in which the weight acts"))


class Shaft(Checked):
    """A stepped shaft; without sections it is rigid.

    **Arguments:**
    - `speed`: rad/s, positive from Y to Z. It is the speed of every inner ring.
    - `sections`: sections from x = 0 along +X. Without sections the shaft is rigid and has no weight and no ends.
    - `material`: material of the sections without a material of their own.
    - `gravity`: gravity across the shaft; `None` for a weightless shaft.
    - `thermal_strain`: thermal strain of the shaft less that of the housing,
      $\\alpha_s\\Delta T_s - \\alpha_h\\Delta T_h$. It closes or opens the bearings, whose rings are located rigidly on
      both, in proportion to their distance from `strain_reference`.
    - `strain_reference`: position of the point of the shaft that does not move relative to the housing, m.
    """

    part: ClassVar[str] = "shaft"

    speed: Scalar = number(metadata=label("rad/s", "speed of the shaft"))
    sections: tuple[Section, ...] = eqx.field(default=(), converter=tuple)
    material: Material = STEEL
    gravity: Gravity | None = None
    thermal_strain: Scalar | None = optional_number(
        metadata=label("1", "thermal strain of the shaft less that of the housing")
    )
    strain_reference: Scalar = number(0.0, metadata=label("m", "point of the shaft that the strain does not move"))

    @property
    def length(self) -> Float[Array, ""] | float:
        """Sum of the lengths of the sections, m."""
        return sum(section.length for section in self.sections)
