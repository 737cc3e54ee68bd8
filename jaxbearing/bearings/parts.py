"""Parts that bearing families share: the contact laws, materials, drag, checks of their sizes, azimuths."""

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
    """Base of the dimensions of all bearing families: what the parts that families share ask for.

    A family states its own dimensions as fields. `first_element_angle` is the azimuth of the first rolling element, rad
    (`None`: 0, and the load line is a line of symmetry); lengths are in m; `bore`, `outside_diameter` and `width` are
    `None` where they are not known.
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
    """Solids of a bearing. `rings` is the material of both rings, or of the outer one alone where `inner_ring` is
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
        """The materials of the rings, by their fields."""
        return {"rings": self.rings} | ({} if self.inner_ring is None else {"inner_ring": self.inner_ring})

    @property
    def race_modulus(self) -> Float[Array, ""] | Float[Array, "2 1"]:
        """E' of the elements on the raceways, Pa: one number where both rings are of one material, else of shape
        (2, 1), inner race first."""
        if self.inner_ring is None:
            return reduced_modulus(self.rings, self.elements)
        return jnp.stack([reduced_modulus(ring, self.elements) for ring in self.of_rings])[:, None]


class Materials(AbstractMaterials):
    """Solids of a roller bearing: `rings`, `rollers` and, for the dynamics, `cage`; `inner_ring`: where it is of
    another material than `rings`, which is that of the outer ring then."""

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
    - `coefficient`: drag coefficient of one rolling element in its row, >= 0; not given: that of an isolated element at
      its Reynolds number.
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1 = under-race supply.
    """

    part: ClassVar[str] = "drag"

    coefficient: Scalar | None = optional_number(bound=">= 0", unit="1")
    through_flow_fraction: Scalar = number(1.0, bound="between 0 and 1", unit="1")


class Drag(DragSettings):
    """Oil drag on orbiting rollers, whose coefficient must be given.

    **Arguments:**
    - `coefficient`: drag coefficient Cd of one rolling element in its row, >= 0; the most influential free
      number of a fast bearing's power loss.
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1 = under-race supply.
    """

    coefficient: Scalar = number(bound=">= 0", unit="1")


RUNNING_SIZES = frozenset({"diametral_clearance", "contact_angle", "first_element_angle", "flange_gap"})
"""Fields of a geometry that seats, temperature and wear change: another value of another one is another bearing."""


def names_another_bearing(path: str) -> bool:
    """True for a dotted path whose new value makes another bearing: of its geometry or its materials."""
    names = path.split(".")
    return not {"geometry", "materials"}.isdisjoint(names) and names[-1] not in RUNNING_SIZES


def drag_density(
    oil: Lubricant,
    operation: AbstractOperation,
    pitch_diameter: Scalar,
    through_flow_fraction: Scalar,
    temperature: Scalar,
) -> Float[Array, ""]:
    """Density of the mixture of oil and air between the rings, which drags on the rolling elements, kg/m^3.
    **Arguments:** `temperature`: of the oil there, K."""
    assert oil.density is not None
    fraction = saturated_oil_fraction(
        operation.oil_flow,
        # one ring at rest: the speed of the other, as in Parker's tests; both turning: either stirs the oil
        safe_norm(operation.inner_speed, operation.outer_speed),
        pitch_diameter,
        through_flow_fraction,
    )
    temperature = jnp.asarray(temperature)
    return mixture_density(fraction, oil.density.density(temperature), air_density(temperature))


def check_between(name: str, value: Scalar, low: Scalar, high: Scalar, below: str, above: str) -> None:
    """**Arguments:** lengths, m, known or traced; `below`, `above`: what the limits are, in words.

    **Raises:** `ValueError` where a known dimension lies on a limit or beyond.
    """
    ends = f"{float(low):.6g} m ({below}) and {float(high):.6g} m ({above})" if known(low, high) is not None else ""
    demand(
        f"{name} must lie between its limits, {below} and {above}",
        (low < value) & (value < high),
        lambda: f"{name} must lie between {ends}, got {float(value):.6g} m",
    )


def check_row_fits(count: int, diameter: Any, pitch_diameter: Any, element: str = "roller") -> None:
    """**Arguments:** lengths, m; one that a file has wrong is a stand-in, of which nothing is checked.

    **Raises:** `ValueError` where the rolling elements do not fit on the pitch circle."""
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
    """Azimuths of the rolling elements, rad; `alone`: of one that stands for all."""
    places = jnp.asarray(2.0 * np.pi * np.arange(1 if alone else count) / count)
    first = geometry.first_element_angle
    return places if first is None else places + first
