"""Oil supply of the raceways of a solved bearing, and checks of the inputs that the supply needs."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import label
from ..contacts.oil_supply import Starvation, given_by
from ..numerics.checks import demand, numbers_or_none
from ..numerics.refusals import refusals_of

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

FLOODED = "fully flooded (assumed)"
"""Supply of a scene with films but without a table [contact.supply], in words."""
_Factor = Float[Array, ""] | None


def _optional(description: str) -> Any:
    return eqx.field(default=None, metadata=label("1", description))


class SupplyResult(eqx.Module):
    """Oil supply of the raceways. The numbers are those of the most loaded contact of each race; they are `None` if the
    contacts are assumed to be flooded.

    `stated`: the supply in words.
    """

    stated: str = eqx.field(static=True)
    film_factor_inner: _Factor = _optional("starved over flooded film, inner raceway")
    film_factor_outer: _Factor = _optional("starved over flooded film, outer raceway")
    rolling_factor_inner: _Factor = _optional("starved over flooded rolling resistance, inner raceway")
    rolling_factor_outer: _Factor = _optional("starved over flooded rolling resistance, outer raceway")
    gap_over_central_inner: _Factor = _optional("gap at the inlet meniscus over flooded central film, inner raceway")
    gap_over_central_outer: _Factor = _optional("gap at the inlet meniscus over flooded central film, outer raceway")

    @property
    def uses_flow(self) -> bool:
        """True if the supply depends on the oil flow of the operating point."""
        return self.stated == given_by("from_flow")


def supply_result(
    scene: AbstractBearing, load: Float[Array, "contact element"], starved: Starvation | None
) -> SupplyResult | None:
    """The oil supply of a scene; `None` without films.

    **Arguments:** `load`: loads of the raceway contacts, N, inner raceway first; `starved`: effect of the supply on
    these contacts. If an element has more than two contacts, `scene.geometry.arcs.races` gives the race of each row."""
    if scene.contact is None or scene.oil is None:
        return None
    supply = scene.contact.supply
    if supply is None:
        return SupplyResult(FLOODED)
    numbers: dict[str, Array] = {}
    if starved is not None:
        most = jnp.argmax(load, axis=1)[:, None]
        for name in ("film_factor", "rolling_factor", "gap_over_central"):
            values = jnp.broadcast_to(getattr(starved, name), load.shape)
            both = jnp.take_along_axis(values, most, axis=1)[:, 0]
            if len(load) > 2:
                both = _of_races(scene.geometry.arcs.races, jnp.max(load, axis=1), both)
            numbers |= {f"{name}_inner": both[0], f"{name}_outer": both[1]}
    return SupplyResult(supply.stated, **numbers)


def _of_races(races: tuple[int, ...], load: Float[Array, " contact"], values: Float[Array, " contact"]) -> list[Array]:
    """Values of the most loaded contact of each race, inner race first."""
    by_race = []
    for race in (0, 1):
        rows = np.flatnonzero(np.asarray(races) == race)
        by_race.append(values[rows][jnp.argmax(load[rows])])
    return by_race


def supply_problems(scene: AbstractBearing) -> Iterator[str | ValueError]:
    """Yields an error for each input that the oil supply of a scene needs and lacks."""
    supply, flow = None if scene.contact is None else scene.contact.supply, scene.operation.oil_flow
    if supply is not None and supply.from_flow is not None and numbers_or_none(flow) is not None:
        message = "operation.oil_flow: contact.supply.from_flow needs a volume flow > 0"
        yield from refusals_of(demand, message, flow != 0.0, lambda: message)


def supply_notes(scene: AbstractBearing) -> tuple[str, ...]:
    """The supply in words, for the notes of a transient run."""
    if scene.contact is None:
        return ()
    supply = scene.contact.supply
    return (f"oil supply of the raceways: {FLOODED if supply is None else supply.stated}",)
