"""Common thermal network of bearings along shaft and housing: inputs, heat flow between neighbouring bearings, and
axial thermal expansion."""

from collections.abc import Iterator, Sequence
from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from .._scene import label, number, optional_number
from .._types import Scalar
from ..materials import Material
from ..mounting.annulus import REFERENCE_TEMPERATURE
from ..numerics.checks import Checked
from .shaft import Shaft

NODES = 6
"""Number of nodes that the network of each bearing must have: the last two are its shaft and its housing."""
SHAFT_NODE, HOUSING_NODE = 4, 5


class ShaftThermal(Checked):
    """Common thermal network of the bearings: heat flows between neighbouring bearings along the shaft and in the
    housing, and shaft and housing expand along the axis with their temperatures.

    Each bearing with a table [thermal] contributes its network of six nodes; the others have none. Between two bearings
    the temperatures of shaft and housing change linearly, beyond the outermost ones they are constant.

    **Arguments:**
    - `housing_expansion`: coefficient of thermal expansion of the housing, 1/K. The shaft has that of its material.
    - `housing_conductance`: conductance between the housing nodes of neighbouring bearings, W/K.
    - `shaft_conductance`: conductance between the shaft nodes of neighbouring bearings, W/K. If not given, it follows
      from the sections and the conductivity of their materials.
    """

    part: ClassVar[str] = "thermal"

    housing_expansion: Scalar = number(
        bound=">= 0", metadata=label("1/K", "coefficient of thermal expansion of the housing")
    )
    housing_conductance: Scalar = number(
        0.0, bound=">= 0", metadata=label("W/K", "conductance of the housing between neighbouring bearings")
    )
    shaft_conductance: Scalar | None = optional_number(
        bound="> 0", metadata=label("W/K", "conductance of the shaft between neighbouring bearings")
    )


class ShaftThermalResult(eqx.Module):
    """The network along shaft and housing. Temperatures and heat flows of each bearing are in its own results.

    **Arguments:** the labels of the fields describe them. A gap lies between two neighbours, in ascending order of
    their positions; heat in the direction of +X is positive.
    """

    shaft_flow: Float[Array, " gap"] = eqx.field(
        metadata=label("W", "heat along the shaft in each gap between bearings, towards +X")
    )
    housing_flow: Float[Array, " gap"] = eqx.field(
        metadata=label("W", "heat in the housing in each gap between bearings, towards +X")
    )
    heat_to_oil: Float[Array, ""] = eqx.field(metadata=label("W", "heat that leaves with the oil of all bearings"))
    heat_to_ambient: Float[Array, ""] = eqx.field(metadata=label("W", "heat that leaves to the ambient"))
    balance_error: Float[Array, ""] = eqx.field(
        metadata=label("1", "loss of all bearings less the heat that leaves, relative to the loss")
    )
    solves: Int[Array, ""] = eqx.field(metadata=label("1", "solves of the shaft behind these temperatures"))


def thermal_problems(thermal: ShaftThermal | None, shaft: Shaft, bearings: dict[str, Any]) -> Iterator[str]:
    """Yields a sentence for each missing or conflicting input of the common network.

    **Arguments:** `bearings`: scenes of the bearings by their paths.
    """
    if thermal is None:
        return
    warm = {path: scene for path, scene in bearings.items() if getattr(scene, "thermal", None) is not None}
    if len(warm) < 2:
        yield "thermal: expected [thermal] tables of two or more bearings, which it joins"
    for path, scene in warm.items():
        if scene.thermal.nodes != NODES:
            yield f"{path}.thermal.nodes must be {NODES}, with shaft and housing, got {scene.thermal.nodes}"
    if shaft.thermal_strain is not None:
        yield "shaft.thermal_strain: expected none beside [thermal], which computes it"
    if not shaft.sections and thermal.shaft_conductance is None:
        yield "thermal.shaft_conductance: found nothing, expected a number, since the shaft has no sections"
    for name, needed in (("thermal_expansion", True), ("conductivity", thermal.shaft_conductance is None)):
        lacking = [m for m in _materials(shaft) if getattr(m, name) is None]
        if needed and lacking:
            example = {"thermal_expansion": "12e-6 1/K", "conductivity": "46 W/(m*K)"}[name]
            yield f"shaft.material.{name}: found nothing, expected a number, which [thermal] needs, e.g. '{example}'"


def _materials(shaft: Shaft) -> Sequence[Material]:
    own = [section.material or shaft.material for section in shaft.sections]
    return own or [shaft.material]


def _conductivity(material: Material) -> Scalar:
    """Conductivity, W/(m K); `thermal_problems` makes sure that it is given."""
    return material.conductivity


def _ends(shaft: Shaft) -> Float[Array, " end"]:
    """Ends of the sections, m, and before them the start x = 0 of the first one."""
    lengths = [jnp.asarray(section.length, dtype=float) for section in shaft.sections]
    return jnp.concatenate([jnp.zeros(1), jnp.cumsum(jnp.stack(lengths))]) if lengths else jnp.zeros(1)


def ascending(position: Float[Array, " bearing"]) -> Int[Array, " bearing"]:
    """Order of the bearings along the shaft."""
    return jnp.argsort(jax.lax.stop_gradient(position))


def gap_conductances(thermal: ShaftThermal, shaft: Shaft, position: Float[Array, " bearing"]) -> Float[Array, " gap"]:
    r"""Conductance of the shaft per gap, W/K: $1/\int dx/(kA)$. **Arguments:** `position`: in ascending order, m."""
    if thermal.shaft_conductance is not None:
        return jnp.broadcast_to(jnp.asarray(thermal.shaft_conductance, dtype=float), (len(position) - 1,))
    ends = _ends(shaft)
    resistivity = jnp.stack([
        4.0 / jnp.pi / _conductivity(material) / (section.outer_diameter**2 - section.inner_diameter**2)
        for section, material in zip(shaft.sections, _materials(shaft), strict=True)
    ])  # fmt: skip
    inside = jnp.clip(position[:, None], ends[None, :-1], ends[None, 1:]) - ends[None, :-1]
    return 1.0 / jnp.diff(inside @ resistivity)


def between_neighbours(thermal: ShaftThermal, shaft: Shaft, position: Float[Array, " bearing"]) -> Array:
    """Conductances of shaft and housing between the nodes of all bearings, W/K, shape (6 n, 6 n).

    **Arguments:** `position`: positions of the bearings with a network, m.
    """
    order, count = ascending(position), len(position)
    gaps = {
        SHAFT_NODE: gap_conductances(thermal, shaft, position[order]),
        HOUSING_NODE: jnp.broadcast_to(jnp.asarray(thermal.housing_conductance, dtype=float), (count - 1,)),
    }
    conductances = jnp.zeros((count, NODES, count, NODES))
    for node, conductance in gaps.items():
        conductances = conductances.at[order[:-1], node, order[1:], node].add(conductance)
        conductances = conductances.at[order[1:], node, order[:-1], node].add(conductance)
    return conductances.reshape(count * NODES, count * NODES)


def flows_along(
    thermal: ShaftThermal, shaft: Shaft, position: Float[Array, " bearing"], temperatures: Float[Array, "bearing 6"]
) -> tuple[Float[Array, " gap"], Float[Array, " gap"]]:
    """Heat flow along the shaft and heat flow in the housing in each gap, W, positive towards +X."""
    order = ascending(position)
    falling = -jnp.diff(temperatures[order], axis=0)
    along = gap_conductances(thermal, shaft, position[order]) * falling[:, SHAFT_NODE]
    return along, thermal.housing_conductance * falling[:, HOUSING_NODE]


def growth_along(
    thermal: ShaftThermal,
    shaft: Shaft,
    position: Float[Array, " bearing"],
    temperatures: Float[Array, "bearing 6"],
    at: Float[Array, " place"],
) -> Float[Array, " place"]:
    r"""Axial displacement of the shaft relative to the housing by thermal expansion, m:
    $\int_{x_{ref}}^x(\alpha_s(T_s - T_0) - \alpha_h(T_h - T_0))\,dx$, exact for temperatures that change linearly.

    **Arguments:** `position`, `temperatures`: of the bearings with a network, m and K; `at`: positions, m.
    """
    order, ends = ascending(position), _ends(shaft)
    reference = jnp.reshape(jnp.asarray(shaft.strain_reference, dtype=float), (1,))
    grid = jnp.sort(jnp.concatenate([ends, position, at, reference]))
    middle, length = 0.5 * (grid[1:] + grid[:-1]), jnp.diff(grid)
    mean = lambda node: jnp.interp(middle, position[order], temperatures[order, node]) - REFERENCE_TEMPERATURE
    each = jnp.stack([jnp.asarray(material.thermal_expansion, dtype=float) for material in _materials(shaft)])
    section = jnp.clip(jnp.searchsorted(ends, jax.lax.stop_gradient(middle)) - 1, 0, len(each) - 1)
    strain = each[section] * mean(SHAFT_NODE) - thermal.housing_expansion * mean(HOUSING_NODE)
    grown = jnp.concatenate([jnp.zeros(1), jnp.cumsum(strain * length)])
    moved = lambda places: jnp.interp(places, grid, grown)
    return moved(at) - moved(reference)
