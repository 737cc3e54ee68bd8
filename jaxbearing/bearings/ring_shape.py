"""Parts of a scene for rings that are not rigid or not round: flexible rings and roundness of raceways."""

import abc
from collections.abc import Callable, Iterator
from typing import Any, ClassVar, Protocol, runtime_checkable

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import label, number, optional_number
from .._types import Scalar, Values
from ..materials import Material
from ..mounting.bending import Foundation, RingSection, rectangular_section
from ..mounting.bent_ring import BentRing, RimLoads, Supports
from ..numerics.checks import Checked, array_module, demand, numbers_or_none
from ..numerics.precision import as_float
from ..numerics.ranges import RANGES
from ..numerics.refusals import refusals_of, refuse_all
from ..numerics.safe import safe_norm
from ..numerics.structure import count, switch
from .operation import AbstractOperation

HARMONICS = 12
"""Highest order of the deflection if a scene does not give it. Its error is 4e-4 to 4e-3 of the largest load. A ring on
two narrow supports needs the order 20."""
MOST_HARMONICS = 60
"""Highest order that a scene may ask for."""
UNBALANCED = 1e-6
"""Largest accepted resultant of the loads on a free ring over the load; it allows for rounded inputs."""

Several = Float[Array | np.ndarray, "_"]
"""List of numbers of a part. Lists of one part may differ in length; `_Lists` compares those that belong together."""


def _values(values: Any) -> Any:
    """Converts to a one-dimensional array of float64. Values that are not numbers are returned unchanged, so that the
    type check refuses them."""
    if isinstance(values, list | tuple):
        traced = any(isinstance(value, jax.Array) for value in values)
        values = jnp.stack(values) if traced else np.asarray(values, dtype=np.float64)
    values = as_float(values)
    return values.reshape(1) if getattr(values, "ndim", None) == 0 else values


def _several(unit: str, bound: str = "finite") -> Any:
    """Field that holds a number or a list of numbers, each within the bound; `None` if a scene does not give it."""
    metadata = {**label(unit, ""), "each": bound}
    return eqx.field(converter=lambda v: None if v is None else _values(v), metadata=metadata, default=None)


class _Lists(Checked):
    """A part of a scene with lists. The lists of a group must be given together and have the same length."""

    groups: ClassVar[tuple[tuple[str, ...], ...]] = ()
    """Groups of names of fields that belong together. Messages name the first field of a group."""
    bounds: ClassVar[dict[str, str]] = {}
    """Field name -> bound of its entries."""

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._list_problems())

    def _list_problems(self) -> Iterator[str | ValueError]:
        for group in self.groups:
            sizes = {name: np.size(getattr(self, name)) for name in group if getattr(self, name) is not None}
            if sizes and (set(sizes) != set(group) or len(set(sizes.values())) > 1 or 0 in sizes.values()):
                missing = [name for name in group if name not in sizes]
                words = f"nothing for {' and '.join(missing)}" if missing else f"lists of lengths {sizes}"
                yield f"{self.part}.{group[0]}: expected lists of one length for {', '.join(group)}, found {words}"
        for name, bound in self.bounds.items():
            values = getattr(self, name)
            if values is not None:
                inside = RANGES[bound].holds(values)
                yield from refusals_of(
                    demand,
                    f"{self.part}.{name} must be {bound}",
                    array_module(values).all(inside),
                    lambda name=name, bound=bound: f"{self.part}.{name} must be {bound} in every entry",
                )


class AbstractBendingRing(_Lists):
    """A ring of rectangular section that bends in its plane.

    **Arguments:**
    - `thickness`: radial height of the section, measured from the raceway, in ball bearings from the bottom of the
      groove, m, > 0.
    - `width`: axial width of the section, by default the width of the bearing or else the length of a roller, m, > 0.
    - `harmonics`: highest order of the deflection, 0 for a rigid ring (structure: another number recompiles).
    - `shear`: whether shear strain of the section is modelled.
    """

    sense: ClassVar[int] = 1
    """1 if the section lies outside the raceway, -1 if it lies inside."""

    harmonics: eqx.AbstractVar[int]
    shear: eqx.AbstractVar[bool]
    thickness: Scalar = number(bound="> 0", unit="m")
    width: Scalar | None = optional_number(bound="> 0", unit="m")

    def centroid_radius(self, raceway_radius: Scalar) -> Scalar:
        """Radius of the centroid circle, m. **Arguments:** `raceway_radius`: m."""
        return raceway_radius + 0.5 * self.sense * self.thickness

    def section(self, material: Material, raceway_radius: Scalar, width: Scalar | None) -> RingSection:
        """The section for the equations. **Arguments:** `width`: width if this part does not give it, m."""
        width = width if self.width is None else self.width
        assert width is not None
        poisson = material.poisson_ratio if self.shear else None
        radius = self.centroid_radius(raceway_radius)
        return rectangular_section(material.youngs_modulus, width, self.thickness, radius, poisson)

    @abc.abstractmethod
    def bent_ring(self, material: Material, raceway_radius: Scalar, width: Scalar | None) -> BentRing:
        """The ring for the equations. **Arguments:** `width`: width if this part does not give it, m."""


class FlexibleRing(AbstractBendingRing):
    """An outer ring that is flexible in its plane, with its housing, its supports and its given loads.

    Without a housing and supports nothing holds the ring. The given loads must then balance the loads of the rolling
    elements, as on a planet gear whose rim is the ring.

    **Arguments:** those of `AbstractBendingRing`, and
    - `shear`: whether shear strain of the section is modelled, which changes the largest load by less than 0.4 %.
    - `housing_stiffness`: stiffness of a housing all around the ring, as radial force per length of circumference and
      deflection, N/m^2, > 0. If not given, nothing surrounds the ring. About 5e10 for a massive steel housing, 1e9 to
      1e10 for thin or light housings: the largest uncertainty of the model.
    - `housing_shear_stiffness`: stiffness of the housing in the circumferential direction, for a ring that is glued or
      tightly fitted, N/m^2.
    - `support_angle`: angles of discrete supports, as in a cut housing, from the load line, rad.
    - `support_stiffness`: radial stiffnesses of the supports, N/m, > 0.
    - `support_gap`: outward deflections of the ring at which it touches the supports, m.
    - `load_angle`: angles of given forces on the ring, rad.
    - `load_radial`: radial components of the given forces, positive outwards, N.
    - `load_tangential`: tangential components of the given forces, positive counter-clockwise, N.
    - `load_radius`: radii at which the given forces act, m, > 0.
    """

    part: ClassVar[str] = "outer_ring"
    groups: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("support_angle", "support_stiffness", "support_gap"),
        ("load_angle", "load_radial", "load_tangential", "load_radius"),
    )
    bounds: ClassVar[dict[str, str]] = {
        **{"support_angle": "finite", "support_stiffness": "> 0", "support_gap": "finite", "load_angle": "finite"},
        **{"load_radial": "finite", "load_tangential": "finite", "load_radius": "> 0"},
    }

    harmonics: int = count("outer_ring.harmonics", HARMONICS, least=0, most=MOST_HARMONICS)
    housing_stiffness: Scalar | None = optional_number(bound="> 0", unit="N/m^2")
    housing_shear_stiffness: Scalar = number(0.0, bound=">= 0", unit="N/m^2")
    shear: bool = switch("outer_ring.shear", False)
    support_angle: Several | None = _several("rad")
    support_stiffness: Several | None = _several("N/m", "> 0")
    support_gap: Several | None = _several("m")
    load_angle: Several | None = _several("rad")
    load_radial: Several | None = _several("N")
    load_tangential: Several | None = _several("N")
    load_radius: Several | None = _several("m", "> 0")

    @property
    def held(self) -> bool:
        """True if a housing or supports hold the ring in place."""
        return self.housing_stiffness is not None or self.support_angle is not None

    def bent_ring(self, material: Material, raceway_radius: Scalar, width: Scalar | None) -> BentRing:
        section = self.section(material, raceway_radius, width)
        orders = tuple(n for n in range(self.harmonics + 1) if self.held or n != 1)
        arrays = lambda *names: (jnp.asarray(getattr(self, name)) for name in names)
        foundation = supports = loads = None
        if self.housing_stiffness is not None:
            foundation = Foundation(jnp.asarray(self.housing_stiffness), jnp.asarray(self.housing_shear_stiffness))
        if self.support_angle is not None:
            supports = Supports(*arrays("support_angle", "support_stiffness", "support_gap"))
        if self.load_angle is not None:
            loads = RimLoads(*arrays("load_angle", "load_radial", "load_tangential", "load_radius"))
        return BentRing(section, orders, foundation, supports, loads)

    def unbalanced(self, load: Float[Array, "2"]) -> Float[Array, ""]:
        """Unbalanced force on a free ring over the load; above `UNBALANCED` the ring has no equilibrium.

        **Arguments:** `load`: load on the inner ring along and across the load line, N, which the elements transmit.
        """
        assert self.load_angle is not None
        arrays = (jnp.asarray(getattr(self, name)) for name in self.groups[1])
        rest = RimLoads(*arrays).resultant() + load
        return jnp.max(jnp.abs(rest)) / safe_norm(load[0], load[1])


class FlexibleInnerRing(AbstractBendingRing):
    r"""An inner ring that is flexible in its plane, on a hollow or soft shaft.

    Its section reaches from the bore to the raceway. The shaft is an elastic foundation under the ring and its only
    support. The deflected shape is stationary relative to the load, and the ring turns through it. This holds far below
    the first natural frequency of the ring, $2.683\sqrt{EI/\rho AR^4}$.

    Displacements of the inner ring (`operation.displacement`, `ring` of the results, the port on a shaft) are those of
    the shaft at the seat. The order 1 of the deflection is the displacement of the ring relative to the shaft: the
    raceway is displaced by the sum of both.

    **Arguments:** those of `AbstractBendingRing`, and
    - `shaft_stiffness`: stiffness of the shaft under the ring, as radial force per length of the centroid circle and
      deflection, N/m^2, > 0. About 1e11 for a solid steel shaft (width 20 mm, radius 40 mm, order 2), less for a hollow
      shaft.
    - `shaft_shear_stiffness`: stiffness of the shaft in the circumferential direction, for a ring that is shrunk or
      glued to the shaft, N/m^2.
    """

    part: ClassVar[str] = "inner_ring"
    sense: ClassVar[int] = -1

    harmonics: int = count("inner_ring.harmonics", HARMONICS, least=0, most=MOST_HARMONICS)
    shaft_stiffness: Scalar = number(kw_only=True, bound="> 0", unit="N/m^2")
    shaft_shear_stiffness: Scalar = number(0.0, bound=">= 0", unit="N/m^2")
    shear: bool = switch("inner_ring.shear", False)

    def bent_ring(self, material: Material, raceway_radius: Scalar, width: Scalar | None) -> BentRing:
        bed = Foundation(jnp.asarray(self.shaft_stiffness), jnp.asarray(self.shaft_shear_stiffness))
        orders = tuple(range(self.harmonics + 1))
        return BentRing(self.section(material, raceway_radius, width), orders, bed)


class AbstractRoundness(_Lists):
    """Deviation of the radius of a raceway from a circle. The deviation is stationary relative to the load.

    It is $p(\\psi) = \\sum_n p_n\\cos n(\\psi - \\varphi_n)$ plus a table with linear interpolation. A lobe of order 0
    changes the clearance, and a lobe of order 1 displaces the raceway.

    **Arguments:**
    - `lobe_order`: orders n of the lobes, whole numbers >= 0.
    - `lobe_height`: heights $p_n$ of the lobes, m.
    - `lobe_angle`: angles $\\varphi_n$ at which the lobes are highest, rad.
    - `table_angle`: angles of the measured deviations, rad.
    - `table_deviation`: measured deviations of the radius at these angles, m.
    """

    groups: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("lobe_order", "lobe_height", "lobe_angle"),
        ("table_angle", "table_deviation"),
    )
    bounds: ClassVar[dict[str, str]] = {
        **{"lobe_order": ">= 0", "lobe_height": "finite", "lobe_angle": "finite"},
        **{"table_angle": "finite", "table_deviation": "finite"},
    }

    lobe_order: Several | None = _several("1", ">= 0")
    lobe_height: Several | None = _several("m")
    lobe_angle: Several | None = _several("rad")
    table_angle: Several | None = _several("rad")
    table_deviation: Several | None = _several("m")

    def __check_init__(self):
        if self.lobe_order is None and self.table_angle is None:
            raise ValueError(f"{self.part}: expected lobes or a table, found nothing")
        orders = numbers_or_none(self.lobe_order)
        if orders is not None:
            xp, rule = array_module(*orders), f"{self.part}.lobe_order must be whole numbers"
            whole = xp.all(orders[0] == xp.round(orders[0]))
            demand(rule, whole, lambda: f"{rule}, got {np.asarray(orders[0]).tolist()}")

    def deviation(self, azimuth: Float[Array, " place"]) -> Float[Array, " place"]:
        """Deviation of the radius of the raceway, m, positive if it is larger. **Arguments:** `azimuth`: rad."""
        total = jnp.zeros_like(azimuth)
        if self.lobe_order is not None:
            order, height, angle = (jnp.asarray(getattr(self, name))[:, None] for name in self.groups[0])
            total = total + jnp.sum(height * jnp.cos(order * (azimuth[None, :] - angle)), axis=0)
        if self.table_angle is not None:
            angle, deviation = (jnp.asarray(getattr(self, name)) for name in self.groups[1])
            total = total + jnp.interp(azimuth, angle, deviation, period=2.0 * jnp.pi)
        return total


class InnerRoundness(AbstractRoundness):
    """Roundness of the inner raceway; see `AbstractRoundness`."""

    part: ClassVar[str] = "inner_roundness"


class OuterRoundness(AbstractRoundness):
    """Roundness of the outer raceway; see `AbstractRoundness`."""

    part: ClassVar[str] = "outer_roundness"


@runtime_checkable
class _Shaped(Protocol):
    """Protocol of scenes with rings that may be flexible or not round."""

    @property
    def outer_ring(self) -> FlexibleRing | None: ...

    @property
    def inner_ring(self) -> FlexibleInnerRing | None: ...

    @property
    def inner_roundness(self) -> InnerRoundness | None: ...

    @property
    def outer_roundness(self) -> OuterRoundness | None: ...


def shaped_parts(scene: _Shaped) -> tuple[str, ...]:
    """Names of the parts of a scene that make a ring flexible or a raceway not round."""
    parts = {
        "outer_ring": scene.outer_ring,
        "inner_ring": scene.inner_ring,
        "inner_roundness": scene.inner_roundness,
        "outer_roundness": scene.outer_roundness,
    }
    return tuple(name for name, part in parts.items() if part is not None)


def moving_problems(scene: _Shaped, round_races: bool) -> Iterator[str]:
    """Yields a message for each part of a scene that a transient run does not support.

    **Arguments:** `round_races`: True if transient runs of this family have round raceways only.
    """
    for name in shaped_parts(scene):
        if round_races or name.endswith("_ring"):
            yield f"{name}: a transient run has rigid{', round' if round_races else ''} rings in this version"


def bending_problems(
    scene: _Shaped, operation: AbstractOperation, inner_diameter: Callable[[], Values], width: Values | None
) -> Iterator[str | ValueError]:
    """Yields a message or an error for each impossible or missing input of flexible rings. The scene may be a stack of
    scenes, as for the bearings of a shaft.

    **Arguments:** `inner_diameter`: function that returns the diameter of the inner raceway, m; `width`: width of a
    ring whose part does not give it, m.
    """
    for ring in (scene.outer_ring, scene.inner_ring):
        if ring is not None and ring.harmonics and ring.width is None and width is None:
            yield f"{ring.part}.width: a flexible ring needs a width, here or as geometry.width"
    yield from _unheld_problems(scene.outer_ring, operation)
    ring = scene.inner_ring
    if ring is not None and ring.harmonics:
        radius = 0.5 * jnp.asarray(inner_diameter())
        yield from refusals_of(
            demand,
            "inner_ring.thickness: expected less than the radius of the inner raceway",
            ring.thickness < radius,
            lambda: (
                "inner_ring.thickness: expected less than the radius of the inner raceway, "
                f"{1e3 * float(radius):.4g} mm, got {1e3 * float(ring.thickness):.4g} mm"
            ),
        )


def _unheld_problems(ring: FlexibleRing | None, operation: AbstractOperation) -> Iterator[str | ValueError]:
    """Yields a message or an error for an outer ring that nothing holds and whose loads do not balance."""
    load = operation.radial_load
    if ring is None or not ring.harmonics or ring.held:
        return
    if ring.load_angle is None or load is None:
        yield (
            "outer_ring: nothing holds the ring; expected a housing_stiffness, supports, or loads from outside and "
            "an operation.radial_load that balance each other"
        )
        return
    lateral = operation.load("lateral")
    across = jnp.zeros(()) if lateral is None else jnp.asarray(lateral)
    unbalanced = ring.unbalanced(jnp.stack([jnp.asarray(load), across]))
    yield from refusals_of(
        demand,
        "outer_ring: the loads on a ring without housing and supports must balance operation.radial_load",
        unbalanced <= UNBALANCED,
        lambda: (
            "outer_ring: the loads on a ring without housing and supports must balance operation.radial_load, got "
            f"a resultant of {float(unbalanced):.3g} times the load"
        ),
    )


def said_of_bending(scene: _Shaped) -> list[str]:
    """Notes for the user on flexible rings."""
    housing = "a housing is uncertain by a factor of 2 to 10, which moves the largest load by up to some 20 %"
    doubts = ((scene.outer_ring, housing), (scene.inner_ring, "a shaft under its ring is known by an estimate only"))
    return [
        f"{ring.part}: a thin ring, flexible in its plane; the stiffness of {doubt}"
        for ring, doubt in doubts
        if ring is not None and ring.harmonics
    ]


def out_of_round(
    inner: InnerRoundness | None, outer: OuterRoundness | None, azimuth: Float[Array, " element"]
) -> Float[Array, " element"] | None:
    """Approach of the raceways to each rolling element by their roundness deviations, m; `None` if both are round."""
    if inner is None and outer is None:
        return None
    nothing = jnp.zeros_like(azimuth)
    closing = nothing if inner is None else inner.deviation(azimuth)
    return closing if outer is None else closing - outer.deviation(azimuth)
