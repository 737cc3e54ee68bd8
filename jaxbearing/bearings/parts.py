"""Parts that bearing families share: contact laws, materials, drag, checks of dimensions, azimuths."""

import abc
import math
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import AbstractScene, label, number, optional_number
from .._types import Scalar
from ..contacts.laws import ContactLaws
from ..gaps import air_density, mixture_density, saturated_oil_fraction
from ..lubricants import Lubricant
from ..materials import Material, reduced_modulus
from ..numerics.checks import Checked, demand, known, numbers_or_none
from ..numerics.safe import safe_norm
from .operation import AbstractOperation

__all__ = ["AbstractScene", "ContactLaws", "Drag", "Materials", "number", "optional_number"]


class AbstractGeometry(Checked):
    """Base of the geometry classes of all families, with the dimensions that shared parts need.

    A family defines its own dimensions as fields, with lengths in m. `first_element_angle` is the azimuth of the first
    rolling element, rad; `None` stands for 0, where the load line is a line of symmetry. `bore`, `outside_diameter` and
    `width` are `None` if they are not known.
    """

    first_element_angle: eqx.AbstractVar[Scalar | None]
    bore: eqx.AbstractVar[Scalar | None]
    outside_diameter: eqx.AbstractVar[Scalar | None]
    width: eqx.AbstractVar[Scalar | None]
    pitch_diameter: eqx.AbstractVar[Scalar]

    @property
    @abc.abstractmethod
    def n_elements(self) -> int:
        """Number of rolling elements."""

    @property
    @abc.abstractmethod
    def element_diameter(self) -> Scalar:
        """Diameter of a rolling element, at its middle, m."""


class AbstractMaterials(eqx.Module):
    """Materials of a bearing. `rings` is the material of both rings, or of the outer ring alone if `inner_ring` is
    given."""

    rings: eqx.AbstractVar[Material]
    inner_ring: eqx.AbstractVar[Material | None]

    @property
    @abc.abstractmethod
    def elements(self) -> Material:
        """The material of the rolling elements."""

    @property
    def of_rings(self) -> tuple[Material, Material]:
        """The materials of the inner and of the outer ring."""
        return (self.rings if self.inner_ring is None else self.inner_ring), self.rings

    @property
    def named_rings(self) -> dict[str, Material]:
        """Field name -> material, for the materials of the rings."""
        return {"rings": self.rings} | ({} if self.inner_ring is None else {"inner_ring": self.inner_ring})

    @property
    def race_modulus(self) -> Float[Array, ""] | Float[Array, "2 1"]:
        """Reduced modulus E' of the contacts with the raceways, Pa: one number if both rings are of one material,
        otherwise of shape (2, 1), inner race first."""
        if self.inner_ring is None:
            return reduced_modulus(self.rings, self.elements)
        return jnp.stack([reduced_modulus(ring, self.elements) for ring in self.of_rings])[:, None]


class Materials(AbstractMaterials):
    """Materials of a roller bearing: `rings`, `rollers` and, for transient runs, `cage`. If `inner_ring` is given,
    `rings` is the material of the outer ring alone."""

    rings: Material
    rollers: Material
    cage: Material | None = None
    inner_ring: Material | None = None

    @property
    def elements(self) -> Material:
        return self.rollers


class DragSettings(Checked):
    """Oil drag on the orbiting rolling elements (windage and churning).

    **Arguments:**
    - `coefficient`: drag coefficient of one rolling element in its row, by default that of an isolated element at its
      Reynolds number, >= 0.
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1 = under-race supply.
    """

    part: ClassVar[str] = "drag"

    coefficient: Scalar | None = optional_number(bound=">= 0", unit="1")
    through_flow_fraction: Scalar = number(1.0, bound="between 0 and 1", unit="1")


class Drag(DragSettings):
    """Oil drag on the orbiting rollers. Its coefficient must be given.

    **Arguments:**
    - `coefficient`: drag coefficient Cd of one rolling element in its row, >= 0; the free number with the largest
      influence on the power loss of a fast bearing.
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1 = under-race supply.
    """

    coefficient: Scalar = number(bound=">= 0", unit="1")


RUNNING_SIZES = frozenset({"diametral_clearance", "contact_angle", "first_element_angle", "flange_gap"})
"""Fields of a geometry that seats, temperature and wear change. A new value of another field makes another bearing."""


def names_another_bearing(path: str) -> bool:
    """True if a new value at this dotted path makes another bearing: the path of a material, or of a field of the
    geometry outside `RUNNING_SIZES`."""
    names = path.split(".")
    return not {"geometry", "materials"}.isdisjoint(names) and names[-1] not in RUNNING_SIZES


def drag_density(
    oil: Lubricant,
    operation: AbstractOperation,
    pitch_diameter: Scalar,
    through_flow_fraction: Scalar,
    temperature: Scalar,
) -> Float[Array, ""]:
    """Density of the oil-air mixture between the rings, which drags on the rolling elements, kg/m^3.

    **Arguments:** `pitch_diameter`: m; `through_flow_fraction`: see `DragSettings`; `temperature`: temperature of the
    oil between the rings, K."""
    assert oil.density is not None
    fraction = saturated_oil_fraction(
        operation.oil_flow,
        # with one ring at rest this is the speed of the other, as in Parker's tests; if both turn, both stir the oil
        safe_norm(operation.inner_speed, operation.outer_speed),
        pitch_diameter,
        through_flow_fraction,
    )
    temperature = jnp.asarray(temperature)
    return mixture_density(fraction, oil.density.density(temperature), air_density(temperature))


def check_between(name: str, value: Scalar, low: Scalar, high: Scalar, below: str, above: str) -> None:
    """Checks that a length lies between two limits.

    **Arguments:** `value`, `low`, `high`: length and its limits, m, known or traced; `below`, `above`: names of the
    limits.

    **Raises:** `ValueError` if the known length lies on a limit or beyond.
    """
    ends = f"{float(low):.6g} m ({below}) and {float(high):.6g} m ({above})" if known(low, high) is not None else ""
    demand(
        f"{name} must lie between its limits, {below} and {above}",
        (low < value) & (value < high),
        lambda: f"{name} must lie between {ends}, got {float(value):.6g} m",
    )


def check_row_fits(count: int, diameter: Any, pitch_diameter: Any, element: str = "roller") -> None:
    """Checks that the rolling elements fit on the pitch circle.

    **Arguments:** `diameter`, `pitch_diameter`: m; nothing is checked if a placeholder stands for a length that was
    wrong in a file.

    **Raises:** `ValueError` if they do not fit."""
    name = f"geometry.n_{element}s"
    if count < 1:
        raise ValueError(f"{name} must be >= 1, got {count}")
    sizes = numbers_or_none(diameter, pitch_diameter)
    if sizes is None:
        return
    chord = sizes[1] * math.sin(math.pi / max(count, 2))
    most = lambda: math.ceil(math.pi / math.asin(sizes[0] / sizes[1])) - 1 if sizes[0] < sizes[1] else 0
    demand(
        f"{name} must be so small that the {element}s fit beside each other on the pitch circle",
        sizes[0] < chord,
        lambda: (
            f"{name}: {count} {element}s of diameter {float(sizes[0]):g} m do not fit on a pitch "
            f"circle of {float(sizes[1]):g} m: their centres are {float(chord):g} m apart; at most {most()} fit"
        ),
    )


FIRST_ELEMENT = label("rad", "azimuth of the first rolling element")


def azimuths(geometry: AbstractGeometry, count: int, alone: bool = False) -> Float[Array, " element"]:
    """Azimuths of the rolling elements, rad. **Arguments:** `alone`: True for one element that represents all."""
    places = jnp.asarray(2.0 * np.pi * np.arange(1 if alone else count) / count)
    first = geometry.first_element_angle
    return places if first is None else places + first
